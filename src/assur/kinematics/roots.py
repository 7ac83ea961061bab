"""Direct problems that end in one polynomial: every root is a branch, the real ones are the poses."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.branches import Branches
from assur.kinematics.modes import is_of_mode, mode_texts, numbered
from assur.kinematics.status import Status
from assur.model.closed_form import Eliminant, Margin
from assur.model.mechanism import MechanismRecord
from assur.numerics import polynomials
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
ROOT = Margin("root", "1", "the polynomial has fewer real roots than its degree", unit=0)
"""The margin that every branch of an eliminant has: 0 where its root is real, else less by the imaginary part."""


@dataclass(frozen=True, eq=False, repr=False)
class RootBranches(Branches):
    """The branches of an eliminant, in the order of its real roots.

    They are numbered, not named by signs alone: two of one sign can often be joined without a singularity.

    Attributes:
        copy: (..., K) whether a root is the second copy of a double one.
        lost: (...) where the polynomial vanishes, so that it says nothing.
        only: the mode to which the answer is narrowed; empty for all of them.
    """

    copy: BoolArray
    lost: BoolArray
    only: str = ""

    @property
    def complete(self) -> bool:
        """Whether these are all solutions: every root of a polynomial that does not vanish."""
        return not self.only and not bool(np.any(self.overall_status == Status.undecided))

    @property
    def right(self) -> str:
        """By what right the answer is complete."""
        return f"closed form, all roots of a polynomial of degree {len(self.modes_asked)}"

    @cached_property
    def status(self) -> NDArray[np.int8]:
        """`Status` (..., K) of every root; undecided where the polynomial vanishes."""
        status = super().status
        status[self.lost] = Status.undecided
        return status

    @cached_property
    def modes(self) -> NDArray[np.int8]:
        """Signs (..., K, s) of the quantities that the file names."""
        return self.signs("direct")

    @cached_property
    def labels(self) -> NDArray[np.str_]:
        """Text (..., K): the signs, and a number where several solutions share them."""
        return numbered(mode_texts(self.modes), self._distinct)

    @cached_property
    def exists(self) -> BoolArray:
        """Whether a branch (..., K) is a solution: a real root, and not the second copy of a double one."""
        return self._distinct & is_of_mode(self.labels, self.only) if self.only else self._distinct

    @cached_property
    def _distinct(self) -> BoolArray:
        return np.asarray(self._real & ~self.copy)

    @property
    def _margin_list(self) -> tuple[Margin, ...]:
        return (ROOT, *super()._margin_list)

    @cached_property
    def _merged(self) -> BoolArray:
        return np.zeros((*self.batch_shape, *self.modes_asked.shape), dtype=bool)


def roots_of(record: MechanismRecord, eliminant: Eliminant, given: FloatArray, only: str = "") -> RootBranches:
    """Every branch of an eliminant at inputs (..., n), or that of one mode."""
    count = int(np.prod(given.shape[:-1], dtype=int))
    inputs = border.input_components(record, given.reshape(count, given.shape[-1]))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        entries = eliminant.coefficients(Floats(), record.values, inputs)
        wide = [np.broadcast_to(np.asarray(entry, dtype=float), (count,)) for entry in entries]
        values, gap = _real(np.stack(wide, axis=-1), eliminant.kind)
        root = (np.cos(values.T), np.sin(values.T)) if eliminant.kind == "angle" else values.T
        branch = eliminant.back(Floats(), record.values, inputs, root)
    copy = np.zeros(values.shape, dtype=bool)
    copy[:, 1:] = np.diff(values, axis=1) == 0
    return RootBranches(
        record=record,
        problem="direct",
        given=given,
        modes_asked=np.zeros((eliminant.degree, len(record.modes.assembly)), dtype=np.int8),
        sign_shape=(eliminant.degree,),
        branch=dataclasses.replace(branch, margins={ROOT.name: -gap.T, **branch.margins}),
        copy=copy.reshape(*given.shape[:-1], eliminant.degree),
        lost=np.all(np.stack(wide) == 0, axis=0).reshape(given.shape[:-1]),
        only=only,
    )


def _real(coefficients: FloatArray, kind: str) -> tuple[FloatArray, FloatArray]:
    """Real values (N, K) of the unknown, rising, NaN last, and how far (N, K) from being real the others are.

    Of a polynomial without real root that is the least imaginary part of its roots, else 1.
    """
    find = polynomials.real_angles if kind == "angle" else polynomials.real_roots
    values = find(coefficients)
    gap = np.where(np.isfinite(values), 0.0, 1.0)
    none = np.flatnonzero(np.all(gap > 0, axis=-1))
    if len(none):
        imaginary = np.abs(polynomials.roots(coefficients[none]).imag)
        gap[none] = np.nanmin(imaginary, axis=-1, initial=1.0)[:, None]
    return values, gap
