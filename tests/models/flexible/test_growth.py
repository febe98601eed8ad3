"""Growth of a vibration of the sliding dam: against the eigenproblem in all modes, and what a result says of it."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

from heeltoe import GroundMotion, flexible
from heeltoe.models.flexible.body.reduced import build_flexible_dam, damped
from heeltoe.models.flexible.evidence.growth import growth_of
from shared.dams import plane_case

TYPICAL = [(0.0, 0.0), (80.0, 0.0), (8.0, 90.0), (8.0, 100.0), (0.0, 100.0)]


def typical(friction=1.2, across=4, elevation=0.0, damping="relative", ratio=0.05, **options):
    return plane_case(
        {
            "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in TYPICAL]},
            "concrete": {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143, "damping": ratio},
            "crack": {"friction": friction, "elevation": f"{elevation} m"},
            "reservoir": {"depth": "100 m"},
            "uplift": {"pattern": "triangular"},
            "flexible": {"elements_across": across, "damping": damping, "evidence": "none", **options},
        }
    )


def in_all_modes(one, friction, way):
    """The same from all modes of both parts, for faces whose nodes meet."""
    square = np.concatenate([part.omega_squared for part in one.reduced])
    rows = np.hstack([part.dampers for part in one.reduced])
    damping = np.diag(np.concatenate([part.damping_free for part in one.reduced])) + rows.T @ rows
    shapes = np.vstack([sign * part.shapes for part, sign in zip(one.reduced, (1.0, -1.0), strict=False)])
    along, across = np.split(shapes, 2, axis=1)
    free = scipy.linalg.null_space(across.T)
    left = scipy.linalg.null_space((across - way * friction * along).T).T
    mass, drag, spring = left @ free, left @ damping @ free, left @ np.diag(square) @ free
    count = len(mass)
    rates = np.linalg.solve(mass, np.hstack([-spring, -drag]))
    values = np.linalg.eigvals(np.vstack([np.eye(count, 2 * count, count), rates]))
    return values.real[np.abs(values) > 1.0].max()


@pytest.mark.parametrize(("friction", "growth"), [(0.8, 0.10), (1.0, 2.62), (1.2, 4.55)])
def test_of_the_typical_dam_as_an_independent_program_has_it(friction, growth):
    one = build_flexible_dam(typical(friction, 8, damping="deformation"))
    assert growth_of(one, [friction])[0] == pytest.approx(growth, abs=0.01)


@pytest.mark.parametrize("elevation", [0.0, 80.0])
@pytest.mark.parametrize("damping", ["relative", "stiffness"])
def test_few_modes_with_static_shapes_tell_it(elevation, damping):
    one = build_flexible_dam(typical(1.2, 4, elevation, damping))
    expected = max(in_all_modes(one, 1.2, way) for way in (1.0, -1.0))
    assert growth_of(one, [1.2])[0] == pytest.approx(expected, rel=1e-3, abs=1e-3)


def surrounded(friction=1.2, modulus="20 GPa", sound=True, elevation=0.0, **rock):
    case = typical(friction, 4, elevation)
    changes = {"rock": {"modulus": modulus} | rock, "reservoir.compressible": sound}
    return build_flexible_dam(case.with_(changes))


@pytest.mark.slow
def test_rock_and_water_take_a_part_of_it():
    assert growth_of(surrounded(modulus="20000 GPa", sound=False), [1.2])[0] == pytest.approx(
        growth_of(build_flexible_dam(typical(1.2, 4)), [1.2])[0], rel=0.03
    )
    waves = surrounded()
    # Microseconds are no vibration of a dam, in rock without mass either.
    of_massless = growth_of(surrounded(massless=True, damping=0.0, sound=False), [1.2])[0]
    assert 0.0 < growth_of(waves, [1.2])[0] < 0.7 * of_massless < 10.0
    # Nothing is fed where nothing rubs, wherever the crack is.
    assert growth_of(waves, [1e-9])[0] < 0.0
    assert growth_of(surrounded(elevation=20.0), [1e-9])[0] < 0.0


def two_cracks(friction=1.2, upper=1.2, damping=0.05):
    case = typical(friction, 8, ratio=damping)
    data = case.model_dump(mode="json", exclude_unset=True)
    return plane_case(data | {"further_cracks": [{"elevation": "40 m", "friction": upper}]})


def test_a_crack_that_sticks_is_none():
    """A crack more that sticks leaves the growth as it is, but for the mesh."""
    one, two = build_flexible_dam(typical(1.2, 8)), build_flexible_dam(two_cracks())
    assert growth_of(two, [None, 1.2])[0] == pytest.approx(growth_of(one, [1.2])[0], rel=0.03)
    upper = build_flexible_dam(typical(1.2, 8, 40.0))
    # What the base adds is bonded to the rock in one dam, and sticks in the other.
    assert growth_of(two, [1.2, None])[0] == pytest.approx(growth_of(upper, [1.2])[0], rel=0.1, abs=0.2)


def test_cracks_that_slide_together_are_those_of_the_crack_that_slides_alone_above_stiff_slabs():
    """Both ways round of each crack are tried: at least the fastest of the two by themselves, with no friction none."""
    two = build_flexible_dam(two_cracks())
    assert growth_of(two, [1e-9, 1e-9])[0] < 0.0
    assert growth_of(two, [1.2, 1.2])[0] > 0.0


@pytest.mark.slow
def test_several_cracks_say_where_their_slip_depends_on_damping():
    response = flexible(two_cracks(upper=1.4), pushed(0.3, 2.0))
    excited = response.self_excitation
    assert excited["growth_1_s"] * excited["sliding_time_s"] > 1.0
    more = flexible(two_cracks(upper=1.4, damping=0.1), pushed(0.3, 2.0))
    assert excited["twice_damped_slip_m"] == pytest.approx(more.residual_slip_m, rel=1e-6)
    assert any(notice.code == "self-excited" for notice in response.warnings)


def test_more_damping_takes_it_away():
    one = build_flexible_dam(typical())
    growths = [growth_of(damped(one, factor), [1.2])[0] for factor in (0.5, 1.0, 2.0, 8.0)]
    assert growths == sorted(growths, reverse=True)
    assert growths[-1] < 0.0 < growths[1]


def pushed(strength, duration):
    """Ground that flees upstream steadily, so that the dam slides downstream."""
    time = np.array([0.0, duration])
    return GroundMotion.from_points(time, np.full(2, -strength * 9.80665))


def test_a_result_says_where_the_slip_depends_on_damping():
    response = flexible(typical(), pushed(0.3, 2.0))
    self_excitation = response.self_excitation
    assert self_excitation["growth_1_s"] * self_excitation["sliding_time_s"] > 1.0
    assert self_excitation["twice_damped_slip_m"] is not None
    # Dashpots twice as strong are those of twice the ratio.
    more = flexible(typical(ratio=0.1), pushed(0.3, 2.0))
    assert self_excitation["twice_damped_slip_m"] == pytest.approx(more.residual_slip_m, rel=1e-6)
    assert any(notice.code == "self-excited" for notice in response.warnings)


def test_a_result_says_where_it_does_not():
    response = flexible(typical(0.8), pushed(0.15, 1.0))
    assert response.self_excitation["growth_1_s"] < 0.0
    assert response.self_excitation["twice_damped_slip_m"] is None
    assert not any(notice.code == "self-excited" for notice in response.warnings)
    standing = flexible(typical(), pushed(0.01, 0.2))
    assert standing.self_excitation is None
