"""Verdict on a response, in a few sentences."""

from __future__ import annotations

import math
from collections.abc import Sequence

from heeltoe.result.contract import JOINT_METER_M, LEAST_M, LEAST_RAD
from heeltoe.result.judge import LimitCheck
from heeltoe.result.numbers import (
    BEST,
    AssumedRock,
    BlockBond,
    BondState,
    CrossValley,
    EvidenceNumbers,
    FrictionEffect,
    FrictionTrial,
    HeadlineWorth,
    RockTrial,
)
from heeltoe.result.outcome import Outcome
from heeltoe.result.record import CrackResponse, ResponseData
from heeltoe.result.rest import comes_to_rest, last_of, motion_end, rests_from
from heeltoe.result.sequence import sequence_sentence
from heeltoe.result.tension import tension_sentence
from heeltoe.units.sentences import listed, written
from heeltoe.units.write import angle, length, lengths, measured, speed

# Less time in the air in all [s] is a few bounces, which the strikes tell of.
_IN_THE_AIR_S = 0.05
# Less time on one end of the crack in all [s] is a blow, and no rocking.
_ROCKS_S = 0.02
# More joints than these are told together.
_SINGLY = 2
# Of more joints or cracks than these the ones that crack or move most are named, and what the others do at most.
_NAMED = 4
# What a model takes the dam for.
_AS = {"rigid": "As a rigid block", "decoupled": "As a rigid block on an elastic part below it"}


def verdict(response: ResponseData, units: str = "si", *, brief: bool = False) -> str:
    """Say what the part above the crack does, and whether it is at rest in the end, in units ``"si"`` or ``"us"``.

    Of several cracks that which slips most leads, and the others follow. A brief verdict leaves out the openings of an
    elastic dam, for where a table shows them, and when it comes to rest.
    """
    if not response.ok:
        # Of two signs of the motion the other may have a result, which must not go unsaid.
        failure = f"No result to trust ({response.outcome}): {advice(response, units)}."
        rest = (_signs(response, units), _limits(response, units))
        return " ".join(sentence for sentence in (failure, *rest) if sentence)
    if response.outcome == Outcome.OVERTURNED:
        about = response.overturned_about
        way = "downstream" if about == "toe" else "upstream"
        sentences = [
            f"{_AS[response.model]}, the dam overturns {way}, about its {about}: it lies on its side at "
            f"{response.end_time_s:.2f} s, where the run and its histories end."
        ]
    elif response.elastic:
        sentences = [
            joint_sentence(response, units),
            _elastic_slip(response, units),
            across_sentence(response, units),
            _elastic_rocking(response) if brief else _openings(response, units),
            _other_cracks(response, units, brief),
            _elastic_end(response, units, brief),
            rock_sentence(response, units),
            tension_sentence(getattr(response, "tension", None), units),
        ]
    else:
        sentences = [
            _bond_of_block(response),
            _slip(response, units),
            across_sentence(response, units),
            _rocking(response, units),
            _other_cracks(response, units, brief),
            _end(response),
        ]
    band = "" if brief else band_sentence(response, units)
    sentences += [sequence_sentence(response.sequence, units), _signs(response, units), band, _limits(response, units)]
    return " ".join(sentence for sentence in sentences if sentence)


def advice(response: ResponseData, units: str = "si") -> str:
    """Say where a run without a result stopped and what to do about it; nothing where there is a result."""
    return "" if response.advice is None else response.advice.text(units)


def _signs(response: ResponseData, units: str) -> str:
    """Say what the motion does the other way round, where both were run."""
    if not response.signs:
        return ""
    own, other = sorted(response.signs, key=lambda way: not way.governs)
    does = "it ends without a result"
    if other.outcome == Outcome.OVERTURNED:
        does = "it overturns, too"
    elif other.residual_slip_m is not None:
        slip, one = abs(other.residual_slip_m), "a single run" if _means(response) else "it"
        does = f"{one} slides {length(slip, units)}" if slip else f"{one} does not slide"
    words = {"recorded": "as recorded", "reversed": "reversed"}
    return f"This is for the motion {words[own.sign]}; {words[other.sign]} {does}."


