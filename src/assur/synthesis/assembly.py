"""Limbs put together: first by classes of equal motion, by the rules; then one by one, confirmed by twists."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations_with_replacement, islice, product

import numpy as np

from assur.synthesis.confirmed import confirmed
from assur.synthesis.designs import Design
from assur.synthesis.expected import Expected, expected
from assur.synthesis.limb_motions import Limb
from assur.synthesis.wanted import WantedMotion
from assur.topology.directions import Vector
from assur.topology.facts import Known
from assur.topology.motion import Motion
from assur.topology.notation import parse_chains
from assur.topology.refusals import Refusal
from assur.topology.spans import Span
from assur.topology.union import serial

Step = Callable[[int, int], None]

MEMBERS = 20
"""Of mechanisms with different limbs, so many are listed for each combination of classes: the simplest ones."""


@dataclass(frozen=True)
class Class:
    """Limbs whose end links have the same motion, the simplest first."""

    limbs: tuple[Limb, ...]


@dataclass
class Tally:
    """How many combinations there were, and what became of them."""

    classes: int = 0
    combinations: int = 0
    looked_at: int = 0
    with_motion: int = 0
    other: Counter[str] = field(default_factory=Counter)
