//! Friction of the contacts that slip, by corrections of their normal impulses and directions: see [`super`].

use super::super::super::simd::{add_times, dot, fill, inlined, largest, Group, Lanes, LANES};
use super::super::triangles::{eliminate, inverse, substitute};
use super::{length, Disc, Side, Sliding, State, Way, CLOSER};

/// Corrections at most, and what they leave to rounding and to the tableaux.
const CORRECTIONS: usize = 12;
const LEFT: f64 = 0.5;
/// How often its matrix may be renewed in one set of corrections.
const RENEWALS: u32 = 3;
/// Factors make one correction for so many unknowns; then they are turned into the inverse, with which each takes less
/// time. A step with 32 elements across, whose states change often, took 17 to 27 % less than with the inverse at once.
const UNKNOWNS: usize = 4;

impl Disc {
    /// Write how the contacts that slip answer to their friction.
    #[inline(always)]
    pub(super) fn gather(&mut self, way: &Way) {
        let (m, count) = (self.states.len(), self.slips.len());
        let [plane, across] = &self.tableaux;
        let stride = (3 * count).div_ceil(LANES);
        self.answers.clear();
        self.answers.resize((2 * count * stride).max(1), [0.0; LANES]);
        self.near.resize(stride, [0.0; LANES]);
        for (c, &to) in self.slips.iter().enumerate() {
            let column = self.answers[c * stride..][..stride].as_flattened_mut();
            for (r, &k) in self.slips.iter().enumerate() {
                column[r] = plane.answer(k, to);
                if plane.given(m + k) {
                    column[count + r] = plane.answer(m + k, to);
                }
            }
            if way.rows.side[to] == Side::None {
                let column = self.answers[(count + c) * stride..][..stride].as_flattened_mut();
                for (r, &k) in self.slips.iter().enumerate() {
                    if way.rows.side[k] == Side::None {
                        column[2 * count + r] = across.answer(k, to);
                    }
                }
            }
        }
    }

    /// Solve for friction where the contacts slip, the others as they are given; false where that does not come closer
    /// fast.
    #[inline(always)]
    pub(super) fn slide<W: Lanes>(&mut self, way: &mut Way, enough: f64) -> bool {
        if self.slips.is_empty() {
            return true;
        }
        self.look(way);
        self.move_on::<W>(way);
        let (mut before, mut renewals) = (f64::INFINITY, 0);
        self.steps.clear();
        for _ in 0..CORRECTIONS {
            let known = !self.pivots.is_empty();
            let now = if known { self.missing(way) } else { f64::INFINITY };
            if now <= LEFT * enough {
                self.pass_on(way);
                self.respond::<W>(way);
                return true;
            }
            if now.is_nan() {
                break;
            }
            if !known || now > CLOSER * before {
                self.see(way);
                if renewals == RENEWALS || !self.renew::<W>(way) {
                    break;
                }
                renewals += 1;
                before = f64::INFINITY;
                self.steps.clear();
                continue;
            }
            before = now;
            self.find::<W>();
            self.learn::<W>();
            if !self.apply::<W>(way) {
                break;
            }
        }
        self.pivots.clear();
        false
    }

    /// Take the contacts that slip as they are.
    #[inline(always)]
    pub(super) fn look(&mut self, way: &Way) {
        let m = self.states.len();
        self.sliding.clear();
        self.sliding.extend(self.slips.iter().map(|&k| Sliding {
            p: [way.p[k], way.rows.p[k]],
            u: [way.u[k], way.rows.u[k]],
            normal: way.p[m + k],
            pressed: way.p[m + k],
            per: 1.0 / way.rho(k),
        }));
    }

    /// Let friction be that of normal impulses and directions, and all answer to its change.
    #[inline(always)]
    pub(super) fn move_on<W: Lanes>(&mut self, way: &Way) {
        let count = self.slips.len();
        for (c, (sliding, &k)) in self.sliding.iter_mut().zip(&self.slips).enumerate() {
            let State::Slip([t, y], _) = self.states[k] else {
                continue;
            };
            let limit = way.limit(k, true, sliding.normal);
            let p = [
                limit * t,
                if way.rows.side[k] == Side::None {
                    limit * y
                } else {
                    sliding.p[1]
                },
            ];
            (self.x[c], self.x[count + c]) = (p[0] - sliding.p[0], p[1] - sliding.p[1]);
            sliding.p = p;
        }
        self.feel::<W>();
    }

    /// Let contacts that slip answer to a change of their friction.
    #[inline(always)]
    fn feel<W: Lanes>(&mut self) {
        let count = self.slips.len();
        self.near.fill([0.0; LANES]);
        inlined::combine::<W>(
            &self.answers,
            self.near.len(),
            &self.x[..2 * count],
            &mut self.near,
        );
        let near = self.near.as_flattened();
        for (c, sliding) in self.sliding.iter_mut().enumerate() {
            sliding.u[0] += near[c];
            sliding.pressed += near[count + c];
            sliding.u[1] += near[2 * count + c];
        }
    }

    /// Write what is missing as right-hand sides, and return the most of it, as a velocity.
    #[inline(always)]
    pub(super) fn missing(&mut self, way: &Way) -> f64 {
        let count = self.slips.len();
        for (c, (sliding, &k)) in self.sliding.iter().zip(&self.slips).enumerate() {
            let State::Slip([t, y], share) = self.states[k] else {
                continue;
            };
            self.x[c] = (sliding.pressed - sliding.normal) * sliding.per;
            self.x[count + c] = if way.rows.side[k] == Side::None {
                share * (y * sliding.u[0] - t * sliding.u[1])
            } else {
                0.0
            };
        }
        largest(&self.x[..2 * count])
    }

