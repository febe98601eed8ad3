"""A dam as a program of OpenSeesPy: bonded modes, the state at rest, and the earthquake with its slip."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.deck import Deck
from heeltoe.views.files.programs.remarks import remarks

#: Files that are written.
FILES = ("dam.py", "ground.csv")
# Unbalanced forces as a part of the static ones; less than a tenth of it is rounding where the penalty is hard.
_TOLERANCE = 1e-6

_HEAD = '''\
Needs OpenSeesPy (pip install openseespy; Debian: libblas3). It prints the longest periods with the cracks bonded, the
reactions at rest, and the slip of each crack in the earthquake, and writes slip.csv beside itself.

Contact is a zeroLengthContact2D at each node of a crack: a penalty of --penalty times the modulus of the concrete over
the length of an element, with Coulomb's friction. That element forgets the friction of a node that has slid and sticks:
slip comes out too large, the more so the softer the penalty and the shorter the step. Vary both.
"""

import argparse
import sys
from pathlib import Path

import openseespy.opensees as ops


def positive(text):
    """Return a number above zero."""
    value = float(text)
    if not value > 0.0:
        raise argparse.ArgumentTypeError("give a number above 0")
    return value


options = argparse.ArgumentParser()
options.add_argument("--penalty", type=positive, default=200.0, help="of the contact, over that of an element")
options.add_argument("--step", type=positive, default=0.001, help="time step [s]")
options.add_argument("--end", type=positive, default=float("inf"), help="moment to stop at [s]")
options.add_argument("--static", action="store_true", help="end before the earthquake")
GAMMA, BETA = 0.6, 0.3025  # Newmark's
ITERATIONS = 30  # of Newton's method
OUTPUT = 0.01  # spacing of slip.csv [s]

'''

_PROGRAM = '''

def build(settings, bonded):
    """Build the dam at rest without loads: with its cracks bonded, or with contact in them."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    for node, (x, y) in enumerate(NODES, 1):
        if not bonded or node not in GROUND:
            ops.node(node, x, y)
    for node, masses in MASSES.items():
        ops.mass(node, *masses)
    ops.nDMaterial("ElasticIsotropic", 1, MODULUS, POISSON)
    for tag, nodes in enumerate(ELEMENTS, 1):
        ops.element("quad8n", tag, *nodes, 1.0, PLANE, 1)
    for node in HELD:
        if not bonded or node not in GROUND:
            ops.fix(node, 1, 1)
    tag = len(ELEMENTS)
    for stiffness, friction, normal, pairs in CRACKS.values():
        for upper, lower, length in pairs:
            tag += 1
            if not bonded:
                penalty = settings.penalty * stiffness * length
                ops.element("zeroLengthContact2D", tag, upper, lower, penalty, penalty, friction, "-normal", *normal)
            elif lower in GROUND:
                ops.fix(upper, 1, 1)
            else:
                ops.equalDOF(lower, upper, 1, 2)


def analysis(kind, tolerance, *integrator):
    ops.wipeAnalysis()
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("SuperLU")
    ops.test("NormUnbalance", tolerance, ITERATIONS, 0)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


def periods():
    analysis("Static", TOLERANCE, "LoadControl", 1.0)
    return [6.283185307179586 / square**0.5 for square in ops.eigen("-genBandArpack", PERIODS)]


def rest():
    """Bring the dam to rest under its static loads, and return the forces of what is below on what stands on it.

    They are those that the concrete has there, less the loads: the contact itself does not tell them once it has
    slid.
    """
    for tag, loads in enumerate(LOADS.values(), 1):
        ops.timeSeries("Constant", tag)
        ops.pattern("Plain", tag, tag)
        for node, forces in loads.items():
            ops.load(node, *forces)
    analysis("Static", TOLERANCE, "LoadControl", 1.0)
    if ops.analyze(1) != 0:
        sys.exit("no equilibrium at rest; try a softer --penalty")
    standing = {upper for _, _, _, pairs in CRACKS.values() for upper, lower, _ in pairs if lower in GROUND} or {*HELD}
    total = [0.0, 0.0]
    for tag, nodes in enumerate(ELEMENTS, 1):
        if standing.intersection(nodes):
            forces = ops.eleForce(tag)
            for place, node in enumerate(nodes):
                if node in standing:
                    total = [total[axis] + forces[2 * place + axis] for axis in (0, 1)]
    for loads in LOADS.values():
        total = [total[axis] - sum(loads[node][axis] for node in standing if node in loads) for axis in (0, 1)]
    return total


def shake():
    """Let the ground move: forces of inertia in motion relative to it."""
    ops.loadConst("-time", 0.0)
    time, *components = zip(*MOTION)
    for tag, (values, pushes) in enumerate(zip(components, PUSHES), 101):
        ops.timeSeries("Path", tag, "-time", *time, "-values", *values)
        ops.pattern("Plain", tag, tag)
        for node, forces in pushes.items():
            ops.load(node, *forces)
    # Damping by the stiffness of the concrete alone: the tangent one, as quad8n has a wrong initial one.
    ops.region(1, "-ele", *range(1, len(ELEMENTS) + 1), "-rayleigh", 0.0, DAMPING, 0.0, 0.0)
    analysis("Transient", TOLERANCE, "Newmark", GAMMA, BETA)


def slips():
    """Return how far the part above each crack is downstream along it, mean over its length [m]."""
    result = []
    for _, _, (x, y), pairs in CRACKS.values():
        moved = 0.0
        for upper, lower, length in pairs:
            over = [ops.nodeDisp(upper, axis) - ops.nodeDisp(lower, axis) for axis in (1, 2)]
            moved += length * (y * over[0] - x * over[1])
        result.append(moved / sum(length for _, _, length in pairs))
    return result


def advance(step):
    """Make a step, in halves where it does not converge."""
    if ops.analyze(1, step) == 0:
        return True
    return step > 1e-6 and advance(step / 2.0) and advance(step / 2.0)


def main():
    settings = options.parse_args()
    ops.logFile(str(Path(__file__).with_name("opensees.log")), "-noEcho")
    build(settings, bonded=True)
    print("periods [s]:", *(f"{period:.6g}" for period in periods()))
    build(settings, bonded=False)
    print("reactions at rest [N]:", *(f"{force:.9g}" for force in rest()))
    if settings.static or not MOTION:
        return
    start, rows, end = slips(), [], min(settings.end, MOTION[-1][0])
    shake()
    every = max(round(OUTPUT / settings.step), 1)
    for number in range(1, round(end / settings.step) + 1):
        if not advance(settings.step):
            sys.exit(f"no convergence at {ops.getTime():.4f} s; try another --step or a softer --penalty")
        if number % every == 0:
            rows.append((ops.getTime(), *(now - before for now, before in zip(slips(), start))))
    lines = [",".join(["time_s", *(f"slip_{name}_m" for name in CRACKS)])]
    lines += [",".join(f"{value:.9g}" for value in row) for row in rows]
    Path(__file__).with_name("slip.csv").write_text("\\n".join(lines) + "\\n")
    for place, name in enumerate(CRACKS, 1):
        print(f"slip of {name} [m]: {rows[-1][place]:.6g} at {rows[-1][0]:g} s, downstream positive")


main()
'''


def write_opensees(deck: Deck, directory: Path) -> None:
    """Write a deck as ``dam.py`` and, where there is a motion, ``ground.csv`` into an empty directory."""
    program = "".join(('"""', "\n".join(_safe(line) for line in remarks(deck)), "\n\n", _HEAD, *_data(deck), _PROGRAM))
    (directory / "dam.py").write_text(program, encoding="utf-8")
    if deck.motion is not None:
        (directory / "ground.csv").write_text(_motion(deck), encoding="utf-8")


