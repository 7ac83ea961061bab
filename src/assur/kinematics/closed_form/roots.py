"""Direct problems that end in one polynomial: every root is a branch, the real ones are the poses."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.kinematics import border
from assur.kinematics.closed_form.branches import Branches
from assur.kinematics.closed_form.doubtful import decided
from assur.kinematics.modes import is_of_mode, lettered, mode_texts, sign_axes, sign_names
from assur.kinematics.naming import sign_meanings, signs_at
from assur.kinematics.status import Status
from assur.model.closed_form import Eliminant, Margin
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics import polynomials
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]
ComplexArray = NDArray[np.complex128]
STEPS, STEP = 3, 1e-7
"""From a root of the coefficients to that of the kernel that they are of, and the difference that says its slope."""
ROOT = Margin("root", "1", "the polynomial has fewer real roots than its degree", unit=0)
"""The margin that every branch of an eliminant has: 0 where its root is real, else less by the imaginary part."""

LAST_DIGIT = 2e-15
"""Part (of a length, of 1 rad) by which inputs are moved to see how far rounding moves the coefficients."""
MOVES = ((1, -1, 1, 1, -1, 1), (1, 1, -1, 1, 1, -1), (-1, 1, 1, 1, -1, -1))
SPARE = 20
"""A coefficient may be wrong by so many times its largest move, and by so many last digits of its own."""


@dataclass(frozen=True, eq=False, repr=False)
class RootBranches(Branches):
    """The branches of an eliminant, in the order of its real roots.

    They bear letters, and are not named by signs alone: two of one sign can often be joined without a singularity.

    Attributes:
        dropped: (..., K) whether a root is no solution of its own: the second copy of a double one, or not real.
        unsure: (..., K) where rounding hides whether there is a pose, and closing the loops did not show it.
        only: the mode to which the answer is narrowed; empty for all of them.
    """

    dropped: BoolArray
    unsure: BoolArray
    only: str = ""

    @property
    def complete(self) -> bool:
        """Whether these are all solutions: every root of a polynomial that does not vanish, none of them in doubt."""
        return not self.only and not bool(np.any(np.isin(self.overall_status, (Status.not_closed, Status.undecided))))

    @property
    def right(self) -> str:
        """By what right the answer is complete."""
        signs = _signs(self.record)
        parts = 2 ** sum(signs.values())
        which = f"{parts} polynomials" if parts > 1 else "a polynomial"
        spare = [name for name, chooses in signs.items() if not chooses]
        twice = f", with both signs of {' and '.join(spare)}" if spare else ""
        return f"closed form, all roots of {which} of degree {self.sign_shape[-1]}{twice}"

    @cached_property
    def formula_status(self) -> NDArray[np.int8]:
        """`Status` (..., K) of every root; undecided where rounding hides it, or the polynomial vanishes."""
        status = super().formula_status
        status[self.unsure] = Status.undecided
        return status

    @cached_property
    def modes(self) -> NDArray[np.int8]:
        """Signs (..., K, s) of the quantities that the file names."""
        return self.signs("direct")

    @cached_property
    def labels(self) -> NDArray[np.str_]:
        """Text (..., K): the signs, and a letter where several solutions share them."""
        if sign_names(self.record, "direct"):
            return lettered(mode_texts(self.modes), self._distinct)
        signs = np.zeros((*self._distinct.shape, len(sign_meanings(self.record, "direct"))), dtype=np.int8)
        signs[self._distinct] = signs_at(self.record, "direct", self.joints[self._distinct])
        return lettered(mode_texts(signs), self._distinct)

    @cached_property
    def exists(self) -> BoolArray:
        """Whether a branch (..., K) is a solution: a real root, and not the second copy of a double one."""
        return self._distinct & is_of_mode(self.labels, self.only) if self.only else self._distinct

    @cached_property
    def _distinct(self) -> BoolArray:
        return np.asarray(self._real & ~self.dropped)

    @property
    def _margin_list(self) -> tuple[Margin, ...]:
        return (ROOT, *super()._margin_list)

    @cached_property
    def _merged(self) -> BoolArray:
        return np.zeros((*self.batch_shape, *self.modes_asked.shape), dtype=bool)


def _signs(record: MechanismRecord) -> dict[str, bool]:
    """The signs of the eliminant, and whether each chooses between polynomials; else only `back` uses it."""
    form = record.closed_form
    if form is None or not isinstance(form.direct, Eliminant) or not form.direct.signs:
        return {}
    signs, inputs = form.direct.signs, border.input_components(record, np.ones((1, len(record.inputs))))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        entries = form.direct.coefficients(Floats(), kernel_dimensions(record), inputs, sign_axes(signs))
    sizes = np.broadcast_shapes(*map(np.shape, entries))  # one length 2 for each sign that an entry depends on
    return dict(zip(signs, (size == 2 for size in (*(1,) * len(signs), *sizes)[-len(signs) - 1 : -1]), strict=True))


def roots_of(record: MechanismRecord, eliminant: Eliminant, given: FloatArray, only: str = "") -> RootBranches:
    """Every branch of an eliminant at inputs (..., n), or that of one mode."""
    flat = given.reshape(int(np.prod(given.shape[:-1], dtype=int)), given.shape[-1])
    found, count = _every_root(record, eliminant, flat)
    dropped, unsure = found.dropped, found.unsure
    rows = np.flatnonzero(np.any(count > 1, axis=-1))
    if len(rows):
        few, few_counts = _every_root(record, eliminant, flat[rows])
        dropped[rows], more = decided(few, few_counts)
        unsure[rows] |= more
    shape = (*given.shape[:-1], eliminant.degree)
    return dataclasses.replace(
        found, given=given, dropped=dropped.reshape(shape), unsure=unsure.reshape(shape), only=only
    )


def _every_root(record: MechanismRecord, eliminant: Eliminant, given: FloatArray) -> tuple[RootBranches, IntArray]:
    """The branches at inputs (N, n), and how many roots lie where each (N, K) does, 0 for one that is not real."""
    inputs = border.input_components(record, given)
    extra = (sign_axes(eliminant.signs, batch_axes=2),) if eliminant.signs else ()
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        coefficients, rounding = coefficients_of(record, eliminant, given)
        points = polynomials.roots(coefficients)
        if eliminant.left_over is not None:
            kernel = partial(eliminant.left_over, Floats(), kernel_dimensions(record), inputs)
            points = polynomials.approached(points, lambda at: _left_over(lambda root: kernel(root, *extra), at), STEPS)
        parts = _real(coefficients, points, rounding, eliminant.kind)
        values, gap, count = (np.moveaxis(item, -1, -2) for item in parts)
        root = (np.cos(values), np.sin(values)) if eliminant.kind == "angle" else values
        branch = eliminant.back(Floats(), kernel_dimensions(record), inputs, root, *extra)
    branches = RootBranches(
        record=record,
        problem="direct",
        given=given,
        modes_asked=np.zeros((eliminant.degree, len(record.modes.assembly)), dtype=np.int8),
        sign_shape=values.shape[:-1],
        branch=dataclasses.replace(branch, margins={ROOT.name: -gap, **branch.margins}),
        dropped=np.zeros((len(given), eliminant.degree), dtype=bool),
        unsure=_by_problem(np.broadcast_to(_lost(coefficients)[..., None, :], values.shape)),
    )
    return branches, _by_problem(count)


def coefficients_of(record: MechanismRecord, eliminant: Eliminant, given: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Coefficients (*parts, N, d + 1) at inputs (N, n), constant term first, and how far rounding may have moved them.

    One part for each sign of the eliminant, + before -. The inputs are moved by their last digits, and so are the
    coefficients: by as much as rounding on the way would move them. A test compares that with a higher precision.
    """
    signs = eliminant.signs
    sizes = np.array([1.0 if item.coordinate.kind == "angle" else 0.0 for item in record.inputs])
    steps = LAST_DIGIT * np.array(MOVES)[:, None, np.arange(given.shape[-1]) % len(MOVES[0])]
    many = np.concatenate([given[None], given + steps * np.maximum(np.abs(given), sizes)])  # (1 + moves, N, n)
    inputs = border.input_components(record, many.reshape(-1, given.shape[-1]))
    extra = (sign_axes(signs),) if signs else ()
    entries = eliminant.coefficients(Floats(), kernel_dimensions(record), inputs, *extra)
    parts, size = (2,) * len(signs), many[..., 0].size
    wide = [np.broadcast_to(np.asarray(entry, dtype=float), (*parts, size)) for entry in entries]
    values = np.stack(wide, axis=-1).reshape(*parts, *many.shape[:-1], len(wide))
    first = np.take(values, 0, axis=len(signs))
    moved = np.max(np.abs(values - np.expand_dims(first, len(signs))), axis=len(signs))
    return first, SPARE * (moved + np.finfo(float).eps * np.abs(first))


