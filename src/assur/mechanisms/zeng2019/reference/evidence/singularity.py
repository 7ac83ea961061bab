"""Evidence on Eqs. (22)-(26) and the singularities: E7, E8, E9, E14, E16."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from types import SimpleNamespace

import numpy as np
import sympy

from assur.audit.configurations import (
    configurations,
    freedoms_with_inputs_locked,
    null_space,
    random_poses,
    scaled_closure,
)
from assur.audit.equations import rates_of
from assur.audit.rows import Evidence
from assur.joint_graph.geometry import joint_scales
from assur.joint_graph.points import quantity
from assur.kinematics.closure import mobility
from assur.kinematics.modes import all_modes
from assur.kinematics.position import inverse
from assur.kinematics.rates.velocity import printed_velocity_map, velocity_map
from assur.kinematics.status import FACTOR_TOLERANCE
from assur.numerics.number_types import Symbols
from assur.singularity.examples import singular_examples
from assur.singularity.verdict import verdict

CLOSE = 1e-9
LARGE = 1e6
LOOSE = 1e-5
"""Singular values at a configuration that is singular to rounding: half the digits of the radicand are left."""


def flat_parallelogram(record):
    """E7: det Jp vanishes on w = 0 and on v = 0 too, and at v = 0 the three rows are dependent as in case (ii)."""
    core = _core_symbols()
    jp, _ = record.closed_form.as_printed(Symbols(), SimpleNamespace(), core)
    cot_alpha, cot_beta = core.cos_alpha / core.sin_alpha, core.cos_beta / core.sin_beta
    product = -(core.u1 - core.u2) * core.w * core.v * (cot_alpha - cot_beta)
    identity = sympy.simplify(sympy.Matrix(jp).det() - product) == 0
    mode = record.modes.default_working
    flat, level = (_on_surface(record, name, mode) for name in ("v", "w"))
    if not flat or not level:
        return Evidence(False, "v = 0 or w = 0 does not cross the search box.")
    locked = [freedoms_with_inputs_locked(record, joints, LOOSE) for _, joints in (*flat[:5], *level[:5])]
    pose = flat[0][0]
    rows = printed_velocity_map(record, pose, mode).jp
    combination, *_ = np.linalg.lstsq(rows[[0, 2]].T, rows[1], rcond=None)
    gap = float(np.max(np.abs(combination @ rows[[0, 2]] - rows[1])))
    size = float(np.max(np.abs(rows)))
    return Evidence(
        bool(identity and min(locked) >= 1 and gap < CLOSE * size and min(abs(combination)) > 1e-3),
        "det Jp = -(u1 - u2) w v (cot α - cot β) (SymPy, exactly). Both v = 0 (parallelogram ① flat) and "
        f"w = 0 (links 9 and 10 along Y) cross the search box in mode {mode}, and there the joint graph "
        f"moves with every input locked. At ({_numbers(pose)}), v = 0, e2 = k1 e1 + k2 e3 with k1 = "
        f"{combination[0]:.4f} and k2 = {combination[1]:.4f}: the case that the paper excludes.",
        {"pose": pose, "k": combination},
    )


def one_collinear_set(record):
    """E16: u1^2 = u2^2 always, so u1 = 0 and u2 = 0 come together, with det Jp = 0 and a lower rank."""
    joints = configurations(record).values
    u1, u2 = (quantity(record, record.modes.working[name], joints) for name in ("u1", "u2"))
    length = record.values.l2
    gap = float(np.max(np.abs(u1 * u1 - u2 * u2))) / length**2
    examples = [example for example in _all_examples(record) if example.factor.name in ("u1", "u2")]
    verdicts = [verdict(record, example.pose, example.mode) for example in examples]
    together = all(max(abs(item.relative[name]) for name in ("u1", "u2")) <= FACTOR_TOLERANCE for item in verdicts)
    dependent = all(
        item.reduced_kind == "comprehensive" and (item.rank or 0) < (item.generic_rank or 0) for item in verdicts
    )
    return Evidence(
        len(verdicts) == 2 and gap < CLOSE and together and dependent,
        f"On {len(joints)} random configurations of the joint graph |u1² - u2²| stays below {CLOSE:g} l2². At the "
        f"examples of u1 = 0 and of u2 = 0 both vanish, det Jp and det Jq are zero together, and the rank of the "
        f"closure is {verdicts[0].rank} instead of {verdicts[0].generic_rank}.",
        {"gap": gap, "ranks": tuple(item.rank for item in verdicts)},
    )


def parallel_links(record):
    """E8: D1D2 and D3E3 are parallel in a whole plane of x where sin(alpha) sin(beta) < 0, never where it is > 0."""
    exact = {name: Fraction(repr(value)) for name, value in vars(record.values).items()}
    width, l4, l6 = exact["b"] - exact["d"], exact["l4"], exact["l6"]
    plane = -width * (l6 - l4) / (l6 + l4)  # cos(alpha) = -cos(beta)
    elsewhere = -width * (l6 + l4) / (l6 - l4)  # cos(alpha) = cos(beta)
    low, high = max(-l4 - width, width - l6), min(l4 - width, width + l6)
    poses = random_poses(record, 4000, np.random.default_rng(0))
    poses[:, 0] = float(plane)
    found = inverse(record, poses)
    signs = np.array([list(mode) for mode in all_modes(record, "inverse")])
    opposite, turned = signs[:, 0] != signs[:, 1], signs[:, 2] != signs[:, 3]
    there = found.exists & opposite & turned
    largest = float(np.max(np.abs(found.factors["sin_alpha_minus_beta"][there])))
    heights = poses[np.any(there, axis=1), 2]
    chosen = list(zip(*np.nonzero(there), strict=True))[:: max(1, int(np.sum(there)) // 8)]
    locked = [freedoms_with_inputs_locked(record, found.joints[index]) for index in chosen]
    # between the ends sin(alpha - beta) has one sign where sin(alpha) sin(beta) > 0
    grid = np.linspace(float(low), float(high), 2001)[1:-1]
    ca, cb = (grid + float(width)) / float(l4), (grid - float(width)) / float(l6)
    least = float(np.min(np.abs(np.sqrt(1 - ca**2) * cb - ca * np.sqrt(1 - cb**2))))
    box = record.box["z"]
    boxed = int(np.sum((heights >= box[0]) & (heights <= box[1])))
    return Evidence(
        largest < CLOSE and min(locked) >= 1 and not low <= elsewhere <= high and least > 1e-3,
        f"At x = -(b - d)(l6 - l4)/(l6 + l4) = {float(plane):.4f} {record.unit} |sin(α - β)| stays below "
        f"{CLOSE:g} at every random pose that a mode with sin α sin β < 0 reaches, and the joint graph "
        f"moves with every input locked ({boxed or 'none'} of these poses {'lie' if boxed else 'lies'} "
        f"between the z of the search box). For sin α sin β > 0 it would take x = {float(elsewhere):.4f}, "
        f"and only {float(low):g} to {float(high):g} is reached; there |sin(α - β)| is at least "
        f"{least:.3f} on a grid.",
        {"plane": float(plane), "elsewhere": float(elsewhere)},
    )


def regular_form(record):
    """E9: the printed Jacobians are right but divide by sin(alpha), sin(beta); the regular form and its factors."""
    form, core = record.closed_form, _core_symbols()
    jp, jq = (sympy.Matrix(rows) for rows in form.jacobians(Symbols(), SimpleNamespace(), core))
    printed_p, printed_q = (sympy.Matrix(rows) for rows in form.as_printed(Symbols(), SimpleNamespace(), core))
    rows = sympy.Matrix([[1, -1, 0], [core.sin_alpha, 0, 0], [0, 0, core.sin_beta]])
    sine = core.sin_alpha * core.cos_beta - core.cos_alpha * core.sin_beta
    identities = [
        rows * printed_p - jp,
        rows * printed_q - jq,
        sympy.Matrix([jp.det() - (core.u1 - core.u2) * core.w * core.v * sine]),
        sympy.Matrix([jq.det() - core.u1 * core.u2 * core.u3 * core.sin_alpha * core.sin_beta]),
    ]
    exact = all(sympy.simplify(matrix).is_zero_matrix for matrix in identities)
    here = configurations(record).values
    regular = all(_kind(record, values, 1e-7) == (False, False) for values in here[:20])
    general = int(mobility(record, here[0]).rank)
    judged, agree = [], True
    for example in _all_examples(record):
        if int(mobility(record, example.joints, threshold=LOOSE).rank) == general:
            moves, stands = _kind(record, example.joints, LOOSE)
            judged.append(example.factor.name)
            agree &= moves if example.factor.kind == "parallel" else stands
    edge = next(item for item in _all_examples(record) if item.factor.name == "sin_alpha")
    printed_size = np.max(np.abs(printed_velocity_map(record, edge.pose, edge.mode).jp))
    size = np.max(np.abs(velocity_map(record, edge.pose, edge.mode).jp))
    finite = size < LARGE and (not np.isfinite(printed_size) or printed_size > LARGE)
    expected = {"w", "u1_minus_u2", "u3", "sin_alpha"}
    return Evidence(
        bool(exact and regular and agree and finite and expected <= set(judged)),
        "(row 1 - row 2, sin α row 1, sin β row 3) of the printed Jp and Jq is the regular form, with "
        "det Jp = (u1 - u2) w v sin(α - β) and det Jq = u1 u2 u3 sin α sin β (SymPy, exactly). By the "
        "null space of the joint graph 20 random configurations are neither parallel nor serial, and "
        f"examples at which {', '.join(judged)} vanish (those at which the closure keeps its rank) are "
        "what the factor says; at sin α = 0 the platform loses a freedom although no u_i vanishes. There "
        f"the printed Jp has entries beyond {LARGE:g}, the regular one has not.",
        {"judged": judged},
    )


def constraint_rank(record):
    """E14: flat parallelograms and u1 = u2 = 0 lower the rank of the whole closure; w = 0 and u1 = u2 do not."""
    general = set(np.atleast_1d(mobility(record, configurations(record).values).rank).tolist())
    found = {
        "v = 0": _ranks(record, [joints for _, joints in _on_surface(record, "v", record.modes.default_working)[:5]]),
        "sin β = 0": _ranks(record, _examples(record, "sin_beta")),
        "u1 = u2 = 0": _ranks(record, _examples(record, "u1")),
        "w = 0": _ranks(record, [joints for _, joints in _on_surface(record, "w", record.modes.default_working)[:5]]),
        "u1 = u2 ≠ 0": _ranks(record, _self_motion(record)),
    }
    rank = min(general)
    lower = ("v = 0", "sin β = 0", "u1 = u2 = 0")
    expected = all(ranks == ({rank - 1} if name in lower else {rank}) for name, ranks in found.items())
    listed = ", ".join(f"{'/'.join(map(str, sorted(ranks)))} at {name}" for name, ranks in found.items())
    return Evidence(
        len(general) == 1 and expected,
        f"Rank of the closure of the joint graph: {rank} on {len(configurations(record).values)} random "
        f"configurations, {listed}.",
        {"general": rank, **{name: sorted(ranks) for name, ranks in found.items()}},
    )


def _core_symbols():
    """Letters of the kernel, with sin and cos on the unit circle."""
    alpha, beta = sympy.symbols("alpha beta")
    names = ("x", "y", "z", "u1", "u2", "u3", "w", "v")
    return SimpleNamespace(
        **{name: sympy.Symbol(name) for name in names},
        cos_alpha=sympy.cos(alpha),
        sin_alpha=sympy.sin(alpha),
        cos_beta=sympy.cos(beta),
        sin_beta=sympy.sin(beta),
    )


def _on_surface(record, name, mode):
    """(pose, joint values) in the search box at which a height over the B's (w or v) is zero: z less that height."""
    low, high = np.array([record.box[axis] for axis in record.platform.pose]).T
    poses = np.random.default_rng(0).uniform(low, high, size=(400, len(low)))
    found = inverse(record, poses, mode)
    poses[:, 2] -= np.where(found.exists[:, 0], found.factors[name][:, 0], np.inf)
    poses = poses[(poses[:, 2] >= low[2]) & (poses[:, 2] <= high[2])]
    moved = inverse(record, poses, mode)
    kept = moved.exists[:, 0]
    return list(zip(poses[kept], moved.joints[kept, 0], strict=True))


