"""Freedoms and motions of mechanisms from their notation, by finite displacement alone: an oracle apart from assur.

It shares no code with the library and none of its ideas beyond the definitions. Notation is read by a parser of its
own, joints are put in random places, the linkage walks along its configuration space from home in random directions,
and twists are derivatives of the links' poses by complex steps. Whether an instantaneous freedom is a real one is
tried: a step along it must leave the loops open by the square of its length at most.
"""

import re
from collections import Counter
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

CLOSED = 1e-11
"""Rotation and gap below which loops are closed; links are about 1 long."""

ZERO = 1e-6
"""Share of the largest singular value that counts as zero."""

NAMED = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}

# ---- notation -------------------------------------------------------------------------------------------------


def read(text):
    """A chain as a list of (letter, axes, label), (\"4R\", axis, None) and branches.

    A label is a name and the axis that runs through that point, None where the point is the centre.
    """
    tokens = re.findall(r"P\(4R\)\[[^\]]*\]|[RPHCU]\[[^\]]*\](?:@[A-Z])?|S(?:@[A-Z])?|[{}|]", text)
    assert "".join(tokens).replace(" ", "") == text.replace(" ", ""), text
    return _series(tokens)


def _series(tokens):
    elements = []
    while tokens and tokens[0] not in "|}":
        token = tokens.pop(0)
        if token == "{":
            branches = [_series(tokens)]
            while tokens.pop(0) == "|":
                branches.append(_series(tokens))
            elements.append(branches)
        elif token[0] == "S":
            elements.append(("S", np.eye(3), (token[2:], None) if token[1:] else None))
        else:
            letter, inside = token.split("[")
            inside, label = inside.split("]")
            marked = [number for number, part in enumerate(re.split("[,;]", inside)) if "@" in part]
            line = (label[1:], None) if label else None
            for number in marked:  # one of the axes of a U
                line = (re.search("@([A-Z])", inside)[1], number)
            elements.append((letter.replace("P(4R)", "4R"), _axes(re.sub("@[A-Z]", "", inside)), line))
    return elements


def _axes(inside):
    if ";" in inside:
        rows = [part.split(",") for part in inside.split(";")]
    else:
        parts = [part.strip() for part in inside.split(",")]
        rows = [[part] for part in parts] if parts[0].strip("-") in NAMED else [parts]
    found = []
    for row in rows:
        name = row[0].strip()
        if name.strip("-") in NAMED:
            axis = np.array(NAMED[name.strip("-")], float) * (-1 if name[0] == "-" else 1)
        else:
            axis = np.array([float(part) for part in row])
        found.append(axis / np.linalg.norm(axis))
    return np.array(found)


# ---- placing --------------------------------------------------------------------------------------------------


@dataclass(eq=False)
class Body:
    """Joints between numbered links (0 the base, 1 the platform): (name, near, far, rows of screws), with O'."""

    joints: list
    links: int
    point: np.ndarray

    @property
    def freedoms(self):
        return sum(len(screws) for _, _, _, screws in self.joints)

    @property
    def loops(self):
        return len(self.joints) - self.links + 1


def placed(texts, seed):
    """The mechanism of some limbs with random dimensions."""
    rng = np.random.default_rng(seed)
    body = Body([], 2, rng.uniform(-1, 1, 3))
    counts, lines = {}, {}

    def link():
        body.links += 1
        return body.links - 1

    def joint(letter, near, far, screws, joined=""):
        counts[letter] = counts.get(letter, 0) + (not joined)
        body.joints.append((joined or f"{letter}{counts[letter]}", near, far, np.array(screws)))

    def turn(axis, point, pitch=0.0):
        return [*axis, *(np.cross(point, axis) + pitch * axis)]

    def series(elements, near, far):
        for index, element in enumerate(elements):
            after = far if index == len(elements) - 1 else link()
            if isinstance(element, list):
                for branch in element:
                    series(branch, near, after)
            else:
                one(*element, near, after)
            near = after

    def one(letter, axes, line, near, far):
        point = rng.uniform(-1, 1, 3)
        axis = axes[0]
        if line:
            beside = rng.uniform(0.3, 1) * axes[line[1]] if line[1] is not None else 0.0
            point = lines.setdefault(line[0], point) + beside  # a label behind the brackets is the centre
        if letter == "P":
            joint("P", near, far, [[0, 0, 0, *axis]])
        elif letter == "C":
            joint("C", near, far, [[0, 0, 0, *axis], turn(axis, point)])
        elif letter == "H":
            joint("H", near, far, [turn(axis, point, rng.choice([-1, 1]) * rng.uniform(0.2, 0.6))])
        elif letter == "4R":
            across = np.cross(axis, rng.normal(size=3))
            across /= np.linalg.norm(across)
            lean = rng.uniform(0.9, 2.2)
            rod = rng.uniform(0.5, 1.2) * (np.cos(lean) * across + np.sin(lean) * np.cross(axis, across))
            side = rng.uniform(0.5, 1.2) * across
            counts["Pa"] = counts.get("Pa", 0) + 1
            name = f"Pa{counts['Pa']}"
            rods = link(), link()
            places = (point, point + side)
            for index, (rod_link, place) in enumerate(zip(rods, places, strict=True)):
                joint("R", near, rod_link, [turn(axis, place)], f"{name}.{'ad'[index]}")
                joint("R", rod_link, far, [turn(axis, place + rod)], f"{name}.{'bc'[index]}")
        else:
            joint(letter, near, far, [turn(item, point) for item in axes])

    for text in texts:
        series(read(text), 0, 1)
    return body


