"""What must hold for every block in every ground motion, looked for by random search."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from heeltoe.kernel.block import Limits, run_blocks
from heeltoe.kernel.shaking import Shaking
from shared.kernel_cases import GRAVITY, Floats, Run, ordinary, paradox_possible, rectangle, rows, run

EVENT_LIMIT = 20_000
VELOCITIES = ("slip_velocity", "gap_velocity_heel", "gap_velocity_toe")


@pytest.fixture(params=[250, pytest.param(10_000, marks=pytest.mark.product)])
def examples(request) -> int:
    return request.param


def for_all(examples: int, *strategies):
    """Run the function that follows on so many examples."""
    return lambda law: settings(max_examples=examples)(given(*strategies)(law))()


@dataclass(frozen=True)
class Case:
    """A block by name, a record in samples and the acceleration that starts the block."""

    block: dict[str, Any]
    time: Floats
    horizontal: Floats
    vertical: Floats | None
    limit: float

    def run(self, **options) -> Run:
        return run(
            rows(self.block), self.time, self.horizontal, self.vertical, **{"event_limit": EVENT_LIMIT} | options
        )


def limits(block: dict[str, Any]) -> tuple[float, float]:
    """Return the ground accelerations (negative, positive) at which a block at rest starts to slide or to rock.

    At rest T = -P - f(a) and the moment about a corner at x must not need a pull at the other one.
    """
    weight, push, mass = -block["static_vertical"], block["static_horizontal"], block["mass_horizontal"]
    slide = block["friction_static"] * weight
    # The force F on the block, downstream, turns it about the toe if H F > M0 + N B_t; about the heel likewise.
    toe = (block["static_moment"] + weight * block["toe_distance"]) / block["height"]
    heel = (block["static_moment"] - weight * block["heel_distance"]) / block["height"]
    return (push - min(slide, toe)) / mass, (push - max(-slide, heel)) / mass


@st.composite
def cases(draw, restitution=None, vertical=True, wild=True) -> Case:
    part = st.floats(0.0, 1.0)
    width, slender, off, load, friction, bounce, side, loose, added = draw(st.tuples(*[part] * 9))
    width = 10.0 ** (2.0 * width)
    height = width * (0.1 + slender * (1.4 if wild else 0.5))
    heel = width * (0.3 + 0.4 * off)
    mass = 2500.0 * width * height
    friction = 0.1 * 20.0**friction if wild else 0.2 + 0.5 * friction
    push = 0.9 * friction * load * mass * GRAVITY
    block = ordinary(
        mass=mass,
        added=mass * added,
        height=height,
        heel=heel,
        toe=width - heel,
        inertia=mass * (1.0 + added) * (width**2 + 4.0 * height**2) / 12.0,
        friction=friction,
        kinetic=friction * (1.0 - 0.4 * max(0.0, loose - 0.5)),
        restitution=bounce if restitution is None else restitution,
        push=push,
        moment=height * push + mass * GRAVITY * (heel - width * (0.05 + 0.9 * side)),
    )
    # Accelerations in quarters of the limit, so that exact limits, plateaus and ties are met.
    limit = min(-limits(block)[0], limits(block)[1])
    quarters = st.lists(st.integers(-16, 16), min_size=3, max_size=30)
    horizontal = 0.25 * limit * np.array(draw(quarters), dtype=float)
    step = float(np.sqrt(width / GRAVITY) * draw(st.sampled_from([0.03, 0.1, 0.3, 1.0])))
    time = step * np.arange(horizontal.size)
    if draw(st.booleans()):
        # Steps instead of a polygon: every sample but the first stands twice.
        time, horizontal = np.repeat(time, 2)[1:], np.repeat(horizontal, 2)[:-1]
    up = None
    if vertical and draw(st.booleans()):
        up = GRAVITY * draw(st.sampled_from([0.3, 1.3])) * np.resize(np.array(draw(quarters)) / 16.0, time.size)
    return Case(block, time, horizontal, up, limit)


def kinetic_energy(block: dict[str, Any], slip: Floats, heel: Floats, toe: Floats) -> Floats:
    turn = (toe - heel) / (block["heel_distance"] + block["toe_distance"])
    up, along = heel + block["heel_distance"] * turn, slip - block["height"] * turn
    return 0.5 * (block["mass_horizontal"] * along**2 + block["mass_vertical"] * up**2 + block["inertia"] * turn**2)


def test_every_run_is_sound(examples):
    @for_all(examples, cases(), st.booleans())
    def law(case, jam):
        at = np.linspace(0.0, case.time[-1], 50)
        one = case.run(at=at, jam=jam)
        s, events, histories = one.summary, one.events, one.histories
        # It ends as it should: no hang, no loop at one time, a paradox only where there can be one.
        assert one.outcome in ("ok", "event limit") or (one.outcome == "paradox" and paradox_possible(case.block))
        assert (len(one.modes) == at.size) == (one.outcome == "ok")
        for table in (s, events, histories):
            assert all(np.isfinite(column).all() for column in table.by_name().values())
        # The ledger closes and no impact creates energy.
        energy = kinetic_energy(case.block, *(getattr(histories, name) for name in VELOCITIES)).max(
            initial=s.energy_kinetic
        )
        books = s.energy_kinetic - s.energy_input + s.energy_friction + s.energy_impact
        assert abs(books) <= 1e-9 * (energy + s.energy_friction + s.energy_impact)
        before = kinetic_energy(
            case.block, *(getattr(events, f"approach_{name.removeprefix('gap_')}") for name in VELOCITIES)
        )
        assert (events.energy_lost >= -1e-11 * before).all()
        # Nothing goes into the crack plane.
        assert min(histories.gap_heel.min(initial=0.0), histories.gap_toe.min(initial=0.0)) >= 0.0
        assert min(events.gap_heel.min(initial=0.0), events.gap_toe.min(initial=0.0)) >= 0.0
        # Parts add up, extremes contain everything.
        parts = [s.slip_sliding, s.slip_slide_rocking, s.slip_drifting]
        assert sum(parts) == pytest.approx(s.slip, abs=1e-12 * (1.0 + np.abs(parts).sum()) + 1e-13 * s.events)
        assert sum(value for name, value in s.by_name().items() if name.startswith("time_")) == pytest.approx(
            s.end_time, rel=1e-11
        )
        for low, high, column in (("slip_min", "slip_max", "slip"), (None, "largest_gap_toe", "gap_toe")):
            values = np.append(getattr(histories, column), getattr(s, column))
            slack = 1e-12 * (1.0 + getattr(s, high))
            assert values.max() <= getattr(s, high) + slack
            assert low is None or values.min() >= getattr(s, low) - slack


def test_a_mirrored_run_is_the_mirror_image(examples):
    """To rounding, which grows by a factor at every impact and without bound in chaos: so with few impacts only."""

    @for_all(examples, cases(wild=False))
    def law(case):
        one = case.run()
        assume(one.summary.impacts <= 3)
        flipped = dict(case.block)
        flipped["heel_distance"], flipped["toe_distance"] = case.block["toe_distance"], case.block["heel_distance"]
        for name in ("static_horizontal", "static_moment"):
            flipped[name] = -case.block[name]
        other = Case(flipped, case.time, -case.horizontal, case.vertical, case.limit).run()
        assert other.outcome == one.outcome
        a, b = one.summary, other.summary
        scale = 1e-9 * max(a.slip_max - a.slip_min, a.largest_gap_heel, a.largest_gap_toe, 1e-6)
        pairs = [("slip", "slip"), ("slip_min", "slip_max"), ("rotation_min", "rotation_max")]
        for name, mirror in (*pairs, *[pair[::-1] for pair in pairs[1:]]):
            assert getattr(a, name) == pytest.approx(-getattr(b, mirror), abs=scale)
        assert a.largest_gap_heel == pytest.approx(b.largest_gap_toe, abs=scale)


def test_length_and_time_scale_to_the_last_bit(examples):
    """Lengths times 4, times and velocities times 2, accelerations alike; the mass times 8 matters nowhere."""

    @for_all(examples, cases())
    def law(case):
        length, time, mass = 4.0, 2.0, 8.0
        factors = dict.fromkeys(case.block, mass)
        factors |= dict.fromkeys(("height", "heel_distance", "toe_distance"), length)
        factors |= {name: mass * length for name in case.block if name.endswith("_moment")}
        factors |= dict.fromkeys(("friction_static", "friction_kinetic", "restitution"), 1.0)
        factors["inertia"] = mass * length**2
        block = {name: value * factors[name] for name, value in case.block.items()}
        a = case.run().summary
        b = Case(block, case.time * time, case.horizontal, case.vertical, case.limit).run().summary
        for name, value in a.by_name().items():
            unit = 1.0
            if name.startswith("energy_") and not name.startswith(("energy_residual", "energy_limited")):
                unit = mass * length
            elif name.startswith("time_") or name == "end_time" or "velocity" in name:
                unit = time
            elif name.startswith(("slip", "gap_", "largest_gap")) and name != "slip_stops":
                unit = length
            assert getattr(b, name) == unit * value, name


def test_ensembles_give_the_same_bits(examples):
    """For any number of threads, any order and any chunks; and the same as one run by itself, histories or none."""

    @for_all(max(examples // 20, 20), st.lists(cases(), min_size=3, max_size=40), st.randoms())
    def law(many, random):
        def ensemble(order, threads):
            arrays = [np.array([value[k] for k in order]) for value in (blocks, which)]
            ones = np.ones((len(order), 2))
            result = run_blocks(arrays[0], motions, arrays[1], ones, Limits(event_limit=EVENT_LIMIT), threads)
            return np.column_stack(list(result.values()))

        blocks, which = [rows(one.block) for one in many], np.arange(len(many))
        motions = [Shaking(one.time, one.horizontal, one.vertical) for one in many]
        order = list(which)
        single = np.array([list(one.run().summary.by_name().values()) for one in many])
        watched = np.array([list(one.run(at=[0.0, one.time[-1]]).summary.by_name().values()) for one in many])
        assert (single == watched).all()
        for threads in (1, 2, 7):
            assert (ensemble(order, threads) == single).all()
        random.shuffle(order)
        assert (ensemble(order, 2) == single[order]).all()
        half = len(order) // 2
        parts = [ensemble(order[:half], 2), ensemble(order[half:], 2)]
        assert (np.vstack(parts) == single[order]).all()


def test_the_settling_velocity_does_not_matter():
    """Residual slips with 1e-7, 1e-8 and 1e-9 agree within 0.01 mm for dams that bounce, unless they are chaotic.

    Chaotic are those that a change of the ground motion by a part in 1e9 moves as far, whatever the settling velocity.
    """
    rng = np.random.default_rng(1)
    time, chaotic, bouncing, count = 0.02 * np.arange(200), 0, 0, 300
    for _ in range(count):
        width, restitution, friction = rng.uniform(5.0, 80.0), rng.uniform(0.0, 0.95), rng.uniform(0.6, 1.2)
        tall = width * rng.uniform(1.0, 2.0)
        block = rectangle(width, tall, friction, water=0.6 * tall, uplift=0.5, restitution=restitution)
        ground = GRAVITY * rng.uniform(0.2, 0.8) * rng.uniform(-1.0, 1.0, time.size)
        runs = [run(block, time, ground, settle=settle).summary for settle in (1e-7, 1e-8, 1e-9)]
        bouncing += runs[0].impacts > 10
        if np.ptp([one.slip for one in runs]) >= 1e-5:
            near = [run(block, time, ground * (1.0 + d)).summary.slip for d in (0.0, 1e-9, -1e-9, 1e-10, -1e-10)]
            assert np.ptp(near) >= 1e-5
            chaotic += 1
    assert bouncing > 0.3 * count
    assert chaotic < 0.1 * count


@pytest.mark.parametrize("seed", range(12))
def test_an_hour_just_below_the_limit_moves_nothing(seed):
    """360 000 samples whose peaks reach 99.99 % of the limits leave every bit zero; at 100.01 % the block moves."""
    rng = np.random.default_rng(seed)
    width, load, side = rng.uniform(1.0, 80.0), rng.uniform(0.0, 0.9), rng.uniform(0.2, 0.8)
    height, friction = width * rng.uniform(0.2, 1.2), rng.uniform(0.2, 1.5)
    mass = 2500.0 * width * height
    push = load * friction * mass * GRAVITY
    moment = height * push + mass * GRAVITY * width * (0.5 - side)
    shape = {"mass": mass, "height": height, "heel": width / 2.0, "toe": width / 2.0}
    block = ordinary(**shape, friction=friction, push=push, moment=moment, restitution=0.5)
    low, high = limits(block)
    noise = rng.uniform(-1.0, 1.0, 360_001)
    noise[[1234, 350_000]] = (-1.0, 1.0)
    ground = np.where(noise < 0.0, -noise * low, noise * high)
    time = 0.01 * np.arange(noise.size)
    below = run(rows(block), time, 0.9999 * ground)
    assert below.summary.slip == below.summary.events == 0.0
    assert not any(getattr(below.summary, name) for name in ("slip_min", "slip_max", "rotation_min", "rotation_max"))
    assert below.summary.time_rest == pytest.approx(3600.0)
    above = run(rows(block), time, 1.0001 * ground).summary
    assert above.slip_max - above.slip_min > 0.0 or above.rotation_max - above.rotation_min > 0.0
