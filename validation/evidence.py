"""Dams drawn at random: whether what the program calls converged stays where it is on a finer mesh and with a shorter
step.

``python -m validation.evidence FIRST COUNT FILE [KIND]`` judges many of a kind, a line of JSON each, and goes
on where it stopped."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np

from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.block import build_block
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.evidence.refinement import answer
from heeltoe.models.flexible.evidence.trials import CROSS_SLIP, SCALES, Level, Trials
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake
from heeltoe.result.contract import CRACKED, HEADLINES, RESIDUAL_SLIP
from heeltoe.result.judge import leading_crack
from heeltoe.result.numbers import EvidenceNumbers
from validation.row import Row
from validation.sources import ENDS_WITH_MOTION, plane_case
from validation.thesis_dams import record_named

#: Dams with a straight crack and constant friction, with a friction law, a crack with two kinks, or two cracks; plain
#: ones on elastic rock before water with sound, those with a bond on the crack, plain ones whose rock is assumed, and
#: plain ones that the other component of the record shakes across the valley.
Kind = Literal["plain", "law", "kinks", "two cracks", "rock and water", "bonds", "assumed rock", "cross valley"]
KINDS: tuple[Kind, ...] = get_args(Kind)
#: So many of those that are called converged must stay where they are.
COVERED = 0.95
#: How many a validation judges.
FEW = 6
_WHICH = "drawn at random; the others say themselves that they are not"
# Frames are not looked at; few cost little [s].
_FRAMES = 0.1
_RECORDS = (
    "elcentro-1940-180-nga",
    "elcentro-1940-270-nga",
    "pacoima-1971-164-nga",
    "pacoima-1971-254-nga",
    "loma-prieta-1989-corralitos-000-nga",
    "loma-prieta-1989-corralitos-090-nga",
    "northridge-aftershock-1994-sylmar-090-nga",
    "northridge-aftershock-1994-sylmar-360-nga",
)
# Components of one record follow each other.
_OTHER = dict(
    pair for one, other in zip(_RECORDS[::2], _RECORDS[1::2], strict=True) for pair in ((one, other), (other, one))
)


@dataclass(frozen=True)
class Judged:
    """What a dam's evidence says, and what became of it.

    Attributes
    ----------
    kind, seed
        It was drawn with.
    high
        Whether its crack is at a height.
    value, uncertainty
        Of the residual slip [m], of several cracks that of the one that slips most.
    converged, mean, spent, most, runs
        As the evidence has them.
    across
        Elements along its crack in the end.
    by_mesh, by_step
        By how much twice the elements and a quarter of the step move the value [m]; None where it is not converged.
    numbers
        Each number with a bound, by its key, whether the slip is converged or not: its value, its uncertainty, and what
        mesh and step move it by.
    """

    kind: Kind
    seed: int
    high: bool
    value: float
    uncertainty: float
    converged: bool
    mean: bool
    spent: bool
    most: str
    runs: int
    across: int
    by_mesh: float | None
    by_step: float | None
    numbers: dict[str, tuple[float, float, float, float]]

    @property
    def covered(self) -> bool:
        """Whether it is converged and stays where it is."""
        if self.by_mesh is None or self.by_step is None:
            return False
        return max(abs(self.by_mesh), abs(self.by_step)) <= self.uncertainty

    def __str__(self) -> str:
        text = f"{self.kind} dam {self.seed}: {1e3 * self.value:.4g} ± {1e3 * self.uncertainty:.2g} mm"
        if self.by_mesh is None or self.by_step is None:
            return f"{text}, not converged"
        return f"{text}, by mesh {1e3 * self.by_mesh:.2g} and step {1e3 * self.by_step:.2g} mm"


def draw(seed: int, kind: Kind = "plain") -> Case:
    """Draw a dam as dams are, its crack at the base or a height, and the first seconds of an earthquake that is strong
    enough for most of them to slide; half of them made to order."""
    rng = np.random.default_rng(seed)
    height = 10.0 ** rng.uniform(1.3, 2.15)
    base, crest, neck = (
        height * rng.uniform(0.6, 0.9),
        height * rng.uniform(0.06, 0.15),
        height * rng.uniform(0.75, 0.95),
    )
    lean = height * float(rng.choice([0.0, rng.uniform(0.0, 0.1)]))
    corners = ((0.0, 0.0), (base, 0.0), (lean + crest, neck), (lean + crest, height), (lean, height))
    elevation = height * float(rng.choice([0.0, 0.0, rng.uniform(0.3, 0.85)]))
    # What a kind has beside leaves the rest as it is.
    own = np.random.default_rng([seed, KINDS.index(kind)])
    if kind == "kinks":
        elevation = height * float(own.uniform(0.15, 0.6))
    if kind == "two cracks":
        elevation = 0.0
    record = str(rng.choice(_RECORDS))
    if rng.random() < 0.4:
        # The numbers on record are those of this corner.
        record = f"synthetic:M{rng.uniform(6.0, 7.5):.2f},{rng.uniform(8.0, 40.0):.1f}km,seed={seed},corner=0.1"
    fields: dict[str, Any] = {
        "title": f"dam {seed}, drawn at random",
        "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
        "concrete": {
            "modulus": f"{rng.uniform(10.0, 40.0):.4g} GPa",
            "poisson": 0.2,
            "damping": float(rng.uniform(0.03, 0.08)),
        },
        "crack": {"elevation": f"{elevation} m", "friction": float(rng.uniform(0.6, 1.4))},
        "reservoir": {"depth": f"{elevation + (height - elevation) * rng.uniform(0.7, 1.0)} m"},
        "uplift": {"pattern": "triangular"},
        "motion": {
            "file": record,
            "pga": f"{rng.uniform(0.3, 0.9):.3f} g",
            "duration": f"{rng.uniform(3.0, 5.0):.1f} s",
        },
        # The numbers on record (docs/flexible.md) are those at the end of the motion.
        **ENDS_WITH_MOTION,
    }
    if kind == "law":
        del fields["crack"]["friction"]
        fields["crack"]["law"] = _law(own)
    if kind == "kinks":
        share = elevation / neck
        width = base + share * (lean + crest - base) - lean * elevation / height if share < 1.0 else crest
        fields["crack"]["kinks"] = _kinks(own, width)
    if kind == "two cracks":
        friction = float(own.uniform(0.6, 1.4))
        fields["further_cracks"] = [{"elevation": f"{height * own.uniform(0.4, 0.85)} m", "friction": friction}]
    if kind == "cross valley":
        fields["motion"]["cross_valley"] = {
            "file": _OTHER.get(record, record.replace(f"seed={seed}", f"seed={seed + 1}"))
        }
    if kind == "assumed rock":
        return Case.of(fields)
    if kind not in ("rock and water", "bonds"):
        fields |= {"rock": "rigid"}
        fields["reservoir"] |= {"compressible": False}
    else:
        fields["reservoir"] |= {"compressible": True, "floor_reflection": float(own.choice([0.3, 0.75, 0.9, 1.0]))}
        fields["rock"] = {
            "modulus": f"{10.0 ** own.uniform(0.5, 1.8):.4g} GPa",
            "poisson": float(own.uniform(0.1, 0.35)),
            "density": f"{own.uniform(2200.0, 2800.0):.5g} kg/m^3",
            "damping": float(own.choice([0.0, 0.02, 0.05] if kind == "rock and water" else [0.02, 0.05])),
        }
    if kind == "bonds":
        # Old lift joints and good ones; energies are those of mass concrete.
        tensile = float(own.uniform(0.2, 1.5))
        fields["crack"]["bond"] = {
            "tensile_strength": f"{tensile:.3f} MPa",
            "cohesion": f"{tensile * own.uniform(1.3, 2.5):.3f} MPa",
            "fracture_energy": f"{own.uniform(100.0, 300.0):.4g} N/m",
            "shear_energy": f"{own.uniform(1000.0, 3000.0):.4g} N/m",
        }
    return plane_case(fields)


def _law(rng: np.random.Generator) -> dict[str, Any]:
    residual = float(rng.uniform(0.6, 1.1))
    friction = {"peak_friction": residual + float(rng.uniform(0.05, 0.5)), "residual_friction": residual}
    form = str(rng.choice(["linear", "exponential", "speed"]))
    if form == "speed":
        return {"name": "speed weakening", **friction, "speed": f"{rng.uniform(0.02, 0.3)} m/s"}
    return {"name": "slip weakening", "form": form, **friction, "slip": f"{rng.uniform(5.0, 60.0)} mm"}


def _kinks(rng: np.random.Generator, width: float) -> list[list[str]]:
    places, rises = np.sort(rng.uniform(0.2, 0.8, 2)), rng.uniform(-0.04, 0.04, 2)
    return [[f"{width * place} m", f"{width * rise} m"] for place, rise in zip(places, rises, strict=True)]


def judge(seed: int, kind: Kind = "plain") -> Judged | None:
    """Judge the dam of a seed; None where it slides under its static loads alone, or its kinks do not fit into it.

    Raises
    ------
    Skipped
        Where its record is not there.
    """
    try:
        case = draw(seed, kind)
        safety = build_block(case).sliding_safety_factor
        dam = build_flexible_dam(case)
    except InputError:
        if kind == "kinks":
            return None
        raise
    if (safety is not None and safety < 1.0) or not dam.start.stands:
        return None
    file = "" if case.motion is None else str(case.motion.file)
    if file in _RECORDS:
        record_named(file)
    response = answer(ShakenDam(case, dam, earthquake(case).shaking), _FRAMES, "full")
    crack = leading_crack([evidence.residual_slip_m.value for evidence in response.evidences])
    evidence = response.evidences[crack]
    moved = _moved(response.shaken, evidence, crack)
    by_mesh, by_step = moved[RESIDUAL_SLIP.key][2:] if evidence.converged else (None, None)
    return Judged(
        kind,
        seed,
        dam.lower is not None,
        evidence.residual_slip_m.value,
        evidence.residual_slip_m.uncertainty,
        evidence.converged,
        evidence.scatters,
        evidence.budget_spent,
        evidence.moved_most_by,
        evidence.runs,
        evidence.elements_across,
        by_mesh,
        by_step,
        moved,
    )


def _moved(shaken: ShakenDam, evidence: EvidenceNumbers, crack: int) -> dict[str, tuple[float, float, float, float]]:
    """Return the numbers of a crack that have a bound: value, uncertainty, and by how much twice the elements and a
    quarter of the step move it."""
    trials = Trials(shaken, evidence.time_step_s, _FRAMES)
    scales, halvings = SCALES[:1], 0
    if evidence.scatters:
        # Means are over runs at the longer of the two steps; 17 of them say enough.
        scales = tuple(evidence.scales[:: max(1, len(evidence.scales) // 17)])
        halvings = -round(math.log2((evidence.varied_time_step_s or evidence.time_step_s) / evidence.time_step_s))
    finer, shorter = Level(1, halvings), Level(0, halvings + 2)
    worths = {item.key: getattr(evidence, item.key) for item in HEADLINES}
    worths |= {CRACKED: evidence.cracked_length_m, CROSS_SLIP: evidence.residual_slip_cross_m}
    mesh, step = (trials.numbers(level, scales, crack) for level in (finer, shorter))
    return {
        key: (
            worth.value,
            worth.uncertainty,
            *(float(numbers[key].mean()) - worth.value for numbers in (mesh, step)),
        )
        for key, worth in worths.items()
        if worth is not None and worth.uncertainty is not None
    }


def judge_all(seeds: Iterable[int], file: Path, kind: Kind = "plain") -> Iterator[Judged]:
    """Judge the dams of some seeds, one after the other, those in the file not again."""
    lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    done = {line["seed"]: line for line in map(json.loads, lines)}
    for seed in seeds:
        if seed not in done:
            judged = judge(seed, kind)
            done[seed] = {"seed": seed} if judged is None else asdict(judged)
            with file.open("a", encoding="utf-8") as out:
                out.write(json.dumps(done[seed]) + "\n")
        if len(done[seed]) > 1:
            yield Judged(**done[seed])


def evidence() -> Iterator[Row]:
    """Random dams: of those that the program calls converged, how many stay within what it says."""
    yield from table([judged for seed in range(FEW) if (judged := judge(seed)) is not None])


def table(judged: list[Judged]) -> Iterator[Row]:
    """Return what became of dams: how many are converged, and how many of these stay where they are."""
    converged = [dam for dam in judged if dam.converged]
    covered = [dam for dam in converged if dam.covered]
    missed = ", ".join(map(str, (dam for dam in converged if not dam.covered)))
    share = len(covered) / len(converged) if converged else 1.0
    bound = np.floor(COVERED * len(converged)) / max(len(converged), 1)
    yield Row(
        f"converged, of {len(judged)}", len(judged), len(converged), None, relative=False, remark=_WHICH, kind="own run"
    )
    yield Row(
        "of these within their uncertainty with twice the elements and a quarter of the step",
        1.0,
        share,
        1.0 - bound,
        relative=False,
        remark=missed or "none leaves it",
        kind="condition",
    )


def print_numbers(judged: list[Judged]) -> None:
    """Print of each number with a bound how many dams keep it, as a table of docs/validation/flexible-choices.md."""
    keys = list(dict.fromkeys(key for dam in judged for key in dam.numbers))
    for key in keys:
        numbers = [dam.numbers[key] for dam in judged if key in dam.numbers]
        kept = [abs(moved[0]) <= bound and abs(moved[1]) <= bound for _, bound, *moved in numbers]
        sys.stdout.write(f"| {key} | {len(kept)} | {sum(kept)} |\n")


if __name__ == "__main__":
    first, count, name = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    wanted = KINDS[KINDS.index(sys.argv[4])] if len(sys.argv) > 4 else KINDS[0]
    judged = []
    for dam in judge_all(range(first, first + count), name, wanted):
        judged.append(dam)
        sys.stdout.write(f"{dam}\n")
        sys.stdout.flush()
    for row in table(judged):
        sys.stdout.write(f"{row.what}: {row.ours:.3g}; {row.remark}\n")
    print_numbers(judged)