# ---- poses and twists -----------------------------------------------------------------------------------------


def _hat(v):
    zero = np.zeros_like(v[..., 0])
    x, y, z = v[..., 0], v[..., 1], v[..., 2]
    rows = [zero, -z, y, z, zero, -x, -y, x, zero]
    return np.stack(rows, axis=-1).reshape(*v.shape[:-1], 3, 3)


def _moved(screw, values):
    """Displacements (..., 4, 4) by a screw with |omega| = 1 or 0, real or complex values (...)."""
    omega, v = screw[:3], screw[3:]
    found = np.zeros((*values.shape, 4, 4), dtype=values.dtype)
    found[..., 3, 3] = 1
    if not omega.any():
        found[..., :3, :3] = np.eye(3)
        found[..., :3, 3] = values[..., None] * v
        return found
    skew = _hat(omega)
    sine, cosine = np.sin(values)[..., None, None], np.cos(values)[..., None, None]
    rotation = np.eye(3) + sine * skew + (1 - cosine) * (skew @ skew)
    found[..., :3, :3] = rotation
    pitch = omega @ v
    found[..., :3, 3] = (np.eye(3) - rotation) @ np.cross(omega, v) + values[..., None] * pitch * omega
    return found


def _inverse(pose):
    found = np.zeros_like(pose)
    found[..., :3, :3] = np.swapaxes(pose[..., :3, :3], -1, -2)
    found[..., :3, 3] = -np.einsum("...ij,...j->...i", found[..., :3, :3], pose[..., :3, 3])
    found[..., 3, 3] = 1
    return found


@dataclass(eq=False)
class Linkage:
    """A body with a spanning tree; `residual` and `platform` as functions of joint values."""

    body: Body

    def __post_init__(self):
        starts = np.cumsum([0, *(len(screws) for *_, screws in self.body.joints)])
        self.columns = [slice(a, b) for a, b in pairwise(starts)]
        self.count = int(starts[-1])
        self.tree, self.cuts, reached = [], [], {0}
        waiting = list(range(len(self.body.joints)))
        while waiting:
            for index in waiting:
                _, near, far, _ = self.body.joints[index]
                if (near in reached) != (far in reached):
                    self.tree.append((index, near in reached))
                    reached |= {near, far}
                    waiting.remove(index)
                    break
                if near in reached:
                    self.cuts.append(index)
                    waiting.remove(index)
                    break

    def _joint(self, index, values):
        pose = None
        columns = self.columns[index]
        for column, screw in zip(range(columns.start, columns.stop), self.body.joints[index][3], strict=True):
            step = _moved(screw, values[..., column])
            pose = step if pose is None else pose @ step
        return pose

    def poses(self, values):
        found = {0: np.broadcast_to(np.eye(4, dtype=values.dtype), (*values.shape[:-1], 4, 4))}
        for index, forward in self.tree:
            _, near, far, _ = self.body.joints[index]
            step = self._joint(index, values)
            if forward:
                found[far] = found[near] @ step
            else:
                found[near] = found[far] @ _inverse(step)
        return found

    def system(self, values):
        """Residuals (..., 6 v): of each loop the skew part of the rotation that is left, and the gap."""
        poses = self.poses(values)
        parts = []
        for index in self.cuts:
            _, near, far, _ = self.body.joints[index]
            gap = poses[near] @ self._joint(index, values) @ _inverse(poses[far])
            parts += [_skew_part(gap), gap[..., :3, 3]]
        return np.concatenate(parts, axis=-1) if parts else np.zeros((*values.shape[:-1], 0), values.dtype)

    def differentiated(self, values):
        """Residuals (N, r), their Jacobian (N, r, n), by complex steps."""
        step = 1e-30
        shifted = values[:, None, :] + 1j * step * np.eye(self.count)
        found = self.system(shifted)
        return found[:, 0].real, np.swapaxes(found.imag / step, -1, -2)

    def platform(self, values):
        """Twists (N, 6, n) of the platform per joint rate: (omega, velocity of O'), by complex steps."""
        step = 1e-30
        pose = self.poses(values[:, None, :] + 1j * step * np.eye(self.count))[1]
        real, slope = pose.real, pose.imag / step
        spin = slope[..., :3, :3] @ np.swapaxes(real[..., :3, :3], -1, -2)
        velocity = slope[..., :3, :3] @ self.body.point + slope[..., :3, 3]
        return np.swapaxes(np.concatenate([_skew_part(spin), velocity], axis=-1), -1, -2)


