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
_ENDS_IN_LETTER = re.compile(r"([a-z]{2,})([A-Z])")
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


def dimension(name: str) -> str:
    """A dimension or a link as it is printed; of a dimension of one part alone the part is told.

    >>> dimension("l2"), dimension("leg1.rod_a.L"), dimension("leg2.L"), dimension("leg2.arm"), dimension("3 others")
    ('$l_{2}$', '$L$ of rod a 1', '$L$ of leg 2', 'arm 2', '3 others')
    """
    part, _, own = name.rpartition(".")
    return f"${mathematics(own)}$ of {words(part)}" if part and mathematics(own) else letter(name)


def words(name: str) -> str:
    """A name of words with its number or letter apart; of a limb's part the limb's number first, as in its letters.

    >>> words("link4a"), words("leg2.crank"), words("leg2.rod1"), words("a2.linkB")
    ('link 4a', 'crank 2', 'rod 2,1', 'link B2')
    """
    of_limb = _OF_LIMB.fullmatch(name)
    if of_limb:
        limb, part = of_limb.groups()
        own = _WORD.fullmatch(part)
        if own:
            return f"{own[1]} {limb},{own[2]}{own[3]}"
        return f"{words(part)}{'' if _ENDS_IN_LETTER.fullmatch(part) else ' '}{limb}"
    ends = _ENDS_IN_LETTER.fullmatch(name)
    if ends:
        return f"{ends[1]} {ends[2]}"
    found = _WORD.fullmatch(name)
    return f"{found[1]} {found[2]}{found[3]}" if found else name.replace("_", " ")


def numeral(number: int) -> str:
    """A number from 1 in Roman numerals.

    >>> [numeral(number) for number in (1, 4, 6, 9, 14)]
    ['I', 'IV', 'VI', 'IX', 'XIV']
    """
    digits = ""
    for value, sign in ((10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")):
        digits += sign * (number // value)
        number %= value
    return digits
