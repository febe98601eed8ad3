//! The power series of a block that slides on one corner: which way friction acts says how hard the corner is pushed.
//!
//! With e = u / |u|, i the corner that lies, j the other one, A and b of [`super::super::block`],
//!
//! `N = -b_i / (A_ii - mu_k e_x A_ix)`, `T = -mu_k N e`,
//! `x'' = b_x + A_xx T_x + A_xi N`, `y'' = b_y + T_y / m`, `g_j'' = b_j + A_jx T_x + A_ji N`,
//!
//! b linear in time. [`go_on`] has the series of a motion on its way, order by order as [`super::series`]. From rest the
//! velocity is `u = t^p alpha (e_0 + rho n_0)`, as in [`super::start`]: e depends on rho alone, and each order has two linear
//! equations for alpha and rho.

use super::super::block::{Vector, SLIP};
use super::flight::INVERSE;
use super::polynomial::TERMS;
use super::series::{Bounds, KEPT, ORDER, SHORTER};
use super::start::{ONSET, REST};

/// Part of the resistance of a corner to being pushed in that friction must leave (Painlevé).
const SINGULAR: f64 = 1e-9;
/// Halvings of the part of friction that has the direction of a start.
const HALVINGS: u32 = 200;

/// One corner that lies, and slides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    pub compliance: [Vector; 3],
    /// Gap of the corner that lies, and of the other one.
    pub gaps: [usize; 2],
    /// One over the mass across the valley.
    pub per_mass: f64,
    /// Coefficient of friction as it slides.
    pub friction: f64,
    /// Acceleration without reactions of slip, gaps, across: now, and its change per second.
    pub free: [[f64; 2]; 4],
}

/// Place of what moves across the valley behind slip, heel and toe.
pub(super) const ACROSS: usize = 3;

/// The motion as polynomials: velocities of the slip along, across, and of the other gap, the speed of the slip; friction
/// along and across, the normal force.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slide {
    pub length: f64,
    pub velocity: [[f64; 4]; TERMS],
    pub friction: [[f64; 2]; TERMS],
    pub normal: [f64; TERMS],
}

impl Contact {
    /// Resistance to pushing the corner in as it slides this way along.
    fn resistance(&self, along: f64) -> f64 {
        let i = self.gaps[0];
        self.compliance[i][i] - self.friction * along * self.compliance[i][SLIP]
    }

    /// Which part of its resistance friction leaves; none where that is Painlevé's.
    pub(super) fn regular(&self, along: f64) -> Option<f64> {
        let i = self.gaps[0];
        let part = self.resistance(along) / self.compliance[i][i];
        (part > SINGULAR).then_some(part)
    }

    /// The same from some time later on.
    fn after(&self, t: f64) -> Self {
        Contact {
            free: self.free.map(|[value, slope]| [value + slope * t, slope]),
            ..*self
        }
    }

    /// The order of a series of the free acceleration.
    fn term(&self, i: usize, k: usize) -> f64 {
        self.free[i].get(k).copied().unwrap_or(0.0)
    }

    /// Friction along and across, and the normal force, of a corner that sticks: their values and their changes.
    fn sticks(&self) -> [[f64; 2]; 3] {
        let (a, i) = (&self.compliance, self.gaps[0]);
        let determinant = a[SLIP][SLIP] * a[i][i] - a[SLIP][i] * a[i][SLIP];
        let at = |k: usize| {
            let (along, up) = (self.free[SLIP][k], self.free[i][k]);
            [
                (a[SLIP][i] * up - a[i][i] * along) / determinant,
                -self.free[ACROSS][k] / self.per_mass,
                (a[i][SLIP] * along - a[SLIP][SLIP] * up) / determinant,
            ]
        };
        let (value, slope) = (at(0), at(1));
        [0, 1, 2].map(|q| [value[q], slope[q]])
    }
}

/// The series of direction, normal force and friction.
struct Rubbing<'a> {
    contact: &'a Contact,
    direction: [[f64; 2]; TERMS],
    resistance: [f64; TERMS],
    normal: [f64; TERMS],
    friction: [[f64; 2]; TERMS],
}

impl<'a> Rubbing<'a> {
    fn new(contact: &'a Contact) -> Self {
        Rubbing {
            contact,
            direction: [[0.0; 2]; TERMS],
            resistance: [0.0; TERMS],
            normal: [0.0; TERMS],
            friction: [[0.0; 2]; TERMS],
        }
    }

