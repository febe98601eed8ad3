//! A slide from rest: its direction by one secular equation, and the series of its onset.
//!
//! The acceleration a in the direction e obeys `(F_x / (m_x a + T))^2 + (F_y / (m_y a + T))^2 = 1`. In the frame of e and
//! of n across it, `u = t^p (alpha e + beta n)`, `rho = beta / alpha`: p = 1 where a > 0, p = 2 where the force just
//! exceeds friction. Order by order alpha comes from the equation along e, rho from that along n. An explicit step from
//! a small velocity would be as short as that velocity, as the direction relaxes at the rate T / (m |u|); the series of
//! the onset is asymptotic and goes far beyond.

use super::flight::{value, Flight, Series};
use super::polynomial::TERMS;
use super::rub::Rub;
use super::series::{reach, Bounds, Forces};

/// Order of the series of an onset.
pub(super) const ONSET: usize = 13;
/// A block slower than this is at rest (m/s): its way to where it stops is less than the size of an atom.
pub(super) const REST: f64 = 1e-9;
/// Part of its first acceleration that a block keeps on one step.
const KEPT: f64 = 0.1;

/// How a block that is at rest begins to slide, for `left` seconds at most; `None` where it does not. `fastest` is how
/// fast it has been before (m/s).
pub(super) fn begin(forces: &Forces, left: f64, fastest: f64) -> Option<Flight> {
    // Where the force has exceeded friction so short a time ago that nothing has moved since, it does so from there on.
    let [exceeds, rate] = excess(forces);
    if rate > 0.0 {
        let since = exceeds.max(0.0) / rate;
        if 0.5 * rate * since * since < REST * forces.mass.min(1.0) {
            let onset = onset(&forces.after(-since), left, since, fastest);
            if onset.is_some() {
                return onset;
            }
        }
    }
    if exceeds <= 0.0 {
        return None;
    }
    jump(forces, left, fastest)
}

/// How much the force exceeds friction, and its change per second (m/s2).
fn excess(forces: &Forces) -> [f64; 2] {
    let [[fx, jx], [fy, jy]] = forces.push;
    let force = fx.hypot(fy);
    let rate = if force > 0.0 {
        (fx * jx + fy * jy) / force
    } else {
        jx.hypot(jy)
    };
    [force - forces.rub[0], rate - forces.rub[1]]
}

/// Acceleration, and direction, of a block whose force exceeds friction.
pub(super) fn direction(forces: &Forces) -> (f64, [f64; 2]) {
    let ([fx, fy], friction) = (forces.push.map(|[f, _]| f), forces.rub[0]);
    let parts = |a: f64| [fx / (forces.mass * a + friction), fy / (a + friction)];
    // Falls, convex, from |F| / T - 1 > 0 at zero.
    let (mut least, mut most) = (0.0, (fx / forces.mass).hypot(fy));
    let mut a = (fx.hypot(fy) - friction) / forces.mass.max(1.0);
    for _ in 0..100 {
        let [p, q] = parts(a);
        let over = p * p + q * q - 1.0;
        if over > 0.0 {
            least = a;
        } else {
            most = a;
        }
        let slope = -2.0 * (p * p * forces.mass / (forces.mass * a + friction) + q * q / (a + friction));
        let newton = a - over / slope;
        let next = if newton > least && newton < most {
            newton
        } else {
            0.5 * (least + most)
        };
        if next == a || next == least || next == most {
            break;
        }
        a = next;
    }
    let [p, q] = parts(a);
    let size = p.hypot(q);
    (a, [p / size, q / size])
}

/// Mass, forces in the frame of e and of what is across it: the three terms of the mass, the force along either.
fn turned(forces: &Forces, [c, s]: [f64; 2]) -> ([f64; 3], [[f64; 2]; 2]) {
    let mass = [
        forces.mass * c * c + s * s,
        (1.0 - forces.mass) * c * s,
        forces.mass * s * s + c * c,
    ];
    let [[fx, jx], [fy, jy]] = forces.push;
    (
        mass,
        [
            [c * fx + s * fy, c * jx + s * jy],
            [c * fy - s * fx, c * jy - s * jx],
        ],
    )
}

