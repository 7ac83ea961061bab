"""Provenance: what to cite, which versions made this report, and how to make it again."""

from __future__ import annotations

import platform
from importlib import metadata
from importlib.resources import files
from pathlib import Path

import assur
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.results.kinds import Facts, Section, Table
from assur.results.plain_text import count
from assur.results.typeset_text import short

TITLE = "assur: topology design and analysis of parallel mechanisms"
AUTHORS = "The assur authors"
LICENSE = "Apache-2.0"
PACKAGES = ("numpy", "scipy", "sympy", "networkx", "matplotlib", "scikit-image", "manifold3d", "jinja2")


def provenance(findings: Findings) -> Section:
    """Citations, versions, dimensions, the command that makes the same report."""
    record = findings.record
    citations = Facts("Please cite", (("mechanism", record.source or "no source is stated"), ("software", software())))
    again = Facts("This report again", tuple(_again(record)))
    return Section("Sources and versions", results=[citations, again, _versions()])


def software() -> str:
    """How this package is cited."""
    return f"{AUTHORS}. {TITLE}. Version {assur.__version__}, {LICENSE}."


def _again(record: MechanismRecord) -> list[tuple[str, str]]:
    sets = "".join(f" --set {name}={value:.12g}" for name, value in record.overrides.items())
    name = record.name if _is_built_in(record) else "/".join(record.file.parts[-2:])
    changed = ", ".join(f"{key} = {short(value)}" for key, value in record.overrides.items())
    dimensions = (
        f"{count(len(record.overrides), 'dimension')} set for this report: {changed}"
        if changed
        else "those of the file"
    )
    return [("command", f"assur report {name}{sets} -o report.html"), ("dimensions", dimensions)]


def _is_built_in(record: MechanismRecord) -> bool:
    """Whether its name alone calls it up; a user's own file may have the name of a built-in mechanism."""
    return record.file.parent == Path(str(files("assur") / "mechanisms" / record.name))


def _versions() -> Table:
    rows = [("Python", platform.python_version()), ("assur", assur.__version__)]
    rows += [(name, metadata.version(name)) for name in PACKAGES]
    return Table("Versions", ("package", "version"), tuple(rows))
