"""Dams of Zhu (2004), chapter VII, with the flexible model. The records are not part of the project.

Unless a case says otherwise: eight elements across, damping `thesis`, virtual water `thesis`, theta the default; the
record taft-1952-s69e-caltech as stored, whole, scaled; steps of 0.2 ms for a crack at the base, 0.1 ms for one at a
height and 0.05 ms for a dam of 2000 GPa or more, whose vibrations are as much faster; no check of the step, which is
the business of :func:`halving`. The prototype is an independent program with four elements across and is compared with
runs that have as many. The worth of each source stands in :mod:`validation.sources`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import islice
from typing import Any

import numpy as np

from heeltoe.case.model import Case
from heeltoe.models.flexible.body.modes import intact_periods
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.run import rigid
from heeltoe.motion.ground_motion import GroundMotion
from validation import sources
from validation.flexible_runs import Runs, scattered
from validation.row import Row
from validation.sources import plane_case
from validation.thesis_dams import record_named

_G = 9.81
_TYPICAL = [(0.0, 0.0), (80.0, 0.0), (8.0, 90.0), (8.0, 100.0), (0.0, 100.0)]
_KOYNA = [(0.0, 0.0), (70.2, 0.0), (20.36, 66.5), (14.8, 103.0), (0.0, 103.0)]
_TRIANGLE = [(0.0, 0.0), (97.536, 0.0), (0.0, 121.92)]

# Thesis: slip in mm and downstream rotation in 1e-4 rad; then the prototype's.
_TABLE_7_1 = {
    41.42: (432.0, 2.03, 481.0, 2.02),
    27.61: (359.0, 5.04, 422.0, 5.17),
    13.81: (424.0, 6.15, 459.0, 6.40),
    6.90: (495.0, 7.30, 496.0, 8.18),
    3.45: (311.0, 4.32, 355.0, 4.57),
}
# Slip in mm of the thesis and of the prototype, the middle of where it has several, by friction and depth of water.
_TABLE_7_7 = {
    (1.0, 100.0): (657.0, 570.0),
    (1.2, 100.0): (210.0, 219.0),
    (0.8, 50.0): (9.8, 11.3),
    (1.0, 50.0): (7.1, 7.9),
    (1.2, 50.0): (6.3, 6.9),
}
# By modulus in GPa.
_TABLE_7_8 = {20.0: (218.0, 219.0), 200.0: (94.0, 86.0), 2000.0: (52.0, 39.0), 20000.0: (37.0, 31.0)}
_TABLE_7_10 = {
    0.8: {90.0: (118.0, 156.0), 95.0: (329.0, 302.0), 100.0: (649.0, 669.0)},
    1.0: {90.0: (85.0, 115.0), 95.0: (209.0, 218.0), 100.0: (382.0, 344.0)},
    1.2: {90.0: (81.0, 102.0), 95.0: (157.0, 149.0), 100.0: (316.0, 276.0)},
}
# Deviations from the thesis up to these are put down to what it does not tell.
_SLIPS_DIFFER, _STIFF_DIFFER, _ROTATIONS_DIFFER, _HIGH_DIFFERS = 0.22, 0.27, 0.15, 0.40
# And from the prototype to what is known to be another in it.
_PROGRAMS_DIFFER, _HIGH_PROGRAMS_DIFFER = 0.15, 0.20


def periods() -> Iterator[Row]:
    """Periods of the dams without water, in s: typical dam, Koyna Dam, triangular dam."""
    koyna = {"density": "2643 kg/m^3", "modulus": "31 GPa", "poisson": 0.2}
    triangle = {"density": "2430 kg/m^3", "modulus": "27.61 GPa", "poisson": 0.0}
    for name, corners, concrete, printed in (
        ("typical", _TYPICAL, _concrete(20.0), (0.2842, 0.1292, 0.1052, 0.0768, 0.0521)),
        ("Koyna", _KOYNA, koyna, (0.3254, 0.1218, 0.0925, 0.0627, 0.0413)),
        ("triangular", _TRIANGLE, triangle, (0.2620, 0.1126, 0.1008)),
    ):
        dam = build_flexible_dam(_case(corners, concrete, friction=1.0))
        computed = intact_periods(dam, len(printed), water=False)
        for number, (reference, ours) in enumerate(zip(printed, computed, strict=True), 1):
            remark = "good for 1 %: the drawing of the section is lost, or its Poisson's ratio is not published"
            yield Row(f"{name}, period {number}", reference, float(ours), 0.01, remark=remark, kind="thesis")
        fine = build_flexible_dam(_case(corners, concrete, friction=1.0, elements_across=16))
        change = float(np.abs(intact_periods(fine, len(printed), water=False) / computed - 1.0).max())
        yield Row(f"{name}, largest change with 16 across", 0.0, change, 3e-3, relative=False, kind="condition")


def table_7_1() -> Iterator[Row]:
    """Triangular dam, friction 1, Taft at 0.5 g: slip and downstream rotation for five moduli.

    Poisson's ratio is 0.2, as in the prototype; the thesis gives none, and its periods say 0.
    """
    motion, run = _taft(0.5), Runs()
    for modulus, (slip, rotation, slip_too, rotation_too) in _TABLE_7_1.items():
        what = f"{modulus} GPa: rotation [1e-4 rad]"
        runs = {across: run(_triangle(modulus, elements_across=across), motion) for across in (8, 4)}
        slips = {across: 1e3 * response.residual_slip_m for across, response in runs.items()}
        peaks = {across: 1e4 * response.rocking_downstream_rad for across, response in runs.items()}
        for row in _slips(f"{modulus} GPa", (slip, slip_too), slips.__getitem__):
            yield run.moved(row, _triangle(modulus), motion) if row.kind == "thesis" else row
        yield sources.ROTATION.row(what, rotation, peaks[8], _ROTATIONS_DIFFER, sources.UNTOLD)
        yield sources.PROTOTYPE_ROTATION.row(what, rotation_too, peaks[4])
    yield from _slips(
        "2000 GPa", (95.0, 94.0), lambda across: run.slip_mm(_triangle(2000.0, elements_across=across), motion)
    )
    turned = 1e4 * run(_triangle(3.45, poisson=0.0), motion).rocking_downstream_rad
    remark = (
        "with the Poisson's ratio that fits the thesis' periods this one of the rotations is outside 15 %; mesh (4 to "
        "16 across), step and theta change it by 2 %, the Poisson's ratio by 30 %"
    )
    yield Row("3.45 GPa, Poisson's ratio 0: rotation [1e-4 rad]", 4.32, turned, None, remark=remark, kind="thesis")
    yield from run.energy()


def table_7_7() -> Iterator[Row]:
    """Typical dam cracked at its base, 20 GPa, Taft at 0.4 g: slip by friction and depth of water."""
    motion, run = _taft(0.4), Runs()
    for (friction, depth), both in _TABLE_7_7.items():
        what = f"friction {friction}, water {depth:g} m"
        for row in _slips(what, both, partial(_slip_mm, run, motion, friction, depth, 20.0)):
            yield run.moved(row, _typical(friction, depth), motion) if row.kind == "thesis" else row
    # The ground stands still for 15 s after the record.
    end = motion.duration + 15.0
    quiet = GroundMotion.from_points(
        np.append(motion.time, [motion.duration, end]), np.append(motion.acceleration, [0.0, 0.0]), name=motion.name
    )
    speeds = {}
    for damping in ("thesis", "deformation"):
        response = run(_typical(0.8, 100.0, damping=damping), quiet)
        time, slip = response.histories["time_s"], response.histories["slip_m"]
        speeds[damping] = (slip[-1] - np.interp(end - 5.0, time, slip)) / 5.0, float(np.interp(50.0, time, slip))
    # Both scatter where nothing damps: 1e-9 of the shaking moves the slip at 50 s by 1 %.
    (speed, at_50), (calm, calm_at_50) = speeds["thesis"], speeds["deformation"]
    remark = (
        f"the thesis says 'failure', the prototype slips 7 m in 50 s: here {at_50:.0f} m in 50 s, and 15 s after the "
        f"record the dam still slides at {speed:.1f} m/s. It is the damping that fails: nothing damps the part "
        f"above the crack while no node sticks. With damping deformation it slips {calm_at_50:.2f} m and comes to rest"
    )
    yield Row(
        "friction 0.8, water 100 m: slides on after the record (1)",
        1.0,
        float(speed > 0.01),
        0.0,
        remark=remark,
        kind="thesis",
    )
    yield Row(
        "the same with damping deformation (0)", 0.0, float(abs(calm) > 0.01), 0.0, relative=False, kind="condition"
    )
    yield from run.energy()


def table_7_8() -> Iterator[Row]:
    """Typical dam cracked at its base, friction 1.2, Taft at 0.4 g: slip in mm from 20 GPa to rigid."""
    motion, run = _taft(0.4), Runs()
    stiffest = max(_TABLE_7_8)
    for modulus, both in _TABLE_7_8.items():
        slips = _slips(
            f"{modulus:g} GPa",
            both,
            partial(_slip_mm, run, motion, 1.2, 100.0, modulus),
            _STIFF_DIFFER if modulus == 2000.0 else _SLIPS_DIFFER,
        )
        for row in slips if modulus < stiffest else islice(slips, 1):
            yield run.moved(row, _typical(1.2, 100.0, modulus), motion) if row.kind == "thesis" else row
    coarse, fine = (
        run.slip_mm(_typical(1.2, 100.0, modulus=stiffest, elements_across=4, time_step=step), motion)
        for step in ("0.1 ms", "0.025 ms")
    )
    reason = (
        "no verdict: the thesis' damping comes and goes with the first node that sticks; where the stiffness makes its "
        "mass term as large as here the slip depends on the step and on rounding: with a quarter of this one of 0.1 ms "
        f"it is {fine:.1f} mm, by other arithmetic it was 1.4 % more"
    )
    what, slip = f"{stiffest:g} GPa, 0.1 ms: slip [mm]", _TABLE_7_8[stiffest][1]
    yield Row(what, slip, coarse, None, remark=reason, kind="prototype")
    stiff = _typical(1.2, 100.0, modulus=20000.0, damping="deformation")
    limit = 1e3 * rigid(stiff, motion).residual_slip_m
    yield Row(
        "20000 GPa, damping deformation, against our rigid model",
        limit,
        run.slip_mm(stiff, motion),
        0.02,
        kind="own run",
    )
    yield from run.energy()


def table_7_10() -> Iterator[Row]:
    """Typical dam cracked at 90 m, Taft at 0.4 g: slip in mm by friction and depth of water."""
    motion, run = _taft(0.4), Runs()
    for friction, line in _TABLE_7_10.items():
        for depth, (printed, prototype) in line.items():
            what = f"friction {friction}, water {depth:g} m"
            ours, coarse = (
                run.slip_mm(_cracked_high(friction, depth, elements_across=across), motion) for across in (8, 4)
            )
            row = sources.HIGH.row(what, printed, ours, _HIGH_DIFFERS, sources.UNTOLD)
            yield run.moved(row, _cracked_high(friction, depth), motion)
            yield sources.PROTOTYPE_HIGH.row(what, prototype, coarse, _HIGH_PROGRAMS_DIFFER, sources.BONDED)
    yield from run.energy()


def _slip_mm(run: Runs, motion: GroundMotion, friction: float, depth: float, modulus: float, across: int) -> float:
    return run.slip_mm(_typical(friction, depth, modulus, elements_across=across), motion)


def _slips(
    what: str, both: tuple[float, float], slip_mm: Callable[[int], float], differ: float = _SLIPS_DIFFER
) -> Iterator[Row]:
    """Compare a slip [mm] with 8 elements across with the thesis, and with 4 with the prototype."""
    thesis = sources.SMALL_SLIP if both[0] < 10.0 else sources.SLIP
    yield thesis.row(f"{what}: slip [mm]", both[0], slip_mm(8), differ, sources.UNTOLD)
    yield sources.PROTOTYPE.row(f"{what}: slip [mm]", both[1], slip_mm(4), _PROGRAMS_DIFFER, sources.BONDED)


def damping() -> Iterator[Row]:
    """Typical dam, friction 1.2, Taft at 0.4 g: slip in mm by kind of damping, 5 % each."""
    motion, run = _taft(0.4), Runs()
    good = "a program with full matrices, made after the same notes, as good as other prototypes (4.5 %)"
    chaotic = "meshes of 4 to 32 across give 411 to 470 mm there: the first mode has 1.6 % of damping, not 5 %"
    for name, slip in (("relative", 286.0), ("thesis", 209.0), ("stiffness", 200.0), ("deformation", 411.0)):
        case = _typical(1.2, 100.0, damping=name)
        loose = name == "deformation"
        row = Row(
            f"{name}: slip [mm]",
            slip,
            run.slip_mm(case, motion),
            0.045,
            remark=f"{good}; {chaotic}" if loose else good,
            kind="prototype",
            explained=0.25 if loose else None,
        )
        yield run.moved(row, case, motion)
    yield from run.energy()


def halving() -> Iterator[Row]:
    """Twice the step, twice the elements: slip in mm, as it is and beside it; Taft at 0.4 g."""
    motion, run = _taft(0.4), Runs()
    for friction in (1.0, 1.2):
        base = f"base crack, friction {friction}, water 100 m"
        yield _half_step(f"{base}: 0.2 and 0.4 ms", run, _typical(friction, 100.0, evidence="step"), motion, 0.03)
        evidence = run(_typical(friction, 100.0, evidence="full"), motion).summary["evidence"]["residual_slip_m"]
        fine = run.slip_mm(_typical(friction, 100.0, elements_across=16), motion)
        yield Row(
            f"{base}: 8 and 16 across",
            1e3 * evidence["run"],
            fine,
            evidence["uncertainty"] / evidence["run"],
            remark="within what the evidence at 8 across says",
            kind="own run",
        )
    high = "crack at 90 m, friction 1, water 95 m"
    yield (row := _half_step(f"{high}: 0.1 and 0.2 ms", run, _cracked_high(1.0, 95.0, evidence="step"), motion, 0.10))
    fine = run.slip_mm(_cracked_high(1.0, 95.0, elements_across=16), motion)
    yield Row(f"{high}: 8 and 16 across", row.reference, fine, 0.10, kind="own run")
    high = "crack at 90 m, friction 1, water 100 m"
    yield _half_step(f"{high}: 0.1 and 0.2 ms", run, _cracked_high(1.0, 100.0, evidence="step"), motion, 0.10)
    narrow, wide = (scattered(_cracked_high(1.0, 100.0, elements_across=across), motion) for across in (8, 16))
    remark = (
        f"a single run says little about the mesh here: the record times 0.99, 1 and 1.01 gives {min(narrow):.0f} to "
        f"{max(narrow):.0f} mm with 8 across and {min(wide):.0f} to {max(wide):.0f} mm with 16. By itself the "
        "program gives the mean then, and its uncertainty"
    )
    yield Row(f"{high}: 8 and 16 across", narrow[1], wide[1], None, remark=remark, kind="own run")
    yield from run.energy()


def _half_step(what: str, run: Runs, case: Case, motion: GroundMotion, allowed: float) -> Row:
    """Judge what the program itself says of another step."""
    response = run(case, motion)
    evidence = response.summary["evidence"]
    slip, moved = (1e3 * evidence["residual_slip_m"][name] for name in ("value", "step"))
    remark = "" if evidence["converged"] else "the result warns"
    return Row(what, slip, slip + moved, allowed, remark=remark, kind="own run")


def _taft(peak: float) -> GroundMotion:
    return record_named("taft-1952-s69e-caltech").scaled_to(peak * _G)


def _typical(friction: float, depth: float, modulus: float = 20.0, **options: Any) -> Case:
    return _case(_TYPICAL, _concrete(modulus), friction, depth, **options)


def _cracked_high(friction: float, depth: float, **options: Any) -> Case:
    return _case(_TYPICAL, _concrete(20.0), friction, depth, elevation=90.0, **options)


def _triangle(modulus: float, poisson: float = 0.2, **options: Any) -> Case:
    concrete = {"density": "2430 kg/m^3", "modulus": f"{modulus} GPa", "poisson": poisson}
    return _case(_TRIANGLE, concrete, 1.0, 121.92, uplift=0.5, **options)


def _concrete(modulus: float) -> dict[str, Any]:
    return {"density": "2650 kg/m^3", "modulus": f"{modulus} GPa", "poisson": 0.143}


def _case(
    corners: list[tuple[float, float]],
    concrete: dict[str, Any],
    friction: float,
    depth: float = 0.0,
    *,
    elevation: float = 0.0,
    uplift: float = 1.0,
    **flexible: Any,
) -> Case:
    stiff = float(concrete["modulus"].split()[0]) >= 2000.0
    fields = {
        "gravity": f"{_G} m/s^2",
        "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
        "concrete": concrete,
        "crack": {"friction": friction, "elevation": f"{elevation} m"},
        "uplift": {"pattern": "triangular", "intensity": uplift},
        "flexible": {
            "elements_across": 8,
            "damping": "thesis",
            "virtual_mass": "thesis",
            "time_step": "0.1 ms" if elevation else "0.05 ms" if stiff else "0.2 ms",
            "evidence": "none",
            **flexible,
        },
    }
    return plane_case(fields | sources.ENDS_WITH_MOTION | ({"reservoir": {"depth": f"{depth} m"}} if depth else {}))
