"""Solutions that were found on the joint graph itself, by a search or loop by loop: no closed form is asked."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.answers.self_motion import SelfMotionCurve
from assur.kinematics.answers.solution import Failure
from assur.kinematics.answers.solution_set import SolutionSet
from assur.kinematics.border import inputs_of
from assur.kinematics.loops.parallelograms import crossed_parallelograms, parallelograms
from assur.kinematics.modes import TURNED, Problem, is_of_mode, lettered, mode_texts
from assur.kinematics.naming import sign_meanings, signs_at
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.finite_motion import status_of
from assur.kinematics.rates.instantaneous import Instant, instantaneous
from assur.kinematics.status import FACTOR_TOLERANCE, Status
from assur.kinematics.still import turned_platform
from assur.model.mechanism import MechanismRecord

if TYPE_CHECKING:
    from assur.kinematics.limbs.solving import LimbSolutions

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, eq=False, repr=False)
class JointGraphSolutions(SolutionSet):
    """Solutions that are nothing but assemblies of the joint graph.

    Attributes:
        assemblies: (..., K, coordinates) joint values, NaN where a problem has fewer than K.
        all_known: whether these are known to be all of the `model`, by what `reason` says.
        nearest: (...) the smallest gap that a problem without solution could be brought to, in length units.
        only: the mode to which the answer is narrowed; empty for all of them.
        limbs: of one pose whose assemblies are all choices of one way a limb, these ways; else empty.

    Example: six legs, each ahead or behind.

    >>> from assur.kinematics.position import inverse
    >>> from assur.model.registry import load_record
    >>> mine = inverse(load_record("planar_3rrr"), [0.0, 0.0, 0.0], method="loops")
    >>> len(mine), [len(limb.values) for limb in mine.limbs]
    (8, [2, 2, 2])
    """

    record: MechanismRecord
    problem: Problem
    given: FloatArray
    assemblies: FloatArray
    all_known: bool
    model: Literal["joint_graph", "reduced"]
    reason: str
    nearest: FloatArray
    only: str = ""
    limbs: tuple[LimbSolutions, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether these are known to be all assemblies."""
        return self.all_known and not self.only

    @property
    def complete_for(self) -> str:
        """The model: "reduced" where assemblies with crossed parallelograms are left out."""
        return self.model

    @property
    def right(self) -> str:
        """By what right the answer is complete, or why it is not known to be."""
        return self.reason

    @cached_property
    def exists(self) -> BoolArray:
        """Whether a row (..., K) is an assembly, of the mode that was asked for."""
        return self._there & is_of_mode(self.labels, self.only) if self.only else self._there

    @property
    def joints(self) -> FloatArray:
        """Every joint's value (..., K, coordinates), in rad or length."""
        return self.assemblies

    @cached_property
    def poses(self) -> FloatArray:
        """Poses (..., K, m), read off the platform."""
        return self._of_joints(partial(pose_of, self.record))

    @cached_property
    def inputs(self) -> FloatArray:
        """Printed inputs (..., K, n), read off the actuated joints."""
        return self._of_joints(partial(inputs_of, self.record))

    @cached_property
    def factors(self) -> dict[str, FloatArray]:
        """How far each solution (..., K) is from being singular: the measures of `Instant`, 0 where it is."""
        measures = self._instant.measures
        return {name: self._spread(value) for name, value in measures.items()}

    @cached_property
    def status(self) -> NDArray[np.int8]:
        """`Status` (..., K) of every row, from the joint graph's Jacobians."""
        found = status_of(self.record, self.assemblies[self._there], self._instant)
        status = np.where(self._there, np.nan_to_num(self._spread(found)), Status.unreachable)
        return self._closed(status.astype(np.int8))

    @cached_property
    def overall_status(self) -> NDArray[np.int8]:
        """`Status` (...) of the answer: the most severe among the listed solutions; undecided where none was found.

        Only where all are known is a problem without solution `unreachable`: a search proves nothing.
        """
        listed = np.where(self.exists, self.status, -1).max(axis=-1, initial=-1)
        nothing = Status.unreachable if self.all_known else Status.undecided
        return np.asarray(np.where(listed >= 0, listed, nothing), dtype=np.int8)

    @cached_property
    def labels(self) -> NDArray[np.str_]:
        """Text (..., K) of the mode: signs, and a letter where several solutions of a problem share them."""
        return lettered(np.char.add(mode_texts(self._signs(self.problem)), self._after_tilde), self._there)

    @cached_property
    def other_labels(self) -> NDArray[np.str_]:
        """Text (..., K) of the other problem's mode, by signs alone."""
        return mode_texts(self._signs("inverse" if self.problem == "direct" else "direct"))

    @property
    def named_quantities(self) -> Mapping[str, FloatArray]:
        """None: the file's letters are joint values."""
        return {}

    @property
    def curves(self) -> tuple[SelfMotionCurve, ...]:
        """None is described: a search meets single assemblies."""
        return ()

    @property
    def failures(self) -> tuple[Failure, ...]:
        """Where nothing was found (a batch of one), the gap that could not be closed."""
        self._only_one()
        if np.any(self._there) or not np.isfinite(self.nearest):
            return ()
        meaning = "the gap that the loops keep at the closest approach that was found"
        return (Failure("gap", -float(self.nearest), 1, meaning, 1),)

    @cached_property
    def _there(self) -> BoolArray:
        return np.asarray(np.all(np.isfinite(self.assemblies), axis=-1))

    @cached_property
    def _after_tilde(self) -> NDArray[np.str_]:
        """What follows a tilde (..., K): names of parallelograms that are crossed, and a platform that is turned."""
        texts = np.zeros(self._there.shape, dtype=object)
        texts[...] = ""
        own = self.assemblies[self._there]
        if parallelograms(self.record):
            texts[self._there] = [
                "".join(f"~{name}" for name in crossed_parallelograms(self.record, row)) for row in own
            ]
        if len(own):
            texts[self._there] += np.where(turned_platform(self.record, own), f"~{TURNED}", "").astype(object)
        return texts.astype(np.str_)

    def _signs(self, problem: Problem) -> NDArray[np.int8]:
        """Signs (..., K, s) of the quantities that name modes; 0 where one vanishes."""
        signs = np.zeros((*self._there.shape, len(sign_meanings(self.record, problem))), dtype=np.int8)
        signs[self._there] = signs_at(self.record, problem, self.assemblies[self._there], FACTOR_TOLERANCE)
        return signs

    @cached_property
    def _instant(self) -> Instant:
        """First-order motion of every assembly, one after another."""
        return instantaneous(self.record, self.assemblies[self._there])

    def _spread(self, values: NDArray[Any]) -> FloatArray:
        """Numbers of the assemblies, one after another, as (..., K); NaN elsewhere."""
        answer = np.full(self._there.shape, np.nan)
        answer[self._there] = values
        return answer

    def _of_joints(self, function: Callable[[FloatArray], FloatArray]) -> FloatArray:
        """A function (N, coordinates) -> (N, k) at every assembly, as (..., K, k); NaN elsewhere."""
        found = function(self.assemblies[self._there])
        answer = np.full((*self._there.shape, found.shape[-1]), np.nan)
        answer[self._there] = found
        return answer
