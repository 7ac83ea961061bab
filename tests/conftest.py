"""What all tests share: a cache of their own, and what some need beyond a plain installation, by marker.

Tests whose need is not met are left out, and the end of the run says which; ASSUR_EXTRAS=required, as in continuous
integration, makes that an error before anything runs.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
from pathlib import Path

import pytest

os.environ.setdefault("ASSUR_CACHE", str(Path(__file__).parents[1] / "build" / "cache"))  # not the user's own

BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def installed(package):
    return importlib.util.find_spec(package) is not None


def chromium():
    """The path of a browser, or None."""
    return next((found for name in BROWSERS if (found := shutil.which(name))), None)


NEEDS = {
    "sim": (installed("mujoco"), "MuJoCo: pip install 'assur[sim]'"),
    "view": (installed("viser"), "viser: pip install 'assur[view]'"),
    "cad": (installed("OCP"), "Open CASCADE: pip install 'assur[cad]'"),
    "site": (installed("sphinx") and installed("myst_parser"), "Sphinx: pip install 'assur[docs]'"),
    "browser": (chromium() and installed("playwright"), "Chromium: apt install chromium, and pip install playwright"),
    "node": (shutil.which("node"), "Node: apt install nodejs"),
}
"""Marker -> whether what its tests need is there, and what that is."""

MISSING = {marker: what for marker, (present, what) in NEEDS.items() if not present}


def pytest_configure(config):
    if os.environ.get("ASSUR_EXTRAS") == "required" and MISSING:
        raise pytest.UsageError("ASSUR_EXTRAS=required, but there is not: " + "; ".join(MISSING.values()))


def pytest_collection_modifyitems(config, items):
    left = {item for item in items if any(item.get_closest_marker(marker) for marker in MISSING)}
    if left:
        config.hook.pytest_deselected(items=list(left))
        items[:] = [item for item in items if item not in left]


def pytest_terminal_summary(terminalreporter):
    for marker, what in MISSING.items():
        terminalreporter.write_line(f"NOT RUN: the tests marked {marker}; they need {what} (or make test ALL=yes)")


@pytest.fixture(scope="session")
def chromium_path():
    return chromium()


@pytest.fixture(scope="session")
def browser():
    """A running Chromium, driven by playwright."""
    from playwright.sync_api import sync_playwright

    flags = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
    with sync_playwright() as tool:
        found = tool.chromium.launch(executable_path=chromium(), args=flags)
        yield found
        found.close()
