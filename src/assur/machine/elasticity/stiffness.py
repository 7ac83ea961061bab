"""Stiffness of a mechanism at poses: how its platform gives way while the inputs are held by their actuators.

Matrix structural analysis of the whole joint graph: beams, rigid links, actuators as springs, passive joints as
unknowns that nothing holds. Overconstraint needs no care, idle freedoms stay idle.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.rates.acceleration import reached_in_mode
from assur.kinematics.status import Status
from assur.kinematics.validation.check import METRES
from assur.machine.elasticity.energies import EnergyShares, energy_shares
from assur.machine.elasticity.mode_shapes import ModeShape, mode_shapes
from assur.machine.elasticity.strains import Strains, strains
from assur.machine.elasticity.structure import structure
from assur.machine.elasticity.vibrations import Vibrations, vibrations
from assur.model.mechanism import MechanismRecord
from assur.results.notebook import Entries, Tabulated

FloatArray = NDArray[np.float64]
ALIKE = 1e-6
"""Share by which stiffness along two principal directions differs at most where it counts as the same."""
RIGID = 1e-12
"""Share of the largest compliance below which nothing gives way; turns count by the characteristic length."""
ABREAST = 256
"""Configurations that are taken at once: their matrices fit a processor's cache."""


@dataclass(frozen=True, eq=False)
class Stiffness(Tabulated):
    """How the platform gives way at N poses, in SI units: displacement before rotation, force before moment.

    Axes are the base's. Where a status says so there are no numbers: NaN.

    Attributes:
        record: the mechanism.
        values: (N, n) joint values.
        status: (N,) of `Status`: `parallel` where a motion that strains nothing moves the platform.
        compliance: (N, 6, 6) at the platform's point, in m/N, rad/N and m/(N m), rad/(N m).
        shear: whether beams give way to shear.
        rigid: whether no link bends.
    """

    record: MechanismRecord
    values: FloatArray
    status: NDArray[np.int8]
    compliance: FloatArray
    shear: bool
    rigid: bool

    def _title(self) -> str:
        return f"stiffness of {self.record.name} against forces, in N/m, ascending, and the direction of the least"

    def _entries(self) -> Entries:
        sizes, ways = self.translational
        names = ("k1", "k2", "k3", "x of k1", "y of k1", "z of k1")
        rows = np.concatenate([sizes, ways[:, 0]], axis=1).tolist()
        return [
            {**dict(zip(names, row, strict=True)), "rank": int(rank), "status": Status(int(code)).name}
            for row, rank, code in zip(rows, self.rank, self.status, strict=True)
        ]

    @cached_property
    def rank(self) -> NDArray[np.int64]:
        """In how many ways (N,) the platform gives way, of six."""
        return self._split[0]

    @cached_property
    def stiffness(self) -> FloatArray:
        """Inverse (N, 6, 6) of the compliance; NaN where rigid links leave a way in which nothing gives way."""
        return self._split[1]

    @cached_property
    def _split(self) -> tuple[NDArray[np.int64], FloatArray]:
        units = np.repeat([self.length, 1.0], 3)
        plain = np.nan_to_num(self.compliance) / units / units[:, None]
        sizes, vectors = np.linalg.eigh(plain)
        kept = sizes > RIGID * sizes[:, -1:]
        scaled = vectors / units[:, None]
        inverse = (scaled / np.where(kept, sizes, np.nan)[:, None]) @ np.swapaxes(scaled, -1, -2)
        return kept.sum(axis=-1), np.asarray(inverse)

    @property
    def length(self) -> float:
        """The characteristic length in m."""
        return METRES[self.record.unit] * characteristic_length(self.record)

    @cached_property
    def translational(self) -> tuple[FloatArray, FloatArray]:
        """Stiffness (N, 3) in N/m, ascending, along directions (N, 3, 3) row by row, where no moment is applied.

        Infinite along directions in which rigid links do not give way.
        """
        known = np.isfinite(self.compliance[:, 0, 0])
        sizes, vectors = np.linalg.eigh(np.nan_to_num(self.compliance[:, :3, :3]))
        sizes, vectors = sizes[:, ::-1], np.swapaxes(vectors, -1, -2)[:, ::-1]
        soft = sizes > RIGID * sizes[:, :1]
        stiff = np.where(soft, 1.0 / np.where(soft, sizes, 1.0), np.inf)
        largest = np.take_along_axis(vectors, np.argmax(np.abs(vectors), axis=-1)[..., None], axis=-1)
        ways = vectors * np.sign(largest)
        return np.where(known[:, None], stiff, np.nan), np.where(known[:, None, None], ways, np.nan)

    @cached_property
    def actuator_only(self) -> Stiffness:
        """The same if no link bent: only the actuators give way."""
        return self if self.rigid else stiffness_at(self.record, self.values, rigid=True)

    def strains(self, place: int = 0) -> Strains:
        """The structure at one of the poses.

        >>> import assur
        >>> answer = assur.load("zeng2019").stiffness([-15.4714, 9.6849, 456.3315])
        >>> answer.strains().structure.record.name
        'zeng2019'
        """
        return strains(structure(self.record, shear=self.shear, rigid=self.rigid), self.values[place : place + 1])

    def shares(self, place: int = 0) -> EnergyShares:
        """Where energy goes under unit forces along x, y and z, summed.

        >>> import assur
        >>> answer = assur.load("zeng2019").stiffness([-15.4714, 9.6849, 456.3315])
        >>> round(sum(answer.shares().links.values()), 9)
        1.0
        """
        state = self.strains(place)
        return energy_shares(state, state.displaced(np.swapaxes(state.platform[:1, :3], -1, -2))[0])

    def vibrations(self, place: int = 0) -> Vibrations:
        """The slowest natural vibrations at one of the poses.

        >>> import assur
        >>> answer = assur.load("zeng2019").stiffness([-15.4714, 9.6849, 456.3315])
        >>> bool((answer.vibrations().frequencies > 0.0).all())
        True
        """
        return vibrations(self.strains(place))

    def mode_shapes(self, place: int = 0) -> tuple[ModeShape, ...]:
        """How the structure moves in each of these; none where the file lacks a mass.

        >>> import assur
        >>> answer = assur.load("zeng2019").stiffness([-15.4714, 9.6849, 456.3315])
        >>> bool(abs(answer.mode_shapes()[0].frequency / answer.vibrations().frequencies[0] - 1.0) < 1e-9)
        True
        """
        return mode_shapes(self.vibrations(place))

    def __str__(self) -> str:
        rows = []
        for place, code in enumerate(self.status):
            sizes, ways = self.translational[0][place], self.translational[1][place]
            told = ", ".join(
                f"{size:.6g} along ({', '.join(f'{part:.3f}' for part in way)})"
                for size, way in zip(sizes, ways, strict=True)
            )
            rows.append(f"{Status(int(code)).name}: {told} N/m")
        return "\n".join([f"stiffness of {self.record.name}, translations without moment", *rows])


