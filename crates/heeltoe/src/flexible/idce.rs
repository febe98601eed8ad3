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

use super::body::{Body, Group, LANES};
use super::contact::relative;
use super::coulomb::Status;
use super::coupling::{Answer, Crack};
use super::dam::{Dam, Options};
use super::frames::{keep, Since, Snapshot};
use super::ledger::Ledger;
use super::observe::{self, Faces, Motion};
use super::result::{Frames, Outcome, Summary};

/// The numbers of the method.
#[derive(Clone, Copy)]
pub struct Idce {
    /// Stiffness of the spring at a contact.
    pub penalty: f64,
    pub gamma: f64,
    pub beta: f64,
}

/// Contact that has made so much of all the energy that the dam has lost by honest means has driven it; sound runs stay
/// below a third. The turnover alone is no measure, as it grows with what is made, but where nothing is lost the second
/// share, which is of the turnover, counts.
const BLOWN_UP: [f64; 2] = [0.5, 0.05];

/// A part of the dam under way.
struct Part<'a> {
    body: &'a Body,
    /// Share of the right-hand side that becomes acceleration, for both states of damping.
    gain: [Vec<Group>; 2],
    /// Answer of the crack nodes to forces on them.
    w: [Vec<f64>; 2],
    q: Vec<Group>,
    v: Vec<Group>,
    a: Vec<Group>,
    /// Position of the crack nodes less what the modes say at the start: nothing, if no modes are left out.
    base: Vec<f64>,
    position: Vec<f64>,
    free: Vec<f64>,
    force: Vec<f64>,
    force_before: Vec<f64>,
}

impl<'a> Part<'a> {
    fn new(body: &'a Body, idce: &Idce, dt: f64) -> Self {
        let gain = [0, 1].map(|state: usize| {
            let pairs = body.damping[state].iter().zip(&body.omega_squared);
            let each = |(c, w): (&Group, &Group)| -> Group {
                std::array::from_fn(|l| 1.0 / (1.0 + idce.gamma * dt * c[l] + idce.beta * dt * dt * w[l]))
            };
            pairs.map(each).collect::<Vec<_>>()
        });
        let w = [0, 1].map(|state: usize| {
            let mut w = body.compliance(&gain[state]);
            w.iter_mut().for_each(|value| *value *= idce.beta * dt * dt);
            w
        });
        let at_start = body.at_crack(&body.start);
        let zeros = vec![0.0; body.columns()];
        Part {
            body,
            gain,
            w,
            q: body.start.clone(),
            v: vec![[0.0; LANES]; body.groups()],
            // The dam has been standing still, held by a crack that was bonded. The springs take over unloaded and give
            // way by force over stiffness, which at stiffnesses of any use is lost in what the release itself does.
            a: vec![[0.0; LANES]; body.groups()],
            base: body.position.iter().zip(&at_start).map(|(x, s)| x - s).collect(),
            position: body.position.clone(),
            free: zeros.clone(),
            force: zeros.clone(),
            force_before: zeros,
        }
    }

    /// Let the modes go on without contact to the end of the step; they keep their new acceleration in `a`, and
    /// return what the ledger needs of the state before.
    fn go_on(&mut self, ground: [[f64; 2]; 2], damping: usize, idce: &Idce, dt: f64) -> Before {
        let before = Before {
            q: self.q.clone(),
            ground,
        };
        let body = self.body;
        for group in 0..body.groups() {
            let (c, w) = (&body.damping[damping][group], &body.omega_squared[group]);
            let gain = &self.gain[damping][group];
            for l in 0..LANES {
                let push = body.load[group][l]
                    - body.participation[0][group][l] * ground[1][0]
                    - body.participation[1][group][l] * ground[1][1];
                let (q, v, a) = (self.q[group][l], self.v[group][l], self.a[group][l]);
                let late = (0.5 - idce.beta) * a + idce.beta * (push - w[l] * q);
                let way = gain[l] * (dt * v + dt * dt * late);
                self.q[group][l] = q + way;
                self.a[group][l] = push - w[l] * (q + way);
                self.v[group][l] =
                    v + dt * ((1.0 - idce.gamma) * a + idce.gamma * self.a[group][l]) - c[l] * way;
            }
        }
        self.free = body.at_crack(&self.q);
        self.free
            .iter_mut()
            .zip(&self.base)
            .for_each(|(x, base)| *x += base);
        before
    }

