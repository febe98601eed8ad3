"""What could stand in the validation book and cannot be reproduced, with the reason."""

from __future__ import annotations

from validation.declared import Absent

_NO_NUMBERS = "curves without printed numbers"

ABSENT = (
    Absent(
        "Thesis: slips, openings and rotations of Koyna Dam in 1967 (section 5.5.2 among them)",
        ("rigid", "flexible", "decoupled"),
        "the record (Koyna, 11 December 1967, at the dam) is in no open collection; koyna-chain has El Centro",
    ),
    Absent(
        "Thesis, table 7.6, El Centro",
        ("rigid",),
        "its version of the record is not known; table-7.6-el-centro has four versions",
    ),
    Absent(
        "Thesis, chapter V: histories of slip, rotation and drift of the typical dam (figures 5.15, 5.25 and others)",
        ("rigid",),
        f"{_NO_NUMBERS}; table-7.6-taft has the residual slips",
    ),
    Absent(
        "Thesis, sections 6.5.1 to 6.5.3: the slips and rotations of its elastic blocks",
        ("flexible",),
        "ground motions and moduli are not published; elastic-impulse, elastic-rocking and contactors take others",
    ),
    Absent(
        "Thesis, table 7.7, friction 0.8 and water of 100 m",
        ("flexible",),
        'the print has "failure" and no number, as the row of table-7.7 has',
    ),
    Absent(
        "Thesis: all else that its chapters V to VII and its appendix print",
        ("rigid", "flexible"),
        "only notes made from the thesis were at hand; the cases have every number of these",
    ),
    Absent(
        "Sliding spectra of blocks under Lixouri 2014 as E. Garini and G. Gazetas print them (2016, figure 6)",
        ("rigid",),
        "the print was not at hand, and has three components at once; lixouri has one",
    ),
    Absent(
        "N. M. Newmark (1965), F. I. Makdisi and H. B. Seed (1978): charts of sliding blocks",
        ("rigid",),
        "charts without numbers; pulse has the closed form, slammer records beside a public program",
    ),
    Absent(
        "J. Zhang and N. Makris (2001): overturning after an impact, as drawn",
        ("rigid",),
        f"{_NO_NUMBERS}; overturning-after-impact has an independent integration",
    ),
)
