"""Helical joints: their pitch couples a rotation with a translation, which a POC set cannot say.

Where the chain translates along the axis anyway, the pitch makes no difference and the joint counts as a revolute.
"""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.directions import Vector
from assur.topology.poc import Mark, PocSet
from assur.topology.symbolic.blocks import structure
from assur.topology.symbolic.derivation import Derivation, DerivationStep
from assur.topology.symbolic.elementary import Elementary, Turn
from assur.topology.symbolic.helices import coupled
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.orientations import Orientations
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import translations
from assur.topology.symbolic.spans import Span, along


def lone_helix(turn: Turn, axis: Vector) -> Motion:
    """A helical joint alone: one translation and one rotation that are one element."""
    mark = Mark("parallel", (turn.name,), (axis,))
    poc = PocSet(1, 1, 1, mark, mark)
    step = DerivationStep("union", (poc,), (turn.name,), poc, "", "")
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
    return coupled(chain, translations(structure(chain)))
