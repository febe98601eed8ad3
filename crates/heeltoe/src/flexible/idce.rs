//! The penalty method of Zhu (2004), chapter VI, for comparison: incremental displacement constraints with Newmark.
//!
//! For each mode, with the ground's acceleration at the ends of the steps,
//!
//! ```text
//! a' = f - gamma_x a_x' - gamma_z a_z' - omega^2 q' + shapes^T F',      v' = v + h ((1 - gamma) a + gamma a') - c d
//! (1 + c gamma h + omega^2 beta h^2) d = h v + h^2 ((1/2 - beta) a + beta (a' + omega^2 d)),      q' = q + d
//! ```
//!
//! which is Newmark's scheme where `gamma` = 1/2 and `beta` = 1/4, and elsewhere has his factor before `d`, the way of
//! the step. The damping is that of the mean velocity `d / h`, and no part of the acceleration `a`, because it changes
//! with the state of the crack: an acceleration that remembers the damping of the step before throws the fast
//! vibrations, which are nearly all damping, and one that is corrected for the change throws them further.
//!
//! A spring of stiffness `alpha` stands at every contact that is closed: `F_n' = -alpha g'` across the crack,
//! `F_t' = F_t - alpha (increment of the slip)` along it while it sticks, `|F_t'| = mu F_n'` while it slips.
//! Eliminating the modes leaves
//!
//! ```text
//! u = (B W B^T + 1/alpha) F' + b,   b_n = gap without contact,   b_t = slip increment without contact - F_t / alpha
//! ```
//!
//! with the same conditions on `u` and `F'` as in [`super::coulomb`], whose changes of state are the iteration within a
//! step. Nothing here bounds the energy: with average acceleration contact makes some at every blow, and the ledger
//! shows it.

use super::compliance::Compliance;
use super::coulomb::Known;
use super::coupling::Crack;
use super::dam::{Dam, Shaking, Wanted};
use super::faces::Faces;
use super::ledger::Ledger;
use super::newmark::{Before, NewmarkStepper};
use super::result::Run;
use super::scheme::Penalty;
use super::simd::Plain;
use super::status::Status;
use super::summary::Outcome;
use super::walk::Walk;

/// Contact that has made so much of all the energy that the dam has lost by honest means has driven it; sound runs stay
/// below a third. The turnover alone is no measure, as it grows with what is made, but where nothing is lost the second
/// share, which is of the turnover, counts.
const BLOWN_UP: [f64; 2] = [0.5, 0.05];

/// Shake the dam.
pub(super) fn simulate(dam: &Dam, shaking: &Shaking, penalty: &Penalty, wanted: Wanted) -> Run {
    let Shaking {
        ground, dt, scale, ..
    } = shaking;
    let mut newmark = Newmark::new(dam, shaking, penalty, wanted);
    if newmark.walk.observed() {
        newmark.keep();
    }
    newmark.follow();
    newmark.stress();
    for (step, ends) in ground.windows(2).enumerate() {
        let ends = [ends[0], ends[1]].map(|a| [scale[0] * a[0], scale[1] * a[1]]);
        newmark.step(ends);
        let position = |crack| Faces::around(crack, &newmark.bodies, |body| &body.position);
        newmark.walk.book(step, position, 1.0);
        newmark.damping = usize::from(!newmark.walk.crack.solver.status.contains(&Status::Stick));
        if newmark.walk.observed() {
            let impulse = |body: &NewmarkStepper| body.force.iter().map(|f| f * dt).collect();
            let impulses: Vec<Vec<f64>> = newmark.bodies.iter().map(impulse).collect();
            let around = |crack| Faces::around(crack, &impulses, |impulse| impulse);
            newmark.walk.gather(around, &[], *dt);
        }
        newmark.follow();
        if newmark.walk.due(step) {
            newmark.balance();
            newmark.keep();
        }
        if newmark.walk.stressed(step) {
            newmark.stress();
        }
        if newmark.walk.ends(step) {
            break;
        }
    }
    newmark.balance();
    if newmark.walk.pending() {
        newmark.keep();
    }
    newmark.end()
}

/// The dam on its way.
struct Newmark<'a> {
    walk: Walk<'a>,
    bodies: Vec<NewmarkStepper<'a>>,
    ledger: Ledger,
    /// State of damping.
    damping: usize,
    penalty: &'a Penalty,
    dt: f64,
}

impl<'a> Newmark<'a> {
    fn new(dam: &'a Dam, shaking: &Shaking, penalty: &'a Penalty, wanted: Wanted<'a>) -> Self {
        let dt = shaking.dt;
        let bodies: Vec<_> = dam
            .bodies
            .iter()
            .map(|body| NewmarkStepper::new(body, penalty, dt))
            .collect();
        let start = energy(&bodies);
        Newmark {
            walk: Walk::new(dam, shaking, wanted, |crack| {
                Faces::around(crack, &dam.bodies, |body| &body.position)
            }),
            bodies,
            ledger: Ledger {
                start,
                stored: start,
                ..Ledger::default()
            },
            damping: 0,
            penalty,
            dt,
        }
    }

