"""Limbs of series that meet at one link: conditions that their poses fulfil, and all assemblies of hybrids."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import closure_error
from assur.kinematics.configurations import distinct
from assur.kinematics.home import home_values
from assur.kinematics.limbs.networks import limbs_of
from assur.kinematics.platforms.direct import direct_by_conditions
from assur.kinematics.platforms.inverse import inverse_by_limbs
from assur.kinematics.platforms.limbs import closed_limb, held_limb, limb_conditions
from assur.kinematics.platforms.soma import products, soma_of
from assur.kinematics.pose import platform_frame, pose_of
from assur.kinematics.search import search
from assur.model.registry import load_record

HYBRIDS = {
    "over a platform": ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] R[y] R[y] R[y]"],
    "over its middle link": ["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "R[z] R[z] C[z]"],
}


@pytest.fixture(scope="module", params=HYBRIDS)
def hybrid(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("limbs") / "mine.toml"
    assert main(["new", str(path), *(word for chain in HYBRIDS[request.param] for word in ("--chain", chain))]) == 0
    return load_record(path)


def test_conditions_hold_where_the_mechanism_is(hybrid):
    values, size = home_values(hybrid), characteristic_length(hybrid)
    rotation, point = platform_frame(hybrid, values)
    soma = soma_of((rotation[None], (point - rotation @ hybrid.platform.point)[None] / size))
    for limb in limbs_of(hybrid):
        conditions = limb_conditions(limb, size)
        assert len(conditions.quadrics) > 0
        assert np.max(np.abs(products(soma) @ conditions.quadrics.T)) < 1e-9


def test_a_limb_closes_as_it_stands(hybrid):
    values, size = home_values(hybrid), characteristic_length(hybrid)
    rotation, point = platform_frame(hybrid, values)
    frame = rotation, point - rotation @ hybrid.platform.point
    for limb in limbs_of(hybrid):
        solutions = closed_limb(limb, frame, size)
        own = values[list(solutions.indices)]
        assert np.min(np.max(np.abs(solutions.values - own), axis=1)) < 1e-6
        held = held_limb(limb, dict(zip(solutions.indices[:1], own[:1].tolist(), strict=True)))
        assert len(closed_limb(held, frame, size).values) >= 1


def test_direct_and_inverse_have_all_that_a_search_meets(hybrid):
    home = home_values(hybrid)
    rng = np.random.default_rng(2)
    inputs = np.array([driven.printed(home[driven.coordinate.index]) for driven in hybrid.inputs])
    inputs = inputs + rng.uniform(-0.1, 0.1, len(inputs)) * np.where(np.abs(inputs) > 10, 20.0, 1.0)
    direct = direct_by_conditions(hybrid, inputs)
    assert direct.complete
    assert len(direct.joints) > 0
    met = search(hybrid, "direct", inputs).joints
    assert len(met) > 0
    assert len(distinct(hybrid, np.concatenate([direct.joints, met]))) == len(direct.joints)
    pose = pose_of(hybrid, direct.joints[0])
    inverse = inverse_by_limbs(hybrid, pose)
    assert inverse.complete
    assert np.max(closure_error(hybrid, inverse.joints)) < 1e-9
    met = search(hybrid, "inverse", pose).joints
    assert len(distinct(hybrid, np.concatenate([inverse.joints, met]))) == len(inverse.joints)
