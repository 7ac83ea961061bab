"""What the sections of one report share: each analysis is made once, and only where a section asks for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import cast

import numpy as np
from numpy.typing import NDArray

from assur.audit import audit as auditing
from assur.audit.reference import Reference
from assur.audit.rows import Audit, Row
from assur.audit.tables import PrintedTable
from assur.errors import UsageError
from assur.figures.context import Context
from assur.joint_graph.frames import frames
from assur.joint_graph.geometry import characteristic_length
from assur.joint_graph.points import point
from assur.kinematics.answers.at_border import inputs_from_border, pose_from_border
from assur.kinematics.answers.solution import Solution
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.answers.style import Style, style_of
from assur.kinematics.border import inputs_of
from assur.kinematics.certified.certify import certified_direct, certified_inverse
from assur.kinematics.certified.result import CertifiedSolutions
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem
from assur.kinematics.position import direct, inverse
from assur.kinematics.rates.velocity import VelocityMap, velocity_map, velocity_map_at
from assur.kinematics.status import closed_form_of
from assur.model.closed_form import Branch, ClosedForm, Eliminant, PolynomialSystem
from assur.report.formulas.reading import FormulaReading, reading
from assur.report.pictures import pictures
from assur.report.proofs import cube
from assur.results.attempt import attempt
from assur.results.kinds import Picture
from assur.singularity.verdict import Verdict, verdict_at
from assur.workspace.aspects.nowhere import nothing_reached, nowhere_zero
from assur.workspace.certified.largest import LargestShape

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Findings(Context):
    """A mechanism and what is found about it.

    Attributes:
        illustrated: whether figures are drawn.
    """

    illustrated: bool = True

    @cached_property
    def style(self) -> Style:
        """How numbers are written."""
        return style_of(self.record, typeset=True)

    @property
    def form(self) -> ClosedForm:
        """The closed form; `UsageError` where there is none."""
        return closed_form_of(self.record)

    @cached_property
    def home(self) -> FloatArray:
        """Joint values (n,) of the assembled home."""
        return home_values(self.record)

    # ---- the source's numbers ----------------------------------------------------------------------------------

    @cached_property
    def audit(self) -> Audit:
        """The audit; `UsageError` where there are no reference data for these dimensions."""
        return auditing.audit(self.record)

    @cached_property
    def reference(self) -> Reference | None:
        """The reference data, None where there are none for these dimensions."""
        try:
            return auditing.reference_of(self.record)
        except UsageError:
            return None

    @property
    def given(self) -> str:
        """What to call the numbers of the reference data: printed in a source, or a reference of ours."""
        return "reference" if self.reference and self.reference.about.origin == "derived" else "printed"

    @property
    def giver(self) -> str:
        """Who says these numbers."""
        return "reference data" if self.given == "reference" else "source"

    def rows(self, kind: str) -> tuple[Row, ...]:
        """Audit rows of one kind of reference entry, none without reference data."""
        if self.reference is None:
            return ()
        make = auditing.KINDS[kind].rows
        return tuple(row for entry in self.reference.entries[kind] for row in make(self.record, self.reference, entry))

    def table(self, problem: Problem) -> PrintedTable | None:
        """The source's first table of solutions of a problem."""
        entries = self.reference.entries[problem] if self.reference else ()
        return cast("PrintedTable", entries[0]) if entries else None

    # ---- position ----------------------------------------------------------------------------------------------

    def kernel(self, problem: Problem) -> Callable[..., Branch] | Eliminant | PolynomialSystem | None:
        """What answers a problem: a kernel by signs, one polynomial, a system of them, or nothing but a search."""
        form = self.record.closed_form
        return None if form is None else form.direct if problem == "direct" else form.inverse

    def formulas(self, problem: Problem) -> FormulaReading:
        """The closed form, written down."""
        return self._direct_formulas if problem == "direct" else self._inverse_formulas

    @cached_property
    def _direct_formulas(self) -> FormulaReading:
        return reading(self.record, "direct")

    @cached_property
    def _inverse_formulas(self) -> FormulaReading:
        return reading(self.record, "inverse")

    @cached_property
    def inputs(self) -> FloatArray:
        """Inputs (n,) of the configuration that the report is about: the source's, else those of home."""
        table = self.table("direct")
        if table:
            return inputs_from_border(self.record, np.array([printed.value for printed in table.given]))
        return inputs_of(self.record, self.home)

    @cached_property
    def direct(self) -> SolutionSet:
        """Every pose at these inputs."""
        return direct(self.record, self.inputs)

    @cached_property
    def solution(self) -> Solution:
        """The configuration that the report is about: of the default assembly mode, else the one nearest to home."""
        solutions = list(self.direct)
        if not solutions:
            raise UsageError(f"{self.record.name} has no real solution at the inputs that the report is about")
        of_mode = [solution for solution in solutions if solution.assembly_mode == self.record.modes.default_assembly]
        chosen = (
            of_mode[0]
            if self.table("direct") and of_mode
            else min(solutions, key=lambda solution: self._apart(solution, self.home))
        )
        if self.record.closed_form is None or self.kernel("direct") is not None:
            return chosen
        joints = np.array(list(chosen.joints.values()))  # of a search, which knows no factors
        return min(
            inverse(self.record, chosen.pose), key=lambda solution: self._apart(solution, joints), default=chosen
        )

    def _apart(self, solution: Solution, joints: FloatArray) -> float:
        """How far joints and platform of a solution are from where they are at joint values (n,); rods may spin."""
        values = np.array([list(solution.joints.values()), joints])
        placed = frames(self.record, values)
        names = (*self.record.joints, *self.record.points)
        places = np.stack([point(self.record, name, values) for name in names], axis=-2)
        turned = placed[self.record.platform.link][0] * characteristic_length(self.record)
        return float(np.linalg.norm(places[0] - places[1]) + np.linalg.norm(turned[0] - turned[1]))

    @cached_property
    def pose(self) -> FloatArray:
        """Pose (m,) of which the inverse problem is solved: the source's, else that of the configuration."""
        table = self.table("inverse")
        if table:
            return pose_from_border(self.record, np.array([printed.value for printed in table.given]))
        return self.solution.pose

    @cached_property
    def inverse(self) -> SolutionSet:
        """All inputs at this pose."""
        return inverse(self.record, self.pose)

    @cached_property
    def proved(self) -> dict[Problem, CertifiedSolutions | str]:
        """What is proved of both answers, each a certificate or why there is none."""
        return {
            "direct": attempt(lambda: certified_direct(self.record, self.inputs)),
            "inverse": attempt(lambda: certified_inverse(self.record, self.pose)),
        }

    @property
    def joints(self) -> FloatArray:
        """Joint values (n,) of the configuration that the report is about."""
        return np.array(list(self.solution.joints.values()))

    @cached_property
    def velocity(self) -> VelocityMap:
        """Jp and Jq in the configuration that the report is about: of the closed form, else of the joint graph."""
        if self.record.closed_form is None:
            return velocity_map_at(self.record, self.joints)
        return velocity_map(self.record, self.solution.pose, self.solution.working_mode)

    @cached_property
    def verdict(self) -> Verdict:
        """The verdict of the joint graph on the configuration that the report is about."""
        return verdict_at(self.record, self.joints)

    # ---- regions -----------------------------------------------------------------------------------------------

    @cached_property
    def nowhere(self) -> frozenset[str]:
        """Of the parallel factors that have no locus inside the workspace those that are proved to have none."""
        if self.workspace.volume == 0:  # of nothing everything is true
            return frozenset()
        unseen = [locus.factor for locus in self.workspace.loci if not locus.area and not locus.everywhere]
        proved = attempt(lambda: nowhere_zero(self.record, unseen)) if unseen else frozenset[str]()
        return frozenset() if isinstance(proved, str) else proved

    @cached_property
    def unreached(self) -> bool:
        """Whether it is proved that no pose of the workspace's box is reached."""
        return attempt(lambda: nothing_reached(self.record)) is True

    @cached_property
    def cube(self) -> LargestShape | str:
        """The largest cube about this configuration that is proved free of singularities, or why there is none."""
        return attempt(lambda: cube(self.record, self.solution))

    # ---- figures -----------------------------------------------------------------------------------------------

    def picture(self, *names: str) -> tuple[Picture, ...]:
        """The figures of these names, as far as the mechanism has them and figures are drawn."""
        return tuple(picture for name in names if self.illustrated for picture in pictures(self, name))
