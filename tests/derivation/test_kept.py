"""Drafts as a stranger makes them: special dimensions, other orders, names of modes that no root has alone."""

import inspect
import shutil
from pathlib import Path

import numpy as np
import pytest
import sympy

from assur.derivation import kept
from assur.derivation.document import document
from assur.derivation.kept import derived_closed_form, derived_document
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.printed_derivation import printed_derivation
from assur.derivation.solution import analytic_solution
from assur.export.c99 import c99_text
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.contract.check import problems
from assur.kinematics.contract.extent import IN_FULL
from assur.kinematics.home import home_values
from assur.kinematics.modes import without_letter
from assur.kinematics.pose import pose_of
from assur.kinematics.position import direct, inverse
from assur.model.kernels.reading import names_of
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.synthesis.shorthand.arrangements import arranged
from assur.topology.notation import parse_chains

HSOC = "{P[z] R[x] R[x] | P[z] R[x] R[x]} R[y] R[y]"
DRAFTS = {
    "biglide": parse_chains(["P[x] R[z]", "P[x] R[z] R[z]"]),
    "as the paper's": parse_chains(["{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]", "P[y] P(4R)[y] P(4R)[x]"]),
    "upright rails": parse_chains([HSOC, "P[z] P(4R)[y] P(4R)[x]"]),  # parallelograms in another order
    "Delta": arranged("Delta", "").chains,
    "ppr": repeated("P[x] P[y] R[z]", 3),
    "rrc": parse_chains(["R[x] R[x] C[x]", "R[y] R[y] C[y]", "R[z] R[z] C[z]"]),
}


def draft(name, folder):
    path = folder / "own.toml"
    path.write_text(drafted(DRAFTS[name], path).text, encoding="utf-8")
    return load_record(path)


@pytest.fixture(scope="module", params=[*DRAFTS])
def both(request, tmp_path_factory):
    """A draft, and the same with its derived form."""
    plain = draft(request.param, tmp_path_factory.mktemp("plain"))
    folder = tmp_path_factory.mktemp("derived")
    shutil.copy(plain.file, folder / "own.toml")
    (folder / "closed_form.py").write_text(derived_closed_form(plain))
    return plain, load_record(folder / "own.toml")


@pytest.mark.deep
def test_a_draft_agrees_with_its_joint_graph(both):
    assert problems(both[1], IN_FULL)[0] == ()


@pytest.mark.deep
def test_answers_of_a_draft_are_those_of_its_joint_graph_by_the_same_names(both):
    plain = both[0]
    length, home = characteristic_length(plain), pose_of(plain, home_values(plain))
    for share in np.random.default_rng(5).uniform(-0.03, 0.03, (2, len(home))):
        pose = home + length * share * [0.0 if name == "phi" else 1.0 for name in plain.platform.pose]
        answers = [{own.mode: own.inputs for own in inverse(record, pose)} for record in both]
        if len(answers[1]) > 1:  # the only one has a letter on the joint graph
            assert answers[0].keys() <= answers[1].keys()
        for mode, inputs in answers[0].items():
            assert np.allclose(inputs, answers[1].get(mode, answers[1].get("")), rtol=0, atol=1e-7 * length)
        inputs = next(iter(answers[1].values()))
        back = [[(own.mode, own.pose) for own in direct(record, inputs)] for record in both]
        for mode, own in back[0]:  # a letter after the signs is no name: which solution bears it depends on the order
            alike = [pose for other, pose in back[1] if without_letter(other) == without_letter(mode)]
            assert any(np.allclose(own, pose, rtol=0, atol=1e-6 * length) for pose in alike)


def test_dimensions_without_which_no_loop_closes_are_told_as_relations(tmp_path):
    path = tmp_path / "own.toml"
    chains = parse_chains(["R[x] R[x] R[x]", "R[x] R[x]"])
    path.write_text(drafted(chains, path).text, encoding="utf-8")
    record = load_record(path)
    solution = analytic_solution(record, "direct")
    (relation,) = solution.loops.relations
    numbers = {sympy.Symbol(name, real=True, positive=own.sign == "positive" or None): own.inside
               for name, own in record.parameters.items()}  # fmt: skip
    assert abs(float((relation.symbol - relation.formula).subs(numbers))) < 1e-9
    assert solution.closes()
    assert "For $x_{A} = " in document(printed_derivation(record, {"direct": solution}, {}))


@pytest.mark.deep
def test_relations_of_dimensions_are_told_in_code_and_held_against_the_file(tmp_path):
    folder, chains = tmp_path / "own", parse_chains(["R[x] R[x] R[x]", "R[x] R[x]"])
    folder.mkdir()
    (folder / "mechanism.toml").write_text(drafted(chains, folder / "mechanism.toml").text, "utf-8")
    plain = load_record(folder)
    text = derived_closed_form(plain)
    form = names_of(text, folder / "closed_form.py")["CLOSED_FORM"]
    (relation,) = form.relations
    assert f"for dimensions with {relation} only" in c99_text(plain.with_closed_form(form, text))
    (folder / "closed_form.py").write_text(text, encoding="utf-8")
    assert problems(load_record(folder))[0] == ()
    (folder / "closed_form.py").write_text(text.replace(relation, f"{relation} + 1"), encoding="utf-8")
    ((problem,), _) = problems(load_record(folder))
    assert (problem.path, problem.given) == (f"relation {relation} + 1", "it is off by 1")


def test_a_document_is_written_once_for_each_choice_of_problems(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    record, calls = load_record("fivebar"), []

    def written():
        calls.append(len(calls))
        return f"document {len(calls)}"

    assert [derived_document(record, {"direct": ""}, written) for _ in range(2)] == ["document 1"] * 2
    assert derived_document(record, {"direct": "", "inverse": ""}, written) == "document 2"
    assert derived_document(load_record("fivebar", l1=0.5), {"direct": ""}, written) == "document 3"
    assert derived_closed_form(record).startswith('"""Closed form of fivebar')


def test_what_was_derived_is_kept_and_so_is_why_nothing_was(tmp_path, monkeypatch):
    monkeypatch.setenv("ASSUR_CACHE", str(tmp_path))
    calls = []

    def refused(record):
        calls.append(record.name)
        raise NotDerivedError("it resists")

    monkeypatch.setattr(kept, "derive", refused)
    for _ in range(2):
        with pytest.raises(NotDerivedError, match="it resists"):
            derived_closed_form(load_record("fivebar"))
    assert calls == ["fivebar"]


def test_what_is_kept_is_made_anew_where_the_check_changes_that_it_has_passed(monkeypatch):
    places = []
    monkeypatch.setattr(kept, "code_digest", lambda *own: str(places.extend(own)))
    kept._name(load_record("fivebar"), "closed form")
    assert any(Path(inspect.getfile(inspect.unwrap(problems))).is_relative_to(place) for place in places)
