"""Names of joints: those that are written, and a counter for each letter, over all limbs of a mechanism."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping

from assur.topology.chains import InnerLoop, flattened
from assur.topology.notation.planar import planar_loop


class JointNames:
    """Gives every joint of a mechanism its own name.

    A name that is written stays, the first time; a limb that repeats it is counted on. What has no name is
    counted past all that are written: R1, R2, P1, Pa1, over all limbs.
    """

    def __init__(self, written: Iterable[Mapping[str, int]]) -> None:
        self._written = {name for names in written for name in names}
        self._given: set[str] = set()
        self._counters: Counter[str] = Counter()

    def of_joint(self, letter: str, written: str = "") -> str:
        """The name of the next joint."""
        if written and written not in self._given:
            self._given.add(written)
            return written
        while True:
            self._counters[letter] += 1
            name = f"{letter}{self._counters[letter]}"
            if name not in self._written | self._given:
                self._given.add(name)
                return name

    def of_loop(self, written: str, loop: InnerLoop) -> str:
        """The name of a planar loop's rotation: as written, else R12 after R1 and R2, the first R of a branch."""
        if written:
            return self.of_joint("R", written)
        if planar_loop(loop) is None:
            return ""
        for branch in loop.branches:
            numbers = [joint.name[1:] for joint in flattened(branch) if joint.name[0] == "R"]
            name = "R" + "".join(numbers[:2])
            if len(numbers) > 1 and name not in self._written | self._given:
                self._given.add(name)
                return name
        return ""
