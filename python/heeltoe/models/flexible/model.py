"""The flexible model: case -> two elastic parts in their modes -> kernel -> response."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.read import Case, case_warnings
from heeltoe.case.shaking import resolve
from heeltoe.errors import InputError
from heeltoe.mechanics.block import build_block
from heeltoe.models.flexible.history import CrackHistory
from heeltoe.models.flexible.inside import longest_step
from heeltoe.models.flexible.modes import part_periods
from heeltoe.models.flexible.reduced import FlexibleDam, build_flexible_dam
from heeltoe.models.flexible.references import REFERENCES
from heeltoe.models.rigid.model import static_state
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground, step_ends, step_means
from heeltoe.result.response import Energy, Response, check_limits

Floats = NDArray[np.float64]

#: A blow lasts about as long as the part above the crack takes for one vibration; the step is this part of it.
_STEPS_PER_PERIOD = 100.0
_SHORTEST_STEP, _LONGEST_STEP = 5e-5, 2e-4
#: What acts in the crack may ask for a shorter one, down to this.
_SHORTEST_OF_ALL = 1e-5
#: So closely the program's own step follows it, as from a sixteenth on the contact problem is next to singular; and so
#: closely at least a given one must.
_ENOUGH_STEPS, _FEWEST_STEPS = 30.0, 8.0
#: Frames kept: enough for an animation, few enough for memory.
_FRAME_STEP = 0.01
_SHORTEST_FRAME_STEP = 1e-3
_HALVINGS = 2
#: By how much half the step may change the slip: more at a height, where the dam strikes and bounces.
_CHANGE_AT_BASE, _CHANGE_AT_HEIGHT = 0.03, 0.10
#: Slips that differ by less than this differ by nothing anyone could measure [m].
_NOTHING = 1e-4

ADVICE = {
    "unstable": (
        "the dam slides under its static loads alone, and goes on for as long as the run lasts; give it more friction, "
        "less uplift or less water until it stands before the earthquake"
    ),
    "lost": "the part above the crack has gone over 100 crack widths away: the dam has failed; see its static safety",
    "blown up": (
        'energy came from nothing, as penalties can make it; use flexible.contact = "coulomb" or a smaller time_step'
    ),
}


@dataclass(frozen=True)
class Convergence:
    """Evidence that the time step is small enough.

    Attributes
    ----------
    time_step
        Of the result [s].
    coarser_step
        That of the run it is compared with, twice as long [s].
    slip, coarser_slip
        Residual slips of both [m].
    allowed
        By how much of the slip they may differ.
    """

    time_step: float
    coarser_step: float
    slip: float
    coarser_slip: float
    allowed: float

    @property
    def change(self) -> float:
        """Difference over the slip, or over 0.1 mm where the slip is less than that says anything."""
        return abs(self.slip - self.coarser_slip) / max(abs(self.slip), _NOTHING / self.allowed)

    @property
    def reached(self) -> bool:
        """Whether the difference is small enough."""
        return self.change <= self.allowed


def flexible(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
    dam: FlexibleDam | None = None,
) -> Response:
    """Run the flexible model on a case.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    motion, vertical
        Ground motions to use, as they are, instead of the case's [m/s2, downstream and upward].
    output_step
        Spacing of the histories [s]; 0.01 s where it is not given. It does not change the motion that is computed.
    dam
        The case's dam, built before; saves the set-up in studies of one dam.

    Returns
    -------
    Response
        With a :class:`~heeltoe.models.flexible.history.CrackHistory` in ``crack``.

    Raises
    ------
    InputError
        Where the case has no motion, no modulus or a mesh or a step that cannot be used.
    """
    if motion is None:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, vertical = resolve(case.motion, case.gravity, case.base_directory)
    end = case.motion.duration if case.motion and case.motion.duration else motion.duration
    if output_step is not None and not _SHORTEST_FRAME_STEP <= output_step <= end:
        raise InputError(
            "frame-step", "output_step", f"{output_step:g} s", shortest=f"{_SHORTEST_FRAME_STEP:g} s", end=f"{end:g} s"
        )
    dam = dam or build_flexible_dam(case)
    shaken = Shaken(case, dam, motion, vertical, end)
    raw, frames, convergence = _converged(shaken, output_step or min(_FRAME_STEP, end))
    outcome = _kernel.CRACK_OUTCOMES[int(raw["outcome"])]
    block = build_block(case)
    safety = block.sliding_safety_factor
    # Anchors with stiffness hold what friction does not.
    if outcome == "ok" and safety is not None and safety < 1.0 and not dam.anchors:
        outcome = "unstable"
    record = _history(frames, dam, case.flexible.contactors)
    advice = ADVICE.get(outcome)
    summary = _summary(raw, dam, shaken, convergence)
    if case.anchors:
        summary["anchors"] = _anchors(case, raw)
    summary["uplift_during_shaking"] = case.uplift.during_shaking
    return Response(
        model="flexible",
        title=case.title,
        outcome=outcome,
        advice=advice and f"stopped at {raw['end_time']:.3f} s with slip {raw['slip']:.4g} m: {advice}",
        warnings=(
            *case_warnings(case),
            *motion.warnings,
            *_warnings(case, dam, raw, record, convergence, safety, _last_change(frames[0])),
        ),
        summary=summary,
        energy=_energy(raw),
        motion=motion,
        vertical=vertical,
        gravity=case.gravity,
        histories=_histories(frames[0], shaken),
        mode=tuple(_kernel.CRACK_STATES[int(state)] for state in frames[0][:, _FRAME["state"]]),
        event_log={},
        static=static_state(block),
        references=_references(case, dam),
        crack=record,
        limits=check_limits(case.limits, summary),
    )


_FRAME = {name: place for place, name in enumerate(_kernel.FRAME_FIELDS)}
# The tables that the kernel returns beside the summary: frames, positions above and below, forces, status, modes.
_Frames = tuple[Floats, Floats, Floats, Floats, NDArray[np.uint8], Floats, Floats]


class Shaken:
    """A dam with its earthquake, ready to run at any step."""

    def __init__(
        self, case: Case, dam: FlexibleDam, motion: GroundMotion, vertical: GroundMotion | None, end: float
    ) -> None:
        self.case, self.dam, self.end = case, dam, end
        self.time, self.horizontal, self.up = ground(motion, vertical, end)

    def first_step(self) -> float:
        """Return the step of the case, or one that follows the vibration of the part above the crack [s].

        Raises
        ------
        InputError
            Where the step of the case is too long to follow it, or what acts in the crack is too stiff for any step.
        """
        period = float(part_periods(self.dam.modes[0], 1)[0])
        given = self.case.flexible.time_step
        shortest = max(_SHORTEST_OF_ALL, min(_SHORTEST_STEP, period / _ENOUGH_STEPS))
        wanted = given or float(np.clip(period / _STEPS_PER_PERIOD, shortest, _LONGEST_STEP))
        dam = self.dam
        step, field = longest_step(dam.parts, dam.water, dam.anchors, self.case.flexible.theta, wanted)
        if step < (wanted if given else _SHORTEST_OF_ALL):
            raise InputError("step-stiff", field, step=f"{step:.2g} s")
        if given is None:
            return step
        if given > period / _FEWEST_STEPS:
            raise InputError(
                "time-step-long", "flexible.time_step", f"{given:g} s", longest=f"{period / _FEWEST_STEPS:.2g} s"
            )
        return given

    def run(self, step: float, frame_step: float | None = None) -> tuple[Floats, _Frames]:
        """Run at about this step, which is made to fit the duration [s]; with frames about every `frame_step`."""
        count = max(1, round(self.end / step))
        step = self.end / count
        options = self.case.flexible
        stride = 0 if frame_step is None else max(1, min(count, round(frame_step / step)))
        result = self.dam.kernel.run(
            self._ground(count), step, options.theta, stride, stride > 0, (1.0, 1.0), self._penalty()
        )
        return result[0], result[1:]

    def run_scaled(self, step: float, scales: Floats) -> dict[str, Floats]:
        """Run once for each factor on the ground motion, side by side; (n,) arrays by name."""
        count = max(1, round(self.end / step))
        pairs = [(float(scale), float(scale)) for scale in scales]
        rows = self.dam.kernel.run_many(
            self._ground(count), self.end / count, self.case.flexible.theta, pairs, 0, self._penalty()
        )
        return {name: rows[:, k] for k, name in enumerate(_kernel.CRACK_SUMMARY_FIELDS)}

    def _ground(self, count: int) -> Floats:
        """Return what the kernel needs to know of the ground in `count` steps."""
        series = step_ends if self.case.flexible.contact == "idce" else step_means
        return series(self.time, self.horizontal, self.up, count, self.end)

    def _penalty(self) -> tuple[float, float, float] | None:
        """Return stiffness, gamma and beta of the penalty method; None for exact contact."""
        options = self.case.flexible
        if options.contact != "idce":
            return None
        stiffest = max(float(body.stiffness.diagonal().max()) for body in self.dam.bodies)
        gamma, beta = options.newmark_gamma, options.newmark_beta
        return options.penalty_factor * stiffest, gamma, (gamma + 0.5) ** 2 / 4.0 if beta is None else beta


def _converged(shaken: Shaken, frame_step: float) -> tuple[dict[str, float], _Frames, Convergence | None]:
    """Run until half the step changes little, or once where no evidence is wanted."""
    case = shaken.case
    step = shaken.first_step()
    if not case.flexible.convergence_check:
        row, frames = shaken.run(step, frame_step)
        return _named(row), frames, None
    allowed = _CHANGE_AT_BASE if shaken.dam.dam.lower is None else _CHANGE_AT_HEIGHT
    # The kernel lets go of the interpreter: the longer run takes one core, the shorter the other.
    with ThreadPoolExecutor(2) as pool:
        coarse = pool.submit(shaken.run, step)
        row, frames = shaken.run(step / 2.0, frame_step)
        coarser = _named(coarse.result()[0])
    for halving in range(_HALVINGS + 1):
        raw = _named(row)
        evidence = Convergence(step / 2.0, step, raw["slip"], coarser["slip"], allowed)
        if evidence.reached or case.flexible.time_step is not None or halving == _HALVINGS:
            break
        step /= 2.0
        coarser = raw
        row, frames = shaken.run(step / 2.0, frame_step)
    return raw, frames, evidence


def _named(row: Floats) -> dict[str, float]:
    """Return the summary by name; the tensions of anchors with stiffness are counted from 0."""
    names = [*_kernel.CRACK_SUMMARY_FIELDS, *(f"tension_{k}" for k in range(len(row)))]
    return dict(zip(names, row.tolist(), strict=False))


def _anchors(case: Case, raw: dict[str, float]) -> list[dict[str, float | None]]:
    """Return the largest tension [N] of each anchor, and what it is good for."""
    stiff = 0
    found: list[dict[str, float | None]] = []
    for anchor in case.anchors:
        tension = anchor.prestress
        if anchor.axial_stiffness or anchor.shear_stiffness:
            tension = raw[f"tension_{stiff}"]
            stiff += 1
        found.append({"distance_m": anchor.distance, "peak_tension_n": tension, "capacity_n": anchor.capacity})
    return found


def _history(frames: _Frames, dam: FlexibleDam, contactors: int) -> CrackHistory:
    rows, upper, lower, force, status, above, below = frames
    count = len(rows)

    def pairs(table: Floats) -> Floats:
        return table.reshape(count, 2, -1)

    return CrackHistory(
        time=np.ascontiguousarray(rows[:, 0]),
        upper_position=pairs(upper),
        lower_position=pairs(lower) if lower.size else None,
        force=pairs(force),
        status=status,
        modes=(above, below)[: len(dam.modes)],
        dam=dam,
        contactors=contactors,
    )


def _summary(
    raw: dict[str, float], dam: FlexibleDam, shaken: Shaken, convergence: Convergence | None
) -> dict[str, Any]:
    return {
        "residual_slip_m": raw["slip"],
        "peak_slip_downstream_m": raw["slip_max"],
        "peak_slip_upstream_m": raw["slip_min"],
        "rocking_downstream_rad": abs(raw["rotation_min"]),
        "rocking_upstream_rad": abs(raw["rotation_max"]),
        "opening_upstream_m": raw["opening_heel"],
        "opening_downstream_m": raw["opening_toe"],
        "largest_gap_heel_m": raw["opening_heel"],
        "largest_gap_toe_m": raw["opening_toe"],
        "slip_by_mode_m": {
            "sliding": raw["slip_sliding"],
            "slide_rocking": raw["slip_slide_rocking"],
            "drifting": raw["slip_drifting"],
        },
        "time_by_mode_s": {
            name.replace("-", "_"): raw[f"time_{name.replace('-', '_')}"] for name in _kernel.CRACK_STATES
        },
        "impacts": int(raw["impacts"]),
        "largest_impact_velocity_m_s": raw["largest_impact_velocity"],
        "peak_normal_force_n": raw["peak_normal_force"],
        "final_mode": _kernel.CRACK_STATES[int(raw["final_state"])],
        "final_slip_velocity_m_s": raw["slip_velocity"],
        "end_time_s": raw["end_time"],
        "crack_width_m": dam.section.crack_width,
        "periods_s": dam.periods.tolist(),
        "mesh": {
            "elements": [len(body.mesh.elements) for body in dam.bodies],
            "nodes": [len(body.mesh.nodes) for body in dam.bodies],
            "modes": [int(basis.omega_squared.size) for basis in dam.modes],
            "crack_nodes": int(dam.dam.upper.mesh.crack.size),
            "basis_error": dam.basis_error,
        },
        "damping": shaken.case.flexible.damping,
        "damping_ratio": shaken.case.concrete.damping,
        "rayleigh_mass_1_s": dam.coefficients[0] if dam.coefficients else None,
        "rayleigh_stiffness_s": dam.coefficients[1] if dam.coefficients else None,
        "contact": shaken.case.flexible.contact,
        "steps": int(raw["steps"]),
        "time_step_s": raw["end_time"] / raw["steps"],
        "contact_iterations_per_step": raw["iterations"] / raw["steps"],
        "contact_residual": raw["contact_residual"],
        "convergence": None
        if convergence is None
        else {
            "time_step_s": convergence.time_step,
            "coarser_step_s": convergence.coarser_step,
            "residual_slip_m": convergence.slip,
            "coarser_residual_slip_m": convergence.coarser_slip,
            "change": convergence.change,
            "allowed": convergence.allowed,
        },
    }


def _energy(raw: dict[str, float]) -> Energy:
    return Energy(
        input_j=raw["energy_input"],
        friction_j=raw["energy_friction"],
        impact_j=raw["energy_impact"],
        kinetic_j=raw["energy_stored"] + raw["energy_penalty"] - raw["energy_start"],
        residual=raw["energy_residual"],
        damping_j=raw["energy_damping"],
        numerical_j=raw["energy_numerical"],
        gained_j=raw["energy_gained"],
    )


def _histories(rows: Floats, shaken: Shaken) -> dict[str, Floats]:
    def column(name: str) -> Floats:
        return np.ascontiguousarray(rows[:, _FRAME[name]])

    time = column("time")
    result = {"time_s": time, "ground_acceleration_m_s2": np.interp(time, shaken.time, shaken.horizontal)}
    if shaken.up is not None:
        result["vertical_ground_acceleration_m_s2"] = np.interp(time, shaken.time, shaken.up)
    return result | {
        "slip_m": column("slip"),
        "slip_velocity_m_s": column("slip_velocity"),
        "gap_heel_m": column("opening_heel"),
        "gap_toe_m": column("opening_toe"),
        "rotation_rad": column("rotation"),
        "normal_force_n": column("normal_force"),
        "friction_force_n": column("friction_force"),
        "touching": column("touching"),
        "stored_energy_j": column("energy_stored"),
        "input_energy_j": column("energy_input"),
        "damping_energy_j": column("energy_damping"),
        "friction_energy_j": column("energy_friction"),
        "impact_energy_j": column("energy_impact"),
    }


def _warnings(
    case: Case,
    dam: FlexibleDam,
    raw: dict[str, float],
    record: CrackHistory,
    convergence: Convergence | None,
    safety: float | None,
    last_change: float,
) -> list[str]:
    said = []
    if convergence is None:
        said.append("flexible.convergence_check is off: nothing shows that the time step is small enough")
    elif not convergence.reached:
        said.append(
            f"the residual slip has not converged: {1e3 * convergence.coarser_slip:.4g} mm with a step of "
            f"{convergence.coarser_step:.3g} s, {1e3 * convergence.slip:.4g} mm with half of it (allowed "
            f"{100.0 * convergence.allowed:g} %); read it with its spread"
        )
    if safety is not None and safety < 1.0 and dam.anchors:
        said.append(
            "friction and prestress alone do not hold the dam before the earthquake (sliding safety factor "
            f"{safety:.3f}): it begins by sliding until its anchors hold it"
        )
    elif safety is not None and safety < 1.0:
        said.append(
            f"the dam slides under its static loads alone (sliding safety factor {safety:.3f}): its slip grows as long "
            "as the run lasts"
        )
    full = case.reservoir is not None and dam.section.water_above_crack(case.reservoir) > 0.9 * dam.section.height
    if case.concrete.damping < 0.005 and full:
        said.append(
            "concrete.damping: with hardly any damping under a full reservoir the dam creeps downstream for as long as "
            "it vibrates; the slip says little"
        )
    if case.concrete.poisson > 0.35:
        said.append(f"concrete.poisson: {case.concrete.poisson:g} is unusual for concrete")
    modulus = case.concrete.modulus or 0.0
    if not 5e9 <= modulus <= 1e11:
        said.append(f"concrete.modulus: {modulus / 1e9:.4g} GPa is not that of concrete")
    if dam.basis_error > 0.02:
        said.append(
            f"the modes kept leave an error of {100.0 * dam.basis_error:.2g} % in the flexibility of the crack; raise "
            "flexible.modes"
        )
    if raw["outcome"] == 0.0 and last_change > _NOTHING:
        said.append(
            "the dam still moves when the run ends: in the last second its slip changes by "
            f"{1e3 * last_change:.3g} mm; the residual slip is that of this moment, and a longer motion.duration lets "
            "it come to rest"
        )
    for number, anchor in enumerate(_anchors(case, raw), start=1):
        tension, capacity = anchor["peak_tension_n"] or 0.0, anchor["capacity_n"]
        if capacity is not None and tension > capacity:
            said.append(
                f"anchor {number} is pulled with {tension / 1e3:.4g} kN/m, beyond its capacity of "
                f"{capacity / 1e3:.4g} kN/m, and would have yielded; the result takes it for elastic"
            )
    if case.analysis.rotation != "small":
        said.append(
            f'analysis.rotation = "{case.analysis.rotation}" has no say here: it is of the rigid block, and the '
            "rotations of the flexible model are small"
        )
    depth = record.deepest_penetration()
    if depth > 1e-3 * dam.section.crack_width:
        said.append(
            f"the crack faces penetrate each other by up to {1e3 * depth:.3g} mm where no node is watched (contactors "
            f"of type {case.flexible.contactors}); types 3 to 5 prevent it"
        )
    if raw["contact_residual"] > 1e-6:
        said.append(
            f"contact holds only to {raw['contact_residual']:.1e} of the impulse: give a shorter flexible.time_step"
        )
    if raw["energy_residual"] > 1e-9:
        said.append(f"the energy ledger does not close: residual {raw['energy_residual']:.1e} of the turnover")
    if raw["energy_gained"] > 1e-4 * raw["energy_turnover"]:
        said.append(
            f"contact has made energy out of nothing, {raw['energy_gained']:.3g} J in a turnover of "
            f"{raw['energy_turnover']:.3g} J, as a penalty does at every blow: compare with another time_step and with "
            'flexible.contact = "coulomb"'
        )
    largest = max(-raw["rotation_min"], raw["rotation_max"])
    if largest > 0.1:
        said.append(f"the largest rotation is {largest:.3g} rad; the model is one of small rotations")
    return said


def _last_change(rows: Floats) -> float:
    """Return by how much the slip changes in the last second of a run [m]."""
    time, slip = rows[:, _FRAME["time"]], rows[:, _FRAME["slip"]]
    return float(np.ptp(slip[time >= time[-1] - 1.0]))


def _references(case: Case, dam: FlexibleDam) -> tuple[str, ...]:
    keys = ["model", case.flexible.contact]
    if dam.dam.upper.mass.sum() > dam.dam.upper.mass_concrete.sum() * (1.0 + 1e-12):
        keys.append("water")
    if dam.water is not None:
        keys.append(case.uplift.during_shaking)
    return tuple(REFERENCES[key] for key in keys)
