"""What is printed is what is computed: the MathML of every line is read back as numbers and gives the solutions.

The evaluator below knows MathML and nothing of how the report makes it.
"""

import math
from functools import cache
from xml.etree import ElementTree

import numpy as np
import pytest

import assur
from assur.kinematics.modes import sign_names
from assur.kinematics.pose import pose_of
from assur.model.pose import is_angle
from assur.report.formulas.latex import latex_mathml, name_mathml
from assur.report.formulas.mathml import letter_mathml, matrix_mathml, term_mathml
from assur.report.formulas.normal import text
from assur.report.formulas.reading import reading

APPLY, TIMES = "\u2061", "\u2062"
FUNCTIONS = ("cos", "sin", "sgn")


def parsed(mathml: str) -> ElementTree.Element:
    return ElementTree.fromstring(f"<mrow>{mathml}</mrow>")


def flat(element: ElementTree.Element) -> str:
    return ElementTree.tostring(element, encoding="unicode").strip()


class Evaluator:
    """Numbers of MathML, for known letters (MathML -> number)."""

    def __init__(self, letters: dict[str, float]) -> None:
        self.letters = {flat(parsed(key)[0]): value for key, value in letters.items()}

    def value(self, element: ElementTree.Element) -> float:
        if flat(element) in self.letters:
            return self.letters[flat(element)]
        kind = element.tag
        if kind == "mn":
            return float(element.text)
        if kind == "mfrac":
            return self.value(element[0]) / self.value(element[1])
        if kind == "msqrt":
            return math.sqrt(max(self.row(list(element)), 0.0))
        if kind == "msup":
            return self.value(element[0]) ** self.value(element[1])
        assert kind == "mrow", flat(element)
        return self.row(list(element))

    def row(self, items: list[ElementTree.Element]) -> float:
        items = [item for item in items if item.tag != "mspace"]
        total, sign, product = 0.0, 1.0, None
        while items:
            item = items.pop(0)
            if item.tag == "mo" and item.text in ("+", "−"):
                total, product = total + sign * (product or 0.0), None
                sign = 1.0 if item.text == "+" else -1.0
            elif item.tag == "mo" and item.text == "(":
                inner = []
                while items[0].text != ")" or items[0].tag != "mo":
                    inner.append(items.pop(0))
                items.pop(0)
                product = self.row(inner) * (1.0 if product is None else product)
            elif item.tag == "mo":
                assert item.text == TIMES, item.text
            elif items and items[0].text == APPLY:
                items.pop(0)
                factor = self.function(item, items.pop(0))
                product = factor * (1.0 if product is None else product)
            else:
                product = self.value(item) * (1.0 if product is None else product)
        return total + sign * (product or 0.0)

    def function(self, name: ElementTree.Element, argument: ElementTree.Element) -> float:
        power = 1.0
        if name.tag == "msup":
            name, power = name[0], self.value(name[1])
        key = flat(parsed(f'<mrow>{flat(name)}<mo>{APPLY}</mo><mspace width="0.14em"/>{flat(argument)}</mrow>')[0])
        return self.letters[key] ** power


def given_letters(record, problem, solution):
    """Letters of parameters, signs and given numbers, with their values, in MathML."""
    letters = {name_mathml(name): value for name, value in vars(record.values).items()}
    mode = solution.mode
    for name, symbol in zip(sign_names(record, problem), mode, strict=True):
        itself = record.closed_form.signs[name].attribute == name
        written = name_mathml(name)
        bracketed = f"<mrow><mo>(</mo>{written}<mo>)</mo></mrow>"
        key = f'<mrow><mi>sgn</mi><mo>{APPLY}</mo><mspace width="0.14em"/>{bracketed}</mrow>' if itself else written
        letters[key] = 1.0 if symbol == "+" else -1.0
    if problem == "inverse":
        return letters | pose_letters(record, solution.pose)
    for item, value in zip(record.inputs, solution.inputs, strict=True):
        written = latex_mathml(item.latex) if item.latex else name_mathml(item.name)
        letters |= as_letters(written, (value - item.offset) * item.sign, item.coordinate.kind == "angle")
    return letters


def as_letters(written, value, angle):
    """A number by its letter, or the cosine and the sine of an angle by theirs."""
    if not angle:
        return {written: float(value)}
    return {
        f'<mrow><mi>{name}</mi><mo>{APPLY}</mo><mspace width="0.14em"/>{written}</mrow>': getattr(math, name)(value)
        for name in ("cos", "sin")
    }


def pose_letters(record, pose):
    letters = {}
    for name, value in zip(record.platform.pose, pose, strict=True):
        letters |= as_letters(name_mathml(name), value, is_angle(name))
    return letters


def evaluated(record, problem, solution, lines):
    """Every letter of the printed lines with its number, in the order in which they are printed."""
    letters = given_letters(record, problem, solution)
    for line in lines:
        number = Evaluator(letters).row(list(parsed(term_mathml(line.term))))
        letters[letter_mathml(line.letter)] = number
    return letters


def has_kernel(name, problem):
    """Whether formulas answer a problem, rather than a polynomial or a search."""
    form = assur.load(name).closed_form
    return form is not None and callable(form.direct if problem == "direct" else form.inverse)


CASES = [(name, problem) for name in assur.names() for problem in ("direct", "inverse") if has_kernel(name, problem)]


