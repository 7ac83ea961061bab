"""Mechanisms of the literature have the freedoms and the motion that are given there."""

import tomllib
from pathlib import Path

import pytest

from assur.derived_topology import topology
from catalogue import topology_of

NAMED = tomllib.loads(Path(__file__).with_name("named_mechanisms.toml").read_text(encoding="utf-8"))["mechanism"]
NAMES = [entry.get("name") or entry["known"] for entry in NAMED]


def test_they_are_sixty_and_have_a_source_each():
    assert len(set(NAMES)) == len(NAMES) >= 60
    assert all("known" in entry or len(entry["source"]) > 40 for entry in NAMED)
    assert all(topology_of(entry["known"]).source for entry in NAMED if "known" in entry)


def test_the_docs_say_how_many_sources_were_not_read():
    own = [entry for entry in NAMED if "known" not in entry]
    unread = sum(not entry["read"] for entry in own)
    text = " ".join((Path(__file__).parents[2] / "docs" / "topology.md").read_text(encoding="utf-8").split())
    assert f"{len(NAMED)} mechanisms of the literature by name" in text
    assert f"{len(NAMED) - len(own)} come with assur; of the other {len(own)}, {unread} sources" in text


@pytest.mark.parametrize("entry", NAMED, ids=NAMES)
def test_freedoms_and_motion_are_those_of_the_literature(entry):
    found = topology_of(entry["known"]) if "known" in entry else topology(entry["chains"], mode=entry.get("mode"))
    assert (found.dof - found.internal_freedoms, found.motion_type) == (entry["dof"], entry["motion"])
    assert list(found.xi) == entry.get("xi", list(found.xi))
    assert found.coupling_degree == entry.get("coupling_degree", found.coupling_degree)
