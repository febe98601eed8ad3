"""Values for fields and options that no one should write and somebody will, of every wrong kind."""

from __future__ import annotations

from typing import Any


def _nested(depth: int) -> list[Any]:
    nest: list[Any] = []
    for _ in range(depth):
        nest = [nest]
    return nest


NUMBERS: tuple[Any, ...] = (
    *(0, 1, -1, 3, 2**31, 2**63, -(2**63) - 1, 2**64, 10**400),
    *(0.0, -0.0, 0.5, -0.5, 5e-324, 1e-300, 1e-9, 1e9, 1e15, 1e300, 1e308, -1e308),
    *(float("nan"), float("inf"), float("-inf"), 1.0000000000000002),
)
TEXTS: tuple[str, ...] = (
    *("", " ", "\n", "\t", "0", "1", "-1", "-0", "+1", "1.", ".5", "1e3", "1e400", "1e-400", "nan", "inf", "-inf"),
    *("NaN m", "inf s", "0x10", "1_000", "1,5", "1,000.5", "--1", "1 2", "9" * 5000, "1e" + "9" * 100),
    *("１２ m", "١٢ m", "½ m", "∞", "1 ｍ", "²", "1 m\n", "1\0 m"),
    *("1 furlong", "1 parsec", "1 dB", "20 degC", "1 $", "1 g", "1 kg", "1 m**1e9", "1 " + "m*" * 2000 + "m"),
    *("1**9**9**9 m", "(" * 3000, "1 " + "(" * 500 + "m" + ")" * 500, "__import__('os').abort()", "{0.__class__}"),
    *("%s%n%x", "\x1b[2J\x1b[31mred", "\r\bover", "\u202eturned", "a\u2028b", "\ud800", "\udcff", "\ufeff1 m"),
    *(
        "שלום",
        "水壩",
        "e\u0301\u0336",
        "\U0001f30a",
        "x" * 100_000,
        "dam\nVerdict  all is well",
        "<script>alert(1)</script>",
    ),
    *(
        "[bold]",
        "[/]",
        "$\\frac{",
        "#import",
        "'",
        '"',
        "`id`",
        "; true",
        "--help",
        "-",
        "none",
        "null",
        "true",
        "auto",
    ),
    *("nowhere/x", "../nowhere/x", "~nouser/x", ".", "/", "/dev/null", "/dev/zero", "x/" * 200 + "x", "y" * 300),
)
THINGS: tuple[Any, ...] = (
    *(None, True, False, [], {}, [[]], [None], [{}], {"": ""}, {"a": {"b": {}}}, {"value": 1, "unit": "m"}),
    *([1, 2, 3], ["1 m", "2 m"], [["0 m", "0 m"]], [["0 m", "0 m"]] * 5, [["0 s", "0 g"], ["1 s", "1 g"]]),
    *([["nan m", "inf m"], ["1e308 m", "0 m"], ["0 m", "1e308 m"]], list(range(3000)), _nested(90)),
)
#: Numbers that are tried with the unit that a field wants.
WITH_UNITS = ("nan", "inf", "-1", "-0", "0", "5e-324", "1e-12", "1e-3", "1", "7", "1e3", "1e12", "1e308", "1e309")


def values(unit: str | None = None) -> list[Any]:
    """Return them all; for quantities also numbers with their unit."""
    quantities = [] if unit is None else [f"{number} {unit}" for number in WITH_UNITS]
    return [*NUMBERS, *TEXTS, *THINGS, *quantities]
