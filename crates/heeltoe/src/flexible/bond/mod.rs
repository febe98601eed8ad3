//! Joints that are bonded: intact, softening, broken.
//!
//! Each node with the share `a` of its crack's length has the damage
//!
//! ```text
//! lambda = max over time of sqrt((w / w_f)^2 + (s / s_f)^2),    w_f = G_f / (A f_t),    s_f = G_II / (A c)
//! ```
//!
//! of its opening `w` and the path `s` of its slip, and bears beside contact the tension `T` and the cohesion `C`
//!
//! ```text
//! T = a (f_t phi - k (w_max - w)) >= 0,      C = a c phi,      p_n >= -T,   |p_t| <= C + mu p_n
//! ```
//!
//! where `phi` falls from 1 to 0 over `lambda`: in one line, `1 - lambda` with the area `A = 1/2`, or in two lines that
//! meet at a quarter of the strength, see [`super::crack_line::BondLaw::first`];
//! intact at `lambda = 0`, broken from `lambda = 1` on; nothing heals. Opening breaks the bond by `G_f` for each square
//! metre, slip by `G_II` beside friction, which acts throughout. `k` leads back to the origin when the node closes,
//! `f_t phi / w_max`, but is no stiffer than the step can follow. The bond's part of the shear changes
//! elastically within `C - mu T`, by as stiff a spring, beside the friction `mu (p_n + T)`: so a node that opens loses
//! no shear at once, and contact has a solution. In the search for rest the bond holds its share of the shear without such a
//! give: that of the joint before anything opens, then what it was found to bear.
//!
//! Where the ground shakes across the valley, too, slip and shear are vectors in the plane of the crack: the bond's part
//! of the shear is within a circle of the radius `C - mu T`, and `s` is the path of the vector.
//!
//! In a step of dt, contact is solved for what is left of `p` without the bond, whose conditions are those of a crack.
//! `T` and `C` are means of the start and the end of the step, found by [`passes`]: so the work of a bond that breaks is
//! `a G_f`, whatever the step.

mod passes;

use super::coulomb::{ContactOperator, Known, Problem, Report, Solver};
use super::crack_line::Line;
use super::law::sideways::Sideways;
use super::scheme::TimeStep;
use super::simd::Lanes;
use super::status::Status;

/// Share of the change of a pass that the spring of a node which closes may hand on to the next.
const FOLLOWED: f64 = 0.1;
/// So many times their strengths tie joints before the search for rest.
const TIED: f64 = 1e6;
/// Less damage is rounding.
const LEAST: f64 = 1e-9;

/// The bond of one contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bond {
    contact: usize,
    /// Length of the crack that is its own, and how much of the crack lies before it (m).
    length: f64,
    place: f64,
    /// Tension and cohesion that it bears intact (N), and way over which either is lost (m).
    strength: [f64; 2],
    reach: [f64; 2],
    /// Damage and share of the strength where two lines of softening meet; the end of one.
    knee: [f64; 2],
    damage: f64,
    /// Way of its slip and its largest gap so far (m).
    path: f64,
    widest: f64,
    /// Shear (N), along the crack and across the valley, and gap as the step begins.
    shear: [f64; 2],
    gap: f64,
    /// Coefficient of friction while it slips.
    friction: f64,
    /// Stiffest springs (N/m) across and along that the step follows.
    stiffest: [f64; 2],
    /// Energy (J) that it may give back as the step begins.
    held: f64,
    /// After the step, if this is the last pass.
    next: After,
    /// Mean tension, shear strength beside friction, and both shears of the step (N).
    mean: [f64; 4],
    /// Whether a closed node bears its cohesion as a limit, in the search for rest.
    rigid: bool,
}

/// What a bond is after a step.
#[derive(Clone, Copy, Debug, Default)]
struct After {
    damage: f64,
    path: f64,
    widest: f64,
    gap: f64,
    shear: [f64; 2],
}

/// Length of a vector in the plane of a crack; one along the crack has that of its component to the last bit.
#[inline(always)]
fn size([along, across]: [f64; 2]) -> f64 {
    if across == 0.0 {
        along.abs()
    } else {
        along.hypot(across)
    }
}

