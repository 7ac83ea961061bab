"""Materials and cross-sections of bars from their entries."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal, NamedTuple

from assur.errors import KeyPath
from assur.model.file import schema
from assur.model.file.build_joints import JointVectors
from assur.model.file.faults import Faults
from assur.model.machine_data import Material, Profile

Kind = Literal["round", "tube", "box"]
KINDS: tuple[Kind, ...] = ("round", "tube", "box")
MOMENTS = ("A", "Iy", "Iz", "J")
SHEAR = ("Ay", "Az")


class _Moments(NamedTuple):
    """Area, second moments about y and z, constant of torsion."""

    area: float
    iy: float
    iz: float
    torsion: float


class _Section(NamedTuple):
    """How a cross-section is given, its sizes and its moments."""

    kind: Kind | Literal["moments"]
    sizes: tuple[float, ...]
    moments: _Moments


def build_materials(entries: Mapping[str, schema.MaterialEntry], faults: Faults) -> dict[str, Material]:
    """Materials by their names."""
    for name, entry in entries.items():
        for key in ("density", "E"):
            check_positive(getattr(entry, key), ("materials", name, key), faults)
        if entry.nu is not None and not -1.0 < entry.nu < 0.5:
            faults.add(("materials", name, "nu"), f"{entry.nu:g}", "allowed: a number between -1 and 0.5")
    return {name: Material(name, entry.density, entry.E, entry.nu) for name, entry in entries.items()}


def build_profiles(
    entries: Mapping[str, schema.ProfileEntry], geometry: JointVectors, faults: Faults
) -> dict[str, Profile]:
    """Cross-sections by their names; one that is not fully said is left out, its fault noted."""
    profiles = {}
    for name, entry in entries.items():
        path = ("profiles", name)
        kinds = [kind for kind in KINDS if getattr(entry, kind) is not None]
        given = [key for key in (*MOMENTS, *SHEAR) if getattr(entry, key) is not None]
        if len(kinds) + bool(given) != 1:
            faults.add(path, " and ".join([*kinds, *given]) or "nothing", f"allowed: one of {', '.join(KINDS)}, or A")
            continue
        up = None if entry.up is None else geometry.axis(entry.up, (*path, "up"))
        sound = _sized(entry, kinds[0], path, faults) if kinds else _given(entry, path, faults)
        if sound is not None:
            profiles[name] = Profile(name, sound.kind, sound.sizes, *sound.moments, entry.Ay, entry.Az, up)
    return profiles


def check_positive(value: float | None, path: KeyPath, faults: Faults, *, zero: bool = False) -> bool:
    """Note a number that is not positive, or negative where zero is allowed; whether it may stay."""
    sound = value is None or value > 0.0 or (zero and value == 0.0)
    if not sound:
        faults.add(path, f"{value:g}", "allowed: zero or a positive number" if zero else "allowed: a positive number")
    return sound


def _sized(entry: schema.ProfileEntry, kind: Kind, path: KeyPath, faults: Faults) -> _Section | None:
    value = getattr(entry, kind)
    sizes = value if isinstance(value, tuple) else (value,)
    hollow = kind == "tube"
    sound = [
        check_positive(size, (*path, kind), faults, zero=hollow and place == 1) for place, size in enumerate(sizes)
    ]
    if hollow and all(sound) and sizes[1] >= sizes[0]:
        faults.add((*path, kind), f"an inner diameter of {sizes[1]:g}", f"allowed: less than the outer, {sizes[0]:g}")
        return None
    if not all(sound):
        return None
    moments = _rectangle(*sizes) if kind == "box" else _ring(sizes[0], sizes[1] if hollow else 0.0)
    return _Section(kind, sizes, moments)


def _given(entry: schema.ProfileEntry, path: KeyPath, faults: Faults) -> _Section | None:
    lacking = [key for key in MOMENTS if getattr(entry, key) is None]
    if lacking:
        faults.add(path, f"lacks {', '.join(lacking)}", f"allowed: {', '.join(MOMENTS)} together")
        return None
    keys = (*MOMENTS, *(key for key in SHEAR if getattr(entry, key) is not None))
    sound = [check_positive(getattr(entry, key), (*path, key), faults) for key in keys]
    if not all(sound):
        return None
    area, iy, iz, torsion = (float(getattr(entry, key)) for key in MOMENTS)
    return _Section("moments", (), _Moments(area, iy, iz, torsion))


def _ring(outer: float, inner: float) -> _Moments:
    second = math.pi * (outer**4 - inner**4) / 64.0
    return _Moments(math.pi * (outer**2 - inner**2) / 4.0, second, second, 2.0 * second)


def _rectangle(along: float, across: float) -> _Moments:
    """Of a rectangle with one side along y, `up`; torsion by Saint-Venant's series in closed form, within 1e-3."""
    long, short = max(along, across), min(along, across)
    share = short / long
    torsion = long * short**3 * (1.0 / 3.0 - 0.21 * share * (1.0 - share**4 / 12.0))
    return _Moments(along * across, along * across**3 / 12.0, across * along**3 / 12.0, torsion)
