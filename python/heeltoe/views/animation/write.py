"""Writing an animation: the options are checked, the scene is built, and the file appears whole or not at all."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.atomic_files import written
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError, expect
from heeltoe.models.cost import Cost
from heeltoe.result.response import Response
from heeltoe.views.figures.dense import filled_in

if TYPE_CHECKING:
    from heeltoe.views.animation.frames import Scene

#: What an animation can be written as.
SUFFIXES = (".mp4", ".gif", ".html")
_FASTEST_RATE = 120.0
_SLOWEST, _FASTEST = 0.001, 100.0
_LARGEST_EXAGGERATION = 1e6
_MOST_FRAMES = 20_000
#: A page interpolates by itself; more moments than these would only make it larger.
_PAGE_STEP, _MOST_PAGE_FRAMES = 0.01, 3000

# Seconds of a moment of a page, and of a picture of a video; how many of these a GIF has.
_OF_PAGE, _OF_PICTURE, _MOST_PICTURES = 3e-4, 0.012, 300


def animate(
    case: Case,
    response: Response,
    path: Path | str,
    *,
    exaggerate: float | None = None,
    frames_per_second: float = 30.0,
    speed: float = 1.0,
    window: tuple[float, float | None] = (0.0, None),
) -> Path:
    """Write what a dam did in an earthquake as an animation, in the units of the case.

    Parameters
    ----------
    case
        The dam.
    response
        What an analysis of it has returned, of any model.
    path
        Where to: a video (``.mp4``, ``.gif``) or a page (``.html``) with everything in it, which any browser plays
        without a network. A file that is there is replaced.
    exaggerate
        How many times as far as they are displacements are drawn, the same for all parts. Where it is not given,
        1, 2, 5, 10, 20, ...: so many that the largest is drawn up to 8 % of the dam's height long, and no longer than a
        third of the crack. The picture says how many.
    frames_per_second
        Of a video. A GIF has at most 300 pictures, and then fewer per second; a page draws as fast as the screen.
    speed
        Seconds of the earthquake per second of the animation.
    window
        From when to when it is shown [s]; without an end, to the last.

    Returns
    -------
    Path
        Of the file.

    Raises
    ------
    InputError
        Where the file's ending is not known, a number is out of range, the response has no histories, the package for
        videos is missing, or the file cannot be written.
    """
    expect(case, Case, "a case", "case")
    expect(response, Response, "a response", "response")
    place = Path(path)
    check_options(place, exaggerate=exaggerate, frames_per_second=frames_per_second, speed=speed)
    if not response.histories:
        raise InputError("nothing-to-show", "response", response.outcome)
    shown = _window(response, *window)
    with written(place, "animation") as fresh:

        def scene(times: Floats) -> Scene:
            from heeltoe.views.animation.frames import build_scene

            return build_scene(case, filled_in(response), times, exaggerate, case.units)

        _write(scene, fresh, frames_per_second, speed, shown)
    return place


def check_options(
    path: Path, *, exaggerate: float | None = None, frames_per_second: float = 30.0, speed: float = 1.0
) -> None:
    """Refuse what no animation can be made of, before anything is computed.

    Raises
    ------
    InputError
        As :func:`animate`.
    """
    if path.suffix.lower() not in SUFFIXES:
        raise InputError("file-ending", "animation", path, kind="an animation", endings=".mp4, .gif or .html")
    for field, value, low, high in (
        ("exaggerate", exaggerate, 0.0, _LARGEST_EXAGGERATION),
        ("frames_per_second", frames_per_second, 1.0, _FASTEST_RATE),
        ("speed", speed, _SLOWEST, _FASTEST),
    ):
        if value is None or (math.isfinite(value) and low <= value <= high and value > 0.0):
            continue
        bound = f"{f'from {low:g}' if low else 'above 0 and up'} to {high:g}"
        raise InputError("out-of-range", field, f"{value:g}", bound=bound)
    if path.suffix.lower() == ".mp4":
        from heeltoe.views.animation.video import ffmpeg

        ffmpeg()


def writing_cost(path: Path, seconds: float, frames_per_second: float, speed: float) -> Cost:
    """Return the cost of writing an animation of `seconds` of an earthquake."""
    suffix = path.suffix.lower()
    pictures = seconds / speed * frames_per_second
    if suffix == ".html":
        return Cost(_OF_PAGE * min(seconds / _PAGE_STEP, _MOST_PAGE_FRAMES), 1e8)
    return Cost(_OF_PICTURE * min(pictures, _MOST_PICTURES if suffix == ".gif" else _MOST_FRAMES), 2e8)


def _window(response: Response, start: float, end: float | None) -> tuple[float, float]:
    """Return the time that is shown, within that of the response [s]."""
    times = response.histories.time_s
    begin, finish = float(times[0]), float(times[-1])
    last = finish if end is None else end
    if not (math.isfinite(start) and math.isfinite(last)) or max(start, begin) >= min(last, finish):
        raise InputError(
            "animation-window", "animation", f"{start:g} s to {last:g} s", begin=f"{begin:g} s", finish=f"{finish:g} s"
        )
    return max(start, begin), min(last, finish)


def _write(
    scene: Callable[[Floats], Scene], path: Path, frames_per_second: float, speed: float, window: tuple[float, float]
) -> None:
    """Write a scene, which is built for the moments that the kind of file shows."""
    first, last = window
    # matplotlib and pillow only where they are needed.
    suffix = path.suffix.lower()
    if suffix == ".html":
        from heeltoe.views.animation.page import write_page

        step = max(_PAGE_STEP, (last - first) / _MOST_PAGE_FRAMES)
        write_page(scene(_moments(first, last, step)), speed, path)
    elif suffix == ".gif":
        from heeltoe.views.animation.video import gif_delay, write_gif

        delay = gif_delay(frames_per_second, (last - first) / speed)
        write_gif(scene(_moments(first, last, 0.01 * delay * speed)), delay, path)
    else:
        from heeltoe.views.animation.video import write_mp4

        write_mp4(scene(_moments(first, last, speed / frames_per_second)), frames_per_second, path)


def _moments(first: float, last: float, step: float) -> Floats:
    """Return moments from the first on, at equal distances, that do not go beyond the last [s]."""
    count = int((last - first) / step * (1.0 + 1e-12)) + 1
    if count > _MOST_FRAMES:
        raise InputError("too-many", "animation", f"{count} frames", most=f"{_MOST_FRAMES}: show less, or faster")
    return first + step * np.arange(count, dtype=np.float64)