def _skew_part(matrix):
    return np.stack(
        [
            (matrix[..., 2, 1] - matrix[..., 1, 2]) / 2,
            (matrix[..., 0, 2] - matrix[..., 2, 0]) / 2,
            (matrix[..., 1, 0] - matrix[..., 0, 1]) / 2,
        ],
        axis=-1,
    )


# ---- walking --------------------------------------------------------------------------------------------------


def closed(linkage, values, steps=40):
    """The nearest assemblies to values (N, n), by damped Gauss-Newton steps, and which of them close."""
    values = values.copy()
    good = np.zeros(len(values), bool)
    for _ in range(steps):
        residual, jacobian = linkage.differentiated(values)
        good = np.max(np.abs(residual), axis=1, initial=0) < CLOSED
        if good.all() or not residual.shape[1]:
            break
        left, singular, turned = np.linalg.svd(jacobian, full_matrices=False)
        damping = np.minimum(1e-3, np.linalg.norm(residual, axis=1, keepdims=True))
        # residuals of loops that imply each other lie along left vectors of zero: nothing is divided by those
        gain = np.where(singular > 1e-11, singular / (singular**2 + (1e-2 * damping) ** 2 + 1e-24), 0.0)
        change = np.einsum("nki,nk->ni", turned, gain * np.einsum("nrk,nr->nk", left, residual))
        change[good] = 0
        size = np.max(np.abs(change), axis=1, keepdims=True)
        values -= change * np.minimum(1, 0.3 / np.maximum(size, 1e-300))
    return values, good


def _null(jacobian):
    """Orthonormal bases, one for each configuration, and the ranks."""
    if not jacobian.shape[1]:
        return [np.eye(jacobian.shape[2])] * len(jacobian), np.zeros(len(jacobian), int)
    _, singular, turned = np.linalg.svd(jacobian)
    ranks = np.sum(singular > ZERO * np.maximum(singular[:, :1], 1e-9), axis=1)
    return [basis[rank:].T for basis, rank in zip(turned, ranks, strict=True)], ranks


def walks(linkage, count=16, seed=0, steps=6, length=0.2):
    """Assemblies (N, n) some finite way from home; those whose loops did not close on the way are left out."""
    rng = np.random.default_rng(seed)
    values = np.zeros((count, linkage.count))
    heading = rng.normal(size=values.shape)
    alive = np.ones(count, bool)
    for _ in range(steps):
        _, jacobian = linkage.differentiated(values)
        bases, _ = _null(jacobian)
        if all(basis.shape[1] == 0 for basis in bases):
            return np.zeros((1, linkage.count))
        along = np.array([basis @ (basis.T @ way) for basis, way in zip(bases, heading, strict=True)])
        size = np.linalg.norm(along, axis=1, keepdims=True)
        aim = values + length * along / np.maximum(size, 1e-12)
        after, good = closed(linkage, aim)
        moved = after - values
        gone = np.linalg.norm(moved, axis=1)
        alive &= good & (gone < 3 * length)
        heading = 0.8 * moved / np.maximum(gone, 1e-9)[:, None] + 0.3 * rng.normal(size=values.shape)
        values = after
    return values[alive]


