"""The window without a browser: what its controls ask for, as a person would use them."""

import time
from types import SimpleNamespace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.closure import closure_error
from assur.view import overlays, player
from assur.view.guard import Guard
from assur.view.link import query
from assur.view.server import Served
from assur.view.snapshot import start, with_dial
from assur.view.window import Window

pytestmark = pytest.mark.view
SECONDS = 60.0
PERSON = object()


@pytest.fixture(scope="module")
def window():
    served = Served("127.0.0.1", 0, Guard.new(), [].append)
    found = Window(assur.load("fivebar"), served)
    yield found
    found.close()
    served.stop()


@pytest.fixture(autouse=True)
def at_home(window):
    """Every test begins at home, with nothing waiting and no layers."""
    window.overlays.clear()
    window.player.forget()
    _press(window._steps, "home")
    _wait(lambda: np.array_equal(window.snapshot.values, start(window.original).values))
    _wait(lambda: not window.worker.busy)


def _press(handle, value, client=PERSON):
    """A person's hand on a control: its value, then what is called when one sends it."""
    handle._impl.value = value
    for called in handle._impl.update_cb:
        called(SimpleNamespace(client=client, client_id=0, target=handle))


def _wait(holds):
    end = time.monotonic() + SECONDS
    while time.monotonic() < end and not holds():
        time.sleep(0.02)
    assert holds()


def test_a_slider_of_an_input_moves_it_and_the_platform_follows(window):
    _press(window._inputs[0], 120.0)
    _wait(lambda: abs(window.snapshot.inputs[0] - np.radians(120.0)) < 1e-9)
    poses = window.original.direct(window.snapshot.inputs).poses
    assert np.min(np.linalg.norm(poses - window.snapshot.pose, axis=-1)) < 1e-9
    _wait(lambda: abs(window._platform[1].value - window.snapshot.pose[1]) < window._platform[1].step)


def test_a_slider_that_is_moved_on_while_it_is_solved_is_not_set_back(window, monkeypatch):
    """The second step comes while the first one is drawn."""
    slider, seen = window._inputs[0], []
    moved = window.stage.move

    def move(record, values):
        moved(record, values)
        if not seen:
            _press(slider, 122.0)
        seen.append(float(slider.value))

    monkeypatch.setattr(window.stage, "move", move)
    monkeypatch.setattr(window, "explain", lambda *_: seen.append(float(slider.value)))  # comes after the sliders
    _press(slider, 121.0)
    _wait(lambda: abs(window.snapshot.inputs[0] - np.radians(122.0)) < 1e-9 and not window.worker.busy)
    assert set(seen) == {122.0}


def test_what_is_set_by_the_program_asks_for_nothing(window):
    before = window.snapshot
    _press(window._inputs[0], 120.0, client=None)
    time.sleep(0.3)
    assert window.snapshot is before


def test_a_limit_is_said_below_its_slider_and_nowhere_else(window):
    _press(window._platform[1], 300.0)
    _wait(lambda: window.notes["Platform y"].visible)
    said = window.notes["Platform y"].content
    assert "#c62828" in said
    assert "singularity" in said
    assert [name for name, note in window.notes.items() if note.visible] == ["Platform y"]
    _press(window._platform[1], 220.0)
    _wait(lambda: not window.notes["Platform y"].visible)


def test_undo_and_redo_of_a_dimension(window):
    _press(window._parameters["l1"], 110.0)
    _wait(lambda: window.snapshot.record.parameters["l1"].value == 110.0)
    _press(window._steps, "undo")
    _wait(lambda: window.snapshot.record.parameters["l1"].value == 100.0)
    _wait(lambda: window._parameters["l1"].value == 100.0)
    _press(window._steps, "redo")
    _wait(lambda: window.snapshot.record.parameters["l1"].value == 110.0)


def test_a_dimension_that_cannot_be_is_refused_in_words(window):
    _press(window._parameters["l1"], -3.0)
    _wait(lambda: window.notes["dimension"].visible)
    assert "a positive number in mm" in window.notes["dimension"].content
    _wait(lambda: window._parameters["l1"].value == 100.0)


def test_a_mode_of_the_list_and_a_ghost_become_current(window):
    _wait(lambda: window.settled > 0 and len(window._lists["inverse"].options) == 4)
    pose = window.snapshot.pose
    _press(window._lists["inverse"], "++")
    _wait(lambda: window.snapshot.modes[0] == "++")
    assert window.snapshot.pose == pytest.approx(pose, abs=1e-9)
    _wait(lambda: window.settled > 0)
    other = window.postures["direct"].others[0]
    window._ghost_clicked(0)
    _wait(lambda: window.snapshot.modes[1] == other.label)
    assert window.snapshot.values == pytest.approx(other.values)


