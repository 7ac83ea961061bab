"""A motion as moving pictures: there and back in one mode, from the same parts, the same light and the same camera."""

from __future__ import annotations

import importlib.util
import io
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from PIL import Image

from assur.errors import UsageError, extra_hint
from assur.figures.canvas import View
from assur.figures.context import Context
from assur.figures.raster import SAMPLES, filled, lit
from assur.figures.solid import model_camera
from assur.figures.style import RED
from assur.kinematics.following.course import course
from assur.kinematics.following.following import LARGEST_STEP, follow
from assur.kinematics.home import home_values
from assur.kinematics.pose import pose_of
from assur.model.mechanism import MechanismRecord
from assur.scene.mesh import Mesh, box, joined, rgb
from assur.scene.motion import closed_motion
from assur.scene.part import Part
from assur.scene.parts import machine, placed, unit
from assur.scene.skeleton import Skeleton, skeleton
from assur.work import Progress

FloatArray = NDArray[np.float64]
Form = Literal["gif", "webp", "mp4"]

FRAMES, SIZES, SECONDS = (8, 240), (64, 1280), (0.1, 60.0)
"""What may be asked for: frames, pixels of the longest side, seconds of a turn."""

COLOURS = 256
COLOURS_MEAN = (
    *("-vf", "scale=out_color_matrix=bt709:out_range=tv"),
    *("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"),
)
"""Of an MP4: without these words each player takes its own guess at what its colours mean."""

DOTS = 72.0
"""A point of a view is a pixel."""

HIDDEN = 0.35
"""How strong the trace is where it is hidden."""

MARGIN = 0.04
"""White on each side, as a share of the longest side."""

_ONE = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True, eq=False)
class Film:
    """A closed motion in k frames; the frame after the last one is the first one.

    Attributes:
        values: (k, n) joint values.
        poses: (k, m) of the platform, in the file's coordinates, lengths and rad.
        pictures: (k, h, w, 3) bytes.
    """

    values: FloatArray
    poses: FloatArray
    pictures: NDArray[np.uint8]


def film(
    record: MechanismRecord,
    frames: int = 48,
    size: int = 480,
    *,
    to: ArrayLike | None = None,
    progress: Progress | None = None,
) -> Film:
    """Pictures of a closed motion from home; the mode is kept, and the platform point leaves a red line.

    Args:
        record: the mechanism.
        frames: how many, 8 to 240.
        size: pixels of the longest side, 64 to 1280.
        to: (m,) or (k, m) pose or poses to go to, straight, and back; all inputs swing where none is given.
        progress: called with (frames done, frames in all).

    Errors: `UsageError` for numbers out of range, where the way to a pose is barred, and where nothing can swing.

    >>> from assur.model.registry import load_record
    >>> found = film(load_record("fivebar"), 8, 64, to=[30.0, 250.0])
    >>> found.pictures.shape[0], found.poses[4].round(9).tolist()
    (8, [30.0, 250.0])
    """
    check_film(frames, size)
    values = closed_motion(record, frames) if to is None else there_and_back(record, to, frames)
    values = values[:-1]
    context = Context(record)
    bodies = [skeleton(record, context.companion, row) for row in values]
    solids = machine(record)
    view, sides = _view(context, solids, bodies, size)
    trace = _trace(bodies)
    pictures = []
    for k, body in enumerate(bodies):
        pictures.append(_frame(placed(solids, body), trace, view, sides))
        if progress:
            progress(k + 1, len(bodies))
    return Film(values, pose_of(record, values), np.array(pictures))


def _frame(mesh: Mesh, trace: Mesh, view: View, sides: tuple[float, float]) -> NDArray[np.uint8]:
    """A picture on white; the trace runs over it, pale where it is hidden."""
    found, line = filled(mesh, view, sides, DOTS), filled(trace, view, sides, DOTS)
    image = lit(mesh, view, found, DOTS)
    flat = image[..., :3] * image[..., 3:] + 1.0 - image[..., 3:]
    strength = np.where(line.depth > found.depth, 1.0, HIDDEN) * (line.face >= 0)
    height, width = image.shape[:2]
    cover = strength.reshape(height, SAMPLES, width, SAMPLES).mean(axis=(1, 3))[::-1, :, None]
    return np.asarray(np.round(255 * (flat * (1 - cover) + rgb(RED) * cover)).astype(np.uint8))


