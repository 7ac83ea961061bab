"""What certificates that a test writes by hand have beside what it is about: no joints, and no exact check."""

from assur.verifier.reading import AT_PLACES

NO_JOINTS = {"joints": [], "jp": [], "jq": []}
UNPROVED = {"says": AT_PLACES, "parallel": [], "serial": []}
