"""`assur.topology` is a function and a package, and takes whatever names a mechanism."""

import importlib
import subprocess
import sys
import types
from pathlib import Path

import pytest

import assur
from assur.errors import UnknownNameError, UsageError
from assur.topology.facts import Topology
from assur.topology.notation import NotationError

TRIPTERON = ["P[x] R[x] R[x] R[x]", "P[y] R[y] R[y] R[y]", "P[z] R[z] R[z] R[z]"]
FILE = Path(assur.__file__).parent / "mechanisms" / "tripteron" / "topology.toml"


def told(found):
    """What topologies that are the same say alike."""
    return str(found.poc), found.dof, found.xi, found.coupling_degree, found.inputs


def test_the_package_is_callable_and_stays_a_package():
    assert isinstance(assur.topology, types.ModuleType)
    assert importlib.import_module("assur.topology") is assur.topology
    assert importlib.import_module("assur.topology.chains").__name__ == "assur.topology.chains"
    assert isinstance(assur.topology("fivebar"), Topology)


@pytest.mark.parametrize(
    "line",
    [
        "import assur, sys; print(callable(assur.topology), 'numpy' in sys.modules)",
        "import assur.topology.chains, sys; import assur; print(callable(assur.topology), False)",
        "import sys; from assur import topology; print(callable(topology), 'numpy' in sys.modules)",
    ],
)
def test_in_a_fresh_interpreter_it_is_there_without_slow_libraries(line):
    ran = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["True", "False"]


def test_the_same_mechanism_by_name_file_folder_and_chains():
    expected = told(assur.topology("tripteron"))
    assert expected == ("t³ r⁰", 3, (5, 4), 1, ("P1", "P2", "P3"))
    for what in (FILE, str(FILE), FILE.parent, TRIPTERON, tuple(TRIPTERON)):
        assert told(assur.topology(what)) == expected
    assert assur.topology(FILE).title == assur.topology("tripteron").title != ""


def test_a_mechanism_by_name_and_by_itself():
    record = assur.load("zeng2019")
    for found in (assur.topology("zeng2019"), assur.topology(record), record.topology()):
        assert told(found) == ("t³ r⁰", 3, (3, 5), 1, ("P1", "P2", "P3"))
        assert found.name == "zeng2019"


@pytest.mark.parametrize("text", ["R[x] R[x] R[x] R[y] R[y]", "P", "S", "-R|R|R-", "UPS", "U P S"])
def test_a_text_with_a_chain_is_a_chain(text):
    found = assur.topology(text)
    assert len(found.limbs) == 1
    assert found.poc.dim == found.limbs[0].poc.dim == assur.topology([text]).poc.dim


def test_the_mode_is_that_of_the_file_unless_another_is_asked_for():
    assert assur.topology("three_upu").mode == "translation"
    assert assur.topology("tripteron").mode == "home"
    asked = assur.topology("tripteron", mode="translation")
    assert (asked.mode, str(asked.poc)) == ("translation", "t³ r⁰")
    assert assur.load("zeng2019").topology(mode="translation").mode == "translation"


@pytest.mark.parametrize("what", ["tripteron", TRIPTERON])
def test_inputs_by_number(what):
    found = assur.topology(what, actuate=["1.2", "2.1", "3.4"])
    assert found.inputs == ("R1", "P2", "R9")
    assert assur.topology(what, actuate=[]).inputs == ("P1", "P2", "P3")


def test_inputs_of_a_mechanism_with_dimensions_by_number():
    mechanism = assur.load("zeng2019")
    assert mechanism.topology(actuate=["1.2", "1.4", "2.1"]).inputs == ("B1", "P2", "P3")
    turning = mechanism.topology(actuate=["1.1", "1.4", "2.2"])  # the parallelogram, by its first hinge
    assert turning.decoupling.inputs == ("P1", "P2", "Pa1")
    assert turning.actuation.verdict == "valid"
    assert turning.decoupling.inputs_of("y") == ("P1", "P2")


@pytest.mark.parametrize(
    ("what", "options", "error", "words"),
    [
        ("tripteronn", {}, UnknownNameError, "did you mean tripteron"),
        ("tri_pyramid", {}, UnknownNameError, "is left out"),
        ("nowhere.toml", {}, UsageError, "nowhere.toml"),
        ("some/where", {}, UsageError, "some/where"),
        (Path("nowhere"), {}, UsageError, "nowhere"),
        ("P[x] Q[x]", {}, NotationError, "expected"),
        ("", {}, NotationError, "expected a joint"),
        ([], {}, UsageError, "no limbs"),
        (3, {}, UsageError, "a topology is given by a name, a file or chains of joints, not by 3"),
        (None, {}, UsageError, "not by None"),
        ("tripteron", {"mode": "free"}, UnknownNameError, "unknown mode 'free'; there is: 3T, home, translation"),
        ("tripteron", {"actuate": ["4.1"]}, UsageError, "there is no limb 4"),
        ("zeng2019", {"actuate": ["2.9"]}, UsageError, "limb 2 has joints 1 to 3"),
    ],
)
def test_what_is_refused(what, options, error, words):
    with pytest.raises(error) as found:
        assur.topology(what, **options)
    assert words in str(found.value)
