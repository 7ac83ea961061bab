"""Bill of materials: which links are made, how many of each kind, and what is bought for the joints, in plain words.

Lengths are in mm, masses those that the file says. Sizes that the joint graph does not give (thicknesses, pins, rails)
are those drawn, to begin with.
"""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.at_border import quantity_text
from assur.kinematics.validation.check import METRES
from assur.machine.masses.link_masses import masses
from assur.model.mechanism import Input, Joint, MechanismRecord
from assur.results.answers.files import BillRow
from assur.scene.bodies import LinkBody, bodies, corners, fused
from assur.scene.part import Part
from assur.scene.shapes import Ball, Bar, Cuboid, Cylinder, Shape, Slab

FloatArray = NDArray[np.float64]


def bill(record: MechanismRecord) -> tuple[BillRow, ...]:
    """The bill of materials: links first, alike ones (or mirrored ones) in one row, then what is bought.

    >>> from assur.model.registry import load_record
    >>> [(row.kind, row.count, row.names) for row in bill(load_record("fivebar"))][1:3]
    [('make', 2, ('crank1', 'crank2')), ('make', 1, ('rod1',))]
    """
    millimetre = 1e3 * METRES[record.unit]
    made, weights = bodies(record), masses(record).bodies
    alike: list[tuple[_Form, list[LinkBody]]] = []
    for body in (item for item in made if item.fused):
        form = _form(body, weights[body.link].mass if body.link in weights else None)
        group = next((group for first, group in alike if _same(first, form)), None)
        if group is None:
            alike.append((form, [body]))
        else:
            group.append(body)
    rows = [
        BillRow(
            "make",
            ", ".join(_counted(_words(item, millimetre) for item in group[0].fused)),
            len(group),
            tuple(item.link for item in group),
            round(form.volume * millimetre**3, 1),
            form.mass,
        )
        for form, group in alike
    ]
    bought: dict[str, list[str]] = {}
    for joint in record.joints.values():
        own = [item for body in made for item in (*body.fused, *body.pins) if item.joint == joint.name]
        driven = next((item for item in record.drives if item.coordinate.joint == joint.name), None)
        for text in _to_buy(record, joint, own, driven, millimetre):
            bought.setdefault(text, []).append(joint.name)
    rows += [BillRow("buy", text, len(names), tuple(names)) for text, names in bought.items()]
    return tuple(rows)


def bill_csv(rows: Iterable[BillRow]) -> str:
    """The bill as a table with commas, one row per line under a line of names.

    >>> bill_csv([BillRow("buy", "ball joint, ball d 8", 2, ("A", "B"))]).splitlines()[1]
    'buy,2,"ball joint, ball d 8",A B,,'
    """
    stream = io.StringIO()
    table = csv.writer(stream, lineterminator="\n")
    table.writerow(
        ("kind", "count", "what, sizes in mm", "links or joints", "volume of one in mm^3", "mass of one in kg")
    )
    for row in rows:
        volume = "" if row.volume is None else f"{row.volume:.1f}"
        mass = "" if row.mass is None else f"{row.mass:.6g}"
        table.writerow((row.kind, row.count, row.what, " ".join(row.names), volume, mass))
    return stream.getvalue()


@dataclass(frozen=True, eq=False)
class _Form:
    """What is equal for links that are alike or mirrored: roles of the parts; their sizes and distances; the volume.

    So is the mass in kg that the file says, None where it says none.
    """

    roles: tuple[str, ...]
    sizes: FloatArray
    volume: float
    mass: float | None


def _form(body: LinkBody, mass: float | None) -> _Form:
    listed = sorted((f"{item.role} {item.shape.kind}", _sizes(item.shape)) for item in body.fused)
    middles = np.array([corners(item.shape).mean(axis=0) for item in body.fused])
    gaps = np.sort(np.linalg.norm(middles[:, None] - middles, axis=2).ravel())
    sizes = [value for _, own in listed for value in own]
    bores = np.sort([_sizes(item)[0] for item in body.bores])  # their lengths beyond the link do not matter
    volume = fused(body).volume()
    return _Form(tuple(role for role, _ in listed), np.array([*sizes, *gaps, *bores, np.cbrt(volume)]), volume, mass)


