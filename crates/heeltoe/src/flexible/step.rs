//! The walk through time with exact contact: Moreau-Jean on velocity level.
//!
//! For each mode, with `v* = theta v' + (1 - theta) v`,
//!
//! ```text
//! v' - v = -dt (omega^2 (q + theta dt v*) + c v*) + dt f - gamma dV + shapes^T p,      q' - q = dt v*
//! ```
//!
//! where `dV` is the change of the ground's velocity in the step, exact for any record. Without contact `v' = v_f`;
//! contact adds `D shapes^T p` with `D = 1 / (1 + theta dt c + theta^2 dt^2 omega^2)`. The normal condition
//! `u_n' >= -h` has
//!
//! ```text
//! h = max(g, 0) / dt,   at least (1 - theta) / theta u_n
//! ```
//!
//! (`g` the gap, `u_n` the velocity before): a gap may close but not be passed, and a node that has just left cannot
//! be thrown back so that contact would do positive work. Nothing rebounds at a node: the waves in the concrete do
//! that.

use super::across::Across;
use super::bond::Bonds;
use super::contact_operator::FacesOperator;
use super::coulomb::{Problem, Report, Solver};
use super::crack_forces::CrackForces;
use super::dam::{Dam, Shaking, Wanted};
use super::law::sideways::Sideways;
use super::law::Laws;
use super::ledger::Ledger;
use super::linear::LinearDam;
use super::modal_stepper::Drive;
use super::result::Run;
use super::scheme::TimeStep;
use super::simd::dot;
#[cfg(target_arch = "x86_64")]
use super::simd::x86;
use super::simd::{Lanes, Plain};
use super::status::Status;
use super::still::Still;
use super::track::Track;
use super::walk::Walk;

/// Shake the dam; `theta` is the weight of the new state within a step.
pub(super) fn simulate(dam: &Dam, shaking: &Shaking, theta: f64, wanted: Wanted) -> Run {
    #[cfg(target_arch = "x86_64")]
    {
        // What is compiled apart for these registers runs where the machine has them only.
        let fma = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        if fma && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
            return run::<x86::Avx512>(dam, shaking, theta, wanted);
        }
        if fma {
            return run::<x86::Avx2>(dam, shaking, theta, wanted);
        }
    }
    run::<Plain>(dam, shaking, theta, wanted)
}

fn run<W: Lanes>(dam: &Dam, shaking: &Shaking, theta: f64, wanted: Wanted) -> Run {
    let mut moreau = Moreau::new(dam, shaking, theta, wanted);
    moreau.go_on::<W>(false, 0, 0);
    if moreau.walk.observed() {
        moreau.ledger.stored = moreau.ledger.start;
        let start = moreau.ledger;
        moreau.keep(&start);
    }
    moreau.follow::<W>();
    moreau.stress::<W>();
    moreau.press::<W>();
    for step in 0..shaking.ground.len() {
        moreau.set_up::<W>();
        moreau.contact::<W>();
        moreau
            .walk
            .book(step, |crack| moreau.linear.position(crack), shaking.dt);
        if let Some(across) = &moreau.across {
            moreau.walk.book_across(across);
        }
        if moreau.walk.observed() {
            let cross = moreau.across.as_ref().map_or(&[][..], |across| &across.rows.p);
            moreau
                .walk
                .gather(|crack| moreau.linear.impulse(crack), cross, 1.0);
        }
        let pushed = moreau.acting.is_some() || moreau.still.is_some();
        moreau.linear.join(moreau.quiet, pushed);
        // The modes follow, and begin the next step.
        let sticks = moreau.walk.crack.solver.status.contains(&Status::Stick);
        moreau.go_on::<W>(true, step + 1, usize::from(!sticks));
        moreau.follow::<W>();
        if moreau.walk.due(step) {
            let now = moreau.balance();
            moreau.keep(&now);
        }
        if moreau.walk.stressed(step) {
            moreau.stress::<W>();
        }
        if moreau.walk.pressed(step) {
            moreau.press::<W>();
        }
        if moreau.walk.ends(step) {
            break;
        }
    }
    let ledger = moreau.balance();
    if moreau.walk.pending() {
        moreau.keep(&ledger);
    }
    let acting = moreau.acting;
    let anchors = |crack| {
        acting
            .as_ref()
            .map_or_else(Vec::new, |acting| acting.borne(crack))
    };
    let crest_cross = moreau
        .across
        .and_then(|across| across.track)
        .map_or_else(Vec::new, Track::end);
    moreau.walk.end(ledger, crest_cross, anchors)
}