/// The vector shortened to a limit.
#[inline(always)]
fn within([along, across]: [f64; 2], limit: f64) -> [f64; 2] {
    if across == 0.0 {
        return [along.clamp(-limit, limit), 0.0];
    }
    let size = along.hypot(across);
    let share = if size > limit { limit / size } else { 1.0 };
    [share * along, share * across]
}

impl Bond {
    /// Share of the strengths that is left.
    #[inline(always)]
    fn left(&self, damage: f64) -> f64 {
        let [place, share] = self.knee;
        if damage <= place {
            1.0 - damage * ((1.0 - share) / place)
        } else {
            share * (1.0 - damage) / (1.0 - place)
        }
    }

    /// Tension (N) at a gap, and the shear beside friction that goes with it; `widest` is the largest gap so far.
    #[inline(always)]
    fn bears(&self, damage: f64, gap: f64, widest: f64) -> [f64; 2] {
        let [tension, cohesion] = self.strength;
        let share = self.left(damage);
        let left = tension * share;
        let back = if self.stiffest[0] * widest > left {
            left / widest
        } else {
            self.stiffest[0]
        };
        let tension = (left - back * (widest - gap).max(0.0)).max(0.0);
        [tension, (cohesion * share - self.friction * tension).max(0.0)]
    }

    /// What it bears as the step begins.
    pub(super) fn now(&self) -> [f64; 2] {
        self.bears(self.damage, self.gap, self.widest)
    }

    /// Follow the motion of a step: `ways` along the crack, across its faces and across the valley, and the shear of
    /// contact and bond.
    fn follow(&mut self, status: Status, [along, apart, across]: [f64; 3], shear: [f64; 2]) {
        let mut next = After {
            damage: self.damage,
            path: self.path,
            widest: self.widest,
            gap: 0.0,
            shear,
        };
        let before = self.now();
        match status {
            Status::Absent => next.damage = 1.0,
            Status::Open => {
                next.gap = (self.gap + apart).max(0.0);
                next.widest = next.widest.max(next.gap);
            }
            _ if self.rigid && status.slips() => next.path += along.abs(),
            _ => {}
        }
        let open = status == Status::Open;
        // One that comes to stick in the step has moved in it.
        if open || (status.closed() && !self.rigid) {
            let spring = self.stiffest[1];
            next.shear = [self.shear[0] - spring * along, self.shear[1] - spring * across];
            next.path += (size(next.shear) - before[1]).max(0.0) / spring;
        }
        if next.damage < 1.0 {
            let worn = (next.widest / self.reach[0]).hypot(next.path / self.reach[1]);
            next.damage = next.damage.max(worn.min(1.0));
        }
        let after = self.bears(next.damage, next.gap, next.widest);
        next.shear = within(next.shear, after[1]);
        self.mean = [
            0.5 * (before[0] + after[0]),
            0.5 * (before[1] + after[1]),
            0.5 * (self.shear[0] + next.shear[0]),
            0.5 * (self.shear[1] + next.shear[1]),
        ];
        self.next = next;
    }

    /// Energy (J) that it may give back after the step: that of its two springs.
    fn may_give_back(&self) -> f64 {
        let After {
            damage,
            widest,
            gap,
            shear,
            ..
        } = self.next;
        let [closed, open] = [0.0, gap].map(|gap| self.bears(damage, gap, widest)[0]);
        let squared = shear[0] * shear[0] + shear[1] * shear[1];
        0.5 * (gap * (closed + open) + squared / self.stiffest[1])
    }

    /// Take over what has been found.
    fn settle(&mut self) {
        let After {
            damage,
            path,
            widest,
            gap,
            shear,
        } = self.next;
        (self.damage, self.path, self.widest) = (damage, path, widest);
        (self.gap, self.shear) = (gap, shear);
    }
}

/// What has become of the bond of one crack.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cracked {
    /// Work (J) that the bond has taken.
    pub energy: f64,
    /// When the first node broke (s), and where: distance from the heel (m); -1 where none has.
    pub first: [f64; 2],
    /// When no node was intact or softening any more (s); -1 before.
    pub through: f64,
    /// Length broken from the heel and from the toe, all that is broken, and all that softens (m).
    pub lengths: [f64; 4],
}

