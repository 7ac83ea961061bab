"""Mode signs: signs of closing blocks that tell the solutions of a problem apart, wherever they are real.

They are the fewest that do so at three problems, and as many more as are independent where two solutions merge.
Each changes at singularities alone, so that a name is kept along every regular path. A rod between universal joints
can stand in two ways that look alike, half a turn about its line apart; a sign that differs between them is joined
with another one that does, so that what looks alike bears one name.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from assur.kinematics.border import held_inputs, inputs_of
from assur.kinematics.closing_blocks.ball_ends import with_ball_ends
from assur.kinematics.closing_blocks.by_name import sorted_by_name
from assur.kinematics.closing_blocks.chains import nodes
from assur.kinematics.closing_blocks.columns import ScrewColumns, assemblies_by_chance, open_freedoms
from assur.kinematics.closing_blocks.folds import differing_at_folds
from assur.kinematics.closing_blocks.namesakes import namesakes
from assur.kinematics.closing_blocks.platform_signs import platform_signs
from assur.kinematics.closing_blocks.signs import BlockSign, Factor, factor_signs, factors, screws_apart
from assur.kinematics.closing_blocks.strokes import StrokeSign
from assur.kinematics.closing_blocks.triangular import triangular_factors
from assur.kinematics.closure import assemble
from assur.kinematics.configurations import numbered
from assur.kinematics.loops.loops import LoopSolutions, solve_by_loops
from assur.kinematics.modes import Problem
from assur.kinematics.pose import pose_of
from assur.kinematics.rates.architecture import self_motion_dimension
from assur.kinematics.starts import by_chance, mixed, redrawn
from assur.kinematics.still import otherwise
from assur.kinematics.turns import near_turns_of_home
from assur.model.mechanism import MechanismRecord
from assur.numerics.modulo_two import independent, residues_of_sums, vanishing_sums

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.intp]
SignArray = NDArray[np.int8]
PROBLEMS, STARTS, AT_ONCE = 3, 160, 48
"""Problems whose solutions are to be told apart, home's first, and starts by chance for each, at most and at once."""

LEAST, MET = 32, 3
"""Assemblies of each problem, and how often each solution is met on the average, before no more starts are made: so
what looks alike is met, too. With 40 and 4 all names of 50 mechanisms are the same."""

ROUNDS = 2
"""How often more starts are made where few of them lead to an assembly."""

MOST_STEPS = 40
"""Of one start. Platforms and linkages lose one start in fifteen to it, none of them a solution; of rods on balls half
the time goes into steps beyond it, as most starts lead nowhere."""

MOST = 0.9
"""Share of the starts that lead to an assembly before the others are left: these take half as many steps again."""


@dataclass(frozen=True, eq=False)
class ModeSign:
    """One sign of a mode's name.

    Attributes:
        factors: whose product it is.
        meaning: what holds where it is +; "" where it was not asked yet.
    """

    factors: tuple[Factor, ...]
    meaning: str = ""

    @property
    def joints(self) -> tuple[str, ...]:
        """Those of all factors."""
        return tuple(dict.fromkeys(name for factor in self.factors for name in factor.joints))

    def needs_platform(self, record: MechanismRecord) -> bool:
        """Whether a factor's block has columns of what a ball-ended mechanism's pose leaves free."""
        blocks = [factor.block for factor in self.factors if isinstance(factor, BlockSign)]
        return any(column >= len(record.coordinates) for block in blocks for column in block.columns)

    def read_off_inputs(self, record: MechanismRecord) -> bool:
        """Whether it is nothing but strokes of driven slides: of one direct problem all solutions have the same."""
        driven = {item.coordinate.joint for item in record.inputs}
        return all(isinstance(factor, StrokeSign) and factor.slide in driven for factor in self.factors)

    def signs(self, screws: ScrewColumns) -> SignArray:
        """Signs (N,); 0 where one of the factors vanishes."""
        signs: SignArray = np.prod([factor.signs(screws) for factor in self.factors], axis=0, dtype=np.int8)
        return signs

    def shares(self, screws: ScrewColumns) -> FloatArray:
        """Product (N,) of what the factors are as shares; zero where one of them vanishes."""
        return np.asarray(np.prod([factor.shares(screws) for factor in self.factors], axis=0))


