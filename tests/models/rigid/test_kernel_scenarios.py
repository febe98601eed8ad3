"""Single situations of the rigid kernel with a known answer: limits met exactly, free fall, paradoxes, ends of runs."""

from __future__ import annotations

import numpy as np
import pytest

from shared.kernel_cases import GRAVITY, Run, ordinary, paradox_possible, rectangle, rows, run


def starts_of_slip(one: Run) -> int:
    return one.kinds.count("slip starts")


@pytest.mark.parametrize(("friction", "gravity"), [(0.5, 8.0), (0.3, 9.81), (0.7, 9.80665)], ids=str)
@pytest.mark.parametrize("side", [-1.0, 1.0])
class TestFrictionExactlyAtItsLimit:
    """mu g, met to the last bit where it is a machine number and within rounding where it is not."""

    def block(self, friction, gravity):
        return rectangle(2.0, 1.0, friction, gravity=gravity)

    def test_held_there_nothing_moves(self, friction, gravity, side):
        one = run(self.block(friction, gravity), [0.0, 5.0, 10.0], [side * friction * gravity] * 3)
        assert (one.outcome, one.summary.slip) == ("ok", 0.0)
        assert one.summary.events <= 2

    def test_a_ramp_that_ends_there_moves_nothing(self, friction, gravity, side):
        limit = side * friction * gravity
        one = run(self.block(friction, gravity), [0.0, 1.0, 2.0, 3.0, 4.0], [0.0, limit, limit, 0.5 * limit, limit])
        assert (one.outcome, one.summary.slip) == ("ok", 0.0)
        assert one.summary.events <= 4

    def test_a_ramp_through_it_starts_once(self, friction, gravity, side):
        limit = side * friction * gravity
        # A third of the limit per second beyond it: s'' = -limit/3 t, s = -limit t^3 / 18.
        one = run(self.block(friction, gravity), [0.0, 3.0, 5.0], [0.0, limit, 5.0 / 3.0 * limit])
        assert starts_of_slip(one) == 1
        assert one.events.time[0] == pytest.approx(3.0, abs=1e-9)
        assert one.summary.slip == pytest.approx(-limit * 8.0 / 18.0, rel=1e-9)

    def test_through_it_from_a_sample_to_a_sample_starts_once(self, friction, gravity, side):
        limit = side * friction * gravity
        ground = [0.0, limit, np.nextafter(limit, side * np.inf), limit, 2.0 * limit, limit, limit, 0.0]
        one = run(self.block(friction, gravity), np.arange(8.0), ground)
        assert one.outcome == "ok"
        assert starts_of_slip(one) == 1
        assert one.summary.events < 12

    def test_a_sliding_block_coasts_there(self, friction, gravity, side):
        start = [[0.0, 0.0, 0.0], [-side, 0.0, 0.0]]
        one = run(self.block(friction, gravity), np.linspace(0.0, 4.0, 9), [side * friction * gravity] * 9, start=start)
        assert one.summary.slip == pytest.approx(-4.0 * side, rel=1e-12)
        assert one.summary.events <= 9


def test_a_jump_past_the_limit_is_not_slept_through():
    """The limit is passed at one side of a jump only; runs without histories look at every sample of a rest too."""
    time, ground = [0.0, 1.0, 1.0, 2.0, 3.0], [0.0, 0.0, -6.0, 0.0, 0.0]
    block = rectangle(2.0, 1.0, 0.5, gravity=8.0)
    quick, watched = run(block, time, ground), run(block, time, ground, at=time)
    assert quick.summary.slip == watched.summary.slip > 0.0