/// The dam on its way.
struct Moreau<'a> {
    walk: Walk<'a>,
    linear: LinearDam<'a>,
    across: Option<Across<'a>>,
    acting: Option<CrackForces<'a>>,
    still: Option<&'a Still>,
    /// Whether nothing moves the dam in this step.
    quiet: bool,
    ledger: Ledger,
    shaking: &'a Shaking<'a>,
}

impl<'a> Moreau<'a> {
    fn new(dam: &'a Dam, shaking: &'a Shaking, theta: f64, wanted: Wanted<'a>) -> Self {
        let dt = shaking.dt;
        let still = dam.still.as_ref();
        let step = TimeStep { dt, theta };
        let linear = LinearDam::new(&dam.bodies, dam.reservoir.as_ref(), still, step);
        let start = linear.energy();
        let start_at = |crack| linear.position(crack);
        let mut walk = Walk::new(dam, shaking, wanted, start_at);
        if let Some(still) = still {
            walk.crack.solver.status.copy_from_slice(&still.status);
            if let Some(laws) = &mut walk.crack.laws {
                laws.begin_at(&still.worked, &still.contact);
            }
            if let (Some(bonds), Some(still_bonds)) = (&mut walk.crack.bonds, &still.bonds) {
                bonds.begin_at(still_bonds, &still.contact);
            }
        }
        Moreau {
            across: Across::new(dam, shaking.across, walk.crack.contacts.len(), step),
            walk,
            acting: CrackForces::new(&dam.cracks, shaking.rising, start_at),
            still,
            quiet: false,
            ledger: Ledger {
                start,
                ..Ledger::default()
            },
            linear,
            shaking,
        }
    }

    /// Let the modes finish the step `now`, unless this is the start, and begin another with this state of damping.
    fn go_on<W: Lanes>(&mut self, under_way: bool, next: usize, damping: usize) {
        let Shaking {
            ground, dt, scale, ..
        } = self.shaking;
        let a = ground.get(next).copied().unwrap_or([0.0; 2]);
        let drive = Drive {
            ground: [scale[0] * a[0] * dt, scale[1] * a[1] * dt],
            damping,
        };
        self.linear.advance::<W>(under_way, drive);
        if let Some(across) = &mut self.across {
            across.go_on::<W>(under_way, next, scale[0], damping);
        }
    }

    /// Write the contact problem of the step, with what else acts in the crack.
    fn set_up<W: Lanes>(&mut self) {
        let linear = &self.linear;
        let crack = &mut self.walk.crack;
        crack.meet(
            |crack| linear.position(crack),
            linear.damping(),
            |part| linear.answers(part),
        );
        if let Some(acting) = &mut self.acting {
            self.linear.push(acting);
        }
        // A dam that stands under loads that do not change goes on standing, to the last bit.
        let across_rests = self.across.as_ref().is_none_or(Across::rests);
        self.quiet = self.still.is_some() && self.linear.rests() && across_rests;
        if self.quiet {
            if let Some(across) = &mut self.across {
                across.stay(&crack.contacts);
            }
            return;
        }
        self.linear
            .find_free::<W>(self.acting.is_some(), self.still.is_some());
        let TimeStep { dt, theta } = self.linear.step;
        let back = (1.0 - theta) / theta;
        let crack = &mut self.walk.crack;
        let contacts = &crack.contacts;
        contacts.relative(|crack| self.linear.free(crack), &mut crack.problem.b);
        contacts.relative(|crack| self.linear.velocity(crack), &mut crack.before);
        let approach = &crack.before[contacts.len()..];
        for ((h, gap), approach) in crack.problem.h.iter_mut().zip(&contacts.gaps).zip(approach) {
            *h = (gap.max(0.0) / dt).max(back * approach);
        }
        crack.set_up();
        let across = self.across.as_mut();
        let sideways = across.map_or_else(Sideways::default, |across| {
            across.set_up::<W>(&crack.contacts);
            across.sideways()
        });
        crack.bear(self.linear.step, sideways);
    }