@lru_cache(maxsize=64)
def distinguishing_signs(record: MechanismRecord, problem: Problem) -> tuple[ModeSign, ...]:
    """The signs that name the modes of a problem; home reads + in each where it is regular.

    >>> from assur.model.registry import load_record
    >>> [sign.joints for sign in distinguishing_signs(load_record("fivebar"), "direct")]
    [('B1', 'B2', 'P')]
    """
    if problem == "direct" and self_motion_dimension(record):
        return ()  # the platform is held nowhere: each assembly leads into others
    record = with_ball_ends(record)
    ordered = sorted_by_name(record)
    known = factors(ordered, problem)
    solved = [ScrewColumns(ordered, values) for values in _solved(ordered, problem, _targets(ordered, known))]
    compared = _compared(solved, known)
    telling, told = len(compared[1]), bool(np.all(np.any(compared[2], axis=1)))
    more: list[Factor] = [*triangular_factors(known, screws_apart(ordered), problem)]
    if not told:
        more += platform_signs(screws_apart(ordered), problem)
    finer = [*known, *more]
    signs, order = _named(ordered, problem, finer, _compared(solved, finer) if more else compared, telling)
    if more and (not told or order[-1:] >= [telling]):
        finer.sort(key=lambda sign: len(sign.joints))
        signs, order = _named(ordered, problem, finer, _compared(solved, finer), len(finer))
    return tuple(ModeSign(tuple(_in_file_order(own, record) for own in signs[place].factors)) for place in order)


def _named(
    record: MechanismRecord, problem: Problem, known: Sequence[Factor], compared: _Compared, telling: int
) -> tuple[list[ModeSign], list[int]]:
    """Products of factors, and the places of those that name modes; the first ones alone where these tell all apart."""
    answers, joined, apart = compared
    apart = np.where(np.arange(len(joined)) < telling, apart, False)
    signs = [ModeSign(tuple(known[k] for k in chosen)) for chosen in joined]
    near = ScrewColumns.together([screws_apart(record), *(own.screws for own in answers)])
    flat = _flat_loops(known, joined, near)
    order = [*_separating(apart.T, flat)]
    given = [k for k, sign in enumerate(signs) if problem == "direct" and sign.read_off_inputs(record)]
    merging = differing_at_folds(problem, signs, near, [*order, *given])
    listed = [*order, *(k for k, own in enumerate(flat) if not own)]
    order += [listed[k] for k in independent(merging.T[listed]) if k >= len(order)]
    order += _separating(namesakes(problem, signs, near, [*order, *given]).T, flat)
    return signs, sorted(order)


def _in_file_order(factor: Factor, record: MechanismRecord) -> Factor:
    """A factor of the sorted mechanism as one of the file's."""
    if not isinstance(factor, BlockSign):
        return factor
    listed = sorted(record.coordinates, key=lambda own: (own.joint, own.index))
    columns = tuple(listed[k].index if k < len(listed) else k for k in factor.block.columns)
    return replace(factor, block=replace(factor.block, columns=columns))


@dataclass(frozen=True, eq=False)
class _Solutions:
    """Solutions of one problem by chance: assemblies (N, n), which (N,) of them each is, and its signs (N, s)."""

    screws: ScrewColumns
    solution: IntArray
    signs: SignArray

    @classmethod
    def of(cls, screws: ScrewColumns, known: Sequence[Factor]) -> _Solutions:
        """Those that assemblies (N, n) are."""
        signs = factor_signs(known, screws)
        regular = np.all(signs != 0, axis=1)
        return cls(screws.rows(regular), numbered(screws.record, screws.values)[regular], signs[regular])

    @property
    def alike(self) -> NDArray[np.bool_]:
        """Which signs (P, s) differ between assemblies that look alike."""
        first = np.unique(self.solution, return_index=True)[1]
        same = np.searchsorted(self.solution[first], self.solution)
        return np.unique(self.signs != self.signs[first][same], axis=0)

    def apart(self, joined: Sequence[Sequence[int]]) -> NDArray[np.bool_]:
        """Which products (P, k) of signs differ between two solutions, of all pairs."""
        own = self.signs[np.unique(self.solution, return_index=True)[1]]
        products = np.array([np.prod(own[:, chosen], axis=1) for chosen in joined]).reshape(len(joined), len(own)).T
        first, second = np.triu_indices(len(own), 1)
        return np.asarray(products[first] != products[second])


