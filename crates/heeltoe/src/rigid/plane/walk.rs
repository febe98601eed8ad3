//! From event to event in the plane of the crack.

use super::super::block::{Affine, Block, Vector, HEEL, SLIP, TOE};
use super::super::choice::{select, Moving, TIE};
use super::super::event;
use super::super::exact;
use super::super::ledger::Work;
use super::super::mode::{Mode, Slip};
use super::super::reaction::{Felt, Reactions};
use super::super::result::{Crossing, Event, EventKind, Moment, Outcome, Run};
use super::super::shaking::{Piece, Shaking};
use super::super::walk::{Options, Walk, Wanted};
use super::flight::Flight;
use super::series::{self, Forces};
use super::start::{self, REST};
use super::straight;

/// Events in which time does not move, after which it never will.
const STANDING: u32 = 1000;

/// Mass and gaps of a block across the valley.
#[derive(Clone, Copy, Debug)]
pub struct Across {
    /// Mass that moves across the valley, per metre of dam: concrete alone (kg/m).
    pub mass: f64,
    /// Distance of the neighbours to the left and to the right (m); infinite where there are none.
    pub gap: [f64; 2],
    /// Place and velocity at the first sample (m, m/s), to the left.
    pub start: [f64; 2],
}

/// A ground that shakes across the valley, too.
#[derive(Clone, Copy, Debug)]
pub struct CrossShaking<'a> {
    /// Along the stream and upward.
    pub level: &'a Shaking<'a>,
    /// Acceleration to the left bank at the same moments (m/s2).
    pub cross: &'a [f64],
}

/// The state of the motion across the valley and what is known of the present piece.
struct Plane<'a> {
    walk: Walk<'a>,
    across: Across,
    crossing: Crossing,
    /// Coefficients of friction of a block that rests and of one that slides.
    friction: [f64; 2],
    /// Mass along the stream.
    mass: f64,
    /// Force along the stream.
    push: Affine,
    /// The normal forces of heel and toe without an acceleration along the stream, and per unit of that.
    normal: [Affine; 2],
    per_acceleration: [f64; 2],
    standing: u32,
    /// Whether a neighbour holds the block, 1 to the left, -1 to the right.
    side: f64,
}

impl Across {
    /// Find what cannot be run.
    ///
    /// # Errors
    /// Where the samples are not as many, the mass is not positive, a gap is negative, or friction would change the
    /// normal force of a block that slides, as the water above an inclined crack does.
    pub fn check(&self, block: &Block, shaking: &CrossShaking) -> Result<(), &'static str> {
        if shaking.cross.len() != shaking.level.time.len() {
            return Err("a motion needs as many accelerations across the valley as times");
        }
        let gaps = self.gap.iter().all(|gap| *gap >= 0.0);
        if self.mass.is_nan() || self.mass <= 0.0 || !gaps {
            return Err("the mass across the valley must be positive and its gaps not negative");
        }
        if block.couples() {
            return Err("water on an inclined crack couples the motion along it with that across it");
        }
        Ok(())
    }
}

