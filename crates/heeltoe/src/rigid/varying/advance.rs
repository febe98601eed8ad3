//! One step of the walk, up to the first event in it.
//!
//! An event is where a normal force, what is left of the friction cone, the slip velocity or a gap falls through zero. It
//! is seen on polynomials through the ends of the step and found, by secants, on the integrated motion itself.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::event;
use super::super::mode::{Mode, Slip, VIOLATION};
use super::super::simulate::Cause;
use super::block::Rotation;
use super::ground::Stretch;
use super::step::{middle, step, State};
use super::walk::Walk;

/// A step that is short enough for its polynomials to say that a motion ends as it begins [s].
const SHORT: f64 = 1e-7;

impl Walk<'_, '_> {
    /// Move to the next event, or by one step; returns the time that took and what ended it.
    pub(super) fn advance(&mut self, stretch: &Stretch, time: f64) -> (f64, Option<Cause>) {
        let start = self.state;
        let rate = self.rates(&start, &stretch.ground);
        let fresh = self.starting.take();
        let mut length = if self.mode == Mode::Rest {
            stretch.left
        } else {
            stretch.left.min(self.suggested)
        };
        loop {
            let (end, rate_at_end) = if self.mode == Mode::Rest {
                (start, rate)
            } else {
                let mut rates = |t: f64, y: &State| self.rates(y, &stretch.after(t));
                let taken = step(&start, &rate, length, &self.scale, &mut rates);
                if taken.error > 1.0 && length > 1e-9 {
                    length *= (0.9 * taken.error.powf(-1.0 / 8.0)).clamp(0.1, 0.9);
                    continue;
                }
                self.suggested = length * (0.9 * taken.error.max(1e-12).powf(-1.0 / 8.0)).clamp(0.2, 5.0);
                (taken.end, taken.rate)
            };
            let Some((at, why, state)) =
                self.first_event([&start, &end], [&rate, &rate_at_end], length, stretch, fresh)
            else {
                self.move_on(&start, &rate, &end, stretch, length, time);
                return (length, None);
            };
            if at.is_nan() {
                // The polynomials saw an event that the motion does not have: they are better on a shorter step.
                length *= 0.5;
                continue;
            }
            self.move_on(&start, &rate, &state, stretch, at, time);
            if why == Cause::Stop {
                self.state[3] = 0.0;
            }
            if matches!(why, Cause::Normal | Cause::Cone | Cause::Stop) || at < 1e-3 * length {
                self.suggested = self.suggested.max(length);
            }
            return (at, Some(why));
        }
    }

