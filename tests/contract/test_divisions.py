"""A law of every closed form: nothing is divided by what may vanish unnoticed.

Kernels never decide anything, so where a denominator is zero a status must say so. Each kernel is recorded, and every
denominator is taken apart: products, quotients, roots and signs leave what must not be zero. That is

- a number, or a parameter that the mechanism's file says is positive;
- a sum of squares and of something positive;
- a number times powers of margins at whose zero the formulas are declared to degenerate, and of factors of det Jp,
  det Jq or of kind "other", at whose zero the pose is singular;
- what the coefficients of a polynomial are divided by: one that is not finite leaves the problem undecided.

What is none of these, and yet not zero or no harm, is told in `EXPLAINED`: how many denominators, and why.
"""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.kinematics.modes import sign_names
from assur.model.closed_form import Branch, Eliminant, PolynomialSystem
from assur.model.pose import is_angle
from assur.numerics.expanded import Expanded
from assur.numerics.recording.tape import Recorded, Recorder

SAMPLES = 120
CURVE = "a curve is worked out only where two centres coincide: then the axis has a length, and is not along X"
RAILS = "lean^2 + rise^2: rails without a direction are refused with their file"
EXPLAINED = {
    ("h4_robot", "inverse"): (1, "the quantity t, by which nothing else is worked out, is that of the direct problem"),
    ("h4_robot", "direct"): (1, "c^2 + s^2 of a root: that it is 1 is one of the three quadrics which the root solves"),
    ("three_rps", "direct"): (24, "squares of units, and det Jp of poses between two steps of Newton's method; where "
                                  "one is zero the margin `upright` is not finite, so that a double root is undecided"),
    ("three_rrc", "direct"): (2, "det(A A^T + eps 1) is at least eps^3"),
    ("delta_4s", "self_motion"): (2, CURVE),
    ("linear_delta_4s", "inverse"): (1, RAILS),
    ("linear_delta_4s", "direct"): (1, RAILS),
    ("linear_delta_4s", "self_motion"): (3, f"{CURVE}; {RAILS}"),
    ("orthoglide", "self_motion"): (2, CURVE),
    ("tsai_platform", "self_motion"): (2, CURVE),
}  # fmt: skip


class Divisions(Recorder):
    """A recorder that remembers what was divided by."""

    def __init__(self):
        super().__init__()
        self.denominators = []

    def apply(self, name, *arguments):
        if any(isinstance(item, Expanded) for item in arguments):
            return NotImplemented  # a polynomial knows how to go on
        if name == "/":
            self.denominators.append(arguments[1])
        return super().apply(name, *arguments)


class Kernel:
    """One problem of a mechanism, recorded with all that is worked out from its branches."""

    def __init__(self, record, problem):
        self.record, self.form, self.ns = record, record.closed_form, Divisions()
        self.p = SimpleNamespace(**{name: self.ns.uniform(name) for name in vars(record.values)})
        self.notzero = {}  # label -> a margin at whose zero the formulas degenerate
        self.given = []  # (name, is an angle)
        getattr(self, problem)()

    def number(self, name, angle=False):
        self.given.append((name, angle))
        if angle:
            return self.ns.varying(f"cos {name}"), self.ns.varying(f"sin {name}")
        return self.ns.varying(name)

    def pose(self):
        return tuple(self.number(name, is_angle(name)) for name in self.record.platform.pose)

    def inputs(self):
        return tuple(self.number(item.name, item.coordinate.kind == "angle") for item in self.record.inputs)

    def signs(self, names):
        return SimpleNamespace(**dict.fromkeys(names, 1.0))

    def inverse(self):
        names = sign_names(self.record, "inverse")
        self.after(self.form.inverse(self.ns, self.p, self.pose(), self.signs(names)), self.form.inverse_margins)

    def direct(self):
        direct, inputs = self.form.direct, self.inputs()
        margins = self.form.direct_margins
        if isinstance(direct, PolynomialSystem):
            unknowns = tuple(self.number(name) for name in direct.unknowns)
            direct.equations(self.ns, self.p, inputs, unknowns)
            self.notzero["finite"] = direct.finite(unknowns)
            self.after(direct.back(self.ns, self.p, inputs, unknowns), margins)
        elif isinstance(direct, Eliminant):
            extra = (self.signs(direct.signs),) if direct.signs else ()
            direct.coefficients(self.ns, self.p, inputs, *extra)
            self.notzero |= {f"coefficients {k}": value for k, value in enumerate(self.ns.denominators)}
            root = self.number(direct.unknown, direct.kind == "angle")
            self.after(direct.back(self.ns, self.p, inputs, root, *extra), margins)
        else:
            names = sign_names(self.record, "direct")
            self.after(direct(self.ns, self.p, inputs, self.signs(names)), margins)

    def self_motion(self):
        found, inputs = self.form.self_motion, self.inputs()
        turn = self.number(found.parameter, True)
        names = sign_names(self.record, "direct")
        branch = found.kernel(self.ns, self.p, inputs, turn, self.signs(names))
        known = [item for item in self.form.direct_margins if item.name in branch.margins]
        self.after(branch, known)

    def after(self, branch: Branch, margins):
        form, ns, p = self.form, self.ns, self.p
        self.notzero |= {item.name: branch.margins[item.name] for item in margins if item.zero == "degenerate"}
        factors = form.factors(ns, p, branch.core)
        self.notzero |= {f"factor {item.name}": factors[item.name] for item in form.factor_list}
        form.jacobians(ns, p, branch.core)
        form.joints(ns, p, branch.core)
        if form.quantities is not None:
            form.quantities(ns, p, branch.core)

    def undeclared(self):
        """Denominators that may vanish without a status."""
        outputs = {f"/{k}": value for k, value in enumerate(self.ns.denominators) if isinstance(value, Recorded)}
        named = {name: value for name, value in self.notzero.items() if isinstance(value, Recorded)}
        plain = [value for value in self.ns.denominators if not isinstance(value, Recorded)]
        tape = self.ns.tape({**outputs, **named})
        pieces = Pieces(self, tape, {name: tape.outputs[name] for name in named})
        found = {k for name in outputs for k in pieces.doubtful(tape.outputs[name])}
        return [pieces.text(k) for k in sorted(found)] + [value for value in plain if not value]


