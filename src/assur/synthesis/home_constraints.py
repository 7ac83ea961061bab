"""What a limb constrains at home: forces and couples, whose directions depend on its axes, not on where it stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.synthesis.poses import twists_at_will
from assur.synthesis.required import RequiredMotion
from assur.synthesis.shared_axes import End
from assur.topology.chains import Chain
from assur.topology.screws.edges import null_basis

FloatArray = NDArray[np.float64]

ZERO = 1e-7
"""Singular values below it are zero; directions have length one, and limbs are about so large."""

DIGITS = 6
"""Decimals to which directions are compared."""

BESIDE = np.array([0.31, -0.47, 0.83])
"""A point on the platform's line that is not on the base's: two lines that limbs share need not meet."""


@dataclass(frozen=True, eq=False)
class HomeConstraints:
    """The constraints of limbs at home.

    Attributes:
        wrenches: (n, 6) rows (moment, force), independent.
    """

    wrenches: FloatArray

    @cached_property
    def forces(self) -> FloatArray:
        """(3, f) orthonormal directions of what they can push along."""
        return _basis(self.wrenches[:, 3:]).T

    @cached_property
    def couples(self) -> FloatArray:
        """(3, c) orthonormal directions of their pure couples."""
        pure = null_basis(self.wrenches[None, :, 3:].swapaxes(-1, -2))[0]  # combinations without a force
        return _basis(pure.T @ self.wrenches[:, :3]).T

    @property
    def key(self) -> tuple[object, ...]:
        """Equal where they are as many along the same directions."""
        flat = [np.round(basis @ basis.T, DIGITS) + 0.0 for basis in (self.forces, self.couples)]
        return (len(self.wrenches), *(tuple(projector.ravel().tolist()) for projector in flat))

    def allows(self, motion: RequiredMotion) -> bool:
        """Whether they push along no translation of a motion and twist about no rotation of it."""
        slides = np.array(motion.translations).reshape(-1, 3)
        turns = np.array(motion.rotations).reshape(-1, 3)
        return bool(np.allclose(slides @ self.forces, 0.0) and np.allclose(turns @ self.couples, 0.0))

    def leave(self, motion: RequiredMotion) -> bool:
        """Whether they leave as many translations as the motion has, and as many freedoms."""
        return 6 - len(self.wrenches) == motion.dim and self._leave_translations(motion)

    def resist_turns_of(self, motion: RequiredMotion) -> bool:
        """Whether they leave as many translations as the motion has, and fewer freedoms."""
        return 6 - len(self.wrenches) < motion.dim and self._leave_translations(motion)

    def _leave_translations(self, motion: RequiredMotion) -> bool:
        pushed: int = self.forces.shape[1]
        return len(motion.translations) + pushed == 3


def constraints_of(twists: FloatArray) -> HomeConstraints:
    """What is reciprocal to twists (6, f).

    >>> gripped = np.eye(6)[:, [0, 1, 2, 3, 4]]  # all but sliding along z
    >>> constraints_of(gripped).forces.ravel().round(12).tolist() in ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])
    True
    """
    return HomeConstraints(null_basis(twists.T[None])[0].T)


def together(parts: Sequence[FloatArray]) -> HomeConstraints:
    """The constraints of several limbs, by the wrenches (n, 6) of each."""
    return HomeConstraints(_basis(np.concatenate(parts)))


def _basis(rows: FloatArray) -> FloatArray:
    """Orthonormal rows (k, m) that span the same as some rows (n, m)."""
    _, singular, turned = np.linalg.svd(rows, full_matrices=False)
    kept: FloatArray = turned[singular > ZERO]
    return kept


def home_twists(chain: Chain, turn: FloatArray, seed: int, end: End = "") -> FloatArray:
    """Twists (6, f) at home of a limb that stands anywhere.

    Args:
        chain: in its first position.
        turn: (3, 3) into its position.
        seed: of the place and the lengths of its links.
        end: where its first axis runs through the origin, or its last through the point `BESIDE`.
    """
    twists = twists_at_will(chain, np.random.default_rng(seed), 1, 0.0)[0]
    if end:
        beside = np.zeros(3) if end == "base" else BESIDE
        axes = [place for place in range(twists.shape[1]) if np.any(twists[:3, place])]
        line = twists[:, axes[0 if end == "base" else -1]]
        shift = beside - np.cross(line[:3], line[3:])  # the axis' point next to the origin comes there
        twists = np.concatenate([twists[:3], twists[3:] + np.cross(shift, twists[:3], axisb=0, axisc=0)])
    return np.concatenate([turn @ twists[:3], turn @ twists[3:]])
