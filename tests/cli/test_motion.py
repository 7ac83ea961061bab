import subprocess

import numpy as np
import pytest
from PIL import Image

import assur
from assur.figures.motion import ffmpeg

SMALL = ("--frames", "8", "--size", "64")


@pytest.mark.parametrize("ending", ["gif", "webp"])
def test_a_film_is_written_and_described(assur_cli, tmp_path, ending):
    path = tmp_path / f"m.{ending}"
    run = assur_cli("motion", "fivebar", "-o", str(path), *SMALL, "--seconds", "2", "--json")
    assert (run.code, run.err) == (0, "")
    assert run.json["file"] == str(path)
    assert run.json["bytes"] == path.stat().st_size
    with Image.open(path) as opened:
        assert (opened.format.lower(), opened.n_frames, list(opened.size)) == (ending, 8, run.json["pixels"])
    record = assur.load("fivebar")
    for pose, inputs in zip(run.json["poses"], run.json["inputs"], strict=True):
        factor = np.pi / 180 if record.angle == "deg" else 1.0
        found = record.direct(np.array(inputs) * factor)
        assert np.min(np.linalg.norm(found.poses[found.exists] - pose, axis=-1)) < 1e-6


def test_a_pose_is_gone_to_and_left_again(assur_cli, tmp_path):
    path = tmp_path / "m.gif"
    run = assur_cli("motion", "fivebar", "--to", "30", "250", "-o", str(path), *SMALL, "--json")
    assert run.code == 0
    poses = np.array(run.json["poses"])
    np.testing.assert_allclose(poses[4], [30, 250], atol=1e-6)
    np.testing.assert_allclose(poses[1:], poses[1:][::-1], atol=1e-6)


def test_a_person_reads_how_far_it_goes(assur_cli, tmp_path):
    path = tmp_path / "m.gif"
    run = assur_cli("motion", "fivebar", "--to", "30", "250", "-o", str(path), *SMALL)
    assert (run.code, run.err) == (0, "")
    assert "fivebar, motion\n" in run.out
    assert " to 30.0000 mm\n" in run.out
    assert "8 frames of " in run.out
    assert f"written: {path}" in run.out.replace("\n", "")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("-o", "m.avi"), "error: cannot write m.avi: its ending is none of .gif, .webp, .mp4\n"),
        (("--frames", "3"), "error: --frames: 3; from 8 to 240\n"),
        (("--size", "1"), "error: --size: 1; from 64 to 1280\n"),
        (("--seconds", "0"), "error: --seconds: 0; from 0.1 to 60\n"),
        (("--to", "1"), "error: --to, pose of fivebar: 1 value, 2 wanted\n"),
        (("--to", "1", "far"), "error: "),
        (("--to", "0", "400"), "error: fivebar: the way from home is barred: stopped at "),
    ],
)
def test_wrong_input_is_refused_and_nothing_is_written(assur_cli, tmp_path, monkeypatch, words, message):
    monkeypatch.chdir(tmp_path)
    run = assur_cli("motion", "fivebar", *words)
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith(message)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.movie
def test_an_mp4_is_written_and_described(assur_cli, tmp_path):
    path = tmp_path / "m.mp4"
    run = assur_cli("motion", "fivebar", "-o", str(path), *SMALL, "--seconds", "2", "--json")
    assert (run.code, run.err, run.json["format"]) == (0, "", "mp4")
    width, height = run.json["pixels"]
    told = subprocess.run([ffmpeg(), "-i", str(path)], capture_output=True, text=True, check=False).stderr
    assert "Duration: 00:00:02.00," in told
    assert f" {width}x{height}" in told


def test_an_mp4_without_ffmpeg_is_refused_before_the_work(assur_cli, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("assur.figures.motion._ffmpeg_of_the_extra", str)
    run = assur_cli("motion", "fivebar", "-o", str(tmp_path / "m.mp4"))
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith(
        "error: an MP4 needs the program ffmpeg, which is not found\nhint: pip install '.[movie]' "
    )
    assert list(tmp_path.iterdir()) == []
