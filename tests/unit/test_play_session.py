"""The playground's messages: every one gets an answer or a clear error, in strict JSON."""

from __future__ import annotations

import json
import math
import subprocess
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coplanar.errors import InvalidInput
from coplanar.play import Session, copying, protocol
from coplanar.play.controls import Choice, Rows, Slider, Stroke, Switch
from coplanar.play.openings import OPENINGS
from coplanar.play.scenarios import opened
from coplanar.play.tabs import TABS
from coplanar.scenarios import KINDS, from_data, load, names, parse

SESSION = Session()


def no_constant(name):
    raise AssertionError(name)


def answered(message):
    """The answer, which has to be strict JSON and never a fault of the playground."""
    text = SESSION.answer(message)
    answer = json.loads(text, parse_constant=no_constant)
    assert set(answer) >= {"id", "ok"}
    if not answer["ok"]:
        assert set(answer["error"]) == {"sentence", "key", "given", "needed"}
        assert "a fault of the playground" not in answer["error"]["sentence"], message
        assert len(text) < 4000
    return answer


def test_describe_names_every_control_with_its_range():
    tabs = answered({"id": 7, "do": "describe"})["tabs"]
    assert [tab["name"] for tab in tabs] == list(TABS) == ["arm", "drive", "base", "motion", "shoot", "lab"]
    for tab in tabs:
        for control in tab["controls"]:
            assert {"key", "label", "kind", "group", "help", "default"} <= set(control)
            if control["kind"] == "slider":
                assert control["min"] <= control["default"] <= control["max"]
                assert control["step"] > 0.0
            if control["kind"] == "choice":
                assert control["default"] in [option["value"] for option in control["options"]]
            for key, values in control.get("only", {}).items():
                assert key in {other["key"] for other in tab["controls"]} | {
                    f["key"] for f in control.get("fields", ())
                }
                assert values


@pytest.mark.parametrize(
    ("message", "key"),
    [
        ("", "message"),
        ("[]", "message"),
        ("{", "message"),
        ('{"id": NaN, "do": "describe"}', "message"),
        ('{"do": "show", "tab": "arm", "state": {"l1": 1e999}}', "message"),
        ("[" * 60000, "message"),
        ("x" * 70000, "message"),
        (b"\xff\xfe", "message"),
        ({"id": 1}, "do"),
        ({"do": ["show"]}, "do"),
        ({"do": "show", "eval": "1"}, "key"),
        ({"do": "show"}, "tab"),
        ({"do": "show", "tab": "arms"}, "tab"),
        ({"do": "show", "tab": "arm", "state": []}, "state"),
        ({"do": "show", "tab": "arm", "state": {"l9": 1.0}}, "key"),
        ({"do": "show", "tab": "arm", "state": {"l1": 9.0}}, "l1"),
        ({"do": "show", "tab": "arm", "state": {"l1": True}}, "l1"),
        ({"do": "show", "tab": "arm", "state": {"l1": math.nan}}, "message"),
        ({"do": "show", "tab": "arm", "state": {"l1": 10**400}}, "l1"),
        ({"do": "show", "tab": "arm", "state": {"elbow": "up"}}, "elbow"),
        ({"do": "show", "tab": "arm", "state": {"limited": 1}}, "limited"),
        ({"do": "show", "tab": "arm", "state": {"stroke": [[0, 0]] * 401}}, "stroke"),
        ({"do": "show", "tab": "arm", "state": {"stroke": [[0, 0], [0]]}}, "stroke"),
        ({"do": "show", "tab": "arm", "state": {"limited": True, "lower1": 1.0, "upper1": -1.0}}, "limits"),
        ({"do": "show", "tab": "arm", "drag": {"handle": "tool"}}, "drag"),
        ({"do": "show", "tab": "arm", "drag": {"handle": "nose", "to": [0, 0]}}, "handle"),
        ({"do": "show", "tab": "arm", "drag": {"handle": "tool", "to": [0, 1e9]}}, "drag.to"),
        ({"do": "show", "tab": "arm", "nudge": {"handle": "tool", "by": [0.5, 0]}}, "nudge.by"),
        ({"do": "show", "tab": "arm", "nudge": {"handle": "nose", "by": [1, 0]}}, "handle"),
        ({"do": "show", "tab": "arm", "changed": "l9"}, "changed"),
        ({"do": "show", "tab": "arm", "live": "yes"}, "live"),
        ({"do": "show", "tab": "base", "state": {"wheels": []}}, "wheels"),
        ({"do": "show", "tab": "base", "state": {"wheels": [{"x": 3.0}]}}, "wheels.0.x"),
        ({"do": "show", "tab": "base", "state": {"wheels": [{}, {"size": 3.0}]}}, "wheels.1.key"),
        ({"do": "show", "tab": "base", "state": {"wheels": [{}] * 9}}, "wheels"),
        ({"do": "copy", "tab": "arm", "as": "c"}, "as"),
        ({"do": "copy", "tab": "arm"}, "as"),
        ({1: 2}, "message"),
        ({"do": {1}}, "message"),
    ],
)
def test_what_cannot_be_answered_says_where_and_what_was_needed(message, key):
    error = answered(message)["error"]
    assert error["key"] == key
    assert error["needed"]


