"""The command line as a user meets it: a process with arguments, output, exit code."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from conftest import ROOT

EXAMPLES = ROOT / "examples"


def heeltoe(*arguments: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", "from heeltoe.cli import main; main()", *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=cwd,
        env={**os.environ, "COLUMNS": "200"},
        timeout=120,
        check=False,
    )


def test_run_says_what_the_dam_does():
    result = heeltoe("run", EXAMPLES / "typical-base.toml")
    assert result.returncode == 0, result.stderr
    for words in ("PGA 0.4 g", "sliding safety factor", "residual slip", "Verdict", "downstream"):
        assert words in result.stdout


def test_json_on_standard_output_is_only_json():
    result = heeltoe("run", EXAMPLES / "block.toml", "--json", "-")
    assert result.returncode == 0
    data = json.loads(result.stdout)
    assert "Verdict" in result.stderr
    assert data["model"] == "rigid"
    assert data["outcome"] == "ok"
    assert data["residual_slip_m"] == pytest.approx(-0.012 * 9.80665, rel=1e-12)


def test_the_contract_of_the_json():
    data = json.loads(heeltoe("run", EXAMPLES / "typical-base.toml", "--json", "-").stdout)
    for key in [
        "model",
        "title",
        "outcome",
        "advice",
        "warnings",
        "residual_slip_m",
        "peak_slip_downstream_m",
        "peak_slip_upstream_m",
        "rocking_downstream_rad",
        "rocking_upstream_rad",
        "opening_upstream_m",
        "opening_downstream_m",
        "slip_by_mode_m",
        "impacts",
        "events",
        "final_mode",
        "critical_acceleration_g",
        "energy",
        "motion",
        "build",
    ]:
        assert key in data, key
    assert set(data["slip_by_mode_m"]) == {"sliding", "slide_rocking", "drifting"}
    assert set(data["energy"]) >= {"input_j", "friction_j", "impact_j", "residual"}
    assert set(data["motion"]) >= {"name", "pga_g", "pgv_m_s", "dt_s", "duration_s"}
    assert set(data["critical_acceleration_g"]) >= {"sliding", "rocking"}
    assert sum(data["slip_by_mode_m"].values()) == pytest.approx(data["residual_slip_m"], rel=1e-12)


def test_out_writes_everything(tmp_path):
    out = tmp_path / "deep" / "result"
    result = heeltoe("run", EXAMPLES / "typical-base.toml", "--out", out)
    assert result.returncode == 0, result.stderr
    names = {path.name for path in out.iterdir()}
    assert names >= {"result.json", "histories.parquet", "events.parquet", "response.png", "response.svg"}
    table = pq.read_table(out / "histories.parquet")
    data = json.loads((out / "result.json").read_text())
    assert table["slip_m"][-1].as_py() == pytest.approx(data["residual_slip_m"], rel=1e-12)
    assert {"time_s", "mode", "rotation_rad", "gap_heel_m"} <= set(table.column_names)


def test_csv_and_output_step(tmp_path):
    result = heeltoe("run", EXAMPLES / "block.toml", "--out", tmp_path, "--csv", "--output-step", "0.01s")
    assert result.returncode == 0, result.stderr
    lines = (tmp_path / "histories.csv").read_text().splitlines()
    assert len(lines) == 42


def test_set_motion_pga_reverse_duration():
    def slip(*more: str) -> float:
        result = heeltoe("run", EXAMPLES / "typical-base.toml", "--json", "-", *more)
        assert result.returncode == 0, result.stderr
        return float(json.loads(result.stdout)["residual_slip_m"])

    plain = slip()
    assert slip("--pga", "0.3g") < plain
    assert slip("--set", "reservoir.depth=90m") < plain
    assert slip("--set", "crack.friction=1.2", "--set", "reservoir.depth=90m") < slip("--set", "reservoir.depth=90m")
    assert slip("--reverse") != plain
    assert slip("--duration", "2s") != plain
    assert slip("--motion", "pacoima-1971-164-nga") != plain


def test_a_motion_on_the_command_line_is_relative_to_where_the_user_stands(tmp_path):
    (tmp_path / "pulse.txt").write_text("# units: time [s], acceleration [g]\n0 -0.5\n0.4 -0.5\n0.41 0\n2 0\n")
    result = heeltoe("run", EXAMPLES / "typical-base.toml", "--motion", "pulse.txt", "--json", "-", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["motion"]["name"] == "pulse"


def test_a_dam_that_cannot_stand_is_not_shaken():
    result = heeltoe("run", EXAMPLES / "typical-base.toml", "--set", "crack.friction=0.3", "--json", "-")
    assert result.returncode == 3
    data = json.loads(result.stdout)
    assert data["outcome"] == "unstable"
    assert "sliding safety factor 0." in data["advice"]
    assert data["static"]["sliding_safety_factor"] < 1.0
    assert "residual_slip_m" not in data or data["residual_slip_m"] is None


@pytest.mark.parametrize("arguments", [("--model", "flexible"), ("--model", "both"), ("--spread", "11"), ("--report",)])
def test_what_is_not_there_yet_says_so(arguments, tmp_path):
    result = heeltoe("run", EXAMPLES / "block.toml", *arguments, "--out", tmp_path / "out")
    assert result.returncode == 2
    assert "later release" in result.stderr
    assert not (tmp_path / "out").exists()


def test_new_writes_a_case_that_runs(tmp_path):
    assert heeltoe("new", "mydam", cwd=tmp_path).returncode == 0
    result = heeltoe("run", "mydam.toml", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    again = heeltoe("new", "mydam", cwd=tmp_path)
    assert again.returncode == 2
    assert "there already" in again.stderr


def test_version_and_help():
    assert "heeltoe 0.1" in heeltoe("--version").stdout
    text = heeltoe("run", "--help").stdout
    for option in [
        "--model",
        "--motion",
        "--pga",
        "--reverse",
        "--duration",
        "--set",
        "--spread",
        "--json",
        "--out",
        "--report",
    ]:
        assert option in text


def test_motion_echo_and_list():
    listing = heeltoe("motion", "--list")
    assert listing.returncode == 0
    assert "elcentro-1940-180-nga" in listing.stdout
    echo = heeltoe("motion", "elcentro-1940-180-nga")
    assert echo.returncode == 0, echo.stderr
    assert "0.2808 g" in echo.stdout
    assert "El Centro" in echo.stdout
