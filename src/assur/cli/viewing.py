"""What `assur view` does: checks where to listen, starts the view, says its link and waits for Ctrl-C."""

from __future__ import annotations

import contextlib
import sys
import threading
import webbrowser

from assur.cli import interruption
from assur.cli.options import Outcome
from assur.errors import UsageError
from assur.model.mechanism import MechanismRecord
from assur.results.answers.files import EndedView
from assur.view.guard import Guard, is_loopback
from assur.view.link import restored
from assur.view.opening import leading_to

LAST_PORT = 65535
WARNING = (
    "warning: other machines can reach this view. Its link is sent as plain text:\n"
    "whoever has it, or listens on the network, may use the view. From elsewhere,\n"
    "put this machine's address into the link."
)


def outcome(record: MechanismRecord, *, host: str, port: int, allow_network: bool, link: str, opens: bool) -> Outcome:
    """Run the view until it is interrupted."""
    check(host, port, allow_network=allow_network)
    restored(record, link)  # raises where it is no link of this mechanism
    from assur.view.server import Served
    from assur.view.window import Window

    windows: list[Window] = []

    def opened(query: str) -> None:
        for window in windows:
            window.restore(query)

    with contextlib.ExitStack() as ends:
        served = Served(host.strip("[]"), port, Guard.new(host), opened)
        ends.callback(served.stop)
        window = Window(record, served)
        ends.callback(window.close)
        windows.append(window)
        window.restore(link)
        said = [WARNING] if not is_loopback(host) else []
        with contextlib.suppress(KeyboardInterrupt):  # from the moment on at which it says that Ctrl-C ends the view
            sys.stderr.write("\n".join([*said, f"{record.name}: {served.url}", "Ctrl-C ends the view.", ""]))
            sys.stderr.flush()
            if opens:
                webbrowser.open(ends.enter_context(leading_to(served.url)).as_uri())
            wait()
        interruption.was_the_end()
    return Outcome(EndedView(record.name, served.url), lambda: [f"the view of {record.name} has ended"])


def link_to_mode(record: MechanismRecord, mode: str, link: str) -> str:
    """A link to an assembly in an operation mode.

    Errors:
        UsageError: another link is given too. UnknownNameError: no such mode is met.
    """
    if link:
        raise UsageError(
            "--mode and --link at once: a link says where the mechanism stands", hint="give one of the two"
        )
    from assur.derived_topology import mode_values
    from assur.view.link import query
    from assur.view.snapshot import start, with_values

    return query(with_values(start(record), mode_values(record, mode)))


def wait() -> None:
    """Until Ctrl-C."""
    threading.Event().wait()


def check(host: str, port: int, *, allow_network: bool) -> None:
    """Refuse a port that there is not, and an address that others can reach where that is not allowed.

    >>> check("127.0.0.1", 0, allow_network=False)
    """
    if not 0 <= port <= LAST_PORT:
        raise UsageError(f"--port {port}; a port is a number from 1 to {LAST_PORT}", hint="leave it out for a free one")
    if not is_loopback(host) and not allow_network:
        raise UsageError(
            f"--host {host} lets other machines reach the view", hint="add --allow-network if that is wanted"
        )
