"""What is wrong with the text of a kernel, and where."""

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
