"""Files at the border of what is derived: a clear word, and never a wrong derivation."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.derivation.home_conditions import conditions_at_home
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import analytic_solution
from assur.kinematics.position import direct
from assur.model.registry import load_record
from derived_points import derived_points, inputs_near_home

FIVE_BAR = """format = 1
name = "bars"
unit = "mm"
angle = "deg"
base = "base"
platform = {{ link = "rod1", pose = ["x", "y", "z"], point = ["l", 0, 0] }}
[parameters]
a = {{ value = 60 }}
l = {{ value = {rod} }}
m = {{ value = 60 }}
tilt = {{ value = 25, unit = "deg", sign = "any" }}
[links]
base = {{}}
rail = {{}}
crank1 = {{}}
crank2 = {{}}
rod1 = {{}}
rod2 = {{}}
[joints]
S = {{ type = "prismatic", parent = "base", child = "rail", axis = {axis} }}
A1 = {{ type = "revolute", parent = "rail", child = "crank1", at = ["-a", 0, 0], axis = {axis} }}
B1 = {{ type = "revolute", parent = "crank1", child = "rod1", at = ["m", 0, 0], axis = {axis} }}
A2 = {{ type = "revolute", parent = "rail", child = "crank2", at = ["a", 0, 0], axis = {axis} }}
B2 = {{ type = "revolute", parent = "crank2", child = "rod2", at = ["m", 0, 0], axis = {axis} }}
C = {{ type = "revolute", parent = "rod1", child = "rod2", at = ["l", 0, 0], child_at = ["l", 0, 0], axis = {axis} }}
[inputs]
S = {{ name = "h" }}
A1 = {{ name = "q1" }}
A2 = {{ name = "q2" }}
[home]
S = 10
A1 = 90
B1 = {bend}
A2 = 90
B2 = {other}
C = 180
"""
TILTED = '["0", "-sin(tilt)", "cos(tilt)"]'

PARALLEL = """format = 1
name = "bars"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "coupler", pose = ["x"] }
[parameters]
a = { value = 100 }
d = { value = 50 }
la = { value = 80 }
lb = { value = 80 }
lc = { value = 80 }
[links]
base = {}
first = {}
second = {}
third = {}
coupler = {}
[joints]
A = { type = "revolute", parent = "base", child = "first", axis = "z" }
B = { type = "revolute", parent = "first", child = "coupler", at = [0, "la", 0], axis = "z" }
C = { type = "revolute", parent = "base", child = "second", at = ["a", 0, 0], axis = "z" }
D = { type = "revolute", parent = "second", child = "coupler", at = [0, "lb", 0], child_at = ["a", 0, 0], axis = "z" }
E = { type = "revolute", parent = "base", child = "third", at = ["d", 0, 0], axis = "z" }
F = { type = "revolute", parent = "third", child = "coupler", at = [0, "lc", 0], child_at = ["d", 0, 0], axis = "z" }
[inputs]
A = { name = "q" }
[home]
A = 20
B = -20
C = 20
D = -20
E = 20
F = -20
"""


def record_of(text, folder):
    path = folder / "bars.toml"
    path.write_text(text)
    return load_record(path)


def test_axes_by_the_cosine_of_a_dimension_are_derived_for_any_of_its_values(tmp_path):
    """Conditions and formulas have no sum of squares in them that is 1, and no branch is lost where tilt is zero."""
    record = record_of(FIVE_BAR.format(axis=TILTED, rod=70, bend=-60, other=60), tmp_path)
    for problem, branches in (("direct", 2), ("inverse", 4)):
        solution = analytic_solution(record, problem)
        assert solution.branches == branches
        assert solution.closes()
        assert not any(
            condition.has(solution.symbols.parameters["tilt"])
            for part in solution.sets
            for condition in part.conditions
        )
    inputs = inputs_near_home(record)
    points, met = derived_points(record, inputs), [own.pose for own in direct(record, inputs, method="search")]
    assert len(met) == len(points) == 2
    for pose in met:
        assert min(np.max(np.abs(own - pose)) for own in points) < 1e-6


def test_a_singular_home_is_said(tmp_path, capsys):
    """Both rods lie on one line at home: there the two assemblies meet."""
    record = record_of(FIVE_BAR.format(axis='"z"', rod=60, bend=-90, other=90), tmp_path)
    solution = analytic_solution(record, "direct")
    assert [*conditions_at_home(solution)] == [solution.roots[-1].radicand]
    assert main(["derive", str(record.file), "--problem", "direct"]) == 0
    assert "at home M1 = 0: with the file's dimensions" in " ".join(capsys.readouterr().out.split())


def test_degenerate_dimensions_at_home_are_said(tmp_path):
    """Links of one length, on bases of one width: home is where the circles of the last set coincide."""
    text = load_record("zeng2019").file.read_text(encoding="utf-8")
    changed = text.replace("b  = { value = 150", "b  = { value = 50").replace(
        "l6 = { value = 230", "l6 = { value = 180"
    )
    assert changed.count("value = 180") == text.count("value = 180") + 1
    path = tmp_path / "degenerate.toml"
    path.write_text(changed)
    solution = analytic_solution(load_record(path), "direct")
    assert solution.branches == 8
    assert {str(own) for own in conditions_at_home(solution)} == {"N3", "M3"}


def test_loops_that_close_for_special_numbers_alone_are_not_derived(tmp_path, capsys):
    """Three parallel bars: of three lengths with one value each loop closes, of three others none."""
    record = record_of(PARALLEL, tmp_path)
    for problem in ("direct", "inverse"):
        with pytest.raises(NotDerivedError, match="for special dimensions alone"):
            analytic_solution(record, problem).held_against_loops()
    assert main(["derive", str(record.file), "--problem", "direct"]) == 5
    assert "close for special dimensions alone" in " ".join(capsys.readouterr().out.split())
