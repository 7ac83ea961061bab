"""Mechanisms with masses assigned at random, and configurations near home at which to weigh them."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import assemble
from assur.kinematics.rates.instantaneous import instantaneous
from assur.kinematics.validation.check import METRES
from assur.machine.motion.screws import rate_units
from assur.model.machine_data import Actuator, Gravity, LinkData, MachineData
from assur.model.pose import LENGTHS, rate_names
from assur.numerics import rotations


@lru_cache
def weighed(record, factor=1.0):
    """The record with bodies whose centres lie anywhere, rotors, and gravity aslant; all masses times a factor."""
    random = np.random.default_rng(0)
    length = characteristic_length(record)
    size = 0.2 * length * METRES[record.unit]
    links = {}
    for link in record.links:
        mass, cloud = random.uniform(0.5, 2.0), size * random.normal(size=(3, 3))
        second = cloud @ cloud.T
        inertia = mass * (np.trace(second) * np.eye(3) - second)
        links[link] = LinkData(
            mass=factor * mass, centre=0.2 * length * random.normal(size=3), inertia=factor * inertia
        )
    actuators = {
        record.coordinate_label(item.coordinate): Actuator(rotor=factor * random.uniform(0.1, 1.0) * size**2)
        for item in record.drives
    }
    data = MachineData(links=links, actuators=actuators, gravity=Gravity(np.array([0.6, 0.0, -0.8])))
    return replace(record, machine=data)


@lru_cache
def place(record):
    """Joint values (1, n) of an assembly near home."""
    motion = instantaneous(record, record.home_values).motion
    away = motion.null @ np.random.default_rng(1).normal(size=len(record.coordinates)) * motion.scale
    near = assemble(record, (record.home_values + 0.1 * away)[None])
    assert near.closed.all()
    return near.values


def motion_of(record):
    """Rates and accelerations (1, k) of the pose, in SI units."""
    size = 0.3 * characteristic_length(record) * METRES[record.unit]
    units = np.array([size if name in LENGTHS else 0.3 for name in rate_names(record.platform.pose)])
    return np.random.default_rng(2).normal(size=(2, 1, len(units))) * units


def moved(record, values, rates, seconds, changes=0.0):
    """Assemblies (N, n) after such times at joint rates (n,) that change, in SI units, the loops closed again."""
    seconds = np.reshape(seconds, (-1, 1))
    away = (seconds * rates + 0.5 * seconds**2 * changes) / rate_units(record)
    after = values[0] + away
    for turn in joint_graph(record).turns:
        turned = rotations.from_vector(away[:, turn]) @ rotations.from_vector(values[0, turn])
        after[:, turn] = rotations.to_vector(turned)
    return assemble(record, after, near=True).values
