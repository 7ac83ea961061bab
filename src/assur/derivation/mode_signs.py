"""Which sign of a mode each root of a derivation has: by the file's quantities, or by closing blocks, at branches."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import sympy
from numpy.typing import NDArray

from assur.derivation.closed_form_formulas import ClosedFormFormulas, SignProduct
from assur.derivation.closed_form_text import ClosedFormText
from assur.derivation.kernel_text import sign_attribute
from assur.derivation.not_derived import NotDerivedError
from assur.derivation.solution import AnalyticSolution
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics import border, pose
from assur.kinematics.closing_blocks.columns import assemblies_by_chance
from assur.kinematics.home import home_values
from assur.kinematics.modes import Problem, sign_names, written_quantities
from assur.kinematics.naming import sign_meanings, signs_at
from assur.model.closed_form import ClosedForm
from assur.model.kernel_dimensions import kernel_dimensions
from assur.model.kernels.faults import FormFault
from assur.model.kernels.reading import names_of
from assur.model.pose import LENGTHS
from assur.numerics.number_types import Floats

FloatArray = NDArray[np.float64]
Share = tuple[set[int], set[str], int]
"""Names by their numbers and divisors, whose product has a sign, and the sense."""
_Table = tuple[NDArray[np.bool_], dict[str, NDArray[np.bool_]]]
RootSigns = dict[tuple[Problem, sympy.Symbol], tuple[str, int]]
PLACES, NEAR = 24, 0.05
"""Poses about home, in characteristic lengths and rad, at which signs are compared."""


@dataclass(frozen=True)
class MatchedSigns:
    """What the signs of modes are those of.

    Attributes:
        roots: problem and root -> the sign of a mode, and whether the root has it or its opposite. A sign without name
            is that of home: the modes do not know legs of negative length.
        factors: sign of a mode that no root has -> a product of factors and of quantities that has it.
        products: problem and root -> what the sign is multiplied with.
    """

    roots: RootSigns
    factors: Mapping[str, sympy.Expr]
    products: Mapping[tuple[Problem, sympy.Symbol], SignProduct]


def matched_signs(direct: AnalyticSolution, inverse: AnalyticSolution) -> MatchedSigns:
    """The signs of both problems. Errors: NotDerivedError."""
    return _Matching(direct, inverse).signs()


@dataclass(frozen=True, eq=False)
class _Branches:
    """Branches at poses about home.

    Attributes:
        joints: (N, n) joint values.
        signs: name in the form that is tried -> signs (N,) of the quantity.
        factors: name of a factor -> its signs (N,).
    """

    joints: NDArray[np.float64]
    signs: Mapping[str, NDArray[np.float64]]
    factors: Mapping[str, NDArray[np.float64]]


class _Matching:
    """A form whose signs are called by numbers, and at its branches those by which modes are named."""

    def __init__(self, direct: AnalyticSolution, inverse: AnalyticSolution) -> None:
        self.direct, self.inverse, self.record = direct, inverse, inverse.symbols.record
        self.solutions: dict[Problem, AnalyticSolution] = {"inverse": inverse, "direct": direct}
        self.own: RootSigns = {
            (problem, root.symbol): (f"{problem}{k}", 1)
            for problem, solution in self.solutions.items()
            for k, root in enumerate(solution.roots)
        }
        plain = ClosedFormFormulas(direct, inverse, self.own)
        self.divisors = {f"divisor{k}": own for k, own in enumerate(plain.direct_divisors)}
        values = {name: plain.of_direct(own) for name, own in self.divisors.items()}
        self.formulas = ClosedFormFormulas(direct, inverse, self.own, values)
        try:
            names = names_of(ClosedFormText(self.formulas).text(), Path("closed_form.py"))
        except FormFault as fault:
            raise NotDerivedError(f"the formulas are too long for a closed form that is read: {fault}") from fault
        self.form: ClosedForm = names["CLOSED_FORM"]

    def signs(self) -> MatchedSigns:
        """Those of both problems."""
        matched: RootSigns = {}
        products: dict[tuple[Problem, sympy.Symbol], SignProduct] = {}
        factors: dict[str, sympy.Expr] = {}
        for problem, solution in self.solutions.items():
            left = self._roots(problem, solution, matched, products)
            if left and problem == "direct" and solution.eliminant is not None:
                if not solution.roots:  # whose names the joint graph has, where the file has none
                    left = {k: name for k, name in left.items() if name in sign_names(self.record, problem)}
                factors = self._of_factors(left)
                left = {k: name for k, name in left.items() if name not in factors}
            if left:
                raise NotDerivedError(f"{', '.join(left.values())} name modes, and no root has their sign")
        names = [
            {name for (of, _), (name, _) in matched.items() if of == problem and name} for problem in self.solutions
        ]
        if alike := set.intersection(*names):
            raise NotDerivedError(
                f"modes of both problems are called {', '.join(sorted(alike))}: a closed form needs names that differ, "
                "which [modes] of the file can give"
            )
        return MatchedSigns(matched, factors, products)

    def _roots(
        self,
        problem: Problem,
        solution: AnalyticSolution,
        matched: RootSigns,
        products: dict[tuple[Problem, sympy.Symbol], SignProduct],
    ) -> dict[int, str]:
        """The signs of roots, each a product of names and of divisors; the names that are left."""
        meanings = [*sign_meanings(self.record, problem)]
        divisors = self.divisors if problem == "direct" else {}
        tables = [self._table(problem, solution, divisors, poses) for poses in (self._anywhere, self._about_home)]
        shares: dict[sympy.Symbol, dict[int, Share]] = {}
        for root in solution.roots:
            name = self.own[problem, root.symbol][0]
            share = self._shares(tables, name, len(meanings), [*divisors])
            if not share and self._same_leg_half_round(problem, solution, root.quantity):
                matched[problem, root.symbol] = "", 1 if solution.symbols.witness.home[root.symbol] > 0 else -1
                continue
            if not share:
                raise NotDerivedError(self._no_name(root.quantity, [table[1][name] for table in tables]))
            shares[root.symbol] = share
        chosen = assigned([{*share} for share in shares.values()])
        if chosen is None:
            raise NotDerivedError(f"the names of the modes of {self.record.name} do not tell all branches apart")
        for k, (symbol, share) in zip(chosen, shares.items(), strict=True):
            names, own, sense = share[k]
            matched[problem, symbol] = meanings[k], sense
            if names != {k} or own:
                others = tuple(meanings[other] for other in sorted(names - {k}))
                whole = tuple(divisors[name] for name in sorted(own))
                products[problem, symbol] = SignProduct(others, whole)
        return {k: name for k, name in enumerate(meanings) if k not in chosen}

    def _no_name(self, quantity: sympy.Expr, minus: Sequence[NDArray[np.bool_]]) -> str:
        """Why a root has none, by whether its sign (N,) is minus at branches."""
        answer = f"the sign of {quantity} is none by which the modes of {self.record.name} are named"
        if len({*np.concatenate(minus).tolist()}) > 1:
            return answer
        return (
            f"{answer}: with these dimensions its other value is real at no assembly that was met; with others the "
            "joint graph names it, or [modes] of the file can"
        )

    def _same_leg_half_round(self, problem: Problem, solution: AnalyticSolution, quantity: sympy.Expr) -> bool:
        """Whether a length of either sign is one answer: the leg is turned half round, which the names do not tell.

        Where the joint graph names the modes, that is so of legs that neither slide nor turn by an input.
        """
        circle = solution.loops.strokes.get(quantity)
        if circle is None or written_quantities(self.record, problem):
            return circle is not None
        driven = [own.coordinate for own in self.record.inputs]
        turned = [self.record.joints[own.joint] for own in driven if own.kind == "angle"]
        slides = {solution.loops.lengths.get(own.index) for own in driven}
        return quantity not in slides and not {*circle.links} & {
            link for joint in turned for link in (joint.parent, joint.child)
        }

    def _table(
        self, problem: Problem, solution: AnalyticSolution, divisors: Mapping[str, sympy.Expr], poses: FloatArray
    ) -> _Table:
        """Which signs are minus: of names (N, s), and by name of roots and divisors (N,)."""
        branches = self._branches(poses)
        named = signs_at(self.record, problem, branches.joints)
        sound = np.all(named != 0, axis=1)
        own = [self.own[problem, root.symbol][0] for root in solution.roots]
        return named[sound] < 0, {name: branches.signs[name][sound] < 0 for name in (*own, *divisors)}

    def _shares(self, tables: Sequence[_Table], root: str, count: int, divisors: Sequence[str]) -> dict[int, Share]:
        """Name -> names, itself among them, and divisors whose product has the sign of a root, and the sense.

        What holds far from home too before what holds near it; one name alone before products.
        """
        wide, near = (np.concatenate([table[0] for table in own]) for own in (tables, tables[1:]))
        signs = {
            name: [np.concatenate([table[1][name] for table in own]) for own in (tables, tables[1:])]
            for name in (root, *divisors)
        }
        for k, named in enumerate((wide, near)):
            alone = {}
            for own in range(count):
                unlike = named[:, own] ^ signs[root][k]
                if np.all(unlike) or not np.any(unlike):
                    alone[own] = ({own}, set[str](), -1 if unlike[0] else 1)
            if alone:
                return alone
            columns = [np.ones(len(named), dtype=bool), *named.T, *(signs[name][k] for name in divisors)]
            chosen = summands(np.stack(columns, axis=1), signs[root][k])
            if chosen is not None:
                names = {own - 1 for own in chosen if 0 < own <= count}
                share = names, {divisors[own - 1 - count] for own in chosen if own > count}, -1 if 0 in chosen else 1
                return dict.fromkeys(names, share)
        return {}

    def _of_factors(self, left: Mapping[int, str]) -> dict[str, sympy.Expr]:
        """Names of modes of a polynomial that products of factors, and of quantities of roots, are the signs of."""
        branches = self._branches(self._anywhere)
        named = signs_at(self.record, "direct", branches.joints)
        quantities = {
            name: (value, branches.factors[name]) for name, kind, value in self.formulas.factors if kind != "other"
        }
        quantities |= {
            name: (self.formulas.sign_values[name], branches.signs[name])
            for (of, _), (name, _) in self.own.items()
            if of == "inverse"
        }
        products: dict[str, sympy.Expr] = {}
        for k, name in left.items():
            product = _product(named[:, k], {own: values for own, (_, values) in quantities.items()})
            if product is not None:
                chosen, sense = product
                products[name] = sense * sympy.prod([quantities[own][0] for own in chosen])
        return products

    @cached_property
    def _about_home(self) -> FloatArray:
        """Poses (N, m) about home."""
        home = pose.pose_of(self.record, home_values(self.record))
        length = characteristic_length(self.record)
        scales = np.array([length if name in LENGTHS else 1.0 for name in self.record.platform.pose])
        random = np.random.default_rng(0)
        return np.asarray(home + NEAR * scales * random.uniform(-1.0, 1.0, (PLACES, len(home))))

    @cached_property
    def _anywhere(self) -> FloatArray:
        """Poses (N, m) of assemblies by chance, and of the other branches at the inputs of a few of them: each root is
        real, and has both signs, at some.
        """
        assemblies = assemblies_by_chance(self.record)
        return np.concatenate([pose.pose_of(self.record, assemblies), *self._other_branches(assemblies[:PLACES])])

    def _other_branches(self, assemblies: FloatArray) -> Iterator[FloatArray]:
        """Poses (N, m) of the direct problem's branches at the inputs of assemblies (K, n), where they are real."""
        solve = self.form.direct
        if not callable(solve):
            return
        names = [self.own["direct", root.symbol][0] for root in self.direct.roots]
        inputs = border.input_components(self.record, border.inputs_of(self.record, assemblies))
        for signs in itertools.product((1.0, -1.0), repeat=len(names)):
            own = SimpleNamespace(**dict(zip(names, signs, strict=True)))
            with np.errstate(divide="ignore", invalid="ignore"):
                branch = solve(Floats(), kernel_dimensions(self.record), inputs, own)
            parts = (np.broadcast_to(border.scalar(value), len(assemblies)) for value in branch.pose)
            poses = np.stack([*parts], axis=-1)
            yield poses[np.all(np.isfinite(poses), axis=-1)]

    def _branches(self, poses: FloatArray) -> _Branches:
        """Branches at poses."""
        record, form = self.record, self.form
        roots = [self.own["inverse", root.symbol][0] for root in self.inverse.roots]
        choices = np.array([*itertools.product((1.0, -1.0), repeat=len(roots))]).reshape(2 ** len(roots), len(roots))
        many, rows = np.repeat(poses, len(choices), axis=0), np.tile(choices, (len(poses), 1))
        ns, p = Floats(), kernel_dimensions(record)
        signs = SimpleNamespace(**dict(zip(roots, rows.T, strict=True)))
        branch = form.inverse(ns, p, border.pose_components(record, many), signs)
        radicands = (np.broadcast_to(value, len(many)) for value in _radicands(form, branch.margins))
        real = np.logical_and.reduce([np.ones(len(many), dtype=bool), *(value > 0.0 for value in radicands)])
        joints = border.joint_values(record, form.joints(ns, p, branch.core))
        values = np.stack([np.broadcast_to(value, len(many)) for value in joints], axis=-1)

        def sign(value: Any) -> NDArray[np.float64]:
            return np.asarray(np.sign(np.broadcast_to(value, len(many)))[real])

        named = [*(name for name, _ in self.own.values()), *self.divisors]
        return _Branches(
            values[real],
            {name: sign(getattr(branch.core, sign_attribute(name))) for name in named},
            {name: sign(value) for name, value in form.factors(ns, p, branch.core).items()},
        )


