"""`assur new`: a mechanism's file to begin with, from the catalogue or from chains in notation."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from assur.cli.called import called
from assur.cli.numbers import whole_number
from assur.cli.options import PLAIN, Outcome, Plain
from assur.cli.output import heading
from assur.errors import OutputError, UnknownNameError, UsageError
from assur.results.plain_text import count as plural

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.results.answers.files import WrittenMechanism
    from assur.synthesis.drafting.copying import Copied
    from assur.topology.analysis import Mode
    from assur.topology.chains import Chain

CLOSED_FORM = "closed_form.py"
MODES: dict[str, Mode] = {"home": "home", "translation": "translation"}
LIMBS = "3"
OTHERS = 3
"""So many files that are in the way are named."""


def new(
    file: Annotated[str, Parameter(name="FILE", help="The .toml file to write; its name is the mechanism's.")],
    shorthand: Annotated[
        str, Parameter(name="SHORTHAND", help="Draft a mechanism as papers name it: 3-RPS, 2UPR-RPU, Delta.")
    ] = "",
    arrangement: Annotated[
        str, Parameter(name="ARRANGEMENT", help="How its axes lie, where the shorthand leaves several: planar.")
    ] = "",
    /,
    *,
    from_: Annotated[
        str, Parameter(name="--from", metavar="NAME", help="Copy a mechanism of the catalogue (see `assur list`).")
    ] = "",
    chain: Annotated[
        tuple[str, ...],
        Parameter(name="--chain", metavar="TEXT", help="One limb from base to platform, in quotes. May be repeated."),
    ] = (),
    limb: Annotated[
        tuple[str, ...],
        Parameter(
            name="--limb",
            metavar="TEXT",
            allow_leading_hyphen=True,
            help="One limb, in quotes, repeated evenly about z.",
        ),
    ] = (),
    count: Annotated[str, Parameter(metavar="N", help="How often --limb is there; 3 if left out.")] = "",
    actuate: Annotated[
        str, Parameter(metavar="LIMB.JOINT,..", help="What is actuated, as 1.1,2.1,3.1, counted from the base.")
    ] = "",
    mode: Annotated[
        str, Parameter(help="translation: the platform keeps its orientation. home: as the chains stand.")
    ] = "",
    coordinates: Annotated[
        bool, Parameter(help="Of a draft: parameters are where joints are at home, not lengths.")
    ] = False,
    force: Annotated[bool, Parameter(help="Replace the file if it is there.")] = False,
    with_closed_form: Annotated[bool, Parameter(help="With --from: copy its closed form, a Python file, too.")] = False,
    derive: Annotated[
        bool, Parameter(negative=(), help="Derive its closed form too, and write it beside, as closed_form.py.")
    ] = False,
    shared: Plain = PLAIN,  # read by main
) -> Outcome:
    r"""Write a mechanism's file to begin with: a copy, or a draft of chains.

    Shorthand means a standard arrangement of axes, which is printed in full;
    where there are several, or none, they are listed. An underlined joint, or
    one between low lines, is driven: 3-_R_PS. Pa is a parallelogram, Pa(4S) one
    with ball joints.

    A draft needs no dimensions. It gets default ones, link lengths l, offsets
    e, radii and angles; with --coordinates the places of joints at home, and
    then its loops close there whatever these are. Limbs that are turns of one
    another about z become one template. Axes with one label (R[x]@O) meet in
    one point, also those of different limbs; --limb gives each limb its own,
    unless all its axes run through it. The file is sound and has the topology
    of the chains: where that cannot be had, it says so and writes nothing. For
    the notation of chains see `assur topology --help`.

    For example:
        assur new my.toml --from delta_4s
        assur new my.toml 3-RPS
        assur new my.toml 3-RRR spherical
        assur new my.toml "3UPS&UP"
        assur new my.toml "3-_R_Pa(4S)"
        assur new my.toml --limb "R[z] R[z] R[z]" --count 3
        assur new my.toml --limb "U P S" --count 6
        assur new my.toml --limb "R[z]@O R[0.8,0,0.6]@O R[0,0.8,0.6]@O"
        assur new my.toml --chain "R[z] R[z] R[z]" --chain "R[z] R[z]"
        assur new my.toml --chain "{P[y] R[x] R[x] | P[y] R[x] R[x]} R[y] R[y]" \
            --chain "P[y] P(4R)[y] P(4R)[x]"
    """
    path = _target(file, force=force)
    if derive and with_closed_form:
        raise UsageError("--derive and --with-closed-form both write closed_form.py", hint="leave one of them out")
    if derive:
        _refuse_others(path)
    made = _made(
        path, shorthand, arrangement, from_, chain, limb, count, actuate, mode, with_closed_form, coordinates, force
    )
    return _with_derived(path, made, shared) if derive else made


def _made(
    path: Path,
    shorthand: str,
    arrangement: str,
    from_: str,
    chain: Sequence[str],
    limb: Sequence[str],
    count: str,
    actuate: str,
    mode: str,
    with_closed_form: bool,
    coordinates: bool,
    force: bool,
) -> Outcome:
    """The file in one of the ways."""
    if from_ and not chain and not limb and not shorthand:
        _refuse_options(path, {"--count": count, "--actuate": actuate, "--mode": mode})
        return _from_catalogue(from_, path, force=force, with_closed_form=with_closed_form, coordinates=coordinates)
    if with_closed_form:
        raise UsageError("--with-closed-form goes with --from; a draft has no closed form", hint="leave it out")
    if shorthand and not from_ and not chain and not limb:
        _refuse_options(path, {"--count": count})
        return _arranged(shorthand, arrangement, path, actuate, mode, coordinates=coordinates)
    chains = _chains(path, from_, chain, limb, count, shorthand)
    return _draft(chains, path, actuate, mode, coordinates=coordinates)


def _arranged(shorthand: str, name: str, path: Path, actuate: str, mode: str, *, coordinates: bool) -> Outcome:
    from assur.synthesis.shorthand.arrangements import arranged

    meant = arranged(shorthand, name)
    said = (f"{meant.shown}: {meant.says}; in full:", f"    {meant.options}")
    driven = actuate or ",".join(meant.actuate)
    return _draft(meant.chains, path, driven, mode or meant.mode, said, coordinates=coordinates)


def _from_catalogue(name: str, path: Path, *, force: bool, with_closed_form: bool, coordinates: bool) -> Outcome:
    from assur.model.topologies import load_topology
    from assur.synthesis.drafting.copying import copied, has_dimensions, in_catalogue

    model = in_catalogue(name)
    if has_dimensions(model):
        if coordinates:
            raise UsageError(f"--coordinates goes with a draft; {model} has dimensions", hint="leave it out")
        return _written_copy(copied(model, path), path, force=force, with_closed_form=with_closed_form)
    described = load_topology(model)
    numbers = ",".join(f"{limb}.{joint}" for limb, joint in described.actuate)
    return _draft(described.chains, path, numbers, described.mode, coordinates=coordinates)


def _draft(
    chains: Sequence[Chain], path: Path, actuate: str, mode: str, read: Sequence[str] = (), *, coordinates: bool
) -> Outcome:
    from assur.results.files import write_whole
    from assur.synthesis.drafting.drafting import drafted

    _refuse_neighbour(path, replaced=False)
    numbers = tuple(part.strip() for part in actuate.split(",")) if actuate.strip() else None
    if mode and mode not in MODES:
        raise UnknownNameError("mode", mode, MODES)
    found = drafted(chains, path, actuate=numbers, mode=MODES[mode or "home"], coordinates=coordinates)
    topology = found.topology
    freedoms = plural(topology.dof - topology.internal_freedoms, "degree")
    said = [
        *read,
        f"drafted from {plural(len(chains), 'limb')}: {topology.poc}, {freedoms} of freedom, "
        f"{topology.coupling_words}; checked: it is sound, and this is its topology",
        *found.notes,
    ]
    return _outcome(path, [str(write_whole(path, found.text))], said)


def _written_copy(copy: Copied, path: Path, *, force: bool, with_closed_form: bool) -> Outcome:
    from assur.results.files import write_whole

    wanted = with_closed_form and copy.closed_form is not None
    _refuse_neighbour(path, replaced=wanted and force)
    if wanted:
        _refuse_others(path)
    files = [str(write_whole(path, copy.text))]
    if wanted and copy.closed_form is not None:
        files.append(str(write_whole(path.parent / CLOSED_FORM, copy.closed_form.read_bytes())))
    said = [f"copied from {copy.model} of the catalogue"]
    if copy.closed_form is None:
        said.append(f"{copy.model} has no closed form")
    elif wanted:
        said += [
            f"its closed form stands beside it, in {CLOSED_FORM}; it holds as long as only numbers are changed",
            "a radicand, a divisor or a margin that you change in it must stay declared as docs/closed-form.md says",
        ]
    else:
        said.append(
            "its closed form stays behind, so that the new file is solved on its joint graph; "
            "--with-closed-form copies it"
        )
    return _outcome(path, files, said)


def _chains(
    path: Path, from_: str, chain: Sequence[str], limb: Sequence[str], count: str, shorthand: str
) -> Sequence[Chain]:
    """The chains that were given in exactly one of the ways."""
    from assur.synthesis.drafting.repeating import repeated
    from assur.topology.notation import parse_chains

    ways = (("a shorthand", shorthand), ("--from", from_), ("--chain", chain), ("--limb", limb))
    given = [name for name, value in ways if value]
    if len(given) != 1:
        found = " and ".join(given) if given else "nothing to begin with"
        hint = f'for example: assur new {path} 3-RPS, or assur new {path} --limb "R[z] R[z] R[z]" --count 3'
        raise UsageError(f"{found}; give a shorthand or one of --from, --chain and --limb", hint=hint)
    if len(limb) > 1:
        each = " ".join(f'--chain "{text}"' for text in limb)
        hint = f"limbs that differ are chains: assur new {path} {each}"
        raise UsageError(f"--limb is given {len(limb)} times; it is one limb, repeated about z", hint=hint)
    if limb:
        return repeated(limb[0], whole_number(count or LIMBS, "--count"))
    _refuse_options(path, {"--count": count}, "--limb")
    return parse_chains(chain)


def _refuse_options(path: Path, given: dict[str, str], which: str = "--limb") -> None:
    """Options that say nothing here."""
    for name, value in given.items():
        if value:
            raise UsageError(f"{name} goes with {which}", hint=f"leave it out: assur new {path} ...")


def _target(file: str, *, force: bool) -> Path:
    """The path to write; nothing is changed."""
    from assur.synthesis.drafting.copying import mechanism_name

    if not file.strip():
        raise OutputError("cannot write to an empty name", hint="name the file, as assur new my.toml ...")
    path = Path(file)
    mechanism_name(path)
    if path.is_dir():
        raise OutputError(f"cannot write {path}: it is a folder", hint="give the name of a file")
    if not path.parent.is_dir():
        raise OutputError(f"cannot write {path}: the folder {path.parent} does not exist", hint="make it first")
    if os.path.lexists(path) and not force:
        raise OutputError(f"{path} is there already", hint="choose another name, or replace it with --force")
    return path


def _refuse_neighbour(path: Path, *, replaced: bool) -> None:
    """A closed form beside a mechanism's file is taken for its own, so that there must be none of another."""
    beside = path.parent / CLOSED_FORM
    if os.path.lexists(beside) and not replaced:
        raise OutputError(
            f"{beside} is there already, and would be read as the closed form of {path.name}",
            hint="choose another folder",
        )


