"""What the roots of an eliminant are not: a proof by cycle types that no tower of square roots has them.

Modulo a prime, at dimensions and inputs that are drawn, the degrees of the polynomial's factors are the cycle type of a
permutation of its Galois group over the field of all dimensions and inputs, where the factors are different
(Dedekind, Frobenius). So it is irreducible where no share of its degree is a sum of such degrees in every type. A type
with an odd prime then shows that the group is no 2-group: no root of it is in a tower of square roots. A cycle of a
prime length over half of the degree makes the group primitive, and insoluble where the degree is no power of a prime
(Galois) or the length below the degree less 2 (Jordan). Of a prime degree it is insoluble where a permutation leaves
two roots in place and not all (Galois).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from sympy import factorint, isprime

CycleType = tuple[int, ...]


@dataclass(frozen=True)
class GroupFindings:
    """What cycle types prove of a Galois group; False says nothing.

    Attributes:
        degree: of the polynomial.
        types: the cycle types that were met, each with a prime at which it was.
        irreducible: whether it is.
        no_tower: whether no root is in a tower of square roots.
        insoluble: whether no root is in a tower of roots of any kind.
    """

    degree: int
    types: tuple[tuple[CycleType, int], ...]
    irreducible: bool
    no_tower: bool
    insoluble: bool

    @property
    def sentence(self) -> str:
        """In words; "" where nothing is proved.

        >>> findings(4, {(4,): 7}).sentence
        'the polynomial of degree 4 is irreducible'
        """
        if not self.irreducible:
            return ""
        said = f"the polynomial of degree {self.degree} is irreducible"
        if self.insoluble:
            return f"{said}, and its group is not soluble: no roots of any kind give its roots"
        return (
            f"{said}, and its group is no 2-group: no tower of square roots gives its roots" if self.no_tower else said
        )


def findings(degree: int, types: dict[CycleType, int]) -> GroupFindings:
    """What cycle types prove.

    Args:
        degree: of the polynomial.
        types: cycle type, its lengths falling -> a prime at which it was met.

    >>> own = findings(6, {(6,): 7, (5, 1): 11})
    >>> own.irreducible, own.no_tower, own.insoluble
    (True, True, True)
    >>> findings(6, {(2, 2, 2): 7, (4, 2): 11}).irreducible
    False
    """
    shares = [_sums(lengths) for lengths in types]
    return _of(degree, types, bool(types) and not any(all(k in own for own in shares) for k in range(1, degree)))


def of_irreducible(degree: int, types: dict[CycleType, int]) -> GroupFindings:
    """The same of a polynomial that is known to be irreducible."""
    return _of(degree, types, True)


def _of(degree: int, types: dict[CycleType, int], irreducible: bool) -> GroupFindings:
    odd = any(length & (length - 1) for lengths in types for length in lengths)
    long = {length for lengths in types for length in lengths if isprime(length) and 2 * length > degree}
    mixed = len(factorint(degree)) > 1
    insoluble = degree > 4 and any(mixed or length < degree - 2 for length in long)
    insoluble |= bool(isprime(degree)) and any(1 < lengths.count(1) < degree for lengths in types)
    return GroupFindings(
        degree, tuple(sorted(types.items())), irreducible, irreducible and odd, irreducible and odd and insoluble
    )


def _sums(lengths: Iterable[int]) -> set[int]:
    sums = {0}
    for length in lengths:
        sums |= {own + length for own in sums}
    return sums
