"""Files for other programs: read back they are the deck, and the programs agree with it where they are installed."""

from __future__ import annotations

import ast
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec

import meshio
import numpy as np
import pytest

from heeltoe import InputError, read_case
from heeltoe.models.flexible.deck import build_deck
from heeltoe.models.run import earthquake
from heeltoe.views.files.programs.write import PROGRAMS, files_for, write_program
from shared.dams import BASE, COARSE, HEIGHT

CCX = shutil.which("ccx")
DAMS = {"base": BASE, "height": HEIGHT}


@pytest.fixture(scope="module", params=DAMS)
def deck(request):
    case = read_case(DAMS[request.param], [*COARSE, "motion.duration=0.02 s"])
    return build_deck(case, earthquake(case))


def run(*command, cwd):
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, timeout=500, check=False)
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return done.stdout


def test_gmsh_has_the_sets_and_the_loads(deck, tmp_path):
    (path,) = write_program(deck, "gmsh", tmp_path)
    mesh = meshio.read(path, "gmsh")
    count = len(mesh.points)
    assert mesh.points[:, :2] == pytest.approx(deck.nodes[:count])
    assert mesh.point_data["mass"][:, :2] == pytest.approx(deck.masses[:count])
    for name, load in deck.loads.items():
        assert mesh.point_data[name][:, :2] == pytest.approx(load[:count])
    for part in deck.parts:
        (elements,) = (
            block.data[own] for block, own in zip(mesh.cells, mesh.cell_sets[part.name], strict=True) if own.size
        )
        assert np.array_equal(elements, part.elements)
    faces = {name for name in mesh.field_data if name.startswith("crack_1")}
    grounded = len(deck.parts) == 1
    assert faces == ({"crack_1_upper"} if grounded else {"crack_1_upper", "crack_1_lower"})
    assert ("base" in mesh.field_data) != grounded


def test_calculix_has_pairs_of_sides_and_the_static_loads(deck, tmp_path):
    (path,) = write_program(deck, "calculix", tmp_path)
    text = path.read_text(encoding="utf-8")
    static = text.split("*STATIC")[1].split("*NODE FILE")[0].split("*CLOAD")[1]
    sums = np.zeros(2)
    for line in static.split("\n")[1:-1]:
        _, axis, force = line.split(",")
        sums[int(axis) - 1] += float(force)
    assert sums == pytest.approx(deck.resultant, rel=1e-10)
    (crack,) = deck.cracks
    edges = (len(crack.upper) - 1) // 2
    for face in ("upper", "lower"):
        sides = text.split(f"NAME=crack_1_{face}, TYPE=ELEMENT\n")[1].split("*")[0]
        assert len(re.findall(r"^\d+, S[1-4]$", sides, re.MULTILINE)) == edges
    assert text.count("*ELEMENT, TYPE=MASS") == np.count_nonzero(deck.water_masses)


@pytest.mark.slow
@pytest.mark.skipif(CCX is None, reason="CalculiX is not installed (apt-get install calculix-ccx)")
def test_calculix_holds_the_dam_and_shakes_it(deck, tmp_path):
    write_program(deck, "calculix", tmp_path)
    run(CCX, "dam", cwd=tmp_path)
    rows = re.findall(r"total force.*time +(\S+)\n\n +(\S+) +(\S+)", (tmp_path / "dam.dat").read_text())
    rest = next((float(x), float(y)) for time, x, y in rows if float(time) == 1.0)
    # The file prints seven digits; forces in contact are as good as its iterations.
    on_held = sum(load[deck.held].sum(axis=0) for load in deck.loads.values())
    assert rest == pytest.approx(tuple(on_held - deck.resultant), rel=2e-6)
    assert float(rows[-1][0]) == pytest.approx(1.0 + deck.motion.end)


@pytest.mark.skipif(find_spec("openseespy") is None, reason="OpenSeesPy is not installed (pip install openseespy)")
def test_opensees_has_the_same_periods_and_reactions(deck, tmp_path):
    write_program(deck, "opensees", tmp_path)
    printed = run(sys.executable, "dam.py", cwd=tmp_path)
    periods, reactions = ([float(word) for word in line.split(":")[1].split()] for line in printed.splitlines()[:2])
    assert periods == pytest.approx(deck.periods, rel=5e-6)
    # Its forces are in balance to a part of 1e-6.
    assert reactions == pytest.approx([-force for force in deck.resultant], rel=1e-6)
    assert re.search(r"slip of crack_1 \[m\]: \S+ at 0.02 s", printed)
    head, *rows = (tmp_path / "slip.csv").read_text().splitlines()
    assert head == "time_s,slip_crack_1_m"
    assert len(rows) == 2


def test_a_program_for_opensees_is_python_whatever_the_title(tmp_path):
    case = read_case(BASE, [*COARSE, {"title": 'Dam """ of \\ quotes'}])
    (path,) = write_program(build_deck(case, None), "opensees", tmp_path)
    tree = ast.parse(path.read_text(encoding="utf-8"))
    assert "Dam ''' of / quotes" in (ast.get_docstring(tree) or "")


def test_vertical_motion_goes_along(tmp_path):
    points = {"points": [["0 s", "0 g"], ["0.1 s", "0.1 g"], ["0.2 s", "0 g"]]}
    case = read_case(BASE, [*COARSE, {"motion": {**points, "vertical": points}}])
    deck = build_deck(case, earthquake(case))
    (_, motion) = sorted(write_program(deck, "opensees", tmp_path))
    assert motion.read_text().startswith("time_s,downstream_m_s2,upward_m_s2\n")
    (path,) = write_program(deck, "calculix", tmp_path)
    assert "*AMPLITUDE, NAME=upward" in path.read_text()


def test_other_programs_are_refused():
    assert PROGRAMS == ("opensees", "calculix", "gmsh")
    with pytest.raises(InputError, match='--to: "abaqus" is not a choice'):
        files_for("abaqus")