class Pieces:
    """What a tape's entries are made of, and of which of them it is known that they are not zero."""

    def __init__(self, kernel, tape, declared):
        self.tape, self.operations = tape, tape.operations
        names = iter(tape.uniform)
        signs = {name: item.sign for name, item in kernel.record.parameters.items()}
        self.parameters = {k: signs[next(names)] for k, item in enumerate(self.operations) if item.name == "uniform"}
        self.values = _samples(kernel, tape)
        self.known, self.declared = set(), sorted(set(declared.values()))
        self.doubts, self.signs = {}, {}
        for k in declared.values():
            self._taken_apart(k)

    def _taken_apart(self, k):
        """A product or quotient that is not zero and finite has no part that is zero."""
        item = self.operations[k]
        if k in self.known:
            return
        self.known.add(k)
        if item.name in ("*", "/", "negative", "magnitude", "root"):
            for part in item.arguments:
                self._taken_apart(part)

    def doubtful(self, k):
        """The parts of an entry of which it is not known that they are not zero."""
        if k not in self.doubts:
            self.doubts[k] = self._doubtful(k)
        return self.doubts[k]

    def _doubtful(self, k):
        item = self.operations[k]
        if k in self.known or self.least(k) == "positive":
            return set()
        if item.name == "number":
            return set() if item.number else {k}
        if item.name in ("negative", "magnitude", "root"):
            return self.doubtful(item.arguments[0])
        if item.name in ("*", "/"):
            return set().union(*map(self.doubtful, item.arguments))
        if item.name in ("+", "-") and self._is_nothing(item.arguments[1]):
            return self.doubtful(item.arguments[0])
        return set() if any(self._is_multiple(k, j) for j in self.known) or self._is_product(k) else {k}

    def _is_nothing(self, k):
        return self.operations[k].name == "number" and self.operations[k].number == 0

    def least(self, k):
        """ "positive", "zero or more", or "anything": what is known of a sign by the way it is made."""
        if k not in self.signs:
            self.signs[k] = self._least(k)
        return self.signs[k]

    def _least(self, k):
        item = self.operations[k]
        if item.name == "number":
            return "positive" if item.number > 0 else "zero or more" if item.number == 0 else "anything"
        if item.name == "uniform":
            return {"positive": "positive", "nonnegative": "zero or more", "any": "anything"}[self.parameters[k]]
        if item.name in ("root", "magnitude"):
            return "positive" if self.least(item.arguments[0]) == "positive" else "zero or more"
        if item.name in ("*", "/", "+"):
            first, second = item.arguments
            if item.name == "*" and first == second:
                return "positive" if first in self.known or self.least(first) == "positive" else "zero or more"
            both = {self.least(first), self.least(second)}
            if "anything" in both:
                return "anything"
            return "positive" if both == {"positive"} or (item.name == "+" and "positive" in both) else "zero or more"
        return "anything"

    def _is_multiple(self, k, known):
        """Whether an entry that varies is another times a number, at samples."""
        with np.errstate(all="ignore"):
            ratio = np.broadcast_to(self.values[k] / self.values[known], (SAMPLES,))
        ratio = ratio[np.isfinite(ratio) & (ratio != 0)]
        varies = len(np.unique(self.values[k])) > SAMPLES // 4
        return varies and len(ratio) > SAMPLES // 4 and _same(ratio, np.median(ratio))

    def _is_product(self, k):
        """Whether an entry is a number times powers of what is declared, at samples; powers are halves."""
        with np.errstate(all="ignore"):
            logs = np.log(np.abs([np.broadcast_to(self.values[j], (SAMPLES,)) for j in (k, *self.declared)]))
        logs = logs[:, np.all(np.isfinite(logs), axis=0)]
        if logs.shape[1] < 2 * len(logs):
            return False
        columns = np.vstack([np.ones(logs.shape[1]), logs[1:]]).T
        powers = np.linalg.lstsq(columns, logs[0], rcond=1e-9)[0][1:]
        rest = logs[0] - logs[1:].T @ (np.round(2 * powers) / 2)
        return bool(np.any(np.round(2 * powers))) and _same(rest - np.median(rest), 0.0)

    def text(self, k, depth=4):
        item = self.operations[k]
        if item.name in ("varying", "uniform"):
            names = self.tape.varying if item.name == "varying" else self.tape.uniform
            return names[[j for j, other in enumerate(self.operations) if other.name == item.name].index(k)]
        if item.name == "number" or depth == 0:
            return f"{item.number:g}" if item.name == "number" else ".."
        parts = [self.text(part, depth - 1) for part in item.arguments]
        return f"({f' {item.name} '.join(parts)})" if len(parts) == 2 else f"{item.name}({parts[0]})"


