//! The walk from event to event by integration: between two events the mode is fixed and [`super::advance`] steps the
//! motion to the next event; here the event is dealt with and the next mode is chosen.

use super::super::block::{Affine, Block, Vector, HEEL, SLIP, TOE};
use super::super::impact::{impact, jam, Impact};
use super::super::mode::{
    accelerations, corner_index, reaction_to, select, Corner, Mode, Piece, Reactions, Slip,
};
use super::super::result::{Event, EventKind, Histories, Outcome, Summary};
use super::super::simulate::{describe, Cause, Options, CRAWL};
use super::block::{Ground, Instant, Rotation, TurningBlock};
use super::ground::{Stretch, TurningGround};
use super::step::{step, State};

/// Relative error allowed in a step, of lengths of the crack's width and of velocities of sqrt(g B).
const TOLERANCE: f64 = 1e-12;
/// The choice of the next mode takes accelerations as linear in time; their rate enters through a ground that passes so
/// many seconds in one, so that it has no part in the sizes by which rounding is judged.
const UNIT: f64 = 1e-9;
/// A moving block's accelerations change with its motion, too: their rate is taken over at most so many seconds.
const AHEAD: f64 = 1e-4;

pub(super) struct Walk<'a, 'h> {
    pub(super) block: &'a Block,
    pub(super) turning: &'a TurningBlock,
    pub(super) options: Options,
    pub(super) settle: f64,
    pub(super) scale: State,
    pub(super) mode: Mode,
    pub(super) corner: Corner,
    pub(super) state: State,
    /// Length that the next step may have.
    pub(super) suggested: f64,
    /// Accelerations of the contact coordinates right after an event, freed from rounding where a motion starts.
    pub(super) starting: Option<Vector>,
    pub(super) summary: Summary,
    pub(super) peak_tension: Vec<f64>,
    pub(super) log: &'a mut Vec<Event>,
    pub(super) histories: Option<&'a mut Histories<'h>>,
    pub(super) standing: u32,
    /// Of a block at rest, see [`super::rest`]; none until it is asked for.
    pub(super) reserve: Option<[[f64; 4]; 4]>,
}

/// Run one block through one motion; the arguments are those of [`super::super::simulate::simulate`]. Returns the
/// summary and the largest tension of each anchor.
pub fn simulate<'h>(
    block: &Block,
    turning: &TurningBlock,
    motion: &TurningGround,
    start: Option<[Vector; 2]>,
    options: Options,
    log: &mut Vec<Event>,
    histories: Option<&mut Histories<'h>>,
) -> (Summary, Vec<f64>) {
    let [position, velocity] = start.unwrap_or([[0.0; 3]; 2]);
    let g = -block.generalised_force[HEEL].constant - block.generalised_force[TOE].constant;
    let speed = (g.abs() / block.mass() * block.width).sqrt();
    let allowed = |size: f64| TOLERANCE * size;
    let (length, turn) = (allowed(block.width), allowed(1.0));
    let (fast, spin) = (allowed(speed), allowed(speed / block.width));
    let corner = if position[TOE] < position[HEEL] {
        Corner::Toe
    } else {
        Corner::Heel
    };
    let mut walk = Walk {
        block,
        turning,
        options,
        settle: options.settle * speed,
        scale: [
            length,
            length,
            turn,
            fast,
            fast,
            spin,
            f64::INFINITY,
            f64::INFINITY,
        ],
        mode: Mode::Rest,
        corner,
        state: [0.0; 8],
        suggested: f64::INFINITY,
        starting: None,
        summary: Summary::at_start(block, motion.time[0], position, velocity),
        peak_tension: vec![0.0; turning.anchors.len()],
        log,
        histories,
        standing: 0,
        reserve: None,
    };
    walk.place(&position, &velocity);
    walk.strain();
    walk.run(motion, start.is_none());
    walk.see();
    let instant = walk.instant(&[0.0; 3]);
    walk.summary.kinetic_energy = turning.kinetic_energy(&instant, &walk.state);
    (walk.summary, walk.peak_tension)
}

impl Walk<'_, '_> {
    /// Take over slip, gaps and their velocities.
    fn place(&mut self, position: &Vector, velocity: &Vector) {
        let own = corner_index(self.corner);
        let ratio = self.block.rotation(position);
        let finite = self.turning.rotation == Rotation::Finite;
        let theta = if finite {
            ratio.clamp(-1.0, 1.0).asin()
        } else {
            ratio
        };
        let cosine = if finite { theta.cos() } else { 1.0 };
        let rate = self.block.rotation(velocity) / cosine;
        self.state = [
            position[SLIP],
            position[own],
            theta,
            velocity[SLIP],
            velocity[own],
            rate,
            0.0,
            0.0,
        ];
    }

