"""Errors at a pose as data and as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.lost import why_lost
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.positions import failures
from assur.cli.progress import progress
from assur.cli.quantities import mode_words
from assur.kinematics.answers.at_border import mechanism_header, pose_at_border
from assur.kinematics.answers.style import style_of
from assur.kinematics.status import Status
from assur.machine.accuracy.pose_errors import COORDINATES, PoseErrors
from assur.machine.accuracy.sampled_poses import COUNT
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS
from assur.results.answers.errors import ErrorsAnswer, SampledAnswer
from assur.results.json_text import plain
from assur.results.plain_text import short

ROUNDED = 1e-9
"""Beside a displacement by as much as the error itself, or a rotation by that over the mechanism's size."""
MOST = 10_000_000
"""Samples at most: some minutes."""
NOT_HELD = "the inputs do not hold the platform here: an error may move it without bound"


def outcome(record: Mechanism, pose: NDArray[Any], mode: str, count: int | None, shared: Shared) -> Outcome:
    """Errors at a pose (m,), in lengths and rad, beside so many samples (the usual number without one)."""
    solved = record.errors(pose, mode)
    answer = _answer(record, pose, mode, solved, _sampled(solved, count or COUNT, shared))
    return Outcome(answer, lambda: _shown(record, answer, pose), exit_codes.of_status(answer.status))


def _sampled(solved: PoseErrors, count: int, shared: Shared) -> SampledAnswer | None:
    """None where there is nothing to draw from."""
    if solved.status != Status.regular or not solved.off:
        return None
    with progress("samples", shared) as step:
        own = solved.sampled(count, progress=step)
    proved = solved.proved.bounds
    inside = own.inside(proved) if proved and own.bounds else None
    return SampledAnswer(own.count, own.seed, own.assembled, own.bounds, own.ratio(proved), inside)


def _answer(
    record: Mechanism, pose: NDArray[Any], mode: str, solved: PoseErrors, sampled: SampledAnswer | None
) -> ErrorsAnswer:
    held = solved.status == Status.regular
    lost = why_lost(record, pose, mode, solved.status)
    summed = held and bool(record.machine.tolerances)
    return ErrorsAnswer(
        **mechanism_header(record),
        pose=tuple(pose.tolist()),
        mode=mode,
        status=solved.status.name,
        input_names=tuple(item.name for item in record.drives),
        sensitivity={name: tuple(plain(row)) for name, row in solved.sensitivity.items()},
        per=solved.units,
        uncompensated={name: tuple(plain(row)) for name, row in solved.uncompensated.items()},
        compatible={name: solved.compatible(name) for name in solved.sensitivity},
        self_stress={
            name: {joint: tuple(wrench.tolist()) for joint, wrench in stress.items()}
            for name, stress in solved.stresses.items()
        },
        elastic=solved.settled,
        worst_case=_named(solved.worst_case) if summed else None,
        root_sum_square=_named(solved.root_sum_square) if summed else None,
        covariance=plain(solved.covariance) if summed else None,
        proved=solved.proved.bounds or None if summed else None,
        sampled=sampled,
        clearances={joint: tuple(row.tolist()) for joint, row in solved.clearances.items()},
        failures=lost.failures,
        notes=lost.notes or tuple(_notes(record, solved)),
        units={
            "pose": ", ".join(record.unit if name in LENGTHS else "rad" for name in record.platform.pose),
            "sensitivity": f"x, y, z in {record.unit}, rx, ry, rz in rad, per unit of the dimension or input",
            "uncompensated": "as sensitivity",
            "self_stress": "force 1, moment m",
            "worst_case": f"{record.unit}, rad",
            "root_sum_square": f"{record.unit}, rad",
            "covariance": f"{record.unit}2, {record.unit} rad, rad2",
            "proved": f"{record.unit}, rad",
            "sampled": f"{record.unit}, rad",
            "clearances": f"{record.unit}, rad",
        },
    )


def _named(row: NDArray[Any]) -> dict[str, float | None]:
    return dict(zip(COORDINATES, plain(row), strict=True))


def _notes(record: Mechanism, solved: PoseErrors) -> Iterable[str]:
    if solved.status == Status.parallel:
        yield NOT_HELD
    if solved.status != Status.regular:
        return
    open_names = [name for name, row in solved.sensitivity.items() if np.isnan(row[0])]
    if open_names and any(name in record.machine.tolerances for name in open_names):
        yield "a tolerance is of what does not assemble alone: no sums; give profiles to links, or name another copy"
    if record.machine.tolerances and solved.proved.resists:
        yield f"no bounds are proved: {solved.proved.resists}"
    if not record.machine.tolerances:
        yield "the file states no tolerances: sensitivities alone"


