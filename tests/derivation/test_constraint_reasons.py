"""Links that three directions hold stand in one of two ways; the one that is not derived is said."""

import json

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from assur.cli.main import main
from assur.derivation.constraint_reasons import ConstraintReason
from assur.derivation.document import document
from assur.derivation.printed_derivation import printed_derivation
from assur.derivation.reasons import left_out, sentences
from assur.derivation.solution import analytic_solution
from assur.joints.steps import UNTURNED
from assur.model.registry import load_record


@pytest.mark.parametrize("seed", range(3))
def test_the_other_way_is_the_other_solution_of_three_turns_that_close(seed):
    """Rot(u, a) Rot(w, c) = Rot(v, b), looked for among all c; half a turn on there is none."""
    u, v, w = Rotation.random(3, random_state=seed).as_matrix()[:, 0]
    reason = ConstraintReason("b", "a", tuple(u), tuple(w), (), (), UNTURNED, tuple(v))
    cosine, sine = map(float, reason.other_way)
    angle = np.arctan2(sine, cosine)
    assert abs(angle) > 1e-3

    def apart(turn):
        """How far the whole is from a turn about v, at the best turn about w."""
        others = Rotation.from_rotvec(np.linspace(-np.pi, np.pi, 20001)[:, None] * w)
        return np.min(np.linalg.norm((Rotation.from_rotvec(turn * u) * others).apply(v) - v, axis=1))

    assert apart(angle) < 1e-3
    assert apart(angle + np.pi) > 1e-2


def test_two_directions_leave_one_way():
    assert ConstraintReason("b", "a", (1, 0, 0), (0, 1, 0), (), (), UNTURNED).other_way is None


def test_bars_that_turn_against_each_other_about_three_directions_do_not_turn(capsys):
    record = load_record("h4_robot")
    solution = analytic_solution(record, "direct")
    assert (solution.branches, solution.eliminant.degree) == (8, 8)
    assert solution.closes()
    said = "bar2 is taken to stand against bar1 as at home; it may also stand turned by half a turn about z"
    assert [*left_out(solution.placed)] == [said]
    assert any("axes along y and x" in sentence for sentence in sentences(solution.placed))
    assert main(["derive", "h4_robot", "--problem", "direct"]) == 0
    assert f"left out: {said}" in " ".join(capsys.readouterr().out.split())
    assert main(["derive", "h4_robot", "--problem", "direct", "--json"]) == 0
    (answer,) = json.loads(capsys.readouterr().out)["problems"]
    assert answer["left_out"] == [said]
    printed = document(printed_derivation(record, {"direct": solution}, {}))
    assert "but for what is left out." in printed
    assert f"Left out: {said}." in printed
