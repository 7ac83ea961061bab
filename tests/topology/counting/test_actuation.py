"""Actuation: which inputs determine a mechanism, what is wrong with the others, and the matroid of all choices."""

from functools import partial
from itertools import combinations

import numpy as np
import pytest

from assur.topology.counting.actuation import actuation, locked_freedoms
from assur.topology.screws.edges import closure, column_names, input_columns
from twist_chains import X, Y, Z, ball, slide, turn, turns
from twist_chains import chain as named_chain

chain = partial(named_chain, letter="")


def zeng(rng, inputs):
    """The mechanism of the paper with parallelograms as one joint; actuated as `inputs` say."""
    across = [np.cross(axis, rng.normal(size=3)) for axis in (X, Y)]
    parts = {
        "A": ("base", "m", [[slide(Y)], *turns(rng, X, 2)]),
        "B": ("base", "m", [[slide(Y)], *turns(rng, X, 2)]),
        "C": ("m", "p", turns(rng, Y, 2)),
        "D": ("base", "p", [[slide(Y)], *[[slide(axis)] for axis in across]]),
    }
    numbers = {name: [int(item[1]) - 1 for item in inputs if item[0] == name] for name in parts}
    return [edge for name, (*ends, joints) in parts.items() for edge in chain(name, *ends, joints, numbers[name])]


def judged(inputs, seed=0):
    return actuation(zeng(np.random.default_rng(seed), inputs), "base", "p")


def test_the_inputs_of_the_paper_are_valid():
    found = judged(("A1", "B1", "D1"))
    assert (found.verdict, found.needed, found.left, found.redundancy, found.hint) == ("valid", 3, 0, 0, "")
    assert found.determining == (("A1", "B1", "D1"),)
    assert ("A1", "B1", "D1") in found.sets
    assert str(found) == f"valid: 3 inputs for 3 freedoms; {len(found.sets)} admissible sets"


def test_the_admissible_sets_of_the_paper_are_those_that_lock_it():
    """By rank of the whole closure with the inputs' rates at zero, set by set."""
    edges = zeng(np.random.default_rng(0), ("A1", "B1", "D1"))
    matrix = closure(edges)[0]
    names = column_names(edges)
    locking = []
    for chosen in combinations(range(len(names)), 3):
        free = np.delete(matrix, chosen, axis=1)
        if np.linalg.matrix_rank(free, tol=1e-8) == free.shape[1]:
            locking.append(tuple(names[index] for index in chosen))
    found = actuation(edges, "base", "p")
    assert sorted(found.sets) == locking
    assert 0 < len(locking) < found.possible == 165
    assert found.complete
    assert set(found.in_some) == {name for item in locking for name in item}
    assert set(found.in_every) == {name for name in names if all(name in item for item in locking)}


def test_sets_near_the_base_come_first():
    """C stands behind three joints, from the base by A or B and from the platform by D."""
    found = judged(("A1", "B1", "D1"))
    away = [sum(3 if name[0] == "C" else int(name[1]) - 1 for name in names) for names in found.sets]
    assert found.sets[0] == ("A1", "B1", "D1")
    assert away == sorted(away)


def test_too_few_inputs():
    found = judged(("A1", "B1"))
    assert (found.verdict, found.left, found.redundancy, found.determining) == ("too few", 1, 0, ())
    assert "D1" in found.helpful
    assert "A1" not in found.helpful
    assert found.hint.startswith("lock also 1 of ")


def test_redundant_inputs_and_the_sets_of_them_that_determine_the_mechanism():
    inputs = ("A1", "B1", "C1", "D1")
    found = judged(inputs)
    assert (found.verdict, found.left, found.redundancy, found.hint) == ("redundant", 0, 1, "")
    for name in found.superfluous:
        rest = tuple(item for item in inputs if item != name)
        assert judged(rest).verdict == "valid"
    valid = {rest for rest in combinations(inputs, 3) if judged(rest).verdict == "valid"}
    assert set(found.determining) == valid


def test_dependent_inputs():
    """C1 and C2 turn against each other: locking one locks the other."""
    found = judged(("A1", "C1", "C2"))
    assert (found.verdict, found.left, found.redundancy, found.superfluous) == ("dependent", 1, 1, ("C1", "C2"))
    assert found.hint.startswith("leave out 1 of C1, C2 and lock also 1 of ")
    assert not {"C1", "C2"} & set(found.helpful)
    assert not any({"C1", "C2"} <= set(item) for item in found.sets)


def test_ball_joints_and_spinning_joints_are_no_inputs():
    """A P-S-S leg: only its P may be driven; the two S spin together."""
    rng = np.random.default_rng(1)
    edges = []
    for index, name in enumerate("ABCDEF"):
        low, high = rng.normal(size=(2, 3))
        edges += chain(name, "base", "p", [[slide(rng.normal(size=3))], ball(low), ball(high)], (0,) if index else ())
    found = actuation(edges, "base", "p")
    assert (found.needed, found.verdict) == (6, "too few")
    assert found.sets == (("A1", "B1", "C1", "D1", "E1", "F1"),)
    assert found.in_some == found.in_every == found.sets[0]
    assert found.helpful == ("A1",)


