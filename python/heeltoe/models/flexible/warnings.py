"""What a reader of a flexible run must know, and what to do where it stopped."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from heeltoe.case.model import Case
from heeltoe.mechanics.loads import water_above_crack
from heeltoe.models.flexible.history import CrackHistory
from heeltoe.models.flexible.reduced import FlexibleDam
from heeltoe.models.flexible.shaken import NOTHING, Convergence
from heeltoe.models.flexible.tables import FRAME, anchors_of

Floats = NDArray[np.float64]

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


def warnings_of(
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
    full = case.reservoir is not None and water_above_crack(case, case.reservoir) > 0.9 * dam.section.height
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
    if raw["outcome"] == 0.0 and last_change > NOTHING:
        said.append(
            "the dam still moves when the run ends: in the last second its slip changes by "
            f"{1e3 * last_change:.3g} mm; the residual slip is that of this moment, and a longer motion.duration lets "
            "it come to rest"
        )
    for number, anchor in enumerate(anchors_of(case, raw), start=1):
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


def last_change(rows: Floats) -> float:
    """Return by how much the slip changes in the last second of a run [m]."""
    time, slip = rows[:, FRAME["time"]], rows[:, FRAME["slip"]]
    return float(np.ptp(slip[time >= time[-1] - 1.0]))
