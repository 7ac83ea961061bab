"""What all tests share: a cache of their own, how many examples they draw, and what some need, by marker.

Tests whose need is not met are left out, and the end of the run says which; ASSUR_EXTRAS=required, as in continuous
integration, makes that an error before anything runs, and makes a run fail in which a test was skipped. What takes
minutes is left out unless `-m` asks for it, and the end of the run says how: `deep`, long walks, real kills and
thousands of mutations, `mutation`, faults put into the source, and `engines`, what other simulators read. The end of
a run also names its slowest files.
"""

import importlib.util
import os
import shutil
from collections import Counter
from ctypes.util import find_library
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

os.environ.setdefault("ASSUR_CACHE", str(Path(__file__).parents[1] / "build" / "cache"))  # not the user's own

# No example database: what a run draws depends on nothing that an earlier one left. Quick draws the same examples each
# time; deep draws others for each seed, which `make test-deep` prints. Either prints what replays a failing example.
settings.register_profile("quick", max_examples=50, derandomize=True, deadline=None, database=None, print_blob=True)
settings.register_profile(
    "deep",
    max_examples=2000,
    deadline=None,
    database=None,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],  # other work on the machine is no fault of a strategy
)
settings.load_profile("quick")

BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def installed(package):
    return importlib.util.find_spec(package) is not None


def chromium():
    """The path of a browser, or None."""
    return next((found for name in BROWSERS if (found := shutil.which(name))), None)


NEEDS = {
    "sim": (installed("mujoco"), "MuJoCo: pip install '.[sim]'"),
    "view": (installed("viser"), "viser: pip install '.[view]'"),
    "cad": (installed("OCP"), "Open CASCADE: pip install '.[cad]'"),
    "cluster": (installed("distributed"), "Dask: pip install '.[cluster]'"),
    "movie": (installed("imageio_ffmpeg"), "ffmpeg: pip install '.[movie]'"),
    "site": (installed("sphinx") and installed("myst_parser"), "Sphinx: pip install '.[docs]'"),
    "browser": (chromium() and installed("playwright"), "Chromium: apt install chromium, and pip install playwright"),
    "node": (shutil.which("node"), "Node: apt install nodejs"),
    "compiler": (shutil.which("gcc"), "a C compiler: apt install gcc"),
    "latex": (shutil.which("pdflatex"), "pdflatex: apt install texlive-latex-recommended"),
    "sdf": (find_library("sdformat12"), "libsdformat 12: apt install libsdformat12-12"),
}
"""Marker -> whether what its tests need is there, and what that is."""

MISSING = {marker: what for marker, (present, what) in NEEDS.items() if not present}
REQUIRED = os.environ.get("ASSUR_EXTRAS") == "required"
ASKED = {"mutation": "make mutations", "deep": "make test-deep", "engines": "make test-engines"}
"""Marker -> the command that runs its tests, which are left out unless `-m` names the marker."""
SLOWEST = 10
"""So many files are named at the end of a run of more than these."""

SKIPPED = []
"""Of this run: what was skipped by its own word."""
LEFT = Counter()
"""Of this run: how many tests were left out by each marker of `ASKED`."""
SECONDS = Counter()
"""Of this run: what the tests of each file took together."""


def pytest_configure(config):
    if REQUIRED and MISSING:
        raise pytest.UsageError("ASSUR_EXTRAS=required, but there is not: " + "; ".join(MISSING.values()))


def pytest_collection_modifyitems(config, items):
    asked = [marker for marker in ASKED if marker not in config.option.markexpr]
    left, kept = [], []
    for item in items:
        if marker := next((marker for marker in [*MISSING, *asked] if item.get_closest_marker(marker)), None):
            LEFT[marker] += marker in asked
            left.append(item)
        else:
            kept.append(item)
    if left:
        config.hook.pytest_deselected(items=left)
        items[:] = kept


def pytest_runtest_logreport(report):
    SECONDS[report.nodeid.split("::")[0]] += report.duration
    SKIPPED.extend([report.nodeid] if report.skipped and not hasattr(report, "wasxfail") else [])


def pytest_collectreport(report):
    SKIPPED.extend([report.nodeid] if report.skipped else [])


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node, error):
    """Every worker collects every test, so that each says what all left out."""
    for marker, count in getattr(node, "workeroutput", {}).get("left", {}).items():
        LEFT[marker] = count


def pytest_sessionfinish(session, exitstatus):
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["left"] = dict(LEFT)
    if REQUIRED and SKIPPED and exitstatus == pytest.ExitCode.OK:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter):
    if REQUIRED and SKIPPED:
        terminalreporter.write_line(f"SKIPPED, though ASSUR_EXTRAS=required: {', '.join(sorted(set(SKIPPED)))}")
    for marker, what in MISSING.items():
        terminalreporter.write_line(f"NOT RUN: the tests marked {marker}; they need {what} (or make test ALL=yes)")
    for marker, count in sorted(LEFT.items()):
        if count:
            terminalreporter.write_line(f"NOT RUN: {count} tests marked {marker}; they run with {ASKED[marker]}")
    if len(SECONDS) > SLOWEST:
        terminalreporter.section(f"the {SLOWEST} slowest of {len(SECONDS)} files, {sum(SECONDS.values()):.0f} s in all")
        for path, seconds in SECONDS.most_common(SLOWEST):
            terminalreporter.write_line(f"{seconds:8.1f} s  {path}")


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

    monkeypatch.setattr(interval_program, "_DONE", interval_program._Done(compilable=False))
