"""The gallery by task: what somebody wants to see, a small picture of it, and the command that draws it."""

from __future__ import annotations

from pathlib import Path

import gallery

TASKS = {
    "structure": "a kinematic diagram, with joints and links named",
    "model": "the model with its frames, angles and every dimension",
    "graph": "which link is joined to which",
    "solid": "the machine as it would be built",
    "planes": "the plane figures that the equations are read from",
    "flow": "the order in which a closed form computes",
    "solutions": "all assemblies at the same inputs",
    "serial": "a pose in which the platform loses a freedom",
    "parallel": "a pose in which the platform gains a freedom",
    "singular": "every other kind of singular configuration",
    "workspace": "where the platform gets, in space",
    "projections": "the workspace seen along its axes",
    "sections": "cuts of the workspace with their areas",
    "aspects": "the parts of the workspace without singularities",
    "parasitic": "what moves although the pose leaves it out",
    "dexterity": "a map of the condition index",
    "fastest": "a map of how fast the platform can be",
    "slowest": "a map of how fast it is at least",
    "transmission": "maps of motion and force transmission",
    "manipulability": "maps of condition and manipulability where lengths and angles mix",
    "indices": "maps of every index at once",
    "reactions": "the forces in the joints",
    "polytope": "which forces the actuators hold at a pose",
    "forces": "a map of the forces that they hold",
    "stiffness": "how it gives way, and which link does",
    "weakest": "a map of the least stiffness",
    "vibrations": "how it vibrates, and how fast",
    "accuracy": "which tolerance moves the platform most",
    "errors": "a map of the error of the pose",
}
"""Figure -> what it is wanted for, in the order of a study."""


def markdown(root: Path, mechanism: str, *others: str) -> str:
    """A table of tasks; `others` name the mechanisms of figures that this one lacks, as parasitic=three_rps."""
    own = dict.fromkeys(TASKS, mechanism) | dict(item.split("=") for item in others)
    pictures: dict[str, str] = {}
    for name in dict.fromkeys(own.values()):
        pictures |= gallery.places(root, name, tuple(figure for figure, of in own.items() if of == name))
    rows = "".join(
        f"* - {task}\n  - ```{{image}} {pictures[figure]}\n    :width: 140px\n    :alt: {task}\n    ```\n"
        f"  - `assur figures {own[figure]} --only {figure}`\n"
        for figure, task in TASKS.items()
    )
    return f"````{{list-table}}\n:header-rows: 1\n\n* - I want\n  - picture\n  - command\n{rows}````"
