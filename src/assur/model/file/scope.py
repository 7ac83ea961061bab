"""What a name in a mechanism file refers to: links, joints and their components, coordinates of points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from assur.errors import KeyPath
from assur.joints.catalogue import JOINT_TYPES
from assur.joints.joint_type import JointType
from assur.model.file.faults import Faults
from assur.model.file.limbs import Instance, Tables
from assur.model.file.numbers import Kind
from assur.model.formula import Formula
from assur.model.mechanism import Coordinate

Target = TypeVar("Target")


class Scope:
    """Looks names up, in a template the limb's own names first.

    An unknown name is noted and answered by None; a name whose entry is broken is answered by None only.

    Attributes:
        coordinates: every component of every joint, in the order of the vector of joint values.
        aliases: other name of a joint -> its name.
    """

    def __init__(self, tables: Tables, faults: Faults) -> None:
        self.tables = tables
        self.faults = faults
        self.aliases: dict[str, str] = {}
        self.coordinates: list[Coordinate] = []
        self._quantities: dict[str, Coordinate] = {}
        self._short: list[str] = []
        for name, placed in tables.joints.items():
            kind = JOINT_TYPES[placed.entry.type]
            names = [name]
            if placed.entry.alias:
                alias = f"{placed.instance.prefix}.{placed.entry.alias}" if placed.instance else placed.entry.alias
                if alias not in tables.joints:
                    self.aliases[alias] = name
                    names.append(alias)
            self._add_coordinates(kind, names)
        self._prefixes = {instance.prefix for instance in tables.instances}
        self._joints = {name: name for name in tables.joints} | self.aliases
        self._points = {name: name for name in tables.points} | self._joints

    def _add_coordinates(self, kind: JointType, names: list[str]) -> None:
        for component, what in zip(kind.components, kind.kinds, strict=True):
            item = Coordinate(names[0], component, len(self.coordinates), what)
            self.coordinates.append(item)
            for name in names:
                self._quantities[f"{name}.{component}"] = item
                short = name if kind.freedoms == 1 else f"{name}.{component}"
                self._quantities[short] = item
                self._short.append(short)

    def link(self, name: str, path: KeyPath, instance: Instance | None = None) -> str | None:
        """Full name of a link."""
        links = {full: full for full in self.tables.links}
        return self._find("link", links, ("links",), name, path, instance)

    def joint(self, name: str, path: KeyPath, instance: Instance | None = None) -> str | None:
        """Full name of a joint, given by its name or alias."""
        return self._find("joint", self._joints, ("joints",), name, path, instance)

    def element(self, name: str, path: KeyPath, instance: Instance | None = None) -> str | None:
        """Full name of a joint or of a generalised joint."""
        elements = {full: full for full in self.tables.generalised} | self._joints
        return self._find("joint", elements, ("generalised", "joints"), name, path, instance)

    def coordinate(self, name: str, path: KeyPath, instance: Instance | None = None) -> Coordinate | None:
        """A component of a joint: `B1` where the joint has only one, else `C.translation`."""
        seen = self._visible(self._quantities, instance)
        joint = self._visible(self._joints, instance).get(name)
        if joint and name not in seen:
            components = JOINT_TYPES[self.tables.joints[joint].entry.type].components
            allowed = " or ".join(f"{name}.{component}" for component in components)
            self.faults.add(path, f"'{name}' has {len(components)} components", f"allowed: {allowed}")
            return None
        if name not in seen:
            short = {text: self._quantities[text] for text in self._short}
            return self._find("joint", short, ("joints",), name, path, instance)
        return seen[name]

    def quantity_kind(self, name: str) -> Kind | None:
        """Kind of a name in a formula of the joint graph: a joint value or a coordinate of a point.

        None for a name that is neither; "either" for one whose entry is broken.
        """
        if name in self._quantities:
            return "angle" if self._quantities[name].kind == "angle" else "plain"
        point, _, letter = name.rpartition(".")
        if letter in ("x", "y", "z") and point in self._points:
            return "plain"
        return "either" if self._is_broken(name, ("joints", "points")) else None

    @property
    def quantities(self) -> list[str]:
        """Names that a formula of the joint graph may have, coordinates of points as `C1.y`."""
        return [*self._short, *(f"{point}.{letter}" for point in self._points for letter in "xyz")]

    def without_aliases(self, formula: Formula) -> Formula:
        """The same formula with the joints' own names."""
        own = {}
        for name in formula.names:
            joint, _, part = name.rpartition(".")
            if name in self.aliases:
                own[name] = self.aliases[name]
            elif joint in self.aliases:
                own[name] = f"{self.aliases[joint]}.{part}"
        return formula.renamed(own)

    def _is_broken(self, name: str, tables: tuple[str, ...], instance: Instance | None = None) -> bool:
        """Whether a name, or what it is a component of, stands in the file, but not in form."""
        head, owner = name.split(".")[0], name.rpartition(".")[0]
        own = [f"{instance.prefix}.{text}" for text in (name, owner)] if instance else []
        broken = {full for table in tables for full in self.tables.broken.get(table, ())}
        unfinished = [limb for limb in self.tables.unfinished if head.removeprefix(limb).isdigit()]
        return bool(unfinished) or not broken.isdisjoint((name, owner, *own))

    def _find(
        self,
        kind: str,
        choices: Mapping[str, Target],
        tables: tuple[str, ...],
        name: str,
        path: KeyPath,
        instance: Instance | None,
    ) -> Target | None:
        seen = self._visible(choices, instance)
        if name in seen:
            return seen[name]
        if not self._is_broken(name, tables, instance):
            self.faults.unknown(path, kind, name, seen)
        return None

    def _visible(self, choices: Mapping[str, Target], instance: Instance | None) -> dict[str, Target]:
        """Names as they are written in a template (or, outside one, full names), with what they stand for."""
        if instance is None:
            return dict(choices)
        outside = {name: item for name, item in choices.items() if name.split(".")[0] not in self._prefixes}
        own = instance.prefix + "."
        return outside | {name.removeprefix(own): item for name, item in choices.items() if name.startswith(own)}
