"""Statuses, merged branches, failures and curves of solution sets, on the paper's mechanism."""

import dataclasses
import json
from types import SimpleNamespace

import numpy as np
import pytest

import assur
from assur.kinematics.answers.answer import answer
from assur.kinematics.status import MARGIN_TOLERANCE, NEAR_SINGULAR, Status
from assur.numerics.number_types import Floats
from assur.results.json_text import json_text

TABLE_1 = [162.6907, -143.3209, -24.6776]
ROW_3 = [-15.4714, 9.6849, 456.3315]


@pytest.fixture(scope="module")
def paper():
    return assur.load("zeng2019")


def test_four_poses_two_modes_of_the_height_each(paper):
    found = paper.direct(TABLE_1)
    assert [solution.mode for solution in found] == ["+++", "++-", "--+", "---"]
    assert found.complete
    assert found.complete_for == "reduced"


def test_eight_real_direct_solutions_occur_and_never_more(paper):
    inputs = np.random.default_rng(0).uniform(-300, 300, size=(20000, 3))
    counts = np.unique(paper.direct(inputs).exists.sum(axis=1))
    assert set(counts) == {0, 4, 8}


@pytest.mark.parametrize(("l7", "l8", "count"), [(60.0, 25.0, 6), (300.0, 100.0, 2)])
def test_two_and_six_occur_where_the_connecting_links_have_length(paper, l7, l8, count):
    longer = paper.with_parameters(l7=l7, l8=l8)
    inputs = np.random.default_rng(0).uniform(-300, 300, size=(20000, 3))
    counts = set(np.unique(longer.direct(inputs).exists.sum(axis=1)).tolist())
    assert count in counts
    assert counts <= {0, 2, 4, 6, 8}


def test_thirty_two_inverses_are_eight_real_ones_at_row_3(paper):
    found = paper.inverse(ROW_3)
    assert found.exists.shape == (32,)
    assert len(found) == 8


def test_a_merged_branch_is_listed_once_with_a_zero(paper):
    """B = 2 l2: links 9, 11 and 10 are stretched along Y, so e1 is 0."""
    found = paper.direct([140.0 + 560.0, 0.0, 300.0])
    assert [solution.mode for solution in found] == ["0++", "0+-", "0-+", "0--"]
    assert len(found) == 4
    assert {solution.working_mode[2:4] for solution in found} == {"-+"}
    assert all(solution.status == Status.parallel for solution in found)
    assert np.all(found.residuals[found.exists] < 1e-5)


def test_a_hair_beyond_the_merge_is_unreachable_and_says_by_how_much(paper):
    found = paper.direct([140.0 + 560.0 + 1e-6, 0.0, 300.0])
    assert found.overall_status == Status.unreachable
    (failure,) = found.failures
    assert failure.quantity == "w2"
    assert failure.value == pytest.approx(-280.0 * 1e-6, rel=1e-3)
    assert failure.branches == 8


def test_unreachable_names_the_quantity_that_comes_first(paper):
    found = paper.inverse([500.0, 0.0, 300.0])
    assert found.overall_status == Status.unreachable
    assert [failure.quantity for failure in found.failures] == ["n_alpha"]
    assert found.failures[0].value == pytest.approx(1 - (600.0 / 180.0) ** 2)


def test_self_motion_is_a_curve_and_never_a_sample(paper):
    found = paper.direct([100.0, -40.0, 20.0])  # B = 0
    assert found.overall_status == Status.self_motion
    assert len(found) == 0
    assert np.all(np.isnan(found.poses))
    assert {curve.parameter for curve in found.curves} == {"gamma"}
    data = answer(found)
    assert data.status == "self_motion"
    assert data.solutions == ()
    assert data.complete is True
    assert len(data.curves) == len(found.curves) > 0
    for curve in found.curves:
        y = curve.poses(33)[:, 1]
        gamma = np.linspace(*curve.interval, 33)
        np.testing.assert_allclose(y, 100.0 + 280.0 * np.cos(gamma) - 70.0, atol=1e-9)


