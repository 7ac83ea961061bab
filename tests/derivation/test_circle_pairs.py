"""Three circles that carry the balls of a platform: one polynomial, its components, its real poses."""

import json
import math
import runpy
from types import SimpleNamespace

import numpy as np
import pytest
import sympy

from assur.cli.main import main
from assur.derivation.document import document
from assur.derivation.numeric_example import example_branches
from assur.derivation.platform_rotation import platform_rotation
from assur.derivation.printed_derivation import printed_derivation
from assur.derivation.solution import analytic_solution
from assur.derivation.solution_count import solution_count
from assur.kinematics.position import direct
from assur.model.registry import load_record
from assur.numerics.rotations import to_angles
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.verifier.derivations.check import verify_derivation
from assur.verifier.reading import RefusedError

ALL_REAL = (380.0, 390.0, 400.0)
"""Inputs of the 3-RPS at which all sixteen poses are real."""


@pytest.fixture(scope="module")
def three_rps():
    return analytic_solution(load_record("three_rps"), "direct")


def draft(limb, folder):
    path = folder / "draft.toml"
    path.write_text(drafted(repeated(limb, 3), path).text, encoding="utf-8")
    return load_record(path)


def poses(solution, inputs):
    """Z, theta and psi of the real branches: all formulas in floats."""
    record, home = solution.symbols.record, solution.symbols.witness.home
    given = {symbol: home[symbol] for symbol in solution.symbols.parameters.values()}
    given |= {sympy.Symbol(own.name, real=True): value for own, value in zip(record.inputs, inputs, strict=True)}
    entries = [entry for row in platform_rotation(solution) for entry in row]
    names = sorted({one for part in (*entries, *solution.point) for one in part.free_symbols}, key=str)
    formulas = sympy.lambdify(names, [*entries, *solution.point])
    real = []
    for branch in example_branches(solution, given, ()):
        *turned, _, _, z = formulas(*(branch.values[name] for name in names))
        _, theta, psi = to_angles(np.reshape(turned, (3, 3)))
        real.append((z, math.degrees(theta), math.degrees(psi)))
    return np.array(sorted(real))


def test_three_rps_has_the_sixteen_poses_of_its_two_quartics(three_rps):
    derived = poses(three_rps, ALL_REAL)
    branches = direct(load_record("three_rps"), ALL_REAL)
    hand_written = [(z, math.degrees(theta), math.degrees(psi)) for z, theta, psi in branches.poses[~branches.dropped]]
    assert len(derived) == len(hand_written) == three_rps.branches
    assert derived == pytest.approx(np.array(sorted(hand_written)), abs=1e-4)


def test_every_branch_closes_every_loop(three_rps):
    assert (three_rps.branches, three_rps.closes()) == (16, True)


def test_its_components_are_two_quartics_each_root_with_a_mirror_image(three_rps):
    own = three_rps.components
    assert [(part.degree, part.irreducible, part.no_tower) for part in own.parts] == [(4, True, True)] * 2
    assert (own.solutions, own.count, own.total) == (2, 16, "(4 + 4) x 2")


def test_the_degree_of_both_quartics_and_their_mirror_images_is_never_told_as_one(three_rps):
    printed = document(printed_derivation(load_record("three_rps"), {"direct": three_rps}, {}))
    assert "its square alone" in printed
    for text in (printed, three_rps.components.sentence):
        assert "degree 16" not in text
        assert "polynomials of degree 4" in text


def test_at_every_pose_one_of_the_written_quartics_vanishes(three_rps):
    """In the order of their coefficients, as the code of the derived form has them."""
    record, own = load_record("three_rps"), three_rps.components
    values = {symbol: float(three_rps.symbols.witness.home[symbol]) for symbol in three_rps.symbols.parameters.values()}
    values |= {
        sympy.Symbol(driven.name, real=True): value for driven, value in zip(record.inputs, ALL_REAL, strict=True)
    }
    branches = direct(record, ALL_REAL)
    turned = branches.joints[~branches.dropped][:, record.joint_coordinates("leg2.A")[0].index]
    vanishing = []
    for polynomial in own.polynomials:
        terms = [float(part.subs(values)) * (-np.sin(turned)) ** power for power, part in enumerate(polynomial)]
        vanishing.append(np.abs(np.sum(terms, axis=0)) < 1e-9 * np.sum(np.abs(terms), axis=0))
    assert own.unknown == sympy.Symbol("sin_leg2_cylinder", real=True)
    assert [len(polynomial) for polynomial in own.polynomials] == [5, 5]
    assert np.sum(vanishing, axis=1).tolist() == [8, 8]
    assert np.all(np.sum(vanishing, axis=0) == 1)


