"""Laws about the project's own files: what is pinned, mirrored and named, and what must not be there."""

import ast
import itertools
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from imports import nodes
from packages import docstring
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from source import CORE, SOURCE, texts

ROOT = Path(__file__).parents[1]
FOLDERS = sorted(path for path in (SOURCE / "mechanisms").iterdir() if path.is_dir() and any(path.glob("*.toml")))
MECHANISMS = [folder for folder in FOLDERS if (folder / "mechanism.toml").is_file()]
NOT_MIRRORS = {"contract", "papers", "derivations", "examples"}
CITED_HOSTS = {"www.apache.org", "www.w3.org", "arxiv.org", "doi.org", "json-schema.org"}
CLOCKS = {"perf_counter", "perf_counter_ns", "process_time", "process_time_ns", "thread_time", "thread_time_ns"}
NOBODY = re.compile(r"localhost|127\.[\d.]+|0\.0\.0\.0|192\.0\.2\.\d+|(?:[\w-]+\.)*example(?:\.\w+)?")
"""This machine itself, every address of it, and names and addresses that are reserved for documentation."""


def read(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def project() -> dict:
    return tomllib.loads(read("pyproject.toml"))


def pins() -> dict[str, str]:
    lines = [line for line in read("constraints.txt").splitlines() if line and not line.startswith("#")]
    return {canonicalize_name(name): version for name, version in (line.split("==") for line in lines)}


def carried_files() -> list[Path]:
    """What git carries, or would after an add."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return [ROOT / name for name in listed.split("\0") if name and (ROOT / name).is_file()]


# ---- versions ----------------------------------------------------------------------------------------------


def test_constraints_hold_names_and_versions_only():
    lines = [line for line in read("constraints.txt").splitlines() if not line.startswith("#")]
    assert [line for line in lines if not re.fullmatch(r"[A-Za-z0-9._-]+==[0-9][A-Za-z0-9.+!]*", line)] == []


def test_nobody_is_told_to_install_assur_by_its_name():
    """No package index has it: an extra is installed from its folder, as `pip install '.[view]'`."""
    named = r"(?:[\w.=<>~\[\]-]+\s+)*['\"]?assur\b(?!['\"]?[/.])"
    told = re.compile(rf"\b(?:pip3?|pipx|uv)\s+(?:pip\s+)?(?:install|add|inject)\s+{named}")
    found = [
        f"{path.relative_to(ROOT)}: {hit.group()}"
        for path in carried_files()
        if path.suffix not in {".png", ".gif"} and path.name != "CHANGELOG.md"
        for hit in told.finditer(path.read_text(encoding="utf-8", errors="replace"))
    ]
    assert found == []
    assert all(told.search(f"pip install {name}") for name in ("'assur[view]'", "-U assur", "numpy assur"))
    assert not told.search("pip install '.[view]' in assur's folder")


def test_every_dependency_is_pinned_within_its_range():
    table = project()
    extras = table["project"]["optional-dependencies"].values()
    wanted = [
        *table["build-system"]["requires"],
        *table["project"]["dependencies"],
        *itertools.chain.from_iterable(extras),
    ]
    found = pins()
    for requirement in map(Requirement, wanted):
        version = found[canonicalize_name(requirement.name)]
        assert requirement.specifier.contains(version, prereleases=True), requirement


def test_one_version_everywhere():
    version = project()["project"]["version"]
    assert re.findall(r"^## (\S+)", read("CHANGELOG.md"), re.MULTILINE)[0] == version
    assert re.findall(r"^version: (\S+)", read("CITATION.cff"), re.MULTILINE) == [version]


# ---- text --------------------------------------------------------------------------------------------------


def test_every_module_says_its_idea():
    assert [path for path in CORE if path.read_text(encoding="utf-8") and not docstring(path)] == []


def test_no_file_names_a_host_or_a_machine():
    found = []
    for path in carried_files():
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:  # a picture
            continue
        hosts = set(re.findall(r"[a-z]://(?:[^\s/@]*@)?([A-Za-z0-9][\w.-]*)", text)) - CITED_HOSTS
        addresses = re.findall(r"(?<![\w.=])(?:\d{1,3}\.){3}\d{1,3}(?![\w.])", text)
        folders = re.findall(r"(?<![\w.~])/(?:home|root|opt|work|Users)/\w+", text)
        named = [item for item in (*hosts, *addresses) if not NOBODY.fullmatch(item)]
        found += [(path.name, item) for item in (*named, *folders)]
    assert found == []


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md"])
def test_make_targets_that_are_named_exist(name):
    targets = set(re.findall(r"^([a-z-]+):", read("Makefile"), re.MULTILINE))
    named = set(re.findall(r"(?:^|`)make ([a-z-]+)", read(name), re.MULTILINE))
    assert named
    assert named <= targets


# ---- code --------------------------------------------------------------------------------------------------


BELOW_THE_COMMANDS = [path for path in CORE if path.relative_to(SOURCE).parts[0] != "cli"]


def test_only_the_command_line_prints():
    assert [
        f"{path}:{node.lineno}"
        for path in BELOW_THE_COMMANDS
        for node in nodes(path)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "print"
    ] == []


def test_the_core_knows_no_mechanism_by_name():
    """Docstrings may give one as an example, and the command line may have a default."""
    names = [folder.name for folder in FOLDERS]
    named = [(path, text) for path in BELOW_THE_COMMANDS for text in texts(path) if any(map(text.__contains__, names))]
    assert named == []


def test_tests_mirror_the_source():
    tested = set()
    for path in (ROOT / "tests").rglob("test_*.py"):
        folder = path.parent.relative_to(ROOT / "tests")
        if folder == Path() or folder.parts[0] in NOT_MIRRORS:
            continue
        tested.add(folder)
        modules = {module.stem for module in (SOURCE / folder).glob("*.py")} | {folder.name}
        name = path.stem.removeprefix("test_")
        assert any(name == module or name.startswith(f"{module}_") for module in modules), path
    folders = {path.parent.relative_to(SOURCE) for path in CORE if path.stem != "__init__"} - {Path()}
    assert folders - tested == set()


def test_no_assertion_has_a_condition_in_place_of_its_message():
    """`assert a, b == c` passes whatever b is; `assert (a, b) == c` was meant."""
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in sorted((ROOT / "tests").rglob("*.py"))
        for node in nodes(path)
        if isinstance(node, ast.Assert) and isinstance(node.msg, (ast.Compare, ast.BoolOp))
    ]
    assert found == []


# ---- mechanisms --------------------------------------------------------------------------------------------


def test_there_are_mechanisms():
    assert len(MECHANISMS) >= 2


def test_every_mechanism_has_reference_data():
    bare = [folder for folder in MECHANISMS if not any(path.is_file() for path in (folder / "reference").iterdir())]
    assert bare == []


def test_every_mechanism_has_dimensions_or_a_topology_and_stands_in_the_catalogue():
    listed = read("docs/catalogue.md")
    for folder in FOLDERS:
        assert folder in MECHANISMS or (folder / "topology.toml").is_file(), folder
        assert folder.name.isidentifier()  # so that its closed form can be imported
        assert f"`{folder.name}`" in listed


# ---- continuous integration --------------------------------------------------------------------------------


@pytest.mark.parametrize("failing", ["test", "check", "nothing"])
def test_ci_runs_both_commands_and_fails_with_either(tmp_path, failing):
    stand_in = tmp_path / "make"
    stand_in.write_text(f'#!/bin/sh\necho "make $1"\n[ "$1" != "{failing}" ]\n')
    stand_in.chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}"}
    ran = subprocess.run([ROOT / ".ci" / "run"], env=environment, capture_output=True, text=True)
    assert ran.stdout.split("\n") == ["make .venv/installed-all", "make test", "make check", ""]
    assert (ran.returncode == 0) == (failing == "nothing")


def test_the_processes_that_ci_starts_share_their_bytecode(tmp_path):
    stand_in = tmp_path / "make"
    stand_in.write_text(
        f'#!/bin/sh\n"{sys.executable}" -c "import sys; print(sys.dont_write_bytecode, sys.pycache_prefix)"\n'
    )
    stand_in.chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}{os.pathsep}{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}
    ran = subprocess.run([ROOT / ".ci" / "run"], env=environment, capture_output=True, text=True)
    assert ran.stdout.splitlines() == [f"False {ROOT / 'build' / 'bytecode'}"] * 3


def test_no_test_has_a_limit_of_time():
    """How long something takes is measured by `make bench`; a test may only give up waiting for what hangs."""
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno}: {node.attr}"
        for path in sorted((ROOT / "tests").rglob("*.py"))
        for node in nodes(path)
        if isinstance(node, ast.Attribute) and node.attr in CLOCKS
    ]
    assert found == []
