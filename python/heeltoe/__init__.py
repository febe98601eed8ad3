"""What a cracked concrete gravity dam does in an earthquake."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from heeltoe.block import Block, build_block
    from heeltoe.case import Case, read_case
    from heeltoe.ensemble import rigid_many
    from heeltoe.errors import HeeltoeError, InputError
    from heeltoe.motion import GroundMotion
    from heeltoe.records import read_record
    from heeltoe.response import Response
    from heeltoe.rigid_model import rigid
    from heeltoe.verdicts import verdict

__all__ = [
    "Block",
    "Case",
    "GroundMotion",
    "HeeltoeError",
    "InputError",
    "Response",
    "build_block",
    "read_case",
    "read_record",
    "rigid",
    "rigid_many",
    "verdict",
]

_HOME = {
    "Block": "block",
    "Case": "case",
    "GroundMotion": "motion",
    "HeeltoeError": "errors",
    "InputError": "errors",
    "Response": "response",
    "build_block": "block",
    "read_case": "case",
    "read_record": "records",
    "rigid": "rigid_model",
    "rigid_many": "ensemble",
    "verdict": "verdicts",
}


def __getattr__(name: str) -> Any:
    """Import on first use, so that ``heeltoe --help`` does not wait for the plots."""
    if name not in _HOME:
        raise AttributeError(f"module 'heeltoe' has no attribute {name!r}")
    value = getattr(import_module(f"heeltoe.{_HOME[name]}"), name)
    globals()[name] = value
    return value
