"""Animations read back: how long, how large, how many frames, what is in them; whole, or not there."""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
import shutil
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from coplanar import Arm, Circle, Pose, Projectile, Run, Segment, trace, viz
from coplanar.errors import InvalidShape, InvalidValue, MissingExtra, NoSolution, UnknownName
from coplanar.logs import read_log
from coplanar.viz import animation
from coplanar.viz.layers import KINDS
from coplanar.viz.renderer import SceneRenderer
from coplanar.viz.scene import Scene
from coplanar.viz.style import DARK, LIGHT

SMALL = {"size": (160, 120), "fps": 10.0}
ARM = Arm((1.0, 1.0))


def driven(duration=2.0, rows=41):
    t = np.linspace(0.0, duration, rows)
    poses = Segment(1.0, 0.8, duration=duration).pose(Pose(), t)
    return Run({"t": t, "x": poses.x, "y": poses.y, "theta": poses.theta}, "body")


def flown():
    way = Projectile(mass=1.0, drag=0.02).launch(speed=30.0, angle=1.0).sample(4.0)
    return Run({"t": way.time, "x": way.x, "y": way.y, "vx": way.vx, "vy": way.vy}, "flight")


def traced():
    return trace(ARM, Circle(0.5, center=(1.0, 0.5)), 31, near=(0.5, 0.5)).as_run(2.0)


def rgb(colour):
    return np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])


def shows(frame, colour, off=12):
    """How many pixels have nearly this colour."""
    return int((np.abs(np.asarray(frame, int) - rgb(colour)).max(axis=-1) <= off).sum())


def middle_of(frame, colour, off=12):
    """The mean place of the pixels of a colour, in pixels from the upper left."""
    rows, columns = np.nonzero(np.abs(np.asarray(frame, int) - rgb(colour)).max(axis=-1) <= off)
    return columns.mean(), rows.mean()


def test_a_gif_loops_and_lasts_as_long_as_the_run(tmp_path):
    path = driven().animate(tmp_path / "run.gif", **SMALL)
    with Image.open(path) as film:
        shown = []
        for i in range(film.n_frames):
            film.seek(i)
            shown.append(film.info["duration"])
        assert film.info["loop"] == 0
        assert film.size == (160, 120)
        assert film.n_frames == 20
    assert sum(shown) == 2000
    assert [p.name for p in tmp_path.iterdir()] == ["run.gif"]


@pytest.mark.parametrize(("speed", "fps"), [(0.5, 7.0), (3.0, 30.0)])
def test_speed_and_rates_that_are_no_whole_hundredths(tmp_path, speed, fps):
    path = viz.animate(driven(), tmp_path / "run.gif", size=(160, 120), fps=fps, speed=speed)
    with Image.open(path) as film:
        total = 0
        for i in range(film.n_frames):
            film.seek(i)
            total += film.info["duration"]
    assert total == pytest.approx(2000.0 / speed, abs=10.0)  # a hundredth of a second


def test_frames_are_bounded(tmp_path):
    seen = []
    long = driven(duration=100.0)
    path = viz.animate(long, tmp_path / "run.gif", size=(64, 64), most_frames=9, progress=lambda *p: seen.append(p))
    assert seen == [(i, 9) for i in range(1, 10)]
    with Image.open(path) as film:
        assert film.n_frames <= 9


