"""Leave to run Python that came with a mechanism's file: what the evaluator of kernels does not read, and evidence.

Python may do anything that its user may. So what stands in the folder of a mechanism that is not built in runs only
with leave, which is asked for once for each content of a file, at its place and with the Python beside it. What was not
run is kept in `refused` and warned of.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from assur.errors import CodeNotRunWarning, UsageError
from assur.results.answers.answer import NotRun

VARIABLE = "ASSUR_RUN_CODE"
Policy = Literal["always", "never", "ask"]
POLICIES: tuple[Policy, ...] = ("always", "never", "ask")
KEPT = "consent"


@dataclass
class _Process:
    """What this process was told."""

    given: bool = False
    forbidden: bool = False
    ask: Callable[[NotRun], bool] | None = None
    answers: dict[str, bool] = field(default_factory=dict)
    refused: list[NotRun] = field(default_factory=list)


_process = _Process()


def policy() -> Policy:
    """What the environment says: ASSUR_RUN_CODE is always, never or ask, which it is where nothing is said.

    Errors:
        UsageError: it says something else.
    """
    value = os.environ.get(VARIABLE, "") or "ask"
    for known in POLICIES:
        if value == known:
            return known
    raise UsageError(f"{VARIABLE} is {value[:40]!r}", hint=f"it may be {', '.join(POLICIES)}")


def built_in(path: Path) -> bool:
    """Whether a file is one of the mechanisms that come with assur.

    >>> built_in(Path("my_mechanism/closed_form.py"))
    False
    """
    home = Path(__file__).resolve().parents[1] / "mechanisms"
    return (path.parent.resolve() / path.name).is_relative_to(home)  # a link in another folder stands among its files


def may_run(path: Path, content: bytes, reason: str, instead: str, line: int | None = None) -> bool:
    """Whether a file of Python may run. Where it may not, that is kept and warned of.

    Args:
        path: the file.
        content: what was read of it, and will run: leave is for this content, at this place, with the Python beside it.
        reason: why it would have to run.
        instead: what happens where it does not.
        line: where in the file the reason stands.

    Errors:
        UsageError: ASSUR_RUN_CODE says what it may not.
    """
    if built_in(path) and path.is_file() and path.read_bytes() == content:  # its folder may be a link by now
        return True
    rule, code = policy(), NotRun(str(path), line, reason, instead)
    if not _process.forbidden and (rule == "always" or (rule == "ask" and (_process.given or _agreed(code, content)))):
        return True
    if code not in _process.refused:
        _process.refused.append(code)
    warnings.warn(f"{code}\nhint: {hint()}", CodeNotRunWarning, stacklevel=2)
    return False


def hint() -> str:
    """How code that was not run could be."""
    if _process.forbidden:
        return "this command runs no code of others, with leave or without"
    if policy() == "never":
        return f"{VARIABLE}=never forbids it"
    return f"look at it first; --run-code, or {VARIABLE}=always, runs it"


def _agreed(code: NotRun, content: bytes) -> bool:
    """Leave that was given before, or is given now, at a terminal."""
    name = _digest(Path(code.file), content)
    from assur.cache import cache_folder

    kept = cache_folder() / KEPT / name
    if kept.is_file():
        return True
    if _process.ask is None:
        return False
    if name not in _process.answers:
        _process.answers[name] = _process.ask(code)
        if _process.answers[name]:
            with contextlib.suppress(OSError):  # it is asked again next time
                kept.parent.mkdir(parents=True, exist_ok=True)
                kept.touch()
    return _process.answers[name]


def _digest(path: Path, content: bytes) -> str:
    """Of all that leave is given for: a file's place and content, and the Python beside it, which it may import."""
    place = path.absolute()
    parts = [str(place).encode(), content]
    for beside in sorted(place.parent.glob("*.py")):
        if beside != place and beside.is_file():
            parts += [beside.name.encode(), beside.read_bytes()]
    return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


@contextlib.contextmanager
def leave(
    *, given: bool = False, forbidden: bool = False, ask: Callable[[NotRun], bool] | None = None
) -> Iterator[list[NotRun]]:
    """What may run meanwhile: all where leave is given, none where that is forbidden, else what a person agrees to.

    Yields what was not run.

    Example: nothing of a stranger's runs, and nobody is asked.

        >>> with leave() as refused:
        ...     pass
        >>> refused
        []
    """
    global _process
    before, _process = _process, _Process(given, forbidden, ask)
    try:
        yield _process.refused
    finally:
        _process = before
