"""The guard: which requests the live view answers, by the token in the path, the Host and the Origin.

Pure functions of one request, so that they are tested without a server. There is one page, held in memory, and one
WebSocket; nothing is ever looked up by a name that a request gives, so no file can be reached through it.
"""

from __future__ import annotations

import hmac
import ipaddress
import secrets
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Self

LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
"""Hosts by which a browser on this machine names it."""

SAFE_SITES = ("none", "same-origin")
"""Sec-Fetch-Site of a page that is opened by hand, or from itself."""

HTTP = 80
"""The port that an address without one means."""

BYTES = 24
"""Random bytes of a token."""


class RequestAnswer(Enum):
    """What becomes of a request."""

    page = "page"
    socket = "socket"
    refused = "refused"


@dataclass(frozen=True)
class RequestVerdict:
    """The answer to a request, and why it is refused; the reason is for tests and logs, never sent."""

    answer: RequestAnswer
    why: str = ""


@dataclass(frozen=True)
class Guard:
    """Checks requests.

    Attributes:
        token: what the path must begin with; whoever has it may use the view.
        hosts: names and addresses that Host may give, as a browser writes them ("127.0.0.1", "[::1]").
        any_address: whether any numerical address is allowed as well. A page of another site can make the browser send
            a name of its own that points here (DNS rebinding), but never a numerical address.
    """

    token: str
    hosts: tuple[str, ...] = LOOPBACK
    any_address: bool = False

    @classmethod
    def new(cls, host: str = "127.0.0.1") -> Self:
        """A guard with a fresh random token for a server that listens on `host`.

        >>> guard = Guard.new()
        >>> len(guard.token), guard.hosts
        (32, ('127.0.0.1', 'localhost', '[::1]'))
        """
        host_as_sent = as_sent(host)
        hosts = LOOPBACK if host_as_sent in LOOPBACK else (*LOOPBACK, host_as_sent)
        return cls(secrets.token_urlsafe(BYTES), hosts, any_address=is_everywhere(host))

    def check(self, path: str, headers: Iterable[tuple[str, str]], port: int) -> RequestVerdict:
        """What becomes of a GET request that came in on `port`.

        Args:
            path: of the request line as it was sent, with its query.
            headers: names and values, each as often as it was sent.
            port: of this server.

        >>> guard = Guard("secret")
        >>> guard.check("/secret/", [("Host", "127.0.0.1:8123")], 8123).answer.value
        'page'
        >>> guard.check("/secret/", [("Host", "evil.example:8123")], 8123)
        RequestVerdict(answer=<RequestAnswer.refused: 'refused'>, why='host')
        """
        sent: dict[str, list[str]] = {}
        for name, value in headers:
            sent.setdefault(name.lower(), []).append(value)
        socket = "upgrade" in sent or "sec-websocket-key" in sent
        why = self._fault(path, sent, port, socket)
        if why:
            return RequestVerdict(RequestAnswer.refused, why)
        return RequestVerdict(RequestAnswer.socket if socket else RequestAnswer.page)

    def _fault(self, path: str, sent: dict[str, list[str]], port: int, socket: bool) -> str:
        hosts = sent.get("host", [])
        if len(hosts) != 1 or not self._is_own(hosts[0], port):
            return "host"
        origins = sent.get("origin", [])
        if origins != [f"http://{hosts[0]}"] and (socket or origins):
            return "origin"
        target = path if socket else path.partition("?")[0]
        if not self._has_token(target):
            return "path"
        return "" if socket or _by_hand(sent) else "embedded"

    def _is_own(self, host: str, port: int) -> bool:
        """Whether a Host header names this server; browsers leave the port of HTTP out."""
        name = host.removesuffix(f":{port}")
        if name == host and port != HTTP:
            return False
        return name in self.hosts or (self.any_address and _is_address(name))

    def _has_token(self, target: str) -> bool:
        """Whether a path is that of the page, compared in constant time and never decoded."""
        expected = f"/{self.token}".encode()
        given = target.encode("utf-8", "surrogatepass")
        bare, slash = hmac.compare_digest(given, expected), hmac.compare_digest(given, expected + b"/")
        return bare or slash


def as_sent(host: str) -> str:
    """A host as a browser writes it into an address and sends it: in small letters, an IPv6 address short, in brackets.

    >>> as_sent("MyBox"), as_sent("FE80:0::1"), as_sent("[::1]"), as_sent("127.0.0.2")
    ('mybox', '[fe80::1]', '[::1]', '127.0.0.2')
    """
    if not _is_address(host):
        return host.lower()
    address = ipaddress.ip_address(host.strip("[]").partition("%")[0])
    return f"[{address}]" if address.version == 6 else str(address)


def reached_at(host: str) -> str:
    """A host by which this machine reaches a server that listens on `host`: itself, or this machine for "every one".

    >>> reached_at("::"), reached_at("0.0.0.0"), reached_at("mybox")
    ('::1', '127.0.0.1', 'mybox')
    """
    if not is_everywhere(host):
        return host
    return "::1" if ":" in host else "127.0.0.1"


def is_loopback(host: str) -> bool:
    """Whether only programs of this machine can reach a server that listens there.

    >>> is_loopback("localhost"), is_loopback("127.0.0.2"), is_loopback("::1"), is_loopback("192.0.2.7")
    (True, True, True, False)
    """
    return host.lower() == "localhost" or (_is_address(host) and ipaddress.ip_address(host.strip("[]")).is_loopback)


def is_everywhere(host: str) -> bool:
    """Whether a server that listens there is reached by every address of the machine."""
    return _is_address(host) and ipaddress.ip_address(host.strip("[]")).is_unspecified


def _is_address(text: str) -> bool:
    try:
        ipaddress.ip_address(text.strip("[]"))
    except ValueError:
        return False
    return True


def _by_hand(sent: dict[str, list[str]]) -> bool:
    """Whether a page is asked for as the page of a tab, not as a part of somebody else's.

    Browsers that do not send these headers are let pass: they need the token as well.
    """
    site, mode, place = ((sent.get(f"sec-fetch-{name}") or [""])[0] for name in ("site", "mode", "dest"))
    return not site or site in SAFE_SITES or (mode, place) == ("navigate", "document")


POLICY = {
    "Content-Security-Policy": "; ".join(
        (
            "default-src 'none'",
            "script-src 'unsafe-inline' 'unsafe-eval' blob:",
            "style-src 'unsafe-inline'",
            "img-src data: blob:",
            "font-src data:",
            "media-src data: blob:",
            "worker-src blob: data:",
            "connect-src 'self' data: blob:",
            "frame-ancestors 'none'",
            "base-uri 'none'",
            "form-action 'none'",
        )
    ),
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}
"""Headers of the page: it loads nothing from anywhere, talks to this server only, and stands in no other page."""