def test_static_and_kinetic_friction_apart():
    """Held up to 0.8 g; once it goes 0.5 g brakes it.

    With v = (a - mu_k g) T the slip is v^2/2 (1/(a - mu_k g) + 1/(mu_k g)).
    """
    block = rectangle(2.0, 0.5, 0.8, gravity=10.0, kinetic=0.5)
    duration = 0.3
    time = [0.0, duration, duration, 3.0]
    assert run(block, time, [-7.99, -7.99, 0.0, 0.0]).summary.slip == 0.0
    speed = (8.01 - 5.0) * duration
    slip = speed**2 / 2.0 * (1.0 / (8.01 - 5.0) + 1.0 / 5.0)
    one = run(block, time, [-8.01, -8.01, 0.0, 0.0])
    assert one.summary.slip == pytest.approx(slip, rel=1e-12)
    assert one.summary.final_mode == 0.0


@pytest.mark.parametrize("push", [0.0, 0.5, 1.0])
def test_a_base_that_a_blow_has_stopped_is_held_by_static_friction(push):
    """It slides and rocks on its toe, the heel strikes and bounces, the blow stops the slip.

    Rocking on without slip needs a friction between mu_k N and mu_s N: the base stands, so it need not slip.
    """
    block = rectangle(2.0, 1.0, 0.8, gravity=10.0, kinetic=0.5, restitution=0.5)
    one = run(block, [0.0, 0.05], [push, push], start=[[0.0, 0.0, 0.0], [0.1, -1.0, 0.0]], at=[0.01])
    assert one.kinds[-1] == "heel strikes"
    assert (one.modes, one.summary.slip) == (["rock on toe"], 0.0)
    needed = np.abs(one.histories.friction_force) / one.histories.normal_force_toe
    assert 0.5 < needed < 0.8


@pytest.mark.parametrize("lift", [-0.5, 0.25, 1.0])
def test_constant_vertical_acceleration_is_changed_gravity(lift):
    rng = np.random.default_rng(7)
    time, ground = 0.05 * np.arange(60), GRAVITY * rng.uniform(-0.8, 0.8, 60)
    plain = rectangle(4.0, 1.0, 0.3, gravity=GRAVITY * (1.0 + lift))
    raised = rectangle(4.0, 1.0, 0.3)
    one, other = run(plain, time, ground), run(raised, time, ground, np.full(60, lift * GRAVITY))
    assert one.summary.events == other.summary.events > 10
    assert one.summary.slip == pytest.approx(other.summary.slip, rel=1e-10)


def test_ground_that_falls_faster_than_the_block():
    """At 2 g downwards for T the block rises over it by g T^2 in all, floats, and lands flat with g T sqrt(2)."""
    duration = 0.25
    block = rectangle(2.0, 3.0, 0.5, restitution=0.5)
    one = run(
        block,
        [0.0, duration, duration, 5.0],
        [0.0] * 4,
        [-2.0 * GRAVITY] * 2 + [0.0] * 2,
        at=[0.5 * duration, duration],
    )
    assert one.modes == ["drift", "drift"]
    assert one.histories.gap_heel == pytest.approx([GRAVITY * duration**2 / 8.0, GRAVITY * duration**2 / 2.0])
    assert one.kinds[1] == "both strike"
    assert one.summary.largest_gap_heel == pytest.approx(GRAVITY * duration**2)
    assert one.summary.largest_impact_velocity == pytest.approx(GRAVITY * duration * np.sqrt(2.0))
    # It bounces flat, ever lower, and comes to rest.
    assert one.summary.rotation_max == one.summary.rotation_min == 0.0
    assert set(one.kinds[1:]) == {"both strike"}
    assert (one.outcome, one.summary.final_mode) == ("ok", 0.0)


def test_an_endless_bounce_meets_the_event_limit():
    block = rectangle(1.0, 1.0, 0.5, restitution=1.0)
    one = run(block, [0.0, 100.0], [0.0, 0.0], start=[[0.0, 0.1, 0.1], [0.0] * 3], event_limit=50, at=np.arange(100.0))
    assert one.outcome == "event limit"
    # The first event is the start of the fall.
    assert one.summary.events == 50
    fall = np.sqrt(2.0 * 0.1 / GRAVITY)
    assert one.summary.end_time == pytest.approx(fall * (2 * 49 - 1), rel=1e-9)
    assert len(one.modes) == int(one.summary.end_time) + 1


