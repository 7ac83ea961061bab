import numpy as np
import pytest

from assur.certificates.tree import TOKEN, Limits, grow, planted
from assur.errors import UsageError
from assur.workspace.certified.boxes import Boxes

SQUARE = Boxes(np.zeros((2, 1)), np.array([[1.0], [3.0]]))


def disc(boxes):
    """Inside or outside of the disc about the origin, by the nearest and the farthest corner."""
    near, far = np.sum(boxes.low**2, axis=0), np.sum(boxes.high**2, axis=0)
    return np.where(far <= 1, "i", np.where(near > 1, "o00", "b"))


def longest(boxes):
    return np.argmax(boxes.high - boxes.low, axis=0)


def limits(**changes):
    return Limits(**{"unsettled": ("b",), "gap": 0.01, "least": np.full((2, 1), 1e-12), "most": 5000, **changes})


def walked(text, low, high):
    """Leaves (token, low, high) by recursion: another way than the one with a stack."""
    if not text[0].isdigit():
        size = 3 if text[0] == "o" else 1
        return [(text[:size], low, high)], text[size:]
    axis = int(text[0])
    middle = 0.5 * low[axis] + 0.5 * high[axis]
    first, rest = walked(text[1:], low, tuple(middle if k == axis else v for k, v in enumerate(high)))
    second, rest = walked(rest, tuple(middle if k == axis else v for k, v in enumerate(low)), high)
    return first + second, rest


def test_the_text_is_the_leaves_depth_first():
    tree = grow(SQUARE, disc, longest, limits())
    leaves, rest = walked(tree.text, (0.0, 0.0), (1.0, 3.0))
    assert rest == ""
    mine = {
        (token, tuple(low), tuple(high))
        for token, low, high in zip(
            tree.tokens[tree.leaves].tolist(),
            tree.boxes[tree.leaves].low.T.tolist(),
            tree.boxes[tree.leaves].high.T.tolist(),
            strict=True,
        )
    }
    assert set(leaves) == mine
    assert len(leaves) == len(mine) > 100


def test_leaves_cover_the_box_and_bound_the_area():
    tree = grow(SQUARE, disc, longest, limits())
    boxes, tokens = tree.boxes[tree.leaves], tree.tokens[tree.leaves]
    areas = np.prod(boxes.high - boxes.low, axis=0)
    assert np.sum(areas) == pytest.approx(3.0, abs=1e-12)
    assert np.sum(areas) == pytest.approx(3.0 * np.sum(tree.shares[tree.leaves]), abs=1e-12)
    low, gap = np.sum(areas[tokens == "i"]), np.sum(areas[tokens == "b"])
    assert low < np.pi / 4 < low + gap
    assert gap <= 0.01 * low


@pytest.mark.parametrize("most", [1, 2, 7, 100])
def test_there_are_at_most_so_many_leaves(most):
    assert int(np.sum(grow(SQUARE, disc, longest, limits(most=most)).leaves)) == most


def test_no_box_is_halved_below_the_finest():
    tree = grow(SQUARE, disc, longest, limits(gap=0.0, least=np.array([[0.1], [0.1]])))
    halved, open_ = tree.boxes[~tree.leaves], tree.boxes[tree.tokens == "b"]
    assert np.all(np.max(halved.high - halved.low, axis=0) > 0.1)
    assert np.all(np.max(open_.high - open_.low, axis=0) <= 0.1)


@pytest.mark.parametrize("after", [2, 3, 5])
@pytest.mark.parametrize("where", ["judge", "axes", "progress"])
def test_what_is_done_is_kept_after_ctrl_c(after, where):
    calls = []

    def stopping(name, function):
        def called(*arguments):
            calls.append(name)
            if calls.count(where) > after:
                raise KeyboardInterrupt
            return function(*arguments)

        return called

    steps = stopping("progress", lambda *_: None)
    tree = grow(SQUARE, stopping("judge", disc), stopping("axes", longest), limits(stoppable=True), steps)
    leaves, rest = walked(tree.text, (0.0, 0.0), (1.0, 3.0))
    assert rest == ""
    assert calls.count(where) == after + 1
    assert len(leaves) >= 2
    assert any(token == "b" for token, _, _ in leaves)
    for token, low, high in leaves:
        assert disc(Boxes(np.array(low)[:, None], np.array(high)[:, None]))[0] == token


@pytest.mark.parametrize("where", ["judge", "axes", "progress"])
def test_ctrl_c_is_raised_where_nothing_is_kept(where):
    def interrupted(*_):
        raise KeyboardInterrupt

    given = {"judge": disc, "axes": longest, "progress": None, where: interrupted}
    with pytest.raises(KeyboardInterrupt):
        grow(SQUARE, given["judge"], given["axes"], limits(), given["progress"])


def test_a_text_is_planted_again():
    tree = grow(SQUARE, disc, longest, limits())
    again = planted(tree.text, SQUARE, disc)
    assert again.text == tree.text
    order = [np.lexsort((*part.boxes.low, *part.boxes.high)) for part in (tree, again)]
    for name in ("low", "high"):
        one, two = (getattr(part.boxes, name)[:, k] for part, k in zip((tree, again), order, strict=True))
        assert np.array_equal(one, two)
    assert np.array_equal(tree.shares[order[0]], again.shares[order[1]])


def test_a_tree_that_was_carried_on_ends_as_one_that_was_not_interrupted():
    few = grow(SQUARE, disc, longest, limits(most=40))
    more = grow(
        SQUARE, disc, longest, limits(gap=0.0, least=np.full((2, 1), 0.02)), start=planted(few.text, SQUARE, disc)
    )
    assert more.text == grow(SQUARE, disc, longest, limits(gap=0.0, least=np.full((2, 1), 0.02))).text


def test_leaves_of_a_text_are_judged_anew():
    """Whatever a text says of its leaves, the tree says what the judge does."""
    tree = grow(SQUARE, disc, longest, limits())
    for lie in ("i", "r", "b", "o00"):
        text = "".join(token if token.isdigit() else lie for token in TOKEN.findall(tree.text))
        assert planted(text, SQUARE, disc).text == tree.text


@pytest.mark.parametrize(
    "text", [None, 5, "", "?", "bi", "0b", "0bbb", "00bb", "2bb", "b?", "0", "0b0", "0" * 1080 + "b" * 1081]
)
def test_what_is_no_whole_tree_is_refused(text):
    with pytest.raises(UsageError, match="no whole tree"):
        planted(text, SQUARE, disc)


def depth_first(tree, place=0):
    """The tokens of a subtree, by going down it."""
    below = (tree.first[place], tree.second[place]) if tree.first[place] >= 0 else ()
    return tree.tokens[place] + "".join(depth_first(tree, child) for child in below)


@pytest.mark.parametrize("most", [1, 2, 3, 40, 400])
def test_a_text_goes_down_its_tree(most):
    tree = grow(SQUARE, disc, longest, limits(most=most))
    assert tree.text == depth_first(tree)
