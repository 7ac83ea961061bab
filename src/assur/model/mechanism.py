"""The record of a mechanism: what the reader makes of a file, with every formula evaluated. Frozen data."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal, Self

import numpy as np
from numpy.typing import NDArray

from assur.errors import UnknownNameError
from assur.joints.joint_type import JointType
from assur.model.closed_form import ClosedForm
from assur.model.file.description import Description
from assur.model.formula import ANGLE_UNITS, Formula
from assur.model.machine_data import MachineData
from assur.model.written import JointFormulas, WrittenVector

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Parameter:
    """A dimension of the mechanism: its value in `unit`, and what it may be."""

    name: str
    value: float
    meaning: str
    unit: str
    sign: Literal["positive", "nonnegative", "any"] = "positive"
    drawn_only: bool = False

    @property
    def angular(self) -> bool:
        """Whether it is an angle, not a length."""
        return self.unit in ANGLE_UNITS

    @property
    def inside(self) -> float:
        """The value as formulas and kernels take it: angles in rad."""
        return math.radians(self.value) if self.unit == "deg" else self.value


@dataclass(frozen=True)
class Link:
    """A rigid body. It owns one frame, parallel to the base's when every joint value is zero."""

    name: str
    meaning: str = ""


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint between two links; nothing says that it closes a loop.

    Attributes:
        at, child_at: (3,) the joint's point in the parent's and in the child's frame.
        axes: (k, 3) unit vectors of its steps, the written ones first, in the parent's frame; what an axis behind
            another turn is along, as the second of U, is so in the child's. None for S.
        turn: (3, 3) orientation of the child's frame in the parent's at value zero. The identity, unless
            the file gives a `child_axis`.
        pitch: advance of an H joint per turn, in length units, right-handed.
        limits: one (low, high) per component, None where there is none.
        cone, cone_axis: an S joint's largest tilt in rad of this axis (3,), fixed in both links and the same
            in both frames at value zero.
        written: the formulas of at, child_at, axes, turn and pitch.
    """

    name: str
    type: JointType
    parent: str
    child: str
    at: FloatArray
    child_at: FloatArray
    axes: FloatArray
    turn: FloatArray
    pitch: float = 0.0
    alias: str = ""
    limits: tuple[tuple[float, float] | None, ...] = ()
    cone: float | None = None
    meaning: str = ""
    cone_axis: FloatArray | None = None
    written: JointFormulas | None = None

    @cached_property
    def turned(self) -> bool:
        """Whether the child's frame is turned against the parent's at value zero."""
        return not np.array_equal(self.turn, np.eye(3))


@dataclass(frozen=True, eq=False)
class Platform:
    """The moving platform: its point O', with its formulas, and the coordinates that count as its pose."""

    link: str
    point: FloatArray
    pose: tuple[str, ...]
    orientation: Literal["constant", "any"]
    written: WrittenVector | None = None


@dataclass(frozen=True)
class Coordinate:
    """One component of one joint: index in the vector of joint values, and what it is."""

    joint: str
    component: str
    index: int
    kind: Literal["angle", "length"]


@dataclass(frozen=True)
class Input:
    """An actuated coordinate. Printed value = sign * joint value + offset."""

    coordinate: Coordinate
    name: str
    latex: str
    offset: float = 0.0
    sign: float = 1.0
    stroke: tuple[float, float] | None = None

    def printed(self, value: Any) -> Any:
        """The printed input at values of the joint, over any number type."""
        return value * self.sign + self.offset

    def joint_value(self, printed: Any) -> Any:
        """The joint's value at printed inputs, over any number type."""
        return (printed - self.offset) * self.sign


@dataclass(frozen=True)
class GeneralisedJoint:
    """Joints that act together as one joint between two links, as POC theory counts them."""

    name: str
    kind: str
    joints: tuple[str, ...]
    parent: str
    child: str


@dataclass(frozen=True)
class LimbRecord:
    """A branch from base to platform: serial, or an inner loop with an output link and a serial tail."""

    name: str
    serial: tuple[str, ...] = ()
    loop: tuple[str, ...] = ()
    output: str = ""
    tail: tuple[str, ...] = ()
    printed: str = ""


@dataclass(frozen=True, eq=False)
class Point:
    """A letter: a point fixed in a link, with its formulas, for drawings, audit and errata."""

    name: str
    link: str
    at: FloatArray
    written: WrittenVector | None = None


@dataclass(frozen=True)
class Modes:
    """Names of branches: each a row of signs of named quantities of the joint graph, in the file's order.

    Where the file names none, and its closed form those of the joint graph's closing blocks, a name has no formula.
    """

    working: Mapping[str, Formula | None] = field(default_factory=dict)
    assembly: Mapping[str, Formula | None] = field(default_factory=dict)
    default_working: str = ""
    default_assembly: str = ""

    def completed(self, working: Sequence[str], assembly: Sequence[str]) -> Modes:
        """The same with names of closing blocks, all of which are + at home, for a problem without names."""
        own = self
        if working and not own.working:
            own = replace(own, working=dict.fromkeys(working), default_working="+" * len(working))
        if assembly and not own.assembly:
            own = replace(own, assembly=dict.fromkeys(assembly), default_assembly="+" * len(assembly))
        return own

    @property
    def of_file(self) -> Modes:
        """The same without names of closing blocks."""
        own = self
        if None in own.working.values():
            own = replace(own, working={}, default_working="")
        if None in own.assembly.values():
            own = replace(own, assembly={}, default_assembly="")
        return own


