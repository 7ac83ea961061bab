"""What is known symbolically of an end link's motion: its POC set, and what an intersection needs beyond it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, get_args

from assur.errors import UnknownNameError
from assur.topology.directions import Vector
from assur.topology.poc import Mark, PocSet
from assur.topology.symbolic.at_home import at_home
from assur.topology.symbolic.base_point import poc_set
from assur.topology.symbolic.blocks import Structure, mirrored
from assur.topology.symbolic.bundles import bundles
from assur.topology.symbolic.chain_steps import chain_derivation
from assur.topology.symbolic.derivation import DerivationStep, PocDerivation, under
from assur.topology.symbolic.elementary import Elementary, Turn
from assur.topology.symbolic.helices import coupled
from assur.topology.symbolic.orientations import EVERY, UNTURNED, Orientations, held, orientations
from assur.topology.symbolic.refusals import Refusal
from assur.topology.symbolic.spaces import rotations, translations
from assur.topology.symbolic.spans import Span, along

Mode = Literal["free", "translation"]
"""A chain displaced at will, or a mechanism from the configuration as written; or an end link that does not turn."""


def check_mode(mode: str) -> None:
    """Refuse an unknown mode.

    Errors:
        UnknownNameError: neither "free" nor "translation".
    """
    if mode not in get_args(Mode):
        raise UnknownNameError("mode", mode, get_args(Mode))


@dataclass(frozen=True)
class Limb:
    """A chain as the rules see it, before anything holds its end link.

    Attributes:
        chain: its slides and turns.
        structure: the same, gathered into blocks.
        freedoms: sum of f_i; an inner loop counts as many as its output link has.
        conditions: where it is such a chain, in words.
        centre: label of the point that all axes run through, where they do.
        labels: every label of a point in it.
        parts: gives the derivations of its inner loops.
        name: how it is named in steps.
    """

    chain: tuple[Elementary, ...]
    structure: Structure
    freedoms: int
    conditions: tuple[str, ...] = ()
    centre: str = ""
    labels: frozenset[str] = frozenset()
    parts: Callable[[], tuple[PocDerivation, ...]] = field(default=tuple, repr=False, compare=False)
    name: str = ""


AT_REST = PocSet(0, 0, 0)
"""The set of a link that does not move."""


@dataclass(frozen=True)
class Motion:
    """The motion of an end link against the base.

    Attributes:
        translations: T, the pure translations.
        rotations: Omega, the directions that it rotates about; dim M = dim T + dim Omega.
        orientations: those that the end link takes.
        freedoms: sum of f_i of a chain; of a platform what its limbs leave it.
        conditions: where the motion is only such, in words.
        limb: the chain that makes it; None for a platform.
        structure: that chain, held to the orientations.
        given: the POC set where no chain makes it: of a platform, or of a helical joint alone.
        helical: whether a rotation advances along its axis.
        from_home: whether home alone proves it, whatever the limbs do by themselves.
        derive: gives the derivation.
    """

    translations: Span
    rotations: Span
    orientations: Orientations
    freedoms: int
    conditions: tuple[str, ...] = ()
    limb: Limb | None = None
    structure: Structure | None = None
    given: PocSet = AT_REST
    helical: bool = False
    from_home: bool = False
    derive: Callable[[], PocDerivation] | None = field(default=None, repr=False, compare=False)

    @cached_property
    def poc(self) -> PocSet:
        """The POC set with O' on the last axis or at its joint's centre; of a platform, at a general point."""
        return poc_set(self.structure, self.structure.end) if self.structure else self.given

    @cached_property
    def restated(self) -> PocSet:
        """The POC set at a general point of the end link."""
        return poc_set(self.structure) if self.structure else self.given

    @property
    def dim(self) -> int:
        """The number of independent elements, dim M."""
        return self.translations.dim + self.rotations.dim

    @property
    def passive(self) -> int:
        """Freedoms that do not move the end link."""
        return self.freedoms - self.dim

    @property
    def couples(self) -> Span:
        """Directions of the couples that it resists."""
        return self.rotations.complement

    @property
    def forces(self) -> Span:
        """Directions of the forces that it resists, on lines whose place depends on the chain's."""
        return self.translations.complement

    @property
    def concurrent(self) -> bool:
        """Whether all axes run through one point."""
        if self.structure is None:
            return False
        of = bundles(self.structure)
        return of.everything in of.points

    @cached_property
    def turns_about(self) -> str:
        """Label of the point of the end link, its last axis' or centre's, about which it can make all its rotations."""
        last = self.limb.chain[-1] if self.limb and self.limb.chain else None
        label = last.point if isinstance(last, Turn) else ""
        return label if label and not label.startswith("#") and self.poc.t == self.translations.dim else ""

    def seen_at(self, point: str) -> PocSet:
        """The POC set at a labelled point of the platform: on the limb's last axis, or else a general one."""
        places = dict(self.structure.ends) if self.structure else {}
        return poc_set(self.structure, places[point]) if self.structure and point in places else self.restated

    def pure_along(self, axis: Vector) -> bool:
        """Whether the force along an axis that it resists needs no couple about that axis.

        So it is where the chain turns about a parallel axis, where all axes run through one point, and where there
        is at most one rotation, or none about this axis.
        """
        if self.structure is None:
            return False
        if self.rotations.dim <= 1 or self.concurrent or self.structure.along(axis):
            return True
        return self.rotations.dim == 2 and not self.rotations.contains(axis)

    @property
    def derivation(self) -> PocDerivation:
        """The steps from joints or limbs to this motion."""
        if self.derive is None:
            raise ValueError("this motion was not derived")
        return self.derive()


def motion_of(limb: Limb, to: Orientations = EVERY) -> Motion | Refusal:
    """The motion of a chain's end link where it takes only some of the orientations that it could take."""
    taken = orientations(limb.structure).meet(to)
    if isinstance(taken, Refusal):
        return taken
    structure = held(limb.structure, taken)
    if isinstance(structure, Refusal):
        return structure
    return _moving(limb, structure, taken)


def seen_from_end(limb: Limb) -> Limb:
    """The chain as its end link sees it: with base and end link exchanged."""
    return replace(limb, chain=limb.chain[::-1], structure=mirrored(limb.structure))


def motion_at_home(limb: Limb) -> Motion | Refusal:
    """The motion of a chain's end link in the configuration as written, where it may have fewer elements."""
    structure = at_home(limb.chain)
    return structure if isinstance(structure, Refusal) else _moving(limb, structure, UNTURNED)


def _moving(limb: Limb, structure: Structure, taken: Orientations) -> Motion | Refusal:
    moved = translations(structure)
    refusal = coupled(limb.chain, moved)
    if refusal is not None:
        return refusal
    return Motion(
        translations=moved,
        rotations=rotations(structure),
        orientations=taken,
        freedoms=limb.freedoms,
        conditions=limb.conditions,
        limb=limb,
        structure=structure,
        derive=lambda: chain_derivation(structure, limb.name, limb.parts(), under(limb.conditions)),
    )


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
        derive=lambda: PocDerivation(turn.name, "on the axis", (), step, (), said),
    )
