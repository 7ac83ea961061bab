"""A command line that cannot be parsed: what is wrong is named, and the option that was probably meant."""

import re

import pytest
from cyclopts import CycloptsError

from assur.cli import parsing
from assur.cli.application import application

WRONG = {
    "sweep zeng2019 --alng x=3": ("unknown option --alng of assur sweep", "did you mean --along"),
    "sweep zeng2019 --ouput out --along x=3": ("unknown option --ouput of assur sweep", "did you mean --output"),
    "sweep zeng2019 -o": ("-o needs a value", ""),
    "synthesize --known --top 3 --new": ("one of --known and --new may be given", ""),
    "synthesize --top 3 --top 4": ("--top is given twice", ""),
    "sweep zeng2019 --output": ("--output needs a value", ""),
    "sweep zeng2019 --along x=3": ("--output (or -o) is missing", ""),
    "certify zeng2019 --finst=3": ("unknown option --finst of assur certify", "did you mean --finest"),
    "certify zeng2019 -x": ("unknown option -x of assur certify", ""),
    "certify zeng2019 -f out.json": ("unknown option -f of assur certify", ""),
    "certify zeng2019 --kind box --zzzzzz 3": ("unknown option --zzzzzz of assur certify", ""),
    "list --set l2=1": ("unknown option --set of assur list", ""),
    "stiffness zeng2019 --no-sheer": ("unknown option --no-sheer of assur stiffness", "did you mean --no-shear? see"),
    "follow zeng2019 --too 1,2,3": ("unknown option --too of assur follow", "did you mean --to"),
    "verify": ("FILE is missing", ""),
    "direct": ("MECHANISM is missing", ""),
    "workspace zeng2019 --box": ("--box needs a value", ""),
    "singularity zeng2019 --pose": ("--pose needs a value", ""),
    "indices zeng2019 --pose --at y=0": ("--pose needs a value", ""),
    "show -": ("unknown option - of assur show", ""),
    "--jsn": ("unknown option --jsn", ""),
}


@pytest.mark.parametrize("words", WRONG)
def test_what_is_wrong_is_named_with_what_was_meant(assur_cli, words):
    message, guess = WRONG[words]
    run = assur_cli(*words.split())
    name = words.split()[0]
    see = "assur --help" if name.startswith("-") else f"assur {name} --help"
    lines = run.err.splitlines()
    assert (run.code, run.out, lines[0]) == (2, "", f"error: {message}")
    assert lines[1].startswith(f"hint: {guess}")
    assert lines[1].endswith(f"see {see}")


@pytest.mark.parametrize("name", [name for name in application() if not name.startswith("-")])
def test_every_command_names_the_unknown_option_and_not_another(assur_cli, name):
    run = assur_cli(name, "--xyzzy", "3")
    assert (run.code, run.out) == (2, "")
    assert run.err == f"error: unknown option --xyzzy of assur {name}\nhint: see assur {name} --help\n"


def test_a_slip_in_any_option_is_answered_with_that_option():
    app = application()
    for name in (name for name in app if not name.startswith("-")):
        options = [item for item in parsing.options(app, [name]) if item.startswith("--") and len(item) > 5]
        assert options
        for option in options:
            slip = f"{option[:-2]}{option[-1]}{option[-2]}" if option[-1] != option[-2] else f"{option}{option[-1]}"
            if slip not in options:
                found = parsing.complaint(app, [name, slip], CycloptsError())
                assert found.message == f"unknown option {slip} of assur {name}"
                assert re.match(rf"did you mean [^?]*{option}\b", found.hint)


def test_options_follow_the_command(assur_cli):
    run = assur_cli("--json", "list")
    assert (run.code, run.err) == (
        2,
        "error: --json before the command\nhint: options follow it, as assur list --json\n",
    )


def test_a_value_that_looks_like_an_option_is_none(assur_cli):
    for words in ("inverse zeng2019 -15 -9 300", "inverse zeng2019 -15 -9 300 --mode=++-++"):
        assert assur_cli(*words.split()).code in (0, 4)
    run = assur_cli("show", "--", "--zeng2019")
    assert "unknown option" not in run.err
