"""The mechanism: what it is made of, its dimensions, its inputs."""

from __future__ import annotations

from assur.errors import UsageError
from assur.joint_graph.tree import joint_graph
from assur.kinematics.answers.at_border import angle_at_border
from assur.model.mechanism import Input, Joint, MechanismRecord
from assur.report.findings import Findings
from assur.report.formulas.latex import symbol_mathml
from assur.report.formulas.mathml import inline, named_formula
from assur.results.kinds import EXACT, PrintedFormula, Result, Scalar, Section, Table
from assur.results.plain_text import count
from assur.results.typeset_text import short, shown_unit


def description(findings: Findings) -> Section:
    """Facts, dimensions, inputs, links and joints."""
    record = findings.record
    results: list[Result] = [*_counts(findings)]
    results += [_parameters(record), _inputs(record)] if record.parameters else [_inputs(record)]
    results += [_joints(findings), _links(record)]
    return Section("The mechanism", _text(findings), results)


def _text(findings: Findings) -> str:
    record = findings.record
    pose = ", ".join(record.platform.pose)
    constant = " Its orientation is expected to stay as it is." if record.platform.orientation == "constant" else ""
    changed = ", ".join(f"{name} = {short(value)}" for name, value in record.overrides.items())
    numbered = (
        " Captions name the figures of the source that show the same."
        if findings.illustrated and findings.companion.numbers
        else ""
    )
    overrides = f"\n\nDimensions other than the file's are used in this report: {changed}." if changed else ""
    return (
        f"{record.title}. Source: {record.source or 'none stated'}.\n\n"
        f"The platform is the link “{record.platform.link}”; its pose is ({pose}).{constant} Lengths are in "
        f"{shown_unit(record.unit)}, angles in {'degrees' if record.angle == 'deg' else 'rad'}. "
        "The joint graph below is the only geometric truth: loop closure, rank and mobility come from it, and every "
        f"closed form in this report is a claim about it that is checked.{numbered}{overrides}"
    )


def _counts(findings: Findings) -> list[Scalar]:
    record = findings.record
    graph = joint_graph(record)
    types: dict[str, int] = {}
    for joint in record.joints.values():
        types[joint.type.name] = types.get(joint.type.name, 0) + 1
    kinds = ", ".join(f"{number} {name}" for name, number in types.items())
    return [
        Scalar("links", float(len(record.links)), "", EXACT, note="base included"),
        Scalar("joints", float(len(record.joints)), "", EXACT, note=kinds),
        Scalar("independent loops", float(len(graph.cut)), "", EXACT, note="joints − links + 1"),
        Scalar(
            "actuated joints",
            float(len(record.drives)),
            "",
            EXACT,
            note=", ".join(i.coordinate.joint for i in record.drives),
        ),
    ]


def _parameters(record: MechanismRecord) -> Table:
    rows = []
    for parameter in record.parameters.values():
        notes = ["set for this report"] if parameter.name in record.overrides else []
        notes += ["drawn only"] if parameter.drawn_only else []
        meaning = f"{parameter.meaning} ({', '.join(notes)})" if notes else parameter.meaning
        rows.append((named_formula(parameter.name), short(parameter.value, 12), shown_unit(parameter.unit), meaning))
    return Table("Dimensions", ("symbol", "value", "unit", "meaning"), tuple(rows))


def _inputs(record: MechanismRecord) -> Table:
    rows = []
    for actuated in record.drives:
        unit = record.angle if actuated.coordinate.kind == "angle" else shown_unit(record.unit)
        symbol = PrintedFormula(inline(symbol_mathml(actuated.latex, actuated.name), actuated.name))
        joint = record.joints[actuated.coordinate.joint]
        rows.append(
            (symbol, record.coordinate_label(actuated.coordinate), joint.type.name, unit, _stroke(record, actuated))
        )
    return Table("Inputs", ("symbol", "joint", "type", "unit", "stroke"), tuple(rows))


def _stroke(record: MechanismRecord, actuated: Input) -> str:
    if actuated.stroke is None:
        return "none stated"
    low, high = (
        angle_at_border(record, end) if actuated.coordinate.kind == "angle" else end for end in actuated.stroke
    )
    return f"{short(float(low))} to {short(float(high))}"


def _joints(findings: Findings) -> Table:
    record = findings.record
    values = _home_texts(findings)
    columns = ("joint", "also", "type", "parent", "child", "axis at value zero", *(("home",) if values else ()))
    rows = tuple(
        (joint.name, joint.alias, joint.type.name, joint.parent, joint.child, _axis(joint), *values.get(joint.name, ()))
        for joint in record.joints.values()
    )
    units = f"{shown_unit(record.unit)} and {'degrees' if record.angle == 'deg' else 'rad'}"
    caption = f"Home: joint values of the assembled home configuration, in {units}." if values else ""
    return Table(f"The {count(len(rows), 'joint')}", columns, rows, caption, folded=True)


def _home_texts(findings: Findings) -> dict[str, tuple[str, ...]]:
    """Joint values of home by joint, none where the loops do not close with these dimensions."""
    try:
        home = findings.home
    except UsageError:
        return {}
    record = findings.record
    texts: dict[str, tuple[str, ...]] = {}
    for name in record.joints:
        parts = []
        for coordinate in record.joint_coordinates(name):
            angle = coordinate.kind == "angle"
            value = angle_at_border(record, home[coordinate.index]) if angle else home[coordinate.index]
            parts.append(findings.style.number(float(value), angle=angle))
        texts[name] = ("; ".join(parts),)
    return texts


def _axis(joint: Joint) -> str:
    return "; ".join(f"({', '.join(short(float(part) + 0.0, 4) for part in axis)})" for axis in joint.axes)


def _links(record: MechanismRecord) -> Table:
    rows = tuple((link.name, link.meaning) for link in record.links.values())
    return Table(f"The {count(len(rows), 'link')}", ("link", "what it is"), rows, folded=True)
