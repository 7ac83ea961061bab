"""Readings: the live numbers of a snapshot, as rows of a name and a text."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from dataclasses import dataclass

from assur.errors import AssurError
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.answers.at_border import angle_at_border
from assur.kinematics.answers.excess import excesses
from assur.kinematics.limits import limits_note
from assur.kinematics.postures import Postures
from assur.kinematics.rates.units import unit_length
from assur.kinematics.status import relative_factors
from assur.model.pose import LENGTHS
from assur.singularity.distance import distance
from assur.singularity.verdict import verdict_at
from assur.view import dials
from assur.view.snapshot import Snapshot

DIGITS = 4


@dataclass(frozen=True)
class Reading:
    """One number that is shown: its name, its text with its unit, and what it is in a few words."""

    name: str
    text: str
    about: str = ""


def readings(snapshot: Snapshot) -> tuple[Reading, ...]:
    """Pose, inputs, residual, mode and condition of a snapshot.

    >>> from assur.model.registry import load_record
    >>> from assur.view.snapshot import start
    >>> found = {item.name: item.text for item in readings(start(load_record("fivebar")))}
    >>> found["y"], found["working mode"], found["condition number"]
    ('223.9241 mm', '-+', '1.107')
    """
    record = snapshot.record
    rows = [
        Reading(dial.name, shown(dial, float(value)))
        for dial, value in (
            *zip(dials.dials(record), dials.read(record, snapshot.values), strict=True),
            *zip(dials.inputs(record), snapshot.inputs, strict=True),
        )
    ]
    rows.append(Reading("residual", f"{snapshot.residual:.1e} {record.unit}", "largest gap of the loops"))
    rows.append(limits_reading(snapshot))
    modes = zip(("working", "assembly"), snapshot.modes, strict=True)
    rows += [Reading(f"{kind} mode", text) for kind, text in modes if text]
    verdict = verdict_at(record, snapshot.values)
    condition = "infinite" if verdict.condition is None else f"{verdict.condition:.4g}"
    length = unit_length(record)
    over = f", lengths over the characteristic length {length:.4g} {record.unit}" if length else ""
    rows.append(Reading("condition number", condition, f"of the map from the inputs' rates to the platform's{over}"))
    least = verdict.closest
    if least:
        about = {"output": "parallel singularity at 0", "input": "serial singularity at 0"}.get(least, "of the closure")
        rows.append(Reading(f"least measure ({least})", f"{verdict.relative[least]:.3g}", about))
    rows.append(Reading("configuration", verdict.kind.replace("_", "-") + (", near singular" if verdict.near else "")))
    return tuple(rows)


def limits_reading(snapshot: Snapshot) -> Reading:
    """Whether strokes, limits of joints and cones of the file are kept, else which is exceeded most and by how much.

    >>> from assur.model.registry import load_record
    >>> from assur.view.snapshot import start
    >>> limits_reading(start(load_record("fivebar"))).text, limits_reading(start(load_record("three_rps"))).text
    ('no limits are stated', 'within')
    """
    record, about = snapshot.record, "strokes, limits of joints and cones of the file"
    exceeded = excesses(record, "inverse", snapshot.pose, snapshot.values)
    if not exceeded:
        return Reading("limits", limits_note(record) or "within", about)
    length = characteristic_length(record)
    worst = max(exceeded, key=lambda excess: excess.by / (1.0 if excess.angular else length))
    by = angle_at_border(record, worst.by) if worst.angular else worst.by
    more = f", {len(exceeded) - 1} more" if len(exceeded) > 1 else ""
    unit = record.angle if worst.angular else record.unit
    return Reading("limits", f"{worst.joint} outside by {by:.4g} {unit}{more}", about)


def closest_factor(snapshot: Snapshot, working: Postures) -> Reading | None:
    """The factor of the closed form that is closest to zero; None without closed form, or without factors.

    >>> from assur.kinematics.postures import postures
    >>> from assur.model.registry import load_record
    >>> from assur.view.snapshot import start
    >>> here = start(load_record("fivebar"))
    >>> closest_factor(here, postures(here.record, here.values, "inverse")).name
    'closest factor'
    """
    form, posture, values = snapshot.record.closed_form, working.current, working.answer.factors
    if form is None or posture is None or any(factor.name not in values for factor in form.factor_list):
        return None
    relative = {
        name: float(value[posture.candidate]) for name, value in relative_factors(snapshot.record, values).items()
    }
    factors = {factor.name: factor for factor in form.factor_list if factor.kind != "other"}
    if not factors:
        return None
    name = min(factors, key=lambda candidate: abs(relative[candidate]))
    return Reading("closest factor", f"{name} = {relative[name]:.3g}", f"0 where {factors[name].meaning}")


def clearance(snapshot: Snapshot, working: Postures) -> Reading | None:
    """Distance to the nearest parallel singularity, the orientation held; None where it is not defined.

    Takes seconds: for when nothing moves.
    """
    record = snapshot.record
    posture = working.current
    if record.closed_form is None or posture is None or not any(name in LENGTHS for name in record.platform.pose):
        return None
    try:
        nearest = distance(record, snapshot.pose, posture.label or None)
    except AssurError:  # a mode by number: closed forms know it by signs alone
        return None
    value = float(nearest.value)
    if math.isnan(value):
        return None
    if math.isinf(value):
        seen = f"none seen within {nearest.reach:.3g} {record.unit}"
        return Reading("to a parallel singularity", seen, "along rays; what is proved, `assur workspace --prove` says")
    return Reading("to a parallel singularity", f"{value:.4g} {record.unit}", f"there {nearest.factor} = 0")


def shown(dial: dials.Dial, value: float) -> str:
    """A value with the digits and the unit that are shown."""
    return f"{round(dial.shown(value), DIGITS) + 0.0:.{DIGITS}f} {dial.unit}"


def table(rows: Sequence[Reading]) -> str:
    """Rows as HTML; what they say is escaped.

    >>> table([Reading("x", "1 mm", "a < b")])
    '<table class="assur"><tr><td>x</td><td title="a &lt; b"><b>1 mm</b></td></tr></table>'
    """
    cells = ""
    for row in rows:
        name, text, about = (html.escape(part) for part in (row.name, row.text, row.about))
        cells += f'<tr><td>{name}</td><td title="{about}"><b>{text}</b></td></tr>'
    return f'<table class="assur">{cells}</table>'
