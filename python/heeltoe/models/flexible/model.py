"""The flexible model: case -> two elastic parts in their modes -> kernel -> response."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from heeltoe.base.beside import beside, pass_notes
from heeltoe.case.combinations import check
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.kernel.dam import DamRun, Ending
from heeltoe.mechanics.block import Block, build_block, static_state
from heeltoe.mechanics.references import cited
from heeltoe.models.flexible.body.cost import check_cost
from heeltoe.models.flexible.body.reduced import FlexibleDam, build_flexible_dam
from heeltoe.models.flexible.evidence.growth import self_excitation
from heeltoe.models.flexible.evidence.refinement import FEWEST, Answer, answer, build_ahead
from heeltoe.models.flexible.evidence.trials import LARGER, Level, Trials
from heeltoe.models.flexible.result.envelope import envelope_of
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.models.flexible.result.tables import crack_responses, crest_of, dam_numbers, energy_of, histories_of_cracks
from heeltoe.models.flexible.result.tension import tension_of, tension_warnings
from heeltoe.models.flexible.result.water import water_warnings
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.expected import analysing, frame_step_of
from heeltoe.models.flexible.run.slip_history import Worn, law_warnings, worn_of
from heeltoe.models.flexible.warnings import judge_outcome, stands, warnings_of
from heeltoe.models.runner import STEP, beside_one_component, until_rest, where_of
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.contract import CRACKED, RESIDUAL_SLIP, WIDTH, headlines
from heeltoe.result.crest import CrestMotion, crest_peaks
from heeltoe.result.judge import CREST_LIMITS, Judgement, judge, leading_crack
from heeltoe.result.limits import allowances
from heeltoe.result.numbers import AssumedRock, EvidenceNumbers, RockTrial, SelfExcitation, SignNumbers
from heeltoe.result.outcome import Outcome
from heeltoe.result.rest import LAST_S, last_change, still_since
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

_SHORTEST_FRAME_STEP = 1e-3


def run_flexible(
    case: Case, earthquake: Earthquake, output_step: float | None = None, first: Rested | None = None
) -> FlexibleResponse:
    """Run the flexible model on a case, on through silence until the dam is at rest.

    Parameters
    ----------
    case
        Dam, crack and water.
    earthquake
        What shakes the ground.
    output_step
        Spacing of the histories [s]; 0.01 s where it is not given.
    first
        The run without evidence, where it has been made before.

    Raises
    ------
    InputError
        Where the case has no modulus or a mesh or a step that cannot be used.
    """
    check(case, "flexible")
    end = earthquake.end
    if output_step is not None and not _SHORTEST_FRAME_STEP <= output_step <= end:
        raise InputError(
            "frame-step", "output_step", f"{output_step:g} s", shortest=f"{_SHORTEST_FRAME_STEP:g} s", end=f"{end:g} s"
        )
    block = build_block(case)
    frame_step = frame_step_of(end, output_step)
    silence = max(case.analysis.silence - earthquake.silence, 0.0)
    check_cost(case, analysing(case, earthquake.run_end, frame_step, silence=silence))
    first = first or run_until_rest(case, build_flexible_dam(case), block, earthquake, frame_step)
    begun, ending = first, Ending()
    # The growth at the first mesh and step, which are seldom too coarse.
    with beside(lambda: _growth(begun.shaken, begun.run, begun.outcome, begun.leads, ending), ending.ask) as at_first:
        result, earthquake = answer_at_rest(case, block, earthquake, frame_step, first)
    shaken, run = result.shaken, result.run
    # Its mesh may be finer by now.
    case, dam = shaken.case, shaken.dam
    outcome, advice = judge_outcome(dam, block, run, earthquake.silence)
    histories, envelope = histories_of_cracks(case, dam, run), envelope_of(dam, run)
    worn = [worn_of(alone, place, dam, run) for place, alone in enumerate(case.single_crack_cases)]
    tension = None if outcome is Outcome.UNSTABLE else tension_of(result, envelope)
    crest = crest_of(shaken, run)
    cracks = tuple(crack_responses(result, histories, static_state(block), crest))
    leads = leading_crack([crack.residual_slip_m for crack in cracks])
    is_first = run is first.run and leads == first.leads
    growth = at_first.result() if is_first else _growth(shaken, run, outcome, leads)
    rock = assumed_rock(case, block, begun.earthquake, frame_step, leads) if outcome.has_result else None
    numbers = dam_numbers(shaken, run, growth, tension, rock)
    response = FlexibleResponse(
        model="flexible",
        title=case.title,
        outcome=outcome,
        advice=advice,
        warnings=(
            *water_warnings(numbers.water_pressure),
            *warnings_of(shaken, run, histories, result.evidences, growth, block, outcome, leads),
            *tension_warnings(tension),
            *_about_the_laws(case, worn),
        ),
        energy=energy_of(run),
        motion=earthquake.motion,
        vertical=earthquake.vertical,
        gravity=case.gravity,
        cracks=cracks,
        asked=leads,
        dam=numbers,
        references=_references(case, dam),
        silence_s=earthquake.silence,
        envelope=envelope,
        crest=crest.motion(case.gravity),
        cross=earthquake.cross,
    )
    return response if shaken.across is None else _beside_one_component(response, result, block)


def _beside_one_component(response: FlexibleResponse, result: Answer, block: Block) -> FlexibleResponse:
    """Add to a response of these runs what the same dam does at the same step without the shaking across the valley: in
    the mean of as many runs where single runs scatter, as the difference of two of them is scatter."""
    shaken, leads = result.shaken, response.asked
    along = ShakenDam(shaken.case, shaken.dam, shaken.shaking.along_stream())
    frame_step = frame_step_of(shaken.shaking.end, None)
    if result.evidences and (evidence := result.evidences[leads]).scatters:
        trials, level = Trials(along, evidence.varied_time_step_s or evidence.time_step_s, frame_step), Level(0, 0)
        slips = trials.numbers(level, evidence.scales, leads)[RESIDUAL_SLIP.key]
        good = trials.have_results(level, evidence.scales)
        mean = float(slips[good].mean()) if np.sum(good) >= FEWEST else None
        return beside_one_component(response, str(trials.outcome(level)), mean, evidence.residual_slip_m.value)
    summary = result.run.summaries[leads]
    without = along.run(summary.end_time / summary.steps, frame_step, stresses=False)
    outcome, _ = judge_outcome(shaken.dam, block, without, response.silence_s)
    slip = without.summaries[leads].slip if outcome.has_result else None
    return beside_one_component(response, str(outcome), slip, summary.slip)


def assumed_rock(case: Case, block: Block, earthquake: Earthquake, frame_step: float, leads: int) -> AssumedRock | None:
    """Return the rock that is assumed below a dam, and how far the crack that leads slips on other rock; None where the
    case says which rock it is. Softer rock takes its shapes from that of the evidence that answers well up to a
    higher frequency, stiffer rock from the assumed one."""
    rock = case.foundation
    if rock is None or not case.surroundings.assumed:
        return None
    moduli: list[float | None] = [rock.modulus / 2.0, 2.0 * rock.modulus, None]
    if case.flexible.evidence == "none":
        return AssumedRock(modulus_pa=rock.modulus, trials=[])
    ending = Ending()

    def trial(modulus: float | None) -> RockTrial:
        if modulus is None:
            other = case.on_rigid_plane()
            dam = build_flexible_dam(other)
        else:
            other = case.on_rock(modulus)
            dam = build_flexible_dam(other, LARGER if modulus < rock.modulus else 1.0, rock.modulus)
        rested = run_until_rest(
            other, dam, block, earthquake, frame_step, step_of=_step_beside, stresses=False, ending=ending
        )
        slip = rested.run.summaries[leads].slip if rested.outcome.has_result else None
        return RockTrial(modulus_pa=modulus, outcome=rested.outcome, residual_slip_m=slip)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        trials = [pool.submit(trial, modulus) for modulus in moduli]
        try:
            return AssumedRock(modulus_pa=rock.modulus, trials=[each.result() for each in trials])
        except BaseException:
            ending.ask()
            pool.shutdown(cancel_futures=True)
            raise


def _step_beside(shaken: ShakenDam) -> float:
    return shaken.step_beside(shaken.first_step())


def _growth(
    shaken: ShakenDam, run: DamRun, outcome: Outcome, leads: int, ending: Ending | None = None
) -> SelfExcitation | None:
    # One that slides by itself needs no vibration to go on.
    return None if outcome is Outcome.UNSTABLE else self_excitation(shaken, run, leads, ending)


class Rested(NamedTuple):
    """A run of a dam until it is at rest.

    Attributes
    ----------
    earthquake
        With the silence that it took.
    shaken, run
        The dam with its earthquake, and what it did.
    outcome, advice
        How the run ended, and what to do about it where there is no result.
    """

    earthquake: Earthquake
    shaken: ShakenDam
    run: DamRun
    outcome: Outcome
    advice: Sentence | None

    @property
    def reach(self) -> float:
        """Largest reach of the cracks, for :func:`until_rest`."""
        if self.outcome != "ok":
            return -math.inf
        reach = -math.inf
        for frames in self.run.all_frames:
            moved = (frames.time, frames.slip, frames.gap_heel, frames.gap_toe)
            reach = max(reach, still_since(*moved) + LAST_S if last_change(*moved).rest else math.inf)
        return reach

    @property
    def leads(self) -> int:
        """Which of its cracks slips most."""
        return leading_crack([summary.slip for summary in self.run.summaries])

    def crest(self, case: Case) -> CrestMotion:
        """Return how the crest moves."""
        return crest_of(self.shaken, self.run).motion(case.gravity)

    def judged(self, case: Case) -> Judgement:
        """Return its judgement by the limits of the case, one row."""
        rows = [summary.by_name() for summary in self.run.summaries]
        dam = self.shaken.dam
        width = np.array([[section.crack_width for section in dam.sections]])
        joint = [line.bond is not None for line in dam.lines]
        columns = {
            **headlines({name: np.array([[row[name] for row in rows]]) for name in rows[0]}),
            WIDTH: width,
            CRACKED: np.where(joint, np.minimum([row["cracked_length"] for row in rows], width), 0.0),
        }
        if any(getattr(case.limits, name) is not None for name in CREST_LIMITS):
            # Its accelerations take as long as a quarter of a run.
            columns |= {key: np.array([[value]]) for key, value in crest_peaks(self.crest(case)).items()}
        return judge({"outcome": [self.outcome], **columns}, allowances(case.limits, case.gravity))

    def sign_numbers(self, case: Case, sign: str) -> SignNumbers:
        """Return what it says of the sign of its motion that does not govern."""
        known, rows, section = self.outcome.has_result, self.run.summaries, self.shaken.dam.sections[self.leads]
        return SignNumbers(
            sign=sign,
            governs=False,
            outcome=self.outcome,
            elevation_m=section.heel[1] - section.base_elevation if known else None,
            residual_slip_m=rows[self.leads].slip if known else None,
            opening_m=max(max(row.opening_upstream, row.opening_downstream) for row in rows) if known else None,
            limits_not_met=self.judged(case).badness()[1],
        )


def run_until_rest(
    case: Case,
    dam: FlexibleDam,
    block: Block,
    earthquake: Earthquake,
    frame_step: float,
    *,
    step_of: Callable[[ShakenDam], float] = ShakenDam.first_step,
    stresses: bool = True,
    ending: Ending | None = None,
) -> Rested:
    """Run a dam, without evidence, until it is at rest: what single runs, rows of studies and drains between motions
    are made of.

    Parameters
    ----------
    case, dam, block
        The dam, its elastic parts, and the part above its crack as a block.
    earthquake
        What shakes the ground.
    frame_step
        Spacing of the frames [s], by which rest is told.
    step_of
        Says the time step [s].
    stresses
        Whether the extremes of the stresses are wanted, too.
    ending
        What ends a run on another thread than the main one.

    Raises
    ------
    InputError
        Where the step cannot be used, or the run takes too much.
    """

    def run(through: Earthquake) -> Rested:
        shaken = ShakenDam(case, dam, through.shaking)
        step = step_of(shaken)
        # Water and anchors may have made it shorter than could be expected.
        check_cost(case, analysing(case, through.run_end, frame_step, step))
        response = shaken.run(step, frame_step, ending, stresses=stresses)
        return Rested(through, shaken, response, *judge_outcome(dam, block, response, through.silence))

    longest = case.analysis.silence
    shaken = ShakenDam(case, dam, earthquake.shaking)
    step = step_of(shaken)
    pauses = shaken.pauses(step, STEP, longest) if longest and not earthquake.silence else None
    if pauses is None:
        return until_rest(run, lambda rested: rested.reach, earthquake, longest)
    # One run goes on from where it is, and ends where the dam is at rest.
    bare = case.without_evidence()
    check_cost(case, analysing(bare, earthquake.run_end + longest, frame_step, step))
    response = shaken.run(step, frame_step, ending, stresses=stresses, pauses=pauses)
    seconds = STEP * math.ceil((response.summary.end_time - earthquake.end) / STEP - 0.5)
    through = earthquake.silent(min(max(seconds, 0.0), longest))
    outcome = judge_outcome(dam, block, response, through.silence)
    return Rested(through, ShakenDam(case, dam, through.shaking), response, *outcome)


def rest_of(
    case: Case,
    earthquake: Earthquake,
    *,
    output_step: float | None = None,
    step_of: Callable[[ShakenDam], float] = ShakenDam.first_step,
) -> Callable[[Earthquake], Rested]:
    """Return what runs a dam until it is at rest, its elastic parts built once.

    Raises
    ------
    InputError
        Where the case has no modulus or a mesh that cannot be used.
    """
    check(case, "flexible")
    dam, block = build_flexible_dam(case), build_block(case)
    frame_step = frame_step_of(earthquake.end, output_step)

    def run(through: Earthquake) -> Rested:
        return run_until_rest(case, dam, block, through, frame_step, step_of=step_of, stresses=False)

    return run


def rest_both_ways(case: Case, earthquake: Earthquake, output_step: float | None) -> list[Rested]:
    """Run a dam with its motion as recorded and reversed until it is at rest, without evidence; one that does not stand
    with its motion as recorded alone. The tables that the evidence needs are built meanwhile.

    Raises
    ------
    InputError
        As :func:`run_until_rest`.
    """
    check(case, "flexible")
    dam, block, ending = build_flexible_dam(case), build_block(case), Ending()
    frame_step = frame_step_of(earthquake.end, output_step)

    def run(through: Earthquake) -> Rested:
        return run_until_rest(case, dam, block, through, frame_step, ending=ending)

    if not stands(dam, block):
        return [run(earthquake)]
    with ThreadPoolExecutor(2) as pool:
        ways = [pool.submit(run, through) for through in (earthquake, earthquake.reversed())]
        try:
            if case.flexible.evidence == "full":
                # What cannot be built is for the runs and the evidence to complain about.
                with suppress(InputError):
                    build_ahead(ShakenDam(case, dam, earthquake.shaking), frame_step)
            return [way.result() for way in ways]
        except BaseException as error:
            ending.ask()
            pool.shutdown()
            pass_notes(ways, error)
            raise


def runs_as_beside(case: Case, earthquake: Earthquake, evidence: EvidenceNumbers) -> bool:
    """Return whether the run with this evidence has mesh and step of those that stand beside it."""
    step = _step_beside(ShakenDam(case, build_flexible_dam(case), earthquake.shaking))
    return evidence.elements_across == case.flexible.elements_across and evidence.time_step_s == step


def rest_each(
    cases: Mapping[str, Case], shakings: Mapping[str, Earthquake], output_step: float | None
) -> dict[str, list[SignNumbers]]:
    """Run dams that differ in friction alone until they are at rest, side by side, without evidence and at a longer
    step where that may be; return what each does in each of the earthquakes, which are named by the sign of the motion.

    Raises
    ------
    InputError
        As :func:`run_until_rest`.
    """
    ending = Ending()

    def run(case: Case, sign: str) -> SignNumbers:
        shaking = shakings[sign]
        frame_step = frame_step_of(shaking.end, output_step)
        dam, block = build_flexible_dam(case), build_block(case)
        rested = run_until_rest(
            case, dam, block, shaking, frame_step, step_of=_step_beside, stresses=False, ending=ending
        )
        return rested.sign_numbers(case, sign)

    for case in cases.values():
        check(case, "flexible")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        ways = {name: [pool.submit(run, case, sign) for sign in shakings] for name, case in cases.items()}
        try:
            return {name: [way.result() for way in each] for name, each in ways.items()}
        except BaseException as error:
            ending.ask()
            pool.shutdown(cancel_futures=True)
            pass_notes([way for each in ways.values() for way in each], error)
            raise


def answer_at_rest(
    case: Case, block: Block, earthquake: Earthquake, frame_step: float, first: Rested | None = None
) -> tuple[Answer, Earthquake]:
    """Run a dam until it is at rest, and gather evidence up to there; return the earthquake with its silence, too.
    `first` is the run without evidence, where it has been made before."""
    dam = build_flexible_dam(case) if first is None else first.shaken.dam
    first = first or run_until_rest(case, dam, block, earthquake, frame_step)
    # A dam that does not stand, or keeps sliding, has no slip to be certain of; one run shows how it goes.
    certain = stands(dam, block) and first.outcome is not Outcome.KEEPS_SLIDING
    asked = case.flexible.evidence if certain else "none"
    reply = answer(first.shaken, frame_step, asked, first.run)
    rested = first._replace(run=reply.run, outcome=judge_outcome(dam, block, reply.run, first.earthquake.silence)[0])
    if rested.reach < math.inf or first.earthquake.silence >= case.analysis.silence:
        return reply, first.earthquake
    # Its mesh or step is finer now, and it takes longer.
    longer = run_until_rest(case, dam, block, earthquake.silent(case.analysis.silence), frame_step)
    return answer(longer.shaken, frame_step, asked, longer.run), longer.earthquake


def _references(case: Case, dam: FlexibleDam) -> tuple[str, ...]:
    keys = ["flexible", case.flexible.contact]
    moved = [(body.mass - body.mass_concrete).diagonal() for body in dam.bodies]
    if moved[0].any():
        keys.append("water")
    if any(water[1::2].any() for water in moved):
        keys.append("sloped water")
    if any(line.water is not None for line in dam.lines):
        keys.append(case.uplift.during_shaking)
    if case.concrete.tensile_strength is not None:
        keys.append("dynamic tension")
    keys += [f"law: {alone.crack.law.name}" for alone in case.single_crack_cases if alone.crack.law is not None]
    return cited(*dict.fromkeys(keys))


def _about_the_laws(case: Case, worn: Sequence[Worn | None]) -> Iterator[Notice]:
    """Say of each crack with a law where that is used beyond what it was made for."""
    for alone, wear in zip(case.single_crack_cases, worn, strict=True):
        if wear is not None:
            yield from law_warnings(wear, where_of(case, alone))
