"""What margins say of branches, by a kernel made up for it."""

from types import SimpleNamespace

import assur
from assur.kinematics.certified.branches import grouped, judged
from assur.model.closed_form import Branch, Margin
from assur.numerics.intervals.interval import Interval

MARGINS = (
    Margin("split", "1", "formulas degenerate", unit=0, zero="degenerate"),
    Margin("reach", "1", "circles meet", unit=2),
)


def said(split, reach):
    """Judgement of branches with such bounds of their margins."""
    record = assur.load("fivebar")
    first, second = (Interval.of(*zip(*pairs, strict=True)) for pairs in (split, reach))

    def kernel(ns):
        root = ns.sqrt(second)
        angle = (1 + 0 * root, 0 * root)
        return Branch((root, root), (angle, angle), {"split": first, "reach": second}, SimpleNamespace())

    return judged(record, kernel, MARGINS, len(split))


def test_a_branch_exists_is_absent_or_is_in_doubt():
    found = said([(1, 2)] * 3, [(1, 4), (-2, -1), (-1, 1)])
    assert found.exists.tolist() == [True, False, False]
    assert found.absent.tolist() == [False, True, False]
    assert found.merging.tolist() == [False, False, True]
    assert [(k, item.name) for k, item in found.doubts] == [(2, "reach")]
    assert found.by == {"reach": 1}


def test_what_degenerates_before_decides_nothing():
    """Where the formulas degenerate a later margin means nothing, however negative it is."""
    found = said([(-1, 1), (-2, -1)], [(-2, -1), (1, 4)])
    assert found.absent.tolist() == [False, False]
    assert found.exists.tolist() == [False, True]
    assert not found.merging[0]
    assert found.doubts[0][1].name == "split"


def test_a_root_of_a_number_that_may_be_negative_proves_nothing():
    """No margin says so, but the pose itself is not defined."""
    record = assur.load("fivebar")

    def kernel(ns):
        root = ns.sqrt(Interval.of([-1.0, 1.0], [1.0, 1.0]))
        angle = (1 + 0 * root, 0 * root)
        return Branch((root, root), (angle, angle), {}, SimpleNamespace())

    assert judged(record, kernel, (), 2).exists.tolist() == [False, True]


def test_doubts_by_one_margin_are_one():
    (doubt,) = grouped(said([(1, 2)] * 2, [(-1, 1), (-3, 0.5)]).doubts)
    assert (doubt.branches, doubt.low[0], doubt.high[0]) == (2, -3, 1)
