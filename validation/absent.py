"""What could stand in the validation book and cannot be reproduced, with the reason."""

from __future__ import annotations

from validation.declared import Absent

_NO_NUMBERS = "curves without printed numbers"

ABSENT = (
    Absent(
        "Thesis: slips, openings and rotations of Koyna Dam in 1967 (section 5.5.2 among them)",
        ("rigid", "flexible", "decoupled"),
        "the record (Koyna, 11 December 1967, at the dam) is in no open collection that was found; the chain itself is "
        "tried with El Centro beside an independent program (koyna-chain), the periods in the case periods",
    ),
    Absent(
        "Thesis, table 7.6, El Centro",
        ("rigid",),
        "the thesis does not say which version of the record it used; none of four gives its half of the table. The "
        "numbers stand side by side in table-7.6-el-centro, without a verdict",
    ),
    Absent(
        "Thesis, chapter V: histories of slip, rotation and drift of the typical dam (figures 5.15, 5.25 and others)",
        ("rigid",),
        f"{_NO_NUMBERS}; the residual slips of the same dam are in table-7.6-taft, slip by mode in drifting",
    ),
    Absent(
        "Thesis, sections 6.5.1 to 6.5.3: the slips and rotations of its elastic blocks",
        ("flexible",),
        "their ground motions and moduli are not published; elastic-impulse, elastic-rocking and contactors take "
        "others, and are held to rigid theory and to an independent program",
    ),
    Absent(
        "Thesis, table 7.7, friction 0.8 and water of 100 m",
        ("flexible",),
        'the print says "failure" and no number; that the dam still slides when the record ends is a row of table-7.7',
    ),
    Absent(
        "Thesis: all else that its chapters V to VII and its appendix print",
        ("rigid", "flexible"),
        "the thesis was not at hand for this book, only notes made from it; the cases hold every number that these "
        "quote",
    ),
    Absent(
        "Sliding spectra of blocks under Lixouri 2014 as E. Garini and G. Gazetas print them (2016, figure 6)",
        ("rigid",),
        "the print could not be had, and puts three components on the block at once; the case lixouri has what another "
        "program published for one component",
    ),
    Absent(
        "N. M. Newmark (1965), F. I. Makdisi and H. B. Seed (1978): charts of sliding blocks",
        ("rigid",),
        "charts over records that are normalised to one peak and velocity, without numbers; the closed form of a pulse "
        "is the case pulse, records beside a public program are the case slammer",
    ),
    Absent(
        "J. Zhang and N. Makris (2001): overturning after an impact, as drawn",
        ("rigid",),
        f"{_NO_NUMBERS}; overturning without impact follows from their equations (overturning), after impacts from "
        "independent integration (overturning-after-impact)",
    ),
)
