"""What the commonest commands load: third-party packages by name, modules of assur by number."""

import json
import os
import subprocess
import sys

import pytest

from assur.cli.application import COMMANDS
from assur.cli.main import main

CODE = """
import sys
before = set(sys.modules)
from assur.cli.main import main
code = main(sys.argv[1:])
import json
print(json.dumps(sorted(set(sys.modules) - before)), file=sys.stderr)
sys.exit(code)
"""
LINE = {"attr", "attrs", "cyclopts", "docstring_parser", "rich", "typing_extensions"}
"""What reads a command line and prints tables."""
READ = {"annotated_types", "pydantic", "pydantic_core", "typing_inspection"}
"""What checks the form of a file that is read for the first time."""
NUMPY = {"numpy", "cython_runtime"}
"""With what its compiled modules bring."""
DIRECT = ("direct", "zeng2019", "162.6907", "-143.3209", "-24.6776")
INVERSE = ("inverse", "zeng2019", "-15.4714", "9.6849", "456.3315")


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    return tmp_path_factory.mktemp("cache")


def loaded(cache, words):
    """Packages that are not of Python, and modules of assur, that a command loads in a process of its own."""
    environment = {**os.environ, "ASSUR_CACHE": str(cache)}
    call = [sys.executable, "-c", CODE, *words]
    done = subprocess.run(call, capture_output=True, text=True, check=True, timeout=120, env=environment)
    modules = json.loads(done.stderr.splitlines()[-1])
    packages = {name.partition(".")[0] for name in modules} - sys.stdlib_module_names
    return {name for name in packages if not name.startswith("_")}, [name for name in modules if name[:5] == "assur"]


def test_a_check_sets_no_type_to_see_that_labels_can_be_set(cache):
    assert "matplotlib" not in loaded(cache, ("check", "tripteron"))[0]


@pytest.mark.parametrize(
    ("words", "packages", "most"),
    [
        (("--help",), set(), 21 + len(COMMANDS)),  # of each command its own module
        (("list",), NUMPY | READ, 122),
        (("show", "zeng2019"), NUMPY, 131),
        (DIRECT, NUMPY, 139),
        (INVERSE, NUMPY, 139),
    ],
)
def test_a_command_loads_what_it_prints_and_no_more(cache, words, packages, most):
    """The second time: what was read of files is kept by then."""
    if words != ("--help",):
        loaded(cache, words)
    third_party, own = loaded(cache, words)
    assert third_party - {"assur"} <= LINE | packages
    assert len(own) <= most


def test_a_file_is_checked_the_first_time(tmp_path):
    third_party, _ = loaded(tmp_path, DIRECT)
    assert third_party >= READ
    assert third_party - {"assur"} <= LINE | READ | NUMPY


def test_a_file_without_labels_is_checked_without_what_draws(tmp_path):
    file = str(tmp_path / "mine.toml")
    assert main(["new", file, "--limb", "R[z] R[z] R[z]"]) == 0
    third_party, _ = loaded(tmp_path, ("check", file))
    assert third_party.isdisjoint({"matplotlib", "manifold3d", "networkx", "scipy"})


def test_a_second_answer_about_a_file_of_ones_own_loads_no_scipy(tmp_path):
    """Names of modes are kept by then."""
    file = str(tmp_path / "mine.toml")
    assert main(["new", file, "--limb", "P[z] R[y] S"]) == 0
    pose = ("inverse", file, "300", "5", "-3")
    loaded(tmp_path, pose)
    assert loaded(tmp_path, pose)[0] - {"assur"} <= LINE | READ | NUMPY
