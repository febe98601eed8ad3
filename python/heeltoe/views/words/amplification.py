"""The response of the crest in words and numbers: its first peak on each rock and with each water."""

from __future__ import annotations

from heeltoe.models.flexible.surroundings.amplification import Amplification

COLUMNS = ("rock", "water", "resonance", "crest over ground", "effective damping")


def peak_rows(amplification: Amplification) -> list[tuple[str, ...]]:
    """Return the cells of each rock and water."""
    rows: list[tuple[str, ...]] = []
    for curve in amplification.curves:
        first = curve.response
        rows.append(
            (
                curve.rock,
                curve.water,
                "-" if first.resonance is None else f"{first.resonance:.3f} Hz",
                "-" if first.peak is None else f"{first.peak:.1f}",
                "-" if first.damping is None else f"{100.0 * first.damping:.1f} %",
            )
        )
    return rows
