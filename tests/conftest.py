"""What all tests share: a cache of their own, and those marked `sim` only where MuJoCo is installed."""

from __future__ import annotations

import importlib.util
import os
from pathlib import Path

import pytest

os.environ.setdefault("ASSUR_CACHE", str(Path(__file__).parents[1] / "build" / "cache"))  # not the user's own

PRESENT = importlib.util.find_spec("mujoco") is not None


def pytest_configure(config):
    """ASSUR_SIM=required, as in continuous integration: no run without MuJoCo."""
    if os.environ.get("ASSUR_SIM") == "required" and not PRESENT:
        raise pytest.UsageError("ASSUR_SIM=required, but MuJoCo is not installed: pip install 'assur[sim]'")


def pytest_collection_modifyitems(config, items):
    if PRESENT:
        return
    left = [item for item in items if item.get_closest_marker("sim")]
    if left:
        config.hook.pytest_deselected(items=left)
        items[:] = [item for item in items if not item.get_closest_marker("sim")]


def pytest_terminal_summary(terminalreporter):
    if not PRESENT:
        terminalreporter.write_line(
            "NOT RUN: the tests marked sim; MuJoCo is not installed (pip install 'assur[sim]', or make test SIM=yes)"
        )
