"""Velocity: Jp v = Jq qdot as formulas and as numbers, determinants by two routes, condition number."""

from __future__ import annotations

import math
import re

from assur.kinematics.answers import pose_at_border
from assur.model.mechanism import MechanismRecord
from assur.report.findings import Findings
from assur.report.formulas.latex import bracket, latex_mathml, name_mathml
from assur.report.formulas.mathml import APPLY, THIN, TIMES, display, equation, matrix_mathml
from assur.report.numbers import pose_angles, short
from assur.results.kinds import Formula, Formulas, Matrix, Result, Scalar, Section

JP, JQ = "<msub><mi>J</mi><mi>p</mi></msub>", "<msub><mi>J</mi><mi>q</mi></msub>"
RATES = "<mi>\U0001d45e\u0307</mi>"
"""q with a dot, as one letter: fonts place the dot of an accent anywhere."""


def velocity(found: Findings) -> Section:
    """The velocity map, its determinants, and its numbers in the configuration of this report."""
    read = found.formulas("inverse")
    form, record = found.form, found.record
    lines = [
        Formula(
            display(f"{JP}{TIMES}<mi>v</mi><mo>=</mo>{JQ}{TIMES}{RATES}", "Jp v = Jq qdot"),
            meaning="v: rates of the pose’s coordinates; q̇: rates of the inputs",
        ),
        Formula(equation(JP, matrix_mathml(read.jp))),
        Formula(equation(JQ, matrix_mathml(read.jq))),
        _determinant(found, JP, "parallel"),
        _determinant(found, JQ, "serial"),
    ]
    said = (
        "The velocity equation of the closed form. Both determinants are products of factors, each of which vanishes "
        "in one geometric situation; the next section says which."
    )
    if form.as_printed is not None:
        said += (
            " The source prints the same equation divided by factors that can vanish; the form here is regular "
            "wherever the pose exists, and the printed one stands beside it in the Python interface."
        )
    results: list[Result | Section] = [Formulas("Velocity equation", tuple(lines)), _here(found, record)]
    return Section("Velocity", said, results)


def _determinant(found: Findings, matrix: str, kind: str) -> Formula:
    """A determinant as the product of the factors of one kind, as the closed form claims."""
    factors = [
        latex_mathml(item.latex) if item.latex else name_mathml(item.name)
        for item in found.form.factor_list
        if item.kind == kind
    ]
    written = [f"<mrow>{bracket('(')}{item}{bracket(')')}</mrow>" if _is_sum(item) else item for item in factors]
    left = f"<mrow><mi>det</mi>{APPLY}{matrix}</mrow>"
    return Formula(equation(left, f"{TIMES}{THIN}".join(written)), meaning=f"{kind} singularities")


def _is_sum(mathml: str) -> bool:
    """Whether a plus or minus stands outside all brackets."""
    outside = re.sub(r">\(<.*>\)<", "><", mathml)
    return ">−<" in outside or ">+<" in outside


def _here(found: Findings, record: MechanismRecord) -> Section:
    here, solution, style = found.velocity, found.solution, found.style
    pose = ", ".join(
        f"{name} = {style.written(float(value), angle=angle)}"
        for name, value, angle in zip(
            record.platform.pose, pose_at_border(record, solution.pose), pose_angles(record), strict=True
        )
    )
    said = f"In the configuration of this report, {pose}, working mode {solution.working_mode}:"
    rates = tuple(f"d{name}/dt" for name in record.platform.pose)
    inputs = tuple(f"d{item.name}/dt" for item in record.inputs)
    products = {
        kind: math.prod(solution.factors[item.name] for item in found.form.factor_list if item.kind == kind)
        for kind in ("parallel", "serial")
    }
    matrices = [Matrix("Jp", here.jp, (), rates), Matrix("Jq", here.jq, (), inputs)]
    if not here.singular_output:
        matrices.append(Matrix("J = Jp⁻¹ Jq", here.matrix, rates, inputs))
    condition = float(here.condition)
    scalars = [
        Scalar("det Jp", float(here.det_jp), "", f"product of its factors: {short(products['parallel'])}"),
        Scalar("det Jq", float(here.det_jq), "", f"product of its factors: {short(products['serial'])}"),
        Scalar("condition number", condition if math.isfinite(condition) else None, "", "2-norm of Jp⁻¹ Jq"),
    ]
    return Section("In numbers", said, [*matrices, *scalars])
