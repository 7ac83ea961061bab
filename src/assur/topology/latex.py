r"""A topology as LaTeX: POC matrices, their intersection, and Eqs. (3) to (6) in numbers, as papers print them.

What is written is ASCII and needs amsmath and amssymb.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterator
from dataclasses import dataclass

from assur.results.plain_text import signed
from assur.topology.characteristics import characteristics
from assur.topology.facts import LimbFacts, Topology
from assur.topology.poc import Mark, PocSet
from assur.topology.symbolic.derivation import DerivationStep, PocDerivation

NEEDS = r"\usepackage{amsmath,amssymb}"
XI = r"\dim\left\{\left(\bigcap_{i=1}^{j} M_{b_i}\right) \cup M_{b_{j+1}}\right\}"
BROKEN = r"\notag \\"
SIGNS = {"union": r"\cup", "intersection": r"\cap"}
PER_LINE = 3
"""Matrices on one line."""

MATHEMATICAL = {
    **{sign: f"^{power}" for power, sign in enumerate("⁰¹²³")},
    **{"∥": r"\parallel", "⊥": r"\perp", "◇": r"\Diamond", "ρ": r"\rho"},
    **{"ξ": r"\xi", "Δ": r"\Delta", "κ": r"\kappa", "\N{MINUS SIGN}": "-", "-": "-"},
}
"""Signs that stand in prose, in mathematics."""

_INDEXED = re.compile(r"([A-Za-z]+?)(\d+[a-z]?|)")


@dataclass(frozen=True)
class Equation:
    """Its two sides in LaTeX, the number that the theory gives it, and what it says.

    A line break in the right side is where print may break it. `dim` is that of the set on the left, if it is one.
    """

    left: str
    right: str
    number: str
    meaning: str
    dim: int | None = None


def fragment(topology: Topology) -> str:
    r"""The table of characteristics and the equations, to be put into a document with the packages of `NEEDS`."""
    lines = [
        f"{equation.left} &= {equation.right}{_dimension(equation)}".replace("\n", f" {BROKEN}\n  &\\quad ")
        for equation in equations(topology)
    ]
    body = " \\\\\n".join(f"  {line}" for line in lines)
    equations_printed = f"{{\\allowdisplaybreaks\n\\begin{{align}}\n{body}\n\\end{{align}}}}"
    return f"% {_ascii(topology.name)}: needs {NEEDS}\n{characteristics_table(topology)}\n{equations_printed}"


def characteristics_table(topology: Topology) -> str:
    r"""The table of characteristics, a tabular of two columns."""
    rows = "".join(f"  {_prose(row.name)} & {_prose(row.text)} \\\\\n" for row in characteristics(topology))
    return f"\\begin{{tabular}}{{lp{{0.7\\linewidth}}}}\n  \\hline\n{rows}  \\hline\n\\end{{tabular}}"


def _prose(text: str) -> str:
    r"""A text with its signs in mathematics.

    >>> _prose("t³ r⁰(∥R_1), κ = 1")
    't$^3$ r$^0$($\\parallel$R\\_1), $\\kappa$ = 1'
    """
    return "".join(f"${MATHEMATICAL[sign]}$" if sign in MATHEMATICAL else _escaped(sign) for sign in text)


def _dimension(equation: Equation) -> str:
    return "" if equation.dim is None else rf", \quad \dim {equation.left} = {equation.dim}"


def equations(topology: Topology) -> tuple[Equation, ...]:
    """POC sets of limbs and platform, then freedoms, constraint degrees and coupling degree in numbers."""
    return (*_poc_sets(topology), *_freedoms(topology), *_degrees(topology))


def poc_matrix(poc: PocSet) -> str:
    r"""The matrix of a POC set, names of joints with their numbers as indices.

    >>> poc_matrix(PocSet(2, 1, 3, Mark("perpendicular", ("R12",)), Mark("parallel", ("R12",))))
    '\\begin{bmatrix} t^2(\\perp R_{12}) \\\\ r^1(\\parallel R_{12}) \\end{bmatrix}'
    """
    return dataclasses.replace(poc, t_mark=_lettered(poc.t_mark), r_mark=_lettered(poc.r_mark)).text("latex")


def name(text: str) -> str:
    r"""A joint's or a link's name in mathematics.

    >>> name("R3"), name("B3a"), name("Pa1"), name("slider_1")
    ('R_{3}', 'B_{3a}', '\\mathrm{Pa}_{1}', '\\mathrm{slider\\_1}')
    """
    match = _INDEXED.fullmatch(text)
    stem, index = match.groups() if match else (text, "")
    letters = stem if len(stem) == 1 else rf"\mathrm{{{_escaped(stem)}}}"
    return f"{letters}_{{{index}}}" if index else letters


def _lettered(mark: Mark) -> Mark:
    return dataclasses.replace(mark, names=tuple(map(name, mark.names)))


def _ascii(text: str) -> str:
    return text.encode("ascii", "replace").decode("ascii")


def _escaped(text: str) -> str:
    return re.sub(r"([&%$#_{}])", r"\\\1", _ascii(text))


def _poc_sets(topology: Topology) -> Iterator[Equation]:
    """The sets of inner loops and limbs, and what the limbs have in common: Eqs. (1) and (2)."""
    platform = next(
        (derivation for derivation in topology.derivations if derivation.whole.operation == "intersection"), None
    )
    parts = {derivation.of: derivation for derivation in (platform.parts if platform else topology.derivations)}
    for number, limb in enumerate(topology.limbs, 1):
        yield from _limb(number, limb, parts.get(f"limb {number}"))
    count = len(topology.limbs)
    if platform:
        yield _equation("M_{Pa}", platform.whole, "(2)", f"the platform; O' {platform.origin}")
    elif count != 1:
        common = rf"\bigcap_{{i=1}}^{{{count}}} M_{{b_i}} = " if count else ""
        yield Equation("M_{Pa}", common + poc_matrix(topology.poc), "(2)", "the platform, by twists", topology.poc.dim)


def _limb(number: int, limb: LimbFacts, part: PocDerivation | None) -> Iterator[Equation]:
    """The sets of its inner loops, and its own; another time if it has another one in the mechanism."""
    left, said = rf"M_{{b_{{{number}}}}}", f"limb {number}: {limb.text}"
    if part is None:
        yield Equation(left, poc_matrix(limb.poc), "(1)", f"{said}; by twists", limb.poc.dim)
        return
    for loop in part.parts:
        yield _equation(rf"M_{{{name(loop.of)}}}", loop.whole, "(2)", f"an inner loop of limb {number}")
    yield _equation(left, part.whole, "(1)", f"{said}; O' {part.origin}")
    result = part.whole.result
    if (result.t, result.r, result.dim) != (limb.poc.t, limb.poc.r, limb.poc.dim):
        said = f"limb {number} as it moves in the mechanism"
        yield Equation(f"{left}'", poc_matrix(limb.poc), "", said, limb.poc.dim)


def step_latex(step: DerivationStep) -> str:
    """A union or an intersection with its result."""
    return f"{_joined(step)} = {poc_matrix(step.result)}"


def _equation(left: str, step: DerivationStep, number: str, meaning: str) -> Equation:
    before = "" if step.operands == (step.result,) else f"{_joined(step)}\n= "
    return Equation(left, before + poc_matrix(step.result), number, meaning, step.result.dim)


def _joined(step: DerivationStep) -> str:
    sign = SIGNS[step.operation]
    sets = list(map(poc_matrix, step.operands))
    rows = [f" {sign} ".join(sets[start : start + PER_LINE]) for start in range(0, len(sets), PER_LINE)]
    return f"\n{sign} ".join(rows)


def _freedoms(topology: Topology) -> Iterator[Equation]:
    """Eqs. (4) and (3)."""
    if not topology.loops:
        return
    yield Equation(r"\xi_{L_j}", XI, "(4)", "independent equations of loop j")
    for number, loop in enumerate(topology.loops, 1):
        yield Equation(rf"\xi_{{L_{{{number}}}}}", str(loop.xi), "", f"loop {number}: {' '.join(loop.joints)}")
    total = topology.dof + sum(topology.xi)
    equations = " + ".join(map(str, topology.xi))
    equations = f"({equations})" if len(topology.loops) > 1 else equations
    internal = f", {topology.internal_freedoms} of them internal" if topology.internal_freedoms else ""
    sums = r"\sum_{i=1}^{m} f_i - \sum_{j=1}^{v} \xi_{L_j}"
    yield Equation("F", f"{sums} = {total} - {equations} = {topology.dof}", "(3)", f"degrees of freedom{internal}")


def _degrees(topology: Topology) -> Iterator[Equation]:
    """Eqs. (5) and (6)."""
    for number, loop in enumerate(topology.loops, 1):
        index = f"{{{number}}}"
        general = rf"\sum_{{i=1}}^{{m_{index}}} f_i - I_{index} - \xi_{{L_{index}}}"
        freedoms = f"({loop.freedoms} - {loop.internal})" if loop.internal else str(loop.freedoms)
        value = f"{freedoms} - {loop.inputs} - {loop.xi} = {signed(loop.delta)}"
        said = f"constraint degree of loop {number}" + (", internal freedoms left out" if loop.internal else "")
        yield Equation(rf"\Delta_{index}", f"{general} = {value}", "(5)", said)
    several = len(topology.assur_chains) > 1
    for number, chain in enumerate(topology.assur_chains, 1):
        values = " + ".join(f"|{signed(topology.loops[place].delta)}|" for place in chain.loops)
        general = r"\frac{1}{2} \min\left\{\sum_{j} |\Delta_j|\right\}"
        left = rf"\kappa_{{{number}}}" if several else r"\kappa"
        said = f"coupling degree of Assur chain {number}" if several else "coupling degree"
        yield Equation(left, rf"{general} = \frac{{1}}{{2}} ({values}) = {chain.coupling_degree}", "(6)", said)
