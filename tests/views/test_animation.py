"""Animations: what they show is what the response says, in any file and with any title, and nothing is half-written."""

from __future__ import annotations

import base64
import json
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import heeltoe
from heeltoe import GroundMotion, InputError, animate
from heeltoe.views.animation import look
from heeltoe.views.animation.bodies import ACCURACY, Moments
from heeltoe.views.animation.frames import STATUSES, automatic, build_scene, round_below
from heeltoe.views.animation.picture import arrow_outlines
from heeltoe.views.animation.video import gif_delay
from shared.command import command
from shared.dams import BLOCK, COARSE, example

PACKAGE = Path(heeltoe.__file__).parent / "views" / "animation"
SMALL = [*COARSE, "motion.duration=1s"]
TITLE = '堰堤 </script><b>$x^2$ & "é" %%SCENE%%'


def shaken(name, model):
    """Run an example coarsely, with 1 s of shaking that make it slide both ways and open."""
    case = example(name, *SMALL)
    time = np.linspace(0.0, 1.0, 101)
    motion = GroundMotion("sine", time, 9.0 * np.sin(2.0 * np.pi * 2.5 * time))
    return case, getattr(heeltoe, model)(case, motion)


@pytest.fixture(scope="module")
def block():
    return shaken("koyna-top", "rigid")


@pytest.fixture(scope="module")
def elastic():
    return shaken("typical-height", "flexible")


@pytest.fixture(scope="module")
def pair(request, block, elastic):
    return {"rigid": block, "flexible": elastic}[request.param]


BOTH = pytest.mark.parametrize("pair", ["rigid", "flexible"], indirect=True)


def page_scene(path):
    text = path.read_text(encoding="utf-8")
    return json.loads(re.search(r'<script type="application/json" id="scene">(.*?)</script>', text, re.S)[1])


def unpacked(field):
    plain = np.frombuffer(base64.b64decode(field["data"]), dtype=np.dtype(field["kind"]).newbyteorder("<"))
    return plain.reshape(field["shape"])


# What is shown


def test_moments_between_samples_are_found():
    moments = Moments.of(np.array([0.0, 1.0, 3.0]), np.array([0.0, 0.25, 2.0, 2.5, 3.0]))
    assert moments.between(np.array([0.0, 10.0, 30.0])) == pytest.approx([0.0, 2.5, 20.0, 25.0, 30.0])
    assert moments.nearest.tolist() == [0, 0, 2, 2, 2]


def test_a_block_keeps_slip_and_gaps_of_its_corners(block):
    case, response = block
    histories = response.histories
    scene = build_scene(case, response, histories["time_s"], 50.0)
    upper = scene.parts[0]
    heel, toe = upper.points[upper.crack]
    assert max(histories["gap_heel_m"].max(), histories["gap_toe_m"].max()) > 1e-4
    for frame in range(0, len(scene.times), 7):
        drawn = (upper.drawn(frame, 50.0)[upper.crack] - [heel, toe]) / 50.0
        assert drawn[0, 1] == pytest.approx(histories["gap_heel_m"][frame], abs=1e-12)
        assert drawn[1, 1] == pytest.approx(histories["gap_toe_m"][frame], abs=1e-12)
        standing = 0 if histories["gap_heel_m"][frame] <= histories["gap_toe_m"][frame] else 1
        assert drawn[standing, 0] == pytest.approx(histories["slip_m"][frame], abs=1e-12)


@pytest.mark.parametrize("angle", [-2.0, -1.2, 0.7, 1.5])
def test_an_overturned_block_keeps_its_shape_and_stands_on_its_corner(block, angle):
    case, response = block
    count, width = len(response.histories["time_s"]), response.crack_width_m
    rise = abs(np.sin(angle)) * width
    made = {
        "slip_m": np.linspace(0.0, 0.3, count),
        "rotation_rad": np.full(count, angle),
        "gap_heel_m": np.full(count, rise if angle < 0.0 else 0.0),
        "gap_toe_m": np.full(count, rise if angle > 0.0 else 0.0),
    }
    tilted = replace(response, outcome="overturned", histories={**response.histories, **made})
    scene = build_scene(case, tilted, response.histories["time_s"], None)
    assert scene.exaggeration == 1.0
    assert scene.subtitle.endswith("; rigid model; overturned")
    assert look.exaggeration_text(scene.exaggeration) == "displacements drawn to scale"
    upper = scene.parts[0]
    drawn = upper.drawn(count - 1, 1.0)
    # A rotation of the corners about the one it stands on, moved along by the slip.
    corner = upper.points[0 if angle > 0.0 else 1]
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    assert drawn == pytest.approx((upper.points - corner) @ turn.T + corner + [0.3, 0.0], abs=1e-9)