/// Run one block on a ground that shakes along the stream, across the valley and upward; [`Across::check`] has found
/// nothing. A ground that stands still across the valley is [`exact::simulate`]'s, and so is a block that its neighbours
/// hold.
pub fn simulate(
    block: &Block,
    across: &Across,
    shaking: &CrossShaking,
    start: Option<[Vector; 2]>,
    options: Options,
    wanted: Wanted,
) -> Run {
    let level = shaking.level;
    let still = shaking.cross.iter().all(|a| *a == 0.0) && across.start == [0.0; 2];
    let held = across.gap == [0.0; 2];
    if still || held {
        let run = exact::simulate_with_path(block, level, start, options, wanted);
        let end = run.summary.end_time - level.time[0];
        let crossing = Crossing {
            kept: vec![[0.0; 3]; run.moments.len()],
            time_at_side: if held { end } else { 0.0 },
            path: run.worn.as_ref().map_or(0.0, |worn| worn.end.path),
            ..Crossing::default()
        };
        return Run {
            crossing: Some(crossing),
            worn: None,
            ..run
        };
    }
    let block = &block.under(block.inertia_force(level.peaks()));
    let [mass, per_heel, per_toe] = block.masses_of_slip();
    let [push, heel, toe] = block.generalised_force;
    let from = start.unwrap_or([[0.0; 3]; 2]);
    let mut plane = Plane {
        walk: Walk::new(block, level.time[0], from, options, wanted),
        across: *across,
        crossing: Crossing {
            position: across.start[0],
            velocity: across.start[1],
            range: [across.start[0]; 2],
            ..Crossing::default()
        },
        friction: [block.friction_static, block.friction_kinetic],
        mass,
        push,
        normal: [heel, toe].map(|force| force.times(-1.0)),
        per_acceleration: [per_heel, per_toe],
        standing: 0,
        side: 0.0,
    };
    let lies = [HEEL, TOE]
        .iter()
        .all(|i| from[0][*i] == 0.0 && from[1][*i] == 0.0);
    plane.walk.summary.ledger.start = plane.kinetic_energy();
    if start.is_none() && !rests(block) {
        plane.walk.summary.outcome = Outcome::Unstable;
    } else if lies {
        plane.run(shaking);
    } else {
        plane.walk.summary.outcome = Outcome::LiftsAcross;
    }
    plane.end()
}

/// Whether the static loads leave the block where it is.
fn rests(block: &Block) -> bool {
    let piece = Piece::still(1.0);
    let moving = Moving {
        closed: [true, true],
        velocity: 0.0,
        piece: &piece,
    };
    let reactions = Reactions::new(block);
    select(&reactions, Mode::Rest, &moving, &mut Felt::default()) == Some(Mode::Rest)
}

/// The next piece: a motion, or a time of rest. It is made and used up in one place, and moves nowhere.
#[allow(clippy::large_enum_variant)]
enum Going {
    Rests { length: f64, lifts: bool },
    Moves { flight: Flight, stops: bool },
}

/// The ground on a piece, from where the block is.
struct Here {
    left: f64,
    forces: Forces,
    /// The normal forces without an acceleration along the stream.
    normal: [[f64; 2]; 2],
}

