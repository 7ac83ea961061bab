"""How soon the page answers, in a real browser that draws without a graphics card: the limits that users were promised.

Every time is the best of some tries, and by the clock or by the processor's time that the browser took, whichever is
less: what else the machine does at that moment does not count. A page that only waits takes no processor's time, so the
clock has a limit too, five times as long.
"""

from __future__ import annotations

import os

import numpy as np
import pytest

from assur.mechanism import load
from assur.page.page import page_html, scene

pytestmark = [pytest.mark.browser, pytest.mark.slow]

NAMES = ("zeng2019", "h4_robot")
"""The example that everybody begins with, and the one with the most joint values."""

FIRST, ANSWER = 3000.0, 100.0
"""Milliseconds from the address to the first picture, and of the page from a slider to the picture that answers it."""

TRIES, MOVES = 6, 20
PATIENCE = 5
"""How many times as long as a limit the clock may show, on a machine that does other things too."""

DRAWN = "performance.getEntriesByName('assur-first-picture')[0].startTime"

MOVED = """([k, share]) => new Promise((done) => {
  const slider = [...document.querySelectorAll("[role=group].sliders input[type=range]")][k];
  const start = performance.now();
  slider.home ??= slider.valueAsNumber;
  slider.value = slider.home + share * (slider.max - slider.min);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
  const solved = performance.now() - start;
  requestAnimationFrame((frame) => done(solved + performance.now() - frame));
})"""


def counted(clock, busy):
    """Milliseconds that count: below a limit where either is, and the clock below `PATIENCE` times the limit."""
    return max(min(clock, busy), clock / PATIENCE)


@pytest.fixture(scope="module", params=NAMES)
def address(request, tmp_path_factory):
    """The address of a mechanism's page, as `assur page` writes it."""
    path = tmp_path_factory.mktemp("speed") / f"{request.param}.html"
    path.write_text(page_html(scene(load(request.param))), encoding="utf-8")
    return path.as_uri()


@pytest.fixture
def opened(browser, address):
    """Open the page anew, until its first picture is drawn; the tab, and the milliseconds until then."""
    tabs, machine = [], browser.new_browser_cdp_session()

    def busy():
        """Milliseconds that page and picture took of one processor; what draws them does so with all of them."""
        spent = {"renderer": 0.0, "GPU": 0.0}
        for item in machine.send("SystemInfo.getProcessInfo")["processInfo"]:
            if item["type"] in spent:
                spent[item["type"]] += 1000 * item["cpuTime"]
        return spent["renderer"] + spent["GPU"] / (os.cpu_count() or 1)

    def open_():
        tabs.append(browser.new_page(viewport={"width": 1100, "height": 700}))
        before = busy()
        tabs[-1].goto(address, wait_until="commit")
        tabs[-1].wait_for_selector("html[data-ready='1']", state="attached", timeout=60_000)
        clock = tabs[-1].evaluate(DRAWN)
        return tabs[-1], counted(clock, busy() - before)

    yield open_
    for tab in tabs:
        tab.close()


def test_the_heaviest_mechanism_is_measured():
    """By its number of joint values, which the time of a step grows with."""
    from assur.mechanism import names

    counts = {name: len(load(name).coordinates) for name in names()}
    assert counts[NAMES[1]] == max(counts.values())


def test_waiting_is_seen_and_other_work_is_not():
    assert counted(2000.0, 5.0) > ANSWER
    assert counted(4 * ANSWER, 0.9 * ANSWER) < ANSWER
    assert counted(0.9 * ANSWER, 4 * ANSWER) < ANSWER
    assert counted(1.1 * ANSWER, 1.1 * ANSWER) > ANSWER


def test_the_first_picture_comes_soon(opened):
    times = []
    for _ in range(TRIES):
        tab, now = opened()
        times.append(now)
        tab.close()
        if now < FIRST:
            break
    assert min(times) < FIRST, times


def answers(tab, shares):
    """Milliseconds of every move of one slider after another, as shares of its length from home.

    What the page does counts: it solves, says and hands over the picture. What draws it here is a processor.
    """
    tab.evaluate("window.assur.reset()")
    sliders = tab.locator("[role=group].sliders input[type=range]").count()
    return [tab.evaluate(MOVED, [k % sliders, share]) for k, share in enumerate(shares)]


@pytest.mark.parametrize("address", NAMES[:1], indirect=True)
def test_a_slider_is_answered_at_once(opened, rng):
    """Every answer, each the best of some tries: what a page does is the same every time, other work is not.

    Of the example that everybody begins with: the heaviest one takes minutes to be drawn so often by a processor alone.
    """
    shares = rng.uniform(-0.1, 0.1, size=MOVES + 1).tolist()
    tab, _ = opened()
    best = np.full(MOVES, np.inf)
    for _ in range(TRIES):
        best = np.minimum(best, answers(tab, shares)[1:])
        if max(best) < ANSWER:
            break
    assert max(best) < ANSWER, np.sort(best)
