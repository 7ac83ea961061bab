"""The inner loops that a limb may begin with: a catalogue by name, with branches and what their output link does.

The first joint of each branch stands on the base and is driven. A loop is written along x, y, z of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.synthesis.positions import CYCLE, turned
from assur.synthesis.required import RequiredMotion
from assur.synthesis.words import AXES, ROTATIONS, Begun
from assur.topology.chains import Chain, InnerLoop
from assur.topology.notation import parse_chain

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class InnerLoopRow:
    """An inner loop of the catalogue.

    Attributes:
        name: how it is called.
        text: its branches, from the base to its output link.
        freedoms: of its output link, all of them independent.
        turns: direction about which its output link turns, "" where it does not.
        plane: directions in which the output link slides without turning, where it does not turn.
    """

    name: str
    text: str
    freedoms: int
    turns: str = "x"
    plane: tuple[str, ...] = ()

    @property
    def loop(self) -> InnerLoop:
        """Its branches."""
        return next(element for element in parse_chain(self.text).elements if isinstance(element, InnerLoop))

    def turned_loops(self, motion: RequiredMotion) -> Iterator[tuple[FloatArray, InnerLoop]]:
        """Ways in which it can stand to the direction that a motion singles out: a rotation (3, 3), and the loop."""
        for power in range(3 if motion.axis else 1):
            turn = np.linalg.matrix_power(CYCLE, power)
            for element in turned(Chain((self.loop,)), turn).elements:
                if isinstance(element, InnerLoop):
                    yield turn, element

    def turned_by(self, turn: FloatArray) -> Begun:
        """What a word is that goes on from its output link, with the loop's axes turned onto others (3, 3)."""

        def name(axis: str) -> str:
            return AXES[int(np.argmax(turn[:, AXES.index(axis)]))]

        known = frozenset(name(axis) for axis in AXES if f"[{axis}]" in self.text)
        blocks = ((name(self.turns), min(self.freedoms, ROTATIONS)),) if self.turns else ()
        return Begun(known=known, slides=tuple(f"P{name(axis)}" for axis in self.plane), blocks=blocks)


INNER_LOOPS = (
    InnerLoopRow("2P4R", "{P[y] R[x] R[x] | P[y] R[x] R[x]}", 3),
    InnerLoopRow("2P4R, rails at a right angle", "{P[y] R[x] R[x] | P[z] R[x] R[x]}", 3),
    InnerLoopRow("P5R", "{P[y] R[x] R[x] | R[x] R[x] R[x]}", 3),
    InnerLoopRow("6R", "{R[x] R[x] R[x] | R[x] R[x] R[x]}", 3),
    InnerLoopRow("2P3R", "{P[y] R[x] | P[y] R[x] R[x]}", 2),
    InnerLoopRow("2P3R, rails at a right angle", "{P[y] R[x] | P[z] R[x] R[x]}", 2),
    InnerLoopRow("P4R, slider", "{P[y] R[x] | R[x] R[x] R[x]}", 2),
    InnerLoopRow("P4R, crank", "{R[x] R[x] | P[y] R[x] R[x]}", 2),
    InnerLoopRow("5R", "{R[x] R[x] | R[x] R[x] R[x]}", 2),
    InnerLoopRow("4P", "{P[y] P[z] | P[z] P[y]}", 2, "", ("y", "z")),
    InnerLoopRow("2P2P(4R)", "{P[y] P(4R)[x] | P[y] P(4R)[x]}", 2, "", ("y", "z")),
    InnerLoopRow("H4 pair", "{R[x] P(4S)[x] | R[x] P(4S)[x]}", 4),
    InnerLoopRow("H4 pair on rails", "{P[z] P(4S)[x] | P[z] P(4S)[x]}", 4),
)
"""Planar loops turn about x, their plane is that of y and z; a pair of H4 lets its bar turn about x alone."""
