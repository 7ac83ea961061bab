import re
import sys
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest

import assur
from assur.errors import UsageError
from assur.results.notebook import cells as table_cells
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


def test_rounding_is_shown_as_zero_beside_what_is_none():
    column = [300.0, -1e-17, 1e-6, np.inf, np.nan]
    assert [row[0] for row in table_cells([{"x": value} for value in column])[1]] == ["300", "0", "1e-06", "inf", "nan"]
    assert table_cells([{"gap": 3e-17}])[1] == [["3e-17"]]


def test_a_column_of_rounding_alone_is_shown_as_zeros_beside_what_its_numbers_might_be():
    entries = [{"x": 3e-14, "gap": 3e-14}, {"x": -2e-14, "gap": 2e-14}]
    assert table_cells(entries, {"x": 250.0})[1] == [["0", "3e-14"], ["0", "2e-14"]]


def test_solutions_know_how_large_their_numbers_might_be(fivebar):
    sizes = fivebar.inverse([0.0, 200.0])._sizes()
    assert sizes["theta1"] == 180.0
    assert 50.0 < sizes["x"] == sizes["y"] < 500.0
    assert "gap" not in sizes


def test_solutions_say_the_units_of_their_columns(fivebar):
    assert f"in {fivebar.unit} and {fivebar.angle}:" in str(fivebar.inverse([0.0, 200.0])).splitlines()[0]


def test_a_mechanism_prints_its_inputs_pose_and_dimensions_and_is_still_named_in_short(fivebar):
    printed = str(fivebar)
    for name in (*fivebar.parameters, *fivebar.platform.pose, *(item.name for item in fivebar.inputs)):
        assert re.search(rf"^(input|pose|dimension) +{name} ", printed, re.MULTILINE)
    assert repr(fivebar) == "<Mechanism fivebar: planar five-bar, 2-RRR with a common joint>"


def test_an_attribute_that_there_is_not_is_told_with_those_that_are_near(fivebar):
    with pytest.raises(AttributeError, match="no attribute 'invers'; did you mean inverse"):
        _ = fivebar.invers
    assert not hasattr(fivebar, "_repr_png_")


@pytest.mark.parametrize(
    ("asked", "wrong", "near"),
    [
        (lambda own: own.workspace(resoluton=3), "option of workspace 'resoluton'", "resolution"),
        (lambda own: own.follow(own.home_values, pose=[0.0, 210.0]), "option of follow 'pose'", "poses"),
    ],
)
def test_an_option_that_there_is_not_is_told_with_those_that_are_near(fivebar, asked, wrong, near):
    with pytest.raises(UsageError, match=f"unknown {wrong}") as raised:
        asked(fivebar)
    assert re.search(rf"did you mean .*\b{near}\b", raised.value.hint)


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


def test_a_notebook_shows_solutions_as_they_stand(fivebar):
    for found in (fivebar.direct(np.radians([60.0, 60.0])), fivebar.inverse([0.0, 200.0])):
        assert found._repr_html_().count("data:image/png;base64,iVBOR") == 1
    none = fivebar.inverse([1e4, 0.0])
    assert not len(none)
    for found in (none, fivebar.direct(np.ones((2, 2)))):
        assert "<img" not in found._repr_html_()


def test_one_solution_has_the_units_of_its_set_in_its_table(fivebar):
    found = fivebar.inverse([0.0, 200.0])
    table = [line.split() for line in str(found[0]).splitlines()[2:]]
    printed = {name: (value, unit) for _, name, value, unit in table}
    for name, number in found.rows()[0].items():
        if name in printed:
            assert printed[name] == (f"{number:.6g}", "deg" if name.startswith("theta") else "mm")
    assert float(printed["A1"][0]) == pytest.approx(np.degrees(found[0].joints["A1"]), rel=1e-5)
    assert {"x", "y", "theta1", "A1", "P"} <= set(printed)
    assert found[0]._repr_html_().count("data:image/png;base64,iVBOR") == 1


