"""Errors of a study: the part of the catalogue (:mod:`heeltoe.errors.error`) that no single run needs."""

from __future__ import annotations

# As in heeltoe.errors.error: code -> (what is wrong, what to do).
OF_STUDIES: dict[str, tuple[str, str]] = {
    # the option --vary
    # study files and their directories
    "study-not-a-number": ("holds no number, so that {value} cannot be drawn", "give a list of its values"),
    "study-count": (
        "{value} is a distribution, of which this method takes equally likely values",
        "say how many: count = 5",
    ),
    "study-correlation": (
        "{value} is not a field that is drawn from a distribution",
        "name two that are, under [vary]",
    ),
    "study-correlations": ("the {value} correlations contradict each other", "weaken some, or leave some out"),
    "study-motion-varies": ("motions do not vary here", "give them under [motions], their strengths as motions.scale"),
    "study-motions": ("no record is named", "choose records, give a folder, files or events, or leave [motions] out"),
    "study-pair": (
        "{value} has {count} horizontal components, not 2",
        "add the other one, or leave out what asks for pairs",
    ),
    "study-components": (
        "{value} has more components than an event has: {names}",
        "name the components of each event under [[motions.events]]",
    ),
    "study-strength": ("a {value} distribution has strengths below zero", "cut it: lower = ..., or take another"),
    "study-base": ("the case does not state a value with which others can be compared", "give it in the case"),
    "study-other": (
        "{value} holds another study, which differs in {changed}",
        "give another directory, or put that back to go on with it",
    ),
    "study-begun": ("{value} holds this study already", "go on with it by --resume, or give another directory"),
    "study-version": ("was written by another version of heeltoe ({value})", "read it with that one"),
    "study-not-there": ("is not the directory of a study", "give what `heeltoe study FILE --out DIR` has written"),
    "study-part": (
        "holds other runs than were written there: it is damaged, or belongs elsewhere",
        "compute them anew: `heeltoe study FILE --out DIR --resume`",
    ),
    "study-no-workers": (
        "the scheduler at {value} has had no worker for {seconds} s",
        "start some: `dask worker {value}`, or leave --scheduler out",
    ),
    "study-no-runs": ("has no runs yet", "run the study: `heeltoe study FILE --out DIR --resume`"),
    "study-left": (
        "{value} runs of {count} are there, too few for an answer that needs the place of each",
        "run the rest: `heeltoe study FILE --out DIR --resume`",
    ),
    "study-no-crest": (
        "the {value} model does not say how the crest moves",
        "leave out the model, or limits on the crest in the case and under [fragility]",
    ),
    "study-lost": (
        "the scheduler or all of its workers are gone ({reason}); the runs that are done stay in {value}",
        "start them again, and continue with --resume",
    ),
    "study-scheduler": (
        "there is no scheduler at {value} ({reason})",
        "start one with `dask scheduler`, or leave it out",
    ),
    # hazard curves
    "hazard-order": (
        "{value} are not ascending strengths above zero",
        "give at least two pairs of a strength and its annual rate, the weakest first",
    ),
    "hazard-rates": (
        "{value} are not falling rates above zero",
        "give for each strength how often a year it is exceeded",
    ),
    "hazard-header": ("has no header with a unit", "write it above the columns: pga [g], annual rate"),
    "heading-logarithm": ("the heading {value} speaks of a logarithm", "give the numbers themselves"),
    "hazard-heading": (
        "{value} does not say what the second column holds",
        "write above it: annual rate, return period [years], or probability in 50 years (with % for per cent)",
    ),
    "hazard-measure": (
        "{value} is not the measure of the fragility curves, {measure}",
        "give the hazard curve of that measure, or set fragility.measure and fragility.period",
    ),
    # tables of dams
    "dams-name": ("{value} is the name of {count} dams", "give each dam a name of its own"),
    "dams-letter": ("the name {value} holds a letter that cannot be shown", "write it without"),
    "dams-unit": ("holds words, which have no unit ({value})", "leave the unit out of the header"),
    # fields that are solved for
    "solve-field": ("holds no number that could be solved for", "name a field that does, as crack.friction"),
    "solve-no-range": ("has no value to search about", "give the range: --between LOW,HIGH"),
    "solve-range": ("the case refuses the range {value}", "give another one: --between LOW,HIGH"),
    # suites of records
    "suite-one-dam": (
        "a suite is one dam in several motions",
        "leave out [vary] and samples, and name the records under [motions]",
    ),
    "suite-one-strength": ("{value} strengths make a study, not a suite", "give one value"),
    "suite-no-period": ("{value} needs concrete.modulus, without which the dam has no period", "give a period"),
}
