"""Bad input gets a clear error and the right exit code; with --json it is one object on standard output too."""

import pytest

import assur

GIVE = "give it like -143.3209 or 1.5e3, without a unit"
WORKING = "one sign + or - for each of: s_alpha, s_beta, u1, u2, u3"
DIMENSIONS = "a, b, d, l1, l2, l3, l4, l5, l6, l7, l8"
BAD = {
    "direct zeng2019 1 2": "inputs of zeng2019: 2 values, 3 wanted\nhint: give yA1, yA2, yA3",
    "direct zeng2019": "inputs of zeng2019: 0 values, 3 wanted\nhint: give yA1, yA2, yA3",
    "direct zeng2019 1 2 3 4": "inputs of zeng2019: 4 values, 3 wanted\nhint: give yA1, yA2, yA3",
    "inverse zeng2019 1": "pose of zeng2019: 1 value, 3 wanted\nhint: give x, y, z",
    "direct zeng2019 1 nan 3": "yA2: nan is not a finite number",
    "direct zeng2019 1 2 -inf": "yA3: -inf is not a finite number",
    "inverse zeng2019 1e400 2 3": "x: 1e400 is too large",
    "direct zeng2019 1 2 abc": f"yA3: 'abc' is not a number\nhint: {GIVE}",
    "direct zeng2019 1 2 -1,5": "yA3: '-1,5' is not a number\nhint: write a decimal point: -1.5",
    "direct zeng2019 1 2 -3mm": f"yA3: '-3mm' is not a number\nhint: {GIVE}",
    "direct zen 1 2 3": "unknown mechanism 'zen'; there is: "
    + ", ".join(assur.names())
    + "\nhint: did you mean zeng2019?",
    "show": "MECHANISM is missing\nhint: see assur show --help",
    "direct zeng2019 1 2 3 --set l2=0": (
        "parameter 'l2' of zeng2019 (links 9 and 10) cannot be 0; allowed: a positive number in mm"
    ),
    "direct zeng2019 1 2 3 --set l2=-5": (
        "parameter 'l2' of zeng2019 (links 9 and 10) cannot be -5; allowed: a positive number in mm"
    ),
    "direct zeng2019 1 2 3 --set l7=-1": (
        "parameter 'l7' of zeng2019 (link 5, C3 to D3) cannot be -1; allowed: zero or a positive number in mm"
    ),
    "direct zeng2019 1 2 3 --set l22=5": (
        f"unknown parameter of zeng2019 'l22'; there is: {DIMENSIONS}\nhint: did you mean l2?"
    ),
    "direct zeng2019 1 2 3 --set self=5": f"unknown parameter of zeng2019 'self'; there is: {DIMENSIONS}",
    "direct zeng2019 1 2 3 --set name=5": f"unknown parameter of zeng2019 'name'; there is: {DIMENSIONS}",
    "direct zeng2019 1 2 3 --set l2=abc": f"--set l2: 'abc' is not a number\nhint: {GIVE}",
    "direct zeng2019 1 2 3 --set l2=3,5": "--set l2: '3,5' is not a number\nhint: write a decimal point: 3.5",
    "direct zeng2019 1 2 3 --set l2=nan": "--set l2: nan is not a finite number",
    "direct zeng2019 1 2 3 --set l2": "--set: 'l2' is not NAME=VALUE\nhint: for example --set l2=300",
    "direct zeng2019 1 2 3 --set l2=1 --set l2=2": "--set: l2 is given twice",
    "list --set l2=1": "unknown option --set of assur list\nhint: see assur list --help",
    "direct zeng2019 1 2 3 --jsno": (
        "unknown option --jsno of assur direct\nhint: did you mean --json? see assur direct --help"
    ),
    "direct zeng2019 1 2 3 --mode": "--mode needs a value\nhint: see assur direct --help",
    "direct zeng2019 1 2 3 --mode ++0": (
        "unknown assembly mode of zeng2019 '++0'; there is: +++, ++-, +-+, +--, -++, -+-, --+, ---\n"
        "hint: one sign + or - for each of: e1, e2, e3"
    ),
    "singularity zeng2019 --pose 1 2": "pose of zeng2019: 2 values, 3 wanted\nhint: give x, y, z",
    "singularity zeng2019 1 2 3": "too many values: 1, 2, 3\nhint: see assur singularity --help",
    "workspace zeng2019 --box x=90:-110": "--box x = 90:-110 is turned round or empty\nhint: give LOW < HIGH",
    "workspace zeng2019 --box q=-1:1": "unknown pose coordinate of zeng2019 'q'; there is: x, y, z",
    "workspace zeng2019 --box -110:90": "--box: '-110:90' is not NAME=VALUE\nhint: for example --box x=-110:90",
    "workspace zeng2019 --box x=-110": "--box x: '-110' is not LOW:HIGH\nhint: for example --box x=-110:90",
    "workspace zeng2019 --box x=-1,5:3": "--box x: '-1,5' is not a number\nhint: write a decimal point: -1.5",
    "workspace zeng2019 --stroke 300:-300": "--stroke = 300:-300 is turned round or empty\nhint: give LOW < HIGH",
    "workspace zeng2019 --stroke q=-1:1": "unknown input of zeng2019 'q'; there is: yA1, yA2, yA3",
    "workspace zeng2019 --stroke -1:1 --stroke -2:2": (
        "--stroke: two intervals for all inputs\nhint: name the input, as --stroke yA1=-300:300"
    ),
    "workspace zeng2019 --stroke=-1:1,yA1=-2:2 --stroke -3:3": (
        "--stroke: two intervals for all inputs\nhint: name the input, as --stroke yA1=-300:300"
    ),
    "workspace zeng2019 --box x=1:2,": (
        "--box: 'x=1:2,' has a comma too many\nhint: put one between two parts, none at the end"
    ),
    "workspace zeng2019 --near -5": "--near: -5 is not a positive length",
    "workspace zeng2019 --near 0": "--near: 0 is not a positive length",
    "workspace zeng2019 --resolution 5.5": "--resolution: '5.5' is not a whole number",
    "workspace zeng2019 --resolution -5": "--resolution: (-5, -5, -5); 2 to 400 cells along each coordinate",
    "workspace zeng2019 -o /nowhere/x.json": (
        "cannot write /nowhere/x.json: the folder /nowhere does not exist\nhint: mkdir -p /nowhere"
    ),
    "workspace zeng2019 -o x.stl": "cannot write x.stl: its ending is none of .json, .obj\nhint: rename it",
    "show nowhere.toml": "cannot read 'nowhere.toml': No such file or directory",
}


