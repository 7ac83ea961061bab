"""The page on certificates says what the code does."""

import re
from pathlib import Path

from assur.certificates.certificate import CLAIMS, certificate
from assur.cli import exit_codes
from assur.cli.main import main
from assur.model.registry import load_record
from assur.verifier import check, program, reading

PAGE = (Path(__file__).parents[2] / "docs" / "certificates.md").read_text(encoding="utf-8")


def first_cells(head):
    rows = PAGE.split(head)[1].split("\n\n")[0].splitlines()[2:]
    return [row.strip("|").split("|")[0].strip() for row in rows]


def test_kinds_and_signs():
    assert first_cells("| kind | claims |"[:-1]) == [f"`{kind}`" for kind in CLAIMS]
    assert check.CLAIMS == CLAIMS
    assert (reading.FORMAT, reading.VERSION) == ("assur certificate", 3)
    assert first_cells("| sign | means |"[:-1]) == ["`0` to `9`", "`i`", "`r`", "`oNN`", "`b`"]
    for token in ("0", "9", "i", "r", "o0f", "b"):
        assert check.TOKEN.fullmatch(token)


def test_the_parts_of_a_path():
    page = PAGE.split("## A path")[1].split("## ")[0]
    assert {"from", "to", "points", "boxes"} <= set(re.findall(r"`(\w+)`", page))
    assert reading.KEYS["statement"] - {"box"} | {"from", "to", "points", "boxes"} == reading.PATH
    assert f"(exit code {exit_codes.NO})" in page
    assert f"undecided ({exit_codes.UNDECIDED})" in page


def test_lines_of_the_verifier():
    folder = Path(check.__file__).parent
    assert "about 1 900 lines, and 1 550 more for derivations" in PAGE
    assert 1850 <= written_lines(folder) < 1950
    assert 1525 <= written_lines(folder / "derivations") < 1575


def written_lines(folder):
    texts = [path.read_text(encoding="utf-8") for path in folder.glob("*.py")]
    return sum(bool(line.strip()) for text in texts for line in text.splitlines())


def test_operations_and_bits():
    text = PAGE.split("list of operations (")[1].split(")\n")[0]
    named = {word for part in re.findall(r"`([^`]+)`", text) for word in part.split()}
    assert named == {*program.TWO, *program.ONE}
    assert f"of {check.BITS} bits" in PAGE


def test_exit_codes():
    assert first_cells("| exit code | means |"[:-1]) == ["0", "1", "3", "5"]
    assert (exit_codes.FAILS, exit_codes.BAD_FILE, exit_codes.UNDECIDED) == (1, 3, 5)


def test_the_commands_run(tmp_path):
    for line in re.findall(r"^    assur (.+)$", PAGE, re.MULTILINE):
        words = [str(tmp_path / word) if word.endswith(".json") else word for word in line.split()]
        assert main(words) == 0


def test_ten_times_the_leaves_in_the_plane():
    """A tenth of the gap takes about ten times the leaves: between five and twenty."""
    count = [sum(certificate(load_record("zeng2019"), gap=gap).claims["leaves"].values()) for gap in (3e-2, 3e-3)]
    assert 5 < count[1] / count[0] < 20