impl Plane<'_> {
    fn end(self) -> Run {
        let energy = self.kinetic_energy();
        Run {
            crossing: Some(self.crossing),
            ..self.walk.end(energy, Vec::new())
        }
    }

    fn kinetic_energy(&self) -> f64 {
        let along = self.walk.block.kinetic_energy(&self.walk.summary.velocity);
        along + 0.5 * self.across.mass * self.crossing.velocity * self.crossing.velocity
    }

    /// From sample to sample.
    fn run(&mut self, shaking: &CrossShaking) {
        let (time, cross) = (shaking.level.time, shaking.cross);
        for (k, piece) in shaking.level.pieces(0).enumerate() {
            if piece.left <= 0.0 {
                continue;
            }
            if self.walk.stopped() {
                return;
            }
            let rate = (cross[k + 1] - cross[k]) / piece.left;
            if !self.cross(&piece, [cross[k], rate], time[k]) {
                return;
            }
        }
        let last = time.len() - 1;
        self.walk.summary.end_time = time[last];
        let ground = shaking.level.at(shaking.level.last());
        let piece = Piece {
            ground,
            ..Piece::still(0.0)
        };
        let here = self.here(&piece, [cross[shaking.level.last()], 0.0]);
        let still = Flight {
            begin: 0.0,
            length: 0.0,
            velocity: [[0.0; super::flight::TERMS]; 2],
            speed: [0.0; super::flight::TERMS],
        };
        let going = Going::Rests {
            length: 0.0,
            lifts: false,
        };
        // At the end nothing is left of the piece: a block that moves does so with what it feels.
        if self.moves() {
            let mut flight = still;
            flight.velocity[0][0] = self.walk.summary.velocity[SLIP];
            flight.velocity[1][0] = self.crossing.velocity;
            let going = Going::Moves { flight, stops: false };
            self.record(&here, &going, f64::INFINITY, time[last]);
        } else {
            self.record(&here, &going, f64::INFINITY, time[last]);
        }
    }

    /// Go from event to event to the end of a piece; false where the run cannot continue.
    fn cross(&mut self, whole: &Piece<2>, [cross, rate]: [f64; 2], time: f64) -> bool {
        let mut local = 0.0;
        loop {
            let piece = whole.rest(local);
            let here = self.here(&piece, [cross + rate * local, rate]);
            self.walk.summary.end_time = time + local;
            let was = self.walk.mode;
            let going = self.choose(&here);
            self.note(was);
            let Some(step) = self.advance(&here, &going, time + local) else {
                return false;
            };
            let moved = local + step > local;
            let ended = step < here.left;
            local += step;
            if !ended {
                return true;
            }
            self.standing = if moved { 0 } else { self.standing + 1 };
            if self.walk.summary.events >= self.walk.options.event_limit {
                self.walk.summary.outcome = Outcome::EventLimit;
            } else if self.standing > STANDING {
                self.walk.summary.outcome = Outcome::Cycling;
            }
            if self.walk.summary.outcome != Outcome::Done || self.walk.stopped() {
                self.walk.summary.end_time = time + local;
                return false;
            }
        }
    }

    fn moves(&self) -> bool {
        self.walk.summary.velocity[SLIP] != 0.0 || self.crossing.velocity != 0.0
    }

    fn here(&self, piece: &Piece<2>, cross: [f64; 2]) -> Here {
        let on = |force: &Affine| [force.at(piece.ground), force.slope(piece.rate)];
        let normal = self.normal.each_ref().map(on);
        let whole = [0, 1].map(|k| normal[0][k] + normal[1][k]);
        let per = |force: [f64; 2], scale: f64| force.map(|f| f * scale);
        let mass = self.across.mass;
        let [hold, rub] = self.friction.map(|mu| per(whole, mu / mass));
        Here {
            left: piece.left,
            forces: Forces {
                mass: self.mass / mass,
                push: [per(on(&self.push), 1.0 / mass), [-cross[0], -cross[1]]],
                rub,
                hold,
            },
            normal,
        }
    }

    /// How the block goes on.
    fn choose(&mut self, here: &Here) -> Going {
        self.side = self.held(here);
        let u = [self.walk.summary.velocity[SLIP], self.crossing.velocity];
        let straight = self.side != 0.0 || here.forces.push[1] == [0.0; 2] && u[1] == 0.0;
        let going = if u == [0.0; 2] {
            if straight {
                self.rest_straight(here)
            } else {
                self.rest(here)
            }
        } else if straight {
            self.slide_straight(here, u[0], u[0].signum())
        } else {
            let flight = series::go_on(&here.forces, u, here.left);
            Going::Moves { flight, stops: false }
        };
        self.walk.mode = match &going {
            Going::Rests { .. } => Mode::Rest,
            Going::Moves { flight, .. } if flight.velocity(0, flight.length) < 0.0 => {
                Mode::Slide(Slip::Upstream)
            }
            Going::Moves { .. } => Mode::Slide(Slip::Downstream),
        };
        self.walk.summary.mode = self.walk.mode;
        going
    }

    /// Which neighbour the block lies against and is pushed into, if any.
    fn held(&self, here: &Here) -> f64 {
        let [push, slope] = here.forces.push[1];
        let y = self.crossing.position;
        for (gap, side) in self.across.gap.into_iter().zip([1.0, -1.0]) {
            let pushes = side * push > 0.0 || push == 0.0 && side * slope >= 0.0;
            if side * y >= gap && self.crossing.velocity == 0.0 && pushes {
                return side;
            }
        }
        0.0
    }

    /// How long the neighbour goes on to hold it.
    fn held_for(&self, here: &Here) -> f64 {
        let [push, slope] = here.forces.push[1].map(|f| f * self.side);
        if self.side != 0.0 && push + slope * here.left < 0.0 {
            event::linear(push, slope, here.left)
        } else {
            here.left
        }
    }

    /// A block at rest whose friction acts in any direction.
    fn rest(&self, here: &Here) -> Going {
        let Forces { push, hold, .. } = here.forces;
        let [[fx, jx], [fy, jy]] = push;
        let [n, jn] = hold;
        let size = n * n + fx * fx + fy * fy;
        let mut spare = n * n - fx * fx - fy * fy;
        let change = 2.0 * (n * jn - fx * jx - fy * jy);
        let bend = jn * jn - jx * jx - jy * jy;
        if spare.abs() <= TIE * size {
            spare = 0.0;
        }
        let stays = spare > 0.0 || spare == 0.0 && change * here.left >= -TIE * size;
        if !stays {
            if let Some(flight) = start::begin(&here.forces, here.left) {
                return Going::Moves { flight, stops: false };
            }
        }
        let slips = event::quadratic(spare.max(0.0), change, bend, here.left).filter(|_| stays);
        self.rests_for(here, slips.unwrap_or(here.left))
    }

    /// A block at rest whose friction acts along the stream alone.
    fn rest_straight(&self, here: &Here) -> Going {
        let ([push, slope], [hold, hold_slope]) = (here.forces.push[0], here.forces.hold);
        let mut length = self.held_for(here);
        for way in [1.0, -1.0] {
            let mut spare = hold - way * push;
            let change = hold_slope - way * slope;
            if spare.abs() <= TIE * (hold + push.abs()) {
                spare = 0.0;
            }
            if spare < 0.0 || spare == 0.0 && change * here.left < -TIE * (hold + push.abs()) {
                return self.slide_straight(here, 0.0, way);
            }
            if spare + change * length < 0.0 {
                length = length.min(event::linear(spare, change, length));
            }
        }
        self.rests_for(here, length)
    }

    /// Rest so long, or until a corner is no longer pressed.
    fn rests_for(&self, here: &Here, length: f64) -> Going {
        let mut until = length;
        let mut lifts = false;
        for [value, slope] in here.normal {
            if value + slope * until < 0.0 {
                until = event::linear(value, slope, until);
                lifts = true;
            }
        }
        Going::Rests { length: until, lifts }
    }

    fn slide_straight(&self, here: &Here, u: f64, way: f64) -> Going {
        let (flight, stops) = straight::go_on(&here.forces, u, way, self.held_for(here));
        Going::Moves { flight, stops }
    }

    /// Move to the next event or to the end of the piece, and keep what there is to keep; returns the time that took,
    /// or none where a corner lifts.
    fn advance(&mut self, here: &Here, going: &Going, time: f64) -> Option<f64> {
        let mut lifted = false;
        let mut strikes = 0.0;
        let mut step = match going {
            Going::Rests { length, lifts } => {
                lifted = *lifts;
                *length
            }
            Going::Moves { flight, .. } => flight.length,
        };
        if let Going::Moves { flight, .. } = going {
            for (normal, per) in here.normal.into_iter().zip(self.per_acceleration) {
                if let Some(t) = flight.first_fall(normal, per, step) {
                    step = t;
                    lifted = true;
                }
            }
            for (gap, side) in self.across.gap.into_iter().zip([1.0, -1.0]) {
                let room = (gap - side * self.crossing.position).max(0.0);
                if self.side == 0.0 {
                    if let Some(t) = flight.reaches(1, room, side, step) {
                        step = t;
                        strikes = side;
                        lifted = false;
                    }
                }
            }
        }
        if self.walk.observed() {
            // The end of a step belongs to what comes after it.
            self.record(here, going, time + step, time);
        }
        let kind = self.walk.mode.kind();
        self.walk.summary.time_by_mode[kind] += step;
        self.take_side(here, step);
        if let Going::Moves { flight, stops } = going {
            self.move_on(here, flight, step);
            if strikes != 0.0 {
                self.strike(strikes, time + step);
            } else if *stops && step >= flight.length {
                self.walk.summary.velocity[SLIP] = 0.0;
            }
            let u = [self.walk.summary.velocity[SLIP], self.crossing.velocity];
            if u[0].hypot(u[1]) < REST && step > 0.0 {
                self.walk.summary.velocity[SLIP] = 0.0;
                self.crossing.velocity = 0.0;
            }
        }
        if lifted {
            self.walk.summary.end_time = time + step;
            self.walk.summary.outcome = Outcome::LiftsAcross;
            return None;
        }
        Some(step)
    }

    /// Impulse that the neighbour takes.
    fn take_side(&mut self, here: &Here, step: f64) {
        if self.side == 0.0 {
            return;
        }
        let [push, slope] = here.forces.push[1];
        self.crossing.time_at_side += step;
        self.crossing.side_impulse += (self.across.mass * step * (push + 0.5 * step * slope)).abs();
    }

    /// Take over the end of a step.
    fn move_on(&mut self, here: &Here, flight: &Flight, step: f64) {
        let mass = self.across.mass;
        let force = here.forces.push.map(|f| f.map(|f| f * mass));
        let rub = here.forces.rub.map(|f| -f * mass);
        let s = &mut self.walk.summary;
        for (velocity, force) in flight.velocity.iter().zip(force) {
            // Where a neighbour holds the block the force into it does no work.
            let [net, size] = flight.work(velocity, force, step);
            s.ledger.apply(Work { net, size });
        }
        let [net, size] = flight.work(&flight.speed, rub, step);
        s.ledger.rub(Work { net, size });
        self.crossing.path += flight.path(step);
        let kind = self.walk.mode.kind();
        for turn in flight.turns(0, step) {
            let at = s.position[SLIP] + flight.way(0, turn);
            s.slip_range = [s.slip_range[0].min(at), s.slip_range[1].max(at)];
        }
        let c = &mut self.crossing;
        for turn in flight.turns(1, step) {
            let at = c.position + flight.way(1, turn);
            c.range = [c.range[0].min(at), c.range[1].max(at)];
        }
        let way = flight.way(0, step);
        s.position[SLIP] += way;
        s.slip_by_mode[kind] += way;
        s.velocity[SLIP] = flight.velocity(0, step);
        c.position += flight.way(1, step);
        c.velocity = flight.velocity(1, step);
        s.slip_range = [
            s.slip_range[0].min(s.position[SLIP]),
            s.slip_range[1].max(s.position[SLIP]),
        ];
        c.range = [c.range[0].min(c.position), c.range[1].max(c.position)];
    }

    /// Come to rest against a neighbour, across the valley.
    fn strike(&mut self, side: f64, time: f64) {
        let speed = self.crossing.velocity;
        let mass = self.across.mass;
        let lost = 0.5 * mass * speed * speed;
        let gap = self.across.gap[usize::from(side < 0.0)];
        let c = &mut self.crossing;
        c.position = side * gap;
        c.range = [
            c.range[0].max(-self.across.gap[1]),
            c.range[1].min(self.across.gap[0]),
        ];
        c.velocity = 0.0;
        c.side_impulse += mass * speed.abs();
        c.side_strikes += 1;
        let s = &mut self.walk.summary;
        s.ledger.strike(lost);
        s.events += 1;
        s.end_time = time;
        let event = Event {
            energy_lost: lost,
            ..self.event(EventKind::SideStrikes, self.walk.mode)
        };
        self.walk.tell(event);
    }

    /// Tell of a start or a stop.
    fn note(&mut self, before: Mode) {
        let after = self.walk.mode;
        let kind = match (before.sticks(), after.sticks()) {
            (true, false) => EventKind::SlipStarts,
            (false, true) => EventKind::SlipStops,
            _ => return,
        };
        self.walk.summary.events += 1;
        self.walk.summary.slip_stops += u64::from(kind == EventKind::SlipStops);
        let event = self.event(kind, before);
        self.walk.tell(event);
    }

    fn event(&self, kind: EventKind, before: Mode) -> Event {
        let s = &self.walk.summary;
        Event {
            time: s.end_time,
            kind,
            before,
            after: self.walk.mode,
            position: s.position,
            velocity: s.velocity,
            approach: s.velocity,
            impulse: [0.0; 3],
            energy_lost: 0.0,
        }
    }

    /// Keep the block at every wanted moment before `until`; `since` is when the present step began.
    fn record(&mut self, here: &Here, going: &Going, until: f64, since: f64) {
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
                let u = [flight.velocity(0, t), flight.velocity(1, t)];
                let speed = u[0].hypot(u[1]);
                let [along, across] = u.map(|u| if speed > 0.0 { -rub * u / speed } else { 0.0 });
                moment.position[SLIP] += flight.way(0, t);
                moment.velocity[SLIP] = u[0];
                position += flight.way(1, t);
                velocity = u[1];
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
