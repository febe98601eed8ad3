//! From event to event in the plane of the crack.

use super::super::block::{Affine, Block, Vector, SLIP, TOE};
use super::super::choice::{select, Moving, TIE, VIOLATION};
use super::super::event;
use super::super::exact;
use super::super::mode::Mode;
use super::super::reaction::{Felt, Reactions};
use super::super::result::{Crossing, Outcome, Run, Wear};
use super::super::shaking::{Piece, Shaking};
use super::super::varying::{self, Rotation, Surface, TurningBlock, TurningShaking};
use super::super::walk::{Carried, Cause, Exactly, Options, Walk, Wanted};
use super::aloft::{rises, Lifted};
use super::flight::Flight;
use super::rub::Rubbing;
use super::series::{self, Bounds, Forces};
use super::start::{self, REST};
use super::straight;
use crate::error::Error;
use crate::friction::Strength;

/// The gaps to the neighbours, beside those of heel and toe.
pub(super) const SIDES: [(usize, f64); 2] = [(TOE + 1, 1.0), (TOE + 2, -1.0)];
/// A normal force, or what is left of friction, that is more than this part of its size is not zero: no rounding makes
/// it so.
const CLEAR: f64 = 1e-9;

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

impl CrossShaking<'_> {
    /// A piece of the motion along the stream and upward, from sample `k` on, with that across the valley.
    pub(super) fn whole(&self, piece: &Piece<2>, k: usize) -> Piece<3> {
        let ([along, up], [along_rate, up_rate]) = (piece.ground, piece.rate);
        let cross_rate = (self.cross[k + 1] - self.cross[k]) / piece.left;
        Piece {
            ground: [along, up, self.cross[k]],
            rate: [along_rate, up_rate, cross_rate],
            left: piece.left,
        }
    }
}

/// The state of the motion across the valley and what is known of the present piece.
pub(super) struct Plane<'a> {
    pub walk: Walk<'a>,
    pub across: Across,
    pub crossing: Crossing,
    /// Motion of a block that does not move across.
    pub reactions: Reactions,
    /// Coefficients of friction of a block that rests and of one that slides.
    pub friction: [f64; 2],
    /// Mass along the stream.
    pub mass: f64,
    /// Force along the stream.
    push: Affine,
    /// The normal forces of heel and toe without an acceleration along the stream, and per unit of that.
    normal: [Affine; 2],
    pub per_acceleration: [f64; 2],
    /// Whether a neighbour holds the block, 1 to the left, -1 to the right.
    pub side: f64,
    /// Its largest speed so far.
    pub fastest: f64,
    /// How the block goes on.
    pub going: Going,
    /// The law of friction, where it goes by one; its normal force is that of the moment.
    pub rubbing: Option<Rubbing<'a>>,
    /// At each moment that is kept: path, and whether the bond is whole.
    pub kept: Vec<[f64; 2]>,
    /// Whether friction or uplift goes by a law, which is not followed off a corner.
    varies: bool,
    /// Whether it lifts all the same.
    lost: bool,
}

impl Across {
    /// Find what cannot be run.
    ///
    /// # Errors
    /// Where the samples are not as many, the mass is not positive, a gap is negative, or friction would change the
    /// normal force of a block that slides, as the water above an inclined crack does.
    pub fn check(&self, block: &Block, shaking: &CrossShaking) -> Result<(), Error> {
        if shaking.cross.len() != shaking.level.time.len() {
            return Err(Error::Motion(
                "a motion needs as many accelerations across the valley as times",
            ));
        }
        let gaps = self.gap.iter().all(|gap| *gap >= 0.0);
        if self.mass.is_nan() || self.mass <= 0.0 || !gaps {
            return Err(Error::Blocks(
                "the mass across the valley must be positive and its gaps not negative",
            ));
        }
        if block.couples() {
            return Err(Error::Blocks(
                "water on an inclined crack couples the motion along it with that across it",
            ));
        }
        Ok(())
    }