def test_the_components_are_the_hand_written_quartics(three_rps, monkeypatch):
    """These are in P, e = o r (1 - P) and e = R - rho sin for the leg of the angle: eight roots by two routes."""
    own = three_rps.eliminant
    leg = int(own.direction.name.removeprefix("leg").removesuffix("_cylinder"))
    kernels = runpy.run_path(str(load_record("three_rps").file.parent / "closed_form.py"))
    coefficients, dimensions = kernels["coefficients"], SimpleNamespace(R=200.0, r=120.0)
    monkeypatch.setitem(coefficients.__globals__, "AWRY", tuple(float(k == leg) for k in (1, 2, 3)))
    lengths = np.array([380.0, 391.0, 405.0])
    sines = [
        (dimensions.R - o * dimensions.r * (1.0 - np.roots(quartic[::-1]))) / lengths[leg - 1]
        for o in (1, -1)
        for quartic in [np.array(coefficients(np, dimensions, lengths, SimpleNamespace(o=o)), dtype=float)]
    ]
    places = np.cos(np.pi * (np.arange(9) + 0.5) / 9)
    values = np.array([left_over(three_rps, lengths, sine) for sine in places])
    roots = np.polynomial.chebyshev.chebroots(np.polynomial.chebyshev.chebfit(places, values / np.max(values), 8))
    assert np.sort_complex(roots) == pytest.approx(np.sort_complex(np.concatenate(sines)), abs=1e-6)


def left_over(solution, inputs, sine):
    """The eliminant at a sine, with either cosine."""
    own, home = solution.eliminant, solution.symbols.witness.home
    values = {symbol: home[symbol] for symbol in solution.symbols.parameters.values()}
    values |= dict(zip(solution.symbols.given, inputs, strict=True))
    values |= dict(zip(own.direction.unknowns, (math.sqrt(1.0 - sine**2), sine), strict=True))
    for step in (*own.known, *own.entries, *own.steps):
        names = sorted(step.formula.free_symbols, key=str)
        values[step.symbol] = sympy.lambdify(names, step.formula)(*(values[name] for name in names))
    return values[own.steps[-1].symbol]


@pytest.mark.deep
def test_as_many_solutions_are_counted_without_the_elimination():
    assert solution_count(load_record("three_rps"), "direct").solutions == 16


@pytest.mark.deep
@pytest.mark.parametrize(("limb", "degrees"), [("P[z] R[y] S", [8, 8]), ("P[x] R[y] S", None), ("R[y] R[y] S", None)])
def test_platforms_on_three_circles_are_derived_whatever_carries_these(limb, degrees, tmp_path):
    solution = analytic_solution(draft(limb, tmp_path), "direct")
    assert (solution.branches, solution.closes()) == (16, True)
    assert (solution.components and [part.degree for part in solution.components.parts]) == degrees


@pytest.mark.deep
def test_the_proof_is_verified_and_a_changed_one_refused(capsys):
    assert main(["derive", "three_rps", "--problem", "direct", "--prove", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    text = load_record("three_rps").file.read_text(encoding="utf-8")
    (proved,) = verify_derivation(json.dumps(document).encode(), text)
    assert (proved.branches, proved.closed, proved.conditions) == (16, 16, ("v != 0", "det != 0"))
    (problem,) = document["problems"]
    assert problem["components"]["degrees"] == [4, 4]
    problem["results"]["R33"] = f"-({problem['results']['R33']})"
    with pytest.raises(RefusedError, match="R33"):
        verify_derivation(json.dumps(document).encode(), text)


@pytest.mark.deep
def test_a_point_beside_the_plane_of_the_balls_is_found_too(tmp_path):
    text = load_record("three_rps").file.read_text(encoding="utf-8")
    path = tmp_path / "mechanism.toml"
    path.write_text(text.replace('link = "platform" ', 'link = "platform"\npoint = [0, 0, 40] ', 1), encoding="utf-8")
    middle, beside = (poses(analytic_solution(load_record(own), "direct"), ALL_REAL) for own in ("three_rps", path))
    across = 40.0 * np.prod(np.cos(np.radians(middle[:, 1:])), axis=1)
    assert np.sort(middle[:, 0] + across) == pytest.approx(beside[:, 0], abs=1e-4)


@pytest.mark.deep
def test_balls_on_lines_are_named_and_counted(tmp_path, capsys):
    draft("R[y] P[z] S", tmp_path)
    assert main(["derive", str(tmp_path / "draft.toml"), "--problem", "direct", "--json"]) == 5
    (problem,) = json.loads(capsys.readouterr().out)["problems"]
    assert (problem["status"], problem["count"]["solutions"]) == ("not_derived", 8)
    assert problem["sides"]["platform_12"] == ["leg1.C", "leg2.C"]