def band_sentence(response: ResponseData, units: str = "si") -> str:
    """Say what the dam does with the other frictions that its crack may have; nothing without a band."""
    if response.friction_band is None:
        return ""
    return " ".join(
        f"With a {trial.friction.text(units)} it {trial_text(trial, units)}."
        for trial in response.friction_band.trials
        if trial.name != BEST
    )


def trial_text(trial: FrictionTrial | FrictionEffect, units: str) -> str:
    """Say what the dam does with one friction."""
    if trial.outcome == Outcome.OVERTURNED:
        return "overturns"
    if trial.outcome == Outcome.KEEPS_SLIDING:
        return "keeps sliding"
    if trial.residual_slip_m is None:
        return f"comes to no result ({trial.outcome})"
    slip = abs(trial.residual_slip_m)
    return f"slides {length(slip, units)} {_way(trial.residual_slip_m)}" if slip else "does not slide"


def effect_sentence(effect: FrictionEffect, units: str) -> str:
    """Say what the dam does with a little less friction."""
    does, change = trial_text(effect, units), effect.slip_change_m
    more = "" if not change else f", {length(abs(change), units)} {'more' if change > 0.0 else 'less'}"
    return f"With {abs(effect.friction_change):g} less friction it {does}{more}."


def _limits(response: ResponseData, units: str) -> str:
    """Say which of the limits that the user has set are met, and by which friction of a band."""
    text = _limits_met(response, units)
    if not text or response.friction_band is None:
        return text
    return f"The limits judge a {response.friction_band.judged.friction.text(units)}: {text}"


def _limits_met(response: ResponseData, units: str) -> str:
    """Say which of the limits that the user has set are met."""
    if not response.limits:
        return ""
    if all(check.failed for check in response.limits):
        failed = response.outcome.sentence if response.outcome.failed else "the part above slides off its crack"
        return f"No limit is met: {failed}."
    broken = [_broken(check, units) for check in response.limits if not check.met]
    if broken:
        doubt = "" if any(check.certain for check in response.limits if not check.met) else ", though not for certain"
        subject = "A limit is" if len(broken) == 1 else f"{len(broken)} limits are"
        return f"{subject} not met{doubt}: {listed([f'its {item}' for item in broken])}.{_chance(response)}"
    doubted = [
        f"{limited(check, units)} of {_judged(check, units)} may be more than the "
        f"{measured(check.allowed, check.unit, units)} allowed"
        for check in response.limits
        if not check.certain
    ]
    if doubted:
        may = listed([f"its {item}" for item in doubted])
        return f"All limits are met, but not for certain: {may}.{_chance(response)}"
    if response.model == "rigid":
        return "As a rigid block it meets all limits; as a dam that vibrates it may not."
    if response.model == "decoupled":
        return "As a rigid block it meets all limits; as a dam whose top vibrates, too, it may not."
    return f"All limits are met.{_chance(response)}"


def _broken(check: LimitCheck, units: str) -> str:
    """Say by which size a limit is not met, or that too many runs exceed it."""
    allowed = measured(check.allowed, check.unit, units)
    if check.value is not None and check.value <= check.allowed:
        return f"{limited(check, units)} is above the {allowed} allowed, or has no result, in too many runs"
    return f"{limited(check, units)} of {_judged(check, units)} is more than the {allowed} allowed"


def _chance(response: ResponseData) -> str:
    """Say how many of the runs with the shaking varied exceed a limit, where single runs scatter."""
    judged: dict[str, list[str]] = {}
    for check in response.limits:
        if check.exceeding is not None:
            judged.setdefault(_share_of_runs(check.exceeding), []).append(check.label)
    labels = [label for group in judged.values() for label in group]
    if not labels:
        return ""
    subject = "Limits" if len(labels) == len(response.limits) else _limits_of(labels).replace("the", "The", 1)
    verb = "is" if subject.startswith("The limit of") else "are"
    shares = [f"{runs} {_limits_of(group)}" for runs, group in judged.items()]
    if len(shares) == 1 < len(labels):
        shares = [f"{runs} each of them" for runs in judged]
    runs = "what 84 % of the runs with the shaking varied by 1 % keep to"
    return f" {subject} {verb} judged on {runs}: {'; '.join(shares)}."


