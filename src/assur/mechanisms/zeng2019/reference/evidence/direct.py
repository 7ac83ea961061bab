"""Evidence on the direct problem, Eqs. (7)-(17) and Table 1: E1 to E5."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import sympy

from assur.audit.audit import reference_entry
from assur.audit.configurations import configurations, random_assemblies
from assur.audit.constraints import broken, needs
from assur.audit.decoupling import jacobians
from assur.audit.rows import Evidence
from assur.audit.tolerance import half_units
from assur.joint_graph.points import point, quantity
from assur.kinematics.closure import closure_jacobian
from assur.kinematics.position import direct
from assur.model.dimensions import with_parameters
from assur.model.formula import parse
from assur.numerics.number_types import Symbols

CLOSE = 1e-6


def false_root(record):
    """E1: Eq. (8) has the root cos(gamma) = -B/A only, and sin(gamma) of either sign."""
    l2, big_b, cosine = sympy.symbols("l2 B c")
    square = (big_b + l2 * cosine) ** 2 + l2**2 * (1 - cosine**2) - l2**2  # |B2C2|^2 - l2^2, Eqs. (7), (8)
    identity = sympy.expand(square - (2 * l2 * big_b * cosine + big_b**2)) == 0
    here = configurations(record).values
    ratio = quantity(record, parse("(P1 - l3 - P2)/(2*l2)"), here)
    cosines, sines = quantity(record, parse("cos(gamma)"), here), quantity(record, parse("sin(gamma)"), here)
    right, wrong = float(np.max(np.abs(cosines + ratio))), float(np.max(np.abs(cosines - ratio)))
    both = bool(np.min(sines) < 0 < np.max(sines))
    return Evidence(
        identity and right < CLOSE and wrong > 0.1 and both,
        "Eq. (8) with the coordinates of Eq. (7) expands to A B cos γ + B² = 0 (SymPy, exactly). On "
        f"{len(here)} random configurations of the joint graph |cos γ + B/A| stays below {CLOSE:g} while "
        f"|cos γ - B/A| reaches {wrong:.2f}, and sin γ takes both signs.",
        {"right": right, "wrong": wrong},
    )


def false_root_rows(record):
    """E2: rows 1 and 2 are what the paper's formulas give for the false root, and no assembly is near them."""
    table = reference_entry(record, "direct", "Table 1")
    inputs, halves = _values(table.given), half_units(table.given)
    assemblies = point(record, "O'", random_assemblies(record, tuple(inputs)))
    found = []
    for line in table.rows[:2]:
        row = _values(line.values)
        candidates = [(signs, as_printed(record, inputs, 1.0, *signs)) for signs in SIGNS]
        signs, pose = min(candidates, key=lambda item: np.linalg.norm(item[1] - row))
        slope = [as_printed(record, inputs + step, 1.0, *signs) - pose for step in np.diag(halves)]
        allowed = half_units(line.values) + np.sum(np.abs(slope), axis=0)
        reproduced = bool(np.all(np.abs(pose - row) <= allowed))
        length = {need.name: need for need in needs(record, row, inputs)}["B2C2"]
        away = float(np.min(np.linalg.norm(assemblies - row, axis=-1)))
        found.append((reproduced and abs(length.needed - length.actual) > 1 and away > 1, length, away))
    big_b = inputs[0] - record.values.l3 - inputs[1]
    predicted = float(np.sqrt(record.values.l2**2 + 2 * big_b**2))
    length = found[0][1]
    return Evidence(
        all(item[0] for item in found) and abs(predicted - length.needed) < 1e-2,
        "The paper's Eqs. (9)-(17) with cos γ = +B/A give rows 1 and 2 to the last printed digit. They "
        f"need |B2C2| = √(l2² + 2B²) = {predicted:.2f} {record.unit} instead of {length.actual:g}. No "
        "assembly of the joint graph that random search finds at these inputs is nearer than "
        f"{min(item[2] for item in found):.1f} {record.unit}.",
        {"predicted": predicted, "needed": [item[1].needed for item in found], "away": [item[2] for item in found]},
    )


