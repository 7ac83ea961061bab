import json

import numpy as np
import pytest

from assur.kinematics.modes import all_modes, mode_signs
from assur.kinematics.position import inverse
from assur.mechanism import load
from assur.model.pose import is_angle
from assur.page.kernel import kernel, parameters
from catalogue import each

POSES = 60

PROGRAM = """
const found = new Map(given.turns.map(([angle, cosine, sine]) => [angle, [cosine, sine]]));
// Python's cosines and sines, so that what is left to compare is defined by IEEE 754 to the last bit
const theirs = { ...Object.fromEntries(Object.getOwnPropertyNames(Math).map((name) => [name, Math[name]])),
  cos: (angle) => found.get(angle)[0], sin: (angle) => found.get(angle)[1] };
const kernel = new Function("Math", "return " + given.kernel)(theirs);
const text = (number) => (Object.is(number, -0) ? "-0.0" : String(number));
answer = given.poses.map((pose, k) => {
  const { factors, inputs } = kernel(pose, given.parameters, given.signs[k]);
  return { factors: Object.values(factors).map(text), names: Object.keys(factors), inputs: inputs.map(text) };
});
"""


def poses_and_modes(record, rng):
    """Poses spread over the file's box, and working modes in turn."""
    low, high = np.array([record.box[name] for name in record.platform.pose]).T
    modes = all_modes(record, "inverse")
    return rng.uniform(low, high, size=(POSES, len(low))), [modes[k % len(modes)] for k in range(POSES)]


def in_node(node, record, poses, modes, text):
    """What a kernel answers there at poses (N, m) in modes."""
    angles = poses[:, [is_angle(name) for name in record.platform.pose]].ravel()
    given = {
        "kernel": text,
        "parameters": parameters(record),
        "poses": poses.tolist(),
        "signs": [mode_signs(record, "inverse", mode) for mode in modes],
        "turns": np.stack([angles, np.cos(angles), np.sin(angles)], axis=1).tolist(),
    }
    return node(PROGRAM, given)


def differences(node, record, rng, text):
    """How many of the compared factors and inputs differ, and how many were compared."""
    poses, modes = poses_and_modes(record, rng)
    solved = [inverse(record, pose, mode or None) for pose, mode in zip(poses, modes, strict=True)]
    given = np.array([found.given for found in solved])  # a quaternion is made a unit one
    differing = compared = 0
    for found, here in zip(solved, in_node(node, record, given, modes, text), strict=True):
        if not found.exists[0]:
            continue
        assert here["names"] == list(found.factors)
        ours = [*(value[0] for value in found.factors.values()), *found.inputs[0]]
        theirs = [float(number) for number in (*here["factors"], *here["inputs"])]
        near = [0.0] * len(found.factors) + [
            4 * np.finfo(float).eps if item.coordinate.kind == "angle" else 0.0 for item in record.inputs
        ]  # an arc tangent may differ in its last bit
        differing += sum(not abs(a - b) <= c * abs(a) for a, b, c in zip(ours, theirs, near, strict=True))
        compared += len(ours)
    return differing, compared


@pytest.mark.node
@pytest.mark.parametrize("name", each())
def test_factors_and_inputs_have_pythons_bits(node, rng, name):
    record = load(name)
    differing, compared = differences(node, record, rng, kernel(record))
    assert compared >= 10
    assert differing == 0


@pytest.mark.node
@pytest.mark.parametrize(("old", "new"), [("Math.sqrt(", "(1 + 2 ** -52) * Math.sqrt("), ("signs[0]", "-signs[0]")])
def test_a_bit_and_a_sign_are_seen(node, rng, old, new):
    record = load("zeng2019")
    text = kernel(record)
    assert old in text
    assert differences(node, record, rng, text.replace(old, new, 1))[0] > 0


def test_where_there_is_no_closed_form_there_is_no_kernel(drafted):
    assert kernel(load(drafted)) is None


def test_parameters_are_those_of_kernels():
    record = load("fivebar")
    assert parameters(record) == json.loads(json.dumps(vars(record.values)))
