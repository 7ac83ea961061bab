"""A derivation: the steps by which a POC set was found, each with its rule and its reason, printed as the papers do."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from assur.topology.poc import PocSet, Style

Operation = Literal["union", "intersection"]

_OPERATORS: dict[Style, dict[Operation, str]] = {
    "unicode": {"union": " ∪ ", "intersection": " ∩ "},
    "ascii": {"union": " u ", "intersection": " n "},
    "latex": {"union": r" \cup ", "intersection": r" \cap "},
}


@dataclass(frozen=True)
class DerivationStep:
    """One application of Eq. (1) or Eq. (2).

    Attributes:
        operation: "union" in a serial chain, "intersection" between limbs.
        operands: the POC sets that are combined, at one O'.
        names: what each operand belongs to.
        result: what comes out.
        rule: by which it was decided: "linear rule", "criterion C1", "criterion C2", "location", ...
        reason: one sentence.
    """

    operation: Operation
    operands: tuple[PocSet, ...]
    names: tuple[str, ...]
    result: PocSet
    rule: str
    reason: str

    def text(self, style: Style = "unicode") -> str:
        """The equation alone.

        >>> r = PocSet(0, 1, 1)
        >>> DerivationStep("union", (r, r), ("R1", "R2"), PocSet(0, 2, 2), "linear rule", "").text("ascii")
        '[t^0; r^1] u [t^0; r^1] = [t^0; r^2]'
        """
        operator = _OPERATORS[style][self.operation]
        result = matrix(self.result, style)
        if len(self.operands) < 2:
            return result
        return f"{operator.join(matrix(poc, style) for poc in self.operands)} = {result}"


@dataclass(frozen=True)
class PocDerivation:
    """Steps and what follows from them.

    Attributes:
        of: what was derived: the chain's or the mechanism's name.
        origin: where O' is.
        parts: derivations that this one stands on: of inner loops, of limbs.
        whole: all operands and the result in one equation.
        steps: the same, two operands at a time.
        conclusion: one sentence in words.
    """

    of: str
    origin: str
    parts: tuple[PocDerivation, ...]
    whole: DerivationStep
    steps: tuple[DerivationStep, ...]
    conclusion: str

    def text(self, style: Style = "unicode") -> str:
        """The derivation on several lines: parts, steps with their reasons, the whole equation, the conclusion."""
        lines = [part.text(style) for part in self.parts]
        lines.append(f"{self.of}, O' {self.origin}:")
        for step in self.steps:
            lines += [f"  {step.text(style)}", f"    by {step.rule}: {step.reason}"]
        if not self.steps or self.steps[-1].operands != self.whole.operands:
            lines.append(f"  {self.whole.text(style)}")
        return "\n".join([*lines, f"  {self.conclusion}"])


def matrix(poc: PocSet, style: Style = "unicode") -> str:
    """A POC set as the matrix of the papers.

    >>> matrix(PocSet(3, 0, 3))
    '[t³; r⁰]'
    """
    if style == "latex":
        return poc.text(style)
    translation, rotation = re.split(r" (?=r[\\^⁰¹²³])", poc.text(style))
    return f"[{translation}; {rotation}]"


def under(conditions: Iterable[str]) -> str:
    """Conditions as the end of a sentence.

    >>> under(["P1 is a parallelogram"])
    ', while P1 is a parallelogram'
    """
    text = " and ".join(dict.fromkeys(conditions))
    return f", while {text}" if text else ""


_NUMBERS = ("no", "one", "two", "three", "four", "five", "six")


def in_words(poc: PocSet) -> str:
    """What a POC set says.

    >>> in_words(PocSet(3, 2, 5))
    'three translations and two rotations'
    """
    return f"{counted(poc.t, 'translation')} and {counted(poc.r, 'rotation')}"


def counted(number: int, noun: str) -> str:
    """A number of things.

    >>> counted(1, "rotation")
    'one rotation'
    """
    return f"{_NUMBERS[number] if number < len(_NUMBERS) else number} {noun}{'' if number == 1 else 's'}"
