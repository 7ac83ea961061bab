"""Every error speaks of what the user typed: options of that command, and no argument of the library."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest
from imports import nodes

import assur
from assur.cli import parsing
from assur.cli.application import application
from assur.cli.spelling import as_typed
from assur.errors import MechanismFileError, Problem, UsageError

SOURCE = Path(assur.__file__).parent
Z = "zeng2019"
WAY = "--from -60,150 --to 60,220"
BAD = [
    f"certify {Z} -o FILE --gap -1",
    f"certify {Z} -o FILE --finest -1",
    f"certify {Z} -o FILE --most 0",
    f"certify {Z} -o FILE --most 1.5",
    f"certify {Z} -o FILE --at z=1e9 --kind box",
    f"certify {Z} -o FILE --stroke yA1=3:1",
    f"certify {Z} -o FILE --box x=nan:1",
    f"certify fivebar -o FILE --kind path --mode=-+ {WAY} --finest 3",
    f"workspace {Z} --resolution 1",
    f"workspace {Z} --resolution 500",
    f"workspace {Z} --section 9000",
    f"workspace {Z} --near -1",
    f"workspace {Z} --near nan",
    f"workspace {Z} --at x=nan",
    f"workspace {Z} --at x=1 --at y=2 --at z=3",
    f"workspace {Z} --at q=1",
    f"workspace {Z} --certify --gap 0",
    f"workspace {Z} --certify --finest 0",
    f"workspace {Z} --certify --section 9000",
    f"workspace {Z} --prove x=1:0",
    f"workspace {Z} --prove q=0:1",
    f"workspace {Z} --largest cube --around x=0",
    f"workspace {Z} --largest cube --around x=0,y=0,z=nan",
    f"workspace {Z} --largest cylinder --around x=0,y=0,z=300 --ratio -1",
    "workspace planar_3rpr --largest cylinder --around x=0,y=0,phi=0",
    "workspace planar_3rpr --largest ball --around x=0,y=0,phi=0",
    f"aspects {Z} --finest 0",
    f"aspects {Z} --finest -1",
    f"aspects {Z} --from 1,2",
    f"aspects {Z} --from 1,2,nan",
    f"aspects {Z} --at x=1 --at y=2 --at z=3",
    f"indices {Z} --map x,z --nodes 1",
    f"indices {Z} --map x,z --nodes 100000",
    f"indices {Z} --map x,x",
    f"indices {Z} --points 1",
    "crosscheck fivebar --samples 0",
    f"workspace {Z} --stroke q=1:2",
    f"indices {Z} --length -1",
    f"sweep {Z} --along x=3 --along y=3 --at z=300 -o FILE --threads -1",
    f"sweep {Z} --along x=3 --along y=3 --at z=300 -o FILE --keep nothing",
    f"direct {Z} 1 2 3 --method search --crossed --certify",
    f"direct {Z} 1 2 3 --method nothing",
    "inverse planar_3rpr 0 0 0 --method search --certify",
    "direct gough_stewart 1 1 1 1 1 1 --method search --certify",
    f"follow {Z} --to 1,2",
    f"follow {Z} --to 1,2,nan",
    "synthesize --limbs 9 --motion 3T",
    "synthesize --max-joints 0",
    "synthesize --motion 9T",
    "synthesize --coupling 3..1",
    "new FILE.toml --chain R[z]",
    "topology --chain R[z] --actuate 4.1",
    "topology --chain R[z]R[z] --chain R[z]R[z] --actuate 1.1,1.1",
]


@cache
def arguments() -> frozenset[str]:
    """Names of all arguments of the library's functions, but for the short ones, as a coordinate may be called too."""
    found = set()
    for path in SOURCE.rglob("*.py"):
        if "cli" in path.parts or "mechanisms" in path.parts:
            continue
        for node in nodes(path):
            if isinstance(node, ast.FunctionDef):
                found.update(item.arg for item in (*node.args.args, *node.args.kwonlyargs))
    return frozenset(name for name in found - {"self"} if len(name) > 2)


@pytest.mark.parametrize("words", BAD)
def test_no_error_names_an_argument_of_the_library(assur_cli, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    run = assur_cli(*words.replace("FILE", "out").split())
    assert run.code == 2, run
    assert run.err.startswith("error: ")
    message, _, hint = run.err.removeprefix("error: ").partition("\nhint: ")
    library, options = arguments(), parsing.options(application(), words.split())
    first = re.match(r"(\w+)(?: of \w+)?: ", message)
    assert not (first and first[1] in library), "an argument's name where its option belongs"
    said = re.sub(r"assur \w+ --?[\w-]+", "", f"{message} {hint}")  # options of a command that is named
    assert set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", said)) <= options
    assert not {word for word in re.findall(r"\b[a-z]+_\w+\b", said) if word in library}
    assert not re.search(r"\b[a-z_]+\(", said), "a call of the library"


def test_the_place_of_an_argument_is_kept():
    error = as_typed(UsageError("finest: x = 0 is not positive", hint="h"), {"--finest"})
    assert (error.message, error.hint) == ("--finest: x = 0 is not positive", "h")
    assert as_typed(UsageError("held: x = nan is not finite"), {"--at"}).message == "--at: x = nan is not finite"


def test_what_is_no_argument_of_the_command_stays():
    for text in ("fivebar: no box", "gap: 3", "no colon"):
        assert as_typed(UsageError(text), {"--box", "--at"}).message == text
    file = MechanismFileError([Problem("gap: ", 1, "gap", "f", "a")])
    assert as_typed(file, {"--gap"}).message == file.message
