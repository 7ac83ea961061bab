"""`assur check`: the text's faults first and all at once, then the joint graph's; a note is no fault."""

from pathlib import Path

import pytest

HERE = Path(__file__).parent
FOURBAR = (HERE.parent / "model" / "fourbar.toml").read_text(encoding="utf-8").replace('["x", "y"]', '["x"]')
FOURBAR = FOURBAR.replace(", y = [0, 120]", "").replace('"60 deg + tilt"', "24").replace("C = -100", "C = 27")
FOURBAR = FOURBAR.replace("B = -50", "B = 22").replace("D = 125", "D = 73")
DELTA = (HERE.parent / "model" / "file" / "delta.toml").read_text(encoding="utf-8")


@pytest.fixture
def check(assur_cli, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def run(text: str, *words: str):
        (tmp_path / "m.toml").write_text(text, encoding="utf-8")
        return assur_cli("check", "m.toml", *words)

    return run


def test_a_sound_file(check) -> None:
    found = check(FOURBAR)
    assert (found.code, found.err) == (0, "")
    assert found.out.splitlines() == [
        "fourbar: sound",
        "4 links, 4 joints; 1 freedom",
        "no closed form: it is solved on its joint graph",
        "next: assur derive m.toml, for a closed form where there is one",
        "next: assur page m.toml",
    ]


def test_internal_freedoms_are_counted(assur_cli) -> None:
    assert assur_cli("check", "delta_4s").out.splitlines()[1:] == [
        "11 links, 15 joints; 3 freedoms and 6 internal freedoms",
        "a closed form stands beside it",
        "the formulas close the joint graph: exact, error < 1e-15",
    ]


def test_faults_of_the_text_come_all_at_once(check) -> None:
    text = FOURBAR.replace("value = 80", "value = -80").replace('child = "crank"', 'child = "cranc"')
    found = check(text.replace('working = "-"', 'working = "-+"'))
    assert (found.code, found.err) == (3, "")
    assert found.out.splitlines() == [
        "m.toml: 3 faults",
        "m.toml:11: parameters.l3.value: l3 = -80 mm; allowed: a positive number",
        '    hint: sign = "any" allows negative values',
        "m.toml:22: joints.A.child: unknown link 'cranc'; there is: coupler, crank, ground, rocker",
        "    hint: did you mean 'crank'?",
        'm.toml:38: modes.default.working: "-+"; allowed: + or - for each of s',
    ]


def test_faults_of_the_joint_graph_come_all_at_once(check) -> None:
    found = check(DELTA.replace("angle = 75", "angle = 40").replace("[-60, 60]", "[50, 60]"))
    assert found.code == 3
    rows = [line.split(": ")[:2] for line in found.out.splitlines() if line.startswith("m.toml")]
    assert rows == [["m.toml:24", "limbs.leg.joints.C1.cone"], ["m.toml:27", "limbs.leg.inputs.M.stroke"]]


def places(run) -> list[str]:
    return [line.split(": ")[1] for line in run.out.splitlines() if line.startswith(("m.toml:", "closed_form.py"))][1:]


def test_a_fault_of_the_text_hides_none_of_the_joint_graph_that_does_not_follow_from_it(check) -> None:
    text = FOURBAR.replace('working = "-"', 'working = "-+"').replace("x = [-40", "x = [900")
    assert places(check(text)) == ["modes.default.working", "workspace.box.x"]
    assert places(check(text.replace("value = 100", "value = 300"))) == [
        "links.ground",
        "modes.default.working",
        "workspace.box.x",
    ]
    assert places(check(text.replace("rocker = {}", "rocker = {}\nspare = {}"))) == [
        "links.spare",
        "modes.default.working",
        "workspace.box.x",
    ]


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ('child = "crank"', 'child = "cranc"', ["joints.A.child"]),
        ("value = 100", "value = -300", ["parameters.g.value"]),
        ("crank = {}", "crank = 3", ["links.crank"]),
        ('base = "ground"', 'base = "grund"', ["base"]),
        ("B = 22", "B = [1, 2]", ["home.B"]),
        ('child = "crank"', 'child = "ground"', ["joints.A.child"]),
        ('at = ["l2", 0, 0], child_at', 'at = ["l2", "lx", 0], child_at', ["joints.C.at[1]"]),
    ],
)
def test_no_fault_follows_from_one_that_is_told(check, old: str, new: str, where: list[str]) -> None:
    assert old in FOURBAR
    assert places(check(FOURBAR.replace(old, new, 1))) == where


FORM = """
from assur.model.closed_form import ClosedForm, Sign

def nothing(ns, p, given, sign):
    return {}

CLOSED_FORM = ClosedForm(
    complete_for="joint_graph", direct=None, inverse=nothing, joints=nothing, factors=nothing, jacobians=nothing,
    signs={"s": Sign("sine", "1")}, direct_margins=(), inverse_margins=(), factor_list=(),
    constraint_singular=(("v",),), self_motion_singular=(("w",),),
)
"""


