"""Images into a film: GIF by Pillow, MP4 by imageio where it is installed. A film appears whole or not at all."""

import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import UInt8

from myograph.errors import InputError, MissingPackageError
from myograph.files import write_whole

KINDS = (".gif", ".mp4")
SLOWEST_MS = 20
"""Time of a GIF's image that players respect [ms]."""
COLOURS = 128
Images = Iterable[UInt8[np.ndarray, "height width 3"]]


def check_film(out: Path) -> None:
    """Raise InputError for a film of another kind, or a folder; MissingPackageError where its writer is missing."""
    if out.suffix.lower() not in KINDS or out.is_dir():
        raise InputError(f"{out}: expected a film such as film.gif or film.mp4")
    if out.suffix.lower() == ".mp4":
        _imageio()


def write_film(out: Path, images: Images, rate: float) -> int:
    """Write the images, so many a second; gives back how many there were. Raises as `check_film` does."""
    check_film(out)
    frames = list(images)
    if not frames:
        raise InputError("film: expected at least one image, got none")
    data = _mp4(frames, rate) if out.suffix.lower() == ".mp4" else _gif(frames, rate)
    write_whole(out, lambda file: file.write(data))
    return len(frames)


def _gif(frames: list[np.ndarray], rate: float) -> bytes:
    try:
        from PIL import Image
    except ImportError:
        raise MissingPackageError("pillow", "view", "writing a film") from None
    shared = Image.fromarray(np.concatenate(frames[:: max(1, len(frames) // 6)])).quantize(COLOURS)
    images = [Image.fromarray(frame).quantize(palette=shared, dither=Image.Dither.NONE) for frame in frames]
    buffer = io.BytesIO()
    duration = max(SLOWEST_MS, round(1000 / rate))
    images[0].save(buffer, format="gif", save_all=True, append_images=images[1:], duration=duration, loop=0)
    return buffer.getvalue()


def _mp4(frames: list[np.ndarray], rate: float) -> bytes:
    even = [frame[: frame.shape[0] // 2 * 2, : frame.shape[1] // 2 * 2] for frame in frames]
    return _imageio().imwrite("<bytes>", even, extension=".mp4", fps=rate, codec="libx264", macro_block_size=2)


def _imageio() -> Any:
    try:
        import imageio.v3
        import imageio_ffmpeg  # noqa: F401
    except ImportError:
        raise MissingPackageError("imageio[ffmpeg]", "film", "a film in MP4") from None
    return imageio.v3