impl Cracked {
    /// Nothing has happened to it.
    pub(super) const NONE: Cracked = Cracked {
        energy: 0.0,
        first: [-1.0; 2],
        through: -1.0,
        lengths: [0.0; 4],
    };
}

/// All bonds.
#[derive(Clone, Debug, Default)]
pub(super) struct Bonds {
    /// Those of each crack, from heel to toe.
    cracks: Vec<Vec<Bond>>,
    pub cracked: Vec<Cracked>,
    /// Impulses of the bonds on each component; those that the last solution was found with, and what they do to the
    /// velocities: intact bonds bear the same from step to step.
    shift: Vec<f64>,
    pushed: Vec<f64>,
    push: Vec<f64>,
    /// Room for velocities and impulses.
    own: Vec<f64>,
    sum: Vec<f64>,
    /// The same across the valley: impulses of the bonds, what the last ones do, and velocities without them.
    shift_across: Vec<f64>,
    push_across: Vec<f64>,
    own_across: Vec<f64>,
    /// Work that they have taken in the step from each component of each contact, and across the valley.
    pub taken: Vec<f64>,
    pub taken_across: Vec<f64>,
    /// Energy (J) that they have given in the step beyond what they held; they ought to give none.
    pub made: f64,
    /// Damage of each contact, 1 where it has no bond.
    pub damage: Vec<f64>,
    passes: u32,
    /// Whether the joints are still tied, at the start of the search for rest.
    tied: bool,
}

impl Bonds {
    /// None where no crack is bonded. Each crack's contacts have a share of its length (m), and are there from the
    /// beginning or in place of others; `shaken` says whether the dynamic strengths are asked for.
    pub(super) fn new(lines: &[Line], shares: &[Vec<(f64, bool)>], shaken: bool) -> Option<Self> {
        if !lines.iter().any(Line::bonded) {
            return None;
        }
        let mut first = 0;
        let mut cracks = Vec::new();
        for (line, shares) in lines.iter().zip(shares) {
            let mut bonds = Vec::new();
            if let Some(law) = line.bond.filter(|_| line.bonded()) {
                let factor = if shaken { law.dynamic } else { 1.0 };
                let strengths = [factor * law.tensile, factor * law.cohesion];
                let mut place = 0.0;
                for (k, &(length, _)) in shares.iter().enumerate().filter(|(_, share)| share.1) {
                    let reach = |k: usize| law.reach(k, strengths[k]);
                    bonds.push(Bond {
                        contact: first + k,
                        length,
                        place: place + 0.5 * length,
                        strength: strengths.map(|strength| length * strength),
                        reach: [reach(0), reach(1)],
                        knee: law.knee(),
                        damage: 0.0,
                        path: 0.0,
                        widest: 0.0,
                        shear: [0.0; 2],
                        gap: 0.0,
                        friction: line.friction[0].max(line.friction[1]),
                        stiffest: [0.0; 2],
                        held: 0.0,
                        next: After::default(),
                        mean: [0.0; 4],
                        rigid: !shaken,
                    });
                    place += length;
                }
            }
            first += shares.len();
            cracks.push(bonds);
        }
        let mut damage = vec![1.0; first];
        cracks
            .iter()
            .flatten()
            .for_each(|bond: &Bond| damage[bond.contact] = 0.0);
        Some(Bonds {
            cracked: vec![Cracked::NONE; cracks.len()],
            damage,
            tied: !shaken,
            shift: vec![0.0; 2 * first],
            pushed: vec![0.0; 2 * first],
            push: vec![0.0; 2 * first],
            own: Vec::new(),
            sum: vec![0.0; 2 * first],
            shift_across: vec![0.0; first],
            push_across: vec![0.0; first],
            own_across: Vec::new(),
            taken: vec![0.0; 2 * first],
            taken_across: vec![0.0; first],
            made: 0.0,
            cracks,
            passes: 0,
        })
    }