    /// Add what the forces of contact change, book the work of loads, ground and damping, and return that of contact,
    /// along the crack and across it.
    fn correct(
        &mut self,
        before: &Before,
        damping: usize,
        idce: &Idce,
        dt: f64,
        ledger: &mut Ledger,
    ) -> [f64; 2] {
        let body = self.body;
        let columns = body.columns();
        for (group, shapes) in body.shapes.chunks_exact(columns).enumerate() {
            let mut push = [0.0; LANES];
            for (shape, force) in shapes.iter().zip(&self.force) {
                for l in 0..LANES {
                    push[l] += shape[l] * force;
                }
            }
            for (l, push) in push.iter().enumerate() {
                let (c, w) = (body.damping[damping][group][l], body.omega_squared[group][l]);
                let further = self.gain[damping][group][l] * idce.beta * dt * dt * push;
                let a = push - w * further;
                self.q[group][l] += further;
                self.a[group][l] += a;
                self.v[group][l] += idce.gamma * dt * a - c * further;
                let way = self.q[group][l] - before.q[group][l];
                let ground = [0, 1].map(|d| (before.ground[0][d] + before.ground[1][d]) / 2.0);
                let drive = body.load[group][l]
                    - body.participation[0][group][l] * ground[0]
                    - body.participation[1][group][l] * ground[1];
                ledger.input += drive * way;
                ledger.turnover += (drive * way).abs();
                ledger.damping += c * way * way / dt;
            }
        }
        let mut work = [0.0; 2];
        let answer = multiply(&self.w[damping], &self.force);
        for (k, position) in self.position.iter_mut().enumerate() {
            let new = self.free[k] + answer[k];
            let mean = (self.force[k] + self.force_before[k]) / 2.0;
            work[usize::from(k >= body.nodes)] += mean * (new - *position);
            *position = new;
        }
        self.force_before.copy_from_slice(&self.force);
        work
    }
}

/// Modes of a part before a step, and the ground at both ends of it.
struct Before {
    q: Vec<Group>,
    ground: [[f64; 2]; 2],
}

fn multiply(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; vector.len()];
    for (value, row) in vector.iter().zip(matrix.chunks_exact(vector.len())) {
        if *value != 0.0 {
            product.iter_mut().zip(row).for_each(|(sum, w)| *sum += value * w);
        }
    }
    product
}

/// Shake the dam. `ground` has the horizontal and vertical acceleration at both ends of all steps, one more than steps.
pub fn simulate(
    dam: &Dam,
    ground: &[[f64; 2]],
    options: &Options,
    idce: &Idce,
    mut frames: Option<&mut Frames>,
) -> Summary {
    let dt = options.dt;
    let mut upper = Part::new(&dam.upper, idce, dt);
    let mut lower = dam.lower.as_ref().map(|body| Part::new(body, idce, dt));
    let mut crack = Crack::new(dam);
    let mut summary = Summary::default();
    let start = energy(&upper, lower.as_ref());
    let mut ledger = Ledger {
        start,
        stored: start,
        ..Ledger::default()
    };
    let at_start = faces(&upper, lower.as_ref(), |part| &part.position);
    let zero = observe::mean_along(at_start.upper) - observe::mean_along(at_start.lower);
    let mut motion = Motion::of(at_start, zero);
    let reach = 100.0 * (upper.position[dam.upper.nodes - 1] - upper.position[0]);
    let mut since = Since::new(&dam.upper);
    let scaled = |a: [f64; 2]| [options.scale[0] * a[0], options.scale[1] * a[1]];
    let mut damping = 0;
    if let Some(frames) = &mut frames {
        let now = snapshot(&upper, lower.as_ref(), &crack, &motion, &since, &summary, &ledger);
        keep(frames, &now, options.keep_modes);
    }
    for (step, ends) in ground.windows(2).enumerate() {
        let ends = [scaled(ends[0]), scaled(ends[1])];
        let before_upper = upper.go_on(ends, damping, idce, dt);
        let before_lower = lower.as_mut().map(|part| part.go_on(ends, damping, idce, dt));
        // The contact problem, on where the nodes were.
        let status = &crack.solver.status;
        let below: &[f64] = lower.as_ref().map_or(&[], |part| &part.position);
        crack
            .contacts
            .update(&upper.position, below, |k| status[k] == Status::Stick);
        if crack.contacts.changed || crack.assembled != Some(damping) {
            let above = Answer {
                w: &upper.w[damping],
                nodes: upper.body.nodes,
            };
            let below = lower.as_ref().map(|part| Answer {
                w: &part.w[damping],
                nodes: part.body.nodes,
            });
            crack.assemble(above, below, damping, |_| 1.0 / idce.penalty);
        }
        let old = faces(&upper, lower.as_ref(), |part| &part.position);
        let free = faces(&upper, lower.as_ref(), |part| &part.free);
        set_up(&mut crack, dam, old, free, idce.penalty, dt);
        let held = spring_energy(&crack, idce.penalty);
        summary.note(crack.solver.solve::<false>(&crack.problem));
        let none: &mut [f64] = &mut [];
        let force = crack.impulses(
            &mut upper.force,
            lower.as_mut().map_or(none, |part| &mut part.force),
        );
        let mut work = upper.correct(&before_upper, damping, idce, dt, &mut ledger);
        if let (Some(part), Some(before)) = (&mut lower, &before_lower) {
            let below = part.correct(before, damping, idce, dt, &mut ledger);
            work = [work[0] + below[0], work[1] + below[1]];
        }
        // What the springs take up is not lost: along the crack it is no friction, across it no impact.
        let holds = spring_energy(&crack, idce.penalty);
        ledger.penalty = holds[0] + holds[1];
        let made = [0, 1].map(|d| work[d] + holds[d] - held[d]);
        ledger.friction -= made[0];
        ledger.impact -= made[1];
        ledger.gained += (made[0] + made[1]).max(0.0);
        ledger.turnover += work[0].abs() + work[1].abs();
        summary.end_time = (step + 1) as f64 * dt;
        let after = Motion::of(faces(&upper, lower.as_ref(), |part| &part.position), zero);
        let state = observe::state(&crack.solver.status);
        observe::book(&mut summary, dt, &motion, &after, state, force[1]);
        observe::strikes(
            &mut summary,
            &crack.contacts,
            &crack.closed,
            &crack.solver.status,
            &crack.approach,
        );
        motion = after;
        damping = usize::from(!crack.solver.status.contains(&Status::Stick));
        if let Some(frames) = &mut frames {
            upper.force.iter_mut().for_each(|value| *value *= dt);
            since.add(&upper.force, [force[0] * dt, force[1] * dt], dt);
            if (step + 1).is_multiple_of(options.stride) {
                ledger.stored = energy(&upper, lower.as_ref());
                ledger.numerical = ledger.unexplained();
                let now = snapshot(&upper, lower.as_ref(), &crack, &motion, &since, &summary, &ledger);
                keep(frames, &now, options.keep_modes);
                since.clear();
            }
        }
        if !(motion.slip.abs() < reach && motion.opening_heel.abs() < reach) {
            summary.outcome = Outcome::Lost;
            break;
        }
    }
    ledger.stored = energy(&upper, lower.as_ref());
    // All that nothing else explains is the scheme's own; so this ledger always closes.
    ledger.numerical = ledger.unexplained();
    let lost = ledger.input + ledger.start - ledger.stored - ledger.penalty;
    let sound = ledger.gained <= (BLOWN_UP[0] * lost).max(BLOWN_UP[1] * ledger.turnover);
    if !(sound && ledger.stored.is_finite() && motion.slip.is_finite()) {
        summary.outcome = Outcome::BlownUp;
    }
    summary.ledger = ledger;
    summary
}

