"""All poses that conditions leave, complex ones counted.

Linear forms are solved first; n - 1 quadrics in the n coordinates that are left have 2^(n-1) common zeros. Four
coordinates are solved by elimination, more by homotopy from x_i^2 = c_i x_0^2. Where there are more quadrics than that,
ranks of their multiples tell the poses apart from what is at infinity; or the same number of combinations of them by
chance are solved, which have all poses among their zeros, each as isolated as it was. Six sums of |p|^2, p, R' p, R and
1 have forty zeros that are poses, and are followed from those (`sections.toml`): the degree of the rigid motions in the
space of these sums (M. Gallet, G. Nawratil, J. Schicho 2015; F. Ronga, T. Vust 1995).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import Frame
from assur.kinematics.platforms.conditions import Conditions
from assur.kinematics.platforms.soma import PAIRS, SIZE, STUDY, frames_of, norm_of, products, spheres
from assur.model.file.toml_source import read_toml
from assur.numerics.expanded import ExpandedSystem
from assur.numerics.homotopy import PathEnd, solve
from assur.numerics.monodromy import all_solutions, random_complex
from assur.numerics.overdetermined_quadrics import zeros_apart
from assur.numerics.path_tracking import polished
from assur.numerics.quadratic_systems import quadratic
from assur.numerics.rotations import cross
from assur.results.reading import file_text

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
FILE = Path(__file__).parent / "sections.toml"
DIGITS = 5
FREEDOMS, MOST = 6, 40
ELIMINATED = 4
"""Unknowns from which on systems are solved by homotopy."""
ATTEMPTS, FEW = 3, 4
"""Ways that are tried where paths are lost, if there are few: where many are, poses are not isolated."""
REAL = 1e-6
"""Largest imaginary part of a pose that is tried as a real one, its largest coordinate being 1."""
DOUBTFUL = 1e-8
"""The same, above which it may be a real one or not."""
INFINITE, NEARLY_INFINITE, FAR = 1e-12, 1e-6, 1e-4
"""N(e), the largest coordinate being 1, of what is no pose; where zeros meet they are known to half of the digits. What
is farther away than a thousand sizes is no pose that a limb reaches, so that nothing real is lost by the second; nor by
the third, a hundred sizes, up to which ends are left that are not regular: there poses near infinity meet it."""
ZERO, NOT_ZERO = 1e-8, 1e-6
"""Up to where a condition holds at a zero of combinations, and from where it does not."""


@dataclass(frozen=True, eq=False)
class Poses:
    """All poses of a platform.

    Attributes:
        frames: of the real ones.
        soma: (K, 8) of all.
        infinite: how many zeros are no poses, but at infinity.
        unknown: zeros of which it is not known whether they are poses, or real.
        most: how many zeros were looked for.
    """

    frames: tuple[Frame, ...]
    soma: ComplexArray
    infinite: int
    unknown: int
    most: int

    @property
    def complex(self) -> int:
        """How many complex poses there are, the real ones among them."""
        return len(self.soma)

    @property
    def sure(self) -> bool:
        """Whether these are certainly all."""
        return not self.unknown

    def right(self, conditions: Conditions) -> str:
        """What was solved, and what came of it."""
        answer = f"{len(conditions.quadrics)} quadrics that limbs hold the platform to"
        answer += f": {self.complex} complex poses of at most {self.most}, {len(self.frames)} of them real"
        return f"{answer}, and {self.infinite} zeros at infinity or nearly so" if self.infinite else answer


def poses_under(conditions: Conditions, size: float) -> Poses | None:
    """All poses under conditions in lengths `size`; None where these leave infinitely many.

    >>> from assur.kinematics.limbs.networks import limbs_of
    >>> from assur.kinematics.platforms.chains import held_series
    >>> from assur.kinematics.platforms.conditions import joined, series_conditions
    >>> from assur.model.registry import load_record
    >>> legs = [held_series(limb, {2 + 6 * k: 1.0}) for k, limb in enumerate(limbs_of(load_record("gough_stewart")))]
    >>> poses_under(joined(series_conditions(leg, 1.0) for leg in legs), 1.0).complex
    40
    """
    chart = _chart(conditions.linear)
    free = chart.shape[1] - 1
    if free < 0:
        return Poses((), np.zeros((0, SIZE), dtype=complex), 0, 0, 0)
    forms = _restricted(np.concatenate([conditions.quadrics, STUDY[None]]), chart)
    if len(forms) < free:
        return None
    known: list[Poses] = []
    for seed in range(ATTEMPTS):
        zeros = _zeros(conditions, forms, chart, np.random.default_rng(seed))
        known.append(_sorted_out(conditions, zeros, chart, size))
        if known[-1].sure or known[-1].unknown > FEW:
            break
    return min(known, key=lambda poses: poses.unknown)


def _zeros(conditions: Conditions, forms: FloatArray, chart: FloatArray, rng: np.random.Generator) -> _Zeros:
    free = chart.shape[1] - 1
    if free == len(forms) == SIZE - 1 and len(conditions.spheres) == FREEDOMS:
        return _followed(_sections(conditions.spheres, rng), start()[1], chart)
    apart = zeros_apart(forms, chart[:4].T @ chart[:4]) if len(forms) > free >= ELIMINATED else None
    if apart is not None:
        return _Zeros(apart, np.ones(len(apart), dtype=bool), 0, np.full(len(apart), INFINITE))
    combined = _combined(forms, free, rng)
    solved = _eliminated(combined) if free < ELIMINATED else None
    return solved if solved is not None else _followed(*_from_squares(combined, rng), chart)


@dataclass(frozen=True, eq=False)
class _Zeros:
    """Coordinates (N, n), of which the regular zeros are certain; how many paths were lost; N(e) of what is no pose."""

    values: ComplexArray
    regular: NDArray[np.bool_]
    lost: int
    infinite: FloatArray


def _sorted_out(conditions: Conditions, zeros: _Zeros, chart: FloatArray, size: float) -> Poses:
    soma = _scaled(zeros.values @ chart.T)
    missed = np.max(np.abs(products(soma) @ conditions.quadrics.T), axis=1, initial=0.0)
    infinite = np.abs(norm_of(soma)) <= zeros.infinite
    off = np.max(np.abs(soma.imag), axis=1, initial=0.0)
    regular = zeros.regular & (missed <= ZERO) & ~infinite
    real = regular & (off <= REAL)
    unknown = ~infinite & (missed <= NOT_ZERO) & (~regular | (off > DOUBTFUL) & (off <= REAL))
    places = frames_of(soma[real].real)
    frames = tuple(zip(places[0], places[1] * size, strict=True))
    lost = int(np.sum(unknown)) + zeros.lost
    return Poses(frames, soma[regular], int(np.sum(infinite)), lost, len(soma) + zeros.lost)


def _chart(linear: FloatArray) -> FloatArray:
    """Columns (8, n) that span what linear forms leave, turned by chance: no zero has a first coordinate 0."""
    left = np.linalg.svd(np.concatenate([linear, np.zeros((1, SIZE))]))[2][len(linear) :]
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(len(left), len(left))))[0]
    return np.eye(SIZE) if len(left) == SIZE else left.T @ turn


def _restricted(quadrics: FloatArray, chart: FloatArray) -> FloatArray:
    """Symmetric matrices (r, n, n), orthonormal, of quadrics (R, 36) of the coordinates that are left."""
    matrices = np.zeros((len(quadrics), SIZE, SIZE))
    matrices[:, PAIRS[:, 0], PAIRS[:, 1]] = quadrics
    own = chart.T @ (matrices + np.swapaxes(matrices, 1, 2)) @ chart
    _, sizes, right = np.linalg.svd(own.reshape(len(own), -1), full_matrices=False)
    return np.asarray(right[sizes > ZERO].reshape(-1, *own.shape[1:]))


def _combined(forms: FloatArray, count: int, rng: np.random.Generator) -> ComplexArray:
    """As many combinations by chance, or the forms themselves."""
    if len(forms) == count:
        return forms.astype(complex)
    return np.tensordot(_mixture(count, len(forms), rng), forms, axes=1)


def _mixture(rows: int, columns: int, rng: np.random.Generator) -> ComplexArray:
    """Orthonormal complex rows by chance."""
    return np.linalg.qr(random_complex(rng, columns * rows).reshape(columns, rows))[0].T


def _eliminated(forms: ComplexArray) -> _Zeros | None:
    """None where zeros that are no poses are not isolated, or only by the digits to which a file's axes are written."""
    if not len(forms):
        return _Zeros(np.ones((1, 1), dtype=complex), np.ones(1, dtype=bool), 0, np.full(1, INFINITE))
    roots = quadratic(forms)
    if not roots.isolated or roots.error >= ZERO:
        return None
    values = np.column_stack([np.ones(len(roots.values)), roots.values])
    return _Zeros(values, np.ones(len(values), dtype=bool), 0, np.full(len(values), NEARLY_INFINITE))


