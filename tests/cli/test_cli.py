"""The command line as a user meets it: a process with arguments, output, exit code."""

from __future__ import annotations

import contextlib
import errno
import json
import os
import pty
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from shared.command import command, options, process
from shared.dams import BASE, BLOCK, EXAMPLES, HEIGHT, ROOT
from shared.dams import FAST as SHORT

COARSE = ("--set", "flexible.elements_across=2")
FAST = options(SHORT)
RIGID = (BASE, "--model", "rigid")


def test_run_says_what_the_dam_does():
    result = process("run", *RIGID)
    assert result.returncode == 0, result.stderr
    for words in ("PGA 0.4 g", "residual slip", "Verdict", "downstream"):
        assert words in result.stdout
    # Before the list of files, if any.
    assert len(result.stdout.splitlines()) <= 15
    assert "sliding safety factor" in process("run", *RIGID, "--details").stdout.lower()


@pytest.mark.slow
def test_figures_in_us_units(tmp_path):
    run = ("run", BLOCK, "--out", tmp_path)
    assert command(*run, "--units", "us").returncode == 0
    assert "slip [in]" in (tmp_path / "response.svg").read_text(encoding="utf-8")
    assert "kip/ft" in (tmp_path / "section.svg").read_text(encoding="utf-8")
    screen = command("run", *RIGID, "--units", "us", "--set", "title=Dam of 100 m", "--duration", "5s", "--details")
    for words in ("Dam of 100 m", "ft/s", "residual slip", " in "):
        assert words in screen.stdout
    assert not re.search(r"\d\s(mm|m/s|m)\b", screen.stdout.replace("Dam of 100 m", ""))
    refused = command(*run, "--units", "imperial")
    assert refused.returncode == 2
    assert "--units" in refused.stderr


def test_json_on_standard_output_is_only_json():
    result = process("run", BLOCK, "--json", "-")
    assert result.returncode == 0
    data = json.loads(result.stdout)
    assert "Verdict" in result.stderr
    assert data["model"] == "rigid"
    assert data["outcome"] == "ok"
    assert data["residual_slip_m"] == pytest.approx(-0.012 * 9.80665, rel=1e-12)


def test_the_contract_of_the_json():
    data = json.loads(command("run", *RIGID, "--json", "-").stdout)
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


@pytest.mark.slow
def test_out_writes_everything(tmp_path):
    out = tmp_path / "deep" / "result"
    result = command("run", *RIGID, "--out", out)
    assert result.returncode == 0, result.stderr
    names = {path.name for path in out.iterdir()}
    assert names >= {"result.json", "histories.parquet", "events.parquet", "response.png", "response.svg"}
    table = pq.read_table(out / "histories.parquet")
    data = json.loads((out / "result.json").read_text())
    assert table["slip_m"][-1].as_py() == pytest.approx(data["residual_slip_m"], rel=1e-12)
    assert {"time_s", "mode", "rotation_rad", "gap_heel_m"} <= set(table.column_names)


@pytest.mark.usefixtures("no_figures")
def test_csv_and_output_step(tmp_path):
    result = command("run", BLOCK, "--out", tmp_path, "--csv", "--output-step", "0.01s")
    assert result.returncode == 0, result.stderr
    lines = (tmp_path / "histories.csv").read_text().splitlines()
    assert len(lines) == 42


def test_set_motion_pga_reverse_duration():
    def slip(*more: str) -> float:
        result = command("run", *RIGID, "--json", "-", *more)
        assert result.returncode == 0, result.stderr
        return float(json.loads(result.stdout)["residual_slip_m"])

    plain = slip()
    assert slip("--pga", "0.3g") < plain
    assert slip("--set", "reservoir.depth=90m") < plain
    assert slip("--set", "crack.friction=1.2", "--set", "reservoir.depth=90m") < slip("--set", "reservoir.depth=90m")
    recorded = slip("--set", "motion.sign=recorded")
    assert slip("--reverse") != recorded
    # Where no one says which way round, the worse one counts.
    assert plain == max(slip("--reverse"), recorded)
    assert slip("--duration", "2s") != plain
    assert slip("--motion", "pacoima-1971-164-nga") != plain