    /// The first event of a step with its time and state; a time that is not a number asks for a shorter step.
    fn first_event(
        &self,
        [start, end]: [&State; 2],
        [rate, rate_at_end]: [&State; 2],
        length: f64,
        stretch: &Stretch,
        fresh: Option<Vector>,
    ) -> Option<(f64, Cause, State)> {
        let mut first: Option<(f64, Cause, usize)> = None;
        let mut earlier = |t: f64, why: Cause, which: usize| {
            // Of two at once a gap goes first: what has struck is no longer what it was.
            let gap = matches!(why, Cause::Gap(_));
            if first.is_none_or(|(before, ..)| t < before || t == before && gap) {
                first = Some((t, why, which));
            }
        };
        let instant = self.turning.at(self.corner, start, &stretch.ground);
        let reactions = self.reactions(&instant);
        let watched = self.watched();
        if watched.iter().any(Option::is_some) {
            let between = if self.mode == Mode::Rest {
                *start
            } else {
                middle([start, end], [rate, rate_at_end], length)
            };
            let values = [
                self.limits_under(&reactions),
                self.limits(&between, &stretch.after(0.5 * length)),
                self.limits(end, &stretch.after(length)),
            ];
            for (which, why) in watched.into_iter().enumerate() {
                let Some(why) = why else { continue };
                let [(v0, size), (vm, _), (v1, _)] = values.map(|row| row[which]);
                let fallen = -VIOLATION * size;
                if vm < fallen && vm < v0 {
                    earlier(
                        event::linear(v0, 2.0 * (vm - v0) / length, 0.5 * length),
                        why,
                        which,
                    );
                } else if v1 < fallen && v1 < v0 {
                    let (c1, c2) = (4.0 * vm - 3.0 * v0 - v1, 2.0 * (v0 - 2.0 * vm + v1));
                    let share = if v0 <= 0.0 {
                        Some(0.0)
                    } else {
                        event::quadratic(v0, c1, c2, 1.0)
                    };
                    earlier(share.unwrap_or(1.0) * length, why, which);
                }
            }
        }
        let now = fresh.unwrap_or_else(|| instant.contact_acceleration(&reactions));
        let speeds = [start, end].map(|y| self.turning.contact_velocity(self.corner, y));
        if let Some(way) = self.mode.slip() {
            let s = way.sign();
            let (v0, v1, a0) = (s * speeds[0][SLIP], s * speeds[1][SLIP], s * now[SLIP]);
            let bend = (v1 - v0 - a0 * length) / (length * length);
            if let Some(t) = event::quadratic(v0, a0, bend, length) {
                earlier(t, Cause::Stop, SLIP);
            }
        }
        let gaps = [start, end].map(|y| self.turning.gaps(self.corner, y));
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if self.mode.contacts()[corner] {
                continue;
            }
            let (p0, p1, v0, a0) = (gaps[0][corner], gaps[1][corner], speeds[0][gap], now[gap]);
            let bend = (p1 - p0 - length * (v0 + 0.5 * length * a0)) / length.powi(3);
            if let Some(t) = event::cubic(p0, v0, 0.5 * a0, bend, length) {
                earlier(t, Cause::Gap(gap), gap);
            }
        }
        let over = std::f64::consts::FRAC_PI_2;
        if self.turning.rotation != Rotation::Small && end[2].abs() > over && first.is_none() {
            let value = |y: &State, _: f64| over - y[2].abs();
            let near = length * (over - start[2].abs()) / (end[2].abs() - start[2].abs());
            let (t, state) = self.located(start, rate, stretch, [near, length], value)?;
            return Some((t, Cause::Normal, state)).filter(|_| t.is_finite());
        }
        let (near, why, which) = first?;
        if near <= 0.0 && fresh.is_some() && length > SHORT {
            // What has just been chosen ends at once: on a shorter step one sees whether it does.
            return Some((f64::NAN, why, *start));
        }
        let found = match why {
            Cause::Normal | Cause::Cone => self.located(start, rate, stretch, [near, length], |y, t| {
                self.limits(y, &stretch.after(t))[which].0
            }),
            Cause::Stop => {
                let s = self.mode.slip().map_or(1.0, Slip::sign);
                self.located(start, rate, stretch, [near, length], |y, _| s * y[3])
            }
            Cause::Gap(gap) => self.located(start, rate, stretch, [near, length], |y, _| {
                self.turning.gaps(self.corner, y)[gap - HEEL]
            }),
        };
        Some(found.map_or((f64::NAN, why, *start), |(t, state)| (t, why, state)))
    }

    /// Root of a function on the integrated motion, near a first guess: secants, kept within the step. None where the
    /// function has none there.
    fn located(
        &self,
        start: &State,
        rate: &State,
        stretch: &Stretch,
        [guess, length]: [f64; 2],
        value: impl Fn(&State, f64) -> f64,
    ) -> Option<(f64, State)> {
        if guess <= 0.0 {
            return Some((0.0, *start));
        }
        let at = |t: f64| {
            let state = self.moved(start, rate, stretch, t);
            (value(&state, t), state)
        };
        let mut t = guess.min(length);
        let (mut v, mut state) = at(t);
        let mut before = if t < length {
            (t + 1e-3 * (length - t)).min(length)
        } else {
            0.999 * t
        };
        let mut v_before = at(before).0;
        for _ in 0..40 {
            if v == 0.0 || v == v_before {
                break;
            }
            let next = (t - v * (t - before) / (v - v_before)).clamp(0.0, length);
            (before, v_before) = (t, v);
            if (next - t).abs() <= 4.0 * f64::EPSILON * t {
                break;
            }
            t = next;
            (v, state) = at(t);
        }
        // Its slope tells a fall through zero from a value that only comes near.
        let slope = ((v - v_before) / (t - before)).abs();
        let reach = slope * 1e-9 * length;
        let settled = v == 0.0 || (v - v_before).abs() == 0.0 || v.abs() <= reach;
        // A gap that has just begun to open is zero at the start of the step, too.
        let back = t < 1e-6 * guess;
        (settled && !back && v.is_finite()).then_some((t, state))
    }
}
