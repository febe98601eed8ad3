"""`heeltoe export`: files and notes, or one line that says why there are none."""

from __future__ import annotations

import pytest

from shared.command import command, options
from shared.dams import BASE, BLOCK, COARSE, EXAMPLES

FAST = options([*COARSE, "motion.duration=1s"])


@pytest.mark.parametrize(
    ("program", "files"), [("opensees", {"dam.py", "ground.csv"}), ("calculix", {"dam.inp"}), ("gmsh", {"dam.msh"})]
)
def test_export_writes_the_files_of_a_program(program, files, tmp_path):
    (tmp_path / "mine.txt").write_text("stays")
    reply = command("export", BASE, *FAST, "--to", program, "--out", tmp_path)
    assert reply.returncode == 0, reply.stderr
    assert {path.name for path in tmp_path.iterdir() if not path.name.startswith(".")} == files | {"mine.txt"}
    assert "here it stands on a rigid plane" in reply.stdout
    for name in files:
        assert f"wrote {tmp_path / name}" in reply.stdout
    (deck,) = (path for path in tmp_path.glob("dam.*"))
    assert "The case stands on assumed rock of 20 GPa" in deck.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("case", "to", "words"),
    [
        (BASE, "abaqus", "--to:"),
        (BLOCK, "gmsh", "concrete.modulus: is required but missing"),
        (EXAMPLES / "stepped-crack.toml", "gmsh", "crack.kinks: does not belong to an exported crack"),
    ],
)
def test_export_refuses_in_one_line(case, to, words, tmp_path):
    reply = command("export", case, "--to", to, "--out", tmp_path / "new")
    assert reply.returncode == 2
    (line,) = reply.stderr.splitlines()
    assert words in line
    assert not (tmp_path / "new").exists()
