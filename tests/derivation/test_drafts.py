"""Kinds that drafts have: rods oblique to their hinges, several sliders on a platform that turns."""

import itertools

import numpy as np
import pytest
import sympy

from assur.cli.main import main
from assur.derivation.solution import analytic_solution
from assur.derivation.symbols import circle_of
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.home import home_values
from assur.kinematics.position import direct
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated

OBLIQUE = {"tsai": "R[y] R[y] P(4R)[x] R[y]", "3-PRPaR": "P[z] R[y] P(4R)[x] R[y]"}
SLIDING = {"3-RRP": "R[z] R[z] P[x]", "3-PRP": "P[y] R[z] P[x]"}
APART = 1e-6


def draft(limb, folder):
    path = folder / "draft.toml"
    path.write_text(drafted(repeated(limb, 3), path).text, encoding="utf-8")
    return load_record(path)


def inputs_near_home(record):
    """Printed inputs (n,), each moved a little: lengths by 5, angles by 0.1 rad."""
    home = home_values(record)
    moved = np.linspace(-1.0, 1.0, len(record.inputs))
    return np.array([
        float(own.printed(home[own.coordinate.index])) + share * (5.0 if own.coordinate.kind == "length" else 0.1)
        for own, share in zip(record.inputs, moved, strict=True)
    ])  # fmt: skip


def derived_points(record, inputs):
    """The platform's point (N, 3) of each real branch of the direct problem."""
    solution = analytic_solution(record, "direct")
    given = {symbol: record.parameters[name].inside for name, symbol in solution.symbols.parameters.items()}
    for own, value in zip(record.inputs, inputs, strict=True):
        given |= (
            {sympy.Symbol(own.name, real=True): float(value)} if own.coordinate.kind == "length"
            else dict(zip(circle_of(own.name), (float(np.cos(value)), float(np.sin(value))), strict=True))
        )  # fmt: skip
    points = []
    for signs in itertools.product((1, -1), repeat=len(solution.roots)):
        turned = {root.symbol: sign for root, sign in zip(solution.roots, signs, strict=True)}
        values = dict(given)
        for own in solution.definitions:
            values[own.symbol] = turned.get(own.symbol, 1) * complex(sympy.N(own.formula, 20, subs=values))
        point = np.array([complex(sympy.N(part, 20, subs=values)) for part in solution.point])
        if np.max(np.abs(point.imag)) < 1e-9:
            points.append(point.real)
    return np.array(points)


@pytest.mark.parametrize("limb", [
    pytest.param(own, marks=() if name in ("tsai", "3-RRP") else pytest.mark.deep, id=name)
    for name, own in (OBLIQUE | SLIDING).items()
])  # fmt: skip
def test_a_draft_has_two_assemblies_which_a_search_finds(limb, tmp_path):
    record = draft(limb, tmp_path)
    solution = analytic_solution(record, "direct")
    assert solution.branches == 2
    assert solution.closes()
    inputs = inputs_near_home(record)
    points, met = derived_points(record, inputs), [own.pose for own in direct(record, inputs, method="search")]
    place = ["xyz".index(name) for name in record.platform.pose if name in "xyz"]
    assert len(met) == len(points)
    for pose in met:
        known = [float(value) for name, value in zip(record.platform.pose, pose, strict=True) if name in "xyz"]
        assert min(np.max(np.abs(own[place] - known)) for own in points) < APART


@pytest.mark.deep
@pytest.mark.parametrize("limb", OBLIQUE.values(), ids=[*OBLIQUE])
def test_rods_oblique_to_their_hinges_are_verified(limb, tmp_path, capsys):
    record = draft(limb, tmp_path)
    assert main(["derive", str(record.file), "--prove", "--json"]) == 0
    proof = tmp_path / "d.json"
    proof.write_text(capsys.readouterr().out)
    assert main(["verify", str(proof), "--mechanism", str(record.file)]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "direct: derivation verified: 2 branches" in said
    assert "inverse: derivation verified: 8 branches" in said


def test_a_draft_with_sliders_on_its_platform_has_a_closed_form_that_its_joint_graph_confirms(tmp_path):
    record = draft(SLIDING["3-RRP"], tmp_path)
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "mechanism.toml").write_text(record.file.read_text(encoding="utf-8"), encoding="utf-8")
    assert main(["derive", str(tmp_path / "own"), "-o", str(tmp_path / "own" / "closed_form.py")]) == 0
    assert problems(load_record(tmp_path / "own"), IN_FULL)[0] == ()


def test_the_inverse_problem_of_a_sliding_draft_is_proved(tmp_path, capsys):
    record = draft(SLIDING["3-RRP"], tmp_path)
    assert main(["derive", str(record.file), "--problem", "inverse", "--prove", "--json"]) == 0
    proof = tmp_path / "d.json"
    proof.write_text(capsys.readouterr().out)
    assert main(["verify", str(proof), "--mechanism", str(record.file)]) == 0
    assert "inverse: derivation verified: 8 branches" in " ".join(capsys.readouterr().out.split())
