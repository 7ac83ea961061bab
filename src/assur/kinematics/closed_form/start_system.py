"""The start of a polynomial system: the same mechanism with generic complex dimensions and inputs, and its solutions.

They stand in the file `start.toml` beside the mechanism's; where there is none they are found by monodromy. Lengths
are counted in the characteristic length.
"""

from __future__ import annotations

from functools import lru_cache
from types import SimpleNamespace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.errors import UsageError
from assur.joint_graph.geometry import characteristic_length
from assur.model.closed_form import ClosedForm, PolynomialSystem
from assur.model.file.toml_source import read_toml
from assur.model.mechanism import MechanismRecord
from assur.model.pose import QUATERNION, has_quaternion
from assur.numerics.expanded import ExpandedSystem, expand, unknowns
from assur.numerics.monodromy import all_solutions, random_complex
from assur.numerics.path_tracking import polished
from assur.results.reading import file_text

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]
FILE = "start.toml"
DIGITS = 5


class Complexes:
    """Complex numbers for a kernel: the root is the principal one."""

    def sqrt(self, radicand: ArrayLike, /) -> ComplexArray:
        """Principal root."""
        root: ComplexArray = np.sqrt(np.asarray(radicand, dtype=complex))
        return root


def dimensions(record: MechanismRecord) -> FloatArray:
    """The parameters (q,), lengths over the characteristic length."""
    length = characteristic_length(record)
    angles = [item.name for item in record.parameters.values() if item.unit not in (record.unit, "1")]
    angles += [item.name for item in record.inputs if item.coordinate.kind == "angle"]
    if angles:
        raise UsageError(f"{record.name}: {', '.join(angles)}: a polynomial system has lengths and numbers, no angles")
    units = [length if item.unit == record.unit else 1.0 for item in record.parameters.values()]
    return np.array([item.inside for item in record.parameters.values()]) / units


def family(
    record: MechanismRecord, system: PolynomialSystem, first: ComplexArray, last: NDArray[np.inexact]
) -> ExpandedSystem:
    """The systems on the straight way from one mechanism to others.

    Args:
        record: the mechanism.
        system: its direct problem.
        first: (q,) dimensions and inputs at t = 1.
        last: (P, q) those of P problems at t = 0; they all have the same dimensions.
    """
    *x, t = unknowns(len(system.unknowns) + 1)
    count = len(record.parameters)
    ends = [*last[0, :count], *last[:, count:].T]
    ways = [b + (a - b) * t for a, b in zip(first, ends, strict=True)]
    p = SimpleNamespace(**dict(zip(record.parameters, ways[:count], strict=True)))
    return expand(system.equations(Complexes(), p, ways[count:], x))


@lru_cache(maxsize=16)
def start_system(record: MechanismRecord, system: PolynomialSystem) -> tuple[ComplexArray, ComplexArray]:
    """Dimensions and inputs (q,) of the start, and all its solutions (K, n)."""
    path = record.folder / FILE if record.folder else None
    if path is None or not path.is_file():
        return start_of(record, system)
    data = read_toml(file_text(path), str(path)).data
    parameters = np.array([complex(*data["start"][name]) for name in _names(record)])
    rough = np.array(data["solutions"]).reshape(-1, len(system.unknowns), 2) @ [1, 1j]
    here = family(record, system, parameters, parameters[None])
    solutions, _ = polished(here, rough, np.ones(len(rough)), np.zeros(len(rough), dtype=int))
    return parameters, solutions


def start_of(record: MechanismRecord, system: PolynomialSystem, seed: int = 0) -> tuple[ComplexArray, ComplexArray]:
    """Dimensions and inputs (q,) of a start, and its solutions (K, n), from nothing.

    Dimensions and a pose are chosen by chance, its inputs follow, and the other solutions are found by monodromy. A
    file `start.toml` holds both, rounded to `DIGITS` digits; its first line names the seed.
    """
    rng = np.random.default_rng(seed)
    chosen = random_complex(rng, len(record.parameters)).round(DIGITS)
    p = SimpleNamespace(**dict(zip(record.parameters, chosen, strict=True)))
    pose = random_complex(rng, len(record.platform.pose))
    if has_quaternion(record.platform.pose):
        places = [record.platform.pose.index(name) for name in QUATERNION]
        pose[places] /= np.sqrt(pose[places] @ pose[places])
    inputs = _form(record).inverse(Complexes(), p, tuple(pose), SimpleNamespace()).inputs
    parameters = np.concatenate([chosen, np.array(inputs)])
    solution = np.array(system.lift(Complexes(), p, tuple(pose)))

    def way(first: ComplexArray, last: ComplexArray) -> ExpandedSystem:
        return family(record, system, first, last[None])

    return parameters, all_solutions(way, parameters, solution, system.degree, rng)


def _names(record: MechanismRecord) -> tuple[str, ...]:
    return (*record.parameters, *(item.name for item in record.inputs))


def _form(record: MechanismRecord) -> ClosedForm:
    if record.closed_form is None:
        raise UsageError(f"{record.name} has no closed form")
    return record.closed_form
