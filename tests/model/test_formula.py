import math

import numpy as np
import pytest
import sympy
from hypothesis import example, given
from hypothesis import strategies as st

from assur.errors import UsageError
from assur.model.formula import MAX_DEPTH, MAX_LENGTH, RESERVED, FormulaError, parse

NAMES = {"a": 1.5, "b2": -0.25, "leg1.B.y": 3.0, "O'.x": 0.125, "e": 2.0}


def expressions() -> st.SearchStrategy[tuple[str, str]]:
    """The same random expression in our grammar and in Python's."""
    plain = st.sampled_from([".5", "2.", "1e-3", "7", "12.25", "3E2"]).map(lambda text: (text, text))
    names = st.sampled_from(sorted(NAMES)).map(lambda name: (name, f"names[{name!r}]"))
    angles = st.sampled_from(["30", "0.5"]).flatmap(
        lambda text: st.sampled_from([(f"{text} deg", f"({text} * pi / 180)"), (f"{text}rad", text)])
    )
    leaves = plain | names | angles | st.just(("pi", "pi"))

    def grow(inner: st.SearchStrategy[tuple[str, str]]) -> st.SearchStrategy[tuple[str, str]]:
        sums = st.tuples(inner, st.sampled_from(["+", " - ", "*", " / ", "-"]), inner).map(
            lambda parts: (parts[0][0] + parts[1] + parts[2][0], parts[0][1] + parts[1] + parts[2][1])
        )
        brackets = inner.map(lambda pair: (f"({pair[0]})", f"({pair[1]})"))
        negatives = inner.map(lambda pair: (f"-{pair[0]}", f"-{pair[1]}"))
        functions = st.tuples(st.sampled_from(["sqrt", "sin", "cos"]), inner).map(
            lambda parts: (f"{parts[0]}( {parts[1][0]} )", f"{parts[0]}({parts[1][1]})")
        )
        return sums | brackets | negatives | functions

    return st.recursive(leaves, grow, max_leaves=12)


def outcome(function: object) -> float | type[Exception]:
    try:
        return function()  # type: ignore[operator,no-any-return]  # a callable of no arguments
    except (ValueError, ZeroDivisionError, OverflowError) as error:
        return type(error)


