"""The controls of the page in a real browser: what a link keeps, sliders that hold their values, courses, copies."""

import re
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest

from assur.cli.pose_table import table, timed_poses
from assur.kinematics.naming import described_signs
from assur.machine.dynamics.prescribed_motion import sampled
from assur.mechanism import load
from catalogue import each

pytestmark = pytest.mark.browser

NAMES = ("zeng2019", "fivebar", "delta_4s", "gough_stewart", "planar_3rrr")
MINUS = "\N{MINUS SIGN}"
SLIDERS = """() => [...document.querySelectorAll(".slider")].map((row) => {
  const [range, number] = row.querySelectorAll("input");
  const ends = [...row.querySelectorAll(".ends span")].map((item) => item.textContent);
  return {name: number.ariaLabel, low: Number(range.min), high: Number(range.max), at: range.valueAsNumber,
          value: number.valueAsNumber, ends: [ends[0], ends[2]]};
})"""


def wait_for_link(page, **wanted):
    """Wait until the address says so."""
    page.wait_for_function(
        "(wanted) => {const now = new URLSearchParams(location.hash.slice(1));"
        "return Object.entries(wanted).every(([name, value]) => now.get(name) === value)}",
        arg=wanted,
    )


def chosen(tab):
    """Everything that a link keeps, as the page shows it."""
    return {
        "tab": tab.locator("[role=tab][aria-selected=true]").text_content(),
        "course": tab.locator("select").evaluate("(it) => it.selectedIndex"),
        "boxes": tab.locator(".check input").evaluate_all("(all) => all.map((it) => it.checked)"),
        "pose": [round(value, 3) for value in tab.evaluate("window.assur.state().pose")],
    }


def test_a_link_brings_back_layers_tab_course_and_check_boxes(opened):
    tab = opened("zeng2019")
    tab.get_by_label("Course", exact=True).select_option(index=2)
    tab.evaluate("window.assur.toPose([-20, 5, 450])")
    tab.get_by_role("tab", name="Show").click()
    for name in ("Letters", "Stop at strokes and joint limits", "Ghosts of the other assembly modes"):
        tab.get_by_label(name).uncheck()
    boxes = tab.locator("#page-show .check input")
    boxes.nth(1).check()
    tab.get_by_role("tab", name="Facts").click()
    wait_for_link(tab, tab="facts", course="2", layers="1", ghosts="0", letters="0", limits="0")
    there = opened("zeng2019", at=tab.url)
    assert chosen(there) == chosen(tab)
    assert chosen(there)["boxes"].count(True) == 1
    # what the boxes say is so
    assert there.evaluate("window.assur.toPose([-20, 5, 450]).reason") is None
    there.wait_for_timeout(1000)  # longer than it takes to write the address anew
    again = parse_qs(urlsplit(there.url).fragment, keep_blank_values=True)
    assert again["view"] == parse_qs(urlsplit(tab.url).fragment)["view"]


def test_a_tab_that_the_keyboard_chose_is_kept_too(opened):
    tab = opened("fivebar")
    tab.get_by_role("tab", name="Move").focus()
    tab.keyboard.press("End")
    wait_for_link(tab, tab="facts")
    tab.keyboard.press("Home")
    wait_for_link(tab, tab="move")


def test_an_old_link_and_nonsense_leave_everything_else_as_it_is(opened):
    plain = chosen(opened("fivebar"))
    wait = opened("fivebar")
    wait.evaluate("window.assur.toPose([10, 200])")
    wait_for_link(wait, tab="move")
    old = re.sub(r"&tab=.*", "", wait.url)
    assert "joints=" in old
    assert chosen(opened("fivebar", at=old)) == {**plain, "pose": [10, 200]}
    nonsense = "#tab=constructor&course=99&layers=7,x&ghosts=maybe&letters=&limits=2&view=0,0,1&%%%"
    assert chosen(opened("fivebar", at=nonsense)) == plain


