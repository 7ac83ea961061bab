"""Helical joints: their pitch couples a rotation with a translation, which a POC set cannot say.

Where the chain translates along the axis anyway, the pitch makes no difference and the joint counts as a revolute.
"""

from __future__ import annotations

from collections.abc import Sequence

from assur.topology.directions import Vector
from assur.topology.poc import Mark, PocSet
from assur.topology.rules.blocks import structure
from assur.topology.rules.derivation import Derivation, DerivationStep
from assur.topology.rules.elementary import Elementary, Turn
from assur.topology.rules.helices import coupled
from assur.topology.rules.motion import Motion
from assur.topology.rules.orientations import Orientations
from assur.topology.rules.refusals import Refusal
from assur.topology.rules.spaces import translations
from assur.topology.rules.spans import Span, along


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
