"""Where a path begins, and how it reads when it has been followed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType

from assur.cli import exit_codes
from assur.cli.interruption import handing_over
from assur.cli.numbers import numbers
from assur.cli.options import Outcome
from assur.cli.output import heading, table
from assur.cli.positions import outcome as no_start
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.answers.at_border import inputs_from_border, pose_from_border
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.answers.style import Style, style_of
from assur.kinematics.border import input_names
from assur.kinematics.following.course import Turns
from assur.kinematics.following.following import follow
from assur.kinematics.following.home_mode import home_mode_at
from assur.kinematics.following.path import WORDS, Path, Stop
from assur.kinematics.turns import periodic
from assur.mechanism import Mechanism
from assur.results.answers.path import NoPath, PathAnswer
from assur.results.plain_text import count, fixed, short

Along = Literal["pose", "inputs"]
ROWS = 12
"""Points that a person sees; --json has all."""


def outcome(
    record: Mechanism,
    along: Along,
    start: Sequence[str],
    target: Sequence[str],
    *,
    mode: str | None,
    turns: Turns,
    use_limits: bool,
) -> Outcome:
    """The path from texts `start` (home where there are none) to texts `target`; or why there is no start."""
    goal = _points(record, along, target)
    if not start:
        if mode is not None:
            raise UsageError("--mode names the mode at --from; home has its own", hint="give --from as well")
        joints = record.home_values
    else:
        place = _points(record, along, start, "--from")
        if len(place) != 1:
            raise UsageError(f"--from: {count(len(place), 'point')}, one wanted", hint="further points belong to --to")
        if record.closed_form is None and mode is None:
            return _from_home_mode(record, along, place[0], goal, turns=turns, use_limits=use_limits)
        solve = record.inverse if along == "pose" else record.direct
        found = solve(place[0], mode)
        default = record.modes.default_working if along == "pose" else record.modes.default_assembly
        row = _nearest_home(record, found, default if mode is None else "")
        if row is None:
            return no_start(record, found if mode else solve(place[0], default or None))
        joints = found.joints[row]
    return _followed(record, joints, along, goal, turns=turns, use_limits=use_limits)


def _from_home_mode(
    record: Mechanism, along: Along, place: NDArray[Any], goal: NDArray[Any], *, turns: Turns, use_limits: bool
) -> Outcome:
    """The path from where home's mode is at --from; without a closed form that is followed from home."""
    start = home_mode_at(record, place, "poses" if along == "pose" else "inputs")
    if start.joints is None:
        said = f"{record.name}, no path: --from is not reached in home's mode: {start.words}"
        code = exit_codes.of_status(start.status.name)
        return Outcome(
            NoPath(record.name, start.status.name, said),
            lambda: [said, "hint: name another mode at --from by --mode"],
            code,
        )
    return _followed(record, start.joints, along, goal, turns=turns, use_limits=use_limits)


def _followed(
    record: Mechanism, joints: NDArray[Any], along: Along, goal: NDArray[Any], *, turns: Turns, use_limits: bool
) -> Outcome:
    poses, inputs = (goal, None) if along == "pose" else (None, goal)
    with handing_over(Path, lambda path: _outcome(record, path)):
        path = follow(record, joints, poses=poses, inputs=inputs, turns=turns, use_limits=use_limits)
    return _outcome(record, path)


def _outcome(record: Mechanism, path: Path) -> Outcome:
    code = exit_codes.FINE
    if path.stopped is not None:  # "undecided" where nothing is seen that would stop it
        code = exit_codes.UNDECIDED if path.stopped.kind == "undecided" else exit_codes.STOPPED
    data = path.answer()
    return Outcome(data, lambda: _shown(record, path, data), code)


def _points(record: Mechanism, along: Along, texts: Sequence[str], option: str = "--to") -> NDArray[Any]:
    """Points (k, m) or (k, n) from texts, in lengths and rad."""
    names = record.platform.pose if along == "pose" else input_names(record)
    what = f"{option}, {'pose' if along == 'pose' else 'inputs'} of {record.name}"
    points = max(1, round(len(texts) / len(names)))
    values = np.array(numbers(texts, list(names) * points, what)).reshape(points, len(names))
    return pose_from_border(record, values) if along == "pose" else inputs_from_border(record, values)


def _nearest_home(record: Mechanism, solutions: SolutionSet, default: str) -> int | None:
    """The listed solution of the default mode that is nearest to home; None where there is none."""
    rows = [
        k
        for k in np.flatnonzero(solutions.exists)
        if not default or str(solutions.labels[k]).partition("/")[0] == default
    ]
    if not rows:
        return None
    change = solutions.joints[rows] - record.home_values
    turned = np.where(periodic(record), 1 - np.cos(change), 0.0)
    return int(rows[int(np.argmin(np.sum(turned, axis=-1)))])


def _shown(record: Mechanism, path: Path, data: PathAnswer) -> Iterable[RenderableType]:
    style = style_of(record)
    stop = path.stopped
    along = "poses" if path.prescribed == "poses" else "inputs"
    end = "the end was reached" if stop is None else f"stopped, {stop.kind}"
    yield heading(f"{record.name}, path along {along}: {end}")
    if path.left:
        yield f"It begins at {WORDS[path.left]}, and leaves it."
    if stop is not None:
        yield _stop(stop, style)
    else:
        yield (
            f"No {'other ' if path.left else ''}singularity was seen at its {count(len(path), 'point')}, and no"
            " determinant changed its sign between them; one that is passed and passed back within a step is not seen."
        )
    if path.remark:
        yield f"At the end {path.remark}."
    yield ""
    kinds = [item.coordinate.kind for item in record.inputs]
    titles = [f"{name} [{style.coordinate_unit(name)}]" for name in data.coordinates]
    titles += [f"{name} [{style.kind_unit(kind)}]" for name, kind in zip(data.input_names, kinds, strict=True)]
    rows = []
    for k in _picked(data.shares):
        pose = [style.coordinate(*pair) for pair in zip(data.coordinates, data.poses[k], strict=True)]
        inputs = [style.kind(*pair) for pair in zip(kinds, data.inputs[k], strict=True)]
        rows.append((fixed(100 * data.shares[k], 2), *pose, *inputs))
    yield table(("share [%]", *titles), rows)
    least = min(float(path.smallest[name].min()) for name in ("inputs", "poses"))
    yield f"{count(len(path), 'point')}; smallest singular value on the way, inputs or platform locked: {short(least)}"
    yield f"(without a unit: lengths in units of {short(characteristic_length(record))} {record.unit})"
    before, after = (_mode(*signs) for signs in path.modes)
    if before:
        yield f"mode: {before}, {'kept' if before == after else f'then {after}'}"


def _stop(stop: Stop, style: Style) -> str:
    """Why a path stopped, as a sentence; its gap with a unit."""
    text = str(stop)
    if stop.gap:
        gap = f"a gap of {stop.gap:.3g}"
        text = text.replace(gap, f"{gap} {style.unit}")
    return f"{text[:1].upper()}{text[1:]}."


def _mode(working: str, assembly: str) -> str:
    """Both modes in words, as far as the file names signs for them."""
    return ", ".join(f"{kind} {signs}" for kind, signs in (("working", working), ("assembly", assembly)) if signs)


def _picked(shares: Sequence[float]) -> list[int]:
    """At most `ROWS` indices, evenly spread over the way, both ends among them."""
    wanted = np.linspace(shares[0], shares[-1], ROWS)
    nearest = np.argmin(np.abs(np.asarray(shares)[:, None] - wanted), axis=0)
    return sorted({0, *nearest.tolist(), len(shares) - 1})[-ROWS:]
