"""The pressure of compressible water on the faces of a dam: the largest, and where the water would tear off."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.models.flexible.body.reservoir import WetFace
from heeltoe.result.numbers import FacePressure
from heeltoe.warnings.notice import Notice

#: Pressure of the air at sea level, and of water vapour at 20 °C [Pa].
ATMOSPHERE, VAPOUR = 101_325.0, 2_340.0


def total_pressure(face: WetFace, water: Floats) -> Floats:
    """Return the pressure (f, k) [Pa] over that of the air on a face by the velocities (f, w) of the water's modes."""
    total: Floats = face.still + water @ face.pressure.T
    return total


def wet_nodes(face: WetFace) -> Integers:
    """Return which nodes of a face are below the surface."""
    wet: Integers = np.flatnonzero(face.still > 0.0)
    return wet


def face_pressures(dam: FlexibleDam, time: Floats, water: Floats) -> list[FacePressure] | None:
    """Return the extremes of the pressure on each face; None without compressible water.

    Parameters
    ----------
    dam
        Of the run.
    time
        (f,) moments of its frames [s].
    water
        (f, w) velocities of the modes of the water.
    """
    if dam.reservoir is None:
        return None
    pressures = []
    for face in dam.reservoir.faces:
        wet = wet_nodes(face)
        total = total_pressure(face, water)[:, wet]
        high, low = (
            np.unravel_index(place, total.shape) for place in (np.argmax(total - face.still[wet]), np.argmin(total))
        )
        lowest = ATMOSPHERE + float(total[low])
        pressures.append(
            FacePressure(
                side=face.side,
                largest_pa=float(total[high] - face.still[wet][high[1]]),
                largest_time_s=float(time[high[0]]),
                largest_z_m=float(face.points[wet][high[1], 1]),
                lowest_absolute_pa=lowest,
                lowest_time_s=float(time[low[0]]),
                lowest_z_m=float(face.points[wet][low[1], 1]),
                cavitates=lowest < VAPOUR,
            )
        )
    return pressures


def water_warnings(pressures: Sequence[FacePressure] | None) -> Iterator[Notice]:
    """Return what a reader must know where the water would tear off a face."""
    for pressure in pressures or ():
        if pressure.cavitates:
            yield Notice(
                "cavitation",
                field=f"{pressure.side}.compressible",
                tension_pa=-pressure.lowest_absolute_pa + VAPOUR,
                z_m=pressure.lowest_z_m,
                time_s=pressure.lowest_time_s,
            )
