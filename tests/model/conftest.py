from collections.abc import Callable
from pathlib import Path

import pytest

from assur.errors import MechanismFileError
from assur.model.file.reader import read_text
from assur.model.mechanism import MechanismRecord

FOURBAR = Path(__file__).with_name("fourbar.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="session")
def fourbar() -> str:
    return FOURBAR


@pytest.fixture(scope="session")
def read() -> Callable[[str], MechanismRecord]:
    return lambda text: read_text(text, Path("f.toml"))


@pytest.fixture(scope="session")
def faults() -> Callable[[str], list[str]]:
    """What the reader says about a text, one line per problem and one per hint."""

    def of(text: str) -> list[str]:
        with pytest.raises(MechanismFileError) as caught:
            read_text(text, Path("f.toml"))
        assert caught.value.exit_code == 3
        return [line for problem in caught.value.problems for line in str(problem).splitlines()]

    return of