    /// Begin with what the bonds of a dam at rest have been through.
    pub(super) fn begin_at(&mut self, still: &Bonds, forces: &[f64]) {
        for (own, still) in self.iter_mut().zip(still.cracks.iter().flatten()) {
            (own.damage, own.path, own.widest, own.gap) = (still.damage, still.path, still.widest, still.gap);
            // What friction alone would not hold.
            let ([tension, limit], m) = (own.now(), forces.len() / 2);
            let rubs = own.friction * (forces[m + own.contact] + tension).max(0.0);
            let shear = forces[own.contact];
            own.shear[0] = (shear - shear.clamp(-rubs, rubs)).clamp(-limit, limit);
        }
        self.look(0.0);
    }

    fn iter_mut(&mut self) -> impl Iterator<Item = &mut Bond> {
        self.cracks.iter_mut().flatten()
    }

    /// Whether a contact that is `pressed` by this force is let go only by more than what its bond bears.
    pub(super) fn holds(&self, contact: usize, pressed: f64) -> bool {
        let mut bonds = self.cracks.iter().flatten();
        bonds.any(|bond| bond.contact == contact && bond.gap == 0.0 && pressed + bond.now()[0] > 0.0)
    }

    /// Begin a step, whose gaps and states are these.
    pub(super) fn set_up(
        &mut self,
        problem: &mut Problem,
        solver: &Solver,
        gaps: &[f64],
        sideways: Sideways,
        step: TimeStep,
    ) {
        if self.iter_mut().any(|bond| bond.rigid) {
            problem.added.resize(solver.status.len(), [0.0; 2]);
            problem.lean.resize(solver.status.len(), 0.0);
        }
        let m = solver.status.len();
        let stiffest = 2.0 * FOLLOWED / (step.theta * step.dt * step.dt);
        for bond in self.cracks.iter_mut().flatten() {
            let k = bond.contact;
            let status = solver.status[k];
            // One spring for all directions of slip.
            let across = sideways.scale.get(k).copied().unwrap_or(f64::INFINITY);
            bond.stiffest = [
                stiffest * problem.scale[m + k],
                stiffest * problem.scale[k].min(across),
            ];
            bond.gap = if status == Status::Open {
                gaps[k].max(0.0)
            } else {
                0.0
            };
            let still = if status.slips() { Status::Stick } else { status };
            bond.follow(still, [0.0; 3], bond.shear);
            if self.tied {
                bond.mean = [TIED * bond.strength[0], TIED * bond.strength[1], 0.0, 0.0];
            }
        }
        self.draw(problem, step.dt, 1.0);
    }

    /// Write what the bonds bear into the problem, and return the largest change of an impulse.
    fn draw(&mut self, problem: &mut Problem, dt: f64, far: f64) -> f64 {
        let m = problem.h.len();
        let mut change = 0.0_f64;
        let Bonds {
            cracks,
            shift,
            shift_across,
            ..
        } = self;
        let mut go = |shift: &mut f64, to: f64| {
            let more = far * (to - *shift);
            change = change.max(more.abs());
            *shift += more;
        };
        for bond in cracks.iter().flatten() {
            let k = bond.contact;
            let [tension, cohesion, shear, across] = bond.mean.map(|force| dt * force);
            go(&mut shift[k], shear);
            go(&mut shift[m + k], -tension);
            go(&mut shift_across[k], across);
            if bond.rigid {
                problem.added[k] = [cohesion; 2];
                problem.lean[k] = shear;
            }
        }
        change
    }

    /// Solve the contact problem in a search for the state of rest, where `G` is known and steps follow each other until
    /// nothing moves.
    pub(super) fn rest<W: Lanes>(
        &mut self,
        problem: &mut Problem,
        solver: &mut Solver,
        step: TimeStep,
    ) -> Report {
        self.own.clone_from(&problem.b);
        Known.velocities::<W>(problem, &self.shift, &mut self.push);
        problem.b.clone_from(&self.push);
        let report = solver.solve::<W>(problem, &mut Known);
        problem.b.clone_from(&self.own);
        solver
            .p
            .iter_mut()
            .zip(&self.shift)
            .for_each(|(p, own)| *p += own);
        let m = solver.status.len();
        for bond in self.iter_mut() {
            let k = bond.contact;
            let [along, apart] = [k, m + k].map(|i| step.dt * solver.u[i]);
            bond.follow(
                solver.status[k],
                [along, apart, 0.0],
                [solver.p[k] / step.dt, 0.0],
            );
        }
        self.tied = false;
        report
    }

