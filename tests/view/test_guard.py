"""The guard as a function of one request; over a socket it is tried in test_server.py."""

import pytest

from assur.view.guard import Guard, RequestAnswer, as_sent, is_everywhere, is_loopback, reached_at

GUARD = Guard("token")
HOST = ("Host", "127.0.0.1:80")


def test_every_token_is_another_and_long():
    tokens = {Guard.new().token for _ in range(50)}
    assert len(tokens) == 50
    assert all(len(token) >= 32 for token in tokens)


@pytest.mark.parametrize("path", ["/token/", "/token", "/token/?a=1", "/token?"])
@pytest.mark.parametrize("host", ["127.0.0.1:80", "localhost:80", "[::1]:80"])
def test_the_page_is_given_to_who_has_the_token(path, host):
    assert GUARD.check(path, [("Host", host)], 80).answer is RequestAnswer.page


@pytest.mark.parametrize("header", [("Upgrade", "websocket"), ("upgrade", "WebSocket"), ("Sec-WebSocket-Key", "x")])
def test_a_socket_needs_the_origin_of_the_page(header):
    assert GUARD.check("/token", [HOST, header], 80).why == "origin"
    assert GUARD.check("/token", [HOST, header, ("Origin", "http://127.0.0.1:80")], 80).answer is RequestAnswer.socket
    assert GUARD.check("/token", [HOST, header, ("Origin", "http://localhost:80")], 80).why == "origin"


@pytest.mark.parametrize(
    ("path", "headers", "why"),
    [
        ("/token/", [], "host"),
        ("/token/", [HOST, HOST], "host"),
        ("/token/", [("Host", "127.0.0.1:")], "host"),
        ("/token/", [("Host", ":80")], "host"),
        ("/token/", [("Host", "")], "host"),
        ("/\ud800", [HOST], "path"),
        ("/token/", [("Host", "127.0.0.1:81")], "host"),
        ("/token/", [HOST, ("Origin", "null")], "origin"),
        ("/other/", [HOST], "path"),
        ("/token/index.html", [HOST], "path"),
        ("/%74oken/", [HOST], "path"),
        ("/token?a", [HOST, ("Upgrade", "websocket"), ("Origin", "http://127.0.0.1:80")], "path"),
        ("/token/", [HOST, ("Sec-Fetch-Site", "cross-site"), ("Sec-Fetch-Mode", "no-cors")], "embedded"),
        (
            "/token/",
            [HOST, ("Sec-Fetch-Site", "same-site"), ("Sec-Fetch-Mode", "navigate"), ("Sec-Fetch-Dest", "iframe")],
            "embedded",
        ),
    ],
)
def test_each_fault_is_named(path, headers, why):
    assert GUARD.check(path, headers, 80).why == why


def test_a_link_that_is_followed_from_another_site_opens_the_page():
    sent = [("Sec-Fetch-Site", "cross-site"), ("Sec-Fetch-Mode", "navigate"), ("Sec-Fetch-Dest", "document")]
    assert GUARD.check("/token/", [HOST, *sent], 80).answer is RequestAnswer.page


def test_one_address_of_the_network_is_answered_under_that_address_only():
    guard = Guard.new("192.0.2.7")
    path = f"/{guard.token}/"
    assert guard.check(path, [("Host", "192.0.2.7:80")], 80).answer is RequestAnswer.page
    assert guard.check(path, [("Host", "192.0.2.8:80")], 80).why == "host"


@pytest.mark.parametrize("everywhere", ["0.0.0.0", "::"])
def test_every_address_is_answered_under_numbers_never_under_a_name(everywhere):
    guard = Guard.new(everywhere)
    path = f"/{guard.token}/"
    assert guard.check(path, [("Host", "192.0.2.3:80")], 80).answer is RequestAnswer.page
    assert guard.check(path, [("Host", "[fe80::1]:80")], 80).answer is RequestAnswer.page
    assert guard.check(path, [("Host", "rebound.example:80")], 80).why == "host"


def test_port_80_goes_without_saying_and_no_other():
    assert GUARD.check("/token/", [("Host", "127.0.0.1")], 80).answer is RequestAnswer.page
    assert GUARD.check("/token/", [("Host", "127.0.0.1")], 81).why == "host"
    socket = [("Host", "[::1]"), ("Upgrade", "websocket"), ("Origin", "http://[::1]")]
    assert GUARD.check("/token", socket, 80).answer is RequestAnswer.socket
    assert GUARD.check("/token", socket, 81).why == "host"


@pytest.mark.parametrize(
    ("host", "sent"),
    [
        ("127.0.0.1", "127.0.0.1"), ("127.0.0.2", "127.0.0.2"), ("localhost", "localhost"), ("LocalHost", "localhost"),
        ("::1", "[::1]"), ("[::1]", "[::1]"), ("MyBox", "mybox"), ("FE80::1", "[fe80::1]"),
        ("fe80:0:0::1", "[fe80::1]"), ("192.0.2.7", "192.0.2.7"), ("0.0.0.0", "127.0.0.1"), ("::", "[::1]"),
    ],
)  # fmt: skip
def test_a_guard_answers_the_address_of_its_own_server(host, sent):
    """As a browser sends it: in small letters, and short."""
    guard = Guard.new(host)
    assert as_sent(reached_at(host)) == sent
    assert guard.check(f"/{guard.token}/", [("Host", f"{sent}:8123")], 8123).answer is RequestAnswer.page
    assert guard.check(f"/{guard.token}/", [("Host", "192.0.2.99:8123")], 8123).why == (
        "" if is_everywhere(host) else "host"
    )


def test_which_addresses_are_of_this_machine_alone():
    assert [is_loopback(host) for host in ("127.0.0.1", "::1", "localhost", "0.0.0.0", "::", "example.org")] == [
        True, True, True, False, False, False,
    ]  # fmt: skip
    assert [is_everywhere(host) for host in ("0.0.0.0", "::", "127.0.0.1", "localhost")] == [True, True, False, False]
