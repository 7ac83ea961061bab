"""The section of aspects says what the library says, with bounds and by what right."""

import dataclasses

import pytest

from assur.model.registry import load_record
from assur.report.findings import Findings
from assur.report.sections.aspects import aspects
from assur.report.sections.reach import reach
from assur.results.kinds import PROVED, Scalar, Table


def section(name):
    found = Findings(load_record(name), resolution=16, illustrated=False)
    return found, aspects(found)


def test_each_aspect_has_its_signs_and_its_bounds():
    found, made = section("zeng2019")
    (table,) = [item for item in made.results if isinstance(item, Table)]
    assert [row[0] for row in table.rows] == [item.label for item in found.aspects.aspects]
    assert [row[1].count("<") for row in table.rows] == [row[0].count("-") for row in table.rows]
    assert all(" to " in row[2] for row in table.rows)
    assert table.known_by == PROVED


def test_different_aspects_are_counted_and_all_that_is_counted_says_how():
    found, made = section("zeng2019")
    scalars = {item.name: item for item in made.results if isinstance(item, Scalar)}
    assert scalars["different aspects, at least"].low == len(found.aspects) == 4
    assert all(item.known_by == PROVED for item in scalars.values())


def test_parts_that_are_not_told_apart_are_not_counted_twice():
    found, made = section("orthoglide")
    (count, _) = [item for item in made.results if isinstance(item, Scalar)]
    assert not found.aspects.told_apart
    assert count.low == len(set(found.aspects.search.links.group.tolist())) < len(found.aspects)
    (table,) = [item for item in made.results if isinstance(item, Table)]
    assert "not proved" in table.known_by


@pytest.mark.parametrize(("name", "said"), [("h4_robot", "nowhere: proved"), ("tripteron", "none found on 16 cells")])
def test_that_there_is_no_singularity_inside_says_how_it_is_known(name, said):
    made = reach(Findings(load_record(name), resolution=16, illustrated=False))
    table = next(item for item in made.results if isinstance(item, Table))
    assert all(row[2].startswith(said) for row in table.rows)
    assert table.known_by.startswith("proved" if "proved" in said else "not proved")


@pytest.mark.parametrize(
    ("box", "known"),
    [
        ({"x": (1000.0, 1100.0), "y": (1000.0, 1100.0)}, "proved by interval arithmetic: nothing is reached"),
        ({"x": (223.99, 323.0), "y": (-40.0, 50.0)}, "not proved: that nothing is reached"),
    ],
)
def test_of_an_empty_workspace_no_factor_is_said_to_be_proved(box, known):
    found = Findings(dataclasses.replace(load_record("fivebar"), box=box), resolution=4, illustrated=False)
    assert found.workspace.volume == 0
    table = next(item for item in reach(found).results if isinstance(item, Table))
    assert {row[2] for row in table.rows} == {"nothing is reached"}
    assert table.known_by.startswith(known)
