"""The file that leads a browser to the link: where it leads, who can read it, and that it is gone at the end."""

import html
import re
import stat

import pytest

from assur.view.opening import leading_to

URL = "http://127.0.0.1:8123/to-ken_/?a=1&b=2"


def test_it_leads_to_the_address_and_nothing_else_stands_in_it():
    with leading_to(URL) as path:
        page = path.read_text(encoding="utf-8")
    targets = {html.unescape(item) for item in re.findall(r'(?:url=|href=")([^"]+)"', page)}
    assert targets == {URL}
    assert "<script" not in page


def test_only_this_user_reads_it():
    with leading_to(URL) as path:
        assert stat.S_IMODE(path.stat().st_mode) == 0o600
        assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700
        assert "to-ken_" not in str(path)


def test_it_is_deleted_in_any_case():
    with pytest.raises(KeyboardInterrupt), leading_to(URL) as path:
        raise KeyboardInterrupt
    assert not path.parent.exists()
