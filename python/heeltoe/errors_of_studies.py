"""What can be wrong with a study: the part of the catalogue of errors (:mod:`heeltoe.errors`) that no run needs."""

from __future__ import annotations

# As in heeltoe.errors: code -> (what is wrong, what to do).
OF_STUDIES: dict[str, tuple[str, str]] = {
    # the option --vary
    "vary-form": ("{value} varies nothing", "write PATH=VALUE,VALUE, for example crack.friction=0.8,1.0,1.2"),
    "vary-twice": ("{value} is varied twice", "give all its values at once"),
    "vary-many": (
        "{value} runs are too many for a table",
        "vary less: up to {most} runs, or write a study file for `heeltoe study`",
    ),
    "vary-option": ("goes with one run, not with a table of runs", "leave it out, or --vary"),
    # study files and their directories
    "study-file-missing": ("there is no such file", "give the path of a study file; `heeltoe examples` writes some"),
    "distribution-incomplete": ("is required and not there", "the distribution {distribution} needs it"),
    "distribution-foreign": ("is no number of the distribution {distribution}", "that has {fields}"),
    "distribution-order": ("{value} is not above {lowest}", "give the lower number first"),
    "distribution-mode": ("{value} is not between the lowest and the highest value", "give one that is"),
    "distribution-spread": ("{value} makes no distribution", "give more than 0"),
    "study-not-a-number": ("holds no number, so that {value} cannot be drawn", "give a list of its values"),
    "study-twice": ("{value} names something twice", "name each value once"),
    "study-count": (
        "{value} is a distribution, of which this method takes equally likely values",
        "say how many: count = 5",
    ),
    "study-correlation": ("{value} is no field that is drawn from a distribution", "name two that are, under [vary]"),
    "study-correlations": ("the {value} correlations contradict each other", "weaken some, or leave some out"),
    "study-power": ("{value} is no power of two, which Sobol's points need here", "give {below} or {above}"),
    "study-motion-varies": ("motions do not vary here", "give them under [motions], their strengths as motions.scale"),
    "study-motions": ("there is neither a folder nor files nor events", "give one of these, or leave [motions] out"),
    "study-folder": ("{value} is no directory", "give the directory of the records, relative to the study file"),
    "study-folder-empty": ("{value} has no records", "give a directory with records"),
    "study-aftershocks": (
        "the case has aftershocks, and the motions of a study take the place of all of its motions",
        "leave [motions] out, or the aftershocks",
    ),
    "study-pair": ("{value} has {count} horizontal components, not 2", "add the other one, or leave pairs out"),
    "study-vertical": ("{value} has no vertical component", "add it, or leave vertical out"),
    "study-horizontal": ("{value} has no horizontal component beside it", "add one, or take the file out"),
    "study-components": (
        "{value} has more components than an event has: {names}",
        "name the components of each event under [[motions.events]]",
    ),
    "study-strength": ("a {value} distribution has strengths below zero", "cut it: lower = ..., or take another"),
    "study-base": ("the case has no value of its own, beside which others could be tried", "give it in the case"),
    "study-other": (
        "{value} holds another study, which differs in {changed}",
        "give another directory, or put that back to go on with it",
    ),
    "study-begun": ("{value} holds this study already", "go on with it by --resume, or give another directory"),
    "study-version": ("was written by another version of heeltoe ({value})", "read it with that one"),
    "study-not-there": ("is no directory of a study", "give what `heeltoe study FILE --out DIR` has written"),
    "study-unreadable": ("does not say what study it is ({reason})", "give another directory, or restore the file"),
    "study-no-grid": ("a study by {value} has no axes of a grid", "take to_pandas"),
    "study-no-answer": ("a study by {value} has no such answer", 'run one with method = "{method}"'),
    "study-measure": ("{value} is not known of its motions", "known are {known}"),
    "study-no-fragility": ("the study asks for no curves", "say the limits under [fragility]"),
    "study-package": ("needs the package {value}, which is not installed", "pip install 'heeltoe[study]'"),
    "study-scheduler": (
        "there is no scheduler at {value} ({reason})",
        "start one with `dask scheduler`, or leave it out",
    ),
    "study-scenario-count": ("{value} is no number of motions", "give 1 to {most}"),
    "study-many": ("{value} are too many", "give at most {most}"),
}