def _followed(system: ExpandedSystem, starts: ComplexArray, chart: FloatArray) -> _Zeros:
    ends = solve(system, starts, lambda x: np.abs(norm_of(_scaled(x @ chart.T))) <= NEARLY_INFINITE)
    kept = ends.end != PathEnd.lost
    regular = ends.end[kept] == PathEnd.regular
    return _Zeros(ends.x[kept], regular, int(np.sum(~kept)), np.where(regular, INFINITE, FAR))


def _scaled(x: ComplexArray) -> ComplexArray:
    """With 1 as the largest coordinate."""
    return x / np.take_along_axis(x, np.argmax(np.abs(x), axis=1)[:, None], axis=1)


def _from_squares(forms: ComplexArray, rng: np.random.Generator) -> tuple[ExpandedSystem, ComplexArray]:
    """x_i^2 = c_i x_0^2 on the straight way to forms (n - 1, n, n), and all zeros of the first."""
    count = forms.shape[-1]
    first, second = np.triu_indices(count)
    last = forms[:, first, second] * np.where(first == second, 1, 2)
    factors = np.exp(2j * np.pi * rng.uniform(size=count - 1))
    squares = ((first == second) & (first == np.arange(1, count)[:, None])).astype(complex)
    squares[:, 0] = -factors
    coefficients = np.stack([last, squares - last])[None]
    signs = np.array([*product((1.0, -1.0), repeat=count - 1)])
    starts = np.column_stack([np.ones(len(signs)), signs * np.sqrt(factors)])
    return ExpandedSystem(coefficients, np.column_stack([first, second]), count), starts