@pytest.mark.parametrize(("run", "options"), [(driven, {}), (flown, {}), (traced, {"arm": ARM})])
def test_gifs_of_every_kind_are_small(tmp_path, run, options):
    path = run().animate(tmp_path / "run.gif", **options)
    assert path.stat().st_size < 1_000_000
    with Image.open(path) as film:
        assert film.size == (640, 480)
        film.seek(film.n_frames // 2)
        assert shows(film.convert("RGB"), LIGHT.series[1]) > 100  # the trail


def decoded(path, size):
    """What ffmpeg says of a film, and its frames."""
    ffmpeg = pytest.importorskip("imageio_ffmpeg").get_ffmpeg_exe()
    command = [ffmpeg, "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(command, capture_output=True, timeout=60, check=True)
    return done.stderr.decode(), np.frombuffer(done.stdout, np.uint8).reshape(-1, size[1], size[0], 3)


def test_an_mp4_read_back(tmp_path):
    path = viz.animate(driven(), tmp_path / "run.mp4", fps=20.0, size=(321, 240), theme="dark")
    about, pictures = decoded(path, (322, 240))
    assert "Duration: 00:00:02.00" in about
    assert re.search(r"Video: h264 .*yuv420p.* 322x240.* 20 fps", about)
    assert len(pictures) == 40
    assert shows(pictures[0], DARK.surface) > 0.5 * 240 * 322
    assert shows(pictures[-1], DARK.series[1], off=40) > shows(pictures[2], DARK.series[1], off=40) + 50
    assert path.stat().st_size < 500_000


def test_without_ffmpeg_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    monkeypatch.setattr(shutil, "which", lambda _: None)
    with pytest.raises(MissingExtra, match=r"pip install 'coplanar\[video\]'"):
        viz.animate(driven(), tmp_path / "run.mp4")
    assert list(tmp_path.iterdir()) == []


def test_an_ffmpeg_that_fails_is_quoted(tmp_path, monkeypatch):
    program = tmp_path / "ffmpeg"
    program.write_text("#!/bin/sh\necho no codec today >&2\nexit 3\n")
    program.chmod(0o700)
    monkeypatch.setattr(animation, "_ffmpeg", lambda: str(program))
    with pytest.raises(NoSolution, match="no codec today"):
        viz.animate(driven(), tmp_path / "run.mp4", **SMALL)
    assert [p.name for p in tmp_path.iterdir()] == ["ffmpeg"]


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError])
def test_what_is_interrupted_leaves_nothing_and_keeps_what_was(tmp_path, suffix, error):
    if suffix == ".mp4":
        pytest.importorskip("imageio_ffmpeg")
    target = tmp_path / f"run{suffix}"
    target.write_text("the old one")

    def stop(done, _):
        if done == 3:
            raise error

    with pytest.raises(error):
        viz.animate(driven(), target, progress=stop, **SMALL)
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [(target.name, "the old one")]


def test_what_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(animation, "_ffmpeg", lambda: "ffmpeg")
    run = driven()
    for path in ("run.avi", "run"):
        with pytest.raises(InvalidValue, match=r"\.gif, \.mp4 or \.html"):
            viz.animate(run, tmp_path / path)
    for name, value in {"fps": 51.0, "speed": 0.0, "size": (8, 8), "most_frames": 0}.items():
        with pytest.raises(InvalidValue, match=name):
            viz.animate(run, tmp_path / "run.gif", **{name: value})
    with pytest.raises(UnknownName, match="theme"):
        viz.animate(run, tmp_path / "run.gif", theme="sepia")
    with pytest.raises(UnknownName, match="theme"):
        viz.animate(run, tmp_path / "run.html", theme="sepia")
    for suffix in animation.SUFFIXES:
        with pytest.raises(OSError, match="No such file"):
            viz.animate(run, tmp_path / "nowhere" / f"run{suffix}", **SMALL)
    assert list(tmp_path.iterdir()) == []


def test_a_layer_of_an_unknown_kind_is_refused(tmp_path):
    scene = Scene([0.0, 1.0]).moving_point([(0, 0), (1, 1)])
    strange = replace(scene, layers=({**scene.layers[0], "kind": "hologram"},), view=(0.0, 1.0, 0.0, 1.0))
    with pytest.raises(UnknownName, match="layer = 'hologram'"):
        viz.animate(strange, tmp_path / "run.gif")


