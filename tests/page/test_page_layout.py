"""How the page lies on the screen: nothing over another, text that can be read, all of it by the keyboard."""

import re
from itertools import combinations

import numpy as np
import pytest

from catalogue import each

pytestmark = pytest.mark.browser

FAR = {
    "zeng2019": [0.0, 0.0, 2000.0],
    "fivebar": [0.0, 2000.0],
    "delta_4s": [0.0, 0.0, -9.0],
    "gough_stewart": [5.0, 0.8, 0.0, 0.5, 0.65, 0.0, -0.55],
}
LONG = {"zeng2019": {"l2": 281, "l3": 141, "l4": 181}}
"""Dimensions that make the lines under the title long."""

MINUS = "\N{MINUS SIGN}"

TEXTS = """() => {
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const found = [];
  while (walk.nextNode())
    if (!walk.currentNode.parentElement.closest("script, style, noscript")) found.push(walk.currentNode.textContent);
  return [...found, ...[...document.querySelectorAll("[title]")].map((item) => item.title)];
}"""

BOXES = """() => [".title", ".status", ".numbers", ".tools"].map((name) => {
  const {left, right, top, bottom} = document.querySelector(name).getBoundingClientRect();
  return {name, left, right, top, bottom};
})"""

CONTRAST = """() => {
  const parts = (text) => text.match(/[\\d.]+/g).map(Number);
  const over = ([r, g, b, a = 1], under) => [r, g, b].map((value, k) => a * value + (1 - a) * under[k]);
  const behind = (node) => {
    const colours = [];
    for (let it = node; it; it = it.parentElement) colours.push(parts(getComputedStyle(it).backgroundColor));
    return colours.reverse().reduce((under, colour) => over(colour, under), [255, 255, 255]);
  };
  const light = (colour) => {
    const even = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    const [r, g, b] = colour.map((value) => even(value / 255));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const weak = [];
  for (const node of document.querySelectorAll("body *")) {
    const own = [...node.childNodes].some((child) => child.nodeType === 3 && child.textContent.trim());
    if (!own || node.closest("script, style, svg, option, noscript") || !node.getClientRects().length) continue;
    const style = getComputedStyle(node);
    const ground = behind(node);
    const [a, b] = [light(over(parts(style.color), ground)), light(ground)].sort((x, y) => y - x);
    const ratio = (a + 0.05) / (b + 0.05);
    const name = `${node.className || node.tagName} "${node.textContent.slice(0, 30)}"`;
    if (ratio < 4.5) weak.push(`${name}: ${ratio.toFixed(2)}`);
  }
  return weak;
}"""


SIZES = [(900, 600), (1300, 800), (821, 560), (780, 390), (640, 480), (390, 800), (360, 640)]


@pytest.mark.parametrize("name", ["zeng2019", "delta_4s"])
def test_nothing_covers_anything_at_a_stop(opened, name):
    """Whatever the window's size. What a page looks like depends on it by its style alone, but for the open numbers."""
    tab = opened(name, **LONG.get(name, {}))
    assert tab.evaluate("(pose) => window.assur.toPose(pose).reason !== null", FAR[name])
    for width, height in SIZES:
        tab.set_viewport_size({"width": width, "height": height})
        for open_ in (True, False):
            tab.evaluate("(on) => (document.querySelector('.numbers').open = on)", open_)
            assert tab.evaluate("[innerWidth, innerHeight]") == [width, height]
            nothing_is_covered(tab, width)
    tab.set_viewport_size({"width": SIZES[0][0], "height": SIZES[0][1]})


def nothing_is_covered(tab, width):
    boxes = tab.evaluate(BOXES)
    stage = tab.locator(".stage").bounding_box()
    for box in boxes:
        assert box["right"] - box["left"] > 20
        assert box["bottom"] - box["top"] > 15
        assert box["left"] >= stage["x"]
        assert box["right"] <= stage["x"] + stage["width"] + 0.5
        assert box["top"] >= stage["y"]
        assert box["bottom"] <= stage["y"] + stage["height"] + 0.5
    for one, other in combinations(boxes, 2):
        apart = (
            one["right"] <= other["left"]
            or other["right"] <= one["left"]
            or one["bottom"] <= other["top"]
            or other["bottom"] <= one["top"]
        )
        assert apart, (one, other)
    assert tab.evaluate("document.documentElement.scrollWidth") <= width


@pytest.mark.parametrize("name", each(FAR, ["zeng2019", "gough_stewart"]))
def test_minus_signs_are_true_ones_wherever_a_person_reads(opened, name):
    tab = opened(name)
    tab.evaluate("(pose) => window.assur.toPose(pose)", FAR[name])
    tab.evaluate("window.assur.choose(1)")
    texts = tab.evaluate(TEXTS)
    assert [text for text in texts if re.search(r"(?<![^\s(=<>≈])-[\d.]|(?<!\S)[+-]*-[+-]+(?!\S)", text)] == []
    assert any(MINUS in text for text in texts)
    typed = tab.locator("input[type=number]").evaluate_all("(all) => all.map((it) => it.value)")
    assert all(np.isfinite(float(text)) for text in typed)
    assert MINUS not in "".join(typed)


def test_the_keyboard_reaches_everything_and_shows_where_it_is(opened):
    tab = opened("fivebar")
    tab.locator("body").click(position={"x": 5, "y": 5})
    seen = []
    for _ in range(60):
        tab.keyboard.press("Tab")
        here = tab.evaluate(
            "() => {const it = document.activeElement; const style = getComputedStyle(it);"
            "return [it.ariaLabel || it.labels?.[0]?.textContent || it.textContent, style.outlineStyle,"
            "parseFloat(style.outlineWidth), it === document.body]}"
        )
        if here[3] or here[:3] in seen:
            break
        seen.append(here[:3])
    names = [name for name, *_ in seen]
    assert {"Numbers", "Reset (r)", "Keys (?)", "Move", "θ1", "theta1 in °", "x", "y in mm"} <= set(names)
    assert {"Course", "Play", "Time"} <= set(names)
    assert all(style != "none" and wide >= 2 for _, style, wide in seen), seen
    tab.get_by_role("tab", name="Move").focus()
    tab.keyboard.press("End")
    tab.keyboard.press("Tab")
    assert tab.evaluate("document.activeElement.id") == "page-facts"


@pytest.mark.parametrize("dark", [False, True])
def test_text_is_dark_enough_on_what_is_behind_it(opened, dark):
    tab = opened("zeng2019", dark=dark, l2=300)
    tab.evaluate("window.assur.toPose([0, 0, 2000])")
    for name in ("Move", "Show", "Facts"):
        tab.get_by_role("tab", name=name).click()
        tab.mouse.move(5, 5)
        assert tab.evaluate(CONTRAST) == []


def test_a_folded_panel_unfolds_where_a_tab_is_chosen(opened):
    tab = opened("fivebar", width=390, height=800)
    tab.get_by_label("Fold the panel").click()
    assert not tab.locator("#page-move").is_visible()
    tab.get_by_role("tab", name="Facts").click()
    assert tab.locator("#page-facts").is_visible()
    assert tab.get_by_label("Fold the panel", exact=True).get_attribute("aria-expanded") == "true"
