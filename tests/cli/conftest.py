"""A command line run inside this process, which is fast, or as the installed command."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from assur.cli.main import main

COMMAND = Path(sys.executable).with_name("assur")


@dataclass(frozen=True)
class Run:
    code: int
    out: str
    err: str

    @property
    def json(self) -> dict[str, Any]:
        """The one object on standard output, which must be all that is there."""
        assert self.out.count("\n") == 1
        found = json.loads(self.out, parse_constant=_refuse)
        assert isinstance(found, dict)
        return found


def _refuse(text: str) -> None:
    raise AssertionError(f"{text} is not JSON")


@pytest.fixture
def assur_cli(capsys, monkeypatch):
    """Run words in this process: a `Run`."""
    monkeypatch.setenv("COLUMNS", "80")

    def run(*words: str) -> Run:
        code = main(list(words))
        captured = capsys.readouterr()
        return Run(code, captured.out, captured.err)

    return run


@pytest.fixture
def assur_process():
    """Run words as the installed command in a process of its own: a `Run`."""

    def run(*words: str, **options: Any) -> Run:
        done = subprocess.run([COMMAND, *words], capture_output=True, text=True, timeout=600, check=False, **options)
        return Run(done.returncode, done.stdout, done.stderr)

    return run
