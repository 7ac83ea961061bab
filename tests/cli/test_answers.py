"""Every command's --json against the schema of its answers: built-in mechanisms, one's own, refusals and failures.

`assur_cli` holds whatever it is given to the schema; the rest of this folder does so at every --json too.
"""

import json
import shutil
from pathlib import Path

import jsonschema
import pytest

import assur
from assur.cli.answers import ANSWERS
from assur.cli.application import COMMANDS
from assur.cli.main import main
from assur.results.answers.schema import schema_of

CLI = Path(assur.__file__).parent / "cli"
CHAINS = ("--limb", "P[x] R[z] R[z]", "--count", "3")
TOLD = {
    "show": (),
    "check": (),
    "topology": (),
    "direct": ("0", "0", "0"),
    "inverse": ("0", "0", "0"),
    "follow": ("--to", "1", "1", "0"),
    "singularity": ("--pose", "0", "0", "0"),
    "forces": ("--pose", "0", "0", "0", "--no-gravity"),
    "indices": ("--pose", "0", "0", "0"),
    "export": ("-o", "own.xml"),
    "figures": ("--only", "structure", "--format", "svg", "-o", "figures"),
    "audit": (),
}
"""What a mechanism of one's own is asked: command -> words after its name."""


@pytest.fixture(scope="module")
def drafted(tmp_path_factory):
    """The file of a mechanism that nobody has seen before, without a closed form."""
    path = tmp_path_factory.mktemp("drafted") / "own.toml"
    assert main(["new", str(path), *CHAINS]) == 0
    return path


@pytest.fixture
def own(tmp_path, monkeypatch, drafted):
    """A copy of it in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    shutil.copy(drafted, "own.toml")
    return "own.toml"


def test_what_is_drafted_is_answered_as_the_schema_says(assur_cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    run = assur_cli("new", "own.toml", *CHAINS, "--json")
    assert (run.code, run.json["files"]) == (0, ["own.toml"])


def test_every_command_says_which_answers_it_gives():
    assert ANSWERS.keys() == COMMANDS


def test_no_command_hands_dictionaries_of_anything_around():
    text = {path.name: path.read_text(encoding="utf-8").count("dict[str, Any]") for path in CLI.glob("*.py")}
    assert {name: count for name, count in text.items() if count} == {}


def test_the_schema_of_all_commands_is_one(assur_cli):
    schema = assur_cli("schema", "--answers", "--json").json
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["$defs"].keys() >= COMMANDS
    assert schema == schema_of(ANSWERS)
    assert json.loads(assur_cli("schema", "--answers").out) == schema


def test_that_of_one_command_says_less(assur_cli):
    schema = assur_cli("schema", "--answers", "direct", "--json").json
    assert schema == schema_of({"direct": ANSWERS["direct"]})
    assert "InverseAnswer" not in schema["$defs"]


@pytest.mark.parametrize("words", [("direct",), ("--answers", "directly")])
def test_a_schema_of_what_is_no_command_is_refused(assur_cli, words):
    assert assur_cli("schema", *words, "--json").code == 2


@pytest.mark.parametrize("command", TOLD)
def test_a_mechanism_of_one_s_own_is_answered_as_the_schema_says(assur_cli, own, command):
    run = assur_cli(command, own, *TOLD[command], "--json")
    assert run.code in (0, 2, 4, 5, 6)
    assert ("error" in run.json) == (run.code == 2)
    assert run.json.get("mechanism", run.json.get("name", "own")) == "own"


@pytest.mark.parametrize("command", TOLD)
def test_so_is_what_cannot_be_read(assur_cli, own, command):
    Path("bad.toml").write_text(f"size = 1\n{Path(own).read_text(encoding='utf-8')}", encoding="utf-8")
    run = assur_cli(command, "bad.toml", *TOLD[command], "--json")
    assert run.code == 3
    problems = run.json["faults"] if command == "check" else run.json["error"]["problems"]
    assert problems


@pytest.mark.parametrize(
    "words",
    [
        ("direct", "fivebar", "900", "x"),
        ("direct", "fivebar", "127", "53", "--set", "l2=1"),
        ("inverse", "zeng2019", "0", "0", "2000"),
        ("inverse", "fivebar", "900", "0", "--certify"),
        ("workspace", "fivebar", "--resolution", "8", "--box", "x=800:900"),
        ("list",),
        ("cache",),
        ("schema",),
        ("verify", "nothing.json"),
        ("crosscheck", "fivebar", "--samples", "0"),
    ],
)
def test_failures_and_what_is_of_no_mechanism(assur_cli, own, words):
    assert assur_cli(*words, "--json").json
