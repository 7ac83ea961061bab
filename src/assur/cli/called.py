"""How this program was called, so that a line that it prints can be typed as it stands."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

PROGRAM = "assur"


def called() -> str:
    """The name of the program where the shell finds it by name, else the path by which it was called.

    >>> called()
    'assur'
    """
    typed = sys.argv[0]
    by_path = Path(typed).stem == PROGRAM and not shutil.which(PROGRAM)
    return typed if by_path else PROGRAM