    /// Take a step with the ground's accelerations at its ends.
    fn step(&mut self, ends: [[f64; 2]; 2]) {
        let (penalty, damping, dt) = (self.penalty, self.damping, self.dt);
        let mut before: Vec<Before> = Vec::new();
        for body in &mut self.bodies {
            before.push(body.go_on(ends, damping, penalty, dt));
        }
        self.set_up();
        let crack = &mut self.walk.crack;
        let held = spring_energy(crack, penalty.stiffness);
        let report = crack.solver.solve::<Plain>(&mut crack.problem, &mut Known);
        self.walk.steps.note(report);
        let crack = &self.walk.crack;
        crack.impulses(&mut self.bodies, |body| &mut body.force);
        let mut work = [0.0; 2];
        for (k, (body, before)) in self.bodies.iter_mut().zip(&before).enumerate() {
            let own = body.correct(before, damping, penalty, dt, &mut self.ledger);
            work = if k == 0 {
                own
            } else {
                [work[0] + own[0], work[1] + own[1]]
            };
        }
        // What the springs take up is not lost: along the crack it is no friction, across it no impact.
        let holds = spring_energy(&self.walk.crack, penalty.stiffness);
        let made = [0, 1].map(|d| work[d] + holds[d] - held[d]);
        let ledger = &mut self.ledger;
        ledger.penalty = holds[0] + holds[1];
        ledger.friction -= made[0];
        ledger.impact -= made[1];
        ledger.gained += (made[0] + made[1]).max(0.0);
        ledger.turnover += work[0].abs() + work[1].abs();
        // It knows one crack alone.
        self.walk.cracks[0].summary.lost = [ledger.friction, ledger.impact];
    }

    /// Write the contact problem, on where the nodes were and where they would be without contact.
    fn set_up(&mut self) {
        let (bodies, damping, dt) = (&self.bodies, self.damping, self.dt);
        let stiffness = self.penalty.stiffness;
        let answers = |part: usize| {
            let body = bodies.get(part)?;
            Some(Compliance {
                w: &body.w[damping],
                nodes: body.body.nodes,
                stride: body.body.stride(),
            })
        };
        let old = |crack| Faces::around(crack, bodies, |body| &body.position);
        let crack = &mut self.walk.crack;
        crack.meet(old, damping, answers);
        crack.fill(answers, 1.0 / stiffness);
        let free = |crack| Faces::around(crack, bodies, |body| &body.free);
        crack.contacts.relative(free, &mut crack.problem.b);
        crack.contacts.relative(old, &mut crack.before);
        let m = crack.contacts.len();
        for (k, before) in crack.before.iter_mut().enumerate() {
            let free = crack.problem.b[k];
            if k < m {
                crack.problem.b[k] = free - *before - crack.solver.p[k] / stiffness;
            }
            *before = (free - *before) / dt;
        }
        crack.set_up();
    }

    /// All that nothing else explains is the scheme's own; so this ledger always closes.
    fn balance(&mut self) {
        self.ledger.stored = energy(&self.bodies);
        self.ledger.numerical = self.ledger.unexplained();
    }

    /// Follow the point that is wanted.
    fn follow(&mut self) {
        if let Some(track) = &mut self.walk.track {
            track.add::<Plain>(&self.bodies[0].q);
        }
    }

    /// Look at the stresses.
    fn stress(&mut self) {
        let modes: Vec<_> = self.bodies.iter().map(|body| body.q.clone()).collect();
        self.walk.stress::<Plain>(&modes);
    }

    /// Keep a frame.
    fn keep(&mut self) {
        let position = |crack| Faces::around(crack, &self.bodies, |body| &body.position);
        let modes: Vec<_> = self.bodies.iter().map(|body| body.q.clone()).collect();
        self.walk.keep(position, &modes, &[], &self.ledger);
    }

    /// Hand over what there is to tell; a run that contact has driven has blown up.
    fn end(mut self) -> Run {
        let ledger = self.ledger;
        let lost = ledger.input + ledger.start - ledger.stored - ledger.penalty;
        let sound = ledger.gained <= (BLOWN_UP[0] * lost).max(BLOWN_UP[1] * ledger.turnover);
        if !(sound && ledger.stored.is_finite() && self.walk.cracks[0].summary.slip.is_finite()) {
            self.walk.steps.outcome = Outcome::BlownUp;
        }
        self.walk.end(ledger, Vec::new(), |_| Vec::new())
    }
}

/// Energy in the springs of all closed contacts, along and across the crack.
fn spring_energy(crack: &Crack, penalty: f64) -> [f64; 2] {
    let (along, across) = crack.solver.p.split_at(crack.contacts.len());
    [along, across].map(|forces| forces.iter().map(|force| force * force).sum::<f64>() / (2.0 * penalty))
}

fn energy(bodies: &[NewmarkStepper]) -> f64 {
    let of = |body: &NewmarkStepper| body.body.energy(&body.q, &body.v);
    bodies.iter().map(of).sum()
}