def _sections(last: FloatArray, rng: np.random.Generator) -> ExpandedSystem:
    """Six quadrics (6, 36) on the straight way from those of the file, each set orthonormal."""
    return _between(np.linalg.qr(start()[0].T)[0].T, _mixture(FREEDOMS, FREEDOMS, rng) @ last)


def _between(first: ComplexArray, last: NDArray[np.inexact]) -> ExpandedSystem:
    coefficients = np.zeros((1, 2, SIZE - 1, len(PAIRS)), dtype=complex)
    coefficients[0, 0, :FREEDOMS], coefficients[0, 1, :FREEDOMS] = last, first - last
    coefficients[0, 0, FREEDOMS] = STUDY
    return ExpandedSystem(coefficients, PAIRS, SIZE)


@lru_cache(maxsize=1)
def start() -> tuple[ComplexArray, ComplexArray]:
    """Six generic complex quadrics (6, 36), sums of |p|^2, p, R' p, R and 1, and all their poses (40, 8)."""
    data = read_toml(file_text(FILE), str(FILE)).data
    sums = np.array(data["sums"]).reshape(FREEDOMS, -1, 2) @ [1, 1j]
    rough = np.array(data["poses"]).reshape(-1, SIZE, 2) @ [1, 1j]
    quadrics = (sums @ spheres()).astype(np.complex128)
    system = _between(quadrics, quadrics)
    return quadrics, polished(system, rough, np.ones(len(rough)), np.zeros(len(rough), dtype=int))[0]


def start_from_nothing(seed: int) -> tuple[ComplexArray, ComplexArray]:
    """What the file holds, by monodromy: sums (6, 17) and a pose by chance, then all the other poses."""
    rng = np.random.default_rng(seed)
    e, p = random_complex(rng, 4), random_complex(rng, 3)
    soma = np.array([*e, -(p @ e[1:]), *(e[0] * p + cross(p, e[1:]))])
    sums = random_complex(rng, FREEDOMS * len(spheres())).reshape(FREEDOMS, -1).round(DIGITS)
    values = (products(soma[None]) @ spheres().T)[0]
    sums[:, -1] = -(sums[:, :-1] @ values[:-1]) / values[-1]
    return sums, all_solutions(_family, sums.ravel(), soma, MOST, rng)


def _family(first: ComplexArray, last: ComplexArray) -> ExpandedSystem:
    return _between(*(sums.reshape(FREEDOMS, -1) @ spheres() for sums in (first, last)))


def write_start(seed: int) -> None:
    """The file anew. Its poses are rounded; Newton's method brings them back."""
    sums, poses = start_from_nothing(seed)
    lines = [f"# By write_start of poses.py, seed {seed}: generic complex sums and all their poses, parts of numbers."]
    for name, table, digits in (("sums", sums, None), ("poses", poses, DIGITS)):
        lines.append(f"{name} = [")
        for row in table.tolist():
            parts = [part if digits is None else round(part, digits) for z in row for part in (z.real, z.imag)]
            lines.append(f"  [{', '.join(map(repr, parts))}],")
        lines.append("]")
    FILE.write_text("\n".join([*lines, ""]))