    /// Solve the contact problem and move the nodes; the bodies get their impulses, the ledger its works.
    fn contact<W: Lanes>(&mut self) {
        let crack = &mut self.walk.crack;
        let softness = crack.softness(self.walk.dam.softness());
        let (report, softness) = match self.still.filter(|_| self.quiet) {
            Some(still) => {
                let report = crack.hold(&still.contact, self.linear.step.dt);
                self.linear.spread(&crack.contacts, &crack.solver.p);
                // Nothing moves, and nothing yields.
                (report, 0.0)
            }
            None => {
                let step = self.linear.step;
                let mut faces = FacesOperator {
                    contacts: &crack.contacts,
                    blocks: &mut crack.blocks,
                    linear: &mut self.linear,
                    softness,
                };
                let (problem, solver) = (&mut crack.problem, &mut crack.solver);
                let solving = Solving {
                    faces: &mut faces,
                    across: self.across.as_mut(),
                    problem,
                    solver,
                    bonds: crack.bonds.as_mut(),
                    laws: crack.laws.as_mut(),
                    before: &crack.before,
                    moved: &mut crack.moved,
                    step,
                };
                (solving.solve::<W>(), softness)
            }
        };
        self.end_contact::<W>(report, softness);
    }

    /// Book the contact problem as it was solved, and move the nodes.
    fn end_contact<W: Lanes>(&mut self, report: Report, softness: f64) {
        self.walk.steps.note(report);
        self.book_contact(softness);
        let before = self.acted();
        if !self.quiet {
            self.linear.finish::<W>();
        }
        self.book_acted(before);
    }

    /// Book the work of the impulses of contact.
    fn book_contact(&mut self, softness: f64) {
        let theta = self.linear.step.theta;
        self.book_bonds();
        let ledger = &mut self.ledger;
        let crack = &self.walk.crack;
        let m = crack.contacts.len();
        let (p, u) = (&crack.solver.p, &crack.solver.u);
        let mut gained = 0.0;
        for (watch, of) in self.walk.cracks.iter_mut().zip(crack.contacts.of_cracks()) {
            let work = [of.clone(), m + of.start..m + of.end].map(|part| {
                let p = &p[part.clone()];
                let own = if softness > 0.0 { softness * dot(p, p) } else { 0.0 };
                (1.0 - theta) * dot(p, &crack.before[part.clone()]) + theta * (dot(p, &u[part]) - own)
            });
            let bonds = crack.bonds.as_ref();
            let taken = bonds.map(|bonds| {
                [of.clone(), m + of.start..m + of.end].map(|part| bonds.taken[part].iter().sum::<f64>())
            });
            let work = taken.map_or(work, |taken| [work[0] + taken[0], work[1] + taken[1]]);
            if let Some(taken) = taken {
                ledger.fracture += taken[0] + taken[1];
                ledger.turnover += taken[0].abs() + taken[1].abs();
            }
            let across_taken = match (bonds, &self.across) {
                (Some(bonds), Some(_)) => &bonds.taken_across[..],
                _ => &[],
            };
            if let Some(taken) = across_taken.get(of.clone()) {
                let taken = taken.iter().sum::<f64>();
                ledger.fracture += taken;
                ledger.turnover += taken.abs();
            }
            let work = self.across.as_ref().map_or(work, |across| {
                let own = across.works(of, across_taken);
                [work[0] + own[0], work[1] + own[1]]
            });
            for (lost, work) in watch.summary.lost.iter_mut().zip(work) {
                *lost -= work;
            }
            ledger.friction -= work[0];
            ledger.impact -= work[1];
            ledger.turnover += work[0].abs() + work[1].abs();
            gained += work[0] + work[1];
        }
        ledger.gained += gained.max(0.0) + crack.bonds.as_ref().map_or(0.0, |bonds| bonds.made);
    }

    /// Let the bonds be where the step has brought them.
    fn book_bonds(&mut self) {
        let (crack, end) = (
            &mut self.walk.crack,
            self.walk.steps.steps as f64 * self.linear.step.dt,
        );
        if let Some(bonds) = &mut crack.bonds {
            if self.quiet {
                bonds.taken.fill(0.0);
                bonds.taken_across.fill(0.0);
                bonds.made = 0.0;
            } else {
                let across = self.across.as_ref();
                bonds.book(
                    &crack.problem,
                    &crack.solver,
                    &crack.before,
                    across.map_or_else(Sideways::default, Across::sideways),
                    self.linear.step,
                    end,
                );
            }
        }
    }

