//! One step of the walk, up to the first event in it.
//!
//! An event is where a normal force, what is left of the friction cone, the slip velocity or a gap falls through zero. It
//! is seen on polynomials through the ends of the step and found, by secants, on the integrated motion itself.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::choice::VIOLATION;
use super::super::event;
use super::super::mode::{Mode, Slip};
use super::super::walk::Cause;
use super::block::Rotation;
use super::shaking::Piece;
use super::step::{between, step, State};
use super::unfolding::Flight;
use super::walk::Varying;

/// A step that is short enough for its polynomials to say that a motion ends as it begins, and one that is not made any
/// shorter; parts of the time in which the block moves by its own size.
pub(super) const SHORT: f64 = 1e-7;
pub(super) const SHORTEST: f64 = 1e-9;

/// By how much a step may be longer, or must be shorter, than one of this error.
pub(super) fn better(error: f64) -> f64 {
    0.9 * error.powf(-1.0 / 8.0)
}

/// A step that has been tried: the state and its rate of change at both ends.
pub(super) struct Trial<'a> {
    pub start: State,
    pub end: State,
    pub rate: State,
    pub rate_at_end: State,
    pub length: f64,
    /// Of the step, in parts of what is allowed.
    pub error: f64,
    /// Whether it was integrated at all.
    pub integrated: bool,
    /// Its series, where it has one.
    pub flight: Option<&'a Flight>,
    pub piece: &'a Piece,
}

impl<'a> Trial<'a> {
    /// As it is where nothing moves.
    pub(super) fn still(start: State, rate: State, length: f64, piece: &'a Piece) -> Self {
        Trial {
            start,
            end: start,
            rate,
            rate_at_end: rate,
            length,
            error: 0.0,
            integrated: false,
            flight: None,
            piece,
        }
    }
}

/// The earliest of the events seen: when, why, and which of the limits.
#[derive(Default)]
struct Earliest(Option<(f64, Cause, usize)>);

impl Earliest {
    fn note(&mut self, t: f64, why: Cause, which: usize) {
        // Of two at once a gap goes first: what has struck is no longer what it was.
        let gap = matches!(why, Cause::Gap(_));
        if self.0.is_none_or(|(before, ..)| t < before || t == before && gap) {
            self.0 = Some((t, why, which));
        }
    }
}

/// An event on the integrated motion: when, why, the state there and the error of the step to it.
struct Found {
    at: f64,
    why: Cause,
    state: State,
    error: f64,
}

impl Found {
    fn of(why: Cause, (at, state, error): (f64, State, f64)) -> Option<Self> {
        Some(Found {
            at,
            why,
            state,
            error,
        })
    }
}

