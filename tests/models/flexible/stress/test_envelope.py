"""The envelope of the stresses: closed forms, all moments one by one, similarity, mirror image."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import GroundMotion, flexible
from heeltoe.models.flexible.body.elastic import dofs, principal
from heeltoe.models.flexible.body.modes import reduce
from heeltoe.models.flexible.body.stress_places import bounded, stress_places
from heeltoe.models.flexible.result.envelope import largest_tension
from shared.dams import TRIANGLE, TYPICAL, plane_case, polygon
from shared.elastic import built, parts

G = 9.80665
CORNERS = [(0.0, 0.0), (24.0, 0.0), (8.0, 20.0), (6.0, 30.0), (0.0, 30.0)]
TIME = np.linspace(0.0, 2.0, 401)
SHAKING = 0.6 * G * np.sin(np.pi * TIME / 2.0) ** 2 * np.sin(2.0 * np.pi * TIME / 0.37)


def shaken(corners=CORNERS, factor=1.0, motion=1.0, elevation=12.0, output_step=None, **blocks):
    """Return a run of a dam, its lengths and its modulus times a factor, its times times the root of it."""
    elastic = {"elements_across": 3, "evidence": "none", "time_step": f"{0.2 * factor**0.5} ms"}
    case = plane_case(
        {
            "section": polygon([(factor * x, factor * z) for x, z in corners]),
            "concrete": {"modulus": f"{20.0 * factor} GPa", **blocks.pop("concrete", {})},
            "crack": {"friction": 0.8, "elevation": f"{factor * elevation} m"},
            "flexible": elastic | blocks.pop("flexible", {}),
            **({"reservoir": {"depth": f"{25.0 * factor} m"}} | blocks),
        }
    )
    return flexible(case, GroundMotion.from_points(TIME * factor**0.5, motion * SHAKING), output_step=output_step)


def largest(response):
    return [(item.tension[item.bounded].max(), item.compression[item.bounded].min()) for item in response.envelope]


# Closed forms


@pytest.mark.parametrize(("elevation", "corners"), [(0.0, TRIANGLE), (60.0, TYPICAL)])
def test_a_field_of_constant_strain_has_the_same_stress_everywhere(elevation, corners):
    # The patch test, through all modes of the body.
    _, _, one = built(corners, elevation)
    for body in parts(one)[: 1 if elevation else None]:
        modes = reduce(body)
        places = stress_places(body, modes)
        x, z = body.mesh.nodes.T
        field = np.column_stack([1e-3 * x + 2e-3 * z, -0.5e-3 * x + 3e-3 * z]).reshape(-1)
        product = np.einsum("pmc,m->pc", places.rows, modes.shapes.T @ (body.mass @ field))
        stress = np.array([1.0, 0.2, 0.0]) * 1e-3 + np.array([0.2, 1.0, 0.0]) * 3e-3 + [0.0, 0.0, 0.4 * 1.5e-3]
        assert product == pytest.approx(np.broadcast_to(20e9 / (1 - 0.2**2) * stress, product.shape), rel=1e-6)


@pytest.mark.parametrize("across", [2, 4])
def test_a_cantilever_has_the_bending_stress_of_a_beam(across):
    # 4 m wide, held at its base, pushed at the crack 40 m up by 1 MN: sigma = M c / I.
    slender = [(0.0, 0.0), (4.0, 0.0), (4.0, 48.0), (0.0, 48.0)]
    case = plane_case(
        {
            "section": polygon(slender),
            "concrete": {"modulus": "20 GPa", "poisson": 0.0},
            "crack": {"friction": 1.0, "elevation": "40 m"},
            "flexible": {"elements_across": across, "modes": 10},
        }
    )
    from heeltoe.models.flexible.body.bonded import bonded_dam

    dam = bonded_dam(case)
    body, modes, places = dam.bodies[1], dam.modes[1], dam.stress_places[1]
    crack = body.mesh.crack
    push = np.zeros(body.mesh.nodes.size)
    push[dofs(crack)[::2]] = 1e6 / crack.size
    product = np.einsum("pmc,m->pc", places.rows, modes.shapes.T @ push / modes.omega_squared)
    x, z = body.mesh.nodes[places.nodes].T
    for face, sign in ((0.0, 1.0), (4.0, -1.0)):
        beam = np.isclose(x, face) & (z > 8.0) & (z < 32.0)
        assert beam.sum() >= 3
        assert product[beam, 1] == pytest.approx(sign * 1e6 * (40.0 - z[beam]) * 2.0 / (4.0**3 / 12.0), rel=2e-3)


# The run

PENALTIES = {"contact": "idce", "damping": "stiffness"}


@pytest.mark.parametrize(
    ("elevation", "options"),
    [
        (12.0, {}),
        *(
            pytest.param(elevation, options, marks=pytest.mark.slow)
            for elevation, options in ((0.0, {}), (0.0, PENALTIES), (12.0, PENALTIES))
        ),
    ],
)
def test_it_is_the_largest_of_all_moments(elevation, options):
    response = shaken(elevation=elevation, output_step=2e-3, flexible=options, analysis={"silence": "0 s"})
    history = response.crack
    assert history.time[1] == pytest.approx(2e-3)
    assert len(response.envelope) == (2 if elevation else 1)
    for part, result in enumerate(response.envelope):
        moments = np.stack([history.stresses(frame)[part] for frame in range(len(history.time))], axis=2)
        major, minor, angle = principal(moments[result.nodes])
        assert result.tension == pytest.approx(major.max(axis=1), abs=1e-3)
        assert result.compression == pytest.approx(minor.min(axis=1), abs=1e-3)
        at, index = major.argmax(axis=1), np.arange(len(major))
        assert result.tension_time == pytest.approx(history.time[at])
        assert result.compression_time == pytest.approx(history.time[minor.argmin(axis=1)])
        turn = result.direction - angle[index, at]
        assert np.cos(2.0 * turn) == pytest.approx(1.0, abs=1e-6)
        assert result.before == pytest.approx(major[:, 0], abs=1e-3)


def test_the_spacing_of_the_histories_plays_no_part():
    one, other = shaken(), shaken(output_step=0.05)
    assert largest(one) == largest(other)


def test_a_larger_dam_has_as_much_more_stress():
    # Looked at as often, counted in steps.
    one, other = shaken(output_step=1e-3), shaken(factor=4.0, output_step=2e-3)
    for (tension, compression), result in zip(largest(one), largest(other), strict=True):
        assert result == pytest.approx((4.0 * tension, 4.0 * compression), rel=1e-6)
    assert other.tension["time_s"] == pytest.approx(2.0 * one.tension["time_s"])
    assert other.tension["x_m"] == pytest.approx(4.0 * one.tension["x_m"])


def test_a_mirror_image_has_the_same_stress_on_the_other_side():
    mirrored = [(24.0 - x, z) for x, z in reversed(CORNERS)]
    one = shaken(elevation=0.0)
    other = shaken(mirrored, motion=-1.0, elevation=0.0, reservoir={"depth": "0 m"}, tailwater={"depth": "25 m"})
    assert largest(other)[0] == pytest.approx(largest(one)[0], rel=1e-6)
    assert other.tension["x_m"] == pytest.approx(24.0 - one.tension["x_m"])
    assert other.tension["z_m"] == pytest.approx(one.tension["z_m"])
    assert np.cos(2.0 * (other.tension["direction_rad"] + one.tension["direction_rad"])) == pytest.approx(1.0, abs=1e-6)


def test_without_an_earthquake_it_is_the_static_state():
    response = shaken(motion=1e-9)
    for item in response.envelope:
        assert item.tension == pytest.approx(item.before, abs=50.0)


# Where it has no bound


def test_what_has_no_bound_is_left_out():
    _, _, one = built(TYPICAL, 60.0)
    upper, lower = parts(one)
    # 32 m wide at the crack, 80 m at the base, 8 m at the neck 30 m above the crack.
    points = np.array([[16.0, 63.9], [16.0, 64.1], [8.9, 90.0], [9.1, 90.0], [0.0, 90.0]])
    assert bounded(upper.mesh, points).tolist() == [False, True, False, True, True]
    points = np.array([[16.0, 56.1], [16.0, 55.9], [0.0, 9.9], [0.0, 10.1], [80.0, 0.0], [40.0, 0.0]])
    assert bounded(lower.mesh, points).tolist() == [False, True, False, True, False, True]


def test_the_largest_tension_is_one_with_a_bound():
    response = shaken()
    result = largest_tension(response.envelope)
    assert result.stress == max(tension for tension, _ in largest(response))
    assert response.tension["stress_pa"] == result.stress
    # Along the crack single nodes are pulled harder.
    assert max(item.tension.max() for item in response.envelope) > result.stress
