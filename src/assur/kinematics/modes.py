"""Modes: names of branches, written as signs in the order that the mechanism's file declares."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.model.formula import Formula
from assur.model.mechanism import MechanismRecord

Problem = Literal["direct", "inverse"]
Method = Literal["auto", "closed form", "loops", "search"]
"""By what an answer is sought; see `assur.kinematics.position.direct`."""
SYMBOLS = {1: "+", -1: "-", 0: "0"}
TURNED = "turned"
"""Follows a tilde in the name of a mode where the platform, that keeps its orientation about home, has another one."""


def sign_names(record: MechanismRecord, problem: Problem) -> tuple[str, ...]:
    """Signs that name a branch: the assembly signs of the direct problem, the working signs of the inverse one."""
    return tuple(record.modes.assembly if problem == "direct" else record.modes.working)


def written_quantities(record: MechanismRecord, problem: Problem) -> dict[str, Formula]:
    """The quantities by whose signs the file names the modes of a problem; none where it names none."""
    own = record.modes.assembly if problem == "direct" else record.modes.working
    return {name: formula for name, formula in own.items() if formula is not None}


def all_modes(record: MechanismRecord, problem: Problem) -> tuple[str, ...]:
    """Every mode, plus before minus, the last sign running fastest.

    >>> from assur.model.registry import load_record
    >>> all_modes(load_record("zeng2019"), "direct")[:3]
    ('+++', '++-', '+-+')
    """
    return tuple("".join(signs) for signs in itertools.product("+-", repeat=len(sign_names(record, problem))))


def sign_rows(record: MechanismRecord, problem: Problem) -> NDArray[np.float64]:
    """Signs (2^s, s) of every mode, in the order of `all_modes`.

    >>> from assur.model.registry import load_record
    >>> sign_rows(load_record("fivebar"), "inverse").tolist()
    [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
    """
    count = len(sign_names(record, problem))
    return np.array(list(itertools.product((1.0, -1.0), repeat=count))).reshape(2**count, count)


def mode_signs(record: MechanismRecord, problem: Problem, mode: str) -> tuple[int, ...]:
    """Signs (+1 or -1) of a mode's text; an unknown mode is refused with the valid ones.

    >>> from assur.model.registry import load_record
    >>> mode_signs(load_record("zeng2019"), "inverse", "++-++")
    (1, 1, -1, 1, 1)
    """
    choices = all_modes(record, problem)
    kind = "assembly mode" if problem == "direct" else "working mode"
    if mode and not sign_names(record, problem):
        raise UsageError(
            f"{record.name} has only one {kind}, which has no signs; found '{mode}'", hint="leave the mode out"
        )
    if mode not in choices:
        names = ", ".join(sign_names(record, problem))
        raise UnknownNameError(f"{kind} of {record.name}", mode, choices, hint=f"one sign + or - for each of: {names}")
    return tuple(1 if symbol == "+" else -1 for symbol in mode)


def mode_kernel_signs(record: MechanismRecord, problem: Problem, mode: str | None = None) -> SimpleNamespace:
    """Signs of a mode by name, as kernels take them; the file's default working mode where none is given.

    >>> from assur.model.registry import load_record
    >>> mode_kernel_signs(load_record("fivebar"), "inverse", "+-")
    namespace(s1=1.0, s2=-1.0)
    """
    signs = mode_signs(record, problem, mode or record.modes.default_working)
    return SimpleNamespace(**dict(zip(sign_names(record, problem), map(float, signs), strict=True)))


def mode_text(signs: Sequence[int] | NDArray[np.int8]) -> str:
    """Text of a mode from its signs; a sign that has merged to zero is written 0.

    >>> mode_text([1, 0, -1])
    '+0-'
    """
    return "".join(SYMBOLS[int(sign)] for sign in signs)


def mode_texts(signs: NDArray[np.int8]) -> NDArray[np.str_]:
    """Texts (...) of modes from their signs (..., s).

    >>> mode_texts(np.array([[1, 0, -1], [1, 1, 1]], dtype=np.int8)).tolist()
    ['+0-', '+++']
    """
    symbols = np.array([SYMBOLS[0], SYMBOLS[1], SYMBOLS[-1]])[signs]
    texts = np.zeros(signs.shape[:-1], dtype="<U1")
    for k in range(signs.shape[-1]):
        texts = np.char.add(texts, symbols[..., k])
    return texts


def lettered(texts: NDArray[np.str_], exists: NDArray[np.bool_]) -> NDArray[np.str_]:
    """Texts (..., K) that tell solutions apart: those whose signs several of one problem share get a letter after them.

    A letter is given in the order of the candidates, at every problem anew: it is not kept along paths. What follows a
    tilde, crossed parallelograms or that the platform is turned, is no sign.

    >>> lettered(np.array(["+", "-", "+", "+"]), np.array([True, True, True, False])).tolist()
    ['+a', '-', '+b', '']
    >>> lettered(np.array(["~Pa1", "~Pa1", ""]), np.array([True, True, True])).tolist()
    ['a~Pa1', 'b~Pa1', 'a']
    """
    answer = np.zeros(texts.shape, dtype=f"<U{texts.dtype.itemsize // 4 + 2}")
    for place in np.ndindex(texts.shape[:-1]):
        rows = np.flatnonzero(exists[place])
        own = texts[place][rows]
        for k, row in enumerate(rows):
            signs, tilde, crossed = str(own[k]).partition("~")
            letter = _letter(int(np.sum(own[:k] == own[k]))) if np.sum(own == own[k]) > 1 or not signs else ""
            answer[(*place, row)] = f"{signs}{letter}{tilde}{crossed}"
    return answer


def _letter(number: int) -> str:
    """a, b, ... z, aa, ab, ..."""
    return (_letter(number // 26 - 1) if number >= 26 else "") + chr(ord("a") + number % 26)


def without_letter(label: str) -> str:
    """The signs of a mode, and what follows its tildes.

    >>> without_letter("+-b~Pa1"), without_letter("a")
    ('+-~Pa1', '')
    """
    signs, tilde, crossed = label.partition("~")
    return signs.rstrip("abcdefghijklmnopqrstuvwxyz") + tilde + crossed


def is_of_mode(labels: NDArray[np.str_], mode: str) -> NDArray[np.bool_]:
    """Which labels (..., K) a mode means: that one, or, where it has no letter, all that share its signs.

    >>> is_of_mode(np.array(["+a", "+b", "-"]), "+").tolist()
    [True, True, False]
    """
    alike = [label == mode or without_letter(label) == mode for label in map(str, labels.reshape(-1))]
    return np.array(alike, dtype=bool).reshape(labels.shape)


def sign_axes(names: Sequence[str], batch_axes: int = 1) -> SimpleNamespace:
    """Both values of every sign, each along a leading axis of its own, so that one call gives all branches."""
    axes = {}
    for place, name in enumerate(names):
        shape = [1] * (len(names) + batch_axes)
        shape[place] = 2
        axes[name] = np.array([1.0, -1.0]).reshape(shape)
    return SimpleNamespace(**axes)
