"""The certificates of the neighbouring folder, for the verifier's tests too."""

import importlib.util
from pathlib import Path

PLACE = Path(__file__).parents[1] / "certificates" / "conftest.py"
spec = importlib.util.spec_from_file_location("certificates_for_tests", PLACE)
shared = importlib.util.module_from_spec(spec)
spec.loader.exec_module(shared)
case, made_of, path_of, forged = shared.case, shared.made_of, shared.path_of, shared.forged