    /// Work of the impulses of water and anchors on the velocities as they are.
    fn acted(&self) -> [f64; 2] {
        let acting = self.acting.as_ref();
        acting.map_or([0.0; 2], |acting| {
            acting.work(|crack| self.linear.velocity(crack))
        })
    }

    /// Book it, from what it was before the step.
    fn book_acted(&mut self, before: [f64; 2]) {
        let after = self.acted();
        let Some(acting) = &mut self.acting else {
            return;
        };
        let theta = self.linear.step.theta;
        let work = [0, 1].map(|k| (1.0 - theta) * before[k] + theta * after[k]);
        let across = self.across.as_ref();
        let sideways = across.map_or(&[][..], Across::stretched);
        let taken_up = acting.settle(|crack| self.linear.position(crack), sideways);
        let ledger = &mut self.ledger;
        ledger.input += work[0];
        // What the anchors have not taken up of their work is the scheme's doing.
        ledger.numerical -= work[1] + taken_up;
        ledger.springs = acting.stored;
        ledger.turnover += work[0].abs() + work[1].abs();
        if let Some(across) = across {
            across.book_acted(ledger);
        }
    }

    /// Follow the point that is wanted.
    #[inline(always)]
    fn follow<W: Lanes>(&mut self) {
        if let Some(track) = &mut self.walk.track {
            track.add::<W>(self.linear.moved());
        }
        if let Some(across) = &mut self.across {
            across.follow::<W>();
        }
    }

    /// Look at the stresses.
    fn stress<W: Lanes>(&mut self) {
        let total = self.linear.amplitudes();
        self.walk.stress::<W>(&total);
    }

    /// Look at the pressures of the water.
    fn press<W: Lanes>(&mut self) {
        if let Some(water) = self.linear.water_groups() {
            self.walk.press::<W>(water);
        }
    }

    /// Keep a frame.
    fn keep(&mut self, ledger: &Ledger) {
        let linear = &self.linear;
        let total = linear.amplitudes();
        let position = |crack| linear.position(crack);
        self.walk.keep(position, &total, linear.water(), ledger);
    }

    /// The ledger with the sums of all parts and the energy they hold; the sums go on, so that frames change nothing.
    fn balance(&self) -> Ledger {
        let mut ledger = self.ledger;
        self.linear.book(&mut ledger);
        if let Some(across) = &self.across {
            across.balance(&mut ledger);
        }
        ledger
    }
}

/// The contact problem of a step, with the bonds of some cracks and the laws of others.
struct Solving<'s, 'f, 'a> {
    faces: &'s mut FacesOperator<'f, 'a>,
    across: Option<&'s mut Across<'a>>,
    problem: &'s mut Problem,
    solver: &'s mut Solver,
    bonds: Option<&'s mut Bonds>,
    laws: Option<&'s mut Laws>,
    before: &'s [f64],
    moved: &'s mut bool,
    step: TimeStep,
}

impl Solving<'_, '_, '_> {
    fn solve<W: Lanes>(mut self) -> Report {
        let mut report = Report::default();
        loop {
            let (problem, solver) = (&mut *self.problem, &mut *self.solver);
            report.go_on(match (self.across.as_mut(), self.bonds.as_mut()) {
                (across, Some(bonds)) => bonds.solve::<W>(
                    problem,
                    solver,
                    (self.faces, across.map(|across| &mut **across)),
                    self.before,
                    self.step,
                    self.moved,
                ),
                (Some(across), None) => self.faces.solve_across::<W>(problem, solver, across, self.before),
                (None, None) => solver.solve::<W>(problem, self.faces),
            });
            let across = self.across.as_deref();
            let sideways = across.map_or_else(Sideways::default, Across::sideways);
            let met = self
                .laws
                .as_mut()
                .is_none_or(|laws| laws.met(problem, solver, self.before, sideways, self.step, &mut report));
            if met {
                if let Some(across) = &mut self.across {
                    across.finish::<W>(self.faces.contacts);
                }
                return report;
            }
        }
    }
}
