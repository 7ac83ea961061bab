"""Mechanisms whose links bend, with profiles at random, and their compliance by another route.

That route knows beams by the matrix of the textbook for twelve displacements, and joints by multipliers.
"""

from dataclasses import replace
from functools import lru_cache
from itertools import pairwise

import numpy as np
from scipy.linalg import block_diag

from assur.joint_graph.frames import frames, screws
from assur.kinematics.pose import platform_frame
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.strains import strains
from assur.machine.elasticity.structure import structure
from assur.machine.masses.bars import joint_points
from assur.machine.motion.screws import rate_units
from assur.model.machine_data import Actuator, Gear, LinkData, MachineData, Material, Profile


@lru_cache
def given(record, shear=True):
    """The same with the compliance of each bar that is alone in its link by hand: that of the textbook's far end."""
    machine, links = record.machine, dict(record.machine.links)
    bars = [beam.link for beam in structure(record).beams]
    for beam in structure(record).beams:
        data = links[beam.link]
        if bars.count(beam.link) == 1:
            matrix = textbook(machine.profiles[data.profile], machine.materials[data.material],
                              np.linalg.norm(beam.second - beam.first), shear)[6:, 6:]  # fmt: skip
            turn = np.kron(np.eye(2), beam.axes)
            by_hand = turn @ np.linalg.inv(matrix) @ turn.T
            links[beam.link] = replace(data, compliance=0.5 * (by_hand + by_hand.T), profile=None, kg_per_m=1.0)
    return replace(record, machine=replace(machine, links=links))


@lru_cache
def yielding(record, seed=0, ways=None):
    """The record with joints that give way in one to six ways, or as many as are told, and gears that yield."""
    random = np.random.default_rng(seed)
    size = np.repeat([1e-3, 1e-2], 3)  # of the square roots of m/N and rad/(N m)
    compliances = {}
    for place, name in enumerate(record.joints):
        roots = size[:, None] * random.normal(size=(6, ways or 1 + place % 6))
        compliances[name] = roots @ roots.T
    actuators = {
        label: replace(actuator, rotor=0.1, gear=Gear(20.0, random.uniform(1e4, 1e6), 1e-3))
        for label, actuator in record.machine.actuators.items()
    }
    return replace(record, machine=replace(record.machine, compliances=compliances, actuators=actuators))


@lru_cache
def bending(record, factor=1.0, seed=0):
    """The record with bars between all joints of each link, one after the other, of odd sections and materials.

    Links weigh as their bars do, others a kilogram. All E are multiplied by a factor.
    """
    random = np.random.default_rng(seed)
    materials, profiles, links = {}, {}, {}
    for link in record.links:
        names = _apart(joint_points(record, link))
        if link == record.base or len(names) < 2:
            links[link] = LinkData(mass=1.0)
            continue
        width, depth = random.uniform(0.01, 0.03, size=2)
        materials[link] = Material(link, 5000.0, factor * random.uniform(50e9, 250e9), random.uniform(0.1, 0.4))
        profiles[link] = Profile(link, "box", (width, depth), width * depth, width * depth**3 / 12,
                                 depth * width**3 / 12, 0.2 * width * depth**3, up=random.normal(size=3))  # fmt: skip
        links[link] = LinkData(profile=link, material=link, bars=tuple(pairwise(names)))
    actuators = {
        record.coordinate_label(item.coordinate): Actuator(stiffness=random.uniform(1e4, 1e6)) for item in record.drives
    }
    return replace(record, machine=MachineData(materials, profiles, links=links, actuators=actuators))


