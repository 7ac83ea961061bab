"""Where a mechanism is singular: its factors, their loci inside the workspace, an example configuration of each."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import RenderableType

from assur.cli.options import Outcome, Shared
from assur.cli.output import heading, table
from assur.cli.progress import progress
from assur.cli.quantities import mode_words
from assur.cli.regions import area_title
from assur.kinematics.answers.at_border import inputs_at_border, mechanism_header, pose_at_border, power
from assur.kinematics.answers.style import style_of
from assur.kinematics.status import closed_form_of, scale
from assur.mechanism import Mechanism
from assur.results.answers.singularity import ListedExample, ListedFactor, SingularityAnswer, SingularLocus
from assur.results.plain_text import short
from assur.singularity.examples import SingularExample, singular_examples
from assur.workspace.region import Workspace, workspace
from assur.workspace.sign_changes import ways_across

Groups = tuple[tuple[str, ...], ...]

RESOLUTION = 48
"""Cells along each coordinate of the box in which loci are looked for."""


def outcome(record: Mechanism, mode: str, shared: Shared) -> Outcome:
    """The outcome for a whole mechanism, its loci being those of one working mode."""
    with progress("loci in the workspace", shared) as step:
        region = workspace(record, mode, resolution=RESOLUTION if record.closed_form else None, progress=step)
    with progress("example configurations", shared) as step:
        examples = [_example(record, item) for item in singular_examples(record, 0, step, lambda: ways_across(region))]
    constraint, self_motion = _groups(record)
    answer = SingularityAnswer(
        **mechanism_header(record),
        mode=mode,
        factors=_factors(record),
        constraint=constraint,
        self_motion=self_motion,
        loci=_loci(region),
        examples=tuple(examples),
    )
    return Outcome(answer, lambda: _shown(record, answer))


def _factors(record: Mechanism) -> tuple[ListedFactor, ...]:
    if record.closed_form is None:
        return ()
    return tuple(
        ListedFactor(item.name, item.kind, item.meaning, power(record.unit, item.unit), scale(record, item.scale))
        for item in closed_form_of(record).factor_list
    )


def _groups(record: Mechanism) -> tuple[Groups, Groups]:
    """Names of factors that are zero together where the joint graph loses rank, and where the platform moves alone."""
    if record.closed_form is None:
        return (), ()
    form = closed_form_of(record)
    return tuple(map(tuple, form.constraint_singular)), tuple(map(tuple, form.self_motion_singular))


def _loci(region: Workspace) -> tuple[SingularLocus, ...]:
    surfaces = region.parallel_singular.factors.items()
    return tuple(SingularLocus(name, item.area, item.everywhere, item.meaning) for name, item in surfaces)


def _example(record: Mechanism, example: SingularExample) -> ListedExample:
    return ListedExample(
        example.factor.name,
        example.status.name,
        example.mode,
        pose_at_border(record, example.pose).tolist(),
        inputs_at_border(record, example.inputs).tolist(),
        example.in_box,
    )


def _shown(record: Mechanism, data: SingularityAnswer) -> Iterable[RenderableType]:
    style = style_of(record)
    if data.factors:
        yield heading(f"{data.mechanism}, singularities: where one of these is zero")
        yield table(
            ("factor", "kind", "zero where"),
            [(item.name, item.kind, item.meaning) for item in data.factors],
            left=("factor", "kind", "zero where"),
        )
    else:
        yield heading(f"{data.mechanism}, singularities: no closed form, so no factors")
    for kind, groups, what in (
        ("constraint", data.constraint, "the joint graph loses rank"),
        ("self_motion", data.self_motion, "the platform moves alone"),
    ):
        for group in groups:
            yield f"{kind}: {' = '.join(group)} = 0, {what}"
    yield ""
    yield heading(f"parallel loci inside the workspace box, {mode_words(record, data.mode)}")
    yield table(
        ("factor", area_title(record, data.coordinates)),
        [(item.factor, _area(item)) for item in data.loci],
        left=("factor",),
    )
    yield ""
    yield heading("example configurations")
    rows = [(item.factor, item.kind, item.mode, style.point(data.coordinates, item.pose)) for item in data.examples]
    pose = style.point_title(data.coordinates)
    yield table(("factor", "the pose is", "mode", pose), rows, left=("factor", "the pose is", pose))
    without = [item.name for item in data.factors if item.name not in {row[0] for row in rows}]
    if without:
        yield f"no example found: {', '.join(without)}"


def _area(locus: SingularLocus) -> str:
    if locus.everywhere:
        return "the whole mode"
    return short(locus.area) if locus.area else "none found"
