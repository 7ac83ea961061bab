"""Printed numbers of topology: POC sets with their directions, and loops with xi, F, Delta and kappa."""

from __future__ import annotations

from collections.abc import Mapping

from assur.audit.parts import LinkMotion, called, link_motion, sampled, square, within
from assur.audit.reference import Digits
from assur.audit.rows import Row
from assur.model.file.schema import Entry
from assur.model.mechanism import MechanismRecord
from assur.topology.analysis import COUNT
from assur.topology.counting.coupling import coupling, coupling_of
from assur.topology.counting.mobility import mobility, motions
from assur.topology.symbolic.derivation import counted, matrix

TWISTS = f"rank of twists at {COUNT} random finite displacements"
COLLAPSED = "parallelograms as one joint"


class PrintedPocSet(Entry):
    """A printed POC set: that of a link moved by some joints, against the base of the mechanism or another link.

    O' is a general point of the link, as where sets are united or intersected. `poc` is the numbers of elements, as
    "t2 r1". Directions are as printed, by joints: elements along an axis, or in the plane that several axes span
    (`t_axes`, `r_axes`), or translations perpendicular to an axis (`t_normal`).

    `opened` is a joint that is taken off the link: the set is that of the open chain from the base to where the link
    was, the union of Eq. (4).
    """

    source: str
    quantity: str
    printed: str
    poc: str
    link: str
    joints: tuple[str, ...] = ()
    base: str = ""
    opened: str = ""
    t_axes: tuple[str, ...] = ()
    t_normal: str = ""
    r_axes: tuple[str, ...] = ()
    erratum: str = ""


class PrintedLoop(Entry):
    """A single open chain in the source's order, generalised joints counting as one joint each."""

    name: str
    joints: tuple[str, ...]
    freedoms: Digits
    inputs: Digits
    xi: Digits
    delta: Digits


class PrintedDecomposition(Entry):
    """The source's loops, and the numbers that follow from them."""

    sources: Mapping[str, str]
    loops: tuple[PrintedLoop, ...]
    loop_count: Digits
    freedom: Digits
    kappa: Digits


def poc_rows(record: MechanismRecord, entry: PrintedPocSet) -> list[Row]:
    """One row: a link's POC set, with its directions.

    Errors:
        RoutesDisagreeError: rules and twists differ. UnknownNameError, UsageError: no such part of the joint graph.
    """
    motion = link_motion(record, entry.link, entry.joints, entry.base, entry.opened)
    directions = _directions(record, entry, motion)
    holds = entry.poc == f"t{motion.poc.t} r{motion.poc.r}" and all(directions.values())
    return [
        Row(
            source=entry.source,
            quantity=entry.quantity,
            printed=entry.printed,
            computed=matrix(motion.poc, "ascii"),
            verdict="ok" if holds else "wrong",
            erratum="" if holds else entry.erratum,
            note="; ".join([_dimension(motion), _known_by(motion), *map(_said, directions, directions.values())]),
        )
    ]


def _directions(record: MechanismRecord, entry: PrintedPocSet, motion: LinkMotion) -> dict[str, bool]:
    """What the source prints of directions -> whether it holds at every configuration."""
    checked = {}
    if entry.t_axes:
        axes = motion.axes(called(record, entry.t_axes))
        checked[_along("t", entry.t_axes)] = within(motion.translations, axes)
    if entry.t_normal:
        axes = motion.axes(called(record, [entry.t_normal]))
        checked[f"t perpendicular to {entry.t_normal}"] = square(motion.translations, axes)
    if entry.r_axes:
        axes = motion.axes(called(record, entry.r_axes))
        checked[_along("r", entry.r_axes)] = within(motion.rotations, axes)
    return checked


def _along(part: str, names: tuple[str, ...]) -> str:
    return f"{part} {'parallel to' if len(names) == 1 else 'in the plane of'} {' and '.join(names)}"


def _said(direction: str, holds: bool) -> str:
    return f"{direction} {'as printed' if holds else 'does not hold'}"


def _dimension(motion: LinkMotion) -> str:
    dependent = motion.poc.dependent
    return f"dim {motion.poc.dim}" + (f", {counted(dependent, 'element')} not independent" if dependent else "")


def _known_by(motion: LinkMotion) -> str:
    return f"{TWISTS}; the rules refuse: {motion.refusal}" if motion.refusal else f"by the rules and by {TWISTS}"


def decomposition_rows(record: MechanismRecord, entry: PrintedDecomposition) -> list[Row]:
    """Rows for f, I, xi and Delta of every loop in the source's order, then for v, F and kappa.

    Errors:
        UnknownNameError: no such joint. UsageError: the loops of the entry are not those of the joint graph.
    """
    sample = sampled(record)
    free = mobility(sample.collapsed, sample.linkage.base, sample.linkage.platform)
    internal = motions(sample.collapsed, sample.linkage.base, sample.linkage.platform).internal
    order = [called(record, loop.joints) for loop in entry.loops]
    rows: list[Row] = []
    for printed, loop in zip(entry.loops, coupling_of(sample.collapsed, order, internal).loops, strict=True):
        rows += [
            _row(
                entry.sources["freedoms"], f"sum of f, {printed.name}", printed.freedoms, loop.freedoms, "joint graph"
            ),
            _row(entry.sources["inputs"], f"I, {printed.name}", printed.inputs, loop.inputs, "inputs of the file"),
            _row(entry.sources["xi"], f"xi, {printed.name}", printed.xi, loop.xi, TWISTS),
            _row(entry.sources["delta"], f"Delta, {printed.name}", printed.delta, loop.delta, TWISTS),
        ]
    kappa = coupling(sample.collapsed, internal).coupling_degree
    least = f"{TWISTS}; the least of all orders of loops"
    return [
        *rows,
        _row(entry.sources["loop_count"], "v", entry.loop_count, free.loops, f"joint graph, {COLLAPSED}"),
        _row(entry.sources["freedom"], "F", entry.freedom, free.dof, TWISTS),
        _row(entry.sources["kappa"], "kappa", entry.kappa, kappa, least),
    ]


def _row(source: str, quantity: str, digits: Digits, computed: int | None, note: str) -> Row:
    off = None if computed is None else digits.value - computed
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
