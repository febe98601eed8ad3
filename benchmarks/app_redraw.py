"""How soon the browser app shows what a slider does: from the event of the slider to the redrawn plot, by the browser's
own clock, for 30 s of shaking; and how long after its command the app is there."""

from __future__ import annotations

CASES = ("typical-base", "typical-height")
#: Paths of the sliders, and how far from where they stand they are moved there and back, in their steps.
SLIDERS = {
    "crack.friction": "friction",
    "reservoir.depth": "water",
    "crack.restitution": "restitution",
    "motion.pga": "peak acceleration",
    "uplift.drain_efficiency": "drains",
}
EVENTS, TABS, EVENTS_OF_EACH = 40, 10, 12
# Between two events, as of a hand that drags: longer than a redrawing, so that each event has its own.
_PAUSE_S = 0.15
_BROWSERS = ("chromium", "chromium-browser", "google-chrome")
