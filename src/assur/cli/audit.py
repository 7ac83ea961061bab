"""`assur audit`: every printed number of a mechanism's source beside ours."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared


def audit(
    mechanism: MechanismName,
    /,
    *,
    documents: Annotated[
        str | None, Parameter(metavar="DIR", help="Also write ERRATA.md and CONFORMANCE.md into this folder.")
    ] = None,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """Check every printed number of the source against ours.

    For each row: ok, wrong or missing, with the erratum that explains it. What
    counts as equal comes from the digits that are printed. Exit code 0 also
    where the source is wrong; 1 where the evidence of one of our errata fails.

    For example:
        assur audit zeng2019
        assur audit zeng2019 --documents . --json
    """
    record = shared.mechanism(mechanism)
    from assur.cli import auditing
    from assur.cli.paths import planned_folder

    folder = planned_folder(documents) if documents is not None else None
    return auditing.outcome(record, folder, shared)
