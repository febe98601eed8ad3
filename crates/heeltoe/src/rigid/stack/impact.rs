//! Impacts of up to four corners at once: `w2 - w1 = A p`.
//!
//! 1. A corner that strikes leaves with `-e` times its approach velocity, or faster without a push.
//! 2. A corner that lies stays with a push, or leaves without one.
//! 3. In a crack that is pushed `|p_T| <= mu_s (p_h + p_t)` where it sticks, `p_T = -mu_k S (p_h + p_t)` where it slips.
//!
//! Of several outcomes the first is taken: with the fewest pushes beside those of the corners that strike, sticking
//! before slipping, the lower crack first. Where friction would make energy of it, all restitutions of this impact are
//! lowered, as those of one block are.

use super::super::block::{HEEL, SLIP, TOE};
use super::blocks::Stack;
use super::solve::{Factors, Six, Square};

/// Relative rounding allowed in the inequalities of the law.
const ROUNDING: f64 = 1e-12;
/// Ways to slip; 0 sticks.
const WAYS: [f64; 3] = [0.0, 1.0, -1.0];

/// For each crack its heel and its toe.
pub(super) type Corners = [[bool; 2]; 2];

/// What an impact does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Impact {
    pub velocity: Six,
    pub impulse: Six,
    /// By the work of the impulses in each crack.
    pub energy_lost: [f64; 2],
    pub energy_limited: bool,
}

/// Who is pushed, how each crack rubs, and what velocities the gaps come to.
struct Assumption<'a> {
    pushed: Corners,
    ways: [f64; 2],
    target: &'a Six,
}

pub(super) struct Approach<'a> {
    pub stack: &'a Stack,
    pub before: Six,
    pub touching: Corners,
}

