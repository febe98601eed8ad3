"""The bond of the joint below a rigid block: it holds while static equilibrium lets it, and breaks at once."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest

from heeltoe import InputError, build_block, read_case, run
from heeltoe.models.statics.after import ligament_of
from heeltoe.result.verdict import verdict

BOND = {
    "tensile_strength": "0.5 MPa",
    "cohesion": "0.8 MPa",
    "fracture_energy": "100 N/m",
    "shear_energy": "1000 N/m",
}
DAM: dict[str, Any] = {
    "section": {"height": "30 m", "crest_width": "5 m", "base_width": "24 m"},
    "concrete": {"modulus": "25 GPa"},
    "crack": {"elevation": "6 m", "friction": 1.0, "bond": BOND},
    "reservoir": {"depth": "26 m"},
    "motion": {"points": [["0 s", "0 g"], ["1 s", "1 g"], ["1.2 s", "0 g"]], "sign": "recorded"},
}


def dam(**changes: Any) -> dict[str, Any]:
    fields = copy.deepcopy(DAM)
    for name, value in changes.items():
        block, _, field = name.partition("__")
        fields[block][field] = value
    return fields


def without_bond(fields: dict[str, Any]) -> dict[str, Any]:
    plain = copy.deepcopy(fields)
    del plain["crack"]["bond"]
    return plain


@pytest.mark.parametrize(("model", "inclination"), [("rigid", "0 deg"), ("rigid", "4 deg"), ("decoupled", "0 deg")])
def test_a_block_that_is_bonded_bears_what_one_at_rest_bears(model, inclination):
    weak = [["0 s", "0 g"], ["0.4 s", "0.05 g"], ["0.8 s", "-0.05 g"], ["1 s", "0 g"]]
    upward = {"points": [["0 s", "0 g"], ["0.5 s", "0.04 g"], ["1 s", "0 g"]]}
    fields = dam(motion__points=weak, motion__vertical=upward, crack__inclination=inclination)
    fields["decoupled"] = {"rotation": True, "vertical": True}
    bonded, plain = (run(read_case(case), model) for case in (fields, without_bond(fields)))
    assert set(plain.mode) == set(bonded.mode) == {"rest"}
    for name, values in plain.histories.items():
        # A motion that jumps where it ends has two values there.
        assert bonded.histories[name][:-1] == pytest.approx(values[:-1], rel=1e-9, abs=1e-3), name


def test_a_bond_breaks_when_the_stress_of_a_beam_reaches_the_strength():
    """The ground accelerates downstream by 1 g a second: the block is left behind, and its toe pulled."""
    response = run(read_case(DAM), "rigid")
    block = build_block(read_case(DAM))
    width, offset = block.width, block.heel_distance - 0.5 * block.width

    def tension_at_toe(acceleration: float) -> float:
        along = block.static.horizontal - block.mass_horizontal * acceleration
        across = block.static.vertical
        moment = block.static_moment + offset * across - block.height * along
        return across / width + 6.0 * moment / width**2

    at_rest, at_one_g = tension_at_toe(0.0), tension_at_toe(9.80665)
    expected = (0.5e6 - at_rest) / (at_one_g - at_rest)
    assert response.bond.breaks_s == pytest.approx(expected, rel=1e-9)
    assert 0.0 < expected < 1.0
    assert response.bond.breaks_by == "tension at the toe"
    assert response.bond.tensile_strength_used == pytest.approx(1.0)
    assert response.bond.shear_strength_used < 1.0
    assert "breaks at" in verdict(response)
    assert ligament_of(response) is None
    moved = response.histories["time_s"][np.abs(response.histories["slip_m"]) > 0.0]
    assert moved.min() > expected


@pytest.mark.parametrize("model", ["rigid", "decoupled"])
def test_a_bond_that_holds_keeps_the_block_at_rest(model):
    fields = dam(crack__bond=BOND | {"tensile_strength": "5 MPa", "cohesion": "8 MPa"})
    fields["limits"] = {"cracked_length": "1 m"}
    response = run(read_case(fields), model)
    assert response.bond.breaks_s is None
    assert 0.0 < response.bond.tensile_strength_used < 1.0
    assert set(response.mode) == {"rest"}
    assert response.peak_slip_downstream_m == response.peak_slip_upstream_m == 0.0
    assert "the block does not move" in verdict(response)
    (check,) = response.limits
    assert (check.value, check.met) == (0.0, True)
    assert ligament_of(response) == (0.0, response.crack_width_m)
    assert any(notice.code == "bond-of-block" for notice in response.warnings)


def test_a_bond_that_breaks_in_the_first_moment_is_the_cracked_block():
    """Shear of a joint that is hardly bonded: the block slides as one that was cracked before."""
    feeble = {"tensile_strength": "1 Pa", "cohesion": "1 Pa", "fracture_energy": "1 N/m", "shear_energy": "1 N/m"}
    fields = dam(crack__bond=feeble, motion__points=[["0 s", "0 g"], ["0.01 s", "0.8 g"], ["0.6 s", "0 g"]])
    bonded, plain = (run(read_case(case), "rigid") for case in (fields, without_bond(fields)))
    assert bonded.bond.breaks_s < 0.02
    assert bonded.residual_slip_m == pytest.approx(plain.residual_slip_m, rel=0.02)


def test_what_a_bond_holds_alone_needs_it():
    """Friction does not hold this block, its bond does; where the static strength is less, the joint has failed."""
    fields = dam(crack__friction=0.2, motion__points=[["0 s", "0 g"], ["0.5 s", "0.02 g"], ["1 s", "0 g"]])
    held = run(read_case(fields), "rigid")
    assert held.outcome == "ok"
    assert held.bond.breaks_s is None
    assert run(read_case(without_bond(fields)), "rigid").outcome == "unstable"
    fields["crack"]["bond"] = BOND | {"tensile_strength": "0.01 MPa", "cohesion": "0.02 MPa", "dynamic_factor": 3.0}
    assert run(read_case(fields), "rigid").outcome == "unstable"


def test_without_a_modulus_a_bonded_dam_is_a_block():
    fields = dam()
    fields["concrete"] = {"density": "2400 kg/m^3"}
    response = run(read_case(fields))
    assert response.model == "rigid"
    assert response.to_json()["bond"]["breaks_by"] == "tension at the toe"


def test_two_blocks_refuse_a_bond():
    fields = dam()
    fields["further_cracks"] = [{"elevation": "15 m"}]
    with pytest.raises(InputError, match="bonded joint") as wrong:
        run(read_case(fields), "rigid")
    assert wrong.value.code == "unsupported"
