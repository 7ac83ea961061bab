"""Our mechanics against an engine's: poses, loops, inputs, freedoms, Jacobians, its own way to an assembly, forces.

Lengths are compared as shares of the characteristic length, turns in rad, Jacobians relative to their largest entry
where that is over 1.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.crosscheck import engine as engines
from assur.crosscheck.engine import Engine
from assur.crosscheck.projected_dynamics import BareBodies, bare_bodies, projected_forces
from assur.crosscheck.samples import SolvedConfiguration, configurations
from assur.errors import Interrupted
from assur.joint_graph.frames import Frame, frames
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.kinematics.closure import mobility
from assur.kinematics.rates.velocity import velocity_map, velocity_map_at
from assur.kinematics.status import Status
from assur.kinematics.turns import periodic_inputs
from assur.machine.forces.actuator_forces import forces_at
from assur.machine.forces.loads import load_of
from assur.machine.masses.link_masses import masses
from assur.model.mechanism import MechanismRecord
from assur.model.pose import LENGTHS, rate_names
from assur.numerics import rotations
from assur.results.answers.comparison import ComparedKind, CrossCheckAnswer

FloatArray = NDArray[np.float64]
EngineName = Literal["mujoco"]

PUSHES = (1e-3, 1e-4, 1e-5)
"""How far the engine's own search for an assembly starts from ours, in rad and characteristic lengths.

The nearer ones are for where another assembly lies next to ours; a false one of ours would not be found from there.
"""

FAST = 0.3
"""Characteristic lengths, and rad, per second of motions in which forces are compared."""

LEAST_MOTION = 1e-3
"""Of the platform where inputs are locked and we say that it moves: its rate for a unit rate of the joints."""

TOLERANCES = {
    "frames of links": 1e-10,
    "loops": 1e-9,
    "inputs": 1e-10,
    "freedoms": 0.0,
    "self-motions": 0.0,
    "Jacobian, joint graph": 1e-6,
    "Jacobian, closed form": 1e-6,
    "assembly by the engine": 1e-8,
    "forces of actuators": 1e-6,
}
"""The largest difference of each kind that is taken for rounding; counts must be equal."""

MEANINGS = {
    "frames of links": "every link, the engine set to our joint values",
    "loops": "rows of the engine's constraints at our solutions",
    "inputs": "lengths of the actuators, against our inputs",
    "freedoms": "nullity of the engine's constraints, against ours",
    "self-motions": "the platform moves with inputs locked where we say so; 1: it does not",
    "Jacobian, joint graph": "rates of the pose per input rate, by screws",
    "Jacobian, closed form": "the same by the closed form",
    "assembly by the engine": "the platform where its Newton ends, inputs locked",
    "forces of actuators": "in motion under gravity and a load, by its masses and constraints; once in each mode",
}


def crosscheck(
    record: MechanismRecord, name: EngineName = "mujoco", *, samples: int = 20, seed: int = 0, text: str | None = None
) -> CrossCheckAnswer:
    """Compare our solutions at random poses and inputs with an engine that reads the exported file.

    Args:
        record: the mechanism.
        name: the engine; MuJoCo is the only one.
        samples: random poses; each mode's solutions at them, and those at inputs that reach one of them.
        seed: of the random generator.
        text: an MJCF file to be loaded in place of the exported one.

    Errors:
        UsageError: the engine is not installed. Whatever the direct and the inverse problem raise.
        Interrupted: Ctrl-C; its answer is what was compared so far.
    """
    whole, record = record, record.determined  # whose inputs' rates the engine can choose one by one
    rng = np.random.default_rng(seed)
    there = engines.engine(record, text)
    own = None if masses(record).lacking else bare_bodies(there)
    weighed: set[tuple[str, str]] = set()  # forces take longer than all the rest: once in each mode
    found = configurations(record, samples, rng)
    total = len(found)
    largest: dict[str, tuple[float, str]] = {}
    count: Counter[str] = Counter()
    done = 0
    try:
        for item in found:
            sizes = _compared(there, item, rng)
            if own is not None and item.status == Status.regular and (item.problem, item.mode) not in weighed:
                sizes |= _forces_apart(whole, there, own, item, rng)
                weighed.add((item.problem, item.mode))
            for kind, size in sizes.items():
                count[kind] += 1
                size = np.inf if np.isnan(size) else size
                if size > largest.get(kind, (-1.0, ""))[0]:
                    largest[kind] = (size, f"{item.problem} {item.mode}".strip())
            done += 1
    except KeyboardInterrupt:
        found = found[:done]
    differences = tuple(
        ComparedKind(kind, largest[kind][0], limit, count[kind], largest[kind][1], MEANINGS[kind])
        for kind, limit in TOLERANCES.items()
        if kind in largest
    )
    modes = {
        problem: dict(sorted(Counter(item.mode for item in found if item.problem == problem).items()))
        for problem in ("direct", "inverse")
    }
    answer = CrossCheckAnswer(record.name, name, there.version, samples, seed, modes, differences)
    if done < total:
        raise Interrupted(answer)
    return answer


def _compared(engine: Engine, sample: SolvedConfiguration, rng: np.random.Generator) -> dict[str, float]:
    """Every difference at one configuration, by kind."""
    record = engine.record
    engines.put(engine, sample.joints)
    ours, theirs = frames(record, sample.joints), engines.link_frames(engine)
    residual, _ = engines.constraints(engine)
    found = {
        "frames of links": max(_apart(engine, ours[link], theirs[link]) for link in record.links),
        "loops": float(np.max(np.abs(residual), initial=0.0)),
        "inputs": _inputs_apart(engine, sample),
    }
    if sample.status == Status.self_motion:
        _, _, open_ = engines.platform_jacobian(engine)
        return found | {"self-motions": float(open_ < LEAST_MOTION)}
    if sample.status != Status.regular:
        return found
    found["freedoms"] = float(abs(engines.freedoms(engine) - int(mobility(record, sample.joints).freedoms)))
    jacobian, missed, open_ = engines.platform_jacobian(engine)
    for kind, ours_ in _jacobians(record, sample).items():
        scale = max(1.0, float(np.max(np.abs(ours_))))
        found[kind] = max(missed, open_, float(np.max(np.abs(jacobian - ours_)))) / scale
    found["assembly by the engine"] = _settled(engine, sample, ours[record.platform.link], rng)
    return found


def _forces_apart(
    record: MechanismRecord, engine: Engine, own: BareBodies, sample: SolvedConfiguration, rng: np.random.Generator
) -> dict[str, float]:
    """How far forces of all drives are from the engine's, as a share of the largest; none near singularities."""
    lengths = np.array([engine.bodies.size if name in LENGTHS else 1.0 for name in rate_names(record.platform.pose)])
    velocity, acceleration = FAST * rng.normal(size=(2, len(lengths))) * lengths
    wrench = rng.normal(size=6)
    ours = forces_at(record, sample.joints[None], load_of(wrench), velocity[None], acceleration[None])
    if ours.status[0] != Status.regular:
        return {}
    theirs = projected_forces(record, engine, own, sample.joints, (velocity, acceleration), wrench)
    size = max(float(np.max(np.abs(ours.forces))), float(np.max(np.abs(theirs))))
    return {"forces of actuators": float(np.max(np.abs(ours.forces[0] - theirs))) / size}