def test_a_wrong_name_is_answered_with_the_near_one():
    assert "did you mean 'arm'?" in answered({"do": "show", "tab": "arms"})["error"]["sentence"]


def test_the_id_comes_back_where_it_can():
    assert answered({"id": 3, "do": "describe"})["id"] == 3
    assert answered({"id": 3, "do": "no"})["id"] == 3
    assert answered({"id": "3", "do": "no"})["id"] is None
    assert answered({"id": 10**30, "do": "no"})["id"] is None


def test_what_nobody_thought_of_is_answered_and_logged(monkeypatch, caplog):
    monkeypatch.setitem(TABS, "arm", None)
    answer = SESSION.handle({"id": 5, "do": "show", "tab": "arm"})
    assert (answer["id"], answer["ok"]) == (5, False)
    assert "a fault of the playground" in answer["error"]["sentence"]
    assert "could not answer" in caplog.text


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=5) | st.dictionaries(st.text(max_size=6), inner, max_size=5),
    max_leaves=20,
)


@given(anything)
@settings(deadline=None, max_examples=60)
def test_any_value_is_answered(message):
    answered(message)


@given(st.text(max_size=60) | st.binary(max_size=60))
@settings(deadline=None, max_examples=60)
def test_any_text_is_answered(message):
    assert not answered(message)["ok"]


def valid(control):
    """Values that a control allows."""
    if isinstance(control, Slider):
        return st.floats(control.low, control.high, allow_subnormal=False)
    if isinstance(control, Choice):
        return st.sampled_from([value for value, _ in control.options])
    if isinstance(control, Switch):
        return st.booleans()
    if isinstance(control, Stroke):
        place = st.floats(-2.0, 2.0)
        return st.lists(st.tuples(place, place).map(list), max_size=12)
    assert isinstance(control, Rows)
    return st.lists(partly(control.fields), min_size=control.least, max_size=3)


def partly(controls):
    return st.fixed_dictionaries({}, optional={control.key: valid(control) for control in controls})


@st.composite
def requests(draw):
    tab = draw(st.sampled_from(sorted(TABS)))
    message = {"id": 1, "do": "show", "tab": tab, "live": True, "state": draw(partly(TABS[tab].controls))}
    keys = [control.key for control in TABS[tab].controls]
    message |= draw(st.fixed_dictionaries({}, optional={"changed": st.sampled_from(keys)}))
    if draw(st.booleans()):
        names = ("tool", "curve", "start", "heading", "end", "target", "launch", "velocity", "wheel_1", "turn_2")
        place = st.lists(st.floats(-1000.0, 1000.0), min_size=2, max_size=2)
        message["drag"] = {"handle": draw(st.sampled_from(names)), "to": draw(place)}
    return message


@given(requests())
@settings(deadline=None, max_examples=120)
def test_any_state_in_range_is_answered_or_refused_clearly_and_leads_to_one_in_range(message):
    answer = answered(message)
    if answer["ok"]:
        again = answered({"id": 2, "do": "show", "tab": message["tab"], "live": True, "state": answer["state"]})
        assert again["ok"], again
        assert set(again["state"]) == set(answer["state"])


@given(requests(), st.data())
@settings(deadline=None, max_examples=60)
def test_a_spoiled_state_is_answered(message, data):
    key = data.draw(st.sampled_from([control.key for control in TABS[message["tab"]].controls]))
    message["state"] = message["state"] | {key: data.draw(anything)}
    answered(message)
    message["do"], message["as"] = "copy", "python"
    answered({name: message[name] for name in ("id", "do", "as", "tab", "state")})


COPIED = [
    *((tab, {}) for tab in TABS),
    ("arm", {"links": "3", "limited": True}),
    ("arm", {"curve": "circle"}),
    ("arm", {"curve": "stroke", "stroke": [[0.5, 0.5], [0.7, 0.6], [0.9, 0.5], [1.1, 0.8]], "limited": True}),
    ("arm", {"target_x": 3.0}),
    ("arm", {"follow": "joints", "q1": -1.0}),
    ("drive", {"compare": True, "limited": True, "curve": "line"}),
    ("drive", {"curve": "point", "start": "free", "ki": 2.0}),
    ("drive", {"curve": "stroke", "stroke": [[x / 10, (x / 12) ** 2] for x in range(9)]}),
    ("base", {"layout": "mecanum", "rollers": "O", "slip": 1.0}),
    ("base", {"layout": "swerve"}),
    ("base", {"layout": "omni4"}),
    ("base", {"layout": "custom", "slipping": 8.0}),
    ("motion", {"compare": False, "then": [{"v": -1.0, "alpha": -0.3}]}),
    ("shoot", {"by": "time"}),
    ("shoot", {"by": "angle"}),
    ("shoot", {"by": "least"}),
    ("shoot", {"target_x": 150.0}),
    ("lab", {"motion": "shot", "duration": 1.5}),
    ("lab", {"motion": "shot", "drag": 0.5, "speed": 60.0, "step": 1.0, "duration": 10.0}),
]
RUNNER = """
import contextlib, io, json, sys
for text in json.load(sys.stdin):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(text, "copied", "exec"), {"__name__": "__main__"})
    print(json.dumps(out.getvalue()))
"""


