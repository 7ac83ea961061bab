"""Errors of the library in the words of the command line: the name of an argument becomes the option that gave it.

A message of the library about one argument begins with its name and a colon (`gap: -1.0 is no share`), see
`assur.errors`. Here that name is replaced where the command has an option for it, so that the two are spelt alike.
"""

from __future__ import annotations

import re
from collections.abc import Collection

from assur.errors import AssurError, MechanismFileError

ARGUMENT = re.compile(r"(stroke(?= of )|[a-z][a-z_]*(?=: ))(?: of (\w+))?: ")
OTHERWISE = {"held": "--at", "centre": "--around", "count": "--points"}
"""Arguments whose option has another name."""


def as_typed(error: AssurError, options: Collection[str]) -> AssurError:
    """The same error, with the argument that it begins with as the option that the user typed.

    >>> str(as_typed(AssurError("gap: -1.0 is no share"), {"--gap"}))
    '--gap: -1.0 is no share'
    >>> str(as_typed(AssurError("stroke of yA1: [3, 1] is turned round"), {"--stroke"}))
    '--stroke yA1: [3, 1] is turned round'
    >>> str(as_typed(AssurError("fivebar: no box to look in"), {"--box"}))
    'fivebar: no box to look in'
    """
    found = ARGUMENT.match(error.message)
    if found is None or isinstance(error, MechanismFileError):
        return error
    name, whose = found[1], found[2]
    option = next((item for item in (f"--{name.replace('_', '-')}", OTHERWISE.get(name)) if item in options), None)
    if option is None:
        return error
    error.message = f"{' '.join(filter(None, (option, whose)))}: {error.message[found.end() :]}"
    return error
