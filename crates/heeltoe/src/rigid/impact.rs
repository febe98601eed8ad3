//! Impacts: `M (v2 - v1) = n_i p_i + n_j p_j + t p_T`, in contact coordinates `w2 - w1 = A p`.
//!
//! 1. A corner that strikes leaves with `-e` times its approach velocity.
//! 2. A corner in contact stays out of it if it then leaves; else it is held, with a push.
//! 3. The base sticks if `|p_T| <= mu_s (p_h + p_t)`; else `p_T = -mu_k S (p_h + p_t)`, S the sign of the slip after.
//!    Of a block that moves across the valley, too, `p_T` and the slip have two components, and `p_T = -lambda u`, u the
//!    slip after: one `lambda >= 0` at which `|p_T| = mu_k (p_h + p_t)`.
//!
//! Newton's restitution with friction can create energy. Where it would, the restitution of this impact is lowered
//! to the largest that does not; with none at all energy cannot grow, since then `p . w2 <= 0`.
//!
//! A block that rocks over may lose more than that, by a measured part of the velocities of its corners.

use super::block::{Block, Vector, HEEL, SLIP, TOE};

/// Relative rounding allowed in the inequalities of the law.
const ROUNDING: f64 = 1e-12;
/// Most halvings of the part of a drag.
const HALVINGS: u32 = 200;

/// What an impact does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Impact {
    pub velocity: Vector,
    /// Impulses: friction, heel, toe.
    pub impulse: Vector,
    /// Velocity across the valley after it, and the impulse of friction there.
    pub across: [f64; 2],
    pub energy_lost: f64,
    /// Restitution had to be lowered for energy not to grow.
    pub energy_limited: bool,
}

impl Impact {
    fn of(before: &Vector, sideways: Option<Sideways>, after: After, energy_limited: bool) -> Self {
        let energy_lost = -energy_gain(before, sideways, &after).0;
        let (velocity, impulse, across) = after;
        Impact {
            velocity,
            impulse,
            across,
            energy_lost,
            energy_limited,
        }
    }
}

/// Mass and velocity across the valley of a block before an impact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sideways {
    pub mass: f64,
    pub velocity: f64,
}

#[derive(Clone, Copy)]
enum Friction {
    Stick,
    Slip(f64),
    /// An impulse of `-lambda` times the slip after, along and across; the number is the part `lambda a / (1 + lambda a)`,
    /// a the compliance of the slip along: 0 without friction, 1 where it sticks.
    Drag(f64),
}

/// Velocities after an impact, its impulses, and both across the valley.
type After = (Vector, Vector, [f64; 2]);

/// A block right before an impact.
struct Approach<'a> {
    block: &'a Block,
    before: &'a Vector,
    sideways: Option<Sideways>,
    touching: [bool; 2],
    /// The fastest of its velocities that matter, to judge rounding by.
    speed: f64,
}

/// What is assumed of the corners and of friction: who is pushed, and to what gap velocities.
struct Assumption<'a> {
    pushed: [bool; 2],
    friction: Friction,
    target: &'a Vector,
}

