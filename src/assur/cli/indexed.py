"""Performance indices as data and as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.configuration import of_modes
from assur.cli.mapped import PlaneMap
from assur.cli.numbers import number, whole_number
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.positions import failures
from assur.cli.progress import progress
from assur.cli.region_question import Question
from assur.errors import UsageError
from assur.kinematics.answers.answer import missing
from assur.kinematics.answers.at_border import coordinates_at_border, mechanism_header, pose_at_border
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.answers.style import style_of
from assur.kinematics.border import input_names
from assur.kinematics.following.home_mode import HomeMode, home_mode_at
from assur.kinematics.position import modes_at
from assur.kinematics.rates.units import is_mixed
from assur.kinematics.status import Status
from assur.mechanism import Mechanism
from assur.model.pose import LENGTHS
from assur.performance.indices import INDICES, indices
from assur.performance.overall import overall
from assur.performance.transmission import GOOD
from assur.results.answers.indices import (
    IndicesAnswer,
    NearestSingularity,
    OverallAnswer,
    OverallIndex,
)
from assur.results.json_text import plain
from assur.results.plain_text import short, with_error
from assur.singularity.distance import distance
from assur.workspace.index_maps import NODES, IndexMaps, index_maps
from assur.workspace.region import workspace

if TYPE_CHECKING:
    from assur.figures.context import Context
    from assur.figures.spec import Drawing

Length = float | Literal["isotropic"] | None


def length_asked(text: str | None) -> Length:
    """The characteristic length that was asked for.

    >>> length_asked("isotropic"), length_asked("120"), length_asked(None)
    ('isotropic', 120.0, None)
    """
    if text is None:
        return None
    if text.strip() == "isotropic":
        return "isotropic"
    value = number(text, "--length")
    if value <= 0:
        raise UsageError(f"--length: {text.strip()} is not a positive length", hint="or --length isotropic")
    return value


def maps_of(length: Length) -> PlaneMap:
    """Maps of every index, lengths divided by a characteristic one."""

    def drawn(context: Context, maps: IndexMaps) -> Drawing:
        from assur.figures.index_maps import drawn

        return drawn(context, maps)

    return PlaneMap(
        "index",
        NODES,
        lambda _: None,
        lambda record, region, names, nodes, _: index_maps(
            record, region, names, nodes=nodes, characteristic_length=length
        ),
        drawn,
        _map_words,
    )


def _map_words(record: Mechanism, maps: IndexMaps) -> Iterable[str]:
    yield "means and extremes are those of the nodes; without --map they come with errors"
    if maps.reach is not None:
        beyond = int(np.sum(np.isinf(maps["distance"])))
        yield (
            "distance: from the nearest parallel singularity inside the reach, its border not counted, that rays found"
            f" within {maps.reach:g} {maps.unit} (none from {beyond} nodes)"
        )
    yield length_words(record, maps.length)


def at_pose(record: Mechanism, pose: NDArray[Any], mode: str, length: Length) -> Outcome:
    """Every index at one pose (m,) in a working mode."""
    of_home = record.closed_form is None and (not mode or mode == record.modes.default_working)
    home = home_mode_at(record, pose) if record.closed_form is None else None
    solved = None if of_home else record.inverse(pose, mode)
    lost = () if solved is None else missing(record, solved.failures)
    there = not lost and (home is None or not of_home or home.reached)
    found = indices(record, pose, mode, length if there or length != "isotropic" else None)
    unreached = not of_home and Status(int(found.status)) == Status.unreachable
    others = modes_at(record, "inverse", pose) if unreached else home.others if of_home and home is not None else ()
    answer = IndicesAnswer(
        **mechanism_header(record),
        pose=pose_at_border(record, pose).tolist(),
        mode=mode,
        input_names=input_names(record),
        status=Status(int(found.status)).name,
        characteristic_length=found.length,
        velocity_factor_unit=found.unit,
        velocity_factors=plain(found.velocity_factors),
        input_transmission_indices=plain(found.transmission.inputs),
        output_transmission_indices=plain(found.transmission.outputs),
        condition_number=plain(found.condition_number),
        **vars(_distance(record, pose, mode)),
        failures=lost,
        home_by="" if home is None else home.words if solved is None else _other(record, solved, home),
        known_modes=others,
        indices={name: plain(found[name]) for name in INDICES},
    )
    units = {name: index.unit(found) for name, index in INDICES.items()}
    return Outcome(answer, lambda: _pose_shown(record, answer, units), exit_codes.of_status(answer.status))


def _other(record: Mechanism, solutions: SolutionSet, home: HomeMode) -> str:
    """Whether the first assembly of a named mode, whose indices are given, is that of home's mode."""
    if not solutions.exists.any():
        return ""
    same = any(home.is_home(record, joints) for joints in solutions.joints[solutions.exists][:1])
    return home.words if same else home.other_words


def _distance(record: Mechanism, pose: NDArray[Any], mode: str) -> NearestSingularity:
    """The distance from the nearest parallel singularity, where there is a closed form and a length in the pose."""
    if record.closed_form is None or not set(record.platform.pose) & set(LENGTHS):
        return NearestSingularity(None, None, None, None)
    found = distance(record, pose, mode)
    factor = str(found.factor) or None
    nearest = plain(pose_at_border(record, found.nearest)) if factor else None
    return NearestSingularity(plain(found.value), factor, nearest, found.reach)