    fn instant(&self, ground: &Ground) -> Instant {
        self.turning.at(self.corner, &self.state, ground)
    }

    fn run(&mut self, motion: &TurningGround, stands: bool) {
        let still = Stretch {
            ground: [0.0; 3],
            rate: [0.0; 3],
            left: 1.0,
        };
        if stands && self.pick(&still).0 != Some(Mode::Rest) {
            self.summary.outcome = Outcome::Unstable;
            return;
        }
        let mut held = false;
        for k in 0..motion.time.len() - 1 {
            let (t0, t1) = (motion.time[k], motion.time[k + 1]);
            let length = t1 - t0;
            if length <= 0.0 {
                continue;
            }
            let (a0, a1) = (motion.at(k), motion.at(k + 1));
            let whole = Stretch {
                ground: a0,
                rate: [0, 1, 2].map(|i| (a1[i] - a0[i]) / length),
                left: length,
            };
            if held && self.mode == Mode::Rest && self.rests_through(&whole, t0) {
                continue;
            }
            let mut local = 0.0;
            let mut cause = None;
            // What ends a motion is watched all the time: it goes on where the ground does.
            let mut chosen = held && self.mode != Mode::Rest && t0 > motion.time[k - 1];
            held = true;
            while local < length {
                let stretch = Stretch {
                    ground: whole.after(local),
                    left: length - local,
                    ..whole
                };
                self.summary.end_time = t0 + local;
                if (cause.is_some() || !chosen) && !self.choose(&stretch, cause) {
                    return;
                }
                chosen = true;
                let (taken, ended) = self.advance(&stretch, t0 + local);
                let moved = local + taken > local;
                local = if taken == stretch.left {
                    length
                } else {
                    local + taken
                };
                self.summary.end_time = t0 + local;
                if self.turning.rotation != Rotation::Small
                    && self.state[2].abs() >= std::f64::consts::FRAC_PI_2
                {
                    self.summary.outcome = Outcome::Overturned;
                    return;
                }
                cause = ended;
                if cause.is_none() {
                    continue;
                }
                self.standing = if moved { 0 } else { self.standing + 1 };
                self.summary.events += 1;
                if self.summary.events >= self.options.event_limit {
                    self.summary.outcome = Outcome::EventLimit;
                    return;
                }
                if self.standing > 1000 {
                    self.summary.outcome = Outcome::Cycling;
                    return;
                }
            }
            if let Some(left) = cause {
                held = false;
                // The event fell on the very end of the piece: it belongs to the next.
                let after = Stretch {
                    ground: a1,
                    rate: [0.0; 3],
                    left: 1e-9 * length,
                };
                if !self.choose(&after, Some(left)) {
                    return;
                }
            }
        }
        let end = motion.time.len() - 1;
        self.summary.end_time = motion.time[end];
        let last = Stretch {
            ground: motion.at(end),
            rate: [0.0; 3],
            left: 0.0,
        };
        let state = self.state;
        self.record(&state, &last, f64::INFINITY, self.summary.end_time);
    }

    fn closed(&self) -> [bool; 2] {
        let gaps = self.turning.gaps(self.corner, &self.state);
        let velocity = self.turning.contact_velocity(self.corner, &self.state);
        [
            gaps[0] == 0.0 && velocity[HEEL] == 0.0,
            gaps[1] == 0.0 && velocity[TOE] == 0.0,
        ]
    }

