"""Strokes: on which side of one centred joint another lies along a slide.

It changes where the two meet or, if one is a ball joint and the slide lies beside the line between them, where that
line is square to the slide: then the leg turns about the other joint as the slide moves, and nothing else does.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closing_blocks.blocks import SMALL
from assur.kinematics.closing_blocks.columns import ScrewColumns
from assur.numerics.rotations import cross

FloatArray = NDArray[np.float64]
SignArray = NDArray[np.int8]
MERGED = 1e-9
"""Share of a block's largest determinant among assemblies by chance below which it has no sign."""


@dataclass(frozen=True, eq=False)
class StrokeSign:
    """The sign of a stroke: on which side of one joint's centre another lies, along a slide between the two.

    Both are ball or universal joints, so that a stroke of zero is a singularity. It is a factor of a block's
    determinant, or its square is.

    Attributes:
        slide: the prismatic joint.
        near, far: the joints on its parent and on its child link.
        size: the stroke at home.
    """

    slide: str
    near: str
    far: str
    size: float = 1.0

    @property
    def joints(self) -> tuple[str, ...]:
        """The three of them."""
        return self.near, self.slide, self.far

    @property
    def meaning(self) -> str:
        """What holds where it is +."""
        return f"{self.far} lies {'ahead of' if self.size > 0 else 'behind'} {self.near} along {self.slide}"

    def shares(self, screws: ScrewColumns) -> FloatArray:
        """The stroke (N,) as a share of home's."""
        line = screws.centre(self.far) - screws.centre(self.near)
        return np.asarray(np.einsum("ni,ni->n", line, screws.axis(self.slide)) / self.size)

    def signs(self, screws: ScrewColumns) -> SignArray:
        """Signs (N,); 0 where the line between the joints is square to the slide, or none."""
        return with_zero(self.shares(screws))


def with_zero(values: FloatArray) -> SignArray:
    """Signs (N,) of shares (N,); 0 where one has merged."""
    return np.where(np.abs(values) > MERGED, np.sign(values), 0).astype(np.int8)


def stroke_signs(screws: ScrewColumns) -> Iterator[StrokeSign]:
    """Those of all slides between two centred joints, one a ball joint or both always in line with the slide."""
    record = screws.record
    centred = [name for name, joint in record.joints.items() if joint.type.ball or joint.type.turns == 2]
    for name, slide in record.joints.items():
        if (slide.type.slides, slide.type.turning) != (1, False):
            continue
        for near, far in product(centred, repeat=2):
            ends = [{record.joints[end].parent, record.joints[end].child} for end in (near, far)]
            if near == far or slide.parent not in ends[0] or slide.child not in ends[1]:
                continue
            line = screws.centre(far) - screws.centre(near)
            off = np.linalg.norm(cross(line, screws.axis(name)), axis=1)
            ball = any(record.joints[end].type.ball for end in (near, far))
            if ball or np.max(off) < SMALL * characteristic_length(record):
                stroke = float(StrokeSign(name, near, far).shares(screws)[0])
                if stroke:
                    yield StrokeSign(name, near, far, stroke)
