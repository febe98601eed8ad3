"""The rigid model: case -> block -> kernel -> response."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.read import Case, case_warnings
from heeltoe.case.shaking import resolve
from heeltoe.errors import InputError
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.rigid.varying import varies, varying
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground, on_same_moments
from heeltoe.result.response import Energy, Response, check_limits

Floats = NDArray[np.float64]

#: Bounces slower than this times sqrt(g' B) end the bouncing, g' the effective weight per mass and B the width of the
#: crack: some 1e-6 m/s for a dam, whose further bounces would stay below 1e-13 m.
SETTLE = 1e-7

ADVICE = {
    "unstable": "give the dam more friction, less uplift or less water until it stands before the earthquake",
    "paradox": (
        'no motion agrees with Coulomb friction here (Painlevé); set analysis.paradox = "tangential impact" to let the '
        "sliding corner jam, or use the flexible model"
    ),
    "event limit": "lower crack.restitution, shorten motion.duration or raise analysis.event_limit",
    "cycling": "report this case: events followed each other without time passing, which should not happen",
}

REFERENCES = {
    "model": (
        'X. Zhu, "Seismic Behavior of Cracked Concrete Gravity Dams", PhD thesis, Concordia University, Montréal, '
        "2004, chapters IV and V"
    ),
    "water": (
        'H. M. Westergaard, "Water pressures on dams during earthquakes", Transactions of the ASCE 98 (1933), 418-433'
    ),
    "rocking": (
        'G. W. Housner, "The behavior of inverted pendulum structures during earthquakes", Bulletin of the '
        "Seismological Society of America 53 (1963), 403-417"
    ),
    "overturning": (
        'J. Zhang and N. Makris, "Rocking response of free-standing blocks under cycloidal pulses", Journal of '
        "Engineering Mechanics, ASCE 127 (2001), 473-483"
    ),
    "integration": (
        "E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential Equations I, 2nd edition, Springer, "
        "1993 (DOP853)"
    ),
    "zero while open": (
        "US Bureau of Reclamation, Design of Small Dams, 3rd edition, 1987, chapter 8 (no uplift in a crack that opens "
        "in the earthquake)"
    ),
    "full while open": (
        'M. Leclerc, P. Léger and R. Tinawi, "Computer aided stability analysis of gravity dams: CADAM", Advances in '
        "Engineering Software 34 (2003), 403-420"
    ),
    "follows opening": (
        'F. Javanmardi, P. Léger and R. Tinawi, "Seismic structural stability of concrete gravity dams considering '
        'transient uplift pressures in cracks", Engineering Structures 27 (2005), 616-628'
    ),
}

# A block that rotates by more than this part of what would overturn it is pulled back noticeably less by its weight.
_SHARE_OF_SLENDERNESS = 0.1
# Less slip [m] changes no decision.
_SLIP_TO_TALK_ABOUT = 1e-3
# A slip of this part of the crack's width takes as much off what the block stands on.
_SHARE_OF_WIDTH = 0.1


def rigid(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    rotation: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> Response:
    """Run the rigid model on a case: exactly between events, or where loads or geometry change as the block moves by
    integration between them.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    motion, vertical
        Ground motions to use, as they are, instead of the case's [m/s2, downstream and upward].
    rotation
        Rotation of the ground about the middle of the crack, counter-clockwise [rad/s2].
    output_step
        Spacing of the histories [s]; at the record's samples where it is not given. It does not change the motion
        that is computed, which is exact between events.

    Returns
    -------
    Response

    Raises
    ------
    InputError
        Where the case has no motion, or one that cannot be used.
    """
    if motion is None:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, vertical = resolve(case.motion, case.gravity, case.base_directory)
    block = build_block(case)
    end = case.motion.duration if case.motion and case.motion.duration else motion.duration
    shaking = GroundSeries.of(motion, vertical, rotation, end)
    moments = _moments(shaking.time, output_step)
    summary_row, history, modes, event_rows, tension = run_block(case, block, shaking, moments)
    raw = dict(zip(_kernel.SUMMARY_FIELDS, summary_row.tolist(), strict=True))
    outcome = _kernel.OUTCOMES[int(raw["outcome"])]
    started = outcome != "unstable"
    moments = moments[: modes.size]
    summary = _summary(case, raw, block, tension) if started else {}
    return Response(
        model="rigid",
        title=case.title,
        outcome=outcome,
        advice=_advice(outcome, raw, block),
        warnings=(*case_warnings(case), *motion.warnings, *_warnings(case, raw, outcome, block, tension)),
        summary=summary,
        energy=_energy(raw) if started else None,
        motion=motion,
        vertical=vertical,
        gravity=case.gravity,
        histories=_histories(case, moments, history, shaking, block) if started else {},
        mode=tuple(_kernel.MODES[m] for m in modes) if started else (),
        event_log=_events(event_rows),
        static=static_state(block),
        references=_references(case, block),
        limits=check_limits(case.limits, summary) if started else (),
    )


@dataclass(frozen=True, eq=False)
class GroundSeries:
    """The ground's motion on common moments, as the kernels take it: (n,) each, or None where there is none."""

    time: Floats
    horizontal: Floats
    up: Floats | None
    turning: Floats | None

    @classmethod
    def of(
        cls, motion: GroundMotion, vertical: GroundMotion | None, rotation: GroundMotion | None, end: float
    ) -> GroundSeries:
        """Put the motions on the same moments, from zero to `end`."""
        if rotation is None:
            return cls(*ground(motion, vertical, end), None)
        series = [motion, rotation] if vertical is None else [motion, rotation, vertical]
        time, horizontal, turning, *rest = on_same_moments(series, end)
        return cls(time, horizontal, rest[0] if rest else None, turning)

    def scaled(self, factor: float) -> GroundSeries:
        """Return the same motion, weaker or stronger."""
        up, turning = (None if each is None else factor * each for each in (self.up, self.turning))
        return GroundSeries(self.time, factor * self.horizontal, up, turning)