    /// Take over where a step of the search for rest has come to.
    pub(super) fn settle(&mut self) {
        self.iter_mut().for_each(Bond::settle);
    }

    /// Book a step that ends at this time.
    pub(super) fn book(
        &mut self,
        problem: &Problem,
        solver: &Solver,
        before: &[f64],
        sideways: Sideways,
        step: TimeStep,
        end: f64,
    ) {
        let m = solver.status.len();
        let mean = |u: f64, before: f64| step.theta * u + (1.0 - step.theta) * before;
        let way = |k: usize| mean(solver.u[k], before[k]);
        self.taken.fill(0.0);
        self.made = 0.0;
        for (bonds, cracked) in self.cracks.iter_mut().zip(&mut self.cracked) {
            for bond in bonds.iter_mut() {
                let k = bond.contact;
                let of = |numbers: &[f64]| numbers.get(k).copied().unwrap_or(0.0);
                let shear = [solver.p[k], of(sideways.p)];
                let shift = [self.shift[k], self.shift_across[k]];
                // Friction is that of pressure. All shear of a node that slips under tension is the bond's; so is the
                // part that the shift adds to the friction of a node that is pressed.
                let sign = solver.status[k].sign();
                let [to, to_across] = towards([shear[0] - shift[0], shear[1] - shift[1]], sign);
                let rubs = problem.mu_slip[k] * self.shift[m + k];
                let [bond_share, across_share] = if solver.p[m + k] < 0.0 {
                    shear
                } else {
                    [shift[0] + rubs * to, shift[1] + rubs * to_across]
                };
                self.taken[k] = -bond_share * way(k);
                self.taken[m + k] = -self.shift[m + k] * way(m + k);
                self.taken_across[k] = -across_share * mean(of(sideways.u), of(sideways.before));
                let taken = self.taken[k] + self.taken[m + k] + self.taken_across[k];
                let held = bond.may_give_back();
                self.made += (held - bond.held - taken).max(0.0);
                bond.held = held;
                cracked.energy += taken;
            }
        }
        self.settle();
        self.look(end);
    }

    /// Look at how far each crack has gone.
    fn look(&mut self, now: f64) {
        for (bonds, cracked) in self.cracks.iter().zip(&mut self.cracked) {
            for bond in bonds {
                self.damage[bond.contact] = bond.damage;
            }
            if bonds.is_empty() {
                continue;
            }
            if cracked.first[0] < 0.0 {
                if let Some(bond) = bonds.iter().find(|bond| bond.damage >= 1.0) {
                    cracked.first = [now, bond.place];
                }
            }
            let broken = |bond: &&Bond| bond.damage >= 1.0;
            let sum = |bonds: &mut dyn Iterator<Item = &Bond>| bonds.fold(0.0, |sum, bond| sum + bond.length);
            cracked.lengths = [
                sum(&mut bonds.iter().take_while(broken)),
                sum(&mut bonds.iter().rev().take_while(broken)),
                sum(&mut bonds.iter().filter(broken)),
                sum(&mut bonds
                    .iter()
                    .filter(|bond| bond.damage > LEAST && bond.damage < 1.0)),
            ];
            if cracked.through < 0.0 && bonds.iter().all(|bond| bond.damage >= 1.0) {
                cracked.through = now;
            }
        }
    }
}

/// Direction against which friction of these impulses along the crack and across the valley acts, of a node that slips
/// along the crack with this sign; none of one that does not slip.
#[inline(always)]
fn towards(friction: [f64; 2], sign: f64) -> [f64; 2] {
    if sign == 0.0 || friction[1] == 0.0 {
        return [sign, 0.0];
    }
    let size = size(friction);
    friction.map(|impulse| -impulse / size)
}
