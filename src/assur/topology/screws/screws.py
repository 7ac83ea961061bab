"""Where the links of a linkage are, and which twists its joints give there: products of exponentials, in batches.

A joint with several freedoms is a row of screws, so a linkage is a tree of one-parameter motions with some loops.
The pose of a link is its displacement from home (R. W. Brockett, Robotic manipulators and the product of
exponentials formula, 1984): x goes to R x + p, all in the base frame.

Inside, everything is measured from O' at home and in lengths of the linkage, so that neither its place nor its size
matters to rounding.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError, UsageError
from assur.numerics.rotations import cross, skew, to_vector, vector_rates_matrix
from assur.topology.screws.linkage import Linkage, LinkageJoint

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class ScrewTree:
    """A linkage of length 1 with O' at the origin: n screws in a spanning tree and v loops, ready to be evaluated.

    Every screw makes a frame; frame 0 is the base, frame k + 1 stands behind screw k.

    Attributes:
        scales: (n,) 1 rad, or the length that a unit of the screw's value stands for.
        screws: (n, 6) at home, v at O'.
        powers: (n, 3, 4, 4) powers of the screws' matrices, with the sense in which the tree passes them.
        behind: (n,) the frame that each screw moves.
        levels: screws that can be composed at once, in order.
        frames: link -> its frame.
        loops: (v, 2) frames that coincide where the loops are closed.
        paths: (n + 1, n) by which screws a frame is moved, each with its sense.
    """

    scales: FloatArray
    screws: FloatArray
    powers: FloatArray
    behind: IndexArray
    levels: tuple[IndexArray, ...]
    frames: Mapping[str, int]
    loops: IndexArray
    paths: FloatArray

    def at(self, values: FloatArray) -> PlacedLinks:
        """Frames and twists at values (N, n) in rad and lengths of the linkage."""
        sizes = np.stack([values, 1.0 - np.cos(values), values - np.sin(values)], axis=-1)  # (N, n, 3)
        # exp(q A) = 1 + q A + (1 - cos q) A^2 + (q - sin q) A^3, for unit rotations, translations and helices alike
        moved = np.einsum("Nnk,nkij->Nnij", sizes, self.powers) + np.eye(4)
        frames = np.empty((len(values), values.shape[1] + 1, 4, 4))
        frames[:, 0] = np.eye(4)
        for level in self.levels:
            frames[:, level + 1] = frames[:, self.behind[level]] @ moved[:, level]
        behind = frames[:, self.behind]
        rotation, origin = behind[..., :3, :3], behind[..., :3, 3]
        turned = rotation @ self.screws.reshape(-1, 2, 3).swapaxes(-1, -2)  # (N, n, 3, 2)
        omega = turned[..., 0]
        twists = np.concatenate([omega, turned[..., 1] + cross(origin, omega)], axis=-1).swapaxes(-1, -2)
        return PlacedLinks(frames, twists)

    def misfit(self, placed: PlacedLinks, first: IndexArray, second: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Rotation vector and gap (N, v, 6) from frames `second` to frames `first`, and the Jacobian (N, v, 6, n)."""
        near, far = placed.frames[:, first], placed.frames[:, second]
        between = near[..., :3, :3] @ far[..., :3, :3].swapaxes(-1, -2)
        vector = to_vector(between)
        residual = np.concatenate([vector, near[..., :3, 3] - far[..., :3, 3]], axis=-1)
        twist = placed.twists[:, None]
        one_twist, two_twist = twist * self.paths[first][:, None], twist * self.paths[second][:, None]
        spin = vector_rates_matrix(vector) @ (one_twist[..., :3, :] - between @ two_twist[..., :3, :])
        gap = _velocity(one_twist, near[..., :3, 3]) - _velocity(two_twist, far[..., :3, 3])
        return residual, np.concatenate([spin, gap], axis=-2)


@dataclass(frozen=True, eq=False)
class PlacedLinks:
    """Frames (N, n + 1, 4, 4) and joint twists (N, 6, n), v at the origin, of a screw tree."""

    frames: FloatArray
    twists: FloatArray


