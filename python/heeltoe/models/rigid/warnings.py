"""What a reader of a rigid run must know, and what to do where it stopped."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.model import Case
from heeltoe.mechanics.block import Block
from heeltoe.models.rigid.varying import varies

Floats = NDArray[np.float64]

ADVICE = {
    "unstable": "give the dam more friction, less uplift or less water until it stands before the earthquake",
    "paradox": (
        'no motion agrees with Coulomb friction here (Painlevé); set analysis.paradox = "tangential impact" to let the '
        "sliding corner jam, or use the flexible model"
    ),
    "event limit": "lower crack.restitution, shorten motion.duration or raise analysis.event_limit",
    "cycling": "report this case: events followed each other without time passing, which should not happen",
}


# A block that rotates by more than this part of what would overturn it is pulled back noticeably less by its weight.
_SHARE_OF_SLENDERNESS = 0.1


# Less slip [m] changes no decision.
_SLIP_TO_TALK_ABOUT = 1e-3


# A slip of this part of the crack's width takes as much off what the block stands on.
_SHARE_OF_WIDTH = 0.1


def advice_of(outcome: str, raw: dict[str, float], block: Block) -> str | None:
    if outcome in ("ok", "overturned"):
        return None
    if outcome == "unstable":
        return f"{_instability(block)}: {ADVICE[outcome]}"
    mode = _kernel.MODES[int(raw["final_mode"])]
    state = (
        f"stopped at {raw['end_time']:.6f} s in mode {mode!r} with slip {raw['slip']:.6g} m at "
        f"{raw['slip_velocity']:.6g} m/s, heel gap {raw['gap_heel']:.6g} m, toe gap {raw['gap_toe']:.6g} m"
    )
    return f"{state}: {ADVICE[outcome]}"


def _instability(block: Block) -> str:
    """Say what moves the dam before any earthquake, and by how much."""
    if block.normal_force <= 0.0:
        return "the water pressure below the dam is more than its weight: it floats"
    reasons = []
    factor = block.sliding_safety_factor
    if factor is not None and factor < 1.0:
        reasons.append(f"it slides under its static loads alone (sliding safety factor {factor:.3f})")
    position = block.resultant_position
    if position is not None and not 0.0 <= position <= block.width:
        corner = "toe" if position > block.width else "heel"
        reasons.append(
            f"it overturns about its {corner} under its static loads alone (resultant {position:.2f} m from the heel, "
            f"crack {block.width:.2f} m wide)"
        )
    return " and ".join(reasons) or "its static loads are at the limit of friction or of overturning"


def warnings_of(case: Case, raw: dict[str, float], outcome: str, block: Block, tension: Floats) -> list[str]:
    said = []
    if outcome == "ok" and _kernel.MODES[int(raw["final_mode"])] != "rest":
        said.append(
            f"the block still moves when the run ends (slip velocity {raw['slip_velocity']:.3g} m/s): the residual "
            "slip is that of this moment; a longer motion.duration lets it come to rest"
        )
    if raw["energy_limited_impacts"]:
        said.append(
            f"{int(raw['energy_limited_impacts'])} impact(s) would have created energy with the restitution "
            "given; theirs was lowered to the largest that does not"
        )
    if raw["jams"]:
        said.append(
            f"{int(raw['jams'])} Painlevé paradox(es) were resolved by a tangential impact, as analysis.paradox asks"
        )
    largest = max(raw["slip_max"], -raw["slip_min"])
    in_the_air, sliding = abs(raw["slip_drifting"]), abs(raw["slip_sliding"]) + abs(raw["slip_slide_rocking"])
    if case.crack.restitution > 0.0 and in_the_air > max(sliding, _SLIP_TO_TALK_ABOUT):
        said.append(
            f"most of the slip, {1e3 * in_the_air:.4g} mm, happens in the air after blows that rebound by "
            f"crack.restitution = {case.crack.restitution:g}: compare with 0, which may leave a small part of it"
        )
    if outcome == "ok" and largest > block.width:
        said.append(
            f"the block slides {largest:.3g} m, farther than its crack of {block.width:.3g} m is wide: it has left "
            "what it stood on, and the slip means failure, not a length"
        )
    elif outcome == "ok" and largest > _SHARE_OF_WIDTH * block.width:
        said.append(
            f"the block slides {100.0 * largest / block.width:.2g} % of the width of its crack: loads, contact and "
            "uplift are those of the place where it began; heeltoe statics --slip judges where it ends"
        )
    # Integration is exact to a part of the crack's width, of which tiny motions are a tiny part.
    if raw["energy_residual"] > (1e-6 if varies(case) else 1e-9):
        said.append(f"the energy ledger does not close: residual {raw['energy_residual']:.1e} of the turnover")
    for anchor, peak in zip(case.anchors, tension, strict=True):
        if anchor.capacity is not None and peak > anchor.capacity:
            said.append(
                f"the anchor {anchor.distance:g} m from the heel is pulled with {peak / 1e6:.3g} MN/m, which is more "
                f"than its capacity of {anchor.capacity / 1e6:.3g} MN/m: it is taken to hold all the same"
            )
    if case.analysis.rotation == "small":
        for rotation, distance, corner in (
            (-raw["rotation_min"], block.toe_distance, "toe"),
            (raw["rotation_max"], block.heel_distance, "heel"),
        ):
            slenderness = math.atan2(distance, block.height)
            if rotation > _SHARE_OF_SLENDERNESS * slenderness:
                said.append(
                    f"it rotates by {rotation:.3g} rad about its {corner}, {100.0 * rotation / slenderness:.2g} % of "
                    f'the {slenderness:.3g} rad at which it would overturn: set analysis.rotation = "finite", since '
                    "small rotations know nothing of overturning"
                )
    return said
