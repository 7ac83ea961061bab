"""Sides: what a sign says of the places of a few joints, where one sentence holds at every assembly by chance."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations, permutations

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closing_blocks.ball_ends import with_ball_ends
from assur.kinematics.closing_blocks.blocks import PLATFORM
from assur.kinematics.closing_blocks.by_name import sorted_by_name
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance
from assur.kinematics.closing_blocks.distinguishing import ModeSign
from assur.model.mechanism import MechanismRecord
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]
MOST = 5
"""Joints of a sign that are few: those of a limb with two rods."""
CLEAR = 1e-6
"""Share of a whole below which a side is not told from none."""
EITHER = 4
"""Assemblies on each side at least, for a sentence to be held against them."""
PARALLEL = 1e-9
"""Sine of the angle between axes up to which they are parallel: they are written, or turned by a limb's angle."""


def side(record: MechanismRecord, sign: ModeSign) -> str:
    """The first sentence that is true where a sign is +, and false where it is -; "" where none is.

    Left and right are seen from where the axis of the first hinge points to: against it.

    >>> from assur.kinematics.closing_blocks.distinguishing import distinguishing_signs
    >>> from assur.model.registry import load_record
    >>> record = load_record("planar_3rrr")
    >>> print(side(record, distinguishing_signs(record, "inverse")[0]))
    leg1.B lies on the right of the line from leg1.A to leg1.C
    """
    ended = with_ball_ends(record)
    joints = sorted(sign.joints, key=lambda name: (name == PLATFORM, name))  # no order of a file decides a word
    if len(joints) > MOST:
        return ""
    screws = ScrewColumns(ended, _assemblies(ended), sign.needs_platform(ended))
    signs = sign.signs(screws)
    for value, positive, negative in _sentences(screws, joints):
        clear = (np.abs(value) > CLEAR) & (signs != 0)
        same, own = (value > 0)[clear], (signs > 0)[clear]
        if min(np.sum(own), np.sum(~own)) < EITHER:
            continue
        if np.all(same == own):
            return positive
        if np.all(same != own):
            return negative
    return ""


def _assemblies(record: MechanismRecord) -> FloatArray:
    """Those (N, n) by chance, which are known of the mechanism whose joints are sorted by name."""
    sorted_values = assemblies_by_chance(sorted_by_name(record))
    values = np.empty_like(sorted_values)
    values[:, [item.index for item in sorted(record.coordinates, key=lambda own: (own.joint, own.index))]] = (
        sorted_values
    )
    return values


def _sentences(screws: ScrewColumns, joints: list[str]) -> Iterator[tuple[FloatArray, str, str]]:
    """Values (N,), what is said where they are positive, and where they are negative; the plainest first."""
    types = {name: screws.record.joints[name].type for name in joints if name != PLATFORM}
    slides = [name for name, own in types.items() if own.slides and not own.turns]
    places = [name for name in joints if name not in slides]
    hinges = [name for name in places if name in types and types[name].turns == 1]
    length = characteristic_length(screws.record)
    for slide in slides:
        for near, far in combinations(places, 2):
            way = (_place(screws, far) - screws.centre(near)) / length
            value = np.einsum("ni,ni->n", way, screws.axis(slide))
            name = "the platform's point" if far == PLATFORM else far
            yield value, *(f"{name} lies {word} {near} along {slide}" for word in ("ahead of", "behind"))
    for hinge in hinges:
        for middle, end in permutations([name for name in places if name not in (hinge, PLATFORM)], 2):
            start, axis = screws.centre(hinge), screws.axis(hinge)
            arms = (screws.centre(end) - start) / length, (screws.centre(middle) - start) / length
            value = np.einsum("ni,ni->n", cross(*arms), axis)
            seen = "" if _planar(screws, hinges) else f", seen against the axis of {hinge}"
            yield (
                value,
                *(f"{middle} lies on the {word} of the line from {hinge} to {end}{seen}" for word in ("left", "right")),
            )
    for first, second, third in combinations(hinges, 3):
        value = np.einsum("ni,ni->n", cross(screws.axis(first), screws.axis(second)), screws.axis(third))
        yield value, *(f"the axes of {first}, {second} and {third} are {word}-handed" for word in ("right", "left"))


def _place(screws: ScrewColumns, name: str) -> FloatArray:
    """Point (N, 3) of a joint, or the platform's own, which follows all joints in their order."""
    if name != PLATFORM:
        return screws.centre(name)
    record = screws.record
    rotation, origin = frames(record, screws.values)[record.platform.link]
    return np.asarray(rotation @ record.platform.point + origin)


def _planar(screws: ScrewColumns, hinges: list[str]) -> bool:
    """Whether all axes are parallel at home, and there are no other turns among the places."""
    first, *others = (screws.axis(name)[0] for name in hinges)
    return len(hinges) > 1 and all(np.linalg.norm(cross(first, other)) < PARALLEL for other in others)
