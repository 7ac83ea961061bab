"""The page: the scene, the program that draws it and its style in one HTML file that needs nothing else."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from importlib.resources import files
from typing import Any

import jinja2
from markupsafe import Markup

import assur
from assur.kinematics.home import home_values
from assur.model.mechanism import MechanismRecord
from assur.page.content import content
from assur.page.force_layers import force_layers
from assur.page.stiffness_layers import stiffness_layers
from assur.results.json_text import json_text
from assur.scene.layers import layers, layers_note, region
from assur.work import Progress

LARGEST = 1_000_000
"""Bytes that a page may have; a test holds every mechanism of the catalogue to it."""


def page(record: MechanismRecord, *, resolution: int | None = None, progress: Progress | None = None) -> str:
    """The whole page of a mechanism as HTML: `page_html` of its `scene`.

    >>> from assur.model.registry import load_record
    >>> text = page(load_record("fivebar"))
    >>> text.count("<script"), len(text) < LARGEST
    (2, True)
    """
    return page_html(scene(record, resolution=resolution, progress=progress))


def scene(
    record: MechanismRecord, *, resolution: int | None = None, progress: Progress | None = None
) -> dict[str, Any]:
    """What a page shows, as plain data: see `assur.page.content`.

    Args:
        record: the mechanism; its home must close.
        resolution: cells along each coordinate of the workspace; a default that a page can show if left out.
        progress: called with (steps done, steps in all).

    Errors: UsageError or MechanismFileError where the mechanism has no home; UsageError for a resolution that is none.
    """
    found = region(record, resolution=resolution, tick=progress)
    home = home_values(record)
    machine = (*force_layers(record, home), *stiffness_layers(record, home))
    return content(record, (*layers(record, found), *machine), layers_note(record, found))


def page_html(content: Mapping[str, Any]) -> str:
    """A scene with the program that draws it and its style, as one HTML file that asks for nothing else."""
    name, title = content["name"], content["title"]
    return (
        _environment()
        .get_template("page.html")
        .render(
            title=f"{name}: {title}" if title else name,
            version=assur.__version__,
            style=Markup(asset("page.css")),
            program=Markup(asset("page.js")),
            scene=Markup(embedded(json_text(content))),
        )
    )


def asset(name: str) -> str:
    """The text of a file that is part of every page."""
    return files("assur.page").joinpath("assets", name).read_text(encoding="utf-8")


def embedded(text: str) -> str:
    r"""JSON as it may stand in a script element: nothing in it can end the element.

    >>> embedded('{"a": "</script>"}')
    '{"a": "\\u003c/script>"}'
    """
    return text.replace("<", "\\u003c")


@lru_cache(maxsize=1)
def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.PackageLoader("assur.page", "assets"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
