"""The scene of a page: everything that a browser needs to draw a mechanism and to move it, as one JSON object."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.home import home_values
from assur.kinematics.status import scale
from assur.kinematics.turns import counted
from assur.model.mechanism import MechanismRecord
from assur.page import kernel
from assur.page.branches import branches, modes
from assur.page.configuration import configuration
from assur.page.facts import errata, errata_note, facts
from assur.page.graph import coordinates, graph
from assur.page.origin import Original, original
from assur.page.quantised import quantised
from assur.page.ranges import input_ranges, pose_ranges
from assur.page.resizing import resizing
from assur.scene.companion import companion
from assur.scene.layers import Layer
from assur.scene.letters import letters
from assur.scene.parts import machine
from assur.scene.skeleton import skeleton
from assur.work import stage

VERSION = 1
"""Of the form of the scene; a page and its program belong together."""

DIGITS = 6
"""Significant digits, of the size of the mechanism, of what is only drawn."""


@stage("numbers of the page")
def content(record: MechanismRecord, layers: Sequence[Layer], layers_note: str = "") -> dict[str, Any]:
    """The scene at home, with layers as `assur.scene.layers` gives them; lengths in the unit, angles in rad.

    Everything that is computed from is there to its last bit; what is only drawn is rounded (`DIGITS`, and layers).

    Errors: UsageError or MechanismFileError where the mechanism has no home.

    >>> from assur.model.registry import load_record
    >>> found = content(load_record("fivebar"), ())
    >>> found["name"], [item["name"] for item in found["inputs"]]
    ('fivebar', ['theta1', 'theta2'])
    """
    home = home_values(record)
    drawn = companion(record)
    body = skeleton(record, drawn, home)
    lettered = letters(body)
    source = original(record)
    return {
        "version": VERSION,
        "name": record.name,
        "title": record.title,
        "source": record.source,
        "unit": record.unit,
        "angleUnit": record.angle,
        "size": body.size,
        "extent": body.size,
        "characteristicLength": characteristic_length(record),
        "parameters": _parameters(record, source),
        **resizing(record, lettered),
        "original": None if source is None else {"name": source.name},
        "graph": graph(record),
        "configuration": configuration(record),
        "coordinates": coordinates(record),
        "platform": {
            "link": record.platform.link,
            "point": record.platform.point.tolist(),
            "pose": list(record.platform.pose),
        },
        "inputs": _inputs(record),
        "poseRange": pose_ranges(record),
        "home": home.tolist(),
        "branches": branches(record),
        "modes": modes(record),
        "parts": _parts(machine(record), body.size),
        "letters": [{"name": item.name, "link": item.link, "at": item.at.tolist()} for item in lettered],
        "layers": [_layer(item) for item in layers],
        "layersNote": layers_note,
        "kernel": kernel.kernel(record),
        "kernelParameters": kernel.parameters(record),
        "factors": _factors(record),
        "facts": facts(record),
        "errata": errata(record),
        "errataNote": errata_note(record),
    }


def _parameters(record: MechanismRecord, source: Original | None) -> list[dict[str, Any]]:
    return [
        {
            "name": name,
            "value": item.value,
            "unit": item.unit,
            "meaning": item.meaning,
            "original": None if source is None else source.other(name, item.value),
        }
        for name, item in record.parameters.items()
    ]


def _inputs(record: MechanismRecord) -> list[dict[str, Any]]:
    ranges = input_ranges(record)
    return [
        {
            "name": item.name,
            "latex": item.latex,
            "index": item.coordinate.index,
            "sign": item.sign,
            "offset": item.offset,
            "kind": item.coordinate.kind,
            "counted": bool(counted(record)[item.coordinate.index]),
            "stroke": None if item.stroke is None else list(item.stroke),
            "range": ranges[k],
        }
        for k, item in enumerate(record.inputs)
    ]


def _parts(solids: tuple[Any, ...], size: float) -> list[dict[str, Any]]:
    return [
        {
            "name": item.name,
            "link": item.link,
            "colour": item.colour,
            "shape": {key: _rounded(value, size) for key, value in item.shape.to_json().items()},
        }
        for item in solids
    ]


def _rounded(value: Any, size: float) -> Any:
    """Lengths that are drawn, in so many digits of the size; directions have as many."""
    if isinstance(value, str):
        return value
    step = 10.0 ** (np.floor(np.log10(size)) + 1 - DIGITS)
    array: NDArray[np.float64] = np.asarray(value, dtype=float)
    places = int(max(DIGITS, -np.log10(step)))
    return (np.round(array, places) + 0.0).tolist()


def _factors(record: MechanismRecord) -> list[dict[str, Any]]:
    form = record.closed_form
    return [
        {
            "name": item.name,
            "kind": item.kind,
            "meaning": item.meaning,
            "latex": item.latex,
            "scale": float(scale(record, item.scale)),
        }
        for item in (form.factor_list if form else ())
        if item.kind != "other"
    ]


def _layer(layer: Layer) -> dict[str, Any]:
    said = {name: getattr(layer, name) for name in ("kind", "label", "colour", "opacity", "factor")}
    return {**said, "visible": False, **quantised(layer.vertices, layer.faces)}