def _limits_of(labels: Sequence[str]) -> str:
    return f"the limit{'s' if len(labels) > 1 else ''} of {listed(labels)}"


def _share_of_runs(share: float) -> str:
    if share in (0.0, 1.0):
        return "all runs exceed" if share else "no run exceeds"
    return f"{100.0 * share:.0f} % of the runs exceed"


def limited(check: LimitCheck, units: str = "si") -> str:
    """Say what is limited, and at which of several cracks, in units ``"si"`` or ``"us"``."""
    crack = "joint" if check.name == "cracked_length" else "crack"
    at = "" if check.elevation_m is None else f" at the {crack} at {_level(check.elevation_m, units)}"
    return check.label + at


def _level(elevation: float, units: str) -> str:
    return written("{at_m:.4g m}", units, at_m=elevation)


def _judged(check: LimitCheck, units: str) -> str:
    """Return a result, and how uncertain it is where that decides."""
    assert check.value is not None
    value = measured(check.value, check.unit, units)
    if not check.certain:
        value = f"{value} ± {measured(check.uncertainty, check.unit, units)}"
    return value


def _spread(response: ResponseData, units: str) -> str:
    """Return the range of the residual slip with slightly different shaking, in brackets."""
    spread = None if response.spread is None else response.spread.residual_slip_m
    if spread is None:
        return ""
    low, high = sorted((abs(spread.min), abs(spread.max)))
    if spread.min * spread.max < 0.0:
        return f" (with the shaking varied by 1 %, {length(spread.min, units)} to {length(spread.max, units)})"
    return f" ({length(low, units)} to {length(high, units)} with the shaking varied by 1 %)"


def _slip(response: ResponseData, units: str) -> str:
    slip: float = response.residual_slip_m
    down, up = response.peak_slip_downstream_m, -response.peak_slip_upstream_m
    as_blocks = "As rigid blocks" if response.several else _AS[response.model]
    dam = f"{as_blocks}, {_subject(response, units)}"
    if max(down, up) == 0.0:
        return f"{dam} does not slide."
    if abs(slip) < LEAST_M:
        return f"{dam} slides to and fro by up to {length(max(down, up), units)} and ends where it began."
    text = f"{dam} slides {length(abs(slip), units)} {_way(slip)}{_spread(response, units)}"
    return text + _on_the_way(slip, down, up, LEAST_M, units) + "."


def across_sentence(response: ResponseData, units: str = "si") -> str:
    """Say what the shaking across the valley does to a dam; nothing where there is none."""
    across: CrossValley | None = getattr(response, "cross_valley", None)
    if across is None:
        return ""
    slip = across.residual_slip_cross_m
    bank = "left" if slip > 0.0 else "right"
    means, sentences = _means(response), []
    mean = "" if means is None else " in the mean"
    if abs(slip) >= LEAST_M:
        sentences.append(f"Across the valley it slides {length(abs(slip), units)}{mean} to the {bank} bank.")
    slip_worth = None if means is None else means.residual_slip_m
    adds, without = _share_across(across, slip_worth), across.without_cross_valley
    if adds and without is not None and without.residual_slip_m is not None:
        alone = length(abs(without.residual_slip_m), units)
        sentences.append(f"The shaking across the valley {adds}: without it the dam slides {alone}{mean}.")
    return " ".join(sentences)


def _share_across(across: CrossValley, mean: HeadlineWorth | None) -> str:
    """Say by how much the shaking across the valley changes the slip; nothing where that is not known. A `mean` slip
    has a standard error, as that without this shaking has one."""
    without = across.without_cross_valley
    if without is None or without.factor is None:
        return ""
    share = 100.0 * (without.factor - 1.0)
    if mean is not None:
        error = 100.0 * math.sqrt(2.0) * without.factor * (mean.shaking or 0.0)
        if abs(share * mean.value) <= abs(error):
            return "adds less than the scatter of single runs hides"
    if abs(share) < 0.5:
        return "adds nothing"
    return f"adds {share:.0f} %" if share > 0.0 else f"takes off {-share:.0f} %"