def test_a_link_restores_and_a_wrong_one_changes_nothing(window):
    wanted = with_dial(start(assur.load("fivebar", l1=105.0)), 0, 12.0)
    window.restore(query(wanted))
    _wait(lambda: window.snapshot.record.parameters["l1"].value == 105.0)
    assert window.snapshot.values == pytest.approx(wanted.values, abs=1e-9)
    before = window.snapshot
    window.restore("mechanism=zeng2019&at=1")
    window.restore("websocket=ws://127.0.0.1/")
    _wait(lambda: not window.worker.busy)
    assert window.snapshot is before
    _wait(lambda: "set=l1" in window.keeper.line.value)
    assert window.keeper.line.value.startswith(window.served.url)


def _moves(window):
    return window.player.way is not None and not np.array_equal(window.snapshot.pose, start(window.original).pose)


def test_a_trajectory_plays_and_its_time_bar_moves_it(window):
    window.player.play()
    _wait(lambda: _moves(window))
    window.player.stop()
    _wait(lambda: not window.worker.busy)
    _press(window.player.time, 0.5)
    middle = window.player.way.at(0.5)
    _wait(lambda: np.array_equal(window.snapshot.values, middle))
    assert closure_error(window.original, middle) < 1e-7


def test_a_trajectory_that_cannot_be_planned_says_why_and_the_next_one_plays(window, monkeypatch):
    def barred(*_):
        raise UsageError("no way at all")

    with monkeypatch.context() as patch:
        patch.setattr(player, "around", barred)
        window.player.play()
        _wait(lambda: window.notes["trajectory"].visible)
        assert "no way at all" in window.notes["trajectory"].content
    window.player.play()
    _wait(lambda: _moves(window))
    assert not window.notes["trajectory"].visible


def test_a_trajectory_that_fails_by_a_bug_does_not_stop_the_next_one(window, monkeypatch):
    told = []
    monkeypatch.setattr(window.worker, "_failed", told.append)
    with monkeypatch.context() as patch:
        patch.setattr(player, "around", lambda _: 1 / 0)
        window.player.play()
        _wait(lambda: told)
    window.player.play()
    _wait(lambda: window.player.way is not None)
    assert [type(error) for error in told] == [ZeroDivisionError]


def test_what_is_pasted_and_no_link_is_told(window, monkeypatch):
    told = []
    monkeypatch.setattr(window.worker, "_failed", told.append)
    before = window.snapshot
    _press(window.keeper.line, "garbage")
    _wait(lambda: told)
    assert "no link of a view" in str(told[0])
    assert window.snapshot is before


def test_a_trajectory_that_stops_on_the_way_says_where_and_why_and_stands_there(window):
    """Straight up from home at y = 224 both legs are in line at 285.5, on the way to 300 and back."""
    window.player.waypoints = [np.array([0.0, 300.0])]
    window.player.play()
    _wait(lambda: window.player.button.label == "stop")
    _wait(lambda: window.player.button.label == "play" and not window.worker.busy)
    height = start(window.original).pose[1]
    share = (np.sqrt(294.0**2 - 70.0**2) - height) / (2 * (300.0 - height))
    assert window.player.time.value == pytest.approx(share, abs=1e-4)
    assert window.snapshot.pose == pytest.approx([0.0, np.sqrt(294.0**2 - 70.0**2)], abs=1e-2)
    note = window.notes["trajectory"]
    assert note.visible
    assert f"stopped at {100 * window.player.way.end:.3g} % of the way: serial singularity" in note.content
    assert "leg1 is 14.1 mm too short" in note.content
    window.player.play()  # anew, from its beginning
    _wait(lambda: window.player.time.value < 0.5 * share)
    assert window.player.button.label == "stop"


def test_a_time_after_the_stop_is_the_time_of_the_stop(window):
    window.player.waypoints = [np.array([0.0, 300.0])]
    window.player.play()
    _wait(lambda: window.player.way is not None)
    window.player.stop()
    _press(window.player.time, 0.9)
    _wait(lambda: window.notes["trajectory"].visible)
    assert window.player.time.value == window.player.way.end


def test_what_is_moved_by_hand_is_where_the_next_trajectory_begins(window):
    window.player.play()
    _wait(lambda: window.player.way is not None)
    window.player.stop()
    before = window.player.way
    _wait(lambda: not window.worker.busy)
    _press(window._platform[0], 30.0)
    _wait(lambda: abs(window.snapshot.pose[0] - 30.0) < 1e-6)
    window.player.play()
    _wait(lambda: window.player.way not in (None, before))
    assert window.original.point("P", window.player.way.at(0.0))[0] == pytest.approx(30.0)


def test_layers_come_as_boxes_that_show_and_hide_them(window):
    window.overlays.compute()
    _wait(lambda: window.overlays.boxes)
    labels = [box.label for box in window.overlays.boxes]
    assert labels[0] == "workspace of mode -+"
    assert all(":" not in label for label in labels)  # what a factor means stands in the hint
    box, node = window.overlays.boxes[0], window.stage._layers[0]
    assert node.visible
    assert window.overlays.height is None  # a plane region has no sections
    _press(box, False)
    assert not node.visible
    window.overlays.clear()
    assert window.overlays.boxes == []