@pytest.mark.parametrize("name", each(NAMES, NAMES[:2]))
def test_every_slider_holds_its_value_in_every_mode(opened, name):
    tab = opened(name)
    read = lambda text: float(text.replace(MINUS, "-"))  # noqa: E731
    for kind in ("choose", "work"):
        for index in range(8):
            tab.evaluate("([kind, index]) => window.assur[kind](index)", [kind, index])
            state = tab.evaluate("window.assur.state()")
            for item in tab.evaluate(SLIDERS):
                slack = 2e-3 * (item["high"] - item["low"])
                assert item["low"] - slack <= item["value"] <= item["high"] + slack, (kind, index, item)
                assert item["at"] == pytest.approx(item["value"], abs=slack)
                for text, end in zip(item["ends"], (item["low"], item["high"]), strict=True):
                    assert read(text) == pytest.approx(end, rel=1e-3, abs=slack)
            assert state["residual"] < 1e-9 * max(1.0, *map(abs, state["values"]))
        tab.evaluate("window.assur.reset()")


def test_a_typed_angle_is_wrapped_into_its_slider(opened):
    tab = opened("fivebar")
    home = tab.evaluate("window.assur.state().inputs")
    box = tab.get_by_label("theta1 in °", exact=True)
    start = float(box.input_value())
    box.fill(str(start + 360 + 5))
    box.press("Enter")
    assert float(box.input_value()) == pytest.approx(start + 5, abs=0.01)
    moved = tab.evaluate("window.assur.state().inputs")
    assert moved[0] - home[0] == pytest.approx(5 * 3.141592653589793 / 180, abs=1e-4)


def test_arrow_keys_move_a_slider_by_round_steps(opened):
    tab = opened("zeng2019")
    slider = tab.locator(".slider input[type=range]").nth(0)
    slider.focus()
    before = tab.evaluate(SLIDERS)[0]
    values = []
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft", "PageUp"):
        tab.keyboard.press(key)
        values.append(tab.evaluate(SLIDERS)[0]["value"])
    step = values[1] - values[0]
    assert 0 < step <= (before["high"] - before["low"]) / 100 + 1e-9
    assert values[0] / step == pytest.approx(round(values[0] / step), abs=1e-6)
    assert before["value"] < values[0] <= before["value"] + step + 1e-6
    assert values[2] == pytest.approx(values[0])
    assert values[3] == pytest.approx(values[2] + 10 * step)
    assert slider.get_attribute("aria-valuetext").endswith(" mm")


def test_a_course_says_its_size_and_keeps_to_it(opened):
    tab = opened("zeng2019")
    first = tab.locator("select option").nth(0)
    assert re.fullmatch(r"circle in y and z, radius [125]0* mm", first.text_content())
    start = tab.evaluate("window.assur.state().pose")
    radius = float(first.text_content().split()[-2])
    tab.get_by_role("button", name="Play").click()
    tab.wait_for_function("(y) => Math.abs(window.assur.state().pose[1] - y) > 1", arg=start[1])
    tab.get_by_role("button", name="Pause").click()
    pose = tab.evaluate("window.assur.state().pose")
    assert sum((a - b) ** 2 for a, b in zip(pose, start, strict=True)) ** 0.5 <= 2 * radius + 1e-6


def test_a_course_begins_where_it_stands_though_its_first_frame_is_older_than_the_button_pressed(opened):
    tab = opened("fivebar")
    tab.evaluate(
        "() => {const plain = window.plainFrame = window.requestAnimationFrame.bind(window);"
        "window.requestAnimationFrame = (call) => plain((now) => call(now - 2000))}"
    )
    start = tab.evaluate("window.assur.state().pose")
    tab.get_by_role("button", name="Play").click()
    tab.wait_for_function("(pose) => window.assur.state().pose.some((it, k) => it !== pose[k])", arg=start)
    tab.get_by_role("button", name="Pause").click()
    assert 0 < float(tab.get_by_label("Time", exact=True).input_value()) < 1
    tab.evaluate("() => {window.requestAnimationFrame = window.plainFrame}")


