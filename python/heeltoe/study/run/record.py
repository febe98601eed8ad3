"""Content of ``study.json``: one schema for all of it, and a checksum, as it may come from a stranger or a
bad disk."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from heeltoe.base.atomic_files import write_text
from heeltoe.case.distribution import Distribution
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.result.write import json_text
from heeltoe.study.plan.file import Study
from heeltoe.study.plan.plan import MOST

STUDY = "study.json"
#: Version of the layout of a directory; another one cannot be read.
VERSION = 6
#: Runs of a part at most, so that memory stays small.
MOST_OF_PART = 32_768
_CHECKSUM = "checksum"

Finite = Annotated[float, Field(allow_inf_nan=False)]
Words = Annotated[list[str], Field(min_length=1)]


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True, defer_build=True)


class _Motion(_Model):
    name: str
    event: str
    reversed: bool
    measures: dict[str, Finite]
    traits: dict[str, Finite | None]
    vs30_m_s: Finite | None
    pulse_period_s: Finite | None
    hazard_share: Finite | None = None
    azimuth_deg: Finite | None = None


class _Hazard(_Model):
    strength: Annotated[list[Finite], Field(min_length=2)]
    annual_rate: Annotated[list[Finite], Field(min_length=2)]
    at: list[Finite]


class _Target(_Model):
    name: str
    period_s: list[Finite]
    pseudo_acceleration_m_s2: list[Finite]


class _Spectra(_Model):
    damping: Finite
    period_s: list[Finite]
    motions: dict[str, list[Finite]]
    target: _Target | None


class _Pilot(_Model):
    elements_across: Annotated[int, Field(ge=1)]
    elements_across_below: Annotated[int, Field(ge=1)] | None
    first_step_s: Annotated[Finite, Field(gt=0.0)]
    time_step_s: Annotated[Finite, Field(gt=0.0)]
    silence_s: Annotated[Finite, Field(ge=0.0)]
    motion: Annotated[int, Field(ge=0)]
    evidence: dict[str, Any] | None
    means: list[dict[str, Finite | None]]
    other_sign: _Pilot | None
    elements_away: Annotated[int, Field(ge=1)] | None
    scatters: bool = False


class _Joint(_Model):
    place: Annotated[int, Field(ge=0)]
    elevation_m: Finite


class _Record(_Model):
    version: Literal[6]
    title: str
    fingerprint: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
    count: Annotated[int, Field(ge=1, le=MOST)]
    size: Annotated[int, Field(ge=1, le=MOST_OF_PART)]
    columns: dict[str, str]
    inputs: dict[str, str]
    warnings: list[str]
    events: Words
    motions: Annotated[list[_Motion], Field(min_length=1)]
    dams: Words | None
    hazard: _Hazard | None
    spectra: _Spectra | None
    pilot: _Pilot | None
    crest: bool
    joints: list[_Joint]
    study: dict[str, Any]
    case: dict[str, Any]
    build: dict[str, str]
    seconds: dict[str, Finite] = {}


def write_record(directory: Path, record: Mapping[str, Any]) -> None:
    """Write what a study is.

    Raises
    ------
    InputError
        Where it cannot be written.
    """
    plain_record = json.loads(json_text({name: value for name, value in record.items() if name != _CHECKSUM}))
    text = json_text({**plain_record, _CHECKSUM: _checksum(plain_record)})
    write_text(directory / STUDY, text, "--out", within=directory)


def read_manifest(directory: Path) -> dict[str, Any]:
    """Return what a study's directory says that it is.

    Raises
    ------
    InputError
        Where there is no study, or it is damaged or none of ours.
    """
    path = directory / STUDY
    damaged = partial(InputError, "source-unreadable", str(path), expected="another directory, or restore the file")
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["version"] != VERSION:
            raise InputError("study-version", str(path), plain(record["version"], 40))
        checksum = record.pop(_CHECKSUM)
        _Record.model_validate(record)
        study = Study.of(record["study"], directory)
    except FileNotFoundError:
        raise InputError("study-not-there", str(directory)) from None
    except ValidationError as error:
        wrong = error.errors(include_url=False)[0]
        place = plain(".".join(map(str, wrong["loc"])), 60)
        raise damaged(reason=f"{place}: {plain(wrong['msg'], 80)}") from None
    except InputError as error:
        if error.code == "study-version":
            raise
        raise damaged(reason=f"study.{error.field}: {error.code}") from None
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise damaged(reason=type(error).__name__) from None
    if checksum != _checksum(record):
        raise damaged(reason="its checksum is another one")
    for reason in _contradictions(record, study):
        raise damaged(reason=reason)
    return dict(record)


def _checksum(record: Mapping[str, object]) -> str:
    return hashlib.sha256(json.dumps(record, sort_keys=True).encode()).hexdigest()


def _contradictions(record: Mapping[str, Any], study: Study) -> list[str]:
    """Return where what a record says of its runs does not agree."""
    motions, scale = record["motions"], study.motions.scale if study.motions else None
    every = study.motions.every if study.motions else None
    meets_all = not study.drawn if every is None else every
    strengths = (
        scale.values if scale is not None and not (study.drawn and isinstance(scale.values, Distribution)) else (1,)
    )
    if isinstance(strengths, Distribution):
        return ["study.motions.scale: a distribution that is not drawn"]
    one = (len(motions) if meets_all else 1) * len(strengths) * len(study.model)
    counts = [values.count or 0 if isinstance(values, Distribution) else len(values) for values in study.vary.values()]
    if record["dams"] is not None:
        dams = len(record["dams"])
    elif study.method == "grid":
        dams = int(np.prod(counts, dtype=object))
    elif study.method == "one at a time":
        dams = 1 + sum(counts)
    else:
        drawn = len(study.vary) + (not meets_all) + isinstance(scale.values if scale else None, Distribution)
        dams = (study.samples or 0) * (drawn + 2 if study.method == "sensitivity" else 1)
    known = motions[0]["measures"].keys()
    hazard, spectra, pilot = record["hazard"], record["spectra"], record["pilot"]
    wrong = {
        "count: not that of the study": record["count"] != dams * one,
        "motions: they have other measures": any(motion["measures"].keys() != known for motion in motions),
        "motions: an event that is none": any(motion["event"] not in record["events"] for motion in motions),
        "motions: one is there twice": len({(motion["name"], motion["reversed"]) for motion in motions}) < len(motions),
        "hazard: strengths and rates": hazard is not None and not _falls(hazard["strength"], hazard["annual_rate"]),
        "spectra: motions and periods": spectra is not None
        and (
            spectra["motions"].keys() != {motion["name"] for motion in motions}
            or any(len(row) != len(spectra["period_s"]) for row in spectra["motions"].values())
        ),
        "pilot: a motion that is none": pilot is not None and pilot["motion"] >= len(motions),
        "dams: a table of dams": (study.cases is None) != (record["dams"] is None),
    }
    return [reason for reason, is_so in wrong.items() if is_so]


def _falls(strength: list[float], rate: list[float]) -> bool:
    """Whether these are a hazard curve."""
    if len(strength) != len(rate) or min(*strength, *rate) <= 0.0:
        return False
    return bool(np.all(np.diff(strength) > 0.0) and np.all(np.diff(rate) < 0.0))
