"""What an earthquake asks of a section by its response spectrum: the first mode of the dam with water and rock, and a
static correction for all higher ones (Fenves and Chopra 1987)."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from heeltoe.mechanics.loads import Resultant


@dataclass(frozen=True)
class SpectralDemand:
    """Forces on what is above a section. Per metre of dam, SI.

    Attributes
    ----------
    spectrum
        Name of the motion or of the design spectrum.
    period_s, damping_ratio
        Of the first mode of the dam without a crack, with its water and its rock; the damping is the effective one.
    pseudo_acceleration_m_s2
        Of the spectrum at that period and damping.
    peak_ground_acceleration_m_s2
        Of the spectrum at period zero.
    first_mode
        Downstream, upward, moment about the heel counter-clockwise, and what the upward part adds to the moment, at
        the first mode's largest push downstream [N, N m per m].
    static_correction
        The same of all higher modes.
    """

    spectrum: str
    period_s: float
    damping_ratio: float
    pseudo_acceleration_m_s2: float
    peak_ground_acceleration_m_s2: float
    first_mode: tuple[float, float, float, float]
    static_correction: tuple[float, float, float, float]

    def push(self) -> Resultant:
        """Return both together downstream: the root of the sum of squares, with the signs of the first mode."""
        across, up, moment, lift = (
            math.copysign(math.hypot(first, rest), first)
            for first, rest in zip(self.first_mode, self.static_correction, strict=True)
        )
        return Resultant("response spectrum", across, up, moment, lift_moment=lift)

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers and strings."""
        push = self.push()
        numbers = asdict(self)
        for name in ("first_mode", "static_correction"):
            across, up, moment, _ = numbers.pop(name)
            numbers[name] = {"horizontal_n": across, "vertical_n": up, "moment_about_heel_nm": moment}
        together = {
            "horizontal_n": push.horizontal,
            "vertical_n": push.vertical,
            "moment_about_heel_nm": push.moment,
        }
        return {**numbers, "together": together}
