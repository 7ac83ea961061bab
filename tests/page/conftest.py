"""What the tests of the page share: a program run in Node, a user's own file, meshes read back."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess

import numpy as np
import pytest

from assur.cli.main import main
from assur.mechanism import load
from assur.page.page import page_html, scene

READY = "html[data-ready='1']"


@pytest.fixture(scope="session")
def node():
    """Run a JavaScript program: it gets `given` as an object, and what it leaves in `answer` comes back."""
    path = shutil.which("node")

    def run(program: str, given: object):
        text = (
            'const given = JSON.parse(require("node:fs").readFileSync(0, "utf8")); let answer;\n'
            f"{program}\nprocess.stdout.write(JSON.stringify(answer));"
        )
        done = subprocess.run(
            [path, "-e", text], input=json.dumps(given), capture_output=True, text=True, timeout=60, check=False
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run


@pytest.fixture(scope="session")
def drafted(tmp_path_factory):
    """The path of a file of a user's own, as `assur new` writes it: no closed form."""
    path = tmp_path_factory.mktemp("drafted") / "five.toml"
    assert main(["new", str(path), "--from", "fivebar", "--json"]) == 0
    return path


@pytest.fixture
def rng():
    return np.random.default_rng(6)


@pytest.fixture(scope="session")
def restored():
    """Vertices (n, 3) and faces of a quantised mesh, as the page reads them."""

    def read(found):
        steps = np.frombuffer(base64.b64decode(found["vertices"]), dtype="<u2").reshape(-1, 3)
        low, high = np.array(found["low"]), np.array(found["high"])
        corners = 2 if found["primitive"] == "segments" else 3
        kind = "<u4" if found["wide"] else "<u2"
        faces = np.frombuffer(base64.b64decode(found["faces"]), dtype=kind).reshape(-1, corners)
        return low + steps / 65535 * (high - low), faces.astype(np.int64)

    return read


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """The address of the page of a mechanism, with other dimensions if so asked."""
    folder, known = tmp_path_factory.mktemp("controls"), {}

    def made(name, **given):
        key = (name, *sorted(given.items()))
        if key not in known:
            path = folder / f"{len(known)}.html"
            path.write_text(page_html(scene(load(name, **given), resolution=12)), encoding="utf-8")
            known[key] = path.as_uri()
        return known[key]

    return made


@pytest.fixture
def opened(browser, address):
    """Open a page in a window of a size; whatever it complains of fails the test."""
    tabs, said = [], []

    def open_(name, *, width=1300, height=800, dark=False, at="", **given):
        context = browser.new_context(
            viewport={"width": width, "height": height}, color_scheme="dark" if dark else "light"
        )
        tab = context.new_page()
        tabs.append(context)
        tab.on("console", lambda message: said.append(f"{message.type}: {message.text}"))
        tab.on("pageerror", lambda error: said.append(f"error: {error}"))
        tab.goto(at if at.startswith("file:") else address(name, **given) + at, wait_until="commit")
        tab.wait_for_selector(READY, state="attached", timeout=60_000)
        return tab

    yield open_
    for context in tabs:
        context.close()
    assert said == []
