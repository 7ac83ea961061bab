import dataclasses
import json
import re
import sys

import matplotlib as mpl
import matplotlib.pyplot as plt
import pytest

import assur
from assur.errors import OutputError, UnknownNameError
from assur.figures import catalogue as figures
from assur.figures.catalogue import ENTRIES
from assur.report.formulas.latex import latex_mathml
from assur.workspace.region import workspace

MAGIC = {"png": b"\x89PNG", "pdf": b"%PDF", "svg": b"<?xml"}
FORMATS = (*MAGIC, "json")


def test_every_figure_is_there_or_left_out_for_a_reason(context):
    names = figures.names(context.record, context)
    reasons = figures.left_out(context.record, context)
    assert [entry.name for entry in ENTRIES if entry.name not in reasons] == names
    assert all(reasons.values())
    assert {"structure", "model", "solid"} <= set(names)


def test_the_papers_mechanism_has_every_figure():
    """But of parasitic motions, as its platform keeps its orientation, and of tolerances, which it does not state."""
    assert figures.left_out(assur.load("zeng2019")).keys() == {"parasitic", "accuracy", "errors"}


def test_catalogue_has_a_number_title_and_caption_for_each(context):
    specs = figures.catalogue(context.record, context)
    assert [spec.name for spec in specs] == figures.names(context.record, context)
    assert {spec.name: spec.number for spec in specs if spec.number} == {
        name: number
        for name, number in context.companion.numbers.items()
        if name in figures.names(context.record, context)
    }
    for spec in specs:
        assert spec.title
        assert spec.caption.endswith(".")
        assert spec.caption.count("$") % 2 == 0, spec.caption
        assert not re.search(r"(^|[\s(])-[\d.]", re.sub(r"\$[^$]*\$", "", spec.caption)), spec.caption  # hyphens
        for latex in re.findall(r"\$([^$]+)\$", spec.caption):
            assert "<merror>" not in latex_mathml(latex), latex


# of the paper's mechanism the demonstration writes every figure, and its report holds them all
@pytest.mark.parametrize(
    ("context", "formats"),
    [
        ("fivebar", ("svg", "json")),
        *(pytest.param(name, FORMATS, marks=pytest.mark.deep) for name in ("fivebar", "planar_3rrr", "zeng2019")),
    ],
    indirect=["context"],
)
def test_every_figure_is_written_in_every_format(context, formats, tmp_path):
    steps = []
    names = figures.names(context.record, context)
    paths = figures.write(
        context.record,
        tmp_path,
        formats=formats,
        progress=lambda *step: steps.append(step),
        context=context,
    )
    assert len(paths) == len(set(paths)) == len(formats) * len(names)
    assert list(dict.fromkeys(steps)) == [(k, len(names)) for k in range(len(names) + 1)]
    assert sorted(tmp_path.iterdir()) == sorted(paths)
    for path in paths:
        content = path.read_bytes()
        if path.suffix == ".json":
            found = json.loads(content)
            assert found["mechanism"] == context.record.name
            assert found["name"] == path.stem
            assert found["caption"]
        else:
            assert content.startswith(MAGIC[path.suffix[1:]])


def test_drawing_leaves_nothing_behind(context):
    before = dict(mpl.rcParams)
    figure = figures.draw(context.record, "structure", context)
    figures.encoded(figure, "png")
    assert plt.get_fignums() == []
    assert dict(mpl.rcParams) == before


def test_a_figure_is_called_by_what_it_shows_with_the_number_of_the_source(context, tmp_path):
    numbers = context.companion.numbers
    paths = figures.write(context.record, tmp_path, ["solid", "structure"], ("json",), context=context)
    assert [path.name for path in paths] == ["solid.json", "structure.json"]
    for path in paths:
        found = json.loads(path.read_text())
        assert found["figure"] == numbers.get(path.stem)
        assert (f"Compare Figure {found['figure']} of the source." in found["caption"]) == (path.stem in numbers)


def test_a_figure_is_drawn_without_asking_which_others_there_are(monkeypatch, tmp_path):
    def asked(_):
        raise AssertionError("asked whether there is another figure")

    context = figures.Context(assur.load("fivebar"))
    others = tuple(dataclasses.replace(item, missing=asked) for item in ENTRIES if item.name != "structure")
    own = tuple(item for item in ENTRIES if item.name == "structure")
    monkeypatch.setattr(sys.modules["assur.figures.catalogue"], "ENTRIES", (*others, *own))
    assert [path.name for path in figures.write(context.record, tmp_path, ["structure"], ("json",), context=context)]
    assert figures.spec(context.record, "structure", context).caption


def test_an_unknown_figure_or_format_writes_nothing(context, tmp_path):
    with pytest.raises(UnknownNameError, match="structure"):
        figures.write(context.record, tmp_path, ["structure", "structur"], context=context)
    with pytest.raises(UnknownNameError, match="png"):
        figures.write(context.record, tmp_path, ["structure"], ["png", "bmp"], context=context)
    assert list(tmp_path.iterdir()) == []


def test_a_figure_that_is_left_out_says_why(context):
    for name, why in figures.left_out(context.record, context).items():
        with pytest.raises(UnknownNameError) as caught:
            figures.draw(context.record, name, context)
        assert caught.value.hint == why


def test_a_folder_that_is_not_there(context, tmp_path):
    with pytest.raises(OutputError):
        figures.write(context.record, tmp_path / "no", ["structure"], context=context)


def test_a_file_without_closed_form_still_has_its_structure(tmp_path):
    path = tmp_path / "slider.toml"
    path.write_text(
        """
format = 1
name = "slider"
unit = "mm"
angle = "deg"
base = "ground"
platform = { link = "block", pose = ["x"], orientation = "constant" }
[parameters]
r = { value = 40 }
[links]
ground = {}
crank = {}
rod = {}
block = {}
[joints]
A = { type = "revolute", parent = "ground", child = "crank", axis = "z" }
B = { type = "revolute", parent = "crank", child = "rod", at = ["r", 0, 0], axis = "z" }
C = { type = "revolute", parent = "rod", child = "block", at = ["2*r", 0, 0], axis = "z" }
S = { type = "prismatic", parent = "ground", child = "block", axis = "x" }
[inputs]
order = ["A"]
A = { name = "q" }
[home]
A = 50
B = -75
C = 25
S = 100
"""
    )
    record = assur.load(path)
    assert figures.names(record) == ["structure", "model", "solutions", "solid", "graph"]
    for name in figures.names(record):
        assert figures.encoded(figures.draw(record, name), "pdf").startswith(b"%PDF")


@pytest.mark.deep
def test_without_closed_form_few_figures_are_missing():
    known = figures.Context(assur.load("fivebar"))
    record = dataclasses.replace(known.record, closed_form=None)
    bare = figures.Context(record, workspace(record, resolution=16))
    missing = set(figures.left_out(record, bare)) - set(figures.left_out(known.record, known))
    assert missing <= {"flow", "aspects", "parallel", "singular"}  # no path meets another singularity
    for name in figures.names(record, bare):
        assert figures.encoded(figures.draw(record, name, bare), "pdf").startswith(b"%PDF")
    for spec in figures.catalogue(record, bare):
        assert spec.caption.endswith(".")
        assert spec.caption.count("$") % 2 == 0, spec.caption
        assert not re.search(r"(^|[\s(])-[\d.]", re.sub(r"\$[^$]*\$", "", spec.caption)), spec.caption  # hyphens
        for latex in re.findall(r"\$([^$]+)\$", spec.caption):
            assert "<merror>" not in latex_mathml(latex), latex
