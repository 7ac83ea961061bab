"""Closed form of two slides that cross: nothing merges and nothing is singular."""

from types import SimpleNamespace

from assur.model.closed_form import Branch, ClosedForm


def inverse(ns, p, pose, sign):
    return Branch(pose, pose, {}, SimpleNamespace(x=pose[0], y=pose[1]))


def direct(ns, p, inputs, sign):
    return inverse(ns, p, inputs, sign)


def joints(ns, p, core):
    return {"A": core.x, "B": core.y, "C": core.y, "D": core.x}


def factors(ns, p, core):
    return {}


def jacobians(ns, p, core):
    rows = ((1, 0), (0, 1))
    return rows, rows


CLOSED_FORM = ClosedForm(
    complete_for="joint_graph",
    direct=direct,
    inverse=inverse,
    joints=joints,
    factors=factors,
    jacobians=jacobians,
    signs={},
    direct_margins=(),
    inverse_margins=(),
    factor_list=(),
)