def joint_sentence(response: ResponseData, units: str = "si") -> str:
    """Say whether the joints of an elastic dam crack, from where, and what is left; nothing of a crack."""
    if not response.several:
        return _joint(response, "The joint", units)
    bonds: list[tuple[CrackResponse, BondState]] = [
        (crack, bond) for crack in response.cracks if (bond := getattr(crack, "joint", None)) is not None
    ]
    if len(bonds) > _SINGLY:
        return _joints_in_order(bonds, units)
    return " ".join(_joint(crack, f"The joint at {_level(crack.elevation, units)}", units) for crack, _ in bonds)


def _joints_in_order(bonds: Sequence[tuple[CrackResponse, BondState]], units: str) -> str:
    """Say of many joints which cracks first, which are cracked through, and how far the others are."""
    cracked = sorted(
        (bond.first_cracking_s, crack.elevation) for crack, bond in bonds if bond.first_cracking_s is not None
    )
    if not cracked:
        return f"None of the {len(bonds)} joints cracks."
    when, level = cracked[0]
    begins = "before the earthquake" if when == 0.0 else f"at {when:.2f} s"
    sentences = [f"The joint at {_level(level, units)} cracks first of {len(bonds)}, {begins}."]
    through = sorted(
        (bond.cracked_through_s, crack.elevation) for crack, bond in bonds if bond.cracked_through_s is not None
    )
    if through:
        places = [f"{_level(level, units)} ({when:.2f} s)" for when, level in through[:_NAMED]]
        if len(through) > _NAMED:
            places.append(f"{len(through) - _NAMED} more by {through[-1][0]:.2f} s")
        sentences.append(f"Cracked through: {listed(places)}.")
    parts = [
        (crack, bond) for crack, bond in bonds if bond.first_cracking_s is not None and bond.cracked_through_s is None
    ]
    if parts:
        farthest = sorted(parts, key=lambda part: -part[1].cracked_length_m / part[0].crack_width_m)[:_NAMED]
        places = [
            f"{_level(crack.elevation, units)} ({_of(bond.cracked_length_m, crack.crack_width_m, units)})"
            for crack, bond in parts
            if any(crack is one for one, _ in farthest)
        ]
        if len(parts) > _NAMED:
            places.append(f"{len(parts) - _NAMED} more less far")
        sentences.append(f"Cracked in part: {listed(places)}.")
    whole = len(bonds) - len(cracked)
    if whole:
        sentences.append(f"{'The other does' if whole == 1 else f'The other {whole} do'} not crack.")
    return " ".join(sentences)


def _of(part: float, whole: float, units: str) -> str:
    return " of ".join(lengths((part, whole), units))


def _bond_of_block(response: ResponseData) -> str:
    """Say how the bond below a rigid block fares; nothing of a crack."""
    bond: BlockBond | None = getattr(response, "bond", None)
    if bond is None:
        return ""
    if bond.breaks_s is None:
        used = max((bond.tensile_strength_used, "tensile"), (bond.shear_strength_used, "shear"))
        return (
            f"The bond below the block holds, so that the block does not move: it bears {100.0 * used[0]:.0f} % of its "
            f"{used[1]} strength at most."
        )
    when = "before the earthquake" if bond.breaks_s == 0.0 else f"at {bond.breaks_s:.2f} s"
    return f"The bond below the block breaks {when}, all at once, by {bond.breaks_by}."


def _joint(crack: ResponseData | CrackResponse, joint: str, units: str) -> str:
    bond: BondState | None = getattr(crack, "joint", None)
    if bond is None:
        return ""
    width: float = crack.crack_width_m
    if bond.first_cracking_s is None:
        softened = ""
        if bond.softening_length_m > 0.0:
            softened = f"; {length(bond.softening_length_m, units)} of it has softened"
        return f"{joint} does not crack over its {length(width, units)}{softened}."
    when = "before the earthquake" if bond.first_cracking_s == 0.0 else f"at {bond.first_cracking_s:.2f} s"
    if bond.cracked_through_s is not None:
        through = "already then" if bond.cracked_through_s == 0.0 else f"at {bond.cracked_through_s:.2f} s"
        return f"{joint} begins to crack {when} and is cracked through {through}."
    faces = [
        f"{length(cracked, units)} from the {face} face"
        for face, cracked in (("upstream", bond.cracked_upstream_m), ("downstream", bond.cracked_downstream_m))
        if cracked > 0.0
    ]
    if not faces:
        faces = [f"{length(bond.cracked_length_m, units)} between the faces"]
    how_far = f"{' and '.join(faces)} of {length(width, units)}{_certain(crack, units)}"
    return f"{joint} begins to crack {when}: {how_far}; the rest holds."


