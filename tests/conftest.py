"""What all tests share: a cache of their own, and what some need beyond a plain installation, by marker.

Tests whose need is not met are left out, and the end of the run says which; ASSUR_EXTRAS=required, as in continuous
integration, makes that an error before anything runs, and makes a run fail in which a test was skipped. Faults put
into the source take minutes: they are left out unless `-m mutation` asks for them.
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
    "movie": (installed("imageio_ffmpeg"), "ffmpeg: pip install 'assur[movie]'"),
    "site": (installed("sphinx") and installed("myst_parser"), "Sphinx: pip install 'assur[docs]'"),
    "browser": (chromium() and installed("playwright"), "Chromium: apt install chromium, and pip install playwright"),
    "node": (shutil.which("node"), "Node: apt install nodejs"),
}
"""Marker -> whether what its tests need is there, and what that is."""

MISSING = {marker: what for marker, (present, what) in NEEDS.items() if not present}
REQUIRED = os.environ.get("ASSUR_EXTRAS") == "required"
SKIPPED = []
"""Of this run: what was skipped by its own word."""


def pytest_configure(config):
    if REQUIRED and MISSING:
        raise pytest.UsageError("ASSUR_EXTRAS=required, but there is not: " + "; ".join(MISSING.values()))


def pytest_collection_modifyitems(config, items):
    out = [*MISSING, *(() if "mutation" in config.option.markexpr else ("mutation",))]
    left = {item for item in items if any(item.get_closest_marker(marker) for marker in out)}
    if left:
        config.hook.pytest_deselected(items=list(left))
        items[:] = [item for item in items if item not in left]


def pytest_runtest_logreport(report):
    SKIPPED.extend([report.nodeid] if report.skipped and not hasattr(report, "wasxfail") else [])


def pytest_collectreport(report):
    SKIPPED.extend([report.nodeid] if report.skipped else [])


def pytest_sessionfinish(session, exitstatus):
    if REQUIRED and SKIPPED and exitstatus == pytest.ExitCode.OK:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter):
    if REQUIRED and SKIPPED:
        terminalreporter.write_line(f"SKIPPED, though ASSUR_EXTRAS=required: {', '.join(sorted(set(SKIPPED)))}")
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


@pytest.fixture
def by_numpy(monkeypatch):
    """Intervals are computed by NumPy alone: what a test changes there is what is computed with."""
    from assur.numerics.recording import interval_program

    monkeypatch.setattr(interval_program, "_DONE", interval_program._Done(there=False))