impl Approach<'_> {
    /// Velocities after the impact and impulses, or `None` if the assumption does not hold.
    fn under(&self, assumed: &Assumption) -> Option<After> {
        let a = &self.block.compliance;
        let impulse = self.impulse(assumed)?;
        let across = self.across(assumed.friction);
        let mut after = *self.before;
        for (i, v) in after.iter_mut().enumerate() {
            *v += (0..3).map(|k| a[i][k] * impulse[k]).sum::<f64>();
        }
        let target = assumed.target;
        let slack = ROUNDING * self.speed;
        let push = ROUNDING * self.speed / a[HEEL][HEEL].min(a[TOE][TOE]);
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if assumed.pushed[corner] {
                if impulse[gap] < -push {
                    return None;
                }
                after[gap] = target[gap];
            } else if self.touching[corner] {
                if after[gap] < target[gap] - slack {
                    return None;
                }
                // A corner left behind by mere rounding has not left.
                if after[gap].abs() <= slack {
                    after[gap] = 0.0;
                }
            }
        }
        match assumed.friction {
            Friction::Stick => {
                let normal = impulse[HEEL] + impulse[TOE];
                let friction = self.block.friction_static_towards(-impulse[SLIP].signum());
                if self.whole(&impulse, across[1]) > friction * normal + push {
                    return None;
                }
                after[SLIP] = 0.0;
            }
            Friction::Drag(_) => {}
            Friction::Slip(sign) => {
                if sign * after[SLIP] < -slack {
                    return None;
                }
                if sign * after[SLIP] < 0.0 {
                    after[SLIP] = 0.0;
                }
            }
        }
        Some((after, impulse, across))
    }

    /// Size of the impulse of friction, along and across.
    fn whole(&self, impulse: &Vector, across: f64) -> f64 {
        match self.sideways {
            Some(_) => impulse[SLIP].hypot(across),
            None => impulse[SLIP].abs(),
        }
    }

    /// Velocity across the valley after the impact, and the impulse of friction there.
    fn across(&self, friction: Friction) -> [f64; 2] {
        let Some(Sideways { mass, velocity }) = self.sideways else {
            return [0.0; 2];
        };
        let left = match friction {
            Friction::Stick => 0.0,
            Friction::Slip(_) => 1.0,
            Friction::Drag(part) => {
                let free = (1.0 - part) * self.block.compliance[SLIP][SLIP] * mass;
                free / (free + part)
            }
        };
        [velocity * left, mass * velocity * (left - 1.0)]
    }

    /// The slip that goes on along and across: the part at which the impulse of friction is as large as it can be. It
    /// exceeds that where it sticks.
    fn drag(&self, pushed: [bool; 2], target: &Vector) -> Option<Friction> {
        let exceeds = |part: f64| {
            let friction = Friction::Drag(part);
            let impulse = self.impulse(&Assumption {
                pushed,
                friction,
                target,
            })?;
            let normal = impulse[HEEL] + impulse[TOE];
            let whole = self.whole(&impulse, self.across(friction)[1]);
            Some(whole > self.block.friction_kinetic * normal)
        };
        let (mut least, mut most) = (0.0, 1.0);
        if !exceeds(most)? {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (least + most);
            if middle <= least || middle >= most {
                break;
            }
            if exceeds(middle)? {
                most = middle;
            } else {
                least = middle;
            }
        }
        Some(Friction::Drag(least))
    }

    /// The impulses that meet the assumption; `None` where there are none.
    fn impulse(&self, assumed: &Assumption) -> Option<Vector> {
        let (a, before) = (&self.block.compliance, self.before);
        // Unknown impulses in the order friction, heel, toe; each row is one condition on them.
        // All rows have the size of the compliance, so that a singular system can be told from a badly scaled one.
        let mut m = [
            [a[SLIP][SLIP], 0.0, 0.0],
            [0.0, a[HEEL][HEEL], 0.0],
            [0.0, 0.0, a[TOE][TOE]],
        ];
        let mut right = [0.0; 3];
        match assumed.friction {
            Friction::Stick => {
                m[SLIP] = a[SLIP];
                right[SLIP] = -before[SLIP];
            }
            Friction::Slip(sign) => {
                let mu = self.block.friction_kinetic_towards(sign) * sign;
                m[SLIP] = [1.0, mu, mu].map(|factor| factor * a[SLIP][SLIP]);
            }
            Friction::Drag(part) => {
                m[SLIP] = a[SLIP].map(|a| part * a);
                m[SLIP][SLIP] += (1.0 - part) * a[SLIP][SLIP];
                right[SLIP] = -part * before[SLIP];
            }
        }
        for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
            if assumed.pushed[corner] {
                m[gap] = a[gap];
                right[gap] = assumed.target[gap] - before[gap];
            }
        }
        solve3(&m, &right)
    }
}

