"""Helical joints: their pitch couples a rotation with a translation, which a POC set cannot say.

Where the chain translates along the axis anyway, the pitch makes no difference and the joint counts as a revolute.
"""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.directions import Vector
from assur.topology.poc import Mark, PocSet
from assur.topology.rules.blocks import structure
from assur.topology.rules.derivation import Derivation, Step
from assur.topology.rules.elementary import Elementary, Slide, Turn
from assur.topology.rules.motion import Motion
from assur.topology.rules.orientations import Orientations
from assur.topology.rules.refusals import Refusal
from assur.topology.rules.spaces import translations
from assur.topology.rules.spans import Span, along
from assur.topology.rules.vectors import aligned


def coupled(chain: Sequence[Elementary]) -> str | None:
    """Name of the first helical joint whose pitch makes a difference; None where there is none.

    >>> z = (0.0, 0.0, 1.0)
    >>> coupled([Turn(z, "H1", pitch=True), Turn((1.0, 0.0, 0.0), "R1")])
    'H1'
    """
    helices = [(place, item) for place, item in enumerate(chain) if isinstance(item, Turn) and item.pitch]
    if not helices or translations(structure(chain)).dim == 3:
        return None
    for place, item in helices:
        if item.direction is None or not _absorbed(chain, place, item.direction):
            return item.name
    return None


def lone_helix(turn: Turn, axis: Vector) -> Motion:
    """A helical joint alone: one translation and one rotation that are one element."""
    mark = Mark("parallel", (turn.name,), (axis,))
    poc = PocSet(1, 1, 1, mark, mark)
    step = Step("union", (poc,), (turn.name,), poc, "", "")
    said = "so the end link has one translation and one rotation, which its pitch makes one element"
    return Motion(
        translations=Span(),
        rotations=along(axis),
        orientations=Orientations(1, (axis,)),
        freedoms=1,
        given=poc,
        helical=True,
        derive=lambda: Derivation(turn.name, "on the axis", (), step, (), said),
    )


def pitch_refusal(chain: Sequence[Elementary]) -> Refusal | None:
    """Why the rules give no answer for a chain with helical joints, where they do not."""
    name = coupled(chain)
    return Refusal(f"the pitch of {name} couples a rotation and a translation") if name else None


def _absorbed(chain: Sequence[Elementary], place: int, axis: Vector) -> bool:
    """Whether the links that only slides and parallel axes join to a helical joint translate along its axis."""
    first, last = place, place + 1
    while first > 0 and _keeps(chain[first - 1], axis):
        first -= 1
    while last < len(chain) and _keeps(chain[last], axis):
        last += 1
    return translations(structure(chain[first:last])).contains(axis)


def _keeps(item: Elementary, axis: Vector) -> bool:
    """Whether what follows keeps its angle to an axis."""
    if isinstance(item, Slide) or not item.finite:
        return True
    return item.direction is not None and aligned(item.direction, axis)
