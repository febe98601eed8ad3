"""What a cracked concrete gravity dam does in an earthquake."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from heeltoe.animation import animate
    from heeltoe.block import Block, build_block
    from heeltoe.case import Case, read_case
    from heeltoe.comparison import Comparison, compare
    from heeltoe.decoupled_model import decoupled
    from heeltoe.ensemble import rigid_many
    from heeltoe.errors import HeeltoeError, InputError
    from heeltoe.flexible_model import flexible
    from heeltoe.flexible_parts import FlexibleDam, build_flexible_dam
    from heeltoe.made_to_order import stochastic_motion
    from heeltoe.matching import match
    from heeltoe.motion import GroundMotion
    from heeltoe.periods import DamPeriods, dam_periods
    from heeltoe.records import read_channels, read_record
    from heeltoe.report import write_report
    from heeltoe.response import Response
    from heeltoe.rigid_model import rigid
    from heeltoe.scenario import synthetic
    from heeltoe.spectrum import response_spectrum
    from heeltoe.spread import with_spread
    from heeltoe.statics_model import Statics, statics
    from heeltoe.targets import asce_7, en_1998
    from heeltoe.verdicts import verdict

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
    "Block": "block",
    "Case": "case",
    "Comparison": "comparison",
    "DamPeriods": "periods",
    "GroundMotion": "motion",
    "HeeltoeError": "errors",
    "InputError": "errors",
    "Response": "response",
    "Statics": "statics_model",
    "animate": "animation",
    "asce_7": "targets",
    "build_block": "block",
    "build_flexible_dam": "flexible_parts",
    "compare": "comparison",
    "dam_periods": "periods",
    "decoupled": "decoupled_model",
    "en_1998": "targets",
    "flexible": "flexible_model",
    "FlexibleDam": "flexible_parts",
    "match": "matching",
    "overturning_map": "overturning",
    "read_case": "case",
    "read_channels": "records",
    "read_record": "records",
    "response_spectrum": "spectrum",
    "rigid": "rigid_model",
    "rigid_many": "ensemble",
    "statics": "statics_model",
    "stochastic_motion": "made_to_order",
    "synthetic": "scenario",
    "verdict": "verdicts",
    "with_spread": "spread",
    "write_report": "report",
}


def __getattr__(name: str) -> Any:
    """Import on first use, so that ``heeltoe --help`` does not wait for the plots."""
    if name not in _HOME:
        raise AttributeError(f"module 'heeltoe' has no attribute {name!r}")
    value = getattr(import_module(f"heeltoe.{_HOME[name]}"), name)
    globals()[name] = value
    return value
