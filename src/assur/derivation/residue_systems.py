"""Systems of polynomials modulo a prime, and how many solutions they have: the monomials under a Groebner basis.

msolve counts where it is on the PATH, in a process of its own: it is called, never linked. Else linear algebra does,
and where matrices would be too large SymPy, in a process that is stopped when its time is over: that of the processor,
so that what is counted does not depend on what else runs. Run as a module, this counts the solutions of the system on
its standard input, or finds its leading monomials.
"""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from pathlib import Path
from typing import Any

import sympy

from assur.derivation.normal_forms import solutions
from assur.derivation.witness import ModularWitness

Monomial = tuple[int, ...]
Polynomial = Mapping[Monomial, int]
"""Powers of the unknowns -> coefficient, below the prime."""
MOST = 100_000
"""Monomials that are counted; more solutions are not told apart from infinitely many."""
PATIENCE = 20
"""Seconds by the clock for each of the processor, where others want it too."""


@dataclass(frozen=True)
class ResidueSystem:
    """Polynomials in some unknowns, modulo a prime; if `even`, a solution and its negative are counted as one."""

    prime: int
    unknowns: int
    polynomials: tuple[Polynomial, ...]
    even: bool = False

    def reduced(self) -> ResidueSystem:
        """The same solutions in fewer unknowns: those are left out that linear equations say.

        >>> ResidueSystem(7, 2, ({(1, 0): 1, (0, 1): 6}, {(2, 0): 1, (0, 1): 1, (0, 0): 6})).reduced().polynomials
        ({(2,): 1, (1,): 1, (0,): 6},)
        """
        left = [dict(own) for own in self.polynomials]
        gone = list[int]()
        while (linear := next((own for own in left if max(map(sum, own), default=0) == 1), None)) is not None:
            left.remove(linear)
            place = next(k for powers in linear for k in range(self.unknowns) if powers[k])
            unit = tuple(int(k == place) for k in range(self.unknowns))
            factor = -pow(linear[unit], -1, self.prime)
            value = {powers: part * factor % self.prime for powers, part in linear.items() if powers != unit}
            left = [own for own in (self._replaced(other, place, value) for other in left) if own]
            gone.append(place)
        kept = [k for k in range(self.unknowns) if k not in gone]
        shorter = tuple({tuple(powers[k] for k in kept): part for powers, part in own.items()} for own in left)
        return replace(self, unknowns=len(kept), polynomials=shorter)

    def _replaced(self, own: Polynomial, place: int, value: Polynomial) -> dict[Monomial, int]:
        total: dict[Monomial, int] = {}
        for powers, part in own.items():
            terms: dict[Monomial, int] = {(*powers[:place], 0, *powers[place + 1 :]): part}
            for _ in range(powers[place]):
                terms = self._product(terms, value)
            for key, factor in terms.items():
                total[key] = (total.get(key, 0) + factor) % self.prime
        return {key: factor for key, factor in total.items() if factor}

    def _product(self, first: Polynomial, second: Polynomial) -> dict[Monomial, int]:
        total: dict[Monomial, int] = {}
        for a, x in first.items():
            for b, y in second.items():
                key = tuple(p + q for p, q in zip(a, b, strict=True))
                total[key] = (total.get(key, 0) + x * y) % self.prime
        return total

    def count(self, seconds: float) -> tuple[int | None, str]:
        """How many solutions there are, with their multiplicities, and by which program.

        None: infinitely many. Errors: TimeoutError.

        >>> ResidueSystem(7, 1, ({(2,): 1, (0,): 6},)).count(60.0)[0]
        2
        """
        own = self.reduced()
        if own._trivial or shutil.which("msolve"):
            leading, program = own._leading_monomials(seconds)
            return _paired(staircase(leading, own.unknowns), own.even), program
        try:
            number, program = own._in_process("count", seconds)
        except subprocess.TimeoutExpired as error:
            raise TimeoutError(f"not counted in {seconds:g} s") from error
        return number, program

    def dimension(self, seconds: float) -> int:
        """How many unknowns may be chosen: 0 where there are finitely many solutions, -1 where there are none.

        Errors:
            TimeoutError.

        >>> ResidueSystem(7, 2, ({(1, 1): 1},)).dimension(60.0)
        1
        """
        own = self.reduced()
        leading, _ = own._leading_monomials(seconds)
        chosen = (set(some) for size in range(own.unknowns, -1, -1) for some in combinations(range(own.unknowns), size))
        free = (some for some in chosen if not any(_within(powers, some) for powers in leading))
        return len(next(free, ())) - any(not any(powers) for powers in leading)

    @property
    def _trivial(self) -> bool:
        """Whether nothing is left, or a number that vanishes."""
        return not any(self.polynomials) or any(own and not any(map(any, own)) for own in self.polynomials)

    def _leading_monomials(self, seconds: float) -> tuple[list[Monomial], str]:
        """Those of a Groebner basis, and by which program. Errors: TimeoutError."""
        if self._trivial:
            return [(0,) * self.unknowns] if any(self.polynomials) else [], "linear equations"
        program = shutil.which("msolve")
        try:
            return (self._by_msolve(program, seconds), "msolve") if program else (self._by_sympy(seconds), "sympy")
        except subprocess.TimeoutExpired as error:
            raise TimeoutError(f"not counted in {seconds:g} s") from error

    def _by_msolve(self, program: str, seconds: float) -> list[Monomial]:
        names = [f"x{k}" for k in range(1, self.unknowns + 1)]
        with tempfile.TemporaryDirectory() as folder:
            given, answer = Path(folder, "in.ms"), Path(folder, "out.ms")
            given.write_text(f"{','.join(names)}\n{self.prime}\n{_joined(self.polynomials, names)}\n", encoding="ascii")
            words = [program, "-g", "1", "-t", "1", "-f", str(given), "-o", str(answer)]
            run = _run(words, seconds)
            text = answer.read_text(encoding="ascii") if answer.is_file() else ""
        found = re.search(r"\[([^\]]*)\]", text)
        if run.returncode != 0 or found is None:
            return self._by_sympy(seconds)
        return [_monomial(part, names) for part in found[1].split(",")]

    def _by_sympy(self, seconds: float) -> list[Monomial]:
        return [tuple(powers) for powers in self._in_process("leading", seconds)]

    def _in_process(self, what: str, seconds: float) -> Any:
        """The answer of a process that can be stopped. Errors: TimeoutExpired."""
        data = [
            self.prime,
            self.unknowns,
            [[[list(powers), part] for powers, part in own.items()] for own in self.polynomials],
            self.even,
        ]
        words = [sys.executable, "-m", "assur.derivation.residue_systems", what]
        run = _run(words, seconds, json.dumps(data))
        run.check_returncode()
        return json.loads(run.stdout)


