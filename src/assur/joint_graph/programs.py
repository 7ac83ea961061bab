"""The joint graph as straight-line programs: recorded once for all mechanisms of one structure.

Dimensions that are 0, 1 or -1, or equal one another, are structure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache, partial
from typing import Any

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.geometry import geometry
from assur.joint_graph.graph_program import GraphProgram
from assur.joint_graph.kept_programs import kept_program
from assur.joint_graph.state import state_names
from assur.joint_graph.tree import joint_graph
from assur.model.mechanism import MechanismRecord
from assur.numerics.recording.straight_line import straight_line
from assur.numerics.recording.tape import Recorded, Recorder, pruned, without_unused
from assur.numerics.vectors import Matrix

Outputs = Mapping[str, Any]
Wanted = Callable[..., Outputs]
"""What a configuration, and other numbers that are given, are asked for."""


def program(
    record: MechanismRecord, asked: Wanted, given: tuple[str, ...] = (), same: tuple[str, ...] = ()
) -> GraphProgram:
    """The program of what a function asks of a configuration.

    Args:
        record: the mechanism.
        asked: names numbers of a configuration; the same function gives the same program.
        given: names of other varying numbers, which the function takes after the configuration.
        same: names of numbers that are the same at every configuration, which it takes before those.

    Example: the frame of the platform of a five-bar turns and moves in the plane.

    >>> import numpy as np
    >>> from assur.model.registry import load_record
    >>> record = load_record("fivebar")
    >>> def height(configuration):
    ...     return {"y": configuration.frames["rod1"][1][1]}
    >>> program(record, height)(record, np.array([[np.pi / 2, 0.0, 0.0, 0.0, 0.0]])).shape
    (1, 1)
    """
    return _programs(_structure(record), asked, given, same)


@lru_cache(maxsize=256)
def _programs(structure: _Structure, asked: Wanted, given: tuple[str, ...], same: tuple[str, ...]) -> GraphProgram:
    return kept_program((structure.key, given, same), asked, partial(structure.program, asked, given, same))


@lru_cache(maxsize=64)
def _structure(record: MechanismRecord) -> _Structure:
    return _Structure(record)


@lru_cache(maxsize=256)
def part(whole: GraphProgram, kind: str) -> GraphProgram:
    """The program of the outputs of one kind alone."""
    names, tape = whole.names[whole.rows(kind)], whole.line.tape
    constants = {name: whole.constants[name] for name in names if name in whole.constants}
    outputs = {name: tape.outputs[name] for name in names if name not in constants}
    fewer = pruned(tape.operations, tape.varying, tape.uniform, outputs)
    own, places = without_unused(fewer)
    return GraphProgram(straight_line(own), tuple(whole.places[place] for place in places), names, constants)


class _Structure:
    """What mechanisms have in common that run the same programs."""

    def __init__(self, record: MechanismRecord) -> None:
        self.record = record
        places: dict[float, int] = {}

        def placed(number: float) -> str:
            return f"number {places.setdefault(number, len(places))}"

        self.pattern = geometry(record).mapped(placed)
        joints = tuple((joint.type.name, joint.parent, joint.child) for joint in record.joints.values())
        self.key = (record.base, record.platform.link, joints, self.pattern.key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Structure) and self.key == other.key

    def __hash__(self) -> int:
        return hash(self.key)

    def program(self, asked: Wanted, given: tuple[str, ...], same: tuple[str, ...]) -> GraphProgram:
        recorder, record = Recorder(), self.record
        varying = {name: tuple(map(recorder.varying, own)) for name, own in state_names(record).items()}
        rates = {
            name: _matrix(recorder.varying(f"rate {name} {k}") for k in range(9))
            for name, joint in record.joints.items()
            for step in joint.type.steps
            if step.kind == "ball"
        }
        uniform: dict[str, Recorded] = {}

        def number(name: str) -> Recorded:
            if name not in uniform:
                uniform[name] = recorder.uniform(name)
            return uniform[name]

        others = [*map(recorder.uniform, same), *map(recorder.varying, given)]
        outputs = asked(Configuration(joint_graph(record), self.pattern.mapped(number), varying, rates), *others)
        constants = {name: float(value) for name, value in outputs.items() if not isinstance(value, Recorded)}
        tape = recorder.tape({name: value for name, value in outputs.items() if name not in constants})
        fewer, places = without_unused(tape)
        return GraphProgram(straight_line(fewer), places, tuple(outputs), constants)


def _matrix(numbers: Iterator[Recorded]) -> Matrix:
    a, b, c, d, e, f, g, h, i = numbers
    return (a, b, c), (d, e, f), (g, h, i)
