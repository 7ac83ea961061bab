"""What the tests of the page look at: made once in a process, for the same mechanism, dimensions and grid."""

from functools import cache
from typing import Any

from assur.mechanism import load
from assur.page.content import content
from assur.page.page import page_html, scene

RESOLUTION = 8
"""Nodes along an axis of the workspace that a page shows: few, since no test looks at how fine it is."""


@cache
def content_of(name: str) -> dict[str, Any]:
    """What a page is given of a mechanism, without layers; nobody may change it."""
    return content(load(name), [])


@cache
def scene_of(name: str, **dimensions: float) -> dict[str, Any]:
    """The scene of a mechanism's page; nobody may change it."""
    return scene(load(name, **dimensions), resolution=RESOLUTION)


@cache
def page_of(name: str, **dimensions: float) -> str:
    """A mechanism's page."""
    return page_html(scene_of(name, **dimensions))
