"""What limbs say of the platform: known numbers of quadrics, true at all poses of the limb and at no others."""

import numpy as np
import pytest

from assur.cli.main import main
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.limbs.networks import limbs_of
from assur.kinematics.platforms.conditions import (
    UncertainConditionsError,
    conditions_at,
    drawn_rotations,
    joined,
)
from assur.kinematics.platforms.limbs import held_limb, limb_conditions
from assur.kinematics.platforms.soma import products, soma_of
from assur.kinematics.pose import platform_frame
from assur.model.registry import load_record


def numbers(name, held):
    """Of the first limb of a mechanism."""
    record = load_record(name)
    home = home_values(record)
    locked = {index: home[index] for index in record.input_indices} if held else {}
    conditions = limb_conditions(held_limb(limbs_of(record)[0], locked), characteristic_length(record))
    return len(conditions.linear), len(conditions.quadrics), len(conditions.spheres)


@pytest.mark.parametrize(
    ("name", "held", "expected"),
    [
        ("gough_stewart", False, (0, 0, 0)),
        ("gough_stewart", True, (0, 1, 1)),  # a distance
        ("three_rps", False, (0, 1, 1)),  # a point in a plane
        ("three_rps", True, (0, 5, 2)),  # on a circle: the plane, four of its multiples, the distance
        ("planar_3rrr", False, (4, 25, 9)),  # e and g in the plane's own four coordinates
    ],
)
def test_how_much_limbs_say(name, held, expected):
    linear, quadrics, spheres = numbers(name, held)
    assert (linear, spheres) == (expected[0], expected[2])
    assert quadrics == expected[1]


def test_they_hold_at_assemblies_of_the_whole_mechanism(tmp_path):
    path = tmp_path / "mine.toml"
    assert main(["new", str(path), "2UPR-SPR"]) == 0
    record = load_record(path)
    size = characteristic_length(record)
    home = home_values(record)
    rotation, point = platform_frame(record, home)
    soma = soma_of((rotation[None], (point - rotation @ record.platform.point)[None] / size))
    conditions = joined(limb_conditions(limb, size) for limb in limbs_of(record))
    assert len(conditions.quadrics) == 6
    assert np.max(np.abs(products(soma) @ conditions.quadrics.T)) < 1e-9
    rng = np.random.default_rng(1)
    others = soma_of((drawn_rotations(rng, 20), rng.normal(size=(20, 3))))
    assert np.min(np.max(np.abs(products(others) @ conditions.quadrics.T), axis=1)) > 1e-4


def test_a_condition_that_is_nearly_true_is_not_decided():
    """A plane that is left by a billionth."""

    def draw(count, rng):
        return drawn_rotations(rng, count), rng.normal(size=(count, 3)) * [1.0, 1.0, 1e-9]

    with pytest.raises(UncertainConditionsError):
        conditions_at(draw, 1.0)
