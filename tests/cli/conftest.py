"""A command line run inside this process, which is fast, or as the installed command.

Whatever a command prints with --json is held against the schema of its answers.
"""

import functools
import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from assur.cli.answers import ANSWERS
from assur.cli.main import main
from assur.results.answers.schema import schema_of

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


@functools.cache
def _validator(command: str) -> jsonschema.Draft202012Validator:
    schema = schema_of({command: ANSWERS.get(command, ())})
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def held_to_schema(words, run: Run) -> Run:
    """The same run; its answer, where it is one in JSON, is as the schema says."""
    if "--json" in words and run.out and words[0] in ANSWERS:
        error = jsonschema.exceptions.best_match(_validator(words[0]).iter_errors(run.json))
        assert error is None, f"{' '.join(words)}: {error.json_path}: {error.message}"
    return run


def _refuse(text: str) -> None:
    raise AssertionError(f"{text} is not JSON")


@pytest.fixture
def assur_cli(capsys, monkeypatch):
    """Run words in this process: a `Run`."""
    monkeypatch.setenv("COLUMNS", "80")

    def run(*words: str) -> Run:
        code = main(list(words))
        captured = capsys.readouterr()
        return held_to_schema(words, Run(code, captured.out, captured.err))

    return run


@pytest.fixture
def assur_process():
    """Run words as the installed command in a process of its own: a `Run`."""

    def run(*words: str, **options: Any) -> Run:
        done = subprocess.run([COMMAND, *words], capture_output=True, text=True, timeout=600, check=False, **options)
        return held_to_schema(words, Run(done.returncode, done.stdout, done.stderr))

    return run