@dataclass(frozen=True, eq=False, repr=False)
class MechanismRecord:
    """A mechanism with its dimensions. Change dimensions with `with_parameters`.

    Attributes:
        unit: the length unit of every length of the file ("mm", "m", ...).
        angle: "deg" or "rad", the angle unit at the border; inside, angles are in rad.
        inputs: those that determine the mechanism, the first ones of the file, as many as its pose has rates.
        redundant_inputs: the file's further ones, which follow.
        coordinates: every component of every joint, in the order of the vector of joint values.
        angles: the source's letters for joint values.
        home: (n,) joint values near one assembled configuration, as the file gives them.
        box: name of a pose coordinate -> (low, high): where the source looks for the workspace.
        sections: values of the last pose coordinate at which the source cuts the workspace.
        folder: where the file's companions are (closed form, reference), None for a lone file.
        closed_form_text: what stood in the file of the closed form when it was read.
        closed_form_not_run: whether there is a closed form that only Python could read, and that was not run.
        description: the file that the record was made of, for making it again with other dimensions.
        overrides: parameters whose values are not the file's.
        machine: masses, cross-sections, actuators and tolerances, as far as the file says them.
        thickness: of a flat bar as it is drawn, a length; None for what `assur.scene.sizes` chooses.
    """

    name: str
    title: str
    source: str
    unit: str
    angle: Literal["deg", "rad"]
    parameters: Mapping[str, Parameter]
    links: Mapping[str, Link]
    joints: Mapping[str, Joint]
    base: str
    platform: Platform
    inputs: tuple[Input, ...]
    coordinates: tuple[Coordinate, ...]
    home: FloatArray
    modes: Modes
    file: Path
    folder: Path | None = None
    generalised: Mapping[str, GeneralisedJoint] = field(default_factory=dict)
    chains: Mapping[str, LimbRecord] = field(default_factory=dict)
    angles: Mapping[str, Coordinate] = field(default_factory=dict)
    points: Mapping[str, Point] = field(default_factory=dict)
    box: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    sections: tuple[float, ...] = ()
    closed_form: ClosedForm | None = None
    closed_form_text: str = ""
    closed_form_not_run: bool = False
    description: Description | None = None
    overrides: Mapping[str, float] = field(default_factory=dict)
    thickness: float | None = None
    redundant_inputs: tuple[Input, ...] = ()
    machine: MachineData = field(default_factory=MachineData)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}: {self.title}>"

    def with_closed_form(self, form: ClosedForm | None, text: str, *, not_run: bool = False) -> Self:
        """The same with what stands in the file of the closed form, which may name modes where the file does not.

        >>> import assur
        >>> assur.load("fivebar").with_closed_form(None, "").closed_form is None
        True
        """
        modes = self.modes.completed(form.working, form.assembly) if form else self.modes
        return replace(self, closed_form=form, closed_form_text=text, closed_form_not_run=not_run, modes=modes)

    @property
    def without_closed_form(self) -> MechanismRecord:
        """The same, solved on its joint graph alone, with the file's names of modes."""
        return _without_closed_form(self)

    @property
    def values(self) -> SimpleNamespace:
        """Parameters by name, as kernels take them: angles in rad."""
        return SimpleNamespace(**{name: parameter.inside for name, parameter in self.parameters.items()})

    @property
    def drives(self) -> tuple[Input, ...]:
        """Every input of the file: those that determine the mechanism, then those that follow."""
        return (*self.inputs, *self.redundant_inputs)

    @property
    def determined(self) -> MechanismRecord:
        """The same without redundant inputs."""
        return replace(self, redundant_inputs=())

    @property
    def input_indices(self) -> tuple[int, ...]:
        """Indices of the inputs in the vector of joint values."""
        return tuple(item.coordinate.index for item in self.inputs)

    def parameter(self, name: str) -> Parameter:
        """The parameter of that name.

        >>> import assur
        >>> assur.load("zeng2019").parameter("l2").value
        280.0
        """
        if name not in self.parameters:
            raise UnknownNameError(f"parameter of {self.name}", name, self.parameters)
        return self.parameters[name]

    def joint(self, name: str) -> Joint:
        """The joint of that name or alias.

        >>> import assur
        >>> assur.load("zeng2019").joint("R3").name
        'D1'
        """
        for joint in self.joints.values():
            if name in (joint.name, joint.alias):
                return joint
        raise UnknownNameError(f"joint of {self.name}", name, self.joints)

    def coordinate_label(self, coordinate: Coordinate) -> str:
        """Name of a joint coordinate: the joint alone where it has one freedom, else joint.component.

        >>> import assur
        >>> fivebar = assur.load("fivebar")
        >>> [fivebar.coordinate_label(coordinate) for coordinate in fivebar.coordinates]
        ['A1', 'A2', 'B1', 'B2', 'P']
        """
        single = self.joints[coordinate.joint].type.freedoms == 1
        return coordinate.joint if single else f"{coordinate.joint}.{coordinate.component}"

    @property
    def angle_unit(self) -> float:
        """The file's angle unit, in rad."""
        return math.radians(1.0) if self.angle == "deg" else 1.0

    def joint_coordinates(self, name: str) -> tuple[Coordinate, ...]:
        """The coordinates of one joint, in the order of its components.

        >>> import assur
        >>> len(assur.load("fivebar").joint_coordinates("A1"))
        1
        """
        joint = self.joint(name)
        return tuple(item for item in self.coordinates if item.joint == joint.name)


@lru_cache(maxsize=64)
def _without_closed_form(record: MechanismRecord) -> MechanismRecord:
    return replace(record, closed_form=None, closed_form_text="", modes=record.modes.of_file)
