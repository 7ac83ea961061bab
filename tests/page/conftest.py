"""What the tests of the page share: a program run in Node, a user's own file, meshes read back."""

import base64
import json
import shutil
import subprocess

import numpy as np
import pytest

from assur.cli.main import main
from pages import page_of
from tabs import as_it_opened, listened, load_page, look


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


@pytest.fixture(scope="session")
def address(tmp_path_factory):
    """The address of the page of a mechanism, with other dimensions if so asked."""
    folder, known = tmp_path_factory.mktemp("pages"), {}

    def made(name, **given):
        key = (name, *sorted(given.items()))
        if key not in known:
            path = folder / f"{len(known)}.html"
            path.write_text(page_of(name, **given), encoding="utf-8")
            known[key] = path.as_uri()
        return known[key]

    return made


@pytest.fixture(scope="session")
def standing(browser, address):
    """A page that stays open from one test to the next, as it opens: put back, or loaded anew where that is not enough.

    Gives the tab, and what it has complained of so far, by mechanism, size of the window, darkness, dimensions, and
    whether its pictures are drawn.
    """
    tabs, before = {}, {}

    def stand(name, width, height, dark=False, drawn=False, **given):
        key = (name, width, height, dark, drawn, *sorted(given.items()))
        if key not in tabs:
            tabs[key] = listened(browser, width, height, dark, drawn)
        tab, said = tabs[key]
        if key not in before or not as_it_opened(tab, before[key]):
            load_page(tab, address(name, **given))
            before[key] = look(tab)
        return tab, said

    yield stand
    for tab, _ in tabs.values():
        tab.context.close()


@pytest.fixture
def opened(browser, address, standing):
    """Open a page in a window of a size, its pictures not drawn; whatever it complains of fails the test.

    A link (`at`), and a page that the test has open already, come in a window of their own.
    """
    own, heard, used = [], [], []

    def open_(name, *, width=900, height=600, dark=False, at="", **given):
        if at or (name, width, height, dark, given) in used:
            tab, said = listened(browser, width, height, dark, drawn=False)
            own.append(tab)
            load_page(tab, at if at.startswith("file:") else address(name, **given) + at)
            heard.append((said, 0))
        else:
            used.append((name, width, height, dark, given))
            tab, said = standing(name, width, height, dark, **given)
            heard.append((said, len(said)))
        return tab

    yield open_
    for tab in own:
        tab.context.close()
    assert [word for said, before in heard for word in said[before:]] == []
