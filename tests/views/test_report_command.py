"""The command line writes a report, with the spread where it is cheap."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from matplotlib.figure import Figure

from shared.command import command, options
from shared.dams import BASE, BLOCK, FAST
from shared.report_reader import Reader, lookup


def test_the_command_line_writes_a_report(tmp_path):
    result = command("run", BASE, "--model", "rigid", "--duration", "3s", "--report", cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    place = tmp_path / "typical-base-report"
    assert {"report.pdf", "report.html", "result.json"} <= {path.name for path in place.iterdir()}
    assert "typical-base-report" in result.stdout
    reader = Reader((place / "report.html").read_text())
    data = json.loads((place / "result.json").read_text())
    assert reader.numbers["residual_slip_m"][0] == data["residual_slip_m"]
    assert "--model rigid --duration 3s --report" in reader.text


def test_files_of_a_run_load_no_statistics_and_no_studies(tmp_path):
    program = (
        "import sys; from heeltoe.cli.main import main\n"
        f"sys.argv = ['heeltoe', 'run', {str(BLOCK)!r}, '--out', {str(tmp_path)!r}]\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        "print([name for name in ('scipy.stats', 'heeltoe.mechanics.law_fit', 'heeltoe.study.answers.study_results') "
        "if name in sys.modules], file=sys.stderr)"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=True)
    assert (tmp_path / "response.png").stat().st_size > 0
    assert ended.stderr.splitlines()[-1] == "[]"


@pytest.mark.slow
@pytest.mark.parametrize("model", ["rigid", "both"])
def test_each_figure_is_drawn_once_for_files_and_report(model, tmp_path, monkeypatch):
    plain, drawn = Figure.__init__, []

    def counting(self, *arguments, **options):
        drawn.append(self)
        plain(self, *arguments, **options)

    monkeypatch.setattr(Figure, "__init__", counting)
    arguments = ["--model", model, *options([*FAST, "motion.duration=1s"]), "--out", tmp_path, "--report"]
    result = command("run", BASE, *arguments, "--spread", "none")
    assert result.returncode == 0, result.stderr
    files = {path.relative_to(tmp_path) for path in tmp_path.rglob("*.png")}
    # Two stand in the report alone: that of page one, and the motion's history.
    assert len(drawn) == len(files) + 2 > 5
    # The files have headings, which the report has taken off.
    assert all("Typical dam" in path.read_text() for path in tmp_path.rglob("response.svg"))
    assert Reader((tmp_path / "report.html").read_text()).text.count("Figure") > 3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "spreads"),
    [
        (["--report"], {"": True}),
        (["--report", "--spread", "none"], {"": False}),
        (["--report", "--spread", "3"], {"": True}),
        (["--report", "--model", "both"], {"beside": True, "": False}),
        ([], {"": False}),
    ],
)
@pytest.mark.usefixtures("no_figures")
def test_a_report_has_the_spread_where_it_is_cheap(arguments, spreads, tmp_path):
    model = () if "--model" in arguments else ("--model", "rigid")
    result = command("run", BASE, *options(FAST), *model, *arguments, "--out", tmp_path)
    assert result.returncode == 0, result.stderr
    data = json.loads((tmp_path / "result.json").read_text())
    for prefix, there in spreads.items():
        spread = (lookup(data, prefix) if prefix else data).get("spread")
        assert (spread is not None) == there
        assert not there or spread["runs"] == (3 if "3" in arguments else 11)
        if arguments:
            text = " ".join(Reader((tmp_path / "report.html").read_text()).text.split())
            assert ("was not asked" in text) == (not all(spreads.values()))


@pytest.mark.usefixtures("no_figures")
def test_a_dam_that_cannot_stand_has_no_spread(tmp_path):
    result = command("run", BASE, "--set", "crack.friction=0.2", "--report", "--out", tmp_path)
    assert result.returncode == 3
    assert "spread" not in json.loads((tmp_path / "result.json").read_text())
    text = Reader((tmp_path / "report.html").read_text()).text
    assert "without a result" not in text
    assert "was not asked" not in text
