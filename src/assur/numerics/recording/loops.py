"""Tapes as one fused compiled loop: numba makes machine code of generated source, kept on disk for the next start.

Elements are worked on in groups. The inputs and outputs of a group lie in one small buffer, row after row, so that the
compiler knows that they do not overlap and vectorises the loop; from there they go to the answer, past the caches where
it is larger than those. No operation is reordered or contracted: the bits are those of `Tape.evaluate`, whatever
the block or the number of threads (the sign of a zero under a root left out).
"""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.cache import cache_folder, keep, mark_used
from assur.errors import UsageError
from assur.numerics.recording.source import GROUP, digest, places_of, source
from assur.numerics.recording.tape import Tape

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.intp]

LINE = 64
"""Bytes of a line of the caches."""
IN_LINE = LINE // 8
"""Numbers of a line."""
STREAMED = 16 * 1024 * 1024
"""Bytes from which an answer is stored past the caches."""
SHARE = 16384
"""Elements that are worth a thread of their own."""


@dataclass(frozen=True, eq=False)
class CompiledLoop:
    """A tape as machine code.

    Attributes:
        tape: what it works out. Its outputs that are numbers, and those that are true or false, each have a place in
            a group; equal outputs share one.
    """

    tape: Tape

    @cached_property
    def places(self) -> dict[str, int]:
        """Output -> its row in a group, from which any row of an answer may take it."""
        return places_of(self.tape)

    def __call__(self, given: ArrayLike, uniform: Sequence[float], threads: int = 0) -> dict[str, NDArray[Any]]:
        """Outputs (N,) by name, of numbers (k, N), one row per varying name, and the uniform ones (u,).

        Args:
            given: numbers (k, N).
            uniform: numbers (u,) that are the same for every element.
            threads: how many work on it; as many as there are cores where 0.

        Example:
            >>> from assur.numerics.recording.tape import Recorder
            >>> recorder = Recorder()
            >>> x, p = recorder.varying("x"), recorder.uniform("p")
            >>> compiled(recorder.tape({"y": x * p, "large": x > p}))([[1.0, 2.0, 4.0]], [3.0])
            {'y': array([ 3.,  6., 12.]), 'large': array([False, False,  True])}
        """
        columns = np.ascontiguousarray(given, dtype=float)
        count = columns.shape[1]
        names: list[list[str]] = [[], []]
        for name in self.tape.outputs:
            names[name in self.tape.logical].append(name)
        rows = tuple(np.array([self.places[name] for name in part], dtype=np.intp) for part in names)
        numbers, truths = empty_rows(len(names[0]), count), np.empty((len(names[1]), count), dtype=bool)
        shares = _shares(count, threads or os.cpu_count() or 1)

        def work(share: tuple[int, int]) -> None:
            self.fill(columns, uniform, (numbers, truths), rows, share)

        if len(shares) == 1:
            work(shares[0])
        else:
            with ThreadPoolExecutor(len(shares)) as pool:
                list(pool.map(work, shares))
        outputs = {**dict(zip(names[0], numbers, strict=True)), **dict(zip(names[1], truths, strict=True))}
        return {name: outputs[name] for name in self.tape.outputs}

    def fill(
        self,
        given: FloatArray,
        uniform: Sequence[float] | FloatArray,
        answer: tuple[FloatArray, BoolArray],
        rows: tuple[IntArray, ...],
        part: tuple[int, int],
        *,
        shift: int = 0,
        streaming: bool | None = None,
    ) -> int:
        """Work out elements start to stop, into rows of an answer; other threads may run meanwhile.

        Args:
            given: numbers (k, M), contiguous.
            uniform: (u,).
            answer: numbers (R, N) and truths (T, N), contiguous.
            rows: for each row of the one, and of the other, the place of its output in a group (`places`).
            part: start and stop, of the elements of `given`.
            shift: where element 0 of `given` stands in the answer.
            streaming: whether to store past the caches, if rows are whole lines of these long; where the answer is
                large if not said. What stands before the first line is stored as usual.

        Returns:
            0 where all given numbers are finite.
        """
        numbers, truths = answer
        lines = numbers.shape[1] % IN_LINE == 0  # else a line begins at another element of each row
        past = lines and (numbers.nbytes >= STREAMED if streaming is None else streaming)
        flat = given.reshape(-1), given.shape[1], np.asarray(uniform, dtype=float), numbers.reshape(-1)
        where = truths.reshape(-1), numbers.shape[1], *rows
        start, stop = part
        line = min(start + _to_line(numbers, start + shift), stop) if past else start
        odd = int(self._code(*flat, *where, (start, line, shift), False)) if line > start else 0
        return odd + int(self._code(*flat, *where, (line, stop, shift), past))

    @property
    def loaded(self) -> bool:
        """Whether the machine code is in memory, so that a call costs nothing but its work."""
        return "_code" in self.__dict__ and bool(self._code.signatures)

    @cached_property
    def _code(self) -> Any:
        return _loaded(source(self.tape)).loop


def compiled(tape: Tape) -> CompiledLoop:
    """A tape as a compiled loop; machine code is made at its first call, or found on disk.

    Errors:
        UsageError: numba is not installed.
    """
    if importlib.util.find_spec("numba") is None:
        raise UsageError("compiled loops need numba, which is not installed", hint="pip install numba, or use NumPy")
    return CompiledLoop(tape)


def empty_rows(rows: int, count: int) -> FloatArray:
    """Numbers (rows, count) that begin at a line of the caches, so that large answers can be stored past these."""
    numbers = np.empty(rows * count + IN_LINE)
    first = _to_line(numbers, 0)
    return numbers[first : first + rows * count].reshape(rows, count)


def _to_line(numbers: FloatArray, place: int) -> int:
    """Numbers from a place of a contiguous array to the next line."""
    return -(numbers.ctypes.data // 8 + place) % IN_LINE


def _shares(count: int, threads: int) -> list[tuple[int, int]]:
    """Where each thread starts and stops: none so small that starting it takes longer."""
    parts = max(1, min(threads, count // SHARE))
    step = max(-(-count // parts // GROUP) * GROUP, GROUP)
    return [(start, min(start + step, count)) for start in range(0, max(count, 1), step)]


@lru_cache(maxsize=64)
def _loaded(text: str) -> ModuleType:
    """The source as a module; a file, since numba keeps machine code beside files only."""
    name = f"assur_loop_{digest(text)}"
    path = cache_folder() / "loops" / f"{name}.py"
    if path.is_file() and path.read_text(encoding="utf-8") == text:
        mark_used(path)
    else:
        keep("loops", path.name, text.encode())
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise ImportError(f"cannot load {path}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