def _lost(coefficients: FloatArray) -> BoolArray:
    """Where a polynomial (..., d + 1) says nothing: it vanishes, or is not finite."""
    return np.asarray(np.all(coefficients == 0, axis=-1) | ~np.all(np.isfinite(coefficients), axis=-1))


def _by_problem(values: NDArray[Any]) -> NDArray[Any]:
    """Of parts, roots and problems (..., d, N) an array (N, K)."""
    return np.array(np.moveaxis(values, -1, 0).reshape(values.shape[-1], int(np.prod(values.shape[:-1]))))


def _left_over(kernel: Callable[..., Any], roots: ComplexArray) -> tuple[FloatArray, ComplexArray]:
    """Size and logarithmic derivative of what vanishes at roots (*parts, N, d), the tangents of half an angle."""
    tangent = np.moveaxis(roots, -1, -2)
    size = np.maximum(1, np.abs(tangent) ** 2)
    step = STEP * np.sqrt(size)
    t = np.stack([tangent, tangent + step])
    value, ahead = np.broadcast_to(kernel(((1 - t * t) / size, 2 * t / size, (1 + t * t) / size)), t.shape)
    return np.abs(np.moveaxis(value, -1, -2)), np.moveaxis((ahead - value) / (step * value), -1, -2)


def _real(
    coefficients: FloatArray, points: ComplexArray, rounding: FloatArray, kind: str
) -> tuple[FloatArray, FloatArray, IntArray]:
    """Real values (..., d) of the unknown, rising, NaN last; how far from being real; how many roots lie there, or 0.

    Where roots lie together, a complex pair x +- i s is tried as the two values x + s and x - s.
    """
    real, count = polynomials.nearness(coefficients, points, rounding)
    place = polynomials.angle_of(points) if kind == "angle" else points
    with np.errstate(invalid="ignore"):
        values = np.where(real, place.real + np.where(count > 1, place.imag, 0), np.nan)
        gap = np.where(real, 0.0, np.nan_to_num(np.abs(place.imag), nan=1.0, posinf=1.0))
    order = np.argsort(values, axis=-1)
    values, gap, count = (np.take_along_axis(item, order, -1) for item in (values, gap, np.where(real, count, 0)))
    return values, gap, count
