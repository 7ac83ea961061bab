"""Every registered mechanism with one context for its cheap figures; a few with all figures, each drawn once."""

from functools import cache

import pytest

import assur
from assur.figures import catalogue as figures
from assur.workspace.region import workspace
from catalogue import each
from own_machines import ELASTIC, OWN, own_machine

COARSE = 24
WHOLE = ("fivebar", "planar_3rrr", "zeng2019")
"""Those of which every figure is drawn: a plane workspace, one with an angle, one in space with a source to follow."""


@pytest.fixture(scope="module", autouse=True)
def few_nodes():
    """Maps of indices at few nodes: what is drawn of a node, and said of a map, is the same at 81 as at 2304."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("assur.figures.index_maps.NODES", 9)
        patch.setattr("assur.figures.indices.NODES", 20)
        patch.setattr("assur.figures.force_maps.NODES", 9)
        patch.setattr("assur.figures.weakest.NODES", 9)
        yield


@cache
def bare(name):
    """The context of a mechanism without a workspace, for figures that need none."""
    return figures.Context(own_machine(name) if name in (*OWN, *ELASTIC) else assur.load(name))


@cache
def shared(name):
    record = assur.load(name)
    return figures.Context(record, workspace(record, resolution=COARSE))


@pytest.fixture(params=WHOLE)
def context(request):
    return shared(request.param)


@pytest.fixture(params=[*each(), *each((*OWN, *ELASTIC), quick=("hybrid",))])
def every(request):
    """Of four mechanisms, in the deep run of every one; give it to figures that are drawn within a second.

    Those of the catalogue, and some of one's own: of these no companion says how they are drawn.
    """
    return bare(request.param)


def made(context, figure):
    """A drawing; a test of one that not every mechanism has names those that do (`parametrize`, indirect)."""
    return figures.drawing(context.record, figure, context)


@pytest.fixture
def data(context):
    """Numbers of a figure by its name."""
    return lambda figure: made(context, figure).data


@pytest.fixture
def data_of_every(every):
    """Numbers of a figure by its name, of every mechanism."""
    return lambda figure: made(every, figure).data


@pytest.fixture
def page_of_every(every):
    """A drawn figure by its name, of every mechanism."""
    return lambda figure: made(every, figure).figure