def copied_x(record):
    """E3: row 4 has the x of row 2; with the right x it is a solution."""
    table = reference_entry(record, "direct", "Table 1")
    second, fourth = table.rows[1], table.rows[3]
    inputs, row = _values(table.given), _values(fourth.values)
    poses = [item.pose for item in direct(record, inputs)]
    nearest = min(poses, key=lambda pose: np.linalg.norm(pose[1:] - row[1:]))
    halves = (half_units(fourth.values), half_units(table.given))
    mended = np.array([nearest[0], *row[1:]])
    copied = fourth.values[0].text == second.values[0].text
    as_printed_breaks, mended_breaks = (broken(record, pose, inputs, *halves) for pose in (row, mended))
    return Evidence(
        copied and bool(as_printed_breaks) and not mended_breaks,
        f"The x of row 4 is, digit for digit, that of row 2 ({second.values[0].text}). As printed the row "
        f"{as_printed_breaks}. With x = {nearest[0]:.4f} and the printed y and z every length is right.",
        {"x": float(nearest[0])},
    )


def missing_solutions(record):
    """E4: four real solutions at the inputs of Table 1; 0, 4 or 8 in general, 2 and 6 where l7 + l8 > 0."""
    inputs = _values(reference_entry(record, "direct", "Table 1").given)
    ours = np.array([item.pose for item in direct(record, inputs)])
    printed = [as_printed(record, inputs, -1.0, *signs, side) for signs in SIGNS for side in (1, -1)]
    formulas = np.array([pose for pose in printed if np.all(np.isfinite(pose))])
    values = random_assemblies(record, tuple(inputs))
    plain = values[_uncrossed(record, values)]
    search = point(record, "O'", plain)
    same = all(_same_set(ours, other) for other in (formulas, search))
    counts = _numbers_of_solutions(record)
    longer = [with_parameters(record, l7=l7, l8=l8) for l7, l8 in ((60, 40), (250, 150))]
    others = set().union(*map(_numbers_of_solutions, longer))
    listed = "; ".join("(" + ", ".join(f"{value:.4f}" for value in pose) + ")" for pose in ours)
    return Evidence(
        same and len(ours) == 4 and counts == {0, 4, 8} and others == {0, 2, 4, 6, 8},
        f"Three routes give the same {len(ours)} poses: the closed form, the paper's own Eqs. (9)-(17) "
        "with γ = ±arccos(-B/A), and random search on the joint graph with uncrossed parallelograms: "
        f"{listed}. Over random inputs the numbers of real solutions are {_listed(counts)}; with l7 + l8 "
        f"= 100 or 400 {record.unit} they are {_listed(others)}.",
        {"poses": ours, "counts": sorted(counts), "counts_with_l7_l8": sorted(others)},
    )


