"""A closed form as C99 in one file: direct and inverse problem, Jacobians, margins, factors, vectors to test it by.

Nothing is allocated and nothing but -lm is needed. Branches are worked out by the recorded program of the closed form,
operation by operation; a polynomial's roots by Aberth's iteration, polished by Newton's.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from assur.errors import UsageError
from assur.export.answers_about_home import answers_about_home
from assur.export.c99_text import HEAD, LEFT_OVER, POLYNOMIAL, SELF_TEST, identifier
from assur.kinematics.contract.kernel import Kernel, recorded
from assur.kinematics.modes import Problem, sign_names
from assur.kinematics.status import tolerance
from assur.model.closed_form import Eliminant, PolynomialSystem
from assur.model.kernel_dimensions import dimension_numbers
from assur.model.mechanism import MechanismRecord
from assur.model.pose import is_angle
from assur.numerics.recording.c99 import c99, number_text
from assur.numerics.recording.tape import pruned

SIGNS = (1.0, -1.0)
FILLED = ("margin", "pose", "input", "factor", "jp", "jq")


def c99_text(record: MechanismRecord) -> str:
    """The file.

    Errors:
        UsageError: a mechanism without a closed form, or one whose closed form asks for a namespace of NumPy alone.

    >>> from assur.model.registry import load_record
    >>> text = c99_text(load_record("fivebar"))
    >>> "int fivebar_direct(" in text, "#define FIVEBAR_DIRECT_MAX 2" in text
    (True, True)
    """
    if record.closed_form is None:
        raise UsageError(
            f"{record.name} has no closed form, so there are no formulas to write in C",
            hint="assur derive M --c FILE writes those that it derives",
        )
    return _Source(record).text()


@dataclass(frozen=True, eq=False)
class _Source:
    record: MechanismRecord

    @cached_property
    def name(self) -> str:
        return identifier(self.record.name)

    @cached_property
    def problems(self) -> tuple[Problem, ...]:
        form = self.record.closed_form
        solved = form is not None and form.direct is not None and not isinstance(form.direct, PolynomialSystem)
        return ("direct", "inverse") if solved else ("inverse",)

    @cached_property
    def kernels(self) -> dict[Problem, Kernel]:
        return {problem: recorded(self.record, problem) for problem in self.problems}

    @cached_property
    def eliminant(self) -> Eliminant | None:
        form = self.record.closed_form
        return form.direct if form is not None and isinstance(form.direct, Eliminant) else None

    def signs(self, problem: Problem) -> tuple[str, ...]:
        if problem == "direct" and self.eliminant is not None:
            return self.eliminant.signs
        return tuple(sign_names(self.record, problem))

    def roots(self, problem: Problem) -> int:
        return self.eliminant.roots if problem == "direct" and self.eliminant is not None else 1

    def most(self, problem: Problem) -> int:
        return int(2 ** len(self.signs(problem))) * self.roots(problem)

    def text(self) -> str:
        parts = [self._head(), *([POLYNOMIAL] if self.eliminant else [])]
        parts += [part for problem in self.problems for part in self._problem(problem)]
        return "\n".join([*parts, self._self_test()])

    def _head(self) -> str:
        record, upper = self.record, self.name.upper()
        kernel = self.kernels["inverse"]
        meanings = {name: own.meaning for name, own in record.parameters.items()}
        numbers = dimension_numbers(record)
        parameters = [
            f"    double {identifier(name)}; /* {_comment(meanings.get(name, name))} */" for name in numbers
        ] or ["    double none;"]
        values = ", ".join(number_text(value) for value in numbers.values()) or "0.0"
        sizes = {
            "INPUTS": len(record.inputs), "COORDINATES": len(record.platform.pose), "ROWS": len(kernel.outputs["jp"]),
            "MARGINS": max(len(own.outputs["margin"]) for own in self.kernels.values()) or 1,
            "FACTORS": len(kernel.outputs["factor"]) or 1,
            "SIGNS": max(len(self.signs(problem)) for problem in self.problems) or 1,
        }  # fmt: skip
        defines = [f"#define {upper}_{name} {size}" for name, size in sizes.items()]
        defines += [f"#define {upper}_{problem.upper()}_MAX {self.most(problem)}" for problem in self.problems]
        return HEAD.format(
            name=self.name, upper=upper, title=_comment(record.title or record.name), unit=record.unit,
            inputs=", ".join(own.name for own in record.inputs), pose=", ".join(record.platform.pose),
            margins="\n".join([*self._relations(), *self._names()]), defines="\n".join(defines),
            parameters="\n".join(parameters), values=values,
        )  # fmt: skip

    def _relations(self) -> Iterator[str]:
        for text in self.record.closed_form.relations if self.record.closed_form else ():
            yield f" * for dimensions with {_comment(text)} only: with others no loop closes"

    def _names(self) -> Iterator[str]:
        for problem in self.problems:
            margins = self.kernels[problem].margins
            yield f" * margins of the {problem} problem, in their order:"
            yield from (f" *   {own.name}: {_comment(own.meaning)}" for own in margins)
        form = self.record.closed_form
        yield " * factors of det Jp and det Jq, in their order:"
        yield from (
            f" *   {own.name} ({own.kind}): {_comment(own.meaning)}" for own in (form.factor_list if form else ())
        )

    def _problem(self, problem: Problem) -> Iterator[str]:
        if self.roots(problem) > 1 or (problem == "direct" and self.eliminant is not None):
            yield self._coefficients()
            if self._polishes:
                yield self._left_over()
        yield self._branch(problem)
        yield self._solver(problem)

    def _given(self, problem: Problem) -> list[str]:
        """What the program is given, from the array of the problem: an angle as cosine and sine of the joint's."""
        if problem == "inverse":
            own = [(f"given[{k}]", is_angle(name)) for k, name in enumerate(self.record.platform.pose)]
        else:
            own = [
                (_joint_value(f"given[{k}]", driven.sign, driven.offset), driven.coordinate.kind == "angle")
                for k, driven in enumerate(self.record.inputs)
            ]
        texts = [part for text, angle in own for part in ((f"cos({text})", f"sin({text})") if angle else (text,))]
        if problem == "direct" and self.eliminant is not None:
            texts += ["cos(root)", "sin(root)"] if self.eliminant.kind == "angle" else ["root"]
        return texts

    def _uniform(self, kernel: Kernel, problem: Problem) -> list[str]:
        names = self.signs(problem)
        return [
            f"sign[{names.index(name.removeprefix('sign.'))}]" if name.startswith("sign.") else f"p->{identifier(name)}"
            for name in kernel.tape.uniform
        ]

    def _body(self, problem: Problem, entries_of: dict[str, int], targets: dict[str, list[str]]) -> str:
        kernel = self.kernels[problem]
        tape = pruned(kernel.tape.operations, kernel.tape.varying, kernel.tape.uniform, entries_of)
        lines = c99(tape, self._given(problem), self._uniform(kernel, problem), targets)
        return "\n".join(f"    {line}" for line in lines)

    def _coefficients(self) -> str:
        kernel = self.kernels["direct"]
        numbers, entries_of, targets = kernel.numbers.get("coefficient", {}), dict[str, int](), dict[str, list[str]]()
        fixed: list[str] = []
        for k, (name, places) in enumerate(kernel.outputs["coefficient"].items()):
            if name in numbers:
                fixed.append(f"\n    c[{k}] = {number_text(numbers[name])};")
            else:
                entries_of[name], targets[name] = places[0], [f"c[{k}]"]
        body = self._body("direct", entries_of, targets) + "".join(fixed)
        return (
            f"static void {self.name}_coefficients(const {self.name}_parameters *p, const double *given, "
            f"const double *sign, double *c)\n{{\n    const double root = 0.0;\n"
            f"    (void)p; (void)given; (void)sign; (void)root;\n{body}\n}}\n"
        )

    @cached_property
    def _polishes(self) -> bool:
        return self.eliminant is not None and self.eliminant.left_over is not None

    def _left_over(self) -> str:
        kernel, name = self.kernels["direct"], "left over"
        places = {name: kernel.outputs[name][name][0]}
        return LEFT_OVER.format(name=self.name, body=self._body("direct", places, {name: ["value"]}))

    def _branch(self, problem: Problem) -> str:
        kernel, entries_of, targets = self.kernels[problem], dict[str, int](), dict[str, list[str]]()
        after: list[str] = []
        for kind in FILLED:
            for row, (name, entries) in enumerate(kernel.outputs[kind].items()):
                if name in kernel.numbers.get(kind, {}):
                    after.append(f"{self._goals(kind, row, 1)[0]} = {number_text(kernel.numbers[kind][name])};")
                    continue
                for k, (place, goal) in enumerate(zip(entries, self._goals(kind, row, len(entries)), strict=True)):
                    entries_of[f"{kind} {name} {k}"], targets[f"{kind} {name} {k}"] = place, [goal]
                after += self._finish(kind, row, len(entries))
        body = self._body(problem, entries_of, targets)
        finish = "\n".join(f"    {line}" for line in after)
        tests = "\n".join(f"    {line}" for line in self._existence(kernel))
        return (
            f"static int {self.name}_{problem}_one(const {self.name}_parameters *p, const double *given, "
            f"const double *sign, double root, {self.name}_solution *out)\n{{\n"
            f"    double cosine[{self.name.upper()}_INPUTS + {self.name.upper()}_COORDINATES] = {{0.0}}, "
            f"sine[{self.name.upper()}_INPUTS + {self.name.upper()}_COORDINATES] = {{0.0}};\n"
            f"    (void)p; (void)given; (void)sign; (void)root; (void)cosine; (void)sine;\n"
            f"{body}\n{finish}\n{tests}\n    return 1;\n}}\n"
        )

    def _goals(self, kind: str, row: int, count: int) -> list[str]:
        if kind in ("jp", "jq"):
            return [f"out->{kind}[{row}][{k}]" for k in range(count)]
        if count == 2:
            place = row if kind == "input" else len(self.record.inputs) + row
            return [f"cosine[{place}]", f"sine[{place}]"]
        return [f"out->{kind if kind == 'pose' else kind + 's'}[{row}]"]

    def _finish(self, kind: str, row: int, count: int) -> Iterator[str]:
        """Angles from cosine and sine; printed inputs from the joints' values, and their rates."""
        if kind == "pose" and count == 2:
            place = len(self.record.inputs) + row
            yield f"out->pose[{row}] = atan2(sine[{place}], cosine[{place}]);"
        if kind == "input":
            driven = self.record.inputs[row]
            value = f"atan2(sine[{row}], cosine[{row}])" if count == 2 else f"out->inputs[{row}]"
            printed = _printed(value, driven.sign, driven.offset)
            if printed != f"out->inputs[{row}]":
                yield f"out->inputs[{row}] = {printed};"
        if kind == "jq":
            for k, driven in enumerate(self.record.inputs):
                if driven.sign != 1.0:
                    yield f"out->jq[{row}][{k}] = {number_text(driven.sign)} * out->jq[{row}][{k}];"

    def _existence(self, kernel: Kernel) -> Iterator[str]:
        """0 is returned where a radicand is negative, -1 where the formulas degenerate and do not tell."""
        for later in (False, True):
            for k, margin in enumerate(kernel.margins):
                if (margin.zero == "degenerate") == later:
                    own, bound = f"out->margins[{k}]", number_text(tolerance(self.record, margin))
                    test = f"!(fabs({own}) > {bound})) return -1" if later else f"{own} < -{bound}) return 0"
                    yield f"if ({test}; /* {margin.name} */"
        for kind, size in (("inputs", len(self.record.inputs)), ("pose", len(self.record.platform.pose))):
            yield from (f"if (!isfinite(out->{kind}[{k}])) return -1;" for k in range(size))

    def _solver(self, problem: Problem) -> str:
        size = len(self.record.inputs) if problem == "direct" else len(self.record.platform.pose)
        signs = self.signs(problem)
        eliminant = self.eliminant if problem == "direct" else None
        given = "inputs" if problem == "direct" else "pose"
        lines = [
            f"int {self.name}_{problem}(const {self.name}_parameters *p, const double {given}[{size}],",
            f"    {self.name}_solution out[{self.name.upper()}_{problem.upper()}_MAX])",
            "{", "    int count = 0;", f"    double sign[{max(len(signs), 1)}] = {{1.0}};",
            *([f"    double c[{eliminant.roots + 1}], roots[{eliminant.roots}];"] if eliminant else []),
            f"    for (int k = 0; k < {size}; k++)",
            f"        if (!(fabs({given}[k]) <= 1e60)) return {self.name.upper()}_NOT_FINITE;",
            f"    for (int choice = 0; choice < {2 ** len(signs)}; choice++) {{",
            f"        for (int k = 0; k < {len(signs)}; k++)",
            f"            sign[k] = (choice >> ({len(signs) - 1} - k)) & 1 ? -1.0 : 1.0;",
        ]  # fmt: skip
        if not signs:
            del lines[-2:]
        if eliminant is not None:
            angle = int(eliminant.kind == "angle")
            lines += [
                f"        {self.name}_coefficients(p, {given}, sign, c);",
                f"        int real = polynomial_roots(c, {eliminant.roots}, {angle}, roots);",
                f"        if (real == -1) return {self.name.upper()}_VANISHES;",
                f"        if (real < 0) return {self.name.upper()}_UNDECIDED;",
                "        for (int r = 0; r < real; r++) {",
                *([f"            roots[r] = {self.name}_nearer(p, {given}, sign, roots[r]);"] * self._polishes),
                *_filled(self, problem, given, "roots[r]", signs, 12),
                "        }",
            ]  # fmt: skip
        else:
            lines += _filled(self, problem, given, "0.0", signs, 8)
        return "\n".join([*lines, "    }", "    return count;", "}", ""])

    def _self_test(self) -> str:
        asked = [
            _vector(self, problem, given, results)
            for problem in self.problems
            for given, results in answers_about_home(self.record, problem)
        ]
        return SELF_TEST.format(
            name=self.name, upper=self.name.upper(), tests="\n".join(asked),
            scale=number_text(_length(self.record)),
        )  # fmt: skip