    /// The next order, of this term of the direction: accelerations of the slip along, across and of the other gap.
    fn raise(&mut self, k: usize, direction: [f64; 2]) -> [f64; 3] {
        let c = self.contact;
        let i = c.gaps[0];
        self.direction[k] = direction;
        self.resistance[k] = if k == 0 {
            c.resistance(direction[0])
        } else {
            -c.friction * direction[0] * c.compliance[i][SLIP]
        };
        let turned: f64 = (1..=k).map(|j| self.resistance[j] * self.normal[k - j]).sum();
        self.normal[k] = (-c.term(i, k) - turned) / self.resistance[0];
        for q in 0..2 {
            let rubs: f64 = (0..=k).map(|j| self.normal[j] * self.direction[k - j][q]).sum();
            self.friction[k][q] = -c.friction * rubs;
        }
        self.moved(
            self.friction[k],
            self.normal[k],
            [c.term(SLIP, k), c.term(ACROSS, k), c.term(c.gaps[1], k)],
        )
    }

    /// Accelerations of these forces beside the free ones.
    fn moved(&self, [along, across]: [f64; 2], normal: f64, free: [f64; 3]) -> [f64; 3] {
        let c = self.contact;
        let [i, j] = c.gaps;
        [
            free[0] + c.compliance[SLIP][SLIP] * along + c.compliance[SLIP][i] * normal,
            free[1] + c.per_mass * across,
            free[2] + c.compliance[j][SLIP] * along + c.compliance[j][i] * normal,
        ]
    }

    /// How normal force, friction and accelerations change where the direction turns from its first one by so much.
    fn turns(&self, by: [f64; 2]) -> (f64, [f64; 2], [f64; 3]) {
        let c = self.contact;
        let normal = c.friction * by[0] * c.compliance[c.gaps[0]][SLIP] * self.normal[0] / self.resistance[0];
        let friction = [0, 1].map(|q| -c.friction * (self.normal[0] * by[q] + normal * self.direction[0][q]));
        (normal, friction, self.moved(friction, normal, [0.0; 3]))
    }
}

/// How a block goes on that slides with the velocity `u`, its other gap with `gap`, for `left` seconds at most; none
/// where friction jams it.
pub(super) fn go_on(contact: &Contact, u: [f64; 2], gap: f64, left: f64, bounds: Bounds) -> Option<Slide> {
    let first = u[0].hypot(u[1]);
    let d0 = u.map(|u| u / first);
    contact.regular(d0[0])?;
    let mut rubbing = Rubbing::new(contact);
    let mut velocity = [[0.0; 4]; TERMS];
    velocity[0] = [u[0], u[1], gap, first];
    for k in 0..TERMS {
        let mut direction = d0;
        if k > 0 {
            // s s' = u . u', s e = u.
            let longer: f64 = (1..=k)
                .map(|j| {
                    let d = rubbing.direction[k - j];
                    j as f64 * (velocity[j][0] * d[0] + velocity[j][1] * d[1])
                })
                .sum();
            velocity[k][3] = longer * INVERSE[k];
            direction = [0, 1].map(|q| {
                let turned: f64 = (1..=k)
                    .map(|j| velocity[j][3] * rubbing.direction[k - j][q])
                    .sum();
                (velocity[k][q] - turned) / first
            });
        }
        let accelerations = rubbing.raise(k, direction);
        if k < ORDER {
            for q in 0..3 {
                velocity[k + 1][q] = accelerations[q] * INVERSE[k + 1];
            }
        }
    }
    // Friction turns the slip back to where the forces have it, along `back`: an error of that kind does not last.
    let n0 = [-d0[1], d0[0]];
    let back = rubbing.turns(n0).2;
    let Bounds { error, way } = bounds;
    let passing = (way * back[0].hypot(back[1]) / first)
        .min((first * error).sqrt())
        .max(error);
    let aside = d0[0] * back[1] - d0[1] * back[0];
    let errors = |k: usize| {
        let [x, y, other, _] = velocity[k];
        let passes = d0[0] * y - d0[1] * x;
        let part = if aside == 0.0 { 0.0 } else { passes / aside };
        let lasts = [x - part * back[0], y - part * back[1], other - part * back[2]];
        let lasts = lasts.iter().fold(0.0, |most: f64, term| most.max(term.abs()));
        (lasts / error).max(passes.abs() / passing)
    };
    let mut length = reach([ORDER - 1, ORDER], errors, left);
    let forward = |t: f64| u[0] * sum(&velocity, 0, t) + u[1] * sum(&velocity, 1, t);
    while forward(length) < KEPT * first * first {
        length *= SHORTER;
    }
    Some(Slide {
        length,
        velocity,
        friction: rubbing.friction,
        normal: rubbing.normal,
    })
}

