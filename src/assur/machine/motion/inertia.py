"""Inertia and gravity of all links per joint rate, M u'' + h(u) + g, before loops and drives tie the rates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.kinematics.validation.check import METRES
from assur.machine.masses.link_masses import Masses
from assur.machine.motion.screws import joint_screws, paths, screw_rates
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinkInertia:
    """Bodies at N configurations, in SI units, with joint rates u as `assur.machine.motion.screws` has them.

    Attributes:
        record: the mechanism.
        masses: (L,) in kg, 0 of links that are not said to weigh.
        centres: (N, L, 3) centres of mass in the base frame.
        tensors: (N, L, 3, 3) inertia about them along the base's axes.
        screws: (N, 6, n) of the joints.
        gravity: (3,).
    """

    record: MechanismRecord
    masses: FloatArray
    centres: FloatArray
    tensors: FloatArray
    screws: FloatArray
    gravity: FloatArray

    @cached_property
    def turning(self) -> FloatArray:
        """Angular velocities (N, L, 3, n) of the links per joint rate."""
        return np.asarray(self.screws[:, None, :3] * paths(self.record).of_links[:, None])

    @cached_property
    def moving(self) -> FloatArray:
        """Velocities (N, L, 3, n) of their centres of mass."""
        at_origin = self.screws[:, None, 3:] * paths(self.record).of_links[:, None]
        return np.asarray(at_origin + np.cross(self.turning, self.centres[..., None], axis=-2))

    @cached_property
    def matrix(self) -> FloatArray:
        """Mass matrix (N, n, n) of the joint rates, rotors of the actuators among it."""
        moving = self.moving * np.sqrt(self.masses)[:, None, None]
        stacked = moving.reshape(len(moving), -1, moving.shape[-1])
        turning = np.swapaxes(self.turning, -1, -2) @ (self.tensors @ self.turning)
        whole = np.swapaxes(stacked, -1, -2) @ stacked + turning.sum(axis=1)
        return np.asarray(whole + np.diag(rotors(self.record)))

    @cached_property
    def weight(self) -> FloatArray:
        """What holds the links against gravity (N, n), per joint rate."""
        return np.asarray(-np.einsum("l,nlaj,a->nj", self.masses, self.moving, self.gravity))

    @cached_property
    def potential(self) -> FloatArray:
        """Potential energy (N,), zero where all centres of mass are at the base's origin."""
        return np.asarray(-np.einsum("l,nla,a->n", self.masses, self.centres, self.gravity))

    def accelerations(self, rates: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Angular accelerations and those of the centres of mass (N, L, 3), at rates and accelerations (N, n)."""
        signs = paths(self.record).of_links
        changes = np.einsum("lj,njk->nlk", signs, screw_rates(self.record, self.screws, rates))
        turning = changes[..., :3] + np.einsum("nlaj,nj->nla", self.turning, second)
        angular, speed = (np.einsum("nlaj,nj->nla", part, rates) for part in (self.turning, self.moving))
        own = changes[..., 3:] + np.cross(changes[..., :3], self.centres) + np.cross(angular, speed)
        return turning, own + np.einsum("nlaj,nj->nla", self.moving, second)

    def wrenches(self, rates: FloatArray, second: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Force, and moment about the centre of mass (N, L, 3), that each link needs to move so; without gravity."""
        turning, own = self.accelerations(rates, second)
        angular = np.einsum("nlaj,nj->nla", self.turning, rates)
        momentum = np.einsum("nlab,nlb->nla", self.tensors, angular)
        moment = np.einsum("nlab,nlb->nla", self.tensors, turning) + np.cross(angular, momentum)
        return self.masses[:, None] * own, moment

    def needed(self, rates: FloatArray, second: FloatArray) -> FloatArray:
        """M u'' + h(u), (N, n): what moves the links so, per joint rate; rotors among it, gravity not."""
        force, moment = self.wrenches(rates, second)
        own = np.einsum("nlaj,nla->nj", self.moving, force) + np.einsum("nlaj,nla->nj", self.turning, moment)
        return np.asarray(own + rotors(self.record) * second)

    def kinetic(self, rates: FloatArray) -> FloatArray:
        """Kinetic energy (N,) at joint rates (N, n)."""
        return np.asarray(0.5 * np.einsum("ni,nij,nj->n", rates, self.matrix, rates))


def link_inertia(record: MechanismRecord, values: FloatArray, known: Masses) -> LinkInertia:
    """The bodies at joint values (N, n), the platform with its payload."""
    metre, placed, own = METRES[record.unit], frames(record, values), paths(record)
    bodies = known.carried(record.platform.link)
    count = len(own.links)
    weights, centres, tensors = np.zeros(count), np.zeros((len(values), count, 3)), np.zeros((len(values), count, 3, 3))
    for place, link in enumerate(own.links):
        rotation, origin = placed[link]
        body = bodies.get(link)
        centres[:, place] = metre * origin
        if body is not None:
            weights[place] = body.mass
            centres[:, place] += rotation @ body.centre
            tensors[:, place] = rotation @ body.inertia @ np.swapaxes(rotation, -1, -2)
    return LinkInertia(record, weights, centres, tensors, joint_screws(record, values), known.gravity)


def rotors(record: MechanismRecord) -> FloatArray:
    """Inertia of rotors (n,) at the joint coordinates that they drive, also through gears."""
    numbers = np.zeros(len(record.coordinates))
    for item in record.drives:
        actuator = record.machine.actuators.get(record.coordinate_label(item.coordinate))
        numbers[item.coordinate.index] = actuator.inertia if actuator else 0.0
    return numbers
