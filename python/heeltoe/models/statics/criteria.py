"""Requirements of USACE, USBR, FERC and CDA, and the defaults of CADAM3D, for a concrete gravity dam, as tables.

Each row names its document and paragraph. What a row rests on beside the document is in its note: numbers that were
not compared with the print say so.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypedDict, Unpack, get_args

Loads = Literal["usual", "unusual", "extreme", "earthquake", "post-earthquake"]

_MEMORY = "the number was not compared with the print"
_INFERRED = "the document has no post-earthquake case: that of its extreme loads is taken"


@dataclass(frozen=True)
class Criterion:
    """One required value.

    Attributes
    ----------
    loads
        "usual", "unusual" (flood), "extreme" (flood), "earthquake" (pseudo-static) or "post-earthquake".
    check
        "sliding", "flotation" and, of a user's own, "overturning": factors, at least so much; "resultant": its distance
        from the middle of the base over the width of the base, at most so much (1/6 the middle third, 1/4 the middle
        half, 1/2 the base); "compression": stress over the compressive strength, at most so much.
    required
        The value.
    document, paragraph
        Where it stands.
    note
        What a reader must know about the row.
    cohesion
        True where it is for resistance with cohesion, False without, None for both.
    structure, site_information
        Which structures and explorations it is for; None for all.
    largest_pa
        Of compression: the stress that is never exceeded, however strong the concrete; None without one.
    """

    loads: Loads
    check: str
    required: float
    document: str
    paragraph: str
    note: str = ""
    cohesion: bool | None = None
    structure: str | None = None
    site_information: str | None = None
    largest_pa: float | None = None

    @property
    def source(self) -> str:
        """Document and paragraph."""
        return f"{self.document}, {self.paragraph}"

    @property
    def at_least(self) -> bool:
        """Whether a value must be at least, not at most, the required one."""
        return self.check in ("sliding", "overturning", "flotation")


class _OnlyFor(TypedDict, total=False):
    cohesion: bool
    structure: str
    site_information: str


def _rows(
    check: str,
    values: dict[Loads, float],
    document: str,
    paragraph: str,
    note: str = "",
    *,
    inferred: tuple[Loads, ...] = (),
    **only_for: Unpack[_OnlyFor],
) -> tuple[Criterion, ...]:
    """Return one row for each case of loads; those inferred say so."""
    return tuple(
        Criterion(
            loads,
            check,
            value,
            document,
            paragraph,
            "; ".join(text for text in (note, _INFERRED if loads in inferred else "") if text),
            **only_for,
        )
        for loads, value in values.items()
    )


def _three(usual: float, unusual: float, extreme: float) -> dict[Loads, float]:
    """Return values for usual, unusual and extreme loads, both earthquake cases among the last."""
    return _five(usual, unusual, extreme, extreme, extreme)


def _five(*values: float) -> dict[Loads, float]:
    """Return values for usual, unusual and extreme loads, the earthquake and the dam after it."""
    return dict(zip(get_args(Loads), values, strict=True))


def _peak(
    tested: tuple[float, ...], untested: tuple[float, ...], document: str, without: str, note: str
) -> tuple[Criterion, ...]:
    """Return the rows of a peak sliding factor, with tests and without; both in the order of the cases of loads."""
    known = {
        "well defined": ("with tests", tested),
        "ordinary": (without, untested),
        "limited": (without, untested),
    }
    return tuple(
        row
        for information, (tests, values) in known.items()
        for row in _rows(
            "sliding",
            _five(*values),
            document,
            f"peak sliding factor, {tests}",
            note,
            cohesion=True,
            site_information=information,
        )
    )


_EM_2100 = "USACE EM 1110-2-2100 (2005)"
_EM_2200 = "USACE EM 1110-2-2200 (1995)"
_GRAVITY_DAMS = "USBR, Design of Gravity Dams (1976)"
_FERC = "FERC Engineering Guidelines, chapter 3 (2002, revised 2016)"
_CDA = "CDA, Dam Safety Guidelines (1999)"
_POST: tuple[Loads, ...] = ("post-earthquake",)

_USACE = (
    *(
        row
        for structure, information, values, table in (
            ("critical", "well defined", (1.7, 1.3, 1.1), "table 3-2"),
            ("critical", "ordinary", (2.0, 1.7, 1.3), "table 3-2"),
            ("normal", "well defined", (1.4, 1.2, 1.1), "table 3-3"),
            ("normal", "ordinary", (1.5, 1.3, 1.1), "table 3-3"),
            ("normal", "limited", (3.0, 2.6, 2.2), "table 3-3"),
        )
        for row in _rows(
            "sliding",
            _three(*values),
            _EM_2100,
            f"paragraph 3-7, {table}",
            _MEMORY,
            inferred=_POST,
            structure=structure,
            site_information=information,
        )
    ),
    *_rows("flotation", _three(1.3, 1.2, 1.1), _EM_2100, "paragraph 3-8, table 3-4", _MEMORY, inferred=_POST),
    *_rows(
        "resultant",
        _three(1.0 / 6.0, 1.0 / 4.0, 1.0 / 2.0),
        _EM_2100,
        "table 3-5",
        f"{_MEMORY}; 75 % of the base in compression is taken for the middle half, which it is where the uplift stays",
        inferred=_POST,
    ),
    *_rows("compression", _three(0.3, 0.5, 0.9), _EM_2200, "table 4-1", _MEMORY, inferred=_POST),
)

# The largest flood is an unusual load to USBR.
_USBR_LOADS = _five(3.0, 2.0, 2.0, 1.0, 1.0)
_PSI = 6894.757
_USBR_CAPS: dict[Loads, float] = {"usual": 1500.0 * _PSI, "unusual": 2250.0 * _PSI, "extreme": 2250.0 * _PSI}
_USBR = (
    *_rows(
        "sliding",
        _USBR_LOADS,
        _GRAVITY_DAMS,
        "chapter III, safety factors, 3-21",
        f"{_MEMORY}; within the concrete and at its contact with the rock, in the rock 4.0, 2.7 and 1.3",
        inferred=_POST,
    ),
    *(
        replace(row, largest_pa=_USBR_CAPS.get(row.loads))
        for row in _rows(
            "compression",
            {loads: 1.0 / factor for loads, factor in _USBR_LOADS.items()},
            _GRAVITY_DAMS,
            "chapter III, safety factors, 3-20",
            f"{_MEMORY}; at most 1500 psi under usual loads, 2250 psi under unusual ones",
            inferred=_POST,
        )
    ),
)

# FERC judges the dam after the earthquake, not by a pseudo-static force.
_FERC_ROWS = (
    *_rows(
        "sliding",
        {"usual": 3.0, "unusual": 2.0, "extreme": 2.0, "post-earthquake": 1.3},
        _FERC,
        "section 3-5.3, table 2",
        f"{_MEMORY}; high or significant hazard",
        cohesion=True,
        structure="critical",
    ),
    *_rows(
        "sliding",
        {"usual": 2.0, "unusual": 1.25, "extreme": 1.25, "post-earthquake": 1.0},
        _FERC,
        "section 3-5.3, table 2",
        f"{_MEMORY}; low hazard, for which there is no table 2A",
        structure="normal",
    ),
    *_rows(
        "sliding",
        {"usual": 1.5, "unusual": 1.5, "extreme": 1.3, "post-earthquake": 1.3},
        _FERC,
        "section 3-5.3, table 2A",
        f"{_MEMORY}; high or significant hazard; the extreme flood is the probable maximum one",
        cohesion=False,
        structure="critical",
    ),
)

# The order of the columns had to be inferred from the values: usual 1.5, flood 1.3, after an earthquake 1.1, in it 1.0.
_FELL = "read in an extract, its columns in disorder, of Fell and others, Geotechnical Engineering of Dams"
_BULLETIN = "the technical bulletin of 2007, Structural Considerations for Dam Safety, was not compared"
_CDA_ROWS = (
    *_peak(
        (2.0, 1.5, 1.5, 1.1, 1.5),
        (3.0, 2.0, 2.0, 1.3, 2.0),
        _CDA,
        "no tests",
        f"{_FELL}, table 16.2, by which a residual sliding factor that is met will do instead; {_BULLETIN}",
    ),
    *_rows(
        "sliding",
        _five(1.5, 1.3, 1.3, 1.0, 1.1),
        _CDA,
        "residual sliding factor",
        f"{_FELL}, table 16.2; {_BULLETIN}",
        cohesion=False,
    ),
    *_rows(
        "resultant",
        _five(1.0 / 6.0, 0.5, 0.5, 0.5, 0.5),
        _CDA,
        "position of the resultant",
        f"{_FELL}, table 16.1, which leaves the middle third to all but usual loads; {_BULLETIN}",
    ),
    *_rows(
        "compression",
        _five(1.0 / 3.0, 1.0 / 2.0, 1.0 / 2.0, 1.0 / 1.1, 1.0 / 1.5),
        _CDA,
        "compressive strength factor",
        f"{_FELL}, table 16.1; {_BULLETIN}",
    ),
)

# What the program suggests; its flood is an extreme one, its unusual case that of idle drains or unusual ice.
_CADAM = "CADAM3D, default performance indicators"
_HELP = "read on the help page of the program, which names no guideline; its numbers may be changed there"
_CADAM_ROWS = (
    *_peak(
        (2.0, 1.5, 1.1, 1.1, 1.5),
        (3.0, 2.0, 1.3, 1.3, 2.0),
        _CADAM,
        "without tests",
        f"{_HELP}; the page has the larger factors beside the words with tests, CDA (1999) beside no tests",
    ),
    *_rows(
        "sliding",
        _five(1.5, 1.3, 1.0, 1.0, 1.1),
        _CADAM,
        "residual sliding factor",
        _HELP,
        cohesion=False,
    ),
    *_rows("flotation", _three(1.2, 1.1, 1.1), _CADAM, "uplifting factor", _HELP),
    *_rows("resultant", _three(1.0 / 6.0, 1.0 / 4.0, 1.0 / 2.0), _CADAM, "resultant position", _HELP),
    *_rows(
        "compression",
        _five(0.33, 0.5, 0.67, 0.9, 0.67),
        _CADAM,
        "compression at lift joints",
        f"{_HELP}; at the base 0.25, 0.5, 0.5, 0.67 and 0.5",
    ),
)

#: All rows, by the name of the criteria.
CRITERIA: dict[str, tuple[Criterion, ...]] = {
    "USACE": _USACE,
    "USBR": _USBR,
    "FERC": _FERC_ROWS,
    "CDA": _CDA_ROWS,
    "CADAM3D": _CADAM_ROWS,
}

#: What the criteria say of the uplift where the earthquake opens the crack, "unchanged" or "zero", and where that
#: stands. CDA leaves both open (as for regions of high seismicity, zero): unchanged is taken.
UPLIFT_IN_EARTHQUAKE: dict[str, tuple[str, str]] = {
    "USACE": ("unchanged", f"{_EM_2200}: unchanged by the earthquake"),
    "USBR": ("zero", "USBR, Design of Small Dams, 3rd edition (1987): zero where the earthquake opens the crack"),
    "FERC": ("unchanged", f"{_FERC}: unchanged by the earthquake"),
    "CDA": ("unchanged", "CDSA, Dam Safety Guidelines (1997): unchanged where seismicity is low"),
    "CADAM3D": ("unchanged", f"{_EM_2200}: unchanged by the earthquake, one of the choices of CADAM3D"),
}


def chosen(
    rows: tuple[Criterion, ...],
    loads: Loads,
    *,
    cohesion: bool = False,
    structure: str = "critical",
    site_information: str = "ordinary",
) -> tuple[Criterion, ...]:
    """Return the rows that hold for a case of loads.

    Parameters
    ----------
    rows
        Of some criteria.
    loads
        Case of loads.
    cohesion
        Whether the resistance counts cohesion; the documents with tables for friction alone have other factors there.
    structure
        "critical" (FERC: high or significant hazard) or "normal" (FERC: low hazard).
    site_information
        "well defined" (CDA: with tests), "ordinary" or "limited".
    """
    return tuple(
        row
        for row in rows
        if row.loads == loads
        and row.cohesion in (None, cohesion)
        and row.structure in (None, structure)
        and row.site_information in (None, site_information)
    )


def unread(rows: tuple[Criterion, ...]) -> tuple[str, ...]:
    """Return which fields of ``[statics]`` criteria do not ask for."""
    asked = {
        "structure": any(row.structure for row in rows),
        "site_information": any(row.site_information for row in rows),
        "compressive_strength": any(row.check == "compression" for row in rows),
    }
    return tuple(field for field, wanted in asked.items() if not wanted)
