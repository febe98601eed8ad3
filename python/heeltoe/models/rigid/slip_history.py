"""State at the end of a crack with a friction law or asperities, by the names of the contract."""

from __future__ import annotations

import math

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.crack.crack import Crack
from heeltoe.case.model import Case
from heeltoe.kernel.block import BlockRun
from heeltoe.kernel.friction import shear_stress
from heeltoe.mechanics.block import Block
from heeltoe.mechanics.friction import coefficients, law_of
from heeltoe.result.numbers import BlockFrictionLaw, Roughness


def law_result(case: Case, block: Block, run: BlockRun) -> BlockFrictionLaw | None:
    """Return the state of the law at the end: how far the crack has slipped, and its friction under the static loads
    before and after that; None of constant coefficients."""
    if case.crack.law is None or run.worn is None:
        return None
    law, stress = law_of(case.crack.law), block.normal_force / block.width
    before, _ = coefficients(law, stress, bond=1.0)
    pressed = max(stress, 1.0)
    with_bond, _ = coefficients(law, stress, run.worn.end, bond=float(run.worn.bonded_at_end))
    without, _ = coefficients(law, stress, run.worn.end)
    return BlockFrictionLaw(
        name=case.crack.law.name,
        slip_path_m=run.worn.end,
        normal_stress_pa=stress,
        apparent_friction_before=before,
        apparent_friction_after=with_bond,
        cohesion_left_pa=None if case.crack.law.cohesion is None else (with_bond - without) * pressed,
        surface=case.crack.law.surface,
        integrated_time_s=run.worn.integrated,
        integration_error_m=run.worn.error,
    )


def law_histories(case: Case, block: Block, run: BlockRun) -> dict[str, Floats]:
    """Return the way that the crack has slipped, to and fro, and the friction that it could bear [N/m]."""
    assert case.crack.law is not None
    assert run.worn is not None
    column, worn = run.histories, run.worn
    stress = (column.normal_force_heel + column.normal_force_toe) / block.width
    closed = (column.gap_heel == 0.0) & (column.gap_toe == 0.0)
    speed = abs(column.slip_velocity)
    if run.crossing is not None:
        speed = np.hypot(speed, run.crossing.kept[:, 1])
    at_rest, sliding = shear_stress(law_of(case.crack.law), stress, worn.path, speed, worn.bonded * closed)
    strength: Floats = np.where(speed > 0.0, sliding, at_rest)
    return {"slip_path_m": worn.path, "friction_strength_n": block.width * strength}


def roughness_result(crack: Crack, run: BlockRun) -> Roughness | None:
    """Return the state of the asperities at the end: dilation, angle and friction along the mean plane before and
    after; None of a crack that is not rough."""
    rough = crack.roughness
    if rough is None or run.rough is None or run.worn is None:
        return None
    dilation, angle, work = run.rough.end
    flank = math.atan(crack.mu_static)
    return Roughness(
        asperity_height_m=rough.asperity_height,
        wave_length_m=rough.wave_length,
        asperity_angle_before_rad=rough.angle,
        asperity_angle_after_rad=angle,
        apparent_friction_before=math.tan(flank + rough.angle),
        apparent_friction_after=math.tan(flank + angle),
        residual_dilation_m=dilation,
        peak_dilation_m=run.rough.highest,
        plastic_work_j_m2=work,
        slip_path_m=run.worn.end,
        asperities_passed=len(run.times_of("asperity passed")),
        integration_error_m=run.worn.error,
    )


def roughness_histories(run: BlockRun) -> dict[str, Floats]:
    """Return how far the crack has dilated [m], the angle of its flanks [rad] and the plastic work [J/m^2]."""
    rough = run.rough
    if rough is None:
        return {}
    names = ("dilation_m", "asperity_angle_rad", "plastic_work_j_m2")
    return dict(zip(names, rough.kept.T, strict=True))
