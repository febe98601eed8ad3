"""What a cracked concrete gravity dam does in an earthquake."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from heeltoe.shown import hand_in

if TYPE_CHECKING:
    from heeltoe.case.model import Case
    from heeltoe.case.read import read_case
    from heeltoe.errors import HeeltoeError, InputError
    from heeltoe.mechanics.block import Block, build_block
    from heeltoe.models.decoupled.model import decoupled
    from heeltoe.models.flexible.model import flexible
    from heeltoe.models.flexible.periods import DamPeriods, dam_periods
    from heeltoe.models.flexible.reduced import FlexibleDam, build_flexible_dam
    from heeltoe.models.rigid.many import rigid_many
    from heeltoe.models.rigid.model import rigid
    from heeltoe.models.statics.model import Statics, statics
    from heeltoe.motion.ground_motion import GroundMotion
    from heeltoe.motion.matching import match
    from heeltoe.motion.records import read_channels, read_record
    from heeltoe.motion.scenario import synthetic
    from heeltoe.motion.spectrum import response_spectrum
    from heeltoe.motion.stochastic import stochastic_motion
    from heeltoe.motion.targets import asce_7, en_1998
    from heeltoe.result.response import Response
    from heeltoe.result.verdict import verdict
    from heeltoe.study.comparison import Comparison, compare
    from heeltoe.study.spread import with_spread
    from heeltoe.views.animation import animate
    from heeltoe.views.report import write_report

__all__ = [
    "Block",
    "Case",
    "Comparison",
    "DamPeriods",
    "FlexibleDam",
    "GroundMotion",
    "HeeltoeError",
    "InputError",
    "Response",
    "Statics",
    "animate",
    "asce_7",
    "build_block",
    "build_flexible_dam",
    "compare",
    "dam_periods",
    "decoupled",
    "en_1998",
    "flexible",
    "match",
    "overturning_map",
    "read_case",
    "read_channels",
    "read_record",
    "response_spectrum",
    "rigid",
    "rigid_many",
    "statics",
    "stochastic_motion",
    "synthetic",
    "verdict",
    "with_spread",
    "write_report",
]

_HOME = {
    "Block": "mechanics.block",
    "Case": "case.model",
    "Comparison": "study.comparison",
    "DamPeriods": "models.flexible.periods",
    "GroundMotion": "motion.ground_motion",
    "HeeltoeError": "errors",
    "InputError": "errors",
    "Response": "result.response",
    "Statics": "models.statics.model",
    "animate": "views.animation",
    "asce_7": "motion.targets",
    "build_block": "mechanics.block",
    "build_flexible_dam": "models.flexible.reduced",
    "compare": "study.comparison",
    "dam_periods": "models.flexible.periods",
    "decoupled": "models.decoupled.model",
    "en_1998": "motion.targets",
    "flexible": "models.flexible.model",
    "FlexibleDam": "models.flexible.reduced",
    "match": "motion.matching",
    "overturning_map": "study.overturning",
    "read_case": "case.read",
    "read_channels": "motion.records",
    "read_record": "motion.records",
    "response_spectrum": "motion.spectrum",
    "rigid": "models.rigid.model",
    "rigid_many": "models.rigid.many",
    "statics": "models.statics.model",
    "stochastic_motion": "motion.stochastic",
    "synthetic": "motion.scenario",
    "verdict": "result.verdict",
    "with_spread": "study.spread",
    "write_report": "views.report",
}


def _html(thing: object) -> str:
    from heeltoe.views.notebook import html

    return html(thing)


hand_in(html=_html)


def __getattr__(name: str) -> Any:
    """Import on first use, so that ``heeltoe --help`` does not wait for the plots."""
    if name not in _HOME:
        raise AttributeError(f"module 'heeltoe' has no attribute {name!r}")
    value = getattr(import_module(f"heeltoe.{_HOME[name]}"), name)
    globals()[name] = value
    return value
