"""The companion `figures.toml` beside a mechanism's file: what its source calls the parts, and views that show them.

Everything in it is optional. It says names, numbers, views and which configuration is drawn, never geometry.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from assur.errors import MechanismFileError, UnknownNameError
from assur.joint_graph.points import quantity
from assur.model.file.faults import Faults
from assur.model.file.toml_source import TomlSource, read_toml
from assur.model.formula import FormulaError, parse
from assur.model.mechanism import MechanismRecord
from assur.results.reading import file_text
from assur.scene.camera import Camera, oblique, orthographic

FILE = "figures.toml"


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class Orthographic(_Part):
    """Seen from far away, from an azimuth and an elevation in degrees."""

    kind: Literal["orthographic"]
    azimuth: Annotated[float, Field(ge=-360, le=360)]
    elevation: Annotated[float, Field(ge=-90, le=90)]


class Oblique(_Part):
    """Two axes in true shape, the third at an angle in degrees and shortened by a scale."""

    kind: Literal["oblique"]
    right: Literal["x", "y", "z"]
    up: Literal["x", "y", "z"]
    angle: float
    scale: Annotated[float, Field(gt=0, le=1)]


class DrawnBar(_Part):
    """A straight part of a link between two of its joints or lettered points."""

    link: str
    ends: Annotated[list[str], Field(min_length=2, max_length=2)]
    label: str = ""
    length: str = ""


class DrawnMeasure(_Part):
    """A distance of two points along one axis, with its letter, in the figure of a plane."""

    ends: Annotated[list[str], Field(min_length=2, max_length=2)]
    along: Literal["x", "y", "z"]
    latex: str
    length: str = ""


class Schematic(_Part):
    """Other dimensions and another pose for the figures that show how the mechanism is made."""

    parameters: dict[str, float] = {}
    pose: list[float] = []
    because: str = ""


class Examples(_Part):
    """The quantities of the joint graph whose vanishing the source draws: a serial and a parallel singularity.

    Formulas over joints and coordinates of points, as in [modes]; whatever a closed form calls its factors.
    """

    serial: str = ""
    parallel: str = ""


class FlowStep(_Part):
    """A box of the flow of the direct solution, or what is said of the box of a quantity beside its declaration.

    `needs` replaces what it is computed from, `adds` adds to it; `sign` is the mode sign that is chosen in it;
    a `condition` is a geometric constraint that is put in, not computed.
    """

    needs: list[str] | None = None
    adds: list[str] = []
    latex: str = ""
    equation: str = ""
    sign: str = ""
    condition: bool = False


class Flow(_Part):
    """What the flow of the direct solution shows beside `ClosedForm.quantity_list`."""

    leave_out: list[str] = []
    steps: dict[str, FlowStep] = {}


class MeetingLinks(_Part):
    """Two links that share no joint and still meet at home as they are drawn, and why that cannot be helped."""

    links: Annotated[list[str], Field(min_length=2, max_length=2)]
    because: Annotated[str, Field(min_length=1)]


class Companion(_Part):
    """How a mechanism is drawn; an empty one draws it with its own names and common views.

    `thickness` is that of a flat bar and `rail` half the length of a rail, as formulas of the parameters.
    """

    inputs: list[float] = []
    rail: str = ""
    thickness: str = ""
    meets: list[MeetingLinks] = []
    bars: list[DrawnBar] = []
    measures: list[DrawnMeasure] = []
    links: dict[str, str] = {}
    chains: dict[str, str] = {}
    generalised: dict[str, str] = {}
    numbers: dict[str, str] = {}
    schematic: Schematic = Schematic()
    examples: Examples = Examples()
    flow: Flow = Flow()
    views: dict[str, Annotated[Orthographic | Oblique, Field(discriminator="kind")]] = {}

    def camera(self, name: str, default: Camera) -> Camera:
        """The view of a figure, or the default where the file gives none."""
        view = self.views.get(name)
        if view is None:
            return default
        if isinstance(view, Orthographic):
            return orthographic(view.azimuth, view.elevation)
        return oblique(view.right, view.up, view.angle, view.scale)


def companion(record: MechanismRecord) -> Companion:
    """The companion of a mechanism, empty where there is no such file.

    Errors: `MechanismFileError` with every fault, where it is, and what is allowed.

    >>> from assur.model.registry import load_record
    >>> companion(load_record("zeng2019")).numbers["flow"]
    '3'
    """
    path = record.folder / FILE if record.folder else None
    if path is None or not path.is_file():
        return Companion()
    source = read_toml(file_text(path), str(path))
    faults = Faults(str(path), source)
    checked = _checked(source, faults)
    if checked is None:
        faults.raise_any()
        return Companion()
    _check_names(record, checked, faults)
    _check_texts(source.data, (), faults)
    faults.raise_any()
    return checked


def _check_texts(data: Any, path: tuple[str | int, ...], faults: Faults) -> None:
    """A dollar sign would begin a formula in a text that is none."""
    if isinstance(data, dict):
        for key, value in data.items():
            _check_texts(value, (*path, key), faults)
    elif isinstance(data, list):
        for k, value in enumerate(data):
            _check_texts(value, (*path, k), faults)
    elif isinstance(data, str) and "$" in data and path[-1] != "latex":
        faults.add(path, f"'{data}'", "allowed: words without dollar signs; `latex` is for formulas")


def _checked(source: TomlSource, faults: Faults) -> Companion | None:
    try:
        return Companion.model_validate(source.data)
    except ValidationError as error:
        for details in error.errors():
            place = tuple(part for part in details["loc"] if part not in ("orthographic", "oblique"))
            if details["type"] == "extra_forbidden" and len(place) == 1:
                faults.unknown(place, "key", str(place[0]), Companion.model_fields)
            else:
                faults.add(place, repr(details["input"])[:60], details["msg"])
    return None


def _check_names(record: MechanismRecord, companion: Companion, faults: Faults) -> None:
    named = {**record.points, **record.joints}
    for k, bar in enumerate(companion.bars):
        _known(faults, ("bars", k, "link"), "link", bar.link, record.links)
        for end in bar.ends:
            _known(faults, ("bars", k, "ends"), "joint or point", end, named)
        _formula(record, faults, ("bars", k, "length"), bar.length)
    for k, measure in enumerate(companion.measures):
        for end in measure.ends:
            _known(faults, ("measures", k, "ends"), "joint or point", end, named)
        _formula(record, faults, ("measures", k, "length"), measure.length)
    for k, meeting in enumerate(companion.meets):
        for name in meeting.links:
            _known(faults, ("meets", k, "links"), "link", name, record.links)
    _formula(record, faults, ("rail",), companion.rail)
    thickness = _formula(record, faults, ("thickness",), companion.thickness)
    if thickness is not None and not thickness > 0:
        faults.add(("thickness",), f"{companion.thickness} = {thickness:g}", "a length above 0")
    for part, choices in (
        ("links", record.links),
        ("chains", record.chains),
        ("generalised", record.generalised),
    ):
        for name in getattr(companion, part):
            _known(faults, (part, name), part, name, choices)
    for name in companion.schematic.parameters:
        _known(faults, ("schematic", "parameters", name), "parameter", name, record.parameters)
    for kind in ("serial", "parallel"):
        _quantity(record, faults, ("examples", kind), getattr(companion.examples, kind))
    for path, values, length in (
        (("inputs",), companion.inputs, len(record.inputs)),
        (("schematic", "pose"), companion.schematic.pose, len(record.platform.pose)),
    ):
        if values and len(values) != length:
            faults.add(path, f"{len(values)} values", f"{length}")


def _known(faults: Faults, path: tuple[str | int, ...], kind: str, name: str, choices: object) -> None:
    names = [str(choice) for choice in choices]  # type: ignore[attr-defined]  # dicts and lists of names
    if name not in names:
        faults.unknown(path, kind, name, names)


def _quantity(record: MechanismRecord, faults: Faults, path: tuple[str | int, ...], text: str) -> None:
    """Note a formula of joint values and points that has none."""
    try:
        if text:
            quantity(record, parse(text), np.zeros(len(record.coordinates)))
    except (FormulaError, UnknownNameError) as error:
        faults.add(path, text, error.message)


def _formula(record: MechanismRecord, faults: Faults, path: tuple[str | int, ...], text: str) -> float | None:
    """The value of a formula; None where there is none, or a faulty one."""
    if not text:
        return None
    try:
        return length(record, text)
    except (FormulaError, UnknownNameError) as error:
        faults.add(path, text, error.message)
        return None


def length(record: MechanismRecord, text: str) -> float:
    """Value of a formula of the parameters.

    >>> from assur.model.registry import load_record
    >>> length(load_record("zeng2019"), "2*d")
    100.0
    """
    formula = parse(text)
    for name in formula.names:
        record.parameter(name)
    return float(formula.evaluate(vars(record.values)))


__all__ = ["FILE", "Companion", "DrawnBar", "MechanismFileError", "companion", "length"]
