"""Every registered mechanism with one context for all its figures, and every figure drawn once."""

from __future__ import annotations

from functools import lru_cache

import pytest

import assur
from assur import figures
from assur.figures.catalogue import ENTRIES
from assur.workspace.region import workspace

COARSE = 24


@lru_cache(maxsize=8)
def shared(name):
    record = assur.load(name)
    return figures.Context(record, workspace(record, resolution=COARSE))


@lru_cache(maxsize=64)
def drawn(name, figure):
    context = shared(name)
    return figures.drawing(context.record, figure, context)


@pytest.fixture(params=assur.names())
def context(request):
    return shared(request.param)


@pytest.fixture
def data(context):
    """Numbers of a figure by its name; skips the mechanisms that do not have it."""

    def of(figure):
        entry = next(item for item in ENTRIES if item.name == figure)
        why = entry.missing(context)
        if why:
            pytest.skip(why)
        return drawn(context.record.name, figure).data

    return of


@pytest.fixture
def page(context):
    """A drawn figure by its name; skips the mechanisms that do not have it."""

    def of(figure):
        entry = next(item for item in ENTRIES if item.name == figure)
        why = entry.missing(context)
        if why:
            pytest.skip(why)
        return drawn(context.record.name, figure).figure

    return of
