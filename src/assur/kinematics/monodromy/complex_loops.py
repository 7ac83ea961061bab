"""The loops of the joint graph at complex configurations, with inputs or the pose on a complex line.

A configuration is a state (k, N): lengths, cosines and sines, quaternions, which may all be complex. Rates (N, n) of
joint coordinates change it; lengths count in characteristic lengths, a ball joint's are an angular velocity.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from assur.joint_graph.frames import frame_numbers, placed_links
from assur.joint_graph.geometry import characteristic_length, joint_scales
from assur.joint_graph.programs import program
from assur.joint_graph.state import changes_at, state_of, unit_state
from assur.joint_graph.tree import joint_graph
from assur.kinematics.closure import gaps_and_rates
from assur.kinematics.modes import Problem
from assur.kinematics.monodromy.pose_line import PoseLine
from assur.model.mechanism import MechanismRecord

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]


class NoMonodromyError(Exception):
    """A problem that is not solved on a line of complex ones; the message says why."""


@dataclass(frozen=True, eq=False)
class ComplexLoops:
    """Loops with inputs or a pose q(t): a length is q + v t, an angle q + 2 atan(v t), so that its cosine is rational.

    Attributes:
        record: the mechanism.
        problem: whether the inputs are given, or the pose.
        given: (k,) joint values of the inputs, or the pose, at t = 0.
        direction: (k,) complex v, lengths in characteristic lengths.
    """

    record: MechanismRecord
    problem: Problem
    given: FloatArray
    direction: ComplexArray

    def at(self, state: ComplexArray, t: ComplexArray) -> ComplexArray:
        """A state (k, N) with the inputs at t (N,)."""
        if self.problem == "inverse":
            return state
        values = np.zeros((len(self.record.coordinates), len(t)), dtype=complex)
        placed = self._angles[:, None], self.direction[:, None] * t, self.given[:, None]
        values[self._columns] = np.where(
            placed[0], placed[2] + 2 * np.arctan(placed[1]), placed[2] + self._units[:, None] * placed[1]
        )
        driven = state_of(self.record, values)
        answer = state.copy()
        answer[self._rows] = driven[self._rows]
        return answer

    def tangent(self, state: ComplexArray, t: ComplexArray) -> ComplexArray:
        """Rates (N, n) by t of an assembly (k, N)."""
        _, slopes, changes = self._equations(state, t)
        rates = np.zeros((len(t), len(self.record.coordinates)), dtype=complex)
        if self.problem == "direct":
            own = self.direction * np.ones((len(t), 1))
            rates[:, self._columns] = np.where(self._angles, 2 * own / (1 + (self.direction * t[:, None]) ** 2), own)
            changes = np.einsum("nij,nj->ni", slopes, rates)
        rates[:, self._free] = self._solved(slopes, -changes)
        return rates

    def step(self, state: ComplexArray, t: ComplexArray) -> ComplexArray:
        """Newton's step: rates (N, n) that close the loops, inputs or the pose as at t (N,)."""
        gaps, slopes, _ = self._equations(state, t)
        rates = np.zeros((state.shape[1], len(self.record.coordinates)), dtype=complex)
        rates[:, self._free] = self._solved(slopes, -gaps)
        return rates

    def moved(self, state: ComplexArray, at: ComplexArray, rates: ComplexArray) -> ComplexArray:
        """A state after rates (N, n), as they change it at another."""
        scaled = rates.T * self._scales[:, None]
        return unit_state(self.record, state + changes_at(self.record, at, scaled))

    def places(self, state: ComplexArray) -> ComplexArray:
        """Frames (N, m) of links, those left out that spin; lengths in characteristic lengths."""
        numbers = program(self.record, frame_numbers).at_state(self.record, state)
        blocks = numbers.reshape(len(numbers) // 12, 12, state.shape[1])[self._steady].copy()
        blocks[:, 9:] /= characteristic_length(self.record)
        return blocks.reshape(12 * len(blocks), state.shape[1]).T

    def regularity(self, state: ComplexArray) -> FloatArray:
        """Smallest over largest singular value (N,) of the equations in the free joints, at t = 0."""
        _, slopes, _ = self._equations(state, np.zeros(state.shape[1], dtype=complex))
        sizes = np.linalg.svd(slopes[:, :, self._free], compute_uv=False)
        return np.asarray(sizes[:, -1] / sizes[:, 0])

    def _solved(self, slopes: ComplexArray, right: ComplexArray) -> ComplexArray:
        matrices = self._mixture @ slopes[:, :, self._free]
        mixed = np.einsum("ij,nj->ni", self._mixture, right)
        try:
            return np.asarray(np.linalg.solve(matrices, mixed[..., None])[..., 0], dtype=complex)
        except np.linalg.LinAlgError:
            return np.full(mixed.shape, np.nan, dtype=complex)

    def _equations(self, state: ComplexArray, t: ComplexArray) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
        """Gaps (N, e) and their derivatives (N, e, n), and (N, e) by t: of loops, spins, which are held, and a pose."""
        record, loops = self.record, len(joint_graph(self.record).cut)
        count, length = len(record.coordinates), characteristic_length(self.record)
        system = program(record, gaps_and_rates)
        numbers = system.at_state(record, state)
        blocks = numbers[system.rows("gap")].reshape(loops, 12, state.shape[1])
        distance, (a, b, c) = blocks[:, :3] / length, blocks[:, 3:].reshape(loops, 3, 3, -1).swapaxes(0, 1)
        turned = 0.5 * np.stack([c[:, 1] - b[:, 2], a[:, 2] - c[:, 0], b[:, 0] - a[:, 1]], axis=1)
        gaps = np.concatenate([distance, turned], axis=1).reshape(6 * loops, state.shape[1]).T
        slopes = system.matrix("derivative", numbers, (6 * loops, count)) * self._scales
        slopes.reshape(len(slopes), loops, 6, count)[:, :, :3] /= length
        if len(self._spins):
            spins = np.broadcast_to(self._spins, (len(gaps), *self._spins.shape))
            gaps = np.pad(gaps, ((0, 0), (0, len(self._spins))))
            slopes = np.concatenate([slopes, spins], axis=1)
        changes = np.zeros_like(gaps)
        if self._pose is not None:
            off, own, rates = self._pose.conditions(state, t)
            parts = ((gaps, off), (slopes, own * self._scales), (changes, rates))
            gaps, slopes, changes = (np.concatenate(part, axis=1) for part in parts)
        return gaps, slopes, changes

    @cached_property
    def _pose(self) -> PoseLine | None:
        return PoseLine(self.record, self.given, self.direction) if self.problem == "inverse" else None

    @cached_property
    def _columns(self) -> list[int]:
        return list(self.record.input_indices) if self.problem == "direct" else []

    @cached_property
    def _free(self) -> list[int]:
        return [k for k in range(len(self.record.coordinates)) if k not in self._columns]

    @cached_property
    def _scales(self) -> FloatArray:
        return joint_scales(self.record)

    @cached_property
    def _units(self) -> FloatArray:
        return self._scales[self._columns]

    @cached_property
    def _angles(self) -> NDArray[np.bool_]:
        return np.array([self.record.coordinates[k].kind == "angle" for k in self._columns])

    @cached_property
    def _rows(self) -> NDArray[np.intp]:
        """Of the numbers of inputs in a state."""
        still = np.zeros((len(self.record.coordinates), 1))
        moved = still.copy()
        moved[self._columns] = 1.0
        return np.flatnonzero(state_of(self.record, still)[:, 0] != state_of(self.record, moved)[:, 0])

    @cached_property
    def _spins(self) -> FloatArray:
        """Rows (s, n) that hold the spin of each rod between two ball joints."""
        rng, rows = np.random.default_rng(5), []
        for link in _rods(self.record):
            row = np.zeros(len(self.record.coordinates))
            first = next(name for name, joint in self.record.joints.items() if link in (joint.parent, joint.child))
            row[joint_graph(self.record).slices[first]] = rng.normal(size=3)
            rows.append(row)
        return np.array(rows).reshape(len(rows), len(self.record.coordinates))

    @cached_property
    def _steady(self) -> list[int]:
        rods = _rods(self.record)
        return [k for k, link in enumerate(placed_links(self.record)) if k and link not in rods]

    @cached_property
    def _mixture(self) -> ComplexArray:
        """As many combinations (f, e) of the equations as there are free joints."""
        pose = len(self.given) if self.problem == "inverse" else 0
        count, free = 6 * len(joint_graph(self.record).cut) + len(self._spins) + pose, len(self._free)
        if count < free:
            raise NoMonodromyError("fewer equations than free joints")
        rng = np.random.default_rng(6)
        drawn = rng.normal(size=(count, free)) + 1j * rng.normal(size=(count, free))
        return np.asarray(np.linalg.qr(drawn)[0].T)


def _rods(record: MechanismRecord) -> list[str]:
    """Links on two ball joints and nothing else."""
    joints = {link: [own for own in record.joints.values() if link in (own.parent, own.child)] for link in record.links}
    ends = (record.base, record.platform.link)
    return [
        link
        for link, own in joints.items()
        if link not in ends and len(own) == 2 and all(joint.type.ball for joint in own)
    ]
