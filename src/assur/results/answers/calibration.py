"""The answer of `assur calibrate`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.position import Numbers


@dataclass(frozen=True)
class CalibrationAnswer(AnswerOfMechanism):
    """The dimensions with which measured poses agree best, what is to be added to inputs, and the measuring frame.

    `sigma` are their standard deviations, `covariance` is in the order of `parameters`.

    `held` keep their values: nothing measured tells them apart, they were to be held, or would get a sign that they may
    not have. `residual_before` and `residual_after` are roots of mean squares without `outliers`, which count from 1.
    `file` is what was written.
    """

    measurements: int
    measured: tuple[str, ...]
    parameters: Mapping[str, float]
    sigma: Mapping[str, float]
    covariance: tuple[Numbers, ...]
    held: tuple[str, ...]
    residual_before: float
    residual_after: float
    outliers: tuple[int, ...]
    file: str | None
    units: Mapping[str, str]
