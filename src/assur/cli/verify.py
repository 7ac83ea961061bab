"""`assur verify`: a certificate checked by the small verifier, and compared with the mechanism as it is now."""

from __future__ import annotations

import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from assur.cli import exit_codes
from assur.cli.options import PLAIN, Outcome, Plain
from assur.errors import UsageError

if TYPE_CHECKING:
    from assur.model.mechanism import MechanismRecord
    from assur.results.answers.derivation import VerifiedProblem


def verify(
    file: Annotated[str, Parameter(name="FILE", help="What `assur certify` or `assur derive --prove` wrote.")],
    /,
    *,
    mechanism: Annotated[
        str | None, Parameter(help="Name or file of the mechanism; the name in the certificate if left out.")
    ] = None,
    shared: Plain = PLAIN,  # noqa: ARG001  # read by main
) -> Outcome:
    """Check a certificate, or a derivation, with the small verifier.

    A proof cuts the box into parts, and says of each that it is reached all
    over, not reached anywhere, or undecided. The verifier proves every part
    again by ball arithmetic, with exact volumes, and shares no code with what
    made the file; how much is undecided is told. Then the formulas are recorded
    anew from the mechanism's files and compared, and held against the verifier's
    own joint graph of the mechanism's file, exactly: only then it is verified.

    Of a derivation the verifier builds the loop equations from the mechanism's
    file, checks that each step is an identity, exactly, and holds every branch
    against its joint graph modulo a prime: so no branch is missing where the
    conditions hold, which are told.

    The exit code is about the proof, not about what it answers. 0: it holds,
    also where it proves a no; 1: refused, a part or a claim does not hold or it
    is that of another mechanism or version; 3: no whole certificate; 5: it
    holds for the formulas in it, but the mechanism is not at hand, or its closed
    form is Python that only running could tell, so that nobody knows whose they
    are. No code of others is run here.

    For example:
        assur verify cert.json
        assur verify cert.json --mechanism my_mechanism.toml
        assur verify d.json --mechanism my_mechanism.toml
    """
    path = Path(file)
    from assur.results.reading import MOST_CERTIFICATE, file_content
    from assur.verifier.check import verify as checked
    from assur.verifier.derivations.check import is_derivation
    from assur.verifier.reading import MalformedError, RefusedError

    content = file_content(path, MOST_CERTIFICATE, "give a file of `assur certify` or `assur derive --prove`")
    start = time.perf_counter()
    if is_derivation(content):
        return _derivation(path, content, mechanism, start)
    try:
        document = checked(content)
    except MalformedError as error:
        return _refused(path, str(error), exit_codes.BAD_FILE)
    except RefusedError as error:
        return _refused(path, str(error), exit_codes.FAILS)
    seconds = time.perf_counter() - start
    return _compared(path, document, mechanism, seconds)


def _derivation(path: Path, content: bytes, name: str | None, start: float) -> Outcome:
    """What is proved of a derivation, against the file of its mechanism."""
    from assur.cli.output import heading
    from assur.model.registry import file_of, names
    from assur.results.answers.derivation import VerifiedDerivation, VerifiedProblem
    from assur.verifier.derivations.check import left_out_of, problems_of, verify_derivation
    from assur.verifier.reading import MalformedError, RefusedError

    try:
        whose, without = problems_of(content)
        omitted = left_out_of(content)
        if name is None and whose not in names():
            text = "the mechanism is not at hand, say with --mechanism where it is"
            return _refused(path, text, exit_codes.UNDECIDED)
        proved = verify_derivation(content, file_of(name or whose).read_text(encoding="utf-8"))
    except MalformedError as error:
        return _refused(path, str(error), exit_codes.BAD_FILE)
    except RefusedError as error:
        return _refused(path, str(error), exit_codes.FAILS)
    problems = tuple(
        VerifiedProblem(
            own.problem, own.branches, own.conditions, own.assumed, own.ways, own.closed, own.relations, own.unstated
        )
        for own in proved
    )
    answer = VerifiedDerivation(True, whose, problems, without, time.perf_counter() - start)
    shown = [heading(f"verified: {path}"), *map(_proved, problems), *(f"{own}: nothing is proved" for own in without)]
    shown += [f"{problem}: left out: {text}" for problem, texts in omitted.items() for text in texts]
    shown.append(f"identities checked exactly, with a joint graph of its own, in {answer.seconds:.2g} s")
    return Outcome(answer, lambda: shown, exit_codes.UNDECIDED if without else exit_codes.FINE)


