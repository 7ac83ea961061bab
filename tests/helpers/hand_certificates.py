"""What certificates that a test writes by hand have beside what it is about: no joints, and no exact check."""

NO_JOINTS = {"joints": [], "jp": [], "jq": []}
UNPROVED = {
    **{"says": "by hand", "proved": False, "any_dimensions": True, "guards_left_out": False, "places": 0},
    **{"checked": [], "primes": [], "parallel": [], "serial": [], "degree": (0.0).hex(), "error": (1.0).hex()},
}