@pytest.mark.parametrize(
    ("name", "option"), [("run", "--motion"), ("run", "--pga"), ("statics", "--criteria"), ("statics", "--slip")]
)
def test_what_looks_like_a_list_and_is_none_is_refused(name, option):
    result = command(name, *RIGID, option, "elcentro-1940-180-nga", f"{option}=0.3 g")
    assert result.returncode == 2
    assert result.stderr == f"heeltoe: {option}: is given 2 times; give it once; a study runs several values\n"


def test_a_motion_on_the_command_line_is_relative_to_where_the_user_stands(tmp_path):
    (tmp_path / "pulse.txt").write_text("# units: time [s], acceleration [g]\n0 -0.5\n0.4 -0.5\n0.41 0\n2 0\n")
    result = command("run", *RIGID, "--motion", "pulse.txt", "--json", "-", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["motion"]["name"] == "pulse"


def test_a_dam_that_cannot_stand_is_not_shaken():
    result = process("run", *RIGID, "--set", "crack.friction=0.3", "--json", "-")
    assert result.returncode == 3
    data = json.loads(result.stdout)
    assert data["outcome"] == "unstable"
    assert "sliding safety factor 0." in data["advice"]
    assert data["static"]["sliding_safety_factor"] < 1.0
    assert "residual_slip_m" not in data or data["residual_slip_m"] is None


@pytest.mark.usefixtures("no_figures")
def test_flexible_says_what_its_result_rests_on(tmp_path):
    short = ("--model", "flexible", *COARSE, "--duration", "4s")
    result = command("run", *RIGID, *short, "--details", "--out", tmp_path)
    assert result.returncode == 0, result.stderr
    for words in [
        "(flexible model)",
        "Period of the intact dam with its water, 1",
        "Nodes along the crack",
        "Damping of a mode of the intact dam, 5",
        "Time step",
        "Residual slip: by how much another time step moves it",
        "Energy lost in the concrete's damping",
        "Blows",
        "Answer. The dam slides",
    ]:
        assert words in " ".join(result.stdout.split()), words
    data = json.loads((tmp_path / "result.json").read_text())
    assert data["model"] == "flexible"
    assert data["damping"] == "relative"
    assert len(data["periods_s"]) == 5
    assert data["evidence"]["other_time_step_s"] == pytest.approx(2.0 * data["time_step_s"], rel=1e-3)
    energy = data["energy"]
    parts = ("friction_j", "impact_j", "damping_j", "rock_j", "floor_j", "far_end_j", "numerical_j", "left_j")
    assert sum(energy[name] for name in parts) == pytest.approx(energy["input_j"], rel=1e-6)
    assert (tmp_path / "crack.parquet").exists()


def test_evidence_is_chosen_on_the_command_line():
    short = ("run", *RIGID, "--model", "flexible", *COARSE, "--duration", "1s", "--json", "-", "--evidence")
    evidences = [json.loads(command(*short, item).stdout)["evidence"] for item in ("none", "step")]
    assert evidences[0] is None
    assert (evidences[1]["asked"], evidences[1]["runs"]) == ("step", 2)
    result = command(*short, "some")
    assert result.returncode == 2
    assert "flexible.evidence" in result.stderr


@pytest.mark.slow
@pytest.mark.usefixtures("empty_figures")
def test_both_models_side_by_side(tmp_path):
    arguments = ("--model", "both", *FAST, "--spread", "3", "--details", "--out", tmp_path, "--json", "-")
    result = command("run", BASE, *arguments)
    assert result.returncode == 0, result.stderr
    data = json.loads(result.stdout)
    assert (data["model"], data["chosen"]["asked"]) == ("flexible", "both")
    assert data == json.loads((tmp_path / "result.json").read_text())
    assert data["beside"]["spread"]["runs"] == data["spread"]["runs"] == 3
    for words in (
        "with the shaking varied by 1 %",
        "computed in",
        "Answer. The dam slides",
        "Trust the flexible model",
    ):
        assert words in " ".join(result.stderr.split()), words
    assert f"{data['ratio']['residual_slip_m']:.4g}" in result.stderr
    assert (tmp_path / "crack.png").exists()


def test_both_end_with_3_where_neither_has_a_result():
    weak = ("--set", "crack.friction=0.3", "--model", "both", *FAST, "--json", "-")
    result = command("run", BASE, *weak)
    assert result.returncode == 3
    data = json.loads(result.stdout)
    assert data["beside"]["outcome"] == "unstable"
    assert data["outcome"] == "unstable"
    assert set(data["ratio"].values()) == {None}
    assert "slides under its static loads alone" in result.stderr


def test_a_dam_that_is_lost_is_no_result(tmp_path):
    (tmp_path / "slide.toml").write_text(
        'section = { polygon = [["0 m", "0 m"], ["0.2 m", "0 m"], ["0.2 m", "0.2 m"], ["0 m", "0.2 m"]] }\n'
        'concrete = { modulus = "20 GPa" }\ncrack = { friction = 0.01 }\n'
        'flexible = { elements_across = 1, evidence = "none" }\n'
        'motion = { points = [["0 s", "-3 g"], ["3 s", "-3 g"]] }\n'
    )
    result = command("run", "slide.toml", "--model", "flexible", "--json", "-", "--spread", "2", cwd=tmp_path)
    assert result.returncode == 3, result.stderr
    data = json.loads(result.stdout)
    assert data["outcome"] == "lost"
    assert data["spread"]["failed"] == 2
    assert "No result to trust (lost)" in result.stderr
    assert "the dam has failed" in data["advice"]


@pytest.mark.parametrize(
    ("arguments", "runs"),
    [
        (("--spread", "block.toml"), 11),
        (("block.toml", "--spread"), 11),
        (("--spread", "--pga", "0.3g", "block.toml"), 11),
        (("block.toml", "--spread", "3"), 3),
        (("block.toml", "--spread=4"), 4),
    ],
)
def test_spread_with_and_without_a_number(arguments, runs):
    result = command("run", *arguments, "--details", "--json", "-", cwd=EXAMPLES)
    assert result.returncode == 0, result.stderr
    spread = json.loads(result.stdout)["spread"]
    assert spread["runs"] == len(spread["scales"]) == runs
    assert (spread["scales"][0], spread["scales"][-1]) == (0.99, 1.01)
    assert set(spread["residual_slip_m"]) == {"mean", "std", "min", "max"}
    assert f"Spread over {runs} runs" in " ".join(result.stderr.split())


def test_periods():
    result = command("periods", HEIGHT, *COARSE, "--count", "3", "--details")
    assert result.returncode == 0, result.stderr
    for words in ("intact, dry", "intact, with water", "above the crack", "below the crack", "is fixed at its base"):
        assert words in " ".join(result.stdout.split())
    result = command("periods", HEIGHT, *COARSE, "--count", "3", "--json", "-")
    periods = json.loads(result.stdout)["periods_s"]
    assert {len(values) for values in periods.values()} == {3}
    assert f"{periods['intact'][0]:.4f} s" in result.stderr


@pytest.mark.slow
def test_periods_with_the_response_of_the_crest(tmp_path):
    result = command("periods", HEIGHT, *COARSE, "--response", "--out", tmp_path, "--json", "-")
    assert result.returncode == 0, result.stderr
    assert {"response.csv", "response.png", "response.svg"} < {path.name for path in tmp_path.iterdir()}
    assert len(json.loads(result.stdout)["response"]["curves"]) == 6
    refused = command("periods", HEIGHT, "--out", tmp_path)
    assert refused.returncode == 2
    assert "--response" in refused.stderr


@pytest.mark.usefixtures("no_figures")
def test_vtk_files_go_beside_the_rest(tmp_path):
    arguments = ("--model", "both", *FAST, "--out", tmp_path, "--vtk")
    folder = tmp_path / "vtk"
    folder.mkdir(parents=True)
    (folder / "dam-9999.vtu").write_text("mine")
    result = command("run", BASE, *arguments)
    assert result.returncode == 0, result.stderr
    assert f"wrote {tmp_path}/vtk\n     pvd  crack, dam" in result.stdout
    # Not one line for each of hundreds of frames.
    assert ".vtu" not in result.stdout
    assert len(list(folder.glob("dam-*.vtu"))) > 100
    assert (folder / "dam-9999.vtu").read_text() == "mine"


@pytest.mark.usefixtures("no_figures")
def test_what_an_earlier_run_left_is_removed_and_told_and_nothing_else(tmp_path):
    (tmp_path / "events.csv").write_text("mine")
    unstable = options(["crack.friction=0.01", "crack.inclination=10 deg"])
    assert command("run", BLOCK, "--out", ".", cwd=tmp_path).returncode == 0
    result = command("run", BLOCK, *unstable, "--out", ".", cwd=tmp_path)
    lines = [line.split() for line in result.stdout.splitlines()]
    assert lines[lines.index(["removed", "."]) + 1] == ["parquet", "events,", "histories"]
    refused = command("run", BLOCK, "--csv", "--out", ".", cwd=tmp_path)
    assert refused.returncode == 2
    assert refused.stderr.startswith("heeltoe: --out: events.csv exists and was not written by heeltoe; ")
    assert (tmp_path / "events.csv").read_text() == "mine"


def test_where_json_cannot_go_nothing_runs(tmp_path, monkeypatch):
    monkeypatch.setattr("heeltoe.study.small.analysis.analyse", None)
    for place in (tmp_path, ""):
        refused = command("run", BLOCK, "--json", place)
        assert refused.returncode == 2
        assert "does not name a file; give the path of a file" in refused.stderr


@pytest.mark.slow
def test_a_terminal_sees_what_goes_on_and_a_pipe_does_not():
    command = [sys.executable, "-m", "heeltoe", "run", str(BASE), "--model", "rigid", "--spread", "--json", "-"]
    ours, theirs = pty.openpty()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=theirs)
    os.close(theirs)
    seen = b""
    # The end of a pseudo-terminal is an error on Linux, and no data elsewhere.
    with contextlib.suppress(OSError):
        while part := os.read(ours, 65536):
            seen += part
    assert process.stdout is not None
    json.loads(process.stdout.read())
    process.stdout.close()
    assert process.wait() == 0
    os.close(ours)
    assert b"rigid model" in seen
    assert b"0:00:0" in seen
    piped = subprocess.run(command, capture_output=True, check=True)
    assert b"0:00:0" not in piped.stderr