def _filled(source: _Source, problem: Problem, given: str, root: str, signs: Sequence[str], indent: int) -> list[str]:
    pad = " " * indent
    lines = [f"int own = {source.name}_{problem}_one(p, {given}, sign, {root}, &out[count]);",
             f"if (own < 0) return {source.name.upper()}_UNDECIDED;", "if (own > 0) {"]  # fmt: skip
    lines += [f"    for (int k = 0; k < {len(signs)}; k++) out[count].signs[k] = (int)sign[k];"] if signs else []
    kept, size = (
        ("inputs", len(source.record.inputs)) if problem == "direct" else ("pose", len(source.record.platform.pose))
    )
    lines += [f"    for (int k = 0; k < {size}; k++) out[count].{kept}[k] = {given}[k];", "    count++;", "}"]
    return [pad + line for line in lines]


def _vector(source: _Source, problem: Problem, given: Any, results: Sequence[Any]) -> str:
    flat = ", ".join(number_text(value) for value in itertools.chain.from_iterable(results)) or "0.0"
    asked = ", ".join(number_text(value) for value in given)
    field = "pose" if problem == "direct" else "inputs"
    names = source.record.platform.pose if problem == "direct" else [own.name for own in source.record.inputs]
    most = f"{source.name.upper()}_{problem.upper()}_MAX"
    size = len(names)
    return (
        f"    {{\n        static {source.name}_solution out[{most}];\n"
        f"        const double given[] = {{{asked}}};\n        const double expected[] = {{{flat}}};\n"
        f"        int count = {source.name}_{problem}(&{source.name}_dimensions, given, out);\n"
        f"        if (count != {len(results)}) wrong++;\n"
        f"        for (int k = 0; k < {len(results)}; k++) {{\n            int met = 0;\n"
        f"            for (int j = 0; j < count; j++) met |= near(out[j].{field}, expected + {size} * k, {size});\n"
        "            if (!met) wrong++;\n        }\n    }"
    )


def _joint_value(text: str, sign: float, offset: float) -> str:
    moved = text if offset == 0.0 else f"({text} - {number_text(offset)})"
    return moved if sign == 1.0 else f"({moved} * {number_text(sign)})"


def _printed(text: str, sign: float, offset: float) -> str:
    turned = text if sign == 1.0 else f"{text} * {number_text(sign)}"
    return turned if offset == 0.0 else f"{turned} + {number_text(offset)}"


def _length(record: MechanismRecord) -> float:
    lengths = [abs(own.value) for own in record.parameters.values() if own.unit == record.unit]
    return float(max([1.0, *lengths]))


def _comment(text: str) -> str:
    return text.replace("*/", "* /").encode("ascii", "replace").decode("ascii")
