"""The base point O': what of a chain's motion is seen at which point of its end link.

O' may be any point of the end link. On the last axis, or at the centre of the last joint, it moves least: the
rotation about that axis leaves it at rest.
"""

from __future__ import annotations

from assur.topology.poc import PocSet
from assur.topology.symbolic.blocks import Structure
from assur.topology.symbolic.marks import rotation_mark, translation_mark
from assur.topology.symbolic.meeting import GENERAL
from assur.topology.symbolic.spaces import rotations, translations
from assur.topology.symbolic.spans import Span


def translations_at(structure: Structure, point: int = GENERAL) -> Span:
    """Directions in which O' can move: T, and what rotations add.

    A spherical joint at O' adds to the motion space V exactly the rotations that leave O' at rest, so that the
    translations of the sum are the velocities of O'.
    """
    return translations(structure.with_sphere(point))


def poc_set(structure: Structure, point: int = GENERAL) -> PocSet:
    """The POC set of a chain, O' at one of its points or at a general point of its end link.

    >>> from assur.topology.symbolic.blocks import structure
    >>> from assur.topology.symbolic.elementary import Turn
    >>> chain = structure([Turn((0.0, 0.0, 1.0), "R1")])
    >>> print(poc_set(chain, chain.end), "|", poc_set(chain))
    t⁰ r¹(∥R1) | t¹(⊥(R1, ρ)) r¹(∥R1)
    """
    moved, turned = translations_at(structure, point), rotations(structure)
    return PocSet(
        moved.dim,
        turned.dim,
        translations(structure).dim + turned.dim,
        translation_mark(moved, structure),
        rotation_mark(turned, structure),
    )
