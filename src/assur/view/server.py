"""The server: viser behind the guard. The one module that knows viser's library.

viser serves one page and one WebSocket from a port of its own; it checks neither token nor Host nor Origin, and looks
files up by the path of the request. There is one place where every request passes, the `process_request` of the
WebSocket library, and viser sets it itself: while viser starts, it is given ours instead, which never calls viser's.
So there is no second, unguarded port, and no path of a request ever becomes the name of a file. A view whose guard is
not asked (another version of viser) does not start.
"""

from __future__ import annotations

import contextlib
import errno
import http
import http.client
import importlib
import io
import logging
import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from assur.errors import AssurError, UsageError, extra_hint
from assur.view.guard import POLICY, Guard, RequestAnswer, as_sent, reached_at

REFUSED = b"refused\n"
MOST = 8
"""Windows that may be open at once: each is sent every change, and asks for its own."""
FULL = (
    "This view is open in {most} windows already, the most that it serves at once. Close one of them, then load this "
    "page again.\n"
)
TRY_AGAIN_LATER = 1013
"""What a WebSocket is closed with where there are too many."""
Opened = Callable[[str], None]
"""Called with the query of every page that is opened."""


class Served:
    """A viser server that is running behind a guard.

    Attributes:
        viser: the server object of the library.
        guard: what checks its requests.
        host, port: where it listens.
    """

    def __init__(self, host: str, port: int, guard: Guard, opened: Opened) -> None:
        viser = library()
        _check_free(host, port)
        self.guard, self.host = guard, host
        self._asked = False
        self._open = 0
        page = (Path(viser.__file__).parent / "client" / "build" / "index.html").read_bytes()
        with contextlib.redirect_stdout(io.StringIO()), self._in_front(page, opened):
            self.viser = viser.ViserServer(host=host, port=port, verbose=False)
        self.port = int(self.viser.get_port())
        messages = importlib.import_module("viser._messages")
        for kind in (messages.ShareUrlRequest, messages.ShareUrlDisconnect):  # no tunnel to the outside
            self.viser._websock_server.unregister_handler(kind)
        try:
            self._check_guarded()
        except BaseException:
            self.stop()
            raise

    @property
    def url(self) -> str:
        """The address with its token."""
        return f"http://{as_sent(reached_at(self.host))}:{self.port}/{self.guard.token}/"

    def stop(self) -> None:
        """End it, threads included."""
        with contextlib.redirect_stdout(io.StringIO()):
            self.viser.stop()

    @contextlib.contextmanager
    def _in_front(self, page: bytes, opened: Opened) -> Iterator[None]:
        """While this lasts, servers of the WebSocket library ask the guard."""
        library = importlib.import_module("websockets.asyncio.server")
        headers = importlib.import_module("websockets.datastructures").Headers
        response = importlib.import_module("websockets.http11").Response
        original = library.serve

        def process(connection: Any, request: Any) -> Any:
            self._asked = True
            port = connection.local_address[1]
            answer = self.guard.check(request.path, request.headers.raw_items(), port).answer
            kind, body, status = "text/plain; charset=utf-8", REFUSED, http.HTTPStatus.FORBIDDEN
            if answer is not RequestAnswer.refused and self._open >= MOST:
                body, status = FULL.format(most=MOST).encode(), http.HTTPStatus.SERVICE_UNAVAILABLE
            elif answer is RequestAnswer.socket:
                return None
            elif answer is RequestAnswer.page:
                kind, body, status = "text/html; charset=utf-8", page, http.HTTPStatus.OK
                opened(request.path.partition("?")[2])
            fields = {**POLICY, "Content-Type": kind, "Content-Length": str(len(body)), "Connection": "close"}
            return response(status.value, status.phrase, headers(fields), body)

        def serve(handler: Any, *arguments: Any, **options: Any) -> Any:
            quiet = logging.getLogger("assur.view.requests")
            quiet.setLevel(logging.CRITICAL)

            async def counted(connection: Any) -> None:
                if self._open >= MOST:  # several came at the same moment
                    await connection.close(TRY_AGAIN_LATER, FULL.format(most=MOST).partition(".")[0])
                    return
                self._open += 1
                try:
                    await handler(connection)
                finally:
                    self._open -= 1

            return original(counted, *arguments, **{**options, "process_request": process, "logger": quiet})

        setattr(library, "serve", serve)  # noqa: B010  # a module's attribute, for as long as viser starts
        try:
            yield
        finally:
            setattr(library, "serve", original)  # noqa: B010

    def _check_guarded(self) -> None:
        """Ask for the page without the token, and stop everything where it is not refused."""
        line = http.client.HTTPConnection(reached_at(self.host), self.port, timeout=10)
        try:
            line.request("GET", "/")
            status = line.getresponse().status
        finally:
            line.close()
        if status != http.HTTPStatus.FORBIDDEN or not self._asked:
            raise AssurError("the view's server does not ask its guard, so it was not started", hint=VERSION)


HINTS = {
    errno.EADDRINUSE: "choose another --port, or leave it out for a free one",
    errno.EACCES: "choose a --port from 1024, or leave it out for a free one",
}
VERSION = f"install the version of viser that assur names: {extra_hint('view')}"


def library() -> Any:
    """viser, or a clear refusal where it is not installed."""
    try:
        return importlib.import_module("viser")
    except ImportError:
        raise UsageError("the live view needs viser, which is not installed", hint=extra_hint("view")) from None


def _check_free(host: str, port: int) -> None:
    """Refuse an address that nothing can listen on; viser would try the next thousand ports."""
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
    except OverflowError:
        raise UsageError(f"nothing can listen on port {port}; a port is a number up to 65535") from None
    except OSError as error:
        where = f"{host}, port {port}" if port else host
        hint = HINTS.get(error.errno or 0, "give --host an address of this machine, or leave it out")
        raise UsageError(f"nothing can listen on {where}: {error.strerror}", hint=hint) from None
