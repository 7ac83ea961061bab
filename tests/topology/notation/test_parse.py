"""Any text is a chain or a NotationError; the same text is always the same chain."""

import random
import tomllib
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import assur
from assur.errors import UsageError
from assur.topology.chains import Chain
from assur.topology.notation import NotationError, parse_chain, parse_chains, plain_text, symbolic_text
from examples import examples

VALID = [
    "P[x] R[0.5,0.866,0] R[x] H[-z]@A",
    "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y]@A U[x,y]@A S",
    "HSOC{-◇(P1(2P4R), P2(2P4R)) ⊥ R(2P4R) ⊥ R3 ∥ R4-}",
    r"HSOC_1\{-\Diamond(P_1^{(2P4R)}, P_2^{(2P4R)}) \perp R^{(2P4R)} \perp R_3 \parallel R_4 -\}",
    "-R|R|R_|_R|R-",
    "-P3-P(4R)[x]-P(4S)-Pa - R",
    "C[1,2,0] / R ⌢⊥ R ⌢ S - {U|{R|P(4U)}}",
]
LETTERS = "RPHCUSaxyz[](){}|-_^/@<>∥⊥⌢◇,.;0124+\\ "
CATALOGUE = sorted(Path(assur.__file__).parent.glob("mechanisms/*/topology.toml"))


def read(texts):
    try:
        return parse_chains(texts), None
    except NotationError as error:
        return (), error


def chain_or_error(*texts):
    """What every text must give; the error must point into its own limb."""
    found, error = read(texts)
    if error:
        assert 0 <= error.position <= len(error.text)
        assert error.text == texts[max(error.limb, 1) - 1]
        assert "^" in error.message
        return
    for chain, text in zip(found, texts, strict=True):
        assert isinstance(chain, Chain)
        assert chain.text == text
        assert chain.elements
        for style in ("unicode", "ascii", "latex"):
            assert symbolic_text(chain, style)
        assert plain_text(parse_chain(plain_text(chain))) == plain_text(chain)


@examples(500)
@given(st.lists(st.text() | st.text(LETTERS, max_size=30), min_size=1, max_size=3))
@example(["R[" + "9" * 3000 + ",1,0]"])
@example(["R" + "9" * 3000])
@example(["R(" + "9" * 3000 + "P4R)"])
@example(["R@A ⌢ S ⌢ R@A"])
def test_any_text(texts):
    chain_or_error(*texts)


@examples(500)
@given(st.sampled_from(VALID), st.integers(0, 10**6), st.integers(1, 4))
def test_mutations_of_valid_texts(text, seed, count):
    rng = random.Random(seed)
    for _ in range(count):
        at, kind = rng.randrange(len(text) + 1), rng.randrange(5)
        end = min(len(text), at + rng.randrange(1, 8))
        piece = {
            0: "",
            1: rng.choice(LETTERS),
            2: rng.choice(LETTERS) + text[at:end],
            3: text[at:end] * 2,
            4: (donor := rng.choice(VALID))[(start := rng.randrange(len(donor))) : start + rng.randrange(12)],
        }[kind]
        text = text[:at] + piece + text[end:]
    chain_or_error(text)
    chain_or_error("P[x]", text)


@pytest.mark.parametrize("text", VALID)
def test_the_same_text_is_the_same_chain(text):
    assert parse_chain(text) == parse_chain(text) == parse_chains([text])[0]


@pytest.mark.parametrize("path", CATALOGUE, ids=[path.parent.name for path in CATALOGUE])
def test_the_catalogues_chains_read_back(path):
    texts = tomllib.loads(path.read_text(encoding="utf-8"))["chains"]
    limbs = parse_chains(texts)
    again = parse_chains([plain_text(limb) for limb in limbs])
    assert [limb.elements for limb in again] == [limb.elements for limb in limbs]


def test_there_is_a_catalogue():
    assert len(CATALOGUE) > 5


def test_wrong_use_of_the_interface():
    with pytest.raises(UsageError, match="no limbs"):
        parse_chains([])
    with pytest.raises(UsageError, match="a list of texts"):
        parse_chains("R[x]")