def _same(values, wanted):
    """Nine in ten of them: at the others rounding may have taken the digits."""
    return bool(np.mean(np.abs(values - wanted) <= 1e-9 * max(1e-300, abs(wanted), wanted == 0)) > 0.9)


def _samples(kernel, tape):
    """Values of every entry at random given numbers, those near the workspace."""
    rng, record = np.random.default_rng(7), kernel.record
    size = max(map(abs, vars(record.values).values()))
    given = []
    for name, angle in kernel.given:
        usual = (-3, 3) if angle else (0.3 * size, 1.5 * size)
        place = rng.uniform(*record.box.get(name, usual), SAMPLES)
        given += [np.cos(place), np.sin(place)] if angle else [place]
    everything = {str(k): k for k in range(len(tape.operations))}
    whole = type(tape)(tape.operations, tape.varying, tape.uniform, everything)
    found = whole.evaluate(given, [getattr(record.values, name) for name in tape.uniform])
    return [np.asarray(found[str(k)]) for k in range(len(tape.operations))]


def _problems(record):
    form = record.closed_form
    return ["inverse", *["direct"] * (form.direct is not None), *["self_motion"] * (form.self_motion is not None)]


@pytest.mark.parametrize(
    ("name", "problem"), [(name, problem) for name in assur.names() for problem in _problems(assur.load(name))]
)
def test_nothing_is_divided_by_what_may_vanish_unnoticed(name, problem):
    found = Kernel(assur.load(name), problem).undeclared()
    count, _ = EXPLAINED.get((name, problem), (0, ""))
    assert len(found) == count, found


def test_rails_without_a_direction_are_refused():
    with pytest.raises(UsageError, match="lean = 0, rise = 0"):
        assur.load("linear_delta_4s", lean=0.0, rise=0.0)


def test_a_division_that_is_not_declared_is_found():
    """The five-bar without the margin that says where its legs have no direction."""
    record = assur.load("fivebar")
    for name, problem in (("distance1", "inverse"), ("gap", "direct")):
        form = record.closed_form
        kept = {
            f"{kind}_margins": tuple(item for item in getattr(form, f"{kind}_margins") if item.name != name)
            for kind in ("inverse", "direct")
        }
        factors = tuple(item for item in form.factor_list if item.kind != "other")
        changed = replace(record, closed_form=replace(form, **kept, factor_list=factors))
        assert len(Kernel(changed, problem).undeclared()) > 0