def _same(first: _Form, second: _Form) -> bool:
    """Whether two forms are equal, but for rounding."""
    if first.roles != second.roles or len(first.sizes) != len(second.sizes):
        return False
    if (first.mass is None) != (second.mass is None) or not np.isclose(first.mass or 0.0, second.mass or 0.0):
        return False
    return bool(np.allclose(first.sizes, second.sizes, rtol=1e-6, atol=1e-6 * float(first.sizes.max())))


def _sizes(shape: Shape) -> tuple[float, ...]:
    if isinstance(shape, Ball):
        return (2 * shape.radius,)
    if isinstance(shape, Cylinder):
        return (2 * shape.radius, float(np.linalg.norm(shape.end - shape.start)))
    if isinstance(shape, Bar):
        return (float(np.linalg.norm(shape.end - shape.start)), 2 * shape.radius, shape.thickness)
    if isinstance(shape, Cuboid):
        return tuple(float(value) for value in np.sort(2 * np.linalg.norm(shape.sides, axis=1))[::-1])
    thick = float(np.linalg.norm(shape.along))
    flat = np.linalg.norm(shape.outline - np.roll(shape.outline, 1, axis=0), axis=1)
    return (*(float(value) for value in np.sort(flat)[::-1]), thick)


def _words(part: Part, millimetre: float) -> str:
    """A part with its sizes, as "bar 250 between eyes, 26 x 8"."""
    sizes = [f"{value * millimetre:.4g}" for value in _sizes(part.shape)]
    if isinstance(part.shape, Ball):
        return f"{part.role} d {sizes[0]}"
    if isinstance(part.shape, Cylinder):
        return f"{part.role} d {sizes[0]} x {sizes[1]}"
    if isinstance(part.shape, Bar):
        return f"{part.role} {sizes[0]} from hole to hole, {sizes[1]} x {sizes[2]}"
    if isinstance(part.shape, Slab):
        return f"{part.role} with {len(sizes) - 1} corners, sides {' '.join(sizes[:-1])}, {sizes[-1]} thick"
    return f"{part.role} {' x '.join(sizes)}"


def _counted(words: Iterable[str]) -> list[str]:
    return [text if count == 1 else f"{count} of {text}" for text, count in Counter(words).items()]


def _to_buy(
    record: MechanismRecord, joint: Joint, own: list[Part], driven: Input | None, millimetre: float
) -> list[str]:
    """What one joint needs."""
    pins = [item.shape for item in own if item.role == "pin" and isinstance(item.shape, Cylinder)]
    grounded = record.base in (joint.parent, joint.child)
    bought = []
    if joint.type.slides == 2:
        bought.append("flat bearing: a plate on which a puck slides" + " and turns" * joint.type.turns)
    elif joint.type.slides and joint.type.turns:
        bought.append("shaft with a linear bearing that slides and turns")
    elif joint.type.slides:
        bought.append("rail with carriage" if grounded else "telescopic slide (rod in a tube with bushes)")
    elif joint.type.screw:
        bought.append(f"screw and nut, {abs(joint.pitch) * millimetre:.4g} mm per turn")
    elif joint.type.turns == 2:
        bought.append(f"universal joint (a cross with two pins d {_sizes(pins[0])[0] * millimetre:.3g})")
    elif joint.type.turns and pins:
        across, long = (value * millimetre for value in _sizes(pins[0]))
        bought.append(f"bearing: pin d {across:.3g} x {long:.3g} with bushes or ball bearings")
    else:
        ball = next((item.shape for item in own if isinstance(item.shape, Ball)), None)
        bought.append(f"ball joint, ball d {2 * ball.radius * millimetre:.3g}" if ball else "ball joint")
    if driven is not None:
        bought.append(_drive(record, driven, millimetre))
    return bought


def _drive(record: MechanismRecord, driven: Input, millimetre: float) -> str:
    """The drive of an input, with its stroke where the file has one."""
    if driven.coordinate.kind == "angle":
        reach = (
            ""
            if driven.stroke is None
            else f", turns by {quantity_text(record, float(np.ptp(driven.stroke)), 'angle', digits=4)}"
        )
        return f"rotary drive (gear motor){reach}"
    reach = "" if driven.stroke is None else f", stroke {np.ptp(driven.stroke) * millimetre:.4g} mm"
    return f"linear drive (ball screw, belt or linear motor){reach}"
