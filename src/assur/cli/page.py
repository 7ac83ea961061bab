"""`assur page`: one offline file in which the mechanism moves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from assur.cli.options import DRAWN_DEFAULTS, Drawn, MechanismName, Outcome

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from assur.mechanism import Mechanism
    from assur.results.answers.files import PageContent

ENDINGS = (".html", ".htm")


def page(
    mechanism: MechanismName,
    /,
    *,
    output: Annotated[
        str,
        Parameter(name=("-o", "--output"), metavar="FILE", help="The file to be written; page.html if left out."),
    ] = "page.html",
    mode: Annotated[
        str,
        Parameter(metavar="NAME", help="Also print the address that begins in this mode of `assur topology --modes`."),
    ] = "",
    resolution: Annotated[
        int | None,
        Parameter(help="Cells along each coordinate of the workspace; what a page can show if left out."),
    ] = None,
    shared: Drawn = DRAWN_DEFAULTS,
) -> Outcome:
    """Write one HTML file in which the mechanism can be moved.

    It needs no server and no network: open it in any browser, also on a phone.
    Sliders move the inputs or the platform, the mode kept; other modes are
    ghosts. The page solves the loops itself, from the same joint graph. An old
    file is replaced whole or not at all.

    For example:
        assur page zeng2019 -o zeng.html
        assur page ./my.toml --set l2=300 -o my.html
        assur page three_upu --mode 3R
    """
    record = shared.mechanism(mechanism)
    from assur.cli.output import Verbatim, heading
    from assur.cli.paths import output_file
    from assur.cli.progress import progress
    from assur.page import page_html, scene
    from assur.page.address import joints_hash
    from assur.results.answers.answer import ABSENT
    from assur.results.answers.files import WrittenPage
    from assur.results.files import write_whole

    path = output_file(output, ENDINGS)
    values = _of_mode(record, mode) if mode else None
    with progress("page", shared) as step:
        found = scene(record, resolution=resolution, progress=step)
        write_whole(path, page_html(found))
    size = path.stat().st_size
    inside = _inside(found)
    address = ABSENT if values is None else path.resolve().as_uri() + joints_hash(values)
    begins = [Verbatim(f"in mode {mode}: {address}")] if values is not None else []
    return Outcome(
        WrittenPage(record.name, str(path), size, inside, address),
        lambda: [
            heading(f"{record.name}, page"),
            *_lines(inside),
            f"written: {path} ({size / 1e3:.0f} kB); open it in a browser",
            *begins,
        ],
    )


def _of_mode(record: Mechanism, mode: str) -> NDArray[np.float64]:
    from assur.derived_topology import mode_values

    return mode_values(record, mode)


def _inside(scene: Mapping[str, Any]) -> PageContent:
    """What is in the file, counted; the scene is what the page reads as JSON."""
    from assur.results.answers.files import PageContent, PageLayers

    kinds = Counter(item["kind"] for item in scene["layers"])
    return PageContent(
        links=len(scene["graph"]["links"]),
        joints=len(scene["graph"]["joints"]),
        loops=len(scene["graph"]["cut"]),
        inputs=tuple(item["name"] for item in scene["inputs"]),
        pose=tuple(scene["platform"]["pose"]),
        assembly_modes=len(scene["branches"]["assembly"]),
        working_modes=len(scene["branches"]["working"]),
        layers_note=scene["layersNote"],
        layers=PageLayers(kinds["workspace"], kinds["singular"], kinds["section"], kinds["force"]),
        factors=len(scene["factors"]),
        facts=len(scene["facts"]),
        errata=len(scene["errata"]),
    )


def _lines(inside: PageContent) -> list[str]:
    from assur.results.plain_text import count

    layers, sections = inside.layers, count(inside.layers.section, "section")
    modes = [count(inside.assembly_modes, "assembly mode"), count(inside.working_modes, "working mode")]
    errata = "1 erratum" if inside.errata == 1 else f"{inside.errata} errata"
    return [
        f"{count(inside.links, 'link')}, {count(inside.joints, 'joint')}, {count(inside.loops, 'loop')}",
        f"sliders: {', '.join(inside.inputs)}; {', '.join(inside.pose)}",
        f"ghosts: {', '.join(modes)} at home",
        f"layers: {layers.workspace} workspace, {layers.singular} singular, {sections}, {layers.force} of forces",
        *([inside.layers_note] if inside.layers_note else []),
        f"{count(inside.facts, 'fact')} of the topology, {errata} of the source",
    ]