@dataclass(frozen=True)
class Outcome:
    """What was met at an assembly: F, t, r, dim M; `real` where every instantaneous freedom leads somewhere."""

    freedoms: int
    t: int
    r: int
    dim: int
    real: bool


def outcome(linkage, values, seed=0):
    """At one assembly (n,)."""
    rng = np.random.default_rng(seed)
    _, jacobian = linkage.differentiated(values[None])
    (basis,), _ = _null(jacobian)
    twists = linkage.platform(values[None])[0] @ basis
    ranks = [_rank(part) for part in (twists[3:], twists[:3], twists)]
    return Outcome(basis.shape[1], *ranks, _leads(linkage, values, basis, rng))


def _rank(matrix):
    if 0 in matrix.shape:
        return 0
    return int(np.sum(np.linalg.svd(matrix, compute_uv=False) > ZERO))


def _leads(linkage, values, basis, rng, tries=6):
    """Whether steps along instantaneous freedoms can be closed by corrections of second order."""
    if not basis.shape[1]:
        return True
    ways = rng.normal(size=(tries, basis.shape[1])) @ basis.T
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    ratios = []
    for step in (4e-3, 1e-3):
        aim = values + step * ways
        after, good = closed(linkage, aim)
        if not good.all():
            return False
        ratios.append(np.linalg.norm(after - aim, axis=1) / step)
    return bool(np.all((ratios[1] < 0.5 * ratios[0]) | (ratios[1] < 1e-4)))


def outcomes(texts, seed=0, count=12):
    """How often each outcome is met around home: {Outcome: number}."""
    linkage = Linkage(placed(texts, seed))
    ends = walks(linkage, count, seed)
    return Counter(outcome(linkage, values, number) for number, values in enumerate(ends))


def finite_outcomes(texts, seed=0, count=8):
    """What finite steps follow: how often each (F, t, r, dim) is met around home, also where loops close singularly.

    A rank is None where the steps do not tell it.

    Steps of two lengths are taken from an assembly in all instantaneous directions, and the loops are closed. In
    directions of motions both lengths get on alike; in others the longer step gets on by its square, or not at all.
    """
    linkage = Linkage(placed(texts, seed))
    ends = walks(linkage, count, seed)
    ends = ends if len(ends) else np.zeros((1, linkage.count))
    return Counter(_followed(linkage, values, number) for number, values in enumerate(ends))


def _followed(linkage, values, seed, tries=30):
    rng = np.random.default_rng(seed)
    _, jacobian = linkage.differentiated(values[None])
    _, singular, turned = np.linalg.svd(jacobian[0]) if jacobian.shape[1] else (0, np.zeros(0), np.eye(linkage.count))
    # at double solutions joints are known to the root of what is left of the loops
    basis = turned[np.sum(singular > 2e-5 * max(singular.max(initial=0), 1e-9)) :].T
    if not basis.shape[1]:
        return 0, 0, 0, 0
    ways = rng.normal(size=(tries, basis.shape[1])) @ basis.T
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    spans = []
    for step in (4e-2, 1e-2):
        after, good = closed(linkage, values + step * ways, steps=120)
        steps = (after - values)[good] / step
        spans.append(basis.T @ steps.T @ steps @ basis / max(good.sum(), 1))
    share, directions = np.linalg.eigh(spans[1] - 0.5 * spans[0])
    motion = basis @ directions[:, share > 0.05 * max(np.max(share), 1e-3)]
    twists = linkage.platform(values[None])[0] @ motion
    t, r, dim = (_clear_rank(part) for part in (twists[3:], twists[:3], twists))
    return motion.shape[1], t, r, dim


def _clear_rank(matrix):
    """Rank, None where it is not clear: finite steps tell directions to 1e-3, and some motions turn hardly more."""
    size = np.linalg.svd(matrix, compute_uv=False)
    return None if np.any((size > 2e-4) & (size < 1e-2)) else int(np.sum(size > 5e-3))


# ---- coupling -------------------------------------------------------------------------------------------------