@lru_cache(maxsize=64)
def screw_tree(linkage: Linkage) -> ScrewTree:
    """The linkage made ready for evaluation.

    Errors:
        UnknownNameError: base or platform are no links. UsageError: links that no joint connects with the base.
    """
    for link in (linkage.base, linkage.platform):
        if link not in linkage.links:
            raise UnknownNameError("link", link, linkage.links)
    return _Growing(linkage).tree()


class _Growing:
    """A spanning tree, joint after joint outwards from the base; the joints left over close the loops."""

    def __init__(self, linkage: Linkage) -> None:
        self.linkage = linkage
        self.slices = linkage.slices
        count = sum(len(joint.screws) for joint in linkage.joints.values())
        self.frames = {linkage.base: 0}
        self.behind = np.zeros(count, dtype=np.intp)
        self.senses = np.ones(count)
        self.depth = np.zeros(count + 1, dtype=np.intp)
        self.paths = np.zeros((count + 1, count))

    def tree(self) -> ScrewTree:
        loops = [self._pass(joint, self.frames[joint.parent], 1) for joint in self._grow()]
        ends = [(end, self.frames[child]) for end, child in loops]
        screws = self._screws()
        matrices = np.zeros((len(screws), 4, 4))
        matrices[:, :3, :3], matrices[:, :3, 3] = skew(screws[:, :3]), screws[:, 3:]
        matrices *= self.senses[:, None, None]
        square = matrices @ matrices
        depth = self.depth[1:]
        return ScrewTree(
            scales=np.where(np.any(screws[:, :3], axis=1), 1.0, self.linkage.length),
            screws=screws,
            powers=np.stack([matrices, square, square @ matrices], axis=1),
            behind=self.behind,
            levels=tuple(np.flatnonzero(depth == level) for level in range(1, int(depth.max(initial=0)) + 1)),
            frames=self.frames,
            loops=np.array(ends, dtype=np.intp).reshape(-1, 2),
            paths=self.paths,
        )

    def _grow(self) -> list[LinkageJoint]:
        """Pass every joint that reaches a new link; what is returned reaches none."""
        waiting = list(self.linkage.joints.values())
        rest = []
        while waiting:
            later = []
            reached = set(self.frames)
            for joint in waiting:
                near, far = joint.parent in self.frames, joint.child in self.frames
                if near and far:
                    rest.append(joint)
                elif joint.parent in reached:
                    self.frames[joint.child] = self._pass(joint, self.frames[joint.parent], 1)[0]
                elif joint.child in reached:
                    self.frames[joint.parent] = self._pass(joint, self.frames[joint.child], -1)[0]
                else:
                    later.append(joint)
            if len(later) == len(waiting):
                apart = sorted({link for joint in later for link in (joint.parent, joint.child)} - set(self.frames))
                raise UsageError(
                    f"no joints connect the links {', '.join(apart)} with the base '{self.linkage.base}'",
                    hint="every link must hang together with the base",
                )
            waiting = later
        return rest

    def _pass(self, joint: LinkageJoint, frame: int, sense: int) -> tuple[int, str]:
        """The frame behind a joint that is passed from a frame, and the child."""
        place = self.slices[joint.name]
        for column in list(range(place.start, place.stop))[::sense]:
            self.behind[column], self.senses[column] = frame, sense
            self.paths[column + 1] = self.paths[frame]
            self.paths[column + 1, column] = sense
            self.depth[column + 1] = self.depth[frame] + 1
            frame = column + 1
        return frame, joint.child

    def _screws(self) -> FloatArray:
        """Screws (n, 6) with v at O', in lengths of the linkage."""
        screws = np.concatenate([joint.screws for joint in self.linkage.joints.values()]).astype(float)
        turning = np.any(screws[:, :3], axis=1)
        moved = (screws[:, 3:] + np.cross(screws[:, :3], self.linkage.point)) / self.linkage.length
        screws[turning, 3:] = moved[turning]
        return screws


def _velocity(twists: FloatArray, point: FloatArray) -> FloatArray:
    """Velocity (..., 3, n) of a point (..., 3) by twists (..., 6, n)."""
    moved: FloatArray = twists[..., 3:, :] - skew(point) @ twists[..., :3, :]
    return moved