/// What goes with rho, order by order: `r = sqrt(1 + rho^2)`, `c = 1 / r`, `s = rho / r`. Its first term is zero.
struct Angle {
    rho: [f64; ONSET + 2],
    r: [f64; ONSET + 2],
    c: [f64; ONSET + 2],
}

impl Angle {
    fn new() -> Self {
        let mut angle = Angle {
            rho: [0.0; ONSET + 2],
            r: [0.0; ONSET + 2],
            c: [0.0; ONSET + 2],
        };
        (angle.r[0], angle.c[0]) = (1.0, 1.0);
        angle
    }

    /// Work out the terms of this order of r and c; rho of that order has no part in them, as its first term is zero.
    fn raise(&mut self, k: usize) {
        let mut square = 0.0;
        for j in 1..k {
            square += self.rho[j] * self.rho[k - j] - self.r[j] * self.r[k - j];
        }
        self.r[k] = square / 2.0;
        let mut c = 0.0;
        for j in 1..=k {
            c -= self.r[j] * self.c[k - j];
        }
        self.c[k] = c;
    }

    /// The term of this order of s, where rho of this order is left out.
    fn sine(&self, k: usize) -> f64 {
        (1..k).map(|j| self.rho[j] * self.c[k - j]).sum()
    }

    /// Term k of what pushes along e and across it less friction by a law, where rho of this order is left out.
    fn forces(&self, law: &Rub, k: usize, [along, across]: [f64; 2]) -> [f64; 2] {
        let sine = |j: usize| {
            if j == k {
                self.sine(j)
            } else {
                self.sine(j) + self.rho[j]
            }
        };
        [
            along - law.times(k, self.c[0], |j| self.c[j]),
            across - law.times(k, 0.0, sine),
        ]
    }
}

/// Friction by a law of a block at rest, with its first term.
fn law_from_rest(forces: &Forces) -> Option<Rub> {
    let mut law = forces.law?.unfold(0.0)?;
    law.next(0, 0.0);
    Some(law)
}

/// The start of a block whose force exceeds friction at once.
fn jump(forces: &Forces, left: f64, fastest: f64) -> Option<Flight> {
    let (a, e) = direction(forces);
    let ([m00, m01, m11], [along, across]) = turned(forces, e);
    let [rub, rub_slope] = forces.rub;
    let (mut angle, mut alpha) = (Angle::new(), [0.0; ONSET + 1]);
    alpha[0] = a;
    let mut by_law = law_from_rest(forces);
    for k in 1..=ONSET {
        angle.raise(k);
        let term = |f: &[f64; 2]| if k == 1 { f[1] } else { 0.0 };
        let mut f = term(&along) - rub * angle.c[k] - rub_slope * angle.c[k - 1];
        let before = if k > 1 {
            angle.sine(k - 1) + angle.rho[k - 1]
        } else {
            0.0
        };
        let mut g = term(&across) - rub * angle.sine(k) - rub_slope * before;
        if let Some(law) = &mut by_law {
            law.next(k, (0..k).map(|j| alpha[j] * angle.r[k - 1 - j]).sum());
            [f, g] = angle.forces(law, k, [term(&along), term(&across)]);
        }
        let known: f64 = (1..k).map(|j| alpha[j] * angle.rho[k - j]).sum();
        // n (m00 alpha + m01 (a rho + known)) = f, n (m01 alpha + m11 (a rho + known)) = g - T rho.
        let n = (k + 1) as f64;
        let [p, q] = [f / n - m01 * known, g / n - m11 * known];
        let corner = m11 * a + rub / n;
        let determinant = m00 * corner - m01 * m01 * a;
        alpha[k] = (p * corner - m01 * a * q) / determinant;
        angle.rho[k] = (m00 * q - m01 * p) / determinant;
    }
    let friction = by_law.map(|law| law.terms);
    Some(flight(1, &alpha, &angle, e, [left, 0.0], (fastest, friction)))
}

