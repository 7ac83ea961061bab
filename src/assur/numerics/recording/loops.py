"""Tapes as one fused compiled loop: numba makes machine code of generated source, kept on disk for the next start.

Elements are worked on in strips. A strip's inputs and outputs lie in one buffer, row after row, so that the compiler
knows that they do not overlap and vectorises the loop. No operation is reordered or contracted: the bits are those of
`Tape.evaluate`, whatever the strip, the block or the number of threads (the sign of a zero under a root left out).
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from assur.numerics.recording.tape import Operation, Tape

FloatArray = NDArray[np.float64]

STRIP = 256
"""Elements of a strip: its buffer stays in the fastest cache."""

_TEXT = {
    "+": "{0} + {1}",
    "-": "{0} - {1}",
    "*": "{0} * {1}",
    "/": "{0} / {1}",
    "negative": "-{0}",
    "magnitude": "abs({0})",
    "root": "sqrt(0.0 if {0} < 0.0 else {0})",
    ">=": "{0} >= {1}",
    ">": "{0} > {1}",
    "and": "{0} & {1}",
}


def source(tape: Tape) -> str:
    """The loop as Python source for numba: `loop(given, uniform, answer, start, stop)`.

    >>> from assur.numerics.recording.tape import Recorder
    >>> recorder = Recorder()
    >>> x = recorder.varying("x")
    >>> "v1 = v0 * v0" in source(recorder.tape({"y": x * x}))
    True
    """
    once = _uniform_entries(tape)
    before, inside = [], []
    varying, uniform = 0, 0
    for k, item in enumerate(tape.operations):
        if item.name == "varying":
            inside.append(f"v{k} = strip[{varying * STRIP} + i]")
            varying += 1
        elif item.name == "uniform":
            before.append(f"v{k} = uniform[{uniform}]")
            uniform += 1
        elif item.name == "number":
            before.append(f"v{k} = {item.number!r}")
        else:
            (before if k in once else inside).append(f"v{k} = {_text(item)}")
    for row, (name, k) in enumerate(tape.outputs.items()):
        value = f"1.0 if v{k} else 0.0" if name in tape.logical else f"v{k}"
        inside.append(f"strip[{(varying + row) * STRIP} + i] = {value}")
    rows, outputs = varying + len(tape.outputs), len(tape.outputs)
    return "\n".join(
        [
            "from math import inf, nan, sqrt",
            "",
            "import numpy as np",
            "from numba import njit",
            "",
            "",
            '@njit(cache=True, nogil=True, error_model="numpy")',
            "def loop(given, uniform, answer, start, stop):",
            f"    strip = np.zeros({rows * STRIP})",
            *(f"    {line}" for line in before),
            f"    for first in range(start, stop, {STRIP}):",
            f"        size = min({STRIP}, stop - first)",
            f"        for row in range({varying}):",
            "            for i in range(size):",
            f"                strip[row * {STRIP} + i] = given[row, first + i]",
            f"        for i in range({STRIP}):",
            *(f"            {line}" for line in inside),
            f"        for row in range({outputs}):",
            "            for i in range(size):",
            f"                answer[row, first + i] = strip[({varying} + row) * {STRIP} + i]",
            "",
        ]
    )


def compiled(tape: Tape) -> Callable[..., FloatArray]:
    """A function of given (k, N) and uniform (u,) numbers that returns the outputs (rows, N), on every core."""
    loop = _loaded(source(tape)).loop
    rows = len(tape.outputs)

    def run(given: Any, uniform: Sequence[float], answer: FloatArray | None = None, threads: int = 0) -> FloatArray:
        columns = np.ascontiguousarray(given, dtype=float)
        count = columns.shape[1]
        found = np.empty((rows, count)) if answer is None else answer
        numbers = np.asarray(uniform, dtype=float)
        shares = _shares(count, threads or os.cpu_count() or 1)
        if len(shares) == 1:
            loop(columns, numbers, found, 0, count)
            return found
        with ThreadPoolExecutor(len(shares)) as pool:
            for done in [pool.submit(loop, columns, numbers, found, *share) for share in shares]:
                done.result()
        return found

    return run


def _shares(count: int, threads: int) -> list[tuple[int, int]]:
    """Where each thread starts and stops: whole strips, and none so small that starting it takes longer."""
    least = 64 * STRIP
    parts = max(1, min(threads, count // least))
    step = -(-count // parts // STRIP) * STRIP or STRIP
    return [(start, min(start + step, count)) for start in range(0, max(count, 1), step)]


def _uniform_entries(tape: Tape) -> set[int]:
    """Entries that are the same for all elements: worked out once, before the loop."""
    once: set[int] = set()
    for k, item in enumerate(tape.operations):
        if item.name in ("uniform", "number") or (item.arguments and once.issuperset(item.arguments)):
            once.add(k)
    return once


def _text(item: Operation) -> str:
    return _TEXT[item.name].format(*(f"v{k}" for k in item.arguments))


def cache_folder() -> Path:
    """Where compiled loops are kept: ASSUR_CACHE, or the user's cache folder."""
    chosen = os.environ.get("ASSUR_CACHE")
    if chosen:
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "assur"


@lru_cache(maxsize=64)
def _loaded(text: str) -> ModuleType:
    """The source as a module; a file, since numba keeps machine code beside files only."""
    name = f"assur_loop_{hashlib.sha256(text.encode()).hexdigest()[:24]}"
    path = cache_folder() / "loops" / f"{name}.py"
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh = path.with_name(f"{name}.{os.getpid()}")
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(path)
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot load {path}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
