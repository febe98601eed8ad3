"""Pulses that are drawn for a case, by points."""

from __future__ import annotations

import math

KINDS = ("sine", "half-sine", "cosine")
# Straight pieces of a whole period.
_PIECES = 40


def pulse_points(kind: str, period: float) -> list[list[str]]:
    """Return a pulse of one g as the points of a case: one sine, half of one, or one cosine of a period [s]."""
    count = _PIECES // 2 if kind == "half-sine" else _PIECES
    wave = math.cos if kind == "cosine" else math.sin
    values = [wave(2.0 * math.pi * place / _PIECES) for place in range(count + 1)]
    return [[f"{period * k / _PIECES:.9g} s", f"{0.0 if abs(v) < 1e-12 else v:.9g} g"] for k, v in enumerate(values)]
