"""Dams before compressible water: what always holds, where energy goes, and what it changes."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest

from heeltoe import run
from heeltoe.mechanics.beam import band_of
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.body.reservoir import water_body
from heeltoe.models.flexible.result.water import face_pressures, total_pressure
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake
from heeltoe.views.figures.all import all_figures
from shared.dams import plane_case

PULSES = [["0 s", "0 g"], ["0.1 s", "0.6 g"], ["0.3 s", "-0.9 g"], ["0.5 s", "0.9 g"], ["0.6 s", "0 g"]]
DAM: dict[str, Any] = {
    "section": {
        "height": "30 m",
        "crest_width": "5 m",
        "upstream": [["0 m", 0.1], ["10 m", 0.0]],
        "downstream": [["0 m", 0.8], ["25 m", 0.0]],
    },
    "concrete": {"modulus": "25 GPa"},
    "crack": {"elevation": "6 m", "friction": 0.8},
    "reservoir": {"depth": "26 m", "compressible": True},
    "motion": {"points": PULSES},
    "flexible": {"elements_across": 6, "evidence": "none"},
    "analysis": {"silence": "0 s"},
}


def dam(**changes: Any) -> dict[str, Any]:
    return copy.deepcopy(DAM) | changes


def water(**changes: Any) -> dict[str, Any]:
    return {"reservoir": DAM["reservoir"] | changes}


CASES = {
    "height": dam(),
    "base": dam(crack={"elevation": "0 m", "friction": 0.8}),
    "two cracks": dam(further_cracks=[{"elevation": "18 m"}]),
    "tailwater": dam(tailwater={"depth": "9 m", "compressible": True, "floor_reflection": 0.6}),
    "water below the crack": dam(crack={"elevation": "18 m", "friction": 0.8}, **water(depth="15 m")),
    "vertical": dam(
        motion={"points": PULSES, "vertical": {"points": [["0 s", "0 g"], ["0.2 s", "0.3 g"], ["0.5 s", "0 g"]]}}
    ),
    "anchored": dam(
        crack={"elevation": "0 m", "friction": 0.8},
        anchors=[{"distance": "5 m", "prestress": "1 MN/m", "axial_stiffness": "50 MN/m/m"}],
    ),
}


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(
            name, marks=pytest.mark.slow if name in ("two cracks", "water below the crack", "anchored") else ()
        )
        for name in CASES
    ],
)
def test_the_ledger_closes_and_energy_leaves_with_the_water(name):
    response = run(plane_case(CASES[name]), "flexible")
    assert response.ok
    energy = response.energy
    assert energy.residual < 1e-10
    assert energy.floor_j > 0.0
    assert energy.far_end_j > 0.0
    assert energy.gained_j < 1e-6 * energy.input_j
    assert response.dam.contact_residual < 1e-9


def test_a_floor_that_throws_everything_back_takes_nothing():
    response = run(plane_case(dam(**water(floor_reflection=1.0))), "flexible")
    assert response.energy.floor_j == 0.0
    assert response.energy.far_end_j > 0.0


def test_without_an_earthquake_nothing_moves():
    still = {"points": [["0 s", "0 g"], ["1 s", "0 g"]], "allow_zero": True}
    response = run(plane_case(dam(motion=still)), "flexible")
    assert response.residual_slip_m == 0.0
    assert response.energy.input_j == 0.0
    assert not np.any(response.histories["slip_m"])


def test_the_same_ground_the_other_way_round_is_another_answer_but_twice_round_the_same():
    one = run(plane_case(dam()), "flexible").residual_slip_m
    other = run(plane_case(dam(motion={"points": PULSES, "sign": "reversed"})), "flexible")
    again = run(plane_case(dam(motion={"points": [[t, f"{-float(a.split()[0])} g"] for t, a in PULSES]})), "flexible")
    assert other.energy.residual < 1e-10
    assert again.residual_slip_m in (pytest.approx(one, rel=1e-9), pytest.approx(other.residual_slip_m, rel=1e-9))


def test_the_rows_of_the_water_push_with_the_pressure_on_the_face():
    # The sum of the forces on the nodes of all parts is that of the pressure over the wet face.
    built = build_flexible_dam(plane_case(CASES["tailwater"]))
    reservoir = water_body(plane_case(CASES["tailwater"]), built.bodies, band_of(plane_case(CASES["tailwater"])))
    assert reservoir is not None
    # As under a ground that goes off slowly.
    rates = reservoir.ground[:, 0] / reservoir.omega_squared
    across = sum(-(rows.T @ rates)[::2].sum() for rows in reservoir.coupling)
    expected = 0.0
    for face, sign in zip(reservoir.faces, (1.0, -1.0), strict=True):
        pressure, z = face.pressure @ rates, face.points[:, 1]
        expected += sign * float(np.trapezoid(pressure, z))
    assert across == pytest.approx(expected, rel=0.05)


def test_stiff_water_is_the_mass_that_does_not_squeeze():
    # At twenty times the speed of sound what is left is the flow that Westergaard's parabola is 7 % above.
    case = {"floor_reflection": 1.0, "wave_speed": "28800 m/s"}
    response = run(plane_case(dam(**water(**case))), "flexible")
    mass = run(plane_case(dam(reservoir={"depth": "26 m"})), "flexible")
    assert response.energy.far_end_j < 1e-3 * response.energy.input_j
    assert response.residual_slip_m == pytest.approx(mass.residual_slip_m, rel=0.1)


@pytest.mark.slow
def test_pressure_on_the_face_of_a_stiff_dam_in_a_slow_motion():
    """8 G / pi^2 rho a h at the foot, G Catalan's constant: what incompressible water has before a vertical wall."""
    slow = [[f"{0.05 * k:.2f} s", f"{0.1 * np.sin(np.pi * k / 40.0) ** 2:.9f} g"] for k in range(41)]
    case = plane_case(
        dam(
            **water(floor_reflection=1.0),
            section={"height": "30 m", "crest_width": "5 m", "base_width": "30 m"},
            concrete={"modulus": "1e6 GPa"},
            crack={"elevation": "0 m", "friction": 5.0},
            motion={"points": slow, "sign": "recorded"},
        )
    )
    response = run(case, "flexible")
    (face,) = response.crack.dam.reservoir.faces
    total = total_pressure(face, response.crack.water)
    assert face.still[0] == pytest.approx(1000.0 * case.gravity * 26.0)
    assert total[0] == pytest.approx(face.still, abs=1.0)
    frame = response.crack.frame_at(1.0)
    # The ground moves downstream, and the face away from the water of the reservoir.
    exact = -8.0 * 0.915966 / np.pi**2 * 1000.0 * 0.1 * case.gravity * 26.0
    assert total[frame, 0] - face.still[0] == pytest.approx(exact, rel=0.015)
    assert response.water_pressure[0].lowest_absolute_pa > 101325.0


