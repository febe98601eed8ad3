"""Whatever is wrong with the input: one line that names the field and the remedy, exit code 2, nothing written."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from shared.command import command, process
from shared.dams import TYPICAL_SECTION

GOOD = """
title = "Test"
[section]
{section}
[concrete]
density = "2650 kg/m^3"
[crack]
friction = 1.0
restitution = 0.5
[reservoir]
depth = "95 m"
[motion]
file = "quake.txt"
""".replace("{section}", "\n".join(f'{name} = "{value}"' for name, value in TYPICAL_SECTION.items()))
QUAKE = "# units: time [s], acceleration [g]\n" + "".join(
    f"{0.01 * k:.2f} {0.3 * (-1) ** (k // 20)}\n" for k in range(200)
)

# What is replaced in the good case (or the record), by what, and words the one line must have.
EDITS = {
    "negative depth": ('depth = "95 m"', 'depth = "-5 m"', ["reservoir.depth", "-5 m"]),
    "water far above the crest": ('depth = "95 m"', 'depth = "220 m"', ["reservoir.depth", "220 m", "200 m"]),
    "unit of the wrong kind": ('depth = "95 m"', 'depth = "95 s"', ["reservoir.depth", "length"]),
    "no unit": ('depth = "95 m"', "depth = 95", ["reservoir.depth", "has no unit"]),
    "unit no one knows": ('depth = "95 m"', 'depth = "95 furlongz"', ["reservoir.depth", "furlongz"]),
    "not a number": ('depth = "95 m"', 'depth = "deep"', ["reservoir.depth", "deep"]),
    "infinite": ('depth = "95 m"', 'depth = "inf m"', ["reservoir.depth"]),
    "not a number at all": ('depth = "95 m"', 'depth = "nan m"', ["reservoir.depth"]),
    "a list for a length": ('depth = "95 m"', "depth = [1, 2]", ["reservoir.depth"]),
    "missing depth": ('depth = "95 m"', "", ["reservoir.depth"]),
    "crack above the crest": ("friction = 1.0", 'friction = 1.0\nelevation = "100 m"', ["crack.elevation", "100 m"]),
    "crack below the base": ("friction = 1.0", 'friction = 1.0\nelevation = "-1 m"', ["crack.elevation"]),
    "restitution above one": ("restitution = 0.5", "restitution = 1.2", ["crack.restitution", "1.2"]),
    "negative restitution": ("restitution = 0.5", "restitution = -0.1", ["crack.restitution"]),
    "negative friction": ("friction = 1.0", "friction = -1.0", ["crack.friction"]),
    "absurd friction": ("friction = 1.0", "friction = 50", ["crack.friction", "50"]),
    "no friction": ("friction = 1.0", "", ["crack.friction"]),
    "two kinds of friction": ("friction = 1.0", "friction = 1.0\nkinetic_friction = 0.8", ["crack.", "friction"]),
    "static below kinetic": (
        "friction = 1.0",
        "static_friction = 0.7\nkinetic_friction = 0.9",
        ["crack.static_friction", "0.9"],
    ),
    "a near miss": ("friction = 1.0", "fricton = 1.0", ["crack.fricton", "friction"]),
    "an unknown table": ("[reservoir]", "[resevoir]", ["resevoir", "reservoir"]),
    "negative density": ('density = "2650 kg/m^3"', 'density = "-1 kg/m^3"', ["concrete.density"]),
    "density in g": ('density = "2650 kg/m^3"', 'density = "2650 g"', ["concrete.density", "density"]),
    "no section": (GOOD[GOOD.index("[section]") : GOOD.index("[concrete]")], "", ["section"]),
    "half a section": ('base_width = "80 m"', "", ["section", "base_width"]),
    "neck above the crest": ('neck_height = "90 m"', 'neck_height = "190 m"', ["neck_height", "190 m"]),
    "self-crossing polygon": (
        GOOD[GOOD.index("height") : GOOD.index("[concrete]")],
        'polygon = [["0 m","0 m"],["9 m","9 m"],["9 m","0 m"],["0 m","9 m"]]\n',
        ["section.polygon", "crosses"],
    ),
    "two corners": (
        GOOD[GOOD.index("height") : GOOD.index("[concrete]")],
        'polygon = [["0 m","0 m"],["9 m","9 m"]]\n',
        ["section.polygon", "corners"],
    ),
    "corners without units": (
        GOOD[GOOD.index("height") : GOOD.index("[concrete]")],
        "polygon = [[0, 0], [9, 0], [9, 9]]\n",
        ["section.polygon", "unit"],
    ),
    "unknown uplift": (
        "[motion]",
        '[uplift]\npattern = "square"\n[motion]',
        ["uplift.pattern", "square", "triangular"],
    ),
    "drains without position": ("[motion]", '[uplift]\npattern = "drained"\n[motion]', ["uplift", "drain"]),
    "extent of a triangle": ("[motion]", "[uplift]\nextent = 0.5\n[motion]", ["uplift.extent"]),
    "negative intensity": ("[motion]", "[uplift]\nintensity = -1\n[motion]", ["uplift.intensity"]),
    "peak of 50 g": ('file = "quake.txt"', 'file = "quake.txt"\npga = "50 g"', ["motion.pga", "50 g"]),
    "peak of zero": ('file = "quake.txt"', 'file = "quake.txt"\npga = "0 g"', ["motion.pga"]),
    "duration of zero": ('file = "quake.txt"', 'file = "quake.txt"\nduration = "0 s"', ["motion.duration"]),
    "no record of that name": ('"quake.txt"', '"earthquak.txt"', ["motion.file", "earthquak.txt"]),
    "no motion": ('[motion]\nfile = "quake.txt"', "", ["motion"]),
    "file and points": (
        'file = "quake.txt"',
        'file = "quake.txt"\npoints = [["0 s","1 g"],["1 s","1 g"]]',
        ["motion", "points"],
    ),
    "points out of order": (
        'file = "quake.txt"',
        'points = [["1 s","0.1 g"],["0 s","0.1 g"]]',
        ["motion.points", "ascend"],
    ),
    "truth in words": ('file = "quake.txt"', 'file = "quake.txt"\nreverse = "yes"', ["motion.reverse"]),
    "unit conflict": ('file = "quake.txt"', 'file = "quake.txt"\nunit = "m/s^2"', ["motion.unit", "quake.txt"]),
    "not TOML": ("[crack]", "[crack", ["case.toml", "TOML"]),
    "elements by half": ("[motion]", "[flexible]\nelements_across = 2.5\n[motion]", ["flexible.elements_across"]),
    "gravity in metres": ('title = "Test"', 'gravity = "9.81 m"', ["gravity"]),
}

RECORDS = {
    "empty record": ("", ["quake.txt", "is empty"]),
    "nan in a record": (QUAKE.replace("0.05 0.3", "0.05 nan"), ["quake.txt", "nan"]),
    "zero record": (re.sub(r" -?0\.3", " 0.0", QUAKE), ["motion", "zero", "allow_zero"]),
    "record in cm/s2 that says g": (QUAKE.replace(" 0.3", " 300").replace(" -0.3", " -300"), ["motion", "300 g"]),
    "record without unit": (QUAKE.split("\n", 1)[1], ["quake.txt", "motion.unit"]),
    "record of words": ("no record\nat all\n", ["quake.txt", "format"]),
    "one sample": ("# units: [g]\n0.0 0.1\n", ["quake.txt", "1 samples"]),
    "time runs back": (QUAKE + "0.5 0.1\n", ["quake", "goes back"]),
}

ARGUMENTS = {
    "no such case": (["run", "nothing.toml"], ["nothing.toml", "no such file"]),
    "a directory": (["run", "."], ["cannot be read"]),
    "set without a value": (["run", "case.toml", "--set", "crack.friction"], ["crack.friction", "PATH=VALUE"]),
    "set an unknown field": (["run", "case.toml", "--set", "crack.frict=1"], ["crack.frict", "friction"]),
    "set a wrong unit": (["run", "case.toml", "--set", "reservoir.depth=5s"], ["reservoir.depth"]),
    "pga without a unit": (["run", "case.toml", "--pga", "0.4"], ["motion.pga", "unit"]),
    "unknown model": (["run", "case.toml", "--model", "soft"], ["--model", "soft"]),
    "unknown motion": (["run", "case.toml", "--motion", "zzz"], ["motion.file", "zzz", "motion --list"]),
    "step beyond the run": (["run", "case.toml", "--output-step", "100s"], ["output_step", "100 s"]),
    "out is a file": (["run", "case.toml", "--out", "case.toml"], ["--out", "case.toml"]),
    "json nowhere": (["run", "case.toml", "--json", "no/where.json"], ["no", "is not there"]),
    "motion of nothing": (["motion"], ["--list"]),
    "flexible without a modulus": (
        ["run", "case.toml", "--model", "flexible", "--out", "o"],
        ["concrete.modulus", "GPa"],
    ),
    "both without a modulus": (["run", "case.toml", "--model", "both", "--out", "o"], ["concrete.modulus"]),
    "spread of one": (["run", "case.toml", "--spread", "1"], ["--spread", "1 is", "2 to 1000"]),
    "spread of thousands": (["run", "case.toml", "--spread", "1001", "--out", "o"], ["--spread", "1001"]),
    "spread of words": (["run", "case.toml", "--spread", "much", "--json", "x.json"], ["--spread", "much"]),
    "spread below nothing": (["run", "case.toml", "--spread", "-3"], ["--spread", "-3"]),
    "vtk without a place": (["run", "case.toml", "--vtk", "--model", "flexible"], ["--vtk", "--out DIR"]),
    "vtk of a rigid block": (["run", "case.toml", "--vtk", "--out", "o"], ["--vtk", "--model flexible"]),
    "periods without a modulus": (["periods", "case.toml", "--json", "x.json"], ["concrete.modulus"]),
    "no periods": (["periods", "case.toml", "--count", "0", "--set", "concrete.modulus=20GPa"], ["--count", "1 to 50"]),
    "periods nowhere": (["periods", "case.toml", "--json", "no/where.json"], ["no", "is not there"]),
    "report of a table": (["run", "case.toml", "--vary", "crack.friction=1,2", "--report"], ["--report", "--vary"]),
    "statics of an unknown criterion": (["statics", "case.toml", "--criteria", "me"], ["statics.criteria", "USACE"]),
    "statics with a slip of seconds": (["statics", "case.toml", "--slip", "5 s"], ["--slip"]),
    "no pulse": (["overturning", "case.toml", "--pulse", "square"], ["pulse", "half-sine"]),
    "too many pulses": (["overturning", "case.toml", "--count", "401"], ["count", "400"]),
    "animation of what": (["animate", "case.toml", "--to", "dam.avi"], ["avi", ".mp4"]),
    "animation of both": (["animate", "case.toml", "--model", "both"], ["both", "auto, rigid, decoupled, flexible"]),
    "decoupled at the base": (["run", "case.toml", "--model", "decoupled"], ["crack.elevation"]),
    "units of nowhere": (["run", "case.toml", "--units", "cgs", "--out", "o"], ["--units", "si or us"]),
    "out in a place of the system": (["run", "case.toml", "--out", "/proc/heeltoe"], ["/proc/heeltoe", "written"]),
    "new over an old one": (["new", "case"], ["case.toml", "already exists"]),
    "figure without an ending": (["motion", "quake.txt", "--figure", "x.doc"], ["--figure", "x.doc", ".png"]),
    "new in no directory": (["new", "no/where"], ["no"]),
}


@pytest.fixture
def place(tmp_path, monkeypatch):
    (tmp_path / "case.toml").write_text(GOOD)
    (tmp_path / "quake.txt").write_text(QUAKE)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refuse(place: Path, arguments: list[str], words: list[str]) -> None:
    before = sorted(place.rglob("*"))
    screen = command(*arguments)
    err = screen.stderr
    assert screen.returncode == 2, err
    lines = err.splitlines()
    assert lines, "nothing was said"
    assert all(line.startswith("heeltoe: ") and "; " in line for line in lines), err
    for word in words:
        assert word in err, err
    assert "Verdict" not in screen.stdout
    assert sorted(place.rglob("*")) == before, "something was left behind"


@pytest.mark.usefixtures("place")
def test_the_good_case_runs():
    screen = command("run", "case.toml")
    assert screen.returncode == 0, screen.stderr
    assert "Verdict" in screen.stdout


@pytest.mark.parametrize("name", EDITS)
def test_case(name, place):
    old, new, words = EDITS[name]
    assert old in GOOD
    (place / "case.toml").write_text(GOOD.replace(old, new))
    refuse(place, ["run", "case.toml", "--out", "out", "--json", "x.json"], words)


@pytest.mark.parametrize("name", RECORDS)
def test_record(name, place):
    text, words = RECORDS[name]
    (place / "quake.txt").write_text(text)
    refuse(place, ["run", "case.toml", "--out", "out"], words)


@pytest.mark.parametrize("name", ARGUMENTS)
def test_arguments(name, place):
    arguments, words = ARGUMENTS[name]
    refuse(place, arguments, words)


def test_a_real_process_says_the_same(place):
    (place / "case.toml").write_text(GOOD.replace("restitution = 0.5", "restitution = 1.2"))
    result = process("run", "case.toml")
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1
    assert "crack.restitution" in result.stderr


def test_there_are_forty_and_more():
    assert len(EDITS) + len(RECORDS) + len(ARGUMENTS) >= 60
