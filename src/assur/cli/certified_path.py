"""A path that `assur certify` looks for and proves, and how a certificate that was written is told."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from assur.certificates.certificate import Certificate
from assur.certificates.paths import path_certificate
from assur.certificates.summary import claim_lines, shares, statement_lines
from assur.cli import exit_codes
from assur.cli.aspects_answer import ANSWERS, pose
from assur.cli.options import Outcome, Shared
from assur.cli.output import heading
from assur.cli.progress import progress
from assur.cli.region_question import Question
from assur.errors import UsageError
from assur.mechanism import Mechanism
from assur.results.answers.certificate import NoCertificate, WrittenCertificate
from assur.workspace.aspects.aspects import aspects
from assur.workspace.domain import box_of
from assur.workspace.slices import slice_at


@dataclass(frozen=True)
class TypedEnds:
    """Both poses, as typed."""

    start: str
    end: str


def outcome(
    record: Mechanism, asked: Question, ends: TypedEnds, finest: float, most: int, target: Path, shared: Shared
) -> Outcome:
    """The path from one pose to the other, written with its proof; told and not written where none was found."""
    if most < 1:
        raise UsageError(f"--most: {most} leaves; a proof has at least one")
    if not 0 <= finest < 1:
        raise UsageError(
            f"--finest: {finest!r} is no share of the box", hint="0 for the usual size, 1e-3 for a thousandth"
        )
    where = box_of(record, asked.box, slice_at(record, asked.held).free)
    size = {name: finest * (high - low) for name, low, high in zip(where.names, where.low, where.high, strict=True)}
    start, end = pose(record, ends.start, "--from", where.names), pose(record, ends.end, "--to", where.names)
    with progress("aspects", shared) as step:
        found = aspects(record, asked.mode, asked.box, asked.strokes, asked.held, size if finest else None, step)
    if found.stopped == "interrupted":
        raise KeyboardInterrupt  # nothing is kept of a path
    path = found.path(start, end)
    if path.status != "connected":
        return _none(path.status, path.why, exit_codes.of_answers([ANSWERS.get(path.status, "no")]))
    with progress("certify", shared) as step:
        made = path_certificate(record, found, path, most, step)
    if made.claims["regular"] != "yes":
        return _none("undecided", "a box of the path is not proved with so few leaves", exit_codes.UNDECIDED)
    return written(made, target, record, shared)


def written(certificate: Certificate, target: Path, record: Mechanism, shared: Shared) -> Outcome:
    """Write a certificate, and say what it claims; of a box or a path the exit code is that of the answer."""
    with progress("writing the certificate", shared):  # some seconds for millions of leaves
        certificate.write(target)
        document = certificate.to_json()
        first, *rest = [*statement_lines(document, record), *claim_lines(document, record)]
        part = shares(document["proof"])
    lines = [*rest, "how: interval arithmetic, not yet checked by `assur verify`", f"written: {target}"]
    stated = {key: value for key, value in document.items() if key not in ("program", "proof")}
    answer = WrittenCertificate(**stated, shares=part, written=str(target))
    asked = [certificate.claims[name] for name in ("reached", "regular") if name in certificate.claims]
    return Outcome(answer, lambda: [heading(first), *lines], exit_codes.of_answers(asked))


def _none(status: str, why: str, code: int) -> Outcome:
    return Outcome(NoCertificate(status, why), lambda: [heading(f"no path written: {status}"), why], code)
