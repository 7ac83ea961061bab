"""`assur derive`: formulas in words and as data, a file that `check` takes, and what resists by its name."""

import json
import re
import shutil
import subprocess

import pytest

from assur.cli.main import main
from assur.model.registry import load_record


def test_it_prints_reasons_before_equations_and_the_sets_in_their_order(capsys):
    assert main(["derive", "zeng2019", "--problem", "direct"]) == 0
    text = capsys.readouterr().out
    assert text.startswith("zeng2019, direct: 8 branches")
    places = [text.index(part) for part in ("link11 hangs on base", "link9 and link10: 2 roots", "link4a: 2 roots")]
    assert places == sorted(places)
    assert "every branch closes every loop" in text


def test_what_resists_is_named_with_its_unknowns_and_its_count_and_no_code_is_written(tmp_path, assur_cli):
    target, document = tmp_path / "closed_form.py", tmp_path / "d.tex"
    ran = assur_cli("derive", "gough_stewart", "-o", str(target), "--latex", str(document), "--json")
    assert ran.code == 5
    direct, inverse = ran.json["problems"]
    assert (direct["status"], inverse["status"]) == ("not_derived", "derived")
    assert "platform" in direct["why"]
    assert direct["resists"] == {
        "links": ["platform"],
        "unknowns": [["e0", "e1", "e2", "e3"], ["g0", "g1", "g2", "g3"]],
    }
    assert (direct["count"]["solutions"], direct["count"]["of"]) == (40, "poses")
    assert (ran.json["closed_form"], ran.json["latex"]) == (None, str(document))
    assert not target.exists()
    text = document.read_text(encoding="ascii")
    assert "Not derived: platform: not solved for e0, e1" in text
    assert "40 poses over complex numbers" in text
    assert "probable, not proved." in text
    assert r"\section{Direct problem: the pose at given inputs}" in text


def test_a_polynomial_is_an_answer_and_says_what_roots_it_cannot_have(capsys):
    assert main(["derive", "three_rrc", "--problem", "direct", "--json"]) == 0
    (direct,) = json.loads(capsys.readouterr().out)["problems"]
    assert (direct["status"], direct["branches"], direct["closes"]) == ("derived", 8, True)
    assert "det != 0" in direct["sets"][0]["conditions"]
    assert direct["proved"].startswith("the polynomial of degree 8 is irreducible")


def test_the_file_that_is_written_makes_a_mechanism_of_one_s_own_exact(tmp_path, capsys):
    shutil.copy(load_record("fivebar").file, tmp_path / "mechanism.toml")
    assert main(["derive", str(tmp_path), "-o", str(tmp_path / "closed_form.py")]) == 0
    assert main(["check", str(tmp_path)]) == 0
    assert "the formulas close the joint graph: exact" in capsys.readouterr().out


@pytest.mark.parametrize("words", [["--problem", "neither"], ["--problem", "direct", "-o", "closed_form.py"]])
def test_words_that_make_no_sense_are_refused(words):
    assert main(["derive", "fivebar", *words]) == 2


def test_the_data_says_reasons_unknowns_choices_and_what_is_assumed(assur_cli):
    problem = assur_cli("derive", "zeng2019", "--problem", "direct", "--json").json["problems"][0]
    (reason,) = problem["reasons"]
    assert (reason["link"], reason["carrier"], reason["axes"]) == ("link11", "base", ["x", "y"])
    assert reason["joints"] == [["B1", "C1"], ["D2", "D1"]]
    assert problem["assumed"] == ["Pa1", "Pa2"]
    first, *_, last = problem["sets"]
    assert first["unknowns"] == [["cos_link9", "sin_link9"], ["cos_link10", "sin_link10"]]
    for own in problem["sets"]:
        (choice,) = own["choices"]
        assert own["roots"] == 2
        assert own["formulas"][choice["root"]] == f"sqrt({choice['radicand']})"
    assert last["conditions"] == ["N3 != 0"]


@pytest.mark.parametrize("problem", ["direct", pytest.param("inverse", marks=pytest.mark.deep)])
def test_what_is_printed_of_a_draft_defines_each_name_before_it_is_used(assur_cli, tmp_path, problem):
    file = tmp_path / "my.toml"
    chains = ["R[y] R[y] P[y] R[y]", "P[x] R[x] R[x] R[x]", "P[z] R[z] R[z] R[z]"]
    assur_cli("new", str(file), *(word for chain in chains for word in ("--chain", chain)))
    record = load_record(str(file))
    given = {*record.parameters, *(driven.name for driven in record.inputs), *"xyz", "sqrt", "sin", "cos"}
    turns = {f"{ratio}_{name}" for ratio in ("sin", "cos") for name in given}
    defined = re.findall(r"^    (\w+) = (.+)$", assur_cli("derive", str(file), "--problem", problem).out, re.MULTILINE)
    known = given | turns if problem == "direct" else given
    assert len(defined) > 20
    for name, formula in defined:
        if not formula.startswith("0"):  # an equation, or what it means where a quantity vanishes
            assert {*re.findall(r"[A-Za-z]\w*", formula)} <= known, name
            known = known | {name}