def test_copied_programs_run_and_print_the_numbers_that_were_read():
    shown, programs = [], []
    for tab, state in COPIED:
        answer = answered({"id": 1, "do": "show", "tab": tab, "state": state})
        shown.append({e["key"]: e["number"] for e in answer["readouts"] if "number" in e})
        copied = answered({"id": 1, "do": "copy", "as": "python", "tab": tab, "state": answer["state"]})
        programs.append(copied["text"])
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", RUNNER],
        input=json.dumps(programs),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    for case, numbers, line in zip(COPIED, shown, done.stdout.splitlines(), strict=True):
        rows = [row.partition(" = ") for row in json.loads(line).splitlines()]
        printed = {key: float(value) for key, sign, value in rows if sign and key.isidentifier()}
        assert len(printed) > 1 or case[1].get("drag") == 0.5, case
        for key, value in printed.items():
            assert value == pytest.approx(numbers[key], rel=1e-12, abs=1e-12), (case, key)


@pytest.mark.parametrize(("tab", "state"), COPIED)
def test_copied_scenarios_load_measure_the_numbers_that_were_read_and_open_again(tab, state):
    answer = answered({"id": 1, "do": "show", "tab": tab, "state": state})
    copied = answered({"id": 1, "do": "copy", "as": "yaml", "tab": tab, "state": answer["state"]})
    scenario = parse(copied["text"])
    read = {e["key"]: e["number"] for e in answer["readouts"] if "number" in e}
    if scenario.type in ("lab", "shot"):  # their numbers are of other steps, and of another end
        return
    for key, value in scenario.measure().items():
        if key in read:
            assert value == pytest.approx(read[key], rel=1e-9, abs=1e-12), key
    name, back = opened(scenario)
    assert name == tab
    once = answered({"id": 1, "do": "copy", "as": "yaml", "tab": tab, "state": back})
    there = parse(once["text"]).measure()
    for key, value in scenario.measure().items():
        assert float(value) == pytest.approx(float(there[key]), rel=1e-9, abs=1e-12, nan_ok=True), key


@pytest.mark.parametrize("name", names())
def test_a_scenario_of_the_catalog_opens_or_is_refused_with_the_reason(name):
    scenario = load(name)
    if scenario.type not in OPENINGS:
        with pytest.raises(InvalidInput, match="one that the playground can show"):
            opened(scenario)
        return
    try:
        tab, state = opened(scenario)
    except InvalidInput:  # out of the range of a slider, or more than a tab can hold
        return
    assert answered({"id": 1, "do": "show", "tab": tab, "state": state})["ok"]


def test_driving_to_a_pose_opens_with_its_noise():
    tab, state = opened(load("drive-to-pose"))
    assert (tab, state["controller"], state["form"], state["noisy"], state["seed"]) == (
        "drive",
        "polar",
        "smooth",
        True,
        1,
    )
    assert state["arrive_within"] == 0.02


def test_what_has_no_place_in_the_playground_is_refused():
    scenario = load("track-astroid")
    assert opened(scenario)[1]["kd"] == 0.5
    with pytest.raises(InvalidInput, match="place in the playground"):
        opened(scenario.replaced({"limits": {"acceleration": 0.1}}))
    with pytest.raises(InvalidInput, match="seed = 100"):
        opened(scenario.replaced({"noise": {"position": 0.01, "seed": 100}}))
    with pytest.raises(InvalidInput, match=r"0\.1 to 200"):
        opened(scenario.replaced({"controller.kp": 400.0}))
    with pytest.raises(InvalidInput, match="two or three revolute links"):
        opened(parse("{type: arm-pose, arm: {links: [1, 1, 1, 1]}, q: [0, 0, 0, 0]}"))
    with pytest.raises(InvalidInput, match="arm-pose, arm-reach"):
        opened(from_data({"schema": 1, "type": "rolling-wheel", **KINDS["rolling-wheel"].example}))


def test_only_numbers_and_fixed_words_enter_a_copied_program():
    with pytest.raises(InvalidInput):
        copying.number(math.inf)
    hostile = '"); __import__("os").system("true'
    for key in ("curve", "elbow", "l1", "follow"):
        message = {"do": "copy", "as": "python", "tab": "arm", "state": {key: hostile}}
        assert not answered(message)["ok"]


def test_a_message_of_too_many_entries_is_refused():
    many = {"do": "show", "tab": "arm", "state": {"stroke": [[0, 0]] * 3000}}
    assert "entries" in answered(many)["error"]["sentence"]
    assert protocol.ENTRIES > 3 * 400  # a full stroke passes


def test_warming_answers_every_tab():
    SESSION.warm()
