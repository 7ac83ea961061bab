"""Opening: a browser is given a private file that leads to the link.

What a program is started with is seen by every user of the machine, so the link, which holds the token, is not given.
"""

from __future__ import annotations

import contextlib
import html
import tempfile
from collections.abc import Iterator
from pathlib import Path

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="referrer" content="no-referrer">
<meta http-equiv="refresh" content="0; url={url}">
<title>assur</title>
</head>
<body><a href="{url}">The live view</a></body>
</html>
"""


@contextlib.contextmanager
def leading_to(url: str) -> Iterator[Path]:
    """A file that only this user can read, in a folder of its own, and that leads a browser to an address.

    Both are deleted at the end.

    >>> with leading_to("http://127.0.0.1:1/token/") as path:
    ...     oct(path.stat().st_mode)[-3:], oct(path.parent.stat().st_mode)[-3:], "/token/" in path.read_text()
    ('600', '700', True)
    >>> path.parent.exists()
    False
    """
    with tempfile.TemporaryDirectory(prefix="assur-view-", ignore_cleanup_errors=True) as folder:
        path = Path(folder) / "open.html"
        path.touch(mode=0o600, exist_ok=False)
        path.write_text(PAGE.format(url=html.escape(url)), encoding="utf-8")
        yield path
