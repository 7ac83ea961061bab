"""What passes through every joint where links bend: the structure decides what rigid links leave open.

Weight and inertia act on the bars where they are, spread evenly, and on the other links as on rigid bodies. Beams and
actuators then say what each body bears, and the joints what must pass for its balance. Loops that rigid links close
may still leave some of it open.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.machine.elasticity.beams import consistent_load
from assur.machine.elasticity.strains import Strains, strains
from assur.machine.elasticity.structure import ElasticStructure, structure
from assur.machine.elasticity.structure_masses import (
    beam_motion,
    body_motion,
    body_on_beam,
    centre_of,
    rigid_bodies,
    section_beside,
)
from assur.machine.forces.actuator_forces import ActuatorForces
from assur.machine.forces.reactions import OPEN, RANK, about_origin, child_points, joint_wrenches
from assur.machine.masses.link_masses import bar_weights, masses
from assur.machine.masses.rigid_body import RigidBody
from assur.machine.motion.screws import joint_screws, paths, screw_rates

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Acceleration:
    """How the points of a link speed up beside what falls: at (3,) of the base's origin, and how that grows (3, 3).

    `turning` is the angular velocity, `second` its rate.
    """

    origin: FloatArray
    growth: FloatArray
    turning: FloatArray
    second: FloatArray

    def at(self, point: FloatArray) -> FloatArray:
        """Of a point (3,) in the base frame, in m/s2."""
        return np.asarray(self.origin + self.growth @ point)


def elastic_reactions(answer: ActuatorForces, *, shear: bool = True) -> Mapping[str, FloatArray | None]:
    """Force and moment (6,) in each joint at the first configuration of an answer, from parent to child.

    They are at the child's joint point along the base's axes, as those of rigid links are; None where rigid links
    leave a number open, everywhere where the actuators do not hold the platform.

    Errors:
        UsageError: an actuator without stiffness, and what else `structure` refuses.

    >>> from assur.machine.forces.actuator_forces import forces
    >>> from assur.model.registry import load_record
    >>> answer = forces(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315], load=[0, 0, -100], gravity=False)
    >>> elastic_reactions(answer)["D1"][:3].round(3).tolist()  # statics alone decides here
    [27.757, -7.225, 52.185]
    """
    record = answer.record
    own = structure(record, shear=shear)
    state = strains(own, answer.values[:1])
    if not state.held[0]:
        return dict.fromkeys(record.joints)
    bodies, fields = rigid_bodies(own, masses(record)), _accelerations(answer)
    on_beams = [_beam_load(state, place, fields[beam.link]) for place, beam in enumerate(own.beams)]
    on_bodies = {link: _body_load(state, link, body, fields[link]) for link, body in bodies.items()}
    turning = _turning(own, answer.joint_accelerations[0])
    work = state.platform[0].T @ np.concatenate([answer.load.force, answer.load.moment])
    work[own.coordinates] -= turning * state.scales
    for link in on_bodies.keys() & own.skeletons.keys():
        place, _ = section_beside(own, link, bodies[link])
        on_beams[place] = on_beams[place] + body_on_beam(state, link, bodies[link]).T @ on_bodies.pop(link)
    for place, load in enumerate(on_beams):
        work += beam_motion(state, place).T @ load
    for link, wrench in on_bodies.items():
        work += body_motion(state, link, bodies[link]).T @ wrench
    moved = state.displaced(work[None, :, None])[0, :, 0]
    borne = _borne_by_beams(state, moved, on_beams)
    for link, wrench in on_bodies.items():
        borne[own.bodies.index((link, 0))] += _about(wrench[3:], wrench[:3], centre_of(state, link, bodies[link]))
    borne[own.platform] += _about(answer.load.force, answer.load.moment, state.point[0])
    stretched = state.scales * moved[own.coordinates]
    return _passed(state, answer.values[:1], borne, own.springs.efforts(stretched) - turning)


def _turning(structure: ElasticStructure, second: FloatArray) -> FloatArray:
    """What rotors need of their drives (w,) at joint accelerations (n,), that behind a gear as much as at its input."""
    rotors = structure.springs.rotors
    between = np.zeros(len(rotors) - len(second) - len(structure.springs.before))
    return np.asarray(rotors * np.concatenate([second, between, second[list(structure.springs.before)]]))


def _accelerations(answer: ActuatorForces) -> dict[str, Acceleration]:
    """Of every link, less what falls freely."""
    record, values = answer.record, answer.values[:1]
    rates, second = answer.joint_rates[0], answer.joint_accelerations[0]
    screws, signs = joint_screws(record, values), paths(record).of_links
    changes = screw_rates(record, screws, rates[None])[0] + screws[0].T * second[:, None]  # (n, 6)
    twists, speeding = signs @ (screws[0] * rates).T, signs @ changes
    falling = masses(record).gravity if answer.load.gravity else np.zeros(3)
    fields = {}
    for link, twist, change in zip(paths(record).links, twists, speeding, strict=True):
        turning, second_turn = _cross(twist[:3]), _cross(change[:3])
        origin = change[3:] + turning @ twist[3:] - falling
        fields[link] = Acceleration(origin, second_turn + turning @ turning, twist[:3], change[:3])
    return fields


def _beam_load(state: Strains, place: int, field: Acceleration) -> FloatArray:
    """Load (12,) on a beam, on the twist of its first end and on its strain, in its axes."""
    beam = state.structure.beams[place]
    weights = bar_weights(state.structure.record, beam.link)
    load = np.zeros(12)
    if weights is None:
        return load
    per_metre, polar = weights
    axes, along = state.beam_axes[0, place], state.beam_axes[0, place, :, 0]
    first = state.beam_ends[0, place] - beam.beam.length * along
    density = np.zeros((2, 4))
    density[0, :3] = -per_metre * axes.T @ field.at(first)
    density[1, :3] = -per_metre * axes.T @ (field.growth @ along)
    density[0, 3] = -polar * along @ field.second
    load += np.einsum("kia,ka->i", consistent_load(beam.beam), density)
    tilting = -polar * beam.beam.length * axes.T @ ((along @ field.turning) * np.cross(field.turning, along))
    load[:3] += tilting  # of the spinning bar that is tilted, half at either end
    load[6:9] += 0.5 * tilting
    return load


def _body_load(state: Strains, link: str, body: RigidBody, field: Acceleration) -> FloatArray:
    """Moment about its centre, and force (6,), of weight and inertia on a rigid body of a link."""
    turn = state.frames[link][0][0]
    tensor = turn @ body.inertia @ turn.T
    moment = tensor @ field.second + np.cross(field.turning, tensor @ field.turning)
    return -np.concatenate([moment, body.mass * field.at(centre_of(state, link, body))])


def _borne_by_beams(state: Strains, moved: FloatArray, loads: list[FloatArray]) -> FloatArray:
    """Force, and moment about the base's origin (B, 6), that beams exert on each body, as displaced."""
    own = state.structure
    total = np.zeros((len(own.bodies), 6))
    for place, (beam, load) in enumerate(zip(own.beams, loads, strict=True)):
        strain = state.units * (state.of_beams[0, place] @ moved)
        axes, second = state.beam_axes[0, place], state.beam_ends[0, place]
        needed = np.concatenate([np.zeros(6), beam.beam.stiffness @ strain]) - load
        at_second = _about(axes @ needed[9:], axes @ needed[6:9], second)
        whole = _about(axes @ needed[3:6], axes @ needed[:3], second - beam.beam.length * axes[:, 0])
        total[beam.bodies[1]] -= at_second
        total[beam.bodies[0]] -= whole - at_second
    return total


