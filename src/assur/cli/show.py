"""`assur show`: one mechanism, as its file says and as its joint graph counts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from assur.cli.options import SHARED_DEFAULTS, MechanismName, Outcome, Shared
from assur.cli.output import heading, table
from assur.results.plain_text import count, tiny

if TYPE_CHECKING:
    from rich.console import RenderableType

    from assur.kinematics.answers.style import Style
    from assur.kinematics.modes import Problem
    from assur.mechanism import Mechanism
    from assur.results.answers.catalogue import MechanismAnswer, ShownClosedForm, ShownJoint, ShownModes


def show(
    mechanism: MechanismName,
    /,
    *,
    masses: Annotated[
        bool, Parameter(help="What links weigh instead: mass, centre, inertia of each, and where they come from.")
    ] = False,
    shared: Shared = SHARED_DEFAULTS,
) -> Outcome:
    """One mechanism: dimensions, joints, inputs, modes, mobility.

    Mobility is that of the whole joint graph by the rank of its closure at the
    assembled home configuration, nothing collapsed.

    For example:
        assur show zeng2019
        assur show ./my.toml --set l2=300 --json
        assur show ./my.toml --masses
    """
    record = shared.mechanism(mechanism)
    if masses:
        from assur.cli import weighed

        return weighed.outcome(record)
    from assur.kinematics.answers.style import style_of

    data = description(record)
    return Outcome(data, lambda: _shown(record, data, style_of(record)))


def description(record: Mechanism) -> MechanismAnswer:
    """The mechanism, with angles in its angle unit."""
    from assur.kinematics.answers.at_border import angle_at_border
    from assur.kinematics.closure import closure_error
    from assur.kinematics.modes import written_quantities
    from assur.model.pose import is_angle
    from assur.results.answers.catalogue import (
        MechanismAnswer,
        ShownClosedForm,
        ShownHome,
        ShownInput,
        ShownJoint,
        ShownLink,
        ShownMobility,
        ShownModes,
        ShownParameter,
    )

    home = record.home_values
    free = record.mobility(home)
    internal = int(record.instantaneous(home).ranks.internal)
    form = record.closed_form
    at_home = [
        float(angle_at_border(record, home[item.index]) if item.kind == "angle" else home[item.index])
        for item in record.coordinates
    ]
    low_high = {name: angle_at_border(record, pair) if is_angle(name) else pair for name, pair in record.box.items()}
    return MechanismAnswer(
        mechanism=record.name,
        title=record.title,
        source=record.source,
        file=str(record.file),
        unit=record.unit,
        angle=record.angle,
        coordinates=record.platform.pose,
        orientation=record.platform.orientation,
        platform=record.platform.link,
        base=record.base,
        parameters=tuple(
            ShownParameter(item.name, item.value, item.unit, item.meaning, item.sign)
            for item in record.parameters.values()
        ),
        links=tuple(ShownLink(item.name, item.meaning) for item in record.links.values()),
        joints=tuple(
            ShownJoint(item.name, item.alias, item.type.name, item.type.kinds, item.parent, item.child)
            for item in record.joints.values()
        ),
        inputs=tuple(
            ShownInput(item.name, item.coordinate.joint, item.coordinate.kind, item in record.redundant_inputs)
            for item in record.drives
        ),
        modes=ShownModes(
            {name: formula.text for name, formula in written_quantities(record, "inverse").items()},
            {name: formula.text for name, formula in written_quantities(record, "direct").items()},
            record.modes.of_file.default_working,
            record.modes.of_file.default_assembly,
        ),
        box={name: list(map(float, pair)) for name, pair in low_high.items()},
        home=ShownHome(
            {name: [at_home[item.index] for item in record.joint_coordinates(name)] for name in record.joints},
            _platform_point(record, home),
            float(closure_error(record, home)),
        ),
        mobility=ShownMobility(int(free.freedoms) - internal, internal, int(free.rank), int(free.redundant)),
        closed_form_not_run=record.closed_form_not_run,
        closed_form=None if form is None else ShownClosedForm(form.complete_for, form.reduced_because),
    )


def _spins(internal: int) -> str:
    """Freedoms that move neither inputs nor platform."""
    return f", and {count(internal, 'internal freedom')}" if internal else ""


def _platform_point(record: Mechanism, home: Any) -> list[float]:
    rotation, origin = record.frames(home)[record.platform.link]
    return [float(value) for value in rotation @ record.platform.point + origin]


def _shown(record: Mechanism, data: MechanismAnswer, style: Style) -> Iterable[RenderableType]:
    free, form, home = data.mobility, data.closed_form, data.home
    yield heading(f"{data.mechanism}: {data.title}")
    yield f"source   {data.source or 'not stated'}"
    yield f"file     {data.file}"
    yield f"units    {data.unit}, {data.angle}"
    yield f"pose     {', '.join(data.coordinates)} of link '{data.platform}', orientation {data.orientation}"
    inputs = (f"{item.name} ({item.joint}{', redundant' * item.redundant})" for item in data.inputs)
    yield f"inputs   {', '.join(inputs)}"
    yield (
        f"mobility F = {free.freedoms}{_spins(free.internal)}: "
        f"{count(len(data.joints), 'joint')}, {count(len(data.links), 'link')}, "
        f"rank {free.rank} of the closure of the whole joint graph, "
        f"{count(free.redundant, 'redundant constraint')}"
    )
    yield _form_line(form, data.closed_form_not_run)
    yield ""
    yield table(
        ("dimension", "value", "unit", "meaning"),
        [(item.name, f"{item.value:.10g}", item.unit, item.meaning) for item in data.parameters],
        left=("dimension", "unit", "meaning"),
    )
    yield ""
    yield table(
        ("joint", "type", "from", "to", f"at home [{style.unit}, {style.angle}]"),
        [_joint_row(item, home.joints, style) for item in data.joints],
        left=("joint", "type", "from", "to"),
    )
    point = ", ".join(style.number(value, angle=False) for value in home.platform_point)
    yield f"home: platform point at ({point}) {style.unit}, loops closed to {tiny(home.residual)} {style.unit}"
    yield ""
    yield from _modes(data.modes)
    yield from _signs(record)
    for name, (low, high) in data.box.items():
        yield f"box: {name} from {low:g} to {high:g} {style.coordinate_unit(name)}"


NOT_RUN = "what stands beside the file is Python beyond formulas, and was not run"


def _form_line(form: ShownClosedForm | None, not_run: bool) -> str:
    if form is None:
        return f"closed   {'not read: ' + NOT_RUN if not_run else 'no closed form: none beside the file'}"
    because = f" ({form.reduced_because})" if form.reduced_because else ""
    return f"closed   closed form, complete for the {form.complete_for.replace('_', ' ')} model{because}"


def _joint_row(joint: ShownJoint, home: Mapping[str, Sequence[float]], style: Style) -> tuple[str, ...]:
    alias = f"{joint.name} ({joint.alias})" if joint.alias else joint.name
    values = [style.kind(kind, value) for kind, value in zip(joint.kinds, home[joint.name], strict=True)]
    return alias, joint.type, joint.parent, joint.child, " ".join(values)


def _modes(modes: ShownModes) -> Iterable[RenderableType]:
    for problem, named, default in (
        ("working", modes.working, modes.default_working),
        ("assembly", modes.assembly, modes.default_assembly),
    ):
        signs = ", ".join(f"{name} = sign of {text}" for name, text in named.items())
        if signs:
            yield f"{problem} mode: {signs}; default {default}"


def _signs(record: Mechanism) -> Iterable[RenderableType]:
    """The signs that the joint graph gives to modes for which the file names no quantities, and what each + means."""
    nameless: list[tuple[Problem, str]] = []
    if not record.modes.of_file.working:
        nameless.append(("inverse", "working"))
    if not record.modes.of_file.assembly:
        nameless.append(("direct", "assembly"))
    for problem, kind in nameless:
        from assur.kinematics.naming import described_signs  # which names in a file do without

        if signs := described_signs(record, problem):
            yield f"{kind} mode: the signs of {', '.join(sign.name for sign in signs)}"
            yield from (f"  {sign.said}" for sign in signs)
