"""Chains and generalised joints, with the full names of what they are made of."""

from __future__ import annotations

from assur.model.file.limbs import Tables
from assur.model.file.scope import Scope
from assur.model.mechanism import GeneralisedJoint, LimbRecord


def build_generalised(tables: Tables, scope: Scope) -> dict[str, GeneralisedJoint]:
    """Parallelograms that count as one joint."""
    found = {}
    for name, placed in tables.generalised.items():
        entry, path, own = placed.entry, placed.path, placed.instance
        joints = [scope.joint(text, (*path, "joints", place), own) for place, text in enumerate(entry.joints)]
        parent = scope.link(entry.stands_for.parent, (*path, "stands_for", "parent"), own)
        child = scope.link(entry.stands_for.child, (*path, "stands_for", "child"), own)
        found[name] = GeneralisedJoint(
            name, entry.kind, tuple(joint for joint in joints if joint), parent or "", child or ""
        )
    return found


def build_chains(tables: Tables, scope: Scope) -> dict[str, LimbRecord]:
    """Branches from base to platform."""
    found = {}
    for name, placed in tables.chains.items():
        entry, path, own = placed.entry, placed.path, placed.instance
        parts: dict[str, tuple[str, ...]] = {}
        for part in ("serial", "loop", "tail"):
            given = enumerate(getattr(entry, part))
            names = [scope.element(text, (*path, part, place), own) for place, text in given]
            parts[part] = tuple(text for text in names if text)
        output = scope.link(entry.output, (*path, "output"), own) if entry.output else ""
        found[name] = LimbRecord(name, parts["serial"], parts["loop"], output or "", parts["tail"], entry.printed)
    return found