def every_kind():
    t = np.linspace(0.0, 2.0, 21)
    xy = np.column_stack([t, np.sin(3.0 * t)])
    poses = np.column_stack([xy, t])
    square = np.array([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)])
    return {
        "region": Scene(t).region([1.5 * square, 0.5 * square]),
        "curve": Scene(t).curve(xy, dashed=True, fill=True),
        "trail": Scene(t).trail(xy),
        "point": Scene(t).moving_point(xy),
        "cross": Scene(t).cross([(2.0, 1.0)]),
        "discs": Scene(t).discs(np.column_stack([xy, 0.1 + t]), fill=True),
        "outline": Scene(t).outline(xy[:, None] + square, dashed=True),
        "segments": Scene(t).segments([0.0, 0.0, 1.0, 1.2, 0.4, -0.5, 0.8, -0.5]),
        "arrows": Scene(t).arrows([[0.0, 1.0, 0.5, 0.0, 0.0, 1.5, 0.0, 0.0]], crossed=True),
        "text": Scene(t).text("50 % of $x$", xy, shift=[0, -10]),
        "linkage": Scene(t).linkage([(0.0, 0.0), (0.7, 0.5), (1.2, 0.1)], dashed=True),
        "body": Scene(t).body(poses, square),
        "carried": Scene(t).carried(poses, [-1.0, 1.0, 1.0, 1.0]),
    }


def test_every_kind_of_layer_is_drawn_in_its_colour():
    scenes = every_kind()
    assert set(scenes) == set(KINDS)
    for kind, scene in scenes.items():
        frame = SceneRenderer(scene, LIGHT, (320, 240)).frame(1.0)
        colour = LIGHT.colour(scene.layers[0]["role"])
        assert shows(frame, colour, off=60) > 10, kind


def test_what_is_drawn_is_where_it_is():
    scene = Scene([0.0, 1.0, 3.0]).moving_point([(0, 0), (1, 2), (3, 2)], role="first")
    scene = replace(scene, view=(0.0, 4.0, 0.0, 3.0))
    renderer = SceneRenderer(scene, LIGHT, (400, 300))
    to_pixels = renderer.ax.transData.transform
    for t, point in ((0.0, (0, 0)), (0.5, (0.5, 1.0)), (2.0, (2.0, 2.0)), (9.0, (3, 2))):
        x, y = to_pixels(point)
        assert middle_of(renderer.frame(t), LIGHT.series[0]) == pytest.approx((x, 300.0 - y), abs=1.0)


def test_words_are_shifted_to_the_right_and_down():
    at = np.zeros((2, 2))
    view = (-1.0, 1.0, -1.0, 1.0)
    places = []
    for shift in ([0, 0], [20, 30]):
        scene = replace(Scene([0.0, 1.0]).text("M", at, role="first", shift=shift), view=view)
        places.append(middle_of(SceneRenderer(scene, LIGHT, (200, 200)).frame(0.0), LIGHT.series[0], off=80))
    assert np.subtract(*places[::-1]) == pytest.approx((20.0, 30.0), abs=1.0)


def test_one_layer_covers_another_in_the_order_of_the_scene():
    dot = [(0.0, 0.0), (0.0, 0.0)]
    scene = Scene([0.0, 1.0]).moving_point(dot, role="first", size=20.0).moving_point(dot, role="second", size=10.0)
    scene = replace(scene, view=(-1.0, 1.0, -1.0, 1.0))
    frame = SceneRenderer(scene, LIGHT, (200, 200)).frame(0.0)
    assert shows(frame, LIGHT.series[1]) == pytest.approx(np.pi * 10.0**2, rel=0.25)
    assert shows(frame, LIGHT.series[0]) == pytest.approx(np.pi * (20.0**2 - 10.0**2), rel=0.25)


