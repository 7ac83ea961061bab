"""Curves in time: forces of the actuators with their limits, rates of the inputs, energies."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from assur.figures.style import GREY, INK, PAGE, SERIES, new_figure
from assur.machine.forces.actuator_forces import force_units
from assur.machine.forces.utilisation import stated
from assur.model.mechanism import MechanismRecord
from assur.results.answers.dynamics import DynamicsAnswer

FloatArray = NDArray[np.float64]
IN_SIGHT = 0.3
"""Share of a limit from which on its line is drawn; where less is used, curves would be flat beside it."""
PANEL = 42.0
"""Height of a panel, in mm."""
DASHES = ("-", "--", "-.", ":")
SPEEDS = {"N": "m/s", "N m": "rad/s"}


def in_time(record: MechanismRecord, answer: DynamicsAnswer) -> Figure:
    """Panels below one another: forces and rates of the inputs, for each of their units, and energies.

    What ended the motion is marked where it has rows up to there.
    """
    units = np.array(force_units(record))
    kinds = [unit for unit in SPEEDS if unit in units]
    times, count = np.array(answer.t), 2 * len(kinds) + 1
    height = 11.0 + PANEL * count
    figure = new_figure(PAGE, height)
    panels: list[Axes] = list(np.atleast_1d(figure.subplots(count, 1, sharex=True)))
    for place, unit in enumerate(kinds):
        own = np.flatnonzero(units == unit)
        names = [answer.input_names[k] for k in own]
        for panel, rows, limits, title in (
            (panels[place], answer.actuator_forces, stated(record, "force"), f"force [{unit}]"),
            (panels[len(kinds) + place], answer.input_rates, stated(record, "speed"), f"rate [{SPEEDS[unit]}]"),
        ):
            _curves(panel, times, np.array(rows)[:, own], names, title)
            _limits(panel, np.array(rows)[:, own], limits[own])
    energies = np.array([answer.kinetic_energy, answer.potential_energy]).T
    energies[:, 1] -= energies[0, 1]
    _curves(panels[-1], times, energies, ["kinetic", "potential,\nless the first"], "energy [J]")
    if answer.stopped is not None:
        for panel in panels:
            panel.axvline(answer.stopped.time, color=GREY, linewidth=0.8)
    panels[-1].set_xlabel("t [s]")
    panels[-1].set_xlim(times[0], times[-1])
    figure.subplots_adjust(left=0.09, right=0.82, top=1.0 - 2.0 / height, bottom=9.0 / height, hspace=0.12)
    figure.align_ylabels(panels)
    return figure


def _curves(panel: Axes, times: FloatArray, rows: FloatArray, names: Sequence[str], title: str) -> None:
    """Columns (N, d) over times; dashes tell apart what colours do not."""
    for k, name in enumerate(names):
        panel.plot(times, rows[:, k], color=SERIES[k % len(SERIES)], linestyle=DASHES[k % len(DASHES)], label=name)
    panel.axhline(0.0, color=INK, linewidth=0.3)
    panel.set_ylabel(title)
    panel.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)


def _limits(panel: Axes, rows: FloatArray, limits: FloatArray) -> None:
    """The limits (d,) of columns (N, d): as lines where they are in sight, else in words."""
    known = np.unique(limits[np.isfinite(limits)])
    largest = float(np.max(np.abs(rows), initial=0.0))
    for limit in known[largest >= IN_SIGHT * known]:
        for sense in (-1.0, 1.0):
            panel.axhline(sense * limit, color=GREY, linewidth=0.8, linestyle=(0, (6, 3)))
    if len(known):
        words = "limit " + ", ".join(f"±{limit:g}" for limit in known)
        panel.text(
            1.01, 0.0, words, transform=panel.transAxes, fontsize="small", color=GREY, verticalalignment="bottom"
        )
