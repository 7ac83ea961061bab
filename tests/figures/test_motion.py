"""Films: every frame is an assembly in the mode of home, the last one leads to the first, and the files open."""

import importlib.util
import io
import re
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import assur
from assur.errors import UsageError
from assur.figures.motion import check_film, encoded_film, ffmpeg, film, there_and_back
from assur.joint_graph.geometry import characteristic_length
from assur.kinematics.closure import closure_error
from assur.kinematics.named_signs import named_signs
from assur.kinematics.pose import pose_of
from assur.numerics import rotations
from assur.scene.mesh import rgb

FEW, SMALL = 8, 64


@pytest.fixture(scope="module")
def fivebar():
    return film(assur.load("fivebar"), FEW, SMALL)


@pytest.mark.parametrize(("name", "way"), [("fivebar", [30.0, -30.0]), ("zeng2019", [20.0, 30.0, -25.0])])
def test_a_way_goes_to_the_pose_and_back_in_one_mode(name, way):
    record = assur.load(name)
    home = pose_of(record, record.home_values)
    values = there_and_back(record, home + way, FEW)
    assert np.max(closure_error(record, values)) < 1e-9 * characteristic_length(record)
    signs = named_signs(record, "inverse", values)
    assert np.all(signs == signs[0])
    np.testing.assert_allclose(values[-1], values[0], atol=1e-9)
    np.testing.assert_allclose(values[1:], values[:-1][::-1], atol=1e-6 * characteristic_length(record))


@pytest.mark.parametrize(("name", "way"), [("fivebar", [30.0, -30.0]), ("zeng2019", [20.0, 30.0, -25.0])])
def test_frames_stand_on_the_straight_way(name, way):
    record = assur.load(name)
    poses = pose_of(record, there_and_back(record, pose_of(record, record.home_values) + way, FEW))
    shares = (1 - np.cos(2 * np.pi * np.arange(FEW + 1) / FEW)) / 2
    np.testing.assert_allclose(poses, poses[0] + shares[:, None] * way, atol=1e-8 * characteristic_length(record))


def test_a_quaternion_turns_evenly_the_short_way():
    record = assur.load("gough_stewart")
    home = pose_of(record, record.home_values)
    turn = rotations.from_vector(np.radians([0.0, 0.0, 6.0])) @ rotations.from_quaternion(home[3:])
    values = there_and_back(record, [*home[:3], *(-rotations.to_quaternion(turn))], FEW)
    turns = rotations.from_quaternion(pose_of(record, values)[:, 3:])
    angles = np.degrees(np.linalg.norm([rotations.to_vector(turn @ turns[0].T) for turn in turns], axis=1))
    np.testing.assert_allclose(angles, 6.0 * (1 - np.cos(2 * np.pi * np.arange(FEW + 1) / FEW)) / 2, atol=1e-6)


def test_to_home_it_stands_still():
    record = assur.load("fivebar")
    values = there_and_back(record, pose_of(record, record.home_values), FEW)
    np.testing.assert_array_equal(values, np.repeat(record.home_values[None], FEW + 1, axis=0))


def test_over_poses_it_passes_every_one_of_them():
    record = assur.load("fivebar")
    home = pose_of(record, record.home_values)
    right, below = np.array([[30.0, 0.0], [30.0, -30.0]])
    poses = pose_of(record, there_and_back(record, [home + right, home + below], 12))
    np.testing.assert_allclose(poses[3], home + right, atol=1e-6)
    np.testing.assert_allclose(poses[6], home + below, atol=1e-6)


def test_poses_are_those_of_the_direct_problem(fivebar):
    record = assur.load("fivebar")
    for values, pose in zip(fivebar.values, fivebar.poses, strict=True):
        inputs = [values[item.coordinate.index] * item.sign + item.offset for item in record.inputs]
        solved = record.direct(inputs)
        gap = np.min(np.linalg.norm(solved.poses[solved.exists] - pose, axis=-1))
        assert gap < 1e-8 * characteristic_length(record)


def test_pictures_show_one_turn_without_a_jump(fivebar):
    assert fivebar.pictures.dtype == np.uint8
    assert fivebar.pictures.shape[0] == FEW
    assert max(fivebar.pictures.shape[1:3]) == SMALL
    steps = np.linalg.norm(np.diff(fivebar.poses, axis=0, append=fivebar.poses[:1]), axis=1)
    assert steps[-1] < 2 * np.max(steps[:-1])  # the first frame follows the last one as any other
    rim = np.concatenate([fivebar.pictures[:, [0, -1]].reshape(-1, 3), fivebar.pictures[:, :, [0, -1]].reshape(-1, 3)])
    assert np.all(rim == 255)  # nothing is cut
    assert all(np.any(one != two) for one, two in zip(fivebar.pictures, np.roll(fivebar.pictures, -1, 0), strict=True))


@pytest.mark.parametrize("form", ["gif", "webp"])
def test_a_file_has_every_frame_and_runs_for_ever(fivebar, form):
    data = encoded_film(fivebar.pictures, form, seconds=1.0)
    assert data == encoded_film(fivebar.pictures, form, seconds=1.0)
    opened = Image.open(io.BytesIO(data))
    assert (opened.format, opened.n_frames, opened.info["loop"]) == (form.upper(), FEW, 0)
    total = 0
    for k in range(FEW):
        opened.seek(k)
        opened.load()
        total += opened.info["duration"]
        shown = np.asarray(opened.convert("RGB"), dtype=int)
        assert np.mean(np.abs(shown - fivebar.pictures[k])) < (3.0 if form == "gif" else 1e-9)
    assert total == 1000


