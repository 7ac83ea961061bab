"""The answer of `assur errors`: displacement x, y, z in the file's unit, then a rotation vector rx, ry, rz in rad."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from assur.results.answers.answer import AnswerOfMechanism
from assur.results.answers.position import NegativeQuantity, Numbers

Row = tuple[float | None, ...]


@dataclass(frozen=True)
class SampledAnswer:
    """Where mechanisms stand that are drawn at random within the tolerances, each assembled anew.

    `count` of them uniformly, from a generator with `seed`, and the ends that are worst to first order; `assembled` of
    all close their loops. `bounds` are those of the coordinates over these, `ratio` how many times as wide the proved
    ones are, null where samples do not differ; `inside` is whether all lie within the proved ones, null without these.
    """

    count: int
    seed: int
    assembled: int
    bounds: Mapping[str, tuple[float, float]]
    ratio: Mapping[str, float | None]
    inside: bool | None


@dataclass(frozen=True)
class ErrorsAnswer(AnswerOfMechanism):
    """How errors of dimensions and inputs move the platform at a pose while the inputs are held, to first order.

    `sensitivity` has six numbers for each dimension `L`, for the copy of it in one limb `leg1.L` and in one link
    `leg1.rod.L`, and for each input, per unit of it (`per`); null where it alone does not assemble. `compatible` says
    so, `self_stress` which wrenches of joints bear it (force and moment in m at the child's point, the largest force
    1), and `elastic` names those whose numbers are where links that bend settle. `uncompensated` is what is left of
    each dimension's when the inputs bring the pose back: no calibration takes it away. `worst_case`, `root_sum_square`
    and `covariance` are those of the file's tolerances, null without. `proved` are bounds between which the
    coordinates of the pose certainly lie with these, for all dimensions that assemble; null where there is no
    proof. `sampled` says how far samples reach between them, null without tolerances. `clearances` are the largest
    errors that a joint's clearance allows, as far as the loops close.
    """

    pose: Numbers
    mode: str
    status: str
    input_names: tuple[str, ...]
    sensitivity: Mapping[str, Row]
    per: Mapping[str, str]
    uncompensated: Mapping[str, Row]
    compatible: Mapping[str, bool]
    self_stress: Mapping[str, Mapping[str, Numbers]]
    elastic: tuple[str, ...]
    worst_case: Mapping[str, float | None] | None
    root_sum_square: Mapping[str, float | None] | None
    covariance: tuple[Row, ...] | None
    proved: Mapping[str, tuple[float, float]] | None
    sampled: SampledAnswer | None
    clearances: Mapping[str, Numbers]
    failures: tuple[NegativeQuantity, ...]
    notes: tuple[str, ...]
    units: Mapping[str, str]
