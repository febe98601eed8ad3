"""What is said of studies in several places: limits, and what motions are known by beside their strength."""

from __future__ import annotations

from heeltoe.units.write import length

KINDS = {"residual_slip": "residual slip", "peak_slip": "peak slip", "opening": "opening", "rotation": "rotation"}
#: As headings.
TRAITS = {
    "mean_period_s": "period",
    "significant_duration_s": "duration",
    "magnitude": "magnitude",
    "distance_m": "distance",
}


def limit_of(limit: str, value: float, units: str = "si", of: str = "") -> str:
    """Write a limit with its amount; `of` stands between them."""
    amount = f"{value:.3g} rad" if limit == "rotation" else length(value, units)
    return f"{KINDS[limit]}{of} {amount}"