def _certain(crack: ResponseData | CrackResponse, units: str) -> str:
    """Return how certain the cracked length of a joint is."""
    evidence = getattr(crack, "evidence", None)
    worth = None if evidence is None else evidence.cracked_length_m
    return "" if worth is None else f" (numerically ± {length(worth.uncertainty, units)})"


def _elastic_slip(response: ResponseData, units: str) -> str:
    slip: float = response.residual_slip_m
    down, up = response.peak_slip_downstream_m, -response.peak_slip_upstream_m
    largest = max(down, up)
    dam = _subject(response, units).replace("the", "The", 1)
    if largest < JOINT_METER_M:
        return f"{dam} does not slide."
    if abs(slip) < JOINT_METER_M:
        return f"{dam} does not slide: its crack shifts by up to {length(largest, units)} and comes back."
    scatter = _scatter(response, units)
    if response.lets_go():
        text = f"{dam} slides {_worth(response, units)} {_way(slip)}{_spread(response, units)}"
        return f"{text}{_on_the_way(slip, down, up, JOINT_METER_M, units)}.{scatter}"
    return (
        f"{dam} creeps {_worth(response, units)} {_way(slip)}{_spread(response, units)}: parts of the crack slip in "
        f"turn, while the rest holds.{scatter}"
    )


def _scatter(response: ResponseData, units: str) -> str:
    """Say how far single runs slide, where they scatter."""
    evidence = getattr(response, "evidence", None)
    distribution = None if evidence is None else evidence.residual_slip_m.distribution
    if distribution is None or distribution.fractile_16 is None:
        return ""
    low, far = length(abs(distribution.fractile_16), units), distribution.fractile_84
    keep = f"16 % of them keep to {low}, and more than 16 % end without a result"
    if far is not None:
        keep = f"16 and 84 % of them keep to {low} and {length(abs(far), units)}, respectively"
    return f" Single runs scatter: with the shaking varied by 1 %, {keep}."


def _worth(response: ResponseData, units: str) -> str:
    """Return how far an elastic dam slides, and how certain that is."""
    slip, evidence = length(abs(response.residual_slip_m), units), getattr(response, "evidence", None)
    if evidence is None:
        return slip
    known = f"numerically ± {length(evidence.residual_slip_m.uncertainty, units)}"
    if evidence.no_limit:
        known = "it may grow with each finer mesh"
    elif not evidence.converged:
        known = f"not converged, {known}"
    mean = " in the mean" if evidence.scatters else ""
    return f"{slip}{mean} ({known}{_damping(response, units)})"


def _damping(response: ResponseData, units: str) -> str:
    """Say what twice the damping makes of the slip where a vibration grows as the dam slides."""
    growth = getattr(response, "self_excitation", None)
    other = None if growth is None else growth.twice_damped_slip_m
    single = " in a single run" if _means(response) else ""
    return "" if other is None else f"; {length(abs(other), units)}{single} with twice the damping"


def rock_sentence(response: ResponseData, units: str = "si") -> str:
    """Say which rock is assumed, and how far the dam slides on other rock; nothing where the case says which rock it
    is."""
    rock: AssumedRock | None = getattr(response, "assumed_rock", None)
    if rock is None:
        return ""
    modulus = written("{modulus_pa:.3g GPa}", units, modulus_pa=rock.modulus_pa)
    assumed = f"The case gives no rock: rock as stiff as the concrete ({modulus}) is assumed"
    if not rock.trials:
        return f"{assumed}."
    soft, stiff, rigid = (_on_other_rock(trial, units) for trial in rock.trials)
    dam = "the dam in a single run" if _means(response) else "the dam"
    moduli = f"with half its modulus {dam} {soft}, with twice it {stiff}"
    slips = [trial.residual_slip_m for trial in rock.trials[:2]]
    if None not in slips:
        half, twice = (length(abs(slip or 0.0), units) for slip in slips)
        moduli = f"with half and twice its modulus {dam} slides {half} and {twice}"
    return f"{assumed}; {moduli}, and on a rigid plane before water without sound it {rigid}."