fn solve3(m: &[[f64; 3]; 3], right: &Vector) -> Option<Vector> {
    let cross = |p: &Vector, q: &Vector| {
        [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ]
    };
    let column = |c: usize| [m[0][c], m[1][c], m[2][c]];
    let (c0, c1, c2) = (column(0), column(1), column(2));
    let dot = |p: &Vector, q: &Vector| p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    let det = dot(&c0, &cross(&c1, &c2));
    let size: f64 = m.iter().map(|row| dot(row, row)).product();
    if det * det <= 1e-28 * size {
        return None;
    }
    Some([
        dot(right, &cross(&c1, &c2)) / det,
        dot(&c0, &cross(right, &c2)) / det,
        dot(&c0, &cross(&c1, right)) / det,
    ])
}

/// The law with every restitution multiplied by `share`.
fn with_restitution(
    block: &Block,
    before: &Vector,
    sideways: Option<Sideways>,
    touching: [bool; 2],
    restitution: [f64; 2],
    share: f64,
) -> Option<After> {
    let mut target = [0.0; 3];
    for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
        if before[gap] < 0.0 {
            target[gap] = -restitution[corner] * share * before[gap];
        }
    }
    let strikes = [
        touching[0] && before[HEEL] < 0.0,
        touching[1] && before[TOE] < 0.0,
    ];
    let approach = Approach {
        block,
        before,
        sideways,
        touching,
        speed: before.iter().fold(0.0_f64, |m, v| m.max(v.abs())),
    };
    // The corner that strikes first; the other joins only if it must. Two that strike at once both obey rule 1.
    let sets = [strikes, touching, [touching[0], false], [false, touching[1]]];
    for (k, pushed) in sets.into_iter().enumerate() {
        if sets[..k].contains(&pushed) || pushed == [false, false] {
            continue;
        }
        let slips = match sideways {
            Some(_) => [approach.drag(pushed, &target), None],
            None => [Some(Friction::Slip(1.0)), Some(Friction::Slip(-1.0))],
        };
        for friction in [Some(Friction::Stick)].into_iter().chain(slips).flatten() {
            let result = approach.under(&Assumption {
                pushed,
                friction,
                target: &target,
            });
            if result.is_some() {
                return result;
            }
        }
    }
    None
}

/// Impact of the corners in `touching`, of which at least one has a negative gap velocity. A bounce slower than
/// `settle` is none: that corner stays; and where both corners touch and neither moves faster, both stay. `None` is a
/// paradox: no outcome satisfies the law.
pub(super) fn impact(
    block: &Block,
    before: &Vector,
    sideways: Option<Sideways>,
    touching: [bool; 2],
    settle: f64,
) -> Option<Impact> {
    let restitution = [HEEL, TOE].map(|gap| {
        let bounce = -block.restitution * before[gap];
        if bounce > settle {
            block.restitution
        } else {
            0.0
        }
    });
    if touching == [true, true] && before[HEEL].abs() < settle && before[TOE].abs() < settle {
        return Some(come_to_lie(block, before, sideways, touching, settle));
    }
    let law = |share: f64| {
        with_restitution(block, before, sideways, touching, restitution, share).filter(|after| {
            let (gain, rounding) = energy_gain(before, sideways, after);
            gain <= rounding
        })
    };
    let mut limited = false;
    let after = law(1.0).or_else(|| {
        limited = true;
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
    })?;
    let blow = Impact::of(before, sideways, after, limited);
    Some(if touching == [true, true] {
        dampened(block, blow)
    } else {
        blow
    })
}

/// A block that rocks from corner to corner with the loss that was measured beyond the law: the velocities of both
/// corners are less by it. Where friction would make energy of that, the law stays.
fn dampened(block: &Block, blow: Impact) -> Impact {
    let mut velocity = blow.velocity;
    for gap in [HEEL, TOE] {
        velocity[gap] *= 1.0 - block.rocking_loss;
    }
    let lost = block.kinetic_energy(&blow.velocity) - block.kinetic_energy(&velocity);
    if block.rocking_loss == 0.0 || lost < 0.0 {
        return blow;
    }
    Impact {
        velocity,
        energy_lost: blow.energy_lost + lost,
        ..blow
    }
}

