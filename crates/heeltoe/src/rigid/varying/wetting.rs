//! Force and moment of water whose pressure changes with the opening, as power series in time.
//!
//! The crack is open by `g(x) = gap + slope x`. Where the pressure is `p + b min(1, g/w)`, with `b = p_full - p` or `-p`, and
//! L is the part of a stretch that is open by more than w, `E = g - w = slope L` at its open end,
//!
//! `int b min(1, g/w) = (gap int b + slope int b x)/w - sign(L) (b E L/2 - b' E L^2/6)/w`,
//!
//! b that at this end, and the moment likewise. Where it is `p w/(w + g)` the integrals are those of
//! [`super::water::tail`], of `e = slope h/(w + g)` in the middle of a stretch of the half length h, whose terms follow from
//!
//! `T = artanh e`, `T' = e'/(1 - e^2)`, `S = (T/e - 1)/e^2`, or from the sum `S = 1/3 + e^2/5 + e^4/7 + ...`.

use super::power::{later, product, Series, Terms, MOST};
use super::water::{FollowingWater, NARROW, ODD};
use crate::friction::INVERSE;
use crate::inside::Law;

/// Opening, as a part of that at the kink, that is at the kink: it is rounding.
const NEAR: f64 = 1e-12;
/// By how much the largest e may grow for which so many terms of the sum are enough.
const GROWS: f64 = 1.5;
/// So many terms of it, and up to which e.
const SUMS: [(usize, f64); 3] = [
    (2, NARROW * NARROW * NARROW * NARROW),
    (4, NARROW * NARROW),
    (8, NARROW),
];
const NONE: Terms = [0.0; MOST];

/// A stretch of the crack over which the pressure is straight while it is closed.
enum Stretch {
    /// Open beyond the kink all over, or at none of its places: integrals of b, b x and b x^2.
    Whole { sums: [f64; 3], open: bool },
    /// Open beyond it at one end, of this place and b, and the change of b; 1 for its end downstream, else -1.
    Wedge {
        sums: [f64; 3],
        end: [f64; 3],
        sign: f64,
        grown: Box<[Terms; 5]>,
    },
    /// Under water that spreads: the middle, half the length, pressure there and its change over half the length; how many
    /// terms of the sum are taken, none where it is not.
    Spread {
        place: [f64; 2],
        pressure: [f64; 2],
        sum: Option<(usize, f64)>,
        grown: Box<[Terms; 14]>,
    },
}

/// The water as its series grow term by term.
pub(super) struct Wetting<'a> {
    water: &'a FollowingWater,
    stretches: Vec<Stretch>,
    /// By the points of the pressure, whether the crack is open beyond the kink, and whether it is at it.
    open: Vec<[bool; 2]>,
    pub force: Terms,
    pub about_heel: Terms,
}

impl<'a> Wetting<'a> {
    /// From gap at the heel and slope, and how they change.
    pub(super) fn new(water: &'a FollowingWater, now: [f64; 2], change: [f64; 2]) -> Self {
        let spreads = water.law == Law::FollowsOpening;
        let beyond = |x: f64| {
            let (open, opens) = (now[0] + now[1] * x - water.opening, change[0] + change[1] * x);
            let near = open.abs() <= NEAR * water.opening;
            [if near { opens >= 0.0 } else { open > 0.0 }, near]
        };
        let open: Vec<_> = match water.law {
            Law::FollowsOpening => Vec::new(),
            _ => water.points.iter().map(|[x, _]| beyond(*x)).collect(),
        };
        let stretch = |k: usize| {
            let ends = [water.points[k], water.points[k + 1]];
            if spreads {
                spread(water, ends, now)
            } else {
                kinked(water, ends, [open[k][0], open[k + 1][0]])
            }
        };
        let long = |k: &usize| water.points[k + 1][0] > water.points[*k][0];
        let stretches = (0..water.points.len() - 1).filter(long).map(stretch).collect();
        Wetting {
            water,
            stretches,
            open,
            force: NONE,
            about_heel: NONE,
        }
    }

