"""What holds the parts of a link together: webs between the plates of a fork, posts under a platform, stands.

None of it is in the joint graph; it is drawn, so that a link is one piece.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from assur.scene.shapes import Bar, Cylinder
from assur.scene.skeleton import JointMark, Rod, Skeleton

FloatArray = NDArray[np.float64]
ALONG = 0.9
"""A hinge whose axis runs along its stand by more than this cosine has a post in place of lugs."""


def webs(skeleton: Skeleton, rod: Rod, aside: FloatArray, radius: float) -> Iterator[Cylinder]:
    """Spacers between two plates at +-`aside` (3,): in the middle, or in the quarters where a joint is there.

    A rod that slides in a tube has one near its far end.
    """
    of_link = [mark for mark in skeleton.marks if rod.link in (mark.joint.parent, mark.joint.child)]
    middle = rod.points.mean(axis=0)
    shares: tuple[float, ...] = (0.5,)
    if any(
        min(float(np.linalg.norm(place - middle)) for place in (mark.at, mark.rail)) < 4 * radius for mark in of_link
    ):
        shares = (0.25, 0.75)
    for mark in of_link:
        if mark.telescopes and mark.joint.child == rod.link:
            far = np.linalg.norm(mark.rail - rod.points[1]) > np.linalg.norm(mark.rail - rod.points[0])
            shares = (0.85 if far else 0.15,)
    for share in shares:
        place = rod.points[0] + share * (rod.points[1] - rod.points[0])
        yield Cylinder(place - aside, place + aside, radius)


def posts(skeleton: Skeleton, level: float, radius: float) -> Iterator[Cylinder]:
    """From the middle of every bar of the platform up to a height in its frame."""
    link = skeleton.record.platform.link
    rotation, origin = skeleton.frames[link]
    ends = [rod.points for rod in skeleton.rods if rod.link == link]
    for plate in skeleton.plates:
        if plate.link == link:
            ends += [plate.points[[k, k - 1]] for k in range(len(plate.points))]
    for pair in ends:
        foot = pair.mean(axis=0)
        height = level - float((foot - origin) @ rotation[:, 2])
        if height > radius:
            yield Cylinder(foot, foot + height * rotation[:, 2], radius)


def stand(mark: JointMark, way: FloatArray, reach: float, size: float) -> Iterator[Bar | Cylinder]:
    """What holds a joint over a plate or a carriage that lies by `way` (3,) from it: two lugs, or a post.

    A post holds a ball, and a hinge whose axis runs along the way.
    """
    foot, along = mark.at + way, way / np.linalg.norm(way)
    if not len(mark.axes) or abs(float(mark.axes[0] @ along)) > ALONG:
        yield Cylinder(foot, mark.at + 0.5 * size * along, 1.7 * size)
        return
    for sense in (1.0, -1.0):
        aside = sense * reach * mark.axes[0]
        yield Bar(mark.at + aside, foot + aside, mark.axes[0], 1.15 * size, 0.6 * size)
