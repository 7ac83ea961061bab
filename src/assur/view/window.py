"""The window: sliders, lists, numbers and buttons, and what each of them changes of what is shown."""

from __future__ import annotations

import html
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.errors import AssurError
from assur.kinematics.modes import Problem
from assur.kinematics.postures import Posture, Postures, postures
from assur.model.mechanism import MechanismRecord
from assur.view import dials, link
from assur.view.explain import Reason
from assur.view.keeping import Keeper
from assur.view.overlays import Overlays
from assur.view.player import Player
from assur.view.readings import Reading, clearance, closest_factor, readings, table
from assur.view.server import Served
from assur.view.snapshot import Snapshot, start, with_dial, with_input, with_parameter, with_values
from assur.view.stage import GHOSTS, Stage
from assur.view.undo import History
from assur.view.worker import Worker

Wish = Callable[[Any], Callable[[Snapshot], Snapshot]]
"""From the value of a control to the change that it asks for."""

FloatArray = NDArray[np.float64]
Change = Callable[[Snapshot, int, float], Snapshot]
"""One input or coordinate, by its number, to a value."""

NONE = "none of these"
"""What the list of modes says where what is shown is no solution in general, as on the arc of a self-motion."""

PROBLEMS: tuple[Problem, ...] = ("direct", "inverse")
RED = "background:#c62828;color:#fff;padding:4px 8px;border-radius:4px;font-size:0.85em"
SMALL = "<style>table.assur{font-size:0.8em;line-height:1.35;border-spacing:6px 0}</style>"


