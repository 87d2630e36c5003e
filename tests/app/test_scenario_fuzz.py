"""Whatever a file holds, reading it gives a scenario or one error that says what is wrong, and soon."""

from __future__ import annotations

import copy
import time

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from coplanar.scenarios import KINDS, InvalidScenario, Scenario, from_data, load, names, parse, read_value
from coplanar.scenarios.catalog import text

LONGEST = 10.0  # [s] for the worst text, on a busy machine
few = settings(deadline=None, max_examples=60, suppress_health_check=list(HealthCheck))
CATALOG = {name: text(name) for name in names()}

PIECES = b"\t|: |- |[|{|&a |*a|!!x |'|\n|\x00|\xff|#|? |% ".split(b"|")

scalars = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=12),
    st.sampled_from(["pi/2", "30 deg", "1e-3", "12 in", "on", "", "((((", "1/0", "9" * 70, "-", "e", "\ud800", "\x00"]),
    st.sampled_from([10**400, -(10**30), 1e308, 5e-324, float("nan")]),
)  # fmt: skip
keys = st.one_of(st.text(max_size=8), st.sampled_from(sorted({k for m in KINDS.values() for k in m.model_fields})))
trees = st.recursive(
    scalars,
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(keys, inner, max_size=4)),
    max_leaves=12,
)


def outcome_of(read, *given_):
    """The scenario, or the error; anything else fails the test."""
    begun, scenario, refused = time.perf_counter(), None, None
    try:
        scenario = read(*given_)
    except InvalidScenario as error:
        refused = error
    assert time.perf_counter() - begun < LONGEST
    if refused is not None:
        assert refused.problems
        assert all(problem.needed for problem in refused.problems)
        assert all(c.isprintable() or c == "\n" for c in str(refused))
    return scenario


def places(node, way=()):
    """Every place of a tree."""
    yield way
    inner = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in inner:
        yield from places(value, (*way, key))


@few
@given(st.dictionaries(keys, trees, max_size=6), st.sampled_from(sorted(KINDS)))
def test_any_mapping(data, kind):
    outcome_of(from_data, {"type": kind, **data})
    outcome_of(from_data, data)


@few
@given(trees)
def test_anything_at_all(tree):
    assert outcome_of(from_data, tree) is None


@settings(few, max_examples=150)
@given(st.sampled_from(sorted(CATALOG)), st.data())
def test_a_valid_scenario_with_one_place_changed(name, data):
    tree = load(name).data(defaults=data.draw(st.booleans()))
    way = data.draw(st.sampled_from([place for place in places(tree) if place]))
    holder = tree
    for step in way[:-1]:
        holder = holder[step]
    change = data.draw(st.sampled_from(["replace", "remove", "add"]))
    if change == "replace" or isinstance(holder, list):
        holder[way[-1]] = data.draw(trees)
    elif change == "remove":
        del holder[way[-1]]
    else:
        holder[data.draw(keys)] = data.draw(trees)
    scenario = outcome_of(from_data, copy.deepcopy(tree))
    assert scenario is None or isinstance(scenario, Scenario)


@pytest.mark.parametrize("name", names())
@settings(few, max_examples=25)
@given(data=st.data())
def test_bytes_of_every_file_changed(tmp_path_factory, name, data):
    content = bytearray(CATALOG[name].encode())
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(content) - 1))
        change = data.draw(st.sampled_from(["flip", "cut", "insert", "copy"]))
        if change == "flip":
            content[place] = data.draw(st.integers(0, 255))
        elif change == "cut":
            del content[place : place + data.draw(st.integers(1, 40))]
        elif change == "insert":
            content[place:place] = data.draw(st.sampled_from(PIECES))
        else:
            content[place:place] = content[: data.draw(st.integers(0, 80))]
        if not content:
            content = bytearray(b" ")
    path = tmp_path_factory.getbasetemp() / f"{name}.yaml"
    path.write_bytes(bytes(content))
    outcome_of(load, path)


@few
@given(st.text(max_size=60), st.sampled_from(["yaml", "toml", "json"]))
def test_any_text(text, form):
    outcome_of(parse, text, form)


@few
@given(st.text(max_size=30), trees)
def test_any_change(key, value):
    outcome_of(lambda: load("track-astroid").replaced({key: value}))
    outcome_of(lambda: load("arc-chain").replaced({f"segments.{key}": value}))


@few
@given(st.text(max_size=30))
def test_any_value_of_a_command(text):
    outcome_of(read_value, text)


LAUGHS = "a: &a [x,x,x,x,x,x,x,x,x]\n" + "".join(
    f"{new}: &{new} [{','.join([f'*{old}'] * 9)}]\n" for old, new in zip("abcdefghi", "bcdefghij", strict=True)
)
HOSTILE = [
    LAUGHS,
    "a: &a [*a]",
    "a: &a {b: *a}",
    "[" * 100_000,
    "{a: " * 50_000,
    "- " * 50_000,
    "? " * 50_000,
    "a: " + "(" * 200_000,
    "type: !!python/object/apply:os.system ['true']",
    "type: track\n<<: {name: a}",
    "type: track\n" * 3,
    "x" * 300_000,
    "a:\n" + "".join(" " * i + "a:\n" for i in range(1, 600)),
    "%YAML 9.9\n---\na",
    "a: 0x" + "f" * 100_000,
    "a: " + "9" * 100_000,
    "'" * 100_001,
    "a: |\n" + " x\n" * 60_000,
]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_yaml(text):
    assert outcome_of(parse, text) is None


@pytest.mark.parametrize(
    ("form", "text"),
    [
        ("json", "[" * 200_000),
        ("json", '{"a":' * 60_000),
        ("json", '{"type": "track", "type": "shot"}'),
        ("json", '{"type": "shot", "level": NaN}'),
        ("json", '{"type": ' + "1" * 200_000 + "}"),
        ("toml", "a = [" + "[" * 100_000),
        ("toml", ".".join("a" * 60_000) + " = 1"),
        ("toml", "\n".join(f"[{'a.' * n}b]" for n in range(1, 400))),
        ("toml", "type = 0x" + "f" * 100_000),
        ("toml", "type = 2020-01-01"),
        ("toml", "a = 1\na = 2"),
    ],
    ids=range(11),
)
def test_hostile_json_and_toml(form, text):
    assert outcome_of(parse, text, form) is None


def test_yaml_of_others_reads_the_same():
    """What PyYAML itself writes of plain data comes back."""
    for name in names():
        data = load(name).data()
        assert load(name) == parse(yaml.safe_dump(data))