@pytest.mark.parametrize("offset", [0.0, 1e-12, 1e-9, 1e-6, 5e-5])
def test_a_hair_beside_b_zero_is_still_the_curve(paper, offset):
    """The direct problem calls it self-motion exactly where the factor u1 - u2 of a solution would."""
    found = paper.direct([100.0 + offset, -40.0, 20.0])
    assert (found.overall_status, len(found)) == (Status.self_motion, 0)
    assert found.curves


def test_beside_the_tolerance_of_b_there_are_solutions_again(paper):
    found = paper.direct([100.0 + 2e-4, -40.0, 20.0])
    assert len(found) == 4
    assert all(solution.status != Status.self_motion for solution in found)


def test_an_arc_of_self_motion_may_end_at_the_half_turn():
    """Tangent circles at gamma = 180 deg: the sine of pi and of -pi round differently."""
    narrow = assur.load("zeng2019", b=50.0, d=50.0, l6=250.0)
    found = narrow.direct([0.0, -140.0, -590.0])
    assert found.overall_status in (Status.self_motion, Status.unreachable)
    for curve in found.curves:
        assert np.all(np.isfinite(curve.poses(9)))


def test_a_batch_in_self_motion_agrees_with_single_problems(paper):
    inputs = np.array([[100.0, -40.0, 20.0], [100.0, -40.0, 2000.0], [162.6907, -143.3209, -24.6776]])
    together = paper.direct(inputs).overall_status
    assert together.tolist() == [int(paper.direct(row).overall_status) for row in inputs]
    assert together.tolist() == [Status.self_motion, Status.unreachable, Status.regular]


def test_circles_that_coincide_are_undecided_and_not_complete():
    """b = d and l4 = l6: where t = 0 the circles of D2 and of E3 are one, and the formulas divide by zero."""
    narrow = assur.load("zeng2019", b=50.0, d=50.0, l4=230.0, l2=230.0)
    found = narrow.direct([240.0, 0.0, 70.0])
    assert found.overall_status == Status.undecided
    assert not found.complete


def test_the_residual_sees_an_answer_to_another_question(paper):
    """A kernel that solves for other inputs closes its own loops, and the residual says that it is wrong."""
    form = paper.closed_form

    def slipped(ns, p, inputs, sign):
        return form.direct(ns, p, (inputs[0] + 0.5, *inputs[1:]), sign)

    wrong = dataclasses.replace(paper, closed_form=dataclasses.replace(form, direct=slipped))
    found = wrong.direct(TABLE_1)
    np.testing.assert_allclose(found.residuals[found.exists], 0.5, rtol=1e-6)


def test_the_overall_status_is_the_most_severe_of_those_listed(paper):
    found = paper.inverse(ROW_3)
    assert {solution.status for solution in found} == {Status.regular, Status.self_motion}
    assert found.overall_status == Status.self_motion


def test_a_failure_names_the_branch_that_comes_nearest(paper):
    """v is one of two heights, t one of four: the largest margin over the branches that fail is told."""
    found = paper.direct([162.6907, -143.3209, -420.0])
    for failure in found.failures:
        margin = found.margins[failure.quantity]
        assert failure.value == np.max(margin[margin < 0])


def test_self_motion_arcs_end_where_a_margin_does(paper):
    for curve in paper.direct([100.0, -40.0, 20.0]).curves:
        inside = paper.inverse(curve.poses(201)[1:-1])
        assert np.all(inside.exists.any(axis=1))
        if np.ptp(curve.interval) < 2 * np.pi - 1e-9:
            beyond = np.array([curve.interval[0] - 1e-3, curve.interval[1] + 1e-3])
            branch = paper.closed_form.self_motion.kernel(
                Floats(),
                paper.values,
                tuple(np.full(2, value) for value in (100.0, -40.0, 20.0)),
                (np.cos(beyond), np.sin(beyond)),
                SimpleNamespace(e2=1.0 if curve.mode[0] == "+" else -1.0, e3=1.0),
            )
            assert np.all(np.minimum(branch.margins["v2"], branch.margins["meeting"]) < 0)


