"""Laws of the position problem: a closed form is a claim about the joint graph, and these check it."""

import numpy as np
import pytest

from assur import load, names
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import quantity
from assur.kinematics import border
from assur.kinematics.closure import closure_error
from assur.kinematics.modes import mode_text, without_letter
from assur.kinematics.naming import signs_at
from assur.kinematics.pose import pose_of
from assur.kinematics.search import search
from assur.kinematics.status import NEAR_SINGULAR, Status, closed_form_of, relative_factors
from assur.model.closed_form import Eliminant
from assur.model.file.place import table_place

SHAPES = [(), (1,), (3, 1, 2), (0,)]
SEARCHED = 4
"""So many direct problems are asked of a mechanism that answers by a search."""
TRACED = 12
"""So many, three times, of one that answers by tracing the paths of a homotopy, or by the roots of a polynomial."""
ANSWERS = {}
"""Of this process, by the mechanism's folder: a derived form has the name of the written one."""


def direct(mechanism, inputs):
    """The direct problem at some of the inputs (N, n): all of them where there is a closed form."""
    return mechanism.direct(inputs if closed_form_of(mechanism).direct else inputs[:SEARCHED])


def mode_at(mechanism, problem, joints):
    """The mode by the signs of the file's quantities; where the file has none, by those of closing blocks."""
    named = mechanism.modes.assembly if problem == "direct" else mechanism.modes.working
    if None in named.values():
        return mode_text(signs_at(mechanism, problem, joints))
    return mode_text([np.sign(quantity(mechanism, formula, joints)) for formula in named.values()])


@pytest.fixture
def answer(mechanism, regular):
    """The direct problem at the inputs of all regular solutions, solved once for all that is asked of it."""
    if mechanism.file not in ANSWERS:
        ANSWERS[mechanism.file] = direct(mechanism, np.array([inputs for _, _, inputs, _ in regular]))
    return ANSWERS[mechanism.file]


def test_home_closes_and_is_in_the_default_modes(mechanism):
    length = characteristic_length(mechanism)
    assert closure_error(mechanism, mechanism.home_values) < 1e-11 * length
    assert mode_at(mechanism, "inverse", mechanism.home_values) == mechanism.modes.default_working
    assert mode_at(mechanism, "direct", mechanism.home_values) == mechanism.modes.default_assembly


@pytest.mark.parametrize("name", [name for name in names() if table_place(load(name), "home") != ("home",)])
def test_home_of_alike_limbs_is_as_symmetric_as_they_are(name):
    """A template's home is the same for every limb, and closing it leaves it so: its digits are enough of them."""
    mechanism = load(name)
    driven = border.inputs_of(mechanism, mechanism.home_values)
    assert np.ptp(driven) < 1e-9 * characteristic_length(mechanism)


@pytest.mark.parametrize("name", ["linear_delta_4s", "three_p2us", "delta_4s", "three_crr", "planar_3rrr"])
def test_a_platform_in_the_middle_is_in_the_middle(name):
    mechanism = load(name)
    pose = pose_of(mechanism, mechanism.home_values)
    names = mechanism.platform.pose
    away = [value for axis, value in zip(names, pose, strict=True) if axis != "z"]
    assert np.max(np.abs(away)) < 1e-9 * characteristic_length(mechanism)


def test_every_inverse_solution_closes_the_whole_joint_graph(mechanism, poses):
    found = mechanism.inverse(poses)
    assert np.any(found.exists)
    assert np.max(found.residuals[found.exists]) < 1e-11 * characteristic_length(mechanism)


def test_every_direct_solution_closes_the_whole_joint_graph(mechanism, answer):
    assert np.any(answer.exists)
    assert np.max(answer.residuals[answer.exists]) < 1e-10 * characteristic_length(mechanism)


def test_joint_values_carry_the_pose_and_the_inputs(mechanism, regular, apart):
    for pose, _, inputs, joints in regular[:40]:
        assert apart(pose_of(mechanism, joints), pose) < 1e-11 * characteristic_length(mechanism)
        gaps = _turned(mechanism, border.inputs_of(mechanism, joints) - inputs)
        assert np.abs(gaps) == pytest.approx(0.0, abs=1e-9)


