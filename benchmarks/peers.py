"""Independent codes on problems that they and heeltoe both solve: what each needs, how wrong it is, what it cannot do.

python benchmarks/peers.py                    # all that are installed; writes their numbers and the book's page of them
python benchmarks/peers.py MuJoCo             # one of them
python benchmarks/peers.py --page             # the page alone, from the numbers as they are
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import peers_solve
from measure import NothingMeasured
from peers_solve import Solved

HERE = Path(__file__).parent
NUMBERS = HERE / "peers.csv"
PAGE = HERE.parent / "docs" / "validation" / "independent-codes.md"
COLUMNS = ("problem", "program", "version", "settings", "step", "error", "heeltoe")
Line = dict[str, str]

_HEAD = """<!-- Made by `make peers` and `make book`; not edited by hand. -->

# Independent codes

Independent programs, each on problems that it and heeltoe can solve and whose exact answer is known, or the program's
own answer with ever smaller steps:

    make peers                 # installs those of the package registry; all of them
    make peers PEER=MuJoCo     # one of them

Numbers of programs that are not installed stay unchanged. Their times, beside ours at no larger error, are in
[results.md](../../benchmarks/results.md). Settings are the best of each program for this very problem.
"""


@dataclass(frozen=True)
class Peer:
    """A program.

    Attributes
    ----------
    name, package
        Its name, and that of what is installed; no package where no registry has it.
    licence, what, needs
        Its licence, what it is, and what a machine must have for it.
    script
        Of this folder, which hands the problem to it.
    solve
        Solves each of the `PROBLEMS` that it is given.
    limits
        The part of heeltoe's work that it cannot do, or not by default.
    """

    name: str
    package: str
    licence: str
    what: str
    needs: str
    script: str
    solve: Mapping[str, Callable[[], list[Solved]]]
    limits: tuple[str, ...]

    def version(self) -> str:
        """Return the version that is installed."""
        try:
            return metadata.version(self.package) if self.package else peers_solve.siconos_version()
        except metadata.PackageNotFoundError:
            return "unknown"


PROBLEMS = {
    "sliding both ways": "A block of 4 m by 1 m and 1 t, friction 0.3, under a constant push of 0.15 g on a base that "
    "moves with 0.6 g at 2 Hz for 5 s. The exact slip is a sum of sines between stops, 1.0538997745 m in the end. "
    "Errors are the largest at any tenth of a second.",
    "sliding one way": "Newmark's block under 30 s of El Centro 1940 (180, NGA) at 0.4 g, yielding at 0.1 g; straight "
    "between the samples. The exact slip is summed in wider numbers. Errors are the largest at any sample, relative to "
    "the slip in the end.",
    "an elastic block": "The block that slides both ways made elastic, 20 GPa, no damping, 16 by 4 elements. Errors "
    "are against the exact slip of the rigid one; the elastic one slides some 0.3 mm less, so that no smaller error "
    "means anything.",
    "two blocks": "Two rigid blocks, one on the other, 4 m by 6 m under 2.4 m by 6 m, by one sine wave of the ground "
    "of 1 s: both rock; both slide and rock; both rock and bounce. No exact answer is known: errors are the largest "
    "differences of any slip or gap, at any moment, from Siconos' own with steps of 0.025 ms, where the largest of "
    "them is 327, 242 and 322 mm. Among its solvers only projected Gauss-Seidel lets blocks stand.",
    "both components": "A block of 2 m by 3 m whose ground shakes along and across, each by a sine for a second: with "
    "a friction of 0.6 and 0.8 g across it slides by -23.14 mm along and 6.67 mm across, with 0.8 and 0.5 g it rocks "
    "and slides by 4.93 and 3.05 mm. Friction is one circle in every contact. Errors are the largest differences of "
    "any slip or gap, at any sample, from Siconos' own with steps of 0.01 ms, where the largest of them is 106 and 82 "
    "mm.",
    "rocking": "A block of 1 m by 4 m let go at half its slenderness, at rotations of any size, each blow with "
    "Housner's ratio. The exact moments of the blows are integrals of its energy. Errors are the largest "
    "relative ones of them.",
}

_REGISTRY = "`pip install -r requirements-bench.lock`"

PEERS = (
    Peer(
        "MuJoCo",
        "mujoco",
        "Apache 2.0",
        "A rigid-body engine for robots; contact is soft, by a convex optimisation in every step.",
        _REGISTRY,
        "peer_mujoco.py",
        {"sliding both ways": peers_solve.mujoco},
        (
            "a coefficient of restitution as a number: `solref` sets the rebound by the damping of the contact, 0.13 "
            "at its critical default, 0.75 at a tenth of it, 1 without",
            "friction that holds without creep by default: 0.4 mm/s at half of its capacity, and next to nothing "
            "(0.003 mm in 5 s) with an elliptic cone, `noslip_iterations` and a free body",
            "events: its error falls with the step, and not below the softness of the contact",
        ),
    ),
    Peer(
        "PyBullet",
        "pybullet",
        "zlib",
        "Bullet, a rigid-body engine for games and robots, called from Python step by step.",
        f"{_REGISTRY}; where no wheel fits, a compiler for C++",
        "peer_pybullet.py",
        {"sliding both ways": peers_solve.pybullet},
        (
            "one law of impact for a corner: it shares a blow among contact points in its own way, and with a "
            "restitution of 1 a ball does not bounce at steps of 1 ms and less",
            "contact solved to rounding: sequential impulses stop after a number of sweeps",
            "vertical gaps below its margin of contact: it keeps bodies apart by a slop",
        ),
    ),
    Peer(
        "pySLAMMER",
        "pyslammer",
        "GPL 3.0",
        "Sliding blocks for slopes in earthquakes, after SLAMMER of the US Geological Survey.",
        _REGISTRY,
        "peer_pyslammer.py",
        {"sliding one way": peers_solve.pyslammer},
        (
            "sliding upstream: its block goes one way",
            "rocking, uplift of a corner, impact",
            "vertical motion; friction that differs at rest and in motion, or a yield acceleration that changes with "
            "slip: the functions and tables that it documents raise TypeError",
        ),
    ),
    Peer(
        "OpenSees",
        "openseespy",
        "free for research, own licence",
        "Finite elements for structures in earthquakes; contact by a penalty on pairs of nodes.",
        f"{_REGISTRY}; Linux on x86-64, macOS or Windows; on Debian libblas3",
        "peer_opensees.py",
        {"an elastic block": peers_solve.opensees},
        (
            "contact without a penalty that gets through: of five kinds one does, with its direction of friction fixed",
            "faces that slide past each other: a pair of nodes stays a pair (zeroLengthContact2D)",
            "a body that is quick to step: all freedoms are solved for anew in each iteration",
            "undamped blocks with schemes that keep energy: they flutter as they slide",
        ),
    ),
    Peer(
        "Siconos",
        "",
        "Apache 2.0",
        "Nonsmooth dynamics: Moreau and Jean's stepping with solvers for frictional contact.",
        "Debian's `python3-siconos` and Debian's own Python; another Python runs it beside itself",
        "peer_siconos.py",
        {
            "an elastic block": peers_solve.siconos,
            "two blocks": peers_solve.siconos_blocks,
            "both components": peers_solve.siconos_circle,
        },
        (
            "finite elements of plane bodies: it takes the matrices of this project's mesh",
            "contact of nodes that travel along another face, unless each new place is given",
            "installation by pip: no package registry of Python has it",
        ),
    ),
    Peer(
        "SciPy",
        "scipy",
        "BSD",
        "An integrator with events (DOP853) and the textbook's equation: what one would write oneself.",
        "nothing that heeltoe does not need itself",
        "rocking_peers.py",
        {"rocking": peers_solve.scipy},
        (
            "sliding with rocking, drift, blows with restitution: each is a program of its own around the integrator",
            "blows that follow each other ever faster: every one is an event to be found",
        ),
    ),
)


def page(lines: list[Line]) -> str:
    """Return the page of the book."""
    parts = [_HEAD, "## Problems by program\n"]
    heads = ["program", *PROBLEMS]
    parts.append(
        _table(heads, [[peer.name, *("●" if item in peer.solve else "" for item in PROBLEMS)] for peer in PEERS])
    )
    parts.append("\nAll problems are rigid or elastic blocks: none of these programs has the loads of a dam.\n")
    for problem, text in PROBLEMS.items():
        parts.append(f"## {problem[0].upper()}{problem[1:]}\n\n{text}\n")
        mine = [line for line in lines if line["problem"] == problem]
        if mine:
            heads = ["program", "version", "settings", "step or tolerance", "largest error", "heeltoe's"]
            parts.append(_table(heads, [[line[column] for column in COLUMNS[1:]] for line in mine]) + "\n")
        parts += [_peer_lines(peer) for peer in PEERS if next(iter(peer.solve)) == problem]
    return "\n".join(parts).rstrip("\n") + "\n"


def _peer_lines(peer: Peer) -> str:
    limits = "\n".join(f"  - {item}" for item in peer.limits)
    return (
        f"### {peer.name}\n\n{peer.what}\n\n- Licence: {peer.licence}\n- Needs: {peer.needs}\n"
        f"- Script: `benchmarks/{peer.script}`\n- Limits:\n{limits}\n"
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
    order = [item.name for item in PEERS]
    return sorted(kept, key=lambda line: order.index(line["program"]))


def run(peer: Peer) -> list[Line]:
    """Run one program.

    Raises
    ------
    NothingMeasured
        Where it is not installed, or its block did not do what the problem asks for.
    """
    lines = []
    for problem, solve in peer.solve.items():
        try:
            solution = solve()
        except ImportError as error:
            raise NothingMeasured(f"not installed ({error}); it needs {peer.needs}") from None
        texts = (
            (item.settings, item.step, f"{item.error:.2g} {item.unit}".strip(), f"{item.ours:.2g} {item.unit}".strip())
            for item in solution
        )
        lines += [dict(zip(COLUMNS, (problem, peer.name, peer.version(), *text), strict=True)) for text in texts]
    return lines


def main() -> None:
    """Run programs and write what they found."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("peer", nargs="*", metavar="PEER", help=f"of {', '.join(item.name for item in PEERS)}")
    parser.add_argument("--page", action="store_true", help="the page alone")
    answer = parser.parse_args()
    by_name = {item.name.lower(): item for item in PEERS}
    if unknown := [name for name in answer.peer if name.lower() not in by_name]:
        parser.error(f"there is no program {', '.join(unknown)}")
    lines = read() if NUMBERS.exists() else []
    for peer in [] if answer.page else [by_name[name.lower()] for name in answer.peer] or PEERS:
        try:
            new = run(peer)
        except NothingMeasured as reason:
            print(f"{peer.name}: {reason}", file=sys.stderr)
            continue
        lines = renewed(lines, peer, new)
        print("\n".join(" ".join(f"{line[column]:12s}" for column in COLUMNS[1:]) for line in new))
    if not answer.page:
        with NUMBERS.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
            writer.writeheader()
            writer.writerows(lines)
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