@lru_cache(maxsize=4)
def _all_examples(record):
    """One example for each factor of the determinants that vanishes in the search box."""
    return singular_examples(record)


def _examples(record, factor):
    """Joint values at which a factor of det Jq vanishes."""
    return [item.joints for item in _all_examples(record) if item.factor.name == factor]


def _self_motion(record):
    """Joint values in the working modes with sign u1 = sign u2, away from every other singularity."""
    pose = np.median([pose for pose, _ in _on_surface(record, "w", record.modes.default_working)], axis=0)
    modes = [mode for mode in all_modes(record, "inverse") if mode[2] == mode[3]]
    found = [inverse(record, pose + np.array([0.0, 0.0, 40.0]), mode) for mode in modes]
    return [item.joints[0] for item in found if item.exists[0]]


def _ranks(record, configurations_found):
    return {int(mobility(record, joints, threshold=LOOSE).rank) for joints in configurations_found}


def _kind(record, values, threshold):
    """(moves with every input locked, stands while an input is driven), by the null space of the joint graph."""
    basis = null_space(scaled_closure(record, values), threshold) * joint_scales(record)[:, None]
    inputs = basis[list(record.input_indices)]
    platform = np.array([rates_of(record, ("O'.x", "O'.y", "O'.z"), values, direction) for direction in basis.T]).T
    return tuple(
        bool(np.linalg.svd(m, compute_uv=False)[-1] < threshold * np.max(np.abs(m))) for m in (inputs, platform)
    )


def _numbers(pose):
    return ", ".join(f"{value:.4f}" for value in pose)
