"""What stands nowhere else of the keys of the JSON and of the columns of tables: names with their meaning.

Keys that are attributes of a class with a description are not here; :mod:`heeltoe.views.explain.keys` takes that.
"""

from __future__ import annotations

from heeltoe.base.blocks import entries
from heeltoe.result.numbers import SlipByMode, TimeByMode

#: Keys of ``heeltoe run --json``.
OF_A_RUN: dict[str, str] = {
    "model": "Which model, or which checks, the numbers are from.",
    "outcome": "How the run ended: ok or overturned have a result to trust, anything else says what stopped it.",
    "advice": "What to do where the run has no result to trust; null where it has one.",
    "sequence[].static.*": "An answer of the static checks: ok, what is missed in words, or the drainage that is left.",
    "limits": "The results beside the limits that the user has set; none of a block beside a better model.",
    "crest": "How the upstream edge of the crest moves; not of the decoupled chain.",
    "verdict": "What the dam does, in one sentence: what the terminal ends with.",
    "chosen": "How the model came to be chosen; null where one was named in Python.",
    "left_out": "Numbers that are not there, by their paths, and why each is none.",
    "warnings[].text": "The sentence, in SI.",
    "warnings[].severity": "How grave it is: note (nothing is wrong), caution, or grave (a number misleads).",
    "warnings[].quantities.*": "A number of the sentence, by its name with its unit.",
    "signs": "What the motion does as recorded and reversed, where the case does not say which way round it is.",
    "sequence": "What each motion does where the dam meets several, one after the other.",
    "cracks": "Of several cracks: what each did, from the crest down, with the keys of one.",
    "governing_crack": "Which of several cracks slips most, from the crest down.",
    "critical_acceleration_g": "Ground accelerations at which the block at rest starts to move.",
    "static.critical_acceleration_per_vertical.*": "By how much this critical acceleration grows with each g of upward "
    "ground acceleration.",
    "static": "The state under the static loads, before the earthquake.",
    "motion": "The horizontal ground motion, as used.",
    "vertical_motion": "The vertical one, with the same keys; null where there is none.",
    "build": "Which build made the result: versions of heeltoe and NumPy, kind of its kernel.",
    "build.*": "Version, or kind of the kernel.",
    "ratio": "Of two models side by side: the better one's headline numbers over the other's; null where that is "
    "next to nothing.",
    "ratio.*": "The better model's number over that of the one beside it.",
    "meaning": "What the difference of two models means, in a sentence.",
    "beside": "What the simpler model makes of the same case, with the same keys.",
    "spread": "The same run with slightly weaker and stronger shaking.",
    "varied": "Of `--vary`: the fields that vary, with their values; of each run those that it has.",
    "runs": "Of `--vary`: every run in full, with these same keys; of a study how many there are.",
}

#: Keys of ``heeltoe statics --json`` that mean something of their own.
OF_STATICS: dict[str, str] = {
    "criteria": "Whose required factors the checks are judged by.",
    "structure": "Whether the dam is critical or normal, as the case says.",
    "site_information": "How well strengths are known, as the case says.",
    "slip_m": "Residual slip of the post-seismic case; null without that case.",
    "slip_source": "Where that slip comes from: given, the case, or the run of a model.",
    "response_spectrum": "What an earthquake asks of the section by its response spectrum; null without `--spectrum`.",
    "ok": "Whether every check is met.",
    "critical_water_level_m.*": "Depth of the reservoir that brings this about; null where none up to the crest does.",
    "sections": "Of many joints: the checks of each, the worst first.",
    "governing": "Of many joints: each check where its margin is smallest, by the name of the check.",
    "governing.*": "The check there, with the keys of `checks`.",
    "governing.*.elevation_m": "At which elevation.",
    "sections[].elevation_m": "Elevation of the joint.",
    "sections[].statics": "Its checks, as of the crack.",
    "governing_elevation_m": "Elevation of the joint that is worst.",
}

#: Columns of the runs of a study, beside those of what varies and the headline numbers.
OF_STUDIES: dict[str, str] = {
    "run": "Number of the run.",
    "sample": "Number of its dam.",
    "model": "Which model.",
    "event": "Name of the earthquake.",
    "motion": "Name of the motion, a component of it.",
    "reversed": "Whether the motion is turned round.",
    "factor": "Factor on the record.",
    "outcome": "How the run ends; only ok has a result to trust.",
    "impacts": "Number of blows.",
    **{f"slip_{row.name}_m": row.number.meaning for row in entries(SlipByMode)},
    **{f"time_{row.name}_s": row.number.meaning for row in entries(TimeByMode)},
    "energy_residual": "What is left of the balance of energies, over the turnover.",
    "cracked_length_m": "Length of a bonded joint that is cracked in the end; 0 of a crack without a bond.",
    "crest_acceleration_g": "Largest acceleration of the crest with that of the ground, where a limit is on the crest.",
    "slid_off": "Whether the part above has slid off.",
}
