"""At which acceleration of the ground a block at rest starts to slide and to rock: one wording for tables and figures.

All accelerations are magnitudes in g, named by the way the block goes; the ground then accelerates the other way.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from heeltoe.base.arrays import Floats
from heeltoe.result.response import Response

_WAYS = ("downstream", "upstream")


@dataclass(frozen=True)
class Start:
    """Where one motion of the block begins.

    Attributes
    ----------
    kind, way
        "sliding" or "rocking"; "downstream" or "upstream".
    value
        Horizontal acceleration of the ground [g], without any vertical one.
    per_vertical
        How much more it is for each g of upward acceleration.
    vertical
        Least and largest upward acceleration of the run [g]; None where the ground moves horizontally alone.
    """

    kind: str
    way: str
    value: float
    per_vertical: float
    vertical: tuple[float, float] | None

    def of_the_ground(self, up: ArrayLike = 0.0) -> Floats:
        """Return it as an acceleration of the ground, positive downstream, at upward accelerations [g]."""
        limit: Floats = self.value + self.per_vertical * np.asarray(up, dtype=np.float64)
        return -limit if self.way == "downstream" else limit

    def __str__(self) -> str:
        return f"{self.value:.4f} g" if math.isfinite(self.value) else "no acceleration"

    @property
    def varied(self) -> str:
        """Its range with the vertical motion; empty without one."""
        if self.vertical is None or not math.isfinite(self.value):
            return ""
        low, high = sorted(self.value + self.per_vertical * up for up in self.vertical)
        return f"{low:.4f} to {high:.4f} g"


def starts(response: Response) -> dict[tuple[str, str], Start]:
    """Return where sliding and rocking start, each way, by kind and way."""
    limits, slopes = (response.static[f"critical_acceleration_{key}"] for key in ("g", "per_vertical"))
    vertical = None
    # In the decoupled chain the crack's own vertical motion and rotation count, not those of the ground.
    if response.vertical is not None and response.model != "decoupled":
        up = response.vertical.acceleration / response.gravity
        vertical = (min(0.0, float(up.min())), max(0.0, float(up.max())))
    return {
        (kind, way): Start(kind, way, limits[f"{kind}_{way}"], slopes[f"{kind}_{way}"], vertical)
        for kind in ("sliding", "rocking")
        for way in _WAYS
    }


def first_starts(response: Response) -> tuple[Start, Start]:
    """Return what comes first downstream, and what upstream."""
    first = starts(response)
    down, up = (
        min((first[kind, way] for kind in ("sliding", "rocking")), key=lambda start: start.value) for way in _WAYS
    )
    return down, up


def first_starts_in_words(response: Response) -> str:
    """Say what starts first each way, and where, for a figure whose line of it moves with the vertical motion."""
    down, up = first_starts(response)
    if down.kind == up.kind:
        text = f"{down.kind} starts at {down} downstream, {up} upstream"
    else:
        text = f"{down.kind} starts at {down} downstream, {up.kind} at {up} upstream"
    if response.elastic:
        text = f"rigid block: {text}"
    if response.vertical is None:
        return text
    return f"{text}; {'moves with the vertical motion' if down.vertical else 'without the vertical motion'}"