/// Write the contact problem of the step, from where the nodes were and where they would be without contact.
fn set_up(crack: &mut Crack, dam: &Dam, old: Faces, free: Faces, penalty: f64, dt: f64) {
    for (k, pair) in crack.contacts.pairs.iter().enumerate() {
        let status = crack.solver.status[k];
        crack.closed[k] = status.closed();
        let Some(pair) = pair else {
            crack.solver.status[k] = Status::Absent;
            crack.problem.b[2 * k] = 0.0;
            crack.problem.b[2 * k + 1] = 0.0;
            crack.approach[k] = 0.0;
            continue;
        };
        if status == Status::Absent {
            crack.solver.status[k] = Status::Open;
        }
        let along = relative(pair, free.upper, free.lower, 0) - relative(pair, old.upper, old.lower, 0);
        crack.problem.b[2 * k] = along - crack.solver.p[2 * k] / penalty;
        crack.problem.b[2 * k + 1] = relative(pair, free.upper, free.lower, 1);
        crack.problem.h[k] = 0.0;
        let way = crack.problem.b[2 * k + 1] - relative(pair, old.upper, old.lower, 1);
        crack.approach[k] = way / dt;
        let slips = matches!(status, Status::SlipDownstream | Status::SlipUpstream);
        crack.problem.mu_stick[k] = dam.friction[usize::from(slips)];
    }
}

/// Energy in the springs of all closed contacts, along and across the crack.
fn spring_energy(crack: &Crack, penalty: f64) -> [f64; 2] {
    [0, 1].map(|d| {
        let forces = crack.solver.p.chunks_exact(2).map(|force| force[d]);
        forces.map(|force| force * force).sum::<f64>() / (2.0 * penalty)
    })
}

fn energy(upper: &Part, lower: Option<&Part>) -> f64 {
    let of = |part: &Part| part.body.energy(&part.q, &part.v);
    of(upper) + lower.map_or(0.0, of)
}

/// One quantity of the crack nodes of both faces.
fn faces<'a>(
    upper: &'a Part,
    lower: Option<&'a Part>,
    what: impl for<'p> Fn(&'p Part) -> &'p [f64],
) -> Faces<'a> {
    Faces {
        upper: what(upper),
        lower: lower.map_or(&[], what),
    }
}

fn snapshot<'a>(
    upper: &'a Part,
    lower: Option<&'a Part>,
    crack: &'a Crack,
    motion: &'a Motion,
    since: &'a Since,
    summary: &'a Summary,
    ledger: &'a Ledger,
) -> Snapshot<'a> {
    Snapshot {
        faces: faces(upper, lower, |part| &part.position),
        modes: [&upper.q, lower.map_or(&[], |part| &part.q)],
        status: &crack.solver.status,
        motion,
        since,
        summary,
        ledger,
    }
}
