"""Every user-facing error, declared once with its remedy and rendered in one place.

An :class:`InputError` is what a user did that can be put right by the user. It carries the field (or file) it
is about, the value that was found, and the remedy, and renders as one line:

    reservoir.depth: 120 m is above the crest at 100 m; give a depth between 0 m and 100 m
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from heeltoe.errors.dams import OF_DAMS
from heeltoe.errors.records import OF_RECORDS
from heeltoe.errors.sanitize import plain
from heeltoe.errors.statics import OF_STATICS
from heeltoe.errors.studies import OF_STUDIES

_SHOWN_LENGTH = 60
_LONGEST = 5000

# Code -> (what is wrong, what to do). The braces are filled from the context of the raiser, and {value}.
CATALOGUE: dict[str, tuple[str, str]] = {
    # kinds: one idea each, whose context names the thing
    "package-missing": ("needs the package {value}, which is not installed", "{install}"),
    "source-missing": ("there is no such file", "give the path of {expected}"),
    "file-missing": ("there is no file {value}", "give the path of {expected}"),
    "source-unreadable": ("cannot be read ({reason})", "give {expected}"),
    "file-unreadable": ("{value} cannot be read ({reason})", "give {expected}"),
    "file-ending": ("{value} does not end as {kind}", "end it in {endings}"),
    "too-large": ("has more than {value}", "give {expected}"),
    "wrong-kind": ("a {kind} is not {expected}", "give {source}"),
    "listed-twice": ("{value} is listed twice", "list it once"),
    "option-foreign": ("does not belong to {owner}", "remove it{remedy}"),
    "option-missing": ("is required by {owner}", "give it, or make another choice"),
    "not-ascending": ("{what} {value} do not ascend", "give {remedy}"),
    "below-other": ("{value} is below {other}, {least}", "give at least {least}"),
    "missing": ("is required but missing", "{remedy}"),
    "above-other": ("{value} is above {other}, {most}", "give at most {most}"),
    "stated-otherwise": ("{value} is not what {name} states, {stated}", "remove one of them"),
    "too-many": ("{value} are too many", "give at most {most}"),
    "too-few": ("has {value}", "give at least {least}"),
    "row-length": ("has {value} cells, the header {count}", "give each row as many cells as the header has"),
    "empty": ("{value} has no {what}", "give {expected}"),
    "another-kind": ("is {value}, not {wanted}", "{remedy}"),
    "nothing-to-show": ('has nothing to show (outcome "{value}")', "show a run that has started"),
    "study-no-answer": ("a study by {value} does not compute this", "{remedy}"),
    "study-component": ("{value} has no {component} component beside it", "add one of its name, or {remedy}"),
    "record-states": (
        "{found} {value}, and its header states {stated}",
        "check {doubtful} and whether all of it is there, or correct its header",
    ),
    "not-a-directory": ("{value} is not a directory", "give {expected}"),
    "several": ("has several {things} ({value})", "choose one {how}"),
    # case
    "case-file-syntax": (
        "is not valid {kind}: {reason}",
        "correct it; `heeltoe new NAME` writes a case to compare with",
    ),
    "case-source": (
        "a {kind} is neither a case file nor the fields of one",
        "give a path or a dictionary; a case changes by its with_",
    ),
    "rock-level": (
        "elastic rock has a level surface, and the base rises by {value} from heel to toe",
        "give a level base, or remove the block rock",
    ),
    "usage": ("{value}", "`{command} --help` lists the options"),
    "option-repeated": ("is given {value} times", "give it once; a study runs several values"),
    "unit-missing": ("{value} has no unit", "write for example {example}"),
    "unit-unknown": ("{value} has the unknown unit {unit}", "write for example {example}"),
    "density-weight": (
        "{value} is a weight for each volume, not a density",
        "divide it by one g, 9.80665 m/s^2: {density}",
    ),
    "unit-ton": (
        "{value} may mean the metric ton of 1000 kg or the one of 2000 lb",
        'write "t" (or "tonne") for the metric one, "short_ton" for the other',
    ),
    "unit-milli": ("{value} counts in thousandths, by a small m", "write a large M for millions, as in MPa or MN"),
    "wrong-quantity": ("{value} is not {kind}", "write for example {example}"),
    "not-finite": ("{value} is not a finite number", "write for example {example}"),
    "unknown-field": ("no such field", "{suggestion}"),
    "missing-field": ("is required but missing", "add for example {example}"),
    "wrong-type": ("{value} is of the wrong type", "give {expected}"),
    "wrong-length": ("{value} has the wrong length", "give {length} values"),
    "not-a-choice": ("{value} is not a choice", "choose {choices}"),
    "out-of-range": ("{value} is out of range", "give a value {bound}"),
    "not-usable": ("{value} cannot be used ({reason})", "see the documentation of the case file"),
    "fields-conflict": ('cannot stand beside "{other}"', "keep one of them"),
    "needs-other": ("has no meaning without {other}", "give that, or remove this"),
    "contradiction": ("{value} contradicts {other}", "keep one of them"),
    "frame-step": (
        "{value} is not a valid spacing for the histories of the flexible model",
        "give {shortest} to {end}; it keeps all modes at each of them",
    ),
    "time-step-long": (
        "{value} is too long to follow the vibration of the part above the crack",
        "give at most {longest}, or leave it out",
    ),
    "step-stiff": (
        "is so stiff that the time step would have to be below {step}",
        "give a wider uplift.opening, a softer anchor or a tougher bond, or a flexible.time_step of that size",
    ),
    "motion-source": ("has no source", "give file or points"),
    "vertical-of-another": (
        "{value} is another motion than the one that {component} was recorded with",
        "give {component}.file of the same earthquake too, or {component}={none} to leave it out",
    ),
    # motion
    "motion-not-finite": ("value {number} is {value}", "give a record of finite numbers"),
    "motion-no-numbers": (
        "its {value} is of {kind}",
        "give an array of numbers: times in seconds from the first, accelerations in m/s2",
    ),
    "motion-order": ("its time goes back from {before} to {value}", "give the samples in order of time"),
    "motion-zero": ("the ground motion is zero throughout", "give another record, or set motion.allow_zero = true"),
    "motion-peak": ("{name} peaks at {value}, beyond any earthquake", "check its unit and its values"),
    "motion-spike": (
        "{name} jumps to {value} at {moment} and back, {ratio} times as far as it reaches anywhere else",
        "correct this value of the file; a pulse that is meant can be drawn by motion.points",
    ),
    "motion-resample": (
        "a step of {value} does not divide the record's {step}",
        "refine by a whole number; coarser steps would change the motion",
    ),
    "motion-brief": ("lasts {value}", "give it {least} or more, in its file and in motion.duration"),
    "spectrum-period": (
        "are not finite numbers of seconds, or are shorter than a record resolves",
        "give 0 s or periods from {least} up",
    ),
    # motions to order
    "order-zero": ("{value} is zero throughout", "give a motion that moves"),
    "order-uniform": (
        "{value} jumps, or no step divides all of its steps",
        "give a record with equal steps for filters and Fourier amplitudes",
    ),
    "order-corner-missing": ("has no corner frequency", "give low, high or both"),
    "order-corner": (
        "{value} is not between 0 Hz and the Nyquist frequency of the record, {nyquist}",
        "give a corner frequency inside",
    ),
    "order-corner-slow": (
        "{value} needs more zeros before and after the record than fit",
        "give {least} or more",
    ),
    "order-window": ("{value} does not come before the end, {end}", "give moments in order, within the record"),
    "order-time": (
        "stretching time by {value} changes the frequency content of the motion",
        "filter or match it instead, or set allow = true if you mean it",
    ),
    "target-table": ("is not a table of a spectrum", "give at least two ascending periods with accelerations above 0"),
    "synthetic-shape": (
        "duration / t_mid is {value}, which no modulation reaches",
        "give duration / t_mid from 0.2 to 4.9",
    ),
    "match-band": ("a band of {value} cannot be matched", "give periods from 0.02 s up, the shorter first"),
    # flexible model
    "mesh-section": (
        "has a ledge, a face that doubles back or a base that is not level, which rows of elements cannot follow",
        "straighten it, or give meshes of your own in flexible.mesh_above and flexible.mesh_below",
    ),
    "mesh-thin": (
        "has a layer of {value} at z = {level}, too thin for elements",
        "remove a corner that is so close to another, or move the crack to the base",
    ),
    "mesh-wedge": (
        "leaves rows of elements that run together to a wedge, or fold over",
        "incline the crack less, or give meshes of your own in flexible.mesh_above and flexible.mesh_below",
    ),
    "mesh-nothing": (
        "leaves nothing of the part {side} the crack at its {end}",
        "move the crack or incline it less; of a dam on a sloping foundation, draw the section with that slope as base",
    ),
    "mesh-not-finite": ("node {value} has no finite coordinates", "correct it"),
    "mesh-plane": ("is not plane", "give a mesh in the plane x, y or x, z"),
    "mesh-kind": (
        "holds {value}",
        "give quadrilaterals throughout, of 4 nodes or of 8 (Gmsh: recombine, incomplete second order)",
    ),
    "mesh-unused": (
        "{value} nodes belong to no element, the first of them is {first}",
        "remove them; gmsh leaves out the centres of arcs where the surface is a physical group",
    ),
    "mesh-clockwise": (
        "{count} elements run clockwise, the first of them is {value}",
        "number the nodes of each counter-clockwise, seen with x downstream to the right",
    ),
    "mesh-inverted": (
        "{count} elements are folded over or crushed, the first of them is {value}",
        "move their nodes until all angles are well between 0 and 180 degrees",
    ),
    "mesh-double": ("{value} pairs of nodes coincide, the first of them {first}", "merge them"),
    "mesh-sides": ("the elements that meet at node {value} do not fit side to side", "let them share all their nodes"),
    "mesh-pieces": ("falls into {value} pieces", "give one body whose elements share sides"),
    "mesh-far": (
        "is not where the section is: it covers {value}, and the crack goes along {crack}",
        "give it in metres and in the coordinates of the section",
    ),
    "mesh-crack": (
        "its {side} side covers {value}, and the crack goes along {crack}",
        "let a line of element sides follow the crack from end to end",
    ),
    "mesh-base": ("has no level base to stand on", "let its lowest points form a horizontal line"),
    "mesh-area": ("has an area of {value} where the section has {area}", "follow the outline of the section"),
    "too-costly": ("takes about {value}, more than is allowed", "ask for less, or allow it by {allow}"),
    # decoupled chain, tables
    "crack-at-base": (
        "{value} is at the base: there is nothing below the crack to shake the part above it",
        "use --model rigid or flexible, or give an elevation above the base",
    ),
    # analysis and command line
    "motion-missing": (
        "is required but missing",
        "add [motion] with a file or points, or give --motion FILE-or-NAME",
    ),
    "motion-of-suite": (
        "lists records for a suite, and there is no [motion] for a single run",
        "run the suite with `heeltoe run` or heeltoe.run_suite, or add [motion]",
    ),
    "explain-unknown": (
        "{value} is not a field of a case or a study, a key of the JSON, a column or an outcome{near}",
        "`heeltoe explain --all` lists all",
    ),
    "app-public": (
        "{value} can be reached from other machines",
        "add --public, which lets those in that have its token, or leave --host out",
    ),
    "app-address": ("the app cannot listen at {value} ({reason})", "give another, or leave it out"),
    "blocks-shape": ("{value} is not a table of blocks", "give blocks, cases, or numbers of shape (n, {columns})"),
    "blocks-many": ("{value} for {count} blocks", "give one for each of them"),
    "column-unknown": ("cannot be a column", "give single cases; columns are {columns}"),
    "blocks-motion": ("{value} is not one of the motions", "give {bounds}"),
    "no-first-mode": (
        "needs a first mode, and the crest of the dam has no clear peak: concrete, water and rock damp it too much",
        "look at heeltoe periods --response, or run the earthquake",
    ),
    "report-package-broken": (
        "needs the package {value}, which does not work here ({reason})",
        "give the program more memory, or install the package anew",
    ),
    "pulse-unstable": (
        "the dam does not even stand without a pulse",
        "give it less water, less uplift or more friction",
    ),
    "animation-window": ("nothing happens from {value}", "give a time from {begin} to {finish}"),
    "file-not-sent": ("{value} has not been sent", "send it with the case file, or name a record of the catalogue"),
    "file-exists": ("already exists", "give another name, or remove it first"),
    "no-directory": ("is not there", "make it first, or give another path"),
    "no-file": ("{value} does not name a file", "give the path of a file"),
    "problems-more": ("{value} more things in it are wrong", "correct those above first"),
    "not-ours": (
        "{value} exists and was not written by heeltoe",
        "give another directory, or empty this one (an older heeltoe listed nothing)",
    ),
    "left-over": (
        "{value} is a result that was not written here, or by another user, and is not completed",
        "remove it, or move its files yourself",
    ),
    "no-room": (
        "nothing can be put into the directory for temporary files ({reason})",
        "set TMPDIR to a place with room",
    ),
    "cannot-write": ("{value} cannot be written ({reason})", "give a place where you may write"),
    **OF_STATICS,
    **OF_DAMS,
    **OF_RECORDS,
    **OF_STUDIES,
}


#: Arguments of public functions, and what makes them.
_SOURCES = {
    "a case": "the result of heeltoe.read_case",
    "a response": "the result of heeltoe.run, rigid, decoupled or flexible",
    "static checks": "the result of heeltoe.statics_of_sections",
    "a ground motion": "the result of heeltoe.read_record",
    "a list": "a list, even of one",
}
#: Command that installs the packages of studies.
STUDY_PACKAGES = "pip install dask distributed duckdb pandas xarray"


def expect(value: object, kind: type, expected: str, field: str) -> None:
    """Refuse an argument of a public function that is not of a kind; `expected` is a key of the sources above.

    Raises
    ------
    InputError
        For the field.
    """
    if not isinstance(value, kind):
        source = _SOURCES[expected]
        raise InputError("wrong-kind", field, kind=type(value).__name__, expected=expected, source=source)


def shown(value: object) -> str:
    """Return `value` as the user wrote it in the case file, shortened where it is long."""
    try:
        text = json.dumps(value, default=str, ensure_ascii=False)
    except (ValueError, RecursionError):  # thousands of digits or brackets
        return "what is there"
    return text if len(text) <= _SHOWN_LENGTH else text[: _SHOWN_LENGTH - 3] + "..."


class HeeltoeError(Exception):
    """Base of every error that heeltoe raises on purpose."""


class InputError(HeeltoeError):
    """Input that cannot be used, with the field, the value and the remedy.

    Parameters
    ----------
    code
        Key of :data:`CATALOGUE`.
    field
        Where it stands: a path into the case (``crack.friction``) or a file name.
    value
        What was found there, as the user wrote it.
    **context
        Whatever else the texts of the catalogue name.

    Attributes
    ----------
    others
        What else is wrong, found with it.
    """

    def __init__(self, code: str, field: str, value: object = "", **context: object) -> None:
        self.code = code
        self.field = field
        self.value = value
        problem, remedy = CATALOGUE[code]
        context["value"] = value
        self.problem = problem.format(**context)
        self.remedy = remedy.format(**context)
        self.others: tuple[InputError, ...] = ()
        super().__init__(str(self))

    def with_others(self, others: Iterable[InputError]) -> InputError:
        """Return the same error with other ones, which Python shows below it."""
        for other in others:
            self.others += (other,)
            self.add_note(str(other))
        return self

    def __str__(self) -> str:
        return plain(f"{self.field}: {self.problem}; {self.remedy}", _LONGEST)

    def __reduce__(self) -> tuple[object, ...]:
        """Come back from another process as the same error: Python would make it anew of its text alone."""
        return InputError.__new__, (type(self), *self.args), self.__dict__


@contextmanager
def package(field: str, name: str, install: str = "") -> Iterator[None]:
    """Refuse what cannot be imported within: a package that is optional and not installed."""
    try:
        yield
    except ImportError:
        raise InputError("package-missing", field, name, install=install or f"pip install {name}") from None


class UnfinishedError(InputError):
    """A run that was ended from outside, with the loss and the way to continue; the input is not at fault."""
