"""Random mechanisms whose limbs share points and lines of base or platform, or turn about axes fixed there."""

import random

AXES = ("x", "y", "z")
MIDDLES = ("P[{b}] R[{a}]", "R[{a}] R[{a}]", "R[{a}] P[{b}]", "P[{b}] R[{a}] R[{a}]")
"""Of limbs between their ends; a is the axis of the planar group that most of them fill with one R more."""


def random_sharing_mechanism(rng: random.Random) -> list[str]:
    """Two to four limbs of three to five joints; a first or last axis of all or of some has a point in common.

    The kinds are those of the literature: U or R at the base, S or U or R at the platform, planar groups between them.
    """
    at_base, at_platform = rng.choice([(True, False), (False, True), (True, True), (False, False)])
    kinds = [_kind(rng) for _ in range(rng.choice([1, 1, 2]))]
    count = rng.choice([2, 3, 3, 4])
    sharing = rng.choice([count, count, 2])
    limbs = []
    for number in range(count):
        first, middle, last, axes = kinds[min(number, len(kinds) - 1) if number < 2 else -1]
        if rng.random() < 0.4:
            axes = rng.sample(AXES, 3)
        shares = number < sharing
        near, far = "@O" if at_base and shares else "", "@Q" if at_platform and shares else ""
        limbs.append(_limb(first, middle, last, axes, near, far))
    return limbs


def _kind(rng: random.Random) -> tuple[str, str, str, list[str]]:
    return (
        rng.choice(["R", "U", "S", "P", ""]),
        rng.choice(MIDDLES),
        rng.choice(["R", "U", "S", ""]),
        rng.sample(AXES, 3),
    )


def _limb(first: str, middle: str, last: str, axes: list[str], near: str, far: str) -> str:
    """The limb with a as the axis of its middle, b across it, c the axis at its ends."""
    a, b, c = axes
    starts = {"R": f"R[{c}]{near}", "U": f"U[{c}{near},{a}]", "S": f"S{near}", "P": f"P[{c}]", "": f"R[{a}]{near}"}
    ends = {"R": f"R[{c}]{far}", "U": f"U[{a},{c}{far}]", "S": f"S{far}", "": f"R[{a}]{far}"}
    return " ".join((starts[first], middle.format(a=a, b=b), ends[last]))
