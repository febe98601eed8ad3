//! A slide on both corners by any law, on one piece of the record: a power series in time.
//!
//! A block that lies on both corners has one way to go. With the friction F against the slip, the path r and the normal
//! force N,
//!
//! `r'' = a_0 + a_1 t + b F`, `N = n_0 + n_1 t + g F`, `F = mu N + c`,
//!
//! and all terms follow one after the other, with those of mu by [`crate::friction::Unfolding`]. The end of the slide is a
//! root of the series of its velocity.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::mode::Mode;
use super::super::walk::Cause;
use super::advance::Trial;
use super::line::{Bare, Flat, CLEAR};
use super::power::Power;
use super::shaking::{Ground, Piece};
use super::step::{State, SIZE};
use super::walk::Varying;
use crate::friction::{Strength, INVERSE, TERMS};

/// A series is long enough where its last two terms are no more than this part of its leading ones; where it diverges, the
/// others say nothing of its size.
const FADED: f64 = 1e-16;
const LEADING: usize = 3;
/// The normal force goes by friction, where it does, by more than this: less is rounding.
const FREE: f64 = 1e-13;
/// A series that has not come to an end is cut to this part of the length at which it would.
const SHORTER: f64 = 0.9;

/// A slide on a piece of the record; all series are in the time over its length.
pub(super) struct Series {
    way: f64,
    /// How long it holds (s).
    length: f64,
    /// Path from here on, its rate of change, and friction.
    path: Power,
    rate: Power,
    friction: Power,
    /// Normal forces at heel and toe and the load along the crack, without friction, and what friction adds.
    felt: [[f64; 2]; 3],
    per_friction: [f64; 2],
    /// Path up to the next corner of the law, from here and since the first slip.
    reach: f64,
    corner: f64,
    /// What the last terms come to: of the path (m), and of its velocity (m/s).
    error: [f64; 2],
}

impl Series {
    /// Whether both corners press all the time, whatever the rounding.
    fn presses(&self, clear: f64) -> bool {
        let (least, most) = (
            self.friction.floor(),
            self.friction.terms[0] + self.friction.swing(),
        );
        (0..2).all(|corner| {
            let [now, change] = self.felt[corner];
            let per = self.per_friction[corner];
            now + change.min(0.0) + (per * least).min(per * most) > clear
        })
    }

    /// The state after `since` from `start`, with the works of the loads and of friction.
    fn state(&self, start: &State, since: f64) -> State {
        let t = since / self.length;
        let path = self.path.at(t);
        let mut state = *start;
        state[0] += self.way * path;
        state[3] = self.way * self.rate.at(t) / self.length;
        let [load, change] = self.felt[2];
        // The integral of t dr is t r less that of r.
        state[6] += self.way * (load * path + change * (t * path - self.path.integral(t)));
        state[7] -= self.rubbed(t);
        state
    }

    /// The work of friction up to a moment.
    fn rubbed(&self, t: f64) -> f64 {
        let (f, v) = (&self.friction.terms, &self.rate.terms);
        let count = self.rate.count;
        let power = |n: usize| (0..=n).map(|k| f[k] * v[n - k]).sum::<f64>();
        t * (0..count)
            .rev()
            .fold(0.0, |sum, n| sum * t + power(n) * INVERSE[n + 1])
    }

    /// When the slide ends, as a part of its length, and whether that is at a corner of the law.
    fn end(&self) -> (f64, Option<Cause>, bool) {
        let mut stop = self.rate.first_fall();
        let mut left = Power {
            terms: self.path.terms.map(|term| -term),
            ..self.path
        };
        left.terms[0] += self.reach;
        let corner = if self.reach.is_finite() {
            left.first_fall()
        } else {
            None
        };
        let first = corner.filter(|at| stop.is_none_or(|stop| *at < stop));
        if first.is_some() {
            stop = None;
        }
        let at = first.or(stop).unwrap_or(1.0);
        (at, stop.map(|_| Cause::Stop), first.is_some())
    }
}

