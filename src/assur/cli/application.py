"""The application: its commands by groups, and what help says of all of them."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

from cyclopts import App, Group, Parameter

import assur
from assur.cli.exit_codes import MEANINGS
from assur.cli.output import console

_NOTE = f"""Negative numbers need no tricks. Angles are in the unit that the mechanism's file states. Exit codes:
{", ".join(f"{code} {meaning}" for code, meaning in MEANINGS.items())}."""

HELP = f"""From the topology of a parallel mechanism to its numbers, each with its proof.

{textwrap.fill(_NOTE, 78)}

For example:
    assur direct zeng2019 162.6907 -143.3209 -24.6776
    assur audit zeng2019"""


GROUPS = {
    "Mechanisms": ("list", "show", "check", "new", "schema"),
    "Topology": ("topology", "synthesize"),
    "Position": ("direct", "inverse", "derive", "follow", "sweep"),
    "Singularity, workspace, quality": ("singularity", "workspace", "aspects", "indices"),
    "Forces": ("forces", "dynamics", "stiffness", "errors", "identify", "calibrate"),
    "See it move": ("page", "view", "motion"),
    "Draw, write, build": ("figures", "report", "export", "collisions"),
    "Prove and check": ("certify", "verify", "crosscheck", "audit", "doctor", "cache", "demo"),
}
"""Commands as help lists them."""
COMMANDS = frozenset(name for names in GROUPS.values() for name in names)


def application(words: Sequence[str] = ()) -> App:
    """The application with every command; with one alone where words begin with it, as each costs its imports."""
    asked = words[0] if words and words[0] in COMMANDS else None
    app = App(
        name="assur",
        help=HELP,
        version=assur.__version__,
        help_format="plaintext",
        console=console(),
        default_parameter=Parameter(negative="", show_default=False),
    )
    for title, names in GROUPS.items():
        group = Group.create_ordered(title)
        for name in names:
            if asked in (None, name):
                app.command(_command(name), name=name, group=group)
    return app


def _command(name: str) -> Callable[..., Any]:
    """The function of a command: that of its name in the module of its name, `list_` where Python has the name."""
    module = vars(import_module(f"assur.cli.{name}"))
    command: Callable[..., Any] = module.get(f"{name}_") or module[name]
    return command
