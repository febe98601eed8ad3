"""A dam so many times as large, with waves in rock and water: lengths go with L, times with its root.

Weight, water and friction go with the length at one gravity and one density; a modulus that goes with the length makes
times go with its root. No program is needed to know the answer. Rock has no damping of its own here, whose frequency is
a constant.
"""

from __future__ import annotations

import copy
import math
from typing import Any

import pytest

from heeltoe import flexible
from heeltoe.mechanics.beam import band_of
from heeltoe.models.flexible.body import reduced
from shared.dams import plane_case

SHAKES = [0.0, 0.6, -0.9, 0.8, -1.0, 0.9, -0.4, 0.0]
MOMENTS = [0.0, 0.02, 0.05, 0.08, 0.11, 0.14, 0.16, 0.18]


def similar(length: float, **changes: Any) -> dict[str, Any]:
    """A dam of 10 m and its surroundings, so many times as large."""
    slow = math.sqrt(length)
    modulus = f"{20.0 * length} GPa"
    return {
        "section": {
            "height": f"{10.0 * length} m",
            "crest_width": f"{0.8 * length} m",
            "base_width": f"{8.0 * length} m",
        },
        "concrete": {"density": "2400 kg/m^3", "modulus": modulus, "damping": 0.05},
        "crack": {"elevation": "0 m", "friction": 0.8},
        "reservoir": {
            "depth": f"{9.0 * length} m",
            "compressible": True,
            "wave_speed": f"{1440.0 * slow} m/s",
            "floor_reflection": 0.8,
        },
        "rock": {"modulus": modulus, "damping": 0.0, "massless": False},
        "uplift": {"pattern": "triangular"},
        "motion": {"points": [[f"{t * slow} s", f"{a} g"] for t, a in zip(MOMENTS, SHAKES, strict=True)]},
        "flexible": {"elements_across": 4, "evidence": "none"},
        "analysis": {"silence": f"{0.1 * slow} s"},
    } | copy.deepcopy(changes)


@pytest.mark.parametrize(
    "surroundings", [*(pytest.param(name, marks=pytest.mark.slow) for name in ("rock and sound", "rock")), "sound"]
)
def test_the_slip_of_a_similar_dam_is_so_many_times_as_far(surroundings):
    small, large = (plane_case(_without(similar(length), surroundings)) for length in (1.0, 16.0))
    one, other = flexible(small, output_step=0.001), flexible(large, output_step=0.004)
    assert one.residual_slip_m > 1e-3
    assert other.residual_slip_m == pytest.approx(16.0 * one.residual_slip_m, rel=1e-3)
    assert other.peak_slip_downstream_m == pytest.approx(16.0 * one.peak_slip_downstream_m, rel=1e-3)
    assert other.opening_upstream_m == pytest.approx(16.0 * one.opening_upstream_m, rel=1e-3)


def _without(fields: dict[str, Any], surroundings: str) -> dict[str, Any]:
    if surroundings == "rock":
        fields["reservoir"] = {"depth": fields["reservoir"]["depth"]}
    if surroundings == "sound":
        fields.pop("rock")
    return fields


def test_the_band_goes_with_the_dam():
    """That of a beam goes with the root of the modulus over the length."""
    bands = [band_of(plane_case(similar(length))) for length in (1.0, 4.0, 16.0)]
    assert bands[1:] == pytest.approx([bands[0] / 2.0, bands[0] / 4.0], rel=1e-9)
    # A dam of 10 m swings some ten times as fast as one of 100 m of the same concrete.
    tall = plane_case(similar(10.0, concrete={"density": "2400 kg/m^3", "modulus": "20 GPa"}))
    assert bands[0] == pytest.approx(10.0 * band_of(tall), rel=1e-9)
    assert 10.0 < band_of(tall) < 30.0


@pytest.mark.slow
def test_the_rock_and_water_of_the_evidence_answer_half_as_much_again_of_the_band(monkeypatch):
    asked = []
    water_body = reduced.water_body

    def noted(case, bodies, highest, **options):
        asked.append(highest)
        return water_body(case, bodies, highest, **options)

    monkeypatch.setattr(reduced, "water_body", noted)
    case = plane_case(similar(1.0, crack={"elevation": "0 m", "friction": 0.81}))
    for larger in (1.0, 1.5):
        reduced.build_flexible_dam(case, larger)
    assert asked == pytest.approx([band_of(case), 1.5 * band_of(case)])
