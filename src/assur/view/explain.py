"""Why something cannot be reached: the limit, the singularity by what it means, and which leg misses by how much."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import held_inputs
from assur.kinematics.closure import CLOSED, assemble, characteristic_length, closing_system, residuals
from assur.kinematics.limits import Limit, limits
from assur.kinematics.paths.path import Path, Stop
from assur.model.joint_graph import frames, joint_graph
from assur.model.mechanism import Joint, MechanismRecord
from assur.model.pose import LENGTHS, rate_names
from assur.numerics import least_squares

FloatArray = NDArray[np.float64]
FIRM = 1e3
"""How much more a gap at the platform weighs than one in a loop, so that the loops show what is missing."""

MISSED = 1e3 * CLOSED
"""Gap from which on a leg misses, as a share of the characteristic length."""

STRAIGHT = 0.7
"""Cosine from which on a gap counts as one along the leg."""


@dataclass(frozen=True)
class Reason:
    """Why a change stopped.

    Attributes:
        kind: "limit", "dimension", "input", or the kind of a singularity (`assur.kinematics.paths.path.Stop`).
        text: one line for a person.
    """

    kind: str
    text: str

    def __str__(self) -> str:
        return self.text


def explain(path: Path, wanted: FloatArray) -> Reason | None:
    """Why a path ended before the inputs or the pose (k,) that were wanted; None where it did not.

    >>> from assur.kinematics.home import home_values
    >>> from assur.kinematics.paths.following import follow
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> path = follow(record, home_values(record), poses=[0.0, 300.0])
    >>> print(explain(path, np.array([0.0, 300.0])))
    serial singularity: A1, B1, P are collinear; A2, B2, P are collinear; leg1 is 14.1 mm too short
    """
    stop = path.stopped
    if stop is None:
        return None
    if stop.kind == "limit":
        return Reason("limit", _limit(path.record, stop))
    if stop.kind == "unreachable":
        return Reason(stop.kind, "no motion of the mechanism does this")
    name = stop.kind.replace("_", "-")
    head = (
        "the steps became too small"
        if stop.kind == "undecided"
        else f"{name} singularity"
        if name != "self-motion"
        else name
    )
    said = [f"{head}: {stop.meaning}" if stop.meaning else head]
    missing = gap(path, wanted)
    if missing:
        said.append(missing)
    return Reason(stop.kind, "; ".join(said))


def _limit(record: MechanismRecord, stop: Stop) -> str:
    """Which bound is met, and its value."""
    bounds = limits(record, stop.joints)
    met = min(bounds, key=lambda bound: float(bound.margin(stop.joints)))
    value = float(met.value(stop.joints))
    end = met.low if abs(value - met.low) < abs(value - met.high) else met.high
    return f"{met.name} ends at {_number(record, met, end)}"


def _number(record: MechanismRecord, bound: Limit, value: float) -> str:
    if not bound.angular:
        return f"{value:.5g} {record.unit}"
    return f"{math.degrees(value):.4g} deg" if record.angle == "deg" else f"{value:.4g} rad"


def gap(path: Path, wanted: FloatArray) -> str:
    """Which leg or loop stays open at what was wanted, and by how much; "" where all of them close."""
    record, start = path.record, path.joints[-1]
    if path.prescribed == "poses":
        return _open_legs(record, start, wanted)
    held = held_inputs(record, start, wanted)
    found = assemble(record, held, held=record.input_indices)
    if bool(found.closed):
        return ""
    gaps = np.linalg.norm(residuals(record, found.values)[:, :3], axis=-1)
    joint = joint_graph(record).cut[int(np.argmax(gaps))]
    return f"the loop closed by {joint.name} stays open by {_length(record, float(found.residual))}"


def _open_legs(record: MechanismRecord, start: FloatArray, pose: FloatArray) -> str:
    """A leg that misses the platform where that is wanted at a pose (m,): the carrying one, else the worst.

    What the others miss is only known where the carrying one can bring the platform there.
    """
    values = _at_platform(record, start, pose)
    rows = closing_system(record, values[None], pose[None])[0][0]
    graph, length = joint_graph(record), characteristic_length(record)
    lengths = np.array([name in LENGTHS for name in rate_names(record.platform.pose)])
    at_platform = float(np.linalg.norm(rows[6 * len(graph.cut) :][lengths]))
    gaps = rows[: 6 * len(graph.cut)].reshape(-1, 6)[:, :3]
    sizes = np.linalg.norm(gaps, axis=-1)
    if at_platform > MISSED * length:
        return f"{_leg(record, None)} is {_length(record, at_platform)} {_carrying_sense(record, values, pose)}"
    if float(np.max(sizes, initial=0.0)) <= MISSED * length:
        return ""
    worst = int(np.argmax(sizes))
    return (
        f"{_leg(record, worst)} is {_length(record, float(sizes[worst]))} {_sense(record, values, worst, gaps[worst])}"
    )


def _at_platform(record: MechanismRecord, start: FloatArray, pose: FloatArray) -> FloatArray:
    """Joint values (n,) that bring the platform to a pose (m,) first, and close the loops as far as can be then."""
    size = characteristic_length(record)
    scale = np.array([size if item.kind == "length" else 1.0 for item in record.coordinates])
    weights = np.ones(6 * len(joint_graph(record).cut) + len(rate_names(record.platform.pose)))
    weights[6 * len(joint_graph(record).cut) :] = FIRM

    def system(trial: FloatArray, rows: NDArray[np.intp]) -> tuple[FloatArray, FloatArray]:
        gaps, derivative = closing_system(record, trial * scale, np.broadcast_to(pose, (len(rows), len(pose))))
        return gaps * weights / size, derivative * scale * weights[:, None] / size

    found = least_squares.minimise(system, (start / scale)[None], tolerance=1e-12, max_steps=300)
    return np.asarray(found.x[0] * scale)


def _leg(record: MechanismRecord, cut: int | None) -> str:
    """Name of the leg that a cut joint closes, None for the one that carries the platform in the tree."""
    graph = joint_graph(record)
    carrying = list(graph.paths[record.platform.link])
    if cut is None:
        return _named(record, carrying)
    joint = graph.cut[cut]
    own = [name for name in graph.loops[cut] if name not in carrying]
    return _named(record, [joint.name, *own])


def _named(record: MechanismRecord, joints: list[str]) -> str:
    """The chain of the file, or the repeated limb, that most of the joints belong to; else its first joint's loop."""
    for chain in record.chains.values():
        if any(name in (*chain.serial, *chain.loop, *chain.tail) for name in joints):
            return chain.name
    links = [link for name in joints for link in (record.joints[name].parent, record.joints[name].child)]
    limbs = [link.partition(".")[0] for link in links if "." in link]
    return limbs[0] if limbs else f"the leg of {joints[0]}"