impl Varying<'_> {
    /// Move to the next event, or by one step; returns the time that took and what ended it.
    pub(super) fn advance(&mut self, piece: &Piece, time: f64) -> (f64, Option<Cause>) {
        let fresh = self.starting.take();
        if let Some(slide) = self.closed_slide(piece, fresh) {
            return self.slide_on(&slide, piece, time);
        }
        if let Some(series) = self.series(piece, fresh) {
            return self.slide_by(&series, piece, time);
        }
        if let Some(advanced) = self.advance_exactly(piece, time) {
            return advanced;
        }
        if let Some(flown) = self
            .flight(piece, fresh)
            .and_then(|flight| self.fly_on(&flight, fresh, piece, time))
        {
            return flown;
        }
        let start = self.state;
        let rate = self.rates(&start, &piece.ground);
        let length = if self.walk.mode == Mode::Rest {
            piece.left
        } else {
            piece.left.min(self.suggested)
        };
        let mut trial = Trial {
            integrated: true,
            ..Trial::still(start, rate, length, piece)
        };
        loop {
            if !self.integrate(&mut trial) {
                continue;
            }
            let Some(Found {
                at,
                why,
                state,
                error,
            }) = self.first_event(&trial, fresh)
            else {
                self.move_on(&trial, &trial.end, trial.length, time);
                return (trial.length, None);
            };
            if at.is_nan() {
                // The polynomials saw an event that the motion does not have: they are better on a shorter step.
                trial.length *= 0.5;
                continue;
            }
            let fine = error <= 1.0;
            if !fine && at < trial.length && at > SHORTEST * self.time_scale {
                // The step to the event meets what the longer one passed over between its stages.
                trial.length = at;
                continue;
            }
            self.move_on(&trial, &state, at, time);
            if why == Cause::Stop {
                self.state[3] = 0.0;
            }
            let why = if why == Cause::Turn { self.turn() } else { why };
            if matches!(why, Cause::Normal | Cause::Cone | Cause::Stop) || at < 1e-3 * trial.length {
                self.suggested = self.suggested.max(trial.length);
            }
            return (at, Some(why));
        }
    }

    /// Note how long the next step may be after one of this length and error.
    pub(super) fn suggest(&mut self, length: f64, error: f64) {
        self.suggested = length * better(error.max(1e-12)).clamp(0.2, 5.0);
    }

    /// Find the end of a step; false where it was too long, and has been made shorter.
    fn integrate(&mut self, trial: &mut Trial) -> bool {
        if self.walk.mode == Mode::Rest {
            return true;
        }
        let piece = trial.piece;
        let mut rates = |t: f64, y: &State| self.rates(y, &piece.after(t));
        let taken = step(&trial.start, &trial.rate, trial.length, &self.scale, &mut rates);
        let fine = taken.error <= 1.0;
        if !fine && trial.length > SHORTEST * self.time_scale {
            // Where numbers overflow in a step that is far too long, its error is none.
            trial.length *= if taken.error.is_finite() {
                better(taken.error).clamp(0.1, 0.9)
            } else {
                0.1
            };
            return false;
        }
        self.suggest(trial.length, taken.error);
        (trial.end, trial.rate_at_end, trial.error) = (taken.end, taken.rate, taken.error);
        true
    }

    /// The first event of a step; a time that is not a number asks for a shorter step.
    fn first_event(&self, trial: &Trial, fresh: Option<Vector>) -> Option<Found> {
        let Trial {
            start, end, length, ..
        } = trial;
        let mut first = Earliest::default();
        self.see_limits(trial, &mut first);
        let real = self.turning.contact_acceleration(self.corner, start, &trial.rate);
        self.see_contacts(trial, &fresh.unwrap_or(real), &real, &mut first);
        let over = std::f64::consts::FRAC_PI_2;
        if self.turning.rotation != Rotation::Small && end[2].abs() > over && first.0.is_none() {
            let value = |y: &State, _: f64| over - y[2].abs();
            let near = length * (over - start[2].abs()) / (end[2].abs() - start[2].abs());
            return Found::of(Cause::Normal, self.located(trial, near, value)?)
                .filter(|found| found.at.is_finite());
        }
        if first.0.is_none() && self.jams(&trial.end, &trial.piece.after(*length)) {
            // Friction jams on the way: nearer to where it begins to, the choice of the next mode says what follows.
            let long = *length > SHORTEST * self.time_scale;
            return Found::of(
                Cause::Normal,
                (if long { f64::NAN } else { *length }, trial.end, 0.0),
            );
        }
        let (near, why, which) = first.0?;
        if near <= 0.0 && fresh.is_some() && *length > SHORT * self.time_scale {
            // What has just been chosen ends at once: on a shorter step one sees whether it does.
            return Found::of(why, (f64::NAN, *start, 0.0));
        }
        let found = match why {
            Cause::Normal | Cause::Cone => {
                self.located(trial, near, |y, t| self.limits(y, &trial.piece.after(t))[which].0)
            }
            Cause::Stop => {
                let s = self.walk.mode.slip().map_or(1.0, Slip::sign);
                self.located(trial, near, |y, _| s * y[3])
            }
            Cause::Gap(gap) => {
                self.located(trial, near, |y, _| self.turning.gaps(self.corner, y)[gap - HEEL])
            }
            Cause::Turn => self.located(trial, near, |y, _| self.before_turns(y)[which]),
        };
        Found::of(why, found.unwrap_or((f64::NAN, *start, 0.0)))
    }

    /// The state at a moment of a step, as a polynomial has it.
    pub(super) fn between(&self, trial: &Trial, t: f64) -> State {
        if self.walk.mode == Mode::Rest {
            return trial.start;
        }
        let (ends, rates) = ([&trial.start, &trial.end], [&trial.rate, &trial.rate_at_end]);
        between(ends, rates, trial.length, t)
    }

    /// See which normal force or side of the friction cone falls through zero.
    fn see_limits(&self, trial: &Trial, first: &mut Earliest) {
        let watched = self.watched();
        if watched.iter().all(Option::is_none) {
            return;
        }
        let length = trial.length;
        let values = [
            (&trial.start, 0.0),
            (&self.between(trial, 0.5 * length), 0.5 * length),
            (&trial.end, length),
        ]
        .map(|(state, t)| self.limits(state, &trial.piece.after(t)));
        for (which, why) in watched.into_iter().enumerate() {
            let Some(why) = why else { continue };
            let [(v0, size), (vm, _), (v1, _)] = values.map(|row| row[which]);
            let fallen = -VIOLATION * size;
            if vm < fallen && vm < v0 {
                let t = event::linear(v0, 2.0 * (vm - v0) / length, 0.5 * length);
                first.note(t, why, which);
            } else if v1 < fallen && v1 < v0 {
                let (c1, c2) = (4.0 * vm - 3.0 * v0 - v1, 2.0 * (v0 - 2.0 * vm + v1));
                let share = if v0 <= 0.0 {
                    Some(0.0)
                } else {
                    event::quadratic(v0, c1, c2, 1.0)
                };
                first.note(share.unwrap_or(1.0) * length, why, which);
            }
        }
    }

    /// See whether the slip stops or a gap closes, with the accelerations at the start; of the `real` ones `now` leaves out
    /// what is rounding, and so does what follows: the shorter the step, the more of its end is that.
    fn see_contacts(&self, trial: &Trial, now: &Vector, real: &Vector, first: &mut Earliest) {
        let length = trial.length;
        let ends = [&trial.start, &trial.end];
        let speeds = ends.map(|y| self.turning.contact_velocity(self.corner, y));
        if let Some(way) = self.walk.mode.slip() {
            let s = way.sign();
            let (v0, v1, a0) = (s * speeds[0][SLIP], s * speeds[1][SLIP], s * now[SLIP]);
            let bend = (v1 - v0 - s * real[SLIP] * length) / (length * length);
            if let Some(t) = event::quadratic(v0, a0, bend, length) {
                first.note(t, Cause::Stop, SLIP);
            }
        }
        if self.rough.is_some() && self.walk.mode.free()[SLIP] {
            let left = ends.map(|y| self.before_turns(y));
            for (which, way) in [1.0, -1.0].into_iter().enumerate() {
                let (p0, p1) = (left[0][which], left[1][which]);
                let (v0, a0) = (way * speeds[0][SLIP], way * now[SLIP]);
                let bend = (p1 - p0 - length * (v0 + 0.5 * length * way * real[SLIP])) / length.powi(3);
                if let Some(t) = event::cubic(p0, v0, 0.5 * a0, bend, length) {
                    first.note(t, Cause::Turn, which);
                }
            }
        }
        let gaps = ends.map(|y| self.turning.gaps(self.corner, y));
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if self.walk.mode.contacts()[corner] {
                continue;
            }
            let (p0, p1, v0, a0) = (gaps[0][corner], gaps[1][corner], speeds[0][gap], now[gap]);
            let bend = (p1 - p0 - length * (v0 + 0.5 * length * real[gap])) / length.powi(3);
            if let Some(t) = event::cubic(p0, v0, 0.5 * a0, bend, length) {
                first.note(t, Cause::Gap(gap), gap);
            }
        }
    }
}
