from pathlib import Path

import pytest

import assur
from assur.model.file.reader import read_text
from assur.model.registry import load_record

HYBRID = ("--chain", "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "--chain", "P[y] P(4R)[y] P(4R)[x]")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_copy_is_sound_and_says_where_it_came_from(assur_cli, folder):
    run = assur_cli("new", "my.toml", "--from", "delta_4s")
    assert (run.code, run.err) == (0, "")
    words = " ".join(run.out.split())
    assert "wrote my.toml" in words
    assert "delta_4s of the catalogue" in words
    assert "its closed form stays behind" in words
    assert "assur check my.toml" in words
    assert list(folder.iterdir()) == [folder / "my.toml"]
    assert assur_cli("check", "my.toml").code == 0
    assert assur.load("my.toml").closed_form is None


def test_the_beginning_of_a_name_is_enough(assur_cli, folder):
    assert assur_cli("new", "my.toml", "--from", "delta").code == 0
    assert "a copy of delta_4s" in Path("my.toml").read_text(encoding="utf-8")


def test_a_name_that_is_not_there_names_the_near_ones(assur_cli, folder):
    run = assur_cli("new", "my.toml", "--from", "tripteronn")
    assert run.code == 2
    assert "did you mean tripteron" in run.err
    assert list(folder.iterdir()) == []


def test_a_closed_form_comes_along_if_asked_for(assur_cli, folder):
    data = assur_cli("new", "my.toml", "--from", "delta_4s", "--with-closed-form", "--json").json
    assert data["files"] == ["my.toml", "closed_form.py"]
    mine, model = assur.load("my.toml"), assur.load("delta_4s")
    assert mine.direct([0.1, 0.2, 0.3]).poses == pytest.approx(model.direct([0.1, 0.2, 0.3]).poses, nan_ok=True)
    assert mine.closed_form is not None


@pytest.mark.parametrize("force", [(), ("--force",)])
def test_a_closed_form_is_not_put_beside_the_files_of_others(assur_cli, folder, force):
    assert assur_cli("new", "five.toml", "--from", "fivebar").code == 0
    run = assur_cli("new", "fc.toml", "--from", "fivebar", "--with-closed-form", *force)
    assert run.code == 2
    assert "five.toml stands in the folder of fc.toml" in " ".join(run.err.split())
    assert str(Path("fc", "fc.toml")) in run.err
    assert list(folder.iterdir()) == [folder / "five.toml"]
    Path("fc").mkdir()
    assert assur_cli("new", str(Path("fc", "fc.toml")), "--from", "fivebar", "--with-closed-form").code == 0
    assert assur.load(Path("five.toml")).closed_form is None


def test_what_is_there_stays_there_unless_forced(assur_cli, folder):
    Path("my.toml").write_text("mine", encoding="utf-8")
    for words in (("--from", "fivebar"), ("--limb", "R[z] R[z] R[z]")):
        run = assur_cli("new", "my.toml", *words)
        assert (run.code, Path("my.toml").read_text(encoding="utf-8")) == (2, "mine")
        assert "--force" in run.err
        assert assur_cli("new", "my.toml", *words, "--force").code == 0
        assert Path("my.toml").read_text(encoding="utf-8") != "mine"
        Path("my.toml").write_text("mine", encoding="utf-8")


@pytest.mark.parametrize("words", [("--from", "fivebar"), ("--from", "fivebar", "--with-closed-form"), HYBRID])
def test_another_s_closed_form_is_neither_read_nor_replaced(assur_cli, folder, words):
    Path("closed_form.py").write_text("raise SystemExit", encoding="utf-8")
    run = assur_cli("new", "my.toml", *words)
    assert run.code == 2
    assert "closed_form.py is there already" in run.err
    assert [path.name for path in folder.iterdir()] == ["closed_form.py"]
    assert Path("closed_form.py").read_text(encoding="utf-8") == "raise SystemExit"


@pytest.mark.parametrize(
    "words",
    [
        *(("--limb", "R[z] R[z] R[z]", "--count", "3"), ("--limb", "R[y] P(4S)[y]")),
        *(pytest.param(words, marks=pytest.mark.deep) for words in (HYBRID, ("--from", "six_sps"))),
    ],
)
def test_a_draft_is_sound_and_can_be_shown(assur_cli, folder, words):
    run = assur_cli("new", "my.toml", *words)
    assert (run.code, run.err) == (0, "")
    assert "it is sound, and this is its topology" in " ".join(run.out.split())
    assert assur_cli("check", "my.toml").code == 0
    assert assur_cli("show", "my.toml", "--json").json["home"]["residual"] < 1e-9
    assert "://" not in Path("my.toml").read_text(encoding="utf-8")


def test_a_draft_is_the_same_every_time(assur_cli, folder):
    texts = []
    for name in ("a", "b"):
        assur_cli("new", f"{name}.toml", *HYBRID)
        texts.append(Path(f"{name}.toml").read_text(encoding="utf-8").partition("title")[2])
    assert texts[0] == texts[1]


def test_what_is_driven_can_be_chosen(assur_cli, folder):
    assur_cli("new", "my.toml", "--limb", "R[z] R[z] R[z]", "--actuate", "1.2,2.2,3.2")
    record = read_text(Path("my.toml").read_text(encoding="utf-8"), Path("my.toml"))
    assert [item.coordinate.joint for item in record.inputs] == ["leg1.B", "leg2.B", "leg3.B"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("my.toml",), "nothing to begin with"),
        (("my.toml", "--from", "fivebar", "--chain", "R[z]"), "--from and --chain"),
        (("my.toml", "--chain", "R[z]", "--limb", "R[z]"), "--chain and --limb"),
        (("my.toml", "3-RPS", "--limb", "R[z]"), "a shorthand and --limb"),
        (("my.toml", "--limb", "R[z]", "--limb", "P[x]"), "given 2 times"),
        (("my.toml", "3-RPS", "--from", "fivebar"), "a shorthand and --from"),
        (("my.toml", "3-RPS", "--count", "3"), "--count goes with"),
        (("my.toml", "3-RQS"), "at character 4"),
        (("my.toml", "2U_P_R-SPR"), "too few"),
        (("my.toml", "--chain", "R[q]"), "R[q]"),
        (("my.toml", "--limb", "R[z] R[z] R[z]", "--count", "x"), "whole number"),
        (("my.toml", "--limb", "R[z] R[z] R[z]", "--count", "1"), "allowed: 2 to 60"),
        (("my.toml", "--chain", "R[z] R[z] R[z]"), "one open chain"),
        (("my.toml", "--from", "fivebar", "--count", "3"), "--count goes with"),
        (("my.toml", *HYBRID, "--count", "3"), "--count goes with"),
        (("my.toml", *HYBRID, "--with-closed-form"), "--with-closed-form goes with"),
        (("my.toml", *HYBRID, "--mode", "sideways"), "unknown mode"),
        (("my.txt", "--from", "fivebar"), "ends in .toml"),
        (("missing/my.toml", "--from", "fivebar"), "does not exist"),
        (("missing/my.toml", "--limb", "R[z] R[z] R[z]"), "does not exist"),
    ],
)
def test_misuse_is_refused_and_writes_nothing(assur_cli, folder, words, said):
    run = assur_cli("new", *words)
    assert run.code == 2
    assert said in run.err
    assert list(folder.iterdir()) == []


