"""Keys of the JSON and columns of the tables: what classes say of their attributes, and what stands in the lists of
:mod:`heeltoe.views.explain.result_keys`."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator

from heeltoe.base.blocks import Block, Number, described
from heeltoe.mechanics.block import StaticState
from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.load_case import ForceNumbers, LoadCase
from heeltoe.models.statics.model import Statics
from heeltoe.models.statics.spectral import SpectralDemand
from heeltoe.result.crest import CrestMotion
from heeltoe.result.histories import EventLog, Histories, columns_of
from heeltoe.result.judge import LimitCheck
from heeltoe.result.numbers import (
    OF_SEVERAL,
    BlockNumbers,
    Chain,
    Chosen,
    ElasticCrack,
    ElasticDam,
    Energy,
    FrictionBand,
    FrictionEffect,
    SignNumbers,
    Spread,
    Stage,
)
from heeltoe.result.outcome import Outcome
from heeltoe.result.record import ResponseData
from heeltoe.result.write import MotionNumbers
from heeltoe.study.answers.comparison import Compared
from heeltoe.study.answers.fragility import Curve
from heeltoe.study.answers.hazard import AnnualRate
from heeltoe.study.answers.portfolio import Ranks
from heeltoe.study.answers.sensitivity import Sobol
from heeltoe.study.answers.suite import SuiteAnswer
from heeltoe.study.small.overturning import OverturningMap
from heeltoe.study.small.solved import Solved
from heeltoe.views.explain.meaning import Meaning
from heeltoe.views.explain.pages import page_of
from heeltoe.views.explain.result_keys import OF_A_RUN, OF_STATICS, OF_STUDIES
from heeltoe.views.explain.study_keys import OF_OTHERS
from heeltoe.views.words.numbers import ENDINGS
from heeltoe.warnings.notice import Notice

_RUN, _STATICS = "heeltoe run --json", "heeltoe statics --json"
# Whose attributes stand where, and which command writes them.
_CLASSES: tuple[tuple[str, type, str], ...] = (
    ("", ResponseData, _RUN),
    ("warnings[].", Notice, _RUN),
    ("", Statics, _STATICS),
)
# Typed blocks, which say by themselves what they hold.
_BLOCKS: tuple[tuple[str, type[Block], str], ...] = (
    ("", BlockNumbers, _RUN),
    ("", Chain, f"{_RUN}, of the decoupled chain"),
    ("", ElasticCrack, f"{_RUN}, of the flexible model"),
    ("", ElasticDam, f"{_RUN}, of the flexible model"),
    ("energy.", Energy, _RUN),
    ("spread.", Spread, _RUN),
    ("static.", StaticState, _RUN),
    ("chosen.", Chosen, _RUN),
    ("limits[].", LimitCheck, _RUN),
    ("crest.", CrestMotion, _RUN),
    ("sequence[].", Stage, _RUN),
    ("signs[].", SignNumbers, _RUN),
    ("friction_band.", FrictionBand, _RUN),
    ("friction_effect.", FrictionEffect, _RUN),
    ("motion.", MotionNumbers, _RUN),
    ("response_spectrum.", SpectralDemand, _STATICS),
    ("cases[].", LoadCase, _STATICS),
    ("cases[].forces[].", ForceNumbers, _STATICS),
    ("checks[].", Check, _STATICS),
    ("governing.*.", Check, _STATICS),
    ("", Solved, "heeltoe solve --json"),
    ("", OverturningMap, "heeltoe overturning --json"),
    ("fragility[].", Curve, "heeltoe study --json"),
    ("hazard[].", AnnualRate, "heeltoe study --json"),
    ("portfolio[].", Ranks, "heeltoe study --json"),
    ("measures_compared.*.", Compared, "heeltoe study --json"),
    ("suite.", SuiteAnswer, "heeltoe study --json"),
    ("sensitivity.*.", Sobol, "heeltoe study --json"),
)
# Attributes that the JSON does not have, or says by keys of their own.
_WITHOUT_KEY = {
    "gravity", "vertical", "cross", "seconds", "sources", "ends_m", "moment_nm", "dam", "parts",
}  # fmt: skip


def keys_of_the_json() -> Iterator[Meaning]:
    """Walk all keys of the JSON."""
    meanings: dict[str, str] = {}
    units: dict[str, str] = {}
    places: dict[str, list[str]] = {}
    for name, number, where in numbers_of_results():
        meanings.setdefault(name, number.meaning)
        units[name] = number.unit
        places.setdefault(name, []).append(where)
    for above, kind, where in _CLASSES:
        for name, text in attribute_meanings(kind).items():
            if name not in _WITHOUT_KEY and f"{above}{name}" != "asked":
                meanings.setdefault(f"{above}{name}", text)
                places.setdefault(f"{above}{name}", []).append(where)
    others = [(f"{command} --json", keys) for command, keys in OF_OTHERS.items()]
    for where, keys in ((_RUN, OF_A_RUN), (_STATICS, OF_STATICS), *others):
        for name, text in keys.items():
            meanings[name] = text
            if where not in places.setdefault(name, []):
                places[name].append(where)
    below: dict[str, list[str]] = {}
    for name in meanings:
        above = name.rpartition(".")[0]
        for block in {above, above.removesuffix("[]")}:
            below.setdefault(block, []).append(name)
    for name, text in meanings.items():
        unit = units.get(name) or unit_of(name)
        text = text.replace(f" [{unit}]", "") if unit else text
        # What every run writes need not be named again for one model.
        always = _RUN in places[name]
        homes = [home for home in dict.fromkeys(places[name]) if not (always and home.startswith(f"{_RUN}, "))]
        where = ", ".join(homes)
        yield Meaning(
            name,
            "key of the JSON",
            text,
            unit,
            found_in=where,
            page=page_of(name, ""),
            parts=tuple(below.get(name, ())),
        )


def numbers_of_results() -> Iterator[tuple[str, Number, str]]:
    """Walk the paths of the typed blocks of results, with their content and the command that writes them."""
    for above, kind, where in _BLOCKS:
        for path, number in described(kind, above):
            name = path.removeprefix("static.") if path.startswith("static.critical_acceleration_g") else path
            # Of several cracks alone.
            yield (f"cracks[].{name}" if name.split(".")[0] in OF_SEVERAL else name), number, where


def columns() -> Iterator[Meaning]:
    """Walk the columns of the tables that runs and studies leave."""
    for kind, where, table in (
        ("column of the histories", "histories.parquet", columns_of(Histories)),
        ("column of the events", "events.parquet", columns_of(EventLog)),
    ):
        for name, number in table.items():
            yield Meaning(name, kind, number.meaning, number.unit, found_in=where)
    for name, meaning in OF_STUDIES.items():
        yield Meaning(name, "column of a study", meaning, unit_of(name), found_in="runs of heeltoe study")


def outcomes() -> Iterator[Meaning]:
    """Walk the ways in which a run ends, each with the remedy where it leaves no result."""
    for outcome in Outcome:
        result = "a result" if outcome.has_result else "no result"
        failed = ", and the dam has failed" if outcome.failed else ""
        texts = (f"{outcome.sentence}: {result}{failed}", outcome.remedy)
        meaning = " ".join(f"{text[0].upper()}{text[1:]}." for text in texts if text)
        where = "outcome of heeltoe run --json, runs of heeltoe study"
        yield Meaning(outcome.value, "outcome of a run", meaning, "", found_in=where)


def attribute_meanings(kind: type) -> dict[str, str]:
    """Return what a class says of its attributes in the section of its docstring."""
    text = inspect.cleandoc(kind.__doc__ or "")
    _, _, section = text.partition("Attributes\n----------\n")
    meanings: dict[str, str] = {}
    for names, prose in re.findall(r"^(\S.*)\n((?:    .*\n?|\n)+)", section, re.MULTILINE):
        meanings |= {name.strip(): _plain(prose) for name in names.split(",")}
    return meanings


def _plain(text: str) -> str:
    """Return a text without its marks."""
    bare = re.sub(r":\w+:`~?(?:[\w.]+\.)?(\w+)`", r"\1", text).replace("``", "")
    return " ".join(re.sub(r"\bNone\b", "null", bare).split())


# What a number is worth, whose unit is that of the number.
_OF_A_NUMBER = ["mean", "std", "min", "max", "value", "run", "uncertainty", "step", "mesh", "shaking", "surroundings"]


def unit_of(name: str) -> str:
    """Return the unit that the name of a key or a column ends in; empty where it says none."""
    parts = [part.removesuffix("[]") for part in name.split(".") if part != "*"]
    for part in (parts[-1], *parts[-2:-1]):
        for ending, unit in ENDINGS.items():
            if part.endswith(ending):
                return unit
        if part not in _OF_A_NUMBER:
            break
    return ""