def there_and_back(record: MechanismRecord, to: ArrayLike, frames: int) -> FloatArray:
    """Joint values (frames + 1, n) from home to a pose (m,), over poses (k, m), and back the same way.

    It slows down at both ends. Every frame is followed to with its pose prescribed, from the frame before: poses are
    those of the straight way, as near a parallel singularity as it may pass, where inputs would hardly hold them.

    Errors: `UsageError` that says what bars the way.
    """
    home = home_values(record)
    _unbarred(record, home, to, LARGEST_STEP)
    way = course(record, "poses", pose_of(record, home), to)
    found = [home]
    for k in range(1, frames // 2 + 1):
        share = (1 - np.cos(2 * np.pi * k / frames)) / 2 * way.shares[-1]
        segment = int(np.searchsorted(way.shares, share)) - 1  # where the pose is home's there is none
        found.append(home if segment < 0 else _unbarred(record, found[-1], way.at(share, segment), 1.0))
    there = np.arange(frames + 1)
    return np.array(found)[np.minimum(there, frames - there)]


def _unbarred(record: MechanismRecord, joints: FloatArray, to: ArrayLike, largest_step: float) -> FloatArray:
    """Joint values (n,) at the end of the path to a pose, which must not stop before it."""
    path = follow(record, joints, poses=to, largest_step=largest_step)
    if path.stopped is not None:
        raise UsageError(
            f"{record.name}: the way from home is barred: {path.stopped}",
            hint=f"see how far it goes: assur follow {record.name} --to ...",
        )
    return np.asarray(path.joints[-1])


def encoded_film(pictures: NDArray[np.uint8], form: Form, seconds: float = 4.0) -> bytes:
    """Pictures (k, h, w, 3) as a file that runs for ever; of an MP4 it is up to the player.

    Args:
        pictures: bytes, three for each pixel.
        form: "gif", "webp", or "mp4", which needs the program ffmpeg or the extra `movie`.
        seconds: of one turn, 0.1 to 60. A GIF counts in hundredths of a second.

    Errors: `UsageError` for another form, for numbers out of range, and where ffmpeg is missing or fails.
    """
    check_film(seconds=seconds)
    if form == "mp4":
        return _mp4(pictures, len(pictures) / seconds)
    if form not in ("gif", "webp"):
        raise UsageError(f"form {form!r} of a film; there is: gif, webp, mp4")
    ends = np.round(np.arange(len(pictures) + 1) * seconds * 100 / len(pictures)) * 10
    images = [Image.fromarray(item) for item in pictures]
    options: dict[str, Any] = {"lossless": True, "method": 3} if form == "webp" else {"disposal": 1, "optimize": False}
    if form == "gif":
        table = _colours(pictures)
        images = [item.quantize(palette=table, dither=Image.Dither.NONE) for item in images]
    stream = io.BytesIO()
    durations = np.diff(ends).astype(int).tolist()
    images[0].save(stream, format=form, save_all=True, append_images=images[1:], duration=durations, loop=0, **options)
    return stream.getvalue()


def ffmpeg() -> str:
    """The program that makes an MP4: the system's, or that of the extra `movie`. Error: `UsageError` without both."""
    found = shutil.which("ffmpeg") or _ffmpeg_of_the_extra()
    if not found:
        raise UsageError(
            "an MP4 needs the program ffmpeg, which is not found",
            hint=f"{extra_hint('movie')} brings one; or write .gif or .webp",
        )
    return found


def _ffmpeg_of_the_extra() -> str:
    """The program that the wheel of imageio-ffmpeg carries; "" without it, or where it carries none."""
    if not importlib.util.find_spec("imageio_ffmpeg"):
        return ""
    import imageio_ffmpeg

    try:
        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except RuntimeError:  # not from a wheel
        return ""


def _mp4(pictures: NDArray[np.uint8], rate: float) -> bytes:
    height, width = (side - side % 2 for side in pictures.shape[1:3])  # its colours are halved along each side
    cut = np.ascontiguousarray(pictures[:, :height, :width])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        raw = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", f"{rate:.6f}", "-i", "-")
        made = ("-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart")
        words = [ffmpeg(), "-y", "-loglevel", "error", *raw, *COLOURS_MEAN, *made, str(path)]
        done = subprocess.run(words, input=cut.tobytes(), capture_output=True, check=False)
        if done.returncode or not path.is_file():
            said = " ".join(done.stderr.decode(errors="replace").split())[:200]
            raise UsageError(
                f"ffmpeg made no MP4: {said or f'exit code {done.returncode}'}", hint="write .gif or .webp"
            )
        return path.read_bytes()


def _colours(pictures: NDArray[np.uint8]) -> Image.Image:
    """One table of colours for all frames, so that nothing flickers."""
    few = pictures[:: max(1, len(pictures) // 6)]
    return Image.fromarray(np.concatenate(few)).quantize(COLOURS, method=Image.Quantize.MEDIANCUT)


def _view(
    context: Context, solids: tuple[Part, ...], bodies: list[Skeleton], size: int
) -> tuple[View, tuple[float, float]]:
    """A view in pixels that holds every frame, and the sides of the picture."""
    camera = model_camera(context)
    flat = [camera.project(placed(solids, body).corners.reshape(-1, 3)) for body in bodies]
    low = np.min([item.min(axis=0) for item in flat], axis=0)
    high = np.max([item.max(axis=0) for item in flat], axis=0)
    scale = (1 - 2 * MARGIN) * size / float(np.max(high - low))
    width, height = np.round(scale * (high - low) + 2 * MARGIN * size)
    view = View(camera, scale, np.array([width, height]) / 2 - scale * (low + high) / 2)
    return view, (float(width), float(height))


def _trace(bodies: list[Skeleton]) -> Mesh:
    """The closed way of the platform point as thin rods."""
    platform, thin = bodies[0].record.platform, 0.16 * unit(bodies[0])
    points = np.array(
        [body.frames[platform.link][0] @ platform.point + body.frames[platform.link][1] for body in bodies]
    )
    rods = []
    for start, end in zip(points, np.roll(points, -1, axis=0), strict=True):
        length = float(np.linalg.norm(end - start))
        along = (end - start) / length if length > 0 else _ONE
        across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
        across = across / np.linalg.norm(across)
        sides = np.stack([(length / 2 + thin) * along, thin * across, thin * np.cross(along, across)])
        rods.append(box((start + end) / 2, sides, RED))
    return joined(rods)


def check_film(frames: int = 48, size: int = 480, seconds: float = 4.0) -> None:
    """Refuse what is out of range, with a `UsageError`.

    >>> check_film(frames=24)
    """
    asked = (("frames", frames, FRAMES), ("size", size, SIZES), ("seconds", seconds, SECONDS))
    for name, value, (low, high) in asked:
        if not low <= value <= high:
            raise UsageError(f"{name}: {value:g}; from {low:g} to {high:g}")
