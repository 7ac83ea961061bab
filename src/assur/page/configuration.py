"""The joint graph's numbers in the page: the recorded program of a configuration as JavaScript."""

from __future__ import annotations

from collections.abc import Mapping

from assur.joint_graph.configuration import Configuration
from assur.joint_graph.frames import frame_numbers
from assur.joint_graph.programs import Outputs, program
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import closing_numbers
from assur.model.mechanism import MechanismRecord
from assur.numerics.recording.javascript import javascript, number_text
from assur.page.resizing import general


def configuration(record: MechanismRecord) -> str:
    """JavaScript source of a function that works out where a configuration stands and how far its loops are open.

    `function (s, d, n)`: the numbers of all steps (`assur.joint_graph.state.state_names`), then nine
    for each ball joint (`ball_rates`); dimensions as `assur.page.resizing.general_dimensions` lists them. It
    fills in what is not zero of numbers n that are: matrices row by row, one after the other as `matrices` gives them.

    >>> from assur.model.registry import load_record
    >>> configuration(load_record("fivebar")).splitlines()[0]
    'function (s, d, n) {'
    """
    found = program(general(record), configuration_numbers)
    starts = _starts(record)
    targets = {name: [f"n[{_place(name, starts)}]"] for name in found.line.tape.outputs}
    constants = (f"n[{_place(name, starts)}]={number_text(value)};" for name, value in found.constants.items() if value)
    varying = [f"s[{place}]" for place in found.places]
    uniform = [f"d[{k}]" for k in range(len(found.line.tape.uniform))]
    body = "\n".join([*constants, *javascript(found.line.tape, varying, uniform, targets)])
    return f"function (s, d, n) {{\n{body}\n}}"


def configuration_numbers(configuration: Configuration) -> Outputs:
    """What the page asks of a configuration: what closes its loops, and the frames of its links."""
    return {**closing_numbers(configuration), **frame_numbers(configuration)}


def matrices(record: MechanismRecord) -> dict[str, tuple[int, int]]:
    """Rows and columns of what the program fills in, in its order.

    `gap`: of each cut joint, in the graph's order, three of the distance and nine of the turn; `derivative`: of each
    of them six rows, velocities before angular velocities; `platform`: nine of its orientation, three of its point;
    `move`: its angular velocity and its point's velocity; `frame`: of each link, as it is placed, orientation and
    origin.

    >>> from assur.model.registry import load_record
    >>> matrices(load_record("fivebar"))["derivative"]
    (6, 5)
    """
    loops, count = len(joint_graph(record).cut), len(record.coordinates)
    return {
        "gap": (loops, 12),
        "derivative": (6 * loops, count),
        "platform": (1, 12),
        "move": (6, count),
        "frame": (len(record.links), 12),
    }


def _starts(record: MechanismRecord) -> dict[str, tuple[int, int]]:
    """Where each matrix begins, and how many columns it has."""
    starts, start = {}, 0
    for kind, (rows, columns) in matrices(record).items():
        starts[kind] = start, columns
        start += rows * columns
    return starts


def _place(name: str, starts: Mapping[str, tuple[int, int]]) -> int:
    """Of an output "kind row,column", or "kind column" of a single row."""
    kind, _, where = name.partition(" ")
    *row, column = map(int, where.split(","))
    start, columns = starts[kind]
    return start + sum(row) * columns + column
