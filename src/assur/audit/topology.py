"""Printed numbers of topology: POC sets, and the decomposition into loops with xi, F, Delta and kappa."""

from __future__ import annotations

from collections.abc import Mapping

from assur.audit import twists
from assur.audit.configurations import COUNT
from assur.audit.reference import Digits
from assur.audit.rows import Row
from assur.model.file.schema import Entry
from assur.model.mechanism import MechanismRecord

KNOWN_BY = f"rank of twists at {COUNT} random configurations"


class PocSet(Entry):
    """A printed POC set: `poc` is its dimensions, as "t2 r1"; the printed directions are read, not computed."""

    source: str
    quantity: str
    printed: str
    poc: str
    link: str
    joints: tuple[str, ...] = ()
    erratum: str = ""


class Loop(Entry):
    """A single open chain in the source's order, generalised joints counting as one joint each."""

    name: str
    joints: tuple[str, ...]
    freedoms: Digits
    inputs: Digits
    xi: Digits
    delta: Digits


class Decomposition(Entry):
    """The source's loops, and the numbers that follow from them."""

    sources: Mapping[str, str]
    loops: tuple[Loop, ...]
    loop_count: Digits
    freedom: Digits
    kappa: Digits


def poc_rows(record: MechanismRecord, entry: PocSet) -> list[Row]:
    """One row: the dimensions of a link's POC set."""
    translations, rotations, dimension = twists.poc_dimensions(record, entry.link, entry.joints)
    computed = f"t{translations} r{rotations}"
    holds = computed == entry.poc
    return [
        Row(
            source=entry.source,
            quantity=entry.quantity,
            printed=entry.printed,
            computed=computed,
            verdict="ok" if holds else "wrong",
            erratum="" if holds else entry.erratum,
            note=f"dim {dimension}; {KNOWN_BY}; directions read, not computed",
        )
    ]


def decomposition_rows(record: MechanismRecord, entry: Decomposition) -> list[Row]:
    """Rows for f, I, xi and Delta of every loop, then for v, F and kappa."""
    rows: list[Row] = []
    earlier: tuple[str, ...] = ()
    xis, deltas = [], []
    for loop in entry.loops:
        inside = {name: twists.constraint_rank(record, [name]) for name in loop.joints if name in record.generalised}
        inner = sum(inside.values())
        freedoms = twists.freedom_sum(record, loop.joints) - inner
        inputs = sum(item.coordinate.joint in loop.joints for item in record.inputs)
        before = twists.constraint_rank(record, earlier) if earlier else 0
        earlier = (*earlier, *loop.joints)
        xi = twists.constraint_rank(record, earlier) - before - inner
        xis.append(xi)
        deltas.append(freedoms - inputs - xi)
        rows += [
            _row(entry.sources["freedoms"], f"sum of f, {loop.name}", loop.freedoms, freedoms),
            _row(entry.sources["inputs"], f"I, {loop.name}", loop.inputs, inputs, "inputs of the file"),
            _row(entry.sources["xi"], f"xi, {loop.name}", loop.xi, xi),
            _row(entry.sources["delta"], f"Delta, {loop.name}", loop.delta, deltas[-1]),
        ]
    collapsed = sum(len(record.generalised[name].joints) - 1 for name in earlier if name in record.generalised)
    links = len(record.links) - sum(
        len(record.generalised[name].joints) - 2 for name in earlier if name in record.generalised
    )
    loop_count = len(record.joints) - collapsed - links + 1
    freedom = twists.freedom_sum(record) - twists.constraint_rank(record)
    kappa = sum(abs(delta) for delta in deltas) / 2
    order = f"{KNOWN_BY}; in the source's order of loops, other orders not tried"
    return [
        *rows,
        _row(entry.sources["loop_count"], "v", entry.loop_count, loop_count, "joint graph, generalised joints as one"),
        _row(entry.sources["freedom"], "F", entry.freedom, freedom),
        _row(entry.sources["kappa"], "kappa", entry.kappa, kappa, order),
    ]


def _row(source: str, quantity: str, digits: Digits, computed: float, note: str = KNOWN_BY) -> Row:
    off = digits.value - computed
    return Row(
        source=source,
        quantity=quantity,
        printed=digits.text,
        computed=computed,
        verdict="ok" if off == 0 else "wrong",
        tolerance=0.0,
        off_by=off,
        note=note,
    )