def summands(columns: NDArray[np.bool_], total: NDArray[np.bool_]) -> list[int] | None:
    """Columns (N, k) whose sum modulo 2 is the total (N,), the first ones if there is a choice; None: there are none.

    >>> summands(np.array([[True, False, True], [True, True, False]]), np.array([False, True]))
    [1]
    """
    basis: list[tuple[NDArray[np.bool_], set[int]]] = []

    def left(own: NDArray[np.bool_], made: set[int]) -> tuple[NDArray[np.bool_], set[int]]:
        for column, of in basis:
            if own[np.argmax(column)]:
                own, made = own ^ column, made ^ of
        return own, made

    for k in range(columns.shape[1]):
        own, made = left(columns[:, k], {k})
        if np.any(own):
            basis.append((own, made))
    rest, chosen = left(total, set())
    return None if np.any(rest) else sorted(chosen)


def assigned(choices: Sequence[set[int]]) -> list[int] | None:
    """One of each set, all different; None where there are none.

    >>> assigned([{0, 1}, {0}])
    [1, 0]
    """
    if not choices:
        return []
    for own in sorted(choices[0]):
        rest = assigned([other - {own} for other in choices[1:]])
        if rest is not None:
            return [own, *rest]
    return None


def _product(signs: NDArray[np.int8], factors: Mapping[str, NDArray[np.float64]]) -> tuple[tuple[str, ...], int] | None:
    """The fewest quantities whose product has these signs (N,), or all the opposite ones; None where none changes."""
    if len({*signs}) < len((1, -1)):
        return None
    for count in range(1, len(factors) + 1):
        for chosen in itertools.combinations(factors, count):
            values = np.prod([factors[name] for name in chosen], axis=0)
            for sense in (1, -1):
                if np.all(signs == sense * values):
                    return chosen, sense
    return None


def _radicands(form: ClosedForm, margins: Mapping[str, Any]) -> list[Any]:
    return [margins[margin.name] for margin in form.inverse_margins if margin.signs]
