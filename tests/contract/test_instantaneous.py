"""Laws of first- and second-order motion: the joint graph alone says what the closed form says."""

import numpy as np

from assur.kinematics.rates.acceleration import acceleration_at
from assur.kinematics.rates.finite_motion import classify_at
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.status import Status
from dual_acceleration import dual_acceleration


def test_the_relation_of_inputs_and_pose_is_that_of_the_joint_graph(mechanism, regular):
    chosen = regular[:25]
    here = instantaneous(mechanism, np.array([joints for _, _, _, joints in chosen]))
    assert np.all(here.closed)
    for k, (pose, mode, _, _) in enumerate(chosen):
        form = mechanism.velocity_map(pose, mode)
        found = np.linalg.solve(here.jp[k], here.jq[k])
        np.testing.assert_allclose(found, form.matrix, rtol=0, atol=1e-8 * np.abs(form.matrix).max())
        if here.jq[k].shape[0] == here.jq[k].shape[1]:
            product = np.linalg.det(here.jp[k]) * np.linalg.det(here.jq[k])
            assert np.sign(product) == np.sign(form.det_jp * form.det_jq)


def test_the_status_is_that_of_the_joint_graph(mechanism, regular, singular_examples):
    found = classify_at(mechanism, np.array([joints for _, _, _, joints in regular[:100]]))
    assert set(found.tolist()) <= {Status.regular, Status.near_singular}
    for example in singular_examples:
        status = Status(int(classify_at(mechanism, example.joints)))
        claimed = {example.status.name}
        if mechanism.closed_form.complete_for == "reduced" and example.status == Status.constraint:
            claimed.add("self_motion")  # in a motion of the joint graph that the reduced model leaves out
        assert status.name in claimed, (example.factor.name, example.mode)
        here, form = instantaneous(mechanism, example.joints), mechanism.velocity_map(example.pose, example.mode)
        if not here.types["IIM"]:  # else relations are lacking, of which a reduced model may know nothing
            sides = (bool(here.singular_output), bool(here.singular_input))
            assert sides == (bool(form.singular_output), bool(form.singular_input)), example.factor.name


def test_the_acceleration_is_that_of_the_joint_graph(mechanism, regular):
    rng = np.random.default_rng(7)
    for pose, mode, _, joints in regular[:10]:
        rates, second = rng.normal(size=(2, len(mechanism.inputs)))
        velocity, acceleration = dual_acceleration(mechanism, pose[None], rates[None], second[None], mode)
        of_graph = acceleration_at(mechanism, joints, rates, second)
        np.testing.assert_allclose(of_graph[0], velocity[0], rtol=0, atol=1e-8 * np.abs(velocity).max())
        np.testing.assert_allclose(of_graph[1], acceleration[0], rtol=0, atol=1e-7 * np.abs(acceleration).max())
        for found, same in zip(mechanism.acceleration(pose, rates, second, mode), of_graph, strict=True):
            np.testing.assert_allclose(found, same, rtol=0, atol=1e-8 * np.abs(same).max())