def test_frames_do_not_depend_on_what_was_drawn_before():
    scene = every_kind()["body"].trail(np.zeros((21, 2)) + np.linspace(0, 1, 21)[:, None])
    renderer = SceneRenderer(scene, DARK, (200, 150))
    first = renderer.frame(0.3)
    renderer.frame(1.9)
    assert np.array_equal(renderer.frame(0.3), first)


def test_a_scene_that_stands_still(tmp_path):
    scene = Scene().linkage([(0.0, 0.0), (1.0, 1.0)])
    with Image.open(viz.animate(scene, tmp_path / "still.gif", **SMALL)) as film:
        assert film.n_frames == 1


def test_a_page_with_everything_in_it(tmp_path):
    path = driven().animate(tmp_path / "run.html", title='<b> & "run"', theme="dark")
    page = path.read_text("utf-8")
    assert not re.search(r"""(src|href)\s*=|url\(|https?://|@import""", page.replace("srcdoc=", ""))
    assert "<b>" not in page
    policy = html.unescape(re.search(r'Content-Security-Policy" content="([^"]*)"', page).group(1))
    assert policy.startswith("default-src 'none'")
    assert "unsafe" not in policy
    for tag in ("script", "style"):
        text = re.findall(rf"<{tag}>(.*?)</{tag}>", page, re.DOTALL)
        assert len(text) == 1
        digest = base64.b64encode(hashlib.sha256(text[0].encode()).digest()).decode()
        assert f"{tag}-src 'sha256-{digest}'" in policy
    scene = json.loads(re.search(r'<script type="application/json">(.*?)</script>', page, re.DOTALL).group(1))
    assert [layer["kind"] for layer in scene["layers"]] == ["trail", "body"]
    assert '<html lang="en" data-theme="dark">' in page


def test_words_of_a_scene_cannot_leave_their_place():
    scene = Scene([0.0, 1.0]).text("</script><script>alert(1)</script>", (0.0, 0.0)).trail([(0, 0), (1, 1)])
    page = viz.Player(scene).page()
    assert "alert(1)</script>" not in page
    assert page.count("<script") == 2


def test_a_run_shows_itself_in_a_notebook():
    run = driven()
    shown = run._repr_html_()
    page = html.unescape(re.search(r'srcdoc="([^"]*)"', shown).group(1))
    assert page == run.animate().page()
    assert 'sandbox="allow-scripts"' in shown
    assert len(shown) < 200_000
    assert Run({"t": [0.0, 1.0], "pressure": [1.0, 2.0]})._repr_html_() is None
    assert traced()._repr_html_() is None  # whose arm it is, is not known
    assert "<iframe" in traced().animate(arm=ARM)._repr_html_()
    assert Run({"t": [0.0, 1.0], "x": np.zeros((2, 99)), "y": np.zeros((2, 99))})._repr_html_() is None


def test_long_runs_make_short_scenes():
    run = driven(rows=20_001)
    scene = viz.scene_of_run(run)
    assert len(scene.times) == 301
    assert scene.times[[0, -1]].tolist() == [0.0, 2.0]
    body = next(layer for layer in scene.layers if layer["kind"] == "body")
    assert np.allclose(body["poses"], run.at(scene.times).poses.as_array(), atol=1e-5)
    assert len(viz.scene_of_run(run, frames=11).times) == 11


def test_scenes_of_every_kind():
    run, q = traced(), traced().stacked("q1", "q2")
    arm = viz.scene_of_run(run, arm=ARM)
    assert [layer["kind"] for layer in arm.layers] == ["linkage", "trail"]
    assert np.allclose(arm.layers[0]["joints"], ARM.points(q).reshape(len(run), -1), atol=1e-5)
    assert [layer["kind"] for layer in viz.scene_of_run(flown()).layers] == ["trail", "point"]
    with_more = viz.scene_of_run(driven(), reference=Circle(1.0), point=(0.1, 0.0), radius=0.2)
    assert [layer["kind"] for layer in with_more.layers] == ["curve", "trail", "body"]
    trail = with_more.layers[1]["points"]
    assert np.allclose(trail, driven().poses @ np.array([0.1, 0.0]), atol=1e-5)
    assert np.hypot(*np.transpose(with_more.layers[2]["outline"])) == pytest.approx(0.2, abs=1e-5)
    backwards = Run({"t": [1.0, 0.0], "x": [2.0, 0.0], "y": [0.0, 0.0]}, "flight")
    assert viz.scene_of_run(backwards).layers[0]["points"] == [[0.0, 0.0], [2.0, 0.0]]


