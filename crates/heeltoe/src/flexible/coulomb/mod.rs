//! The contact problem of one step: find the impulses `p` for which
//!
//! ```text
//! u = G p + b
//! 0 <= u_n + h   perpendicular to   p_n >= 0                         (Signorini)
//! u_t = 0 and |p_t| <= mu p_n,  or  p_t = -mu p_n sign(u_t)          (Coulomb)
//! ```
//!
//! with `mu p_n + c` for `mu p_n` where a law adds a constant.
//!
//! at all contacts at once. In two dimensions each contact is open, sticking, or slipping one way; the right set of
//! these states turns the problem into a linear one. The set of the last step is tried first, contacts that break
//! their conditions change state, and the factors of the last few sets are kept as long as what `G` has for them. So `G`
//! itself is wanted among closed contacts only; what else is said of `u` is for the faces to tell.

pub(super) mod disc;
mod factors;
mod inverse;
mod linear;
mod past;
mod problem;
mod sweep;
mod tableau;
mod triangles;

pub(super) use self::problem::{ContactOperator, Known, Problem};

use self::factors::{factor, Kept};
use self::inverse::Inverse;
use self::linear::{settle, Linear};
use self::past::Past;
use super::simd::{largest, Lanes};
use super::status::Status;

/// How a solution was found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Report {
    /// Sets of states tried.
    pub iterations: u32,
    /// Whether the sweeps had to help.
    pub swept: bool,
    /// Largest violation of the conditions, as an impulse, over the impulse that would stop the fastest node, or the
    /// largest impulse if that is more.
    pub residual: f64,
}

impl Report {
    /// Count another solution of the same step.
    #[inline(always)]
    pub(super) fn go_on(&mut self, found: Report) {
        self.iterations += found.iterations;
        self.swept |= found.swept;
        self.residual = found.residual;
    }
}

/// How wrong contacts change before sweeping, and how many sets are tried so: whether the worst alone changes, and whether
/// one that closes slips the way it moves. Sticking it may be torn off where slipping it is not; then it opens and closes
/// by turns.
const CHANGES: [(bool, bool, u32); 4] = [
    (false, false, 12),
    (true, false, 60),
    (false, true, 12),
    (true, true, 400),
];
/// What counts as a violation, relative to the largest term: well above rounding, far below what matters.
const SLACK: f64 = 1e-11;

/// What rounding may leave where corrections do no better.
const ROUNDED: f64 = 1e-11;
/// From so many contacts on an inverse that goes from set to set costs less than factors.
pub(super) const MANY: usize = 16;

/// Sweeps in turn with the same states after which they are looked at for the first time; each look in vain doubles them.
const SETTLED: u32 = 16;

/// How far the sweeps of a step have come.
struct Sweeps {
    count: u32,
    /// In turn with the same states, and after how many of these to look.
    same: u32,
    look: u32,
}

impl Default for Sweeps {
    fn default() -> Self {
        Sweeps {
            count: 0,
            same: 0,
            look: SETTLED,
        }
    }
}

/// State of the contacts and the factors that belong to it.
#[derive(Default)]
pub(super) struct Solver {
    pub status: Vec<Status>,
    /// Solution, ordered like `b`.
    pub p: Vec<f64>,
    /// Velocities of the solution.
    pub u: Vec<f64>,
    factors: Kept,
    /// Where there are many contacts, in place of factors.
    inverse: Option<Inverse>,
    /// Whether factors last although contacts have moved a little, and what they miss is corrected: a node that slips moves
    /// in every step, and where there are several cracks the factors of all are large.
    pub lasting: bool,
    /// Whether all changes are tried before sweeping. In a step sweeps go on from the impulses of the one before, to the
    /// solution next to them where friction allows several; where there is none before they may not come to an end.
    pub thorough: bool,
    /// A set met before, to know a circle by.
    mark: Vec<Status>,
    /// What the next solution may begin with.
    past: Past,
}

impl Solver {
    pub(super) fn new(contacts: usize) -> Self {
        Solver {
            status: vec![Status::Stick; contacts],
            p: vec![0.0; 2 * contacts],
            u: vec![0.0; 2 * contacts],
            ..Default::default()
        }
    }

    /// One whose inverse goes from set to set. That costs less than factors where there are many contacts whose friction
    /// does not change.
    pub(super) fn with_inverse(contacts: usize) -> Self {
        Solver {
            inverse: Some(Inverse::new(contacts)),
            ..Solver::new(contacts)
        }
    }

    /// Forget the factors where they contain a contact that has moved, because its part of `G` is another one; lasting ones
    /// grow old.
    pub(super) fn forget(&mut self, moved: &[bool]) {
        // An inverse is always corrected.
        self.factors.forget(moved, self.lasting);
    }