def decoupling(record):
    """E5: y is the mean of yA1 and yA2; x and z do not change when all inputs move alike; not so at B = 0."""
    names = [*record.parameters, "yA1", "yA2", "yA3", "e1", "e2", "e3", "shift"]
    symbols = SimpleNamespace(**{name: sympy.Symbol(name) for name in names})
    moved = tuple(getattr(symbols, name) + symbols.shift for name in ("yA1", "yA2", "yA3"))
    pose = record.closed_form.direct(Symbols(), symbols, moved, symbols).pose
    mean = (symbols.yA1 + symbols.yA2) / 2
    exact = sympy.expand(pose[1] - symbols.shift - mean) == 0
    invariant = symbols.shift not in (pose[0].free_symbols | pose[2].free_symbols)
    here = configurations(record)
    together = np.array([1.0 if item.joint in ("P1", "P2", "P3") else 0.0 for item in record.coordinates])
    closes = float(np.max(np.abs(closure_jacobian(record, here.values) @ together)))
    off = float(np.max(np.abs(jacobians(record)[:, 1] - [0.5, 0.5, 0.0])))
    table = reference_entry(record, "inverse", "Table 2")
    curves = direct(record, _values(table.rows[0].values)).curves
    spread = max(float(np.ptp(curve.poses()[:, 1])) for curve in curves) if curves else 0.0
    return Evidence(
        exact and invariant and closes < CLOSE and off < CLOSE and spread > 1,
        "In the closed form (SymPy, exactly) y = (yA1 + yA2)/2, and x and z are unchanged when the same "
        "amount is added to all three inputs: they depend on yA1 - yA2 and (yA1 + yA2)/2 - yA3 only. "
        f"That motion of the three sliders closes the joint graph on {len(here.values)} random "
        f"configurations. At B = 0 (Table 2 row 1) y runs over {spread:.1f} {record.unit} with every "
        "input locked.",
        {"spread": spread, "closure": closes},
    )


SIGNS = ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0))
"""Signs of the roots in Eqs. (14) and (17)."""


def as_printed(record, inputs, root, t_sign, a_sign, gamma_sign=1.0):
    """A pose by Eqs. (9), (14), (17) and (10) as printed, with cos(gamma) = root B/A; NaN where a root is not real."""
    p = record.values
    y_a1, y_a2, y_a3 = inputs
    big_b = y_a1 - p.l3 - y_a2
    with np.errstate(invalid="ignore"):
        gamma = gamma_sign * np.arccos(root * big_b / (2 * p.l2))  # Eq. (9)
        y = y_a1 + p.l2 * np.cos(gamma) - p.l3 / 2
        t = -(p.l2 * np.sin(gamma) - p.l8 - p.l7) + t_sign * np.sqrt(p.l6**2 - (y - y_a3) ** 2)  # Eq. (14)
        j1, j2 = 2 * p.l4 * t, 4 * p.l4 * (p.b - p.d)
        j3 = p.l6**2 - p.l4**2 - t**2 - 4 * (p.b - p.d) ** 2
        alpha = 2 * np.arctan((j1 + a_sign * np.sqrt(j1**2 + j2**2 - j3**2)) / (j2 - j3))  # Eq. (17)
    x = -p.b + p.l4 * np.cos(alpha) + p.d  # Eq. (10)
    return np.array([x, y, p.l1 + p.l2 * np.sin(gamma) + p.l4 * np.sin(alpha)])


def _numbers_of_solutions(record):
    """Numbers of real solutions over random inputs that reach from the middle to beyond every limit."""
    p = record.values
    rng = np.random.default_rng(0)
    big_b, u3 = rng.uniform(-2.2 * p.l2, 2.2 * p.l2, 20000), rng.uniform(-1.1 * p.l6, 1.1 * p.l6, 20000)
    inputs = np.stack([big_b + p.l3, np.zeros_like(u3), (big_b + p.l3) / 2 - u3], axis=-1)
    return {int(count) for count in np.unique(np.sum(direct(record, inputs).exists, axis=-1))}


def _uncrossed(record, values):
    """Where both parallelograms are parallelograms."""
    gaps = [quantity(record, parse(formula), values) for formula in ("B3a - B3b", "D3a - D3b")]
    return np.all([np.abs(np.exp(1j * gap) - 1) < 1e-5 for gap in gaps], axis=0)


def _same_set(first, second):
    """Whether two lists of poses are the same set within a micrometre or so."""
    gaps = np.linalg.norm(first[:, None] - second[None, :], axis=-1)
    return bool(np.all(gaps.min(axis=0) < 1e-3) and np.all(gaps.min(axis=1) < 1e-3))


def _values(digits):
    return np.array([item.value for item in digits])


def _listed(numbers):
    *first, last = sorted(numbers)
    return f"{', '.join(map(str, first))} and {last}"