_Compared = tuple[list[_Solutions], list[list[int]], NDArray[np.bool_]]


def _compared(solved: Sequence[ScrewColumns], known: Sequence[Factor]) -> _Compared:
    """The solutions of each problem, products of factors that name them, and which of these differ in each pair."""
    answers = [_Solutions.of(screws, known) for screws in solved]
    joined = vanishing_sums(np.concatenate([answer.alike for answer in answers]).T)
    return answers, joined, np.concatenate([answer.apart(joined) for answer in answers])


def _targets(record: MechanismRecord, known: Sequence[Factor]) -> FloatArray:
    """Assemblies (P, n), home first, whose inputs or poses are asked.

    A singular home is none: solutions merge there, and rounding decides their signs.
    """
    values = assemblies_by_chance(record)
    if len(values) > 1 and not all(factor.signs(screws_apart(record))[0] for factor in known):
        values = values[1:]
    return values[:: -(-len(values) // PROBLEMS)]


def _solved(record: MechanismRecord, problem: Problem, targets: FloatArray) -> list[FloatArray]:
    """Assemblies (N, n) at the inputs or the pose of each target; what all ask for is closed together."""
    asking = [_solving(record, problem, target) for target in targets]
    begun = {k: next(own) for k, own in enumerate(asking)}
    solved: dict[int, FloatArray] = {}
    while begun:
        closed = _closed(record, problem, [(targets[k], starts) for k, starts in begun.items()])
        for k, values in zip([*begun], closed, strict=True):
            try:
                begun[k] = asking[k].send(values)
            except StopIteration as end:
                solved[k] = end.value
                del begun[k]
    return [solved[k] for k in range(len(targets))]


def _solving(
    record: MechanismRecord, problem: Problem, target: FloatArray
) -> Generator[FloatArray, FloatArray, FloatArray]:
    """Assemblies (N, n) at the inputs or the pose of another, in which still stands what does about home.

    Yields starts (S, n), and is sent the assemblies to which they lead. In loops of rods on balls, to which few starts
    by chance lead, they are those that the loops have in turn. Where few starts lead to one all the same, others begin
    as parts of those that are known.
    """
    if _rods_on_balls(record):
        turn = _in_turn(record, problem, target)
        if turn.complete:
            return (yield np.concatenate([target[None], turn.joints]))
    rng = np.random.default_rng(0)
    values = yield np.concatenate([target[None], by_chance(record, AT_ONCE, rng)])
    limbs = _limbs_apart(record) if problem == "inverse" and not open_freedoms(record) else []
    for _ in range(AT_ONCE, STARTS, AT_ONCE):
        solutions = 1 if len(limbs) > 1 else 1 + int(np.max(numbered(record, values), initial=0))
        if len(values) >= max(LEAST, MET * solutions):
            break
        values = np.concatenate([values, (yield by_chance(record, AT_ONCE, rng))])
    for _ in range(ROUNDS):
        if not 0 < len(values) < LEAST:
            break
        begun = np.concatenate([redrawn(record, values, STARTS // 2, rng), mixed(record, values, STARTS // 2, rng)])
        values = np.concatenate([values, (yield begun)])
    return _exchanged(values, limbs, rng) if len(limbs) > 1 else values


def _limbs_apart(record: MechanismRecord) -> list[list[int]]:
    """Indices of the joint values of parts that hang together by neither base nor platform: each closes by itself."""
    held = {record.base, record.platform.link}
    node = nodes(
        record, [(own.parent, own.child) for own in record.joints.values() if not {own.parent, own.child} & held]
    )
    limbs: dict[str, list[int]] = {}
    for item in record.coordinates:
        joint = record.joints[item.joint]
        part = next((node[link] for link in (joint.parent, joint.child) if link not in held), joint.name)
        limbs.setdefault(part, []).append(item.index)
    return [*limbs.values()]


def _exchanged(values: FloatArray, limbs: Sequence[Sequence[int]], rng: np.random.Generator) -> FloatArray:
    """Assemblies (N, n) at one pose, and others, in which each limb stands as in one of them."""
    others = np.empty((STARTS, values.shape[1]))
    for columns in limbs:
        others[:, columns] = values[rng.integers(len(values), size=STARTS)][:, columns]
    return np.concatenate([values, others])


def _rods_on_balls(record: MechanismRecord) -> bool:
    balls = [joint for joint in record.joints.values() if joint.type.ball]
    ends = Counter(link for joint in balls for link in (joint.parent, joint.child))
    return any(count > 1 for link, count in ends.items() if link not in (record.base, record.platform.link))


def _in_turn(record: MechanismRecord, problem: Problem, target: FloatArray) -> LoopSolutions:
    if problem == "direct":
        return solve_by_loops(record, inputs_of(record, target))
    return solve_by_loops(record, pose=pose_of(record, target))


def _closed(
    record: MechanismRecord, problem: Problem, asked: Sequence[tuple[FloatArray, FloatArray]]
) -> list[FloatArray]:
    """For each pair of a target (n,) and starts (S, n) the assemblies (N, n) to which these lead.

    Nuts begin with the turns of home: from others four starts of five or more lead nowhere once the shafts are held.
    """
    begun = np.concatenate([starts for _, starts in asked])
    counts = [len(starts) for _, starts in asked]
    targets = np.repeat([target for target, _ in asked], counts, axis=0)
    direct = problem == "direct"
    held, poses = (record.input_indices, None) if direct else ((), pose_of(record, targets))
    if direct:
        begun = held_inputs(record, begun, inputs_of(record, targets))
    starts = near_turns_of_home(record, begun, held)
    closed = assemble(record, starts, held=held, poses=poses, enough=MOST, far=True, max_steps=MOST_STEPS)
    kept = closed.closed.copy()
    kept[kept] = [not other for other in otherwise(record, closed.values[kept])]
    return [
        values[own]
        for values, own in zip(
            *(np.split(array, np.cumsum(counts)[:-1]) for array in (closed.values, kept)), strict=True
        )
    ]


def _flat_loops(known: Sequence[Factor], joined: Sequence[Sequence[int]], screws: ScrewColumns) -> list[bool]:
    """Which products of factors change where a loop that moves by itself is flat: by its sign, or that of a whole.

    A flat parallelogram is no singularity of either problem of those that stay such: no two solutions merge there.
    """
    signs = factor_signs(known, screws)
    rows = signs[np.all(signs != 0, axis=1)].T < 0
    moving = [k for k, factor in enumerate(known) if isinstance(factor, BlockSign) and factor.moving]
    plain = sorted({*range(len(known))} - {*moving}, key=lambda k: _unknown_rates(known[k]))
    of_moving = np.equal.outer(np.arange(len(known)), moving)
    rests = residues_of_sums(np.concatenate([rows, of_moving], axis=1)[[*moving, *plain]], rows.shape[1])
    flat = {*moving, *(k for k, rest in zip(plain, rests[len(moving) :], strict=True) if np.any(rest))}
    return [bool(flat & {*chosen}) for chosen in joined]


def _unknown_rates(factor: Factor) -> int:
    """How many rates a factor is the determinant of."""
    return factor.rates.shape[1] if isinstance(factor, BlockSign) else 0


def _separating(apart: NDArray[np.bool_], last: Sequence[bool]) -> Iterator[int]:
    """The signs that tell most pairs apart that those before them did not, until none tells more.

    Args:
        apart: whether each sign differs in each pair (s, P).
        last: which signs come where no other tells more.
    """
    left = np.ones(apart.shape[1], dtype=bool)
    for later in (False, True):
        own = [k for k, late in enumerate(last) if late == later]
        while np.any(left) and own:
            gains = [int(np.sum(apart[k] & left)) for k in own]
            best = own[int(np.argmax(gains))]
            if not np.any(apart[best] & left):
                break
            left &= ~apart[best]
            yield best
