"""Laws of closed forms over intervals: the same lines, unchanged, bound every float answer in a box.

Every float operation lies between the rounded bounds of the interval operation, so the float answers must lie inside
to the last bit, whatever they have lost by cancellation.
"""

from types import SimpleNamespace

import numpy as np
import pytest

import assur
from assur.kinematics.modes import all_modes, mode_signs, sign_names
from assur.model.closed_form import Branch, Eliminant, PolynomialSystem
from assur.model.pose import is_angle
from assur.numerics.dual import Dual, DualIntervals, Duals
from assur.numerics.intervals.functions import cosine_sine
from assur.numerics.intervals.interval import Interval
from assur.numerics.number_types import Floats, Intervals

WIDTHS = (0.0, 1e-3, 1e-1)
"""Widths of the boxes, over that of the mechanism's workspace box; over a turn for an angle of an input."""

WITH_DIRECT = [name for name in assur.names() if assur.load(name).closed_form.direct is not None]


def _leaves(value, path=()):
    """(path, number) of every number in a kernel's answer."""
    if isinstance(value, Branch):
        value = {"inputs": value.inputs, "pose": value.pose, "margins": value.margins, "core": value.core}
    if isinstance(value, SimpleNamespace):
        value = vars(value)
    if hasattr(value, "items"):
        value = [(name, value[name]) for name in value]
    elif isinstance(value, tuple | list):
        value = list(enumerate(value))
    else:
        return [] if value is None or isinstance(value, str) else [(path, value)]
    return [leaf for name, part in value for leaf in _leaves(part, (*path, name))]


def _signs(mechanism, problem, mode):
    return SimpleNamespace(
        **dict(zip(sign_names(mechanism, problem), mode_signs(mechanism, problem, mode), strict=True))
    )


