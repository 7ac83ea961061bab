"""The order in which sets are solved agrees with the Assur chains of the theory."""

import numpy as np
import pytest

import assur
from assur.kinematics.home import home_values
from assur.kinematics.loops.circles import system
from assur.kinematics.loops.hinges import NotCirclesError
from assur.kinematics.loops.orientations import turnings
from assur.kinematics.loops.solving import Solved, solve


def _solved(name: str, locked: dict[int, float] | None = None) -> Solved:
    mechanism = assur.load(name)
    if locked is None:
        locked = {index: float(home_values(mechanism)[index]) for index in mechanism.input_indices}
    (turning,) = turnings(mechanism, locked, None, parallel=tuple(mechanism.generalised))
    return solve(system(mechanism, turning, locked, {}))


@pytest.mark.parametrize(("name", "roots"), [("fivebar", (2,)), ("zeng2019", (2, 2, 2)), ("tripteron", (2, 2, 2))])
def test_where_the_plan_needs_no_search_every_set_is_one_loop(name: str, roots: tuple[int, ...]) -> None:
    assert assur.topology(name).plan.search == 0
    assert tuple(group.roots for group in _solved(name).sets) == roots


@pytest.mark.parametrize("name", ["planar_3rrr", "planar_3rpr"])
def test_where_the_plan_searches_in_one_dimension_two_loops_are_solved_together(name: str) -> None:
    assert assur.topology(name).plan.search == 1
    (only,) = _solved(name).sets
    assert (len(only.groups), only.roots) == (4, 6)


def test_the_plan_of_a_platform_on_three_circles_is_one_set() -> None:
    assert assur.topology("three_rps").plan.search == 2
    (only,) = _solved("three_rps").sets
    assert (len(only.groups), only.roots) == (4, 16)


def test_the_plan_of_a_limb_with_two_circles_is_one_set_of_64() -> None:
    assert assur.topology("three_rrrp4r").plan.search == 1
    (only,) = _solved("three_rrrp4r").sets
    assert (len(only.groups), only.roots) == (6, 64)


def test_every_item_is_solved_once() -> None:
    order = [number for group in _solved("zeng2019").sets for number in group.groups]
    assert sorted(order) == list(range(5))


def test_unknowns_are_real() -> None:
    unknowns = _solved("zeng2019").unknowns[:, 1:].reshape(-1, 5, 2)
    np.testing.assert_allclose(np.abs(unknowns), 1.0, atol=1e-12)
    np.testing.assert_array_equal(unknowns[..., 1], np.conj(unknowns[..., 0]))


def test_a_mechanism_whose_inputs_are_not_locked_is_refused() -> None:
    with pytest.raises(NotCirclesError, match="not determine"):
        _solved("fivebar", {})


def test_a_point_on_a_sphere_is_met_from_both_sides() -> None:
    unknowns = _solved("orthoglide").unknowns
    assert len(unknowns) == 2 * 2**3  # two platforms; each limb's circle may be turned by half a turn
    turns = np.angle(unknowns[:, [1, 3, 5]])
    assert len(np.unique(turns.round(6), axis=0)) == len(unknowns)
