"""Mechanisms as edges of twists, each at a random configuration, parallelograms as one joint."""

import dataclasses

import numpy as np

from twist_chains import X, Y, Z, across, ball, chain, slide, turn, turns

AROUND = [np.array([np.cos(a), np.sin(a), 0.0]) for a in (0.0, 2.1, 4.2)]


def driven(name, start, end, joints, actuated=(0,)):
    """A chain whose first joint is driven, where nothing else is said."""
    return chain(name, start, end, joints, actuated)


def limbs(joints, actuated=0):
    """Limbs between base and platform."""
    return [edge for i, item in enumerate(joints) for edge in driven(f"L{i + 1}", "base", "p", item, (actuated,))]


def zeng(rng):
    """The mechanism of the paper, parallelograms as one joint each."""
    first = driven("A", "base", "m", [[slide(Y)], *turns(rng, X, 2)])
    second = driven("B", "base", "m", [[slide(Y)], *turns(rng, X, 2)])
    outer = driven("C", "m", "p", turns(rng, Y, 2), ())
    other = driven("D", "base", "p", [[slide(Y)], [slide(across(rng, X))], [slide(across(rng, Y))]])
    return first + second + outer + other


def zeng_with_one_five_dof_limb(rng):
    loop = [turn(X, rng.normal(size=3)), slide(Y), slide(Z)]
    (inner,) = driven("A", "base", "m", [loop])
    rest = [edge for edge in zeng(rng) if edge.name[0] in "CD"]
    return [dataclasses.replace(inner, inputs=(1, 2)), *rest]


def delta_4r(rng):
    return limbs([[*turns(rng, u, 2), [slide(rng.normal(size=3))], *turns(rng, u, 1)] for u in AROUND])


def parallelogram_4s(rng, short):
    rod = rng.normal(size=3)
    point = rng.normal(size=3)
    return [slide(across(rng, rod)), slide(across(rng, rod)), turn(short, point), turn(rod, point)]


def delta_4s(rng):
    return limbs([[*turns(rng, u, 1), parallelogram_4s(rng, u)] for u in AROUND])


def linear_delta_4s(rng):
    return limbs([[[slide(Z)], parallelogram_4s(rng, u)] for u in AROUND])


def orthoglide(rng):
    return limbs([[[slide(u)], *turns(rng, u, 1), [slide(rng.normal(size=3))], *turns(rng, u, 1)] for u in (X, Y, Z)])


def upu(rng):
    found = []
    for u in AROUND:
        leg = np.array(rng.normal(size=3))
        low = rng.normal(size=3)
        w = np.cross(u, leg)
        found.append([[slide(leg)], [turn(u, low), turn(w, low)], [turn(w, low + leg), turn(u, low + leg)]])
    return limbs(found)


def tripteron(rng):
    return limbs([[[slide(u)], *turns(rng, u, 3)] for u in (X, Y, Z)])


def crr(rng):
    return limbs([[[slide(u), turn(u, rng.normal(size=3))], *turns(rng, u, 2)] for u in AROUND])


def rrc(rng):
    return limbs([[*turns(rng, u, 2), [turn(u, rng.normal(size=3)), slide(u)]] for u in AROUND])


def planar_rrr(rng):
    return limbs([turns(rng, Z, 3) for _ in range(3)])


def planar_rpr(rng):
    return limbs([[*turns(rng, Z, 1), [slide(across(rng, Z))], *turns(rng, Z, 1)] for _ in range(3)], actuated=1)


def five_bar(rng):
    return driven("A", "base", "p", turns(rng, Z, 3)) + driven("B", "base", "p", turns(rng, Z, 2))


def rps(rng):
    found = []
    for u in AROUND:
        leg = across(rng, u)
        low = rng.normal(size=3)
        found.append([[turn(u, low)], [slide(leg)], ball(low + leg)])
    return limbs(found, actuated=1)


def ups_limb(rng, low_ball=False):
    low, high = rng.normal(size=3), rng.normal(size=3)
    u = rng.normal(size=3)
    first = ball(low) if low_ball else [turn(u, low), turn(across(rng, u), low)]
    return [first, [slide(high - low)], ball(high)]


def gough(rng):
    return limbs([ups_limb(rng) for _ in range(6)], actuated=1)


def gough_sps(rng):
    return limbs([ups_limb(rng, low_ball=True) for _ in range(6)], actuated=1)


def tricept(rng):
    limb = driven("L4", "base", "p", [[turn(X, Z), turn(Y, Z)], [slide(Z)]], ())
    return limbs([ups_limb(rng) for _ in range(3)], actuated=1) + limb


def h4(rng):
    def arm(name, end, u):
        return driven(name, "base", end, [*turns(rng, u, 1), parallelogram_4s(rng, u)])

    arms = arm("A", "bar1", X) + arm("B", "bar1", Y) + arm("C", "bar2", X) + arm("D", "bar2", Y)
    return [
        *arms,
        *driven("E", "bar1", "p", turns(rng, Z, 1), ()),
        *driven("F", "bar2", "p", turns(rng, Z, 1), ()),
    ]