@pytest.mark.parametrize("words", BAD)
def test_a_clear_error(assur_cli, words):
    run = assur_cli(*words.split())
    assert (run.code, run.out, run.err) == (2, "", f"error: {BAD[words]}\n")


@pytest.mark.parametrize("words", BAD)
def test_with_json_the_error_is_one_object_too(assur_cli, words):
    run = assur_cli(*words.split(), "--json")
    assert (run.code, run.err) == (2, f"error: {BAD[words]}\n")
    message, _, hint = BAD[words].partition("\nhint: ")
    assert run.json == {"error": {"message": message, "hint": hint, "exit_code": 2, "problems": []}}


def test_with_json_the_problems_of_a_file_come_with_their_places(assur_cli, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('format = 1\nname = 3\nunit = "mm"\ncolour = "red"\n')
    run = assur_cli("direct", str(path), "1", "--json")
    error = run.json["error"]
    assert (run.code, error["exit_code"]) == (3, 3)
    assert (2, "name") in [(item["line"], item["path"]) for item in error["problems"]]
    assert all(item["file"] == str(path) and item["allowed"] for item in error["problems"])


def test_an_unknown_mode_lists_all_of_them(assur_cli):
    run = assur_cli("inverse", "zeng2019", "1", "2", "3", "--mode", "+++")
    assert run.code == 2
    assert run.err.startswith("error: unknown working mode of zeng2019 '+++'; there is: +++++, ++++-, ")
    assert run.err.endswith(f"\nhint: {WORKING}\n")


def test_an_unknown_command_is_answered_with_the_near_one(assur_cli):
    run = assur_cli("dirct", "zeng2019", "1", "2", "3")
    assert run.code == 2
    assert run.err.startswith('error: unknown command "dirct". Did you mean "direct"? Available commands: ')
    assert run.err.endswith("\nhint: see assur --help\n")


def test_a_bad_file_exits_3_and_lists_all_its_problems(assur_cli, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('format = 1\nname = 3\nunit = "mm"\ncolour = "red"\n')
    run = assur_cli("show", str(path))
    assert (run.code, run.out) == (3, "")
    assert f"{path}:2: name: 3; allowed: a text in quotes" in run.err
    assert f"{path}:4: colour" in run.err


def test_a_fault_that_only_the_joint_graph_shows_is_told_when_it_is_solved(assur_cli):
    from pathlib import Path

    path = Path(__file__).parents[1] / "model" / "fourbar.toml"
    assert assur_cli("show", str(path)).code == 0
    run = assur_cli("direct", str(path), "30")
    assert run.code == 3
    assert "platform.pose: x, y: only 1 of 2 can be chosen" in run.err


def test_an_output_that_cannot_be_written_leaves_the_old_file_whole(assur_cli, tmp_path, monkeypatch):
    path = tmp_path / "out.json"
    path.write_text("old")

    def full(self, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    run = assur_cli("workspace", "fivebar", "--resolution", "8", "-o", str(path))
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith(f"error: cannot write {path}: No space left on device\n")
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == ["out.json"]


def test_a_folder_is_no_output_file(assur_cli, tmp_path):
    run = assur_cli("workspace", "fivebar", "-o", str(tmp_path))
    assert (run.code, run.out) == (2, "")
    assert run.err == f"error: cannot write {tmp_path}: it is a folder\nhint: give a file that ends in .json or .obj\n"


def test_debug_shows_the_traceback_and_keeps_the_exit_code(assur_cli):
    run = assur_cli("direct", "zeng2019", "1", "--debug")
    assert run.code == 2
    assert run.err.startswith("Traceback (most recent call last):")
    assert run.err.endswith("error: inputs of zeng2019: 1 value, 3 wanted\nhint: give yA1, yA2, yA3\n")


@pytest.mark.parametrize("json", [False, True])
def test_a_bug_of_ours_is_one_line_and_exits_70(assur_cli, monkeypatch, json):
    def broken(*_, **__):
        raise ZeroDivisionError("a\nb")

    monkeypatch.setattr("assur.mechanism.Mechanism.direct", broken)
    words = ["direct", "zeng2019", "1", "2", "3", *["--json"] * json]
    run = assur_cli(*words)
    assert run.code == 70
    assert run.err == "error: a bug in assur: ZeroDivisionError: a b\nhint: run with --debug\n"
    if json:
        assert run.json["error"]["message"] == "a bug in assur: ZeroDivisionError: a b"
    else:
        assert run.out == ""
    assert "Traceback" in assur_cli(*words, "--debug").err


def test_an_interrupt_exits_130(assur_cli, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr("assur.mechanism.Mechanism.direct", interrupted)
    run = assur_cli("direct", "zeng2019", "1", "2", "3")
    assert (run.code, run.out, run.err) == (130, "", "interrupted: there is no answer yet\n")
    run = assur_cli("direct", "zeng2019", "1", "2", "3", "--json")
    assert run.code == run.json["error"]["exit_code"] == 130


SERIAL = """
format = 1
name = "arm"
unit = "mm"
angle = "deg"
base = "base"
platform = { link = "b", pose = ["x", "y"] }
[parameters]
l = { value = 100, meaning = "length" }
[links]
base = { meaning = "base" }
a = { meaning = "first" }
b = { meaning = "second" }
[joints]
A = { type = "revolute", parent = "base", child = "a", axis = "z" }
B = { type = "revolute", parent = "a", child = "b", at = ["l", 0, 0], axis = "z" }
[inputs]
A = { name = "q1" }
B = { name = "q2" }
[home]
A = 10
B = 40
"""


@pytest.mark.parametrize(
    "command", ["check", "show", "report", "singularity", "indices", "forces", "errors", "identify --count 3"]
)
def test_a_file_without_a_loop_is_refused_by_every_command(assur_cli, tmp_path, monkeypatch, command):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.toml").write_text(SERIAL, encoding="utf-8")
    name, *rest = command.split()
    posed = ["--pose", "90", "20"] * (name in ("singularity", "indices", "forces", "errors"))
    run = assur_cli(name, "arm.toml", *posed, *rest)
    assert "no loop: nothing but serial chains" in run.out + run.err
    assert run.code in (1, 3)
