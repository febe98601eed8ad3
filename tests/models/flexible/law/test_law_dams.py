"""Friction laws in the whole flexible model, from the case to the response, with its own start and damping."""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe import GroundMotion, InputError, flexible, rigid, run
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake
from shared.dams import TYPICAL_SECTION, plane_case, polygon

G = 9.80665
CORNERS = [(0.0, 0.0), (24.0, 0.0), (8.0, 20.0), (6.0, 30.0), (0.0, 30.0)]
WEAKENING = {"name": "slip weakening", "peak_friction": 0.7, "residual_friction": 0.5, "slip": "20 mm"}
SPEED = {"name": "speed weakening", "peak_friction": 0.7, "residual_friction": 0.5, "speed": "0.1 m/s"}
COHESION = {"name": "cohesion", "cohesion": "15 kPa", "residual_friction": 0.4}
BARTON = {"name": "barton-bandis", "jrc": 6, "jcs": "10 MPa", "residual_angle": "20 deg"}
LIFT = {
    "name": "lift joint",
    "surface": "untreated",
    "basic_friction": 0.45,
    "roughness_friction": [["50 kPa", 0.2], ["1 MPa", 0.1]],
}
ALL = [WEAKENING, {**WEAKENING, "form": "exponential"}, SPEED, COHESION, {**COHESION, "slip": "5 mm"}, BARTON, LIFT]
IDS = ["linear", "exponential", "speed", "brittle", "gradual", "barton", "lift"]
# One of each kind, and all of them in the slow part.
FEW = [
    pytest.param(law, marks=() if name in ("linear", "speed", "barton") else pytest.mark.slow, id=name)
    for law, name in zip(ALL, IDS, strict=True)
]
TIME = np.linspace(0.0, 2.0, 401)
SHAKING = sum(np.sin(2.0 * np.pi * TIME / period + k) for k, period in enumerate((0.5, 0.37, 0.21)))
SHAKING *= 0.3 * G * np.sin(np.pi * TIME / 2.0) ** 2


def case(law, corners=CORNERS, modulus=20.0, **blocks):
    blocks = {"reservoir": {"depth": "20 m"}} | blocks
    return plane_case(
        {
            "section": polygon(corners),
            "concrete": {"modulus": f"{modulus} GPa"},
            "crack": {"law": law, **blocks.pop("crack", {})},
            "flexible": {"elements_across": 3, "evidence": "none"} | blocks.pop("flexible", {}),
            **{name: block for name, block in blocks.items() if block is not None},
        }
    )


def motion(factor=1.0, time=TIME):
    return GroundMotion.from_points(np.append(time, 1.5 * time[-1]), np.append(factor * SHAKING, 0.0))


PUSH = GroundMotion.from_points([0.0, 0.05, 0.25, 0.3, 2.0], [0.0, -9.0, -9.0, 0.0, 0.0])


@pytest.mark.parametrize("law", FEW)
def test_a_dam_that_hardly_gives_is_the_rigid_one(law):
    # A low dam, which slides and stands on all of its crack: a stiff crack has linear stresses, the law of the block
    # goes by their mean.
    low = [(0.0, 0.0), (40.0, 0.0), (34.0, 8.0), (0.0, 8.0)]
    options = {"modulus": 2e5, "reservoir": {"depth": "7.5 m"}, "uplift": {"pattern": "triangular"}}
    stiff = case(law, low, **options, flexible={"elements_across": 4, "time_step": "0.05 ms"})
    dam, block = flexible(stiff, PUSH), rigid(stiff, PUSH)
    assert block.residual_slip_m > 0.03
    assert dam.residual_slip_m == pytest.approx(block.residual_slip_m, rel=0.03)
    assert dam.friction_law["slip_path_m"] == pytest.approx(block.friction_law["slip_path_m"], rel=0.03)
    for name in ("apparent_friction_before", "apparent_friction_after"):
        assert dam.friction_law[name] == pytest.approx(block.friction_law[name], rel=0.03)


