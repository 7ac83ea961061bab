"""The site builds without a warning, is whole, and asks no network for anything."""

import os
import re
import subprocess
import sys
from html import unescape
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest

ROOT = Path(__file__).parents[1]
LOADED = re.compile(r"<(?:script|img|link|iframe|source)\b[^>]*?(?:src|href)=\"([^\"]+)\"")
FOLLOWED = re.compile(r"<a\b[^>]*?href=\"([^\"]+)\"")
NAMED = re.compile(r"\bid=\"([^\"]+)\"")
PHONE = {"width": 390, "height": 800}
ELSEWHERE = re.compile(r"(?:[a-z]+:)?//")


@pytest.mark.browser
@pytest.mark.site
@pytest.mark.slow
@pytest.mark.parametrize("pictures", ["blank", pytest.param("drawn", marks=pytest.mark.deep)])
def test_the_site_builds_and_is_whole(tmp_path, browser, pictures):
    """One test, so that it is built once; the figures of its gallery are tests of their own."""
    site = tmp_path / "site"
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-E", "-q", "-d", tmp_path / "trees", "docs", site]
    ran = subprocess.run(
        command,
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "ASSUR_GALLERY": pictures},
    )
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "", "")
    pages = {path: path.read_text(encoding="utf-8") for path in site.rglob("*.html")}
    sources = {path.relative_to(ROOT / "docs").with_suffix(".html") for path in (ROOT / "docs").rglob("*.md")}
    assert sources <= {path.relative_to(site) for path in pages}
    loads_nothing_from_elsewhere(site, pages)
    leads_somewhere(pages)
    shows_every_figure(pages[site / "gallery.html"])
    every_formula_is_typeset(pages)
    fits_a_phone(browser, pages)


def fits_a_phone(browser, pages):
    """What is wider scrolls by itself, never the page."""
    tab = browser.new_page(viewport=PHONE)
    for path in pages:
        tab.goto(path.as_uri())
        assert tab.evaluate("document.documentElement.scrollWidth") <= PHONE["width"], path.name
    tab.close()


def loads_nothing_from_elsewhere(site, pages):
    for path, text in pages.items():
        for target in LOADED.findall(text):
            assert not ELSEWHERE.match(target), (path.name, target)
            there = path.parent / unquote(target.split("?")[0])
            assert target.startswith(("data:", "#")) or there.is_file(), (path.name, target)
    for path in site.rglob("*.css"):
        assert not re.search(r"(?:url\(|@import)\s*['\"]?(?:https?:)?//", path.read_text(encoding="utf-8")), path


def leads_somewhere(pages):
    names = {path.resolve(): set(NAMED.findall(text)) for path, text in pages.items()}
    checked = 0
    for path, text in pages.items():
        for link in FOLLOWED.findall(text):
            target, name = urldefrag(unescape(link))
            if ELSEWHERE.match(target):
                continue
            there = (path.parent / unquote(target)).resolve() if target else path.resolve()
            assert there.is_file(), (path.name, link)
            assert not name or there.suffix != ".html" or unquote(name) in names[there], (path.name, link)
            checked += 1
    assert checked > 500


def shows_every_figure(gallery):
    from assur.figures.catalogue import ENTRIES

    plain = re.sub(r"<[^>]*>", "", gallery)
    for entry in ENTRIES:
        assert re.search(rf"<img[^>]*src=\"_images/{entry.name}\d*\.png\"", gallery), entry.name
        assert f"--only {entry.name}\n" in plain


def every_formula_is_typeset(pages):
    formulas = [found for text in pages.values() for found in re.findall(r"<math .*?</math>", text, re.DOTALL)]
    assert len(formulas) > 100
    assert [found for found in formulas if "<merror>" in found] == []
