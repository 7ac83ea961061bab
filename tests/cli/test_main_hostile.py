"""Files, command lines and certificates by chance: none is answered by a traceback, none that is forged is accepted.

`make test-deep` tries 4000 files, 300 command lines and 400 certificates; each failure is named by its seed.
"""

import json
from importlib.resources import files
from pathlib import Path

import pytest

import hostile
from assur.errors import hidden
from assur.model.registry import names, topology_names

CODES = {0, 1, 2, 3, 4, 5, 6}
"""Every code but that of a bug of ours."""
HERE = Path(__file__).parents[1] / "model"
FOLDER = Path(str(files("assur"))) / "mechanisms"
TEXTS = [
    *((HERE / "fourbar.toml").read_text(encoding="utf-8") for _ in range(4)),
    (HERE / "file" / "delta.toml").read_text(encoding="utf-8"),
    *((FOLDER / name / "mechanism.toml").read_text(encoding="utf-8") for name in names()),
    *((FOLDER / name / "topology.toml").read_text(encoding="utf-8") for name in topology_names()[:4]),
]


def answered(run, words):
    """A run ended by a code of ours, with no word that a terminal obeys."""
    assert run.code in CODES, (words, run.err)
    assert "Traceback" not in run.err
    assert hidden(run.out) == hidden(run.err) == "", words


def look_at_files(assur_cli, folder, seeds):
    path = folder / "f.toml"
    for seed in seeds:
        path.write_text(hostile.mutated(TEXTS[seed % len(TEXTS)], seed), encoding="utf-8", newline="")
        run = assur_cli("check", str(path))
        answered(run, f"file {seed}")
        assert run.code in (0, 2, 3), seed


def look_at_command_lines(assur_cli, folder, monkeypatch, seeds):
    monkeypatch.chdir(folder)
    for seed in seeds:
        words = hostile.command_line(seed)
        answered(assur_cli(*words), f"command line {seed}: {words}")


def look_at_certificates(assur_cli, folder, seeds):
    path, forgery = folder / "c.json", folder / "forged.json"
    for k, kind in enumerate(("workspace", "box")):
        box = ("--box", "x=-20:20,y=180:220") if kind == "box" else ()
        made = assur_cli("certify", "fivebar", "-o", str(path), "--kind", kind, "--most", "40", *box)
        assert made.code in (0, 5)
        document = json.loads(path.read_text(encoding="utf-8"))
        for seed in seeds[k::2]:
            content, other = hostile.forged(document, seed)
            forgery.write_bytes(content)
            run = assur_cli("verify", str(forgery), "--mechanism", "fivebar")
            answered(run, f"certificate {seed}")
            assert not other or run.code in (1, 2, 3), (seed, run.out)


def test_files_by_chance(assur_cli, tmp_path):
    look_at_files(assur_cli, tmp_path, range(24))


def test_command_lines_by_chance(assur_cli, tmp_path, monkeypatch):
    look_at_command_lines(assur_cli, tmp_path, monkeypatch, range(24))


def test_certificates_by_chance(assur_cli, tmp_path):
    look_at_certificates(assur_cli, tmp_path, range(24))


@pytest.mark.deep
@pytest.mark.parametrize("hundred", range(40))
def test_4000_files_by_chance(assur_cli, tmp_path, hundred):
    look_at_files(assur_cli, tmp_path, range(1000 + 100 * hundred, 1100 + 100 * hundred))


@pytest.mark.deep
@pytest.mark.parametrize("fifty", range(6))
def test_300_command_lines_by_chance(assur_cli, tmp_path, monkeypatch, fifty):
    look_at_command_lines(assur_cli, tmp_path, monkeypatch, range(1000 + 50 * fifty, 1050 + 50 * fifty))


@pytest.mark.deep
@pytest.mark.parametrize("hundred", range(4))
def test_400_certificates_by_chance(assur_cli, tmp_path, hundred):
    look_at_certificates(assur_cli, tmp_path, range(1000 + 100 * hundred, 1100 + 100 * hundred))