def _carrying_sense(record: MechanismRecord, values: FloatArray, pose: FloatArray) -> str:
    """Whether the leg that carries the platform is too short to bring it to a pose (m,), or too long."""
    rotation, origin = frames(record, values)[record.platform.link]
    reached = rotation @ record.platform.point + origin
    named = dict(zip(record.platform.pose, pose.tolist(), strict=True))
    wanted = np.array([named.get(name, here) for name, here in zip(LENGTHS, reached, strict=True)])
    root = _root(record, list(joint_graph(record).paths[record.platform.link]))
    return "too short" if np.linalg.norm(wanted - root) >= np.linalg.norm(reached - root) else "too long"


def _root(record: MechanismRecord, names: list[str]) -> FloatArray:
    """The point (3,) of the base on which a chain of joints stands."""
    root = next(record.joints[name] for name in names if record.base in _links(record.joints[name]))
    return root.at if root.parent == record.base else root.child_at


def _sense(record: MechanismRecord, values: FloatArray, cut: int, gap: FloatArray) -> str:
    """Whether the leg of a cut joint is too short, too long, or off to the side."""
    graph = joint_graph(record)
    joint, placed = graph.cut[cut], frames(record, values)
    carrying = set(graph.paths[record.platform.link])
    with_platform = [link for link in (joint.child, joint.parent) if carrying <= set(graph.paths[link])]
    if len(with_platform) != 1:
        return "off"
    outer = with_platform[0]
    inner = joint.parent if outer == joint.child else joint.child
    missing = -gap if outer == joint.child else gap  # from the leg's side to the platform's
    roots = list(graph.paths[inner]) or [joint.name]
    rotation, origin = placed[record.platform.link]
    way = rotation @ record.platform.point + origin - _root(record, roots)
    cosine = float(missing @ way) / max(float(np.linalg.norm(missing) * np.linalg.norm(way)), 1e-300)
    return "too short" if cosine > STRAIGHT else "too long" if cosine < -STRAIGHT else "off"


def _links(joint: Joint) -> tuple[str, str]:
    return joint.parent, joint.child


def _length(record: MechanismRecord, value: float) -> str:
    return f"{value:.3g} {record.unit}"
