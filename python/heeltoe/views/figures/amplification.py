"""The amplification of the crest by frequency, on rigid and on elastic rock."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from heeltoe.models.flexible.surroundings.amplification import Amplification, CrestCurve
from heeltoe.views.figures.style import COLOURS, WIDTH, heading, styled

_LINES = {
    "empty": ("#777777", ":"),
    "incompressible": (COLOURS["rotation"], "--"),
    "compressible": (COLOURS["slip"], "-"),
}


@styled
def amplification_figure(title: str, amplification: Amplification) -> Figure:
    """Draw the acceleration of the crest over that of the ground, a panel for each rock, a line for each water."""
    rocks = list(dict.fromkeys(curve.rock for curve in amplification.curves))
    figure = Figure(figsize=(WIDTH, 4.4), layout="constrained")
    all_axes = figure.subplots(1, len(rocks), sharex=True, sharey=True, squeeze=False)[0]
    for axes, rock in zip(all_axes, rocks, strict=True):
        for curve in amplification.curves:
            if curve.rock == rock:
                colour, dash = _LINES[curve.water]
                size = np.abs(curve.response.amplification)
                axes.plot(amplification.frequencies, size, color=colour, linestyle=dash, label=_label(curve))
                if curve.response.resonance is not None and curve.response.peak is not None:
                    axes.plot(curve.response.resonance, curve.response.peak, "o", color=colour, markersize=3.5)
        axes.set_title(f"{rock} rock", fontsize=9)
        axes.set_xlabel("frequency [Hz]")
        axes.legend(
            fontsize=7.5,
            loc="upper center",
            bbox_to_anchor=(0.5, -0.14),
            title="water: first peak, effective damping",
            title_fontsize=7.5,
        )
        axes.set_xlim(0.0, float(amplification.frequencies[-1]))
    all_axes[0].set_ylim(0.0, None)
    all_axes[0].set_ylabel("acceleration of the crest over the ground's [-]")
    ratio = f"{100.0 * amplification.damping_ratio:.3g} % damping of the concrete"
    heading(figure, title or "Untitled case", f"no slip, cracks bonded; {ratio}")
    return figure


def _label(curve: CrestCurve) -> str:
    response = curve.response
    if response.resonance is None:
        return curve.water
    damping = "too broad" if response.damping is None else f"{100.0 * response.damping:.1f} %"
    return f"{curve.water}: {response.resonance:.2f} Hz, {damping}"
