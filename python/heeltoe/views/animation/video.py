"""Videos of a scene: MP4 through ffmpeg, GIF through pillow."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
from PIL import Image, ImageColor

from heeltoe.errors import InputError
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
    try:
        import imageio_ffmpeg
    except ImportError:
        raise InputError("animation-package", ".mp4") from None
    return imageio_ffmpeg  # type: ignore[no-any-return]


def write_mp4(scene: Scene, frames_per_second: float, path: Path) -> None:
    """Write a scene, whose frames follow each other at this rate, as H.264 that every player reads."""
    picture = Picture(scene, _MP4_PIXELS)
    writer = ffmpeg().write_frames(
        str(path),
        picture.size,
        pix_fmt_in="rgba",
        pix_fmt_out="yuv420p",
        fps=frames_per_second,
        codec="libx264",
        quality=None,
        macro_block_size=2,
        ffmpeg_log_level="error",
        output_params=["-crf", "20", "-preset", "veryfast", "-movflags", "+faststart"],
    )
    writer.send(None)
    try:
        for frame in range(len(scene.times)):
            writer.send(picture.draw(frame))
    finally:
        writer.close()


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
