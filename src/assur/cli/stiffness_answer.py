"""Stiffness at a pose as data and as a person reads it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.lost import why_lost
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.positions import failures
from assur.cli.quantities import mode_words
from assur.kinematics.answers.at_border import mechanism_header, pose_at_border
from assur.kinematics.answers.style import style_of
from assur.kinematics.status import Status
from assur.machine.elasticity.energies import ranked
from assur.machine.elasticity.mode_shapes import ModeShape, mode_shapes
from assur.machine.elasticity.springs import ACTUATORS, JOINTS
from assur.machine.elasticity.stiffness import Stiffness, alike
from assur.machine.elasticity.structure import yields
from assur.machine.masses.slips import slips
from assur.machine.motion.screws import pose_metres
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS
from assur.results.answers.stiffness import (
    Row,
    ShownCompliance,
    ShownModeShape,
    ShownMovedLink,
    ShownShares,
    StiffnessAnswer,
)
from assur.results.json_text import plain
from assur.results.plain_text import short

UNITS = {
    "compliance": "m/N, m/(N m) above right, rad/N below left, rad/(N m) below right",
    "stiffness": "N/m, N/rad above right, N m/m below left, N m/rad below right",
    "translational_eigenvalues": "N/m",
    "directions": "1",
    "shares": "1",
    "frequencies": "Hz",
    "mode_shapes": "frequency Hz, points and displacements m, rotations rad, shares 1",
}
WRENCH = ("Fx [N]", "Fy [N]", "Fz [N]", "Mx [N m]", "My [N m]", "Mz [N m]")
STILL = 1e-9
"""A displacement of the platform below this share of the largest is rounding."""
NOT_HELD = "the platform moves here while nothing is strained: the actuators do not hold it"


def outcome(record: Mechanism, pose: NDArray[Any], mode: str, *, shear: bool) -> Outcome:
    """Stiffness at a pose (m,), in lengths and rad."""
    solved = record.stiffness(pose, mode, shear=shear)
    answer = _answer(record, pose, mode, solved)
    return Outcome(answer, lambda: _shown(record, answer, pose), exit_codes.of_status(answer.status))


def _answer(record: Mechanism, pose: NDArray[Any], mode: str, solved: Stiffness) -> StiffnessAnswer:
    status = Status(int(solved.status[0]))
    held = status == Status.regular
    whole, motors = _compliance(solved), _compliance(solved.actuator_only)
    shares = solved.shares() if held else None
    vibrations = solved.vibrations() if held else None
    lost = why_lost(record, pose, mode, status)
    notes = [NOT_HELD] if status == Status.parallel else [*lost.notes]
    notes += map(str, slips(record, {}))
    if held and not yields(record):
        notes.append("no link has a profile: only the actuators give way")
    if vibrations and vibrations.lacking:
        notes.append(f"no mass is stated of {', '.join(vibrations.lacking)}: no frequencies")
    return StiffnessAnswer(
        **mechanism_header(record),
        pose=(pose * pose_metres(record)).tolist(),
        mode=mode,
        status=status.name,
        input_names=tuple(item.name for item in record.drives),
        shear=solved.shear,
        compliance=whole.compliance,
        stiffness=whole.stiffness,
        rank=whole.rank,
        translational_eigenvalues=whole.translational_eigenvalues,
        directions=whole.directions,
        actuator_only=motors,
        shares=ShownShares(shares.links, shares.kinds, shares.actuators, shares.joints) if shares else None,
        frequencies=tuple(plain(vibrations.frequencies)) if vibrations else (),
        mode_shapes=tuple(_shape(own) for own in mode_shapes(vibrations)) if vibrations else (),
        failures=lost.failures,
        notes=tuple(notes),
        units={"pose": ", ".join("m" if name in LENGTHS else "rad" for name in record.platform.pose), **UNITS},
    )


def _shape(own: ModeShape) -> ShownModeShape:
    links = {link: ShownMovedLink(plain(rest), plain(moved)) for link, (rest, moved) in own.links.items()}
    return ShownModeShape(own.frequency, plain(own.platform), own.shares.links, links)


def _compliance(solved: Stiffness) -> ShownCompliance:
    held = bool(np.isfinite(solved.compliance[0]).all())
    sizes, directions = solved.translational
    return ShownCompliance(
        compliance=plain(solved.compliance[0]) if held else None,
        stiffness=plain(solved.stiffness[0]) if held and int(solved.rank[0]) == 6 else None,
        rank=int(solved.rank[0]) if held else None,
        translational_eigenvalues=plain(sizes[0]),
        directions=plain(directions[0]),
    )


def _shown(record: Mechanism, answer: StiffnessAnswer, pose: NDArray[Any]) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, stiffness: {answer.status}")
    place = style_of(record).pose(answer.coordinates, pose_at_border(record, pose).tolist())
    yield f"at {place}, {mode_words(record, answer.mode)}, inputs held by their actuators"
    yield ""
    if answer.failures:
        yield failures(answer.failures)
    yield from (f"note: {note}" for note in answer.notes)
    if answer.compliance is not None:
        yield from _translations(answer)
        yield from _matrices(answer)
        yield from _energies(answer)


def _translations(answer: StiffnessAnswer) -> Iterable[RenderableType]:
    motors = answer.actuator_only.translational_eigenvalues
    rows = [
        (_micro(size), *(f"{round(part or 0.0, 4) + 0.0:.4f}" for part in way), _micro(alone))
        for size, way, alone in zip(answer.translational_eigenvalues, answer.directions, motors, strict=True)
    ]
    yield table(("stiffness [N/um]", "along x", "y", "z", "actuators alone [N/um]"), rows)
    yield "of forces along principal directions without moment; those of the actuators alone have their own"
    if same := alike([np.inf if size is None else size for size in answer.translational_eigenvalues]):
        yield same


def _matrices(answer: StiffnessAnswer) -> Iterable[RenderableType]:
    yield ""
    columns = ("per unit of", "Fx", "Fy", "Fz", "Mx", "My", "Mz")
    names = ("x [um]", "y [um]", "z [um]", "rx [urad]", "ry [urad]", "rz [urad]")
    yield table(columns, _cleared(names, answer.compliance or (), 1e6), left=("per unit of",))
    yield "compliance at the platform's point, per N and N m"
    if answer.stiffness is None:
        yield f"no stiffness matrix: rigid links give way in {answer.rank} of 6 ways"
        return
    yield ""
    columns = ("per unit of", "x", "y", "z", "rx", "ry", "rz")
    yield table(columns, _cleared(WRENCH, answer.stiffness, 1.0), left=("per unit of",))
    yield "stiffness, N and N m per m and rad"


def _cleared(names: Sequence[str], matrix: Sequence[Row], unit: float) -> list[tuple[str, ...]]:
    """Rows of a symmetric matrix, without what is rounding beside its diagonal."""
    numbers = np.array(matrix, dtype=float)
    sizes = np.sqrt(np.abs(np.diag(numbers)))
    numbers[np.abs(numbers) < 1e-9 * sizes * sizes[:, None]] = 0.0
    return [(name, *(short(unit * value) for value in row)) for name, row in zip(names, numbers, strict=True)]


def _energies(answer: StiffnessAnswer) -> Iterable[RenderableType]:
    shares = answer.shares
    if shares is not None:
        yield ""
        rows = [(name, f"{share:.1%}") for name, share in ranked(shares.links)]
        yield table(("of the strain energy in", "share"), rows, left=("of the strain energy in",))
        kinds = ", ".join(f"{name} {share:.1%}" for name, share in shares.kinds.items() if name != ACTUATORS)
        if any(share for name, share in shares.kinds.items() if name != ACTUATORS):
            yield f"by kinds: {kinds}"
        for whole, split in ((ACTUATORS, shares.actuators), (JOINTS, shares.joints)):
            if split:
                yield f"of that of the {whole}: {', '.join(f'{name} {share:.1%}' for name, share in split.items())}"
        yield "under unit forces along x, y and z, summed"
    if answer.frequencies:
        yield ""
        shapes = [
            (short(own.frequency), *(f"{part + 0.0:.3f}" for part in _scaled(own.platform[:3])), _strained(own.shares))
            for own in answer.mode_shapes
        ]
        yield table(("vibration [Hz]", "platform along x", "y", "z", "strained most"), shapes, left=("strained most",))
        yield "natural vibrations: how the platform's point moves, and where the strain energy is"


def _scaled(moved: Sequence[float]) -> NDArray[np.float64]:
    """Three displacements, of which the largest is one, rounded; none of a platform that stands still."""
    numbers = np.array(moved)
    largest = float(np.max(np.abs(numbers)))
    return np.asarray(np.round(numbers / largest if largest > STILL else 0.0 * numbers, 3))


def _strained(shares: Mapping[str, float]) -> str:
    """The two links, or the actuators, that are strained most."""
    most = ranked(shares)[:2]
    return ", ".join(f"{name} {share:.0%}" for name, share in most if share > 0.01)


def _micro(value: float | None) -> str:
    """N/m in N/um."""
    return "rigid" if value is None else short(value / 1e6)
