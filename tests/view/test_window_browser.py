"""The live view in a real browser: what it shows is what Python computes."""

import pathlib
import time

import pytest

import assur
from assur.view.guard import Guard
from assur.view.server import Served
from assur.view.window import Window

pytestmark = [pytest.mark.browser, pytest.mark.view]
SECONDS = 120
PICTURES = pathlib.Path(__file__).parents[2] / "build" / "view"


@pytest.fixture(scope="module")
def shown():
    """A window of the five-bar, ended in any case."""
    windows: list[Window] = []

    def opened(query: str) -> None:
        for window in windows:
            window.restore(query)

    served = Served("127.0.0.1", 0, Guard.new(), opened)
    windows.append(Window(assur.load("fivebar"), served))
    yield windows[0]
    windows[0].close()
    served.stop()


@pytest.fixture
def faults():
    """What a page complains of."""
    return []


def _opened(browser, window, faults, query=""):
    page = browser.new_page(viewport={"width": 900, "height": 700})
    page.on("console", lambda said: faults.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("request", lambda asked: None if _own(asked.url, window) else faults.append(asked.url))
    page.goto(window.served.url + query)
    page.wait_for_selector("text=residual", timeout=1000 * SECONDS)
    return page


def _own(url, window):
    return url.startswith((window.served.url, "data:", "blob:"))


def _number(page, name):
    row = page.locator("table.assur tr", has=page.locator(f"td:text-is('{name}')"))
    return float(row.locator("b").inner_text(timeout=1000 * SECONDS).split()[0])


def _until(page, name, wanted, within=1e-3):
    end = time.monotonic() + SECONDS
    while time.monotonic() < end and abs(_number(page, name) - wanted) > within:
        time.sleep(0.2)
    assert _number(page, name) == pytest.approx(wanted, abs=within)


def _wait(holds):
    end = time.monotonic() + SECONDS
    while time.monotonic() < end and not holds():
        time.sleep(0.2)
    assert holds()


def test_a_slider_moves_the_mechanism_as_python_does(shown, in_browser, faults):
    """Sliders in the order of the page: two inputs, x, y. Keys move them by steps; then a link brings home back."""
    record = shown.original
    home = shown.snapshot.pose

    def body(browser):
        page = _opened(browser, shown, faults)
        sliders = page.get_by_role("slider")
        steps = shown._platform[0].step
        for _ in range(3):
            sliders.nth(2).press("ArrowRight", timeout=1000 * SECONDS)
        _wait(lambda: shown.snapshot.pose[0] > home[0] + 2.5 * steps)
        there = shown.snapshot.pose
        _until(page, "x", there[0])
        found = record.inverse(there, "-+").inputs[0]
        for name, value in zip(("theta1", "theta2"), found, strict=True):
            _until(page, name, value * 180 / 3.141592653589793)
        PICTURES.mkdir(parents=True, exist_ok=True)
        page.screenshot(path=PICTURES / "fivebar.png", timeout=1000 * SECONDS)

    in_browser(body)
    assert faults == []
    assert (PICTURES / "fivebar.png").stat().st_size > 20_000


def test_a_link_restores_and_a_limit_is_said_in_red(shown, in_browser, faults):
    record = shown.original
    other = record.direct(record.direct([2.0, 1.0]).given, "-").joints[0]
    query = f"?mechanism=fivebar&at={','.join(repr(float(value)) for value in other)}"

    def body(browser):
        page = _opened(browser, shown, faults, query)
        _until(page, "theta1", 2.0 * 180 / 3.141592653589793)
        _wait(lambda: shown.snapshot.modes[1] == "-")
        box = page.get_by_role("textbox").nth(3)  # y, beside its slider
        box.fill("260", timeout=1000 * SECONDS)
        red = page.get_by_role("alert").filter(has_text="singularity")
        red.wait_for(timeout=1000 * SECONDS)
        assert red.inner_text() == str(shown.snapshot.reason)
        page.screenshot(path=PICTURES / "fivebar-limit.png", timeout=1000 * SECONDS)

    in_browser(body)
    assert faults == []
