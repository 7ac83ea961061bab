"""Derived polynomials serve like hand-written ones, also of drafts that nobody has solved by hand."""

import itertools
import shutil
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

from assur.derivation import eliminants
from assur.derivation.derivation import derive
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import analytic_solution
from assur.derivation.witness import NoResidueRootError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.exact import exactness
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.pose import ANGLES, LENGTHS
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chains
from catalogue import each

DRAFTS = {
    "rrr": repeated("R[z] R[z] R[z]", 3),
    "mixed": parse_chains(["R[z] R[z] R[z]", "R[z] P[x] R[z]", "P[x] R[z] R[z]"]),
    "prc": repeated("P[z] R[y] C[y]", 3),
    "oblique": parse_chains(
        ["R[y] R[y] C[y]", "R[0.6,0.8,0] R[0.6,0.8,0] C[0.6,0.8,0]", "R[0,0.6,0.8] R[0,0.6,0.8] C[0,0.6,0.8]"]
    ),
}


def with_derived_form(record, folder):
    shutil.copy(record.file, folder / "mechanism.toml")
    (folder / "closed_form.py").write_text(derive(record).closed_form())
    return load_record(folder)


def poses_near_home(record, number):
    length, home = characteristic_length(record), pose_of(record, home_values(record))
    scales = np.array([0.1 * length if name in LENGTHS else 0.1 for name in record.platform.pose])
    return home + scales * np.random.default_rng(4).uniform(-1.0, 1.0, (number, len(home)))


def apart(record, first, second):
    """How far poses are apart, in characteristic lengths and rad: each of the first from the nearest of the second."""
    gaps = np.abs(np.array(first)[:, None] - np.array(second)[None])
    for k, name in enumerate(record.platform.pose):
        gaps[:, :, k] = (
            np.abs((gaps[:, :, k] + np.pi) % (2 * np.pi) - np.pi)
            if name in ANGLES
            else gaps[:, :, k] / characteristic_length(record)
        )
    return float(np.max(np.min(np.max(gaps, axis=-1), axis=1)))


@pytest.fixture(scope="module", params=each(DRAFTS, ["mixed"]))
def draft(request, tmp_path_factory):
    """A draft, and the same with its derived form."""
    folder = tmp_path_factory.mktemp(request.param)
    path = folder / f"{request.param}.toml"
    path.write_text(drafted(DRAFTS[request.param], path).text, encoding="utf-8")
    record = load_record(path)
    return record, with_derived_form(record, tmp_path_factory.mktemp("derived"))


def test_a_draft_agrees_with_its_joint_graph_exactly(draft):
    assert problems(draft[1], IN_FULL)[0] == ()
    assert exactness(draft[1]).proved


def test_a_draft_has_the_assemblies_that_a_search_finds(draft):
    plain, derived = draft
    for pose in poses_near_home(plain, 3):
        inputs = next(iter(inverse(plain, pose))).inputs
        searched = [own.pose for own in direct(plain, inputs, method="search")]
        solved = [own.pose for own in direct(derived, inputs, method="closed form")]
        assert len(searched) == len(solved)
        assert apart(plain, searched, solved) < 1e-8


def test_legs_of_either_sign_are_more_than_the_hand_written_form_has(tmp_path):
    written = load_record("planar_3rpr")
    derived = with_derived_form(written, tmp_path)
    assert problems(derived, IN_FULL)[0] == ()
    assert exactness(derived).proved
    length = characteristic_length(written)
    for pose in poses_near_home(written, 8):
        (own,) = inverse(written, pose, method="closed form")
        others = {other.mode: other.inputs for other in inverse(derived, pose, method="closed form")}
        assert len(others) == 8
        assert np.allclose(own.inputs, others["+++"], rtol=0, atol=1e-9 * length)
        back = [[other.pose for other in direct(form, own.inputs, method="closed form")] for form in (written, derived)]
        assert len(back[0]) == len(back[1])
        assert apart(written, *back) < 1e-9


@pytest.mark.deep
def test_poses_of_one_angle_are_both_found(tmp_path):
    """Where the circles of a 3-RPR's platform point have their centres on a line, two poses share the unknown, phi."""
    written = load_record("planar_3rpr")
    derived, p, rng = with_derived_form(written, tmp_path), written.values, np.random.default_rng(2)

    def centres(phi):
        turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
        return np.array([[0.0, 0.0], [p.a2, 0.0], [p.a3, p.h3]]) - np.array([[0, 0], [p.d1, 0], [p.c3, p.e3]]) @ turn.T

    def area(phi):
        return float(np.linalg.det(centres(phi)[1:]))

    angles = np.linspace(-3.1, 3.1, 60)
    lines = [brentq(area, low, high, xtol=1e-15) for low, high in pairwise(angles) if area(low) * area(high) < 0]
    assert lines
    for phi in lines:
        own = centres(phi)
        along = own[1] / np.linalg.norm(own[1])
        for place in rng.uniform(-20.0, 20.0, (10, 2)):
            for change in (0.0, 1e-12, 1e-9, 1e-7):
                answer = direct(derived, np.linalg.norm(place - own, axis=1) * (1 + change * rng.normal(size=3)))
                assert answer.complete
                pair = [[*place, phi], [*(2 * (place @ along) * along - place), phi]]
                assert apart(written, pair, [other.pose for other in answer]) < 1e-4


def test_coefficients_that_are_no_residues_at_one_draw_are_drawn_again(monkeypatch):
    """As of a Par4, whose rods have roots of their own: two draws fail here, then all of them."""
    record, polynomial = load_record("planar_3rpr"), eliminants.polynomial
    plain, failing = analytic_solution(record, "direct"), iter([True, True])

    def drawn(eliminant, witness):
        if next(failing, False):
            raise NoResidueRootError("no residue")
        return polynomial(eliminant, witness)

    monkeypatch.setattr(eliminants, "polynomial", drawn)
    again = analytic_solution.__wrapped__(record, "direct")
    assert again.eliminant.degree == plain.eliminant.degree == 6
    assert next(failing, None) is None
    failing = itertools.repeat(True)  # from here on no draw is one
    with pytest.raises(NotDerivedError, match="no draw makes residues"):
        analytic_solution.__wrapped__(record, "direct")