@pytest.fixture(params=CASES, ids="-".join)
def case(request):
    return request.param


@cache
def loaded(name):
    return assur.load(name)


@cache
def read_of(name, problem):
    return reading(loaded(name), problem)


@pytest.fixture
def mechanism(case):
    return loaded(case[0])


@pytest.fixture
def problem(case):
    return case[1]


@pytest.fixture
def answer(mechanism, problem):
    home = mechanism.home_values
    if problem == "inverse":
        return mechanism.inverse(pose_of(mechanism, home))
    return mechanism.direct([item.sign * home[item.coordinate.index] + item.offset for item in mechanism.inputs])


def test_most_mechanisms_have_formulas():
    assert len([problem for _, problem in CASES if problem == "inverse"]) >= 15
    assert len([problem for _, problem in CASES if problem == "direct"]) >= 9


def test_printed_formulas_give_every_solution(mechanism, problem, answer):
    assert len(answer) > 0
    lines = read_of(mechanism.name, problem).lines
    for solution in answer:
        letters = Evaluator(evaluated(mechanism, problem, solution, lines)).letters
        if problem == "direct":
            expected = pose_letters(mechanism, solution.pose)
            found, wanted = [letters[flat(parsed(key)[0])] for key in expected], list(expected.values())
        else:
            values = {
                (line.letter.function, line.letter.name): letters[flat(parsed(letter_mathml(line.letter))[0])]
                for line in lines
            }
            found, wanted = [], []
            for item, value in zip(mechanism.inputs, solution.inputs, strict=True):
                if item.coordinate.kind == "length":
                    found.append(values["", item.name])
                    wanted.append(value)
                else:
                    found += [values["cos", item.name], values["sin", item.name]]
                    wanted += [math.cos(value), math.sin(value)]
        assert np.allclose(found, wanted, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("name", [name for name, problem in CASES if problem == "inverse"])
def test_printed_jacobians_are_those_that_are_computed(name):
    mechanism = loaded(name)
    pose = pose_of(mechanism, mechanism.home_values)
    read = read_of(name, "inverse")
    for solution in mechanism.inverse(pose):
        letters = evaluated(mechanism, "inverse", solution, read.lines)
        here = mechanism.velocity_map(pose, solution.mode)
        for rows, wanted in ((read.jp, here.jp), (read.jq, here.jq)):
            cells = parsed(matrix_mathml(rows)).iter("mtd")
            found = [Evaluator(letters).row(list(cell)) for cell in cells]
            assert np.allclose(found, wanted.ravel(), rtol=1e-9, atol=1e-9)


def test_quantities_have_the_values_of_the_interface(mechanism, problem, answer):
    lines = read_of(mechanism.name, problem)
    solution = next(iter(answer))
    letters = evaluated(mechanism, problem, solution, lines.lines)
    seen = set()
    for line in (*lines.lines, *lines.named):
        number = Evaluator(letters).row(list(parsed(term_mathml(line.term))))
        letters.setdefault(letter_mathml(line.letter), number)
        if line.letter.name in solution.quantities:
            value = solution.quantities[line.letter.name]
            wanted = getattr(math, line.letter.function)(value) if line.letter.function else value
            assert math.isclose(number, wanted, rel_tol=1e-9, abs_tol=1e-9), line.letter
            seen.add(line.letter.name)
    assert seen == set(solution.quantities)


def test_every_line_needs_only_what_stands_before_it(mechanism, problem):
    read = read_of(mechanism.name, problem)
    known = {line.letter for line in read.lines}
    before = set()
    for line in read.lines:
        used = {part.letter for part in walk(line.term) if part.letter is not None}
        assert used & known <= before
        before.add(line.letter)
    assert len(before) == len(read.lines)


def walk(term):
    yield term
    for part in term.parts:
        yield from walk(part)


def test_lines_are_short(mechanism, problem):
    """A letter stands for its formula wherever it turns up."""
    assert max(len(text(line.term)) for line in read_of(mechanism.name, problem).lines) < 120


@pytest.mark.parametrize(
    ("problem", "letter", "formula", "equation"),
    [
        ("inverse", "cos alpha", "(x + b - d)/l4", "(17), (18)"),
        ("inverse", "cos beta", "(x + d - b)/l6", "(16), (19)"),
        ("inverse", "yA3", "y - u3", ""),
        ("direct", "B", "yA1 - l3 - yA2", "(9)"),
        ("direct", "t", "v + l7 + l8 - w", "(14)"),
        ("direct", "x", "l4 cos alpha - b + d", ""),
    ],
)
def test_lines_of_the_papers_mechanism_read_as_the_paper_prints_them(problem, letter, formula, equation):
    lines = reading(assur.load("zeng2019"), problem).lines
    found = {f"{line.letter.function} {line.letter.name}".strip(): line for line in lines}[letter]
    assert text(found.term) == formula
    assert not equation or found.equation == equation


def test_a_radicand_that_is_needed_once_stands_where_it_is_needed():
    record = assur.load("zeng2019")
    lines = reading(record, "direct").lines
    assert "w2" not in {line.letter.name for line in lines}
    assert text(next(line.term for line in lines if line.letter.name == "w")) == "e1 sqrt(l2^2 - B^2/4)"