/// The start of a block whose force just equals friction, and exceeds it from now on. `since` seconds of it are over.
fn onset(forces: &Forces, left: f64, since: f64, fastest: f64) -> Option<Flight> {
    let [[fx, _], [fy, _]] = forces.push;
    let size = fx.hypot(fy);
    let [rub, rub_slope] = forces.rub;
    if size <= 0.0 || rub <= 0.0 {
        return None;
    }
    let e = [fx / size, fy / size];
    let ([m00, m01, m11], [along, across]) = turned(forces, e);
    let (mut angle, mut alpha) = (Angle::new(), [0.0; ONSET + 1]);
    let mut by_law = law_from_rest(forces);
    for k in 1..=ONSET {
        angle.raise(k);
        let term = |f: &[f64; 2]| if k == 1 { f[1] } else { 0.0 };
        let n = (k + 1) as f64;
        let mut f = term(&along) - rub * angle.c[k] - rub_slope * angle.c[k - 1];
        let before = if k > 1 {
            angle.sine(k - 1) + angle.rho[k - 1]
        } else {
            0.0
        };
        let mut g = term(&across) - rub * angle.sine(k) - rub_slope * before;
        if let Some(law) = &mut by_law {
            law.next(k, (0..k - 1).map(|j| alpha[j] * angle.r[k - 2 - j]).sum());
            [f, g] = angle.forces(law, k, [term(&along), term(&across)]);
        }
        // Of the last alpha rho has no part, as it begins with zero.
        let beta: f64 = (0..k - 1).map(|j| alpha[j] * angle.rho[k - 1 - j]).sum();
        alpha[k - 1] = (f / n - m01 * beta) / m00;
        if k == 1 && alpha[0] <= 0.0 {
            return None;
        }
        angle.rho[k] = (g - n * (m01 * alpha[k - 1] + m11 * beta)) / rub;
    }
    let friction = by_law.map(|law| law.terms);
    Some(flight(2, &alpha, &angle, e, [left, since], (fastest, friction)))
}

/// The velocities of `t^power (alpha e + alpha rho n)`.
fn flight(
    power: usize,
    alpha: &[f64; ONSET + 1],
    angle: &Angle,
    [c, s]: [f64; 2],
    [left, since]: [f64; 2],
    (fastest, friction): (f64, Option<Series>),
) -> Flight {
    let mut terms = [[0.0; 3]; TERMS];
    // The onset knows one term less of alpha than of rho.
    let last = ONSET + 1 - power;
    for k in 0..=last {
        let beta: f64 = (0..k).map(|j| alpha[j] * angle.rho[k - j]).sum();
        let speed = (0..=k).map(|j| alpha[j] * angle.r[k - j]).sum();
        terms[k + power] = [c * alpha[k] - s * beta, s * alpha[k] + c * beta, speed];
    }
    const { assert!(ONSET + 1 < TERMS) };
    let likely = alpha[0] * (left + since).powi(power as i32);
    let bounds = Bounds::new(fastest.max(likely), 0.0);
    let mut length = reach(
        &terms,
        last + power,
        |term| term.iter().fold(0.0, |most: f64, term| most.max(term.abs())) / bounds.error,
        left + since,
    );
    let forward = |t: f64| {
        let [along, across, _] = value(&terms, t);
        c * along + s * across
    };
    while forward(length) < KEPT * alpha[0] * length.powi(power as i32) {
        length *= 0.6;
    }
    Flight {
        begin: since,
        length: (length - since).clamp(0.0, left),
        terms,
        friction,
    }
}