def test_declared_constant_orientation_is_constant(mechanism, regular):
    turned = [frames(mechanism, joints)[mechanism.platform.link][0] for _, _, _, joints in regular]
    spread = np.max(np.abs(np.array(turned) - np.eye(3)))
    assert (spread < 1e-12) == (mechanism.platform.orientation == "constant")


def test_modes_are_the_signs_of_the_named_quantities(mechanism, regular):
    for _, mode, _, joints in regular:
        assert mode_at(mechanism, "inverse", joints) == mode


def test_assembly_modes_are_the_signs_of_the_named_quantities(mechanism, answer):
    for row, branch in zip(*np.nonzero(answer.exists & (answer.status == Status.regular)), strict=True):
        joints = answer.joints[row, branch]
        mode = mode_at(mechanism, "direct", joints)
        assert mode in ("", without_letter(str(answer.labels[row, branch])))


def test_modes_tell_the_solutions_of_one_problem_apart(mechanism, regular):
    found = direct(mechanism, np.array([inputs for _, _, inputs, _ in regular[:10]]))
    for exists, labels in zip(found.exists, found.labels, strict=True):
        assert len(set(labels[exists])) == np.sum(exists)


def test_direct_of_inverse_returns_the_pose(mechanism, regular, answer, apart):
    for row, (pose, _, _, _) in enumerate(regular[: len(answer.exists)]):
        gaps = apart(answer.poses[row][answer.exists[row]], pose)
        assert np.min(gaps) < 1e-7 * characteristic_length(mechanism)


def test_inverse_of_direct_returns_the_inputs(mechanism, regular, answer):
    inputs = np.array([inputs for _, _, inputs, _ in regular])
    good = answer.exists & (answer.status == Status.regular)
    back = mechanism.inverse(answer.poses[good])
    wanted = np.broadcast_to(inputs[: len(good), None, :], answer.inputs.shape)[good]
    gaps = np.abs(_turned(mechanism, back.inputs - wanted[:, None, :])).max(axis=-1)
    assert np.max(np.min(np.where(back.exists, gaps, np.inf), axis=-1)) < 1e-6 * characteristic_length(mechanism)


def _turned(mechanism, differences):
    """Differences of angles to the nearest turn."""
    angular = np.array([item.coordinate.kind == "angle" for item in mechanism.inputs])
    return np.where(angular, (differences + np.pi) % (2 * np.pi) - np.pi, differences)


def test_a_polynomial_has_no_more_real_roots_than_its_degree_and_all_its_roots_close(mechanism, regular):
    eliminant = closed_form_of(mechanism).direct
    if not isinstance(eliminant, Eliminant):
        return
    found = mechanism.direct(np.array([inputs for _, _, inputs, _ in regular]))
    counts = np.sum(found.exists, axis=-1)
    assert counts.min() >= 1
    assert counts.max() <= eliminant.degree


def test_a_search_on_the_joint_graph_finds_every_branch_of_the_closed_form(mechanism, regular, apart):
    _, _, inputs, _ = regular[0]
    if closed_form_of(mechanism).direct is None:
        return
    claimed, found = mechanism.direct(inputs), search(mechanism, "direct", inputs)
    assert len(found.joints)
    poses, length = pose_of(mechanism, found.joints), characteristic_length(mechanism)
    if found.settled:
        for pose in claimed.poses[claimed.exists]:
            assert np.min(apart(poses, pose)) < 1e-6 * length
    if claimed.complete_for == "joint_graph" and claimed.complete:
        for pose in poses:
            assert np.min(apart(claimed.poses[claimed.exists], pose)) < 1e-6 * length


@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_batch_shapes_agree_with_single_problems(mechanism, regular, shape):
    count = int(np.prod(shape))
    poses = np.array([pose for pose, _, _, _ in regular[:count]]).reshape(*shape, len(mechanism.platform.pose))
    inputs = np.array([inputs for _, _, inputs, _ in regular[:count]]).reshape(*shape, len(mechanism.inputs))
    inverse = mechanism.inverse(poses)
    assert inverse.inputs.shape == (*shape, inverse.candidates, len(mechanism.inputs))
    for index in np.ndindex(shape):
        np.testing.assert_array_equal(inverse.inputs[index], mechanism.inverse(poses[index]).inputs)
    if closed_form_of(mechanism).direct is None:
        return
    direct = mechanism.direct(inputs)
    assert direct.poses.shape == (*shape, direct.candidates, len(mechanism.platform.pose))
    exact = callable(closed_form_of(mechanism).direct)  # a library's eigenvalues depend on the batch
    for index in np.ndindex(shape):
        alone = mechanism.direct(inputs[index])
        tolerance = 0.0 if exact else 1e-9 * characteristic_length(mechanism)
        np.testing.assert_allclose(direct.poses[index], alone.poses, rtol=0, atol=tolerance)
        np.testing.assert_array_equal(direct.status[index], alone.status)


