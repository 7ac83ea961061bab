"""What links weigh: mass, centre and inertia of each, in SI units, and where each number comes from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.errors import UsageError
from assur.kinematics.validation.check import METRES
from assur.machine.masses.bars import link_bars
from assur.machine.masses.rigid_body import RigidBody, spread
from assur.machine.masses.slips import slips
from assur.model.file.place import entry_hint
from assur.model.machine_data import LinkData, Profile
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Masses:
    """The bodies of a mechanism, by their links, without base and payload.

    Attributes:
        bodies: of every link of which the file says it.
        payload: what the platform carries, in its frame; None where there is nothing.
        gravity: (3,) in m/s2, in the base frame.
        lacking: links of which nothing is said, or a material without its density.
        notes: what looks like a slip.
    """

    bodies: Mapping[str, RigidBody]
    payload: RigidBody | None
    gravity: FloatArray
    lacking: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def total(self) -> float:
        """Of all that is known, payload included, in kg."""
        return sum(body.mass for body in self.bodies.values()) + (self.payload.mass if self.payload else 0.0)

    def carried(self, platform: str) -> Mapping[str, RigidBody]:
        """The bodies, the platform with its payload."""
        if self.payload is None or platform not in self.bodies:
            return self.bodies
        return {**self.bodies, platform: self.bodies[platform].with_body(self.payload)}


@lru_cache(maxsize=64)
def masses(record: MechanismRecord) -> Masses:
    """Masses of all links but the base.

    Errors:
        UsageError: a bar whose ends or whose weight is not known.
    """
    data, metre = record.machine, METRES[record.unit]
    bodies, lacking = {}, []
    for link in record.links:
        own = data.links.get(link)
        if link == record.base:
            continue
        if own is None or not own.weighs or _without_density(record, own):
            lacking.append(link)
        else:
            bodies[link] = _body(record, link, own)
    payload = None
    if data.payload is not None:
        centre = record.platform.point if data.payload.centre is None else data.payload.centre
        payload = _given(data.payload, centre * metre, "platform's point")
    carried = {**bodies, **({"the payload": payload} if payload else {})}
    gravity = data.gravity.direction * data.gravity.value
    return Masses(bodies, payload, gravity, tuple(lacking), tuple(map(str, slips(record, carried))))


def all_masses(record: MechanismRecord) -> Masses:
    """Masses of all links, none lacking.

    Errors:
        UsageError: links of which the file says no mass.
    """
    known = masses(record)
    if known.lacking:
        first = known.lacking[0]
        own = record.machine.links.get(first)
        hint = f"{entry_hint(record, 'links', first, 'mass = 1.2')}, in kg"
        if own and own.material and _without_density(record, own):
            hint = f"{entry_hint(record, 'materials', own.material, 'density = 7850')}, in kg/m3"
        raise UsageError(f"{record.name}: no mass of {', '.join(known.lacking)}", hint=hint)
    return known


def _without_density(record: MechanismRecord, data: LinkData) -> bool:
    """Whether a link weighs as its material does, of which the file does not say the density."""
    if data.material is None or data.mass is not None or data.kg_per_m is not None:
        return False
    return record.machine.materials[data.material].density is None


def _body(record: MechanismRecord, link: str, data: LinkData) -> RigidBody:
    if data.mass is not None and not _of_bars_alone(data):
        metre = METRES[record.unit]
        return _given(data, (np.zeros(3) if data.centre is None else data.centre) * metre, "origin")
    if data.profile is None and data.kg_per_m is None:
        from assur.machine.masses.solids import of_solid  # which draws; few files ask for it

        return of_solid(record, link, _density(record, link, data), str(data.material))
    return _of_bars(record, link, data)


def _of_bars_alone(data: LinkData) -> bool:
    """Whether a link weighs as its bars do: no body is stated in their place."""
    if data.mass is None:
        return data.profile is not None or data.kg_per_m is not None
    return data.profile is not None and data.centre is None and data.inertia is None


def _given(data: LinkData, centre: FloatArray, place: str) -> RigidBody:
    """A mass that the file gives."""
    inertia = np.zeros((3, 3)) if data.inertia is None else data.inertia
    place = "" if data.centre is not None else f" at the {place}"
    size = "" if data.inertia is not None else ", a point"
    return RigidBody(float(data.mass or 0.0), centre, inertia, f"stated{size}{place}")


def _of_bars(record: MechanismRecord, link: str, data: LinkData) -> RigidBody:
    """Uniform bars: slender, but for what the section turns with about the bar's own axis."""
    metre, bars = METRES[record.unit], link_bars(record, link)
    per_metre, polar, source = _bar_weights(record, link, data)
    mass, moment, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for bar in bars:
        ends = metre * bar.ends
        own, middle, along = per_metre * metre * bar.length, ends.mean(axis=0), ends[1] - ends[0]
        size = float(along @ along)
        axis = along / np.sqrt(size) if size else np.zeros(3)
        mass += own
        moment += own * middle
        second += own * (spread(along) / 12.0 + polar * np.outer(axis, axis) + spread(middle))
    centre = moment / mass
    return RigidBody(mass, centre, second - mass * spread(centre), source)


def bar_weights(record: MechanismRecord, link: str) -> tuple[float, float] | None:
    """Kilograms of a metre of a link's bars, and kg m2 of it about their own axis; None where they do not weigh.

    >>> from assur.model.registry import load_record
    >>> [round(number, 6) for number in bar_weights(load_record("zeng2019"), "link12")]
    [2.46615, 0.000123]
    """
    data = record.machine.links.get(link)
    if data is None or not data.weighs or not _of_bars_alone(data):
        return None
    per_metre, polar, _ = _bar_weights(record, link, data)
    return per_metre, per_metre * polar


def _bar_weights(record: MechanismRecord, link: str, data: LinkData) -> tuple[float, float, str]:
    """Kilograms of a metre, the square of the radius of gyration about the bar's own axis in m2, and the source."""
    length = METRES[record.unit] * sum(bar.length for bar in link_bars(record, link))
    if length == 0.0:
        raise UsageError(f"link {link} of {record.name}: its bars have no length", hint="give it a mass")
    profile = record.machine.profiles[data.profile] if data.profile else None
    per_metre, source = _weight(record, link, data, profile, length)
    return per_metre, profile.polar / profile.area if profile else 0.0, source


def _weight(
    record: MechanismRecord, link: str, data: LinkData, profile: Profile | None, length: float
) -> tuple[float, str]:
    """Kilograms per metre of a link's bars, and where they come from."""
    if data.mass is not None:
        return data.mass / length, f"stated, spread over bars of {profile.name if profile else ''}"
    if data.kg_per_m is not None:
        return data.kg_per_m, f"bars of {data.kg_per_m:g} kg/m"
    area = record.machine.profiles[data.profile or ""].area
    return _density(record, link, data) * area, f"bars of {data.profile}, {data.material}"


def _density(record: MechanismRecord, link: str, data: LinkData) -> float:
    density = record.machine.materials[data.material].density if data.material else None
    if density is None:
        raise UsageError(
            f"link {link} of {record.name}: no density of {data.material}",
            hint=f"{entry_hint(record, 'materials', data.material or '', 'density = 7850')}, in kg/m3",
        )
    return density
