"""Repeated limbs: a template written once becomes as many limbs as it says, with names such as `leg1.B`.

When every joint value is zero all link frames are parallel to the base's. So a limb is turned about an axis
by turning every vector of its template, in whichever frame it is given; the axis passes through the origin
of every one of these frames. The turning itself is done where the vectors get their numbers.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from assur.errors import KeyPath
from assur.model.file import schema
from assur.model.file.description import Description
from assur.model.file.faults import Faults
from assur.model.formula import Formula

Item = TypeVar("Item")


@dataclass(frozen=True)
class Instance:
    """One of the limbs that a template becomes."""

    limb: str
    number: int

    @property
    def prefix(self) -> str:
        """What its names begin with, less the dot."""
        return f"{self.limb}{self.number}"


@dataclass(frozen=True)
class Placed(Generic[Item]):
    """An entry of the file under its full name, with the place of its text and the limb it belongs to."""

    name: str
    entry: Item
    path: KeyPath
    instance: Instance | None = None

    @property
    def local(self) -> str:
        """Its name as written in the file."""
        return self.name.removeprefix(f"{self.instance.prefix}.") if self.instance else self.name


_REPEATED = ("links", "joints", "inputs", "generalised", "points", "home")


@dataclass(frozen=True)
class Tables:
    """Everything that may stand in a template or outside one, by full name.

    Attributes:
        broken: table -> full names of entries that are in the file but not in form; they exist, so that
            whoever refers to them is not blamed.
        single_links: what stands outside the templates about a link of one limb.
        unfinished: templates that do not say how often they repeat, a fault as well.
    """

    links: dict[str, Placed[schema.LinkEntry]] = field(default_factory=dict)
    joints: dict[str, Placed[schema.AnyJoint]] = field(default_factory=dict)
    inputs: dict[str, Placed[schema.InputEntry]] = field(default_factory=dict)
    generalised: dict[str, Placed[schema.GeneralisedEntry]] = field(default_factory=dict)
    chains: dict[str, Placed[schema.ChainEntry]] = field(default_factory=dict)
    points: dict[str, Placed[schema.PointEntry]] = field(default_factory=dict)
    home: dict[str, Placed[tuple[Formula, ...]]] = field(default_factory=dict)
    single_links: dict[str, Placed[schema.LinkEntry]] = field(default_factory=dict)
    instances: tuple[Instance, ...] = ()
    broken: Mapping[str, frozenset[str]] = field(default_factory=dict)
    unfinished: frozenset[str] = frozenset()


def expand(description: Description, faults: Faults) -> Tables:
    """All entries by full name: those outside templates first, then limb by limb in the file's order."""
    file, cut = description.form.entry, description.form.cut
    instances = {name: _instances(name, limb, cut, faults) for name, limb in file.limbs.items()}
    tables = Tables(
        instances=tuple(instance for group in instances.values() for instance in group),
        broken=_broken(description, instances),
        unfinished=frozenset(name for name, limb in file.limbs.items() if _count(limb) is None),
    )
    for table in (*_REPEATED, "chains"):
        entries = file.inputs.entries if table == "inputs" else getattr(file, table)
        for name, entry in entries.items():
            alone = table == "links" and "." in name
            getattr(tables, "single_links" if alone else table)[name] = Placed(name, entry, (table, name))
    _check_offsets(file, instances, faults)
    for limb, group in instances.items():
        for instance in group:
            _repeat(tables, file.limbs[limb], instance)
    return tables


def _instances(name: str, limb: schema.LimbEntry, cut: frozenset[KeyPath], faults: Faults) -> tuple[Instance, ...]:
    path = ("limbs", name, "repeat")
    repeat = limb.repeat
    if repeat is None:
        if path not in cut:
            faults.add(path, "missing", "this key must be there", 'repeat = { about = "z", count = 3 }')
        return (Instance(name, 1),)
    if (repeat.count is None) == (repeat.angles is None):
        found = "count and angles" if repeat.count else "neither count nor angles"
        faults.add(path, found, "allowed: one of the two", "count = 3 means every 120 deg")
    return tuple(Instance(name, number + 1) for number in range(repeated(limb)))


def repeated(limb: schema.LimbEntry) -> int:
    """How many limbs a template becomes; 1 where it does not say."""
    return _count(limb) or 1


def _count(limb: schema.LimbEntry) -> int | None:
    """How many limbs a template becomes, if it says so."""
    repeat = limb.repeat
    if repeat is None:
        return None
    return len(repeat.angles) if repeat.angles else repeat.count


def _repeat(tables: Tables, limb: schema.LimbEntry, instance: Instance) -> None:
    for table in _REPEATED:
        for name, entry in getattr(limb, table).items():
            full = f"{instance.prefix}.{name}"
            own = _numbered(entry, instance.number) if table == "inputs" else entry
            getattr(tables, table)[full] = Placed(full, own, ("limbs", instance.limb, table, name), instance)
    if limb.chain:
        place = Placed(instance.prefix, limb.chain, ("limbs", instance.limb, "chain"), instance)
        tables.chains[instance.prefix] = place


def _numbered(entry: schema.InputEntry, number: int) -> schema.InputEntry:
    """The input of one limb: its number behind the name, and as an index in LaTeX."""
    letter = entry.latex or entry.name
    latex = f"{{{letter}}}_{{{number}}}" if "_" in letter or "^" in letter else f"{letter}_{{{number}}}"
    offset = entry.offsets[number - 1] if number <= len(entry.offsets) else entry.offset
    return entry.model_copy(update={"name": f"{entry.name}{number}", "latex": latex, "offset": offset, "offsets": ()})


def _check_offsets(file: schema.FileEntry, instances: Mapping[str, tuple[Instance, ...]], faults: Faults) -> None:
    """One for each limb of a template, and none elsewhere."""
    for name, entry in file.inputs.entries.items():
        if entry.offsets:
            faults.add(
                ("inputs", name, "offsets"), "of an input of its own", "allowed: in a template of limbs", "offset = 0"
            )
    for limb, group in instances.items():
        for name, entry in file.limbs[limb].inputs.items():
            if entry.offsets and len(entry.offsets) != len(group):
                path = ("limbs", limb, "inputs", name, "offsets")
                faults.add(path, f"{len(entry.offsets)} offsets of {len(group)} limbs", "allowed: one for each limb")


def _broken(description: Description, instances: Mapping[str, tuple[Instance, ...]]) -> dict[str, frozenset[str]]:
    """Full names, aliases among them, of the entries that were cut out."""
    broken: dict[str, set[str]] = {}
    for path in description.form.cut:
        data: Any = description.source.data
        for part in path:
            data = data.get(part) if isinstance(data, dict) else None
        alias = data.get("alias") if isinstance(data, dict) else None
        names = [str(path[-1]), *([alias] if isinstance(alias, str) else [])]
        if len(path) == 2 and path[0] != "limbs":
            broken.setdefault(str(path[0]), set()).update(names)
        elif len(path) == 4:
            prefixes = [instance.prefix for instance in instances.get(str(path[1]), ())]
            full = {f"{prefix}.{name}" for prefix in prefixes for name in names}
            broken.setdefault(str(path[2]), set()).update(full)
    return {table: frozenset(names) for table, names in broken.items()}