def test_an_elastic_dam_moves_as_its_record_says(elastic):
    case, response = elastic
    record = response.crack
    scene = build_scene(case, response, record.time, 10.0)
    largest = max(np.abs(each).max() for k in range(len(record.time)) for each in record.displacements(k))
    assert scene.parts[0].amplitudes.shape[1] < record.modes[0].shape[1]
    for frame in range(0, len(record.time), 9):
        for part, body, moved in zip(scene.parts, record.dam.bodies, record.displacements(frame), strict=True):
            crack = (part.drawn(frame, 10.0) - part.points)[part.crack] / 10.0
            assert crack == pytest.approx(moved[body.mesh.crack], abs=1.1 * ACCURACY * largest)


def test_outlines_go_round_the_parts(block, elastic):
    inclined = example("typical-height", *SMALL, "crack.inclination=10 deg")
    for case, response in (block, elastic, (inclined, block[1])):
        scene = build_scene(case, response, np.array([0.0]), 1.0)
        areas = []
        for part in scene.parts:
            x, z = part.points[part.outline].T
            areas.append(0.5 * float(np.sum(x * np.roll(z, -1) - np.roll(x, -1) * z)))
            # No slivers: no two sides double back on each other.
            sides = np.diff(part.points[[*part.outline, *part.outline[:2]]], axis=0)
            sides /= np.hypot(*sides.T)[:, None]
            assert np.sum(sides[1:] * sides[:-1], axis=1).min() > -0.99
        # Counter-clockwise, together as large as the section.
        assert min(areas) > 0.0
        assert areas[0] == pytest.approx(case.cut.area)
        assert sum(areas) == pytest.approx(case.outline.area)
        upper, lower = scene.parts
        assert upper.points[upper.upstream[0]] == pytest.approx(case.cut.heel)
        assert upper.points[upper.downstream[0]] == pytest.approx(case.cut.toe)
        assert lower.points[lower.upstream[-1]] == pytest.approx(case.cut.heel)
        assert lower.points[lower.downstream[-1]] == pytest.approx(case.cut.toe)
        assert lower.points[lower.upstream[0], 1] == lower.points[lower.downstream[0], 1] == scene.base


def test_parts_do_not_visibly_run_into_each_other(elastic):
    case, response = elastic
    scene = build_scene(case, response, response.crack.time, None)
    bottom, top = scene.views[-1][2:]
    assert scene.exaggeration >= 5.0
    for frame in range(len(scene.times)):
        upper, lower = (part.drawn(frame, scene.exaggeration)[part.crack] for part in scene.parts)
        over = (upper[:, 0] >= lower[0, 0]) & (upper[:, 0] <= lower[-1, 0])
        gaps = upper[over, 1] - np.interp(upper[over, 0], lower[:, 0], lower[:, 1])
        # Three pixels of a picture of 600.
        assert gaps.min(initial=0.0) > -0.005 * (top - bottom)


def test_forces_of_a_block_add_up_to_the_histories(block):
    case, response = block
    histories = response.histories
    scene = build_scene(case, response, histories["time_s"], None)
    assert scene.force_unit == "MN/m"
    total = 1e6 * scene.forces.sum(axis=1)
    normal = histories["normal_force_heel_n"] + histories["normal_force_toe_n"]
    held = normal > 0.0
    assert total[:, 1] == pytest.approx(normal)
    assert total[held, 0] == pytest.approx(histories["friction_force_n"][held])


def test_stresses_of_an_elastic_crack_add_up_to_the_forces(elastic):
    case, response = elastic
    record = response.crack
    scene = build_scene(case, response, record.time, None)
    assert scene.force_unit == "MPa"
    # Simpson's rule by hand: two elements of half the crack each.
    lengths = record.dam.section.crack_width / 12.0 * np.array([1.0, 4.0, 2.0, 4.0, 1.0])
    for frame in (0, 30, -1):
        forces = 1e6 * scene.forces[frame] * lengths[:, None]
        assert forces == pytest.approx(record.forces()[frame].T, rel=1e-9, abs=1e-3)


def test_points_of_the_crack_say_what_they_do(block, elastic):
    case, response = block
    scene = build_scene(case, response, response.histories["time_s"], None)
    names = np.array(STATUSES)[scene.status]
    for frame, mode in enumerate(response.mode):
        corners = names[frame]
        if mode == "drift":
            assert (corners == "open").all()
        if mode == "rest":
            assert (corners == "stick").all()
        if mode.startswith("rock on heel"):
            assert corners.tolist() == ["stick", "open"]
    case, response = elastic
    scene = build_scene(case, response, response.crack.time, None)
    known = response.crack.status_names()
    watched = response.crack.node_status()[0]
    for k in np.ndindex(scene.status.shape):
        expected = known[watched[k]] if watched[k] >= 0 else "absent"
        assert (STATUSES[scene.status[k]] if scene.status[k] >= 0 else "absent") == expected


