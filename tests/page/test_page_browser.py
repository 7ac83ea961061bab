"""The page in a real browser: it asks for nothing, complains of nothing, and moves as Python says."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest

from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.border import inputs_of
from assur.kinematics.closure import closure_error
from assur.kinematics.naming import mode_names
from assur.kinematics.pose import pose_of
from assur.mechanism import load
from assur.model.pose import is_angle
from catalogue import each
from pages import page_of, scene_of
from tabs import as_it_opened, load_page, look

pytestmark = pytest.mark.browser

NAMES = ("zeng2019", "linear_delta_4r", "fivebar", "planar_3rrr", "gough_stewart", "orthoglide")
MOVES = 3
SHARE = 0.15
"""How far an input or the platform is moved from home, as a share of its slider."""


@dataclass
class Shown:
    """A mechanism in a browser, and what came out of it."""

    record: Any
    scene: dict[str, Any]
    tab: Any
    address: str
    said: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)
    opened: str | None = None

    def call(self, name: str, *values: Any) -> dict[str, Any]:
        return self.tab.evaluate(f"(values) => window.assur.{name}(...values)", [list(map(float, v)) for v in values])

    def open(self) -> None:
        """The page as it opens: by going back to home, where that leaves what was loaded, else loaded anew."""
        if self.opened is not None and as_it_opened(self.tab, self.opened):
            return
        load_page(self.tab, self.address)
        self.opened = look(self.tab)

    def home(self) -> None:
        """Back to home by the way that it came, else by loading the page anew."""
        wanted = self.record.home_values
        state = self.call("toInputs", inputs_of(self.record, wanted))
        if state["reason"] is not None or not np.allclose(state["values"], wanted, rtol=0, atol=1e-6):
            self.open()
            assert np.array_equal(self.call("state")["values"], wanted)


@pytest.fixture(scope="module")
def shown(browser, tmp_path_factory):
    """Open the page of a mechanism from a file, once."""
    folder, tabs = tmp_path_factory.mktemp("pages"), {}

    def open_(name):
        if name not in tabs:
            record = load(name)
            found = scene_of(name)
            path = folder / f"{record.name}.html"
            path.write_text(page_of(name), encoding="utf-8")
            tab = browser.new_page(viewport={"width": 640, "height": 480})
            here = tabs[name] = Shown(record, found, tab, path.as_uri())
            tab.on("console", lambda message: here.said.append(f"{message.type}: {message.text}"))
            tab.on("pageerror", lambda error: here.said.append(f"error: {error}"))
            tab.on("request", lambda request: here.asked.append(request.url))
            here.open()
        return tabs[name]

    yield open_
    for item in tabs.values():
        item.tab.close()


def moves(ranges, home, rng):
    """Places around home, each a share of the sliders away from it."""
    span = np.ptp(np.array(ranges), axis=1)
    return home + rng.uniform(-SHARE, SHARE, size=(MOVES, len(home))) * span


@pytest.mark.parametrize("name", each(NAMES))
def test_it_opens_from_a_file_without_a_word_and_without_a_request(shown, name):
    here = shown(name)
    assert here.said == []
    own = ("data:", "blob:", "about:")
    assert {url for url in here.asked if not url.startswith(own)} == {here.address}
    state = here.call("state")
    assert np.allclose(state["values"], here.record.home_values, rtol=0, atol=1e-9)
    assert state["residual"] < 1e-10 * characteristic_length(here.record)


@pytest.mark.parametrize("name", each(NAMES))
def test_poses_at_random_inputs_are_those_of_direct_in_the_same_mode(shown, name, rng):
    here = shown(name)
    record, length = here.record, characteristic_length(here.record)
    home = np.array(inputs_of(record, record.home_values))
    compared = 0
    for target in moves([item["range"] for item in here.scene["inputs"]], home, rng):
        here.home()
        state = here.call("toInputs", target)
        path = record.follow(record.home_values, inputs=target)
        if state["reason"] is not None:
            assert path.stopped is not None
            continue
        # the page goes on where a working mode ends, for its sliders are to keep the assembly mode
        assert path.stopped is None or path.stopped.kind == "serial"
        compared += 1
        assert np.allclose(state["inputs"], target, rtol=0, atol=1e-9 * length)
        assert float(closure_error(record, np.array(state["values"]))) < 1e-9 * length
        found = record.direct(target)
        gaps = np.max(np.abs(found.poses - state["pose"]), axis=-1)
        gaps[~found.exists] = np.inf
        nearest = int(np.argmin(gaps))
        assert gaps[nearest] < 1e-9 * length
        if path.stopped is None:  # the same branch, followed a second time
            assert np.allclose(path.poses[-1], state["pose"], rtol=0, atol=1e-8 * length)
        signs = here.scene["branches"]["assembly"][0]["label"].partition("/")[0]
        assert str(found.labels[nearest]).startswith(signs if set(signs) <= {"+", "-"} else "")
    assert compared >= 1


@pytest.mark.parametrize("name", each(NAMES))
def test_inputs_at_random_poses_are_those_of_inverse_in_the_same_mode(shown, name, rng):
    here = shown(name)
    record, length = here.record, characteristic_length(here.record)
    home = pose_of(record, record.home_values)
    compared = 0
    for target in moves(here.scene["poseRange"], home, rng):
        if "qw" in record.platform.pose:
            target[3:] /= np.linalg.norm(target[3:])
        here.home()
        state = here.call("toPose", target)
        path = record.follow(record.home_values, poses=target)
        assert (state["reason"] is None) == (path.stopped is None)
        if state["reason"] is not None:
            continue
        compared += 1
        mode = here.scene["branches"]["working"][0]["label"].partition("/")[0]
        wanted = record.inverse(target, mode if mode and set(mode) <= {"+", "-"} else None)
        turned = [item["kind"] == "angle" for item in here.scene["inputs"]]
        gaps = np.array(state["inputs"]) - wanted.inputs[wanted.exists]
        gaps[:, turned] = (gaps[:, turned] + np.pi) % (2 * np.pi) - np.pi
        assert np.min(np.max(np.abs(gaps), axis=1)) < 1e-9 * length
    assert compared >= 1


def test_what_it_shows_is_what_python_says_there(shown):
    here = shown("zeng2019")
    here.home()
    state = here.call("toPose", [-15.4714, 9.6849, 456.3315])
    found = here.record.singularity(state["pose"], "++-++")
    assert state["factor"]["name"] == found.closest
    assert state["factor"]["value"] == pytest.approx(found.factors[found.closest], rel=1e-6)
    assert state["condition"] == pytest.approx(found.condition, rel=1e-6)


def test_it_stops_at_what_it_cannot_reach_and_says_why(shown):
    here = shown("zeng2019")
    here.home()
    state = here.call("toPose", [0.0, 0.0, 2000.0])
    assert state["reason"]["kind"] in ("gap", "singular", "limit", "stroke")
    assert len(state["reason"]["text"]) > 10
    assert state["residual"] < 1e-9 * characteristic_length(here.record)
    path = here.record.follow(here.record.home_values, poses=[0.0, 0.0, 2000.0])
    assert path.stopped is not None
    assert np.linalg.norm(path.poses[-1] - state["pose"]) < 5.0


def test_links_stand_where_python_puts_them(shown):
    here = shown("fivebar")
    here.home()
    state = here.call("toInputs", inputs_of(here.record, here.record.home_values) + np.array([0.1, -0.05]))
    placed = frames(here.record, np.array(state["values"]))
    rotation, origin = placed[here.record.platform.link]
    point = rotation @ here.record.platform.point + origin
    assert point[:2] == pytest.approx(state["pose"][:2], abs=1e-9)
    assert not any(map(is_angle, here.record.platform.pose))


def test_the_pressed_assembly_mode_is_that_of_the_working_mode_that_was_chosen(shown):
    here = shown("fivebar")
    pressed = "document.querySelector('[aria-label=\"Assembly modes\"] [aria-pressed=true]').textContent"
    for index in range(len(here.scene["branches"]["working"])):
        here.open()
        values = np.array(here.tab.evaluate("(index) => window.assur.work(index)", index)["values"])
        marked = " (home)" if index == 0 else ""
        assert here.tab.evaluate(pressed).replace("\u2212", "-") == mode_names(here.record, values)[1] + marked
    here.open()


def test_a_users_own_file_moves_too(shown, drafted):
    here = shown(drafted)
    assert here.said == []
    state = here.call("toInputs", inputs_of(here.record, here.record.home_values) + np.array([0.1, -0.05]))
    assert state["reason"] is None
    assert state["factor"] is None
    assert float(closure_error(here.record, np.array(state["values"]))) < 1e-9


def test_a_number_that_is_typed_is_kept_inside_its_slider_and_what_is_none_goes_back(shown):
    page = shown("zeng2019")
    page.open()
    box = page.tab.get_by_label("x in mm", exact=True)
    before = box.input_value()
    box.fill("")
    box.press("Enter")
    box.blur()
    assert box.input_value() == before
    low, high = page.scene["poseRange"][0]
    box.fill("-100000")
    box.press("Enter")
    page.tab.wait_for_function("(x) => window.assur.state().pose[0] < x - 1", arg=float(before))
    assert low <= page.call("state")["pose"][0] < high
    said = page.tab.locator(".slider", has=box).locator(".why")
    assert (said.text_content() or "").startswith("\N{MINUS SIGN}100000 is beyond this slider: ")
    page.open()


def test_a_decimal_comma_is_a_point(shown):
    page = shown("zeng2019")
    page.open()
    box = page.tab.get_by_label("x in mm", exact=True)
    box.fill("")
    box.press_sequentially("-12,5")
    box.press("Enter")
    assert page.call("state")["pose"][0] == pytest.approx(-12.5, abs=1e-9)
    page.open()


def test_the_closest_factor_is_told_as_a_share_of_its_scale(shown):
    page = shown("zeng2019")
    page.open()
    factor = page.call("state")["factor"]
    name = page.tab.locator(".numbers").get_by_text("closest factor", exact=True)
    text = name.locator("xpath=following-sibling::dd[1]").text_content() or ""
    shown_as = float(text.split()[-1].replace("\N{MINUS SIGN}", "-"))
    scale = {item["name"]: item["scale"] for item in page.scene["factors"]}[factor["name"]]
    assert shown_as == pytest.approx(factor["value"] / scale, rel=5e-3)


def test_a_factor_is_named_as_a_person_writes_it(shown):
    page = shown("zeng2019")
    page.open()
    labels = [item["label"] for item in page.scene["branches"]["working"]]
    page.tab.evaluate("(k) => window.assur.work(k)", labels.index("++---"))
    name = page.tab.locator(".numbers").get_by_text("closest factor", exact=True)
    row = name.locator("xpath=following-sibling::dd[1]")
    assert (row.text_content() or "").startswith("u1 \N{MINUS SIGN} u2")
    page.open()