impl Approach<'_> {
    /// All corners that touch strike by the law; bounces slower than `settle` of their crack are none. Where two or more
    /// touch and none of them moves faster they come to lie. `None` where no outcome meets the law.
    pub(super) fn impact(&self, settle: [f64; 2]) -> Option<Impact> {
        let slow = self.slow(settle);
        let law = |share: f64| {
            let target: Six = std::array::from_fn(|i| {
                let crack = i / 3;
                let bounce = -self.stack.blocks[crack].restitution * self.before[i];
                let bounces = i % 3 != SLIP && bounce > settle[crack] && !slow;
                if bounces {
                    share * bounce
                } else {
                    0.0
                }
            });
            let found = self.outcome(&target, [&WAYS, &WAYS]);
            found.filter(|(after, impulse)| {
                let (gain, rounding) = gain(&self.before, after, impulse);
                gain <= rounding
            })
        };
        let mut energy_limited = false;
        let found = law(1.0).or_else(|| {
            energy_limited = true;
            largest_share(law)
        });
        let (velocity, impulse) = match found {
            Some(found) => found,
            None if slow => (self.before, [0.0; 6]),
            None => return None,
        };
        let struck = Impact {
            energy_lost: lost(&self.before, &velocity, &impulse),
            velocity,
            impulse,
            energy_limited,
        };
        Some(if slow {
            self.come_to_lie(struck, settle)
        } else {
            struck
        })
    }

    /// Impulse that stops the slip in these cracks and lifts nothing.
    pub(super) fn jam(&self, jams: [bool; 2]) -> Option<Impact> {
        let ways = jams.map(|jams| if jams { &WAYS[..1] } else { &WAYS[..] });
        let (velocity, impulse) = self.outcome(&[0.0; 6], ways)?;
        let energy_lost = lost(&self.before, &velocity, &impulse);
        (energy_lost[0] + energy_lost[1] > 0.0).then_some(Impact {
            velocity,
            impulse,
            energy_lost,
            energy_limited: false,
        })
    }

    /// The first outcome that meets the law, where the cracks rub in one of these ways.
    fn outcome(&self, target: &Six, ways: [&[f64]; 2]) -> Option<(Six, Six)> {
        let strikes = |k: usize| self.touching[k / 2][k % 2] && self.before[3 * (k / 2) + 1 + k % 2] < 0.0;
        let mut sets: Vec<(bool, u32, usize)> = (1..16_usize)
            .filter(|set| (0..4).all(|k| set >> k & 1 == 0 || self.touching[k / 2][k % 2]))
            .map(|set| {
                let missing = (0..4).any(|k| strikes(k) && set >> k & 1 == 0);
                (missing, set.count_ones(), set)
            })
            .collect();
        sets.sort_unstable();
        for (_, _, set) in sets {
            let pushed = [0, 1].map(|crack| [0, 1].map(|corner| set >> (2 * crack + corner) & 1 == 1));
            let free = pushed.map(|corners| corners == [false, false]);
            for &lower in if free[0] { &WAYS[..1] } else { ways[0] } {
                for &upper in if free[1] { &WAYS[..1] } else { ways[1] } {
                    let assumed = Assumption {
                        pushed,
                        ways: [lower, upper],
                        target,
                    };
                    if let Some(found) = self.under(&assumed) {
                        return Some(found);
                    }
                }
            }
        }
        None
    }

    /// Velocities after the impact and impulses, or `None` if the assumption does not hold.
    fn under(&self, assumed: &Assumption) -> Option<(Six, Six)> {
        let a = &self.stack.compliance;
        let impulse = self.impulse(assumed)?;
        let mut after = self.before;
        for (value, row) in after.iter_mut().zip(a) {
            *value += (0..6).map(|k| row[k] * impulse[k]).sum::<f64>();
        }
        let speed = self.before.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let slack = ROUNDING * speed;
        for crack in 0..2 {
            let first = 3 * crack;
            let stiffest = a[first + HEEL][first + HEEL].min(a[first + TOE][first + TOE]);
            let push = slack / stiffest;
            for (corner, gap) in [first + HEEL, first + TOE].into_iter().enumerate() {
                if assumed.pushed[crack][corner] {
                    if impulse[gap] < -push {
                        return None;
                    }
                    after[gap] = assumed.target[gap];
                } else if self.touching[crack][corner] {
                    if after[gap] < assumed.target[gap] - slack {
                        return None;
                    }
                    if after[gap].abs() <= slack {
                        after[gap] = 0.0;
                    }
                }
            }
            if assumed.pushed[crack] == [false, false] {
                continue;
            }
            let (way, slip) = (assumed.ways[crack], &mut after[first + SLIP]);
            if way == 0.0 {
                let normal = impulse[first + HEEL] + impulse[first + TOE];
                if impulse[first + SLIP].abs() > self.stack.blocks[crack].friction_static * normal + push {
                    return None;
                }
                *slip = 0.0;
            } else if way * *slip < -slack {
                return None;
            } else if way * *slip < 0.0 {
                *slip = 0.0;
            }
        }
        Some((after, impulse))
    }

    /// The impulses that meet the assumption.
    fn impulse(&self, assumed: &Assumption) -> Option<Six> {
        let a = &self.stack.compliance;
        let mut rows: Square =
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { a[i][i] } else { 0.0 }));
        let mut right = [0.0; 6];
        for crack in 0..2 {
            let (slip, pushed) = (3 * crack + SLIP, assumed.pushed[crack]);
            if pushed == [false, false] {
                continue;
            }
            let way = assumed.ways[crack];
            if way == 0.0 {
                rows[slip] = a[slip];
                right[slip] = -self.before[slip];
            } else {
                let pull = way * self.stack.blocks[crack].friction_kinetic * a[slip][slip];
                rows[slip][3 * crack + HEEL] = pull;
                rows[slip][3 * crack + TOE] = pull;
            }
            for (corner, gap) in [3 * crack + HEEL, 3 * crack + TOE].into_iter().enumerate() {
                if pushed[corner] {
                    rows[gap] = a[gap];
                    right[gap] = assumed.target[gap] - self.before[gap];
                }
            }
        }
        let size: f64 = (0..6).map(|i| a[i][i]).product();
        let factors = Factors::new(rows);
        (factors.determinant.abs() > 1e-14 * size).then(|| factors.solve(&right))
    }

    /// Whether two corners touch or more, all of them slower than their bound.
    fn slow(&self, settle: [f64; 2]) -> bool {
        let touching = (0..4).filter(|k| self.touching[k / 2][k % 2]);
        let slow = |k: usize| self.before[3 * (k / 2) + HEEL + k % 2].abs() < settle[k / 2];
        touching.clone().count() > 1 && touching.clone().all(slow)
    }

    /// Hold corners that have become too slow to bounce, be it from one to the other, and as slow a slip of a crack that
    /// lies: a projection in the norm of the kinetic energy, which can only lose.
    fn come_to_lie(&self, struck: Impact, settle: [f64; 2]) -> Impact {
        let v = &struck.velocity;
        let held: [bool; 6] = std::array::from_fn(|i| {
            let touching = self.touching[i / 3];
            match i % 3 {
                SLIP => {
                    let lies = touching == [true, true] && v[i].abs() < settle[i / 3];
                    lies || touching != [false, false] && v[i] == 0.0
                }
                gap => touching[gap - HEEL],
            }
        });
        let a = &self.stack.compliance;
        let rows: Square = std::array::from_fn(|i| {
            std::array::from_fn(|j| match (held[i], i == j) {
                (true, _) => a[i][j],
                (false, true) => a[i][i],
                (false, false) => 0.0,
            })
        });
        let right: Six = std::array::from_fn(|i| if held[i] { -v[i] } else { 0.0 });
        let push = Factors::new(rows).solve(&right);
        let velocity: Six = std::array::from_fn(|i| {
            if held[i] {
                0.0
            } else {
                v[i] + (0..6).map(|k| a[i][k] * push[k]).sum::<f64>()
            }
        });
        let more = lost(v, &velocity, &push);
        Impact {
            velocity,
            energy_lost: [0, 1].map(|crack| struck.energy_lost[crack] + more[crack]),
            ..struck
        }
    }
}

/// The outcome with the largest share of the restitutions that makes no energy.
fn largest_share(law: impl Fn(f64) -> Option<(Six, Six)>) -> Option<(Six, Six)> {
    let mut best = law(0.0)?;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if let Some(found) = law(middle) {
            best = found;
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(best)
}

/// Work of the impulses in each crack, taken as lost.
fn lost(before: &Six, after: &Six, impulse: &Six) -> [f64; 2] {
    [0, 1].map(|crack| {
        let work = |i: usize| 0.5 * impulse[i] * (before[i] + after[i]);
        -(3 * crack..3 * crack + 3).map(work).sum::<f64>()
    })
}

/// Energy gained and the rounding in it.
fn gain(before: &Six, after: &Six, impulse: &Six) -> (f64, f64) {
    let [lower, upper] = lost(before, after, impulse);
    let size = |i: usize| 0.5 * impulse[i].abs() * (before[i].abs() + after[i].abs());
    (-lower - upper, ROUNDING * (0..6).map(size).sum::<f64>())
}