    /// Find the terms n.
    pub(super) fn unfold(&mut self, n: usize, gap: &Terms, slope: &Terms) {
        let width = self.water.opening;
        let closed = self.water.law != Law::FollowsOpening && n == 0;
        let mut sum = if closed { self.water.closed } else { [0.0; 2] };
        for stretch in &mut self.stretches {
            let [force, moment] = match stretch {
                Stretch::Whole { sums, open: true } if n == 0 => [sums[0], sums[1]],
                Stretch::Whole { open: true, .. } => [0.0; 2],
                Stretch::Whole { sums, .. } => straight(sums, gap[n], slope[n], width),
                Stretch::Wedge {
                    sums,
                    end,
                    sign,
                    grown,
                } => {
                    let [force, moment] = straight(sums, gap[n], slope[n], width);
                    let [less, turn] = wedge(n, [gap, slope], width, *end, grown);
                    [force - *sign * less / width, moment - *sign * turn / width]
                }
                Stretch::Spread {
                    place,
                    pressure,
                    sum,
                    grown,
                } => {
                    let few = sum.map(|(count, _)| count);
                    spreading(n, [gap, slope], width, [*place, *pressure], few, grown)
                }
            };
            sum[0] += force;
            sum[1] += moment;
        }
        [self.force[n], self.about_heel[n]] = sum;
    }

    /// What is above zero as long as the series hold, from how far the crack is open at a place.
    pub(super) fn bends(&self, gap: impl Fn(f64) -> Series) -> Vec<Series> {
        let width = self.water.opening;
        let kinks = self
            .water
            .points
            .iter()
            .zip(&self.open)
            .map(|([x, _], [beyond, near])| {
                let mut left = gap(*x);
                left.terms[0] = if *near { 0.0 } else { left.terms[0] - width };
                left.scaled(if *beyond { 1.0 } else { -1.0 })
            });
        let spread = self.stretches.iter().filter_map(|stretch| match stretch {
            Stretch::Spread {
                place: [middle, half],
                sum: Some((_, most)),
                ..
            } => Some((middle, half, most)),
            _ => None,
        });
        let narrow = spread.flat_map(|(middle, half, most)| {
            let mut about = gap(*middle);
            about.terms[0] += width;
            let rise = gap(middle + half).plus(&gap(*middle), -1.0);
            [1.0, -1.0].map(|way| about.scaled(GROWS * most).plus(&rise, -way))
        });
        kinks.chain(narrow).collect()
    }
}

fn kinked(water: &FollowingWater, [[x0, p0], [x1, p1]]: [[f64; 2]; 2], open: [bool; 2]) -> Stretch {
    let more = |still: f64| match water.law {
        Law::FullWhileOpen => water.full - still,
        _ => -still,
    };
    let (b0, b1) = (more(p0), more(p1));
    let (long, rise) = (x1 - x0, (b1 - b0) / (x1 - x0));
    let (middle, mean) = (0.5 * (x0 + x1), 0.5 * (b0 + b1));
    let about = long * long / 12.0;
    let first = middle * mean + rise * about;
    let second = mean * (middle * middle + about) + 2.0 * middle * rise * about;
    let sums = [mean, first, second].map(|sum| long * sum);
    let (end, sign) = match open {
        [false, true] => ([x1, b1, rise], 1.0),
        [true, false] => ([x0, b0, rise], -1.0),
        [open, _] => return Stretch::Whole { sums, open },
    };
    Stretch::Wedge {
        sums,
        end,
        sign,
        grown: Box::new([NONE; 5]),
    }
}

fn spread(water: &FollowingWater, [[x0, p0], [x1, p1]]: [[f64; 2]; 2], [gap, slope]: [f64; 2]) -> Stretch {
    let place @ [middle, half] = [0.5 * (x0 + x1), 0.5 * (x1 - x0)];
    let e = slope * half / (water.opening + gap + slope * middle);
    Stretch::Spread {
        place,
        pressure: [0.5 * (p0 + p1), 0.5 * (p1 - p0)],
        sum: SUMS.into_iter().find(|(_, most)| e.abs() < *most),
        grown: Box::new([NONE; 14]),
    }
}

/// Force and moment of a pressure `b g/w`.
fn straight([whole, first, second]: &[f64; 3], gap: f64, slope: f64, width: f64) -> [f64; 2] {
    [
        (gap * whole + slope * first) / width,
        (gap * first + slope * second) / width,
    ]
}

