"""Motions in time as data, as rows of a file, as a person reads them."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.quantities import mode_words
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.answers.at_border import mechanism_header
from assur.kinematics.pose import pose_error
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.dynamics.departure import Departure
from assur.machine.dynamics.inverse_dynamics import MotionForces, dynamics
from assur.machine.dynamics.motion_file import MotionFile
from assur.machine.dynamics.prescribed_motion import PrescribedMotion
from assur.machine.dynamics.release import Release, forces_in_time
from assur.machine.forces.actuator_forces import force_units
from assur.machine.forces.utilisation import Utilisation, peak, rms, utilisation
from assur.machine.masses.link_masses import masses
from assur.machine.motion.screws import pose_metres
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS, rate_names
from assur.results.answers.dynamics import DynamicsAnswer, StoppedMotion, UsedShares
from assur.results.files import write_whole
from assur.results.json_text import plain
from assur.results.plain_text import count, short

if TYPE_CHECKING:
    from assur.machine.dynamics.free_motion import FreeMotion

FloatArray = NDArray[np.float64]
ROWS = 12
"""Moments that a person sees; --json and files have all."""
ROUNDED = 1e-12
"""Share of the largest number of a unit below which one is zero."""


def outcome(
    record: Mechanism,
    read: MotionFile,
    mode: str,
    acting: tuple[Sequence[float], bool],
    *,
    forward: bool,
    use_limits: bool,
    path: Path | None,
) -> Outcome:
    """The motion of a file, under a load and gravity (`acting`); rows or a figure go to a path."""
    motion, release, options = read.prescribed, read.release, {"gravity": acting[1], "use_limits": use_limits}
    if release is not None and not forward:
        raise UsageError("the file gives forces and no motion", hint="add --forward to let the mechanism run by them")
    if motion is not None:
        asked = dynamics(record, motion, mode, acting[0], **options)
        answer = _of_prescribed(record, asked, mode, acting)
        release = _as_asked(asked, motion) if forward and asked.departure is None else None
    if release is not None:
        from assur.machine.dynamics.free_motion import free_motion  # with the integrators of SciPy

        answer = _of_free(record, free_motion(record, release, mode, acting[0], **options), mode, acting, motion)
    if path is not None and answer.t:
        content = rows_text(answer) if path.suffix.lower() == ".csv" else _drawn(record, answer, path)
        answer = replace(answer, files=(str(write_whole(path, content)),))
    return Outcome(answer, lambda: _shown(record, answer), _code(answer))


def _code(answer: DynamicsAnswer) -> int:
    if answer.stopped is None:
        return exit_codes.FINE
    return exit_codes.of_status(answer.status) or exit_codes.STOPPED


def _as_asked(asked: MotionForces, motion: PrescribedMotion) -> Release:
    """The start of a motion, and what it asks the actuators for."""
    pose, velocity, _ = (part[0] for part in motion.at(motion.times[:1]))
    exerted = forces_in_time(asked.times, asked.forces, smooth=True)
    return Release(pose, velocity, float(asked.times[-1]), exerted, float(asked.times[0]), len(asked.times))


def _of_prescribed(
    record: Mechanism, asked: MotionForces, mode: str, acting: tuple[Sequence[float], bool]
) -> DynamicsAnswer:
    return replace(
        _answer(record, asked, mode, acting),
        friction=() if asked.answer is None else plain(asked.answer.friction),
        utilisation_with_friction=_shares(asked.utilisation(friction=True)),
        notes=tuple(_notes(record, asked)),
    )


def _of_free(
    record: Mechanism,
    free: FreeMotion,
    mode: str,
    acting: tuple[Sequence[float], bool],
    prescribed: PrescribedMotion | None,
) -> DynamicsAnswer:
    away = None
    if prescribed is not None:
        length = characteristic_length(record)
        error = pose_error(record, free.values, prescribed.at(free.times)[0], length)
        away = float(np.max(np.abs(error), initial=0.0)) / length
    return replace(
        _answer(record, free, mode, acting),
        forward=True,
        loop_gap=free.gap,
        energy_drift=free.drift,
        deviation=away,
        notes=("friction is left aside", *masses(record).notes),
    )


def _answer(
    record: Mechanism, moved: MotionForces | FreeMotion, mode: str, acting: tuple[Sequence[float], bool]
) -> DynamicsAnswer:
    """What both kinds of motion have."""
    load, gravity = acting
    of_pose = pose_metres(record)
    of_inputs = np.array([METRES[record.unit] if unit == "N" else 1.0 for unit in force_units(record)])
    return DynamicsAnswer(
        **mechanism_header(record),
        mode=mode,
        status=moved.status,
        forward=False,
        input_names=tuple(item.name for item in record.drives),
        load=[*load, *[0.0] * (6 - len(load))],
        under_gravity=gravity,
        t=plain(moved.times),
        pose=plain(moved.poses * of_pose),
        velocity=plain(moved.velocities),
        acceleration=plain(moved.accelerations),
        inputs=plain(moved.inputs * of_inputs),
        input_rates=plain(moved.rates),
        actuator_forces=plain(moved.forces),
        friction=(),
        power=plain(moved.forces * moved.rates),
        kinetic_energy=plain(moved.kinetic_energy),
        potential_energy=plain(moved.potential_energy),
        peak=plain(peak(moved.forces)),
        rms=plain(rms(moved.times, moved.forces)),
        utilisation=_shares(utilisation(record, moved.forces, moved.rates)),
        utilisation_with_friction=None,
        loop_gap=None,
        energy_drift=None,
        deviation=None,
        stopped=_stopped(record, moved.departure),
        notes=(),
        files=(),
        units=_units(record),
    )


def _shares(shares: Utilisation) -> UsedShares:
    return UsedShares(plain(shares.force), plain(shares.speed), plain(shares.power))


def _stopped(record: Mechanism, departure: Departure | None) -> StoppedMotion | None:
    if departure is None:
        return None
    pose = (departure.pose * pose_metres(record)).tolist()
    margin = plain(departure.margin)
    return StoppedMotion(departure.kind, departure.time, pose, departure.quantity, margin, departure.text)


def _notes(record: Mechanism, asked: MotionForces) -> Iterable[str]:
    if asked.answer is not None:
        near = np.flatnonzero(asked.answer.status == Status.near_singular)
        if len(near):
            largest = int(near[np.argmax(asked.answer.growth[near])])
            grown = f"{asked.answer.growth[largest]:.3g} N or N m of an actuator per newton at the platform"
            yield f"near a singularity at {asked.times[largest]:.6g} s: {grown}"
        if asked.swings:
            yield "rods weigh beside the axes about which nothing drives them: they swing, from where the motion begins"
        if asked.answer.preload.shape[-1]:
            yield "more drives than freedoms: the forces of least norm; preload may be added"
    yield from masses(record).notes


def _units(record: Mechanism) -> dict[str, str]:
    lengths = [name in LENGTHS for name in rate_names(record.platform.pose)]
    forces = ", ".join(force_units(record))
    speeds = ", ".join("m/s" if unit == "N" else "rad/s" for unit in force_units(record))
    names = record.platform.pose
    return {
        "t": "s",
        "pose": ", ".join("m" if name in LENGTHS else "1" if name.startswith("q") else "rad" for name in names),
        "velocity": ", ".join("m/s" if length else "rad/s" for length in lengths),
        "acceleration": ", ".join("m/s2" if length else "rad/s2" for length in lengths),
        "load": "N, N, N, N m, N m, N m",
        "inputs": ", ".join("m" if unit == "N" else "rad" for unit in force_units(record)),
        "input_rates": speeds,
        "actuator_forces": forces,
        "friction": forces,
        "power": ", ".join("W" for _ in record.drives),
        "kinetic_energy": "J",
        "potential_energy": "J",
        "peak": forces,
        "rms": forces,
        "utilisation": "share of the limit",
        "utilisation_with_friction": "share of the limit",
        "loop_gap": "characteristic lengths",
        "energy_drift": "share of the largest kinetic energy",
        "deviation": "characteristic lengths, and rad",
    }


def rows_text(answer: DynamicsAnswer) -> str:
    """Rows by moments as CSV, each column with its unit; `assur.cli.pose_table` reads its times and poses again."""
    rates, inputs = rate_names(answer.coordinates), answer.input_names
    blocks = {
        "pose": answer.coordinates,
        "velocity": [f"d {name}/dt" for name in rates],
        "acceleration": [f"d2 {name}/dt2" for name in rates],
        "inputs": inputs,
        "input_rates": [f"d {name}/dt" for name in inputs],
        "actuator_forces": [f"force {name}" for name in inputs],
        "friction": [f"friction {name}" for name in inputs],
        "power": [f"power {name}" for name in inputs],
        "kinetic_energy": ["kinetic energy"],
        "potential_energy": ["potential energy"],
    }
    columns, rows = ["t [s]"], [[time] for time in answer.t]
    for key, names in blocks.items():
        block = np.array(getattr(answer, key))
        if len(block):
            units = answer.units[key].split(", ")
            columns += [f"{name} [{unit}]" for name, unit in zip(names, units, strict=True)]
            rows = [[*row, *values] for row, values in zip(rows, block.reshape(len(rows), -1).tolist(), strict=True)]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([columns, *([repr(value) for value in row] for row in rows)])
    return text.getvalue()


def _drawn(record: Mechanism, answer: DynamicsAnswer, path: Path) -> bytes:
    from assur.figures.encode import encoded
    from assur.figures.in_time import in_time
    from assur.figures.style import styled

    with styled():
        return encoded(in_time(record, answer), path.suffix.lower()[1:])


def _shown(record: Mechanism, answer: DynamicsAnswer) -> Iterable[RenderableType]:
    what = "free motion" if answer.forward else "forces along a motion"
    end = "to its end" if answer.stopped is None else f"ended, {answer.stopped.kind}" if answer.t else "refused"
    yield heading(f"{answer.mechanism}, {what}: {end}")
    if answer.stopped is not None:
        yield f"{answer.stopped.text[:1].upper()}{answer.stopped.text[1:]}."
    if not answer.t:
        return
    span = f"{answer.t[0]:.6g} s to {answer.t[-1]:.6g} s, {count(len(answer.t), 'moment')}"
    yield f"{span}, {mode_words(record, answer.mode)}"
    yield from (f"note: {note}" for note in answer.notes)
    yield ""
    yield _actuators(record, answer)
    if answer.utilisation_with_friction is not None:
        yield "* with friction"
    yield ""
    yield _moments(record, answer)
    energies = [f"{short(max(values))} J" for values in (answer.kinetic_energy, answer.potential_energy)]
    yield f"largest energies: kinetic {energies[0]}, potential {energies[1]}"
    if answer.forward:
        yield f"loops open by at most {answer.loop_gap:.1e} characteristic lengths"
        yield f"energy from nowhere: at most {answer.energy_drift:.1e} of the largest kinetic energy"
        if answer.deviation is not None:
            yield f"away from the motion of the file by at most {answer.deviation:.1e} characteristic lengths or rad"
    yield from (f"written: {file}" for file in answer.files)


def _actuators(record: Mechanism, answer: DynamicsAnswer) -> RenderableType:
    shares = answer.utilisation_with_friction or answer.utilisation
    speeds, powers = peak(np.array(answer.input_rates)), peak(np.array(answer.power))
    rows = [
        (
            name,
            short(answer.peak[k]),
            short(answer.rms[k]),
            unit,
            _share(shares.force[k]),
            short(speeds[k]),
            "m/s" if unit == "N" else "rad/s",
            _share(shares.speed[k]),
            short(powers[k]),
            _share(shares.power[k]),
        )
        for k, (name, unit) in enumerate(zip(answer.input_names, force_units(record), strict=True))
    ]
    of = "of limit" if answer.forward else "of limit*"
    columns = ("actuator", "peak", "rms", "in", of, "speed", "in ", "of limit", "power [W]", of + " ")
    return table(columns, rows, left=("actuator", "in", "in "))


def _share(value: float | None) -> str:
    return "-" if value is None else f"{value:.1%}"


def _moments(record: Mechanism, answer: DynamicsAnswer) -> RenderableType:
    units = ["m" if name in LENGTHS else "1" if name.startswith("q") else "rad" for name in answer.coordinates]
    titles = [f"{name} [{unit}]" for name, unit in zip(answer.coordinates, units, strict=True)]
    titles += [f"{name} [{unit}]" for name, unit in zip(answer.input_names, force_units(record), strict=True)]
    picked = sorted({round(place) for place in np.linspace(0, len(answer.t) - 1, ROWS)})
    numbers = np.column_stack([answer.t, answer.pose, answer.actuator_forces])
    alike = np.array(["s", *units, *force_units(record)])
    for unit in set(alike.tolist()):
        block = numbers[:, alike == unit]
        numbers[:, alike == unit] = np.where(np.abs(block) <= ROUNDED * np.abs(block).max(), 0.0, block)
    return table(("t [s]", *titles), [[short(value) for value in numbers[k]] for k in picked])
