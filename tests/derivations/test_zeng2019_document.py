"""Every test that docs/derivations/zeng2019.md calls as a witness exists."""

import re
from pathlib import Path

HERE = Path(__file__).parent
DOCUMENT = HERE.parents[1] / "docs" / "derivations" / "zeng2019.md"


def test_every_witness_of_the_derivation_is_a_test():
    groups = re.findall(r"\[((?:`\w+`,?\s*)+)\]", DOCUMENT.read_text(encoding="utf-8"))
    named = {name for group in groups for name in re.findall(r"`(\w+)`", group)}
    sources = "\n".join(path.read_text(encoding="utf-8") for path in HERE.glob("test_zeng2019_*.py"))
    tests = set(re.findall(r"def test_(\w+)\(", sources))
    assert len(named) > 30
    assert sorted(named - tests) == []
