import numpy as np

from assur.report.formulas.normal import text
from assur.report.formulas.shorthand import LONG, shorthand
from assur.report.formulas.trace import POINTS, Book, Letter, leaf

RNG = np.random.default_rng(4)


def letters(count):
    book = Book()
    return [leaf(book, Letter(f"x{k}", "<mi>x</mi>"), RNG.uniform(1, 2, POINTS)) for k in range(count)]


def test_a_part_that_two_formulas_share_gets_one_letter():
    a, b, c, d, e = letters(5)
    shared = a * b + c * d
    terms = [shared + e, e / shared]
    brief = shorthand(terms, ["x"])
    assert [text(brief.short(term)) for term in terms] == ["k1 + x4", "x4/k1"]
    assert [(letter.name, text(term)) for letter, term in brief.taken()] == [("k1", "x0 x1 + x2 x3")]
    assert brief.taken() == []


def test_a_long_formula_is_cut_and_stands_for_the_same_number():
    many = letters(30)
    whole = many[0] * many[1]
    for first, second in zip(many[2::2], many[3::2], strict=True):
        whole = whole * first + second
    brief = shorthand([whole], [])
    written = brief.short(whole)
    steps = brief.taken()
    assert steps
    for term in (written, *(term for _, term in steps)):
        assert len(set(text(term).replace("(", " ").replace(")", " ").split()) - {"+"}) <= LONG
    assert np.allclose(written.values, whole.values)


def test_definitions_need_only_what_stands_before_them():
    a, b, c, d, e = letters(5)
    inner = a * b + c * d
    outer = inner * inner * e + a * b * c
    brief = shorthand([outer + 1, outer * d, inner - a], [])
    for term in (outer + 1, outer * d, inner - a):
        brief.short(term)
    known = set()
    for letter, term in brief.taken():
        used = {part for part in text(term).replace("(", " ").replace(")", " ").split() if part.startswith("k")}
        assert {part.partition("^")[0] for part in used} <= known
        known.add(letter.name)
    assert known == {"k1", "k2"}


def test_letters_that_are_taken_are_not_used():
    assert shorthand([], ["k1", "c", "x"]).stem == "f"
    assert shorthand([], ["k", "c", "f", "g", "j", "n", "m"]).stem == "K"