    /// Take these impulses, at which nothing moves, for the solution of a step.
    pub(super) fn hold(&mut self, impulses: impl Iterator<Item = f64>) {
        self.p.iter_mut().zip(impulses).for_each(|(p, held)| *p = held);
        self.u.fill(0.0);
        self.past.forget();
    }

    /// Solve, starting from the states of the last time; `Absent` ones must have been set by the caller.
    pub(super) fn solve<W: Lanes>(
        &mut self,
        problem: &mut Problem,
        crack: &mut impl ContactOperator,
    ) -> Report {
        let mut report = Report::default();
        let mut found = false;
        let thorough = self.thorough;
        let mut changes = CHANGES.iter().filter(|(_, slips, _)| thorough || !slips);
        let mut sweeps = Sweeps::default();
        let (mut p, mut status) = (Vec::new(), Vec::new());
        while !found {
            let (worst_only, slips, most) = match changes.next() {
                Some(change) => *change,
                None => {
                    if !report.swept {
                        self.past.forget();
                        let status = &self.status;
                        crack.fill(problem, |contact| status[contact] != Status::Absent);
                        report.swept = true;
                    }
                    if self.sweep(problem, &mut sweeps) {
                        break;
                    }
                    p.clone_from(&self.p);
                    status.clone_from(&self.status);
                    (false, false, 1)
                }
            };
            found = self.search::<W>(problem, crack, (worst_only, slips), most, &mut report);
            if report.swept && !found {
                self.p.clone_from(&p);
                self.status.clone_from(&status);
            }
        }
        if self.clip() || !found {
            crack.velocities::<W>(problem, &self.p, &mut self.u);
        }
        report.residual = self.residual(problem);
        report
    }

    /// Go from set to set; false where none is right of so many, or they come round in a circle.
    fn search<W: Lanes>(
        &mut self,
        problem: &mut Problem,
        crack: &mut impl ContactOperator,
        change: (bool, bool),
        most: u32,
        report: &mut Report,
    ) -> bool {
        self.mark.clear();
        for trial in 1..=most {
            report.iterations += 1;
            if !self.impulses::<W>(problem, crack) {
                return false;
            }
            if !self.amend(problem, change) {
                return true;
            }
            if self.status == self.mark {
                return false;
            }
            if trial.is_power_of_two() {
                self.mark.clone_from(&self.status);
            }
        }
        false
    }

    /// Find the impulses of the set of states and the velocities they make; false where the set has none.
    fn impulses<W: Lanes>(&mut self, problem: &mut Problem, crack: &mut impl ContactOperator) -> bool {
        if self.follow::<W>(problem, crack) {
            return true;
        }
        // With the same set the last solutions go on, as in `follow`; what lasts is corrected anyway.
        let goes_on = self.inverse.is_none() && self.past.known() && self.factors.last_for(&self.status);
        let known = self.inverse.is_none() && self.factors.turn_to(&self.status);
        if known {
            let factors = self.factors.now();
            if factors.old() && goes_on {
                self.past.go_on(&problem.b, &mut self.p, &mut self.u);
                factors.amiss(&self.u, &problem.h);
                factors.add::<W>(problem, &mut self.p);
            } else {
                self.past.forget();
                factors.solve::<W>(problem, &mut self.p);
            }
            crack.velocities::<W>(problem, &self.p, &mut self.u);
            if !factors.old() || settle::<W>(factors, problem, crack, &mut self.p, &mut self.u, 0.0) {
                self.keep(problem);
                return true;
            }
        }
        self.past.forget();
        let status = &self.status;
        crack.fill(problem, |contact| status[contact].closed());
        let factors = self.factors.now();
        if !factor::<W>(factors, problem, status) {
            return false;
        }
        factors.solve::<W>(problem, &mut self.p);
        crack.velocities::<W>(problem, &self.p, &mut self.u);
        self.keep(problem);
        true
    }

    /// Keep what the solution is for, where the next one may begin with it.
    #[inline(always)]
    fn keep(&mut self, problem: &Problem) {
        if self.lasting {
            self.past.keep(&problem.b);
        }
    }

