"""`assur topology`: POC sets, freedoms, coupling degree and the rest of a mechanism's topology, derived."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import PLAIN, Outcome, Plain
from assur.errors import UsageError

ENDINGS = (".svg", ".pdf", ".png")


def topology(
    what: Annotated[
        str | None,
        Parameter(name="MECHANISM", help="A name (see `assur list`) or the path of a .toml file; or give --chain."),
    ] = None,
    /,
    *,
    chain: Annotated[
        tuple[str, ...],
        Parameter(name="--chain", metavar="TEXT", help="One limb from base to platform, in quotes. May be repeated."),
    ] = (),
    actuate: Annotated[
        str, Parameter(metavar="LIMB.JOINT,..", help="What is actuated, as 1.1,2.1,3.1, counted from the base.")
    ] = "",
    mode: Annotated[
        str | None,
        Parameter(
            help="translation: the platform keeps its orientation. home: as the chains stand. Or a name of --modes, for"
            " the motion around that mode's example."
        ),
    ] = None,
    modes: Annotated[
        bool, Parameter(help="Also list its operation modes, wherever it can be assembled: met by chance.")
    ] = False,
    improve: Annotated[
        bool,
        Parameter(
            help="Also list neighbours with the same motion that are better in κ, redundancy or decoupling: a joint"
            " relaxed, joints merged, limbs joined, other joints driven."
        ),
    ] = False,
    graph: Annotated[
        str | None, Parameter(metavar="FILE", help="Also draw links and joints into this .svg, .pdf or .png file.")
    ] = None,
    sketch: Annotated[
        str | None,
        Parameter(
            metavar="FILE",
            help="Also draw limbs in space into such a file, joints by their symbols, axes in their directions.",
        ),
    ] = None,
    latex: Annotated[bool, Parameter(help="Print a LaTeX fragment for a paper instead.")] = False,
    ascii_: Annotated[bool, Parameter(name="--ascii", help="Print plain letters and signs only.")] = False,
    shared: Plain = PLAIN,  # noqa: ARG001  # read by main
) -> Outcome:
    r"""Derive a mechanism's topology: POC set, DOF, loops, coupling degree.

    Two routes, which must agree: the rules of POC sets, and the rank of twists
    at random configurations. Where the rules do not hold, it says why.
    A limb is text: P[x] R[x] R[x] R[x], with axes x, y, z or R[0.6,0.8,0];
    U[x,y], S, C[x], P(4R)[y]; U P S leaves axes general; branches of an inner
    loop stand in braces. The shell eats brackets, braces and bars: put every
    chain in quotes.

    For example:
        assur topology zeng2019
        assur topology zeng2019 --graph zeng2019.svg --sketch limbs.svg
        assur topology three_upu --modes
        assur topology three_upu --mode 3R
        assur topology fivebar --improve
        assur topology --chain "R[z] R[z] R[z]" --chain "R[z] R[z]"
        assur topology --chain "P[x] R[x] R[x] R[x]" \
            --chain "P[y] R[y] R[y] R[y]" --chain "P[z] R[z] R[z] R[z]"
        assur topology --chain "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]"
        assur topology --chain "-R|R|R_|_R|R-" --ascii
    """
    from assur.cli import topology_answer
    from assur.cli.paths import output_file
    from assur.derived_topology import operation_modes
    from assur.derived_topology import topology as derive
    from assur.improved_topology import improvements

    graph_path, sketch_path = (None if path is None else output_file(path, ENDINGS) for path in (graph, sketch))
    asked = _asked(what, chain)
    derived = derive(asked, actuate=_actuators(actuate), mode=mode)
    met = operation_modes(asked) if modes else None
    better = improvements(asked, actuate=_actuators(actuate), mode=mode) if improve else None
    also = topology_answer.BesideFacts(graph_path, sketch_path, met, better)
    return topology_answer.outcome(derived, also, latex=latex, ascii_only=ascii_)


def _asked(what: str | None, chain: Sequence[str]) -> str | tuple[str, ...]:
    """A name or chains, never both."""
    if what is not None and chain:
        raise UsageError(f"a mechanism ({what}) and --chain at once", hint="give one of the two")
    if what is not None and ("[" in what or " " in what.strip()):
        raise UsageError(f"'{what}' looks like a chain, not like a name", hint=f'write --chain "{what}"')
    if what is not None:
        return what
    if not chain:
        hint = 'for example: assur topology zeng2019, or assur topology --chain "P[x] R[x] R[x] R[x]"'
        raise UsageError("no mechanism is named and no --chain given", hint=hint)
    return tuple(chain)


def _actuators(text: str) -> tuple[str, ...] | None:
    """The numbers between commas; None where nothing is given.

    >>> _actuators("1.1, 2.3")
    ('1.1', '2.3')
    """
    return tuple(part.strip() for part in text.split(",")) if text.strip() else None
