"""Compile yardstick.c and call it: each function answers with new arrays, or writes into those given."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from assur.kinematics.modes import mode_signs
from assur.kinematics.status import closed_form_of, tolerance
from assur.model.mechanism import MechanismRecord

HERE = Path(__file__).parent
FLAGS = (
    "-O3",
    "-march=native",
    "-fno-math-errno",
    "-fno-trapping-math",
    "-fPIC",
    "-shared",
    "-Wall",
    "-Wextra",
)
LENGTHS = ("b", "d", "l1", "l2", "l3", "l4", "l6", "l7", "l8")  # as in `lengths` of yardstick.c
INVERSE_MARGINS = ("n_alpha", "n_beta", "M12", "M3")
DIRECT_MARGINS = ("B", "w2", "v2", "centres", "meeting")

Arrays = list[np.ndarray]


def compiler() -> str | None:
    """gcc, where there is one."""
    return shutil.which("gcc")


def compile_library(gcc: str) -> ctypes.CDLL:
    """Compile yardstick.c into bench/build and load it."""
    target = HERE / "build" / "yardstick.so"
    target.parent.mkdir(exist_ok=True)
    subprocess.run([gcc, *FLAGS, str(HERE / "yardstick.c"), "-o", str(target)], check=True)
    return ctypes.CDLL(str(target))


@dataclass(frozen=True)
class Yardstick:
    """The C functions for one record. Answers are lists of arrays (rows, N), bool where they say what exists."""

    library: ctypes.CDLL
    record: MechanismRecord
    mode: str

    def empty(self, job: str, count: int) -> Arrays:
        """Arrays for the answer of a job."""
        rows: dict[str, tuple[tuple[int, type], ...]] = {
            "inverse_one": ((3, float), (1, bool), (1, float), (1, float), (9, float)),
            "inverse_distinct": ((4, float), (4, float), (4, float), (4, bool)),
            "inverse_expanded": ((96, float), (32, bool)),
            "direct_all": ((24, float), (8, bool)),
        }
        return [np.empty((size, count), kind) for size, kind in rows[job]]

    def run(self, job: str, components: np.ndarray, answer: Arrays) -> Arrays:
        """Do a job into `answer`."""
        function: Callable[..., None] = getattr(self.library, job)
        direct = job == "direct_all"
        setting = [self._lengths(), self._limits(DIRECT_MARGINS if direct else INVERSE_MARGINS)]
        if job == "inverse_one":
            setting.append(np.array(mode_signs(self.record, "inverse", self.mode), dtype=float))
            places = [row for array in answer for row in array]
        else:
            places = answer
        pointers = [ctypes.c_void_p(array.ctypes.data) for array in (*setting, *components, *places)]
        function(ctypes.c_long(len(components[0])), *pointers)
        return answer

    def _lengths(self) -> np.ndarray:
        return np.array([self.record.parameters[name].value for name in LENGTHS])

    def _limits(self, names: tuple[str, ...]) -> np.ndarray:
        form = closed_form_of(self.record)
        margins = {item.name: item for item in (*form.direct_margins, *form.inverse_margins)}
        return np.array([tolerance(self.record, margins[name]) for name in names])