    /// Let the inverse follow the set of states, and find the impulses with it; false where there is none, or it leaves too
    /// much.
    fn follow<W: Lanes>(&mut self, problem: &mut Problem, crack: &mut impl ContactOperator) -> bool {
        let status = &self.status;
        let Some(inverse) = &mut self.inverse else {
            return false;
        };
        let mut anew = inverse.far_from(status);
        // With the same set the last solution goes on: what is left to correct is little.
        let mut goes_on = !anew && self.past.known() && inverse.changed(status).next().is_none();
        loop {
            if anew {
                crack.fill(problem, |contact| status[contact].closed());
                inverse.clear();
            } else {
                let closes = |contact: &usize| status[*contact].closed();
                for contact in inverse.changed(status).filter(closes) {
                    crack.fill_row(problem, contact, |other| status[other].closed());
                }
            }
            if inverse.turn_to::<W>(problem, status) {
                if goes_on {
                    self.past.go_on(&problem.b, &mut self.p, &mut self.u);
                } else {
                    self.past.forget();
                    self.u.copy_from_slice(&problem.b);
                    self.p.fill(0.0);
                }
                inverse.amiss(&self.u, &problem.h);
                inverse.add::<W>(problem, &mut self.p);
                crack.velocities::<W>(problem, &self.p, &mut self.u);
                self.past.keep(&problem.b);
                if settle::<W>(inverse, problem, crack, &mut self.p, &mut self.u, ROUNDED) {
                    return true;
                }
            }
            if anew {
                return false;
            }
            (anew, goes_on) = (true, false);
        }
    }

    /// Change the state of the contacts that break their conditions, all or the worst; false where none does.
    fn amend(&mut self, problem: &Problem, (worst_only, slips): (bool, bool)) -> bool {
        let m = self.status.len();
        let (slack_u, slack_p) = (SLACK * largest(&problem.b), SLACK * largest(&self.p));
        let mut worst = (0.0, usize::MAX, Status::Open);
        let mut changed = false;
        for contact in 0..m {
            let (u_t, u_n) = (self.u[contact], self.u[m + contact] + problem.h[contact]);
            let (p_t, p_n) = (self.p[contact], self.p[m + contact]);
            let status = self.status[contact];
            let scale = problem.scale[m + contact];
            let limit = problem.mu_stick[contact] * p_n + problem.added(contact, false, p_t);
            let (violation, next) = match status {
                Status::Open if u_n < -slack_u => {
                    let way = match slips {
                        true if u_t > 0.0 => Status::SlipDownstream,
                        true => Status::SlipUpstream,
                        false => Status::Stick,
                    };
                    (-u_n, way)
                }
                Status::Stick | Status::SlipDownstream | Status::SlipUpstream if p_n < -slack_p => {
                    (-p_n / scale, Status::Open)
                }
                Status::Stick if p_t.abs() > limit.max(0.0) + slack_p => {
                    let way = if p_t > 0.0 {
                        Status::SlipUpstream
                    } else {
                        Status::SlipDownstream
                    };
                    ((p_t.abs() - limit) / scale, way)
                }
                Status::SlipDownstream if u_t < -slack_u => (-u_t, Status::Stick),
                Status::SlipUpstream if u_t > slack_u => (u_t, Status::Stick),
                _ => continue,
            };
            changed = true;
            if !worst_only {
                self.status[contact] = next;
            } else if violation > worst.0 {
                worst = (violation, contact, next);
            }
        }
        if worst_only && worst.1 != usize::MAX {
            self.status[worst.1] = worst.2;
        }
        changed
    }

    /// Take rounding off the solution; false where there was none.
    fn clip(&mut self) -> bool {
        let m = self.status.len();
        let pulls = self.p[m..].iter().any(|p| *p < 0.0);
        if pulls {
            self.p[m..].iter_mut().for_each(|p| *p = p.max(0.0));
        }
        pulls
    }

    /// By what impulse a contact breaks its conditions.
    pub(super) fn violation(&self, problem: &Problem, contact: usize) -> f64 {
        let m = self.status.len();
        let (p_t, p_n) = (self.p[contact], self.p[m + contact]);
        let (scale_t, scale_n) = (problem.scale[contact], problem.scale[m + contact]);
        // The natural map: zero exactly where the conditions hold.
        let across = p_n
            .min((self.u[m + contact] + problem.h[contact]) * scale_n)
            .abs();
        let sticks = self.status[contact] == Status::Stick;
        let mu = if sticks {
            problem.mu_stick[contact]
        } else {
            problem.mu_slip[contact]
        };
        let limit = |along| p_n * mu + problem.added(contact, !sticks, along);
        let along = p_t
            - (p_t - self.u[contact] * scale_t)
                .max(-limit(-1.0))
                .min(limit(1.0));
        across.max(along.abs())
    }

    /// Residual of the solution. Nothing is known or felt of an absent contact, so that it adds nothing.
    fn residual(&self, problem: &Problem) -> f64 {
        let m = self.status.len();
        let (b_t, b_n) = problem.b.split_at(m);
        let (scale_t, scale_n) = problem.scale.split_at(m);
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for (k, p_n) in self.p[m..].iter().enumerate() {
            let stops = (b_t[k].abs() * scale_t[k]).max(b_n[k].abs() * scale_n[k]);
            largest = largest.max(p_n.max(stops));
            worst = worst.max(self.violation(problem, k));
        }
        if largest > 0.0 {
            worst / largest
        } else {
            0.0
        }
    }
}
