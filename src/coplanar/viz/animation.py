"""Animations that are files: GIF, MP4, or one HTML page; whole, or not there at all."""

from __future__ import annotations

import contextlib
import importlib
import os
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, Any, NamedTuple, cast

import numpy as np

from coplanar import checks
from coplanar.errors import InvalidValue, MissingExtra, NoSolution
from coplanar.run import Run
from coplanar.run.files import written_whole
from coplanar.viz.player import Player
from coplanar.viz.renderer import SceneRenderer
from coplanar.viz.scene import Scene
from coplanar.viz.scenes import scene_of_run
from coplanar.viz.style import theme_named

SUFFIXES = (".gif", ".html", ".mp4")
FASTEST = {".gif": 50.0, ".mp4": 120.0}  # [frames/s] viewers slow down a GIF that asks for more
SMALLEST, LARGEST = 64, 4096  # [pixels]
HELD = 400_000_000  # [bytes] of the frames of a GIF, which are held until it is written
STILL = 1.0  # how long a scene that does not move is shown [s]

Progress = Callable[[int, int], None]


class Timing(NamedTuple):
    """When which frame is shown.

    Attributes:
        times: Of the scene, one a frame [s].
        duration: Of the film [s].
    """

    times: np.ndarray
    duration: float

    @classmethod
    def of(cls, scene: Scene, fps: float, speed: float, most: int) -> Timing:
        """Frames evenly over the scene, the last one at its end; at fewer a second where there would be too many."""
        first, last = float(scene.times[0]), float(scene.times[-1])
        if last <= first:
            return cls(np.array([first]), STILL)
        duration = (last - first) / speed
        return cls(np.linspace(first, last, min(most, max(2, round(duration * fps)))), duration)


