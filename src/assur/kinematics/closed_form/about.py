"""What the files of a stored sweep hold, as plain data: the grid, axes, units, and how the answers are known."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from assur.kinematics.modes import Problem
from assur.kinematics.status import Status
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.results.json_text import json_text
from assur.results.store.layout import Array, Plan
from assur.results.store.note import Counts


def coordinates(record: MechanismRecord, problem: Problem) -> dict[str, str]:
    """What a grid runs over: name -> "length" or "angle", in the file's order.

    >>> from assur.model.registry import load_record
    >>> coordinates(load_record("fivebar"), "direct")
    {'theta1': 'angle', 'theta2': 'angle'}
    """
    if problem == "direct":
        return {item.name: item.coordinate.kind for item in record.inputs}
    return {name: "angle" if is_angle(name) else "length" for name in record.platform.pose}


def drive_kinds(record: MechanismRecord) -> dict[str, str]:
    """Every input of the file, redundant ones last: name -> "length" or "angle"."""
    return {item.name: item.coordinate.kind for item in record.drives}


def told(plan: Plan, counts: Counts) -> bytes:
    """`sweep.json`: what the files of a store hold that is done; of a shard one axis of places."""
    return (json_text(described(plan, counts, plan.length)) + "\n").encode()


def described(plan: Plan, counts: Counts, done: int) -> dict[str, Any]:
    """What the files of a store hold: what is known of the whole grid, which part it is, and what was counted.

    Args:
        plan: with what `about` says.
        counts: of modes that solve a problem, of branches by status, and of problems without a mechanism.
        done: how many places are done.
    """
    known = dict(plan.about or {})
    files, status = known.pop("files"), counts.get("status", {})
    modes = dict(sorted(counts.get("modes", {}).items(), key=lambda counted: int(counted[0])))
    by_status = {one.name: status[one.name] for one in Status if one.name in status}
    return {
        **known,
        "problems": plan.length,
        "done": done,
        "shard": _shard(plan),
        "counts": {
            "by_modes": modes,
            "by_status": by_status if "status" in files else None,
            "refused": counts.get("refused", {}),
        },
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
