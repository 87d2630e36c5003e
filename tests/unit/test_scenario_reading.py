"""Files, texts and data: what is read, and what the errors say."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

from coplanar.errors import InvalidInput
from coplanar.scenarios import InvalidScenario, from_data, load, names, parse, read_value
from coplanar.scenarios.catalog import text

TRACK = """\
schema: 1
type: track
referenc: 3
reference:
  curve: {type: circel, radius: 1}
controller:
  type: point-tracker
  point: [1]
  kp: -3
  kpp: 4
duration: 3 kg
integrator:
  method: rk5
"""


def problems(read, *given):
    with pytest.raises(InvalidScenario) as caught:
        read(*given)
    return {problem.key: problem for problem in caught.value.problems}, str(caught.value)


def test_everything_at_once_with_line_key_given_needed_and_remedy():
    found, told = problems(parse, TRACK)
    assert {key: problem.line for key, problem in found.items()} == {
        "referenc": 3, "reference.curve.type": 5, "controller.point.1": 8, "controller.kp": 9, "controller.kpp": 10,
        "duration": 11, "integrator.method": 13,
    }  # fmt: skip
    assert found["referenc"].remedy == "did you mean 'reference'?"
    assert found["reference.curve.type"].remedy == "did you mean 'circle'?"
    assert found["controller.kp"].given == "-3"
    assert found["controller.kp"].needed == "a gain [1/s] above 0"
    assert found["controller.kpp"].remedy == "did you mean 'kp'?"
    assert "its unit is that of a mass" in found["duration"].remedy
    assert found["integrator.method"].remedy == "did you mean 'rk4'?"
    assert [line.split(": ")[1] for line in told.splitlines()] == [f"line {n}" for n in (3, 5, 8, 9, 10, 11, 13)]


def test_what_the_library_refuses_is_told_by_its_key():
    found, _ = problems(parse, "type: arm-pose\narm: {links: [1, 1], joints: RX}\nq: [0, 0]")
    assert found["arm.joints"].line == 2
    found, _ = problems(load("track-astroid").replaced, {"controller.point.0": 0})
    assert "PolarController" in found["controller.point"].remedy
    found, _ = problems(
        parse, "type: wheels\ntwist: {}\nbase: {type: differential, radius: 1, half_track: 1, track: 2}"
    )
    assert next(iter(found)).startswith("base.")
    found, _ = problems(parse, "type: program\nsegments:\n- {v: 1, duration: 1}\n- {omega: 1e9, duration: 1e3}")
    assert next(iter(found)).startswith("segments.1")
    assert next(iter(found.values())).line == 4


@pytest.mark.parametrize(
    ("text", "value"),
    [("1e-3", 0.001), ("1E5", 1e5), (".5", 0.5), ("010", 10), ("on", "on"), ("12:30", "12:30"), ("~", None),
     ("yes", "yes"), ("true", True), ("2001-01-01", "2001-01-01"), ("1_000", "1_000"), ("'1'", "1"),
     ("[1, 30 deg]", [1, "30 deg"]),
     ("{a: 1}", {"a": 1}), ("", None), ("-7", -7)],
)  # fmt: skip
def test_yaml_without_its_traps(text, value):
    read = read_value(text)
    assert read == value
    assert type(read) is type(value)


def test_a_switch_may_be_on():
    tracker = "controller: {type: point-tracker, point: [1, 0], kp: 1, feedforward: %s}"
    base = "type: track\nreference: {curve: {type: circle, radius: 1}}\n"
    assert parse(base + tracker % "on").controller.feedforward is True
    assert parse(base + tracker % "no").controller.feedforward is False
    assert "controller.feedforward" in problems(parse, base + tracker % "maybe")[0]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a: 1\na: 2", "line 2: a: needed each key once"),
        ("a: !!python/object:os.system x", "without tags"),
        ("? [a]\n: 1", "keys that are words"),
        ("", "a mapping of keys"),
        ("- 1", "a mapping of keys"),
        ("{}", "type = nothing: needed one of frames, arm-pose"),
        ("type: trak", "did you mean 'track'?"),
        ("type: [1]", "type = [1]"),
        ("a: *b", "undefined alias"),
    ],
)
def test_what_is_no_scenario(text, words):
    assert words in problems(parse, text)[1]


def test_numbers_that_are_none():
    shot = "type: shot\nprojectile: {mass: %s}\nlaunch: {speed: 1, angle: 1}"
    for bad in ("yes", "true", ".nan", ".inf", "1e999", "null", "[1]", "{}", "'x'"):
        assert "projectile.mass" in problems(parse, shot % bad)[0]
    assert parse(shot % "'1e-3'").projectile.mass == 1e-3
    assert "points" in problems(parse, shot % "1" + "\npoints: true")[0]
    assert "points" in problems(parse, shot % "1" + "\npoints: 10.5")[0]
    assert "schema" in problems(parse, shot % "1" + "\nschema: 2")[0]


def test_toml_and_json_make_the_same_scenario(tmp_path):
    yaml, toml, json = tmp_path / "a.yaml", tmp_path / "a.toml", tmp_path / "a.json"
    yaml.write_text("type: arm-reach\narm:\n  links: [1, 50 cm]\ntarget: [1, 0]\n")
    toml.write_text('type = "arm-reach"\ntarget = [1, 0]\n[arm]\nlinks = [1, "50 cm"]\n')
    json.write_text('{"type": "arm-reach", "target": [1, 0], "arm": {"links": [1, "50 cm"]}}')
    assert load(yaml) == load(toml) == load(json)
    assert load(yaml).name == "a"


def test_lines_in_toml_and_json():
    found, _ = problems(parse, 'type = "program"\n\n[[segments]]\nv = 1\nduration = 1\n[[segments]]\nvv = 2\n', "toml")
    assert found["segments.1.vv"].line == 7
    assert found["segments.1.duration"].line == 6
    found, _ = problems(parse, '{\n "type": "program",\n "segments": [\n  {"duration": "x"}]}', "json")
    assert found["segments.0.duration"].line == 4
    assert parse('\ufeff{"type": "arm-pose", "arm": {"links": [1]}, "q": [0]}'.lstrip("\ufeff"), "json").q == (0.0,)


def test_files_that_cannot_be_read(tmp_path):
    (tmp_path / "folder.yaml").mkdir()
    (tmp_path / "latin.yaml").write_bytes(b"type: track\ntitle: \xe4")
    (tmp_path / "bom.yaml").write_bytes("\ufefftype: arm-pose\narm: {links: [1]}\nq: [0]".encode())
    for name, words in (
        ("none.yaml", "no file"), ("folder.yaml", "no file"), ("a.txt", "ends in .yaml"),
        ("latin.yaml", "line 2: byte 0xe4"), ("nul\x00.yaml", "can be read"),
    ):  # fmt: skip
        assert words in problems(load, tmp_path / name)[1]
    assert load(tmp_path / "bom.yaml").name == "bom"


def test_the_name_comes_from_the_file_and_is_fit_for_a_folder(tmp_path):
    path = tmp_path / "My Robot (1).yaml"
    path.write_text(text("arm-pose"))
    assert load(path).name == "my-robot-1"
    assert from_data({"type": "arm-pose", "arm": {"links": [1]}, "q": [0]}).name == "arm-pose"
    for bad in ("../x", "a/b", "", ".", "a b", "A"):
        assert "name" in problems(from_data, {"type": "arm-pose", "arm": {"links": [1]}, "q": [0], "name": bad})[0]


def test_names():
    assert load("lemniscate").name == "trace-lemniscate"
    assert load("astroid").name == "track-astroid"
    assert "did you mean 'trace-circle'?" in problems(load, "trace-circel")[1]
    assert "did you mean 'aim-time'?" in problems(load, "aim-tme")[1]
    assert load("least").name == "aim-least"
    files = {path.stem for path in (Path(__file__).parents[2] / "src/coplanar/scenarios/catalog").glob("*.yaml")}
    assert files == set(names())


def test_the_error_is_one_of_the_family_and_travels():
    with pytest.raises(InvalidInput) as caught:
        parse("type: trak")
    back = pickle.loads(pickle.dumps(caught.value))
    assert str(back) == str(caught.value)
    assert back.problems == caught.value.problems
    many = {f"k{i}": 1 for i in range(40)}
    found, told = problems(from_data, {"type": "arm-pose", **many})
    assert len(found) == 42
    assert told.endswith("and 17 problems more")


def test_changes_by_key():
    track = load("track-astroid")
    other = track.replaced({"controller.kp": "20/s", "controller.point.1": 0.02, "noise.seed": 3, "limits.v": 1})
    assert (other.controller.kp, other.controller.point) == (20.0, (0.05, 0.02))
    assert (other.noise.seed, other.limits.v, other.limits.mode) == (3, 1.0, "scale")
    assert track.controller.kp == 100.0
    assert track.replaced({"integrator": {"method": "rk4"}, "unstable": "run"}).integrator.step == 0.01
    arm = load("arm-reach").replaced({"arm.links.0": "30 cm", "arm.limits": [[0, 1], None], "arm.base.x": 1})
    assert arm.arm.links == (0.3, 0.5)
    assert arm.arm.limits == ((0.0, 1.0), None)


@pytest.mark.parametrize(
    ("key", "words"),
    [
        ("controler.kp", "did you mean 'controller'?"),
        ("controller.kpp", "did you mean 'kp'?"),
        ("controller.point.2", "a place from 0 to 1"),
        ("controller.point.x", "a place from 0 to 1"),
        ("duration.x", "duration = 10.0: needed no keys behind it"),
        ("integrator.method.x", "no keys behind it"),
        ("controller.point.0.x", "controller.point.0"),
        ("", "a key that is known here"),
        ("..", "a key that is known here"),
    ],
)
def test_keys_that_lead_nowhere(key, words):
    assert words in problems(load("track-astroid").replaced, {key: 1.0})[1]
