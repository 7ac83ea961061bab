"""Which answers each command gives: the table from which `assur schema --answers` makes its schema."""

from __future__ import annotations

from assur.results.answers.certified import CertifiedDirect, CertifiedInverse
from assur.results.answers.position import DirectAnswer, InverseAnswer

ANSWERS: dict[str, tuple[type, ...]] = {
    "direct": (DirectAnswer, CertifiedDirect),
    "inverse": (InverseAnswer, CertifiedInverse),
}
