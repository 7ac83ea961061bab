r"""The equation of motion as a LaTeX document: definitions in the order in which they are needed, then M, g and D."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from assur.machine.forces.motion_formulas import MotionFormulas
from assur.numerics.recording.tape import Operation, Tape

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
SUM, PRODUCT, ATOM = 1, 2, 3
GREEK = ("alpha", "beta", "gamma", "delta", "theta", "phi", "psi", "eta", "mu", "rho")


def document(formulas: MotionFormulas) -> str:
    """The whole document.

    >>> from assur.machine.forces.motion_formulas import motion_formulas
    >>> from assur.model.registry import load_record
    >>> text = document(motion_formulas(load_record("three_upu")))
    >>> text.count("begin{document}"), "M}_{11} &=" in text
    (1, True)
    """
    return HEAD + "\n".join(_lines(formulas)) + "\n\\end{document}\n"


def letter(name: str) -> str:
    r"""A name as it is written.

    >>> print(letter("l12"), letter("theta1"), letter("leg"))
    l_{12} \theta_{1} \mathrm{leg}
    """
    stem = name.rstrip("0123456789")
    word, number = stem.removesuffix("_"), name[len(stem) :]
    head = f"\\{word}" if word in GREEK else word if len(word) == 1 else rf"\mathrm{{{word.replace('_', ' ')}}}"
    return f"{head}_{{{number}}}" if number else head


def _lines(formulas: MotionFormulas) -> Iterator[str]:
    record, tape = formulas.record, formulas.tape
    pose = [letter(name) for name in record.platform.pose]
    name = record.name.replace("_", r"\_")
    yield rf"\section*{{Equation of motion of {name}, working mode ${formulas.mode}$}}"
    yield rf"With the pose $\mathbf x = ({', '.join(pose)})$ in {record.unit}, its rates $\mathbf v$, its accelerations"
    yield r"$\mathbf a$ and the force $\mathbf f$ on the platform, the actuators exert $\boldsymbol\tau$:"
    yield r"\[ \mathbf D^{\mathsf T} \boldsymbol\tau = \mathbf M \mathbf a + \mathbf c + \mathbf g - \mathbf f, \qquad"
    yield r"\mathbf c_i = \sum_{j,k} \Bigl(\frac{\partial \mathbf M_{ij}}{\partial \mathbf x_k}"
    yield r"- \frac12 \frac{\partial \mathbf M_{jk}}{\partial \mathbf x_i}\Bigr) \mathbf v_j \mathbf v_k \]"
    if len(record.drives) > len(pose):
        yield r"With more actuators than freedoms $\boldsymbol\tau$ is the least that does."
    yield rf"Masses are in kg, $\mathbf g$ and $\mathbf f$ in N, torques in N\,{record.unit}. Masses and places without"
    yield "a letter are those of the file. The dimensions are"
    values = dict(zip(tape.uniform, formulas.values.tolist(), strict=True))
    used = [name for name in tape.uniform if name in values]
    yield f"${', '.join(f'{letter(name)} = {_number(values[name])}' for name in used)}$."
    book = _Book(tape)
    yield r"\subsection*{Definitions}"
    yield from _aligned(book.definitions)
    for title, kind in (("Mass matrix", "M"), ("Gravity", "g"), ("Rates of the inputs", "D")):
        yield rf"\subsection*{{{title}}}"
        rows = [(own, entry) for own, entry in tape.outputs.items() if own.startswith(kind)]
        yield from _aligned([(_indexed(own), book.text(entry)[0]) for own, entry in rows])
        yield "Entries that are not there are zero." + (r" $\mathbf M$ is symmetric." if kind == "M" else "")


def _indexed(name: str) -> str:
    """`M 0,1` as a matrix entry, counted from 1."""
    kind, place = name.split()
    return rf"\mathbf{{{kind}}}_{{{''.join(str(int(number) + 1) for number in place.split(','))}}}"


def _aligned(pairs: list[tuple[str, str]]) -> Iterator[str]:
    if pairs:
        yield r"\begin{align*}"
        yield " \\\\\n".join(f"{name} &= {text}" for name, text in pairs)
        yield r"\end{align*}"


class _Book:
    """Texts of the entries of a tape; what is used more than once, or is long, has a definition."""

    def __init__(self, tape: Tape) -> None:
        uses = Counter(k for operation in tape.operations for k in operation.arguments)
        names = {"varying": iter(tape.varying), "uniform": iter(tape.uniform)}
        self.definitions: list[tuple[str, str]] = []
        self._texts: list[tuple[str, int]] = []
        for k, operation in enumerate(tape.operations):
            if operation.name in names:
                self._texts.append((letter(next(names[operation.name])), ATOM))
                continue
            text, bond = _written(operation, [self._texts[a] for a in operation.arguments])
            simple = operation.name in ("number", "negative") and len(text) < LONG // 3
            if not simple and (uses[k] > 1 or (uses[k] == 1 and len(text) > LONG)):
                self.definitions.append((rf"\sigma_{{{len(self.definitions) + 1}}}", text))
                text, bond = self.definitions[-1][0], ATOM
            self._texts.append((text, bond))

    def text(self, entry: int) -> tuple[str, int]:
        """Of an entry, and how firmly it holds together."""
        return self._texts[entry]


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
