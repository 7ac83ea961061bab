"""A chain in the one configuration as written, where more axes may be parallel than stay so.

A mechanism can leave that configuration in as many directions as it has freedoms there. Where that is more than it
has afterwards, it can go on in several modes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from assur.topology.directions import coplanar, parallel
from assur.topology.symbolic.blocks import Block, Structure
from assur.topology.symbolic.elementary import Elementary, Slide, Turn
from assur.topology.symbolic.meeting import GENERAL, Line
from assur.topology.symbolic.refusals import Refusal


def at_home(chain: Sequence[Elementary]) -> Structure | Refusal:
    """The chain with nothing turned: all parallel axes are one block, all axes with one label share a point.

    >>> x, y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    >>> [len(block.lines) for block in at_home([Turn(x, "R1"), Turn(y, "R2"), Turn(x, "R3")]).blocks]
    [2, 1]
    """
    points: dict[str, int] = {}
    blocks: list[tuple[Turn, dict[str, Line]]] = []
    rods: list[Line] = []
    for index, item in enumerate(chain):
        if isinstance(item, Slide):
            continue
        through = frozenset(points.setdefault(label, len(points)) for label in item.labels)
        line = Line(index, item.name, through)
        if not item.finite:
            rods.append(line)
            continue
        same = [lines for first, lines in blocks if parallel(first.direction, item.direction)]
        lines = same[0] if same else {}
        if not same:
            blocks.append((item, lines))
        known = next((label for label in item.labels if label in lines), next(iter(item.labels), f"#{index} alone"))
        lines[known] = replace(lines.get(known, line), points=lines.get(known, line).points | through)
    if any(_flat([turn for turn, lines in blocks if _pass(lines.values(), point)]) for point in points.values()):
        return Refusal("three axes through one point lie in one plane as written")
    slides = [slide for slide in chain if isinstance(slide, Slide)]
    turns = [Block(turn.direction, tuple(lines.values()), net=False) for turn, lines in blocks]
    last = chain[-1] if chain else None
    end = points.get(last.point, GENERAL) if isinstance(last, Turn) else GENERAL
    return Structure((*slides, *turns), tuple(rods), end)


def _pass(lines: Iterable[Line], point: int) -> bool:
    return any(point in line.points for line in lines)


def _flat(turns: Sequence[Turn]) -> bool:
    """Whether three or more axes lie in one plane."""
    axes = [turn.direction for turn in turns if turn.direction is not None]
    return len(axes) == len(turns) > 2 and all(coplanar(axes[0], axes[1], axis) for axis in axes[2:])
