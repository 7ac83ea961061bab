"""The steps of Eq. (1) as the papers print them: a chain's blocks, one after the other, with the reason of each."""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.poc import PocSet
from assur.topology.symbolic.base_point import poc_set
from assur.topology.symbolic.blocks import Structure
from assur.topology.symbolic.derivation import DerivationStep, PocDerivation, counted, in_words
from assur.topology.symbolic.meeting import GENERAL
from assur.topology.symbolic.operands import Operand, joints, operands


def chain_derivation(
    structure: Structure, name: str, parts: tuple[PocDerivation, ...], conditions: str
) -> PocDerivation:
    """How the set of a chain's end link follows from those of its joints.

    O' is any point of the end link where that makes no difference, as in the papers, and else on the last axis.

    Args:
        structure: the chain.
        name: what the derivation calls it.
        parts: derivations of its inner loops.
        conditions: where all this is so, to be said at the end.
    """
    anywhere, at_end = poc_set(structure), poc_set(structure, structure.end)
    point = GENERAL if anywhere.t == at_end.t else structure.end
    result = anywhere if point == GENERAL else at_end
    united = operands(structure)
    sets = [poc_set(operand.structure, point) for operand in united]
    inside = [step for operand, poc in zip(united, sets, strict=True) for step in _inside(operand, poc, point)]
    between = _between(united, sets, structure, point)
    whole = DerivationStep("union", tuple(sets), tuple(operand.text for operand in united), result, "", "")
    if len(united) == 1 and inside:
        whole = inside[0]
    origin = "at any point of the end link" if point == GENERAL else "on the last axis"
    said = f"so the end link has {in_words(result)}{conditions}"
    return PocDerivation(name, origin, parts, whole, (*inside, *between), said)


def _inside(operand: Operand, poc: PocSet, point: int) -> list[DerivationStep]:
    """How the joints of one block or one point make its set."""
    pieces = joints(operand)
    if len(pieces) < 2:
        return []
    sets = tuple(poc_set(piece.structure, point) for piece in pieces)
    reason = f"{in_words(poc)} of {operand.text}, {_independence(poc, sum(each.dim for each in sets))}"
    return [DerivationStep("union", sets, tuple(piece.text for piece in pieces), poc, "criterion C1", reason)]


def _between(
    united: Sequence[Operand], sets: Sequence[PocSet], structure: Structure, point: int
) -> list[DerivationStep]:
    """The union, one operand after the other."""
    steps: list[DerivationStep] = []
    count = len(united[0].structure.items) if united else 0
    for index in range(1, len(united)):
        before = steps[-1].result if steps else sets[0]
        count += len(united[index].structure.items)
        rods = tuple(
            rod for rod in structure.rods if any(rod in operand.structure.rods for operand in united[: index + 1])
        )
        prefix = Structure(structure.items[:count], rods, structure.end)
        poc = poc_set(prefix, point)
        steps.append(
            _union(before, sets[index], poc, ", ".join(operand.text for operand in united[:index]), united[index].text)
        )
    return steps


def _union(before: PocSet, added: PocSet, poc: PocSet, old: str, new: str) -> DerivationStep:
    rule = "linear rule" if poc.dim == before.dim + added.dim else "criterion C2"
    verb = "add" if "," in new else "adds"
    more = PocSet(poc.t - before.t, poc.r - before.r, 0)
    elements = in_words(more) if more.t or more.r else "no element"
    reason = f"{new} {verb} {elements}, {_independence(poc, before.dim + added.dim)}"
    return DerivationStep("union", (before, added), (old, new), poc, rule, reason)


def _independence(poc: PocSet, freedoms: int) -> str:
    """How many elements are independent, and how many freedoms make none."""
    text = "all independent" if not poc.dependent else f"{counted(poc.dependent, 'element')} not independent"
    if freedoms > poc.dim:
        text += f", {counted(freedoms - poc.dim, 'freedom')} without effect (dim M = {poc.dim})"
    return text
