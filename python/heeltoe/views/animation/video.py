"""Videos of a scene: MP4 through ffmpeg, GIF through pillow."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from subprocess import PIPE, Popen
from types import ModuleType

import numpy as np
from PIL import Image, ImageColor

from heeltoe.errors.error import package
from heeltoe.views.animation import look
from heeltoe.views.animation.frames import Scene
from heeltoe.views.animation.picture import Picture

_MP4_PIXELS, _GIF_PIXELS = 100, 75
#: A GIF counts its delays in hundredths of a second, of which viewers take no fewer than 2.
_HUNDREDTHS = 100
_SHORTEST_DELAY = 2
#: Pictures in a GIF, which has no good compression: some 15 kB each.
_MOST_GIF_FRAMES = 300
_GIF_COLOURS = 80


def gif_delay(frames_per_second: float, seconds: float) -> int:
    """Return the time from picture to picture of a GIF that plays for so long [hundredths of a second]."""
    wanted = max(round(_HUNDREDTHS / frames_per_second), _SHORTEST_DELAY)
    return max(wanted, int(np.ceil(_HUNDREDTHS * seconds / _MOST_GIF_FRAMES)))


def ffmpeg() -> ModuleType:
    """Return the package that brings ffmpeg along.

    Raises
    ------
    InputError
        Where it is not installed.
    """
    with package(".mp4", "imageio-ffmpeg"):
        import imageio_ffmpeg
    return imageio_ffmpeg  # type: ignore[no-any-return]


def write_mp4(scene: Scene, frames_per_second: float, path: Path) -> None:
    """Write a scene, whose frames follow each other at this rate, as H.264 that every player reads.

    Raises
    ------
    OSError
        Where ffmpeg cannot write all of it.
    """
    picture = Picture(scene, _MP4_PIXELS)
    width, height = picture.size
    rate = Fraction(frames_per_second).limit_denominator()
    options = ["-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{width}x{height}", "-r", f"{rate}", "-i", "-"]
    wanted = ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-preset", "veryfast", "-movflags", "+faststart"]
    # The whole path: one that begins with a word and a colon is an address to ffmpeg.
    command = [ffmpeg().get_ffmpeg_exe(), "-v", "error", "-y", *options, *wanted, str(path.absolute())]
    with _broken_pipes_are_errors(), Popen(command, stdin=PIPE, stderr=PIPE) as process:
        assert process.stdin is not None
        try:
            for frame in range(len(scene.times)):
                process.stdin.write(picture.draw(frame))
        except BrokenPipeError:
            pass  # it says itself why it has ended
        except BaseException:
            process.kill()
            raise
        _, output = process.communicate()
    if process.returncode:
        lines = output.decode(errors="replace").strip().splitlines() or [f"ffmpeg ended with {process.returncode}"]
        raise OSError(lines[-1].rpartition(": ")[2])


@contextmanager
def _broken_pipes_are_errors() -> Iterator[None]:
    """Do not end where a process that is written to ends, as the command line does for the one that reads it."""
    if not hasattr(signal, "SIGPIPE") or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGPIPE, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGPIPE, before)


def write_gif(scene: Scene, delay: int, path: Path) -> None:
    """Write a scene, whose frames follow each other after `delay` hundredths of a second, as a GIF that repeats."""
    picture = Picture(scene, _GIF_PIXELS)

    def image(frame: int) -> Image.Image:
        return Image.fromarray(np.asarray(picture.draw(frame))).convert("RGB")

    # One palette for all, from moments all over the animation, lest colours flicker; with a stripe of each colour that
    # says something, lest small things lose theirs.
    chosen = sorted({round(k) for k in np.linspace(0, len(scene.times) - 1, 3)})
    stripes = [np.full((12, picture.size[0], 3), ImageColor.getrgb(colour), dtype=np.uint8) for colour in look.SPEAKING]
    sample = np.vstack([*(np.asarray(image(frame)) for frame in chosen), *stripes])
    palette = Image.fromarray(sample).quantize(_GIF_COLOURS, method=Image.Quantize.MEDIANCUT)
    images = (image(frame).quantize(palette=palette, dither=Image.Dither.NONE) for frame in range(len(scene.times)))
    next(images).save(path, "GIF", save_all=True, append_images=images, duration=10 * delay, loop=0, optimize=False)
