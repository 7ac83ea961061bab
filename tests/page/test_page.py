import json
import re
from html.parser import HTMLParser

import pytest

from assur.cli.self_contained import outside_needs
from assur.mechanism import load
from assur.page.page import LARGEST, asset, embedded, page, page_html, scene
from catalogue import each


def scene_in(text):
    """The scene, as a browser finds it."""
    found = re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.DOTALL)
    return json.loads(found[1])


@pytest.mark.parametrize("name", each(quick=["zeng2019", "h4_robot", "gough_stewart"]))
def test_every_mechanism_has_a_page_under_a_megabyte(name):
    text = page(load(name))
    assert len(text.encode()) < LARGEST == 1_000_000
    assert outside_needs(text) == []
    assert scene_in(text)["name"] == name


def test_a_users_own_file_has_one(drafted):
    text = page(load(drafted))
    assert len(text.encode()) < LARGEST
    found = scene_in(text)
    assert [item["kind"] for item in found["layers"]] == ["workspace", *["force"] * 2, *["stiffness"] * 4]


def test_other_dimensions_make_another_page():
    one, other = (scene_in(page(load("fivebar", **given))) for given in ({}, {"l1": 110}))
    assert one["home"] != other["home"]


def test_what_a_file_says_cannot_end_the_element_it_stands_in():
    evil = {**scene(load("fivebar")), "name": "</script><img src=x onerror=alert(1)>", "title": "<b>&"}
    text = page_html(evil)
    assert "<img src=x" not in text
    assert scene_in(text)["name"] == evil["name"]
    assert "<title>&lt;/script&gt;" in text
    assert json.loads(embedded(json.dumps(evil)))["name"] == evil["name"]


def test_the_program_and_the_style_cannot_end_theirs():
    assert "</script" not in asset("page.js").lower()
    assert "<!--" not in asset("page.js")
    assert "</style" not in asset("page.css").lower()


def test_it_allows_no_request():
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page_html(scene(load("fivebar"))))[1]
    rules = dict(rule.strip().split(" ", 1) for rule in policy.split(";"))
    assert rules["default-src"] == "'none'"
    assert all("http" not in rule and "*" not in rule and "'self'" not in rule for rule in rules.values())


def test_it_is_well_formed():
    class Reader(HTMLParser):
        opened: list[str]

        def handle_starttag(self, tag, _attributes):
            if tag not in ("meta", "link"):
                self.opened.append(tag)

        def handle_endtag(self, tag):
            assert self.opened.pop() == tag

    reader = Reader()
    reader.opened = []
    reader.feed(page(load("fivebar")))
    reader.close()
    assert reader.opened == []


def test_the_same_mechanism_makes_the_same_bytes():
    assert page(load("fivebar")) == page(load("fivebar"))