def _shown(record: Mechanism, answer: ErrorsAnswer, pose: NDArray[Any]) -> Iterable[RenderableType]:
    yield heading(f"{answer.mechanism}, errors: {answer.status}")
    place = style_of(record).pose(answer.coordinates, pose_at_border(record, pose).tolist())
    yield f"at {place}, {mode_words(record, answer.mode)}, inputs held"
    yield ""
    if answer.failures:
        yield failures(answer.failures)
    yield from (f"note: {note}" for note in answer.notes)
    if answer.sensitivity:
        yield from _sensitivities(answer)
        yield from _left(answer, ", ".join(record.platform.pose))
        yield from _sums(answer)


def _sensitivities(answer: ErrorsAnswer) -> Iterable[RenderableType]:
    rows = [
        (f"{name}{'*' if not answer.compatible[name] else ''}", answer.per[name], *_cleared(row))
        for name, row in answer.sensitivity.items()
    ]
    yield table(("error of one", "in", *_columns(answer)), rows, left=("error of one", "in"))
    if answer.self_stress:
        yield "* does not assemble alone: a stress that balances itself bears it, in the joints"
        alike: dict[tuple[str, ...], list[str]] = {}
        for name, stress in answer.self_stress.items():
            alike.setdefault(tuple(stress), []).append(name)
        yield from (f"  {', '.join(names)}: {', '.join(joints)}" for joints, names in alike.items())
        settled = len(answer.elastic)
        if settled:
            yield f"  their numbers are where links that bend by their profiles settle ({settled} of them)"


def _left(answer: ErrorsAnswer, pose: str) -> Iterable[RenderableType]:
    """What no calibration takes away."""
    left = {name: row for name, row in answer.uncompensated.items() if any(row)}
    rows = [(name, answer.per[name], *_cleared(row)) for name, row in left.items()]
    alone = " that assembles alone" if any(None in row for row in answer.uncompensated.values()) else ""
    yield ""
    if not rows:
        yield f"calibration can make up for each of them{alone}: nothing is left when the inputs bring {pose} back"
        return
    yield table(("left of one", "in", *_columns(answer)), rows, left=("left of one", "in"))
    yield f"when the inputs bring {pose} back: calibration cannot make up for it; nothing is left of any other{alone}"


def _sums(answer: ErrorsAnswer) -> Iterable[RenderableType]:
    sums: list[tuple[str, Mapping[str, float | None]]] = []
    if answer.worst_case and answer.root_sum_square:
        sums += [("worst case", answer.worst_case), ("root sum square", answer.root_sum_square)]
    rows = [(name, *_cleared(row.values(), _size(row.values()))) for name, row in sums]
    rows += [(f"clearance of {joint}", *_cleared(row, _size(row))) for joint, row in answer.clearances.items()]
    if rows:
        yield ""
        yield table(("with the file's tolerances", *_columns(answer)), rows, left=("with the file's tolerances",))
        yield "of first order: no bounds"
    if answer.proved and answer.worst_case:
        yield ""
        ratios = answer.sampled.ratio if answer.sampled else {}
        proofs = [
            (
                name,
                f"{low:.9g}",
                f"{high:.9g}",
                _times(0.5 * (high - low), answer.worst_case.get(name)),
                _ratio(ratios.get(name)),
            )
            for name, (low, high) in answer.proved.items()
        ]
        columns = ("proved", "at least", "at most", "half of it over the worst case", "width over that of samples")
        yield table(columns, proofs, left=("proved",))
        yield f"certainly, for all dimensions that assemble: lengths in {answer.unit}, angles in rad"
    if answer.sampled:
        yield _drawn(answer.sampled, proved=bool(answer.proved))


def _drawn(own: SampledAnswer, *, proved: bool) -> str:
    ends = own.assembled - own.count
    whole = f"{own.count} samples, uniform (seed {own.seed}), and the ends that are worst to first order"
    if not own.assembled:
        return f"{whole}: none of them assembles"
    told = whole if ends >= 0 else f"{own.assembled} that assemble of {whole}"
    if not proved:
        reached = "; ".join(f"{name} {low:.9g} .. {high:.9g}" for name, (low, high) in own.bounds.items())
        return f"{told}: {reached}"
    return f"{told}: {'all inside' if own.inside else 'some OUTSIDE the bounds'}"


def _ratio(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"


def _times(half: float, first: float | None) -> str:
    """How much wider bounds are than what the first order says, where it says anything."""
    return f"{half / first:.3f}" if first and half / first < 1e3 else "-"


def _columns(answer: ErrorsAnswer) -> tuple[str, ...]:
    return tuple(f"{name} [{answer.unit if name in LENGTHS else 'rad'}]" for name in COORDINATES)


def _size(row: Iterable[float | None]) -> float:
    return max((abs(value) for value in row if value is not None), default=0.0)


def _cleared(row: Iterable[float | None], size: float = 1.0) -> tuple[str, ...]:
    """Numbers as they are read; what is rounding beside a size as 0."""
    return tuple(short(0.0 if value is not None and abs(value) < ROUNDED * size else value) for value in row)
