"""What the files of a stored sweep hold, as plain data: the grid, axes, units, and how the answers are known."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from assur.kinematics.answers.at_border import power
from assur.kinematics.modes import Problem
from assur.kinematics.status import Status, closed_form_of
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.results.json_text import json_text
from assur.results.store.layout import Array, Plan
from assur.results.store.note import Counts

if TYPE_CHECKING:
    from assur.kinematics.closed_form.grid_sweep import GridSweep

_ROWS = {"inputs": "input", "poses": "coordinate", "factors": "factor"}


def coordinates(record: MechanismRecord, problem: Problem) -> dict[str, str]:
    """What a grid runs over: name -> "length" or "angle", in the file's order.

    >>> from assur.model.registry import load_record
    >>> coordinates(load_record("fivebar"), "direct")
    {'theta1': 'angle', 'theta2': 'angle'}
    """
    if problem == "direct":
        return {item.name: item.coordinate.kind for item in record.inputs}
    return {name: "angle" if is_angle(name) else "length" for name in record.platform.pose}


def factor(record: MechanismRecord, kind: str) -> float:
    """From the mechanism's unit of a length or an angle to the length or rad."""
    return math.pi / 180 if kind == "angle" and record.angle == "deg" else 1.0


def about(sweep: GridSweep) -> dict[str, Any]:
    """The sweep of a whole grid, without what is counted in it."""
    record = sweep.record
    kinds = coordinates(record, sweep.problem)
    units = {"length": record.unit, "angle": record.angle}
    axes: list[dict[str, Any]] = []
    held: dict[str, float] = {}
    scales = sweep.grid.scales or (1.0,) * len(kinds)
    for k, (name, kind) in enumerate(kinds.items()):
        scale = scales[k] / factor(record, kind)
        low, high = (value * scale for value in (sweep.grid.low[k], sweep.grid.high[k]))
        if sweep.grid.counts[k] == 1:
            held[name] = low
        else:
            axes.append({"name": name, "unit": units[kind], "low": low, "high": high, "count": sweep.grid.counts[k]})
    return {
        "mechanism": record.name,
        "dimensions": {name: float(value) for name, value in vars(record.values).items()},
        "problem": sweep.problem,
        "mode": sweep.mode,
        "modes": list(sweep.modes),
        "unit": record.unit,
        "angle": record.angle,
        "along": axes,
        "at": held,
        "how": sweep.how,
        "files": {array.name: _file(sweep, array, [axis["name"] for axis in axes]) for array in sweep.arrays},
    }


def told(plan: Plan, counts: Counts) -> bytes:
    """`sweep.json`: what the files of a store hold that is done; of a shard one axis of places."""
    return (json_text(described(plan, counts, plan.length)) + "\n").encode()


def described(plan: Plan, counts: Counts, done: int) -> dict[str, Any]:
    """What the files of a store hold: what is known of the whole grid, which part it is, and what was counted.

    Args:
        plan: with what `about` says.
        counts: of modes that solve a problem, and of branches by status.
        done: how many places are done.
    """
    known = dict(plan.about or {})
    files, status = known.pop("files"), counts.get("status", {})
    modes = dict(sorted(counts.get("modes", {}).items(), key=lambda item: int(item[0])))
    by_status = {one.name: status[one.name] for one in Status if one.name in status}
    return {
        **known,
        "problems": plan.length,
        "done": done,
        "shard": _shard(plan),
        "counts": {"by_modes": modes, "by_status": by_status if "status" in files else None},
        "bytes": plan.bytes,
        "files": {array.name: _of_files(plan, array, files[array.name]) for array in plan.files},
    }


def _shard(plan: Plan) -> dict[str, int] | None:
    if plan.shard is None:
        return None
    return {
        "index": plan.shard.index,
        "of": plan.shard.of,
        "first": plan.places.start,
        "last": plan.places.stop - 1,
        "problems": plan.size,
    }


def _of_files(plan: Plan, array: Array, whole: Mapping[str, Any]) -> dict[str, Any]:
    if plan.shard is None:
        return dict(whole)
    axes = [*whole["axes"][: len(array.rows)], "place"]
    return {**whole, "shape": list(array.shape), "axes": axes}


def _file(sweep: GridSweep, array: Array, along: Sequence[str]) -> dict[str, Any]:
    rows, units, meaning = _rows(sweep, array.name)
    names = [*(["mode"] if sweep.every else []), *([_ROWS[array.name]] if rows else [])]
    return {
        "file": f"{array.name}.npy",
        "shape": list(array.shape),
        "dtype": array.dtype,
        "axes": [*names, *along],
        "rows": rows,
        "units": units,
        "meaning": meaning,
    }


def _rows(sweep: GridSweep, name: str) -> tuple[list[str], list[str], str]:
    """Names and units of the rows of a file, where it has some, and what stands in it."""
    record = sweep.record
    units = {"length": record.unit, "angle": record.angle}
    if name in ("inputs", "poses"):
        kinds = coordinates(record, "direct" if name == "inputs" else "inverse")
        return list(kinds), [units[kind] for kind in kinds.values()], f"the {name}; NaN where `exists` would be false"
    if name == "factors":
        items = closed_form_of(record).factor_list
        names, powers = [item.name for item in items], [power(record.unit, item.unit) for item in items]
        return names, powers, "factors of det Jp and det Jq"
    meanings = {
        "exists": sweep.existence,
        "status": "status: " + ", ".join(f"{status.value} {status.name}" for status in Status),
        "det_jp": f"det Jp of the regular Jacobian, {record.unit} and rad",
        "det_jq": f"det Jq of the regular Jacobian, {record.unit} and rad",
        "condition_index": f"1/cond2 of Jp^-1 Jq, 0 where singular, {record.unit} and rad",
        "smallest": f"smallest singular value of Jp^-1 Jq, {record.unit} and rad",
    }
    return [], [], meanings[name]
