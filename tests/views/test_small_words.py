"""A table of runs on a terminal."""

from __future__ import annotations

import io

from rich.console import Console

from heeltoe import rigid
from heeltoe.study.small.run_table import parse_axes, run_small
from heeltoe.views.terminal.small import print_small
from shared.dams import KOYNA, SHORT


def test_warnings_that_differ_in_numbers_alone_are_one():
    grid = run_small(KOYNA, SHORT, parse_axes(["motion.pga=0.4 g,0.5 g,0.6 g"]), rigid)
    console = Console(file=io.StringIO(), width=100)
    print_small(grid, console)
    short = console.file.getvalue()
    print_small(grid, console, details=True)
    long = console.file.getvalue()[len(short) :]
    assert "warning  0.4 g and 2 more, with other numbers: a rigid block leaves out" in short
    assert "with other numbers" not in long
    assert long.count("a rigid block leaves out the vibration") == 3


def test_a_narrow_terminal_cuts_no_number():
    texts = ["crack.friction=0.1,1.0", "reservoir.depth=85 m,91.75 m", "uplift.pattern=none,triangular"]
    grid = run_small(KOYNA, SHORT, parse_axes(texts), rigid)
    tables = []
    for width in (60, 80, 160):
        console = Console(file=io.StringIO(), width=width)
        print_small(grid, console)
        text = console.file.getvalue()
        assert "…" not in text
        assert text.count("impacts") == 1
        assert max(map(len, text.splitlines()[3:])) <= width
        tables.append(sum(line.startswith("friction ") for line in text.splitlines()))
        # What belongs to some runs says to which; what belongs to all is said once.
        assert "0.1, 91.75 m, none: unstable" in " ".join(text.split())
        assert text.count("baseline") == 1
    # As many as it takes, and one where there is room.
    assert tables[0] > tables[1] > tables[2] == 1
