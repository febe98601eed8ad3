"""The examples that come with the package, as `heeltoe examples` writes them."""

import pytest

from heeltoe.case import examples
from shared.command import command
from shared.dams import ALL_EXAMPLES, EXAMPLES, STUDIES


def test_all_cases_and_studies_are_written(tmp_path):
    process = command("examples", cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    assert process.stdout == f"wrote {len(ALL_EXAMPLES) + len(STUDIES)} cases and studies into examples\n"
    for path in (*ALL_EXAMPLES, *STUDIES):
        assert (tmp_path / "examples" / path.relative_to(EXAMPLES)).read_bytes() == path.read_bytes()
    assert command("study", "examples/studies/fragility.toml", "--dry-run", cwd=tmp_path).returncode == 0


def test_nothing_of_the_users_is_touched(tmp_path):
    (tmp_path / "examples").mkdir()
    process = command("examples", cwd=tmp_path)
    assert (process.returncode, process.stderr) == (
        2,
        "heeltoe: examples: already exists; give another name, or remove it first\n",
    )
    assert list((tmp_path / "examples").iterdir()) == []
    assert command("examples", "elsewhere", cwd=tmp_path).returncode == 0


@pytest.mark.parametrize("sources", [True, False])
def test_they_are_those_of_the_sources_or_of_the_package(sources, tmp_path, monkeypatch):
    if sources:
        (tmp_path / "crates").mkdir()
    monkeypatch.setattr(examples, "_SOURCES", tmp_path)
    monkeypatch.setattr(examples, "_PACKAGE", tmp_path / "python" / "heeltoe")
    home = tmp_path if sources else tmp_path / "python" / "heeltoe"
    assert examples.examples_folder() == home / "examples"
