"""Forces at a pose as data and as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes, weak
from assur.cli.lost import why_lost
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.positions import failures
from assur.cli.quantities import mode_words
from assur.errors import UsageError
from assur.kinematics.answers.at_border import mechanism_header, pose_at_border
from assur.kinematics.answers.style import style_of
from assur.kinematics.status import Status
from assur.machine.elasticity.elastic_reactions import elastic_reactions
from assur.machine.elasticity.structure import yields
from assur.machine.forces.actuator_forces import ActuatorForces, force_units
from assur.machine.forces.reactions import Reactions, reactions
from assur.machine.masses.link_masses import masses
from assur.machine.motion.screws import pose_metres, rate_metres
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS, rate_names
from assur.results.answers.forces import ForcesAnswer, ShownReaction
from assur.results.json_text import plain
from assur.results.plain_text import short

ROUNDED = 1e-12
AXES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
Elastic = Mapping[str, NDArray[Any] | None]
"""Wrenches of joints, force before moment."""
HELD = (Status.regular, Status.near_singular, Status.serial)
"""Where actuators hold the platform."""
SAID = {
    "serial": "the pose's rates are not free here: no mass matrix, bias and gravity per rate of the pose",
    "parallel": "the actuators do not hold the platform here: near it forces grow without bound",
    "comprehensive": "neither do the actuators hold the platform, nor is the pose free",
    "constraint": "the mechanism has more freedoms here than actuators",
    "undecided": "the rates of the pose do not say how the joints move here",
}


def outcome(
    record: Mechanism,
    pose: NDArray[Any],
    mode: str,
    wrench: Sequence[float],
    gravity: bool,
    motion: Sequence[Sequence[float]],
) -> Outcome:
    """Forces at a pose (m,), in lengths and rad, for a load in N and N m; velocity and acceleration as typed."""
    turned = [name not in LENGTHS for name in rate_names(record.platform.pose)]
    moves = [np.array(part) * np.where(turned, record.angle_unit, 1.0) for part in motion]
    velocity, acceleration = (part if any(np.any(part) for part in moves) else None for part in moves)
    solved = record.forces(pose, velocity, acceleration, wrench, gravity=gravity, mode=mode)
    status = Status(int(solved.status[0]))
    passed = reactions(solved) if status in HELD else None
    answer = _answer(record, pose, mode, moves, (solved, passed, _elastic(record, solved) if passed else {}))
    return Outcome(answer, lambda: _shown(record, answer), exit_codes.of_status(status.name))


def _answer(
    record: Mechanism,
    pose: NDArray[Any],
    mode: str,
    motion: Sequence[NDArray[Any]],
    solutions: tuple[ActuatorForces, Reactions | None, Elastic],
) -> ForcesAnswer:
    solved, passed, bent = solutions
    status = Status(int(solved.status[0]))
    lost = why_lost(record, pose, mode, status)
    return ForcesAnswer(
        **mechanism_header(record),
        pose=(pose * pose_metres(record)).tolist(),
        mode=mode,
        status=status.name,
        input_names=tuple(item.name for item in record.drives),
        load=[*solved.load.force.tolist(), *solved.load.moment.tolist()],
        under_gravity=solved.load.gravity,
        velocity=(motion[0] * rate_metres(record)).tolist(),
        acceleration=(motion[1] * rate_metres(record)).tolist(),
        actuator_forces=plain(solved.forces[0]),
        least_norm=solved.preload.shape[-1] > 0,
        preload=plain(solved.preload[0].T),
        friction=plain(solved.friction[0]),
        friction_band=solved.friction_band.tolist(),
        input_rates=plain(solved.input_rates[0]),
        kinetic_energy=plain(solved.kinetic_energy[0]),
        potential_energy=plain(solved.potential_energy[0]),
        power=plain(solved.power[0]),
        mass_matrix=plain(solved.mass_matrix[0]),
        bias=plain(solved.bias[0]),
        gravity=plain(solved.gravity[0]),
        growth=plain(solved.growth[0]) if status in HELD else None,
        weakest=weak.shown(solved),
        reactions=tuple(_reactions(passed, bent)),
        unknowns=passed.unknowns if passed else None,
        equations=passed.equations if passed else None,
        rank=passed.rank if passed else None,
        redundancy=passed.redundancy if passed else None,
        failures=lost.failures,
        notes=lost.notes or tuple(_notes(record, solved)),
        units=_units(record),
    )


def _elastic(record: Mechanism, solved: ActuatorForces) -> Elastic:
    """What joints pass where links bend, of a file that says what that asks for."""
    if not yields(record):
        return {}
    try:
        return elastic_reactions(solved)
    except UsageError:
        return {}


def _reactions(passed: Reactions | None, bent: Elastic) -> Iterable[ShownReaction]:
    for item in passed.joints if passed else ():
        wrench = bent.get(item.joint)
        yield ShownReaction(
            joint=item.joint,
            force=item.force.tolist(),
            moment=item.moment.tolist(),
            unique=tuple(item.unique.tolist()),
            indeterminate=tuple(row.tolist() for row in item.indeterminate),
            elastic=None if wrench is None else tuple(wrench.tolist()),
        )


def _notes(record: Mechanism, solved: ActuatorForces) -> Iterable[str]:
    status = Status(int(solved.status[0])).name
    if status in SAID:
        yield SAID[status]
    yield from weak.notes(solved)
    if solved.preload.shape[-1]:
        yield "more drives than freedoms: the forces of least norm; preload may be added"
    if solved.unbalanced[0] and status in ("regular", "near_singular", "serial"):
        yield "a freedom that nothing drives, as the spin of a rod, is not in balance: it is left to speed up"
    known = masses(record)
    if known.lacking:
        yield f"no mass is stated of {', '.join(known.lacking)}: no energies, no mass matrix"
    yield from known.notes


def _units(record: Mechanism) -> dict[str, str]:
    lengths = [name in LENGTHS for name in rate_names(record.platform.pose)]
    mixed = ", ".join
    forces = mixed(force_units(record))
    rates = mixed("m/s" if unit == "N" else "rad/s" for unit in force_units(record))
    of_pose = mixed("N" if length else "N m" for length in lengths)
    return {
        "pose": mixed(
            "m" if name in LENGTHS else "1" if name.startswith("q") else "rad" for name in record.platform.pose
        ),
        "velocity": mixed("m/s" if length else "rad/s" for length in lengths),
        "acceleration": mixed("m/s2" if length else "rad/s2" for length in lengths),
        "load": "N, N, N, N m, N m, N m",
        "actuator_forces": forces,
        "preload": forces,
        "friction": forces,
        "friction_band": forces,
        "input_rates": rates,
        "kinetic_energy": "J",
        "potential_energy": "J",
        "power": "W",
        "mass_matrix": "kg, kg m between a length and an angle, kg m2 between angles",
        "bias": of_pose,
        "gravity": of_pose,
        "growth": "N or N m per N; moments of the load over the characteristic length",
        "weakest": "1; lengths in characteristic lengths",
        "reactions": "force N, moment N m",
    }


def _shown(record: Mechanism, answer: ForcesAnswer) -> Iterable[RenderableType]:
    pose = pose_at_border(record, _inside(record, answer)).tolist()
    yield heading(f"{answer.mechanism}, forces: {answer.status}")
    yield f"at {style_of(record).pose(answer.coordinates, pose)}, {mode_words(record, answer.mode)}"
    acting = ["gravity"] * answer.under_gravity
    if any(answer.load):
        force, moment = answer.load[:3], answer.load[3:]
        acting.append(
            f"({_list(force)}) N" + (f" and ({_list(moment)}) N m" if any(moment) else "") + " on the platform"
        )
    yield f"under {' and '.join(acting) or 'no load'}"
    yield ""
    if answer.failures:
        yield failures(answer.failures)
    for note in answer.notes:
        yield f"note: {note}"
    if answer.reactions:
        yield from _actuators(record, answer)
        yield from _terms(answer)
        yield from _joints(answer)


def _inside(record: Mechanism, answer: ForcesAnswer) -> NDArray[Any]:
    return np.asarray(np.array(answer.pose) / pose_metres(record))


def _actuators(record: Mechanism, answer: ForcesAnswer) -> Iterable[RenderableType]:
    labels = [record.coordinate_label(item.coordinate) for item in record.drives]
    known = [record.machine.actuators.get(label) for label in labels]
    rows = []
    for place, (name, unit, actuator) in enumerate(zip(answer.input_names, force_units(record), known, strict=True)):
        moving, force = answer.input_rates[place], answer.actuator_forces[place]
        friction = answer.friction[place] if moving else answer.friction_band[place]
        limit = actuator.force if actuator else None
        borne = abs((force or 0.0) + (friction or 0.0) * bool(moving))
        share = f"{borne / limit:.0%}" if limit else "-"
        told = f"{'' if moving else '±'}{short(friction)}" if actuator else "-"
        rows.append((name, short(force), unit, told, short(moving), "m/s" if unit == "N" else "rad/s", share))
    columns = ("actuator", "force", "in", "friction", "rate", "per", "of its limit")
    yield table(columns, rows, left=("actuator", "in", "per"))
    yield f"largest force of an actuator per newton at the platform: {short(answer.growth)}"
    if any(answer.velocity):
        yield f"power of the actuators {short(answer.power)} W, friction left aside"


def _terms(answer: ForcesAnswer) -> Iterable[RenderableType]:
    if answer.kinetic_energy is not None:
        yield f"energy: kinetic {short(answer.kinetic_energy)} J, potential {short(answer.potential_energy)} J"
    if answer.mass_matrix and answer.mass_matrix[0][0] is not None:
        yield ""
        size = max(abs(value or 0.0) for row in (*answer.mass_matrix, answer.gravity) for value in row)
        rows = [
            (name, *(_clear(value, size) for value in (*row, bias, weight)))
            for name, row, bias, weight in zip(
                _rates(answer), answer.mass_matrix, answer.bias, answer.gravity, strict=True
            )
        ]
        columns = ("rate of", *(f"M {name}" for name in _rates(answer)), "bias c", "gravity g")
        yield table(columns, rows, left=("rate of",))
        yield "M a + c + g = actuators and loads, per rate of the pose, in SI units"


def _rates(answer: ForcesAnswer) -> tuple[str, ...]:
    return rate_names(answer.coordinates)


def _joints(answer: ForcesAnswer) -> Iterable[RenderableType]:
    yield ""
    rows = [
        (
            item.joint,
            *(_number(value, sure) for value, sure in zip([*item.force, *item.moment], item.unique, strict=True)),
        )
        for item in answer.reactions
    ]
    columns = ("joint", *(f"{name} [{'N' if name[0] == 'F' else 'N m'}]" for name in AXES))
    yield table(columns, rows, left=("joint",))
    yield "what the parent passes to the child at its joint point, along the base's axes"
    stresses = answer.redundancy or 0
    yield f"{answer.unknowns} unknowns, {answer.equations} equations of rank {answer.rank}"
    if stresses:
        ways = f"{stresses} stresses balance themselves" if stresses > 1 else "1 stress balances itself"
        yield f"* rigid links leave it open: {ways}; the least is shown"
        yield from _bent_joints(answer, columns)


def _bent_joints(answer: ForcesAnswer, columns: Sequence[str]) -> Iterable[RenderableType]:
    """What the structure makes of reactions that rigid links leave open."""
    rows = [
        (item.joint, *(_number(value, True) for value in item.elastic))
        for item in answer.reactions
        if item.elastic is not None and not all(item.unique)
    ]
    if rows:
        yield ""
        yield table(columns, rows, left=("joint",))
        yield "the same where links bend by their profiles, and drives give way as their actuators do"
    if rows and any(item.elastic is None for item in answer.reactions):
        yield "the other joints: rigid links still leave them open"


def _clear(value: float | None, size: float) -> str:
    """A number, where it is more than rounding beside others of a size."""
    return short(0.0 if value is not None and abs(value) < ROUNDED * size else value)


def _number(value: float, sure: bool) -> str:
    """A number, with a star where rigid links leave it open."""
    return f"{0.0 if abs(value) < 5e-10 else value:.5g}{'' if sure else '*'}"


def _list(values: Iterable[float]) -> str:
    return ", ".join(f"{value:g}" for value in values)
