"""Facts beside the model: what the topology engine derives, and the errata of the source."""

from __future__ import annotations

from assur.audit.errata import ErrataFile
from assur.audit.reference import ERRATA, FOLDER, checked
from assur.derived_topology import topology
from assur.errors import AssurError
from assur.model.file.toml_source import read_toml
from assur.model.mechanism import MechanismRecord
from assur.page.origin import has_errata, left_out
from assur.report.sections.derived import rounded
from assur.results.reading import file_text
from assur.topology.facts import Topology

KINDS = {"none": "every output depends on every input", "partial": "partly decoupled", "full": "decoupled"}


def facts(record: MechanismRecord) -> list[dict[str, str]]:
    """Title and text of each fact of the topology; why there are none where it cannot be derived.

    >>> from assur.model.registry import load_record
    >>> [item["text"] for item in facts(load_record("zeng2019"))][:3]
    ['t³ r⁰', '3', '1']
    """
    try:
        found = topology(record)
    except AssurError as error:
        return [{"title": "Topology", "text": f"not derived: {error.message}"}]
    return [{"title": title, "text": text} for title, text in _facts(found) if text]


def errata(record: MechanismRecord) -> list[dict[str, str]]:
    """Id and text of each erratum of the source as its file says it; `assur audit` computes the evidence.

    None where they are not of this mechanism: `errata_note` says why.

    >>> from assur.model.registry import load_record
    >>> errata(load_record("zeng2019"))[0]["id"]
    'E1'
    >>> errata(load_record("zeng2019", l2=300))
    []
    """
    if record.folder is None or not has_errata(record) or left_out(record):
        return []
    path = record.folder / FOLDER / ERRATA
    entries = checked(ErrataFile, read_toml(file_text(path), str(path)), path).root
    return [
        {"id": name, "text": f"{entry.where}: printed {entry.printed.rstrip('., ')}. {entry.finding}"}
        for name, entry in entries.items()
    ]


def errata_note(record: MechanismRecord) -> str:
    """What is said where there are no errata.

    >>> from assur.model.registry import load_record
    >>> errata_note(load_record("fivebar"))
    'None are known.'
    """
    reason = left_out(record)
    return f"{reason[0].upper()}{reason[1:]}." if reason else "None are known."


def _facts(topology: Topology) -> list[tuple[str, str]]:
    redundant = topology.redundant_constraints
    internal = f", {topology.internal_freedoms} of them internal" if topology.internal_freedoms else ""
    loops = "; ".join(f"loop {k}: ξ = {loop.xi}, Δ = {loop.delta:+d}" for k, loop in enumerate(topology.loops, 1))
    return [
        ("POC set of the platform", str(topology.poc)),
        ("Degrees of freedom F", f"{topology.dof}{internal}"),
        ("Coupling degree κ", "" if topology.coupling_degree is None else str(topology.coupling_degree)),
        ("Loops", loops.replace("+0", "0").replace("-", "\N{MINUS SIGN}")),
        ("Limbs", "; ".join(f"{rounded(limb.text)}: {limb.poc}" for limb in topology.limbs)),
        ("Redundant constraints", f"{redundant.collapsed}; {redundant.joint_graph} of the whole joint graph"),
        ("Decoupling", KINDS[topology.decoupling.kind] if topology.decoupling else ""),
        ("Direct problem", "; ".join(line.rstrip(".") for line in topology.plan.words)),
    ]
