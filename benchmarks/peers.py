"""Independent codes on problems that they and heeltoe both solve: what each needs, how wrong it is, what it cannot do.

python benchmarks/peers.py                    # all that are installed; writes their numbers and the book's page of them
python benchmarks/peers.py MuJoCo             # one of them
python benchmarks/peers.py --page             # the page alone, from the numbers as they are
"""

from __future__ import annotations

import argparse
import csv
import sys
from pathlib import Path

from measure import NothingMeasured
from peers_declared import PEERS, PROBLEMS, Peer

HERE = Path(__file__).parent
NUMBERS = HERE / "peers.csv"
PAGE = HERE.parent / "docs" / "validation" / "independent-codes.md"
COLUMNS = ("program", "version", "settings", "step", "error", "heeltoe")
Line = dict[str, str]

_HEAD = """<!-- Made by `make peers` and `make book`; what is changed by hand here fails the tests. -->

# Independent codes

Programs that were written by others and know nothing of heeltoe, each on a problem that both can solve and whose exact
answer is known. Anyone can run them:

    make peers                 # installs those that the package registry has; all of them
    make peers PEER=MuJoCo     # one of them

What is not installed is named and its numbers stay as they were. Their times, beside ours at no larger error, are in
[results.md](../../benchmarks/results.md). Settings are those that serve each program best on this very problem.
"""


def page(lines: list[Line]) -> str:
    """Return the page of the book."""
    parts = [_HEAD, "## Who solves what\n"]
    heads = ["program", *PROBLEMS]
    parts.append(
        _table(heads, [[peer.name, *("●" if peer.problem == each else "" for each in PROBLEMS)] for peer in PEERS])
    )
    parts.append("\nAll problems are rigid or elastic blocks: none of these programs has the loads of a dam.\n")
    for problem, text in PROBLEMS.items():
        parts.append(f"## {problem[0].upper()}{problem[1:]}\n\n{text}\n")
        mine = [line for line in lines if line["program"] in {peer.name for peer in PEERS if peer.problem == problem}]
        if mine:
            heads = ["program", "version", "settings", "step or tolerance", "largest error", "heeltoe's"]
            parts.append(_table(heads, [[line[column] for column in COLUMNS] for line in mine]) + "\n")
        parts += [_said(peer) for peer in PEERS if peer.problem == problem]
    return "\n".join(parts).rstrip("\n") + "\n"


def _said(peer: Peer) -> str:
    cannot = "\n".join(f"  - {each}" for each in peer.cannot)
    return (
        f"### {peer.name}\n\n{peer.what}\n\n- Licence: {peer.licence}\n- Needs: {peer.needs}\n"
        f"- Script: `benchmarks/{peer.script}`\n- Cannot:\n{cannot}\n"
    )


def _table(heads: list[str], rows: list[list[str]]) -> str:
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, ["---"] * len(heads), *rows])


def read() -> list[Line]:
    """Return the numbers as they are."""
    with NUMBERS.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def renewed(old: list[Line], peer: Peer, new: list[Line]) -> list[Line]:
    """Return the numbers with those of one program in place of its old ones, in the order of the programs."""
    kept = [line for line in old if line["program"] != peer.name] + new
    order = [each.name for each in PEERS]
    return sorted(kept, key=lambda line: order.index(line["program"]))


def run(peer: Peer) -> list[Line]:
    """Run one program.

    Raises
    ------
    NothingMeasured
        Where it is not installed, or its block did not do what the problem asks for.
    """
    try:
        found = peer.solve()
    except ImportError as error:
        raise NothingMeasured(f"not installed ({error}); it needs {peer.needs}") from None
    texts = (
        (each.settings, each.step, f"{each.error:.2g} {each.unit}".strip(), f"{each.ours:.2g} {each.unit}".strip())
        for each in found
    )
    return [dict(zip(COLUMNS, (peer.name, peer.version(), *text), strict=True)) for text in texts]


def main() -> None:
    """Run programs and write what they found."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("peer", nargs="*", metavar="PEER", help=f"of {', '.join(each.name for each in PEERS)}")
    parser.add_argument("--page", action="store_true", help="the page alone")
    told = parser.parse_args()
    by_name = {each.name.lower(): each for each in PEERS}
    if unknown := [name for name in told.peer if name.lower() not in by_name]:
        parser.error(f"there is no program {', '.join(unknown)}")
    lines = read() if NUMBERS.exists() else []
    for peer in [] if told.page else [by_name[name.lower()] for name in told.peer] or PEERS:
        try:
            new = run(peer)
        except NothingMeasured as reason:
            print(f"{peer.name}: {reason}", file=sys.stderr)
            continue
        lines = renewed(lines, peer, new)
        print("\n".join(" ".join(f"{line[column]:12s}" for column in COLUMNS) for line in new))
    if not told.page:
        with NUMBERS.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(lines)
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
