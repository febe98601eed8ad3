"""Two models on one case: the numbers of the better one beside those of the simpler one, and the meaning of their
difference."""

from __future__ import annotations

from collections.abc import Sequence

from heeltoe.result.contract import HEADLINES, RESIDUAL_SLIP
from heeltoe.result.quantity import Quantity
from heeltoe.result.record import ResponseData
from heeltoe.units.sentences import Sentence
from heeltoe.units.write import angle, length

# From which ratio on the models differ by more than the flexible one is known to differ from its references.
_CLOSE = 1.25
# Less between two models is no difference. Half a millimetre of slip or opening is what the widths of cracks are told
# apart by when a dam is inspected. A rotation of a milliradian is 1 cm at the crest of a top of 10 m; what less of it
# opens along a wide crack is an opening, and compared as such.
_SAME_M, _SAME_RAD = 5e-4, 1e-3
# A slip of less is none that matters to a dam [m].
_LITTLE = 1e-3
_LITTLE_IN_WORDS = {"si": "a millimetre", "us": "0.04 in"}

_TABLE = Sentence.of(
    "Zhu 2004, table 7.8: a dam of {moduli_pa:g GPa} slides {slips_m:g mm}, a rigid block {slip_m:g mm}",
    moduli_pa=(20e9, 200e9, 2000e9, 20000e9),
    slips_m=(0.218, 0.094, 0.052, 0.037),
    slip_m=0.036,
)
# Why the elastic dam slides another way than a block.
_ADDS = "its own vibration adds to the shaking, which a rigid block leaves out"
_CHAIN = (
    "in the decoupled chain the part below vibrates as if the top never slid or rocked, and the top does not vibrate "
    "itself"
)
_BLOCKS = {"rigid": "rigid block", "decoupled": "decoupled top"}


def ratio(dam: ResponseData, block: ResponseData) -> dict[str, float | None]:
    """Return dam over block for slips, rotations and openings; None where the block has next to nothing."""
    return {headline.key: _ratio(headline, dam, block) for headline in HEADLINES}


def differing(dam: ResponseData, block: ResponseData) -> tuple[Quantity, ...]:
    """Return the headline numbers in which two models do not agree.

    They agree in a number where the larger is at most 1.25 times the smaller, with the same sign, or where they are
    less than 0.5 mm or 1 mrad apart.
    """
    return tuple(headline for headline in HEADLINES if not _agree(headline, dam, block))


def meaning(dam: ResponseData, block: ResponseData, units: str = "si", *, brief: bool = False) -> str:
    """Say in a sentence or two what the difference means, in units ``"si"`` or ``"us"``.

    A brief meaning leaves out the reason and the source.
    """
    failed = [response.model for response in (block, dam) if not response.ok]
    if failed:
        return f"There is nothing to compare: no result to trust from the {' and the '.join(failed)} model."
    apart = differing(dam, block)
    if not apart:
        return _agreement(block)
    others = [headline for headline in apart if headline is not RESIDUAL_SLIP]
    if RESIDUAL_SLIP not in apart:
        alike = "end" if any(headline.kind == "slip" for headline in apart) else "slide"
        return f"They {alike} alike, but {_most(others, dam, block, units)}. Trust the flexible model."
    far, near = (abs(RESIDUAL_SLIP.of(response)) for response in (dam, block))
    if max(far, near) < _LITTLE:
        text = f"Both say that the dam slides by less than {_LITTLE_IN_WORDS[units]} in the end"
        if not others:
            return f"{text}."
        return f"{text}, but they {_most(others, dam, block, units)}. Trust the flexible model."
    text, reason, source = _slips_differ(dam, block)
    if brief:
        return f"{text}. Trust the flexible model."
    return f"{text}: {reason}. Trust the flexible model{f' ({_TABLE.text(units)})' if source else ''}."


def _most(apart: Sequence[Quantity], dam: ResponseData, block: ResponseData, units: str) -> str:
    """Name the length that differs by the most metres; a rotation where no length differs."""
    most = max(apart, key=lambda of: (of.kind != "rotation", abs(of.of(dam) - of.of(block))))
    return f"differ in the {_numbers_of(most, dam, block, units)}"


def _agree(of: Quantity, dam: ResponseData, block: ResponseData) -> bool:
    one, other = (of.of(response) for response in (dam, block))
    if abs(one - other) < (_SAME_RAD if of.kind == "rotation" else _SAME_M):
        return True
    low, high = sorted((abs(one), abs(other)))
    return one * other > 0.0 and high <= _CLOSE * low


def _agreement(block: ResponseData) -> str:
    text = "They agree in slips, rotations and openings"
    if block.model == "decoupled":
        return f"{text}: the part below shakes the top as if the top never slid on it."
    return f"{text}: the dam is so stiff against this shaking that a rigid block says what it does."


def _numbers_of(of: Quantity, dam: ResponseData, block: ResponseData, units: str) -> str:
    """Return a number of both models: elastic dam and block."""
    # Adding zero makes a negative zero a plain one.
    values = [of.way * of.of(response) + 0.0 for response in (dam, block)]
    one, other = (angle(value) if of.kind == "rotation" else length(value, units) for value in values)
    return f"{of.label} ({one} of the flexible dam, {other} of the {_BLOCKS[block.model]})"


def _slips_differ(dam: ResponseData, block: ResponseData) -> tuple[str, str, bool]:
    """Say how the slips differ and why, and whether a source shows it."""
    far, near = (abs(RESIDUAL_SLIP.of(response)) for response in (dam, block))
    opposite = RESIDUAL_SLIP.of(dam) * RESIDUAL_SLIP.of(block) < 0.0
    if block.model == "decoupled":
        return _slips_of_the_chain(far, near, opposite), _CHAIN, False
    if opposite:
        return "They slide opposite ways", "the dam's own vibration decides here", False
    if near < _LITTLE:
        return "Only the flexible dam slides", _ADDS, True
    if far > near:
        return f"The flexible dam slides {far / near:.2g} times as far", _ADDS, True
    share = f"{far / near:.2g} times" if far > 0.01 * near else "less than a hundredth of"
    text = f"The flexible dam slides only {share} what the rigid block does"
    return text, "its own vibration works against the shaking here", False


def _slips_of_the_chain(far: float, near: float, opposite: bool) -> str:
    """Say how they differ where the block was shaken by the part below it."""
    if opposite:
        return "They slide opposite ways"
    if far < 0.01 * near:
        return "The flexible dam slides less than a hundredth of what the decoupled top does"
    if near < 0.01 * far:
        return "The decoupled top slides less than a hundredth of what the flexible dam does"
    return f"The flexible dam slides {far / near:.2g} times as far as the decoupled top"


def _ratio(of: Quantity, dam: ResponseData, block: ResponseData) -> float | None:
    if not (dam.ok and block.ok) or abs(of.of(block)) < of.least:
        return None
    return of.of(dam) / of.of(block)
