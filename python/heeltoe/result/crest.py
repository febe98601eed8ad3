"""How the crest moves: what people, gates and instruments up there feel, from the histories of a run."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number

#: Its largest numbers as columns of studies.
CREST_PEAKS = ("crest_displacement_m", "crest_acceleration_g")
#: Its columns of the histories.
DISPLACEMENT, ACCELERATION = "crest_displacement_m", "crest_acceleration_m_s2"


class CrestMotion(Block):
    """How far and how hard the upstream edge of the crest moves."""

    displacement_m: Annotated[
        float,
        Number(
            "Largest horizontal displacement from where it stands before the earthquake, relative to the ground, "
            "at the moments of the histories.",
            "m",
        ),
    ]
    residual_displacement_m: Annotated[
        float, Number("Where it is at the end of the run, positive downstream: of a dam that slips mostly slip.", "m")
    ]
    acceleration_g: Annotated[
        float,
        Number(
            "Largest horizontal acceleration with that of the ground, its mean over two steps of the histories: "
            "the blow of an impact is shorter.",
            "g",
        ),
    ]
    amplification: Annotated[
        float | None, Number("How many times the peak of the ground that is; null where the ground stands still.")
    ]


def crest_histories(time: Floats, place: Floats, ground: Floats) -> dict[str, Floats]:
    """Return the histories of the crest.

    Parameters
    ----------
    time
        (n,) moments [s].
    place
        (n,) where it is relative to the ground, from anywhere, positive downstream [m].
    ground
        (n,) horizontal acceleration of the ground [m/s2].

    Returns
    -------
    dict
        Displacement from its first place [m], and acceleration with that of the ground [m/s2]: its change of velocity
        between the middles of the neighbouring intervals, which is exact in the mean, and the ground's at both ends.
    """
    displacement = place - place[0]
    own = np.zeros_like(displacement)
    if time.size > 2:
        velocity = np.diff(displacement) / np.diff(time)
        own[1:-1] = np.diff(velocity) / ((time[2:] - time[:-2]) / 2.0)
    return {DISPLACEMENT: displacement, ACCELERATION: own + ground}


def crest_peaks(crest: CrestMotion | None) -> dict[str, float]:
    """Return the numbers of :data:`CREST_PEAKS`; not a number where there are none."""
    peaks = (math.nan, math.nan) if crest is None else (crest.displacement_m, crest.acceleration_g)
    return dict(zip(CREST_PEAKS, peaks, strict=True))


def crest_motion(histories: Mapping[str, Floats], gravity: float, ground: float) -> CrestMotion | None:
    """Return the largest of these histories; None where a model has none. `gravity` is one g, `ground` the peak of its
    acceleration [m/s2], which the histories miss where it jumps."""
    if DISPLACEMENT not in histories:
        return None
    displacement, acceleration = histories[DISPLACEMENT], histories[ACCELERATION]
    largest = float(np.abs(acceleration).max(initial=0.0))
    return CrestMotion(
        displacement_m=float(np.abs(displacement).max(initial=0.0)),
        residual_displacement_m=float(displacement[-1]),
        acceleration_g=largest / gravity,
        amplification=largest / ground if ground else None,
    )