def by_multipliers(record, values, shear=True, off=None):
    """Compliance (6, 6), displacement before rotation, at joint values (n,), and what joints pass under unit wrenches.

    What a joint's parent passes to its child is (6, 6) force and moment about the platform's point, but for drives.
    With joints that are `off` by twists (J, 6, k), as of `elastic_errors`, how far the platform moves (6, k), in SI.
    """
    own = structure(record)
    metre = METRES[record.unit]
    placed = {link: (turn[0], metre * at[0]) for link, (turn, at) in frames(record, values[None]).items()}
    at = [placed[link][1] + (placed[link][0] @ own.skeletons[link].nodes[node] if link in own.skeletons else 0.0)
          for link, node in own.bodies]  # fmt: skip
    count = 6 * len(at)
    held_by = _held_by(record)
    whole = np.zeros((count, count))
    for beam in own.beams:
        data = record.machine.links[beam.link]
        first, second = beam.bodies
        turned = placed[beam.link][0] @ beam.axes
        matrix = textbook(record.machine.profiles[data.profile], record.machine.materials[data.material],
                          np.linalg.norm(at[second] - at[first]), shear)  # fmt: skip
        turn = np.kron(np.eye(4), turned)
        own_places = [*range(6 * first, 6 * first + 6), *range(6 * second, 6 * second + 6)]
        whole[np.ix_(own_places, own_places)] += turn @ matrix @ turn.T
    rows, owners, softness = [np.eye(6, count)], {}, [np.zeros((6, 6))]  # the base stands still
    moves = screws(record, values[None])[0]
    moves[3:] *= metre
    moves /= rate_units(record)
    point = metre * platform_frame(record, values[None])[1][0]
    off = np.zeros((len(record.joints), 6, 0)) if off is None else off
    shifts = metre * off[:, 3:] + np.cross(off[:, :3], point, axisa=1, axisb=0, axisc=1)
    off = np.concatenate([shifts, off[:, :3]], axis=1)
    gaps, forces = [np.zeros((6, off.shape[2]))], np.zeros((count, off.shape[2]))
    for (name, (parent, child)), error in zip(own.sides.items(), off, strict=True):
        apart = _twist_at(at[child], child, count, point) - _twist_at(at[parent], parent, count, point)
        own_moves = moves[:, [item.index for item in record.joint_coordinates(name)]]
        own_moves = np.concatenate(
            [own_moves[3:] + np.cross(own_moves[:3], point, axis=0).reshape(3, -1), own_moves[:3]]
        )
        compliance = record.machine.compliances.get(name)
        indices = [item.index for item in record.joint_coordinates(name)]
        if compliance is not None:  # a driven coordinate is then one more way in which the joint yields
            compliance = carried(compliance, record.joints[name], placed[record.joints[name].child], (point, metre))
            driven = [place for place, index in enumerate(indices) if index in held_by]
            for move, place in zip(own_moves.T[driven], driven, strict=True):
                compliance = compliance + np.outer(move, move) / held_by[indices[place]]
            own_moves, indices = np.delete(own_moves, driven, axis=1), np.delete(indices, driven)
        held = np.linalg.svd(own_moves)[0][:, own_moves.shape[1] :] if own_moves.size else np.eye(6)
        softness.append(np.zeros((held.shape[1],) * 2) if compliance is None else held.T @ compliance @ held)
        owners[name] = held, slice(sum(map(len, rows)), sum(map(len, rows)) + held.shape[1])
        rows.append(held.T @ apart)
        gaps.append(held.T @ error)
        inverse = np.linalg.pinv(own_moves) if own_moves.size else ()
        for row, index in zip(inverse, indices, strict=True):
            whole += held_by.get(index, 0.0) * np.outer(row @ apart, row @ apart)
            forces += held_by.get(index, 0.0) * np.outer(row @ apart, row @ error)
    constraints = np.concatenate(rows)
    saddle = np.block([[whole, constraints.T], [constraints, -block_diag(*softness)]])
    scale = np.ones(len(saddle))
    for _ in range(20):  # rows and columns brought to 1
        scale /= np.sqrt(np.abs(scale * saddle * scale[:, None]).max(axis=0))
    platform = _twist_at(at[own.platform], own.platform, count, point)
    loads = np.concatenate([platform.T, np.zeros((len(constraints), 6))])
    if off.shape[2]:
        loads = np.concatenate([forces, *gaps])
    solution = scale[:, None] * np.linalg.lstsq(scale * saddle * scale[:, None], scale[:, None] * loads, rcond=1e-13)[0]
    passed = {name: -held @ solution[count:][own_rows] for name, (held, own_rows) in owners.items()}
    return platform @ solution[:count], passed


def textbook(profile, material, length, shear):
    """Timoshenko's beam (12, 12): displacements and rotations of its first end, then of its second."""
    elasticity, rigidity = material.elasticity, material.elasticity / (2 * (1 + material.poisson))
    whole = np.zeros((12, 12))
    for place, value in ((0, elasticity * profile.area), (3, rigidity * profile.torsion)):
        whole[np.ix_([place, place + 6], [place, place + 6])] = value / length * np.array([[1, -1], [-1, 1]])
    for push, turn, second, sense in ((1, 5, profile.iz, 1), (2, 4, profile.iy, -1)):
        bend = elasticity * second
        phi = 12 * bend / (rigidity * 5 / 6 * profile.area * length**2) if shear else 0.0
        a, b = 12.0, 6.0 * length * sense
        c, d = (4 + phi) * length**2, (2 - phi) * length**2
        matrix = np.array([[a, b, -a, b], [b, c, -b, d], [-a, -b, a, -b], [b, d, -b, c]])
        whole[np.ix_([push, turn, push + 6, turn + 6], [push, turn, push + 6, turn + 6])] = (
            bend / length**3 / (1 + phi) * matrix
        )
    return whole