def test_the_closed_form_is_looked_at_with_the_file_and_all_that_it_claims_at_once(check, tmp_path) -> None:
    (tmp_path / "closed_form.py").write_text(FORM.replace('"1")', '"-l1")'), encoding="utf-8")
    told = check(FOURBAR.replace('working = "-"', 'working = "-+"')).out
    for text in ("modes.default.working", "the group ('v',)", "the group ('w',)", "the scale '-l1' is -40"):
        assert text in told
    (tmp_path / "closed_form.py").write_text(FORM.replace('{"s"', '{"t"').replace('"1")', '"lx")'), encoding="utf-8")
    told = check(FOURBAR).out
    assert "signs t; those of [modes] in m.toml: s" in told
    assert "the scale" not in told  # it is that of another mechanism, whose parameters these are not
    (tmp_path / "closed_form.py").write_text("x = 1 / 0", encoding="utf-8")
    told = check(FOURBAR.replace('child = "crank"', 'child = "cranc"')).out
    assert "joints.A.child" in told
    assert "ZeroDivisionError" in told


def test_a_line_is_never_broken(check) -> None:
    """A fault is one line, however long, so that an editor can jump to it."""
    found = check(FOURBAR.replace("value = 100", "value = 300"))
    assert found.out.splitlines() == [
        "fourbar: 1 fault",
        "m.toml:16: links.ground: spans 300 mm between A and D, the rest of its loop only 240 mm; "
        "allowed: no side longer than the others together",
        "    hint: whatever the angles, the loop through A, B, C, D cannot close",
    ]


def test_a_note_is_no_fault(check) -> None:
    found = check(FOURBAR.replace('"mm"', '"m"'))
    assert found.code == 0
    assert found.out.splitlines()[0] == "fourbar: sound"
    assert found.out.splitlines()[3:] == [
        "note: m.toml:3: unit: the longest link measures 120 m, that is 120 m; "
        "allowed: it is unusual, but may be: 0.001 m to 50 m",
        "    hint: is it mm that is meant?",
        "next: assur derive m.toml, for a closed form where there is one",
        "next: assur page m.toml",
    ]


def test_a_home_of_another_assembly_is_noted(check) -> None:
    found = check(FOURBAR.replace("C = 27", "C = 67"))
    assert found.code == 0
    assert "the file says 67 deg" in found.out
    assert "    hint: is it the assembly that is meant?" in found.out.splitlines()


@pytest.mark.parametrize("command", ["check", "show", "topology"])
def test_a_file_named_without_its_ending_is_guessed(assur_cli, tmp_path, monkeypatch, command: str) -> None:
    monkeypatch.chdir(tmp_path)
    assert "mine.toml" not in assur_cli(command, "mine").err
    (tmp_path / "mine.toml").write_text(FOURBAR, encoding="utf-8")
    assert assur_cli(command, "mine").err.splitlines()[-1] == "hint: did you mean mine.toml?"
    path = tmp_path / "mine"
    assert assur_cli(command, str(path)).err.splitlines()[-1].endswith(f"did you mean {path}.toml?")


def test_the_same_as_json(check) -> None:
    found = check(FOURBAR.replace("value = 100", "value = 300"), "--json")
    assert found.code == 3
    assert (found.json["sound"], found.json["notes"], found.json["facts"]) == (False, [], None)
    assert found.json["faults"] == [
        {
            "file": "m.toml",
            "line": 16,
            "path": "links.ground",
            "found": "spans 300 mm between A and D, the rest of its loop only 240 mm",
            "allowed": "allowed: no side longer than the others together",
            "hint": "whatever the angles, the loop through A, B, C, D cannot close",
        }
    ]
    sound = check(FOURBAR, "--json").json
    counts = {"links": 4, "joints": 4, "freedoms": 1, "internal_freedoms": 0, "redundant_inputs": []}
    facts = {
        **counts,
        "architecture": "",
        "closed_form": False,
        "closed_form_checked": False,
        "closed_form_not_run": False,
    }
    facts |= {"exact": None, "unproved": []}
    assert (sound["sound"], sound["faults"], sound["facts"]) == (True, [], facts)


@pytest.mark.parametrize(
    ("name", "code", "told"),
    [
        ("none.toml", 2, "cannot read 'none.toml': No such file or directory"),
        (".", 2, ""),
        ("zneg2019", 2, "zeng2019"),
        ("folder", 2, "'folder' is a folder without mechanism.toml"),
        ("./file", 2, "'./file' is a file that does not end in .toml"),
        ("a" * 300, 2, "unknown mechanism 'aaa"),
    ],
)
def test_what_is_no_file_is_a_usage_error(assur_cli, tmp_path, monkeypatch, name: str, code: int, told: str) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").write_text("")
    found = assur_cli("check", name)
    assert (found.code, found.out) == (code, "")
    assert found.err.startswith("error: ")
    assert told in found.err


def test_a_topology_is_told_where_it_belongs(check) -> None:
    found = check('format = 1\nkind = "topology"\nname = "t"\nchains = ["R[z] R[z]"]')
    assert (found.code, found.out) == (2, "")
    assert found.err == "error: m.toml is a topology without dimensions\nhint: assur topology m.toml\n"


def test_what_is_not_utf_8_is_told_with_its_line(assur_cli, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.toml").write_bytes(b'format = 1\nname = "\xff"')
    found = assur_cli("check", "m.toml")
    assert found.code == 3
    assert found.out.splitlines() == ["m.toml: 1 fault", "m.toml:2: byte 0xff; allowed: UTF-8 text"]
