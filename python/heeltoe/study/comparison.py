"""The rigid model, or the decoupled chain, and the flexible model side by side on the same ground motion."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from time import perf_counter
from types import MappingProxyType
from typing import Any, Literal, Protocol, TypeVar

from heeltoe.case.model import Case
from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.models.run import earthquake, flexible, run
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.contract import HEADLINES, Quantity
from heeltoe.result.response import Response
from heeltoe.shown import Shown
from heeltoe.units.sentences import Sentence

# From which ratio on the models differ by more than the flexible one is known to differ from its references.
_CLOSE = 1.25
# A slip of less is none that matters to a dam [m].
_LITTLE = 1e-3
_LITTLE_IN_WORDS = {"si": "a millimetre", "us": "0.04 in"}

_TABLE = Sentence.of(
    "Zhu 2004, table 7.8: a dam of {moduli_pa:g GPa} slides {slips_m:g mm}, a rigid block {slip_m:g mm}",
    moduli_pa=(20e9, 200e9, 2000e9, 20000e9),
    slips_m=(0.218, 0.094, 0.052, 0.037),
    slip_m=0.036,
)

R = TypeVar("R", bound=Response)


class Change(Protocol):
    """Makes a response of the same kind of one."""

    def __call__(self, response: R, /) -> R: ...


@dataclass(frozen=True, eq=False)
class Comparison(Shown):
    """Two models on one case.

    Attributes
    ----------
    rigid
        Response of the rigid part above the crack: of the model ``"rigid"`` or ``"decoupled"``.
    flexible
        That of the flexible model, to the same ground motion.
    seconds
        How long each took to compute, by model [s]; building the elastic parts is part of it.
    """

    rigid: Response
    flexible: FlexibleResponse
    seconds: Mapping[str, float]

    def __post_init__(self) -> None:
        object.__setattr__(self, "seconds", MappingProxyType(dict(self.seconds)))

    @property
    def title(self) -> str:
        """Of the case."""
        return self.flexible.title

    @property
    def responses(self) -> tuple[Response, FlexibleResponse]:
        """Both, that of the rigid part first."""
        return self.rigid, self.flexible

    @property
    def ok(self) -> bool:
        """Whether both runs ended with a result to trust."""
        return self.rigid.ok and self.flexible.ok

    def ratio(self) -> dict[str, float | None]:
        """Return flexible over rigid for slips, rotations and openings; None where the rigid one is next to nothing."""
        return {each.key: self._ratio(each) for each in HEADLINES}

    def meaning(self, units: str = "si") -> str:
        """Say in a sentence what the difference means, in units ``"si"`` or ``"us"``."""
        if not self.ok:
            failed = [each.model for each in (self.rigid, self.flexible) if not each.ok]
            return f"There is nothing to compare: no result to trust from the {' and the '.join(failed)} model."
        block, dam = (abs(each.residual_slip_m) for each in (self.rigid, self.flexible))
        if max(block, dam) < _LITTLE:
            return f"Both say that the dam slides by less than {_LITTLE_IN_WORDS[units]}."
        if isinstance(self.rigid, DecoupledResponse):
            return self._meaning_of_decoupling(block, dam)
        if block < _LITTLE:
            return (
                "Only the flexible dam slides: its own vibration adds to the shaking, of which a rigid block knows "
                f"nothing. Trust the flexible model ({_TABLE.text(units)})."
            )
        if self.rigid.residual_slip_m * self.flexible.residual_slip_m < 0.0:
            return "They slide opposite ways: the dam's own vibration decides here. Trust the flexible model."
        if dam > _CLOSE * block:
            return (
                f"The flexible dam slides {dam / block:.2g} times as far: its own vibration adds to the shaking, of "
                f"which a rigid block knows nothing. Trust the flexible model ({_TABLE.text(units)})."
            )
        if block > _CLOSE * dam:
            share = f"{dam / block:.2g} times" if dam > 0.01 * block else "less than a hundredth of"
            return (
                f"The flexible dam slides only {share} what the rigid block does: its own vibration works against the "
                "shaking here. Trust the flexible model."
            )
        return "They agree: the dam is so stiff against this shaking that a rigid block says what it does."

    def _meaning_of_decoupling(self, block: float, dam: float) -> str:
        """Say the same where the block was shaken by the part below it."""
        if self.rigid.residual_slip_m * self.flexible.residual_slip_m < 0.0:
            text = "They slide opposite ways"
        elif max(block, dam) <= _CLOSE * min(block, dam):
            return "They agree: the part below shakes the top as if the top never slid on it."
        elif dam < 0.01 * block:
            text = "The flexible dam slides less than a hundredth of what the decoupled top does"
        elif block < 0.01 * dam:
            text = "The decoupled top slides less than a hundredth of what the flexible dam does"
        else:
            text = f"The flexible dam slides {dam / block:.2g} times as far as the decoupled top"
        return (
            f"{text}: in the decoupled chain the part below vibrates as if the top never slid or rocked, and the top "
            "does not vibrate itself. Trust the flexible model."
        )

    def to_json(self) -> dict[str, Any]:
        """Return both results and their ratio as plain numbers, strings and lists."""
        return {
            "model": "both",
            "title": self.title,
            self.rigid.model: self.rigid.to_json(),
            "flexible": self.flexible.to_json(),
            "ratio": self.ratio(),
            "meaning": self.meaning(),
            "seconds": dict(self.seconds),
        }

    def with_responses(self, change: Change) -> Comparison:
        """Return the same with both responses changed."""
        return replace(self, rigid=change(self.rigid), flexible=change(self.flexible))

    def _ratio(self, of: Quantity) -> float | None:
        block, dam = (each.summary.get(of.key) for each in (self.rigid, self.flexible))
        if block is None or dam is None or not self.ok or abs(block) < of.least:
            return None
        return float(dam / block)


def compare(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
    block: Literal["rigid", "decoupled"] = "rigid",
) -> Comparison:
    """Run two models on a case: the flexible one and `block`, which knows a rigid part above the crack. Parameters and
    errors are those of :func:`heeltoe.flexible` and :func:`heeltoe.decoupled`."""
    shaking = earthquake(case, motion, vertical)
    began = perf_counter()
    stiff = run(case, block, shaking.motion, shaking.vertical, output_step=output_step)
    between = perf_counter()
    dam = flexible(case, shaking.motion, shaking.vertical, output_step=output_step)
    return Comparison(stiff, dam, {block: between - began, "flexible": perf_counter() - between})
