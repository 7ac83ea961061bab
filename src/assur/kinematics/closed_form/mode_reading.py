"""A reading of a working mode: what its inverse kernel says at poses, each column worked out once and when asked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from assur.kinematics import border
from assur.kinematics.modes import mode_kernel_signs
from assur.kinematics.status import closed_form_of, exists, relative_factors
from assur.model.closed_form import Branch
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.mechanism import MechanismRecord
from assur.numerics.number_types import Floats


@dataclass(frozen=True, eq=False)
class ModeReading:
    """What the kernel of a closed form says at poses, over one number type; nothing of it is read twice.

    Attributes:
        record: the mechanism.
        ns: the number type.
        branch: the kernel's numbers at the poses, which broadcast against one another.
    """

    record: MechanismRecord
    ns: Any
    branch: Branch

    @property
    def margins(self) -> Mapping[str, Any]:
        """Margins by name."""
        margins: Mapping[str, Any] = self.branch.margins
        return margins

    @cached_property
    def factors(self) -> Mapping[str, Any]:
        """Factors of det Jp and det Jq by name."""
        found: Mapping[str, Any] = self._of_core("factors")
        return found

    @cached_property
    def relative_factors(self) -> Mapping[str, Any]:
        """The same divided by their scales: numbers of order one."""
        return relative_factors(self.record, self.factors)

    @cached_property
    def joints(self) -> Mapping[str, Any]:
        """Joint values by joint or joint.component, as the kernel has them: an angle as (cosine, sine)."""
        found: Mapping[str, Any] = self._of_core("joints")
        return found

    @cached_property
    def jacobians(self) -> tuple[Any, Any]:
        """Rows of Jp and of Jq, of the joint values that are inputs."""
        found: tuple[Any, Any] = self._of_core("jacobians")
        return found

    @cached_property
    def exists(self) -> NDArray[np.bool_]:
        """Whether the mode reaches a pose: no margin forbids it."""
        return exists(self.record, closed_form_of(self.record).inverse_margins, self.margins)

    def _of_core(self, kernel: str) -> Any:
        form = closed_form_of(self.record)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            return getattr(form, kernel)(self.ns, kernel_dimensions(self.record), self.branch.core)


def mode_reading(record: MechanismRecord, mode: str | None, components: tuple[Any, ...], ns: Any = None) -> ModeReading:
    """The working mode (the file's default where none is given) at poses, as components that broadcast.

    Args:
        record: a mechanism with a closed form.
        mode: signs of the working mode.
        components: the pose as kernels take it: numbers, angles as (cosine, sine).
        ns: the number type; floats where none is given.

    >>> from assur.model.registry import load_record
    >>> here = mode_reading(load_record("fivebar"), "-+", (np.array([0.0, 900.0]), np.array(200.0)))
    >>> list(here.margins), here.exists
    (['distance1', 'distance2', 'reach1', 'reach2'], array([ True, False]))
    """
    signs = mode_kernel_signs(record, "inverse", mode)
    ns = ns or Floats()
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # where a margin degenerates; it says so
        return ModeReading(record, ns, closed_form_of(record).inverse(ns, kernel_dimensions(record), components, signs))


def mode_reading_at(record: MechanismRecord, mode: str | None, poses: ArrayLike) -> ModeReading:
    """The same in floats at poses (..., m) in lengths and rad, each number (N,) or what broadcasts to it."""
    given = border.checked_poses(record, poses)
    return mode_reading(record, mode, border.pose_components(record, given.reshape(-1, given.shape[-1])))
