//! What is kept of a stretch: the new state, the books, extremes, the moments asked for.

use super::super::block::SLIP;
use super::super::ledger::Work;
use super::super::mode::{Mode, Slip};
use super::super::result::{EventKind, Moment};
use super::super::walk::Blow;
use super::flight::Flight;
use super::walk::{Going, Here, Plane, SIDES};

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
        s.ledger.rub(ways.work(2, here.forces.rub.map(|f| -f * mass)));
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
    }

    /// Come to rest: friction takes what is left of the motion.
    pub(super) fn stand(&mut self) {
        let left = self.kinetic_energy();
        let s = &mut self.walk.summary;
        s.ledger.rub(Work {
            net: -left,
            size: left,
        });
        s.velocity[SLIP] = 0.0;
        self.crossing.velocity = 0.0;
    }

    /// Come to rest against the neighbour of this gap, across the valley.
    pub(super) fn strike(&mut self, gap: usize) -> Blow<1> {
        let which = usize::from(gap != SIDES[0].0);
        let mass = self.across.mass;
        let c = &mut self.crossing;
        let speed = c.velocity;
        let lost = 0.5 * mass * speed * speed;
        c.position = SIDES[which].1 * self.across.gap[which];
        c.range = [
            c.range[0].max(-self.across.gap[1]),
            c.range[1].min(self.across.gap[0]),
        ];
        c.velocity = 0.0;
        c.side_impulse += mass * speed.abs();
        c.side_strikes += 1;
        self.walk.summary.ledger.strike(lost);
        Blow {
            kinds: [Some(EventKind::SideStrikes)],
            impulse: [[0.0; 3]],
            energy_lost: [lost],
        }
    }

    /// Keep the block at every wanted moment before `until`; `since` is when the present step began.
    pub(super) fn record(&mut self, here: &Here, going: &Going, until: f64, since: f64) {
        while let Some(time) = self.walk.next_moment(until) {
            let t = time - since;
            let (moment, crossing) = self.moment(here, going, t.max(0.0));
            self.crossing.kept.push(crossing);
            self.walk.keep(moment);
        }
    }

    /// The block after some time of a step, and the place, velocity and friction across the valley.
    fn moment(&self, here: &Here, going: &Going, t: f64) -> (Moment, [f64; 3]) {
        let (mut moment, mut position, mut velocity) =
            (self.at_rest(), self.crossing.position, self.crossing.velocity);
        let mass = self.across.mass;
        let rub = mass * (here.forces.rub[0] + here.forces.rub[1] * t);
        let push = here.forces.push.map(|[f, j]| mass * (f + j * t));
        let (friction, across, acceleration) = match going {
            Going::Rests { .. } => {
                let across = if self.side == 0.0 { -push[1] } else { 0.0 };
                (-push[0], across, 0.0)
            }
            Going::Moves { flight, .. } => {
                let t = t.min(flight.length);
                let [u, v, _] = flight.velocities(t);
                let way = flight.ways(t).way;
                let speed = u.hypot(v);
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
