"""Names of modes on the joint graph: by the file's quantities where it has them, else by signs of closing blocks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import chain, count

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.modes import Problem, mode_text, sign_names, written_quantities
from assur.kinematics.named_signs import named_signs
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
STEMS: Mapping[Problem, tuple[str, str]] = {"inverse": ("s", "sigma"), "direct": ("e", "epsilon")}
"""Letters of signs: the second where the file has names like the first."""


@dataclass(frozen=True)
class DescribedSign:
    """A sign of a mode's name.

    Attributes:
        name: by which answers name it.
        letter: for figures: that of the file's quantity is its name, as of a letter with a number.
        meaning: what holds where it is +: the file's formula, or a sentence.
        places: names of the joints and points that it is about.
        written: whether it is that of a quantity in the file, else of a closing block.
    """

    name: str
    letter: str
    meaning: str
    places: tuple[str, ...]
    written: bool

    @property
    def said(self) -> str:
        """Name, letter and meaning in a line.

        >>> DescribedSign("leg1", "s1", "B1 lies ahead of A1 along P1", ("A1", "P1", "B1"), False).said
        'leg1 (s1) is +: B1 lies ahead of A1 along P1'
        """
        return f"{self.name} ({self.letter}) is +: {self.meaning}"


@lru_cache(maxsize=64)
def described_signs(record: MechanismRecord, problem: Problem) -> tuple[DescribedSign, ...]:
    """The signs of a problem's modes, in their order.

    >>> from assur.model.registry import load_record
    >>> [(sign.letter, sign.name) for sign in described_signs(load_record("planar_3rpr"), "inverse")]
    [('s1', 'leg1'), ('s2', 'leg2'), ('s3', 'leg3')]
    >>> described_signs(load_record("fivebar"), "inverse")[0].places
    ('B1',)
    """
    written = written_quantities(record, problem)
    if written:
        return tuple(
            DescribedSign(name, name, f"{formula.text} > 0", _places(record, formula.names), True)
            for name, formula in written.items()
        )
    from assur.kinematics.closing_blocks.kept import kept_signs  # which names in a file do without
    from assur.kinematics.closing_blocks.sentences import sentence, sign_name

    signs: dict[str, DescribedSign] = {}
    own = kept_signs(record, problem)
    # a closed form calls the signs of both problems by their names
    others = {sign.name for sign in described_signs(record, "inverse")} if problem == "direct" else set[str]()
    for letter, sign in zip(_letters(record, problem, len(own)), own, strict=True):
        name = sign_name(record, sign, {*signs} | others)
        places = tuple(joint for joint in sign.joints if joint in record.joints)
        signs[name] = DescribedSign(name, letter, sentence(record, sign), places, False)
    return tuple(signs.values())


def _places(record: MechanismRecord, names: frozenset[str]) -> tuple[str, ...]:
    """Joints and points whose values or coordinates a formula reads, in the file's order."""
    read = names | {name.rpartition(".")[0] for name in names}
    return tuple(name for name in (*record.joints, *record.points) if name in read)


def _letters(record: MechanismRecord, problem: Problem, number: int) -> list[str]:
    """s1, s2, ... or e1, e2, ..., none of which is a name in the file."""
    latin, greek = STEMS[problem]
    driven = {name for entry in record.inputs for name in (entry.name, entry.coordinate.joint)}
    taken = {*record.parameters, *record.joints, *record.points, *record.links, *record.angles, *driven}
    taken |= {*record.modes.working, *record.modes.assembly}
    rows = ([f"{stem}{k + 1}" for k in range(number)] for stem in chain((latin, greek), (latin * n for n in count(2))))
    return next(row for row in rows if taken.isdisjoint(row))


def sign_meanings(record: MechanismRecord, problem: Problem) -> Mapping[str, str]:
    """Name of each sign of a mode -> what holds where it is +: the file's formula, or a sentence.

    >>> from assur.model.registry import load_record
    >>> list(sign_meanings(load_record("fivebar"), "inverse").items())
    [('s1', 'sin(B1) > 0'), ('s2', 'sin(B2) > 0')]
    >>> print(sign_meanings(load_record("gough_stewart"), "inverse")["leg1"])
    B1 lies ahead of A1 along P1
    """
    return {sign.name: sign.meaning for sign in described_signs(record, problem)}


def signs_at(record: MechanismRecord, problem: Problem, joints: FloatArray, zero: float = 0.0) -> NDArray[np.int8]:
    """Signs (..., s) of a mode of a problem at joint values (..., n), in the order of `sign_meanings`.

    0 where a quantity of the file is within `zero` (rad, characteristic lengths), or a block is singular.
    """
    if written_quantities(record, problem):
        return named_signs(record, problem, joints, zero)
    from assur.kinematics.closing_blocks.kept import kept_signs_at  # which names in a file do without

    return kept_signs_at(record, problem, joints)


def declared_signs(
    record: MechanismRecord, problem: Problem, joints: FloatArray, zero: float = 0.0
) -> NDArray[np.int8]:
    """The same where the file or its closed form names the modes; (..., 0) where neither does."""
    if sign_names(record, problem):
        return signs_at(record, problem, joints, zero)
    return named_signs(record, problem, joints, zero)


def mode_names(record: MechanismRecord, joints: FloatArray) -> tuple[str, str]:
    """Working and assembly mode of joint values (n,), by signs alone; "" where there are none.

    >>> from assur.kinematics.home import home_values
    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rpr")
    >>> mode_names(record, home_values(record))
    ('+++', '+')
    """
    return mode_text(signs_at(record, "inverse", joints)), mode_text(signs_at(record, "direct", joints))
