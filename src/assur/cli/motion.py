"""`assur motion`: the mechanism moving, as one file of moving pictures."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import DRAWN_DEFAULTS, Drawn, MechanismName, Outcome

ENDINGS = (".gif", ".webp", ".mp4")


def motion(
    mechanism: MechanismName,
    /,
    *,
    output: Annotated[
        str | None,
        Parameter(
            name=("-o", "--output"),
            metavar="FILE",
            help="The file, which ends in .gif, .webp or .mp4; NAME.gif if left out.",
        ),
    ] = None,
    to: Annotated[
        tuple[str, ...],
        Parameter(
            consume_multiple=1,
            metavar="VALUE",
            help="A pose to go to from home and back, one value per coordinate. All inputs swing if left out.",
        ),
    ] = (),
    frames: Annotated[int, Parameter(help="How many pictures, 8 to 240; 48 if left out.")] = 48,
    seconds: Annotated[float, Parameter(help="How long one turn takes, 0.1 to 60; 4 if left out.")] = 4.0,
    size: Annotated[int, Parameter(help="Pixels of the longest side, 64 to 1280; 480 if left out.")] = 480,
    shared: Drawn = DRAWN_DEFAULTS,
) -> Outcome:
    """Write moving pictures of a closed motion from home, the mode kept.

    All inputs swing, each a little behind the one before, as far as the mode and
    the limits of the file let them; or, with --to, the platform goes straight to
    a pose and back. The platform point leaves a red line. MP4 needs the program
    ffmpeg, which pip install '.[movie]' brings; GIF and WebP need nothing. An
    old file is replaced whole or not at all.

    For example:
        assur motion zeng2019 -o zeng.gif
        assur motion fivebar --to 40 240 --frames 24 -o fivebar.webp
    """
    record = shared.mechanism(mechanism)
    from assur.cli.paths import output_file
    from assur.figures.motion import check_film, ffmpeg

    path = output_file(output or f"{record.name}.gif", ENDINGS)
    check_film(frames, size, seconds)
    if path.suffix.lower() == ".mp4":
        ffmpeg()
    from assur.cli.filmed import outcome

    return outcome(record, path, to, frames=frames, seconds=seconds, size=size, shared=shared)