def test_a_recorded_motion_is_a_table_that_dynamics_reads(opened, tmp_path):
    tab = opened("zeng2019")
    record, poses = load("zeng2019"), [tab.evaluate("window.assur.state().pose")]
    save = tab.get_by_role("button", name="Save as CSV")
    assert save.is_disabled()
    tab.get_by_role("button", name="Record").click()
    for step in range(1, 6):
        poses.append([poses[0][0] - step, poses[0][1] + step, poses[0][2] - 5 * step])
        assert tab.evaluate("(pose) => window.assur.toPose(pose).reason", poses[-1]) is None
        tab.wait_for_timeout(20)
    tab.get_by_role("button", name="Stop").click()
    tab.evaluate("window.assur.toPose([0, 0, 400])")  # no longer recorded
    with tab.expect_download() as saved:
        save.click()
    path = tmp_path / saved.value.suggested_filename
    saved.value.save_as(path)
    times, read = timed_poses(record, str(path))
    assert (path.name, len(times)) == ("zeng2019-motion.csv", 6)
    assert np.allclose(read, poses, rtol=0.0, atol=1e-6)
    assert times[0] == 0.0
    assert np.all(np.diff(times) > 0.0)
    names, rows = table(record, str(path))
    inputs = rows[:, [names.index(item.name) for item in record.inputs]]
    gaps = np.abs(record.inverse(read).inputs - inputs[:, None])
    assert np.all(np.min(np.max(np.nan_to_num(gaps, nan=np.inf), axis=-1), axis=-1) < 1e-6)
    sampled(record, times, read)


def test_sliders_change_dimensions_and_a_link_keeps_them(opened):
    tab = opened("fivebar")
    home = tab.evaluate("window.assur.state()")
    tab.get_by_text("Dimensions", exact=True).first.click()
    box = tab.get_by_label("l2 in mm", exact=True)
    box.fill("200")
    box.press("Enter")
    moved = tab.evaluate("window.assur.state()")
    wanted = load("fivebar", l2=200).direct(home["inputs"])
    assert np.allclose(moved["inputs"], home["inputs"], rtol=0.0, atol=1e-9)
    assert min(np.max(np.abs(own.pose - moved["pose"])) for own in wanted) < 1e-6
    assert "--set l2=200" in tab.locator(".sizes p").last.text_content()
    wait_for_link(tab, tab="move")
    tab.wait_for_function("() => location.hash.includes('sizes=')")
    there = opened("fivebar", at=tab.url)
    assert np.allclose(there.evaluate("window.assur.state().pose"), moved["pose"], rtol=0.0, atol=1e-3)
    assert there.evaluate("window.assur.resized")
    box.fill("40")  # shorter than half of what they span
    box.press("Enter")
    assert float(box.input_value()) > 40
    assert "parallel singularity" in tab.locator(".slider.stopped .why").last.text_content()
    tab.keyboard.press("Escape")
    tab.evaluate("document.activeElement.blur()")
    tab.keyboard.press("r")
    assert not tab.evaluate("window.assur.resized")
    tab.get_by_text("Dimensions", exact=True).first.click()


def test_a_stop_is_said_once_and_modes_say_what_their_signs_mean(opened):
    tab = opened("three_upu")
    tab.evaluate("window.assur.toPose([0, 0, 1000])")
    said = [text for text in tab.locator(".slider .why").all_text_contents() if text]
    assert len(said) == 1
    assert tab.locator(".slider.stopped").count() == 1
    tab.wait_for_function("() => Number(getComputedStyle(document.querySelector('.status')).opacity) < 0.1")
    assert tab.locator(".status").text_content() == said[0]
    tab.get_by_role("tab", name="Show").click()  # where no slider says it
    tab.wait_for_function("() => Number(getComputedStyle(document.querySelector('.status')).opacity) > 0.9")
    titles = tab.locator("[aria-label='Working modes'] button").evaluate_all("(all) => all.map((it) => it.title)")
    meanings = [sign.said for sign in described_signs(load("three_upu"), "inverse")]
    assert all(title.split("\n")[1:] == meanings for title in titles)
    assert meanings


def test_a_lost_context_comes_back(opened):
    tab = opened("fivebar")
    lost = """() => {
      const canvas = document.querySelector("canvas");
      const own = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
      window.plainLog = console.log;
      console.log = () => {};  // three.js says that it was lost, and that it is back
      const back = new Promise((done) => canvas.addEventListener("webglcontextrestored", () =>
        requestAnimationFrame(() => requestAnimationFrame(() => done(!canvas.getContext("webgl2").isContextLost())))));
      own.loseContext();
      setTimeout(() => own.restoreContext(), 50);
      return back;
    }"""
    assert tab.evaluate(lost)
    assert tab.evaluate("window.assur.toPose([10, 210]).reason") is None
    tab.evaluate("() => {console.log = window.plainLog}")


