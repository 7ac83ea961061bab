"""Planar inner loops with three freedoms, which the literature writes by a tag: 2P4R."""

from __future__ import annotations

from dataclasses import dataclass

from assur.topology.chains import ChainJoint, InnerLoop
from assur.topology.directions import Vector, parallel, perpendicular


@dataclass(frozen=True)
class PlanarLoop:
    """A loop of six joints R and P in one plane: its output link has t2 r1.

    Attributes:
        normal: direction of every R.
        sliders: its P, those at the heads of the branches first.
        tag: "2P4R".
    """

    normal: Vector
    sliders: tuple[ChainJoint, ...]
    tag: str


def planar_loop(loop: InnerLoop) -> PlanarLoop | None:
    """What a loop is as a planar one; None unless two branches of three R and P each move its link freely in a plane.

    Then every R is parallel to the others, no two of them in a branch on one line, every P is perpendicular to
    them and no two P of a branch are parallel; each branch has an R, so that the link can turn.
    """
    joints = [[part for part in branch if isinstance(part, ChainJoint)] for branch in loop.branches]
    hinges = [joint for branch in joints for joint in branch if joint.type.letter == "R"]
    if len(joints) != 2 or not hinges or any(len(branch) != 3 for branch in (*joints, *loop.branches)):
        return None
    normal = hinges[0].axes[0]
    if not all(_free(branch, normal) for branch in joints):
        return None
    sliders = tuple(branch[place] for place in range(3) for branch in joints if branch[place].type.letter == "P")
    count = len(sliders)
    tag = f"{count if count > 1 else ''}{'P' if count else ''}{6 - count}R"
    return PlanarLoop(normal, sliders, tag)


def _free(branch: list[ChainJoint], normal: Vector) -> bool:
    """Whether three joints give the motions of the plane, all three of them."""
    hinges = [joint for joint in branch if joint.type.letter == "R"]
    sliders = [joint for joint in branch if joint.type.letter == "P"]
    if (
        len(hinges) + len(sliders) != 3
        or not hinges
        or any(joint.general or joint.point or joint.through for joint in branch)
    ):
        return False
    if not all(parallel(joint.axes[0], normal) for joint in hinges):
        return False
    in_plane = all(perpendicular(joint.axes[0], normal) for joint in sliders)
    return in_plane and not (len(sliders) == 2 and parallel(sliders[0].axes[0], sliders[1].axes[0]))
