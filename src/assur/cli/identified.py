"""What poses tell, as data and as a person reads it."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import RenderableType

from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.quantities import mode_words
from assur.kinematics.answers.at_border import mechanism_header
from assur.machine.calibration.identification import Identification, combined
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS
from assur.results.answers.identification import IdentificationAnswer, NotTold
from assur.results.plain_text import short


def outcome(record: Mechanism, told: Identification, mode: str) -> Outcome:
    """What poses tell."""
    answer = IdentificationAnswer(
        **mechanism_header(record),
        mode=mode,
        poses=tuple(tuple(pose.tolist()) for pose in told.poses),
        measured=told.measured,
        parameters=told.parameters,
        strained=told.strained,
        rank=told.rank,
        unidentifiable=tuple(NotTold(part.words, part.combination) for part in told.unidentifiable),
        base_parameters=told.base_parameters,
        observability=told.observability,
        units={
            "poses": ", ".join(record.unit if name in LENGTHS else "rad" for name in record.platform.pose),
            "unidentifiable": "per unit of each dimension, of inputs and angles of the frame in rad",
            "observability": "angles by the characteristic length",
        },
    )
    return Outcome(answer, lambda: _shown(record, answer))


def _shown(record: Mechanism, answer: IdentificationAnswer) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, identification")
    yield f"{len(answer.poses)} poses, {mode_words(record, answer.mode)}; measured: {', '.join(answer.measured)}"
    yield ""
    yield f"unknown: {', '.join(answer.parameters)} (inputs: their offsets)"
    if answer.strained:
        yield f"taken as they are, since alone they do not assemble: {', '.join(answer.strained)}"
    yield f"{answer.rank} of {len(answer.parameters)} combinations are told"
    yield from (f"  {part.words}" for part in answer.unidentifiable)
    sums = [combined(own) for own in answer.base_parameters.values() if len(own) > 1]
    if sums:
        yield f"what is told of these: {', '.join(sums)}"
    yield ""
    yield table(tuple(answer.observability), [tuple(map(short, answer.observability.values()))])
    yield "how well the poses show what is told, larger is better (Sun and Hollerbach 2008)"
