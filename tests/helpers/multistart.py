"""Assemblies by many starts of a damped Gauss-Newton method, on the verifier's joint graph: no code of the solvers."""

from dataclasses import dataclass

import numpy as np

from assur.verifier.formula import FloatNumbers
from assur.verifier.graph import Graph
from assur.verifier.mechanism import mechanism

WIDTH = {"turn": 1, "slide": 1, "screw": 1, "ball": 4}
KINDS = {
    "revolute": ("turn",),
    "prismatic": ("slide",),
    "helical": ("screw",),
    "cylindrical": ("slide", "turn"),
    "universal": ("turn", "turn"),
    "spherical": ("ball",),
    "planar": ("slide", "slide", "turn"),
}


@dataclass
class Multistart:
    """Direct problems of a file. Unknowns (N, n) are angles, lengths by `size`, and quaternions of any length."""

    text: str
    size: float

    def __post_init__(self):
        self.file = mechanism(self.text)
        self.graph = Graph(self.file, FloatNumbers(), self.file.dimensions(FloatNumbers()))
        self.columns, count = {}, 0
        for name, joint in self.file.joints.items():
            kinds = KINDS[joint.type]
            self.columns[name] = [(kind, count + sum(WIDTH[own] for own in kinds[:k])) for k, kind in enumerate(kinds)]
            count += sum(WIDTH[own] for own in kinds)
        self.count = count
        self.driven = [self.columns[name][0] for name, _ in self.file.inputs]

    def state(self, unknowns):
        """Numbers of each joint for the graph."""
        state = {}
        for name, steps in self.columns.items():
            state[name] = []
            for kind, k in steps:
                if kind == "slide":
                    state[name].append(unknowns[:, k] * self.size)
                elif kind == "ball":
                    w, x, y, z = unknowns[:, k : k + 4].T
                    norm = w * w + x * x + y * y + z * z
                    rows = (
                        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
                        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
                        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
                    )
                    state[name] += [entry / norm for row in rows for entry in row]
                else:
                    own = unknowns[:, k]
                    state[name] += [np.cos(own), np.sin(own)] + ([own] if kind == "screw" else [])
        return state

    def gaps(self, unknowns):
        """What is zero (N, m) where the loops close."""
        state = self.state(unknowns)
        frames = self.graph.frames(state)
        rows = []
        for name in self.graph.cut:
            distance, turned = self.graph.gap(name, state, frames)
            rows += [part / self.size for part in distance]
            rows += [turned[i][j] - float(i == j) for i in range(3) for j in range(3)]
        return np.stack([np.broadcast_to(row, len(unknowns)) for row in rows], axis=1)

    def platform(self, unknowns):
        """Orientation (N, 3, 3) and point (N, 3) of the platform."""
        rotation, origin = self.graph.frames(self.state(unknowns))[self.file.platform]
        turned = np.moveaxis(np.array([[np.broadcast_to(a, len(unknowns)) for a in row] for row in rotation]), -1, 0)
        place = np.stack([np.broadcast_to(part, len(unknowns)) for part in origin], axis=1)
        return turned, place + turned @ np.array([float(part) for part in self.graph.point])

    def point(self, name, unknowns):
        """Where a joint is on its parent (N, 3)."""
        rotation, origin = self.graph.frames(self.state(unknowns))[self.file.joints[name].parent]
        at = self.graph.joints[name].at
        parts = [origin[i] + sum(rotation[i][j] * at[j] for j in range(3)) for i in range(3)]
        return np.stack([np.broadcast_to(part, len(unknowns)) for part in parts], axis=1)

    def assemblies(self, inputs, starts, screws=(), steps=60):
        """Unknowns (K, n) that close the loops at inputs in rad and lengths, each as often as starts lead there.

        Screws stay within half a turn of values that are given for them: threaded elsewhere they would close too.
        """
        rng = np.random.default_rng(0)
        unknowns = rng.uniform(-np.pi, np.pi, (starts, self.count))
        for own in self.columns.values():
            for kind, k in own:
                if kind == "ball":
                    unknowns[:, k : k + 4] = rng.normal(size=(starts, 4))
                if kind == "slide":
                    unknowns[:, k] = rng.uniform(-3, 3, starts)
        threads = [k for own in self.columns.values() for kind, k in own if kind == "screw"]
        unknowns[:, threads] = np.array(screws) + rng.uniform(-1, 1, (starts, len(threads)))
        held = []
        for (kind, k), value in zip(self.driven, inputs, strict=True):
            unknowns[:, k] = value / self.size if kind == "slide" else value
            held.append(k)
        free = np.setdiff1d(np.arange(self.count), held)
        damping = np.full(starts, 1e-1)
        gaps = self.gaps(unknowns)
        error = np.sum(gaps**2, axis=1)
        for _ in range(steps):
            slopes = self._slopes(unknowns, free)
            normal = np.einsum("nki,nkj->nij", slopes, slopes) + damping[:, None, None] * np.eye(len(free))
            change = np.linalg.solve(normal, -np.einsum("nki,nk->ni", slopes, gaps)[..., None])[..., 0]
            trial = unknowns.copy()
            trial[:, free] += change
            new = self.gaps(trial)
            better = np.sum(new**2, axis=1) < error
            unknowns[better], gaps[better] = trial[better], new[better]
            error = np.sum(gaps**2, axis=1)
            damping = np.clip(np.where(better, damping / 5, damping * 4), 1e-13, 1e3)
        near = np.all(np.abs(unknowns[:, threads] - screws) < np.pi, axis=1)
        return unknowns[(error < 1e-18) & near]

    def _slopes(self, unknowns, free):
        """Derivative (N, m, f), by complex steps."""
        columns = []
        for k in free:
            moved = unknowns.astype(complex)
            moved[:, k] += 1e-30j
            columns.append(self.gaps(moved).imag / 1e-30)
        return np.stack(columns, axis=-1)
