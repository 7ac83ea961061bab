"""Letters: names of points, joints, links and angles as mathematical text."""

from __future__ import annotations

import re

GREEK = frozenset(
    {"alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "kappa", "lambda"}
    | {"mu", "nu", "xi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega"}
)
PRIME = "\N{PRIME}"
_LETTER = re.compile(r"([A-Z]|[a-z])(\d*)([a-z]?)('*)")
_WORD = re.compile(r"([A-Za-z]+?)(\d+)([a-z]?)")


def letter(name: str) -> str:
    r"""A name as it is printed: a letter with its index in italics, a Greek letter, or the words themselves.

    >>> letter("B3a"), letter("O'"), letter("gamma"), letter("slider1")
    ('$B_{3a}$', '$O$′', '$\\gamma$', 'slider 1')
    """
    plain = name.rstrip("'")
    primes = PRIME * (len(name) - len(plain))  # the font sets a mathematical prime too far off
    return f"${inside}${primes}" if (inside := mathematics(plain)) else words(name)


def mathematics(name: str) -> str:
    """The same without dollar signs; empty where the name is words.

    >>> mathematics("l2"), mathematics("platform")
    ('l_{2}', '')
    """
    found = _LETTER.fullmatch(name)
    if found:
        sign, number, suffix, primes = found.groups()
        index = number + suffix
        return f"{sign}{primes}_{{{index}}}" if index else f"{sign}{primes}"
    stem, number = re.fullmatch(r"(.*?)(\d*)", name).groups()  # type: ignore[union-attr]  # matches every text
    if stem in GREEK:
        return f"\\{stem}_{{{number}}}" if number else f"\\{stem}"
    return ""


def words(name: str) -> str:
    """A name of words with its number apart.

    >>> words("link4a")
    'link 4a'
    """
    found = _WORD.fullmatch(name)
    return f"{found[1]} {found[2]}{found[3]}" if found else name.replace("_", " ")