def over_workspace(record: Mechanism, asked: Question, points: str, length: Length, shared: Shared) -> Outcome:
    """Means and extremes of every index over the workspace of a working mode."""
    count = whole_number(points, "--points")
    with progress("workspace", shared) as step:
        region = workspace(
            record, asked.mode, asked.box, asked.strokes, asked.resolution, (), held=asked.held, progress=step
        )
    with progress("indices", shared):
        found = overall(record, region, count, length)
    answer = OverallAnswer(
        **mechanism_header(record),
        mode=found.mode,
        points=found.points,
        singular=found.singular,
        characteristic_length=found.length,
        velocity_factor_unit=found.factor_unit,
        good_from=GOOD,
        good_transmission=found.good,
        indices={name: _at_border(record, item) for name, item in found.values.items()},
        held=coordinates_at_border(record, region.slice.held),
        volume=region.volume,
        volume_error=region.volume_error,
        volume_unit=region.unit,
    )
    return Outcome(answer, lambda: _overall_shown(record, answer))


def _at_border(record: Mechanism, index: OverallIndex) -> OverallIndex:
    least, most = (pose_at_border(record, pose).tolist() for pose in (index.least_at, index.most_at))
    return replace(index, least_at=least, most_at=most)


def _pose_shown(record: Mechanism, data: IndicesAnswer, units: dict[str, str]) -> Iterable[RenderableType]:
    yield heading(f"{data.mechanism}, indices: {data.status}")
    of_mode = f", working mode {data.mode}" if data.mode else ""
    yield f"at {style_of(record).pose(data.coordinates, data.pose)}{of_mode}"
    yield from of_modes(data, data.status)
    yield ""
    if data.failures:
        yield failures(data.failures)
        return
    if data.indices["transmission"] is None:
        return
    rows = [
        (name, f"{short(data.indices[name])} {units[name]}".strip(), index.meaning) for name, index in INDICES.items()
    ]
    if data.distance is not None:
        what = f"distance from {data.nearest_factor} = 0, the nearest parallel singularity found"
        rows.append(("distance", f"{short(data.distance)} {record.unit}", what))
    elif data.distance_reach is not None:
        what = f"no parallel singularity was found within {short(data.distance_reach)} {record.unit}"
        rows.append(("distance", "", what))
    yield table(("index", "value", "what it is"), rows, left=("index", "what it is"))
    yield ""
    yield heading("transmission, input by input: 0 none, 1 all")
    parts = (data.input_names, data.input_transmission_indices, data.output_transmission_indices)
    yield table(
        ("input", "drives its limb", "drives the platform"),
        [(name, short(first), short(second)) for name, first, second in zip(*parts, strict=True)],
        left=("input",),
    )
    factors = ", ".join(map(short, data.velocity_factors))
    if data.status == "undecided":
        yield "theta is a right angle: phi and psi have no rates of their own, so that J does not exist here"
    written = "(Jq^-1 Jp)^+" if record.redundant_inputs else "Jp^-1 Jq"
    yield f"condition number of J = {written}, one over the local condition index: {short(data.condition_number)}"
    yield f"velocity factors of J = {written}: {factors} {data.velocity_factor_unit}".rstrip()
    yield length_words(record, data.characteristic_length)


def _overall_shown(record: Mechanism, data: OverallAnswer) -> Iterable[RenderableType]:
    style = style_of(record)
    of_mode = f" of working mode {data.mode}" if data.mode else ""
    yield heading(f"{data.mechanism}, indices over the workspace{of_mode}")
    if data.held:
        yield f"held: {', '.join(f'{name} = {value:g}' for name, value in data.held.items())}"
    volume = with_error(data.volume, data.volume_error)
    yield f"workspace: {volume} {data.volume_unit}, seen at {data.points} points"
    good = data.good_transmission
    if not data.indices or good is None:
        yield "nothing is reached"
        return
    yield ""
    rows = [
        (name, with_error(item.mean, item.mean_error), short(item.least), short(item.most))
        for name, item in data.indices.items()
    ]
    yield table(("index", "mean", "least", "most"), rows, left=("index",))
    unit = data.velocity_factor_unit
    if unit:
        yield f"largest and smallest are velocity factors in {unit}; manipulability is their product"
    yield length_words(record, data.characteristic_length)
    yield ""
    size = f"{with_error(good.volume, good.volume_error)} {good.unit}"
    share = f"{100 * good.share:.1f} ± {100 * good.share_error:.1f} %"
    yield f"good transmission (local index at least {data.good_from}): {share}, {size}"
    worst = data.indices["transmission"]
    where = style.point(data.coordinates, worst.least_at)
    title = style.point_title(data.coordinates)
    yield f"worst transmission seen: {short(worst.least)} at {title} = {where}"
    if data.singular:
        yield f"{data.singular} points are singular and left out of the means of J's indices"


def length_words(record: Mechanism, length: float | None) -> str:
    """What lengths are divided by, and why nothing where that is so."""
    if length is not None:
        return f"lengths are divided by the characteristic length {length:.6g} {record.unit}"
    if is_mixed(record):
        return "no characteristic length was found"
    return "units do not mix, so that the condition indices depend on no characteristic length"