def alike(sizes: ArrayLike) -> str:
    """What is to be said of the directions of ascending stiffness where two are the same; empty where none are.

    >>> alike([1.0, 1.0, 3.0]), alike([1.0, 2.0, np.inf])
    ('where stiffness is the same, every direction between theirs has it', '')
    """
    known = np.asarray(sizes, dtype=float)
    known = known[np.isfinite(known)]
    same = bool(np.any(np.diff(known) <= ALIKE * known[1:]))
    return "where stiffness is the same, every direction between theirs has it" if same else ""


def stiffness(record: MechanismRecord, poses: ArrayLike, mode: str | None = None, *, shear: bool = True) -> Stiffness:
    """Stiffness at poses (..., m) in a working mode (the file's default where none is given).

    Args:
        record: the mechanism.
        poses: (..., m) in the mechanism's unit and rad.
        mode: the working mode.
        shear: whether beams give way to shear (Timoshenko), or not (Euler and Bernoulli).

    Returns:
        Answers in SI units, one for each pose of the flattened batch. A status says where there are none.

    Errors:
        UsageError: an actuator without stiffness; a profile without material, E or nu; bars that are not known.

    Example: how the paper's mechanism gives way, with the profiles that its file assumes.

    >>> from assur.model.registry import load_record
    >>> answer = stiffness(load_record("zeng2019"), [-15.4714, 9.6849, 456.3315])
    >>> answer.translational[0].round(-3).tolist(), answer.actuator_only.translational[0].round(-5).tolist()
    ([[225000.0, 1121000.0, 8326000.0]], [[19500000.0, 165600000.0, 696800000.0]])
    """
    structure(record, shear=shear)  # what the file lacks is told before poses are solved
    flat = border.checked_poses(record, poses).reshape(-1, len(record.platform.pose))
    values, lost = reached_in_mode(record, flat, mode)
    return stiffness_at(record, values, shear=shear, lost=lost)


def stiffness_at(
    record: MechanismRecord,
    values: FloatArray,
    *,
    shear: bool = True,
    rigid: bool = False,
    lost: NDArray[np.int8] | None = None,
) -> Stiffness:
    """Stiffness at joint values (N, n); with `rigid` no link bends.

    Where `lost` (N,) is not `regular` the joint values stand in for a pose that is not reached, and this is its status.
    """
    own = structure(record, shear=shear, rigid=rigid)
    compliance, held = np.full((len(values), 6, 6), np.nan), np.zeros(len(values), dtype=bool)
    for start in range(0, len(values), ABREAST):
        part = slice(start, start + ABREAST)
        state = strains(own, values[part])
        held[part] = state.held
        compliance[part] = state.platform @ state.displaced(np.swapaxes(state.platform, -1, -2))
    status = np.where(held, int(Status.regular), int(Status.parallel)).astype(np.int8)
    status[closure_error(record, values) > CLOSED * characteristic_length(record)] = int(Status.not_closed)
    if lost is not None:
        status = np.where(lost != Status.regular, lost, status)
    compliance[status != int(Status.regular)] = np.nan
    return Stiffness(record, values, status, 0.5 * (compliance + np.swapaxes(compliance, -1, -2)), shear, rigid)
