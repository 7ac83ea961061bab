"""Modes: names of branches, written as signs in the order that the mechanism's file declares."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from types import SimpleNamespace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.model.mechanism import MechanismRecord

Problem = Literal["direct", "inverse"]
Method = Literal["auto", "closed form", "loops", "search"]
"""By what an answer is sought; see `assur.kinematics.position.direct`."""
SYMBOLS = {1: "+", -1: "-", 0: "0"}


def sign_names(record: MechanismRecord, problem: Problem) -> tuple[str, ...]:
    """Signs that name a branch: the assembly signs of the direct problem, the working signs of the inverse one."""
    return tuple(record.modes.assembly if problem == "direct" else record.modes.working)


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


def numbered(texts: NDArray[np.str_], exists: NDArray[np.bool_]) -> NDArray[np.str_]:
    """Texts (..., K) that tell solutions apart: those that several solutions of one problem share get a number.

    >>> numbered(np.array(["+", "-", "+", "+"]), np.array([True, True, True, False])).tolist()
    ['+/1', '-', '+/2', '']
    >>> numbered(np.array(["", ""]), np.array([True, True])).tolist()
    ['1', '2']
    """
    longest = texts.dtype.itemsize // 4 + 1 + len(str(texts.shape[-1]))
    answer = np.zeros(texts.shape, dtype=f"<U{longest}")
    for place in np.ndindex(texts.shape[:-1]):
        rows = np.flatnonzero(exists[place])
        own = texts[place][rows]
        for k, row in enumerate(rows):
            number = int(np.sum(own[: k + 1] == own[k]))
            shared = int(np.sum(own == own[k])) > 1 or not own[k]
            answer[(*place, row)] = f"{own[k]}{'/' if own[k] else ''}{number}" if shared else own[k]
    return answer


def is_of_mode(labels: NDArray[np.str_], mode: str) -> NDArray[np.bool_]:
    """Which labels (..., K) a mode means: that one, or, where it has no number, all that share its signs.

    >>> is_of_mode(np.array(["+/1", "+/2", "-"]), "+").tolist()
    [True, True, False]
    """
    return np.asarray((labels == mode) | np.char.startswith(labels, f"{mode}/"))


def sign_axes(names: Sequence[str], batch_axes: int = 1) -> SimpleNamespace:
    """Both values of every sign, each along a leading axis of its own, so that one call gives all branches."""
    axes = {}
    for place, name in enumerate(names):
        shape = [1] * (len(names) + batch_axes)
        shape[place] = 2
        axes[name] = np.array([1.0, -1.0]).reshape(shape)
    return SimpleNamespace(**axes)
