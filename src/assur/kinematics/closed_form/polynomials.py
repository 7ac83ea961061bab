"""Direct problems that end in polynomials: one of them, or a system."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.assemblies import assemblies
from assur.kinematics.closed_form.roots import roots_of
from assur.kinematics.closed_form.systems import solutions_of
from assur.kinematics.modes import Method
from assur.model.closed_form import Eliminant, PolynomialSystem
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]


def polynomial_solutions(
    record: MechanismRecord, kernel: Eliminant | PolynomialSystem, given: FloatArray, only: str, method: Method
) -> SolutionSet:
    """The roots of a polynomial or of a system of them.

    A single problem that the roots of one polynomial leave open goes to the loops in turn, where they do not.
    """
    if isinstance(kernel, PolynomialSystem):
        return solutions_of(record, kernel, given, only)
    if method == "auto" and given.ndim == 1 and not roots_of(record, kernel, given, "").complete:
        found = assemblies(record, "direct", given, only, "loops", crossed=False)
        if found.all_known:
            return found
    return roots_of(record, kernel, given, only)
