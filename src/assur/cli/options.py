"""What all commands share: the options, how a mechanism is named, and what a command hands back."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Group, Parameter

from assur.cli.numbers import assignments, number, numbers
from assur.errors import UsageError

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from rich.console import RenderableType

    from assur.mechanism import Mechanism
    from assur.results.answers.answer import Answer, NotRun

SHARED = Group("Shared options", sort_key=9)

MechanismName = Annotated[
    str, Parameter(name="MECHANISM", help="A name (see `assur list`) or the path of a .toml file.")
]


MethodName = Annotated[
    Literal["auto", "closed form", "loops", "search"],
    Parameter(help="Closed form, or on the joint graph: loops in turn, or a search. The best of them if left out."),
]

Crossed = Annotated[
    bool, Parameter(help="On the joint graph: let parallelograms cross over (a mode then names them, as +++~Pa1).")
]

WorkingMode = Annotated[
    str | None, Parameter(help="Working mode, as ++-++; the default of the mechanism's file if left out.")
]

Load = Annotated[
    str | None,
    Parameter(metavar="FX,FY,FZ[,MX,MY,MZ]", help="Force [N] and moment [N m] on the platform at its point."),
]

NoGravity = Annotated[bool, Parameter(help="Leave gravity aside.")]

Centre = Annotated[
    str | None,
    Parameter(
        metavar="X,Y,Z", help="From which a distance is measured, in the measuring frame; its origin if left out."
    ),
]


@Parameter(name="*", group=SHARED)
@dataclass(frozen=True)
class Plain:
    """Options of every command."""

    json: Annotated[
        bool,
        Parameter(help="Print one JSON object and nothing else, an error too. Numbers that do not exist are null."),
    ] = False
    debug: Annotated[bool, Parameter(help="Show the traceback of an error.")] = False


@Parameter(name="*", group=SHARED)
@dataclass(frozen=True)
class Shared(Plain):
    """Options of every command that is about one mechanism."""

    set_: Annotated[
        tuple[str, ...],
        Parameter(
            name="--set",
            metavar="NAME=VALUE",
            help="Another value for a dimension, in the file's unit, as --set l2=300. May be repeated.",
        ),
    ] = ()
    run_code: Annotated[
        bool,
        Parameter(
            help="Let Python in the mechanism's folder run that assur cannot read as formulas. It may do all that you "
            "may; look at it first. ASSUR_RUN_CODE=always or never says so for all commands."
        ),
    ] = False

    def mechanism(self, name: str) -> Mechanism:
        """The mechanism of that name or file, with the dimensions of `--set`."""
        from assur.mechanism import load

        return load(name, **self.dimensions)

    @property
    def dimensions(self) -> dict[str, float]:
        """Those of `--set`."""
        given = assignments(self.set_, "--set", "l2=300")
        return {key: number(text, f"--set {key}") for key, text in given.items()}


@Parameter(name="*", group=SHARED)
@dataclass(frozen=True)
class Drawn(Shared):
    """Options of every command that draws a mechanism as solids."""

    thickness: Annotated[
        str | None,
        Parameter(
            metavar="LENGTH",
            help="How thick flat bars are, in the mechanism's unit; pins, balls, forks and rails go with it. If left "
            "out: what figures.toml says, else as thick as looks well and neighbouring joints leave room.",
        ),
    ] = None

    def mechanism(self, name: str) -> Mechanism:
        """The mechanism of that name or file, with the dimensions of `--set` and the thickness."""
        found = super().mechanism(name)
        if self.thickness is None:
            return found
        from assur.scene.sizes import with_thickness

        return with_thickness(found, number(self.thickness, "--thickness"))


@Parameter(name="*")
@dataclass(frozen=True)
class PoseOptions:
    """Options that name one assembly: by a pose, in a working mode."""

    pose: Annotated[
        tuple[str, ...],
        Parameter(consume_multiple=1, metavar="X Y Z", help="The pose, one value per coordinate."),
    ] = ()
    mode: WorkingMode = None

    def pose_of(self, record: Mechanism) -> NDArray[Any]:
        """The pose (m,) in lengths and rad; a refusal where none is given."""
        from assur.kinematics.answers.at_border import pose_from_border

        if not self.pose:
            raise UsageError("--pose is missing", hint=f"--pose {' '.join(record.platform.pose)}")
        return pose_from_border(record, numbers(self.pose, record.platform.pose, f"pose of {record.name}"))

    def pose_or_home(self, record: Mechanism) -> NDArray[Any]:
        """The pose (m,), home's where none is given."""
        from assur.kinematics.pose import pose_of

        return self.pose_of(record) if self.pose else pose_of(record, record.home_values)

    def mode_of(self, record: Mechanism) -> str:
        """The working mode, that of the file where none is named."""
        return self.mode or record.modes.default_working


@Parameter(name="*")
@dataclass(frozen=True)
class RegionOptions:
    """Options that say where to look among poses."""

    box: Annotated[
        tuple[str, ...],
        Parameter(metavar="NAME=LOW:HIGH,..", help="Where to look along coordinates; the file's box if left out."),
    ] = ()
    stroke: Annotated[
        tuple[str, ...],
        Parameter(metavar="[NAME=]LOW:HIGH", help="Limits of one input, or of all inputs if no name is given."),
    ] = ()
    at: Annotated[
        tuple[str, ...],
        Parameter(metavar="NAME=VALUE,..", help="Hold coordinates; of a pose with more than three, angles as at home."),
    ] = ()


@Parameter(name="*")
@dataclass(frozen=True)
class MapOptions(RegionOptions):
    """Options of a map over some coordinates of the workspace; none is asked for where `map_` is None."""

    map_: Annotated[
        str | None,
        Parameter(name="--map", metavar="X,Z", help="Map over these coordinates, the others held."),
    ] = None
    nodes: Annotated[
        str | None,
        Parameter(
            metavar="COUNT",
            help="With --map: nodes along each; 60 of indices, 40 of forces, 30 of stiffness if left out.",
        ),
    ] = None
    output: Annotated[
        str | None,
        Parameter(
            name=("-o", "--output"),
            metavar="FILE",
            help="With --map: write the maps, .npz, .csv or .json, or draw them, .png, .pdf or .svg.",
        ),
    ] = None
    resolution: Annotated[
        str | None, Parameter(metavar="CELLS", help="Cells of the workspace along each; 32 if left out.")
    ] = None


def refuse(why: str, hint: str, **options: object) -> None:
    """Refuse options that a question would not look at, where any is given: what is typed is obeyed, or refused.

    >>> refuse("of a map alone", "add --map x,z", nodes="30", box=(), map_=None)
    Traceback (most recent call last):
    ...
    assur.errors.UsageError: --nodes: of a map alone
    hint: add --map x,z
    """
    given = [
        f"--{name.rstrip('_').replace('_', '-')}" for name, value in options.items() if value not in (None, False, ())
    ]
    if given:
        raise UsageError(f"{', '.join(given)}: {why}", hint=hint)


PLAIN = Plain()
POSE = PoseOptions()
REGION = RegionOptions()
NO_MAP = MapOptions()
SHARED_DEFAULTS = Shared()
DRAWN_DEFAULTS = Drawn()


@dataclass(frozen=True)
class Outcome:
    """What a command found: an answer for `--json`, what a person sees, the exit code, and how it came about."""

    data: Answer
    shown: Callable[[], Iterable[RenderableType]]
    exit_code: int = 0
    interrupted: bool = False
    interrupted_at: str = ""
    not_run: tuple[NotRun, ...] = ()
