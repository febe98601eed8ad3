"""The figure of a ground motion: histories, Fourier amplitudes, response spectrum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heeltoe.base.atomic_files import written
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import fourier_amplitudes, velocity_displacement
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.motion.targets import Target
from heeltoe.units.systems import Units, unit_system
from heeltoe.units.write import number
from heeltoe.views.figures.panels import beside
from heeltoe.views.figures.style import COLOURS, WIDTH, align_labels, heading, styled
from heeltoe.views.figures.write import save

_BEFORE = "#AAAAAA"


@dataclass(frozen=True, eq=False)
class Matched:
    """Target and source of a matched motion.

    Attributes
    ----------
    target
        The spectrum.
    record
        The motion before, scaled as a whole to the target.
    """

    target: Target
    record: GroundMotion


def write_motion_figure(
    motion: GroundMotion, gravity: float, path: Path, units: str = "si", matched: Matched | None = None
) -> Path:
    """Write the figure of a motion to `path` (its ending says the format) and return the path."""
    with written(path, "--figure") as fresh:
        save(motion_figure(motion, gravity, units, matched), fresh)
    return path


@styled
def history_figure(motion: GroundMotion, vertical: GroundMotion | None, gravity: float, units: str = "si") -> Figure:
    """Draw acceleration, velocity and displacement over time, of the vertical motion beside, where there is one."""
    motions = [motion, *([] if vertical is None else [vertical])]
    figure = Figure(figsize=(WIDTH, 4.4), layout="constrained")
    columns = figure.subplots(3, len(motions), sharex=True, squeeze=False).T
    heading(figure, " and ".join(motion.name for motion in motions))
    for axes, motion, way in zip(columns, motions, ("horizontal, + downstream", "vertical, + up"), strict=False):
        draw_history(list(axes), motion, gravity, unit_system(units))
        axes[0].set_title(way, loc="left", fontsize=9)
        align_labels(axes)
    return figure


def draw_history(panels: Sequence[Axes], motion: GroundMotion, gravity: float, units: Units) -> None:
    """Draw acceleration, velocity and displacement over time, with their peaks, into three panels."""
    velocity, displacement = velocity_displacement(motion)
    speed, length = units.scale("velocity"), units.scale("displacement", motion.pgd)
    rows = (
        ("acceleration", "PGA", motion.acceleration / gravity, motion.pga / gravity, "g"),
        ("velocity", "PGV", speed(velocity), speed(motion.pgv), speed.unit),
        ("displacement", "PGD", length(displacement), length(motion.pgd), length.unit),
    )
    for axes, (name, peak, values, most, unit) in zip(panels, rows, strict=True):
        axes.plot(motion.time, values, color=COLOURS["ground"], linewidth=0.7)
        axes.set_ylabel(f"{name}\n[{unit}]")
        beside(axes, f"{peak} {number(most)} {unit}")
        axes.set_xlim(0.0, motion.duration)
    panels[-1].set_xlabel("time [s]")


@styled
def motion_figure(motion: GroundMotion, gravity: float, units: str = "si", matched: Matched | None = None) -> Figure:
    """Draw acceleration, velocity and displacement over time, Fourier amplitudes and the response spectrum, of 5 %
    damping; of a motion that was matched with its target, at the damping of that, and the record before."""
    system = unit_system(units)
    velocity_scale = system.scale("velocity")
    figure = Figure(figsize=(WIDTH, 8.0), layout="constrained")
    grid = figure.add_gridspec(4, 2, height_ratios=[1.0, 0.8, 0.8, 1.7])
    about = ", ".join(part for part in (motion.event, motion.station, motion.component, motion.date) if part)
    heading(figure, motion.name, about or "no origin stated")
    top = figure.add_subplot(grid[0, :])
    panels = [top, *(figure.add_subplot(grid[row, :], sharex=top) for row in (1, 2))]
    if matched is not None:
        record = matched.record
        top.plot(record.time, record.acceleration / gravity, color=_BEFORE, linewidth=0.7, label="scaled record")
        top.legend(loc="upper right", fontsize=7)
    draw_history(panels, motion, gravity, system)
    frequency, amplitude = fourier_amplitudes(motion)
    fourier = figure.add_subplot(grid[3, 0])
    shown = (frequency >= 0.05) & (amplitude > 0.0)
    fourier.loglog(frequency[shown], velocity_scale(amplitude[shown]), color=COLOURS["slip"], linewidth=0.6)
    fourier.set_xlabel("frequency [Hz]")
    fourier.set_ylabel(f"Fourier amplitude [{velocity_scale.unit}]")
    if shown.any():
        largest = velocity_scale(amplitude[shown].max())
        fourier.set_ylim(largest * 1e-4, largest * 2.0)

    damping = 0.05 if matched is None else matched.target.damping
    spectrum = response_spectrum(motion, damping=damping)
    response = figure.add_subplot(grid[3, 1])
    if matched is not None:
        _draw_target(response, matched, gravity)
    response.semilogx(
        spectrum.period, spectrum.pseudo_acceleration / gravity, color=COLOURS["rotation"], label="matched"
    )
    if matched is not None:
        response.legend(loc="upper right", fontsize=7)
    response.axhline(motion.pga / gravity, color=COLOURS["limit"], linestyle="--", linewidth=0.9)
    response.annotate(
        f"PGA {number(motion.pga / gravity)} g",
        (spectrum.period[-1], motion.pga / gravity),
        xytext=(0, 3),
        textcoords="offset points",
        ha="right",
        fontsize=7,
    )
    response.set_xlabel("period [s]")
    response.set_ylabel(f"pseudo-acceleration [g], {100.0 * damping:.3g} %")
    response.set_ylim(bottom=0.0)
    response.set_xlim(spectrum.period[0], spectrum.period[-1])
    for axes in (fourier, response):
        axes.xaxis.set_major_formatter(lambda value, _: np.format_float_positional(value, trim="-"))
    return figure


def _draw_target(axes: Axes, matched: Matched, gravity: float) -> None:
    """Draw the target of a match, and the spectrum of the record before."""
    before = response_spectrum(matched.record, damping=matched.target.damping)
    axes.semilogx(
        before.period, before.pseudo_acceleration / gravity, color=_BEFORE, linewidth=1.0, label="scaled record"
    )
    known = (before.period >= matched.target.shortest) & (before.period <= matched.target.longest)
    period = before.period[known]
    axes.semilogx(
        period, matched.target(period) / gravity, color=COLOURS["toe"], linestyle="--", linewidth=1.8, label="target"
    )
