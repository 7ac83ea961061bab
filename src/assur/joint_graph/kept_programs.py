"""Programs of joint graphs, kept in the user's cache: by structure, by what is asked for, and by the code that records.

To record a program and to compile its lines takes milliseconds for every hundred operations; to read one, a hundredth.
"""

from __future__ import annotations

import hashlib
import importlib.util
import marshal
import os
from collections.abc import Callable, Hashable
from contextlib import suppress
from dataclasses import is_dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from assur.cache import keep, own_content
from assur.joint_graph.graph_program import GraphProgram
from assur.numerics.recording.levels import Levels
from assur.numerics.recording.straight_line import StraightLine
from assur.numerics.recording.tape import Operation, Tape
from assur.version import VERSION

KIND = "programs"
LARGEST = 50_000_000
"""Bytes of an entry; a larger one is none of ours."""

RECORDERS = ("joints", "joint_graph", "kinematics", "machine", "model", "numerics")
"""Folders of the code that is recorded, or records: where one of its files changes, older programs count no more."""


def kept_program(structure: Hashable, asked: Callable[..., Any], make: Callable[[], GraphProgram]) -> GraphProgram:
    """The program of what a function asks of configurations of a structure, made where it is not kept.

    Args:
        structure: its text tells it from every other.
        asked: a function of a module, or a frozen dataclass that is called; programs of others are made each time.
        make: records the program.
    """
    question = _question(asked)
    if not question:
        return make()
    parts = (VERSION, importlib.util.MAGIC_NUMBER.hex(), _code(), repr(structure), question)
    name = hashlib.sha256("\0".join(parts).encode()).hexdigest()
    digest, _, body = (own_content(KIND, name, LARGEST) or b"").partition(b"\n")
    if body and digest.decode("ascii", "replace") == hashlib.sha256(body).hexdigest():
        with suppress(ValueError, TypeError, EOFError):
            return _program(marshal.loads(body))
    program = make()
    body = marshal.dumps(_data(program))
    with suppress(OSError):
        keep(KIND, name, hashlib.sha256(body).hexdigest().encode() + b"\n" + body)
    return program


def _question(asked: Callable[..., Any]) -> str:
    """What names a question in every process; empty where nothing does."""
    if is_dataclass(asked):
        return f"{type(asked).__module__}.{asked!r}"
    name = getattr(asked, "__qualname__", "<")
    return "" if "<" in name or getattr(asked, "__closure__", None) else f"{asked.__module__}.{name}"


@lru_cache(maxsize=1)
def _code() -> str:
    """Names, sizes and times of the files that record and are recorded."""
    home = Path(__file__).parents[1]
    files = [path for folder in RECORDERS for path in _sources(os.fspath(home / folder))]
    return hashlib.sha256(repr(sorted(files)).encode()).hexdigest()


def _sources(folder: str) -> list[tuple[str, int, int]]:
    files: list[tuple[str, int, int]] = []
    with os.scandir(folder) as entries:
        for entry in entries:
            if entry.name.endswith(".py"):
                status = entry.stat()
                files.append((entry.path, status.st_size, status.st_mtime_ns))
            elif entry.is_dir() and entry.name != "__pycache__":
                files += _sources(entry.path)
    return files


def _data(program: GraphProgram) -> tuple[Any, ...]:
    line, tape = program.line, program.line.tape
    operations = [tuple(operation) for operation in tape.operations]
    parts = operations, tape.varying, tape.uniform, dict(tape.outputs)
    by_levels = line.levels.size, line.levels.steps, line.levels.numbers, line.levels.outputs
    return parts, by_levels, line.code, program.places, program.names, dict(program.constants)


def _program(data: tuple[Any, ...]) -> GraphProgram:
    (operations, varying, uniform, outputs), by_levels, code, places, names, constants = data
    tape = Tape(tuple(map(Operation._make, operations)), varying, uniform, outputs)
    return GraphProgram(StraightLine(tape, Levels(*by_levels), code), places, names, constants)
