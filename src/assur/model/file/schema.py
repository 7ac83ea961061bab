"""The form of a mechanism file: which tables and keys there are, and what stands in each.

Only the form is checked here; whether names exist and numbers make sense is seen when the record is built.
"""

# annotations stand as they are: pydantic would evaluate each text again
from typing import Annotated, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, StrictBool

from assur.model.file.values import (
    DOWN,
    ZERO,
    Axis,
    BarEnds,
    ComplianceRows,
    Format,
    HomeValue,
    Inertia,
    LinkName,
    MechanismName,
    Name,
    Number,
    PlainName,
    Range,
    Sense,
    TwoAxes,
    TwoNumbers,
    Value,
    Vector,
    bound_alone,
)


class Entry(BaseModel):
    """A table of the file: frozen, and with no keys but its own."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True, defer_build=True)


class ParameterEntry(Entry):
    """A dimension, or a formula of other dimensions."""

    value: Value
    meaning: str = ""
    unit: str | None = None
    sign: Literal["positive", "nonnegative", "any"] = "positive"
    drawn_only: StrictBool = False


class MaterialEntry(Entry):
    """What bars are made of: density in kg/m3, E in Pa, Poisson's ratio nu."""

    density: Number | None = None
    E: Number | None = None
    nu: Number | None = None


class ProfileEntry(Entry):
    """A cross-section, in m: round, tube or box; or its area and moments."""

    round: Number | None = None
    tube: TwoNumbers | None = None
    box: TwoNumbers | None = None
    up: Axis | None = None
    A: Number | None = None
    Iy: Number | None = None
    Iz: Number | None = None
    J: Number | None = None
    Ay: Number | None = None
    Az: Number | None = None


class GravityEntry(Entry):
    """Where things fall, and how fast, in m/s2."""

    direction: Axis = DOWN
    value: Number = 9.81


class WeightEntry(Entry):
    """A mass in kg, its centre in the frame of its link, its inertia about it in kg m2."""

    mass: Number | None = None
    centre: Vector | None = None
    inertia: Inertia | None = None


class LinkEntry(WeightEntry):
    """A rigid body; what it weighs, and what it bends by."""

    meaning: str = ""
    profile: str | None = None
    material: str | None = None
    kg_per_m: Number | None = None
    rigid: StrictBool = False
    up: Axis | None = None
    compliance: ComplianceRows | None = None
    bars: Annotated[tuple[BarEnds, ...], Field(min_length=1, max_length=60)] | None = None


class FrictionEntry(Entry):
    """Friction of an input, in N or N m, and per speed."""

    coulomb: Number = 0.0
    viscous: Number = 0.0


class GearEntry(Entry):
    """A gear: motions of the motor per motion of the input, N/m or N m/rad at the input, kg or kg m2 at the motor."""

    ratio: Number
    stiffness: Number | None = None
    rotor: Number = 0.0


class ActuatorEntry(Entry):
    """What drives an input: N/m or N m/rad, N or N m, m/s or rad/s, kg or kg m2."""

    stiffness: Number | None = None
    force: Number | None = None
    speed: Number | None = None
    rotor: Number = 0.0
    friction: FrictionEntry = FrictionEntry.model_construct()
    gear: GearEntry | None = None


class ToleranceEntry(Entry):
    """A bound in the unit of what it belongs to, or a standard deviation."""

    bound: Value | None = None
    sigma: Value | None = None


class JointEntry(Entry):
    """What every joint has."""

    parent: str
    child: str
    at: Vector = ZERO
    child_at: Vector = ZERO
    alias: Name | None = None
    meaning: str = ""


class AxialEntry(JointEntry):
    """A joint with one axis; `child_axis` is the same axis in the child's frame, where it differs."""

    axis: Axis
    child_axis: Axis | None = None


class RevoluteEntry(AxialEntry):
    """R: the child turns about the axis."""

    type: Literal["revolute"]
    limits: Range | None = None


class PrismaticEntry(AxialEntry):
    """P: the child slides along the axis."""

    type: Literal["prismatic"]
    limits: Range | None = None


class HelicalEntry(AxialEntry):
    """H: the child turns about the axis and advances by `pitch` a turn, as a right-handed screw."""

    type: Literal["helical"]
    pitch: Value
    limits: Range | None = None


class CylindricalLimits(Entry):
    """Limits of C."""

    translation: Range | None = None
    rotation: Range | None = None


class CylindricalEntry(AxialEntry):
    """C: the child slides along the axis and turns about it."""

    type: Literal["cylindrical"]
    limits: CylindricalLimits = CylindricalLimits.model_construct()


class PlanarLimits(Entry):
    """Limits of E."""

    first: Range | None = None
    second: Range | None = None
    rotation: Range | None = None


class PlanarEntry(AxialEntry):
    """E: the child slides in the plane across the axis and turns about the axis."""

    type: Literal["planar"]
    limits: PlanarLimits = PlanarLimits.model_construct()


class UniversalLimits(Entry):
    """Limits of U."""

    first: Range | None = None
    second: Range | None = None


class UniversalEntry(JointEntry):
    """U: two axes through one point, the first fixed in the parent, the second in the child."""

    type: Literal["universal"]
    axes: TwoAxes
    limits: UniversalLimits = UniversalLimits.model_construct()


class Cone(Entry):
    """How far the axis of a ball stud may tilt from the axis of its socket."""

    axis: Axis
    angle: Value


