import numpy as np

from assur.report.formulas.normal import text
from assur.report.formulas.trace import POINTS, Book, Letter, Tracing, leaf

X = np.linspace(1.0, 2.0, POINTS) + 0.3j
Y = np.linspace(3.0, 2.5, POINTS) - 0.2j


def letters(book):
    return leaf(book, Letter("x", "<mi>x</mi>"), X), leaf(book, Letter("y", "<mi>y</mi>"), Y)


def test_a_letter_is_recognised_by_its_values_whatever_its_formula():
    big = Letter("M", "<mi>M</mi>")
    book = Book(known=[(big, X * X - Y)])
    x, y = letters(book)
    assert text((x * x - y) * 2) == "2 M"
    assert text(1 + (x * x + x - y - x)) == "1 + M"
    assert text(book.met[big]) == "x^2 - y"


def test_another_formula_is_no_letter():
    book = Book(known=[(Letter("M", "<mi>M</mi>"), X * X - Y)])
    x, y = letters(book)
    assert text(x * x + y) == "x^2 + y"
    assert book.met == {}


def test_a_power_of_one_letter_is_written_as_such():
    book = Book(known=[(Letter("M", "<mi>M</mi>"), X * X / 4)])
    x, _ = letters(book)
    assert text(x * x / 4) == "x^2/4"


def test_values_follow_the_arithmetic():
    book = Book()
    x, y = letters(book)
    term = Tracing(book).sqrt((2 - x) / y + 3 * (-x)) - 1 / y
    assert np.allclose(term.values, np.sqrt((2 - X) / Y - 3 * X) - 1 / Y)
