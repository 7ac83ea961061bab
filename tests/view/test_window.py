"""The window without a browser: what its controls ask for, as a person would use them."""

import time
from types import SimpleNamespace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.closure import closure_error
from assur.view import player
from assur.view.guard import Guard
from assur.view.link import query
from assur.view.server import Served
from assur.view.state import start, with_dial
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
    """Every test begins at home, with nothing waiting."""
    window.player.forget()
    _press(window._steps, "home")
    _wait(lambda: np.array_equal(window.state.values, start(window.original).values))
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
    _wait(lambda: abs(window.state.inputs[0] - np.radians(120.0)) < 1e-9)
    poses = window.original.direct(window.state.inputs).poses
    assert np.min(np.linalg.norm(poses - window.state.pose, axis=-1)) < 1e-9
    _wait(lambda: abs(window._platform[1].value - window.state.pose[1]) < window._platform[1].step)


def test_what_is_set_by_the_program_asks_for_nothing(window):
    before = window.state
    _press(window._inputs[0], 120.0, client=None)
    time.sleep(0.3)
    assert window.state is before


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
    _wait(lambda: window.state.record.parameters["l1"].value == 110.0)
    _press(window._steps, "undo")
    _wait(lambda: window.state.record.parameters["l1"].value == 100.0)
    _wait(lambda: window._parameters["l1"].value == 100.0)
    _press(window._steps, "redo")
    _wait(lambda: window.state.record.parameters["l1"].value == 110.0)


def test_a_dimension_that_cannot_be_is_refused_in_words(window):
    _press(window._parameters["l1"], -3.0)
    _wait(lambda: window.notes["dimension"].visible)
    assert "a positive number in mm" in window.notes["dimension"].content
    _wait(lambda: window._parameters["l1"].value == 100.0)


def test_a_mode_of_the_list_and_a_ghost_become_current(window):
    _wait(lambda: window.settled > 0 and len(window._lists["inverse"].options) == 4)
    pose = window.state.pose
    _press(window._lists["inverse"], "++")
    _wait(lambda: window.state.modes[0] == "++")
    assert window.state.pose == pytest.approx(pose, abs=1e-9)
    _wait(lambda: window.settled > 0)
    other = window.found["direct"].others[0]
    window._ghost_clicked(0)
    _wait(lambda: window.state.modes[1] == other.label)
    assert window.state.values == pytest.approx(other.values)


def test_a_link_restores_and_a_wrong_one_changes_nothing(window):
    wanted = with_dial(start(assur.load("fivebar", l1=105.0)), 0, 12.0)
    window.restore(query(wanted))
    _wait(lambda: window.state.record.parameters["l1"].value == 105.0)
    assert window.state.values == pytest.approx(wanted.values, abs=1e-9)
    before = window.state
    window.restore("mechanism=zeng2019&at=1")
    window.restore("websocket=ws://127.0.0.1/")
    _wait(lambda: not window.worker.busy)
    assert window.state is before
    _wait(lambda: "set=l1" in window.keeper.line.value)
    assert window.keeper.line.value.startswith(window.served.url)


def test_a_trajectory_plays_and_its_time_bar_moves_it(window):
    window.player.command("play")
    _wait(lambda: window.player.way is not None and not np.array_equal(window.state.pose, start(window.original).pose))
    window.player.command("stop")
    _wait(lambda: not window.worker.busy)
    _press(window.player.time, 0.5)
    middle = window.player.way.at(0.5)
    _wait(lambda: np.array_equal(window.state.values, middle))
    assert closure_error(window.original, middle) < 1e-7


def test_a_trajectory_that_cannot_be_planned_says_why_and_the_next_one_plays(window, monkeypatch):
    def barred(*_):
        raise UsageError("no way at all")

    with monkeypatch.context() as patch:
        patch.setattr(player, "around", barred)
        window.player.command("play")
        _wait(lambda: window.notes["trajectory"].visible)
        assert "no way at all" in window.notes["trajectory"].content
    window.player.command("play")
    _wait(lambda: window.player.way is not None and not np.array_equal(window.state.pose, start(window.original).pose))
    assert not window.notes["trajectory"].visible


def test_a_trajectory_that_fails_by_a_bug_does_not_stop_the_next_one(window, monkeypatch):
    told = []
    monkeypatch.setattr(window.worker, "_failed", told.append)
    with monkeypatch.context() as patch:
        patch.setattr(player, "around", lambda _: 1 / 0)
        window.player.command("play")
        _wait(lambda: told)
    window.player.command("play")
    _wait(lambda: window.player.way is not None)
    assert [type(error) for error in told] == [ZeroDivisionError]


def test_what_is_pasted_and_no_link_is_told(window, monkeypatch):
    told = []
    monkeypatch.setattr(window.worker, "_failed", told.append)
    before = window.state
    _press(window.keeper.line, "garbage")
    _wait(lambda: told)
    assert "no link of a view" in str(told[0])
    assert window.state is before


def test_layers_come_as_boxes_that_show_and_hide_them(window):
    window.overlays.compute()
    labels = [box.label for box in window.overlays.boxes]
    assert labels[0].startswith("workspace of mode")
    box, node = window.overlays.boxes[0], window.stage._layers[0]
    assert node.visible
    _press(box, False)
    assert not node.visible
    window.overlays.clear()
    assert window.overlays.boxes == []
