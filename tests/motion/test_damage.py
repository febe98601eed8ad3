"""What is wrong with a record is looked for in the record, before scaling and filters hide it."""

from __future__ import annotations

import numpy as np
import pytest

import heeltoe
from heeltoe import InputError, read_case, rigid
from heeltoe.motion.check import check_record
from heeltoe.motion.records.read import read_channels
from shared.command import command
from shared.dams import BLOCK
from shared.record_samples import GAL, G, channels, cosmos, csmip, read

WAVE = 0.3 * np.sin(0.13 * np.arange(400)) * np.hanning(400)


def record(path, values=WAVE, unit="g", step="0.01 s"):
    path.write_text(f"# time step: {step}\n# units: [{unit}]\n" + "\n".join(f"{value:.6g}" for value in values))
    return path


def damaged(value, width=1, wave=WAVE):
    values = wave.copy()
    values[150 : 150 + width] = value
    return values


def run(file, *changes):
    return rigid(read_case(BLOCK, [f"motion.file={file}", *changes]))


HIDING = [
    (),
    ("motion.pga=0.3 g",),
    ('motion.processing=[{step="band-pass", low="0.2 Hz", high="10 Hz"}]', "motion.pga=0.3 g"),
    ('motion.processing=[{step="scale-to-arias", intensity="1 m/s"}]',),
]


@pytest.mark.parametrize("changes", HIDING)
@pytest.mark.parametrize(
    ("values", "unit", "code"),
    [
        (damaged(-9999.0), "g", "record-marker"),
        (damaged(-999.9, width=4, wave=100.0 * WAVE), "mm/s^2", "record-marker"),
        (damaged(9.99), "g", "motion-spike"),
        (damaged(-1.2), "g", "motion-spike"),
        (1e4 * WAVE, "g", "motion-peak"),
    ],
)
def test_no_scaling_or_filter_hides_damage(values, unit, code, changes, tmp_path):
    file = record(tmp_path / "a.txt", values, unit)
    with pytest.raises(InputError) as caught:
        run(file, *changes)
    assert caught.value.code == code
    assert "scale" not in str(caught.value)
    assert "pga" not in str(caught.value)


def test_a_doubtful_value_is_pointed_at_and_a_sound_record_is_not(tmp_path):
    doubted = run(record(tmp_path / "a.txt", damaged(0.75)), "motion.pga=0.3 g")
    (message,) = (warning for warning in doubted.warnings if warning.name == "motion-flaw spike")
    assert message.time_s == pytest.approx(1.5)
    assert dict(message.quantities)["peak_g"] == pytest.approx(0.75)
    sound = run(record(tmp_path / "b.txt"), "motion.pga=0.3 g")
    assert not {"motion-flaw spike", "motion-flaw coarse", "component-other"} & {
        warning.name for warning in sound.warnings
    }


def test_nines_that_were_measured_are_no_marker(tmp_path):
    values = 1000.0 * WAVE / np.abs(WAVE).max()
    values[np.abs(values).argmax()] = 999.0
    assert run(record(tmp_path / "a.txt", values, "cm/s^2"), "motion.pga=0.3 g").summary


def test_clipping_shows_before_a_filter_rounds_it_off(tmp_path):
    file = record(tmp_path / "a.txt", np.clip(WAVE, -0.15, 0.15))
    for changes in HIDING:
        assert "motion-flaw clipped" in {warning.name for warning in run(file, *changes).warnings}


def test_real_records_have_no_spikes(records):
    doubted = set()
    for path in sorted((records / "ensemble").iterdir()):
        for motion in read_channels(path) if path.suffix else []:
            doubted |= {path.stem for item in check_record(motion, G) if item.name == "motion-flaw spike"}
    assert all("cape-mendocino" in name for name in doubted), doubted


@pytest.mark.parametrize("step", ["10 s", "1.5 s"])
def test_a_step_of_seconds_is_no_record(step, tmp_path):
    bare = tmp_path / "bare.txt"
    bare.write_text("# units: [g]\n" + "\n".join(f"{value:.6g}" for value in WAVE))
    columns = tmp_path / "columns.txt"
    seconds = float(step.split()[0])
    columns.write_text("# units: [g]\n" + "\n".join(f"{k * seconds} {value:.6g}" for k, value in enumerate(WAVE)))
    for file, changes in ((record(tmp_path / "a.txt", step=step), []), (columns, []), (bare, [f"time_step={step}"])):
        with pytest.raises(InputError, match="is not that of a record"):
            run(file, *(f"motion.{change}" for change in changes))


