"""Amplification of the crest of the dam of a case, with and without what surrounds it: rigid and elastic rock, an empty
reservoir, water as a mass and water with sound. The picture that engineers know from EAGD-84 (Fenves and Chopra 1984).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.case.dam import Rock
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.elastic import dam
from heeltoe.models.flexible.body.modes import intact_periods
from heeltoe.models.flexible.body.reservoir import water_body
from heeltoe.models.flexible.body.rock import rock_material
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.models.flexible.surroundings.response import CrestResponse, IntactDam, WaterOfDam, crest_response
from heeltoe.models.flexible.surroundings.rock import ReducedRock, reduced_rock
from heeltoe.units.sentences import written

# Frequencies from zero to so many times the first one of the dry dam on a rigid base.
_FARTHEST, _COUNT = 4.0, 201


@dataclass(frozen=True, eq=False)
class CrestCurve:
    """The response of the crest with one kind of rock and water.

    Attributes
    ----------
    rock
        ``"rigid"`` or ``"elastic"``.
    water
        ``"empty"``, ``"incompressible"`` (a mass that moves with the face) or ``"compressible"``.
    response
        How the crest answers.
    """

    rock: str
    water: str
    response: CrestResponse


@dataclass(frozen=True, eq=False)
class Amplification:
    """How the crest of an intact dam amplifies the horizontal motion of the ground, by frequency.

    Attributes
    ----------
    frequencies
        (k,) rising from 0 [Hz].
    damping_ratio
        Of the concrete, the same at all frequencies.
    curves
        For each rock and water.
    assumptions
        Sentences with placeholders of :func:`heeltoe.units.sentences.written`, and their values: what the case does not
        say of rock and water.
    """

    frequencies: Floats
    damping_ratio: float
    curves: tuple[CrestCurve, ...]
    assumptions: tuple[tuple[str, dict[str, float]], ...]

    def sentences(self, units: str = "si") -> list[str]:
        """Return what is assumed, in units ``"si"`` or ``"us"``."""
        return [written(text, units, **values) for text, values in self.assumptions]

    def to_table(self) -> pa.Table:
        """Return the amplification by frequency, a column to each rock and water."""
        sizes = {
            f"amplification_{curve.rock}_{curve.water}": np.abs(curve.response.amplification) for curve in self.curves
        }
        return pa.table({"frequency_hz": self.frequencies, **sizes})

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers, strings and lists."""
        return {
            "frequency_hz": self.frequencies.tolist(),
            "curves": [
                {
                    "rock": curve.rock,
                    "water": curve.water,
                    "resonance_hz": curve.response.resonance,
                    "peak": curve.response.peak,
                    "damping_ratio": curve.response.damping,
                    "amplification": np.abs(curve.response.amplification).tolist(),
                }
                for curve in self.curves
            ],
            "assumptions": self.sentences(),
        }


@one_blas_thread()
def crest_amplification(case: Case) -> Amplification:
    """Return how the crest of a dam answers on rigid and on elastic rock, with its reservoir empty, its water a mass,
    and its water with sound.

    Rock that the case does not have is of the modulus of the concrete, else with the defaults of its fields; so is
    sound in water that the case takes as a mass. Water of the tailwater stays as the case has it.

    Parameters
    ----------
    case
        A dam with a modulus; it needs no earthquake.

    Raises
    ------
    InputError
        Where the modulus or the mesh cannot be used.
    """
    massed, sounding = case.with_water_as_mass(), _sounding(case)
    mesh = dam_mesh(case)
    parts = dam(massed, mesh)
    intact = IntactDam.of(parts)
    highest = _FARTHEST / float(intact_periods(parts, 1, water=False)[0])
    frequencies = np.linspace(0.0, highest, _COUNT)
    waters: dict[str, WaterOfDam | None] = {"empty": None}
    if case.reservoir is not None and case.reservoir.depth > 0.0:
        waters["incompressible"] = WaterOfDam.of(intact, parts, None)
        with_waves = dam(sounding, mesh)
        waters["compressible"] = WaterOfDam.of(intact, with_waves, water_body(sounding, with_waves.bodies, highest))
    rocks: dict[str, ReducedRock | None] = {
        "rigid": None,
        "elastic": reduced_rock(intact.base, rock_material(_rock(case)), highest=highest),
    }
    ratio = case.concrete.damping
    curves = tuple(
        CrestCurve(rock, water, crest_response(intact, frequencies, ratio, water=wet, rock=below))
        for rock, below in rocks.items()
        for water, wet in waters.items()
    )
    return Amplification(frequencies, ratio, curves, tuple(_assumptions(case)))


def _sounding(case: Case) -> Case:
    """Return a case whose reservoir has sound; no check minds what else it has, as only its water is looked at."""
    if case.reservoir is None:
        return case
    return case.model_copy(update={"reservoir": case.reservoir.model_copy(update={"compressible": True})})


def _rock(case: Case) -> Rock:
    return case.foundation or Rock.model_validate({"modulus": f"{case.concrete.modulus!r} Pa"})


def _assumptions(case: Case) -> Iterator[tuple[str, dict[str, float]]]:
    if case.foundation is None or case.surroundings.assumed:
        yield (
            "The case has no [rock]: elastic rock has the modulus of the concrete, {modulus_pa:.3g GPa}.",
            {"modulus_pa": case.concrete.modulus or 0.0},
        )
    if case.reservoir is not None and not case.has_sound("reservoir"):
        yield (
            "The case has water without sound: compressible water has sound of {speed_m_s:.4g m/s}, and the floor "
            "reflects {reflection:.3g} of a wave.",
            {"speed_m_s": case.reservoir.wave_speed, "reflection": case.reservoir.floor_reflection},
        )