/// How a block whose corner sticks begins to slide on it, its other gap with the velocity `gap`, for `left` seconds at
/// most; `None` where it does not. `fastest` is how fast it has been before (m/s).
pub(super) fn begin(contact: &Contact, gap: f64, left: f64, fastest: f64) -> Option<Slide> {
    let [[along, along_rate], [across, across_rate], [normal, normal_rate]] = contact.sticks();
    let size = along.hypot(across);
    let rate = if size > 0.0 {
        (along * along_rate + across * across_rate) / size
    } else {
        along_rate.hypot(across_rate)
    } - contact.friction * normal_rate;
    let exceeds = size - contact.friction * normal;
    if rate > 0.0 {
        // Where the force has exceeded friction so short a time ago that nothing has moved since, it does so from there on.
        let since = exceeds.max(0.0) / rate;
        let compliance = contact.compliance[SLIP][SLIP].max(contact.per_mass);
        if 0.5 * rate * compliance * since * since < REST {
            let slide = onset(&contact.after(-since), gap, left, since, fastest);
            if slide.is_some() {
                return slide;
            }
        }
    }
    if exceeds <= 0.0 {
        return None;
    }
    jump(contact, gap, left, fastest)
}

/// Acceleration of a start, along and across: friction is `-lambda` times it, and as large as it can be.
fn direction(contact: &Contact) -> [f64; 2] {
    let (a, i) = (&contact.compliance, contact.gaps[0]);
    let free = contact.free.map(|[value, _]| value);
    let (normal, per) = (-free[i] / a[i][i], -a[i][SLIP] / a[i][i]);
    // The corner stays down.
    let along = free[SLIP] + a[SLIP][i] * normal;
    let compliance = a[SLIP][SLIP] + a[SLIP][i] * per;
    let ratio = contact.per_mass / compliance;
    // part = lambda compliance / (1 + lambda compliance).
    let at = |part: f64| {
        let left = 1.0 - part;
        [along * left, free[ACROSS] * left / (left + part * ratio)]
    };
    let (mut least, mut most) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (least + most);
        if middle <= least || middle >= most {
            break;
        }
        let lambda = middle / ((1.0 - middle) * compliance);
        let [x, y] = at(middle);
        let limit = contact.friction * (normal - per * lambda * x);
        if lambda * x.hypot(y) > limit {
            most = middle;
        } else {
            least = middle;
        }
    }
    at(least)
}

/// The start of a block whose force exceeds friction at once.
fn jump(contact: &Contact, gap: f64, left: f64, fastest: f64) -> Option<Slide> {
    let [x, y] = direction(contact);
    let acceleration = x.hypot(y);
    let e0 = [x / acceleration, y / acceleration];
    if acceleration <= 0.0 || contact.regular(e0[0]).is_none() {
        return None;
    }
    start(contact, 1, acceleration, e0, gap, [left, 0.0], fastest)
}

/// The start of a block whose force just equals friction, and exceeds it from now on; `since` seconds of it are over.
fn onset(contact: &Contact, gap: f64, left: f64, since: f64, fastest: f64) -> Option<Slide> {
    let [[along, _], [across, _], [normal, _]] = contact.sticks();
    let size = along.hypot(across);
    if size <= 0.0 || normal <= 0.0 {
        return None;
    }
    let e0 = [-along / size, -across / size];
    contact.regular(e0[0])?;
    start(contact, 2, 0.0, e0, gap, [left, since], fastest)
}

