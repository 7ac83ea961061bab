"""Sliders on links that turn: legs of either sign, and ends that stand aside of them."""

import json
import math

import pytest
import sympy

from assur.cli.main import main
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.sets import next_set
from assur.derivation.solution import analytic_solution
from assur.derivation.strokes import stroke_vectors
from assur.derivation.unknown_directions import UnknownDirection
from assur.derivation.witness import ModularWitness
from assur.model.registry import load_record
from assur.synthesis.drafting.drafting import drafted
from assur.topology.notation import parse_chains

ASIDE = """
format = 1
name = "aside"
title = "a slider whose end stands aside, on a driven crank"
unit = "mm"
angle = "deg"
base = "base"

[platform]
link = "rod"
pose = ["x"]

[parameters]
a = { value = 10, meaning = "from the slider's pivot to the crank's" }
l = { value = 4, meaning = "crank" }
e = { value = 2, meaning = "end of the rod, aside" }

[links]
base = { meaning = "base" }
guide = { meaning = "turning guide" }
rod = { meaning = "sliding rod" }
crank = { meaning = "driven crank" }

[joints]
A = { type = "revolute", parent = "base", child = "guide", axis = "z" }
B = { type = "prismatic", parent = "guide", child = "rod", axis = "x" }
C = { type = "revolute", parent = "crank", child = "rod", at = ["l", 0, 0], child_at = [0, "e", 0], axis = "z" }
D = { type = "revolute", parent = "base", child = "crank", at = ["a", 0, 0], axis = "z" }

[inputs]
D = { name = "q" }

[home]
A = 40
B = 10
C = -50
D = 90
"""


def at(solution, given):
    """Numbers of all symbols, each root positive."""
    numbers = dict(given)
    for own in solution.definitions:
        numbers[own.symbol] = float(own.formula.subs(numbers))
    return {symbol.name: value for symbol, value in numbers.items()}


def test_legs_of_either_sign_reach_a_platform():
    solution = analytic_solution(load_record("planar_3rpr"), "inverse")
    assert solution.branches == 8
    assert solution.closes()


def test_a_leg_is_as_long_as_its_ends_are_apart():
    record = load_record("planar_3rpr")
    solution = analytic_solution(record, "inverse")
    symbols = {
        symbol.name: symbol for own in solution.loops.forms for part in own.values() for symbol in part.free_symbols
    }
    given = {symbols[name]: parameter.inside for name, parameter in record.parameters.items() if name in symbols}
    given |= {symbols["x"]: 3.0, symbols["y"]: -2.0, symbols["cos_phi"]: 0.6, symbols["sin_phi"]: 0.8}
    numbers = at(solution, given)
    assert numbers["q_P1"] == pytest.approx(math.hypot(3.0, -2.0))
    x, y = 3.0 + 0.6 * numbers["d1"] - numbers["a2"], -2.0 + 0.8 * numbers["d1"]
    assert numbers["q_P2"] == pytest.approx(math.hypot(x, y))
    assert (numbers["cos_cylinder2"], numbers["sin_cylinder2"]) == pytest.approx(
        (x / math.hypot(x, y), y / math.hypot(x, y))
    )


def test_an_end_aside_of_its_slider_is_reached_in_two_ways(tmp_path):
    path = tmp_path / "aside.toml"
    path.write_text(ASIDE)
    solution = analytic_solution(load_record(path), "direct")
    assert solution.branches == 2
    assert solution.closes()


def platform_on_a_slider(*places):
    """A slider on a platform that turns; each place (along, aside) of the platform stands at x, y."""
    q, c, s, x, y = sympy.symbols("q c s x y")
    circle = UnknownDirection("circle", "platform", (c, s), ("platform",))
    one = sympy.Integer(1)
    forms = [form for along, aside in places
             for form in ({c: q + along, s: -aside, one: -x}, {c: aside, s: q + along, one: -y})]  # fmt: skip
    return stroke_vectors(forms, {q: circle}, ModularWitness())


def test_what_else_a_platform_holds_waits_for_the_vector_with_its_slider():
    a, b = sympy.symbols("a b")
    (vector,), forms = platform_on_a_slider((0, 0), (a, b))
    c, s = vector.circle.unknowns
    assert [sorted(map(str, form.keys() & {c, s})) for form in forms] == [[], [], ["c", "s"], ["c", "s"]]
    chosen, equations = next_set(forms, [vector.direction], ModularWitness(), after=[vector.circle])
    assert chosen == (vector.direction,)
    assert not any({c, s} & form.keys() for form in equations)


def test_a_vector_that_is_not_solved_alone_is_refused_by_its_link():
    a, b = sympy.symbols("a b")
    (vector,), forms = platform_on_a_slider((0, 0), (a, b))
    with pytest.raises(NotDerivedError, match="platform: turns, carries a slider, and no vector"):
        next_set(forms[2:], [vector.direction], ModularWitness(), after=[vector.circle])


@pytest.mark.deep
@pytest.mark.parametrize(
    "chains",
    [
        ["R[z] P[x] R[z]", "P[x] R[z] R[z]", "R[z] R[z] P[x]"],
        ["R[z] R[z] P[x]", "R[z] R[z] R[z]", "R[z] R[z] R[z]"],
    ],
)
def test_the_angle_of_a_platform_that_slides_on_a_link_says_all_else(chains, tmp_path, capsys):
    """One slider on the platform and two dyads: lengths along its direction are linear once its angle is known."""
    path, data = tmp_path / "own.toml", tmp_path / "d.json"
    path.write_text(drafted(parse_chains(chains), path).text, encoding="utf-8")
    solution = analytic_solution(load_record(path), "direct")
    assert (solution.branches, solution.closes()) == (6, True)
    assert main(["derive", str(path), "--problem", "direct", "--prove", "--json"]) == 0
    data.write_text(capsys.readouterr().out, encoding="utf-8")
    assert json.loads(data.read_text(encoding="utf-8"))["problems"][0]["count"]["solutions"] == 6
    assert main(["verify", str(data), "--mechanism", str(path)]) == 0
