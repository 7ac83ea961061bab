"""Ties: dimensions of an overconstrained draft that change together, or else its loops do not close.

Where loops close for special dimensions alone, their closure has left null vectors n, wrenches that balance themselves.
A change of dimensions that moves the closure by G dp assembles only where n G dp = 0, at every configuration: the rows
n G are the ties, to first order. Lengths that are offsets along one direction enter linearly, so that their ties hold
as they stand; those of angles are only named.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.rates.motions import around_home, closure_values, general
from assur.kinematics.turns import joint_units
from assur.machine.accuracy.error_closure import error_closure
from assur.machine.accuracy.geometry_errors import geometry_errors
from assur.machine.calibration.identification import reduced
from assur.model.mechanism import MechanismRecord
from assur.synthesis.drafting.linear import Linear
from assur.synthesis.drafting.tables import Dimension
from assur.synthesis.drafting.templates import Draft

FloatArray = NDArray[np.float64]
PLACES = 4
"""Configurations at which ties are read: those of one alone may be of its own, as at a singular home."""

OPEN = 1e-6
"""Change of the closure below which one of a dimension leaves loops closed: slopes of formulas are differences."""

PLAIN = 1e-5
"""A share of a length within this of a whole or half number is that."""

NEAR = 2.0
"""mm by which rounded lengths may miss a tie that they satisfied before."""


@dataclass(frozen=True)
class Tie:
    """A dimension that others determine: the sum of `shares` of them; `linear`: they are lengths, and this is exact."""

    name: str
    shares: Mapping[str, float]
    linear: bool

    @property
    def names(self) -> tuple[str, ...]:
        """All that change together."""
        return (*self.shares, self.name)

    @property
    def formula(self) -> str:
        """The sum as a file writes it.

        >>> Tie("e2", {"e1": 1.0, "xA": -1.0}, linear=True).formula
        'e1 - xA'
        """
        return Linear(tuple(self.shares.items())).text()


def ties(record: MechanismRecord) -> tuple[Tie, ...]:
    """The ties of a mechanism's parameters, each of which determines its last one.

    >>> from assur.model.registry import load_record
    >>> ties(load_record("zeng2019"))
    ()
    """
    names, rows = _rows(record)
    if not len(rows):
        return ()
    reduced_rows, last = reduced(rows)
    made = []
    for row, place in zip(reduced_rows, last, strict=True):
        shares = {
            name: _plain(-float(share))
            for k, (name, share) in enumerate(zip(names, row, strict=True))
            if k != place and abs(share) > PLAIN
        }
        value = record.parameters[names[place]].value
        sizes = {name: record.parameters[name] for name in shares}
        lengths = all(size.unit == record.unit for size in (*sizes.values(), record.parameters[names[place]]))
        exact = lengths and abs(sum(share * sizes[name].value for name, share in shares.items()) - value) < NEAR
        made.append(Tie(names[place], shares, exact))
    return tuple(made)


def _rows(record: MechanismRecord) -> tuple[tuple[str, ...], FloatArray]:
    """Parameters (P), and an orthonormal basis (r, P) of what no change of them may be made of."""
    near = around_home(record)
    rank = int(general(record).closure)
    regular = near[closure_values(record, near)[:, rank - 1].argsort()[::-1][:PLACES]]
    names: tuple[str, ...] = ()
    rows = []
    for values in regular:
        errors = geometry_errors(record, values)
        whole = [k for k, name in enumerate(errors.names) if "." not in name]
        names = tuple(errors.names[k] for k in whole)
        closure = error_closure(record, values)
        left = np.linalg.svd(closure.loops * joint_units(record))[0][:, rank:]
        twists = errors.twists[whole].reshape(len(whole), -1).T
        rows.append(left.T @ closure.of_twists @ twists * _units(record, names))
    stacked = np.concatenate(rows)
    _, sizes, right = np.linalg.svd(stacked, full_matrices=False)
    kept = right[sizes > OPEN]
    return names, np.where(np.abs(kept) > OPEN, kept, 0.0)


def _units(record: MechanismRecord, names: Collection[str]) -> FloatArray:
    """One of each parameter (P,): the characteristic length, or a rad, so that all move loops by about as much."""
    length = characteristic_length(record)
    kinds = {record.unit: length, "deg": float(np.degrees(1.0))}
    return np.array([kinds.get(record.parameters[name].unit, 1.0) for name in names])


def _plain(share: float) -> float:
    """A share of a length, without the dust of differences."""
    return round(2.0 * share) / 2.0 if abs(2.0 * share - round(2.0 * share)) < 2.0 * PLAIN else share


def joints_of(drawn: Draft, names: Collection[str]) -> frozenset[str]:
    """Joints whose places are written with some of these dimensions."""
    return frozenset(
        joint.name
        for template in drawn.templates
        for joint in template.joints
        for point in (joint.at, joint.child_at)
        for part in point
        for term, _ in part.terms
        if not set(names).isdisjoint(re.findall(r"\w+", term))
    )


def tied(drawn: Draft, own_ties: Collection[Tie]) -> Draft:
    """The draft whose dimensions are formulas of others, where ties are linear."""
    formulas = {tie.name: tie.formula for tie in own_ties if tie.linear}

    def own(sizes: tuple[Dimension, ...]) -> tuple[Dimension, ...]:
        return tuple(dataclasses.replace(size, formula=formulas.get(size.name, "")) for size in sizes)

    templates = tuple(
        dataclasses.replace(template, dimensions=own(template.dimensions)) for template in drawn.templates
    )
    together = tuple(tie.names for tie in own_ties if not tie.linear)
    return dataclasses.replace(drawn, dimensions=own(drawn.dimensions), templates=templates, together=together)
