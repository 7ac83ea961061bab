"""The checks behind `assur doctor`: what is installed, and whether its numbers hold."""

from __future__ import annotations

import platform
import sys
import tempfile
from collections.abc import Iterable, Iterator
from importlib import metadata
from pathlib import Path

import numpy as np
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from rich.console import RenderableType

from assur.cli.options import Outcome, Plain
from assur.cli.output import heading, table
from assur.cli.progress import progress
from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import CLOSED, closure_error
from assur.kinematics.configurations import places
from assur.mechanism import Mechanism
from assur.results.answers.installation import Check, InstallationAnswer
from assur.results.plain_text import count

PYTHON = (3, 11)
PINS = "constraints.txt"
AGREE = 1e-9
"""Share of the characteristic length (or rad) within which two configurations are the same."""


def outcome(folder: str, shared: Plain) -> Outcome:
    """Every check; exit code 1 where one is a fault."""
    with progress("self-check", shared):
        checks = [*_installation(), _writable(folder), *_numbers()]
    faults = sum(check.answer == "fault" for check in checks)
    answer = InstallationAnswer(platform.python_version(), platform.platform(), tuple(checks), faults)
    return Outcome(answer, lambda: _shown(answer), 1 if faults else 0)


def _shown(data: InstallationAnswer) -> Iterable[RenderableType]:
    yield heading(f"assur on Python {data.python}, {data.platform}")
    colour = {"ok": "", "note": "yellow", "fault": "red"}
    yield table(
        ("", "check", "found"),
        [(check.answer, check.what, check.outcome) for check in data.checks],
        left=("", "check", "found"),
        styles=[colour[check.answer] for check in data.checks],
    )
    yield "everything that is needed works" if not data.faults else count(data.faults, "fault")


def _installation() -> Iterator[Check]:
    version = sys.version_info[:2]
    wanted = ".".join(map(str, PYTHON))
    yield Check("python", "ok" if version >= PYTHON else "fault", f"{platform.python_version()}, {wanted} or newer")
    try:
        needed = metadata.requires("assur") or []
    except metadata.PackageNotFoundError:
        yield Check("assur", "note", "not installed, run from its source")
        return
    pins = _pins()
    for text in needed:
        yield _package(text, pins)
    yield Check(PINS, "ok" if pins else "note", f"{len(pins)} pins" if pins else "not beside this installation")


def _package(text: str, pins: dict[str, str]) -> Check:
    """A line such as `numpy>=2.0` or `ruff>=0.6; extra == "dev"` of the metadata."""
    requirement = Requirement(text)
    optional = requirement.marker is not None and not requirement.marker.evaluate({"extra": ""})
    name = f"{requirement.name} (optional)" if optional else requirement.name
    try:
        version = metadata.version(requirement.name)
    except metadata.PackageNotFoundError:
        return Check(name, "note" if optional else "fault", f"not installed, {requirement.specifier} wanted")
    if not requirement.specifier.contains(version, prereleases=True):
        return Check(name, "note" if optional else "fault", f"{version}, {requirement.specifier} wanted")
    pin = pins.get(canonicalize_name(requirement.name), version)
    if pin != version:
        return Check(name, "note", f"{version}, tested with {pin}")
    return Check(name, "ok", version)


def _pins() -> dict[str, str]:
    """Versions by name, from the constraints beside the source; empty where there is no source."""
    path = Path(__file__).parents[3] / PINS
    if not path.is_file():
        return {}
    lines = [line.strip() for line in path.read_text(encoding="utf-8").splitlines()]
    pairs = [line.split("==", 1) for line in lines if "==" in line and not line.startswith("#")]
    return {canonicalize_name(name): version for name, version in pairs}


def _writable(text: str) -> Check:
    """Whether output can go into a folder that exists or would be made."""
    path = Path(text).absolute()
    nearest = next(folder for folder in (path, *path.parents) if folder.exists())
    try:
        with tempfile.TemporaryFile(dir=nearest):
            pass
    except OSError as error:
        return Check("output", "fault", f"cannot write {text}: {error.strerror}")
    return Check("output", "ok", f"{text} can be written")


def _numbers() -> Iterator[Check]:
    """For every mechanism: home closes, and closed form and joint graph agree."""
    try:
        from assur.mechanism import load, names
    except ImportError as error:
        yield Check("self-check", "fault", f"cannot start: {error}")
        return
    for name in names():
        record = load(name)
        yield _home(record)
        if record.closed_form is not None:
            yield _agreement(record)


def _home(record: Mechanism) -> Check:
    try:
        gap = float(closure_error(record, record.home_values))
    except UsageError as error:
        return Check(f"{record.name} home", "fault", error.message)
    closed = gap <= CLOSED * characteristic_length(record)
    return Check(f"{record.name} home", "ok" if closed else "fault", f"loops closed to {gap:.1e} {record.unit}")


def _agreement(record: Mechanism) -> Check:
    """The closed form at home's inputs must list home, and each of its solutions must close the joint graph."""
    home, length = record.home_values, characteristic_length(record)
    found = record.direct(inputs_of(record, home))
    what = f"{record.name} closed form"
    if not np.any(found.exists):
        return Check(what, "fault", "finds no solution at home's inputs")
    worst = float(np.max(found.residuals[found.exists]))
    there = places(record, np.vstack([home, *found.joints[found.exists]]))
    apart = float(np.min(np.max(np.abs(there[1:] - there[0]), axis=-1)))
    agrees = worst <= AGREE * length and apart <= AGREE
    text = f"home is one of {count(len(found), 'solution')}, to {apart:.1e}; largest gap {worst:.1e} {record.unit}"
    return Check(what, "ok" if agrees else "fault", text)
