"""Derivations with a polynomial held against mechanism files by the small verifier, whole ones and changed ones."""

import copy
import json

import pytest

from assur.cli.main import main
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.synthesis.drafting.repeating import repeated
from assur.topology.notation import parse_chains
from assur.verifier.derivations.check import verify_derivation
from assur.verifier.reading import RefusedError

DEGREES = {"planar_3rpr": 6, "planar_3rrr": 6, "three_rrc": 8}
DRAFTS = {
    "mixed": (parse_chains(["R[z] R[z] R[z]", "R[z] P[x] R[z]", "P[x] R[z] R[z]"]), 6),
    "prc": (repeated("P[z] R[y] C[y]", 3), 8),
}


def proof_of(name, capsys):
    assert main(["derive", str(name), "--problem", "direct", "--prove", "--json"]) == 0
    return capsys.readouterr().out


@pytest.fixture(scope="module")
def kept():
    return {}


@pytest.fixture
def document(kept, capsys):
    """The data of 3-RPR."""
    if not kept:
        kept["planar_3rpr"] = proof_of("planar_3rpr", capsys)
    return json.loads(kept["planar_3rpr"])


def verified(document, name="planar_3rpr"):
    return verify_derivation(json.dumps(document).encode(), load_record(name).file.read_text(encoding="utf-8"))


def test_a_polynomial_of_degree_six_is_verified_with_its_conditions(document):
    (proved,) = verified(document)
    assert (proved.branches, proved.closed) == (6, 6)
    assert proved.conditions == ("rho2 != 0", "rho3 != 0", "det != 0")


@pytest.mark.deep
@pytest.mark.parametrize("name", [*DEGREES][1:])
def test_polynomials_are_verified_exactly(name, capsys):
    (proved,) = verified(json.loads(proof_of(name, capsys)), name)
    assert (proved.branches, proved.closed) == (DEGREES[name],) * 2


@pytest.mark.deep
def test_a_pose_that_says_a_part_of_the_orientation_is_verified(capsys):
    assert main(["derive", "three_rps", "--problem", "inverse", "--prove", "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    (proved,) = verified(document, "three_rps")
    assert (proved.branches, proved.closed) == (16, 16)
    (own,) = (own for own in document["problems"][0]["proof"]["orientations"] if own["link"] == "platform")
    own["axis"] = ["1", "0", "0"]
    with pytest.raises(RefusedError, match="platform"):
        verified(document, "three_rps")


@pytest.mark.deep
@pytest.mark.parametrize("name", DRAFTS)
def test_polynomials_of_drafts_are_verified_exactly(name, tmp_path, capsys):
    chains, degree = DRAFTS[name]
    path = tmp_path / f"{name}.toml"
    path.write_text(drafted(chains, path).text, encoding="utf-8")
    (proved,) = verify_derivation(proof_of(path, capsys).encode(), path.read_text(encoding="utf-8"))
    assert (proved.branches, proved.closed) == (degree, degree)


@pytest.mark.deep
def test_links_that_three_directions_hold_are_verified_with_the_way_that_is_taken(capsys):
    document = json.loads(proof_of("h4_robot", capsys))
    (proved,) = verified(document, "h4_robot")
    assert (proved.branches, proved.closed, proved.ways) == (8, 8, ("bar2 against bar1",))
    reason, _ = document["problems"][0]["proof"]["reasons"]
    for third in (["0", "0", "1"], ["1", "0", "0"], None):  # along the first, the second; and without it
        reason["third"] = third
        if third is None:
            del reason["third"]
        with pytest.raises(RefusedError, match="bar2"):
            verified(document, "h4_robot")


def set_of(problem):
    return problem["sets"][0], problem["proof"]["sets"][0]


def another_polynomial(problem):
    set_of(problem)[0]["formulas"]["elim"] = "det**2 + n1**2 + n2**2"


def a_multiple_of_the_polynomial(problem):
    """It vanishes, and has more roots."""
    given, proved = set_of(problem)
    given["formulas"]["elim"] = f"cos_platform*({given['formulas']['elim']})"
    shares = proved["polynomial"]["shares"]
    shares |= {name: f"cos_platform*({share})" for name, share in shares.items()}


def that_multiple_with_its_degree(problem):
    a_multiple_of_the_polynomial(problem)
    given, proved = set_of(problem)
    given["roots"] = problem["branches"] = proved["polynomial"]["degree"] = 8


def nothing_for_a_polynomial(problem):
    given, proved = set_of(problem)
    given["formulas"]["elim"] = "det - det"
    proved["polynomial"]["shares"] = {}


def more_roots(problem):
    given, proved = set_of(problem)
    given["roots"] = problem["branches"] = proved["polynomial"]["degree"] = 8


def fewer_roots(problem):
    given, proved = set_of(problem)
    given["roots"] = problem["branches"] = proved["polynomial"]["degree"] = 4


def fewer_branches(problem):
    problem["branches"] = set_of(problem)[0]["roots"] = 4


def no_polynomial(problem):
    del set_of(problem)[1]["polynomial"]


def in_another_angle(problem):
    set_of(problem)[1]["polynomial"]["circle"] = ["cos_cylinder1", "sin_cylinder1"]


def in_an_input(problem):
    set_of(problem)[1]["polynomial"]["circle"] = ["rho1", "rho2"]


def a_changed_share(problem):
    set_of(problem)[1]["polynomial"]["shares"]["q"] = "det"


def another_quadric(problem):
    set_of(problem)[1]["polynomial"]["quadric"] = "cos_cylinder1**2 + 2*sin_cylinder1**2 - 1 = 0"


def a_changed_line(problem):
    set_of(problem)[0]["lines"][0] = set_of(problem)[0]["lines"][1]


def a_changed_numerator(problem):
    formulas = set_of(problem)[0]["formulas"]
    formulas["n1"] = f"-({formulas['n1']})"


def no_condition(problem):
    set_of(problem)[0]["conditions"].remove("det != 0")


def a_condition_at_roots_alone(problem):
    """It fails at every root."""
    set_of(problem)[0]["conditions"].append("elim != 0")


def another_point(problem):
    problem["results"]["y"] += " + cos_platform"


TAMPERED = (
    another_polynomial, a_multiple_of_the_polynomial, that_multiple_with_its_degree, nothing_for_a_polynomial,
    more_roots, fewer_roots, fewer_branches, no_polynomial, in_another_angle, in_an_input, a_changed_share,
    another_quadric, a_changed_line, a_changed_numerator, no_condition, a_condition_at_roots_alone, another_point,
)  # fmt: skip


@pytest.mark.parametrize("change", TAMPERED, ids=lambda change: change.__name__)
def test_what_was_changed_is_refused(document, change):
    other = copy.deepcopy(document)
    change(other["problems"][0])
    with pytest.raises(RefusedError):
        verified(other)
