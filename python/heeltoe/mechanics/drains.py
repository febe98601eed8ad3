"""Drains that a slip closes: what they leave of the drainage, and the case that is left."""

from __future__ import annotations

from heeltoe.case.model import Case


def close_by_slip(case: Case) -> bool:
    """Whether a case has drains that a slip closes, and says how wide they are."""
    return case.uplift.pattern == "drained" and case.statics.drain_diameter is not None


def drainage_left(case: Case, slip: float) -> float:
    """Return the part of the drainage that a slip [m], either way, leaves: none from one diameter of the drains on."""
    size = case.statics.drain_diameter
    if not close_by_slip(case) or size is None:
        return 1.0
    return max(0.0, 1.0 - abs(slip) / size)


def with_drainage(case: Case, share: float) -> Case:
    """Return a case with a share of its drainage left; without any, the drains have the head that the case says."""
    own, closed = case.uplift.drain_efficiency or 0.0, 0.0
    if case.statics.closed_drains == "linear":
        # A drain at a part of the width is on the straight line from heel to toe with that part as its efficiency.
        closed = min(case.uplift_at_crack.drain_position or 0.0, own)
    efficiency = closed + share * (own - closed)
    return case.model_copy(update={"uplift": case.uplift.model_copy(update={"drain_efficiency": efficiency})})
