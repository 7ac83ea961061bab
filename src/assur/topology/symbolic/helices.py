"""Whether the pitch of a helical joint makes a difference in a chain.

It makes none where the chain translates along the helix's axis anyway: then the joint counts as a revolute. A chain
that does so when it is displaced at will may not do so as written, or where its end link is held to fewer orientations.
"""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.directions import Vector, parallel
from assur.topology.symbolic.blocks import structure
from assur.topology.symbolic.elementary import Elementary, Slide, Turn
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import translations
from assur.topology.symbolic.spans import Span


def coupled(chain: Sequence[Elementary], moved: Span) -> Refusal | None:
    """Why a chain has no POC set because of a pitch; None where no pitch makes a difference.

    Args:
        chain: with helical joints or without.
        moved: its pure translations as it is held, with helical joints taken for revolute ones.

    >>> z = (0.0, 0.0, 1.0)
    >>> print(coupled([Turn(z, "H1", pitch=True), Turn((1.0, 0.0, 0.0), "R1")], Span()).reason)
    the pitch of H1 couples a rotation and a translation
    """
    if moved.dim == 3:
        return None
    for place, part in enumerate(chain):
        if isinstance(part, Turn) and part.pitch and not (part.direction and _absorbed(chain, place, part.direction)):
            return Refusal(f"the pitch of {part.name} couples a rotation and a translation")
    return None


def _absorbed(chain: Sequence[Elementary], place: int, axis: Vector) -> bool:
    """Whether the links that only slides and parallel axes join to a helical joint translate along its axis."""
    first, last = place, place + 1
    while first > 0 and _keeps(chain[first - 1], axis):
        first -= 1
    while last < len(chain) and _keeps(chain[last], axis):
        last += 1
    return translations(structure(chain[first:last])).contains(axis)


def _keeps(part: Elementary, axis: Vector) -> bool:
    """Whether what follows keeps its angle to an axis."""
    if isinstance(part, Slide) or not part.finite:
        return True
    return parallel(part.direction, axis)
