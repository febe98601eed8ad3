"""Keys of the JSON and columns of tables that no typed block describes: names with their meaning.

Keys that are attributes of a class with a description are not here; :mod:`heeltoe.views.explain.keys` takes that.
"""

from __future__ import annotations

from heeltoe.base.blocks import entries
from heeltoe.result.numbers import SlipByMode, TimeByMode

#: Keys of ``heeltoe run --json``.
OF_A_RUN: dict[str, str] = {
    "model": "Which model, or which checks, the numbers are from.",
    "outcome": "How the run ended: ok or overturned have a result to trust, anything else says what stopped it.",
    "advice": "Remedy for a run without a result to trust; null otherwise.",
    "sequence[].static.*": "An answer of the static checks: ok, what is missed in words, or the drainage that is left.",
    "limits": "The results beside the limits that the user has set; none of a block beside a better model.",
    "crest": "How the upstream edge of the crest moves; not of the decoupled chain.",
    "verdict": "Verdict in one sentence, as on the terminal.",
    "chosen": "How the model came to be chosen; null where one was named in Python.",
    "left_out": "Omitted values by path, with the reason.",
    "warnings[].text": "The sentence, in SI.",
    "warnings[].kind": "Which sentence of the code it is; null where the code has one.",
    "warnings[].severity": "How grave it is: note (nothing is wrong), caution, or grave (a number misleads).",
    "warnings[].quantities.*": "A number of the sentence, by its name with its unit.",
    "signs": "Results with the motion as recorded and reversed, where the case gives no sign.",
    "friction_band": "Results with the other frictions of the crack, where the case has `[crack.band]`.",
    "friction_effect": "The result with 0.1 less friction, where the crack has no band and no law.",
    "sequence": "Results of each motion of a sequence.",
    "cracks": "Results of each of several cracks, from the crest down, with the keys of one.",
    "governing_crack": "Which of several cracks slips most, from the crest down.",
    "critical_acceleration_g": "Ground accelerations at which the block at rest starts to move.",
    "static.critical_acceleration_per_vertical.*": "By how much this critical acceleration grows with each g of upward "
    "ground acceleration.",
    "static": "The state under the static loads, before the earthquake.",
    "motion": "The horizontal ground motion, as used.",
    "vertical_motion": "The vertical motion, with the same keys; null without one.",
    "cross_valley_motion": "The motion across the valley, with the same keys; left out if there is none.",
    "build": "Which build made the result: versions of heeltoe and NumPy, kind of its kernel.",
    "build.*": "Version, or kind of the kernel.",
    "ratio": "Headline numbers of the better of two models over those of the other; null where the other is "
    "nearly zero.",
    "ratio.*": "The better model's number over that of the one beside it.",
    "meaning": "Meaning of the difference of two models, in a sentence.",
    "beside": "Result of the simpler model for the same case, with the same keys.",
    "spread": "The same run with slightly weaker and stronger shaking.",
    "varied": "`--vary`: the fields that vary, with their values; in a run, its own values.",
    "runs": "`--vary`: every run in full, with these same keys; in a study, the number of runs.",
}

#: Keys of ``heeltoe statics --json`` that mean something of their own.
OF_STATICS: dict[str, str] = {
    "criteria": "Guideline with the required factors.",
    "structure": "Whether the dam is critical or normal, as the case says.",
    "site_information": "How well strengths are known, as the case says.",
    "slip_m": "Residual slip of the post-seismic case; null without that case.",
    "slip_source": "Where that slip comes from: given, the case, or the run of a model.",
    "response_spectrum": "Demand of an earthquake on the section by its response spectrum; null without `--spectrum`.",
    "ok": "Whether every check is met.",
    "critical_water_level_m.*": "Depth of the reservoir that brings this about; null where none up to the crest does.",
    "sections": "Checks of each of many joints, the worst first.",
    "governing": "For many joints, each check where its margin is smallest, by the name of the check.",
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
    "energy_residual": "Residual of the balance of energies, over the turnover.",
    "cracked_length_m": "Length of a bonded joint that is cracked in the end; 0 of a crack without a bond.",
    "crest_acceleration_g": "Largest acceleration of the crest with that of the ground, where a limit is on the crest.",
    "slid_off": "Whether the part above has slid off.",
}
