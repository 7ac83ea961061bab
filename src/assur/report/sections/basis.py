"""The basis: how each number is known, and the conventions."""

from __future__ import annotations

from collections.abc import Mapping

from assur.figures.catalogue import left_out
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import CLOSED, RANK_GAP
from assur.kinematics.rates.units import is_mixed
from assur.kinematics.status import FACTOR_TOLERANCE, MARGIN_TOLERANCE, NEAR_SINGULAR, Status
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.results.kinds import Facts, Result, Section, Table
from assur.results.typeset_text import short

TOPOLOGICAL = (
    ("degrees of freedom", "rank of the closure of all loops", "freedoms of the joints less those of the loops"),
    ("POC sets", "rules of union and intersection", "rank of twists at random finite displacements"),
)
CLOSED_FORM = (
    ("poses and inputs", "closed form, every branch", "closure of the whole joint graph, residual listed"),
    ("numbers of solutions", "closed form, every branch", "the closed form over intervals: these and no other"),
    ("velocity", "Jp v = Jq q̇ of the closed form", "determinants as products of factors; differences, in the tests"),
    ("singularities", "factors of the determinants", "rank of the closure of the joint graph"),
    ("volume, areas", "solids of signed margins, intersected", "the same at half the resolution"),
    ("bounds of volume and areas", "boxes proved inside or outside by intervals", "the estimate by solids, compared"),
    ("global condition index", "quasi-random mean", "spread of eight independent shifts"),
    ("formulas", "the kernels, read over symbols", "the joint graph, in the tests"),
)
SEARCHED = (
    (
        "poses and inputs",
        "loop after loop, or a search: see Completeness",
        "closure of the joint graph, residual listed",
    ),
    ("velocity, singularities", "null space of the closure’s Jacobian", "finite motions; differences, in the tests"),
    ("volume, areas", "the mode followed over a grid", "the same at half the resolution"),
)
AUDITED = (
    ("POC sets, ξ, Δ, κ", "declared in the reference data", "derived, as above"),
    ("printed values", "recomputed to their last digit", "the constraint that a wrong value breaks"),
)


def basis(findings: Findings) -> Section:
    """Two routes to every number, conventions, tolerances."""
    routes = [*TOPOLOGICAL, *(CLOSED_FORM if findings.record.closed_form else SEARCHED)]
    routes += AUDITED if findings.reference else ()
    known = Table("Two routes to every number", ("number", "first route", "second route"), tuple(routes))
    parts: list[Result] = [known, Facts("Conventions", _conventions(findings.record)), _tolerances()]
    missing = left_out(findings.record, findings) if findings.illustrated else {}
    if missing:
        parts.append(Facts("Figures that this mechanism does not have", _by_reason(missing)))
    return Section("How the numbers are known", results=parts)


def _by_reason(missing: Mapping[str, str]) -> tuple[tuple[str, str], ...]:
    """Names that have the same reason together."""
    names: dict[str, list[str]] = {}
    for name, why in missing.items():
        names.setdefault(why, []).append(name)
    return tuple((", ".join(together), why) for why, together in names.items())


def _conventions(record: MechanismRecord) -> tuple[tuple[str, str], ...]:
    angles = "degrees" if record.angle == "deg" else "rad"
    length = f"{short(characteristic_length(record))} {record.unit}"
    over = f", lengths divided by the characteristic length {length}" if is_mixed(record) else ""
    statuses = ", ".join(status.name.replace("_", " ") for status in Status)
    return (
        ("frames", "right-handed, Z up; all link frames are parallel to the base’s when every joint value is zero"),
        ("units", f"lengths in {record.unit}, angles in {angles} in this report"),
        ("inputs", "printed value = sign · joint value + offset, in the order of the file"),
        ("velocity", "Jp v = Jq q̇; the condition number is that of J = Jp⁻¹ Jq in the 2-norm" + over),
        ("modes", "rows of signs in the order that the file declares; 0 where two branches have merged"),
        ("residual", f"largest gap over the cut joints; a rotation counts times {length}"),
        ("status", f"{statuses}: the most severe is reported"),
    )


def _tolerances() -> Table:
    rows = (
        ("two branches merge", short(MARGIN_TOLERANCE), "a radicand, of its scale"),
        ("singular", short(FACTOR_TOLERANCE), "a factor, of its scale"),
        ("near singular", short(NEAR_SINGULAR), "a factor, of its scale"),
        ("loops are closed", short(CLOSED), "the residual, of the characteristic length"),
        ("rank", short(RANK_GAP), "a singular value, of the largest"),
    )
    return Table("When a number counts as zero", ("decision", "share", "of what"), rows, folded=True)