@given(expressions())
@example(("1-2-3", "1-2-3"))
@example(("2/4*8", "2/4*8"))
@example(("--2 - -3*-(4)", "--2 - -3*-(4)"))
@example(("-a*b2", "-names['a']*names['b2']"))
def test_values_are_those_of_python(pair: tuple[str, str]) -> None:
    ours, theirs = pair
    scope = {"names": NAMES, "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "pi": math.pi}
    expected = outcome(lambda: float(eval(theirs, {"__builtins__": {}}, scope)))  # noqa: S307 our own text
    found = outcome(lambda: float(parse(ours).evaluate(NAMES, math)))
    if isinstance(expected, float) and isinstance(found, float):
        assert found == pytest.approx(expected, rel=1e-13, abs=0, nan_ok=True)
    else:
        assert found == expected


def test_arrays_and_symbols_go_through_the_same_formula() -> None:
    formula = parse("l/2 + sqrt(l*l)*sin(30 deg + 0*l) + 0.1")
    lengths = np.array([[1.0, 2.0], [3.0, 4.0]])
    assert formula.evaluate({"l": lengths}) == pytest.approx(lengths + 0.1)
    symbol = sympy.Symbol("l", positive=True)
    exact = formula.evaluate({"l": symbol}, sympy, sympy.Rational)
    assert exact == symbol + sympy.Rational(1, 10)


def test_names_are_those_to_look_up() -> None:
    formula = parse("sin(C1.y) - O'.x*leg1.C.translation + pi + sqrt(x'')")
    assert formula.names == {"C1.y", "O'.x", "leg1.C.translation", "x''"}
    other = formula.renamed({"C1.y": "R2.y"})
    assert other.names == {"R2.y", "O'.x", "leg1.C.translation", "x''"}
    assert other.text == formula.text
    with pytest.raises(KeyError):
        other.evaluate(dict.fromkeys(formula.names, 1.0))


WRONG = [
    ("", 0, "the end", "a number, a name, '-' or '('", ""),
    ("  ", 2, "the end", "a number, a name, '-' or '('", ""),
    ("l2 + * 3", 5, "'*'", "a number, a name, '-' or '('", ""),
    ("l2 +", 4, "the end", "a number, a name, '-' or '('", ""),
    ("(l2", 3, "the end", "an operator or ')'", ""),
    ("l2)", 2, "')'", "an operator or the end", ""),
    ("2 l2", 2, "'l2'", "an operator or the end", "write * between factors: 2*l2"),
    ("(2l2)", 2, "'l2'", "an operator or ')'", "write * between factors: 2*l2"),
    ("1.2.3", 3, "'.3'", "an operator or the end", "write * between factors: 2*l2"),
    ("0,5", 1, "','", "a number, a name, an operator or a bracket", "write decimals with a point: 0.5, not 0,5"),
    ("l2^2", 2, "'^'", "a number, a name, an operator or a bracket", "there are no powers: write l2*l2"),
    ("l2**2", 3, "'*'", "a number, a name, '-' or '('", "there are no powers: write l2*l2"),
    ("90°", 2, "'°'", "a number, a name, an operator or a bracket", "write deg: 30 deg"),
    ("l2 − 1", 3, "'−'", "a number, a name, an operator or a bracket", "write - (the hyphen on the keyboard)"),
    ("sin 3", 4, "'3'", "'(' after sin", ""),
    ("sin", 3, "the end", "'(' after sin", ""),
    ("sin(1, 2)", 5, "','", "a number, a name, an operator or a bracket", "write decimals with a point: 0.5, not 0,5"),
    ("deg", 0, "'deg'", "a number, a name, '-' or '('", "a unit follows a number: 30 deg"),
    ("l2 deg", 3, "'deg'", "an operator or the end", "write * between factors: 2*l2"),
    ("1e999", 0, "'1e999'", "a number below 1.8e308", ""),
    ("exp(1)", 3, "'('", "an operator or the end", ""),
    ("+3", 0, "'+'", "a number, a name, '-' or '('", ""),
    ("٣", 0, "'٣'", "a number, a name, an operator or a bracket", ""),
    ("__import__(os)", 10, "'('", "an operator or the end", ""),
]  # fmt: skip


@pytest.mark.parametrize(("text", "position", "found", "expected", "hint"), WRONG)
def test_a_syntax_error_says_where_and_what(text: str, position: int, found: str, expected: str, hint: str) -> None:
    with pytest.raises(FormulaError) as caught:
        parse(text)
    error = caught.value
    assert (error.position, error.given, error.expected, error.hint) == (position, found, expected, hint)
    assert isinstance(error, UsageError)
    shown, caret = error.message.splitlines()[1:3]
    assert shown == f"  {text}"
    assert caret.index("^") == position + 2


def test_a_long_formula_shows_only_the_place_of_its_error() -> None:
    with pytest.raises(FormulaError) as caught:
        parse("1 + " * 100 + "? + 2" + " + 3" * 30)
    shown, caret = caught.value.message.splitlines()[1:3]
    assert len(shown) < 90
    assert shown[caret.index("^")] == "?"


@pytest.mark.parametrize("opening", ["(", "-", "sin(", "-(", "sqrt(-"])
def test_depth_is_limited_and_so_is_length(opening: str) -> None:
    with pytest.raises(FormulaError, match=f"too deep a nesting; expected at most {MAX_DEPTH} levels"):
        parse(opening * (MAX_LENGTH // len(opening)))
    with pytest.raises(FormulaError, match=f"{MAX_LENGTH + 1} characters; expected at most {MAX_LENGTH}"):
        parse("1" * (MAX_LENGTH + 1))


def test_formulas_at_the_limits_have_values() -> None:
    deep = "(" * MAX_DEPTH + "1" + ")" * MAX_DEPTH
    assert parse(deep).evaluate({}) == 1.0
    assert parse("+".join(["1"] * 500)).evaluate({}) == 500.0


@given(st.text(max_size=60) | st.text(alphabet="0123456789.eE+-*/() abl'_deg√,^", max_size=60))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        formula = parse(text)
    except FormulaError:
        return
    assert formula.names.isdisjoint(RESERVED)