/// Terms n of the integrals of `b (g - w)` and of it times x over what is open beyond the kink.
fn wedge(n: usize, [gap, slope]: [&Terms; 2], width: f64, end: [f64; 3], grown: &mut [Terms; 5]) -> [f64; 2] {
    let [place, b, rise] = end;
    let [open, long, w1, w2, w3] = grown;
    open[n] = gap[n] + slope[n] * place - if n == 0 { width } else { 0.0 };
    long[n] = (open[n] - later(slope, long, n)) / slope[0];
    w1[n] = product(open, long, n);
    w2[n] = product(w1, long, n);
    w3[n] = product(w2, long, n);
    [
        b * w1[n] / 2.0 - rise * w2[n] / 6.0,
        b * place * w1[n] / 2.0 - (b + rise * place) * w2[n] / 6.0 + rise * w3[n] / 12.0,
    ]
}

/// Terms n of the force and the moment of water that spreads over a stretch.
fn spreading(
    n: usize,
    [gap, slope]: [&Terms; 2],
    width: f64,
    [[middle, half], [still, rise]]: [[f64; 2]; 2],
    few: Option<usize>,
    grown: &mut [Terms; 14],
) -> [f64; 2] {
    let [open, scale, e, s, es, lever, turned, powers @ ..] = grown;
    let one = if n == 0 { 1.0 } else { 0.0 };
    open[n] = gap[n] + slope[n] * middle + one * width;
    scale[n] = (2.0 * one * width - later(open, scale, n)) / open[0];
    e[n] = (slope[n] * half - later(open, e, n)) / open[0];
    powers[0][n] = product(e, e, n);
    s[n] = if let Some(few) = few {
        for k in 1..few - 1 {
            powers[k][n] = product(&powers[0], &powers[k - 1], n);
        }
        let sum = powers.iter().zip(&ODD[1..few]);
        sum.fold(one * ODD[0], |sum, (power, odd)| sum + odd * power[n])
    } else {
        let [square, inverse, t, ratio, change, ..] = powers;
        inverse[n] = (one + later(square, inverse, n)) / (1.0 - square[0]);
        change[n] = n as f64 * e[n];
        t[n] = if n == 0 {
            e[0].atanh()
        } else {
            product(change, inverse, n) * INVERSE[n]
        };
        ratio[n] = (t[n] - later(e, ratio, n)) / e[0];
        (ratio[n] - one - later(square, s, n)) / square[0]
    };
    es[n] = product(e, s, n);
    lever[n] = rise * s[n] - still * es[n];
    turned[n] = product(scale, lever, n);
    let press = still * scale[n] - product(e, turned, n);
    [half * press, half * (middle * press + half * turned[n])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_are_the_force_as_the_crack_opens() {
        let points = vec![[0.0, 8.0], [4.0, 2.0], [10.0, 0.0]];
        // Gap at the heel and slope, and how they change over a length in which no kink is passed.
        let ways = [
            ([0.0, 1e-6], [0.0, 2e-6]),
            ([2e-5, 4e-5], [1e-6, -1e-6]),
            ([0.0, 2e-4], [0.0, 1e-5]),
            ([5e-3, -4e-4], [1e-5, 2e-6]),
            ([0.1, 1e-3], [1e-3, 1e-4]),
            ([0.02, -1.9e-3], [1e-4, 1e-5]),
        ];
        for law in [Law::ZeroWhileOpen, Law::FullWhileOpen, Law::FollowsOpening] {
            let water = FollowingWater::new(law, points.clone(), 1e-3, 8.0);
            for (now, change) in ways {
                let mut wetting = Wetting::new(&water, now, change);
                let [mut gap, mut slope] = [NONE; 2];
                [gap[0], gap[1], slope[0], slope[1]] = [now[0], change[0], now[1], change[1]];
                (0..MOST).for_each(|n| wetting.unfold(n, &gap, &slope));
                for t in [0.0, 0.05, 0.1] {
                    let series =
                        [wetting.force, wetting.about_heel].map(|terms| Series { terms, count: MOST }.at(t));
                    let direct = water.force(now[0] + change[0] * t, now[1] + change[1] * t);
                    for (series, direct) in series.into_iter().zip(direct) {
                        let apart = (series - direct).abs();
                        assert!(apart < 1e-12 * 200.0, "{law:?} {now:?} {t}: {series} {direct}");
                    }
                }
            }
        }
    }
}
