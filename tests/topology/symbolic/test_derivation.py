import pytest
from hypothesis import given
from hypothesis import strategies as st

from assur.topology.notation import parse_chain, parse_chains
from assur.topology.poc import Mark, PocSet
from assur.topology.symbolic.derivation import DerivationStep, PocDerivation, counted, in_words, matrix, under
from assur.topology.symbolic.intersection import parallel
from assur.topology.symbolic.motion import Motion
from assur.topology.symbolic.union import serial
from examples import examples

SET = PocSet(2, 1, 3, Mark("arm", ("R1",)), Mark("parallel", ("R1",)))


@pytest.mark.parametrize(
    ("style", "printed"),
    [
        ("unicode", "[t²(⊥(R1, ρ)); r¹(∥R1)]"),
        ("ascii", "[t^2(_|_(R1, rho)); r^1(||R1)]"),
        ("latex", r"\begin{bmatrix} t^2(\perp (R1, \rho)) \\ r^1(\parallel R1) \end{bmatrix}"),
    ],
)
def test_a_matrix_in_three_styles(style, printed):
    assert matrix(SET, style) == printed


@pytest.mark.parametrize(
    ("style", "signs"), [("unicode", ("∪", "∩")), ("ascii", (" u ", " n ")), ("latex", (r"\cup", r"\cap"))]
)
def test_union_and_intersection_in_three_styles(style, signs):
    for operation, sign in zip(("union", "intersection"), signs, strict=True):
        text = DerivationStep(operation, (SET, SET), ("1", "2"), SET, "", "").text(style)
        assert sign in text
        assert text.count(matrix(SET, style)) == 3


def test_one_operand_is_no_equation():
    assert DerivationStep("union", (SET,), ("R1",), SET, "", "").text() == matrix(SET)


def test_words():
    assert in_words(PocSet(1, 0, 1)) == "one translation and no rotations"
    assert counted(7, "freedom") == "7 freedoms"
    assert under([]) == ""
    assert under(["a", "b", "a"]) == ", while a and b"


def test_the_papers_derivation_as_text():
    chain = parse_chain("{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]")
    text = serial(chain, name="the hybrid chain I").derivation.text()
    assert text.splitlines()[-6:] == [
        "the hybrid chain I, O' at any point of the end link:",
        "  [t¹(⊥(R5, ρ)); r¹(∥R5)] ∪ [t¹(⊥(R6, ρ)); r¹(∥R6)] = [t²(⊥R5); r¹(∥R5)]",
        "    by criterion C1: two translations and one rotation of R5, R6, one element not independent",
        "  [t²(⊥R12); r¹(∥R12)] ∪ [t²(⊥R5); r¹(∥R5)] = [t³; r²(∥◇(R12, R5))]",
        "    by linear rule: R5, R6 add one translation and one rotation, all independent",
        "  so the end link has three translations and two rotations",
    ]


JOINTS = (
    "P[x]",
    "P[y]",
    "R[x]",
    "R[x]",
    "R[y]",
    "R[z]",
    "C[y]",
    "U[x,y]",
    "U[y,z]",
    "S",
    "P(4R)[y]",
    "P(4S)[x]",
    "P(4U)[z]",
)
texts = st.lists(st.sampled_from(JOINTS), min_size=1, max_size=6).map(" ".join)


@examples(150)
@given(texts)
def test_a_derivation_ends_with_what_it_derives(text):
    motion = serial(parse_chain(text))
    derivation = motion.derivation
    assert derivation.whole.result in (motion.poc, motion.restated)
    assert derivation.whole.result.t == motion.poc.t
    if derivation.steps:
        assert derivation.steps[-1].result == derivation.whole.result


@examples(150)
@given(texts)
def test_every_step_obeys_criterion_c2(text):
    """Eq. (1) at one O': dim M <= min(sum of the operands' dim, t + r), and nothing gets lost."""
    for step in serial(parse_chain(text)).derivation.steps:
        assert step.result.dim <= min(6, sum(poc.dim for poc in step.operands), step.result.t + step.result.r)
        for poc in step.operands:
            assert step.result.t >= poc.t
            assert step.result.r >= poc.r
            assert step.result.dim >= poc.dim
        assert step.result.t <= sum(poc.t for poc in step.operands)
        assert step.result.r <= sum(poc.r for poc in step.operands)
        lost = step.result.dim < sum(poc.dim for poc in step.operands)
        assert (step.rule == "linear rule") <= (not lost)


@examples(80)
@given(st.lists(texts, min_size=2, max_size=3))
def test_a_platforms_derivation_ends_with_what_it_derives(limbs):
    motion = parallel([serial(chain) for chain in parse_chains(limbs)])
    if isinstance(motion, Motion):
        derivation = motion.derivation
        assert isinstance(derivation, PocDerivation)
        assert derivation.whole.result == motion.poc
        assert len(derivation.parts) == len(limbs)
        for style in ("unicode", "ascii", "latex"):
            assert derivation.text(style).count("so the end link has") == len(limbs)


def test_ascii_is_ascii():
    text = serial(parse_chain("P[x] R[x] R[x] R[y] S")).derivation.text("ascii")
    assert text.isascii()
