"""Chains closed by their middle link: six turns have sixteen ways, and no start of Newton's method meets more."""

from dataclasses import replace

import numpy as np
import pytest

from assur.cli.main import main
from assur.kinematics.closure import closure_error
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.limbs.networks import limbs_of
from assur.kinematics.limbs.point_closure import MovingLimbError
from assur.kinematics.limbs.serial import (
    ElementaryMotion,
    NotSerialError,
    SerialLimb,
    composed,
    displacement,
    inverted,
)
from assur.kinematics.limbs.solving import limb_solutions
from assur.kinematics.platforms.chains import closed_series, held_series, loop_of
from assur.kinematics.platforms.direct import direct_by_conditions
from assur.kinematics.search import search
from assur.model.registry import load_record
from assur.numerics.rotations import from_vector


def chain(seed, kinds):
    """A limb whose axes lie by chance."""
    rng = np.random.default_rng(seed)
    motions = []
    for k, kind in enumerate(kinds):
        axis = rng.normal(size=3)
        motions.append(ElementaryMotion(kind, axis / np.linalg.norm(axis), rng.uniform(-1, 1, 3), k, 1))
    return SerialLimb(tuple(f"J{k}" for k in range(len(kinds))), tuple(motions), (np.eye(3), np.ones(3)))


def end(limb, values):
    frame = limb.zero
    for motion, value in zip(reversed(limb.motions), values[::-1], strict=True):
        frame = composed(displacement(motion, np.asarray(value)), frame)
    return frame


def newton(limb, frame, values):
    """Joint values by Newton's method with differences, or None."""

    def gap(values):
        rotation, place = composed(inverted(frame), end(limb, values))
        return np.concatenate([[rotation[2, 1], rotation[0, 2], rotation[1, 0]], place, [rotation.trace() - 3.0]])

    for _ in range(60):
        own = gap(values)
        slope = np.array([(gap(values + 1e-7 * row) - own) / 1e-7 for row in np.eye(len(values))]).T
        step = np.linalg.lstsq(slope, -own, rcond=1e-9)[0]
        values = values + step * min(1.0, 1.0 / np.linalg.norm(step))
        if np.linalg.norm(step) < 1e-13:
            break
    return values if np.linalg.norm(gap(values)) < 1e-9 else None


@pytest.mark.parametrize(
    "kinds",
    [
        ("turn",) * 6,
        pytest.param(("turn", "turn", "slide", "turn", "turn", "turn"), marks=pytest.mark.deep),
        ("turn",) * 5,
    ],
)
def test_all_ways_close_and_a_search_meets_no_other(kinds):
    limb = chain(3, kinds)
    rng = np.random.default_rng(8)
    frame = end(limb, rng.uniform(-np.pi, np.pi, len(kinds)))
    solutions = closed_series(limb, frame)
    assert len(solutions.values) >= 1
    assert solutions.roots == (16 if len(kinds) == 6 and "slide" not in kinds else solutions.roots)
    for values in solutions.values:
        rotation, place = end(limb, values)
        assert np.allclose(rotation, frame[0], rtol=0, atol=1e-8)
        assert np.allclose(place, frame[1], rtol=0, atol=1e-8)
    turns = np.array([kind == "turn" for kind in kinds])
    met = 0
    for start in rng.uniform(-np.pi, np.pi, (60, len(kinds))):
        values = newton(limb, frame, start)
        if values is not None:
            off = np.where(turns, np.sin(0.5 * (solutions.values - values)), solutions.values - values)
            assert np.min(np.max(np.abs(off), axis=1)) < 1e-6
            met += 1
    assert met > 0


def test_seven_turns_move():
    limb = chain(3, ("turn",) * 6)
    extra = SerialLimb(
        limb.joints, (*limb.motions, ElementaryMotion("turn", np.eye(3)[0], np.zeros(3), 6, 1)), limb.zero
    )
    with pytest.raises(NotSerialError, match="no point"):
        closed_series(extra, extra.zero)
    twice = SerialLimb(limb.joints, (*limb.motions[:5], limb.motions[4]), limb.zero)
    with pytest.raises(MovingLimbError):
        closed_series(twice, end(twice, np.full(6, 0.3)))


def test_a_held_joint_is_one_with_the_next():
    limb = limbs_of(load_record("planar_3rrr"))[0]
    values = np.array([0.3, -0.4, 0.9])
    held = held_series(limb, {limb.motions[0].index: 0.3})
    assert len(held.motions) == 2
    assert all(
        np.allclose(*parts, rtol=0, atol=1e-12) for parts in zip(end(held, values[1:]), end(limb, values), strict=True)
    )
    assert limb_solutions(held, end(limb, values)).values.round(9).tolist() == [[-0.4, 0.9]]


