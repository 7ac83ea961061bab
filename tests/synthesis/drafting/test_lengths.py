"""Lengths: the same mechanism as by coordinates, in parameters as papers have them, whose home closes."""

import re
from pathlib import Path

import numpy as np
import pytest

import assur
from assur.kinematics.home import home_values
from assur.kinematics.validation.check import faults
from assur.model.dimensions import with_parameters
from assur.model.file.reader import read_text
from assur.synthesis.drafting.attempts import DraftQuestion
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.inputs import inputs_for
from assur.synthesis.drafting.layout import LAYOUTS
from assur.synthesis.drafting.lengths import by_lengths
from assur.synthesis.drafting.templates import draft
from assur.synthesis.shorthand.arrangements import arranged

PATH = Path("my.toml")
SAME = [
    *(("3-RRR", "planar"), ("3-RRR", "spherical"), ("3-PRR", ""), ("3-RRS", ""), ("3-PRS", "upright"), ("3UPS&UP", "")),
    *(("Delta", ""), ("linear Delta", ""), ("3-RRPaR", ""), ("3-CRR", ""), ("H4", ""), ("Orthoglide", "")),
]
"""Arrangements whose P, if there are any, are on the base or left general: no P is turned along its leg."""


def parameters(text, name=""):
    arrangement = arranged(text, name)
    found = drafted(arrangement.chains, PATH, actuate=arrangement.actuate, mode=arrangement.mode)
    record = read_text(found.text, PATH)
    assert faults(record) == ()
    return record


@pytest.mark.parametrize(
    ("text", "name"),
    [pytest.param(*item, marks=pytest.mark.deep) if item[0] in ("H4", "3UPS&UP", "3-RRPaR") else item for item in SAME],
)
def test_the_direct_problem_has_the_same_solutions_as_by_coordinates(tmp_path, monkeypatch, text, name):
    """The joints' values differ by those at home, which is the same place."""
    exact = lambda drawn, *, rounded, polar: by_lengths(drawn, rounded=False)  # noqa: E731, ARG005
    monkeypatch.setattr("assur.synthesis.drafting.attempts.by_lengths", exact)
    arrangement = arranged(text, name)
    inputs, topology = inputs_for(arrangement.chains, arrangement.actuate, arrangement.mode)
    forms = [
        DraftQuestion(arrangement.chains, PATH, inputs, topology, arrangement.mode, coordinates)
        for coordinates in (True, False)
    ]
    pairs = ([form.attempt(layout, moved=False) for form in forms] for layout in LAYOUTS[0] + LAYOUTS[1])
    pair = next(pair for pair in pairs if all(made.record is not None and made.clearance > 0.1 for made in pair))
    answers = []
    for number, made in enumerate(pair):
        path = tmp_path / f"form{number}.toml"
        path.write_text(made.text.replace('name   = "my"', f'name   = "form{number}"'), encoding="utf-8")
        mechanism = assur.load(path)
        driven = [mechanism.coordinates.index(item.coordinate) for item in mechanism.inputs]
        lengths = np.array([mechanism.coordinates[place].kind == "length" for place in driven])
        home = home_values(mechanism)
        change = np.where(lengths, 7.0, 0.05) * (1 + 0.2 * np.arange(len(driven)))
        found = mechanism.direct(home[driven] + change)
        answers.append(found.poses[found.exists])
    by_coordinates, lengths_form = answers
    assert len(by_coordinates) == len(lengths_form) > 0
    for pose in by_coordinates:
        assert np.min(np.max(np.abs(lengths_form - pose), axis=1)) < 1e-4


@pytest.mark.parametrize(
    ("text", "name", "names"),
    [
        ("3-RPS", "", ["a", "b"]),
        ("Delta", "", ["B_w", "a", "b", "l1", "l2"]),
        ("3-RRS", "", ["a", "b", "l1", "l2"]),
        ("3UPS&UP", "", ["rA", "rC"]),
        ("3-UPU", "tangential", ["a", "b"]),
    ],
)
def test_a_standard_mechanism_has_the_parameters_of_papers_and_nothing_that_is_zero(text, name, names):
    record = parameters(text, name)
    assert sorted(record.parameters) == names
    assert all(parameter.value for parameter in record.parameters.values())
    assert all(parameter.value == round(parameter.value, 1) for parameter in record.parameters.values())


def test_a_leg_s_stroke_is_its_length():
    record = parameters("6-UPS")
    values = home_values(record)
    a, b = (record.joints[name] for name in ("a1.A", "a1.C"))
    stroke = values[[item.joint for item in record.coordinates].index("a1.B")]
    platform = np.array([0.0, 0.0, 300.0]) + b.child_at
    assert stroke == pytest.approx(np.linalg.norm(platform - a.at), abs=1.0)


@pytest.mark.parametrize(
    ("text", "name"),
    [("3-RRR", "planar"), ("3-RPS", ""), ("Delta", ""), pytest.param("6-RUS", "", marks=pytest.mark.deep)],
)
def test_home_closes_with_other_lengths(text, name):
    record = parameters(text, name)
    rng = np.random.default_rng(1)
    values = {key: size.value * rng.uniform(0.95, 1.05) for key, size in record.parameters.items()}
    changed = with_parameters(record, **values)
    assert np.isfinite(home_values(changed)).all()
    assert not np.allclose(home_values(changed), home_values(record))


def test_equal_links_of_a_template_have_one_length():
    """The four corners and two rods of a parallelogram are its width and one length."""
    text = drafted(arranged("Delta").chains, PATH).text
    assert [len(re.findall(rf"^{letter}", text, re.MULTILINE)) for letter in (r"l\d+ ", r"\w+_w ")] == [2, 1]


@pytest.mark.parametrize("layout", LAYOUTS[0] + LAYOUTS[1])
def test_by_lengths_and_by_coordinates_have_the_same_links_and_joints(layout):
    drawn = draft(arranged("6-RUS").chains, layout)
    made = by_lengths(drawn)
    for first, second in zip(drawn.templates, made.templates, strict=True):
        assert [joint.name for joint in first.joints] == [joint.name for joint in second.joints]
        assert first.links == second.links