def _means(response: ResponseData) -> EvidenceNumbers | None:
    """Return the evidence by which the numbers of a response are means; None where they are those of a run."""
    evidence: EvidenceNumbers | None = getattr(response, "evidence", None)
    return evidence if evidence is not None and evidence.scatters else None


def _on_other_rock(trial: RockTrial, units: str) -> str:
    if trial.outcome == Outcome.KEEPS_SLIDING:
        return "keeps sliding"
    if trial.residual_slip_m is None:
        return "comes to no result"
    return f"slides {length(abs(trial.residual_slip_m), units)}"


def _way(slip: float) -> str:
    return "downstream" if slip > 0.0 else "upstream"


def _on_the_way(slip: float, down: float, up: float, smallest: float, units: str) -> str:
    back = max(down if slip > 0.0 else up, 0.0) - abs(slip)
    return (
        f", after up to {length(abs(slip) + back, units)} on the way" if back > max(smallest, 0.05 * abs(slip)) else ""
    )


def _openings(response: ResponseData, units: str) -> str:
    """Say how far an elastic dam's crack opens, and how it closes."""
    faces = {"upstream": response.opening_upstream_m, "downstream": response.opening_downstream_m}
    open_ = [f"{length(gap, units)} at the {face} face" for face, gap in faces.items() if gap >= JOINT_METER_M]
    if not open_:
        return (
            "The crack stays closed at both faces."
            if max(faces.values()) == 0.0
            else ("The crack opens by less than anyone could measure.")
        )
    text = f"The crack opens up to {' and '.join(open_)}"
    rotation = max(response.rocking_downstream_rad, response.rocking_upstream_rad)
    text += f", the part above it rotates by up to {angle(rotation)}"
    strikes = response.impacts
    if strikes:
        fastest = "" if strikes == 1 else ", the fastest"
        count = "once" if strikes == 1 else f"{strikes} times"
        text += f"; nodes of the crack strike {count}{fastest} at {speed(response.largest_impact_velocity_m_s, units)}"
    return f"{text}. {_elastic_rocking(response)}".rstrip()


def _elastic_rocking(response: ResponseData) -> str:
    """Say whether an elastic dam whose crack opens rocks."""
    if max(response.opening_upstream_m, response.opening_downstream_m) < JOINT_METER_M:
        return ""
    times = response.time_by_mode_s
    rocking, in_the_air = times.rocking + times.slide_rocking, times.drifting
    text = "No rocking: the opening is elastic deformation."
    if rocking >= _ROCKS_S:
        text = f"It rocks, standing on one end of the crack, for {rocking:.2f} s in all."
    if in_the_air >= _IN_THE_AIR_S:
        text += f" For {in_the_air:.2f} s in all it touches nothing."
    return text


def _elastic_end(response: ResponseData, units: str, brief: bool) -> str:
    if comes_to_rest(response):
        if brief:
            return "It is at rest in the end."
        return _rest_in_silence(response) or "It has come to rest in the end."
    factor = response.static.sliding_safety_factor
    held = any(notice.name == "friction-not-enough steps" for notice in response.warnings)
    if factor is not None and factor < 1.0 and not held:
        return "It slides away: its static loads alone move it, and nothing stops it."
    last = last_of(response)
    moved = length(last.change_m, units)
    return (
        f"It has not come to rest {_when_it_ends(response)}: in the last {last.seconds:.2g} s its {last.what} changes "
        f"by {moved}."
    )