def test_self_motion_out_of_reach_is_unreachable_by_the_nearest_miss(paper):
    found = paper.direct([100.0, -40.0, 2000.0])
    assert found.overall_status == Status.unreachable
    (failure,) = found.failures
    assert failure.quantity == "v2"
    # the nearest point of the circle of C1 is 280 along Y towards slider 3
    assert failure.value == pytest.approx(230.0**2 - (2000.0 - (100.0 + 280.0 - 70.0)) ** 2, rel=1e-5)


def test_near_singular_is_labelled_between_the_two_tolerances(paper):
    offset = 280.0 * NEAR_SINGULAR
    for share, expected in ((0.5, Status.near_singular), (2.0, Status.regular)):
        u1 = offset * share
        height = np.sqrt(280.0**2 - u1**2) + 30.0
        pose = [-40.0, 0.0, height + 180.0 * np.sqrt(1 - (60.0 / 180.0) ** 2)]
        found = paper.inverse(pose, "++-++")
        if found.exists[0]:
            assert found.status[0] == expected


def test_quantities_of_the_paper_can_be_asked_for_by_name(paper):
    found = paper.inverse(ROW_3, "++-++")
    assert np.degrees(found.quantities("alpha")[0]) == pytest.approx(61.99, abs=0.01)
    assert np.degrees(found.quantities("beta")[0]) == pytest.approx(120.14, abs=0.01)
    t = found.quantities("t")[0]
    j = [found.quantities(name)[0] for name in ("J1", "J2", "J3")]
    alpha = found.quantities("alpha")[0]
    assert j[0] == pytest.approx(2 * 180.0 * t)
    assert j[0] * np.sin(alpha) + j[1] * np.cos(alpha) + j[2] == pytest.approx(0.0, abs=1e-6)  # Eq. (17)
    with pytest.raises(assur.UnknownNameError, match="unknown quantity of zeng2019 'delta'"):
        found.quantities("delta")


def test_one_mode_alone_is_not_called_complete(paper):
    assert not paper.inverse(ROW_3, "++-++").complete
    assert paper.inverse(ROW_3).complete


def test_json_reads_back_to_the_same_numbers(paper):
    for found in (paper.direct(TABLE_1), paper.inverse(ROW_3), paper.direct([100.0, -40.0, 20.0])):
        data = json.loads(json_text(answer(found)))
        numbers = [solution["pose" if found.problem == "direct" else "inputs"] for solution in data["solutions"]]
        arrays = found.poses if found.problem == "direct" else found.inputs
        np.testing.assert_array_equal(np.array(numbers).reshape(-1, 3), arrays[found.exists])


def test_nonzero_connecting_links_close(paper):
    longer = paper.with_parameters(l7=12.0, l8=7.0)
    found = longer.direct(TABLE_1)
    assert len(found) > 0
    assert np.max(found.residuals[found.exists]) < 1e-9


def test_a_batch_cannot_be_iterated(paper):
    with pytest.raises(assur.UsageError, match=r"batch of shape \(2,\)"):
        list(paper.direct([TABLE_1, TABLE_1]))


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ([1.0, 2.0], "2 values, 3 wanted"),
        (5.0, "a single number, 3 wanted"),
        ([1.0, 2.0, np.nan], "must be finite"),
        ([1.0, 2.0, np.inf], "must be finite"),
        ([1.0, 2.0, 1e200], "larger than 1e"),
        (["1,5", "2", "3"], "not an array of numbers"),
        (["1", "2", "3"], "not an array of numbers"),
        ([True, False, True], "not an array of numbers"),
        ([1j, 2.0, 3.0], "not an array of numbers"),
        (np.ma.array([1.0, 2.0, 3.0], mask=[1, 0, 0]), "not an array of numbers"),
        ([[1.0, 2.0], [3.0]], "not an array of numbers"),
    ],
)
def test_bad_inputs_are_refused(paper, inputs, message):
    with pytest.raises(assur.UsageError, match=message):
        paper.direct(inputs)


def test_an_unknown_mode_is_refused_with_the_signs_it_needs(paper):
    with pytest.raises(assur.UnknownNameError, match=r"one sign \+ or - for each of: s_alpha, s_beta, u1, u2, u3"):
        paper.inverse(ROW_3, "+++")


def test_margin_tolerance_is_far_above_rounding():
    assert 100 * np.finfo(float).eps < MARGIN_TOLERANCE < 1e-10
