"""The answers of `assur certify` and `assur verify`; statement and claims are those of the file, numbers in hex."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from assur.results.answers.answer import Answer


@dataclass(frozen=True)
class StatedCertificate(Answer):
    """What a certificate states and claims, what it says of its formulas, and the shares of its parts."""

    kind: str
    made_by: str
    statement: Mapping[str, Any]
    exact: Mapping[str, Any]
    claims: Mapping[str, Any]
    sha256: str
    shares: Mapping[str, float]


@dataclass(frozen=True)
class WrittenCertificate(StatedCertificate):
    """A certificate that was written."""

    format: str
    version: int
    written: str


@dataclass(frozen=True)
class NoCertificate(Answer):
    """Why no path was written."""

    status: str
    why: str
    written: None = None


@dataclass(frozen=True)
class VerifiedCertificate(StatedCertificate):
    """A certificate that holds; `verified` is null where nobody knows whether its formulas are the mechanism's.

    `joint_graph` is what the verifier found of the formulas on its own joint graph, where it looked.
    """

    verified: Literal[True] | None
    mechanism_compared: bool
    joint_graph: Mapping[str, Any] | None
    seconds: float


@dataclass(frozen=True)
class RefusedCertificate(Answer):
    """A certificate that is none, or that does not hold, and why."""

    verified: Literal[False]
    refused: str
