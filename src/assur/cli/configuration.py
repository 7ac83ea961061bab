"""The verdict on one configuration, as data and as a person reads it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.positions import failures, other_modes
from assur.cli.quantities import mode_words
from assur.kinematics.answers.answer import missing
from assur.kinematics.answers.at_border import mechanism_header, pose_at_border, power
from assur.kinematics.answers.style import style_of
from assur.kinematics.rates.units import unit_length
from assur.kinematics.status import FACTOR_TOLERANCE, closed_form_of
from assur.mechanism import Mechanism
from assur.results.answers.indices import IndicesAnswer
from assur.results.answers.singularity import ConfigurationAnswer
from assur.results.plain_text import count, fixed, short


def outcome(record: Mechanism, pose: NDArray[Any], mode: str) -> Outcome:
    """The outcome for one pose (m,) in a working mode."""
    data = verdict_answer(record, pose, mode)
    return Outcome(data, lambda: _shown(record, data), exit_codes.of_status(data.kind))


def verdict_answer(record: Mechanism, pose: NDArray[Any], mode: str) -> ConfigurationAnswer:
    """The verdict at the border; for a pose that the mode does not reach, which quantity is negative."""
    verdict = record.singularity(pose, mode)
    # of home's mode without a closed form `home_by` says what stops the paths
    of_home = record.closed_form is None and (not mode or mode == record.modes.default_working)
    lost = not of_home and verdict.kind in ("unreachable", "undecided")
    return ConfigurationAnswer(
        **mechanism_header(record),
        pose=pose_at_border(record, pose).tolist(),
        mode=mode,
        **vars(verdict),
        characteristic_length=unit_length(record),
        failures=missing(record, record.inverse(pose, mode).failures) if lost else (),
    )


def _shown(record: Mechanism, data: ConfigurationAnswer) -> Iterable[RenderableType]:
    near = ", near_singular" if data.near else ""
    yield heading(f"{data.mechanism}, singularity: {data.kind}{near}")
    yield f"at {style_of(record).pose(data.coordinates, data.pose)}, {mode_words(record, data.mode)}"
    yield from of_modes(data, data.kind)
    yield ""
    if data.failures:
        yield failures(data.failures)
    if data.rank is not None:
        yield from _factors(record, data) if record.closed_form else _measures(data)


def of_modes(data: ConfigurationAnswer | IndicesAnswer, status: str) -> Iterable[str]:
    """By what it is home's mode or is not; else, where a mode does not reach the pose, which others do."""
    if data.home_by:
        yield data.home_by
    elif status == "unreachable":
        yield other_modes(data.known_modes)


def _measures(data: ConfigurationAnswer) -> Iterable[RenderableType]:
    """How far the joint graph is from being singular, where there is no closed form with factors."""
    rows = [(name, fixed(value, 6)) for name, value in data.factors.items()]
    yield table(("measure", "0 where singular, 1 at most"), rows, left=("measure",))


def _factors(record: Mechanism, data: ConfigurationAnswer) -> Iterable[RenderableType]:
    listed = closed_form_of(record).factor_list
    zero = {name: size is not None and abs(size) <= FACTOR_TOLERANCE for name, size in data.relative.items()}
    rows = [
        (
            item.name,
            f"{short(data.factors[item.name])} {power(record.unit, item.unit)}".strip(),
            "= 0" if zero[item.name] else fixed(data.relative[item.name], 4),
            item.kind,
            item.meaning,
        )
        for item in listed
    ]
    columns = ("factor", "value", "share", "kind", "zero where")
    styles = ["yellow" if zero[item.name] else "" for item in listed]
    if rows:
        yield table(columns, rows, left=("factor", "kind", "zero where"), styles=styles)
        yield f"share: of the factor's scale; zero within {FACTOR_TOLERANCE:g}"
    else:
        yield "det Jp and det Jq are 1 at every pose: the closed form declares no factor"
    units = {kind: power(record.unit, sum(f.unit for f in listed if f.kind == kind)) for kind in ("parallel", "serial")}
    det_jp, det_jq = f"{short(data.det_jp)} {units['parallel']}", f"{short(data.det_jq)} {units['serial']}"
    yield f"det Jp = {det_jp.strip()}, det Jq = {det_jq.strip()}"
    exists = data.condition is not None
    length = data.characteristic_length
    over = f", lengths over the characteristic length {short(length)} {record.unit}" if length else ""
    yield f"condition number of J = Jp^-1 Jq{over}: {short(data.condition) if exists else 'none, singular'}"
    yield f"by det Jp and det Jq alone: {data.reduced_kind}"
    freedoms = count(data.freedoms or 0, "freedom")
    yield f"joint graph: rank {data.rank} here, {data.generic_rank} in general; {freedoms}"
    if data.closest and (data.kind != "regular" or data.near):
        yield f"closest to zero: {data.closest}"