def _other_cracks(response: ResponseData, units: str, brief: bool) -> str:
    """Say what the dam does at the cracks that do not lead, from the crest down."""
    if not response.several:
        return ""
    smallest = JOINT_METER_M if response.elastic else LEAST_M
    sentences = []
    others = [crack for place, crack in enumerate(response.cracks) if place != response.asked]
    named = others if len(others) <= _NAMED else sorted(others, key=_slides)[-_NAMED:]
    for crack in others:
        if not any(crack is one for one in named):
            continue
        slip, opening = crack.residual_slip_m, max(crack.opening_upstream_m, crack.opening_downstream_m)
        peak = _slides(crack)
        does = ["does not slide"]
        if abs(slip) >= smallest:
            mean = " in the mean" if crack.scatters else ""
            does = [f"slides {length(abs(slip), units)}{mean} {_way(slip)}"]
        elif peak >= smallest:
            does = [f"shifts by up to {length(peak, units)} and comes back"]
        if opening >= smallest and not brief:
            does.append(f"opens up to {length(opening, units)}")
        times = crack.time_by_mode_s
        rocking = times.rocking + times.slide_rocking
        if rocking >= _ROCKS_S:
            does.append(f"rocks for {rocking:.2f} s")
        if times.drifting >= _IN_THE_AIR_S:
            does.append(f"lifts off for {times.drifting:.2f} s")
        does = [*does[:-2], " and ".join(does[-2:])]
        sentences.append(f"At the crack at {_level(crack.elevation, units)} it {', '.join(does)}.")
    if len(others) > len(named):
        most = max(_slides(crack) for crack in others if not any(crack is one for one in named))
        does_most = f"moves at most {length(most, units)}" if most >= smallest else "does not slide"
        rest = len(others) - len(named)
        sentences.append(f"At the other {'crack' if rest == 1 else f'{rest} cracks'} it {does_most}.")
    return " ".join(sentences)


def _slides(crack: CrackResponse) -> float:
    """Return how far a crack slips either way at most [m]."""
    return max(crack.peak_slip_downstream_m, -crack.peak_slip_upstream_m)


def _subject(response: ResponseData, units: str) -> str:
    """Return what slides: of several cracks the dam above the one that leads."""
    if not response.several:
        return "the dam"
    return f"the dam above the crack at {_level(response.cracks[response.asked].elevation, units)}"


def _rocking(response: ResponseData, units: str) -> str:
    down, up = response.rocking_downstream_rad, response.rocking_upstream_rad
    if max(response.largest_gap_heel_m, response.largest_gap_toe_m) == 0.0:
        return "It does not rock."
    if max(down, up) < LEAST_RAD and response.time_by_mode_s.drifting == 0.0:
        return "It lifts off by less than anyone could measure."
    parts = []
    if down >= LEAST_RAD:
        parts.append(
            f"downstream by {angle(down)}, opening the crack {length(response.opening_upstream_m, units)} at the "
            "upstream face"
        )
    if up >= LEAST_RAD:
        parts.append(
            f"upstream by {angle(up)}, opening it {length(response.opening_downstream_m, units)} at the downstream face"
        )
    text = "It rocks " + " and ".join(parts) if parts else "It lifts off"
    strikes = response.impacts
    if strikes:
        fastest = speed(response.largest_impact_velocity_m_s, units)
        text += f"; {strikes} impact{'s' if strikes > 1 else ''}, bounces included, at up to {fastest}"
    return text + "."


def _end(response: ResponseData) -> str:
    if comes_to_rest(response):
        return _rest_in_silence(response) or "It is at rest in the end."
    return f"It still moves {_when_it_ends(response)} ({response.final_mode})."


def _rest_in_silence(response: ResponseData) -> str:
    """Say when the dam comes to rest where the run had to go on after the ground motion to see it."""
    if not response.silence_s:
        return ""
    ended, rest = motion_end(response), rests_from(response)
    ends = "is cut" if response.motion.is_cut or response.motion.duration > ended else "ends"
    if rest <= ended:
        return f"It comes to rest as the ground motion {ends} at {ended:.4g} s."
    return f"The ground motion {ends} at {ended:.4g} s; the dam comes to rest {rest - ended:.2g} s later, in silence."


def _when_it_ends(response: ResponseData) -> str:
    if not response.silence_s:
        return "when the run ends"
    ended = motion_end(response)
    return f"when the run ends, {response.end_time_s - ended:.3g} s after the ground motion"