def _some_modes(mechanism, problem):
    modes = all_modes(mechanism, problem)
    return {modes[0], modes[len(modes) // 2], modes[-1]}


def _exact(parameters):
    """The parameters as intervals: a product of two floats would be rounded, and the rounding lost."""
    return SimpleNamespace(**{name: Interval.of(value) for name, value in vars(parameters).items()})


def _around(centres, reach, angles):
    """Components for a kernel, of points chosen at random in boxes (n,) and of the boxes: angles as pairs."""
    points = centres + reach * np.random.default_rng(8).uniform(-1, 1, size=centres.shape)
    points = np.clip(points, centres - reach, centres + reach)
    boxes = [Interval.of(low, high) for low, high in zip((centres - reach).T, (centres + reach).T, strict=True)]
    floats = tuple((np.cos(x), np.sin(x)) if angle else x for x, angle in zip(points.T, angles, strict=True))
    return floats, tuple(cosine_sine(x) if angle else x for x, angle in zip(boxes, angles, strict=True))


def _boxes(mechanism, poses, width):
    low, high = np.array([mechanism.box[name] for name in mechanism.platform.pose]).T
    return _around(poses, width * (high - low) / 2, [is_angle(name) for name in mechanism.platform.pose])


def _after(form, ns, p, branch):
    """All that is computed from a branch."""
    found = {
        "branch": branch,
        "joints": form.joints(ns, p, branch.core),
        "factors": form.factors(ns, p, branch.core),
        "jacobians": form.jacobians(ns, p, branch.core),
    }
    for name in ("quantities", "as_printed"):
        if getattr(form, name) is not None:
            found[name] = getattr(form, name)(ns, p, branch.core)
    if form.constraints is not None:
        found["constraints"] = form.constraints(ns, p, branch.core, branch.inputs)
    return found


def _direct(mechanism, ns, p, inputs, pose, turn):
    """What the direct problem's kernels answer; the pose and the turn stand for unknowns that a search would find."""
    form, direct = mechanism.closed_form, mechanism.closed_form.direct
    found = {}
    if isinstance(direct, PolynomialSystem):
        unknowns = tuple(direct.lift(ns, p, pose))
        found["equations"] = list(direct.equations(ns, p, inputs, unknowns))
        return found | _after(form, ns, p, direct.back(ns, p, inputs, unknowns))
    if isinstance(direct, Eliminant):
        extra = (SimpleNamespace(**dict.fromkeys(direct.signs, -1)),) if direct.signs else ()
        found["coefficients"] = list(direct.coefficients(ns, p, inputs, *extra))
        root = turn if direct.kind == "angle" else turn[0]
        return found | _after(form, ns, p, direct.back(ns, p, inputs, root, *extra))
    for mode in _some_modes(mechanism, "direct"):
        found[mode] = _after(form, ns, p, direct(ns, p, inputs, _signs(mechanism, "direct", mode)))
    if form.self_motion is not None:
        signs = SimpleNamespace(**dict.fromkeys(sign_names(mechanism, "direct"), 1))
        found["self_motion"] = _after(form, ns, p, form.self_motion.kernel(ns, p, inputs, turn, signs))
    return found


def _compare(floats, intervals):
    """Every finite float answer lies inside; the widths of the answers over their sizes, in the median of the boxes."""
    floats, intervals = _leaves(floats), _leaves(intervals)
    assert [path for path, _ in floats] == [path for path, _ in intervals]
    widths, compared = {}, 0
    for (path, number), (_, interval) in zip(floats, intervals, strict=True):
        if not isinstance(interval, Interval):
            np.testing.assert_array_equal(number, interval, err_msg=str(path))
            continue
        number = np.broadcast_to(number, interval.shape)
        finite = np.isfinite(number)
        outside = finite & ~interval.contains(number)
        assert not np.any(outside), (path, number[outside][:3], interval[outside][:3])
        compared += int(np.sum(finite & np.isfinite(interval.width)))
        if np.any(finite):
            size = max(float(np.max(np.abs(number[finite]))), 1e-100)
            widths[path] = float(np.median(np.broadcast_to(interval.width, number.shape)[finite])) / size
    assert compared > 0
    return widths


@pytest.mark.parametrize("width", WIDTHS)
def test_every_float_answer_at_a_pose_in_the_box_lies_inside(mechanism, poses, width):
    form = mechanism.closed_form
    floats, intervals = _boxes(mechanism, poses, width)
    for mode in _some_modes(mechanism, "inverse"):
        sign = _signs(mechanism, "inverse", mode)
        with np.errstate(all="ignore"):  # floats divide by zero where a branch does not exist
            number = form.inverse(Floats(), mechanism.values, floats, sign)
            wanted = _after(form, Floats(), mechanism.values, number)
        p = _exact(mechanism.values)
        found = _after(form, Intervals(), p, form.inverse(Intervals(), p, intervals, sign))
        widths = _compare(wanted, found)
        if width == 0:  # but for what is zero at every pose of a mode, and has no size
            assert np.quantile(list(widths.values()), 0.8) < 1e-9, max(widths, key=widths.get)


@pytest.mark.parametrize("mechanism", WITH_DIRECT, indirect=True)
@pytest.mark.parametrize("width", WIDTHS)
def test_every_float_answer_at_inputs_in_the_box_lies_inside(mechanism, regular, width):
    values = np.array([inputs for _, _, inputs, _ in regular[:40]])
    poses = np.array([pose for pose, _, _, _ in regular[:40]])
    angles = [item.coordinate.kind == "angle" for item in mechanism.inputs]
    reach = width * np.where(angles, np.pi, np.ptp(values, axis=0) / 2)
    inputs, poses = _around(values, reach, angles), _boxes(mechanism, poses, width)
    turns = [pairs[0] for pairs in _around(np.linspace(-3, 3, len(values))[:, None], width * np.pi, [True])]
    with np.errstate(all="ignore"):
        wanted = _direct(mechanism, Floats(), mechanism.values, inputs[0], poses[0], turns[0])
    found = _direct(mechanism, Intervals(), _exact(mechanism.values), inputs[1], poses[1], turns[1])
    widths = _compare(wanted, found)
    if width == 0:  # the turn is no root of the polynomial, and how close to one that vanishes is left to chance
        assert np.median(list(widths.values())) < 1e-5


def test_margins_prove_that_branches_exist_and_that_they_do_not(mechanism, poses):
    """In small boxes a margin's bounds have the sign of the float's, at all but a few poses near its zero."""
    floats, intervals = _boxes(mechanism, poses, 1e-6)
    sign = _signs(mechanism, "inverse", mechanism.modes.default_working)
    with np.errstate(all="ignore"):
        number = mechanism.closed_form.inverse(Floats(), mechanism.values, floats, sign)
    interval = mechanism.closed_form.inverse(Intervals(), _exact(mechanism.values), intervals, sign)
    exists = np.ones(len(poses), dtype=bool)
    for name, margin in number.margins.items():
        bounds, margin = interval.margins[name], np.broadcast_to(margin, len(poses))
        assert not np.any(bounds.positive & (margin <= 0))
        assert not np.any(bounds.negative & (margin >= 0))
        exists &= np.broadcast_to(bounds.positive, len(poses))
        undefined = ~np.broadcast_to(bounds.defined, len(poses))
        assert np.mean(np.broadcast_to(bounds.nonzero, len(poses)) | undefined | (np.abs(margin) < 1e-9)) > 0.9, name
    parts = [part for _, part in _leaves(interval.inputs) if isinstance(part, Interval)]
    assert np.sum(exists) > 5
    for part in parts:
        assert np.all(np.broadcast_to(part.defined, len(poses))[exists])


def test_the_slopes_of_duals_lie_inside_those_over_boxes(mechanism, poses):
    form, names = mechanism.closed_form, mechanism.platform.pose
    sign = _signs(mechanism, "inverse", mechanism.modes.default_working)
    rng = np.random.default_rng(9)
    floats, intervals = _boxes(mechanism, poses, 1e-4)
    along = rng.normal(size=len(names))

    def moving(components, numbers):
        return tuple(
            (Dual(value[0], -value[1] * rate), Dual(value[1], value[0] * rate)) if is_angle(name)
            else Dual(value, numbers(rate))
            for name, value, rate in zip(names, components, along, strict=True)
        )  # fmt: skip

    with np.errstate(all="ignore"):
        wanted = form.inverse(Duals(), mechanism.values, moving(floats, float), sign)
    found = form.inverse(DualIntervals(), _exact(mechanism.values), moving(intervals, Interval.of), sign)
    compared = 0
    for (_, number), (_, interval) in zip(_leaves(wanted.inputs), _leaves(found.inputs), strict=True):
        if isinstance(number, Dual):
            slope, bounds = np.broadcast_to(number.derivative, len(poses)), interval.derivative
            finite = np.isfinite(slope)
            assert np.all(bounds.contains(slope) | ~finite)
            compared += int(np.sum(finite & np.isfinite(bounds.width)))
    assert compared > 20
