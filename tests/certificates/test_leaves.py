import numpy as np
import pytest

from assur.certificates.formulas import RegionFormulas, formulas
from assur.certificates.leaves import BLOCK, Leaves
from assur.mechanism import load
from assur.model.registry import load_record
from assur.numerics.recording.tape import Recorder
from assur.workspace.certified.boxes import Boxes
from assur.workspace.slices import Slice


@pytest.fixture(scope="module")
def leaves():
    return Leaves(formulas(load_record("zeng2019")))


def boxes(count, size, seed=3):
    low = np.random.default_rng(seed).uniform([-110, -250, 180], [90, 250, 480], (count, 3)).T
    return Boxes(low, low + size)


def margins(x, z):
    """Those of Eqs. (18)-(21), for b = 210, d = 40 and the rest as in the file, written down again."""
    p = load_record("zeng2019").values
    alpha, beta = (x + p.b - p.d) / p.l4, (x + p.d - p.b) / p.l6
    w = z - p.l4 * np.sqrt(np.maximum(1 - alpha**2, 0)) - p.l1
    v = z - p.l8 - p.l6 * np.sqrt(np.maximum(1 - beta**2, 0)) - p.l7 - p.l1
    return np.array([1 - alpha**2, 1 - beta**2, p.l2**2 - w**2, p.l6**2 - v**2])


def test_leaves_are_true_of_points_inside(leaves):
    found = boxes(3000, 8.0)
    tokens = leaves.tokens(found)
    assert {"r", "b", "o00", "o02"} <= set(tokens.tolist())
    rng = np.random.default_rng(4)
    for _ in range(20):
        x, _, z = found.low + rng.random(found.low.shape) * (found.high - found.low)
        values = margins(x, z)
        assert np.all(values[:, np.isin(tokens, ("i", "r"))] >= 0)
        for k in range(4):
            assert np.all(values[k, tokens == f"o{k:02x}"] < 0)


def test_no_factor_changes_its_sign_inside_a_regular_leaf(leaves):
    record, found = load("zeng2019"), boxes(2000, 8.0)
    regular = found[leaves.tokens(found) == "r"]
    assert len(regular) > 200
    for name, values in factors_inside(record, regular).items():
        assert np.all(np.all(values > 0, axis=0) | np.all(values < 0, axis=0)), name


def test_where_a_leaf_is_only_inside_a_factor_may_change_its_sign(leaves):
    found = boxes(2000, 8.0)
    inside = found[leaves.tokens(found) == "i"]
    signs = [np.sign(values) for values in factors_inside(load("zeng2019"), inside).values()]
    assert np.mean(np.any([np.any(each != each[0], axis=0) for each in signs], axis=0)) > 0.1


def factors_inside(record, found):
    """Factors (20, N) at random poses of boxes, by the solver, which knows no intervals."""
    rng = np.random.default_rng(5)
    poses = found.low + rng.random((20, *found.low.shape)) * (found.high - found.low)
    solved = record.inverse(np.moveaxis(poses, 1, -1), record.modes.default_working)
    assert solved.exists.all()
    return {name: values[..., 0] for name, values in solved.factors.items()}


def test_inside_a_leaf_a_stroke_is_kept():
    record, stroke = load("zeng2019"), (0.0, 250.0)
    bounded = Leaves(formulas(load_record("zeng2019"), strokes={"yA1": stroke}))
    found = boxes(2000, 8.0)
    inside = found[np.isin(bounded.tokens(found), ("i", "r"))]
    assert len(inside) > 100
    rng = np.random.default_rng(6)
    for _ in range(10):
        poses = inside.low + rng.random(inside.low.shape) * (inside.high - inside.low)
        first = record.inverse(poses.T, record.modes.default_working).inputs[:, 0, 0]
        assert np.all((stroke[0] <= first) & (first <= stroke[1]))


def test_small_boxes_are_decided_but_near_the_boundary(leaves):
    found = boxes(3000, 1e-3)
    open_ = leaves.tokens(found) == "b"
    assert np.mean(open_) < 0.01


def test_blocks_make_no_difference(leaves):
    found = boxes(BLOCK + 77, 5.0)
    assert np.array_equal(leaves.tokens(found)[-77:], leaves.tokens(found[slice(BLOCK, None)]))


def test_a_coordinate_without_influence_is_never_halved(leaves):
    found = boxes(500, np.array([[5.0], [400.0], [5.0]]))
    axes = leaves.axes(found, np.array([[200.0], [500.0], [300.0]]), np.array([[1.0], [np.inf], [1.0]]))
    assert set(axes.tolist()) == {0, 2}


def test_no_side_is_halved_below_the_least(leaves):
    found = boxes(500, np.array([[5.0], [400.0], [5.0]]))
    axes = leaves.axes(found, np.array([[200.0], [500.0], [300.0]]), np.array([[1.0], [np.inf], [6.0]]))
    assert set(axes.tolist()) == {0}


def test_signs_of_factors(leaves):
    low = np.array([[-15.0], [0.0], [400.0]])
    signs = dict(leaves.signs(Boxes(low, low + 1)))
    assert signs["u2"] is True
    assert signs["u1"] is False
    assert len(leaves.signs(Boxes(low, low + 1))) == len(leaves.formulas.names("factors"))


def test_a_factor_with_a_pole_changes_its_sign_without_a_zero():
    """x and 1/x are negative left of zero and positive right of it; only the first is zero between."""
    left, right = (Boxes(np.array([[a]]), np.array([[b]])) for a, b in ((-1.0, -0.5), (0.5, 1.0)))
    regular, inside = Boxes(np.array([[-1.0, 0.5]]), np.array([[-0.5, 1.0]])), Boxes(left.high, right.low)
    for factor, zero in ((lambda x: x + x, True), (lambda x: 1 / x, False), (lambda x: 1 / (x * x + 1), False)):
        recorder = Recorder()
        x = recorder.varying("x")
        rules = RegionFormulas(
            Slice(("x",), ("x",), {}), recorder.tape({"margins: m": x * x, "factors: f": factor(x)}), {}
        )
        assert Leaves(rules).vanishes(regular, inside) is zero
