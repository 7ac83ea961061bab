"""How many signs of a mode are not those of a root: with each choice of them the formulas are others."""

from __future__ import annotations

from functools import lru_cache
from types import SimpleNamespace
from typing import Any

from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.status import closed_form_of
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.recording.tape import Recorder, Tape


@lru_cache(maxsize=64)
def taken_over(record: MechanismRecord, problem: Problem) -> tuple[tuple[frozenset[int], ...], int]:
    """Sets of signs that roots take over, by their places in the mode, and how many roots there are of what is drawn.

    A root takes over signs if it occurs nowhere but times one of them, and these nowhere else: the other sign of all of
    them is then the other root.

    >>> from assur.model.registry import load_record
    >>> taken_over(load_record("fivebar"), "inverse")
    ((frozenset({0}), frozenset({1})), 2)
    """
    tape, signs = _recorded(record, problem)
    uses: dict[int, list[tuple[str, int]]] = {k: [] for k in tape.outputs.values()}
    drawn: set[int] = set()
    for k, operation in enumerate(tape.operations):
        if operation.name in ("varying", "uniform") or drawn & set(operation.arguments):
            drawn.add(k)
        for place, j in enumerate(operation.arguments):
            uses.setdefault(j, []).append(
                (operation.name, operation.arguments[1 - place] if operation.name == "*" else k)
            )
    for k in tape.outputs.values():
        uses[k].append(("output", k))
    roots = [k for k, operation in enumerate(tape.operations) if operation.name == "root" and k in drawn]

    def only_times(k: int, others: list[int]) -> bool:
        return all(name == "*" and j in others for name, j in uses.get(k, []))

    takers = [k for k in roots if only_times(k, signs) and all(only_times(j, [k]) for _, j in uses.get(k, []))]
    return tuple(frozenset(signs.index(j) for _, j in uses.get(k, [])) for k in takers), len(roots)


def _recorded(record: MechanismRecord, problem: Problem) -> tuple[Tape, list[int]]:
    """Everything that is held against the joint graph, and the entries of the signs."""
    form, recorder = closed_form_of(record), Recorder()
    p = kernel_dimensions(record, recorder.uniform)
    signs = {name: recorder.uniform(f"sign {name}") for name in sign_names(record, problem)}

    def given(name: str, angle: bool) -> Any:
        return (recorder.varying(name), recorder.varying(f"{name} sine")) if angle else recorder.varying(name)

    direct = form.direct
    if problem == "inverse" or not callable(direct):
        pose = tuple(given(name, is_angle(name)) for name in record.platform.pose)
        branch = form.inverse(recorder, p, pose, SimpleNamespace(**signs))
    else:
        inputs = tuple(given(item.name, item.coordinate.kind == "angle") for item in record.inputs)
        branch = direct(recorder, p, inputs, SimpleNamespace(**signs))
    numbers = [
        *(branch.pose, branch.inputs, tuple(form.joints(recorder, p, branch.core).values())),
        *(form.jacobians(recorder, p, branch.core), tuple(form.factors(recorder, p, branch.core).values())),
    ]
    tape = recorder.tape({str(k): number for k, number in enumerate(_flat(numbers))})
    uniform = [k for k, operation in enumerate(tape.operations) if operation.name == "uniform"]
    return tape, [k for k, name in zip(uniform, tape.uniform, strict=True) if name.startswith("sign ")]


def _flat(value: Any) -> list[Any]:
    if isinstance(value, (tuple, list)):
        return [number for part in value for number in _flat(part)]
    return [value]
