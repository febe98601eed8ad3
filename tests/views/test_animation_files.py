"""Files of animations: video, GIF and page hold what the response says, with any title, and nothing is half-written."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

import heeltoe
from heeltoe import InputError, animate, read_case, rigid
from heeltoe.views.animation import look
from heeltoe.views.animation.charts import Charts
from heeltoe.views.animation.frames import build_scene
from heeltoe.views.animation.picture import arrow_outlines
from heeltoe.views.animation.video import gif_delay
from heeltoe.views.figures.dense import filled_in
from shared.command import command
from shared.dams import BLOCK, SHORT, example
from shared.scenes import page_scene, unpacked

PLAYER = Path(heeltoe.__file__).parent / "views" / "animation" / "player"
TITLE = '堰堤 </script><b>$x^2$ & "é" %%SCENE%%'
BOTH = pytest.mark.parametrize("pair", ["rigid", "flexible"], indirect=True)


# Files


@pytest.mark.slow
@BOTH
def test_a_video_has_its_frames(pair, tmp_path):
    imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg")
    case, response = pair
    path = animate(case, response, tmp_path / "dam.mp4", frames_per_second=10, window=(0.2, 0.8), speed=0.5)
    # Decoded by a process of our own, as the package's reader leaves its pipes open.
    command = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(command, capture_output=True, check=True, timeout=60)
    for words in (b"h264", b"yuv420p", b"1280x720", b"10 fps"):
        assert words in done.stderr
    frames = np.frombuffer(done.stdout, dtype=np.uint8).reshape(-1, 720, 1280, 3)
    # 0.6 s at half speed are 1.2 s, with pictures at both ends.
    assert len(frames) == 13
    assert np.abs(frames[0].astype(int) - frames[-1]).max() > 100
    assert [file.name for file in tmp_path.iterdir()] == ["dam.mp4"]


def test_a_gif_has_its_frames_and_colours(block, tmp_path):
    case, response = block
    path = animate(replace_title(case), replace(response, title=TITLE), str(tmp_path / "dam.GIF"), frames_per_second=5)
    with Image.open(path) as image:
        assert image.format == "GIF"
        assert image.n_frames == 6
        assert image.info["duration"] == 200
        assert image.size == (960, 540)
        colours = {colour for _, colour in image.convert("RGB").getcolors(1 << 20)}
    # The blue of "slips downstream" is in the legend.
    assert min(sum(abs(a - b) for a, b in zip(colour, (0, 0x72, 0xB2), strict=True)) for colour in colours) < 20


def replace_title(case):
    return case.model_copy(update={"title": TITLE})


def test_a_long_gif_has_fewer_pictures():
    assert gif_delay(10.0, 5.0) == 10
    assert gif_delay(120.0, 1.0) == 2
    assert 100 * 60.0 / gif_delay(30.0, 60.0) <= 300


@BOTH
def test_the_page_holds_what_the_response_says(pair, tmp_path):
    case, response = pair
    path = animate(case, response, tmp_path / "dam.html", window=(0.0, 0.9))
    scene = page_scene(path)
    # A block with few samples is shown as it moves between them.
    response = filled_in(response)
    times = unpacked(scene["times"])
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(0.9)
    traces = {trace["role"]: trace for trace in scene["traces"]}
    history = unpacked(scene["historyTimes"])
    within = response.histories["time_s"] <= 0.9 + 1e-12
    assert history == pytest.approx(response.histories["time_s"][within], rel=1e-6, abs=1e-6)
    slip = response.histories["slip_m"][within] / {"m": 1.0, "mm": 1e-3}[traces["slip"]["unit"]]
    assert unpacked(traces["slip"]["values"]) == pytest.approx(slip, rel=1e-6, abs=1e-6)
    mode = [scene["modes"][k]["name"] for k in unpacked(scene["historyMode"])]
    assert mode == list(np.array(response.mode)[within])
    # Positions of the crack, put together from shapes and amplitudes as the page does.
    expected = build_scene(case, response, times.astype(float), None)
    for part, field in zip(expected.parts, scene["parts"], strict=True):
        shapes, amplitudes = unpacked(field["shapes"]), unpacked(field["amplitudes"])
        drawn = unpacked(field["points"]) + np.tensordot(amplitudes[40], shapes, axes=1)
        assert drawn == pytest.approx(part.drawn(40, 1.0), abs=2e-5)
    assert unpacked(scene["forces"]) == pytest.approx(expected.forces, rel=1e-5, abs=1e-6)
    assert unpacked(scene["status"]).tolist() == expected.status.tolist()


def test_the_page_needs_nothing_else_and_any_title_is_text(block, tmp_path):
    case, response = block
    text = animate(case, replace(response, title=TITLE), tmp_path / "dam.html").read_text(encoding="utf-8")
    for loading in ("http:", "https:", "src=", "url(", "@import", "<link", "fetch(", "XMLHttpRequest", "import("):
        assert loading not in text, loading
    assert "default-src 'none'" in text
    assert len(re.findall("</script>", text)) == 2
    assert "<b>" not in text
    assert text.count("堰堤 &lt;/script&gt;&lt;b&gt;$x^2$ &amp; &quot;é&quot; %%SCENE%%") == 2
    assert page_scene(tmp_path / "dam.html")["title"] == TITLE
    # What looks like a place of the template is left alone, in the two headings and in the data.
    assert text.count("%%") == 6


@pytest.mark.skipif(shutil.which("node") is None, reason="needs node")
def test_the_page_draws_where_the_scene_says(elastic, tmp_path):
    case, response = elastic
    path = animate(case, response, tmp_path / "dam.html")
    (tmp_path / "scene.json").write_text(json.dumps(page_scene(path)), encoding="utf-8")
    for script in PLAYER.glob("*.js"):
        # As the modules that they are.
        copy = tmp_path / script.with_suffix(".mjs").name
        shutil.copy(script, copy)
        subprocess.run(["node", "--check", copy], check=True, timeout=60)
    program = """
      import { readFileSync } from "node:fs";
      const model = await import(process.argv[1]);
      const scene = model.readScene(JSON.parse(readFileSync(process.argv[2], "utf8")));
      const moment = model.momentAt(scene.times, 0.505);
      console.log(JSON.stringify({
        drawn: scene.parts.map((part) => Array.from(model.drawnPoints(part, moment, 20))),
        arrows: model.forcesAt(scene, moment.nearest).map((each) => each.vector),
        arrow: model.arrowOutline([5, 1], [0, 2], 0.1),
        ticks: model.ticks(-0.4, 0.37, 4),
        choices: model.exaggerations(20),
        odd: model.exaggerations(7),
        hash: [model.momentOf("#t=6.5"), model.momentOf("#other"), model.momentOf("#t=.")],
        level: [model.atLevel([[0, 0], [2, 10]], 5), model.atLevel([[0, 0], [2, 10]], 50)],
      }));
    """
    result = subprocess.run(
        ["node", "--input-type=module", "-e", program, tmp_path / "scene.mjs", tmp_path / "scene.json"],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    answer = json.loads(result.stdout)
    expected = build_scene(case, response, np.array([0.0, 0.50, 0.51]), 20.0)
    for drawn, part in zip(answer["drawn"], expected.parts, strict=True):
        # Between its moments, 10 ms apart, the page goes straight.
        middle = (part.drawn(1, 20.0) + part.drawn(2, 20.0)) / 2.0
        assert np.array(drawn).reshape(-1, 2) == pytest.approx(middle, abs=1e-3)
    assert np.hypot(*np.array(answer["arrows"]).T).max() <= page_scene(path)["cut"] + 1e-9
    assert np.array(answer["arrow"]) == pytest.approx(
        arrow_outlines(np.array([[5.0, 1.0]]), np.array([[0.0, 2.0]]), 0.1).vertices[:7]
    )
    assert answer["ticks"] == pytest.approx([-0.4, -0.2, 0.0, 0.2])
    assert 20 in answer["choices"]
    assert answer["choices"] == sorted(set(answer["choices"]))
    assert 7 in answer["odd"]
    assert answer["hash"] == [6.5, None, None]
    assert answer["level"] == [1, 2]


# Refusals


@pytest.mark.parametrize(
    ("name", "options", "code"),
    [
        ("dam.avi", {}, "file-ending"),
        ("dam", {}, "file-ending"),
        ("dam.html", {"exaggerate": 0.0}, "out-of-range"),
        ("dam.html", {"exaggerate": float("nan")}, "out-of-range"),
        ("dam.gif", {"frames_per_second": 0.5}, "out-of-range"),
        ("dam.gif", {"frames_per_second": 1000.0}, "out-of-range"),
        ("dam.html", {"speed": -1.0}, "out-of-range"),
        ("dam.html", {"window": (0.5, 0.5)}, "animation-window"),
        ("dam.html", {"window": (7.0, None)}, "animation-window"),
        ("dam.mp4", {"speed": 0.001, "frames_per_second": 120.0}, "too-many"),
        ("nowhere/dam.html", {}, "no-directory"),
    ],
)
def test_what_cannot_be_made_is_refused_and_leaves_nothing(block, tmp_path, name, options, code):
    pytest.importorskip("imageio_ffmpeg")
    case, response = block
    with pytest.raises(InputError) as caught:
        animate(case, response, tmp_path / name, **options)
    assert caught.value.code == code
    assert list(tmp_path.iterdir()) == []


def test_a_run_that_never_started_is_refused(block, tmp_path):
    case, response = block
    with pytest.raises(InputError) as caught:
        animate(case, replace(response, outcome="unstable").with_crack(histories={}), tmp_path / "dam.html")
    assert caught.value.code == "nothing-to-show"


def test_a_missing_package_says_how_to_get_it(block, tmp_path, monkeypatch):
    case, response = block
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(InputError, match=r"pip install imageio-ffmpeg"):
        animate(case, response, tmp_path / "dam.mp4")


def test_a_failure_keeps_the_file_that_was_there(block, tmp_path, monkeypatch):
    case, response = block
    old = tmp_path / "dam.html"
    old.write_text("old", encoding="utf-8")

    def failing(*arguments):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("heeltoe.views.animation.page.write_page", failing)
    with pytest.raises(InputError, match="No space left"):
        animate(case, response, old)
    assert old.read_text(encoding="utf-8") == "old"
    assert list(tmp_path.iterdir()) == [old]


# Command line


def test_the_command_writes_a_page(tmp_path):
    result = command("animate", BLOCK, "--exaggerate", "5", "--from", "0s", "--until", "0.2 s", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    assert "block.animation.html" in result.stdout
    assert "analysis" in result.stdout
    scene = page_scene(tmp_path / "block.animation.html")
    assert scene["exaggeration"] == 5.0
    assert unpacked(scene["times"])[-1] == pytest.approx(0.2)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--model", "both"), "choose auto, rigid, decoupled, flexible"),
        (("--to", "dam.txt"), ".mp4, .gif or .html"),
        (("--to", "nowhere/dam.html"), "make it first"),
        (("--fps", "0"), "out of range"),
        (("--exaggerate", "much"), "--exaggerate"),
    ],
)
def test_the_command_refuses_in_one_line(tmp_path, options, words):
    result = command("animate", BLOCK, *options, cwd=tmp_path)
    assert result.returncode == 2
    assert words in result.stderr
    assert result.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_dam_that_cannot_stand_has_no_animation(tmp_path):
    result = command(
        "animate", BLOCK, "--set", "crack.friction=0.01", "--set", "crack.inclination=10 deg", cwd=tmp_path
    )
    assert result.returncode == 3, result.stderr
    assert "unstable" in result.stdout
    assert list(tmp_path.iterdir()) == []


def test_what_shakes_the_block_of_a_decoupled_chain_is_shown(koyna, tmp_path):
    page = animate(example("koyna", *SHORT), koyna, tmp_path / "koyna.html")
    assert "the motion of the crack shakes the part above" in page.read_text()
    scene = page_scene(page)
    traces = {trace["role"]: trace for trace in scene["traces"]}
    assert (traces["ground"]["label"], traces["crack"]["label"]) == ("ground", "crack")
    shaken = koyna.histories["crack_acceleration_m_s2"] / koyna.gravity
    assert np.abs(unpacked(traces["crack"]["values"])).max() == pytest.approx(np.abs(shaken).max(), rel=0.02)


def test_what_reaches_far_hides_nothing(koyna):
    scene = build_scene(example("koyna", *SHORT), koyna, koyna.histories["time_s"][::100], None)
    figure = Figure()
    Charts(figure, scene)
    curves = [line for line in figure.axes[0].lines if len(line.get_xdata()) > 2]
    assert [line.get_color() for line in curves] == [look.TRACES["crack"], look.TRACES["ground"]]


def test_a_block_with_few_samples_moves_as_it_does(tmp_path):
    """Pushed by 0.8 g for 0.1 s, it slides by -0.3 g t^2 at first."""
    case = read_case(BLOCK)
    scene = page_scene(animate(case, rigid(case), tmp_path / "block.html"))
    traces = {trace["role"]: unpacked(trace["values"]) for trace in scene["traces"]}
    time = unpacked(scene["historyTimes"])
    pushed = time < 0.0999
    assert pushed.sum() > 50
    assert traces["slip"][pushed] == pytest.approx(-0.3e3 * 9.80665 * time[pushed] ** 2, abs=1e-3)
    assert traces["ground"][pushed] == pytest.approx(0.8)