def test_extremes_of_the_pressure_are_those_between_frames_too():
    case = plane_case(dam(motion={"points": PULSES, "pga": "3 g", "sign": "recorded"}))
    shaken = ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking)
    step = shaken.first_step()
    # Frames at the moments at which the pressures are looked at, and a few.
    all_of_them, few = (shaken.run(step, spacing) for spacing in (5e-4, 0.01))
    (face,) = shaken.dam.reservoir.faces
    total, coarse = (total_pressure(face, run.water)[:, face.wet] for run in (all_of_them, few))
    (found,) = face_pressures(shaken.dam, few)
    beyond = total - face.still[face.wet]
    assert found.lowest_absolute_pa == pytest.approx(101325.0 + total.min(), rel=1e-9)
    assert found.largest_pa == pytest.approx(beyond.max(), rel=1e-9)
    assert found.lowest_time_s == pytest.approx(all_of_them.frames.time[total.min(axis=1).argmin()])
    assert found.lowest_z_m == face.points[face.wet[total.min(axis=0).argmin()], 1]
    assert total.min() < coarse.min() - 1e3


def test_water_that_tears_off_is_warned_of():
    weak, strong = (
        run(plane_case(dam(motion={"points": PULSES, "pga": peak, "sign": "recorded"})), "flexible")
        for peak in ("0.05 g", "3 g")
    )
    (low,), (high,) = weak.water_pressure, strong.water_pressure
    assert low.side == high.side == "reservoir"
    assert not low.cavitates
    assert low.lowest_absolute_pa > 90e3
    assert high.cavitates
    assert high.lowest_absolute_pa < 0.0
    assert high.largest_pa > low.largest_pa > 0.0
    codes = [[notice.code for notice in response.warnings] for response in (weak, strong)]
    assert "cavitation" not in codes[0]
    assert "cavitation" in codes[1]
    assert "water-pressure" in all_figures(None, strong)
    assert all_figures(None, strong)["water-pressure"].axes
    dry = run(plane_case(dam(reservoir={"depth": "26 m"})), "flexible")
    assert dry.water_pressure is None
    assert "water_pressure" not in dry.to_json()
    assert "water-pressure" not in all_figures(None, dry)
