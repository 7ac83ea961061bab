"""The page on conventions says what the code does: statuses, tolerances, exit codes, symbols."""

import re
from pathlib import Path

import assur
from assur import errors
from assur.kinematics import closure, status
from assur.kinematics.rates import motions
from assur.topology import directions
from assur.topology.screws import edges, twists

PAGE = (Path(__file__).parents[1] / "CONVENTIONS.md").read_text(encoding="utf-8")


def rows(heading: str) -> list[list[str]]:
    """Cells of every table row under one heading, the table heads left out."""
    section = PAGE.split(f"## {heading}\n")[1].split("\n## ")[0]
    lines = [line for line in section.splitlines() if line.startswith("|")]
    heads = {index - 1 for index, line in enumerate(lines) if line.startswith("|---")}
    heads |= {index + 1 for index in heads}
    return [
        [cell.strip() for cell in line.strip("|").split("|")] for index, line in enumerate(lines) if index not in heads
    ]


def test_it_lists_the_statuses_in_order():
    listed = [cells[0].strip("`") for cells in rows("Status") if len(cells) == 2]
    assert listed == [item.name for item in status.Status]


def test_it_prints_the_tolerances():
    printed = {cells[0].strip("`"): cells[1] for cells in rows("Status") if len(cells) == 3}
    code = {**vars(motions), **vars(status), **vars(closure)}
    assert len(printed) == 6
    assert {name: float(value) for name, value in printed.items()} == {name: code[name] for name in printed}


def test_it_prints_the_tolerances_of_topology():
    printed = {cells[0].strip("`"): float(cells[1]) for cells in rows("Topology")}
    code = {**vars(edges), **vars(directions), **vars(twists)}
    assert printed == {name: code[name] for name in ("EXACT", "NEARLY", "RANK_GAP", "CLEAR")}


def test_it_lists_the_exit_code_of_every_error():
    listed = {int(cells[0]) for cells in rows("Command line")}
    kinds = [kind for kind in vars(errors).values() if isinstance(kind, type) and issubclass(kind, errors.AssurError)]
    assert {kind.exit_code for kind in kinds} <= listed
    assert listed == {0, 1, 2, 3, 4, 5, 6, 70, 130}


def test_it_lists_every_symbol_of_the_paper():
    listed = {name for cells in rows("Symbols") for name in re.findall(r"`(\w+)`", cells[1])}
    mechanism = assur.load("zeng2019")
    form = mechanism.closed_form
    named = {*mechanism.parameters, *mechanism.platform.pose, *(item.name for item in mechanism.inputs)}
    named |= {item.name for item in (*form.factor_list, *form.quantity_list)}
    assert named - listed == set()
