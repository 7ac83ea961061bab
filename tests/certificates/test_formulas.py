import numpy as np
import pytest

import assur
from assur.certificates.formulas import GROUPS, formulas
from assur.model.registry import load_record
from assur.numerics.intervals.interval import Interval
from assur.workspace.certified.criteria import criteria

QUESTIONS = [
    ("zeng2019", {}, {"x": (-110, 90), "y": (-250, 250), "z": (180, 480)}),
    ("planar_3rpr", {"strokes": {"rho1": (0, 12)}}, {"x": (-9, 9), "y": (-9, 9), "phi": (-3, 3)}),
    ("fivebar", {"strokes": {"theta1": (0.5, 2.5)}}, {"x": (-150, 150), "y": (50, 250)}),
    (
        "gough_stewart",
        {"held": {"x": 0.1, "y": 0.0, "z": 0.9}},
        {"phi": (-1, 1), "theta": (-1, 1), "psi": (-1, 1)},
    ),
]


@pytest.mark.parametrize(("name", "asked", "box"), QUESTIONS)
def test_margins_and_factors_are_those_of_the_criteria(name, asked, box):
    """The same kernel, recorded on two ways, of which one has its constants worked out before."""
    record = load_record(name)
    mine, other = formulas(record, **asked), criteria(record, **asked, factors=("parallel", "serial"))
    rng = np.random.default_rng(5)
    points = [Interval.of(rng.uniform(*box[coordinate], 400)) for coordinate in mine.slice.free]
    found, _ = mine.over(points)
    wanted = other.over(points)
    compared = 0
    for group, names in (("margins", other.margins), ("nonzero", other.regular), ("factors", mine.names("factors"))):
        for item in names:
            one, two = found[f"{group}: {item}"], wanted[item]
            both = np.isfinite(one.low) & np.isfinite(two.low) & np.isfinite(one.high) & np.isfinite(two.high)
            assert np.all((one.low <= two.high) | ~both)
            assert np.all((two.low <= one.high) | ~both)
            compared += int(np.sum(both))
    assert compared > 400
    assert mine.names("margins") == other.margins


def test_boxes_with_margins_are_those_that_the_inverse_problem_solves():
    record = assur.load("zeng2019")
    rules = formulas(record)
    rng = np.random.default_rng(6)
    points = rng.uniform([-110, -250, 180], [90, 250, 480], (200, 3))
    found, _ = rules.over([Interval.of(column) for column in points.T])
    reached = np.all([found[f"margins: {name}"].low >= 0 for name in rules.names("margins")], axis=0)
    solved = record.inverse(points, record.modes.default_working).exists.any(axis=-1)
    assert np.array_equal(reached, solved)
    assert 10 < np.sum(reached) < 190


def test_the_program_as_data_has_every_number_exactly(case, made_of):
    program = made_of(case).program
    assert set(program) == {"operations", *GROUPS}
    for name, *arguments in program["operations"]:
        if name == "number":
            low, high = (float.fromhex(text) for text in arguments[:2])
            slack = 1e-12 * max(abs(low), abs(high), 1e-300) if arguments[2].startswith("constant") else 0.0
            assert 0 <= high - low <= slack


def test_parameters_and_what_is_held_stand_in_the_program(made_of):
    numbers = {item[3]: item[1] for item in made_of("strokes").program["operations"] if item[0] == "number"}
    assert numbers["l2"] == (280.0).hex()
    assert numbers["y"] == (200.0).hex()
    assert numbers["sign u1"] == (-1.0).hex()


def test_cosines_and_sines_are_left_to_the_verifier(made_of):
    operations = [item[0] for item in made_of("held angle").program["operations"]]
    assert operations.count("cosine") == operations.count("sine") == 1