/// The series of `t^power alpha (e0 + rho n0)`, the first alpha given where the power is 1; none where it goes back.
fn start(
    contact: &Contact,
    power: usize,
    first: f64,
    e0: [f64; 2],
    gap: f64,
    [left, since]: [f64; 2],
    fastest: f64,
) -> Option<Slide> {
    let n0 = [-e0[1], e0[0]];
    let mut rubbing = Rubbing::new(contact);
    let (mut alpha, mut rho) = ([0.0; ONSET + 2], [0.0; ONSET + 2]);
    let (mut r, mut c) = ([0.0; ONSET + 2], [0.0; ONSET + 2]);
    (alpha[0], r[0], c[0]) = (first, 1.0, 1.0);
    let mut gaps = [0.0; TERMS];
    gaps[0] = gap;
    gaps[1] = rubbing.raise(0, e0)[2];
    let (normal_turns, friction_turns, back) = rubbing.turns(n0);
    for k in 1..=ONSET {
        let square: f64 = (1..k).map(|j| rho[j] * rho[k - j] - r[j] * r[k - j]).sum();
        r[k] = 0.5 * square;
        c[k] = -(1..=k).map(|j| r[j] * c[k - j]).sum::<f64>();
        let sine: f64 = (1..k).map(|j| rho[j] * c[k - j]).sum();
        // Without the term of rho that is looked for.
        let known = rubbing.raise(k, [0, 1].map(|q| e0[q] * c[k] + n0[q] * sine));
        let n = (k + 1) as f64;
        let beta: f64 = if power == 1 {
            (1..k).map(|j| alpha[j] * rho[k - j]).sum()
        } else {
            (0..k - 1).map(|j| alpha[j] * rho[k - 1 - j]).sum()
        };
        let right = [0, 1].map(|q| known[q] - n * n0[q] * beta);
        let own = if power == 1 { n * first } else { 0.0 };
        let column = [0, 1].map(|q| own * n0[q] - back[q]);
        // n alpha e0 + rho column = right.
        let across = |v: [f64; 2]| e0[0] * v[1] - e0[1] * v[0];
        let along = |v: [f64; 2]| e0[0] * v[0] + e0[1] * v[1];
        rho[k] = across(right) / across(column);
        alpha[k + 1 - power] = (along(right) - rho[k] * along(column)) / n;
        for q in 0..2 {
            rubbing.direction[k][q] += n0[q] * rho[k];
            rubbing.friction[k][q] += friction_turns[q] * rho[k];
        }
        rubbing.resistance[k] -=
            contact.friction * n0[0] * rho[k] * contact.compliance[contact.gaps[0]][SLIP];
        rubbing.normal[k] += normal_turns * rho[k];
        gaps[k + 1] = (known[2] + back[2] * rho[k]) / n;
    }
    if alpha[0] <= 0.0 || !alpha.iter().chain(&rho).all(|term| term.is_finite()) {
        return None;
    }
    // The onset knows one term less of alpha than of rho.
    let last = ONSET + 1 - power;
    let mut velocity = [[0.0; 4]; TERMS];
    for k in 0..=last {
        let beta: f64 = (0..k).map(|j| alpha[j] * rho[k - j]).sum();
        velocity[k + power] = [
            e0[0] * alpha[k] + n0[0] * beta,
            e0[1] * alpha[k] + n0[1] * beta,
            0.0,
            (0..=k).map(|j| alpha[j] * r[k - j]).sum(),
        ];
    }
    for (velocity, gap) in velocity.iter_mut().zip(gaps) {
        velocity[2] = gap;
    }
    let likely = alpha[0] * (left + since).powi(power as i32);
    let bounds = Bounds::new(fastest.max(likely), 0.0);
    let errors = |k: usize| {
        velocity[k]
            .iter()
            .fold(0.0, |most: f64, term| most.max(term.abs()))
            / bounds.error
    };
    let mut length = reach([last + power - 1, last + power], errors, left + since);
    let forward = |t: f64| e0[0] * sum(&velocity, 0, t) + e0[1] * sum(&velocity, 1, t);
    while forward(length) < KEPT * alpha[0] * length.powi(power as i32) {
        length *= SHORTER;
    }
    let mut slide = Slide {
        length: (length - since).clamp(0.0, left),
        velocity,
        friction: rubbing.friction,
        normal: rubbing.normal,
    };
    if since > 0.0 {
        slide.move_origin(since);
    }
    Some(slide)
}

impl Slide {
    /// Count the time from some seconds later on.
    fn move_origin(&mut self, since: f64) {
        fn later<const N: usize>(terms: &mut [[f64; N]; TERMS], since: f64) {
            for row in 0..TERMS - 1 {
                for k in (row..TERMS - 1).rev() {
                    let next = terms[k + 1];
                    for (term, next) in terms[k].iter_mut().zip(next) {
                        *term += since * next;
                    }
                }
            }
        }
        later(&mut self.velocity, since);
        later(&mut self.friction, since);
        let mut normal = self.normal.map(|term| [term]);
        later(&mut normal, since);
        self.normal = normal.map(|[term]| term);
    }
}

/// How far two terms of a series allow to go, `left` at most; `errors` says how many times its bound a term is.
fn reach(terms: [usize; 2], errors: impl Fn(usize) -> f64, left: f64) -> f64 {
    let shortest = terms
        .into_iter()
        .map(|k| -errors(k).ln() * INVERSE[k])
        .fold(f64::INFINITY, f64::min);
    left.min(shortest.exp())
}

/// One of the polynomials after a time.
fn sum(terms: &[[f64; 4]; TERMS], q: usize, t: f64) -> f64 {
    terms.iter().rev().fold(0.0, |sum, term| sum * t + term[q])
}