def least_sum_of_degrees(texts, driven, seed=0):
    """The least sum of |degrees| over all orders of loops, Eqs. (4) to (6), by trying them; None where nothing was met.

    A sum of degrees is what some loops can do with the drives locked, less what they still do in the whole mechanism.
    `driven` are pairs from 0: a joint's place among all as they are written, and its component. A parallelogram is one
    joint, with the motion of its far link. Infinite where the platform moves although the drives are locked.
    """
    linkage = Linkage(placed(texts, seed))
    ends = [(values, outcome(linkage, values, number)) for number, values in enumerate(walks(linkage, 12, seed))]
    met = Counter(item for _, item in ends if item.real)
    if not met:
        return None
    (usual, _), *_ = met.most_common(1)
    orders = _Orders(linkage, next(values for values, item in ends if item == usual), driven)
    return orders.least(frozenset()) if orders.fixed else np.inf


class _Orders:
    """Loops of a mechanism one after the other, at one assembly."""

    def __init__(self, linkage, values, driven):
        self.edges = _generalised(linkage, values)
        columns = [np.concatenate([[index] * twists.shape[1]]) for index, (*_, twists) in enumerate(self.edges)]
        self.owner = np.concatenate(columns).astype(int)
        starts = np.searchsorted(self.owner, [place for place, _ in driven])
        self.driven = np.isin(np.arange(len(self.owner)), starts + [component for _, component in driven])
        self.rests = self._locked(frozenset(range(len(self.edges))))
        platform = sum(sense * self._spread(index) for index, sense in self._way(0, 1))
        self.fixed = not _rank(platform @ self.rests)
        self.known, self.ranks = {}, {}

    def _spread(self, index):
        found = np.zeros((6, len(self.owner)))
        found[:, self.owner == index] = self.edges[index][3]
        return found

    def _way(self, start, end, among=None):
        """(edge, sense) from one link to another."""
        among = range(len(self.edges)) if among is None else among
        ways = {start: []}
        while end not in ways:
            before = len(ways)
            for index in among:
                _, near, far, _ = self.edges[index]
                for one, other, sense in ((near, far, 1), (far, near, -1)):
                    if one in ways and other not in ways:
                        ways[other] = [*ways[one], (index, sense)]
            if len(ways) == before:
                return None
        return ways[end]

    def _closure(self, taken):
        rows, tree = [], []
        for index in sorted(taken):
            _, near, far, _ = self.edges[index]
            way = self._way(near, far, tree)
            if way is None:
                tree.append(index)
            else:
                rows.append(self._spread(index) - sum((sense * self._spread(i) for i, sense in way), np.zeros((6, 1))))
        return np.concatenate(rows) if rows else np.zeros((0, len(self.owner)))

    def _locked(self, taken):
        """Basis of the motions of some loops with the drives locked, all other joints at rest."""
        free = np.isin(self.owner, list(taken)) & ~self.driven
        (basis,) = _null(self._closure(taken)[None][..., free])[0]
        found = np.zeros((len(self.owner), basis.shape[1]))
        found[free] = basis
        return found

    def left(self, taken):
        """Freedoms of some loops with the drives locked, less those that the whole mechanism leaves them."""
        if taken not in self.ranks:
            inside = np.isin(self.owner, list(taken))
            self.ranks[taken] = self._locked(taken).shape[1] - _rank(self.rests[inside])
        return self.ranks[taken]

    def least(self, taken):
        if taken not in self.known:
            after = {frozenset(taken | loop) for loop in self._next(taken)}
            sums = [abs(self.left(item) - self.left(taken)) + self.least(item) for item in after]
            self.known[taken] = min(sums, default=0)
        return self.known[taken]

    def _next(self, taken):
        """Sets of edges that add one loop: cycles of the graph whose parts that are joined already are one node."""
        node = {link: link for _, near, far, _ in self.edges for link in (near, far)}
        for index in taken:
            _, near, far, _ = self.edges[index]
            node = {link: node[near] if item == node[far] else item for link, item in node.items()}
        rest = [(i, node[e[1]], node[e[2]]) for i, e in enumerate(self.edges) if i not in taken]

        def further(way, nodes, goal):
            if nodes[-1] == goal:
                yield frozenset(way)
                return
            for index, one, other in rest:
                for near, far in ((one, other), (other, one)):
                    if near == nodes[-1] and index > way[0] and far not in nodes:
                        yield from further((*way, index), (*nodes, far), goal)

        for index, one, other in rest:
            yield from further((index,), (other,), one)


