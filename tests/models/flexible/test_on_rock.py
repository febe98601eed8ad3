"""Dams on elastic rock: what always holds, where energy goes, and what the rock changes."""

from __future__ import annotations

import copy
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from heeltoe import InputError, flexible, read_case, run
from heeltoe.models.flexible.body import rock as rock_module
from heeltoe.models.flexible.body.reduced import _KEPT
from heeltoe.models.flexible.result.history import crack_table
from shared.dams import example

PULSES = [["0 s", "0 g"], ["0.1 s", "0.6 g"], ["0.3 s", "-0.9 g"], ["0.5 s", "0.9 g"], ["0.6 s", "0 g"]]
ROCK: dict[str, Any] = {"modulus": "20 GPa"}
DAM: dict[str, Any] = {
    "section": {"height": "30 m", "crest_width": "5 m", "base_width": "26 m"},
    "concrete": {"modulus": "25 GPa"},
    "crack": {"elevation": "0 m", "friction": 0.8},
    "reservoir": {"depth": "26 m"},
    "rock": ROCK,
    "motion": {"points": PULSES},
    "flexible": {"elements_across": 4, "evidence": "none"},
    "analysis": {"silence": "0 s"},
}
BOND = {"tensile_strength": "3 MPa", "cohesion": "6 MPa", "fracture_energy": "200 N/m", "shear_energy": "1000 N/m"}
WEAKENING = {"name": "slip weakening", "peak_friction": 0.9, "residual_friction": 0.7, "slip": "20 mm"}


def dam(**changes: Any) -> dict[str, Any]:
    return copy.deepcopy(DAM) | changes


CASES = {
    "plain": dam(),
    "sound": dam(reservoir={"depth": "26 m", "compressible": True}),
    "two cracks": dam(further_cracks=[{"elevation": "18 m"}]),
    "bond": dam(crack={"elevation": "0 m", "friction": 0.8, "bond": BOND}, further_cracks=[{"elevation": "18 m"}]),
    "law": dam(crack={"elevation": "0 m", "law": WEAKENING}),
    "vertical": dam(
        motion={"points": PULSES, "vertical": {"points": [["0 s", "0 g"], ["0.2 s", "0.3 g"], ["0.5 s", "0 g"]]}}
    ),
    "uplift": dam(uplift={"pattern": "triangular"}, tailwater={"depth": "6 m"}),
}


@pytest.mark.parametrize("name", CASES)
def test_the_ledger_closes_and_energy_leaves_in_the_rock(name):
    response = run(read_case(CASES[name]), "flexible")
    assert response.ok
    energy = response.energy
    assert energy.residual < 1e-10
    assert energy.rock_j > 0.0
    assert energy.gained_j < 1e-6 * energy.input_j
    assert response.dam.contact_residual < 1e-9


def test_without_an_earthquake_nothing_moves():
    still = {"points": [["0 s", "0 g"], ["1 s", "0 g"]], "allow_zero": True}
    response = run(read_case(dam(motion=still)), "flexible")
    assert response.residual_slip_m == 0.0
    assert response.energy.input_j == 0.0
    assert response.energy.rock_j == 0.0
    assert not np.any(response.histories["slip_m"])


def test_stiff_rock_is_a_rigid_plane():
    rigid = dam()
    del rigid["rock"]
    plane = run(read_case(rigid), "flexible")
    stiff = run(read_case(dam(rock={"modulus": "25 TPa"})), "flexible")
    assert stiff.residual_slip_m == pytest.approx(plane.residual_slip_m, rel=2e-3)
    assert stiff.energy.rock_j < 1e-3 * stiff.energy.input_j
    assert plane.energy.rock_j == 0.0


def test_rock_that_neither_damps_nor_lets_waves_go_takes_nothing_and_is_warned_of():
    held = run(read_case(dam(rock=ROCK | {"radiation": False, "damping": 0.0})), "flexible")
    assert abs(held.energy.rock_j) < 1e-10 * held.energy.input_j
    assert held.energy.residual < 1e-10
    massless = run(read_case(dam(rock=ROCK | {"massless": True})), "flexible")
    for response, field in ((held, "rock.radiation"), (massless, "rock.massless")):
        (notice,) = [notice for notice in response.warnings if notice.code == "rock-keeps-waves"]
        assert field in str(notice)
    assert not any(n.code == "rock-keeps-waves" for n in run(read_case(dam()), "flexible").warnings)


def test_a_larger_box_answers_the_same(monkeypatch):
    usual = run(read_case(dam()), "flexible").residual_slip_m
    monkeypatch.setattr(rock_module, "EXTENT", 1.5 * rock_module.EXTENT)
    _KEPT.clear()
    larger = run(read_case(dam()), "flexible").residual_slip_m
    _KEPT.clear()
    assert larger != usual
    assert larger == pytest.approx(usual, rel=0.02)


def test_a_base_that_is_not_level_and_a_dam_that_is_bonded_to_the_rock_are_refused():
    tilted = dam(
        section={"polygon": [["0 m", "0 m"], ["20 m", "2 m"], ["5 m", "30 m"], ["0 m", "30 m"]]},
        crack={"elevation": "0 m", "inclination": f"{math.degrees(math.atan(0.1))} deg", "friction": 0.8},
    )
    with pytest.raises(InputError) as refused:
        flexible(read_case(tilted))
    assert refused.value.code == "rock-level"
    with pytest.raises(InputError, match="add a crack at the base"):
        flexible(read_case(dam(crack={"elevation": "6 m", "friction": 0.8})))


def test_the_surface_goes_on_beyond_the_toe():
    # Weak friction: the dam slides farther than its last element is long.
    strong = [[time, f"{4.0 * float(value.split()[0])} g"] for time, value in PULSES]
    response = run(read_case(dam(motion={"points": strong}, crack={"elevation": "0 m", "friction": 0.55})), "flexible")
    assert response.ok
    assert response.energy.residual < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize(
    ("record", "friction", "changes", "slip_mm"),
    [
        # An independent program with full matrices, not converged to the last per cent.
        ("elcentro-1940-180-nga", 1.0, {"damping": 0.0}, 716.0),
        ("taft-1952-s69e-caltech", 1.2, {"damping": 0.0}, 280.0),
    ],
)
def test_slips_of_an_independent_program(record, friction, changes, slip_mm, records):
    case = example(
        "typical-base",
        f"crack.friction={friction}",
        f"motion.file={next(records.glob(f'{record}*'))}" if record.startswith("taft") else f"motion.file={record}",
        "motion.sign=recorded",
        "flexible.evidence=none",
    ).with_({"rock": {"modulus": "20 GPa"} | changes})
    assert 1e3 * flexible(case).residual_slip_m == pytest.approx(slip_mm, rel=0.08)


def test_the_example_runs():
    path = Path(__file__).parents[3] / "examples/on-rock.toml"
    case = read_case(path, ["motion.duration=3 s", "flexible.evidence=none", "flexible.elements_across=4"])
    response = flexible(case)
    assert response.ok
    assert response.energy.rock_j > 0.0
    # The surface of the rock is the lower face of the crack, and wider than the base.
    table = crack_table(response.crack).to_pandas()
    lower, upper = (table[table.side == side] for side in ("lower", "upper"))
    assert lower.x_m.min() < upper.x_m.min()
    assert lower.x_m.max() > upper.x_m.max()
