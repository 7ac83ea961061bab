"""The audit of a mechanism, run once for all tests of a process: it takes seconds, and it is frozen data."""

from functools import cache

import assur
from assur.audit.audit import audit


@cache
def audited(name):
    return audit(assur.load(name))