def _passed(state: Strains, values: FloatArray, borne: FloatArray, efforts: FloatArray) -> dict[str, FloatArray | None]:
    """Force and moment (6,) of each joint at its child's point, from what each body bears beside; None where open.

    Args:
        state: the structure.
        values: (1, n) of the joints.
        borne: (B, 6) force, and moment about the base's origin, on each body from beams and loads.
        efforts: (w,) what drives and virtual joints pass along their coordinates.
    """
    own, record, length = state.structure, state.structure.record, state.length
    points = child_points(record, values)
    wrenches, owners, drives = joint_wrenches(record, joint_screws(record, values)[0], points, length)
    equations = np.zeros((len(own.bodies), 6, len(owners)))
    for column, joint in enumerate(owners):
        parent, child = own.sides[joint]
        at_base = about_origin(wrenches[:, column], points[joint] / length)
        equations[child, :, column] += at_base
        equations[parent, :, column] -= at_base
    balance = equations[1:].reshape(-1, len(owners))  # the base bears whatever it is
    along, stretching = _along_virtual_joints(state, wrenches, owners, efforts)
    matrix = np.concatenate([balance, along])
    right = np.concatenate([-(borne[1:] / np.repeat([1.0, length], 3)).reshape(-1), stretching])
    solution = np.zeros(len(owners))
    for (column, scale), item in zip(drives, record.drives, strict=True):
        solution[column] = item.sign * efforts[item.coordinate.index] * scale
    rest = np.setdiff1d(np.arange(len(owners)), [column for column, _ in drives])
    left, sizes, across = np.linalg.svd(matrix[:, rest], full_matrices=True)
    rank = int(np.sum(sizes > RANK * sizes[0]))
    needed = left[:, :rank].T @ (right - matrix @ solution)
    solution[rest] = across[:rank].T @ (needed / sizes[:rank])
    stresses = np.zeros((len(owners), len(rest) - rank))
    stresses[rest] = across[rank:].T
    passed: dict[str, FloatArray | None] = {}
    for joint in record.joints:
        columns = [column for column, name in enumerate(owners) if name == joint]
        sure = np.max(np.abs(wrenches[:, columns] @ stresses[columns]), initial=0.0) <= OPEN
        wrench = wrenches[:, columns] @ solution[columns] * np.repeat([1.0, length], 3)
        passed[joint] = wrench if sure else None
    return passed


def _along_virtual_joints(
    state: Strains, wrenches: FloatArray, owners: list[str], efforts: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """What each virtual joint is passed (V, U) along its coordinates by wrenches (6, U), and by its efforts (V,)."""
    virtual = state.structure.virtual
    count = sum(len(joint.stiffness) for joint in virtual.values())
    along, first = np.zeros((count, len(owners))), 0
    for name, joint in virtual.items():
        turn = state.frames[joint.link][0][0]
        moves = np.concatenate([turn @ joint.twists[3:], turn @ joint.twists[:3]])
        columns = [column for column, owner in enumerate(owners) if owner == name]
        along[first : first + len(joint.stiffness), columns] = moves.T @ wrenches[:, columns]
        first += len(joint.stiffness)
    start = len(state.structure.record.coordinates)
    return along, efforts[start : start + count] / state.length


def _about(force: FloatArray, moment: FloatArray, point: FloatArray) -> FloatArray:
    """Force, and moment about the base's origin (6,), of a wrench at a point."""
    return np.concatenate([force, moment + np.cross(point, force)])


def _cross(vector: FloatArray) -> FloatArray:
    """The matrix (3, 3) of the product with a vector (3,)."""
    return np.asarray(-np.cross(np.eye(3), vector).T)