@pytest.mark.slow
def test_new_writes_a_case_that_runs(tmp_path):
    assert command("new", "mydam", cwd=tmp_path).returncode == 0
    result = command("run", "mydam.toml", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    again = command("new", "mydam", cwd=tmp_path)
    assert again.returncode == 2
    assert "already exists" in again.stderr


def test_version_and_help():
    assert "heeltoe 0.1" in command("--version").stdout
    text = command("run", "--help").stdout
    for option in [
        "--model",
        "--motion",
        "--pga",
        "--set",
        "--spread",
        "--json",
        "--out",
        "--vtk",
        "--report",
    ]:
        assert option in text
    # Fields of the case say the same; who types them still can.
    for option in ("--units", "--duration", "--evidence", "--match", "--target", "--judge", "--vertical"):
        assert f" {option} " not in text
    assert "periods" in command("--help").stdout


def test_motion_echo_and_list():
    listing = command("motion", "--list")
    assert listing.returncode == 0
    assert "elcentro-1940-180-nga" in listing.stdout
    echo = command("motion", "elcentro-1940-180-nga", "--details")
    assert echo.returncode == 0, echo.stderr
    assert "0.2808 g" in echo.stdout
    assert "El Centro Array" in echo.stdout


def test_a_file_that_cannot_be_written_is_not_called_standard_output(monkeypatch):
    def full(path):
        raise OSError(errno.ENOSPC, "No space left on device", "/there/cache")

    # Whoever imports it now keeps what is patched.
    import_module("heeltoe.study.run.run")
    monkeypatch.setattr("heeltoe.study.plan.file.read_study", full)
    screen = command("study", "study.toml")
    assert screen.returncode == 2
    assert screen.stderr.startswith("heeltoe: /there/cache: it cannot be written (No space left on device)")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device here is always full")
def test_a_standard_output_that_is_full_is_called_that():
    with Path("/dev/full").open("w") as full:
        message = subprocess.run(
            [sys.executable, "-m", "heeltoe", "run", str(BLOCK)],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert message.returncode == 2
    assert message.stderr.splitlines()[-1].startswith("heeltoe: standard output: it cannot be written (No space left")


def test_what_the_system_refuses_otherwise_is_no_trouble_of_standard_output(monkeypatch):
    def gone(path):
        raise OSError(errno.ECHILD, "No child processes")

    monkeypatch.setattr("heeltoe.study.plan.file.read_study", gone)
    with pytest.raises(OSError, match="No child processes"):
        command("study", "study.toml")


def test_a_block_loads_no_statistics_no_meshes_no_tables_and_no_figures():
    """What is loaded costs a run of a block more than the run."""
    program = (
        "import sys; from heeltoe.cli.main import main\n"
        f"sys.argv = ['heeltoe', 'run', {str(BLOCK)!r}, '--json', '-']\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "from heeltoe.result.numbers import BondState\n"
        "print([name for name in ('scipy', 'skfem', 'matplotlib', 'pandas', 'pint', 'pyarrow', 'jinja2', "
        "'numpy.polynomial', 'rich._emoji_codes', 'heeltoe.models.flexible', 'heeltoe.study.plan.file', "
        "'heeltoe.views.content.document') if name in sys.modules], '__dataclass_fields__' in vars(BondState), "
        "file=sys.stderr)"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=True)
    assert ended.stderr.splitlines()[-1] == "[] False"


def test_names_of_files_load_no_libraries_of_figures():
    program = (
        "import sys; import heeltoe.views.files.write\n"
        "print([name for name in ('scipy', 'matplotlib', 'pyarrow', 'heeltoe.models.flexible.body') "
        "if name in sys.modules])"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=True)
    assert ended.stdout == "[]\n"


@pytest.mark.parametrize(
    ("words", "opening", "unloaded"),
    [
        (["--version"], "heeltoe ", ("numpy", "pydantic", "rich")),
        (["explain", "crack.friction"], "crack.friction", ("scipy", "matplotlib", "pandas", "pint")),
    ],
)
def test_what_needs_no_numbers_loads_no_libraries_of_numbers(words, opening, unloaded):
    program = (
        "import sys; from heeltoe.cli.main import main\n"
        f"sys.argv = {['heeltoe', *words]!r}\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        f"print([name for name in {unloaded!r} if name in sys.modules], file=sys.stderr)"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=True)
    assert ended.stdout.startswith(opening)
    assert ended.stderr.splitlines()[-1] == "[]"


def test_the_help_cuts_no_sentence():
    screen = command("--help", columns=80)
    assert "..." not in screen.stdout.partition("Commands:")[2]
    assert max(map(len, screen.stdout.splitlines())) <= 80


def test_examples_are_listed_with_a_line_each(tmp_path):
    screen = command("examples", "--list", cwd=tmp_path)
    lines = screen.stdout.splitlines()
    assert lines[::2] == [
        path.relative_to(ROOT / "examples").as_posix() for path in sorted((ROOT / "examples").rglob("*.toml"))
    ]
    assert all(len(line.strip()) > 10 for line in lines[1::2])
    assert not list(tmp_path.iterdir())


def test_a_friction_law_that_is_none_is_refused_with_those_that_are():
    result = command("law", "barton")
    assert result.returncode == 2
    assert result.stderr.startswith("heeltoe: law: barton is not a friction law")
    assert "barton-bandis" in result.stderr