    /// The mode in which the block goes on, the accelerations with which it does, and the block as it is now.
    fn pick(&self, stretch: &Stretch) -> (Option<Mode>, Vector, Block) {
        let now = self.instant(&stretch.ground);
        let still = self.state[3..6] == [0.0; 3];
        let ahead = if still {
            stretch.left
        } else {
            stretch.left.min(AHEAD)
        };
        let mut later = self.state;
        for (value, rate) in later.iter_mut().zip(self.rates(&self.state, &stretch.ground)) {
            *value += ahead * rate;
        }
        let then = self.turning.at(self.corner, &later, &stretch.after(ahead));
        // Where modes are at a tie they share their reactions, by which the compliance changes the accelerations, too.
        let reactions = self.reactions(&now);
        let affine = [SLIP, HEEL, TOE].map(|i| {
            let stiffer: f64 = (0..3)
                .map(|k| (then.compliance[i][k] - now.compliance[i][k]) * reactions[k])
                .sum();
            Affine {
                constant: now.free_acceleration[i],
                horizontal: (then.free_acceleration[i] - now.free_acceleration[i] + stiffer) / ahead * UNIT,
                vertical: 0.0,
            }
        });
        let block = self.block.at(now.compliance, affine);
        let reactions = Reactions::new(&block);
        let piece = Piece {
            ground: [0.0; 2],
            rate: [1.0 / UNIT, 0.0],
            left: stretch.left,
        };
        let closed = self.closed();
        let velocity = self.turning.contact_velocity(self.corner, &self.state);
        let found = select(&reactions, self.mode, closed, velocity[SLIP], &piece);
        let starts = [
            if velocity[SLIP] == 0.0 {
                found.and_then(Mode::slip).map_or(0.0, Slip::sign)
            } else {
                0.0
            },
            f64::from(closed[0]),
            f64::from(closed[1]),
        ];
        let first = found.map_or([0.0; 3], |mode| {
            accelerations(reactions.of(mode), starts, &piece).map(|[value, _]| value)
        });
        (found, first, block)
    }

    /// Deal with what ended the last step and choose the mode of the next; false where the run cannot continue.
    fn choose(&mut self, stretch: &Stretch, cause: Option<Cause>) -> bool {
        let before = self.mode;
        let approach = self.turning.contact_velocity(self.corner, &self.state);
        let mut blow: Option<(EventKind, Impact)> = None;
        if let Some(Cause::Gap(gap)) = cause {
            let Some(struck) = self.strike(gap) else {
                self.summary.outcome = Outcome::Paradox;
                return false;
            };
            blow = Some(struck);
        }
        let (mut after, mut first, local) = self.pick(stretch);
        let velocity = self.turning.contact_velocity(self.corner, &self.state);
        let crawls = velocity[SLIP].abs() < CRAWL * self.settle;
        if after.is_none() && (self.options.jam || crawls) {
            if let Some(stop) = jam(&local, &velocity, self.closed()) {
                self.apply(&stop);
                self.summary.jams += u64::from(!crawls);
                blow = Some((EventKind::Jams, stop));
                (after, first, _) = self.pick(stretch);
            }
        }
        let Some(after) = after else {
            self.summary.outcome = Outcome::Paradox;
            return false;
        };
        self.mode = after;
        self.summary.mode = after;
        self.reserve = None;
        self.starting = Some(first);
        let stays = match after {
            Mode::Rock(corner) | Mode::SlideRock(corner, _) => corner,
            _ => self.corner,
        };
        if stays != self.corner {
            self.turn_to(stays);
        }
        self.see();
        if cause.is_some() || after != before || blow.is_some() {
            if cause.is_none() {
                self.summary.events += 1;
            }
            let kind = blow.map_or_else(|| describe(before, after, cause), |(kind, _)| kind);
            self.summary.slip_stops += u64::from(kind == EventKind::SlipStops);
            self.log.push(Event {
                time: self.summary.end_time,
                kind,
                before,
                after,
                position: self.summary.position,
                velocity: self.summary.velocity,
                approach,
                impulse: blow.map_or([0.0; 3], |(_, i)| i.impulse),
                energy_lost: blow.map_or(0.0, |(_, i)| i.energy_lost),
            });
        }
        true
    }

    /// Go over to the other corner, which is in contact: its gap is exactly zero.
    fn turn_to(&mut self, corner: Corner) {
        let slip = self.state[0];
        self.state = self.turning.other_corner(self.corner, &self.state);
        self.corner = corner;
        // The corners of a block that stands on neither are not at the same slip: to have turned is part of drifting.
        self.summary.slip_by_mode[Mode::Drift.kind()] += self.state[0] - slip;
        let near = 1e-13 * self.block.width;
        if self.state[1].abs() <= near {
            self.state[1] = 0.0;
        }
    }

    fn apply(&mut self, blow: &Impact) {
        // A corner that has come to lie is at exactly zero velocity only where the motion counts from it.
        let other = if self.corner == Corner::Heel {
            Corner::Toe
        } else {
            Corner::Heel
        };
        if self.state[2] == 0.0 && blow.velocity[corner_index(other)] == 0.0 {
            self.turn_to(other);
        }
        let own = corner_index(self.corner);
        let cosine = match self.turning.rotation {
            Rotation::Finite => self.state[2].cos(),
            _ => 1.0,
        };
        self.state[3] = blow.velocity[SLIP];
        self.state[4] = blow.velocity[own];
        self.state[5] = self.block.rotation(&blow.velocity) / cosine;
        self.summary.ledger.strike(blow.energy_lost);
        self.summary.energy_limited += u64::from(blow.energy_limited);
    }

