//! What is kept of a stretch: the new state, the books, extremes, the moments asked for.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::impact::Impact;
use super::super::ledger::Work;
use super::super::mode::{Mode, Slip};
use super::super::result::Moment;
use super::aloft::{Lifted, SPEED};
use super::flight::Flight;
use super::polynomial::Polynomial;
use super::rubbing::ACROSS;
use super::walk::{Going, Here, Plane};

/// A path that comes so near to a corner of its law, in proportion, is there.
const SNAP: f64 = 1e-13;

impl Plane<'_> {
    /// Impulse that the neighbour takes.
    pub(super) fn take_side(&mut self, here: &Here, step: f64) {
        if self.side == 0.0 {
            return;
        }
        let [push, slope] = here.forces.push[1];
        self.crossing.time_at_side += step;
        self.crossing.side_impulse += (self.across.mass * step * (push + 0.5 * step * slope)).abs();
    }

    /// Take over the end of a step.
    pub(super) fn move_on(&mut self, here: &Here, flight: &Flight, step: f64) {
        let mass = self.across.mass;
        let fastest = here.forces.fastest(step);
        let ways = flight.ways(step);
        let [along, across, speed] = flight.velocities(step);
        self.fastest = self.fastest.max(speed);
        let kind = self.walk.mode.kind();
        let s = &mut self.walk.summary;
        for (i, force) in here.forces.push.into_iter().enumerate() {
            // Where a neighbour holds the block the force into it does no work.
            s.ledger.apply(ways.work(i, force.map(|f| f * mass)));
        }
        s.ledger.rub(match &flight.friction {
            None => ways.work(2, here.forces.rub.map(|f| -f * mass)),
            Some(friction) => {
                let work = mass * flight.rubbed(friction, step);
                Work {
                    net: -work,
                    size: work.abs(),
                }
            }
        });
        let c = &mut self.crossing;
        let moved = [
            (
                0,
                &mut s.position[SLIP],
                &mut s.velocity[SLIP],
                &mut s.slip_range,
                along,
            ),
            (1, &mut c.position, &mut c.velocity, &mut c.range, across),
        ];
        for (i, position, velocity, range, after) in moved {
            let before = *position;
            *position += ways.way[i];
            *range = [range[0].min(*position), range[1].max(*position)];
            let most = step * (velocity.abs() + step * fastest[i]);
            let turns = velocity.abs() <= fastest[i] * step;
            if turns && (before + most > range[1] || before - most < range[0]) {
                for turn in flight.turns(i, step) {
                    let at = before + flight.ways(turn).way[i];
                    *range = [range[0].min(at), range[1].max(at)];
                }
            }
            *velocity = after;
        }
        s.slip_by_mode[kind] += ways.way[0];
        c.path += ways.way[2];
        if let Some(rubbing) = &mut self.rubbing {
            let corner = rubbing.law.corner(rubbing.worn);
            let path = rubbing.worn.path + ways.way[2];
            // The next step begins beyond the corner, whatever the rounding.
            rubbing.worn.path = if path >= corner - SNAP * corner {
                corner
            } else {
                path
            };
        }
    }

    /// The slip stops: friction takes what is left of its motion.
    pub(super) fn stand(&mut self) {
        let before = self.kinetic_energy();
        self.walk.summary.velocity[SLIP] = 0.0;
        self.crossing.velocity = 0.0;
        let left = before - self.kinetic_energy();
        self.walk.summary.ledger.rub(Work {
            net: -left,
            size: left.abs(),
        });
    }

    /// Come to rest against the neighbour on this side, across the valley.
    pub(super) fn strike_side(&mut self, side: f64) -> Impact {
        let mass = self.across.mass;
        let c = &mut self.crossing;
        let speed = c.velocity;
        let lost = 0.5 * mass * speed * speed;
        let [left, right] = self.across.gap;
        c.position = if side > 0.0 { left } else { -right };
        c.range = [c.range[0].max(-right), c.range[1].min(left)];
        c.velocity = 0.0;
        c.side_impulse += mass * speed.abs();
        c.side_strikes += 1;
        self.walk.summary.ledger.strike(lost);
        Impact {
            velocity: self.walk.summary.velocity,
            impulse: [0.0; 3],
            across: [0.0; 2],
            energy_lost: lost,
            energy_limited: false,
        }
    }

    /// Take over the end of a step off one corner or both.
    pub(super) fn move_lifted(&mut self, here: &Here, lifted: &Lifted, step: f64) {
        let block = self.walk.block;
        let (ground, rate) = ([here.ground[0], here.ground[1]], [here.rate[0], here.rate[1]]);
        let mass = self.across.mass;
        let rates = [SLIP, HEEL, TOE, ACROSS, SPEED].map(|i| lifted.rate(i));
        let before = self.place();
        let work = |[f0, f1]: [f64; 2], rate: &Polynomial| {
            let [way, moment] = rate.integrals(step);
            Work {
                net: f0 * way + f1 * moment,
                size: (f0 * way).abs() + (f1 * moment).abs(),
            }
        };
        let s = &mut self.walk.summary;
        for i in [SLIP, HEEL, TOE] {
            let load = &block.generalised_force[i];
            s.ledger
                .apply(work([load.at(ground), load.slope(rate)], &rates[i]));
            s.position[i] += rates[i].integrals(step)[0];
            s.velocity[i] = rates[i].at(step);
        }
        for gap in [HEEL, TOE] {
            s.position[gap] = s.position[gap].max(0.0);
        }
        let push = here.forces.push[1].map(|f| f * mass);
        s.ledger.apply(work(push, &rates[ACROSS]));
        s.ledger.rub(work([1.0, 0.0], &lifted.rubs()));
        s.slip_by_mode[lifted.mode.kind()] += s.position[SLIP] - before[SLIP];
        let c = &mut self.crossing;
        c.position += rates[ACROSS].integrals(step)[0];
        c.velocity = rates[ACROSS].at(step);
        c.path += rates[SPEED].integrals(step)[0];
        self.fastest = self.fastest.max(rates[SPEED].at(step));
        let end = self.place();
        self.widen(end);
        self.turning_points(before, &rates, step);
    }

    /// Slip, gaps, and the place across.
    fn place(&self) -> [f64; 4] {
        let [slip, heel, toe] = self.walk.summary.position;
        [slip, heel, toe, self.crossing.position]
    }

    /// Take a place into the extremes.
    fn widen(&mut self, [slip, heel, toe, across]: [f64; 4]) {
        let at = [slip, heel, toe];
        let turn = self.walk.block.rotation(&at);
        self.walk.summary.widen(&at, turn);
        let range = &mut self.crossing.range;
        *range = [range[0].min(across), range[1].max(across)];
    }

    /// Extremes on a step, where a velocity changes its sign.
    fn turning_points(&mut self, before: [f64; 4], rates: &[Polynomial; 5], step: f64) {
        let places = [SLIP, HEEL, TOE, ACROSS].map(|i| Polynomial::place(before[i], &rates[i]));
        let turning = rates[TOE].less(&rates[HEEL]);
        for rate in [&rates[SLIP], &rates[HEEL], &rates[TOE], &rates[ACROSS], &turning] {
            for t in rate.turns(step) {
                self.widen(places.each_ref().map(|place| place.at(t)));
            }
        }
    }

    /// The block of a step off one corner or both after some time.
    fn moment_lifted(&self, lifted: &Lifted, t: f64) -> (Moment, [f64; 3]) {
        let t = t.min(lifted.length);
        let rates = [SLIP, HEEL, TOE, ACROSS].map(|i| lifted.rate(i));
        let at = |i: usize| Polynomial::place(self.place()[i], &rates[i]).at(t);
        let force = |i: usize| lifted.pull(i).at(t);
        let mode = match lifted.mode {
            Mode::SlideRock(corner, _) if rates[SLIP].at(t) < 0.0 => Mode::SlideRock(corner, Slip::Upstream),
            Mode::SlideRock(corner, _) => Mode::SlideRock(corner, Slip::Downstream),
            mode => mode,
        };
        let moment = Moment {
            mode,
            position: [at(SLIP), at(HEEL).max(0.0), at(TOE).max(0.0)],
            velocity: [SLIP, HEEL, TOE].map(|i| rates[i].at(t)),
            acceleration: [SLIP, HEEL, TOE].map(|i| rates[i].rate().at(t)),
            reaction: [SLIP, HEEL, TOE].map(force),
        };
        (moment, [at(ACROSS), rates[ACROSS].at(t), force(ACROSS)])
    }

    /// Keep the block at every wanted moment before `until`; `since` is when the present step began.
    pub(super) fn record(&mut self, here: &Here, going: &Going, until: f64, since: f64) {
        while let Some(time) = self.walk.next_moment(until) {
            let t = time - since;
            let (moment, crossing) = self.moment(here, going, t.max(0.0));
            if self.walk.whole() {
                self.crossing.kept.push(crossing);
            }
            if let Some(rubbing) = self.rubbing.as_ref().filter(|_| self.walk.whole()) {
                let more = match going {
                    Going::Rests { .. } | Going::Lifted(_) => 0.0,
                    Going::Moves { flight, .. } => flight.ways(t.clamp(0.0, flight.length)).way[2],
                };
                let bonded = f64::from(u8::from(rubbing.worn.bonded));
                self.kept.push([rubbing.worn.path + more, bonded]);
            }
            self.walk.keep(moment);
        }
    }

    /// The block after some time of a step, and the place, velocity and friction across the valley.
    fn moment(&self, here: &Here, going: &Going, t: f64) -> (Moment, [f64; 3]) {
        if let Going::Lifted(lifted) = going {
            return self.moment_lifted(lifted, t);
        }
        let (mut moment, mut position, mut velocity) =
            (self.at_rest(), self.crossing.position, self.crossing.velocity);
        let mass = self.across.mass;
        let rub = mass * (here.forces.rub[0] + here.forces.rub[1] * t);
        let push = here.forces.push.map(|[f, j]| mass * (f + j * t));
        let (friction, across, acceleration) = match going {
            Going::Rests { .. } | Going::Lifted(_) => {
                let across = if self.side == 0.0 { -push[1] } else { 0.0 };
                (-push[0], across, 0.0)
            }
            Going::Moves { flight, .. } => {
                let t = t.min(flight.length);
                let [u, v, _] = flight.velocities(t);
                let way = flight.ways(t).way;
                let speed = u.hypot(v);
                let rub = flight.friction(t).map_or(rub, |friction| mass * friction);
                let [along, across] = [u, v].map(|u| if speed > 0.0 { -rub * u / speed } else { 0.0 });
                moment.mode = Mode::Slide(if u < 0.0 { Slip::Upstream } else { Slip::Downstream });
                moment.position[SLIP] += way[0];
                moment.velocity[SLIP] = u;
                position += way[1];
                velocity = v;
                let acceleration = (push[0] + along) / self.mass;
                (along, across, acceleration)
            }
        };
        moment.acceleration[SLIP] = acceleration;
        let pressed = |i: usize| {
            let [value, slope] = here.normal[i];
            value + slope * t + self.per_acceleration[i] * acceleration
        };
        moment.reaction = [friction, pressed(0), pressed(1)];
        (moment, [position, velocity, across])
    }

    fn at_rest(&self) -> Moment {
        let s = &self.walk.summary;
        Moment {
            mode: self.walk.mode,
            position: s.position,
            velocity: s.velocity,
            acceleration: [0.0; 3],
            reaction: [0.0; 3],
        }
    }
}