    /// Let the shares be those of impulses and velocities as they are.
    #[inline(always)]
    fn see(&mut self, way: &Way) {
        for (sliding, &k) in self.sliding.iter().zip(&self.slips) {
            if way.rows.side[k] == Side::None {
                if let State::Slip(to, _) = self.states[k] {
                    let (_, share) = way.slide_of(k, sliding.p, sliding.u, sliding.normal);
                    self.states[k] = State::Slip(to, share.min(1.0));
                }
            }
        }
    }

    /// Factor Newton's matrix of directions and shares as they are; false where it has no inverse.
    #[inline(always)]
    pub(super) fn renew<W: Lanes>(&mut self, way: &Way) -> bool {
        let (count, stride) = (self.slips.len(), self.near.len());
        let n = 2 * count;
        self.lu.clear();
        self.lu.resize(n * n, 0.0);
        for (c, &to) in self.slips.iter().enumerate() {
            let State::Slip([t, y], share) = self.states[to] else {
                continue;
            };
            let stopped = way.rows.side[to] != Side::None;
            let (per, mu) = (self.sliding[c].per, way.problem.mu_slip[to]);
            let along = self.answers[c * stride..][..stride].as_flattened();
            let across = self.answers[(count + c) * stride..][..stride].as_flattened();
            // To a change of the normal impulse, and of friction at right angles to its direction.
            for (column, [by_t, by_y]) in [(c, [mu * t, mu * y]), (count + c, [-y, t])] {
                let [by_t, by_y] = match (stopped, column == c) {
                    (false, _) => [by_t, by_y],
                    (true, true) => [by_t, 0.0],
                    (true, false) => [0.0; 2],
                };
                let column = &mut self.lu[column * n..][..n];
                for (r, (sliding, &k)) in self.sliding.iter().zip(&self.slips).enumerate() {
                    let State::Slip([t, y], share) = self.states[k] else {
                        continue;
                    };
                    column[r] = -by_t * along[count + r] * sliding.per;
                    if way.rows.side[k] == Side::None {
                        let u = [by_t * along[r], by_y * across[2 * count + r]];
                        column[count + r] = share * (t * u[1] - y * u[0]);
                    }
                }
            }
            self.lu[c * n + c] += per;
            let own = if stopped { 1.0 } else { 1.0 - share };
            self.lu[(count + c) * n + count + c] += own * per;
        }
        self.sum.resize(n.div_ceil(LANES), [0.0; LANES]);
        if !eliminate::<W>(&mut self.lu, n, &mut self.pivots) {
            self.pivots.clear();
            return false;
        }
        self.inverse.clear();
        self.made = 0;
        true
    }

    /// Turn the right-hand sides into the solution, by the factors or, after some corrections, by the inverse.
    #[inline(always)]
    pub(super) fn find<W: Lanes>(&mut self) {
        let n = 2 * self.slips.len();
        self.made += 1;
        if self.made <= n / UNKNOWNS {
            fill(&self.x[..n], &mut self.sum);
            substitute::<W>(&self.lu, &self.pivots, &mut self.sum.as_flattened_mut()[..n]);
            return;
        }
        if self.inverse.is_empty() {
            inverse::<W>(&self.lu, &self.pivots, n, &mut self.inverse);
        }
        self.sum.fill([0.0; LANES]);
        inlined::combine::<W>(&self.inverse, self.sum.len(), &self.x[..n], &mut self.sum);
    }

    /// Change a correction by what those before it have shown, and keep it.
    #[inline(always)]
    fn learn<W: Lanes>(&mut self) {
        let stride = self.sum.len();
        let mut steps = self.steps.chunks_exact(stride);
        if let Some(mut last) = steps.next() {
            for step in steps {
                add_times::<W>(share(last, &self.sum), step, &mut self.sum);
                last = step;
            }
            let left = 1.0 - share(last, &self.sum);
            if left > CLOSER {
                self.sum.as_flattened_mut().iter_mut().for_each(|x| *x /= left);
            }
        }
        self.steps.extend_from_slice(&self.sum);
    }

    /// Change normal impulses and directions by the solution; false where a node that slips is not pressed any more.
    #[inline(always)]
    fn apply<W: Lanes>(&mut self, way: &Way) -> bool {
        let (count, x) = (self.slips.len(), self.sum.as_flattened());
        for (c, (sliding, &k)) in self.sliding.iter_mut().zip(&self.slips).enumerate() {
            sliding.normal += x[c];
            if let (State::Slip(to, _), Side::None) = (&mut self.states[k], way.rows.side[k]) {
                let limit = way.limit(k, true, sliding.normal);
                if limit <= 0.0 {
                    return false;
                }
                let turn = x[count + c] / limit;
                let turned = [to[0] - to[1] * turn, to[1] + to[0] * turn];
                let size = length(turned[0], turned[1]);
                *to = [turned[0] / size, turned[1] / size];
            }
        }
        self.move_on::<W>(way);
        true
    }

    /// Hand the friction that has been found over as what is given.
    #[inline(always)]
    pub(super) fn pass_on(&mut self, way: &mut Way) {
        let m = self.states.len();
        self.x.fill(0.0);
        for (sliding, &k) in self.sliding.iter().zip(&self.slips) {
            self.x[k] = sliding.p[0] - way.p[k];
            way.p[k] = sliding.p[0];
            if way.rows.side[k] == Side::None {
                self.x[2 * m + k] = sliding.p[1] - way.rows.p[k];
                way.rows.p[k] = sliding.p[1];
            }
        }
    }
}

/// How much of a correction another one has.
#[inline(always)]
fn share(step: &[Group], sum: &[Group]) -> f64 {
    let (step, sum) = (step.as_flattened(), sum.as_flattened());
    dot(step, sum) / dot(step, step)
}
