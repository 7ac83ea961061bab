"""A mechanism's closed form, derived from its joint graph."""

from __future__ import annotations

from dataclasses import dataclass, replace

from assur.derivation.closed_form_formulas import ClosedFormFormulas
from assur.derivation.closed_form_meanings import ClosedFormMeanings
from assur.derivation.closed_form_text import ClosedFormText
from assur.derivation.constraint_couples import coplanar_couples
from assur.derivation.mode_signs import matched_signs
from assur.derivation.printed_derivation import PrintedDerivation, printed_derivation
from assur.derivation.rank_losses import rank_losses
from assur.derivation.solution import AnalyticSolution, analytic_solution
from assur.model.mechanism import MechanismRecord


@dataclass(frozen=True, eq=False)
class Derivation:
    """Both problems of a mechanism, solved by formulas."""

    record: MechanismRecord
    direct: AnalyticSolution
    inverse: AnalyticSolution

    def closed_form(self) -> str:
        """The file `closed_form.py`. Errors: NotDerivedError."""
        signs = matched_signs(self.direct, self.inverse)
        formulas = ClosedFormFormulas(self.direct, self.inverse, signs.roots, signs.factors, signs.products)
        couples = coplanar_couples(self.inverse)
        plain = ClosedFormText(formulas, couples=couples)
        lost = rank_losses(self.record, plain.text(), tuple(couples))
        return replace(plain, meanings=ClosedFormMeanings(formulas), constraint_singular=lost).text()

    def printed(self) -> PrintedDerivation:
        """Both problems for print."""
        return printed_derivation(self.record, {"direct": self.direct, "inverse": self.inverse}, {})


def derive(record: MechanismRecord) -> Derivation:
    """The closed form of a mechanism. Errors: NotDerivedError.

    >>> from assur.model.registry import load_record
    >>> derive(load_record("fivebar")).direct.branches
    2
    """
    return Derivation(record, analytic_solution(record, "direct"), analytic_solution(record, "inverse"))