def _settled(engine: Engine, sample: SolvedConfiguration, ours: Frame, rng: np.random.Generator) -> float:
    """How far the platform is from ours where the engine's Newton ends, from the farthest start that comes back."""
    apart = np.inf
    for push in PUSHES:
        engines.put(engine, sample.joints)
        if engines.settle(engine, push * rng.uniform(-1, 1, size=engine.model.nv)):
            apart = min(apart, _apart(engine, ours, engines.link_frames(engine)[engine.record.platform.link]))
        if apart <= TOLERANCES["assembly by the engine"]:
            break
    return apart


def _apart(engine: Engine, ours: Frame, theirs: Frame) -> float:
    """Distance of two frames: entries of orientations, and origins as shares of the characteristic length."""
    metre, size = engine.bodies.metre, engine.bodies.size
    away = np.max(np.abs(metre * ours[1] - theirs[1])) / size
    return float(max(away, np.max(np.abs(ours[0] - theirs[0]))))


def _inputs_apart(engine: Engine, sample: SolvedConfiguration) -> float:
    """Largest difference of the printed inputs; angles whose turns do not count are the same after whole ones."""
    metre, size = engine.bodies.metre, engine.bodies.size
    angular = np.array([one.coordinate.kind == "angle" for one in engine.record.inputs])
    gap = engines.printed_inputs(engine) - np.where(angular, 1.0, metre) * sample.inputs
    gap = np.where(periodic_inputs(engine.record), rotations.nearest_turn(gap), gap)
    return float(np.max(np.abs(np.where(angular, gap, gap / size)), initial=0.0))


def _jacobians(record: MechanismRecord, sample: SolvedConfiguration) -> dict[str, FloatArray]:
    """Our rates (k, n) of the pose per input rate, lengths in units of the characteristic length, by each route."""
    length = characteristic_length(record)
    rows = np.array([length if name in LENGTHS else 1.0 for name in rate_names(record.platform.pose)])
    columns = joint_scales(record)[list(record.input_indices)]
    found = {"Jacobian, joint graph": velocity_map_at(record, sample.joints).matrix}
    if record.closed_form is not None and re.fullmatch(r"[+-]*", sample.working_mode):
        found["Jacobian, closed form"] = velocity_map(record, sample.pose, sample.working_mode).matrix
    return {kind: matrix * columns / rows[:, None] for kind, matrix in found.items()}