@pytest.mark.parametrize("law", FEW)
def test_a_mirror_image_moves_the_other_way(law):
    mirrored = [(24.0 - x, z) for x, z in reversed(CORNERS)]
    one = flexible(case(law, flexible={"time_step": "0.2 ms"}), motion())
    water = {"reservoir": None, "tailwater": {"depth": "20 m", "compressible": False}}
    other = flexible(case(law, mirrored, flexible={"time_step": "0.2 ms"}, **water), motion(-1.0))
    assert abs(one.residual_slip_m) > 0.01
    assert other.residual_slip_m == pytest.approx(-one.residual_slip_m, rel=1e-6)
    assert other.friction_law["slip_path_m"] == pytest.approx(one.friction_law["slip_path_m"], rel=1e-6)
    assert other.energy.friction_j == pytest.approx(one.energy.friction_j, rel=1e-6)


@pytest.mark.parametrize("law", [WEAKENING, BARTON, {**COHESION, "slip": "5 mm"}], ids=["linear", "barton", "gradual"])
def test_a_larger_dam_moves_as_much_more(law):
    # Lengths, modulus, strengths and ways of the law times the factor, times and steps times its root.
    factor = 4.0
    larger = [(factor * x, factor * z) for x, z in CORNERS]
    scaled = {**law, **{name: f"{factor * float(law[name].split()[0])} {law[name].split()[1]}" for name in
                        {"slip", "jcs", "cohesion"} & set(law)}}  # fmt: skip
    one = flexible(case(law, flexible={"time_step": "0.2 ms"}), motion())
    options = {"time_step": f"{0.2 * factor**0.5} ms"}
    blocks = {"reservoir": {"depth": f"{20.0 * factor} m"}, "flexible": options}
    other = flexible(case(scaled, larger, 20.0 * factor, **blocks), motion(time=TIME * factor**0.5))
    assert abs(one.residual_slip_m) > 0.01
    assert other.residual_slip_m == pytest.approx(factor * one.residual_slip_m, rel=1e-6)
    for name in ("apparent_friction_before", "apparent_friction_after"):
        assert other.friction_law[name] == pytest.approx(one.friction_law[name], rel=1e-6)


@pytest.mark.parametrize("law", ALL, ids=IDS)
def test_a_dam_with_each_law(law):
    response = flexible(case(law, crack={"elevation": "6 m"}), motion())
    result, histories = response.friction_law, response.histories
    assert response.outcome == "ok"
    assert result["name"] == law["name"]
    assert result["slip_path_range_m"][0] <= result["slip_path_m"] <= result["slip_path_range_m"][1]
    # The nodes are summed up in other orders, which processors round each in its way.
    assert result["slip_path_m"] == pytest.approx(histories["slip_path_m"][-1], rel=1e-14)
    assert result["slip_path_m"] > 0.0
    assert result["apparent_friction_after"] <= result["apparent_friction_before"] * (1.0 + 1e-12)
    for when in ("before", "after"):
        least, most = result[f"apparent_friction_{when}_range"]
        assert least * (1.0 - 1e-9) <= result[f"apparent_friction_{when}"] <= most * (1.0 + 1e-9)
    assert (np.diff(histories["slip_path_m"]) >= 0.0).all()
    borne, force = histories["friction_strength_n"], abs(histories["friction_force_n"])
    assert (force <= borne + 1e-9 * borne.max()).all()
    assert response.energy.residual < 1e-11
    assert (result["cohesion_left_pa"] is None) == (law["name"] != "cohesion")
    assert any(law["name"].split("-")[0].split()[0] in source.lower() or "slip" in source.lower()
               or "coulomb" in source.lower() for source in response.references)  # fmt: skip


def test_without_a_law_there_is_none():
    response = flexible(case(None, crack={"friction": 0.6}), motion())
    assert response.friction_law is None
    assert "slip_path_m" not in response.histories


def test_auto_takes_the_flexible_model_with_a_law():
    response = run(case(WEAKENING), motion=motion())
    assert response.model == "flexible"
    assert response.beside.model == "rigid"
    assert response.friction_law["slip_path_range_m"][1] > response.friction_law["slip_path_range_m"][0]


def test_the_penalty_method_refuses_a_law():
    with pytest.raises(InputError) as refused:
        flexible(case(WEAKENING, flexible={"contact": "idce", "damping": "stiffness"}), motion())
    assert refused.value.code == "unsupported"


