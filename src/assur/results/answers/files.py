"""The answers of commands that write files: pages, reports, figures, motions, exports, drafts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from assur.results.answers.answer import ABSENT, Absent, Answer
from assur.results.answers.position import Numbers
from assur.results.kinds import Scalar


@dataclass(frozen=True)
class PageLayers:
    """How many layers of each kind a page has."""

    workspace: int
    singular: int
    section: int
    force: int


@dataclass(frozen=True)
class PageContent:
    """What is in a page, counted."""

    links: int
    joints: int
    loops: int
    inputs: tuple[str, ...]
    pose: tuple[str, ...]
    assembly_modes: int
    working_modes: int
    layers_note: str
    layers: PageLayers
    factors: int
    facts: int
    errata: int


@dataclass(frozen=True)
class WrittenPage(Answer):
    """A page in which the mechanism can be moved; its address in an operation mode where one is asked for."""

    mechanism: str
    file: str
    bytes: int
    inside: PageContent
    address: str | Absent = ABSENT


@dataclass(frozen=True)
class ReportNumber(Scalar):
    """A number of a report, and the section that it stands in."""

    section: str = ""


@dataclass(frozen=True)
class WrittenReport(Answer):
    """A report and all its single numbers, and its files for LaTeX; one that was interrupted is not written."""

    mechanism: str
    file: str | None
    numbers: tuple[ReportNumber, ...]
    bytes: int | Absent = ABSENT
    latex: tuple[str, ...] | Absent = ABSENT


@dataclass(frozen=True)
class WrittenFigure:
    """A figure by what it shows, with its files, and its size in mm."""

    name: str
    files: tuple[str, ...]
    width: float
    height: float


@dataclass(frozen=True)
class WrittenFigures(Answer):
    """The figures in a folder, drawn for a page of a width in mm; of those that the mechanism does not have why."""

    mechanism: str
    folder: str
    figures: tuple[WrittenFigure, ...]
    left_out: Mapping[str, str]
    width: float


@dataclass(frozen=True)
class WrittenMotion(Answer):
    """Moving pictures, with the poses (frames, m) and inputs (frames, n) that they show."""

    mechanism: str
    file: str
    bytes: int
    format: str
    frames: int
    seconds: float
    pixels: tuple[int, int]
    coordinates: tuple[str, ...]
    poses: tuple[Numbers, ...]
    inputs: tuple[Numbers, ...]


@dataclass(frozen=True)
class BillRow:
    """One line of a bill of materials.

    Attributes:
        kind: "make" or "buy".
        what: what it is, in words; of a link its parts with their sizes in mm.
        count: how many.
        names: the links, or the joints that it is for.
        volume: of one, in mm^3; None for what is bought.
        mass: of one, in kg, as the file says it; None where it does not.
    """

    kind: Literal["make", "buy"]
    what: str
    count: int
    names: tuple[str, ...]
    volume: float | None = None
    mass: float | None = None


@dataclass(frozen=True)
class WrittenExport(Answer):
    """Files for simulators (with nominal masses), or of solids (with their thickness and what has to be made)."""

    mechanism: str
    format: str
    files: tuple[str, ...]
    nominal_mass_kg: float | Absent = ABSENT
    bill: tuple[BillRow, ...] | Absent = ABSENT
    thickness: float | Absent = ABSENT


@dataclass(frozen=True)
class WrittenMechanism(Answer):
    """A mechanism's file to begin with, and what stands beside it."""

    mechanism: str
    files: tuple[str, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class EndedView(Answer):
    """A view that has ended, and where it was."""

    mechanism: str
    url: str
