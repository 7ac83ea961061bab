"""Homes of drafts: no input is near a fold of an inner loop, none is where operation modes meet."""

from pathlib import Path

import numpy as np
import pytest

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import assemble
from assur.kinematics.home import home_values
from assur.kinematics.rates.restraint import WELL
from assur.model.file.reader import read_text
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.homes import holding, remarks, travel
from assur.topology.notation import parse_chains

RAILS, UPRIGHT = "{P[y] R[x] R[x] | P[y] R[x] R[x]}", "{P[z] R[y] R[y] | P[z] R[y] R[y]}"
FIVE_BAR, UPRIGHT_FIVE_BAR = "{R[z] R[z] | R[z] R[z] R[z]}", "{R[x] R[x] R[x] | R[x] R[x]}"
KINDS = [
    [UPRIGHT_FIVE_BAR + " R[y]", "R[x] R[x] R[x] R[y]"],
    *([RAILS + " R[y] R[y]", other] for other in ("R[z] R[z] C[z]", "P[y] P(4R)[x] P(4R)[y]")),
    [UPRIGHT + " R[z]", "P[x] R[y] R[y] R[z]"],
    [RAILS, "P[y] U[x,y] S"],
    [FIVE_BAR + " R[z]", "R[z] R[z] R[z]"],
    [FIVE_BAR + " R[z]"] * 3,
    [UPRIGHT_FIVE_BAR + " S", "S P[z] U[x,y]", "S P[z] U[x,y]"],
    ["{P[y] R[x] R[x] | R[x] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]"],
    ["{R[z] R[z] R[z] | R[z] R[z]} P[z]", "R[z] R[z] C[z]"],
    ["P[x] P(2US)[x]", "{P[y] P(4R)[x] | P[y] P(4R)[x]} P(4R)[z]"],
]
MM, DEG, STEPS = 9.0, 4.5, 20


def moved(record, index, change):
    """Joint values (steps, n) as one input changes in equal steps, angles and shares of lengths."""
    home, held = home_values(record), list(record.input_indices)
    path = [home]
    for _ in range(STEPS):
        start = path[-1].copy()
        start[index] += change / STEPS
        closed = assemble(record, start, held=held, near=True)
        assert bool(closed.closed)
        path.append(closed.values)
    length = characteristic_length(record)
    return np.array(path) / [length if item.kind == "length" else 1.0 for item in record.coordinates]


@pytest.mark.parametrize("chains", [KINDS[0], *(pytest.param(chains, marks=pytest.mark.deep) for chains in KINDS[1:])])
def test_no_input_of_a_draft_with_inner_loops_is_near_a_fold(chains):
    """Towards a fold equal steps of an input move other joints by ever longer ones, as a root does, and end."""
    record = read_text(drafted(parse_chains(chains), Path("my.toml")).text, Path("my.toml"))
    for index in record.input_indices:
        way = MM if record.coordinates[index].kind == "length" else np.radians(DEG)
        for change in (way, -way):
            steps = np.linalg.norm(np.diff(moved(record, index, change), axis=0), axis=1)
            assert np.max(steps) < 3.0 * np.min(steps)


def test_a_home_at_which_modes_meet_is_left_along_the_one_asked_for():
    """Upright as drawn, its first limb may turn about y beside the second; leaning, it may not."""
    chains = parse_chains(["C[x] R[y] U[y,x]", "{P[z] R[y] | P[z] R[y] R[y]} C[y]"])
    record = read_text(drafted(chains, Path("my.toml"), mode="translation").text, Path("my.toml"))
    lean = home_values(record)[[f"{item.joint}.{item.component}" for item in record.coordinates].index("a1.A.rotation")]
    assert abs(lean) > np.radians(DEG)
    assert holding(record) < WELL


def test_a_home_near_a_fold_is_said():
    record = load_record("three_rps")
    assert remarks(record, travel(record)) == ()
    (said,) = remarks(record, 0.0)
    assert "near a fold" in said
    assert "less than 5 mm or 2.5 deg" in said