def test_one_mode_is_the_same_as_its_row_of_all_modes(mechanism, regular):
    for pose, mode, inputs, _ in regular[:20]:
        np.testing.assert_allclose(mechanism.inverse(pose, mode).inputs[0], inputs, rtol=0, atol=1e-12)


def test_no_unlabelled_nan(mechanism, poses, regular):
    inputs = np.array([inputs for _, _, inputs, _ in regular])
    inputs = inputs if callable(closed_form_of(mechanism).direct) else inputs[:TRACED]
    growth = [1.0 if name == "theta" else 10.0 for name in mechanism.platform.pose]  # theta ends at 90 deg
    answers = [mechanism.inverse(np.concatenate([poses, poses * growth]))]
    answers.append(direct(mechanism, np.concatenate([inputs * 10.0, inputs * 0.1, inputs])))
    for found in answers:
        missing = np.isin(found.status, (Status.unreachable, Status.self_motion, Status.undecided))
        assert np.all(np.isfinite(found.poses[found.exists]))
        assert np.all(np.isfinite(found.joints[found.exists]))
        assert np.all(missing | np.isfinite(found.poses).all(axis=-1))


@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-9, 1e-12, 0.0])
def test_near_singular_configurations_close_and_are_labelled(mechanism, singular_examples, distance, units, moved):
    assert singular_examples
    toward = np.random.default_rng(4).normal(size=(8, len(units))) * units / characteristic_length(mechanism)
    for example in singular_examples:
        for step in toward:
            found = mechanism.inverse(moved(example.pose, distance * step), example.mode)
            if not found.exists[0]:
                assert found.failures
                assert all(failure.value < 0 for failure in found.failures)
                continue
            assert found.residuals[0] < 1e-7 * characteristic_length(mechanism)
            sizes = relative_factors(mechanism, found.factors)
            form = closed_form_of(mechanism)
            watched = {item.name for item in form.factor_list if item.kind != "other"}
            watched |= {group[0] for group in form.constraint_singular if len(group) == 1}
            least = min(abs(float(sizes[name][0])) for name in watched)
            assert (found.status[0] == Status.regular) == (least > NEAR_SINGULAR)


def test_direct_at_singular_examples_finds_the_pose_or_says_why_not(mechanism, singular_examples, apart):
    if closed_form_of(mechanism).direct is None:
        return
    for example in singular_examples:
        found = mechanism.direct(example.inputs)
        if found.overall_status == Status.self_motion:
            assert len(found) == 0
            nearest = [apart(curve.poses(4001), example.pose).min() for curve in found.curves]
        else:
            nearest = apart(found.poses[found.exists], example.pose)
        assert np.min(nearest) < 1e-2 * characteristic_length(mechanism)


def test_self_motion_is_a_curve_of_assemblies_with_locked_inputs(mechanism, singular_examples):
    moving = [example for example in singular_examples if example.status == Status.self_motion]
    claims = [set(group) for group in closed_form_of(mechanism).self_motion_singular]
    factors = {example.factor.name for example in singular_examples}
    assert moving or not any(group <= factors for group in claims)
    for example in moving:
        found = mechanism.direct(example.inputs)
        assert len(found) == 0
        assert found.curves
        for curve in found.curves:
            joints = curve.joints(41)
            assert np.max(closure_error(mechanism, joints)) < 1e-6 * characteristic_length(mechanism)
            locked = joints[:, mechanism.input_indices]
            np.testing.assert_allclose(locked, np.broadcast_to(locked[0], locked.shape), rtol=0, atol=1e-6)
            spread = np.ptp(curve.poses(41), axis=0).max()
            assert spread > 1e-3 * (curve.interval[1] - curve.interval[0])
