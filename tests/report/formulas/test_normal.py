import numpy as np
import pytest

from assur.report.formulas.normal import summands, text
from assur.report.formulas.trace import POINTS, Book, Letter, Tracing, leaf

BOOK = Book()
A, B, C = (
    leaf(BOOK, Letter(name, f"<mi>{name}</mi>"), np.linspace(k + 1, k + 2, POINTS)) for k, name in enumerate("abc")
)


@pytest.mark.parametrize(
    ("term", "expected"),
    [
        (A + B - C, "a + b - c"),
        (-(A - B), "b - a"),
        (A - (B - C), "a - b + c"),
        (A * A, "a^2"),
        (A * (B + C) * 2 * A, "2 a^2 (b + c)"),
        ((A + B) * (A + B), "(a + b)^2"),
        (2 * (A - B) * (2 * (A - B)), "4 (a - b)^2"),
        (A / 2 / B, "a/(2 b)"),
        (A / (B / C), "a c/b"),
        ((A + B) / C, "(a + b)/c"),
        (A + A, "2 a"),
        (A - A + B, "b"),
        (0 * A, "0"),
        (0 * A + B, "b"),
        (1 - A * A, "1 - a^2"),
        (-A * B / 3, "-a b/3"),
        (0.5 * A, "a/2"),
        (Tracing(BOOK).sqrt(A * A - B) * A, "a sqrt(a^2 - b)"),
        (2 / A, "2/a"),
    ],
)
def test_text(term, expected):
    assert text(term) == expected


@pytest.mark.parametrize("term", [A + B * C - A / B, -(A - B) * (C + 2), (A + B) / (C - 5) - 3])
def test_products_add_up_to_the_value(term):
    total = sum(
        float(item.coefficient)
        * np.prod([power.base.values**power.exponent for power in item.above] or [1.0], axis=0)
        / np.prod([power.base.values**power.exponent for power in item.below] or [1.0], axis=0)
        for item in summands(term)
    )
    assert np.allclose(total, term.values)