_Raw = tuple[Floats, Floats, NDArray[np.uint8], Floats, Floats]


def run_block(case: Case, block: Block, shaking: GroundSeries, moments: Floats) -> _Raw:
    """Run the kernel that the case needs; the last array is the largest tension of each anchor [N/m]."""
    jam = case.analysis.paradox == "tangential impact"
    limits = (SETTLE, case.analysis.event_limit, jam)
    if not varies(case) and shaking.turning is None:
        found = _kernel.run_rigid(
            block.parameters(), shaking.time, shaking.horizontal, shaking.up, moments, None, *limits
        )
        return *found, np.array([anchor.prestress for anchor in case.anchors])
    what = varying(case, block)
    return _kernel.run_rigid_varying(
        block.parameters(),
        what.numbers,
        what.rotation,
        what.rule,
        what.pressure,
        what.anchors,
        shaking.time,
        shaking.horizontal,
        shaking.up,
        shaking.turning,
        moments,
        None,
        *limits,
    )


def _moments(time: Floats, step: float | None) -> Floats:
    if step is None:
        return np.unique(time)
    if not 0.0 < step <= time[-1]:
        raise InputError("output-step", "output_step", f"{step:g} s", duration=f"{time[-1]:g} s")
    return np.arange(int(np.floor(time[-1] / step * (1.0 + 1e-12))) + 1, dtype=np.float64) * step


def _summary(case: Case, raw: dict[str, float], block: Block, tension: Floats) -> dict[str, Any]:
    downstream, upstream = -raw["rotation_min"], raw["rotation_max"]
    overturned = _kernel.OUTCOMES[int(raw["outcome"])] == "overturned"
    finite = case.analysis.rotation == "finite"

    def opening(rotation: float) -> float:
        return block.width * (math.sin(min(rotation, math.pi / 2.0)) if finite else rotation)

    return {
        "residual_slip_m": raw["slip"],
        "peak_slip_downstream_m": raw["slip_max"],
        "peak_slip_upstream_m": raw["slip_min"],
        "rocking_downstream_rad": abs(downstream),
        "rocking_upstream_rad": abs(upstream),
        # Rocking downstream, about the toe, opens the crack at the upstream face.
        "opening_upstream_m": opening(abs(downstream)),
        "opening_downstream_m": opening(abs(upstream)),
        "largest_gap_heel_m": raw["largest_gap_heel"],
        "largest_gap_toe_m": raw["largest_gap_toe"],
        "slip_by_mode_m": {
            "sliding": raw["slip_sliding"],
            "slide_rocking": raw["slip_slide_rocking"],
            "drifting": raw["slip_drifting"],
        },
        "time_by_mode_s": {
            "rest": raw["time_rest"],
            "sliding": raw["time_sliding"],
            "rocking": raw["time_rocking"],
            "slide_rocking": raw["time_slide_rocking"],
            "drifting": raw["time_drifting"],
        },
        "impacts": int(raw["impacts"]),
        "largest_impact_velocity_m_s": raw["largest_impact_velocity"],
        "events": int(raw["events"]),
        "final_mode": _kernel.MODES[int(raw["final_mode"])],
        "final_slip_velocity_m_s": raw["slip_velocity"],
        "end_time_s": raw["end_time"],
        "crack_width_m": block.width,
        "rotation": case.analysis.rotation,
        "uplift_during_shaking": case.uplift.during_shaking,
        "overturned_about": ("toe" if downstream > upstream else "heel") if overturned else None,
        "anchors": [
            {"distance_m": anchor.distance, "peak_tension_n": float(peak), "capacity_n": anchor.capacity}
            for anchor, peak in zip(case.anchors, tension, strict=True)
        ],
    }