def _proved(own: VerifiedProblem) -> str:
    """A derivation that holds, in a sentence."""
    from assur.results.plain_text import count

    where = " and ".join(own.conditions)
    complete = f"complete where {where}" if where else "complete"
    assumed = f"; {' and '.join(own.assumed)} taken to stay parallelograms" if own.assumed else ""
    ways = f"; of two ways to stand one is taken of {' and '.join(own.ways)}" if own.ways else ""
    alone = ", which the file's numbers have and no formula of it states"
    relations = [f"{text}{alone if text in own.unstated else ''}" for text in own.relations]
    related = f"; for dimensions with {' and '.join(relations)}" if relations else ""
    return f"{own.problem}: derivation verified: {count(own.branches, 'branch')}, {complete}{assumed}{ways}{related}"


def _compared(path: Path, document: Mapping[str, Any], mechanism: str | None, seconds: float) -> Outcome:
    """The certificate holds for its formulas; whether they are the mechanism's."""
    from assur.certificates.recorded import at_hand, differences, with_dimensions

    record = at_hand(document, mechanism)
    if record is None:
        return _holds(path, document, None, seconds)
    if record.closed_form_not_run:
        why = f"{record.name}'s closed form is Python beyond formulas, and verify runs no code of others"
        return _holds(path, document, None, seconds, why)
    try:
        record = with_dimensions(document, record)
    except UsageError as error:
        different: tuple[str, ...] = (error.message,)
    else:
        different = differences(document, record)
    if different:
        return _refused(path, f"another mechanism or version: {'; '.join(different)}", exit_codes.FAILS)
    from assur.verifier.closure import closes
    from assur.verifier.reading import RefusedError

    try:
        exact = closes(document, record.file.read_text(encoding="utf-8"))
    except RefusedError as error:
        return _refused(path, str(error), exit_codes.FAILS)
    return _holds(path, document, record, seconds, exact=exact)


def _holds(
    path: Path,
    document: Mapping[str, Any],
    record: MechanismRecord | None,
    seconds: float,
    why_not: str = "the mechanism is not at hand, say with --mechanism where it is",
    exact: Mapping[str, Any] | None = None,
) -> Outcome:
    """It is verified where its formulas are those of the mechanism; anyone can write some for which a claim holds."""
    from assur.certificates.summary import claim_lines, shares, statement_lines
    from assur.cli.output import heading
    from assur.results.answers.certificate import VerifiedCertificate

    lines = [*statement_lines(document, record), *claim_lines(document, record)]
    how = f"checked: every part, proved again by ball arithmetic; the sums, exactly; in {seconds:.2g} s"
    known = {key: document[key] for key in ("kind", "statement", "exact", "claims", "made_by", "sha256")}
    ours = record is not None
    answer = VerifiedCertificate(
        **known,
        shares=shares(document["proof"]),
        verified=True if ours else None,
        mechanism_compared=ours,
        joint_graph=exact,
        seconds=seconds,
    )
    head = "verified" if ours else "holds for its own formulas"
    whose = "the mechanism's, recorded anew" if ours else f"not compared: {why_not}"
    shown = [heading(f"{head}: {path}"), *lines, how, f"formulas: {whose}", *_graph(document, exact)]
    code = exit_codes.of_answers(["yes" if ours else "open"])
    return Outcome(answer, lambda: shown, code)


def _graph(document: Mapping[str, Any], exact: Mapping[str, Any] | None) -> list[str]:
    """What is known of the formulas on the joint graph; only what the verifier found itself counts as checked."""
    from assur.verifier.reading import AT_PLACES

    says = document["exact"]["says"]
    if exact is None:
        not_looked = "" if says == AT_PLACES else "not looked at; the certificate says: "
        return [f"joint graph: {not_looked}{says}"]
    degree = f"degrees up to {exact['degree']:.0f}"
    how = f"repeated with a joint graph of its own, modulo {exact['prime']}, at {exact['places']} places, {degree}"
    return [f"joint graph: {says}", f"  {how}, error {exact['error']:.0e}"]


def _refused(path: Path, why: str, code: int) -> Outcome:
    from assur.cli.output import heading
    from assur.results.answers.certificate import RefusedCertificate

    text = " ".join(why.split())
    return Outcome(RefusedCertificate(False, text), lambda: [heading(f"refused: {path}"), text], code)
