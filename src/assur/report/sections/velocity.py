"""Velocity: Jp v = Jq qdot as formulas and as numbers, determinants by two routes, condition number."""

from __future__ import annotations

import math
import re

from assur.kinematics.answers.at_border import pose_at_border
from assur.kinematics.rates.velocity import VelocityMap
from assur.model.mechanism import MechanismRecord
from assur.model.pose import rate_names
from assur.report.findings import Findings
from assur.report.formulas.latex import bracket, symbol_mathml
from assur.report.formulas.mathml import APPLY, THIN, TIMES, display, equation, matrix_mathml
from assur.results.kinds import FLOATING, Formulas, Matrix, PrintedFormula, Result, Scalar, Section
from assur.results.typeset_text import short

JP, JQ = "<msub><mi>J</mi><mi>p</mi></msub>", "<msub><mi>J</mi><mi>q</mi></msub>"
RATE = {"wx": "ωx", "wy": "ωy", "wz": "ωz"}
RATES = "<mi>\U0001d45e\u0307</mi>"
"""q with a dot, as one letter: fonts place the dot of an accent anywhere."""


NULL_SPACE = (
    "Without a closed form Jp v = Jq q̇ is what the joint rates that keep every loop closed, the null space of the "
    "closure’s Jacobian, say of the rates v of the pose and the rates q̇ of the inputs. Its rows are known up to a "
    "common orthogonal factor, so only their singular values and the sign of det Jp det Jq mean anything."
)


def velocity(findings: Findings) -> Section:
    """The velocity map, its determinants, and its numbers in the configuration of this report."""
    if findings.record.closed_form is None:
        return Section("Velocity", NULL_SPACE, [_here(findings, findings.record)])
    read = findings.formulas("inverse")
    form, record = findings.form, findings.record
    lines = [
        PrintedFormula(
            display(f"{JP}{TIMES}<mi>v</mi><mo>=</mo>{JQ}{TIMES}{RATES}", "Jp v = Jq qdot"),
            meaning="v: rates of the pose’s coordinates; q̇: rates of the inputs",
        ),
        PrintedFormula(equation(JP, matrix_mathml(read.jp))),
        PrintedFormula(equation(JQ, matrix_mathml(read.jq))),
        _determinant(findings, JP, "parallel"),
        _determinant(findings, JQ, "serial"),
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
    results: list[Result | Section] = [Formulas("Velocity equation", tuple(lines)), _here(findings, record)]
    return Section("Velocity", said, results)


def _determinant(findings: Findings, matrix: str, kind: str) -> PrintedFormula:
    """A determinant as the product of the factors of one kind, as the closed form claims."""
    factors = [symbol_mathml(factor.latex, factor.name) for factor in findings.form.factor_list if factor.kind == kind]
    written = [
        f"<mrow>{bracket('(')}{factor}{bracket(')')}</mrow>" if _is_sum(factor) else factor for factor in factors
    ]
    left = f"<mrow><mi>det</mi>{APPLY}{matrix}</mrow>"
    return PrintedFormula(equation(left, f"{TIMES}{THIN}".join(written)), meaning=f"{kind} singularities")


def _is_sum(mathml: str) -> bool:
    """Whether a plus or minus stands outside all brackets."""
    outside = re.sub(r">\(<.*>\)<", "><", mathml)
    return ">−<" in outside or ">+<" in outside


def _here(findings: Findings, record: MechanismRecord) -> Section:
    velocity, solution = findings.velocity, findings.solution
    pose = findings.style.pose(record.platform.pose, pose_at_border(record, solution.pose).tolist())
    mode = f", working mode {solution.working_mode}" if solution.working_mode else ""
    said = f"In the configuration of this report, {pose}{mode}:"
    rates = tuple(RATE.get(name, f"d{name}/dt") for name in rate_names(record.platform.pose))
    inputs = tuple(f"d{actuated.name}/dt" for actuated in record.drives)
    matrices = [Matrix("Jp", velocity.jp, (), rates), Matrix("Jq", velocity.jq, (), inputs)]
    if not velocity.singular_output:
        matrices.append(Matrix(f"J = {_written(record)}", velocity.matrix, rates, inputs))
    condition = float(velocity.condition)
    determinants = [
        Scalar("det Jp", float(velocity.det_jp), "", FLOATING, note=_product(findings, "parallel")),
        Scalar("det Jq", float(velocity.det_jq), "", FLOATING, note=_product(findings, "serial")),
    ]
    scalars = [
        *(() if record.redundant_inputs else determinants),  # then Jp is no square
        Scalar("condition number", condition if math.isfinite(condition) else None, "", FLOATING, note=_norm(velocity)),
    ]
    return Section("In numbers", said, [*matrices, *scalars])


def _norm(velocity: VelocityMap) -> str:
    divided = (
        f"; lengths divided by the characteristic length {short(velocity.length)} {velocity.record.unit}"
        if velocity.length
        else ""
    )
    return f"κ(J) = s₁/sᵣ of J = {_written(velocity.record)} in the 2-norm{divided}"


def _written(record: MechanismRecord) -> str:
    """J in letters; with redundant inputs a pseudoinverse."""
    return "(Jq⁻¹ Jp)⁺" if record.redundant_inputs else "Jp⁻¹ Jq"


def _product(findings: Findings, kind: str) -> str:
    """The second route to a determinant."""
    form = findings.record.closed_form
    if form is None:
        return "up to the factor of both"
    factors = (findings.solution.factors[factor.name] for factor in form.factor_list if factor.kind == kind)
    return f"product of its factors: {short(math.prod(factors))}"
