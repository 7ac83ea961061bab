"""Things that belong together by pairs: the classes of an equivalence."""

from __future__ import annotations


class Groups:
    """Numbers from 0, each in a group of its own until groups are joined.

    >>> groups = Groups(3)
    >>> groups.join(0, 2)
    >>> groups.of(2) == groups.of(0) != groups.of(1)
    True
    """

    def __init__(self, count: int) -> None:
        self._above = list(range(count))

    def of(self, member: int) -> int:
        """The group's smallest member."""
        while self._above[member] != member:
            member = self._above[member]
        return member

    def join(self, first: int, second: int) -> None:
        """Make two groups one."""
        low, high = sorted((self.of(first), self.of(second)))
        self._above[high] = low
