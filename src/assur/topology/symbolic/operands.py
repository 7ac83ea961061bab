"""The operands of Eq. (1): how a chain falls into the sets whose union its end link's set is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from assur.topology.symbolic.blocks import Block, Item, Structure
from assur.topology.symbolic.elementary import Slide


@dataclass(frozen=True)
class Operand:
    """A part of a chain that is one set of the union, and the joints that it consists of."""

    structure: Structure
    names: tuple[str, ...]

    @property
    def text(self) -> str:
        """The joints as a list."""
        return ", ".join(self.names)


def operands(structure: Structure) -> tuple[Operand, ...]:
    """Slides, blocks of parallel axes, axes through one point, generalised joints; O' of the last one is the chain's.

    >>> from assur.topology.symbolic.blocks import structure
    >>> from assur.topology.symbolic.elementary import Turn
    >>> z, x = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    >>> [item.names for item in operands(structure([Turn(z, "R1"), Turn(z, "R2"), Turn(x, "R3")]))]
    [('R1', 'R2'), ('R3',)]
    """
    groups: list[list[Item]] = []
    for item in structure.items:
        if groups and _belongs(item, groups[-1]):
            groups[-1].append(item)
        else:
            groups.append([item])
    return tuple(_operand(group, structure) for group in groups)


def joints(operand: Operand) -> tuple[Operand, ...]:
    """The joints that an operand consists of, each alone; a generalised joint is not taken apart."""
    whole = operand.structure
    groups: list[list[Item]] = []
    for item in _apart(whole.items):
        if groups and isinstance(item, Block) and item.name in _names(groups[-1]):
            groups[-1].append(item)
        else:
            groups.append([item])
    return tuple(_operand(group, whole) for group in groups)


def _belongs(element: Item, group: Sequence[Item]) -> bool:
    """Whether an item is of the joint before it, or an axis through the point of those before it."""
    last = group[-1]
    if isinstance(element, Slide):
        return False
    if isinstance(last, Slide):
        return last.name == element.name
    alone = [other for other in (*group, element) if isinstance(other, Block) and len(other.lines) == 1]
    if len(alone) <= len(group):
        return False
    return bool(frozenset.intersection(*(block.lines[0].points for block in alone)))


def _apart(items: Sequence[Item]) -> Iterator[Item]:
    """Blocks as single axes with what stands between them."""
    for item in items:
        if isinstance(item, Slide):
            yield item
            continue
        first, *rest = item.lines
        yield replace(item, lines=(first,), inner=())
        yield from _apart(item.inner)
        for line in rest:
            yield replace(item, lines=(line,), inner=())


def _operand(items: Sequence[Item], whole: Structure) -> Operand:
    names = tuple(dict.fromkeys(_names(items)))
    rods = tuple(rod for rod in whole.rods if rod.name in names)
    return Operand(Structure(tuple(items), rods, whole.end), names)


def _names(items: Sequence[Item]) -> list[str]:
    names: list[str] = []
    for item in items:
        if isinstance(item, Slide):
            names.append(item.name)
        else:
            names += [item.name, *_names(item.inner), *(line.name for line in item.lines[1:])]
    return names
