import re
import sys
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.results.notebook import html_table, text_table


@pytest.fixture(scope="module")
def fivebar():
    return assur.load("fivebar")


def cells(html):
    root = ElementTree.fromstring(f"<div>{re.sub('<img[^>]*>', '', html)}</div>")
    return [[cell.text or "" for cell in row] for row in root.iter("tr")]


def test_html_escapes_what_stands_in_cells():
    table = html_table("<b>", ("a&b",), (("<script>",),))
    assert cells(table) == [["a&b"], ["<script>"]]
    assert "<script>" not in table


def test_text_has_as_many_lines_as_rows_and_two_more():
    assert text_table("t", ("a", "b"), ((1, "long"), ("longer", 2))) == "t\na       b\n1       long\nlonger  2"


def test_a_mechanism_prints_its_inputs_pose_and_dimensions_and_is_still_named_in_short(fivebar):
    printed = str(fivebar)
    for name in (*fivebar.parameters, *fivebar.platform.pose, *(item.name for item in fivebar.inputs)):
        assert re.search(rf"^(input|pose|dimension) +{name} ", printed, re.MULTILINE)
    assert repr(fivebar) == "<Mechanism fivebar: planar five-bar, 2-RRR with a common joint>"


def test_a_notebook_shows_the_table_and_a_picture(fivebar):
    shown = fivebar._repr_html_()
    assert len(cells(shown)) == len(str(fivebar).splitlines()) - 1
    assert shown.count("data:image/png;base64,iVBOR") == 1


def test_a_notebook_shows_solutions_in_the_files_units(fivebar):
    found = fivebar.direct(np.radians([60.0, 60.0]))
    head, *rows = cells(found._repr_html_())
    assert head == [*fivebar.platform.pose, "theta1", "theta2", "mode", "status", "gap"]
    for row, solution in zip(rows, found, strict=True):
        assert [float(cell) for cell in row[:2]] == pytest.approx(solution.pose, rel=1e-5)
        assert [float(cell) for cell in row[2:4]] == [60.0, 60.0]
        assert row[4] == solution.mode
    assert "batch (2,)" in fivebar.direct(np.ones((2, 2)))._repr_html_()


def test_a_notebook_shows_a_topology_with_its_graph():
    shown = assur.topology("fivebar")._repr_html_()
    assert sorted(row[0].split()[0] for row in cells(shown)) >= ["freedoms", "coupling"] or len(cells(shown)) > 5
    assert "data:image/png;base64,iVBOR" in shown


def test_a_data_frame_is_made_of_the_rows_where_pandas_is(fivebar, monkeypatch):
    """Of a stand-in: pandas is none of what assur needs."""
    monkeypatch.setitem(sys.modules, "pandas", SimpleNamespace(DataFrame=lambda rows: ("frame", rows)))
    found = fivebar.direct([1.0, 1.0])
    assert found.to_dataframe() == ("frame", found.rows())


def test_without_pandas_it_says_what_is_missing(fivebar, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(UsageError, match="pandas") as caught:
        fivebar.direct([1.0, 1.0]).to_dataframe()
    assert caught.value.hint == "pip install pandas"


def test_a_plot_has_the_width_that_is_asked_for(fivebar):
    assert fivebar.plot("flow", width="ieee").get_size_inches()[0] <= 88.9 / 25.4
    with pytest.raises(UsageError, match="no width"):
        fivebar.plot(width="acm")


def test_the_package_offers_what_is_public_and_nothing_else():
    assert {name for name in dir(assur) if not name.startswith("_")} == {*assur.__all__, "topology"}