def test_forces_are_shown_where_the_mechanism_rests_and_hidden_while_it_moves(window):
    _wait(lambda: window.settled > 1)
    _press(window.overlays.forces, True)
    _wait(lambda: "weight of the platform: 4.69 N" in window.overlays.told.content)  # told after they are drawn
    assert len(window.stage._at_rest) == 2
    before = window.overlays.told.content
    _press(window._inputs[0], 120.0)
    _wait(lambda: window.settled > 0 and window.overlays.told.content != before and len(window.stage._at_rest) == 2)
    assert all(node.opacity for node in window.stage._solids)
    _press(window.overlays.forces, False)
    _wait(lambda: window.stage._at_rest == [])
    assert not any(node.opacity for node in window.stage._solids)


def test_stiffness_and_the_slowest_vibration_are_shown_where_the_mechanism_rests(window):
    _wait(lambda: window.settled > 1)
    _press(window.overlays.stiffness, True)
    _wait(lambda: "stiffness here: " in window.overlays.told.content)
    assert len(window.stage._at_rest) == 1
    _press(window.overlays.vibration, True)
    _wait(lambda: "vibration here: " in window.overlays.told.content)
    assert len(window.stage._at_rest) == 2
    before = window.overlays.told.content
    _press(window._inputs[0], 120.0)
    _wait(lambda: window.settled > 0 and window.overlays.told.content != before and len(window.stage._at_rest) == 2)
    _press(window.overlays.stiffness, False)
    _press(window.overlays.vibration, False)
    _wait(lambda: window.stage._at_rest == [] and not window.overlays.told.visible)


def _endless(ticks):
    def region(record, mode, tick):
        while True:
            ticks.append(mode)
            tick(len(ticks) % 100, 100)
            time.sleep(0.01)

    return region


def test_layers_that_are_not_wanted_any_more_are_not_computed_on(window, monkeypatch):
    """Cancelled by the button, by other dimensions, and by the end of the window."""
    ticks = []
    monkeypatch.setattr(overlays, "region", _endless(ticks))
    ways_out = (window.overlays._pressed, lambda: _press(window._parameters["l1"], 105.0), window.overlays.clear)
    for way_out in ways_out:
        window.overlays._pressed()
        _wait(lambda: window.overlays.progress.visible and window.overlays.progress.value > 0)
        assert window.overlays.button.label == "cancel"
        way_out()
        _wait(lambda: not window.overlays.progress.visible)
        assert window.overlays.button.label == overlays.COMPUTE
        count = len(ticks)
        time.sleep(0.1)
        assert len(ticks) == count
    assert window.overlays.boxes == []


def test_layers_that_cannot_be_computed_say_why(window, monkeypatch):
    told = []
    monkeypatch.setattr(window, "failed", told.append)

    def barred(*_, **__):
        raise UsageError("no such mode")

    monkeypatch.setattr(overlays, "region", barred)
    window.overlays._pressed()
    _wait(lambda: told and window.overlays.button.label == overlays.COMPUTE)
    assert "no such mode" in str(told[0])
    monkeypatch.setattr(overlays, "region", lambda *_, **__: None)
    window.overlays._pressed()
    _wait(lambda: window.overlays.note.visible)
    assert "gives no [workspace] box" in window.overlays.note.content


def test_a_section_is_cut_at_the_height_that_is_asked_for():
    """Its outline against the area of the solid that is cut, by the shoelace formula; only the last wish is done."""
    served = Served("127.0.0.1", 0, Guard.new(), [].append)
    record = assur.load("tripteron")
    window = Window(record, served)
    try:
        window.overlays.compute()
        _wait(lambda: window.overlays.height is not None)
        low, high = record.box["z"]
        assert (window.overlays.height.min, window.overlays.height.max) == (low, high)
        for height in (low + 0.3 * (high - low), low + 0.6 * (high - low)):
            _press(window.overlays.height, height)
            _wait(lambda height=height: f"section z = {height:g} mm" in window.overlays.note.content)
            points = window.stage._section.points / window.stage.scale
            assert points[..., 2] == pytest.approx(np.full(points.shape[:2], height), abs=1e-3)
            (x1, y1), (x2, y2) = points[:, 0, :2].T, points[:, 1, :2].T
            area = 0.5 * abs(float(np.sum(x1 * y2 - x2 * y1)))
            wanted = assur.load("tripteron").workspace(resolution=32).section(height).area
            assert area == pytest.approx(wanted, rel=2e-3)
        _press(window.overlays.boxes[-1], False)
        _wait(lambda: window.stage._section is None)
        _press(window.overlays.boxes[-1], True)
        _wait(lambda: window.stage._section is not None)
        _press(window._parameters[next(iter(window._parameters))], 1.01 * next(iter(record.parameters.values())).value)
        _wait(lambda: window.overlays.height is None and window.stage._section is None)
    finally:
        window.close()
        served.stop()