def _generalised(linkage, values):
    """Joints as (name, near, far, twists (6, f)) at an assembly; a parallelogram as one, with its far link's motion."""
    step = 1e-30
    poses = linkage.poses(values.astype(complex))
    found, inside = [], {}
    for index, (name, near, far, _) in enumerate(linkage.body.joints):
        columns = linkage.columns[index]
        count = columns.stop - columns.start
        shifted = values + 1j * step * np.eye(linkage.count)[columns]
        moved = poses[near] @ linkage._joint(index, shifted)
        real, slope = moved.real, moved.imag / step
        spin = slope[..., :3, :3] @ np.swapaxes(real[..., :3, :3], -1, -2)
        omega = _skew_part(spin)
        velocity = slope[..., :3, 3] - np.cross(omega, real[..., :3, 3])
        twists = np.concatenate([omega, velocity], axis=-1).reshape(count, 6).T
        if "." in name:
            inside.setdefault(name.split(".")[0], []).append((near, far, twists))
            if len(inside[name.split(".")[0]]) == 4:
                (base, _, a), (_, end, b), (_, _, d), (_, _, c) = inside[name.split(".")[0]]
                (rates,) = _null(np.concatenate([a, b, -d, -c], axis=1)[None])[0]
                motion = a @ rates[:1] + b @ rates[1:2]
                found.append((name.split(".")[0], base, end, motion / np.linalg.norm(motion)))
        else:
            found.append((name, near, far, twists))
    return found


# ---- random mechanisms ----------------------------------------------------------------------------------------

DIRECTIONS = ("x", "y", "z", "x", "y", "z", "1,0,2", "0.6,0.8,0", "-0.5,0.8,1.1")


def random_mechanism(rng):
    """Two to four limbs that may move: each with three to six freedoms, of axes that are often parallel or square."""
    count = int(rng.integers(2, 5))
    if rng.random() < 0.7:
        return tuple(_random_limb(rng) for _ in range(count))
    limb = _random_limb(rng)  # equal limbs, all as they are or every other one with other axes
    turned = limb.translate(str.maketrans("xyz", rng.choice(["xyz", "yxz", "yzx", "zyx"])))
    return ((limb, turned) * 2)[:count]


def _random_limb(rng):
    axes = [str(axis) for axis in rng.choice(DIRECTIONS, size=int(rng.integers(1, 4)), replace=False)]
    left = int(rng.choice([3, 4, 5, 6], p=[0.15, 0.3, 0.4, 0.15]))
    parts = []
    if rng.random() < 0.2:
        parts.append(_random_loop(rng, axes))
        left -= 2
    while left > 0:
        text, freedoms = _random_joint(rng, axes, left)
        parts.append(text)
        left -= freedoms
    if rng.random() < 0.3:
        rng.shuffle(parts)
    return " ".join(parts)


KINDS = {"R": 0.5, "P": 0.19, "P(4R)": 0.09, "H": 0.03, "C": 0.06, "U": 0.08, "S": 0.05}
FREEDOMS = {"C": 2, "U": 2, "S": 3}


def _random_joint(rng, axes, left):
    axis, kind = str(rng.choice(axes)), str(rng.choice(list(KINDS), p=list(KINDS.values())))
    if FREEDOMS.get(kind, 1) > left:
        return f"R[{axis}]", 1
    if kind == "S":
        return "S", 3
    if kind == "U":
        other = str(rng.choice(["1,0,0", "0,1,0", "0,0,1"]))
        if abs(_axes(axis)[0] @ _axes(other)[0]) > 0.9:
            return f"R[{axis}]", 1
        return f"U[{_written(axis)}; {other}]", 2
    return f"{kind}[{axis}]", FREEDOMS.get(kind, 1)


def _written(axis):
    return ",".join(str(part) for part in NAMED[axis]) if axis in NAMED else axis


def _random_loop(rng, axes):
    axis, along = rng.choice(axes), rng.choice(["x", "y", "z"])
    sliding, turning = f"P[{along}] R[{axis}] R[{axis}]", f"R[{axis}] R[{axis}] R[{axis}]"
    first = rng.choice([sliding, turning, f"R[{axis}] R[{axis}]"])
    second = rng.choice([sliding, turning, "U[x,y] P[z] S"], p=[0.4, 0.4, 0.2])
    return f"{{{first} | {second}}}"