    fn strike(&mut self, gap: usize) -> Option<(EventKind, Impact)> {
        let corner = if gap == HEEL { Corner::Heel } else { Corner::Toe };
        let near = 1e-13 * self.block.width;
        let touched = self.turning.gaps(self.corner, &self.state)[corner_index(self.corner) - HEEL] <= near;
        if corner != self.corner {
            self.turn_to(corner);
        }
        self.state[1] = 0.0;
        let other = self.turning.gaps(corner, &self.state)[TOE - gap];
        if other <= near || touched && self.state[2].abs() * self.block.width <= near {
            self.state[2] = 0.0;
        }
        let gaps = self.turning.gaps(corner, &self.state);
        let velocity = self.turning.contact_velocity(corner, &self.state);
        let touching = gaps.map(|open| open <= 0.0);
        let strikes = [
            touching[0] && velocity[HEEL] < 0.0,
            touching[1] && velocity[TOE] < 0.0,
        ];
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if touching[corner] {
                let s = &mut self.summary;
                s.largest_impact_velocity = s.largest_impact_velocity.max(-velocity[gap]);
            }
        }
        self.summary.impacts += 1;
        let local = self
            .block
            .at(self.instant(&[0.0; 3]).compliance, self.block.free_acceleration);
        let result = impact(&local, &velocity, touching, self.settle)?;
        self.apply(&result);
        let kind = match strikes {
            [true, true] => EventKind::BothStrike,
            [true, false] => EventKind::HeelStrikes,
            _ => EventKind::ToeStrikes,
        };
        Some((kind, result))
    }

    /// Reactions in the present mode; where friction makes them infinite, none, and the choice of the next mode says so.
    pub(super) fn reactions(&self, instant: &Instant) -> Vector {
        let friction = self.block.friction_kinetic;
        reaction_to(
            &instant.compliance,
            friction,
            self.mode,
            &instant.free_acceleration,
        )
        .unwrap_or([0.0; 3])
    }

    pub(super) fn rates(&self, state: &State, ground: &Ground) -> State {
        let instant = self.turning.at(self.corner, state, ground);
        let reactions = self.reactions(&instant);
        let mut acceleration = instant.acceleration(&reactions);
        let contacts = self.mode.contacts();
        if self.mode.sticks() {
            acceleration[0] = 0.0;
        }
        if contacts[corner_index(self.corner) - HEEL] {
            acceleration[1] = 0.0;
        }
        if contacts == [true, true] {
            acceleration[2] = 0.0;
        }
        let [a, b, c] = acceleration;
        let rubbing = reactions[SLIP] * state[3];
        [
            state[3],
            state[4],
            state[5],
            a,
            b,
            c,
            instant.power(state),
            rubbing,
        ]
    }

    /// The state after `since` from `start`, by one step.
    pub(super) fn moved(&self, start: &State, rate: &State, stretch: &Stretch, since: f64) -> State {
        if since == 0.0 || self.mode == Mode::Rest {
            return *start;
        }
        let mut rates = |t: f64, y: &State| self.rates(y, &stretch.after(t));
        step(start, rate, since, &self.scale, &mut rates).end
    }

    /// Normal forces and what is left of the friction cone, both ways, at a state; sizes to judge them by.
    pub(super) fn limits(&self, state: &State, ground: &Ground) -> [(f64, f64); 4] {
        let instant = self.turning.at(self.corner, state, ground);
        self.limits_under(&self.reactions(&instant))
    }

    pub(super) fn limits_under(&self, reactions: &Vector) -> [(f64, f64); 4] {
        let [friction, heel, toe] = *reactions;
        let scale = self.block.force_scale;
        let mu = self.block.friction_static;
        let size = |force: f64| scale.max(force.abs());
        let cone = mu * (size(heel) + size(toe)) + size(friction);
        [
            (heel, size(heel)),
            (toe, size(toe)),
            (mu * (heel + toe) - friction, cone),
            (mu * (heel + toe) + friction, cone),
        ]
    }

    /// Which of the limits of [`Self::limits`] end the present mode.
    pub(super) fn watched(&self) -> [Option<Cause>; 4] {
        let [heel, toe] = self.mode.contacts().map(|on| on.then_some(Cause::Normal));
        let cone = self.mode.sticks().then_some(Cause::Cone);
        [heel, toe, cone, cone]
    }
}