def test_a_cylindrical_joint_that_spins_with_its_rod_slides_only():
    """C-S with the ball on the axis of the C: its rotation is internal, so only its translation may be driven."""
    rng = np.random.default_rng(1)
    edges = []
    for name in "ABCDEF":
        axis, low, high = rng.normal(size=(3, 3))
        first = [slide(axis), turn(axis, low)] if name == "A" else [slide(axis)]
        more = [ball(low + 0.3 * axis), [turn(across, high) for across in (X, Y)]]
        edges += chain(name, "base", "p", [first, *more], (0,))
    axis = edges[0].twists[0, 3:, 0]
    through = edges[1].twists[0] @ axis  # the rotation of the ball about the axis of the C
    np.testing.assert_allclose(through, edges[0].twists[0, :, 1], atol=1e-12)
    found = actuation(edges, "base", "p")
    assert (found.needed, found.verdict) == (6, "valid")
    assert "A1.1" in found.in_some
    assert "A1.2" not in found.in_some
    assert not any("A1.2" in item for item in found.sets)


def test_a_limb_with_a_joint_too_many_needs_an_input_there():
    rng = np.random.default_rng(2)
    plain = [edge for name in "AB" for edge in chain(name, "base", "p", turns(rng, Z, 3), (0,))]
    limb = chain("C", "base", "p", turns(rng, Z, 4), (0, 1))
    found = actuation(plain + limb, "base", "p")
    assert (found.needed, found.verdict) == (4, "valid")
    assert all(sum(name.startswith("C") for name in item) >= 1 for item in found.sets)


def test_every_leg_of_a_planar_platform_gives_one_input_or_more():
    """3-RRR: 84 choices of three joints; all three in one leg would leave the others loose, but lock the platform."""
    rng = np.random.default_rng(2)
    edges = [edge for name in "ABC" for edge in chain(name, "base", "p", turns(rng, Z, 3), (0,))]
    found = actuation(edges, "base", "p")
    assert (found.possible, len(found.sets), found.in_every) == (84, 84, ())
    assert len(found.in_some) == 9


def test_two_legs_locked_altogether_leave_a_rotation():
    """6-UPS: U and P of a leg fix its ball; two fixed balls let the platform turn about their line. C(6, 2) = 15."""
    rng = np.random.default_rng(2)
    edges = []
    for name in "ABCDEF":
        low, high = rng.normal(size=(2, 3))
        joints = [[turn(axis, low) for axis in rng.normal(size=(2, 3))], [slide(high - low)], ball(high)]
        edges += chain(name, "base", "p", joints, (1,))
    found = actuation(edges, "base", "p")
    assert found.verdict == "valid"
    assert (found.tried, found.possible, len(found.sets)) == (18564, 18564, 18564 - 15)
    admissible = set(found.sets)
    for one, two in combinations("ABCDEF", 2):
        assert tuple(f"{leg}{joint}" for leg in (one, two) for joint in ("1.1", "1.2", "2")) not in admissible


def test_a_structure_needs_no_inputs():
    rng = np.random.default_rng(2)
    edges = [edge for name in "ABC" for edge in chain(name, "base", "p", turns(rng, Z, 2))]
    found = actuation(edges, "base", "p")
    assert (found.needed, found.verdict, found.sets, found.in_some) == (0, "valid", ((),), ())


def test_the_first_sets_of_many():
    found = actuation(zeng(np.random.default_rng(0), ("A1", "B1", "D1")), "base", "p", limit=20)
    whole = judged(("A1", "B1", "D1"))
    assert (found.tried, found.possible, found.complete) == (20, 165, False)
    assert set(found.sets) < set(whole.sets)
    assert found.sets[0] == whole.sets[0]
    assert (found.in_some, found.in_every) == (whole.in_some, whole.in_every)
    assert str(found).endswith("among the first 20 of 165")


def test_no_set_of_single_freedoms_may_do():
    """A ball joint alone: its freedoms are not single ones."""
    found = actuation(chain("A", "base", "p", [ball(X)]), "base", "p")
    assert (found.needed, found.sets, found.in_some, found.verdict) == (3, (), (), "too few")
    assert found.hint == ""


@pytest.mark.parametrize("seed", range(6))
def test_locked_freedoms_by_rank(seed):
    """Against the dimension of the platform's motion with the locked columns taken out of the closure."""
    rng = np.random.default_rng(seed)
    edges = zeng(rng, ("A1", "B1", "D1"))
    inputs = sorted(rng.choice(11, 3, replace=False).tolist())
    kept = [edge for index, edge in enumerate(edges) if index not in inputs]
    matrix = np.delete(closure(edges)[0], inputs, axis=1)
    free = matrix.shape[1] - np.linalg.matrix_rank(matrix, tol=1e-8)
    assert len(kept) == matrix.shape[1]
    assert locked_freedoms(edges, inputs, "base", "p") == free
    assert locked_freedoms(edges, input_columns(edges), "base", "p") == 0
