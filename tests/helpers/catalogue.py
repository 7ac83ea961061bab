"""The mechanisms of the catalogue as parameters of a test: three of them always, the others in the deep run.

For what is a law of every mechanism, `contract/` asks all of them in every run. A test that looks at one more use of
the same numbers (a figure, an export, a page) asks three that have between them parallelograms and a closed form,
angles in a plane, ball joints, quaternions and forty solutions; `make test-deep` asks the others.
"""

from collections.abc import Iterable
from functools import cache
from typing import Any

import pytest

from assur.derived_topology import topology
from assur.mechanism import names
from assur.topology.facts import Topology

REPRESENTATIVES = ("zeng2019", "planar_3rrr", "gough_stewart")


def each(of: Iterable[str] | None = None, quick: Iterable[str] = REPRESENTATIVES) -> list[Any]:
    """Names as parameters: those of `quick` in every run, the others marked `deep`."""
    quick = tuple(quick)
    every = list(names() if of is None else of)
    assert set(quick) <= set(every)
    return [name if name in quick else pytest.param(name, marks=pytest.mark.deep) for name in every]


@cache
def topology_of(name: str) -> Topology:
    """The topology of a mechanism of the catalogue, computed once in a process."""
    return topology(name)