class SphericalEntry(JointEntry):
    """S: the child turns about a point."""

    type: Literal["spherical"]
    cone: Cone | None = None


AnyJoint = Annotated[
    RevoluteEntry | PrismaticEntry | HelicalEntry | CylindricalEntry | PlanarEntry | UniversalEntry | SphericalEntry,
    Field(discriminator="type"),
]
JOINT_ENTRIES: dict[str, type[JointEntry]] = {
    "revolute": RevoluteEntry,
    "prismatic": PrismaticEntry,
    "helical": HelicalEntry,
    "cylindrical": CylindricalEntry,
    "universal": UniversalEntry,
    "spherical": SphericalEntry,
    "planar": PlanarEntry,
}


class PlatformEntry(Entry):
    """The moving platform, its point and the coordinates that count."""

    link: str
    point: Vector = ZERO
    pose: tuple[Literal["x", "y", "z", "phi", "theta", "psi", "qw", "qx", "qy", "qz"], ...] = Field(min_length=1)
    orientation: Literal["constant", "any"] = "any"


class InputEntry(Entry):
    """An actuated coordinate. Printed value = sign * joint value + offset; `offsets`: one for each limb."""

    name: Name
    latex: str = ""
    offset: Value = ZERO[0]
    offsets: tuple[Value, ...] = ()
    sign: Sense = 1
    stroke: Range | None = None


class InputTable(BaseModel):
    """`order`, and an entry for each input under the name of its joint."""

    model_config = ConfigDict(extra="allow", frozen=True, arbitrary_types_allowed=True, defer_build=True)
    __pydantic_extra__: dict[str, InputEntry]

    order: tuple[str, ...] | None = None

    @property
    def entries(self) -> dict[str, InputEntry]:
        """Inputs by the name of their joint."""
        return self.__pydantic_extra__


class StandsFor(Entry):
    """The two links that a generalised joint stands between."""

    parent: str
    child: str


class GeneralisedEntry(Entry):
    """A parallelogram that counts as one joint."""

    kind: Literal["P(4R)", "P(4U)", "P(4S)", "P(2US)"]
    joints: tuple[str, ...] = Field(min_length=4, max_length=4)
    stands_for: StandsFor


class ChainEntry(Entry):
    """A branch from base to platform: `serial`, or `loop`, `output` and `tail`."""

    serial: tuple[str, ...] = ()
    loop: tuple[str, ...] = ()
    output: str = ""
    tail: tuple[str, ...] = ()
    printed: str = ""


class PointEntry(Entry):
    """A letter: a point fixed in a link."""

    link: str
    at: Vector = ZERO


class DefaultModes(Entry):
    """The mode that is meant where none is named."""

    working: str = ""
    assembly: str = ""


class ModesEntry(Entry):
    """Names of branches: signs of formulas over joint values and coordinates of points."""

    working: dict[PlainName, Value] = {}
    assembly: dict[PlainName, Value] = {}
    default: DefaultModes = DefaultModes.model_construct()


class WorkspaceEntry(Entry):
    """Where the source looks for the workspace."""

    box: dict[str, Range] = {}
    sections: tuple[Value, ...] = ()


ToleranceValue = Annotated[ToleranceEntry, BeforeValidator(bound_alone, json_schema_input_type=Value | ToleranceEntry)]


class Repeat(Entry):
    """How often a limb is there, about which axis, and where."""

    about: Axis
    count: Annotated[int, Field(strict=True, ge=2, le=60)] | None = None
    angles: Annotated[tuple[Value, ...], Field(min_length=1, max_length=60)] | None = None


class LimbEntry(Entry):
    """A template: links, joints and the rest, written once and turned about an axis."""

    repeat: Repeat | None = None
    links: dict[Name, LinkEntry] = {}
    joints: dict[Name, AnyJoint] = {}
    inputs: dict[str, InputEntry] = {}
    generalised: dict[Name, GeneralisedEntry] = {}
    chain: ChainEntry | None = None
    points: dict[Name, PointEntry] = {}
    home: dict[str, HomeValue] = {}


class FileEntry(Entry):
    """The whole file. What must be there is seen by the reader, so that a gap hides no other fault."""

    format: Format = None
    name: MechanismName | None = None
    title: str = ""
    source: str = ""
    unit: Literal["mm", "cm", "m", "in", "ft"] | None = None
    angle: Literal["deg", "rad"] | None = None
    base: str | None = None
    platform: PlatformEntry | None = None
    parameters: dict[PlainName, ParameterEntry] = {}
    links: dict[LinkName, LinkEntry] = {}
    joints: dict[Name, AnyJoint] = {}
    limbs: dict[Name, LimbEntry] = {}
    inputs: InputTable = Field(default_factory=InputTable.model_construct)
    generalised: dict[Name, GeneralisedEntry] = {}
    chains: dict[Name, ChainEntry] = {}
    angles: dict[Name, str] = {}
    points: dict[Name, PointEntry] = {}
    modes: ModesEntry = ModesEntry.model_construct()
    workspace: WorkspaceEntry = WorkspaceEntry.model_construct()
    home: dict[str, HomeValue] = {}
    materials: dict[PlainName, MaterialEntry] = {}
    profiles: dict[PlainName, ProfileEntry] = {}
    gravity: GravityEntry | None = None
    payload: WeightEntry | None = None
    actuators: dict[str, ActuatorEntry] = {}
    tolerances: dict[str, ToleranceValue] = {}
    clearances: dict[str, Value] = {}
    compliances: dict[str, ComplianceRows] = {}