@pytest.fixture
def drafted(assur_cli, tmp_path):
    """A five-bar of one's own, whose angles are dimensions, before and after its closed form was derived."""
    file = tmp_path / "my.toml"
    assur_cli("new", str(file), "--chain", "R[z] R[z] R[z]", "--chain", "R[z] R[z]")
    before = assur_cli("direct", str(file), "--json", "--", "10", "5").json
    assert assur_cli("derive", str(file), "-o", str(tmp_path / "closed_form.py")).code == 0
    return file, before


def test_a_draft_keeps_its_names_and_answers(drafted, assur_cli):
    file, before = drafted
    assert "the formulas close the joint graph: exact" in assur_cli("check", str(file)).out
    after = assur_cli("direct", str(file), "--json", "--", "10", "5").json
    assert after["complete"]
    assert [(own["mode"], own["working_mode"]) for own in after["solutions"]] == [
        (own["mode"], own["working_mode"]) for own in before["solutions"]
    ]
    for first, second in zip(before["solutions"], after["solutions"], strict=True):
        assert second["pose"] == pytest.approx(first["pose"], abs=1e-6)


def test_what_is_certified_of_a_draft_is_verified(drafted, assur_cli, tmp_path):
    file, _ = drafted
    certificate = tmp_path / "workspace.json"
    assert assur_cli("certify", str(file), "-o", str(certificate)).code == 0
    assert "exact" in assur_cli("verify", str(certificate), "--mechanism", str(file)).out


def test_a_form_with_other_names_than_the_joint_graph_s_is_refused(drafted, assur_cli, tmp_path):
    file, _ = drafted
    form = tmp_path / "closed_form.py"
    quoted = form.read_text().replace('"platform"', '"upright"').replace("('platform',)", "('upright',)")
    form.write_text(quoted.replace("sign.platform", "sign.upright"))
    answer = assur_cli("check", str(file))
    assert answer.code == 3
    assert "the joint graph names the modes by platform" in " ".join((answer.out + answer.err).split())


def test_a_cosine_of_a_number_is_no_part_of_a_closed_form(assur_cli, tmp_path):
    file = tmp_path / "my.toml"
    chains = ("P[z] P(4S)[y]", "P[z] P(4S)[-0.866,-0.5,0]", "P[1,0,2] P(4S)[0.866,-0.5,0]")
    assur_cli("new", str(file), *(word for chain in chains for word in ("--chain", chain)))
    drafted = file.read_text()
    file.write_text(drafted.replace('angles = [0, "gammaa2"]', "angles = [0, 119.999272]"))
    assert file.read_text() != drafted
    answer = assur_cli("derive", str(file), "-o", str(tmp_path / "closed_form.py"))
    assert answer.code == 5
    assert "angle among the parameters" in answer.out + answer.err


def test_a_document_that_is_no_tex_file_is_refused(assur_cli):
    assert assur_cli("derive", "fivebar", "--latex", "d.pdf").code == 2


@pytest.mark.compiler
def test_the_c_of_a_derived_form_passes_its_own_test(tmp_path, assur_cli):
    shutil.copy(load_record("fivebar").file, tmp_path / "own.toml")
    target = tmp_path / "own.c"
    ran = assur_cli("derive", str(tmp_path / "own.toml"), "--c", str(target), "--json")
    assert (ran.code, ran.json["c"], ran.json["closed_form"]) == (0, str(target), None)
    words = [
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Werror",
        "-DFIVEBAR_TEST",
        str(target),
        "-o",
        str(tmp_path / "own"),
        "-lm",
    ]
    subprocess.run(["gcc", *words], check=True)
    assert subprocess.run([tmp_path / "own"], check=True, capture_output=True, text=True).stdout == "fivebar: fine\n"


def test_the_document_of_a_polynomial_says_its_degree_and_what_follows_of_a_root(tmp_path, assur_cli):
    target = tmp_path / "d.tex"
    assert assur_cli("derive", "planar_3rpr", "--latex", str(target)).code == 0
    text = target.read_text(encoding="ascii")
    parts = ("These belong together", r"a polynomial of degree 6", "At each of its roots", "over complex numbers")
    places = [text.index(part) for part in parts]
    assert places == sorted(places)


@pytest.mark.parametrize(("words", "code"), [([], 0), (["--square-roots"], 4)])
def test_a_polynomial_is_no_answer_where_square_roots_are_asked_for(words, code, assur_cli):
    run = assur_cli("derive", "planar_3rrr", "--problem", "direct", *words, "--json")
    assert (run.code, run.json["problems"][0]["square_roots"]) == (code, "no")


def test_square_roots_are_one(assur_cli):
    run = assur_cli("derive", "fivebar", "--square-roots", "--json")
    assert (run.code, [own["square_roots"] for own in run.json["problems"]]) == (0, ["yes", "yes"])


def test_proof_counts_solutions_beside_the_branches_and_says_that_they_are_complex(assur_cli):
    run = assur_cli("derive", "fivebar", "--problem", "direct", "--prove")
    text = " ".join(run.out.split())
    assert run.code == 0
    assert "2 solutions over complex numbers, counted by" in text
    assert "probable, not proved" in text