def test_a_step_that_is_too_long_for_a_dam_is_told(tmp_path):
    warnings = run(record(tmp_path / "a.txt", step="0.2 s")).warnings
    assert any(item.name == "motion-flaw coarse" and "every 0.2 s" in str(item) for item in warnings)


@pytest.mark.parametrize(("height", "step", "left_out"), [(100.0, 0.1, 0.2), (100.0, 0.02, None), (20.0, 0.02, 0.2)])
def test_a_step_is_judged_by_the_period_of_an_elastic_dam(tmp_path, height, step, left_out):
    """Straight lines leave sinc(h / T) squared of a wave of period T that is measured every h: of a dam that swings in
    0.38 s (100 m) 79 % at 0.1 s and 99 % at 0.02 s; a fifth of its height swings five times as fast."""
    file = record(tmp_path / "a.txt", step=f"{step} s")
    section = {"height": f"{height} m", "crest_width": f"{0.08 * height} m", "base_width": f"{0.8 * height} m"}
    fields = {
        "section": section,
        "concrete": {"modulus": "20 GPa", "density": "2650 kg/m^3", "poisson": 0.143},
        "crack": {"friction": 1.0},
        "reservoir": {"depth": f"{height} m"},
        "motion": {"file": str(file)},
        "flexible": {"elements_across": 4, "evidence": "none"},
        "analysis": {"silence": "0 s"},
    }
    case = heeltoe.read_case(fields)
    named = [notice for notice in heeltoe.run(case, "flexible").warnings if notice.name == "motion-coarse-for-dam"]
    shares = [dict(notice.quantities)["share"] for notice in named]
    assert shares == ([] if left_out is None else [pytest.approx(left_out, abs=0.05)])
    if named:
        first = heeltoe.dam_periods(case, 1).intact[0]
        assert dict(named[0].quantities)["period_s"] == pytest.approx(first, rel=0.12)
        assert shares[0] == pytest.approx(1.0 - np.sinc(step / first) ** 2, rel=0.25)
    # A block swings in no period.
    assert "motion-coarse-for-dam" not in {notice.name for notice in heeltoe.run(case, "rigid").warnings}


@pytest.mark.parametrize("component", ["UP", "Up", "vertical UP", "DWN", "U-D", "HNZ", "Vert."])
def test_a_vertical_component_that_shakes_horizontally_is_told(component, tmp_path):
    file = tmp_path / "a.V2"
    file.write_text(csmip({component: GAL}))
    for other, code in (("", "component-other"), ("vertical.", None)):
        changes = [f"motion.{other}file={file}"] + ([f"motion.file={record(tmp_path / 'b.txt')}"] if other else [])
        codes = {warning.name for warning in rigid(read_case(BLOCK, changes)).warnings}
        assert {item for item in codes if item.startswith("component-")} == ({code} if code else set())


@pytest.mark.parametrize("component", ["90 DEG", "S69E", "N-S", "EW", "164 (S16E)", "HNN", "360"])
def test_a_horizontal_component_that_shakes_vertically_is_told(component, tmp_path):
    file = tmp_path / "a.V2"
    file.write_text(csmip({component: GAL}))
    case = read_case(BLOCK, [f"motion.file={file}", f"motion.vertical.file={file}"])
    (warning,) = [item for item in rigid(case).warnings if item.name.startswith("component-")]
    assert (warning.name, warning.field) == ("component-other", "motion.vertical")
    assert "is a horizontal component" in str(warning)


def test_a_name_tells_where_a_file_does_not(tmp_path):
    warnings = run(record(tmp_path / "quake_up.txt")).warnings
    assert "component-other" in {item.name for item in warnings}


