"""What limbs say of a platform that turns in space, modulo a prime: polynomials of its pose, which are counted.

No loop equation is linear there. Poses of each limb are drawn, as soma coordinates e0 to e3 and g0 to g3; linear forms
and quadrics that are zero at all of these are what it says, as kinematics/platforms has them in floats. A pose and its
opposite coordinates, of N(e) = 1, are one.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import sympy
from flint import nmod_mat
from numpy.typing import NDArray

from assur.derivation.not_derived import NotDerivedError
from assur.derivation.residue_systems import Polynomial, ResidueSystem
from assur.derivation.symbols import GivenSymbols
from assur.derivation.witness import NoResidueRootError
from assur.joint_graph.tree import joint_graph
from assur.joints.steps import Step
from assur.kinematics.limbs.networks import Limb, ParallelParts, SeriesParts, limbs_of
from assur.kinematics.limbs.serial import NotSerialError, SerialLimb
from assur.kinematics.platforms.soma import PAIRS, SIZE, STUDY, composed_soma, products
from assur.numerics.vectors import Matrix, Vector

Residues = NDArray[np.object_]
UNKNOWNS = (tuple(f"e{k}" for k in range(4)), tuple(f"g{k}" for k in range(4)))
"""Soma coordinates: the platform's quaternion, and its product with the place."""
POSES = 2 * len(PAIRS)
"""That are drawn of a limb: more than quadrics have coefficients."""
OPPOSITE = np.array([1, -1, -1, -1, 1, -1, -1, -1])
"""Signs by which soma coordinates are those of the displacement back."""