@pytest.mark.parametrize(("value", "expected"), [(1.0, 1.0), (1.99, 1.0), (2.0, 2.0), (49.0, 20.0), (0.06, 0.05)])
def test_round_numbers(value, expected):
    assert round_below(value) == pytest.approx(expected)


def test_the_exaggeration_fits_dam_and_crack():
    dam = SimpleNamespace(crest_elevation=100.0, base_elevation=0.0, crack_width=80.0)
    assert automatic(0.1, dam) == 50.0  # 8 m of 100 m are 80 times 0.1 m
    assert automatic(0.1, SimpleNamespace(**{**vars(dam), "crack_width": 8.0})) == 20.0
    assert automatic(30.0, dam) == 1.0
    assert automatic(0.0, dam) == 1.0


def test_arrows_point_where_the_force_goes():
    outline = arrow_outlines(np.array([[5.0, 1.0], [0.0, 0.0]]), np.array([[0.0, 2.0], [0.0, 0.0]]), 0.1)
    # One arrow of eight corners; the force of zero has none.
    assert len(outline.vertices) == 8
    assert outline.vertices[3] == pytest.approx([5.0, 1.0])
    assert outline.vertices[:, 1].min() == pytest.approx(-1.0)
    assert len(arrow_outlines(np.zeros((1, 2)), np.zeros((1, 2)), 0.1).vertices) == 0


# Files


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
    times = unpacked(scene["times"])
    assert times[0] == 0.0
    assert times[-1] == pytest.approx(0.9)
    traces = {trace["name"]: trace for trace in scene["traces"]}
    history = unpacked(scene["historyTimes"])
    within = response.histories["time_s"] <= 0.9 + 1e-12
    assert history == pytest.approx(response.histories["time_s"][within], rel=1e-6, abs=1e-6)
    slip = 1e3 * response.histories["slip_m"][within]
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
    assert len(re.findall("</script>", text)) == 3
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
    for script in ("scene.js", "player.js"):
        subprocess.run(["node", "--check", PACKAGE / script], check=True, timeout=60)
    program = """
      const model = require(process.argv[1]);
      const scene = model.readScene(JSON.parse(require("fs").readFileSync(process.argv[2], "utf8")));
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
        ["node", "-e", program, PACKAGE / "scene.js", tmp_path / "scene.json"],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    found = json.loads(result.stdout)
    expected = build_scene(case, response, np.array([0.0, 0.50, 0.51]), 20.0)
    for drawn, part in zip(found["drawn"], expected.parts, strict=True):
        # Between its moments, 10 ms apart, the page goes straight.
        middle = (part.drawn(1, 20.0) + part.drawn(2, 20.0)) / 2.0
        assert np.array(drawn).reshape(-1, 2) == pytest.approx(middle, abs=1e-3)
    assert np.hypot(*np.array(found["arrows"]).T).max() <= page_scene(path)["cut"] + 1e-9
    assert np.array(found["arrow"]) == pytest.approx(
        arrow_outlines(np.array([[5.0, 1.0]]), np.array([[0.0, 2.0]]), 0.1).vertices[:7]
    )
    assert found["ticks"] == pytest.approx([-0.4, -0.2, 0.0, 0.2])
    assert 20 in found["choices"]
    assert found["choices"] == sorted(set(found["choices"]))
    assert 7 in found["odd"]
    assert found["hash"] == [6.5, None, None]
    assert found["level"] == [1, 2]


# Refusals


@pytest.mark.parametrize(
    ("name", "options", "code"),
    [
        ("dam.avi", {}, "animation-ending"),
        ("dam", {}, "animation-ending"),
        ("dam.html", {"exaggerate": 0.0}, "animation-range"),
        ("dam.html", {"exaggerate": float("nan")}, "animation-range"),
        ("dam.gif", {"frames_per_second": 0.5}, "animation-range"),
        ("dam.gif", {"frames_per_second": 1000.0}, "animation-range"),
        ("dam.html", {"speed": -1.0}, "animation-range"),
        ("dam.html", {"window": (0.5, 0.5)}, "animation-window"),
        ("dam.html", {"window": (7.0, None)}, "animation-window"),
        ("dam.mp4", {"speed": 0.001, "frames_per_second": 120.0}, "animation-frames"),
        ("nowhere/dam.html", {}, "cannot-write"),
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
        animate(case, replace(response, outcome="unstable", histories={}), tmp_path / "dam.html")
    assert caught.value.code == "animation-nothing"


def test_a_missing_package_says_how_to_get_it(block, tmp_path, monkeypatch):
    case, response = block
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(InputError, match=r"pip install heeltoe\[animation\]"):
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
        (("--model", "both"), "rigid, flexible or decoupled"),
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
