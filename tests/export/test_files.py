"""Which files an export writes."""

import json
from xml.etree import ElementTree

import pytest

import assur
from assur.export.files import ENDINGS, export
from assur.export.sidecar import sidecar
from assur.results.json_text import plain

ROOTS = {"mjcf": "mujoco", "sdf": "sdf", "urdf": "robot"}


@pytest.mark.parametrize("form", ROOTS)
def test_each_form_is_written_as_one_document(tmp_path, form):
    path = tmp_path / f"it{ENDINGS[form][0]}"
    written = export(assur.load("fivebar"), form, path)
    assert written[0] == path
    assert ElementTree.parse(path).getroot().tag == ROOTS[form]
    assert sorted(tmp_path.iterdir()) == sorted(written)


def test_the_loops_stand_beside_the_urdf_file(tmp_path):
    _, beside = export(assur.load("fivebar"), "urdf", tmp_path / "it.urdf")
    assert beside.name == "it.loops.json"
    assert json.loads(beside.read_text()) == plain(sidecar(assur.load("fivebar"), "it.urdf"))


def test_a_title_that_xml_cannot_hold_in_a_comment_is_written_all_the_same(tmp_path):
    import dataclasses

    odd = dataclasses.replace(assur.load("fivebar"), title="a -- b --- c \x01 -")
    for form in ROOTS:
        ElementTree.parse(export(odd, form, tmp_path / f"it{ENDINGS[form][0]}")[0])