def pose_system(symbols: GivenSymbols) -> ResidueSystem | None:
    """The platform's pose at drawn dimensions and inputs; each solution and its opposite are one.

    None where a dimension has no residue.

    Errors:
        NotDerivedError: limbs that are no series of joints and of parallelograms.

    >>> from assur.derivation.witness import ModularWitness
    >>> from assur.model.registry import load_record
    >>> from assur.numerics.prime_field import SMALL
    >>> system = pose_system(GivenSymbols(load_record("gough_stewart"), "direct", ModularWitness(1, SMALL)))
    >>> system.unknowns, len(system.polynomials)
    (8, 8)
    """
    drawn = _DrawnLimbs(symbols)
    try:
        drawn_poses = [drawn.poses(limb) for limb in limbs_of(symbols.record)]
    except NotSerialError as error:
        raise NotDerivedError(str(error)) from error
    except NoResidueRootError:
        return None
    own: list[list[int]] = []
    forms: list[list[int]] = []
    for soma in drawn_poses:
        forms += drawn.zero_at(soma)
        own += drawn.zero_at(products(soma))
    linear = [{_powers(k): part for k, part in enumerate(form) if part} for form in drawn.independent(forms, SIZE)]
    study = [[int(2 * part) for part in STUDY]]
    quadrics = [_quadric(row) for row in drawn.independent([*study, *own], len(PAIRS))]
    unit: Polynomial = {_powers(k, k): 1 for k in range(SIZE // 2)} | {_powers(): drawn.prime - 1}
    return ResidueSystem(drawn.prime, SIZE, (*linear, *quadrics, unit), even=True)


class _DrawnLimbs:
    """Poses of limbs modulo a prime, all joints but those held drawn."""

    def __init__(self, symbols: GivenSymbols) -> None:
        self.symbols, self.record = symbols, symbols.record
        self.prime: int = symbols.witness.field.p
        self._random = np.random.default_rng(self.prime)
        self._slices = joint_graph(symbols.record).slices

    def poses(self, limb: Limb) -> Residues:
        """Soma (N, 8) of the platform on a limb."""
        soma, link = self._constant((1, 0, 0, 0)), self.record.base
        for part in limb.parts if isinstance(limb, SeriesParts) else (limb,):
            own, link = self._part(part, link)
            soma = composed_soma(soma, own) % self.prime
        return soma

    def zero_at(self, rows: Residues) -> list[list[int]]:
        """What is zero at all rows."""
        kernel, count = nmod_mat((rows % self.prime).tolist(), self.prime).nullspace()
        return [[int(part) for part in row] for row in kernel.transpose().tolist()[:count]]

    def independent(self, rows: Sequence[Sequence[int]], width: int) -> list[list[int]]:
        """The reduced form of rows."""
        matrix, rank = nmod_mat(len(rows), width, [part for row in rows for part in row], self.prime).rref()
        return [[int(part) for part in row] for row in matrix.tolist()[:rank]]

    def _part(self, part: Limb, link: str) -> tuple[Residues, str]:
        """A series of joints, or a parallelogram of hinges by one of its sides, from a link to another."""
        parallel = isinstance(part, ParallelParts) and part.turned is not None
        series = part.parts[0] if isinstance(part, ParallelParts) and parallel else part
        if not isinstance(series, SerialLimb):
            raise NotDerivedError(f"{', '.join(part.joints)} are no series of joints, and no parallelogram")
        soma = self._constant((1, 0, 0, 0))
        for name in series.joints:
            joint = self.record.joints[name]
            steps = [*self._steps(name)]
            if joint.parent != link:
                steps = [own * OPPOSITE for own in reversed(steps)]
            link = joint.child if joint.parent == link else joint.parent
            *turns, last = steps
            for own in turns:
                soma = composed_soma(soma, own) % self.prime
            if parallel and name == series.joints[-1]:  # its second hinge turns back by what the first turns
                soma = composed_soma(soma, self._turned(soma[:, :4] * OPPOSITE[:4])) % self.prime
            soma = composed_soma(soma, last) % self.prime
        return soma, link

    def _steps(self, name: str) -> Iterator[Residues]:
        """A joint from its parent to its child; the last is a shift either way."""
        own, joint = self.symbols.geometry.joints[name], self.record.joints[name]
        yield self._shifted(np.array([[self._residue(part) for part in own.at]] * POSES, dtype=object))
        for step, first in joint.type.places:
            yield from self._moved(step, own.axes, self._slices[name].start + first)
        yield self._constant(self._quaternion(own.turn))
        yield self._shifted(np.array([[-self._residue(part) for part in own.child_at]] * POSES, dtype=object))

    def _moved(self, step: Step, axes: Sequence[Vector], index: int) -> Iterator[Residues]:
        """One elementary motion; a screw as a turn and a slide, which is all that can be said by polynomials."""
        if step.kind == "ball":
            yield self._turned(self._drawn(4))
            return
        axis = np.array([[self._residue(part) for part in axes[step.direction]]] * POSES, dtype=object)
        held = self.symbols.locked.get(index)
        if step.kind in ("turn", "screw"):
            half = self._drawn(2)
            if held is not None:
                cosine, sine = (self._residue(part) for part in held)
                half = np.array([[1 + cosine, sine]] * POSES, dtype=object)
            yield self._turned(np.concatenate([half[:, :1], half[:, 1:] * axis], axis=1))
        if step.kind in ("slide", "screw"):
            length = self._drawn(1)
            if held is not None and step.kind == "slide":
                length = np.array([[self._residue(held)]] * POSES, dtype=object)
            yield self._shifted(length * axis)

    def _quaternion(self, turn: Matrix) -> tuple[int, ...]:
        """Of a constant turn, of any length; of four such the first that is not zero."""
        r = sympy.Matrix(3, 3, [self._residue(part) for row in turn for part in row])
        w, *v = 1 + r.trace(), r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
        symmetric = r + r.T + (1 - r.trace()) * sympy.eye(3)  # four times v v'
        own = [(w, *v), *((v[k], *symmetric.row(k)) for k in range(3))]
        return next(row for row in (tuple(int(part) % self.prime for part in each) for each in own) if any(row))

    def _residue(self, formula: Any) -> int:
        real, imaginary = self.symbols.witness.value(sympy.sympify(formula))
        if imaginary:
            raise NoResidueRootError(f"{formula} has no residue")
        return real

    def _drawn(self, count: int) -> Residues:
        return self._random.integers(1, self.prime, (POSES, count)).astype(object)

    def _constant(self, quaternion: Sequence[int]) -> Residues:
        return self._turned(np.array([quaternion] * POSES, dtype=object))

    def _turned(self, quaternions: Residues) -> Residues:
        """Soma (N, 8) of turns (N, 4)."""
        return np.concatenate([quaternions, np.zeros_like(quaternions)], axis=1)

    def _shifted(self, places: Residues) -> Residues:
        """Soma (N, 8) of shifts (N, 3)."""
        soma = np.zeros((POSES, SIZE), dtype=object)
        soma[:, 0], soma[:, 5:] = 1, places
        return soma


def _powers(*places: int) -> tuple[int, ...]:
    return tuple(places.count(k) for k in range(SIZE))


def _quadric(row: Sequence[int]) -> Polynomial:
    return {_powers(*pair): part for pair, part in zip(PAIRS.tolist(), row, strict=True) if part}
