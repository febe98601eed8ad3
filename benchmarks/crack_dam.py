"""The flexible model at the sizes it is used at: set-up, time per step, and the share of the machine it reaches."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

# The kernel uses one core for one run; so must what its rate is compared with.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from measure import Timing, heading, repeat, require, seconds, table, timed

from heeltoe import Case, GroundMotion, InputError, read_case, read_record
from heeltoe.kernel.build import PROFILE
from heeltoe.models.flexible.body import bonded
from heeltoe.models.flexible.body import reduced as flexible_parts
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.records.catalog import find

DURATION = 20.0
# The program's own steps for these two.
BASE_STEP, HEIGHT_STEP = 2e-4, 1e-4
# With the program's own damping, and friction that slides a while.
DAM = ("crack.friction=1.2", "flexible.damping=relative", "flexible.virtual_mass=complete")
ALL = "flexible.modes=5000"
# Where rock and water are not the subject.
PLANE = ("rock=rigid", "reservoir.compressible=false")
ABREAST = 8
EXAMPLES = Path(__file__).parent.parent / "examples"
COLUMNS = [
    "case",
    "modes",
    "watched nodes",
    "step",
    "set-up",
    "20 s of shaking",
    f"each of {ABREAST}",
    "per step",
    "contact sets per step",
    "rate",
    "share",
    "slip",
]


@dataclass(frozen=True)
class Problem:
    """A dam at a given step."""

    name: str
    file: str
    changes: tuple[str, ...]
    step: float


PROBLEMS = (
    Problem("base crack", "thesis/typical-base.toml", (), BASE_STEP),
    Problem("base crack, all modes", "thesis/typical-base.toml", (ALL,), BASE_STEP),
    Problem("base crack, 16 across", "thesis/typical-base.toml", ("flexible.elements_across=16",), BASE_STEP),
    Problem("crack at 90 m", "thesis/typical-height.toml", (), HEIGHT_STEP),
    Problem("crack at 90 m, all modes", "thesis/typical-height.toml", (ALL,), HEIGHT_STEP),
)


def motion(case: Case) -> GroundMotion:
    """Taft S69E where it is at hand, else El Centro 1940, at 0.4 g."""
    try:
        record = read_record(find("taft-1952-s69e-caltech", Path.cwd()))
    except InputError:
        record = read_record(find("elcentro-1940-180-nga", Path.cwd()))
    return record.scaled_to(0.4 * case.gravity).cut(DURATION)


def machine_rate() -> float:
    """Return what one core reaches in products of matrices [operations/s], the best that ordinary programs do."""
    size = 1000
    one, two = np.random.default_rng(1).random((2, size, size))
    return 2.0 * size**3 / least(repeat(lambda: one @ two))


def least(timing: Timing) -> float:
    """Return the least processor time [s]: what else a shared server does makes a run longer, never shorter."""
    return min(timing.cpu)


def operations(dam: flexible_parts.FlexibleDam) -> float:
    """Count the operations of a step that go over the modes: two products with the shapes, and 34 for each mode."""
    return float(sum(4 * part.shapes.size + 34 * part.omega_squared.size for part in dam.reduced))


def row(problem: Problem, peak: float) -> list[str]:
    """Measure one problem."""
    case = read_case(EXAMPLES / problem.file, (*DAM, *problem.changes))
    shaking = motion(case)
    setup = repeat(lambda: flexible_parts._build(case), 5, bonded._KEPT.clear)
    dam = flexible_parts.build_flexible_dam(case)
    shaken = ShakenDam(case, dam, Earthquake(shaking, None, DURATION).shaking)
    raw = shaken.run(problem.step).summary
    require(raw.steps == round(DURATION / problem.step) and raw.slip > 1e-3, "the dam did not slide")
    ours = least(repeat(lambda: shaken.run(problem.step), 7))
    # On one core, to be compared with that one run.
    scales = np.repeat(np.linspace(0.98, 1.02, ABREAST)[:, None], 2, axis=1)
    (_, step, ground), theta = shaken._ground(problem.step), case.flexible.theta
    several = least(repeat(lambda: dam.kernel.run_many(ground, step, theta, scales, threads=1), 3)) / ABREAST
    per_step = ours / raw.steps
    rate = operations(dam) / per_step
    return [
        problem.name,
        " + ".join(str(part.omega_squared.size) for part in dam.reduced),
        str(dam.upper.mesh.crack.size + (2 if dam.lower else 0)),
        seconds(problem.step),
        timed(setup),
        seconds(ours),
        seconds(several),
        seconds(per_step),
        f"{raw.iterations / raw.steps:.2f}",
        f"{rate / 1e9:.1f} G/s",
        f"{rate / peak:.0%}",
        f"{1e3 * raw.slip:.1f} mm",
    ]


def several_cracks(name: str, changes: tuple[str, ...]) -> list[str]:
    """Measure a dam with two cracks beside those that have one of them, in turn and at the same step."""
    case = read_case(EXAMPLES / "two-cracks.toml", (*PLANE, "motion.duration=12s", "analysis.silence=0s", *changes))
    cases = (case, *case.single_crack_cases)
    dams = [ShakenDam(item, flexible_parts.build_flexible_dam(item), earthquake(item).shaking) for item in cases]
    slips = [[crack.slip for crack in dam.run(HEIGHT_STEP).summaries] for dam in dams]
    require(min(abs(slip) for item in slips for slip in item) > 1e-3, "a crack did not slide")
    times = np.array([[repeat(lambda dam=dam: dam.run(HEIGHT_STEP), 1).cpu[0] for dam in dams] for _ in range(7)])
    both, *alone = times.min(axis=0) / round(cases[0].motion.duration / HEIGHT_STEP)
    return [name, seconds(both), *map(seconds, alone), f"{both / sum(alone):.2f}"]


#: Laws with numbers that make them Coulomb's, 1.0, so that the dam does the same and only the law costs.
LAWS: dict[str, dict[str, Any]] = {
    "constant": {},
    "slip weakening": {"name": "slip weakening", "peak_friction": 1.0, "residual_friction": 1.0, "slip": "20 mm"},
    "speed weakening": {"name": "speed weakening", "peak_friction": 1.0, "residual_friction": 1.0, "speed": "0.1 m/s"},
    "cohesion": {"name": "cohesion", "cohesion": "0 Pa", "residual_friction": 1.0},
    "Barton-Bandis": {"name": "barton-bandis", "jrc": 1e-9, "jcs": "20 MPa", "residual_angle": "45 deg"},
    "lift joint": {"name": "lift joint", "surface": "plane", "basic_friction": 1.0},
}


def with_laws() -> dict[str, Case]:
    """Return the typical dam with each friction law."""
    case = read_case(EXAMPLES / "typical-base.toml", (*PLANE, "motion.duration=12s", "analysis.silence=0s"))
    return {
        name: case.with_({"crack.friction": None, "crack.law": law} if law else {"crack.friction": 1.0})
        for name, law in LAWS.items()
    }


def with_kinks() -> dict[str, Case]:
    """Return a dam with a straight crack and with one that has a step."""
    changes = (*PLANE, "motion.duration=12s", "analysis.silence=0s", "flexible.elements_across=16")
    case = read_case(EXAMPLES / "stepped-crack.toml", changes)
    return {"straight, 16 across": case.with_({"crack.kinks": []}), "with a step, 16 across": case}


def with_surroundings() -> dict[str, Case]:
    """Return the typical dam before water with sound, on rock, and with a joint that cracks through."""
    changes = ("motion.duration=12s", "analysis.silence=0s")
    both = read_case(EXAMPLES / "on-rock.toml", changes)
    bare = both.with_({"rock": "rigid", "reservoir.compressible": False})
    bond = {
        "tensile_strength": "1 MPa",
        "cohesion": "1.5 MPa",
        "fracture_energy": "100 N/m",
        "shear_energy": "1000 N/m",
    }
    return {
        "neither": bare,
        "a bond": bare.with_({"crack.bond": bond}),
        "water with sound": both.with_({"rock": "rigid"}),
        "rock": both.with_({"reservoir.compressible": False}),
        "rock and water": both,
    }


def beside(cases: dict[str, Case], step: float) -> list[list[str]]:
    """Measure a step [s] of each dam, in turn, and over that of the first."""
    dams = [
        ShakenDam(item, flexible_parts.build_flexible_dam(item), earthquake(item).shaking) for item in cases.values()
    ]
    slips = [dam.run(step).summary.slip for dam in dams]
    require(min(map(abs, slips)) > 1e-3, "a crack did not slide")
    times = np.array([[repeat(lambda dam=dam: dam.run(step), 1).cpu[0] for dam in dams] for _ in range(7)])
    each = times.min(axis=0) / round(next(iter(cases.values())).motion.duration / step)
    return [
        [name, seconds(taken), f"{taken / each[0]:.2f}", f"{1e3 * slip:.1f} mm"]
        for name, taken, slip in zip(cases, each, slips, strict=True)
    ]


def report() -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    peak = machine_rate()
    text = (
        "Typical dam, 100 m, friction 1.2, damping `relative`, 0.4 g, on one core: the least processor time of 7 runs "
        "without frames, and of 3 times eight runs one after the other. The rate counts the arithmetic on the modes "
        "alone, not that of the contact; "
        f"the share is of {peak / 1e9:.0f} G/s, what numpy reaches here on one core in products of large matrices."
    )
    return "\n\n".join(
        [
            heading("Flexible dams", ["heeltoe", "numpy", "scipy", "scikit-fem"]),
            text,
            table(COLUMNS, [row(problem, peak) for problem in PROBLEMS]),
            "A step of `examples/two-cracks.toml`, 12 s at steps of 0.1 ms, and of the same dam with one crack: "
            "the least of 7 runs in turn, and the first over the sum of the others.",
            table(
                ["motion", "both cracks", "neck alone", "base alone", "ratio"],
                [several_cracks(pga, (f"motion.pga={pga}",)) for pga in ("0.2 g", "0.4 g")],
            ),
            "A step of `examples/typical-base.toml` with friction laws that come to the same constant, 1.0, and of "
            "`examples/stepped-crack.toml` with and without its step: 12 s at steps of 0.2 ms, the least of 7 runs in "
            "turn, beside the first.",
            table(["law", "per step", "beside the first", "slip"], beside(with_laws(), BASE_STEP)),
            table(["crack", "per step", "beside the first", "slip"], beside(with_kinks(), BASE_STEP)),
            "The same with the dam of `examples/on-rock.toml`: a bond that cracks through, water and rock.",
            table(["with", "per step", "beside the first", "slip"], beside(with_surroundings(), BASE_STEP)),
        ]
    )


if __name__ == "__main__":
    print(report())