@pytest.mark.parametrize(
    ("asked", "pictures"), [({}, 1), ({"box": {"x": (5e3, 6e3)}}, 1), ({"held": {"x": 20.0}}, 0)], ids=str
)
def test_a_notebook_shows_a_workspace_of_two_coordinates_or_more(fivebar, asked, pictures):
    shown = fivebar.workspace(resolution=8, **asked)._repr_html_()
    assert shown.count("data:image/png;base64,iVBOR") == pictures


def test_a_notebook_shows_a_topology_with_its_graph():
    shown = assur.topology("fivebar")._repr_html_()
    assert sorted(row[0].split()[0] for row in cells(shown)) >= ["freedoms", "coupling"] or len(cells(shown)) > 5
    assert "data:image/png;base64,iVBOR" in shown


def test_solutions_print_as_the_table_that_a_notebook_shows(fivebar):
    solutions = fivebar.direct(np.radians([60.0, 60.0]))
    head, *rows = str(solutions).splitlines()[1:]
    assert head.split() == cells(solutions._repr_html_())[0]
    assert len(rows) == len(solutions) == 2
    assert [row.split()[4] for row in rows] == [solution.mode for solution in solutions]
    assert solutions[1].mode == list(solutions)[1].mode
    assert str(fivebar.direct(np.ones((2, 2)))) == repr(fivebar.direct(np.ones((2, 2))))


POSE = [20.0, 224.0]
ANSWERS = {
    "solution": (lambda own: own.inverse(POSE)[0], 9, lambda answer: answer.pose[0]),
    "mobility": (lambda own: own.mobility(own.home_values), 1, lambda answer: answer.gap),
    "instant": (lambda own: own.instantaneous(own.home_values), 1, lambda answer: answer.measures["output"]),
    "velocities": (lambda own: own.velocity_map([POSE, POSE]), 2, lambda answer: answer.matrix[0, 0, 0]),
    "indices": (lambda own: own.indices(POSE), 1, lambda answer: answer["condition"]),
    "verdict": (lambda own: own.singularity(POSE), 4, lambda answer: answer.det_jp),
    "aspects": (lambda own: own.aspects("-+"), 1, lambda answer: answer.aspects[0].volume[0]),
    "workspace": (lambda own: own.workspace(resolution=8), 3, lambda answer: answer.volume),
    "errors": (lambda own: own.errors(POSE), 3, lambda answer: answer.sensitivity["g"][0]),
    "certificate": (lambda own: own.certified_inverse(POSE), 2, lambda answer: answer.solutions[0].pose.low[0]),
    "stiffness": (lambda own: own.stiffness(POSE), 1, lambda answer: answer.translational[0][0, 0]),
    "small motions": (lambda own: own.small_motions(POSE), 4, lambda answer: answer.poles[0].real),
    "path": (lambda own: own.follow(own.home_values, poses=[20.0, 230.0]), 2, lambda answer: answer.shares[0]),
    "forces": (lambda own: own.forces([POSE], load=[0.0, 1.0, 0.0]), 1, lambda answer: answer.forces[0, 0]),
}


@pytest.mark.parametrize("name", ANSWERS)
def test_an_answer_is_a_table_printed_in_a_notebook_and_as_a_data_frame(fivebar, monkeypatch, name):
    make, least, first = ANSWERS[name]
    answer = make(fivebar)
    monkeypatch.setitem(sys.modules, "pandas", SimpleNamespace(DataFrame=lambda rows: rows))
    rows = answer.to_dataframe()
    head, *shown = cells(answer._repr_html_())
    assert head == list(rows[0])
    assert len(shown) == len(rows) >= least
    numbers = [value for value in rows[0].values() if isinstance(value, float)]
    assert numbers[0] == pytest.approx(float(first(answer)))
    assert len(str(answer).splitlines()) > len(rows) or "per unit" in str(answer) or answer._title() == str(answer)
    assert "array(" not in str(answer)


def test_of_a_long_table_the_first_rows_are_shown_and_how_many_more_there_are():
    columns, rows = table_cells([{"t": float(k), "x": 0.0} for k in range(30)])
    assert columns == ("t", "x")
    assert rows[23] == ["23", "0"]
    assert rows[24:] == [["and 6 more", ""]]


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
