"""What is wrong with the text of a kernel, and where, and how much it may do.

So one that never ends, or fills the memory, is refused instead.
"""

from __future__ import annotations


class KernelFault(Exception):  # noqa: N818  # a fault of a file; it becomes a `Problem` where the file is known
    """A place in a kernel's text that cannot be worked out.

    Attributes:
        line: the line in the file, None where it is not known yet.
        reason: what stands there.
        allowed: what may stand there.
        hint: what to write instead.
    """

    def __init__(self, reason: str, allowed: str = "", hint: str = "", line: int | None = None) -> None:
        super().__init__(reason)
        self.reason, self.allowed, self.hint, self.line = reason, allowed, hint, line


class FormFault(KernelFault):
    """The text is Python, but not in the form that the evaluator reads: it could only be run."""


class LimitFault(KernelFault):
    """A kernel that goes on for too long, or makes too large a thing."""


BYTES = 2**18
"""Of a file. The longest kernel that is shipped has 12 kB."""
NODES = 30_000
"""Of a file's syntax tree."""
NESTING = 60
"""Of brackets, operators and statements in one another; every level is a few levels of Python's own stack."""
STEPS = 400_000
"""Nodes of the syntax tree that are worked out in one call. The costliest kernel that is shipped takes some 6,000."""
CALLS = 30
"""Functions in one another."""
LENGTH = 2_000
"""Of a tuple, list, table or text."""
PARTS = 20_000
"""Of a value with all that it is made of, each as often as it occurs: `t = (t, t)` doubles it in one step."""
BITS = 256
"""Of a whole number."""


class Meter:
    """What one call of a kernel has left, and the line where it is."""

    __slots__ = ("calls", "line", "steps")

    def __init__(self) -> None:
        self.steps, self.calls, self.line = STEPS, CALLS, 0

    def spend(self, steps: int) -> None:
        """Count work.

        Errors:
            LimitFault: nothing is left.
        """
        self.steps -= steps
        if self.steps < 0:
            raise LimitFault(f"more than {STEPS} steps in one call", hint="a kernel is a few hundred operations long")


def checked_length(length: int) -> int:
    """The length of a thing that is about to be made.

    >>> checked_length(3)
    3
    """
    if length > LENGTH:
        raise LimitFault(f"{length} entries in one tuple, list or text", f"at most {LENGTH}")
    return length


def checked_whole(number: int) -> int:
    """A whole number that came out.

    >>> checked_whole(2**64) == 2**64
    True
    """
    if number.bit_length() > BITS:
        raise LimitFault(f"a whole number of {number.bit_length()} bits", f"at most {BITS}")
    return number
