"""The benchmarks renew the section they have measured and leave the others alone."""

import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture
def run(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    import run

    yield run
    for name in ("run", "measure"):
        sys.modules.pop(name, None)


def test_results_have_a_section_for_every_part(run):
    text = (FOLDER / "results.md").read_text(encoding="utf-8")
    titles = [line.removeprefix("## ") for line in text.splitlines() if line.startswith("## ")]
    assert titles == list(run.PARTS.values())


def test_one_section_is_renewed(run):
    text = (FOLDER / "results.md").read_text(encoding="utf-8")
    new = run.renewed(text, "## Flexible dams\n\nnew")
    assert "## Flexible dams\n\nnew\n\n## Flexible studies" in new
    before, after = (body[: body.index("## Flexible dams")] for body in (text, new))
    assert before == after
    assert run.renewed("", "## Rigid peers\n\nx") == f"{run.TITLE}\n\n## Rigid peers\n\nx\n"
    with pytest.raises(run.NothingMeasured):
        run.renewed(text, "## Anything else")


def test_every_part_is_there(run):
    assert all((FOLDER / f"{part}.py").is_file() for part in run.PARTS)


def test_what_measures_nothing_fails_and_writes_nothing(tmp_path):
    for name in ("run.py", "measure.py"):
        (tmp_path / name).write_text((FOLDER / name).read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "crack_dam.py").write_text(
        "from measure import require\ndef report():\n    require(False, 'no dam')\n", encoding="utf-8"
    )
    found = subprocess.run(
        [sys.executable, "run.py", "crack_dam"], cwd=tmp_path, capture_output=True, text=True, timeout=60
    )
    assert found.returncode == 1
    assert "nothing measured: no dam" in found.stderr
    assert not (tmp_path / "results.md").exists()
