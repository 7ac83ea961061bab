"""What cannot be derived."""

from __future__ import annotations

from assur.errors import AssurError


class NotDerivedError(AssurError):
    """What the method does not reach; the message says what resists."""
