"""A page of docs/ that is a recipe, followed to the letter: files that it shows are made, changes made, commands run.

"`path`:" before a block names the file that the block is, or that a `diff` changes: lines with - and without a sign
stand there one after the other, once, and become those with + and without a sign. A block `sh` is typed line by line; a
block `text` right after it is what is printed.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from shown import rounded

ROOT = Path(__file__).parents[2]
CARRIED = ("src", "tests", "docs", "pyproject.toml", "README.md", "CONVENTIONS.md", "ERRATA.md", "CONFORMANCE.md")
BLOCK = re.compile(r"(?:`([\w./-]+)`:\n\n)?```(\w+)\n(.*?)```", re.DOTALL)

START = 'import sys\nfrom assur.cli.main import main\n\nsys.argv[0] = "assur"\nsys.exit(main())\n'


@dataclass(frozen=True)
class Checkout:
    """A copy of the checkout, in which `assur` and `python` are those of the copy and of the tests."""

    folder: Path

    @classmethod
    def at(cls, folder: Path) -> Checkout:
        """A copy in an empty folder."""
        for name in CARRIED:
            copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
            copy(ROOT / name, folder / name)
        if Path(f"{sys.pycache_prefix}{ROOT}/src").is_dir():  # modules that are compiled already, beside no source
            shutil.copytree(f"{sys.pycache_prefix}{ROOT}/src", f"{sys.pycache_prefix}{folder}/src")
        programs = folder / "bin"
        programs.mkdir()
        (programs / "assur").write_text(f"#!{sys.executable}\n{START}")
        (programs / "python").write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
        for path in programs.iterdir():
            path.chmod(0o755)
        return cls(folder)

    def typed(self, line: str) -> str:
        """What a line prints; it must not fail."""
        path = f"{self.folder / 'bin'}{os.pathsep}{os.environ['PATH']}"
        environment = {**os.environ, "PATH": path, "PYTHONPATH": str(self.folder / "src"), "COLUMNS": "80"}
        ran = subprocess.run(line, shell=True, cwd=self.folder, env=environment, capture_output=True, text=True)
        assert ran.returncode == 0, (line, ran.stdout, ran.stderr)
        return "\n".join(row.rstrip() for row in ran.stdout.splitlines()).strip("\n")

    def made(self, name: str, text: str) -> None:
        """A new file."""
        path = self.folder / name
        assert not path.exists(), f"{name} is there"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def changed(self, name: str, change: str) -> None:
        """A file in which something else stands."""
        rows = [row or " " for row in change.splitlines()]
        old = "".join(f"{row[1:]}\n" for row in rows if row[0] in " -")
        new = "".join(f"{row[1:]}\n" for row in rows if row[0] in " +")
        text = (self.folder / name).read_text(encoding="utf-8")
        assert text.count(old) == 1, (name, old)
        (self.folder / name).write_text(text.replace(old, new), encoding="utf-8")


@dataclass(frozen=True)
class Followed:
    """What following a recipe touched: files that were there before, files that are new, and commands that ran."""

    existing: frozenset[str]
    new: frozenset[str]
    typed: tuple[str, ...]


def followed(page: Path, checkout: Checkout) -> Followed:
    """The page, from its first block to its last."""
    existing, new, typed, shown = set(), set(), [], ""
    for name, kind, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        if kind == "diff":
            checkout.changed(name, text)
            existing |= {name} - new
        elif name:
            checkout.made(name, text)
            new.add(name)
        elif kind == "sh":
            shown = "\n".join(filter(None, map(checkout.typed, text.splitlines())))
            typed += text.splitlines()
            existing |= set(re.findall(r" > (\S+)", text)) - new
        elif kind == "text":
            assert rounded(shown) == rounded(text.strip("\n")), typed[-1]
    return Followed(frozenset(existing), frozenset(new), tuple(typed))
