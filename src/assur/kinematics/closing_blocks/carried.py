"""Signs of closing blocks carried from some dimensions to others, which turn the spaces that their screws span."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from assur.kinematics.closing_blocks.distinguishing import ModeSign
from assur.kinematics.closing_blocks.platform_signs import PlatformSign
from assur.kinematics.closing_blocks.signs import BlockSign, Factor

CLEAR = 0.1
"""A determinant between bases of two spaces below which these lie across each other, and say nothing of a sense."""


def carried(sign: ModeSign, other: ModeSign | None) -> ModeSign:
    """A sign with the spaces of another one, that of the same joints with other dimensions, in its own sense.

    The sign as it is where the other one is made of something else.

    >>> from assur.kinematics.closing_blocks.distinguishing import distinguishing_signs
    >>> from assur.model.registry import load_record
    >>> first, second = (distinguishing_signs(load_record("fivebar", l1=own), "direct")[0] for own in (120, 130))
    >>> carried(first, second).factors[0].basis is second.factors[0].basis
    True
    """
    if other is None or len(other.factors) != len(sign.factors):
        return sign
    factors = [*_factors(sign, other)]
    return replace(sign, factors=tuple(factors)) if len(factors) == len(sign.factors) else sign


def _factors(sign: ModeSign, other: ModeSign) -> Iterator[Factor]:
    """Those factors of a sign that another one has, in its spaces."""
    for own, new in zip(sign.factors, other.factors, strict=True):
        if not isinstance(own, BlockSign) or not isinstance(new, BlockSign):
            if isinstance(own, PlatformSign) and type(own) is type(new) and own.joints == new.joints:
                yield new
            continue
        alike = own.block == new.block and own.links == new.links
        if not alike or own.basis.shape != new.basis.shape or own.rates.shape != new.rates.shape:
            continue
        sense = np.linalg.det(own.basis.T @ new.basis) * np.linalg.det(own.rates.T @ new.rates)
        if abs(sense) > CLEAR:
            yield replace(new, size=float(np.copysign(new.size, own.size * sense)))
