"""Crest of the intact dam between water and rock: an independent program in the frequency domain, and Pine Flat."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe.models.flexible.surroundings.response import (
    IntactDam,
    WaterOfDam,
    base_nodes,
    crest_response,
)
from heeltoe.models.flexible.surroundings.rock import RockMaterial, reduced_rock
from heeltoe.models.flexible.surroundings.water import reduced_water
from shared.elastic import built
from shared.exact_dam import crest_amplification

TYPICAL = [(0.0, 0.0), (80.0, 0.0), (12.0, 90.0), (10.0, 100.0), (0.0, 100.0)]
DEPTH, SPEED, REFLECTION, RATIO = 92.0, 1440.0, 0.8, 0.05
# So little that it does not matter that the closed form has it at all frequencies.
ROCK = RockMaterial(20e9, 0.33, 2650.0, damping=0.003, damping_frequency=2.5)
# Whether the reservoir is full, whether there is rock.
COMBINATIONS = {
    "empty, rigid": (False, False),
    "full, rigid": (True, False),
    "empty, rock": (False, True),
    "full, rock": (True, True),
}
# Section of Pine Flat dam, from the axis upstream, as published by Samii and Lotfi (2007).
PINE_FLAT = [
    (0.0, 0.0), (95.71, 0.0), (24.38, 91.44), (15.64, 106.68), (14.86, 112.41), (14.86, 121.92), (5.11, 121.92),
    (5.11, 102.17),
]  # fmt: skip


@pytest.fixture(scope="module")
def typical():
    _, _, dam = built(TYPICAL)
    return dam, IntactDam.of(dam)


@pytest.fixture(scope="module")
def around(typical):
    _, intact = typical
    water = reduced_water(list(intact.faces), DEPTH, wave_speed=SPEED, reflection=REFLECTION)
    return WaterOfDam.before(intact, water), reduced_rock(intact.base, ROCK)


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name == "full, rock" else pytest.mark.slow) for name in COMBINATIONS],
)
def test_independent_program_in_the_frequency_domain(typical, around, name):
    """Full matrices of the dam, exact channel, rock by its wavenumber integral: within 2 % up to 15 Hz."""
    dam, intact = typical
    full, soft = COMBINATIONS[name]
    frequencies = np.array([0.5, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 9.0, 10.0, 11.0, 12.0, 13.0, 15.0])
    water, rock = around
    ours = intact.crest_motion(frequencies, RATIO, water if full else None, rock if soft else None)
    exact = [
        crest_amplification(
            dam.upper,
            base_nodes(dam.upper),
            frequency,
            RATIO,
            (DEPTH, SPEED, REFLECTION) if full else None,
            (ROCK.shear, ROCK.poisson, ROCK.density, ROCK.damping) if soft else None,
        )
        for frequency in frequencies
    ]
    assert np.abs(ours) == pytest.approx(np.abs(exact), rel=0.02)
    assert np.abs(ours - exact).max() < 0.03 * np.abs(exact).max()


def test_pine_flat_with_its_reservoir():
    """2.53 Hz (Samii and Lotfi 2007), 2.60 Hz (Gorai and Maity 2020), both with a reservoir cut off."""
    _, _, dam = built(PINE_FLAT, concrete={"density": "2480 kg/m^3", "modulus": "22.75 GPa", "poisson": 0.2})
    intact = IntactDam.of(dam)
    water = reduced_water(list(intact.faces), 116.19, wave_speed=1440.0, reflection=0.9)
    frequencies = np.linspace(0.0, 6.0, 61)
    empty = crest_response(intact, frequencies, 0.01, water=None, rock=None)
    full = crest_response(intact, frequencies, 0.01, water=WaterOfDam.before(intact, water), rock=None)
    assert empty.resonance == pytest.approx(3.15, rel=0.02)
    assert empty.damping == pytest.approx(0.01, rel=0.02)
    assert 2.45 < full.resonance < 2.62
    assert 0.01 < full.damping < 0.03


def test_water_and_rock_make_the_dam_slower_and_damp_it(typical, around):
    _, intact = typical
    water, soft = around
    rigid, full, rock, both = responses = [
        crest_response(
            intact, np.linspace(0.0, 8.0, 41), 0.05, water=water if wet else None, rock=soft if loose else None
        )
        for wet, loose in COMBINATIONS.values()
    ]
    assert all(response.amplification[0] == 1.0 for response in responses)
    assert both.resonance < min(full.resonance, rock.resonance) < rigid.resonance
    assert rigid.damping == pytest.approx(0.05, rel=0.05)
    assert rock.damping > 0.08


def test_rigid_rock_is_no_rock(typical):
    """A thousand times as stiff: the resonance within 0.1 %; and what is left falls as the stiffness rises."""
    _, intact = typical
    frequencies = np.linspace(0.5, 6.0, 23)
    rigid = crest_response(intact, frequencies, RATIO, water=None, rock=None)
    off = []
    for factor in (1e3, 1e5):
        rock = reduced_rock(intact.base, RockMaterial(factor * 20e9, 0.33, 2650.0))
        stiff = crest_response(intact, frequencies, RATIO, water=None, rock=rock)
        assert stiff.resonance == pytest.approx(rigid.resonance, rel=1e-3)
        off.append(np.abs(stiff.amplification - rigid.amplification).max())
    assert off[0] < 0.01 * rigid.peak
    # Nearly in proportion: the compliance of a half-plane falls with the logarithm of the frequency, too.
    assert off[1] == pytest.approx(off[0] / 100.0, rel=0.3)


def test_no_peak_no_damping(typical):
    _, intact = typical
    below = crest_response(intact, np.linspace(0.0, 1.0, 5), RATIO, water=None, rock=None)
    assert (below.resonance, below.peak, below.damping) == (None, None, None)
