"""Runs of one dam in one earthquake at several meshes, steps and strengths of the shaking, none of them twice."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.base.beside import pass_notes
from heeltoe.errors.error import InputError
from heeltoe.kernel.dam import DAM_OUTCOMES, DamRun, Ending
from heeltoe.models.cost import Cost
from heeltoe.models.flexible.body.cost import building, parts_of, surroundings_of
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.expected import running, with_mesh
from heeltoe.models.runner import largest_rotation, leaves
from heeltoe.result.contract import CRACKED, HEADLINES, headlines
from heeltoe.result.outcome import Outcome, decide

#: Length of a joint that softens [m], beside the headline numbers.
SOFTENING = "softening_length_m"
#: Slip across the valley at the end [m], beside them, too.
CROSS_SLIP = "residual_slip_cross_m"
#: Factors on the shaking: as it is, and up to 1 % either way.
SCALES: tuple[float, ...] = (1.0, 0.99, 0.995, 1.005, 1.01)
# Steps between the least and the largest factor of the smallest sample.
_OF_SAMPLE = 16
#: Rock and water that reach farther do so by this factor, and answer well up to a frequency that is higher by it.
LARGER = 1.5
# Twice as many elements along the crack cost about so many times as much; half the step twice.
_WORK_OF_MESH = 4.0


def scales_of(doublings: int) -> tuple[float, ...]:
    """Return 17 factors on the shaking, equally spaced from 0.99 to 1.01, or about twice as many as often as
    `doublings` says; those of fewer doublings and :data:`SCALES` are among them."""
    # Rounded, so that the same factor is the same number.
    spaced = np.linspace(0.99, 1.01, _OF_SAMPLE * 2**doublings + 1)
    return tuple(round(float(scale), 12) for scale in spaced)


@dataclass(frozen=True, order=True)
class Level:
    """Fineness of a run: twice the elements along the crack and half the step, as many times as the level counts; -1 is
    half the elements and twice the step; and whether rock and water reach farther."""

    mesh: int
    halvings: int
    larger: bool = False

    @property
    def work(self) -> float:
        """Cost of a run relative to one at level 0."""
        return float(_WORK_OF_MESH**self.mesh * 2.0**self.halvings)


class Trials:
    """Runs of one dam in one earthquake.

    Parameters
    ----------
    shaken
        The dam as its case has it, level 0 of the meshes.
    step
        That of runs that scatter [s], level 0 of the steps.
    frame_step
        Spacing of the frames of whole runs [s].
    made
        Runs with frames that have been made before, by their levels.
    """

    def __init__(
        self, shaken: ShakenDam, step: float, frame_step: float, made: Mapping[Level, DamRun] | None = None
    ) -> None:
        self.step = step
        self._frame_step = frame_step
        self._shaken = {(0, False): shaken}
        # Of each crack.
        self._numbers: dict[tuple[Level, float], tuple[dict[str, float], ...]] = {}
        self._whole: dict[Level, DamRun] = {}
        self._ending = Ending()
        for level, run in (made or {}).items():
            self._keep(level, run)

    @property
    def runs(self) -> int:
        """How many there have been."""
        return len(self._numbers)

    @property
    def work(self) -> float:
        """Cost of all runs together, in runs at level 0."""
        return sum(level.work for level, _ in self._numbers)

    def cost(self, wanted: Iterable[tuple[Level, Sequence[float]]]) -> float:
        """Return what the runs that are still to be made would cost."""
        runs = {(level, scale) for level, scales in wanted for scale in scales}
        return sum(level.work for level, _ in runs - self._numbers.keys())

    def expected(self, level: Level, work: float) -> Cost:
        """Return the estimated cost of `work` runs at level 0, with one at another level among them."""
        first = self._shaken[0, False]
        case, end = with_mesh(first.case, level.mesh), first.shaking.end
        parts = building(parts_of(case), surroundings_of(case))
        runs = running(first.case, end, self._frame_step, self.step, runs=work)
        finest = running(case, end, self._frame_step, self.step_of(level))
        return Cost(parts.seconds + runs.seconds, parts.memory + finest.memory)

    def dam_of(self, mesh: int, *, larger: bool = False) -> ShakenDam:
        """Return the dam with another mesh, or with rock and water that reach farther."""
        if (mesh, larger) not in self._shaken:
            first = self._shaken[0, False]
            case = with_mesh(first.case, mesh)
            dam = build_flexible_dam(case, LARGER if larger else 1.0)
            self._shaken[mesh, larger] = replace(first, case=case, dam=dam)
        return self._shaken[mesh, larger]

    def has_mesh(self, mesh: int, least: int) -> bool:
        """Whether the dam has another mesh with at least `least` elements along its crack."""
        if with_mesh(self._shaken[0, False].case, mesh).flexible.elements_across < least:
            return False
        try:
            self.dam_of(mesh)
        except InputError:
            # So few elements do not follow its kinks.
            return False
        return True

    def across_of(self, level: Level) -> int:
        """Return how many elements there are along the crack."""
        return self.dam_of(level.mesh).case.flexible.elements_across

    def step_of(self, level: Level) -> float:
        """Return the length of a step [s]."""
        return float(self.step / 2.0**level.halvings)

    def whole(self, level: Level) -> DamRun:
        """Return a run with its frames, for the unscaled shaking."""
        if level not in self._whole:
            response = self.dam_of(level.mesh).run(self.step_of(level), self._frame_step, self._ending)
            self._keep(level, response)
        return self._whole[level]

    def _keep(self, level: Level, run: DamRun) -> None:
        self._whole[level] = run
        self._numbers[level, 1.0] = tuple(summary.by_name() for summary in run.summaries)

    def prepare(self, whole: Sequence[Level], wanted: Iterable[tuple[Level, Sequence[float]]]) -> None:
        """Make runs with frames, the first of which shows its progress, and others side by side: the kernel lets go of
        the interpreter."""

        def make(one: tuple[Level, Sequence[float]]) -> None:
            level, scales = one
            # That of the shaking as it is has its frames.
            self.numbers(level, [scale for scale in scales if level not in whole or scale != 1.0])

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            shown, *others = [pool.submit(self.whole, level) for level in whole]
            try:
                list(pool.map(make, wanted))
                for item in (shown, *others):
                    item.result()
            except KeyboardInterrupt as error:
                # Threads hear of no signal; what the run with frames has come to is told.
                self._ending.ask()
                pool.shutdown(cancel_futures=True)
                pass_notes([shown], error)
                raise

    @property
    def cracks(self) -> int:
        """How many there are."""
        return len(self._shaken[0, False].dam.lines)

    @property
    def asked(self) -> int:
        """Which of them is asked of."""
        return self._shaken[0, False].dam.asked

    def numbers(self, level: Level, scales: Sequence[float], crack: int = 0) -> dict[str, Floats]:
        """Return the headline numbers of a crack in runs with these factors on the shaking, (n,) by name."""
        missing = [scale for scale in scales if (level, scale) not in self._numbers]
        if missing:
            tables = self.dam_of(level.mesh, larger=level.larger).run_scaled_cracks(
                self.step_of(level), np.array(missing), self._ending
            )
            for place, scale in enumerate(missing):
                self._numbers[level, scale] = tuple(
                    {name: float(column[place]) for name, column in table.items()} for table in tables
                )
        rows = [self._numbers[level, scale][crack] for scale in scales]
        lines = headlines({item.column: np.array([row[item.column] for row in rows]) for item in HEADLINES})
        width = self.dam_of(level.mesh).dam.sections[crack].crack_width
        softening = np.array([row["softening_length"] for row in rows])
        return lines | {
            CRACKED: np.minimum([row["cracked_length"] for row in rows], width),
            SOFTENING: softening,
            CROSS_SLIP: np.array([row["cross_slip"] for row in rows]),
        }

    def have_results(self, level: Level, scales: Sequence[float]) -> NDArray[np.bool_]:
        """Return (n,) which of these runs, all made before, end with a result."""
        return np.array([self.outcome(level, scale).has_result for scale in scales])

    def outcome(self, level: Level, scale: float = 1.0) -> Outcome:
        """Return how a run that was made before ends."""
        cracks = self._numbers[level, scale]
        widths = [section.crack_width for section in self.dam_of(level.mesh).dam.sections]
        rotation = max(float(largest_rotation(row)) for row in cracks)
        return decide(DAM_OUTCOMES[int(cracks[0]["outcome"])], rotation=rotation, off=bool(leaves(cracks, widths)))