def test_components_of_two_earthquakes_are_told(tmp_path):
    one, other = tmp_path / "a.V2", tmp_path / "b.V2"
    one.write_text(cosmos())
    for event, answer in (("Nowhere Earthquake of Tue Jan 1, 1980 20:00 UTC", False), ("Elsewhere in 1999", True)):
        other.write_text(cosmos(direction="Up", event=event))
        case = read_case(BLOCK, [f"motion.file={one}", f"motion.vertical.file={other}"])
        warnings = [warning for warning in rigid(case).warnings if warning.name == "components-differ"]
        assert bool(warnings) is answer


def columns(path, values=WAVE, step=0.01, **about):
    header = [f"# {name}: {text}" for name, text in about.items()]
    header += [f"# time step: {step} s", "# units: [g]"]
    path.write_text("\n".join([*header, *(f"{value:.6g}" for value in values)]))
    return path


@pytest.mark.parametrize(
    ("across", "up", "code"),
    [
        ({"event": "Kern County 1952"}, {"event": "Imperial Valley", "date": "1940-05-19"}, "components-differ"),
        ({"event": "A", "station": "Here"}, {"event": "A", "station": "There"}, "components-differ"),
        ({"event": "A", "date": "1940-05-19"}, {"event": "A", "step": 0.02}, None),
        ({"event": "A", "date": "1940-05-19"}, {"station": "There", "step": 0.02}, "components-unsure"),
        ({"date": "1940-05-19"}, {"values": WAVE[:300]}, "components-unsure"),
        ({"date": "1940-05-19"}, {}, None),
    ],
)
def test_components_are_compared_by_all_that_their_files_state(across, up, code, tmp_path):
    files = columns(tmp_path / "a.txt", **across), columns(tmp_path / "b.txt", **up)
    case = read_case(BLOCK, [f"motion.file={files[0]}", f"motion.vertical.file={files[1]}"])
    notices = [notice for notice in rigid(case).warnings if notice.name.startswith("components-")]
    assert [notice.name for notice in notices] == ([code] if code else [])
    if code == "components-unsure":
        assert "event" in str(notices[0])
        assert "could not be compared" in str(notices[0])


def test_components_in_two_formats_are_compared_by_their_years(tmp_path):
    across = columns(tmp_path / "a.txt", event="Kern County, California, 1952")
    up = tmp_path / "b.V2"
    up.write_text(cosmos(direction="Up", event="Nowhere Earthquake of Tue Jan 1, 1980 20:00 UTC"))
    case = read_case(BLOCK, [f"motion.file={across}", f"motion.vertical.file={up}"])
    assert "components-differ" in {notice.name for notice in rigid(case).warnings}


def test_the_first_of_two_channels_is_not_taken_for_the_record():
    whole = csmip({"90 DEG": GAL, "UP": -0.5 * GAL})
    cut = whole[: whole.index("POINTS OF ACCEL DATA", whole.index("POINTS OF ACCEL DATA") + 1) - 2]
    with pytest.raises(InputError, match=r"opens 2 channels, but has the accelerations of one alone \(1: 90 DEG"):
        read(cut)
    assert read(cut, channel=1).component == "90 DEG"
    assert [motion.component for motion in channels(cut)] == ["90 DEG"]


def test_a_look_at_a_record_says_what_an_analysis_would_refuse(tmp_path):
    file = record(tmp_path / "up.txt", damaged(9.99))
    text = " ".join(command("motion", file, cwd=tmp_path).stdout.split())
    assert "jumps to 9.99 g at 1.5 s and back" in text
    assert "shakes the dam" not in text


@pytest.mark.parametrize(
    "whole",
    [
        csmip({"90 DEG": GAL, "UP": -0.5 * GAL}),
        cosmos() + cosmos("velocity") + cosmos(values=0.5 * GAL, number=2, direction="Up"),
    ],
)
def test_a_file_of_two_channels_that_is_cut_anywhere_says_so(whole):
    lines = whole.splitlines(keepends=True)
    ends = [k for k, line in enumerate(lines, 1) if "end of data" in line.lower() or "end-of-data" in line.lower()]
    silent = []
    for k in range(2, len(lines)):
        try:
            result = read("".join(lines[:k]))
        except InputError:
            continue
        if not result.warnings:
            silent.append(k)
    # Between two channels nothing is missing, as far as the file tells.
    assert set(silent) <= {*ends, *(k + 1 for k in ends)}
