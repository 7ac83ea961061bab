import math
import re
import shlex
from pathlib import Path

import pytest

import assur
from assur.results.json_text import plain
from assur.synthesis.answers import answers
from assur.synthesis.question import question
from assur.synthesis.synthesis import synthesis

PAGE = Path(__file__).parents[2] / "docs" / "topology.md"
ROWS = re.findall(r"^\| `assur (synthesize .*?)` \| (.*?) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)

SMALL = ("--max-joints", "3", "--symmetric")


@pytest.fixture(autouse=True)
def _nothing_kept(monkeypatch, tmp_path):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path / "cache"))


@pytest.fixture(scope="module")
def every(tmp_path_factory):
    """What a small search finds."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ASSUR_CACHE", str(tmp_path_factory.mktemp("cache")))
        return plain(answers(synthesis(question("3T", 3, 3, symmetric=True))))


def test_the_answer_is_that_of_the_library(assur_cli, every):
    data = assur_cli("synthesize", *SMALL, "--json").json
    assert data == every
    assert {"three_crr", "three_rrc"} <= {name for item in data["mechanisms"] for name in item["names"]}


def test_a_person_sees_counts_a_ranked_table_reasons_and_known_names(assur_cli):
    run = assur_cli("synthesize", "--motion", "3T", "--limbs", "3", *SMALL, "--coupling", "0..1")
    assert (run.code, run.err) == (0, "")
    assert run.out.startswith("3T: ")
    assert "limb types" in run.out
    assert "3 x C[x] R[x] R[x] (three_crr)" in run.out
    assert "the front, beaten by none in κ, redundant constraints, joints and zeros" in run.out
    assert "1: smallest κ, fewest redundant constraints, fewest joints, most zeros" in " ".join(run.out.split())
    assert "one virtual variable, for limbs 1 and 2 close a loop with Δ = +1" in " ".join(run.out.split())
    assert "known mechanisms with these limbs" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


def test_different_limbs_stand_below_each_other(assur_cli):
    run = assur_cli("synthesize", "--max-joints", "3", "--actuators", "leg", "--top", "2")
    assert "the best 2" in run.out
    assert "Of different limbs the 20 simplest" in run.out
    assert "t³ r³" in run.out
    assert max(map(len, run.out.splitlines())) <= 80


def test_the_best_are_cut_off_where_asked(assur_cli):
    data = assur_cli("synthesize", *SMALL, "--top", "3", "--json").json
    assert [item["rank"] for item in data["mechanisms"]] == [1, 2, 3]
    assert data["found"] > 3


def test_fewer_limbs_than_freedoms_are_shown_by_families(assur_cli):
    words = ("synthesize", "--motion", "2T1R", "--limbs", "2", "--max-joints", "3", "--max-members", "1")
    run = assur_cli(*words, "--top", "2")
    assert run.out.startswith("2T1R: ")
    assert "the best 2 of" in run.out
    assert "simplest" in run.out
    assert "with κ = 0, " in run.out
    assert "closes with Δ = " in " ".join(run.out.split())
    assert max(map(len, run.out.splitlines())) <= 80


def test_an_explanation_says_what_drops_a_mechanism(assur_cli):
    run = assur_cli("synthesize", "--limbs", "2", "--explain", "tripteron")
    assert (run.code, run.err) == (0, "")
    assert "not listed, by the filter of the number of limbs: it has 3 limbs, and 2 are" in " ".join(run.out.split())
    data = assur_cli("synthesize", "--limbs", "2", "--explain", "tripteron", "--json").json
    assert (data["dropped_by"], data["rank"], data["family"], data["listed_as"]) == ("limbs", None, None, [])
    legs = ("U[x,y] P[x] U[y,x]",) * 3
    run = assur_cli("synthesize", "--explain", *legs, "--actuate", "1.2,2.2,3.2")
    assert "its drive is P1" in run.out


def test_an_explanation_says_where_a_mechanism_is_listed(assur_cli):
    run = assur_cli("synthesize", *SMALL, "--explain", *("R[x] R[x] C[x]",) * 3)
    assert "listed (three_rrc): rank " in run.out
    assert "R[x] R[x] C[x] | R[y] R[y] C[y] | R[z] R[z] C[z]" in run.out


def test_nothing_found_says_which_coupling_degrees_there_are(assur_cli):
    run = assur_cli("synthesize", *SMALL, "--coupling", "0")
    assert run.code == 0
    assert "3T: 0 mechanisms" in run.out
    assert "with κ = 1" in run.out


def test_files_are_written_that_topology_reads(assur_cli, tmp_path):
    folder = tmp_path / "found"
    run = assur_cli("synthesize", *SMALL, "--top", "2", "--toml", str(folder), "--json")
    written = run.json["written"]
    assert sorted(map(str, folder.iterdir())) == sorted(written)
    assert len(written) == 2
    read = assur_cli("topology", written[0], "--json").json
    best = run.json["mechanisms"][0]
    assert (read["dof"], read["coupling_degree"]) == (best["dof"], best["coupling_degree"])
    assert assur.topology(written[1]).redundant_constraints.collapsed == 3


def test_limbs_without_passive_slides_are_kept_where_asked(assur_cli, every):
    some = assur_cli("synthesize", *SMALL, "--no-passive-p", "--json").json
    assert 0 < some["limb_types"]["with_motion"] < every["limb_types"]["with_motion"]
    for mechanism in some["mechanisms"]:
        for number, chain in enumerate(mechanism["chains"], 1):
            letters = re.findall(r"P\(\w+\)|[A-Z](?=\[)|S", chain)
            driven = {actuated for actuated in mechanism["actuate"] if actuated.startswith(f"{number}.")}
            assert {f"{number}.{place}" for place, letter in enumerate(letters, 1) if letter in "PC"} <= driven


def test_kinds_of_joints_and_known_or_new_ones_are_kept_where_asked(assur_cli, every):
    known, new = (assur_cli("synthesize", *SMALL, word, "--json").json for word in ("--known", "--new"))
    assert 0 < known["found"] < every["found"] == known["found"] + new["found"]
    assert all(mechanism["names"] for mechanism in known["mechanisms"])
    assert not any(mechanism["names"] for mechanism in new["mechanisms"])
    some = assur_cli("synthesize", *SMALL, "--joints", "rp,C", "--json").json
    assert some["asked"]["joint_kinds"] == ["R", "P", "C"]
    wanted = [one["chains"] for one in every["mechanisms"] if {*one["joint_kinds"]} <= {"R", "P", "C"}]
    assert [one["chains"] for one in some["mechanisms"]] == wanted


def test_chosen_mechanisms_are_drafted_with_what_solves_them(assur_cli, tmp_path):
    words = ("synthesize", "--motion", "2T1R", "--max-joints", "3", "--symmetric", "--top", "1")
    run = assur_cli(*words, "--draft", str(tmp_path / "chosen"), "--json")
    (draft,) = run.json["drafts"]
    assert (draft["rank"], draft["refusal"]) == (1, "")
    assert draft["inverse"].startswith("square roots")
    drafted = assur.topology(assur.load(draft["file"]))
    assert (drafted.dof, len(drafted.limbs)) == (3, len(run.json["mechanisms"][0]["chains"]))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--motion", "4T"), "unknown motion '4T'"),
        (("--limbs", "4"), "4 limbs for 3T"),
        (("--limbs", "1"), "1 limbs for 3T"),
        (("--max-members", "0"), "--max-members 0"),
        (("--limbs", "three"), "--limbs: 'three' is not a whole number"),
        (("--max-joints", "0"), "at most 0 joints"),
        (("--coupling", "1..0"), "--coupling 1..0"),
        (("--coupling", "a"), "--coupling: 'a' is not a whole number"),
        (("--actuators", "arm"), "unknown place of the actuators 'arm'; there is: any, base, leg"),
        (("--joints", "RPQ"), "unknown kind of joint 'Q'; there is: C, P, P(2US), P(4R), P(4S), R, S, U"),
        (("--top", "0"), "--top 0"),
        (("--actuate", "1.1"), "--actuate without --explain"),
        (("--explain", "tripteron", "--actuate", "1.1"), "--actuate beside the name tripteron"),
        (("--explain", "P[x"), "cannot read this chain"),
        (("--motion", "3T", "--idle"), "idle joints for 3T, whose limbs are written without"),
        (("--motion", "1T2R:XY"), "unknown motion '1T2R:XY'; there is: 1T2R:PU, 1T2R:RPR, 1T2R:UP"),
        (("--motion", "3R", "--limbs", "2"), "2 limbs for 3R, whose limbs have one drive each; give 3"),
        (("--parasitic",), "unknown motion '3T'; there is: 1T2R, 1T3R, 2R, 2T3R"),
        (("--parasitic", "--motion", "1T2R", "--limbs", "2"), "2 limbs for 1T2R that others come with"),
    ],
)
def test_misuse_says_what_is_allowed(assur_cli, words, message):
    run = assur_cli("synthesize", *words)
    assert (run.code, run.out) == (2, "")
    assert message in run.err


def test_a_folder_that_cannot_be_made_is_said_before_the_search(assur_cli, tmp_path):
    path = tmp_path / "file"
    path.write_text("")
    run = assur_cli("synthesize", "--toml", str(path / "found"))
    assert run.code == 2
    assert "cannot make the folder" in run.err


def test_more_than_a_million_combinations_want_a_word(assur_cli, monkeypatch):
    from assur.cli import synthesize

    words = ("synthesize", "--max-joints", "3", "--actuators", "leg")
    every = assur_cli(*words, "--json").json
    types, count = every["limb_types"]["with_motion"], every["combinations"]["all"]
    assert count == math.comb(types + 2, 3) > types
    monkeypatch.setattr(synthesize, "MILLION", count - 1)
    run = assur_cli(*words)
    assert run.code == 2
    said = f"{count} combinations of {types} limb types, and {count - 1} are looked at unasked"
    assert run.err.startswith(f"error: {said}\nhint: ")
    assert "--yes" in run.err
    assert assur_cli(*words, "--yes", "--json").json == every
    assert assur_cli(*words, "--symmetric").code == 0


@pytest.mark.deep
@pytest.mark.parametrize(("command", "names"), ROWS, ids=[names.partition(",")[0] for _, names in ROWS])
def test_the_commands_of_the_page_find_the_known_mechanisms(assur_cli, command, names):
    """All of those that it names, and no others."""
    data = assur_cli(*shlex.split(command), "--json").json
    assert sorted(name for item in data["mechanisms"] for name in item["names"]) == names.split(", ")


def test_the_page_has_its_commands():
    assert len(ROWS) == 14
    assert len({name for _, names in ROWS for name in names.split(", ")}) == 23