def test_rocking_that_dies_out_ends():
    """Each impact leaves a share of the velocity: without an end of its own it would take thousands of them."""
    one = run(rectangle(1.0, 3.0, 2.0), [0.0, 20.0], [0.0, 0.0], start=[[0.0, 0.0, 0.1], [0.0] * 3])
    assert one.outcome == "ok"
    assert one.summary.final_mode == one.summary.slip_velocity == one.summary.gap_velocity_toe == 0.0
    assert 10 < one.summary.impacts < 200


@pytest.mark.parametrize(
    "fault",
    [{"push": 6000.0}, {"moment": 6000.0}, {"moment": -6000.0}, {"uplift": 9820.0}],
    ids=lambda f: next(iter(f)),
)
def test_a_block_that_cannot_stand_is_unstable(fault):
    one = run(rows(ordinary(friction=0.5, **fault)), [0.0, 1.0], [0.0, 0.0], at=[0.0, 0.5])
    assert one.outcome == "unstable"
    assert one.summary.end_time == one.summary.slip == 0.0
    assert one.modes == []


class TestPainleve:
    """A block twice as tall as wide slides downstream on its toe: from mu = 4/3 on friction can pull it in."""

    start = ([0.0, 0.1, 0.0], [1.0, 0.0, 0.0])

    def block(self, friction):
        return rectangle(1.0, 2.0, friction)

    @pytest.mark.parametrize("friction", [1.3, 1.4])
    def test_it_begins_where_theory_says(self, friction):
        assert bool(paradox_possible(ordinary(height=1.0, friction=friction))) == (friction > 4.0 / 3.0)
        one = run(self.block(friction), [0.0, 1.0], [0.0, 0.0], start=self.start)
        assert one.outcome == ("paradox" if friction > 4.0 / 3.0 else "ok")

    def test_it_is_said_with_time_and_state(self):
        one = run(self.block(1.6), [0.0, 1.0], [0.0, 0.0], start=self.start, at=[0.0, 0.5])
        assert (one.outcome, one.summary.end_time, one.modes) == ("paradox", 0.0, [])
        assert [getattr(one.summary, n) for n in ("slip", "gap_heel", "gap_toe", "slip_velocity")] == [
            0.0,
            0.1,
            0.0,
            1.0,
        ]

    def test_with_jamming_it_goes_on(self):
        one = run(self.block(1.6), [0.0, 5.0], [0.0, 0.0], start=self.start, jam=True)
        assert (one.outcome, one.kinds[0], one.summary.jams) == ("ok", "jams", 1.0)
        assert one.events.slip_velocity[0] == 0.0
        assert one.events.energy_lost[0] > 0.0

    @pytest.mark.parametrize("jam", [False, True])
    def test_it_is_met_by_ordinary_motion_too(self, jam):
        """A sliding block is pressed down, its heel unloads at a known moment, and its toe can only dig in.

        While it slides T = -mu N, and the heel carries nothing once M0 = N (mu H - B_t).
        """
        weight, height, friction = 1000.0 * GRAVITY, 0.84, 1.6
        block = ordinary(height=height, friction=friction, push=0.9 * weight, moment=0.9 * weight)
        time, ground, up = [0.0, 1.0, 1.5, 2.0, 4.0], [0.0, -1.0, -1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0]
        one = run(rows(block), time, GRAVITY * np.array(ground), GRAVITY * np.array(up), jam=jam)
        moment = 1.0 + 0.5 * (0.9 / (friction * height - 0.5) - 1.0)
        assert one.kinds[0] == "slip starts"
        if jam:
            assert (one.outcome, one.kinds[1], one.summary.jams) == ("ok", "jams", 1.0)
            assert one.events.time[1] == pytest.approx(moment, rel=1e-9)
        else:
            assert one.outcome == "paradox"
            assert one.summary.end_time == pytest.approx(moment, rel=1e-9)
            assert one.summary.slip_velocity > 0.5


