"""The benchmarks renew the section they have measured and leave the others alone."""

import ast
import importlib
import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heeltoe import read_case

FOLDER = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture
def run(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    import run

    yield run
    for path in FOLDER.glob("*.py"):
        sys.modules.pop(path.stem, None)


def test_results_have_a_section_for_every_part(run):
    text = (FOLDER / "results.md").read_text(encoding="utf-8")
    titles = [line.removeprefix("## ") for line in text.splitlines() if line.startswith("## ")]
    # One part needs a build of another version.
    assert titles == [title for part, title in run.PARTS.items() if part != "other_build" or title in titles]


def test_one_section_is_renewed(run):
    text = (FOLDER / "results.md").read_text(encoding="utf-8")
    new = run.renewed(text, "## Flexible dams\n\nnew")
    assert "## Flexible dams\n\nnew\n\n## How cost grows" in new
    before, after = (body[: body.index("## Flexible dams")] for body in (text, new))
    assert before == after
    assert run.renewed("", "## Rigid peers\n\nx") == f"{run.TITLE}\n\n## Rigid peers\n\nx\n"
    with pytest.raises(run.NothingMeasured):
        run.renewed(text, "## Anything else")


def test_every_part_is_there(run):
    assert all((FOLDER / f"{part}.py").is_file() for part in run.PARTS)


def test_what_measures_nothing_fails_and_writes_nothing(tmp_path):
    for name in ("run.py", "measure.py", "history.py"):
        (tmp_path / name).write_text((FOLDER / name).read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "crack_dam.py").write_text(
        "from measure import require\ndef report():\n    require(False, 'no dam')\n", encoding="utf-8"
    )
    process = subprocess.run(
        [sys.executable, "run.py", "crack_dam"], cwd=tmp_path, capture_output=True, text=True, timeout=60
    )
    assert process.returncode == 1
    assert "nothing measured: no dam" in process.stderr
    assert not (tmp_path / "results.md").exists()


def test_what_cannot_be_measured_here_is_said_and_no_failure(tmp_path):
    for name in ("run.py", "measure.py", "history.py"):
        (tmp_path / name).write_text((FOLDER / name).read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "crack_peers.py").write_text("import no_such_peer\n", encoding="utf-8")
    (tmp_path / "study_million.py").write_text(
        "from measure import Skipped\ndef report():\n    raise Skipped('no records')\n", encoding="utf-8"
    )
    process = subprocess.run(
        [sys.executable, "run.py", "crack_peers", "study_million"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert process.returncode == 0, process.stderr
    assert "crack_peers: not measured here, its section stays: No module named 'no_such_peer'" in process.stderr
    assert "study_million: not measured here, its section stays: no records" in process.stderr


def test_figures_are_picked_kept_once_and_shown(run, tmp_path, monkeypatch):
    import history

    monkeypatch.setattr(history, "STORE", tmp_path / "history.csv")
    monkeypatch.setattr(history, "TABLE", tmp_path / "history.md")
    section = (
        "## Flexible dams\n\nMeasured 2026-11-22 on 2 cores; Linux, Python 3.11.7; heeltoe 0.1.0, numpy 2.4.6."
        "\n\n| base crack | 88 | 17 | 200 µs | 76.1 ms (1%) | 206 ms | 200 ms |"
    )
    result = history.picked(section, "abc1234")
    assert [(item.version, item.figure, item.seconds) for item in result] == [("0.1.0", "20 s, base crack", "0.206")]
    history.add(result)
    history.add(result)
    assert history.read() == result
    assert "| 2026-11-22 | 0.1.0 | abc1234 | 206 ms |" in (tmp_path / "history.md").read_text(encoding="utf-8")
    assert history.picked("## Flexible dams\n\nnothing", "abc1234") == []


def test_the_history_is_that_of_its_figures(run):
    import history

    known = history.read()
    assert known
    assert {(item.part, item.figure) for item in known} <= {(part, name) for part, name, _ in history.FIGURES}
    assert {part for part, *_ in history.FIGURES} <= set(run.PARTS.values())
    assert (FOLDER / "history.md").read_text(encoding="utf-8") == history.page(known)


def test_the_page_of_independent_codes_is_made_of_their_declarations(run):
    import peers

    lines = peers.read()
    assert {line["program"] for line in lines} == {peer.name for peer in peers.PEERS}
    assert peers.PAGE.read_text(encoding="utf-8") == peers.page(lines)
    assert all((FOLDER / peer.script).is_file() for peer in peers.PEERS)


def test_a_peer_that_is_not_installed_is_said_and_keeps_its_numbers(run, tmp_path, monkeypatch, capsys):
    import peers

    def absent():
        raise ImportError("No module named 'mujoco'")

    mujoco = replace(peers.PEERS[0], solve={"sliding both ways": absent})
    monkeypatch.setattr(peers, "PEERS", (mujoco, *peers.PEERS[1:]))
    monkeypatch.setattr(peers, "NUMBERS", tmp_path / "peers.csv")
    monkeypatch.setattr(peers, "PAGE", tmp_path / "page.md")
    before = (FOLDER / "peers.csv").read_text(encoding="utf-8")
    peers.NUMBERS.write_text(before, encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["peers.py", "MuJoCo"])
    peers.main()
    assert "MuJoCo: not installed (No module named 'mujoco')" in capsys.readouterr().err
    assert peers.NUMBERS.read_text(encoding="utf-8") == before
    assert "### MuJoCo" in peers.PAGE.read_text(encoding="utf-8")


def test_an_independent_code_that_all_have_is_run_anew(run):
    import peers

    (scipy,) = (peer for peer in peers.PEERS if peer.name == "SciPy")
    loose, strict = peers.run(scipy)
    assert float(loose["error"]) < 1e-5
    assert float(strict["error"]) < 1e-8
    assert float(strict["heeltoe"]) < 1e-11


@pytest.mark.skipif(sys.platform != "linux", reason="the system does not say what one process took")
def test_the_memory_of_a_process_is_its_own(run):
    import processes

    held = b"x" * 100_000_000
    version = processes.Version(Path(sys.executable))
    large, small = (version.run(("-S", "-c", words)) for words in ("x = b'x' * 200_000_000", "print('[1, 2]')"))
    assert 190.0 < large.peak < 260.0
    assert small.peak < 50.0 < len(held) / 2**20
    assert small.answer == [1, 2]
    assert 0.0 < small.processor < 10.0 * small.elapsed
    with pytest.raises(run.NothingMeasured, match=r"ends with 3: gone"):
        version.run(("-S", "-c", "import sys; sys.stderr.write('gone'); sys.exit(3)"))


def test_the_turn_of_least_processor_time_counts(run):
    import processes

    times = iter([2.0, 5.0, 1.5, 6.0, 3.0, 4.0])
    ours, other = ((lambda: processes.Taken(0.0, next(times), 0.0, "")) for _ in range(2))
    (first, second), turns = processes.least([ours, other])
    assert (first.processor, second.processor, turns) == (1.5, 5.0, 2)


def test_a_row_says_whether_what_was_asked_is_met_and_whether_slips_agree(run):
    import other_build
    import processes

    def row(ours: float, slip: float, peak: float = 80.0) -> list[str]:
        taken = [
            processes.Taken(20.0, time, held, json.dumps({"residual_slip_m": at, "evidence": None}))
            for time, at, held in ((ours, slip, peak), (20.0, 0.5, 80.0))
        ]
        works = tuple(lambda each=each: each for each in taken)
        return other_build.Row("work", works, 0.5, other_build.of_run).measured()

    assert row(8.0, 0.51)[4:] == ["0.40", "0.5, met", "80 / 80 MB", "510.0 / 500.0 mm"]
    assert row(12.0, 0.6, 90.0)[4:] == [
        "0.60",
        "0.5, **not met**",
        "90 / 80 MB, **above 1**",
        "600.0 / 500.0 mm, **apart**",
    ]


def test_ours_is_put_on_a_rigid_plane_beside_the_other(run, tmp_path):
    import other_build
    import processes

    here = processes.Version(FOLDER.parent / ".venv" / "bin" / "heeltoe")
    both = other_build.Both(here, here, tmp_path)
    for name in ("typical-base", "typical-height", "koyna-top", "two-cracks"):
        ours, other = (read_case(file) for file in both.plane(name))
        assert ours.foundation is None
        assert not ours.reservoir.compressible
        assert other.foundation is not None
        assert ours.section == other.section


def test_newmarks_block_by_steps_comes_to_the_exact_slip(run):
    import peer_newmark
    from exact import slip_one_way

    found, missing = peer_newmark.programs()
    if not found:
        pytest.skip(" ".join(missing))
    coarse = 3.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 41))
    errors = []
    for step in (0.05, 0.005, 0.0005):
        drive = np.interp(np.arange(0.0, 2.0 + step / 2.0, step), np.arange(41) * 0.05, coarse)
        exact = slip_one_way(drive, step, 1.0)
        slips = [program.one(drive, step, 1.0, np.inf) for program in found]
        errors.append(max(np.abs(slip - exact).max() for slip in slips) / exact[-1])
        many = [program.many(drive, step, np.array([0.0, 1.0]), np.ones(2), np.full(2, np.inf)) for program in found]
        assert all(ends == pytest.approx([0.0, slip[-1]]) for ends, slip in zip(many, slips, strict=True))
    assert errors[0] < 0.1
    assert errors[1] < errors[0] / 10.0
    assert errors[2] < 1e-5


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.py")), ids=lambda path: path.stem)
def test_what_a_benchmark_takes_from_the_package_is_there(path):
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "heeltoe":
            home = importlib.import_module(node.module)
            for name in node.names:
                if not hasattr(home, name.name):
                    importlib.import_module(f"{node.module}.{name.name}")


def test_the_page_of_real_cracks_has_the_costs_that_were_measured(run):
    laws = importlib.import_module("friction_laws")
    text = laws.PAGE.read_text(encoding="utf-8")
    assert laws.page(text, laws.RESULTS.read_text(encoding="utf-8")) == text
    assert text.count("| constant, 0.9 |") == 1