def serial_limbs(record):
    """The links of each limb; none where a limb has loops or branches."""
    held = {record.base, record.platform.link}
    limbs = []
    for start in record.joints.values():
        if start.parent == record.base and start.child not in held:
            limbs.append({start.child})
            for _ in record.links:
                for joint in record.joints.values():
                    if {joint.parent, joint.child} & limbs[-1]:
                        limbs[-1] |= {joint.parent, joint.child} - held
    ends = [link for joint in record.joints.values() for link in (joint.parent, joint.child)]
    inner = [link for limb in limbs for link in limb]
    alone = len(set(inner)) == len(inner) == len(record.links) - 2
    return limbs if alone and {ends.count(link) for link in inner} == {2} else []


def by_limbs(record, values, limbs):
    """Compliance (6, 6) at the platform's point, displacement before rotation, by virtual joints of serial limbs."""
    units = np.repeat([strains(structure(record), values).length, 1.0], 3)
    passed, forms = [], []
    for links in limbs:
        compliance, passive = _limb(record, values, links)
        left, sizes, _ = np.linalg.svd(passive / units[:, None])
        passed.append(left[:, np.sum(sizes > 1e-9 * sizes[0]) :])  # wrenches that do no work in passive joints
        forms.append(passed[-1].T @ (compliance / units / units[:, None]) @ passed[-1])
    whole = np.concatenate(passed, axis=1)
    size = max(form.max() for form in forms)
    saddle = np.block([[block_diag(*forms) / size, -whole.T], [whole, np.zeros((6, 6))]])
    loads = np.concatenate([np.zeros((len(saddle) - 6, 6)), np.eye(6)])
    return size * np.linalg.lstsq(saddle, loads, rcond=1e-14)[0][-6:] * units * units[:, None]


def _limb(record, values, links):
    """Compliance (6, 6) of a serial limb at the platform's point, and how its passive joints move it (6, p)."""
    own = structure(record)
    state = strains(own, values)
    point = state.point[0]
    moves = screws(record, values)[0]
    moves[3:] *= METRES[record.unit]
    moves /= rate_units(record)
    moves = np.concatenate([moves[3:] + np.cross(moves[:3], point, axis=0), moves[:3]])
    compliance, passive, held_by = np.zeros((6, 6)), np.zeros((6, 0)), _held_by(record)
    for item in record.coordinates:
        joint = record.joints[item.joint]
        if {joint.parent, joint.child} & links:
            move = moves[:, [item.index]]
            if item.index in held_by:
                compliance += move @ move.T / held_by[item.index]
            else:
                passive = np.concatenate([passive, move], axis=1)
    for name, softness in record.machine.compliances.items():
        joint = record.joints[name]
        if {joint.parent, joint.child} & links:
            placed = tuple(part[0] for part in state.frames[joint.child])
            compliance += carried(softness, joint, placed, (point, METRES[record.unit]))
    for number, beam in enumerate(own.beams):
        if beam.link in links:
            turn, lever = state.beam_axes[0, number], point - state.beam_ends[0, number]
            moved = np.zeros((6, 6))  # displacement and rotation at the platform per strain
            moved[3:, :3], moved[:3, 3:] = turn, turn
            moved[:3, :3] = np.cross(turn, lever, axis=0)
            compliance += moved @ beam.beam.parts.sum(axis=0) @ moved.T
    return compliance, passive


def carried(compliance, joint, placed, seen):
    """The compliance (6, 6) of a joint whose child is placed so (3, 3), (3,), seen from a point (3,) in metres."""
    (turn, origin), (point, metre) = placed, seen
    lever = point - origin - turn @ joint.child_at * metre
    moved = np.block([[turn, np.cross(turn, lever, axis=0)], [np.zeros((3, 3)), turn]])
    return moved @ compliance @ moved.T


def _held_by(record):
    """Stiffness of each driven joint coordinate, actuator and gear in series."""
    held_by = {}
    for item in record.drives:
        own = record.machine.actuators[record.coordinate_label(item.coordinate)]
        yields = 1.0 / own.stiffness + (1.0 / own.gear.stiffness if own.gear else 0.0)
        held_by[item.coordinate.index] = 1.0 / yields
    return held_by


def _apart(points):
    """Names of points, one of each place."""
    kept = {}
    for name, point in points.items():
        if all(np.linalg.norm(point - known) > 1e-9 for known in kept.values()):
            kept[name] = point
    return list(kept)


def _twist_at(own, body, count, point):
    """Displacement, then rotation (6, count) at a point of a body that is at `own`."""
    moved = np.zeros((6, count))
    lever = point - own
    moved[:, 6 * body : 6 * body + 6] = np.eye(6)
    moved[:3, 6 * body + 3 : 6 * body + 6] = np.cross(np.eye(3), lever).T
    return moved
