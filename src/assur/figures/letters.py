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
_OF_LIMB = re.compile(r"[A-Za-z_]+(\d+)\.(\w+)")


def letter(name: str) -> str:
    r"""A name as it is printed: a letter with its index in italics, a Greek letter, or the words themselves.

    Of a part of a repeated limb the limb's number comes first in the index.

    >>> letter("B3a"), letter("O'"), letter("gamma"), letter("slider1"), letter("leg2.A"), letter("leg2.B1")
    ('$B_{3a}$', '$O$′', '$\\gamma$', 'slider 1', '$A_{2}$', '$B_{2,1}$')
    """
    plain = name.rstrip("'")
    primes = PRIME * (len(name) - len(plain))  # the font sets a mathematical prime too far off
    return f"${inside}${primes}" if (inside := mathematics(plain)) else words(name)


def mathematics(name: str) -> str:
    """The same without dollar signs; empty where the name is words.

    >>> mathematics("l2"), mathematics("platform")
    ('l_{2}', '')
    """
    of_limb = _OF_LIMB.fullmatch(name)
    if of_limb:
        limb, part = of_limb.groups()
        own = _LETTER.fullmatch(part)
        index = f"{limb},{own[2]}{own[3]}".removesuffix(",") if own else ""
        return f"{own[1]}{own[4]}_{{{index}}}" if own else ""
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
    """A name of words with its number apart; of a limb's part the limb's number.

    >>> words("link4a"), words("leg2.crank")
    ('link 4a', 'crank 2')
    """
    of_limb = _OF_LIMB.fullmatch(name)
    if of_limb:
        return f"{words(of_limb[2])}{',' if of_limb[2][-1].isdigit() else ' '}{of_limb[1]}"
    found = _WORD.fullmatch(name)
    return f"{found[1]} {found[2]}{found[3]}" if found else name.replace("_", " ")
