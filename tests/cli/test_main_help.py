import pytest

import assur
from assur.cli.application import application

COMMANDS = (
    *("list", "show", "check", "topology", "direct", "inverse", "follow", "singularity", "workspace", "certify"),
    *(
        "verify",
        "audit",
        "figures",
        "report",
        "new",
        "schema",
        "export",
        "crosscheck",
        "indices",
        "synthesize",
        "forces",
        "stiffness",
        "errors",
        "identify",
        "calibrate",
        "dynamics",
    ),
    *("aspects", "derive", "sweep", "page", "view", "motion", "collisions", "demo", "doctor", "cache"),
)


def test_all_commands_are_there(assur_cli):
    run = assur_cli("--help")
    assert (run.code, run.err) == (0, "")
    assert all(f"│ {name} " in run.out for name in COMMANDS)
    assert {name for name in application() if not name.startswith("-")} == set(COMMANDS)


def test_no_words_print_the_help(assur_cli):
    assert assur_cli() == assur_cli("--help")


@pytest.mark.parametrize("name", COMMANDS)
def test_each_command_explains_itself_with_an_example(assur_cli, name):
    run = assur_cli(name, "-h")
    assert (run.code, run.err) == (0, "")
    assert run.out == assur_cli(name, "--help").out
    assert "For example:\n    assur " + name in run.out
    assert "--json" in run.out
    assert "--debug" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_says_what_it_means(name):
    arguments = application()[name].assemble_argument_collection()
    for argument in arguments:
        if argument.parameter.name != ("*",) and argument.parse:
            assert argument.parameter.help, f"{name} {argument.name}"


def test_version(assur_cli):
    assert assur_cli("--version").out == f"{assur.__version__}\n"
