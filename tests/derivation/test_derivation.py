"""A derived closed form takes the place of the hand-written one: checked like any, with the same answers and names."""

import shutil

import numpy as np
import pytest

from assur.derivation.derivation import derive
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.exact import exactness
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.pose import LENGTHS
from assur.model.registry import load_record

TOWERS = ("zeng2019", "fivebar", "orthoglide", "tripteron", "linear_delta_4r", "delta_4s", "tsai_platform",
          "three_p2us", "linear_delta_4s", "three_crr")  # fmt: skip
POLYNOMIALS = ("planar_3rrr", "three_rrc")
QUICK = ("zeng2019", "fivebar")
"""A tower with parallelograms, and one in a plane; the others in the deep run."""


@pytest.fixture(
    scope="module",
    params=[name if name in QUICK else pytest.param(name, marks=pytest.mark.deep) for name in (*TOWERS, *POLYNOMIALS)],
)
def both(request, tmp_path_factory):
    """The record of a mechanism with its hand-written form, and one with the derived form."""
    written = load_record(request.param)
    folder = tmp_path_factory.mktemp(request.param)
    shutil.copy(written.file, folder / "mechanism.toml")
    (folder / "closed_form.py").write_text(derive(written).closed_form())
    return written, load_record(folder)


def test_it_agrees_with_the_joint_graph_exactly(both):
    derived = both[1]
    assert problems(derived, IN_FULL)[0] == ()
    assert exactness(derived).proved


def test_answers_and_names_are_those_of_the_hand_written_form(both):
    written = both[0]
    length = characteristic_length(written)
    home = pose_of(written, home_values(written))
    scales = np.array([0.05 * length if name in LENGTHS else 0.05 for name in written.platform.pose])
    poses = home + scales * np.random.default_rng(7).uniform(-1.0, 1.0, (20, len(home)))
    compared = 0
    for pose in poses:
        first, second = (inverse(record, pose, method="closed form") for record in both)
        modes = [{own.mode: own.inputs for own in answer} for answer in (first, second)]
        assert modes[0].keys() == modes[1].keys()
        for mode, inputs in modes[0].items():
            assert np.allclose(inputs, modes[1][mode], rtol=0, atol=1e-9 * length)
        for inputs in list(modes[0].values())[:1]:
            back = [{own.mode: own.pose for own in direct(record, inputs, method="closed form")} for record in both]
            assert back[0].keys() == back[1].keys()
            for mode, value in back[0].items():
                assert np.allclose(value, back[1][mode], rtol=0, atol=1e-9 * length)
            compared += 1
    assert compared >= 8
