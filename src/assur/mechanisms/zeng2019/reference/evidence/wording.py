"""Evidence on small print: E15."""

from __future__ import annotations

import numpy as np

from assur.audit.audit import reference_entry
from assur.audit.configurations import configurations
from assur.audit.parts import link_motion
from assur.audit.rows import Evidence
from assur.audit.tables import solve
from assur.joint_graph.points import quantity
from assur.kinematics.modes import all_modes
from assur.kinematics.position import direct
from assur.model.dimensions import with_parameters
from assur.model.formula import parse

CLOSE = 1e-6


def small_print(record):
    """E15: P3 is the parallel one; Eq. (17) divides by zero at alpha = pi; three statements that are right."""
    first, second, third = (record.joints[name] for name in ("P1", "P2", "P3"))
    coaxial = np.allclose(first.at, second.at) and np.allclose(np.cross(first.axes[0], second.axes[0]), 0)
    apart = float(np.linalg.norm(np.cross(third.at - first.at, first.axes[0])))
    parallel = np.allclose(np.cross(first.axes[0], third.axes[0]), 0) and apart > 1
    lost, reached, dimensions = _straight_angle(record)
    chain = link_motion(record, record.platform.link, record.chains["HSOC2"].serial).poc
    given = reference_entry(record, "inverse", "Table 2").given
    not_real = len(all_modes(record, "inverse")) - len(solve(record, "inverse", given))
    printed = reference_entry(record, "count", "Inverse solutions, imaginary").printed.value
    here = configurations(record).values
    fifteen = float(np.max(np.abs(quantity(record, parse("D1.y - D3.y"), here))))
    return Evidence(
        bool(coaxial and parallel)
        and lost
        and reached
        and (chain.t, chain.r, chain.dim) == (3, 0, 3)
        and not_real == printed
        and fifteen < CLOSE,
        f"P1 and P2 share one axis; P3 is parallel to it, {apart:g} {record.unit} away. With {dimensions} "
        "there are inputs with J2 = J3, where the closed form has a solution with α = π that closes the "
        "joint graph and Eq. (17) divides by zero. Right are: chain II alone has t3 r0 by the rules and by "
        f"rank of twists; {not_real} of {len(all_modes(record, 'inverse'))} inverse solutions are not real at "
        f"Table 1 row 3; Eq. (15) holds on {len(here)} random configurations within {CLOSE:g}.",
        {"apart": apart, "not_real": not_real, "fifteen": fifteen},
    )


def _straight_angle(record):
    """(Eq. (17) divides by 0, alpha = pi is a solution, dimensions) where J2 = J3; not with the printed lengths."""
    other = with_parameters(record, b=60, d=50, l4=100)
    p = other.values
    w = -np.sqrt(p.l2**2 - 50.0**2)  # B = 100
    t = np.sqrt(p.l6**2 - p.l4**2 - 4 * (p.b - p.d) ** 2 - 4 * p.l4 * (p.b - p.d))  # J3 = J2
    v = t + w - p.l7 - p.l8
    y = (100.0 + p.l3) / 2
    inputs = np.array([100.0 + p.l3, 0.0, y - np.sqrt(p.l6**2 - v**2)])
    straight = [
        item for item in direct(other, inputs) if abs(np.cos(item.joints["D1"]) + 1) < 1e-9 and item.residual < CLOSE
    ]
    if not straight:
        return False, False, ""
    numbers = straight[0].quantities
    lost = abs(numbers["J2"] - numbers["J3"]) < 1e-6 * abs(numbers["J2"])
    return bool(lost), True, f"b = {p.b:g}, d = {p.d:g}, l4 = {p.l4:g}"