impl Varying<'_> {
    /// The slide by series from the present state on, where it is one whose corners press all the time; a slip that starts
    /// does so with the acceleration of `fresh`, freed from rounding.
    pub(super) fn series(&self, piece: &Piece, fresh: Option<Vector>) -> Option<Series> {
        let Mode::Slide(slip) = self.walk.mode else {
            return None;
        };
        let rubbing = &self.rubbing;
        let way = slip.sign();
        if !self.lies_plainly() || piece.left <= 0.0 {
            return None;
        }
        let flat = self.flat(way)?;
        let unit = piece.left;
        let felt = |i: usize| {
            let by = |ground: &Ground| -> f64 { (0..3).map(|k| flat.per_ground[k][i] * ground[k]).sum() };
            [flat.still[i] + by(&piece.ground), unit * by(&piece.rate)]
        };
        let [heel, toe, load, pull] = [0, 1, 2, 3].map(felt);
        let pressing = [heel[0] + toe[0], heel[1] + toe[1]];
        let mut coupling = flat.per_friction[0] + flat.per_friction[1];
        if coupling.abs() < FREE {
            coupling = 0.0;
        } else if rubbing.bends() {
            return None;
        }
        let (worn, speed) = (rubbing.worn, way * self.state[3]);
        let stress = pressing.map(|force| force / rubbing.width);
        if pressing[0].min(pressing[0] + pressing[1]) <= 0.0 {
            return None;
        }
        let mut unfolding = rubbing.law.unfold(worn.path, speed, stress, unit)?;
        let [bond, per_path] = rubbing
            .law
            .bond_over_path(worn)
            .map(|stress| stress * rubbing.width);
        let square = unit * unit * way;
        let begins = fresh.filter(|_| speed == 0.0).map(|all| square * all[SLIP]);
        let [mut path, mut rate, mut mu, mut friction] = [[0.0; TERMS]; 4];
        rate[0] = unit * speed;
        let mut size = rate[0].abs();
        let mut count = 1;
        loop {
            let n = count - 1;
            mu[n] = unfolding.term(n, &path, &rate);
            let beside = if n == 0 { bond } else { per_path * path[n] };
            let before = if n == 0 { 0.0 } else { mu[n - 1] * pressing[1] };
            friction[n] = mu[n] * pressing[0] + before + beside;
            if coupling != 0.0 {
                let left = 1.0 - mu[0] * coupling;
                if left <= 0.0 {
                    return None;
                }
                let own: f64 = (1..=n).map(|k| mu[k] * friction[n - k]).sum();
                friction[n] = (friction[n] + own * coupling) / left;
            }
            let loads = if n < 2 { pull[n] } else { 0.0 };
            let mut acceleration = square * (loads + flat.per_friction[3] * friction[n]);
            if n == 0 {
                acceleration = begins.unwrap_or(acceleration);
            }
            rate[count] = acceleration * INVERSE[count];
            path[count] = rate[n] * INVERSE[count];
            if count < LEADING {
                size += rate[count].abs();
            }
            count += 1;
            let faded = rate[count - 1].abs() + rate[count - 2].abs() <= FADED * size;
            if faded && count > LEADING || count == TERMS {
                break;
            }
        }
        if !size.is_finite() || size == 0.0 {
            return None;
        }
        let [mut path, mut rate, mut friction] = [path, rate, friction].map(|terms| Power { terms, count });
        friction.count = count - 1;
        let mut length = unit;
        let last = rate.terms[count - 1].abs() + rate.terms[count - 2].abs();
        if last > FADED * size {
            let part = SHORTER * (FADED * size / last).powf(1.0 / (count - 2) as f64);
            for power in [&mut path, &mut rate, &mut friction] {
                power.shorten(part);
            }
            // It is the path's rate of change over the length.
            rate.terms = rate.terms.map(|term| part * term);
            length *= part;
        }
        let part = length / unit;
        let tail = rate.terms[count - 1].abs() + rate.terms[count - 2].abs();
        let series = Series {
            way,
            length,
            path,
            rate,
            friction,
            felt: [heel, toe, load].map(|[now, change]| [now, part * change]),
            per_friction: [flat.per_friction[0], flat.per_friction[1]],
            reach: rubbing.corner() - worn.path,
            corner: rubbing.corner(),
            error: [tail, tail / length],
        };
        if !series.presses(CLEAR * self.walk.block.force_scale) {
            return None;
        }
        Some(series)
    }

    /// While nothing ends the slide, go through what is left of a piece, or as far as the series holds, and return how long
    /// that took. Its works stay in the state.
    pub(super) fn series_through(&mut self, piece: &Piece, time: f64) -> Option<f64> {
        let series = self.series(piece, None)?;
        let clear = series.rate.floor() > 0.5 * series.rate.terms[0];
        if !clear || series.path.at(1.0) >= (1.0 - CLEAR) * series.reach {
            return None;
        }
        let start = self.state;
        self.record(&start, piece, time + series.length, time);
        let end = series.state(&start, series.length);
        self.wear(&end);
        self.gather(series.error, series.length);
        self.state = end;
        Some(series.length)
    }

    /// Slide on to the next event, or as long as the series holds; returns the time that took and what ended it.
    pub(super) fn slide_by(&mut self, series: &Series, piece: &Piece, time: f64) -> (f64, Option<Cause>) {
        let (part, cause, turns_corner) = series.end();
        let taken = if part == 1.0 {
            series.length
        } else {
            part * series.length
        };
        let mut end = series.state(&self.state, taken);
        if cause == Some(Cause::Stop) {
            end[3] = 0.0;
        }
        let trial = Trial::still(self.state, [0.0; SIZE], series.length, piece);
        self.move_on(&trial, &end, taken, time);
        if taken > 0.0 {
            self.gather(series.error, 0.0);
            self.error.time += taken;
        }
        if turns_corner {
            self.turn_corner(series.corner);
        }
        (taken, cause)
    }

    /// The state by the series, if there is one that reaches so far.
    pub(super) fn by_series(&self, start: &State, piece: &Piece, since: f64) -> Option<State> {
        let series = self.series(piece, None)?;
        (since <= series.length).then(|| series.state(start, since))
    }

    /// Add the error of a series of this length to those before.
    fn gather(&mut self, [path, speed]: [f64; 2], length: f64) {
        let sum = &mut self.error;
        sum.slip += sum.speed * length + path;
        sum.speed += speed;
        sum.time += length;
    }

    /// What is felt as the block slides this way; none where friction makes it infinite.
    fn flat(&self, way: f64) -> Option<Flat> {
        let place = &self.flats[usize::from(way < 0.0)];
        if let Some(flat) = place.get() {
            return Some(flat);
        }
        let felt = |ground: &Ground, friction: f64| -> Option<Bare> {
            let instant = self.turning.at(self.corner, &self.state, ground);
            let strength = Strength {
                constant: [friction; 2],
                ..Strength::default()
            };
            let reactions = super::friction::under(&strength, self.walk.mode, &instant)?;
            let [acceleration, ..] = instant.acceleration(&reactions);
            Some([reactions[HEEL], reactions[TOE], instant.pushed(), acceleration])
        };
        let still = felt(&[0.0; 3], 0.0)?;
        let change = |felt: Bare| -> Bare { std::array::from_fn(|i| felt[i] - still[i]) };
        // A force of the size of those at hand, so that rounding is small beside it.
        let force = self.walk.block.force_scale;
        let flat = Flat {
            still,
            per_ground: [
                change(felt(&[1.0, 0.0, 0.0], 0.0)?),
                change(felt(&[0.0, 1.0, 0.0], 0.0)?),
                change(felt(&[0.0, 0.0, 1.0], 0.0)?),
            ],
            per_friction: change(felt(&[0.0; 3], force)?).map(|change| change / force),
        };
        place.set(Some(flat));
        Some(flat)
    }
}