def animate(
    moving: Scene | Run, path: str | os.PathLike[str], *, fps: float = 25.0, size: tuple[int, int] = (640, 480),
    theme: str | None = None, speed: float = 1.0, most_frames: int = 600, title: str = "a motion",
    progress: Progress | None = None, **of_run: Any,
) -> Path:  # fmt: skip
    """Write an animation: ``.gif``, ``.mp4`` (needs the extra "video"), or ``.html``, one page that plays it.

    The file takes its place when it is complete; when it is interrupted nothing is left behind.

    Args:
        moving: A scene, or a run, of which ``scene_of_run`` makes one.
        path: Where to write; the suffix says what.
        fps: Frames a second, at most 50 for a GIF; of .gif and .mp4.
        size: Width and height [pixels]; of .gif and .mp4, for the latter even numbers.
        theme: "light" or "dark"; None is light, and on a page the reader's own choice.
        speed: How many seconds of the scene pass in one of the film; of .gif and .mp4.
        most_frames: A longer film has fewer frames a second.
        title: Of the page.
        progress: Called with how many frames are done and how many there are.
        **of_run: Passed to ``scene_of_run``: ``arm``, ``reference``, ``point``, ``radius``, ``frames``.

    Returns:
        Where it was written.

    Raises:
        InvalidValue: If the suffix is another, or a number is not positive or out of range.
        UnknownName: If there is no such theme, or the scene has layers of an unknown kind.
        MissingExtra: If an .mp4 is asked for and ffmpeg is not there.
        OSError: If the file cannot be written.
    """
    target = Path(path)
    kind = target.suffix.lower()
    if kind not in SUFFIXES:
        raise InvalidValue("path", str(path), "a name that ends in .gif, .mp4 or .html")
    rate = _between("fps", fps, 0.1, FASTEST.get(kind, FASTEST[".mp4"]))
    pace, most = float(checks.positive("speed", speed)), int(_between("most_frames", most_frames, 1, 100_000))
    scene = scene_of_run(moving, **of_run) if isinstance(moving, Run) else moving
    if kind == ".html":
        text = Player(scene, title, theme).page()
        return _whole(target, lambda part: _write_text(part, text))
    width, height = (int(_between("size", pixels, SMALLEST, LARGEST)) for pixels in size)
    colours = theme_named(theme or "light")
    ffmpeg = _ffmpeg() if kind == ".mp4" else ""
    if kind == ".mp4":
        width, height = width + width % 2, height + height % 2
    if kind == ".gif":
        most = min(most, max(2, HELD // (width * height)))
    timing = Timing.of(scene, rate, pace, most)
    renderer = SceneRenderer(scene, colours, (width, height))
    frames = _frames(renderer, timing, progress)
    if kind == ".gif":
        return _whole(target, lambda part: _write_gif(part, _palette(renderer, timing), frames, timing))
    return _whole(target, lambda part: _write_mp4(part, ffmpeg, frames, timing, (width, height)))


def _between(name: str, value: float, low: float, high: float) -> float:
    number = float(checks.positive(name, value))
    if not low <= number <= high:
        raise InvalidValue(name, value, f"between {low:g} and {high:g}")
    return number


def _frames(renderer: SceneRenderer, timing: Timing, progress: Progress | None) -> Iterator[np.ndarray]:
    for done, t in enumerate(timing.times.tolist(), 1):
        yield renderer.frame(t)
        if progress:
            progress(done, len(timing.times))


def _whole(target: Path, write: Callable[[Path], None]) -> Path:
    with written_whole(target) as part:
        write(part)
    return target


def _write_text(part: Path, text: str) -> None:
    with part.open("x", encoding="utf-8", newline="\n") as file:
        file.write(text)


def _palette(renderer: SceneRenderer, timing: Timing) -> Any:
    """The colours of some of the frames."""
    from PIL import Image

    sample = timing.times[:: max(1, len(timing.times) // 8)]
    stacked = np.concatenate([renderer.frame(t) for t in sample.tolist()])
    return Image.fromarray(stacked).quantize(colors=128, method=Image.Quantize.MEDIANCUT)


def _write_gif(part: Path, palette: Any, frames: Iterator[np.ndarray], timing: Timing) -> None:
    """One palette for all frames, and durations in hundredths of a second that add up to the film's."""
    from PIL import Image

    count = len(timing.times)
    pictures = (Image.fromarray(frame).quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames)
    ends = np.round(100.0 * timing.duration * np.arange(count + 1) / count)
    shown = np.maximum(10.0 * np.diff(ends), 20.0).astype(int).tolist()
    with part.open("xb") as file:
        next(pictures).save(file, format="GIF", save_all=True, append_images=pictures, duration=shown, loop=0)


def _ffmpeg() -> str:
    """The program that imageio-ffmpeg brings, or the one on the path.

    Raises:
        MissingExtra: If there is neither.
    """
    try:
        program: str | None = importlib.import_module("imageio_ffmpeg").get_ffmpeg_exe()
    except (ImportError, RuntimeError):
        program = shutil.which("ffmpeg")
    if program is None:
        raise MissingExtra("imageio-ffmpeg", "video")
    return program


def _write_mp4(part: Path, ffmpeg: str, frames: Iterator[np.ndarray], timing: Timing, size: tuple[int, int]) -> None:
    """Frames through a pipe to ffmpeg, into a file that could be made."""
    part.touch(exist_ok=False)
    command = [
        ffmpeg, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}",
        "-framerate", f"{len(timing.times) / timing.duration:.9g}", "-i", "-", "-an", "-c:v", "libx264", "-crf", "20",
        "-preset", "medium", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4", str(part),
    ]  # fmt: skip
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        pipe, complaints = cast(IO[bytes], process.stdin), cast(IO[bytes], process.stderr)
        try:
            for frame in frames:
                pipe.write(frame.tobytes())
            pipe.close()
        except BrokenPipeError:
            _closed(pipe)
        except BaseException:
            process.kill()
            _closed(pipe)
            raise
        said = complaints.read().decode("utf-8", "replace").strip()
        if process.wait():
            raise NoSolution(f"ffmpeg failed: {said[-300:]}", command)


def _closed(pipe: IO[bytes]) -> None:
    """Close a pipe whose reader has gone."""
    with contextlib.suppress(BrokenPipeError):
        pipe.close()