    /// Find what of a block that varies, on a ground that also turns, cannot be run beside what [`Self::check`] finds.
    ///
    /// # Errors
    /// Where rotations are not small, anchors follow the block, the crack is rough, friction goes by the normal stress or
    /// the ground turns.
    pub fn check_varying(
        (turning, surface): (&TurningBlock, Option<&Surface>),
        shaking: &TurningShaking,
    ) -> Result<(), Error> {
        let refused = [
            (
                turning.rotation != Rotation::Small,
                "a block that moves across the valley rotates by small angles",
            ),
            (
                !turning.anchors.is_empty(),
                "a block that moves across the valley has anchors of constant force alone",
            ),
            (
                surface.is_some_and(|surface| surface.asperities.is_some()),
                "asperities rise along the stream alone",
            ),
            (
                surface.is_some_and(|surface| surface.law.by_stress()),
                "friction of a block that moves across the valley does not go by the normal stress",
            ),
            (
                !shaking.is_level(),
                "a ground that shakes across the valley does not turn",
            ),
        ];
        match refused.into_iter().find(|(holds, _)| *holds) {
            Some((_, why)) => Err(Error::Blocks(why)),
            None => Ok(()),
        }
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
    walk(block, across, shaking, None, start, options, wanted)
}

/// The same for a block whose friction goes by a law, or whose uplift goes by how far the crack is open, which is not as
/// long as it slides. [`Across::check_varying`] has found nothing else that varies.
pub fn simulate_varying(
    block: &Block,
    across: &Across,
    shaking: &CrossShaking,
    varying: (&TurningBlock, Option<&Surface>),
    start: Option<[Vector; 2]>,
    options: Options,
    wanted: Wanted,
) -> Run {
    walk(block, across, shaking, Some(varying), start, options, wanted)
}

fn walk(
    block: &Block,
    across: &Across,
    shaking: &CrossShaking,
    varying: Option<(&TurningBlock, Option<&Surface>)>,
    start: Option<[Vector; 2]>,
    options: Options,
    wanted: Wanted,
) -> Run {
    let level = shaking.level;
    let surface = varying.and_then(|(_, surface)| surface);
    let been = surface.map_or(0.0, |surface| surface.worn.path);
    let still = shaking.cross.iter().all(|a| *a == 0.0) && across.start[1] == 0.0;
    let held = across.gap == [0.0; 2];
    if still || held {
        let run = match varying {
            None => exact::simulate_with_path(block, level, start, options, wanted),
            Some((turning, surface)) => {
                let level = TurningShaking::straight(level);
                varying::simulate(block, turning, surface, &level, start, options, wanted)
            }
        };
        let end = run.summary.end_time - level.time[0];
        let crossing = Crossing {
            kept: vec![[across.start[0], 0.0, 0.0]; run.moments.len()],
            time_at_side: if held { end } else { 0.0 },
            position: across.start[0],
            range: [across.start[0]; 2],
            path: run.worn.as_ref().map_or(0.0, |worn| worn.end.path) - been,
            ..Crossing::default()
        };
        return Run {
            crossing: Some(crossing),
            worn: run.worn.filter(|_| varying.is_some()),
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
        reactions: Reactions::new(block),
        friction: [block.friction_static, block.friction_kinetic],
        mass,
        push,
        normal: [heel, toe].map(|force| force.times(-1.0)),
        per_acceleration: [per_heel, per_toe],
        side: 0.0,
        fastest: 0.0,
        going: Going::rest(0.0),
        rubbing: surface.map(|surface| Rubbing {
            law: surface.law,
            worn: surface.worn,
            width: block.width,
            mass: across.mass,
            normal: [0.0; 2],
        }),
        kept: Vec::new(),
        varies: varying.is_some(),
        lost: false,
    };
    plane.walk.summary.ledger.start = plane.kinetic_energy();
    let rests = if plane.rubbing.is_some() {
        plane.rests_by_law()
    } else {
        rests(block)
    };
    if start.is_none() && !rests {
        plane.walk.summary.outcome = Outcome::Unstable;
    } else {
        plane.run(shaking);
    }
    plane.end()
}

/// The same forces without those across the valley.
fn along_alone<'a>(forces: &Forces<'a>) -> Forces<'a> {
    Forces {
        push: [forces.push[0], [0.0; 2]],
        ..*forces
    }
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

/// The next stretch: a motion on both corners, a time of rest, or a motion off one of them. It is made and used up in one place, and moves nowhere.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Copy)]
pub(super) enum Going {
    Rests { length: f64, lifts: bool },
    Moves { flight: Flight, stops: bool },
    Lifted(Lifted),
}

impl Going {
    pub(super) fn rest(length: f64) -> Self {
        Going::Rests { length, lifts: false }
    }