def test_a_law_beyond_its_range_is_warned_about():
    def said(law):
        return [notice.name for notice in flexible(case(law), motion()).warnings]

    assert "law-range mean" in said({**BARTON, "jcs": "0.1 MPa"})
    part = said({**BARTON, "jcs": "0.35 MPa"})
    assert "law-range part" in part
    assert "law-range mean" not in part
    assert "law-by-mean" not in part
    assert not {"law-range mean", "law-range part"} & set(said(WEAKENING))


def small_steps(law, mass, weight, length, push, dt):
    """An independent program for a stiff slider: friction is what the law bears at the way and speed of the last small
    step. Of first order."""
    velocity, slip = 0.0, 0.0
    for a in push:
        free = velocity - a * dt
        bound = law(weight / length, slip, abs(velocity)) * length / mass * dt
        after = math.copysign(max(0.0, abs(free) - bound), free)
        slip += 0.5 * dt * (velocity + after)
        velocity = after
    return slip


@pytest.mark.parametrize(
    ("law", "by_hand"),
    [
        (WEAKENING, lambda s, d, v: s * (0.5 + 0.2 * max(0.0, 1.0 - d / 0.02))),
        pytest.param(SPEED, lambda s, d, v: s * (0.5 + 0.2 * math.exp(-v / 0.1)), marks=pytest.mark.slow),
        pytest.param(
            {**COHESION, "slip": "5 mm"},
            lambda s, d, v: 0.4 * s + 15e3 * max(0.0, 1.0 - d / 0.005),
            marks=pytest.mark.slow,
        ),
        pytest.param(
            BARTON,
            lambda s, d, v: s * math.tan(math.radians(20.0 + 6.0 * math.log10(10e6 / s))),
            marks=pytest.mark.slow,
        ),
    ],
    ids=["linear", "speed", "gradual", "barton"],
)
def test_a_program_of_small_steps_agrees(law, by_hand):
    # A dry slab hardly leans on its toe as it slides: every node has the mean stress.
    slab = case(
        law, [(0.0, 0.0), (60.0, 0.0), (60.0, 1.5), (0.0, 1.5)], 2e5, reservoir=None,
        flexible={"elements_across": 20, "time_step": "0.05 ms"}, analysis={"silence": "0 s"},
    )  # fmt: skip
    pulse = GroundMotion.from_points([0.0, 0.01, 0.3, 0.31, 1.5], [0.0, -9.0, -9.0, 0.0, 0.0])
    response = flexible(slab, pulse)
    density = slab.concrete.density
    mass = density * 60.0 * 1.5
    slips = []
    for count in (30_000, 60_000):
        dt = 1.5 / count
        push = np.interp((np.arange(count) + 0.5) * dt, [0.0, 0.01, 0.3, 0.31, 1.5], [0.0, -9.0, -9.0, 0.0, 0.0])
        slips.append(small_steps(by_hand, mass, mass * G, 60.0, push, dt))
    assert slips[1] > 0.03
    assert response.residual_slip_m == pytest.approx(slips[1], rel=0.01, abs=2.0 * abs(slips[1] - slips[0]))


@pytest.mark.slow
def test_slip_weakening_converges_with_the_step_on_a_real_record():
    dam = plane_case(
        {
            "section": TYPICAL_SECTION,
            "concrete": {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143},
            "crack": {"law": {**WEAKENING, "peak_friction": 1.2, "residual_friction": 0.8}},
            "reservoir": {"depth": "100 m"},
            "uplift": {"pattern": "triangular"},
            "motion": {"file": "elcentro-1940-180-nga", "pga": "0.4 g", "duration": "12 s"},
        }
    )
    shaken = ShakenDam(dam, build_flexible_dam(dam), earthquake(dam).shaking)
    slips = [shaken.run(step).summary.slip for step in (4e-4, 2e-4, 1e-4, 5e-5)]
    changes = np.abs(np.diff(slips))
    assert slips[-1] > 1.0
    # Halving the step halves what is left: of first order, a thousandth at the program's own step.
    assert (changes[1:] < 0.7 * changes[:-1]).all()
    assert changes[1] < 2e-3 * slips[-1]