WRIST = ("--limb", "R[z]@O R[0.8,0,0.6]@O R[0,0.8,0.6]@O")
WRIST_OF_CHAINS = (
    "R[x]@O R[0,1,0.3]@O R[0.3,0,1]@O",
    "R[y]@O R[0.3,0,1]@O R[1,0.3,0]@O",
    "R[z]@O R[1,0.3,0]@O R[0,1,0.3]@O",
)
SPHERICAL = {
    "a wrist of one limb": (WRIST, [0, 3, 3], 3),
    "a wrist of three limbs": (tuple(part for text in WRIST_OF_CHAINS for part in ("--chain", text)), [0, 3, 3], 3),
    "a post and three legs": (("--chain", "S@O", *("--chain", "U P S") * 3), [0, 3, 3], 3),
    "two limbs": (("--chain", "R[x]@O R[y]@O", "--chain", "R[y]@O R[z]@O R[x]@O"), [0, 2, 2], 2),
    "planar and spherical": (("--chain", "R[x] R[x] R[x] R[y]@O R[z]@O", "--chain", "P[x] S@O"), [0, 3, 3], 3),
}


@pytest.mark.parametrize("name", SPHERICAL)
def test_limbs_that_share_a_point_are_drafted_with_it_at_the_platform_s_origin(assur_cli, folder, name):
    given, numbers, freedoms = SPHERICAL[name]
    run = assur_cli("new", "my.toml", *given)
    assert (run.code, run.err) == (0, "")
    record = load_record("my.toml")
    assert len(record.inputs) == freedoms
    assert set(record.platform.pose) <= {"phi", "theta", "psi"}
    facts = assur.topology("my.toml")
    assert [facts.poc.t, facts.poc.r, facts.poc.dim] == numbers
    assert facts.routes_agree is True


def test_a_shorthand_is_echoed_in_full_and_the_full_form_drafts_the_same(assur_cli, folder):
    run = assur_cli("new", "my.toml", "3-RPS")
    assert (run.code, run.err) == (0, "")
    assert '--limb "R[y] P[z] S" --count 3 --actuate 1.2,2.2,3.2' in " ".join(run.out.split())
    text = Path("my.toml").read_text(encoding="utf-8")
    full = ("--limb", "R[y] P[z] S", "--count", "3", "--actuate", "1.2,2.2,3.2")
    assert assur_cli("new", "my.toml", *full, "--force").code == 0
    assert Path("my.toml").read_text(encoding="utf-8") == text


def test_of_several_arrangements_one_is_named(assur_cli, folder):
    run = assur_cli("new", "my.toml", "3-RRR")
    assert run.code == 2
    assert "planar" in run.err
    assert "spherical" in run.err
    assert list(folder.iterdir()) == []
    assert assur_cli("new", "my.toml", "3-RRR", "planar").code == 0
    assert load_record("my.toml").platform.pose == ("x", "y", "phi")


def test_axes_that_were_left_out_are_said_to_be_general(assur_cli, folder):
    run = assur_cli("new", "my.toml", "--limb", "R R R")
    assert run.code == 2
    assert "does not move" in run.err
    assert "R[z] R[z] R[z]" in run.err
    assert list(folder.iterdir()) == []