def test_a_slip_let_in_by_a_hair_does_not_stop_the_moment_it_starts():
    """A block rocks on its heel, loses weight, starts to slip, and is about to lift off.

    Where the slip starts, its acceleration is rounding of the wrong sign: too small to forbid the start, it used to end
    it at once, and start and stop followed each other a thousand times at one moment ("cycling"). The rounding is large
    because friction leaves the heel 0.3 % of its resistance: the acceleration is the difference of two a thousand times
    the loads, yet whether it is zero was asked relative to the loads.
    """
    block = [
        *(22691.569939251513, 17135.81682728138, 79941.69702983655, 3.0507196715393565, 1.2778618647184414),
        *(0.968928227094203, 0.0, -168102.36307563033, 25966.237259092468, -22691.569939251513, 0.0, 0.0),
        *(0.0, -17135.81682728138, 0.0, 1.6106836488435328, 1.6106836488435328, 0.0),
        *(0.0, 0.0, 0.0, 0.0),
    ]
    ends = [0.014357142172415727, 0.028714284344831455, 0.043071426517247186]
    time = [0.0, ends[0], ends[0], ends[1], ends[1], ends[2], ends[2]]
    horizontal = [0.0, 0.0, 0.0, 0.0, 2.045976964673055, 2.045976964673055, 0.0]
    vertical = [0.0, -11.955937500000001, 0.0, 0.0, 0.0, -11.955937500000001, 0.0]
    one = run(np.array(block), time, horizontal, vertical)
    assert one.outcome == "ok"
    assert one.kinds[-2:] == ["slip starts", "heel lifts"]
    assert one.summary.slip_velocity < 0.0


@pytest.mark.parametrize("left", [1e-2, 1e-4, 1e-6, 1e-8])
@pytest.mark.parametrize("ground", [1.05, 1.2, 1.5])
@pytest.mark.parametrize("heel", [0.8, 1.0, 1.2])
def test_rounding_is_told_from_motion_however_close_the_paradox(heel, ground, left):
    """Friction leaves the heel a share `left` of its resistance to being pushed in while the base slips upstream.

    The block rocks on its heel, loses its weight, slips and lifts off, once each. With ties measured by the loads alone
    slip and stick used to take turns at one moment, or no mode was found ("paradox") where there is one.
    """
    height, mass = 3.0, 17_000.0
    inertia = mass * (2.0**2 + 4.0 * height**2) / 12.0
    friction = (1.0 - left) * (inertia / mass + heel**2) / (height * heel)
    block = ordinary(mass=mass, height=height, heel=heel, toe=2.0 - heel, inertia=inertia, friction=friction)
    horizontal = np.full(3, ground * GRAVITY * heel / height)
    vertical = [0.0, -1.2 * GRAVITY, -1.2 * GRAVITY]
    one = run(rows(block), [0.0, 0.1, 0.2], horizontal, vertical, event_limit=1000)
    assert one.outcome == "ok"
    assert one.kinds == ["toe lifts", "slip starts", "heel lifts"]
    # While it rocks (J/m + H^2 + B_h^2) theta'' = H a - B_h w with w the weight per mass; the slip starts where
    # T/m = a - H theta'' is mu N/m = mu (w + B_h theta'').
    reach = (height + friction * heel) / (inertia / mass + height**2 + heel**2)
    weight = horizontal[0] * (1.0 - reach * height) / (friction - reach * heel)
    assert one.events.time[1] == pytest.approx(0.1 * (GRAVITY - weight) / (1.2 * GRAVITY), rel=1e-9)
    assert one.events.slip_velocity[2] < 0.0
