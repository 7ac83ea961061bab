r"""The equation of motion as a LaTeX document: term for term, each after the definitions that it needs first."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping

from assur.kinematics.validation.check import METRES
from assur.machine.forces.motion_formulas import MotionFormulas
from assur.model.pose import LENGTHS
from assur.numerics.recording.tape import Operation, Tape
from assur.results.latex_text import letter

HEAD = r"""\documentclass[10pt,a4paper]{article}
\usepackage{amsmath}
\setlength{\textwidth}{176mm}\setlength{\oddsidemargin}{-8.4mm}
\setlength{\textheight}{240mm}\setlength{\topmargin}{-14mm}
\allowdisplaybreaks
\begin{document}
"""
LONG = 90
"""Letters of a formula from which on it has a name of its own."""
DIGITS = 12
TERMS = {
    "Rates of the inputs": "D",
    "Gravity": "g",
    "Mass matrix": "M",
    "Bias": "c",
    "What is needed along each coordinate": "r",
    "Forces of the actuators": "tau",
}
SUM, PRODUCT, ATOM = 1, 2, 3


def document(formulas: MotionFormulas) -> str:
    """The whole document.

    >>> from assur.machine.forces.motion_formulas import motion_formulas
    >>> from assur.model.registry import load_record
    >>> text = document(motion_formulas(load_record("three_upu")))
    >>> text.count("begin{document}"), "M}_{11} &=" in text
    (1, True)
    """
    text = "\n".join(_lines(formulas))
    order = re.findall(r"^\\sigma_\{(\d+)\} &=", text, re.MULTILINE)
    numbers = {old: str(place) for place, old in enumerate(order, 1)}
    text = re.sub(r"(?<=\\sigma_\{)\d+", lambda old: numbers[old[0]], text)
    return HEAD + text + "\n\\end{document}\n"


def _lines(formulas: MotionFormulas) -> Iterator[str]:
    record, tape = formulas.record, formulas.tape
    pose = [letter(name) for name in record.platform.pose]
    name, unit = record.name.replace("_", r"\_"), record.unit
    metre = "" if METRES[unit] == 1.0 else "u "
    yield rf"\section*{{Equation of motion of {name}{f', working mode ${formulas.mode}$' if formulas.mode else ''}}}"
    angles = [letter(name) for name in record.platform.pose if name not in LENGTHS]
    units = f"{unit} and rad" if angles and len(angles) < len(pose) else "rad" if angles else unit
    yield rf"With the pose $\mathbf x = ({', '.join(pose)})$ in {units}, its rates, its accelerations, and"
    yield r"forces $\mathbf f$ on the platform along these coordinates, the actuators exert $\boldsymbol\tau$:"
    yield rf"\[ \mathbf D^{{\mathsf T}} \boldsymbol\tau = \mathbf r = {metre}(\mathbf M \ddot{{\mathbf x}} + \mathbf c)"
    yield r"+ \mathbf g - \mathbf f \]"
    if metre:
        yield rf"with $u = {_number(METRES[unit])}$\,m/{unit}."
    if len(record.drives) > len(pose):
        yield r"With more actuators than freedoms $\boldsymbol\tau$ is the least that does."
    if angles:
        yield "; ".join(rf"$c_{{{name}}} = \cos {name}$, $s_{{{name}}} = \sin {name}$" for name in angles) + "."
    yield rf"Masses are in kg, forces in N, torques in N\,{unit}. Masses and places without a letter are those of the"
    yield "file. The dimensions are"
    values = dict(zip(tape.uniform, formulas.values.tolist(), strict=True))
    yield f"${', '.join(f'{letter(name)} = {_number(value)}' for name, value in values.items())}$."
    book = _Book(tape)
    for title, kind in TERMS.items():
        rows = {own: entry for own, entry in tape.outputs.items() if own.split()[0] == kind}
        yield rf"\subsection*{{{title}}}"
        yield from _aligned([*book.needed(rows), *book.rows(rows)])
        yield "Entries that are not there are zero." + (r" $\mathbf M$ is symmetric." if kind == "M" else "")


def _given(name: str) -> str:
    r"""What is given for each motion: coordinates of the pose, their rates and accelerations, forces on the platform.

    >>> print(_given("x'"), _given("x''"), _given("f_x"), _given("y"), _given("cos phi"))
    \dot{x} \ddot{x} f_{x} y c_{\phi}
    """
    word, _, angle = name.partition(" ")
    if angle:
        return rf"{word[0]}_{{{letter(angle)}}}"
    stem = name.rstrip("'")
    if stem != name:
        return rf"\{'d' * (len(name) - len(stem))}ot{{{letter(stem)}}}"
    return f"f_{{{letter(name[2:])}}}" if name.startswith("f_") else letter(name)


def _indexed(name: str) -> str:
    """`M 0,1` as a matrix entry, counted from 1."""
    kind, place = name.split()
    bold = r"\boldsymbol{\tau}" if kind == "tau" else rf"\mathbf{{{kind}}}"
    return rf"{bold}_{{{''.join(str(int(number) + 1) for number in place.split(','))}}}"


def _aligned(pairs: list[tuple[str, str]]) -> Iterator[str]:
    if pairs:
        yield r"\begin{align*}"
        yield " \\\\\n".join(f"{name} &= {text}" for name, text in pairs)
        yield r"\end{align*}"


class _Book:
    """Texts of the entries of a tape; what is used more than once, or is long, has a definition, an output its name."""

    def __init__(self, tape: Tape) -> None:
        uses = Counter(k for operation in tape.operations for k in operation.arguments)
        names = {"varying": iter(tape.varying), "uniform": iter(tape.uniform)}
        outputs = {entry: name for name, entry in reversed([*tape.outputs.items()])}
        self._tape = tape
        self._definitions: dict[int, tuple[str, str]] = {}  # by entry, those that are still to be written
        self._texts: list[tuple[str, int]] = []
        for k, operation in enumerate(tape.operations):
            if operation.name in names:
                self._texts.append((_given(next(names[operation.name])), ATOM))
                continue
            text, bond = _written(operation, [self._texts[a] for a in operation.arguments])
            simple = operation.name in ("number", "negative") and len(text) < LONG // 3
            if not simple and (k in outputs or uses[k] > 1 or (uses[k] == 1 and len(text) > LONG)):
                count = sum(name.startswith(r"\sigma") for name, _ in self._definitions.values())
                name = _indexed(outputs[k]) if k in outputs else rf"\sigma_{{{count + 1}}}"
                self._definitions[k] = name, text
                text, bond = name, ATOM
            self._texts.append((text, bond))

    def needed(self, rows: Mapping[str, int]) -> Iterator[tuple[str, str]]:
        """Definitions, each once, that rows ask for and that were not written before."""
        asked, left = set[int](), list(rows.values())
        while left:
            arguments = self._tape.operations[left.pop()].arguments
            left += {*arguments} - asked
            asked |= {*arguments}
        return (self._definitions.pop(k) for k in sorted(asked & {*self._definitions}))

    def rows(self, rows: Mapping[str, int]) -> Iterator[tuple[str, str]]:
        """Entries of a term, but those that definitions needed."""
        for name, entry in rows.items():
            own, text = self._definitions.pop(entry, (_indexed(name), self._texts[entry][0]))
            if own != text:
                yield own, text


def _written(operation: Operation, texts: list[tuple[str, int]]) -> tuple[str, int]:
    name = operation.name
    if name == "number":
        return _number(operation.number), ATOM if operation.number >= 0 else SUM
    if name == "root":
        return rf"\sqrt{{{texts[0][0]}}}", ATOM
    if name == "/":
        return rf"\frac{{{texts[0][0]}}}{{{texts[1][0]}}}", PRODUCT
    if name == "negative":
        return f"-{_held(texts[0], PRODUCT)}", SUM
    first, second = texts
    if name == "*":
        if first == second and first[1] == ATOM:
            return f"{first[0]}^{{2}}", PRODUCT
        if second[0][0].isdigit() and not first[0][0].isdigit():
            first, second = second, first  # numbers first
        return rf"{_held(first, PRODUCT)} \, {_held(second, PRODUCT)}", PRODUCT
    if second[0].startswith("-") and " " not in second[0]:  # the negative of something short
        return f"{first[0]} {'-' if name == '+' else '+'} {second[0][1:]}", SUM
    return f"{first[0]} {name} {_held(second, PRODUCT)}", SUM


def _held(text: tuple[str, int], least: int) -> str:
    return text[0] if text[1] >= least else rf"\left({text[0]}\right)"


def _number(value: float) -> str:
    r"""A number as LaTeX has it.

    >>> print(_number(0.5), _number(-1.5e-9))
    0.5 -1.5 \cdot 10^{-9}
    """
    mantissa, _, exponent = f"{value:.{DIGITS}g}".partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa
