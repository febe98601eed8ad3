"""The pressure of compressible water on the faces of an elastic dam."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.figure import Figure

from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.models.flexible.result.water import ATMOSPHERE, VAPOUR, pressure_ranges, total_pressure
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.style import COLOURS, WIDTH, describe, styled


@styled
def water_pressure_figure(response: FlexibleResponse, units: str = "si") -> Figure:
    """Draw the pressure over the height of each face: at rest, its range over the run, and that at the
    frame with the largest push on the face."""
    history = response.crack
    water, reservoir = history.water, history.dam.reservoir
    assert water is not None
    assert reservoir is not None
    assert history.pressures is not None
    system = unit_system(units)
    figure = Figure(figsize=(WIDTH, 4.4), layout="constrained")
    describe(figure, response)
    all_axes = figure.subplots(1, len(reservoir.faces), squeeze=False)[0]
    length = system.scale("length")
    handles: dict[str, Artist] = {}
    for axes, of in zip(all_axes, pressure_ranges(reservoir, history.pressures), strict=True):
        face, wet = of.face, of.face.wet
        total, z = total_pressure(face, water)[:, wet], face.points[wet, 1]
        order = np.argsort(z, kind="stable")
        total, height, still = total[:, order], length(z[order]), face.still[wet][order]
        least, most = ((still + beyond[order]) for beyond in (of.least, of.most))
        scale = system.scale("pressure", float(max(np.abs(least).max(), np.abs(most).max())))
        pushed = int(np.argmax(np.trapezoid(total, z[order], axis=1)))
        low, high = scale(least), scale(most)
        axes.fill_betweenx(height, low, high, color=COLOURS["water"], label="range over the run")
        axes.plot(scale(still), height, color="#000000", linestyle="--", linewidth=1.0, label="at rest")
        axes.plot(scale(total[pushed]), height, color=COLOURS["slip"], linewidth=1.3, label="largest push on the face")
        lowest = of.least_at[order][np.argmin(least)]
        moments = f"push at {history.time[pushed]:.2f} s, lowest pressure at {lowest:.2f} s"
        axes.set_title(f"{face.side}: {moments}", fontsize=8)
        limit = scale(VAPOUR - ATMOSPHERE)
        if low.min() < 0.5 * limit:
            axes.axvline(limit, color=COLOURS["crack"], linestyle=":", label="vapour: the water tears off")
        axes.set_xlabel(f"pressure over that of the air [{scale.unit}]")
        axes.set_ylabel(f"height [{length.unit}]")
        artists, labels = axes.get_legend_handles_labels()
        handles |= dict(zip(labels, artists, strict=True))
    figure.legend(list(handles.values()), list(handles), loc="outside lower center", ncols=3)
    return figure
