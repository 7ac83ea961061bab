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
from assur.report.numbers import pose_words, short
from assur.results.kinds import FLOATING, Formula, Formulas, Matrix, Result, Scalar, Section

JP, JQ = "<msub><mi>J</mi><mi>p</mi></msub>", "<msub><mi>J</mi><mi>q</mi></msub>"
RATE = {"wx": "ωx", "wy": "ωy", "wz": "ωz"}
RATES = "<mi>\U0001d45e\u0307</mi>"
"""q with a dot, as one letter: fonts place the dot of an accent anywhere."""


NULL_SPACE = (
    "Without a closed form Jp v = Jq q̇ is what the joint rates that keep every loop closed, the null space of the "
    "closure’s Jacobian, say of the rates v of the pose and the rates q̇ of the inputs. Its rows are known up to a "
    "common orthogonal factor, so only their singular values and the sign of det Jp det Jq mean anything."
)


def velocity(found: Findings) -> Section:
    """The velocity map, its determinants, and its numbers in the configuration of this report."""
    if found.record.closed_form is None:
        return Section("Velocity", NULL_SPACE, [_here(found, found.record)])
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
    factors = [symbol_mathml(item.latex, item.name) for item in found.form.factor_list if item.kind == kind]
    written = [f"<mrow>{bracket('(')}{item}{bracket(')')}</mrow>" if _is_sum(item) else item for item in factors]
    left = f"<mrow><mi>det</mi>{APPLY}{matrix}</mrow>"
    return Formula(equation(left, f"{TIMES}{THIN}".join(written)), meaning=f"{kind} singularities")


def _is_sum(mathml: str) -> bool:
    """Whether a plus or minus stands outside all brackets."""
    outside = re.sub(r">\(<.*>\)<", "><", mathml)
    return ">−<" in outside or ">+<" in outside


def _here(found: Findings, record: MechanismRecord) -> Section:
    here, solution = found.velocity, found.solution
    pose = pose_words(record, found.style, pose_at_border(record, solution.pose).tolist())
    mode = f", working mode {solution.working_mode}" if solution.working_mode else ""
    said = f"In the configuration of this report, {pose}{mode}:"
    rates = tuple(RATE.get(name, f"d{name}/dt") for name in rate_names(record.platform.pose))
    inputs = tuple(f"d{item.name}/dt" for item in record.inputs)
    matrices = [Matrix("Jp", here.jp, (), rates), Matrix("Jq", here.jq, (), inputs)]
    if not here.singular_output:
        matrices.append(Matrix("J = Jp⁻¹ Jq", here.matrix, rates, inputs))
    condition = float(here.condition)
    scalars = [
        Scalar("det Jp", float(here.det_jp), "", FLOATING, note=_product(found, "parallel")),
        Scalar("det Jq", float(here.det_jq), "", FLOATING, note=_product(found, "serial")),
        Scalar("condition number", condition if math.isfinite(condition) else None, "", FLOATING, note=_norm(here)),
    ]
    return Section("In numbers", said, [*matrices, *scalars])


def _norm(here: VelocityMap) -> str:
    divided = (
        f"; lengths divided by the characteristic length {short(here.length)} {here.record.unit}" if here.length else ""
    )
    return f"κ(J) = s₁/sᵣ of J = Jp⁻¹ Jq in the 2-norm{divided}"


def _product(found: Findings, kind: str) -> str:
    """The second route to a determinant."""
    form = found.record.closed_form
    if form is None:
        return "up to the factor of both"
    factors = (found.solution.factors[item.name] for item in form.factor_list if item.kind == kind)
    return f"product of its factors: {short(math.prod(factors))}"