def test_scenes_of_batches():
    t = np.linspace(0.0, 1.0, 5)
    for robots, roles in ((3, ["first", "second", "third"]), (8, ["first"] * 8)):
        x = t[:, None] + np.arange(robots)
        run = Run({"t": t, "x": x, "y": 0.0 * x, "theta": 0.0 * x}, "body")
        layers = [layer for layer in viz.scene_of_run(run).layers if layer["kind"] == "body"]
        assert [layer["role"] for layer in layers] == roles
        assert np.allclose([np.transpose(layer["poses"])[0] for layer in layers], x.T)
    many = Run({"t": t, "x": np.zeros((5, 65)), "y": np.zeros((5, 65))})
    with pytest.raises(InvalidShape, match="at most 64"):
        viz.scene_of_run(many)
    with pytest.raises(InvalidValue, match="nothing to draw"):
        viz.scene_of_run(Run({"t": t, "pressure": t}))
    with pytest.raises(InvalidValue, match="arm"):
        viz.scene_of_run(traced())


def test_saving_by_suffix(tmp_path):
    run = driven()
    back = Run.from_csv(run.save(tmp_path / "run.csv"), "body")
    assert np.array_equal(back["x"], run["x"])
    back = read_log(run.save(tmp_path / "run.json"))
    assert back.kind == "body"
    assert np.array_equal(back["theta"], run["theta"])
    with pytest.raises(UnknownName, match="xlsx"):
        run.save(tmp_path / "run.xlsx")


def chromium():
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


@pytest.mark.skipif(not chromium(), reason="no Chromium on this machine")
def test_the_page_plays_from_disk_in_a_browser(tmp_path):
    """Under its own policy: no complaint, no request but itself, and the picture changes."""
    sync = pytest.importorskip("playwright.sync_api")
    path = driven().animate(tmp_path / "run.html")
    frame = tmp_path / "notebook.html"
    frame.write_text(f"<!doctype html><title>n</title>{driven()._repr_html_()}{flown()._repr_html_()}", "utf-8")
    said, asked = [], []
    with sync.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium(), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 800, "height": 640})
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        page.goto(path.as_uri())
        sync.expect(page.locator("output")).not_to_have_text("0.00 s")
        page.click("button")
        first = page.locator("canvas").screenshot()
        page.locator("input").fill("900")
        assert page.locator("output").text_content() == "1.80 s"
        assert page.locator("canvas").screenshot() != first
        assert asked == [path.as_uri()]
        page.goto(frame.as_uri())
        for i in range(2):
            inside = page.frame_locator("iframe").nth(i)
            inside.locator("output").wait_for()
            assert inside.locator("button").count() == 1
        browser.close()
    assert said == []


def test_ffmpeg_ends_with_its_film(tmp_path):
    """No process outlives an interrupted film."""
    pytest.importorskip("imageio_ffmpeg")
    started = []
    real = subprocess.Popen

    class Noted(real):
        def __init__(self, *args, **kwargs):
            super().__init__(*args, **kwargs)
            started.append(self)

    def stop(*_):
        raise KeyboardInterrupt

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(subprocess, "Popen", Noted)
        with pytest.raises(KeyboardInterrupt):
            viz.animate(driven(), tmp_path / "run.mp4", progress=stop, **SMALL)
    assert all(process.poll() is not None for process in started)
    assert started