class Window:
    """What a browser shows of one mechanism, and what it may ask. Every change passes through one worker."""

    def __init__(self, record: MechanismRecord, served: Served) -> None:
        self.original, self.served, self.gui = record, served, served.viser.gui
        self.history = History(start(record))
        self.postures: dict[Problem, Postures] = {}
        self.more: tuple[Reading, ...] = ()
        self.settled = 0
        self.worker = Worker(self._idle, self.failed)
        self.stage = Stage(served.viser, self._ghost_clicked)
        self.stage.build(record, self.snapshot.values)
        self.stage.look(self.stage.first_viewpoint(record, self.snapshot.values))
        self.notes: dict[str, Any] = {}
        self.gui.set_panel_label(record.name)
        self._inputs = self._sliders("Inputs", dials.inputs(record), self.snapshot.inputs, with_input)
        coordinates = dials.read(record, self.snapshot.values)
        self._platform = self._sliders("Platform", dials.dials(record), coordinates, with_dial)
        self._make_numbers()
        self._make_modes()
        self.overlays = Overlays(self)
        self._make_parameters()
        self.player = Player(self)
        self.keeper = Keeper(self)
        self._show()
        self.worker.start()

    @property
    def snapshot(self) -> Snapshot:
        """What is shown."""
        return self.history.present

    def close(self) -> None:
        """End what runs."""
        self.player.stop()
        self.worker.stop()

    def restore(self, query: str) -> None:
        """Show what a link says; a query without one is no wish."""
        if any(f"{field}=" in query for field in ("at", "set", "camera")):
            self.go(query)

    def go(self, query: str) -> None:
        """Show what a link says; a person is told where it is none."""

        def task() -> None:
            snapshot, viewpoint = link.restored(self.original, query)
            self.now(snapshot, "")
            if viewpoint is not None:
                self.stage.look(viewpoint.times(self.stage.scale))

        self.worker.ask("restore", task)

    # ---- what is made once

    def _sliders(
        self,
        title: str,
        sliders: tuple[dials.Dial, ...],
        values: FloatArray,
        change: Change,
    ) -> list[Any]:
        handles = []
        with self.gui.add_folder(title):
            for k, (dial, value) in enumerate(zip(sliders, values, strict=True)):
                low, high = dial.ends
                shown = dial.shown(float(value))
                about = "stroke" if dial.limits else "range"
                handle = self.gui.add_slider(
                    f"{dial.name} [{dial.unit}]", min=low, max=high, step=dial.step, initial_value=shown,
                    hint=f"{about} {low:.6g} .. {high:.6g} {dial.unit}",
                )  # fmt: skip
                self.notes[f"{title} {dial.name}"] = self.gui.add_html("", visible=False)
                self.on_person(handle, f"{title} {dial.name}", self._turn(k, dial, change))
                handles.append(handle)
        return handles

    def _turn(self, k: int, dial: dials.Dial, change: Change) -> Wish:
        return lambda shown: partial(_turned, change, k, dial.inside(float(shown)))

    def on_person(self, handle: Any, label: str, wish: Wish) -> None:
        """What a person does with a control asks for a change; what we set ourselves does not."""

        def changed(event: Any) -> None:
            if event.client is not None:
                change = wish(event.target.value)  # now: the worker may set the control before it comes to this
                self.worker.ask(label, lambda: self.now(change(self.snapshot), label))

        handle.on_update(changed)

    def _make_numbers(self) -> None:
        with self.gui.add_folder("Numbers"):
            self._numbers = self.gui.add_html("")

    def _make_modes(self) -> None:
        with self.gui.add_folder("Modes"):
            self._lists: dict[Problem, Any] = {
                "direct": self.gui.add_dropdown(
                    "assembly",
                    ("...",),
                    hint=f"poses at these inputs; {GHOSTS} at most are ghosts in the scene",
                ),
                "inverse": self.gui.add_dropdown("working", ("...",), hint="sets of inputs at this pose"),
            }
            self._right = self.gui.add_html("")
            self._ghosts_shown = self.gui.add_checkbox("ghosts", initial_value=True)
            self._letters_shown = self.gui.add_checkbox("letters", initial_value=True)
        for problem, handle in self._lists.items():
            self.on_person(handle, f"{problem} mode", partial(self._chosen, problem))
        self._ghosts_shown.on_update(lambda _: self.stage.show_ghosts(self._ghosts_shown.value))
        self._letters_shown.on_update(lambda _: self.stage.show_letters(self._letters_shown.value))

    def _make_parameters(self) -> None:
        with self.gui.add_folder("Dimensions", expand_by_default=False):
            self._parameters = {}
            for parameter in self.original.parameters.values():
                if parameter.drawn_only:
                    continue
                handle = self.gui.add_number(
                    f"{parameter.name} [{parameter.unit}]",
                    initial_value=parameter.value,
                    step=_step(parameter.value),
                    hint=parameter.meaning,
                )
                self.on_person(handle, f"dimension {parameter.name}", partial(_resized, parameter.name))
                self._parameters[parameter.name] = handle
            self.notes["dimension"] = self.gui.add_html("", visible=False)
        with self.gui.add_folder("Steps"):
            self._steps = self.gui.add_button_group("", ("undo", "redo", "home"))
        self._steps.on_click(lambda event: self.worker.ask("step", partial(self._step, str(event.target.value))))

    # ---- what the worker does

    def now(self, snapshot: Snapshot, label: str) -> None:
        """Show another snapshot; it is one step with the last where it is of the same thing."""
        before = self.snapshot
        self.history = self.history.then(snapshot, label)
        self._after(before, label)

    def _after(self, before: Snapshot, label: str) -> None:
        self.settled = 0
        self.more = ()
        if self.snapshot.record is not before.record:
            self.stage.build(self.snapshot.record, self.snapshot.values)
            self.player.forget()
            self.overlays.clear()
        self._show(label)

    def _step(self, name: str) -> None:
        before = self.snapshot
        if name == "home":
            self.now(start(self.original), "")
            return
        self.history = self.history.back() if name == "undo" else self.history.on()
        self._after(before, "")

    def _show(self, label: str = "") -> None:
        """Everything that follows at once from what is shown."""
        snapshot = self.snapshot
        self.stage.move(snapshot.record, snapshot.values)
        self.stage.at_rest(())  # they were of where it stood
        with self.served.viser.atomic():
            self._set("Inputs", self._inputs, dials.inputs(self.original), snapshot.inputs)
            coordinates = dials.read(snapshot.record, snapshot.values)
            self._set("Platform", self._platform, dials.dials(self.original), coordinates)
            for name, handle in self._parameters.items():
                if not self.worker.waits(f"dimension {name}"):
                    handle.value = snapshot.record.parameters[name].value
            self._numbers.content = SMALL + table((*readings(snapshot), *self.more))
            self.explain(label, snapshot.reason)

    def _set(self, title: str, handles: list[Any], sliders: tuple[dials.Dial, ...], values: FloatArray) -> None:
        """Sliders to values (k,); one that a person has moved on meanwhile stays where that is."""
        for handle, dial, value in zip(handles, sliders, values, strict=True):
            if not self.worker.waits(f"{title} {dial.name}"):
                _set(handle, dial, float(value))

    def explain(self, label: str, reason: Reason | None) -> None:
        """In red below the control that a label names, why it stopped; nowhere else."""
        place = "dimension" if label.startswith("dimension") else label
        for name, note in self.notes.items():
            concerned = reason is not None and name == place
            if concerned:
                note.content = f'<div role="alert" style="{RED}">{html.escape(str(reason))}</div>'
            note.visible = concerned

    def _idle(self) -> bool:
        """What takes longer, when nothing moves: other modes first, then the distance to the nearest singularity."""
        if self.settled == 0:
            self.history = self.history.alone()
            shown = self.snapshot
            self.postures = {problem: postures(shown.record, shown.values, problem) for problem in PROBLEMS}
            self._show_modes()
            factor = closest_factor(self.snapshot, self.postures["inverse"])
            self.more = (factor,) if factor else ()
            self.keeper.refresh()
            self.overlays.show_at_rest()
        elif self.settled == 1:
            distance = clearance(self.snapshot, self.postures["inverse"])
            self.more = (*self.more, distance) if distance else self.more
        self.settled += 1
        self._numbers.content = SMALL + table((*readings(self.snapshot), *self.more))
        return self.settled < 2

    def _show_modes(self) -> None:
        others = self.postures["direct"].others
        self.stage.ghosts(
            self.snapshot.record, [posture.values for posture in others], visible=self._ghosts_shown.value
        )
        for problem, handle in self._lists.items():
            listed = self.postures[problem]
            names = tuple(_name(posture) for posture in listed.listed)
            handle.options = names if listed.current else (NONE, *names)
            handle.value = _name(listed.current) if listed.current else NONE
        said = self.postures["direct"].answer
        right = f"{'complete, ' if said.complete else ''}{said.right}"
        self._right.content = f'<small style="display:block;padding:0 8px">assembly modes: {html.escape(right)}</small>'

    def _chosen(self, problem: Problem, name: str) -> Callable[[Snapshot], Snapshot]:
        choices = self.postures[problem].listed if problem in self.postures else ()
        chosen = next((posture for posture in choices if _name(posture) == name), None)
        return lambda snapshot: snapshot if chosen is None else with_values(snapshot, chosen.values)

    def _ghost_clicked(self, index: int) -> None:
        others = self.postures["direct"].others if self.postures else ()
        if index < len(others):
            self.worker.ask("ghost", lambda: self.now(with_values(self.snapshot, others[index].values), ""))

    def failed(self, error: Exception) -> None:
        """Tell everybody what went wrong."""
        text = error.message if isinstance(error, AssurError) else f"a bug in assur: {type(error).__name__}: {error}"
        for client in self.served.viser.get_clients().values():
            client.add_notification("That did not work", text, color="red")


def _turned(change: Change, k: int, value: float, snapshot: Snapshot) -> Snapshot:
    return change(snapshot, k, value)


def _resized(name: str, value: float) -> Callable[[Snapshot], Snapshot]:
    return lambda snapshot: with_parameter(snapshot, name, float(value))


def _set(handle: Any, dial: dials.Dial, value: float) -> None:
    """A slider to a value, its range made longer where the value lies outside."""
    shown = round(dial.shown(value) / dial.step, 2) * dial.step
    if shown < handle.min:
        handle.min = shown
    if shown > handle.max:
        handle.max = shown
    if abs(handle.value - shown) > dial.step / 1000:  # the rounding of a step is nothing to tell a browser of
        handle.value = shown


def _name(posture: Posture) -> str:
    return posture.label or "the one"


def _step(value: float) -> float:
    """What an arrow changes a dimension by: about a thousandth of it."""
    return float(10.0 ** np.floor(np.log10(abs(value) or 1.0) - 2))
