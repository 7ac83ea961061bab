"""The installed command, as a process of its own."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

COMMAND = Path(sys.executable).with_name("assur")
HEAVY = ("numpy", "scipy", "sympy", "networkx", "pydantic", "matplotlib", "skimage", "manifold3d", "jinja2")


def test_help_loads_nothing_heavy():
    code = (
        "import sys; from assur.cli.main import main; main(['--help']); "
        f"sys.exit(' '.join(name for name in {HEAVY} if name in sys.modules) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert done.stderr.strip() == ""
    assert done.returncode == 0


def test_solids_that_are_left_at_the_end_are_not_complained_of():
    code = (
        "import sys; sys.argv = ['assur', '--version']; from assur.cli.main import main; main(); "
        "from manifold3d import Manifold; left = [Manifold.cube((1, 1, 1))]; left.append(left)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_it_runs_as_a_module_too():
    """Where the environment's folder of commands is not on the path."""
    words = ["topology", "no_such_mechanism"]
    runs = [
        subprocess.run([*command, *words], capture_output=True, text=True, timeout=60, check=False)
        for command in ([COMMAND], [sys.executable, "-m", "assur"])
    ]
    assert [run.returncode for run in runs] == [2, 2]
    assert runs[0].stderr == runs[1].stderr != ""


def test_negative_numbers_need_no_tricks(assur_process):
    run = assur_process("direct", "zeng2019", "162.6907", "-143.3209", "-24.6776", "--json")
    assert (run.code, run.err) == (0, "")
    assert len(run.json["solutions"]) == 4


@pytest.mark.parametrize(
    ("words", "code"),
    [
        (("list",), 0),
        (("direct", "zeng2019", "1"), 2),
        (("direct", "zeng2019", "900", "-900", "0"), 4),
        (("nonsense",), 2),
    ],
)
def test_exit_codes(assur_process, words, code):
    assert assur_process(*words).code == code


@pytest.mark.parametrize("words", [("show", "zeng2019"), ("show", "zeng2019", "--json"), ("--help",)])
def test_a_reader_that_goes_away_is_no_error(words):
    with subprocess.Popen([COMMAND, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 141


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full is needed")
@pytest.mark.parametrize("words", [("list",), ("list", "--json"), ("--help",)])
def test_a_full_disk_is_an_error(words):
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [COMMAND, *words], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60, check=False
        )
    assert done.returncode == 2
    assert done.stderr == "error: cannot write standard output: No space left on device\n"


def test_output_that_cannot_show_a_letter_replaces_it(assur_process):
    run = assur_process("show", "zeng2019", env={**os.environ, "PYTHONIOENCODING": "ascii"})
    assert (run.code, run.err) == (0, "")


def test_nothing_but_json_when_nobody_looks(assur_process):
    run = assur_process("workspace", "fivebar", "--resolution", "16", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json["unit"] == "mm^2"
