"""Where a mechanism is singular: its factors, their loci inside the workspace, an example configuration of each."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.progress import progress
from assur.cli.quantities import mode_words, point_text, point_title, short, style_of
from assur.cli.regions import area_title

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.mechanism import Mechanism
    from assur.workspace.region import Workspace

RESOLUTION = 48
"""Cells along each coordinate of the box in which loci are looked for."""


def outcome(record: Mechanism, mode: str, shared: Shared) -> Outcome:
    """The outcome for a whole mechanism, its loci being those of one working mode."""
    from assur.singularity.examples import singular_examples
    from assur.workspace.region import workspace
    from assur.workspace.sign_changes import ways_across

    with progress("loci in the workspace", shared) as step:
        region = workspace(record, mode, resolution=RESOLUTION if record.closed_form else None, progress=step)
    with progress("example configurations", shared) as step:
        examples = [_example(record, item) for item in singular_examples(record, 0, step, lambda: ways_across(region))]
    data = {
        "mechanism": record.name,
        "unit": record.unit,
        "angle": record.angle,
        "coordinates": list(record.platform.pose),
        "mode": mode,
        "factors": _factors(record),
        **_groups(record),
        "loci": _loci(region),
        "examples": examples,
    }
    return Outcome(data, lambda: _shown(record, data))


def _factors(record: Mechanism) -> list[dict[str, Any]]:
    from assur.kinematics.answers.at_border import power
    from assur.kinematics.status import closed_form_of, scale

    return (
        [
            {
                "name": item.name,
                "kind": item.kind,
                "meaning": item.meaning,
                "unit": power(record.unit, item.unit),
                "scale": scale(record, item.scale),
            }
            for item in closed_form_of(record).factor_list
        ]
        if record.closed_form
        else []
    )


def _groups(record: Mechanism) -> dict[str, list[list[str]]]:
    from assur.kinematics.status import closed_form_of

    if record.closed_form is None:
        return {"constraint": [], "self_motion": []}
    form = closed_form_of(record)
    return {
        "constraint": [list(group) for group in form.constraint_singular],
        "self_motion": [list(group) for group in form.self_motion_singular],
    }


def _loci(region: Workspace) -> list[dict[str, Any]]:
    found = region.parallel_singular["factors"]
    return [
        {"factor": name, "area": item["area"], "everywhere": item["everywhere"], "meaning": item["meaning"]}
        for name, item in found.items()
    ]


def _example(record: Mechanism, example: Any) -> dict[str, Any]:
    from assur.kinematics.answers.at_border import inputs_at_border, pose_at_border
    from assur.results.json_text import plain

    return {
        "factor": example.factor.name,
        "kind": example.status.name,
        "mode": example.mode,
        "pose": plain(pose_at_border(record, example.pose)),
        "inputs": plain(inputs_at_border(record, example.inputs)),
        "in_box": example.in_box,
    }


def _shown(record: Mechanism, data: dict[str, Any]) -> Iterable[RenderableType]:
    style = style_of(record)
    if data["factors"]:
        yield heading(f"{data['mechanism']}, singularities: where one of these is zero")
        yield table(
            ("factor", "kind", "zero where"),
            [(item["name"], item["kind"], item["meaning"]) for item in data["factors"]],
            left=("factor", "kind", "zero where"),
        )
    else:
        yield heading(f"{data['mechanism']}, singularities: no closed form, so no factors")
    for kind, what in (("constraint", "the joint graph loses rank"), ("self_motion", "the platform moves alone")):
        for group in data[kind]:
            yield f"{kind}: {' = '.join(group)} = 0, {what}"
    yield ""
    yield heading(f"parallel loci inside the workspace box, {mode_words(record, data['mode'])}")
    yield table(
        ("factor", area_title(record, data["coordinates"])),
        [(item["factor"], _area(item)) for item in data["loci"]],
        left=("factor",),
    )
    yield ""
    yield heading("example configurations")
    rows = [
        (item["factor"], item["kind"], item["mode"], point_text(style, data["coordinates"], item["pose"]))
        for item in data["examples"]
    ]
    pose = point_title(style, data["coordinates"])
    yield table(("factor", "the pose is", "mode", pose), rows, left=("factor", "the pose is", pose))
    without = [item["name"] for item in data["factors"] if item["name"] not in {row[0] for row in rows}]
    if without:
        yield f"no example found: {', '.join(without)}"


def _area(item: dict[str, Any]) -> str:
    if item["everywhere"]:
        return "the whole mode"
    return short(item["area"]) if item["area"] else "none found"
