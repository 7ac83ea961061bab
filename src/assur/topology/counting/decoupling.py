"""Decoupling: which output of the platform depends on which input, as the zero pattern of the Jacobian.

Two routes. The twists give the Jacobian itself at some configurations. The theory locks every input but one
and asks for the POC set that is left: an output perpendicular to all of it does not depend on that input.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.topology.chains import Chain
from assur.topology.directions import NAMED
from assur.topology.screws.edges import Edge, along, at_generic, closure, column_names, input_columns, null_basis
from assur.topology.symbolic.intersection import parallel
from assur.topology.symbolic.locking import locked
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.union import serial

FloatArray = NDArray[np.float64]

OUTPUTS = ("x", "y", "z", "rx", "ry", "rz")
"""The platform's coordinates: along the base's axes, then about them."""

ZERO = 1e-8
"""Entries of the Jacobian below this share of its largest at the same configuration are zero."""


@dataclass(frozen=True)
class Decoupling:
    """depends[i][j]: whether output i depends on input j. Outputs that never change are left out."""

    outputs: tuple[str, ...]
    inputs: tuple[str, ...]
    depends: tuple[tuple[bool, ...], ...]

    @property
    def kind(self) -> str:
        """How far inputs and outputs are decoupled.

        >>> Decoupling(("x", "y"), ("P1", "P2"), ((True, True), (False, True))).kind
        'partial'
        """
        if all(all(row) for row in self.depends):
            return "none"
        return "full" if all(sum(row) == 1 for row in self.depends) else "partial"

    def inputs_of(self, output: str) -> tuple[str, ...]:
        """The inputs that an output depends on."""
        row = self.depends[self.outputs.index(output)]
        return tuple(name for name, used in zip(self.inputs, row, strict=True) if used)


def jacobian(edges: Sequence[Edge], base: str, platform: str) -> FloatArray | None:
    """Twist (N, 6, n) of the platform per rate of each input: velocity of O' in rows 0-2, rotation in rows 3-5.

    None where the inputs do not fix the platform's motion, or hinder each other. Internal freedoms do no harm.
    """
    edges = at_generic(edges)
    actuated = input_columns(edges)
    free = null_basis(closure(edges))
    moves = along(edges, base, platform) @ free
    rates = free[:, actuated, :]
    fixed = np.linalg.matrix_rank(rates, tol=1e-7)
    both = np.linalg.matrix_rank(np.concatenate([rates, moves], axis=1), tol=1e-7)
    if np.any(fixed < len(actuated)) or np.any(both > fixed):
        return None
    twists = moves @ np.linalg.pinv(rates)
    return np.concatenate([twists[:, 3:], twists[:, :3]], axis=1)


def by_jacobian(edges: Sequence[Edge], base: str, platform: str) -> Decoupling | None:
    """The zero pattern at the configurations of the edges' twists; None where there is no Jacobian."""
    matrix = jacobian(edges, base, platform)
    if matrix is None or not matrix.size:
        return None
    columns = column_names(edges)
    names = tuple(columns[index] for index in input_columns(edges))
    used = np.any(np.abs(matrix) > ZERO * np.max(np.abs(matrix), axis=(1, 2), keepdims=True), axis=0)
    kept = [row for row in range(len(OUTPUTS)) if used[row].any()]
    return Decoupling(
        tuple(OUTPUTS[row] for row in kept), names, tuple(tuple(bool(entry) for entry in used[row]) for row in kept)
    )


def by_rules(chains: Sequence[Chain], inputs: Sequence[str]) -> Decoupling | Refusal:
    """The same pattern from the theory, for a platform that does not turn and whose every limb keeps its orientation.

    Every input but one is locked; what the platform can then do are the translations that all limbs leave it.

    >>> from assur.topology.notation import parse_chains
    >>> tripod = parse_chains([f"P[{u}] R[{u}] R[{u}] R[{u}]" for u in "xyz"])
    >>> by_rules(tripod, ["P1", "P2", "P3"]).depends
    ((True, False, False), (False, True, False), (False, False, True))
    """
    columns = []
    for name in inputs:
        limbs: list[Motion | Refusal] = []
        for number, chain in enumerate(chains):
            left = locked(chain.elements, set(inputs) - {name}, number)
            if not left:
                return Refusal(f"a limb has no joint left when every input but {name} is locked")
            limbs.append(left if isinstance(left, Refusal) else serial(left, "translation"))
        motion = _meeting(limbs)
        if isinstance(motion, Refusal):
            return motion
        still = motion.translations.complement
        columns.append([not still.contains(axis) for axis in NAMED.values()])
    used = [tuple(row) for row in zip(*columns, strict=True)]
    kept = [index for index, row in enumerate(used) if any(row)]
    return Decoupling(tuple(OUTPUTS[index] for index in kept), tuple(inputs), tuple(used[index] for index in kept))


@dataclass(frozen=True)
class JudgedPattern:
    """The pattern, None where the routes differ; `refusal` says why the rules do not confirm it."""

    decoupling: Decoupling | None
    refusal: str = ""


def judged(rules: Decoupling | Refusal, twists: Decoupling) -> JudgedPattern:
    """The pattern of the Jacobian, unless the rules promise a zero where it has none: then neither is chosen.

    A pattern with more zeros than the theory promises is due to dimensions.
    """
    if isinstance(rules, Refusal):
        return JudgedPattern(twists, rules.reason)
    for output, row in zip(twists.outputs, twists.depends, strict=True):
        allowed = rules.inputs_of(output) if output in rules.outputs else ()
        for name, used in zip(twists.inputs, row, strict=True):
            if used and name not in allowed:
                reason = f"the rules say that {output} does not depend on {name}, the twists say that it does"
                return JudgedPattern(None, f"{reason}; one of them is wrong there, and neither is chosen")
    same = (rules.outputs, rules.depends) == (twists.outputs, twists.depends)
    return JudgedPattern(twists, "" if same else "the dimensions decouple more than the topology promises")


def _meeting(limbs: Sequence[Motion | Refusal]) -> Motion | Refusal:
    motions = [limb for limb in limbs if isinstance(limb, Motion)]
    refused = next((limb for limb in limbs if isinstance(limb, Refusal)), None)
    if refused is not None:
        return refused
    return motions[0] if len(motions) == 1 else parallel(motions, "translation")
