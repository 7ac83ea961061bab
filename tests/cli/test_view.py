"""`assur view` from outside: its link, how it ends, and what it refuses."""

import http.client
import io
import re
import signal
import stat
import subprocess
import sys
import urllib.parse
import webbrowser
from pathlib import Path

import numpy as np
import pytest

from assur import load
from assur.cli import viewing
from assur.cli.main import main
from assur.joint_graph.frames import frames
from assur.kinematics.closure import assemble
from assur.numerics.rotations import to_vector
from assur.view.link import restored

COMMAND = [sys.executable, "-c", "from assur.cli.main import main; raise SystemExit(main())"]


def _heeds_interrupts():
    """What a shell starts in the background ignores Ctrl-C, and so does what that starts."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.view
def test_it_serves_its_page_until_it_is_interrupted():
    words = [*COMMAND, "view", "fivebar", "--no-open", "--json"]
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(words, **options, preexec_fn=_heeds_interrupts) as running:
        try:
            line = next(text for text in running.stderr if "http://" in text)
            url = urllib.parse.urlsplit(re.search(r"http://\S+", line)[0])
            connection = http.client.HTTPConnection(url.hostname, url.port, timeout=20)
            connection.request("GET", url.path)
            assert connection.getresponse().status == 200
            connection.close()
            assert url.hostname == "127.0.0.1"
        finally:
            running.send_signal(signal.SIGINT)
            try:
                said, _ = running.communicate(timeout=60)
            except subprocess.TimeoutExpired:
                running.kill()
                raise
    assert running.returncode == 0
    assert f'"url": "{url.geturl()}"' in said
    with pytest.raises(ConnectionRefusedError):
        http.client.HTTPConnection(url.hostname, url.port, timeout=5).request("GET", "/")


@pytest.mark.parametrize("host", ["0.0.0.0", "192.0.2.7", "::", "example.org"])
def test_a_host_that_others_reach_needs_a_second_word(host, capsys):
    assert main(["view", "fivebar", "--host", host]) == 2
    said = capsys.readouterr().err
    assert f"--host {host} lets other machines reach the view" in said
    assert "--allow-network" in said


@pytest.mark.parametrize("port", ["-1", "65536"])
def test_a_port_that_there_is_not(port, capsys):
    assert main(["view", "fivebar", "--port", port]) == 2
    assert f"--port {port}; a port is a number from 1 to 65535" in capsys.readouterr().err


def test_without_viser_it_says_what_to_install(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "viser", None)
    assert main(["view", "fivebar", "--no-open"]) == 2
    said = capsys.readouterr().err
    assert "the live view needs viser, which is not installed" in said
    assert "pip install '.[view]'" in said


@pytest.mark.view
def test_ctrl_c_at_the_very_moment_at_which_the_link_is_said_ends_it_well(monkeypatch, capsys):
    class Pressed(io.StringIO):
        """What stands on the terminal is read at once, and the key is pressed."""

        def flush(self):
            if "Ctrl-C ends the view" in self.getvalue():
                raise KeyboardInterrupt

    monkeypatch.setattr(sys, "stderr", Pressed())
    assert main(["view", "fivebar", "--no-open"]) == 0
    assert "the view of fivebar has ended" in capsys.readouterr().out


@pytest.fixture
def ended(monkeypatch):
    """The view is ended at once, as by Ctrl-C."""

    def interrupted():
        raise KeyboardInterrupt

    monkeypatch.setattr(viewing, "wait", interrupted)


@pytest.mark.view
@pytest.mark.usefixtures("ended")
def test_the_browser_is_given_a_private_file_not_the_token(monkeypatch, capsys):
    """A browser that stands in: what it is started with is what other users see of it."""
    given, pages, modes = [], [], []

    def browser(address):
        path = Path(urllib.parse.unquote(urllib.parse.urlsplit(address).path))
        given.append(path)
        pages.append(path.read_text(encoding="utf-8"))
        modes.append((stat.S_IMODE(path.stat().st_mode), stat.S_IMODE(path.parent.stat().st_mode)))

    monkeypatch.setattr(webbrowser, "open", browser)
    assert main(["view", "fivebar"]) == 0
    url = re.search(r"http://\S+", capsys.readouterr().err)[0]
    token = urllib.parse.urlsplit(url).path.strip("/")
    assert len(token) >= 32
    assert token not in str(given[0])
    assert f'href="{url}"' in pages[0]
    assert modes == [(0o600, 0o700)]
    assert not given[0].parent.exists()


@pytest.mark.parametrize("link", ["garbage", "at=1,2", "mechanism=zeng2019", "set=l1"])
@pytest.mark.usefixtures("ended")
def test_what_is_no_link_is_refused_before_anything_is_served(link, capsys):
    assert main(["view", "fivebar", "--no-open", "--link", link]) == 2
    said = capsys.readouterr().err
    assert "link" in said
    assert "http://" not in said


@pytest.mark.view
@pytest.mark.parametrize("host", ["0.0.0.0", "::"])
@pytest.mark.usefixtures("ended")
def test_with_the_second_word_it_warns(host, capsys):
    assert main(["view", "fivebar", "--host", host, "--allow-network", "--no-open"]) == 0
    assert "warning: other machines can reach this view" in capsys.readouterr().err


def test_it_begins_in_the_operation_mode_that_is_named():
    record = load("three_upu")
    snapshot, _ = restored(record, viewing.link_to_mode(record, "3R", ""))
    values = snapshot.values
    moved = assemble(record, values + 0.02 * np.random.default_rng(0).normal(size=(12, len(values))), near=True)
    turned = frames(record, moved.values[moved.closed])[record.platform.link][0]
    assert np.linalg.matrix_rank(to_vector(np.swapaxes(turned[:1], -1, -2) @ turned), tol=1e-6) == 3


def test_a_mode_that_is_not_met_lists_those_that_are(capsys):
    assert main(["view", "fivebar", "--mode", "3R", "--no-open"]) == 2
    assert "operation mode" in capsys.readouterr().err


def test_a_link_already_says_where_it_stands(capsys):
    assert main(["view", "fivebar", "--mode", "1T1R", "--link", "at=1,2,3,4,5", "--no-open"]) == 2
    assert "--mode and --link at once" in capsys.readouterr().err
