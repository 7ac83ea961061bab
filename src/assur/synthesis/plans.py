"""What a synthesis looks at for one motion: limbs by classes, and the sets of classes that could make mechanisms."""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

from assur.synthesis.arrangements import arranged_classes
from assur.synthesis.assembly import MechanismFamily, Range, Sought, assemble, known_members
from assur.synthesis.classes import Class, chosen_classes, classes, number_of_members
from assur.synthesis.following_limbs import classes_by_constraints, following_limbs, following_types, sets_leaving
from assur.synthesis.isomorphism import Key
from assur.synthesis.known_mechanisms import known_by_directions, known_mechanisms
from assur.synthesis.limb_motions import LimbVerdict, verdict
from assur.synthesis.limbs import hybrid_types, limb_types
from assur.synthesis.parasitic import limb_classes, moved
from assur.synthesis.positions import placements, positions
from assur.synthesis.question import SynthesisQuestion
from assur.synthesis.required import RequiredMotion
from assur.synthesis.virtual_chains import VirtualChain

Step = Callable[[int, int], None]
"""Called with (steps done, steps in all)."""


ASSEMBLED, MOVED, MEGABYTES = 0.003, 0.05, 0.015
"""What a mechanism costs that is looked at, as measured: seconds by twists at given poses, seconds where it is moved by
a finite amount, megabytes."""


@dataclass(frozen=True, eq=False)
class ClassSet:
    """One class for each limb.

    Attributes:
        chosen: the classes.
        members: mechanisms that it stands for.
        looked_at: so many of them are looked at, about.
        family: makes the family of those that have the motion.
    """

    chosen: tuple[Class, ...]
    members: int
    looked_at: int
    family: Callable[[], MechanismFamily]

    def may_have(self, key: Key) -> bool:
        """Whether a mechanism has one limb of each class, by its canonical form."""
        alike = all(any(limb.type.key == key[0] for limb in limbs) for limbs in self.chosen)
        return alike if len(set(key)) == 1 else bool(known_members(self.chosen, [key]))


@dataclass(frozen=True, eq=False)
class SearchPlan:
    """What is looked at for one motion.

    Attributes:
        classes: its limbs.
        sets: of their classes.
        left_out: number of limb types that have not the motion, by the reason.
        disagreements: limbs on which the two routes differ, in words.
        cut: whether Ctrl-C came while the limbs were looked at.
        seconds: that a mechanism takes.
    """

    classes: tuple[Class, ...]
    sets: tuple[ClassSet, ...]
    left_out: Counter[str] = field(default_factory=Counter)
    disagreements: tuple[str, ...] = ()
    cut: bool = False
    seconds: float = ASSEMBLED

    @property
    def effort(self) -> str:
        """About how long it takes to look at all sets, and how much memory, on a machine of today."""
        megabytes = math.ceil(self._looked_at * MEGABYTES)
        return f"{len(self.sets)} families, about {math.ceil(self.duration / 60)} min and {megabytes} MB"

    @property
    def duration(self) -> float:
        """Seconds that it takes to look at all sets, about."""
        return self._looked_at * self.seconds

    @property
    def _looked_at(self) -> int:
        return sum(some.looked_at for some in self.sets)

    @property
    def combinations(self) -> int:
        """Mechanisms that all sets stand for."""
        return sum(some.members for some in self.sets)


def plans(asked: SynthesisQuestion, steps: Sequence[Step], also: Sequence[Key] = ()) -> Iterator[SearchPlan]:
    """A plan for each motion with the name that is asked for, made when it is its turn.

    Args:
        asked: the question.
        steps: one for each plan, called with (limbs or sets of classes looked at, of how many).
        also: canonical forms of mechanisms that are listed however many joints they have, as known ones are.
    """
    if asked.parasitic:
        yield _parasitic(asked, steps[0], also)
    elif asked.rows:
        yield from (_following(asked, row, step, also) for row, step in zip(asked.rows, steps, strict=True))
    else:
        yield _by_directions(asked, steps[0], also)