    pub(super) fn moves(&self) -> bool {
        matches!(self, Going::Moves { .. })
    }
}

/// The ground on a piece, from where the block is.
pub(super) struct Here<'a> {
    pub left: f64,
    /// Accelerations of the ground along, up, across, and their change per second.
    pub ground: [f64; 3],
    pub rate: [f64; 3],
    pub forces: Forces<'a>,
    /// The normal forces without an acceleration along the stream.
    pub normal: [[f64; 2]; 2],
}

impl<'a> Plane<'a> {
    fn end(mut self) -> Run {
        if self.lost {
            self.walk.summary.outcome = Outcome::LiftsAcross;
        }
        let energy = self.kinetic_energy();
        let worn = self.rubbing.map(|rubbing| Wear {
            kept: self.kept,
            end: rubbing.worn,
            error: 0.0,
            integrated: 0.0,
        });
        Run {
            crossing: Some(self.crossing),
            worn,
            ..self.walk.end(energy, Vec::new())
        }
    }

    /// Whether the static loads leave a block where it is whose friction goes by a law.
    fn rests_by_law(&self) -> bool {
        let here = self.here(&Piece::still(1.0));
        let [push, _] = here.forces.push;
        here.normal.iter().all(|normal| normal[0] >= 0.0) && push[0].abs() <= here.forces.hold[0]
    }

    /// Strength of friction under this normal force, at rest and at this speed.
    fn strength(&self, normal: f64, speed: f64) -> Strength {
        match &self.rubbing {
            None => Strength {
                coefficient: self.friction,
                ..Strength::default()
            },
            Some(rubbing) => rubbing.strength(normal, speed),
        }
    }

    pub(super) fn kinetic_energy(&self) -> f64 {
        let along = self.walk.block.kinetic_energy(&self.walk.summary.velocity);
        along + 0.5 * self.across.mass * self.crossing.velocity * self.crossing.velocity
    }

    /// From sample to sample.
    fn run(&mut self, shaking: &CrossShaking) {
        let level = shaking.level;
        let n = level.time.len();
        let mut k = 0;
        while k + 1 < n {
            if self.velocity() == [0.0; 2] && self.lying() == [true; 2] {
                k = self.rest_until(shaking, k);
                if k + 1 >= n {
                    break;
                }
            }
            let Some(piece) = level.pieces(k).next() else {
                break;
            };
            k += 1;
            if piece.left <= 0.0 {
                continue;
            }
            if self.walk.stopped() || !self.cross(&shaking.whole(&piece, k - 1), level.time[k - 1]) {
                return;
            }
        }
        self.set_time(level.time[n - 1]);
        self.walk.summary.mode = self.walk.mode;
        self.record_end(shaking);
    }

    /// While the block rests nothing moves: return the last sample before rest may end, and keep the block at the moments
    /// that are wanted until then.
    fn rest_until(&mut self, shaking: &CrossShaking, from: usize) -> usize {
        let (level, y) = (shaking.level, self.crossing.position);
        let apart = SIDES
            .iter()
            .zip(self.across.gap)
            .all(|((_, side), gap)| side * y < gap);
        let n = level.time.len();
        // Friction less the force, linear as they are, is concave in time: what holds at two samples does so between.
        let stays = (from..n).take_while(|k| apart && self.clears(level.at(*k), shaking.cross[*k]));
        let k = from + stays.count().max(1) - 1;
        if k > from {
            self.walk.mode = Mode::Rest;
            self.side = 0.0;
        }
        self.walk.summary.time_by_mode[Mode::Rest.kind()] += level.time[k] - level.time[from];
        if self.walk.observed() {
            for (piece, j) in level
                .pieces(from)
                .zip(from..k)
                .filter(|(piece, _)| piece.left > 0.0)
            {
                let here = self.here(&shaking.whole(&piece, j));
                self.record(&here, &Going::rest(piece.left), level.time[j + 1], level.time[j]);
            }
        }
        k
    }

    /// Whether a block at rest is clear of every limit under this ground.
    fn clears(&self, ground: [f64; 2], cross: f64) -> bool {
        let [heel, toe] = [0, 1].map(|i| self.normal[i].at(ground));
        let strength = self.strength(heel + toe, 0.0);
        let hold = strength.coefficient[0] * (heel + toe) + strength.constant[0];
        let (along, across) = (self.push.at(ground), self.across.mass * cross);
        let least = CLEAR * (heel + toe);
        heel > least && toe > least && along * along + across * across < (1.0 - CLEAR) * hold * hold
    }