def test_slow_pictures_leave_shadows_out(opened, address):
    """Of a clock that goes 100 ms on from picture to picture."""
    tab = opened("fivebar", at=address("fivebar"))
    slow = """async (late) => {
      const plain = performance.now.bind(performance);
      let gone = 0;
      performance.now = () => plain() + gone;
      for (let k = 0; k < 16; k++) {
        window.assur.toPose([k % 2, 210]);
        gone += late;
        await new Promise(requestAnimationFrame);
      }
      performance.now = () => plain() + gone;
      return document.querySelector("canvas").dataset.shadows ?? "";
    }"""
    assert tab.evaluate(slow, 1000) == ""  # each stands still before the next
    assert tab.evaluate(slow, 100) == "false"


def test_a_course_that_cannot_be_followed_says_why(opened):
    tab = opened("three_upu")
    reason = tab.evaluate("window.assur.toPose([0, 0, 1000]).reason")
    assert reason["kind"] == "stroke"
    tab.get_by_role("button", name="Play").click()
    note = tab.locator(".player p").text_content()
    assert re.fullmatch(r"It cannot be followed from here: stroke of \S+ ends here\.", note)
    assert tab.get_by_role("button", name="Play").is_visible()


def test_the_current_working_mode_stays_marked_while_it_moves(opened):
    tab = opened("delta_4s")
    marked = tab.locator("[aria-label='Working modes'] [aria-pressed=true]")
    name = marked.text_content()
    for pose in ([0.1, 0.2, -0.9], [-0.3, 0.1, -1.0], [0.4, -0.4, -0.8], [0.0, 0.6, -0.9], [0.0, 0.0, -1.1]):
        assert tab.evaluate("(pose) => window.assur.toPose(pose).reason", pose) is None
        assert marked.count() == 1
        tab.wait_for_timeout(400)
        assert marked.count() == 1
        assert marked.text_content() == name


def test_a_working_mode_that_is_not_listed_is_said_to_be_none_of_them(opened):
    tab = opened("zeng2019")
    note = tab.get_by_text("It stands in none of these")
    assert not note.is_visible()
    labels = [
        item["label"] for item in tab.evaluate("JSON.parse(document.getElementById('scene').text).branches.working")
    ]
    for index in range(4):
        tab.evaluate("(index) => window.assur.choose(index)", index)
        tab.wait_for_timeout(1500)
        state = tab.evaluate("window.assur.state()")
        here = load("zeng2019").inverse(state["pose"])
        gaps = np.max(np.abs(here.inputs - state["inputs"]), axis=-1)
        gaps[~here.exists] = np.inf
        listed = str(here.labels[np.argmin(gaps)]) in labels
        assert note.is_visible() != listed
        assert tab.locator("[aria-label='Working modes'] [aria-pressed=true]").count() == int(listed)


def test_another_dimension_is_told_under_the_title_and_in_the_table(opened):
    tab = opened("zeng2019", l2=300)
    assert tab.locator(".title p").text_content() == "zeng2019: with l2 = 300 (its file: 280)"
    tab.get_by_role("tab", name="Facts").click()
    assert "its file: 280" in tab.locator("tr.differs").text_content()
    assert tab.locator("tr.differs").count() == 1
    assert tab.locator(".errata").count() == 0
    assert "l2 = 300" in tab.get_by_text("Those of the source are left out").text_content()
    plain = opened("zeng2019")
    assert plain.locator(".title p").text_content() == "zeng2019"
    assert plain.locator("tr.differs").count() == 0
    assert plain.locator(".errata li").count() > 5


def test_the_nearest_singularity_is_looked_for_once_its_number_is_seen(opened):
    tab = opened("fivebar", width=390, height=800)
    name = tab.locator(".numbers").get_by_text("to a singularity", exact=True)
    number = name.locator("xpath=following-sibling::dd[1]")
    tab.wait_for_timeout(400)  # three times as long as it rests before it looks
    assert number.text_content() == "\N{HORIZONTAL ELLIPSIS}"
    tab.locator(".numbers summary").click()
    number.filter(has_text=re.compile(r"\d")).wait_for()