def _by_directions(asked: SynthesisQuestion, step: Step, also: Sequence[Key]) -> SearchPlan:
    """By limbs whose motion is that of the platform at every point."""
    types = limb_types(asked.motion, asked.max_joints, asked.actuators)
    if asked.hybrid:
        types += hybrid_types(asked.motion, asked.max_joints)
    types = tuple(filter(asked.wants, types))
    turns = positions(asked.motion, asked.limbs)
    verdicts: list[LimbVerdict] = []
    cut = False
    try:
        for done, limb in enumerate(types):
            step(done, len(types))
            verdicts.append(verdict(limb, asked.motion, turns))
    except KeyboardInterrupt:
        cut = True
    usable = classes([judged.limb for judged in verdicts if judged.limb])
    known = (*known_mechanisms(asked.motion), *also)
    sought = _sought(asked, asked.motion, placements(asked.motion, asked.limbs), known)
    sets = (
        _class_set(some, sought) for some in chosen_classes(usable, asked.limbs, asked.drives, equal=asked.symmetric)
    )
    return SearchPlan(
        usable,
        () if cut else tuple(sets),
        Counter(judged.reason for judged in verdicts if judged.reason),
        tuple(judged.disagreement for judged in verdicts if judged.disagreement),
        cut,
    )


def _following(asked: SynthesisQuestion, row: VirtualChain, step: Step, also: Sequence[Key]) -> SearchPlan:
    """By limbs that follow a virtual chain."""
    every = following_types(row, asked.max_joints, asked.actuators, idle=asked.idle)
    types = tuple(filter(asked.wants, every))
    limbs = following_limbs(row, types, asked.limbs)
    usable = classes_by_constraints(limbs, row)
    known = (*known_mechanisms(row), *also)
    sets = (
        _class_set(chosen, dataclasses.replace(_sought(asked, row, (places,), known), reached=True), row.row)
        for chosen, places in sets_leaving(_sets(usable, asked, step), row)
    )
    return SearchPlan(usable, tuple(sets), Counter({"not the motion": len(types) - len(limbs)}))


def _sets(usable: Sequence[Class], asked: SynthesisQuestion, step: Step) -> Iterator[tuple[Class, ...]]:
    """One class for each limb, counted."""
    whole = len(usable) if asked.symmetric else math.comb(len(usable) + asked.limbs - 1, asked.limbs)
    for done, chosen in enumerate(chosen_classes(usable, asked.limbs, asked.drives, equal=asked.symmetric)):
        step(done, whole)
        yield chosen


def _parasitic(asked: SynthesisQuestion, step: Step, also: Sequence[Key]) -> SearchPlan:
    """By constraints at home, which leave the motion that is asked for."""
    every = limb_classes(asked.motion, asked.actuators, passive=asked.limbs > asked.drives)
    wanted = (tuple(limb for limb in some if asked.wants(limb.type)) for some in every)
    usable = tuple(some for some in wanted if some)
    known = [*(one.key for one in known_by_directions(asked.motion)), *also]
    sought = _sought(asked, asked.motion, (), known)
    sets = (
        _counted(one.chosen, one.members, sought, partial(moved, one, sought))
        for one in arranged_classes(_sets(usable, asked, step), asked.motion)
    )
    return SearchPlan(usable, tuple(sets), seconds=MOVED)


def _sought(
    asked: SynthesisQuestion, motion: RequiredMotion, placed: tuple[tuple[int, ...], ...], known: Sequence[Key]
) -> Sought:
    return Sought(motion, Range(*asked.coupling), placed, asked.symmetric, asked.members, known)


def _class_set(chosen: tuple[Class, ...], sought: Sought, row: str = "") -> ClassSet:
    return _counted(chosen, number_of_members(chosen), sought, partial(_assembled, chosen, sought, row))


def _counted(
    chosen: tuple[Class, ...], members: int, sought: Sought, family: Callable[[], MechanismFamily]
) -> ClassSet:
    """A set with the mechanisms that it stands for: of equal limbs all are looked at, of others the simplest."""
    if sought.symmetric:
        return ClassSet(chosen, len(chosen[0]), len(chosen[0]), family)
    return ClassSet(chosen, members, min(members, sought.members), family)


def _assembled(chosen: tuple[Class, ...], sought: Sought, row: str) -> MechanismFamily:
    family = assemble(chosen, sought)
    designs = tuple(dataclasses.replace(design, row=row) for design in family.designs)
    return dataclasses.replace(family, designs=designs)
