"""Every option of every command with every hostile text."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

from heeltoe.app import serve
from heeltoe.cli.main import program
from shared.attacked import Attack
from shared.dams import BASE, BLOCK, COARSE, SLENDER
from shared.hostile import NUMBERS, TEXTS, WITH_UNITS

COMMANDS: dict[str, Any] = typer.main.get_command(program()).commands  # type: ignore[attr-defined]
#: What a command is called with beside the option that is tried: what is quick.
USUAL: dict[str, list[str | Path]] = {
    "run": [BLOCK],
    "statics": [BLOCK],
    "periods": [BASE, *(part for change in COARSE for part in ("--set", change))],
    "overturning": [SLENDER, "--count=2"],
    "animate": [BLOCK, "--to=page.html"],
    "export": [BASE, "--to=gmsh", "--out=files", *(part for change in COARSE for part in ("--set", change))],
    "motion": ["record.txt"],
    "study": ["study.json", "--dry-run"],
    "new": ["fresh"],
    "examples": [],
    "app": ["--no-browser", "--public"],
    "explain": ["crack.friction"],
    "law": ["barton-bandis"],
    "solve": [BLOCK, "crack.friction", "--until=residual_slip = 1 mm", "--between=0.4,0.6"],
}
RECORD = "# units: time [s], acceleration [g]\n" + "".join(f"{0.01 * k:.2f} {(-1) ** k * 0.2}\n" for k in range(50))
# A run of one dam.
STUDY = json.dumps({"case": str(BLOCK), "vary": {"crack.friction": [0.5]}})
WORDS = (
    *(text for text in TEXTS if len(text) < 10_000),
    *(str(number) for number in NUMBERS),
    *(f"{number} {unit}" for number in WITH_UNITS for unit in ("s", "g", "m")),
    *("synthetic:", "synthetic:M9e9,0km", "synthetic:M6.5,20km,seed=-1", "synthetic:M6.5,1e308km", "both", "full,step"),
)
SETTINGS = ("crack.friction=", "=1", "crack.friction", "..=1", "a.b.c=1", "crack=1", "section.polygon=[[", "title.x=1")


def calls(name: str) -> Iterator[list[str | Path]]:
    """Walk all calls of a command: each option and argument with every word."""
    usual = USUAL[name]
    for parameter in COMMANDS[name].params:
        if parameter.name == "help" or getattr(parameter, "is_flag", False):
            continue
        if parameter.param_type_name == "argument":
            yield from ([word, *usual[1:]] for word in WORDS)
            continue
        option = max(parameter.opts, key=len)
        kept = [argument for argument in usual if not str(argument).startswith(f"{option}=")]
        words = WORDS
        if option in ("--set", "--vary"):
            words = (*WORDS, *SETTINGS, *(f"crack.friction={word}" for word in WORDS), *(f"{word}=1" for word in WORDS))
        yield from ([*kept, f"{option}={word}"] for word in words)
        yield [*kept, option]
        yield [*kept, option, "--"]


def attack(name: str, place: Path, every: int, record_property: Any) -> None:
    strikes = Attack(f"options of {name}")
    for number, arguments in enumerate(calls(name)):
        if number % every:
            continue
        cwd = place / str(number)
        cwd.mkdir()
        (cwd / "record.txt").write_text(RECORD)
        (cwd / "study.json").write_text(STUDY)
        strikes.strike(f"{name} {arguments[-1] if len(arguments) > 1 else arguments!r}", name, *arguments, cwd=cwd)
        shutil.rmtree(cwd)
    strikes.report(record_property)


@pytest.fixture(autouse=True)
def nobody_comes(monkeypatch):
    """The app listens, says where, and ends."""

    async def over(*_: Any) -> None:
        pass

    monkeypatch.setattr(serve, "_run", over)


def test_all_commands_are_attacked():
    assert set(USUAL) == set(COMMANDS)


@pytest.mark.slow
@pytest.mark.usefixtures("empty_figures")
@pytest.mark.parametrize("name", USUAL)
def test_some_words_for_every_option(name, tmp_path, record_property):
    attack(name, tmp_path, 41, record_property)


@pytest.mark.product
@pytest.mark.usefixtures("empty_figures")
@pytest.mark.parametrize("name", USUAL)
def test_most_words_for_every_option(name, tmp_path, record_property):
    attack(name, tmp_path, 3, record_property)