    /// Keep the block at the moments that are left, all of them at the end.
    fn record_end(&mut self, shaking: &CrossShaking) {
        let last = shaking.level.last();
        let [along, up] = shaking.level.at(last);
        let piece = Piece {
            ground: [along, up, shaking.cross[last]],
            ..Piece::still(0.0)
        };
        let here = self.here(&piece);
        // Nothing is left of the piece: a block that moves does so with what it feels.
        let velocity = self.velocity();
        let going = if self.lying() != [true; 2] {
            let drifts = || self.lifted(Mode::Drift, &here);
            let lifted = self.lifted(self.walk.mode, &here).or_else(drifts);
            lifted.map_or(Going::rest(0.0), Going::Lifted)
        } else if velocity == [0.0; 2] {
            Going::rest(0.0)
        } else {
            let flight = Flight::moment(velocity);
            Going::Moves { flight, stops: false }
        };
        self.record(&here, &going, f64::INFINITY, self.walk.summary.end_time);
    }

    /// Velocities along and across.
    pub(super) fn velocity(&self) -> [f64; 2] {
        [self.walk.summary.velocity[SLIP], self.crossing.velocity]
    }

    pub(super) fn here(&self, piece: &Piece<3>) -> Here<'a> {
        let ([along, up, cross], [along_rate, up_rate, cross_rate]) = (piece.ground, piece.rate);
        let on = |force: &Affine| [force.at([along, up]), force.slope([along_rate, up_rate])];
        let normal = self.normal.each_ref().map(on);
        let whole = [0, 1].map(|k| normal[0][k] + normal[1][k]);
        let per = |force: [f64; 2], scale: f64| force.map(|f| f * scale);
        let mass = self.across.mass;
        let [u, v] = self.velocity();
        let strength = self.strength(whole[0], u.hypot(v));
        let [hold, rub] = [0, 1].map(|k| {
            let [value, slope] = per(whole, strength.coefficient[k] / mass);
            [value + strength.constant[k] / mass, slope]
        });
        let law = self.rubbing.map(|rubbing| Rubbing {
            normal: whole,
            ..rubbing
        });
        Here {
            left: piece.left,
            ground: piece.ground,
            rate: piece.rate,
            forces: Forces {
                mass: self.mass / mass,
                push: [per(on(&self.push), 1.0 / mass), [-cross, -cross_rate]],
                rub,
                hold,
                most: law.map_or(rub, |law| law.most()),
                law,
            },
            normal,
        }
    }

    /// How the block goes on: on both corners where both are pressed, off one of them else. None is a Painlevé paradox, or
    /// a block that lifts and whose friction or uplift goes by a law.
    pub(super) fn go(&mut self, here: &Here<'a>) -> Option<Going> {
        if self.lying() == [true; 2] {
            let going = self.choose_way(here);
            if self.presses(here, &going) {
                return Some(going);
            }
        }
        if self.varies {
            self.lost = true;
            return None;
        }
        self.side = self.held(here);
        self.lift(here).map(Going::Lifted)
    }

    /// How a block goes on that lies on both corners.
    pub(super) fn choose_way(&mut self, here: &Here<'a>) -> Going {
        self.side = self.held(here);
        let u = self.velocity();
        let straight = self.side != 0.0 || here.forces.push[1] == [0.0; 2] && u[1] == 0.0;
        match (u == [0.0; 2], straight) {
            (true, true) => self.rest_straight(here),
            (true, false) => self.rest(here),
            (false, true) => self.slide_straight(here, u[0], u[0].signum()),
            (false, false) => {
                let speed = (u[0] * u[0] + u[1] * u[1]).sqrt();
                let stops = here.forces.stops_within(speed, here.left);
                let bounds = Bounds::new(self.fastest.max(speed), self.crossing.path);
                let flight = series::go_on(&here.forces, u, here.left, stops, bounds);
                Going::Moves { flight, stops: false }
            }
        }
    }

    /// Which neighbour the block lies against and is pushed into, if any.
    pub(super) fn held(&self, here: &Here) -> f64 {
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
    pub(super) fn held_for(&self, here: &Here) -> f64 {
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
            if let Some(flight) = start::begin(&here.forces, here.left, self.fastest) {
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
                if here.forces.law.is_none() {
                    return self.slide_straight(here, 0.0, way);
                }
                let left = self.held_for(here);
                if let Some(flight) = start::begin(&along_alone(&here.forces), left, self.fastest) {
                    return Going::Moves { flight, stops: false };
                }
                continue;
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
            if value + slope * until < -VIOLATION * self.walk.block.force_scale && slope < 0.0 {
                until = event::linear(value, slope, until);
                lifts = true;
            }
        }
        Going::Rests { length: until, lifts }
    }

    /// Whether both corners are pressed as it goes on so.
    pub(super) fn presses(&self, here: &Here, going: &Going) -> bool {
        let least = TIE * self.walk.block.force_scale;
        let pairs = here.normal.into_iter().zip(self.per_acceleration);
        match going {
            Going::Rests { .. } => here
                .normal
                .into_iter()
                .all(|mut n| rises(&mut n, here.left, least)),
            Going::Moves { flight, .. } => {
                let along = flight.acceleration(0, 0.0);
                pairs.into_iter().all(|(normal, per)| {
                    normal[0] + per * along > least
                        || rises(&mut flight.pressed(normal, per).start(), here.left, least)
                })
            }
            Going::Lifted(_) => false,
        }
    }

    fn slide_straight(&self, here: &Here, u: f64, way: f64) -> Going {
        if here.forces.law.is_some() {
            let bounds = Bounds::new(self.fastest.max(u.abs()), self.crossing.path);
            let flight = series::go_on(
                &along_alone(&here.forces),
                [u, 0.0],
                self.held_for(here),
                None,
                bounds,
            );
            return Going::Moves { flight, stops: false };
        }
        let (flight, stops) = straight::go_on(&here.forces, u, way, self.held_for(here));
        Going::Moves { flight, stops }
    }

    /// Move to the next event or to the end of a stretch, and keep what there is to keep; returns the time that took, and
    /// what ended it.
    pub(super) fn go_on(&mut self, here: &Here, going: &Going, time: f64) -> (f64, Option<Cause>) {
        let (step, cause) = match going {
            Going::Rests { length, lifts: true } => (*length, Some(Cause::Normal)),
            Going::Rests { length, .. } => (*length, None),
            Going::Moves { flight, .. } => self.first_event(here, flight),
            Going::Lifted(lifted) => return self.go_on_lifted(here, lifted, time),
        };
        if self.walk.observed() {
            // The end of a step belongs to what comes after it.
            self.record(here, going, time + step, time);
        }
        self.walk.summary.time_by_mode[self.walk.mode.kind()] += step;
        self.take_side(here, step);
        let Going::Moves { flight, stops } = going else {
            return (step, cause);
        };
        self.move_on(here, flight, step);
        let stands = *stops && step >= flight.length;
        let [along, across] = self.velocity();
        let crawls = along * along + across * across < REST * REST;
        if cause.is_none() && step > 0.0 && (stands || crawls) {
            self.stand();
            return (step, Some(Cause::Stop));
        }
        (step, cause)
    }

    /// The first event on a stretch, or its end.
    fn first_event(&self, here: &Here, flight: &Flight) -> (f64, Option<Cause>) {
        let (mut step, mut cause) = (flight.length, None);
        let [along, across] = here.forces.fastest(step);
        for (normal, per) in here.normal.into_iter().zip(self.per_acceleration) {
            let [value, slope] = normal;
            let most = along * per.abs();
            if value > most && value + slope * step > most {
                continue;
            }
            let pressed = flight.pressed(normal, per);
            // Where it begins at zero it rises.
            let rises = pressed.start()[0] <= 0.0;
            let pressed = if rises { pressed.without_start() } else { pressed };
            if let Some(t) = pressed.falls(step) {
                (step, cause) = (t, Some(Cause::Normal));
            }
        }
        for ((number, side), gap) in SIDES.into_iter().zip(self.across.gap) {
            let room = (gap - side * self.crossing.position).max(0.0);
            let most = step * (self.crossing.velocity.abs() + step * across);
            if self.side != 0.0 || room > most {
                continue;
            }
            if let Some(t) = flight.reaches(1, room, side, step) {
                (step, cause) = (t, Some(Cause::Gap(number)));
            }
        }
        if let Some(rubbing) = &self.rubbing {
            let reach = rubbing.law.corner(rubbing.worn) - rubbing.worn.path;
            if let Some(t) = flight.walks(reach, step).filter(|t| *t < step) {
                (step, cause) = (t, None);
            }
        }
        (step, cause)
    }
}
