"""What is asked of a synthesis: a motion, how many limbs of what length, where drives stand, what is wanted of κ."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal, get_args

from assur.errors import UnknownNameError, UsageError
from assur.synthesis.assembly import MEMBERS
from assur.synthesis.limbs import JOINT_KINDS, Actuators, LimbType
from assur.synthesis.required import MOTIONS, PARASITIC, RequiredMotion, motion_named
from assur.synthesis.virtual_chains import VIRTUAL_CHAINS, VirtualChain, rows_named

Novelty = Literal["", "known", "new"]
"""Whether mechanisms of the catalogue are listed alone, or all others; without either all are."""

ANY = (0, 99)
"""Every coupling degree."""


@dataclass(frozen=True)
class SynthesisQuestion:
    """What was asked for; see `question`."""

    motion: RequiredMotion
    limbs: int
    max_joints: int
    coupling: tuple[int, int]
    symmetric: bool
    actuators: Actuators
    members: int
    parasitic: bool = False
    rows: tuple[VirtualChain, ...] = ()
    idle: bool = False
    passive_slides: bool = True
    joints: tuple[str, ...] = ()
    novelty: Novelty = ""
    redundant: int = 0

    @property
    def drives(self) -> int:
        """Number of drives: one for each freedom, and redundant ones."""
        return self.motion.dim + self.redundant

    def unwanted(self, limb: LimbType) -> str:
        """Why a limb is not among those that are asked for, by its joints alone; empty where it is."""
        others = sorted(limb.joint_kinds.difference(self.joints)) if self.joints else []
        if others:
            return f"it has {' and '.join(others)}, and limbs of {', '.join(self.joints)} are asked for"
        if limb.passive_slides and not self.passive_slides:
            return "nothing drives it along its P or C, and limbs without passive slides are asked for"
        return ""

    def wants(self, limb: LimbType) -> bool:
        """Whether a limb is among those that are asked for, by its joints alone."""
        return not self.unwanted(limb)

    @property
    def hybrid(self) -> bool:
        """Whether some limbs begin with an inner loop and have two actuators."""
        return self.limbs < self.drives

    @property
    def by_families(self) -> bool:
        """Whether what is found is told by families, which are many."""
        return self.hybrid or self.parasitic or bool(self.rows)


def question(
    motion: str = "3T",
    limbs: int | None = None,
    max_joints: int = 5,
    coupling: tuple[int, int] = ANY,
    *,
    symmetric: bool = False,
    actuators: Actuators = "base",
    members: int = MEMBERS,
    parasitic: bool = False,
    idle: bool = False,
    passive_slides: bool = True,
    joints: Collection[str] = (),
    novelty: Novelty = "",
    redundant: int = 0,
) -> SynthesisQuestion:
    """What is asked of a synthesis.

    Limbs are series of R, P, C, U and parallelograms with axes parallel or perpendicular to each other, and S in limbs
    that constrain nothing; U counts as one joint. A series has one actuator. With fewer limbs than freedoms, limbs
    that begin with an inner loop of a catalogue have two, one in each of its branches.

    Args:
        motion: "3T", "2T1R", "3T1R" or "3T3R"; T counts translations, R rotations (one of them about z). Or one of
            `virtual_chains`, as "1T2R" for all of its rows and "1T2R:UP" for one.
        limbs: number of limbs, by default that of drives; half of it, rounded up, is the least.
        max_joints: of a limb, on the way through one branch of its inner loop.
        coupling: least and largest coupling degree, Eq. (6).
        symmetric: only mechanisms of equal limbs. Without it, also the simplest of those with different limbs.
        actuators: "base" where the first joint of each limb is driven (R, P or the translation of C), "leg" where it is
            the first P between two joints that turn, "any" for any one R, P or C.
        members: of each family of different limbs so many are listed, the simplest, and known ones.
        parasitic: the motion is that at home, and others come with it: by limbs of three joints at most, whose
            constraints at home leave it, and a finite motion of each mechanism that is listed. One limb more than the
            motion has freedoms is passive, and alone constrains the platform.
        idle: whether limbs that follow a virtual chain may have one R that stays at rest.
        passive_slides: whether limbs may have P, or C along its axis, that nothing drives.
        joints: kinds of joints that limbs are made of, of `JOINT_KINDS`; all where it is empty.
        novelty: whether only mechanisms of the catalogue are listed, or all others.
        redundant: so many drives more than freedoms.

    Errors:
        UnknownNameError: another motion, or kind of joint. UsageError: another number of limbs, or an empty range.
    """
    name = motion.strip().upper()
    if not parasitic and name.partition(":")[0] not in {*MOTIONS, *VIRTUAL_CHAINS}:
        hint = "T counts translations, R rotations: 3T is three translations without rotation"
        raise UnknownNameError("motion", motion, {*MOTIONS, *VIRTUAL_CHAINS}, hint=hint)
    rows = () if parasitic or name in MOTIONS else rows_named(motion)
    target = rows[0] if rows else motion_named(motion, among=PARASITIC if parasitic else MOTIONS)
    if redundant < 0:
        raise UsageError(f"{redundant} redundant drives; give none or more")
    drives = target.dim + redundant
    number = drives if limbs is None else limbs
    if parasitic and number not in (drives, drives + 1):
        raise UsageError(
            f"{number} limbs for {target.name} that others come with; each has one drive, and at most one has none",
            hint=f"give {drives}, or {drives + 1} of which one has no drive",
        )
    if idle and not rows:
        raise UsageError(
            f"idle joints for {target.name}, whose limbs are written without",
            hint=f"motions by virtual chains may have them: {', '.join(VIRTUAL_CHAINS)}, of 3T as 3T:PPP",
        )
    if rows and number != drives:
        raise UsageError(f"{number} limbs for {target.name}, whose limbs have one drive each; give {drives}")
    least = max(2, math.ceil(drives / 2))
    if not parasitic and not least <= number <= drives:
        raise UsageError(
            f"{number} limbs for {target.name}; a limb has one actuator, or two with an inner loop",
            hint=f"give {least} to {drives}, or leave the number out for {drives}",
        )
    if number < drives and actuators == "leg":
        raise UsageError(
            f"{number} limbs for {target.name} with actuators in the legs; with inner loops they stand on the base",
            hint=f"leave out the place of the actuators, or ask for {drives} limbs",
        )
    if max_joints < 1:
        raise UsageError(f"at most {max_joints} joints in a limb; allowed: 1 or more", hint="5 finds all known ones")
    if not 0 <= coupling[0] <= coupling[1]:
        raise UsageError(f"coupling degrees {coupling[0]}..{coupling[1]}: there are none", hint="give them as 0..1")
    if actuators not in get_args(Actuators):
        raise UnknownNameError("place of the actuators", actuators, get_args(Actuators))
    for kind in joints:
        if kind not in JOINT_KINDS:
            raise UnknownNameError("kind of joint", kind, JOINT_KINDS)
    if members < 1:
        raise UsageError(f"{members} members of each family; one at least")
    return SynthesisQuestion(
        motion=target,
        limbs=number,
        max_joints=max_joints,
        coupling=coupling,
        symmetric=symmetric,
        actuators=actuators,
        members=members,
        parasitic=parasitic,
        rows=rows,
        idle=idle,
        passive_slides=passive_slides,
        joints=tuple(kind for kind in JOINT_KINDS if kind in joints),
        novelty=novelty,
        redundant=redundant,
    )
