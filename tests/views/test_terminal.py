"""What the terminal says in SI and in the units of the United States, each made of the same numbers."""

from __future__ import annotations

import io
import re
from dataclasses import replace
from typing import Any

import pytest
from rich.console import Console

from heeltoe import read_case, rigid, statics, with_spread
from heeltoe.case.model import Case
from heeltoe.models.statics.joints import Joints, statics_of_sections
from heeltoe.study.small.run_table import parse_axes, run_small
from heeltoe.views.terminal.motion import print_motion
from heeltoe.views.terminal.show import show
from heeltoe.views.terminal.statics import print_sections
from shared.command import command
from shared.dams import BASE, FAST, KOYNA_TOP, example
from shared.responses import with_numbers
from shared.statics import dam

SI = re.compile(r"\d ?(mm|m|m/s|m/s²|kN/m|MN/m|kPa|MPa|GPa|J|J/m|kJ/m|MJ/m|kg/m\^3)(?![\w/²^])|per metre")


def shown(result: Any, units: str, case: Case | None = None) -> str:
    """The text of a result on a wide terminal; all of it with its case."""
    file = io.StringIO()
    console = Console(file=file, width=220, highlight=False)
    if isinstance(result, Joints):
        print_sections(result, console, units, details=True)
    else:
        show(result, console, units, case)
    return file.getvalue()


def plain(response: Any) -> Any:
    """The same without people's own words, and without what was done to its motion, which is told as it was done."""
    return replace(response, title="", motion=replace(response.motion, processing=()))


@pytest.fixture(scope="module")
def results(typical_both, koyna_both) -> dict[str, Any]:
    strong = example("koyna-top", "motion.pga=1.2g", "motion.duration=5s")
    loads = ["statics.flood_depth=97m", "statics.seismic_coefficient=0.1", "statics.compressive_strength=20MPa"]
    return {
        "rigid": with_spread(rigid(strong), strong, 3),
        "both": typical_both,
        "flexible": replace(typical_both, beside=None),
        "decoupled": koyna_both.beside,
        "chain": koyna_both,
        "grid": run_small(KOYNA_TOP, ["motion.duration=2s"], parse_axes(["crack.friction=0.2,1.0"]), rigid),
        "statics": statics_of_sections(example("typical-base", *loads), lambda case, place: statics(case, 0.1)),
        "failed": rigid(dam("99 m", crack={"friction": 0.2}, motion={"points": [["0 s", "0.1 g"], ["1 s", "0 g"]]})),
    }


@pytest.mark.parametrize("name", ["rigid", "both", "flexible", "decoupled", "chain", "grid", "statics", "failed"])
def test_no_si_unit_is_left(results, name):
    result = results[name]
    if name not in ("grid", "statics"):
        result = plain(result) if name not in ("both", "chain") else result.with_responses(plain)
    text = shown(result, "us")
    assert not SI.search(text), SI.search(text)
    assert SI.search(shown(result, "si")) or name in ("grid", "failed")


def test_both_systems_say_the_same(results):
    def lengths(text: str, label: str) -> list[float]:
        sizes = {"mm": 1e-3, "m": 1.0, "in": 0.0254, "ft": 0.3048}
        (line,) = (line for line in text.splitlines() if line.startswith(label))
        return [float(number) * sizes[unit] for number, unit in re.findall(r"(-?[\d.]+) (mm|m|in|ft)\b", line)]

    case = read_case(BASE, FAST)
    for label in ("Residual slip, +", "Peak slip downstream", "Opening at the upstream face"):
        si, us = (lengths(shown(results["both"], units, case), label) for units in ("si", "us"))
        assert len(si) == len(us) > 0
        assert us == pytest.approx(si, rel=0.02, abs=1e-5)


def test_a_row_of_the_static_checks_has_one_unit(results):
    si, us = (shown(results["statics"], units).splitlines() for units in ("si", "us"))

    def row(lines: list[str], label: str) -> list[float]:
        (line,) = (line for line in lines if line.startswith(label))
        numbers, units = line.removeprefix(label).split()[::2], set(line.removeprefix(label).split()[1::2])
        assert len(units) == 1, line
        return [float(number) for number in numbers]

    forces = row(si, "Normal force")
    assert len(forces) == 5
    kip_per_foot, psi = 4448.2216152605 / 0.3048, 6894.757293168
    assert row(us, "Normal force") == pytest.approx([force * 1e6 / kip_per_foot for force in forces], rel=1e-3)
    stresses = row(si, "Stress at the toe, compression +")
    assert row(us, "Stress at the toe, compression +") == pytest.approx(
        [stress * 1e6 / psi for stress in stresses], rel=2e-3
    )


@pytest.mark.parametrize(("residual", "units"), [(0.3, "si"), (1.5, "si"), (0.3, "us")])
def test_a_column_is_no_wider_than_what_can_be_measured(results, residual, units):
    """A tenth of a micrometre beside what is shown in mm, in m and in inches."""
    moved = with_numbers(results["flexible"], residual_slip_m=residual, peak_slip_upstream_m=-1e-7)
    file = io.StringIO()
    show(moved, Console(file=file, width=80, highlight=False), units)
    (row,) = [line for line in file.getvalue().splitlines() if line.startswith("flexible dam")]
    number, unit, down, _, up = row.removeprefix("flexible dam").split()[:5]
    assert (float(number) > 0.0, unit in {"mm", "m", "in"}, float(down) > 0.0, up) == (True, True, True, "-")


def test_people_s_own_words_stay(results):
    words = "5 m high, 1 mm to 10 km [draft]"
    assert words in shown(replace(results["rigid"], title=words), "us")


def test_a_motion(results):
    motion = results["rigid"].motion
    texts = []
    for units in ("si", "us"):
        file = io.StringIO()
        print_motion(motion, Console(file=file, width=200, highlight=False), units)
        texts.append(file.getvalue())
    speeds = [float(re.search(r"PGV +([\d.]+)", text)[1]) for text in texts]
    assert speeds[1] * 0.3048 == pytest.approx(speeds[0], rel=1e-3)


def test_errors_quote_what_was_typed(tmp_path):
    case = tmp_path / "small.json"
    case.write_text(
        '{"section": {"polygon": [["0 m", "0 m"], ["1 um", "0 m"], ["0 m", "1 um"]]}, "crack": {"friction": 1}}'
    )
    process = command("run", case, "--units", "us")
    assert process.returncode == 2
    assert "give a value from 1 mm to 10 km" in process.stderr
