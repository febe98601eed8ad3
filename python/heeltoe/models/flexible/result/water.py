"""The pressure of compressible water on the faces of a dam: the largest, and where the water would tear off."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.kernel.dam import DamRun
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.models.flexible.body.reservoir import WaterBody, WetFace
from heeltoe.result.numbers import FacePressure
from heeltoe.warnings.notice import Notice

#: Pressure of the air at sea level, and of water vapour at 20 °C [Pa].
ATMOSPHERE, VAPOUR = 101_325.0, 2_340.0


def total_pressure(face: WetFace, water: Floats) -> Floats:
    """Return the pressure (f, k) [Pa] over that of the air on a face by the velocities (f, w) of the water's modes."""
    total: Floats = face.still + water @ face.pressure.T
    return total


class PressureRange(NamedTuple):
    """The range of the pressure beyond that at rest [Pa] on a face, (k,) at its nodes below the surface, and when
    [s]."""

    face: WetFace
    most: Floats
    most_at: Floats
    least: Floats
    least_at: Floats


def extremes_of_water(dam: FlexibleDam, run: DamRun) -> Floats | None:
    """Return the largest pressure beyond that at rest [Pa] and when [s], the least and when, (4, p) at all nodes below
    the surface, face by face; None without compressible water."""
    if dam.reservoir is None:
        return None
    found = run.pressures
    return np.stack([found.tension, found.tension_time, found.compression, found.compression_time])


def pressure_ranges(reservoir: WaterBody, extremes: Floats) -> list[PressureRange]:
    """Return the range of the pressure on each face over a run, by :func:`extremes_of_water`."""
    ranges, first = [], 0
    for face in reservoir.faces:
        own = slice(first, first + face.wet.size)
        first += face.wet.size
        ranges.append(PressureRange(face, *extremes[:, own]))
    return ranges


def face_pressures(dam: FlexibleDam, run: DamRun) -> list[FacePressure] | None:
    """Return the extremes of the pressure on each face in a run of a dam; None without compressible water."""
    extremes = extremes_of_water(dam, run)
    if dam.reservoir is None or extremes is None:
        return None
    result = []
    for of in pressure_ranges(dam.reservoir, extremes):
        z, total = of.face.points[of.face.wet, 1], of.face.still[of.face.wet] + of.least
        high, low = int(np.argmax(of.most)), int(np.argmin(total))
        lowest = ATMOSPHERE + float(total[low])
        result.append(
            FacePressure(
                side=of.face.side,
                largest_pa=float(of.most[high]),
                largest_time_s=float(of.most_at[high]),
                largest_z_m=float(z[high]),
                lowest_absolute_pa=lowest,
                lowest_time_s=float(of.least_at[low]),
                lowest_z_m=float(z[low]),
                cavitates=lowest < VAPOUR,
            )
        )
    return result


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