/// Work of the impulses, `p . (w1 + w2) / 2`, and the rounding to be expected in it. The difference of the two kinetic
/// energies would drown it where the rest of the block moves much faster than the corner that strikes.
fn energy_gain(before: &Vector, sideways: Option<Sideways>, (after, impulse, across): &After) -> (f64, f64) {
    let [velocity, aside] = across;
    let was = sideways.map_or(0.0, |sideways| sideways.velocity);
    let mut gain = 0.5 * aside * (was + velocity);
    let mut size = 0.5 * aside.abs() * (was.abs() + velocity.abs());
    for i in 0..3 {
        gain += 0.5 * impulse[i] * (before[i] + after[i]);
        size += 0.5 * impulse[i].abs() * (before[i].abs() + after[i].abs());
    }
    (gain, ROUNDING * size)
}

/// Rocking from corner to corner dies out as bouncing does, in infinitely many impacts, each leaving a fixed share of
/// the velocity. Here the block is so slow that its blow is the last one: what the law without restitution leaves of
/// the velocities of the corners goes without a blow, since it would be pulled, and so does as slow a slip. Where the
/// block slips faster it does so on both corners. Either is a projection in the norm of the kinetic energy, which can
/// only lose.
fn come_to_lie(
    block: &Block,
    before: &Vector,
    sideways: Option<Sideways>,
    touching: [bool; 2],
    settle: f64,
) -> Impact {
    let was = sideways.map_or(0.0, |sideways| sideways.velocity);
    let after = with_restitution(block, before, sideways, touching, [0.0; 2], 0.0);
    let after = after.unwrap_or((*before, [0.0; 3], [was, 0.0]));
    let mut energy_lost = -energy_gain(before, sideways, &after).0;
    let (struck, impulse, mut across) = after;
    let mut velocity = [0.0; 3];
    let slip = match sideways {
        Some(_) => struck[SLIP].hypot(across[0]),
        None => struck[SLIP].abs(),
    };
    if slip < settle {
        energy_lost += block.kinetic_energy(&struck);
        energy_lost += sideways.map_or(0.0, |sideways| 0.5 * sideways.mass * across[0] * across[0]);
        across[0] = 0.0;
    } else {
        let a = &block.compliance;
        let det = a[HEEL][HEEL] * a[TOE][TOE] - a[HEEL][TOE] * a[TOE][HEEL];
        let heel = (a[HEEL][TOE] * struck[TOE] - a[TOE][TOE] * struck[HEEL]) / det;
        let toe = (a[TOE][HEEL] * struck[HEEL] - a[HEEL][HEEL] * struck[TOE]) / det;
        velocity[SLIP] = struck[SLIP] + a[SLIP][HEEL] * heel + a[SLIP][TOE] * toe;
        let lies = (velocity, [0.0, heel, toe], [0.0; 2]);
        energy_lost -= energy_gain(&struck, None, &lies).0;
    }
    Impact {
        velocity,
        impulse,
        across,
        energy_lost,
        energy_limited: false,
    }
}

/// Tangential impact that ends a Painlevé paradox: a sliding corner jams, and the impulse that stops its slip lifts
/// nothing and sinks nothing. `None` where the cone of friction does not hold it.
pub(super) fn jam(
    block: &Block,
    before: &Vector,
    sideways: Option<Sideways>,
    touching: [bool; 2],
) -> Option<Impact> {
    let approach = Approach {
        block,
        before,
        sideways,
        touching,
        speed: before[SLIP].abs(),
    };
    [[touching[0], false], [false, touching[1]], touching]
        .into_iter()
        .filter(|pushed| *pushed != [false, false])
        .find_map(|pushed| {
            approach.under(&Assumption {
                pushed,
                friction: Friction::Stick,
                target: &[0.0; 3],
            })
        })
        .map(|after| Impact::of(before, sideways, after, false))
        .filter(|jam| jam.energy_lost > 0.0)
}
