"""Scenarios written again, templates, and the schema that editors read."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

import coplanar.scenarios
from coplanar.scenarios import KINDS, InvalidScenario, from_data, load, names, parse, schema, template
from coplanar.scenarios.catalog import text
from coplanar.scenarios.texts import parsed

VALIDATOR = jsonschema.Draft202012Validator(schema())


@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize(("defaults", "comments"), [(False, False), (True, True)])
def test_what_is_written_is_read_again(name, defaults, comments):
    scenario = load(name)
    written = scenario.to_yaml(defaults=defaults, comments=comments)
    assert parse(written) == scenario
    assert yaml.safe_load(written)["name"] == name
    assert all(len(line) < 200 for line in written.splitlines())
    assert from_data(json.loads(json.dumps(scenario.data(defaults=defaults)))) == scenario


@settings(deadline=None, max_examples=60)
@given(st.text(st.characters(exclude_categories=("Cs",)), max_size=200), st.floats(-1e9, 1e9), st.floats(1e-9, 1.0))
def test_any_text_and_number_come_back(words, angle, length):
    data = {"type": "arm-pose", "arm": {"links": [length]}, "q": [angle], "title": words, "description": words}
    scenario = from_data(data)
    back = parse(scenario.to_yaml(comments=True))
    assert (back.q, back.arm.links, back.title, back.description) == ((angle,), (length,), words, words)
    assert yaml.safe_load(scenario.to_yaml())["arm"]["links"] == [length]


@pytest.mark.parametrize("kind", KINDS)
def test_a_template_runs_as_it_is_and_shows_every_key(kind):
    written = template(kind)
    scenario = parse(written)
    outcome = scenario.run()
    assert (outcome.ok, outcome.passed) == (True, True)
    assert scenario.type == kind
    model = type(scenario)
    assert set(yaml.safe_load(written)) == {field.alias or name for name, field in model.model_fields.items()}
    values = [line for line in written.splitlines() if not line.startswith("#")]
    assert values[0].startswith("schema: 1  # ")
    assert [line for line in values if not line.startswith(" ") and "  # " not in line] == []


def test_a_template_of_no_kind():
    with pytest.raises(InvalidScenario, match="did you mean 'track'"):
        template("trak")


def test_units_stand_in_the_comments():
    written = template("track")
    assert "kp: 3.0  # Velocity per error: how hard the point is pulled to the reference [1/s]" in written
    assert "error_against: current  # Which sample of the reference the error is taken to: current, next" in written
    assert "half_track" in next(line for line in written.splitlines() if line.startswith("limits: null"))


def test_the_schema_in_the_package_is_that_of_the_models():
    path = Path(coplanar.scenarios.__file__).with_name("schema.json")
    assert json.loads(path.read_text("utf-8")) == json.loads(json.dumps(schema()))


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(schema())


@pytest.mark.parametrize("name", names())
def test_the_schema_takes_every_demonstration(name):
    VALIDATOR.validate(parsed(text(name), "yaml", name).data)
    VALIDATOR.validate(load(name).data(defaults=True))


@pytest.mark.parametrize("kind", KINDS)
def test_the_schema_takes_every_template(kind):
    VALIDATOR.validate(yaml.safe_load(template(kind)))


@pytest.mark.parametrize(
    "change",
    [
        {"controller": {"type": "point-tracker", "point": [1, 0], "kp": -1}},
        {"controller": {"type": "point-tracker", "point": [1, 0], "kp": 1, "kpp": 1}},
        {"controller": {"type": "point-tracker", "point": [1], "kp": 1}},
        {"integrator": {"method": "rk5"}},
        {"durations": 1},
        {"duration": True},
        {"schema": 2},
        {"type": "trak"},
        {"name": "a/b"},
    ],
)
def test_the_schema_refuses_what_the_models_refuse(change):
    data = {**load("track-astroid").data(), **change}
    assert not VALIDATOR.is_valid(data)
    with pytest.raises(InvalidScenario):
        from_data(data)


def every_field(part):
    for definition in part["$defs"].values():
        yield from definition.get("properties", {}).items()


def test_every_field_says_what_it_is_and_its_unit():
    for key, field in every_field(schema()):
        assert field.get("description"), key
        inside = json.dumps(field)
        if '"x-unit": "' in inside.replace('"x-unit": ""', ""):
            assert field["description"].endswith("]"), key


@pytest.mark.parametrize("first", range(1, 20))
def test_long_texts_are_folded_without_loss(first):
    words = " ".join(["a" * first, *["a well-known two-link arm", "an on-line half-track"] * 20])
    scenario = load("arm-pose").replaced({"description": words})
    written = scenario.to_yaml()
    assert "description: >-" in written
    assert parse(written).description == yaml.safe_load(written)["description"] == words