def _refuse_others(path: Path) -> None:
    """A closed form is read with every mechanism's file of its folder, so that it stands with one alone."""
    others = sorted(item.name for item in path.parent.glob("*.toml") if item.name != path.name)
    if others:
        more = f" and {len(others) - OTHERS} more" if len(others) > OTHERS else ""
        stand = "stands" if len(others) == 1 else "stand"
        raise OutputError(
            f"{', '.join(others[:OTHERS])}{more} {stand} in the folder of {path}, "
            f"and would be read with the closed form of {path.name}",
            hint=f"give it a folder of its own, made first, as {path.parent / path.stem / path.name}",
        )


def _with_derived(path: Path, made: Outcome, shared: Plain) -> Outcome:
    """The same with the closed form that was derived, or with the reason why there is none."""
    from assur.cli import exit_codes
    from assur.cli.progress import progress
    from assur.derivation.kept import derived_closed_form
    from assur.derivation.not_derived import NotDerivedError
    from assur.model.registry import load_record
    from assur.results.answers.files import WrittenMechanism
    from assur.results.files import write_whole

    draft = made.data
    if not isinstance(draft, WrittenMechanism):
        return made
    try:
        with progress(f"deriving {path.stem}", shared):
            text = derived_closed_form(load_record(path))
    except NotDerivedError as error:
        notes = (*draft.notes, f"no closed form was derived: {error}")
        return _outcome(path, draft.files, notes, exit_codes.UNDECIDED)
    beside = str(write_whole(path.parent / CLOSED_FORM, text))
    notes = (*draft.notes, "its closed form was derived, and agrees with its joint graph")
    return _outcome(path, (*draft.files, beside), notes)


def _outcome(path: Path, files: Sequence[str], said: Sequence[str], code: int = 0) -> Outcome:
    from assur.results.answers.files import WrittenMechanism

    data = WrittenMechanism(path.stem, tuple(files), tuple(said))
    return Outcome(data, lambda: _shown(path, data), exit_code=code)


def _shown(path: Path, data: WrittenMechanism) -> Iterable[RenderableType]:
    from rich.text import Text

    yield heading(f"wrote {' and '.join(data.files)}")
    yield from map(Text, data.notes)
    yield Text(f"next: {called()} check {path}")
