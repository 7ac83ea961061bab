"""The server over a socket: the attack list, and what is answered."""

import importlib
import importlib.util
import pathlib
import socket
import threading
import time
import urllib.request
from types import SimpleNamespace

import pytest

from assur.errors import AssurError, UsageError
from assur.view import server
from assur.view.guard import Guard

_SPEC = importlib.util.spec_from_file_location("attacks", pathlib.Path(__file__).with_name("attacks.py"))
_LIST = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(_LIST)
ATTACKS, HOST, ORIGIN, SOCKET, get = _LIST.ATTACKS, _LIST.HOST, _LIST.ORIGIN, _LIST.SOCKET, _LIST.get
pytestmark = pytest.mark.view
WORD = "7c1f-not-for-anyone"


@pytest.fixture(scope="module")
def secret(tmp_path_factory):
    path = tmp_path_factory.mktemp("secret") / "file.txt"
    path.write_text(WORD)
    return path


@pytest.fixture
def ask(served, secret, talk):
    """Send one request of the list."""

    def send(text: str) -> bytes:
        found, _ = served
        token = found.guard.token
        encoded = "".join(f"%{ord(letter):02x}" for letter in token)
        for name, value in (
            ("TOKEN-1", token[:-1]), ("TOKEN", token), ("UPPER", token.swapcase()), ("ENCODED", encoded),
            ("PORT", str(found.port)), ("SECRET", str(secret).lstrip("/")),
        ):  # fmt: skip
            text = text.replace(name, value)
        return talk(found.port, text.encode("utf-8"))

    return send


def test_the_list_is_long_enough():
    assert len(ATTACKS) >= 60
    assert len(set(ATTACKS.values())) == len(ATTACKS)


@pytest.mark.parametrize("name", ATTACKS)
def test_it_is_refused(name, ask, served):
    answer = ask(ATTACKS[name])
    first = answer.split(b"\r\n", 1)[0]
    assert b" 200 " not in first
    assert b" 101 " not in first
    assert b"<script" not in answer
    assert b"root:" not in answer
    assert WORD.encode() not in answer
    assert served[0].guard.token.encode() not in answer


def test_the_same_requests_are_answered_where_nothing_is_wrong(ask, served):
    page = ask(get("/TOKEN/?at=1", HOST, "Connection: close"))
    head = page.split(b"\r\n\r\n", 1)[0].lower()
    assert page.startswith(b"HTTP/1.1 200 ")
    assert b"<script" in page
    assert b"connect-src 'self'" in head
    assert b"frame-ancestors 'none'" in head
    assert b"access-control-allow" not in head
    assert served[1][-1] == "at=1"
    assert ask(get("/TOKEN", HOST, ORIGIN, *SOCKET, "Sec-WebSocket-Protocol: viser-v0")).startswith(b"HTTP/1.1 101 ")


def test_it_listens_on_the_loopback_alone(served):
    found, _ = served
    assert found.url.startswith(f"http://127.0.0.1:{found.port}/")
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", found.port), timeout=5)


def test_there_is_no_tunnel_to_the_outside(served):
    messages = importlib.import_module("viser._messages")
    handlers = served[0].viser._websock_server._incoming_handlers
    assert messages.ShareUrlRequest not in handlers
    assert handlers  # the others are there: the name of this table has not changed


def test_a_server_that_does_not_ask_its_guard_does_not_start(monkeypatch):
    """As if another version of the library began its server in another way."""
    library = importlib.import_module("websockets.asyncio.server")
    infra = importlib.import_module("viser.infra._infra")
    own = SimpleNamespace(asyncio=SimpleNamespace(server=SimpleNamespace(serve=library.serve)))
    for name in ("datastructures", "exceptions"):
        setattr(own, name, importlib.import_module(f"websockets.{name}"))
    own.asyncio.server.ServerConnection = library.ServerConnection
    monkeypatch.setattr(infra, "websockets", own)
    before = threading.active_count()
    with pytest.raises(AssurError, match="does not ask its guard"):
        server.Served("127.0.0.1", 0, Guard.new(), [].append)
    assert threading.active_count() <= before


@pytest.mark.parametrize("host", ["::", "::1", "127.0.0.2", "LOCALHOST"])
def test_it_answers_its_own_address_wherever_it_listens(host):
    found = server.Served(host, 0, Guard.new(host), [].append)
    try:
        with urllib.request.urlopen(found.url, timeout=10) as answer:
            assert answer.status == 200
    finally:
        found.stop()


@pytest.mark.parametrize(
    ("host", "port", "said", "hint"),
    [
        ("127.0.0.1", "taken", r"nothing can listen on 127\.0\.0\.1, port \d+: Address already in use", "--port"),
        ("192.0.2.1", 0, r"nothing can listen on 192\.0\.2\.1: Cannot assign", "--host"),
        ("nobody.invalid", 0, r"nothing can listen on nobody\.invalid: \w+", "--host"),
    ],
)
def test_where_nothing_can_listen_is_refused_with_what_to_change(served, host, port, said, hint):
    with pytest.raises(UsageError, match=said) as caught:
        server.Served(host, served[0].port if port == "taken" else port, Guard.new(), [].append)
    assert hint in caught.value.hint


def test_without_viser_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "viser", None)
    with pytest.raises(UsageError, match="needs viser") as caught:
        server.library()
    assert caught.value.hint == "pip install '.[view]' in assur's folder"


def test_so_many_windows_are_served_and_the_next_one_is_told(served):
    found, _ = served
    headers = [f"Host: 127.0.0.1:{found.port}", f"Origin: http://127.0.0.1:{found.port}", *SOCKET]
    path = f"/{found.guard.token}"
    shake = "\r\n".join([f"GET {path} HTTP/1.1", *headers, "Sec-WebSocket-Protocol: viser-v0", "", ""]).encode()
    page = "\r\n".join([f"GET {path}/ HTTP/1.1", headers[0], "Connection: close", "", ""]).encode()

    def counted(holds):
        for _ in range(1000):
            if holds():
                return
            time.sleep(0.01)
        raise AssertionError(found._open)

    def answer(sent):
        line = socket.create_connection(("127.0.0.1", found.port), timeout=20)
        line.sendall(sent)
        return line, line.recv(4096)

    lines = []
    try:
        while len(lines) <= server.MOST and (not lines or lines[-1][1].startswith(b"HTTP/1.1 101 ")):
            lines.append(answer(shake))
            counted(lambda: found._open == min(len(lines), server.MOST))
        assert len(lines) == server.MOST + 1
        assert lines[-1][1].startswith(b"HTTP/1.1 503 ")
        line, told = answer(page)
        line.close()
        assert told.startswith(b"HTTP/1.1 503 ")
        assert f"open in {server.MOST} windows already".encode() in told
    finally:
        for line, _ in lines:
            line.close()
    counted(lambda: found._open < server.MOST)  # the server notices that they are gone
    line, told = answer(page)
    line.close()
    assert told.startswith(b"HTTP/1.1 200 ")