def _safe(line: str) -> str:
    """Return a line that cannot end the text it stands in."""
    return line.replace("\\", "/").replace('"""', "'''")


def _data(deck: Deck) -> Iterator[str]:
    yield f"MODULUS, POISSON, PLANE = {deck.modulus!r}, {deck.poisson!r}, 'Plane{deck.plane.title()}'\n"
    yield f"DAMPING = {deck.stiffness_damping!r}  # over stiffness [s]: {deck.damping:g} of critical, first mode\n"
    yield f"PERIODS = {len(deck.periods)}\n"
    yield f"TOLERANCE = {_TOLERANCE * float(np.hypot(*deck.resultant)):.3g}  # of forces in Newton's method [N]\n"
    yield from _list("NODES", [f"({x!r}, {y!r})" for x, y in deck.nodes.tolist()])
    yield f"GROUND = {set((deck.ground + 1).tolist()) or 'set()'}\n"
    yield f"HELD = {(deck.held + 1).tolist()}\n"
    yield from _list("ELEMENTS", [str(tuple(nodes)) for part in deck.parts for nodes in (part.elements + 1).tolist()])
    yield from _nodal("MASSES", deck.masses, "[kg], concrete and water")
    yield "# Name: stiffness over length [Pa/m], friction, normal, and pairs of nodes with the length of each [m].\n"
    yield "CRACKS = {\n"
    for crack in deck.cracks:
        normal = tuple(float(part) for part in crack.normal)
        size = float(crack.lengths.sum()) / ((len(crack.upper) - 1) // 2)
        yield f"    {crack.name!r}: ({deck.modulus / size!r}, {float(crack.friction)!r}, {normal}, [\n"
        for upper, lower, length in zip(crack.upper, crack.lower, crack.lengths.tolist(), strict=True):
            yield f"        ({upper + 1}, {lower + 1}, {length!r}),\n"
        yield "    ]),\n"
    yield "}\nLOADS = {}\n"
    for name, load in deck.loads.items():
        yield from _nodal(f"LOADS[{name!r}]", load, "[N]")
    yield "# Forces by an acceleration of the ground of 1 m/s2 [N].\nPUSHES = [{}, {}]\n"
    yield from _nodal("PUSHES[0]", deck.along_x, "downstream")
    yield from _nodal("PUSHES[1]", deck.along_y, "upward")
    if deck.motion is None:
        yield "MOTION = []\n"
    else:
        yield 'LINES = Path(__file__).with_name("ground.csv").read_text().splitlines()[1:]\n'
        yield 'MOTION = [tuple(map(float, line.split(","))) for line in LINES]  # s, m/s2\n'


def _list(name: str, rows: list[str]) -> Iterator[str]:
    yield f"{name} = [\n"
    yield from (f"    {row},\n" for row in rows)
    yield "]\n"


def _nodal(name: str, values: Floats, meaning: str) -> Iterator[str]:
    """Yield the values of nodes that have any."""
    yield f"{name} = {{  # {meaning}\n"
    for node in np.flatnonzero(values.any(axis=1)).tolist():
        yield f"    {node + 1}: {tuple(values[node].tolist())},\n"
    yield "}\n"


def _motion(deck: Deck) -> str:
    assert deck.motion is not None
    shaking = deck.motion.shaking
    columns = [shaking.time, shaking.horizontal, *([] if shaking.up is None else [shaking.up])]
    head = "time_s,downstream_m_s2" + ("" if shaking.up is None else ",upward_m_s2")
    rows = [",".join(repr(value) for value in row) for row in np.column_stack(columns).tolist()]
    return "\n".join([head, *rows]) + "\n"