@pytest.mark.parametrize("at", [0.0, 6e-15])
def test_points_that_differ_by_rounding_are_in_one_place(at):
    """A leg all of whose points are on the base's origin, the platform's too: none of these is a length."""
    turns = [ElementaryMotion("turn", axis, np.full(3, at), k, 1) for k, axis in enumerate(np.eye(3)[:2])]
    slide = ElementaryMotion("slide", np.eye(3)[2], np.full(3, at), 2, 1)
    leg = SerialLimb(("U", "P"), (*turns, slide), (np.eye(3), np.zeros(3)), 300.0)
    for off in (0.0, 3e-13):
        assert np.allclose(
            closed_series(leg, (np.eye(3), np.full(3, off))).values, [[0, 0, off], [np.pi, np.pi, -off]][:1]
        )


def test_a_loop_closes_where_its_limbs_meet():
    first, second = chain(3, ("turn",) * 3), chain(4, ("turn",) * 2)
    values = np.array([0.3, -0.4, 0.9, 0.2, 0.5])
    rotation, place = composed(inverted(end(second, values[3:])), end(first, values[:3]))
    loop = end(loop_of(first, second), np.array([*values[:3], *values[:2:-1]]))
    back = composed(composed(end(second, values[3:]), (rotation, place)), inverted(end(second, values[3:])))
    assert np.allclose(loop[0], back[0], rtol=0, atol=1e-12)
    assert np.allclose(loop[1], back[1], rtol=0, atol=1e-12)


def with_screws(limb, places, advance=0.2):
    motions = [
        replace(motion, kind="screw", advance=advance) if k in places else motion
        for k, motion in enumerate(limb.motions)
    ]
    return replace(limb, motions=tuple(motions))


def test_the_shift_along_parallel_axes_tells_a_screw_among_them():
    """Beyond a turn too; what is left is an arm of two links, with two ways."""
    limb = chain(5, ("turn",) * 4)
    axis = limb.motions[0].axis
    parallel = replace(limb, motions=tuple(replace(motion, axis=axis) for motion in limb.motions))
    limb = with_screws(parallel, {1})
    values = np.array([0.4, 9.0, -0.7, 1.1])
    solutions = closed_series(limb, end(limb, values))
    assert len(solutions.values) == 2
    assert np.allclose(solutions.values[:, 1], 9.0, rtol=0, atol=1e-9)
    for row in solutions.values:
        for part, expected in zip(end(limb, row), end(limb, values), strict=True):
            assert np.allclose(part, expected, rtol=0, atol=1e-8)


def test_a_screw_slides_a_point_of_its_axis_and_turns_what_follows():
    """Two turns that cross, a screw, and a ball joint on its axis, far from what a search could be started at."""
    first = chain(6, ("turn", "turn", "screw", "ball"))
    ball = replace(first.motions[3], axis=np.eye(3), point=first.motions[2].point + 1.3 * first.motions[2].axis)
    limb = with_screws(replace(first, motions=(*first.motions[:3], ball)), {2})
    frame = end(replace(limb, motions=limb.motions[:3]), np.array([0.3, -0.8, 14.0]))
    solutions = closed_series(limb, frame)
    assert np.min(np.max(np.abs(solutions.values - [0.3, -0.8, 14.0, 0, 0, 0]), axis=1)) < 1e-8
    for row in solutions.values:
        placed = end(replace(limb, motions=limb.motions[:3], zero=(np.eye(3), np.zeros(3))), row[:3])
        turned = from_vector(row[3:])
        whole = composed(placed, composed((turned, ball.point - turned @ ball.point), limb.zero))
        assert np.allclose(whole[1], frame[1], rtol=0, atol=1e-8)
        assert np.allclose(whole[0], frame[0], rtol=0, atol=1e-8)


def test_a_screw_that_moves_a_point_beside_its_axis_is_not_solved_so():
    limb = with_screws(chain(3, ("turn",) * 6), {2})
    with pytest.raises(NotSerialError, match="beside its axis"):
        limb_solutions(replace(limb, motions=limb.motions[:4]), limb.zero)


SEVEN_TURNS = "{R[z] R[x] R[0,0.6,0.8] | R[0.6,0,0.8] R[0,1,0] R[0.28,0.96,0] R[0.8,0.6,0]}"


def test_a_draft_of_seven_turns_has_all_that_a_search_meets(tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "--chain", SEVEN_TURNS]) == 0
    record = load_record(path)
    driven = record.inputs[0]
    inputs = np.array([driven.printed(home_values(record)[driven.coordinate.index]) + 0.2])
    solutions = direct_by_conditions(record, inputs)
    assert solutions.complete
    assert solutions.right.startswith("its one loop by the middle link: 16 complex assemblies")
    assert np.max(closure_error(record, solutions.joints)) < 1e-9
    met = search(record, "direct", inputs).joints
    assert len(met) > 0
    assert len(distinct(record, np.concatenate([solutions.joints, met]))) == len(solutions.joints)
