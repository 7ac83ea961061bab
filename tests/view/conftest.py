"""What the view's tests run in: a server that is ended in any case, and Chromium in a thread of its own."""

import socket
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

FLAGS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
SECONDS = 280


@pytest.fixture(scope="module")
def served():
    """A server behind its guard, with the queries of the pages that were opened; no thread is left when it ends."""
    from assur.view.guard import Guard
    from assur.view.server import Served

    before = set(threading.enumerate())
    opened: list[str] = []
    found = Served("127.0.0.1", 0, Guard.new(), opened.append)
    yield found, opened
    found.stop()
    left = [thread for thread in set(threading.enumerate()) - before if thread.is_alive() and not thread.daemon]
    assert left == []


@pytest.fixture(scope="session")
def in_browser(chromium_path):
    """Run a function of a running Chromium; in a thread of its own, as playwright wants one for itself."""
    from playwright.sync_api import sync_playwright

    def run(body):
        with sync_playwright() as tool:
            browser = tool.chromium.launch(executable_path=chromium_path, args=list(FLAGS))
            try:
                return body(browser)
            finally:
                browser.close()

    def in_thread(body):
        with ThreadPoolExecutor(1) as pool:
            return pool.submit(run, body).result(timeout=SECONDS)

    return in_thread


@pytest.fixture(scope="session")
def talk():
    """Send bytes to a port of this machine, and what comes back."""

    def exchange(port: int, sent: bytes) -> bytes:
        with socket.create_connection(("127.0.0.1", port), timeout=10) as line:
            line.settimeout(3)
            received = b""
            try:
                line.sendall(sent)
                while part := line.recv(65536):
                    received += part
                    if received.startswith(b"HTTP/1.1 101"):
                        break
            except (TimeoutError, ConnectionResetError, BrokenPipeError):
                pass
            return received

    return exchange