def _run(words: Sequence[str], seconds: float, text: str = "") -> subprocess.CompletedProcess[str]:
    """A process with so much time of the processor; where there is none such limit, by the clock.

    Errors:
        TimeoutExpired.
    """
    limited = os.name == "posix"
    if limited:
        words = ["sh", "-c", f'ulimit -t {math.ceil(seconds)}; exec "$@"', "sh", *words]
    wait = PATIENCE * seconds if limited else seconds
    alone = os.environ | {"OPENBLAS_NUM_THREADS": "1"}  # threads that wait for each other take time of the processor
    run = subprocess.run(words, input=text, timeout=wait, check=False, capture_output=True, text=True, env=alone)
    if limited and -run.returncode in (signal.SIGXCPU, signal.SIGKILL):  # which the limit sends
        raise subprocess.TimeoutExpired(words, seconds)
    return run


def residue_system(
    equations: Sequence[sympy.Expr], unknowns: Sequence[sympy.Symbol], witness: ModularWitness
) -> ResidueSystem | None:
    """Equations at a witness; None where a coefficient is no residue, but one times the root of -1."""
    polynomials = []
    for equation in equations:
        polynomial = {}
        for powers, part in sympy.Poly(sympy.expand(equation), *unknowns).terms():
            real, imaginary = witness.value(part)
            if imaginary:
                return None
            if real:
                polynomial[tuple(map(int, powers))] = real
        polynomials.append(polynomial)
    return ResidueSystem(witness.field.p, len(unknowns), tuple(own for own in polynomials if own))