def _energy(raw: dict[str, float]) -> Energy:
    return Energy(
        input_j=raw["energy_input"],
        friction_j=raw["energy_friction"],
        impact_j=raw["energy_impact"],
        kinetic_j=raw["energy_kinetic"],
        residual=raw["energy_residual"],
    )


def _histories(case: Case, moments: Floats, history: Floats, shaking: GroundSeries, block: Block) -> dict[str, Floats]:
    column = {name: np.ascontiguousarray(history[:, k]) for k, name in enumerate(_kernel.HISTORY_FIELDS)}
    time = shaking.time
    result = {"time_s": moments, "ground_acceleration_m_s2": np.interp(moments, time, shaking.horizontal)}
    if shaking.up is not None:
        result["vertical_ground_acceleration_m_s2"] = np.interp(moments, time, shaking.up)
    if shaking.turning is not None:
        result["ground_rotation_rad_s2"] = np.interp(moments, time, shaking.turning)
    rotation = (column["gap_toe"] - column["gap_heel"]) / block.width
    rate = (column["gap_velocity_toe"] - column["gap_velocity_heel"]) / block.width
    if case.analysis.rotation == "finite":
        # The gaps go with its sine.
        rotation = np.arcsin(np.clip(rotation, -1.0, 1.0))
        rate = rate / np.maximum(np.cos(rotation), 1e-9)
    result |= {
        "slip_m": column["slip"],
        "slip_velocity_m_s": column["slip_velocity"],
        "slip_acceleration_m_s2": column["slip_acceleration"],
        "gap_heel_m": column["gap_heel"],
        "gap_toe_m": column["gap_toe"],
        "rotation_rad": rotation,
        "rotation_velocity_rad_s": rate,
        "friction_force_n": column["friction_force"],
        "normal_force_heel_n": column["normal_force_heel"],
        "normal_force_toe_n": column["normal_force_toe"],
    }
    return result


def _events(rows: Floats) -> dict[str, Any]:
    column = {name: np.ascontiguousarray(rows[:, k]) for k, name in enumerate(_kernel.EVENT_FIELDS)}

    def named(field: str, names: list[str]) -> list[str]:
        return [names[int(k)] for k in column[field]]

    return {
        "time_s": column["time"],
        "kind": named("kind", _kernel.EVENT_KINDS),
        "mode_before": named("mode_before", _kernel.MODES),
        "mode_after": named("mode_after", _kernel.MODES),
        "slip_m": column["slip"],
        "gap_heel_m": column["gap_heel"],
        "gap_toe_m": column["gap_toe"],
        "slip_velocity_m_s": column["slip_velocity"],
        "gap_velocity_heel_m_s": column["gap_velocity_heel"],
        "gap_velocity_toe_m_s": column["gap_velocity_toe"],
        "approach_slip_velocity_m_s": column["approach_slip_velocity"],
        "approach_velocity_heel_m_s": column["approach_velocity_heel"],
        "approach_velocity_toe_m_s": column["approach_velocity_toe"],
        "friction_impulse_n_s": column["impulse_friction"],
        "heel_impulse_n_s": column["impulse_heel"],
        "toe_impulse_n_s": column["impulse_toe"],
        "energy_lost_j": column["energy_lost"],
    }


def static_state(block: Block) -> dict[str, Any]:
    """Return the state under the static loads, by the names of the contract."""
    critical = block.critical_accelerations()
    return {
        "critical_acceleration_g": {
            "sliding": critical.sliding / block.gravity,
            "rocking": critical.rocking / block.gravity,
            "sliding_downstream": critical.sliding_downstream / block.gravity,
            "sliding_upstream": critical.sliding_upstream / block.gravity,
            "rocking_downstream": critical.rocking_downstream / block.gravity,
            "rocking_upstream": critical.rocking_upstream / block.gravity,
        },
        "sliding_safety_factor": block.sliding_safety_factor,
        "resultant_from_heel_m": block.resultant_position,
        "normal_force_n": block.normal_force,
        "horizontal_force_n": block.static.horizontal,
        "concrete_mass_kg": block.concrete_mass,
        "virtual_mass_kg": block.water.mass,
    }


def _advice(outcome: str, raw: dict[str, float], block: Block) -> str | None:
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


def _warnings(case: Case, raw: dict[str, float], outcome: str, block: Block, tension: Floats) -> list[str]:
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


def _references(case: Case, block: Block) -> tuple[str, ...]:
    keys = ["model", "rocking"] + (["water"] if block.water.mass else [])
    if case.analysis.rotation != "small":
        keys.append("overturning")
    if case.uplift.during_shaking in REFERENCES:
        keys.append(case.uplift.during_shaking)
    if varies(case):
        keys.append("integration")
    return tuple(REFERENCES[key] for key in keys)