FAKE = """#!{python}
import pathlib, sys
data = sys.stdin.buffer.read()
if {fails}:
    sys.stderr.write("no such codec")
    sys.exit(3)
pathlib.Path(sys.argv[-1]).write_bytes(" ".join(sys.argv[1:-1]).encode() + b"|%d" % len(data))
"""


def stand_in(folder, monkeypatch, *, fails):
    """A program named ffmpeg that writes what it was told and how many bytes it read."""
    path = folder / "ffmpeg"
    path.write_text(FAKE.format(python=sys.executable, fails=fails))
    path.chmod(0o755)
    monkeypatch.setenv("PATH", str(folder))


def test_an_mp4_is_made_by_ffmpeg(tmp_path, monkeypatch):
    stand_in(tmp_path, monkeypatch, fails=False)
    pictures = np.zeros((10, 65, 41, 3), dtype=np.uint8)
    words, size = encoded_film(pictures, "mp4", seconds=2.0).split(b"|")
    assert b"-s 40x64 -r 5.000000 -i -" in words  # even sides, ten frames in two seconds
    assert int(size) == 10 * 40 * 64 * 3


def read_back(data, path):
    """The frames (k, h, w, 3) of a file, decoded, and in words what it says of itself."""
    path.write_bytes(data)
    words = [ffmpeg(), "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(words, capture_output=True, check=True)
    said = " ".join(line for line in done.stderr.decode().splitlines() if "Duration" in line or "Video: h264" in line)
    width, height = map(int, re.search(r" (\d+)x(\d+)[, ]", said).groups())
    return np.frombuffer(done.stdout, np.uint8).reshape(-1, height, width, 3), said


@pytest.fixture
def without_a_system(tmp_path, monkeypatch):
    """No ffmpeg but that of the extra."""
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("IMAGEIO_FFMPEG_EXE", raising=False)


@pytest.mark.movie
@pytest.mark.usefixtures("without_a_system")
def test_an_mp4_that_is_read_back_has_every_frame_as_it_was_drawn(fivebar, tmp_path):
    data = encoded_film(fivebar.pictures, "mp4", seconds=2.0)
    shown, said = read_back(data, tmp_path / "m.mp4")
    height, width = fivebar.pictures.shape[1:3]
    assert shown.shape == (FEW, height - height % 2, width - width % 2, 3)
    assert "Duration: 00:00:02.00," in said
    assert f" {FEW // 2} fps," in said
    assert " yuv420p(" in said
    assert data[4:8] == b"ftyp"
    assert data.index(b"moov") < data.index(b"mdat")  # it plays while it is still read
    drawn = fivebar.pictures[:, : shown.shape[1], : shown.shape[2]].astype(float)
    gaps = np.array([[np.mean(np.abs(one - other)) for other in drawn] for one in shown.astype(float)])
    assert np.max(np.diag(gaps)) < 3.0
    np.testing.assert_array_equal(np.argmin(gaps, axis=1), np.arange(FEW))


@pytest.mark.movie
@pytest.mark.usefixtures("without_a_system")
def test_the_colours_of_an_mp4_are_those_that_were_drawn(tmp_path):
    """Whole frames of one colour: what a swapped channel, another matrix or another range would change."""
    colours = [
        rgb(name) for name in ("#ff0000", "#00ff00", "#0000ff", "#ffffff", "#000000", "#c44e52", "#4c72b0", "#dddddd")
    ]
    drawn = np.round(255 * np.array(colours)).astype(np.uint8)
    pictures = np.broadcast_to(drawn[:, None, None], (8, 64, 96, 3)).copy()
    shown, said = read_back(encoded_film(pictures, "mp4", seconds=1.0), tmp_path / "m.mp4")
    assert "(tv, bt709" in said
    assert np.max(np.abs(shown.astype(int) - pictures)) <= 4


def test_what_ffmpeg_complains_of_is_said(tmp_path, monkeypatch):
    stand_in(tmp_path, monkeypatch, fails=True)
    with pytest.raises(UsageError, match="ffmpeg made no MP4: no such codec"):
        encoded_film(np.zeros((8, 64, 64, 3), dtype=np.uint8), "mp4")


@pytest.mark.parametrize("package", ["missing", "without a program"])
def test_without_ffmpeg_there_is_a_hint(tmp_path, monkeypatch, package):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", SimpleNamespace(get_ffmpeg_exe=_none))
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None if package == "missing" else True)
    with pytest.raises(UsageError, match="ffmpeg, which is not found") as caught:
        ffmpeg()
    assert caught.value.hint == "pip install '.[movie]' in assur's folder brings one; or write .gif or .webp"


def _none():
    raise RuntimeError("No ffmpeg exe could be found.")


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"frames": 7}, "frames: 7; from 8 to 240"),
        ({"frames": 241}, "frames: 241"),
        ({"size": 5000}, "size: 5000; from 64 to 1280"),
        ({"seconds": 0.0}, "seconds: 0; from 0.1 to 60"),
        ({"seconds": float("nan")}, "seconds: nan"),
    ],
)
def test_numbers_out_of_range_are_refused(asked, message):
    with pytest.raises(UsageError, match=message):
        check_film(**asked)


def test_another_form_is_refused(fivebar):
    with pytest.raises(UsageError, match="form 'avi' of a film; there is: gif, webp, mp4"):
        encoded_film(fivebar.pictures, "avi")


def test_a_barred_way_says_what_bars_it():
    with pytest.raises(UsageError, match=r"the way from home is barred: stopped at .* serial singularity"):
        there_and_back(assur.load("fivebar"), [0.0, 400.0], FEW)