def _within(powers: Monomial, chosen: Collection[int]) -> bool:
    """Whether a monomial is one of some unknowns alone."""
    return all(k in chosen for k, power in enumerate(powers) if power)


def _joined(polynomials: Sequence[Polynomial], names: Sequence[str]) -> str:
    """Polynomials as msolve reads them."""

    def term(powers: Monomial, part: int) -> str:
        return "*".join([str(part), *(f"{name}^{power}" for name, power in zip(names, powers, strict=True) if power)])

    return ",\n".join("+".join(term(*item) for item in own.items()) for own in polynomials)


def _monomial(text: str, names: Sequence[str]) -> Monomial:
    """A leading monomial as msolve writes it.

    >>> _monomial("x1^1*x3^2", ["x1", "x2", "x3"]), _monomial("1", ["x1"])
    ((1, 0, 2), (0,))
    """
    powers = {name: int(power) for name, power in re.findall(r"(x\d+)\^(\d+)", text)}
    return tuple(powers.get(name, 0) for name in names)


def staircase(leading: Sequence[Monomial], unknowns: int) -> int | None:
    """How many monomials no leading one divides; None where there are infinitely many.

    >>> staircase([(1, 1), (2, 0), (0, 3)], 2), staircase([(1, 1), (2, 0)], 2), staircase([(0, 0)], 2)
    (4, None, 0)
    """
    pure = [min((own[k] for own in leading if sum(own) == own[k]), default=None) for k in range(unknowns)]
    if any(own is None for own in pure):
        return None
    return sum(1 for _ in _under([*leading], unknowns, ()))


def _under(leading: Sequence[Monomial], unknowns: int, powers: Monomial) -> Iterator[Monomial]:
    """Monomials that begin with some powers and are not divided."""
    place = len(powers)
    if any(all(a <= b for a, b in zip(own, powers, strict=False)) and not any(own[place:]) for own in leading):
        return
    if place == unknowns:
        yield powers
        return
    for power in range(MOST):
        before = False
        for own in _under(leading, unknowns, (*powers, power)):
            before = True
            yield own
        if not before:
            return


def _paired(count: int | None, even: bool) -> int | None:
    """A count, of solutions and their negatives together where these come in pairs."""
    return count // 2 if even and count is not None else count


Written = Sequence[Sequence[tuple[Sequence[int], int]]]
"""Polynomials as lists of powers and coefficients, as JSON has them."""


def _leading(prime: int, unknowns: int, polynomials: Written, _even: bool = False) -> list[Monomial]:
    """Leading monomials of a Groebner basis, by SymPy."""
    from sympy import GF
    from sympy.polys.groebnertools import groebner
    from sympy.polys.orderings import grevlex
    from sympy.polys.rings import ring

    own, *_unknowns = ring([f"x{k}" for k in range(unknowns)], GF(prime), grevlex)
    given = [own.from_dict({tuple(powers): GF(prime)(part) for powers, part in parts}) for parts in polynomials]
    return [tuple(polynomial.LM) for polynomial in groebner(given, own)]


def _count(prime: int, unknowns: int, polynomials: Written, even: bool = False) -> tuple[int | None, str]:
    """How many solutions, and by what: linear algebra, else what stands under SymPy's Groebner basis."""
    given = [{tuple(powers): part for powers, part in own} for own in polynomials]
    if (count := solutions(prime, unknowns, given, even=even)) is not None:
        return count, "linear algebra"
    return _paired(staircase(_leading(prime, unknowns, polynomials, even), unknowns), even), "sympy"


if __name__ == "__main__":
    answers: Mapping[str, Callable[..., object]] = {"count": _count, "leading": _leading}
    sys.stdout.write(json.dumps(answers[sys.argv[1]](*json.loads(sys.stdin.read()))))
