//! The contact problem of one step where the ground shakes across the valley, too: friction resists the resultant.
//!
//! Along the crack (t), across its faces (n) and across the valley (y) find impulses `p` for which
//!
//! ```text
//! u = G p + b,      0 <= u_n + h   perpendicular to   p_n >= 0
//! u_T = 0 and |p_T| <= mu p_n,   or   p_T = -mu p_n u_T / |u_T|,      T = (t, y)
//! ```
//!
//! Nothing couples y with t and n but friction. With `z = p_T - rho u_T` a node sticks while `|z| <= mu p_n`; where it
//! slips, Newton's method of `p_T = mu p_n z / |z|` (Alart and Curnier 1991) is, in the direction `e = z / |z|` and the one
//! at right angles to it,
//!
//! ```text
//! p_e = mu p_n,      s u_q + (1 - s) / rho p_q = 0,      s = mu p_n / |z|
//! ```
//!
//! The states and shares of the last step are tried first, with the impulses and directions to which the last two lead. From
//! step to step they change little: the inverse of the matrix goes along, three of its rows for each node that changes, and
//! with it
//!
//! ```text
//! p_T = mu p_n e(phi),      u_n + h = 0,      u_q = 0      and, where it sticks,      u_T = 0
//! ```
//!
//! are solved by corrections of p and phi, as long as each leaves little of what was amiss; where one does not, the inverse
//! gets the directions and shares that they have come to. Whatever the corrections before have shown of the matrix is used
//! (Broyden; Kelley, Iterative Methods for Linear and Nonlinear Equations, 1995, chapter 7). Where sets of states come round
//! in a circle, sweeps help: each node by itself, the others held, has a solution by one number `lambda >= 0` with
//! `u_T = -lambda p_T`. A law adds a constant to `mu p_n`.
//!
//! A neighbour that a node touches is a plastic stop: where it pushes, `u_y = 0`, it takes all that acts across the valley,
//! and friction acts along the crack alone. The forces that a node bears there are a convex set, half of a disc and half of a
//! strip, to which the slip is normal; one that stopped a node within a step would make them jump.

use super::super::simd::{add_times, apart, dot, fill, in_groups, inlined, largest, Group, Lanes, LANES};
use super::super::status::Status;
use super::problem::Problem;
use super::triangles::{eliminate, inverse};
use super::Report;

/// Most sets of states in turn, at first and between sweeps.
const TRIALS: u32 = 40;
const TRIALS_BETWEEN: u32 = 15;
/// Sweeps before the first look, each look in vain doubles them, and most of a step.
const LOOK: u32 = 16;
const SWEEPS: u32 = 4000;
/// Relative to the largest impulse or velocity: what counts as a violation, and by how much friction may be off.
const SLACK: f64 = 1e-11;
const RIGHT: f64 = 1e-10;
/// Corrections at most, and what each may leave of what was amiss.
const CORRECTIONS: usize = 12;
const CLOSER: f64 = 0.5;
/// How often the inverse may follow in one set of corrections.
const RENEWALS: u32 = 3;
/// Part of the usual differences that it then may leave.
const RENEWED: f64 = 0.2;
/// Cosine of the most that a direction may have turned in the last step if it is to go on turning.
const NEAR: f64 = 0.9;
/// By how much the direction of a slip (as a sine) and its share may be others than those in the inverse.
const TURNED: f64 = 0.05;
const SHARED: f64 = 0.05;
/// The same of coefficients of friction.
const RUBBED: f64 = 0.02;
/// A pivot, against rows of about 1, of a change that is not to be made.
const VANISHES: f64 = 1e-7;
/// Halvings in the search for a node's lambda, which are more than a double holds.
const HALVINGS: u32 = 200;

/// How the bodies answer across the valley at the contacts, and what they do there.
#[derive(Default)]
pub(in super::super) struct Rows {
    /// Symmetric, row by row.
    pub g: Vec<f64>,
    pub b: Vec<f64>,
    /// Whether each contact touches its neighbour to the left and to the right.
    pub touches: Vec<[bool; 2]>,
    pub scale: Vec<f64>,
    pub p: Vec<f64>,
    pub u: Vec<f64>,
    /// Which neighbour pushes.
    pub side: Vec<Side>,
    /// `G` along the crack and across its faces, and that across the valley, their rows filled up to whole groups; and
    /// room for sums.
    wide: [Vec<Group>; 2],
    room_for: [Vec<Group>; 2],
}

impl Rows {
    pub(in super::super) fn new(contacts: usize) -> Self {
        Rows {
            g: vec![0.0; contacts * contacts],
            b: vec![0.0; contacts],
            touches: vec![[false; 2]; contacts],
            scale: vec![0.0; contacts],
            p: vec![0.0; contacts],
            u: vec![0.0; contacts],
            side: vec![Side::None; contacts],
            ..Rows::default()
        }
    }
}

/// The neighbour that pushes a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in super::super) enum Side {
    #[default]
    None,
    Left,
    Right,
}

/// State of a contact in the plane of its crack.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    Absent,
    Open,
    Stick,
    /// With the direction of its friction, and the share s.
    Slip([f64; 2], f64),
}

impl State {
    fn closed(self) -> bool {
        matches!(self, State::Stick | State::Slip(..))
    }
}

/// An equation of a contact: what it takes of the velocities there, what of the impulses, and its right-hand side.
#[derive(Clone, Copy, Default)]
struct Row {
    felt: [f64; 3],
    own: [f64; 3],
    right: f64,
}

/// The solver, with the states of the last step.
pub(in super::super) struct Disc {
    states: Vec<State>,
    /// States and impulses of the step before it, and whether a step begins.
    before: Vec<(State, [f64; 3])>,
    begins: bool,
    /// The inverse of the equations, column by column, each filled up to whole groups; impulses and equations stand in
    /// the order along, normal, across, each of all contacts.
    inverse: Vec<Group>,
    /// The set it belongs to, with the coefficients of friction; empty where it is good for nothing.
    of: Vec<(State, Side, f64)>,
    /// Right-hand sides, and room for a solution, for rows and columns, and for the corrections of a set.
    x: Vec<f64>,
    sum: Vec<Group>,
    room: Vec<Group>,
    lu: Vec<f64>,
    pivots: Vec<usize>,
    steps: Vec<Group>,
}

impl Disc {
    pub(in super::super) fn new(contacts: usize) -> Self {
        Disc {
            states: vec![State::Stick; contacts],
            before: vec![(State::Absent, [0.0; 3]); contacts],
            begins: false,
            inverse: Vec::new(),
            of: Vec::new(),
            x: vec![0.0; 3 * contacts],
            sum: vec![[0.0; LANES]; (3 * contacts).div_ceil(LANES)],
            room: Vec::new(),
            lu: Vec::new(),
            pivots: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// Begin a step, which starts from where the last two steps lead.
    pub(in super::super) fn begin(&mut self) {
        self.begins = true;
    }

    /// Solve from the states of the last step; `status` says which contacts are absent, and takes the states found. `moved`
    /// says that `G` is another one than last time.
    pub(in super::super) fn solve<W: Lanes>(
        &mut self,
        problem: &Problem,
        rows: &mut Rows,
        status: &mut [Status],
        (p, u): (&mut [f64], &mut [f64]),
        moved: bool,
    ) -> Report {
        if moved || rows.wide[0].is_empty() {
            let m = self.states.len();
            rows.wide = [in_groups(&problem.g, 2 * m), in_groups(&rows.g, m)];
            rows.room_for = [2 * m, m].map(|size| vec![[0.0; LANES]; size.div_ceil(LANES)]);
        }
        for ((state, side), status) in self.states.iter_mut().zip(&mut rows.side).zip(&*status) {
            *state = match (*status, *state) {
                (Status::Absent, _) => State::Absent,
                (_, State::Absent) => State::Open,
                (Status::Stick, State::Open) => State::Stick,
                (_, state) => state,
            };
            if *state == State::Absent {
                *side = Side::None;
            }
        }
        for (side, touches) in rows.side.iter_mut().zip(&rows.touches) {
            if *side == Side::Left && !touches[0] || *side == Side::Right && !touches[1] {
                *side = Side::None;
            }
        }
        let mut way = Way { problem, rows, p, u };
        if std::mem::take(&mut self.begins) {
            self.go_ahead(&mut way);
        }
        let mut report = Report::default();
        let mut found = search::<W>(self, &mut way, TRIALS, &mut report);
        let (mut swept, mut look) = (0, LOOK);
        while !found && swept < SWEEPS {
            report.swept = true;
            swept += look;
            if sweep(self, &mut way, look) {
                break;
            }
            look *= 2;
            let kept = (
                self.states.clone(),
                way.rows.side.clone(),
                way.p.to_vec(),
                way.rows.p.clone(),
            );
            found = search::<W>(self, &mut way, TRIALS_BETWEEN, &mut report);
            if !found {
                (self.states, way.rows.side) = (kept.0, kept.1);
                way.p.copy_from_slice(&kept.2);
                way.rows.p.copy_from_slice(&kept.3);
            }
        }
        if !found {
            way.velocities::<W>();
        }
        report.residual = self.residual(&way);
        for (contact, (status, state)) in status.iter_mut().zip(&self.states).enumerate() {
            *status = match state {
                State::Absent => Status::Absent,
                State::Open => Status::Open,
                State::Stick => Status::Stick,
                State::Slip(..) if way.u[contact] >= 0.0 => Status::SlipDownstream,
                State::Slip(..) => Status::SlipUpstream,
            };
        }
        report
    }

    /// Let impulses and directions of contacts whose state has lasted go on as in the last step.
    fn go_ahead(&mut self, way: &mut Way) {
        let m = self.states.len();
        for (contact, (state, before)) in self.states.iter_mut().zip(&mut self.before).enumerate() {
            let now = [way.p[contact], way.p[m + contact], way.rows.p[contact]];
            let (was, from) = std::mem::replace(before, (*state, now));
            let lasts = match (&mut *state, was) {
                // Where a neighbour pushes, friction acts along the crack.
                (State::Slip(..), _) if way.rows.side[contact] != Side::None => *state == was,
                (State::Slip(to, _), State::Slip(of, _)) => {
                    let turned = [2.0 * to[0] - of[0], 2.0 * to[1] - of[1]];
                    let size = length(turned[0], turned[1]);
                    let near = to[0] * of[0] + to[1] * of[1] > NEAR;
                    if near {
                        *to = [turned[0] / size, turned[1] / size];
                    }
                    near
                }
                (state, was) => *state == was,
            };
            if lasts {
                let [along, normal, across] = [0, 1, 2].map(|k| 2.0 * now[k] - from[k]);
                (way.p[contact], way.p[m + contact], way.rows.p[contact]) = (along, normal, across);
            }
        }
    }

    /// Go from set to set; false where none is right of so many.
    #[inline(always)]
    fn go_on<W: Lanes>(&mut self, way: &mut Way, most: u32, report: &mut Report) -> bool {
        for _ in 0..most {
            report.iterations += 1;
            if !(self.follow::<W>(way) && self.correct::<W>(way)) {
                if !self.impulses::<W>(way) {
                    return false;
                }
                way.velocities::<W>();
            }
            if self.turn(way) {
                return true;
            }
        }
        false
    }

    /// Let the inverse follow the states, contact by contact; false where there is none, or too much has changed.
    #[inline(always)]
    fn follow<W: Lanes>(&mut self, way: &Way) -> bool {
        if self.of.is_empty() {
            return false;
        }
        let far = |contact: &usize| self.off(way, *contact, 1.0);
        let changed = (0..self.states.len()).filter(far).count();
        if changed > self.states.len() / 3 + 1 {
            return false;
        }
        if changed == 0 {
            return true;
        }
        let changed: Vec<usize> = (0..self.states.len()).filter(far).collect();
        for contact in changed {
            if !self.replace::<W>(way, contact) {
                self.of.clear();
                return false;
            }
            self.of[contact] = self.set_of(way, contact);
        }
        true
    }

    /// Whether the inverse has other equations of a contact, or directions and shares that are off by more than this part
    /// of what they may be.
    #[inline(always)]
    fn off(&self, way: &Way, contact: usize, part: f64) -> bool {
        let (of, of_side, mu) = self.of[contact];
        way.rows.side[contact] != of_side
            || match (self.states[contact], of) {
                (State::Slip(to, share), State::Slip(other, of_share)) => {
                    to[0] * other[0] + to[1] * other[1] < 0.0
                        || (to[0] * other[1] - to[1] * other[0]).abs() > part * TURNED
                        || (share - of_share).abs() > part * SHARED
                        || (way.problem.mu_slip[contact] - mu).abs() > RUBBED
                }
                (state, of) => state != of,
            }
    }

    fn set_of(&self, way: &Way, contact: usize) -> (State, Side, f64) {
        (
            self.states[contact],
            way.rows.side[contact],
            way.problem.mu_slip[contact],
        )
    }

    /// Replace the equations of a contact in the inverse; false where they have no solution. With the new rows `r` and the
    /// columns `A_c` of the inverse `A` that stand for the old ones, columns become `A - A_c (r A_c)^-1 r A`.
    #[inline(always)]
    fn replace<W: Lanes>(&mut self, way: &Way, contact: usize) -> bool {
        let m = self.states.len();
        let (n, stride) = (3 * m, (3 * m).div_ceil(LANES));
        self.room.clear();
        self.room.resize(6 * stride, [0.0; LANES]);
        let (rows, old) = self.room.split_at_mut(3 * stride);
        let equations = way.equations(contact, self.states[contact]);
        for (k, equation) in equations.iter().enumerate() {
            way.write(contact, equation, rows[k * stride..][..stride].as_flattened_mut());
            let column = &self.inverse[(contact + k * m) * stride..][..stride];
            old[k * stride..][..stride].copy_from_slice(column);
        }
        let mut inner = [[0.0; 6]; 3];
        for (r, inner) in inner.iter_mut().enumerate() {
            for c in 0..3 {
                let (row, column) = (&rows[r * stride..][..stride], &old[c * stride..][..stride]);
                inner[c] = dot(row.as_flattened(), column.as_flattened());
            }
            inner[3 + r] = 1.0;
        }
        let Some(inner) = inverse_of_three(inner) else {
            return false;
        };
        let own = [contact, m + contact, 2 * m + contact];
        for j in (0..n).filter(|j| !own.contains(j)) {
            let column = &mut self.inverse[j * stride..][..stride];
            let mut felt = [W::all(0.0); 3];
            for (g, group) in column.iter().enumerate() {
                let group = W::load(group);
                for (r, felt) in felt.iter_mut().enumerate() {
                    *felt = W::load(&rows[r * stride + g]).fma(group, *felt);
                }
            }
            let mut groups = [[0.0; LANES]; LANES];
            for r in 0..3 {
                felt[r].store(&mut groups[r]);
            }
            let felt = W::sums(&groups);
            let mut by = [W::all(0.0); 3];
            for (by, inner) in by.iter_mut().zip(&inner) {
                *by = W::all(-(inner[0] * felt[0] + inner[1] * felt[1] + inner[2] * felt[2]));
            }
            add_three::<W>(by, old, column);
        }
        for (k, j) in own.into_iter().enumerate() {
            let column = &mut self.inverse[j * stride..][..stride];
            column.fill([0.0; LANES]);
            add_three::<W>(
                [W::all(inner[0][k]), W::all(inner[1][k]), W::all(inner[2][k])],
                old,
                column,
            );
        }
        true
    }

    /// Correct the impulses of the last step by the inverse; false where they do not come closer fast.
    #[inline(always)]
    fn correct<W: Lanes>(&mut self, way: &mut Way) -> bool {
        let m = self.states.len();
        for (contact, state) in self.states.iter().enumerate() {
            if !state.closed() {
                (way.p[contact], way.p[m + contact]) = (0.0, 0.0);
            }
            match *state {
                State::Slip(to, _) => way.lean(contact, to, 0.0),
                State::Stick => {}
                State::Absent | State::Open if way.rows.side[contact] != Side::None => {}
                State::Absent | State::Open => way.rows.p[contact] = 0.0,
            }
        }
        let enough = RIGHT * largest(&way.problem.b).max(largest(&way.rows.b));
        let (mut before, mut renewals) = (f64::INFINITY, 0);
        self.steps.clear();
        for _ in 0..CORRECTIONS {
            way.velocities::<W>();
            let now = self.amiss(way);
            if now <= enough {
                return true;
            }
            if now > CLOSER * before || now.is_nan() {
                if renewals == RENEWALS || now.is_nan() || !self.renew::<W>(way) {
                    break;
                }
                renewals += 1;
                self.steps.clear();
                self.amiss(way);
            }
            before = now;
            self.find::<W>();
            self.learn::<W>();
            if !self.apply(way) {
                break;
            }
        }
        self.of.clear();
        false
    }

    /// Let the inverse have the directions and shares of all that slips where the corrections are; false where it cannot.
    #[inline(always)]
    fn renew<W: Lanes>(&mut self, way: &Way) -> bool {
        let m = self.states.len();
        for contact in 0..m {
            let State::Slip(to, _) = self.states[contact] else {
                continue;
            };
            if way.rows.side[contact] == Side::None {
                let rho = way.rho(contact);
                let size = length(
                    way.p[contact] - rho * way.u[contact],
                    way.rows.p[contact] - rho * way.rows.u[contact],
                );
                let limit = way.limit(contact, true, way.p[m + contact]);
                self.states[contact] = State::Slip(to, (limit / size.max(f64::MIN_POSITIVE)).min(1.0));
            }
            if self.off(way, contact, RENEWED) {
                if !self.replace::<W>(way, contact) {
                    return false;
                }
                self.of[contact] = self.set_of(way, contact);
            }
        }
        true
    }

    /// Turn the right-hand sides into the solution by the inverse.
    #[inline(always)]
    fn find<W: Lanes>(&mut self) {
        self.sum.fill([0.0; LANES]);
        inlined::combine::<W>(&self.inverse, self.sum.len(), &self.x, &mut self.sum);
    }

    /// Change a correction by what those before it have shown, and keep it.
    #[inline(always)]
    fn learn<W: Lanes>(&mut self) {
        let stride = self.sum.len();
        let mut steps = self.steps.chunks_exact(stride);
        if let Some(mut last) = steps.next() {
            for step in steps {
                add_times::<W>(share(last, &self.sum), step, &mut self.sum);
                last = step;
            }
            let left = 1.0 - share(last, &self.sum);
            if left > CLOSER {
                self.sum.as_flattened_mut().iter_mut().for_each(|x| *x /= left);
            }
        }
        self.steps.extend_from_slice(&self.sum);
    }

    /// Write by what the velocities are amiss, as right-hand sides, and return the most of it.
    #[inline(always)]
    fn amiss(&mut self, way: &Way) -> f64 {
        let (m, rows, x) = (self.states.len(), &*way.rows, &mut self.x);
        for (contact, state) in self.states.iter().enumerate() {
            let stopped = rows.side[contact] != Side::None;
            let (u_t, u_y) = (way.u[contact], rows.u[contact]);
            let u_n = way.u[m + contact] + way.problem.h[contact];
            let across = if stopped { -u_y } else { 0.0 };
            let [t, n, y] = match *state {
                State::Stick => [-u_t, -u_n, -u_y],
                State::Slip([t, y], _) if !stopped => {
                    let share = match self.of[contact].0 {
                        State::Slip(_, share) => share,
                        _ => 1.0,
                    };
                    [0.0, -u_n, share * (y * u_t - t * u_y)]
                }
                State::Slip(..) => [0.0, -u_n, across],
                State::Absent | State::Open => [0.0, 0.0, across],
            };
            (x[contact], x[m + contact], x[2 * m + contact]) = (t, n, y);
        }
        largest(x)
    }

    /// Change impulses and directions by the solution; false where a node that slips is not pressed any more.
    #[inline(always)]
    fn apply(&mut self, way: &mut Way) -> bool {
        let (m, x) = (self.states.len(), self.sum.as_flattened());
        for (contact, state) in self.states.iter_mut().enumerate() {
            let stopped = way.rows.side[contact] != Side::None;
            let [along, normal, across] = [x[contact], x[m + contact], x[2 * m + contact]];
            match state {
                State::Stick => {
                    way.p[contact] += along;
                    way.p[m + contact] += normal;
                }
                State::Slip(to, _) => {
                    if !stopped {
                        let limit = way.limit(contact, true, way.p[m + contact] + normal);
                        if limit <= 0.0 {
                            return false;
                        }
                        let turn = (to[0] * across - to[1] * along) / limit;
                        let turned = [to[0] - to[1] * turn, to[1] + to[0] * turn];
                        let size = length(turned[0], turned[1]);
                        *to = [turned[0] / size, turned[1] / size];
                    }
                    way.lean(contact, *to, normal);
                }
                State::Absent | State::Open => {}
            }
            if stopped || *state == State::Stick {
                way.rows.p[contact] += across;
            }
        }
        true
    }

    /// Find the inverse of the states as they are, and their impulses; false where they have none.
    #[inline(always)]
    fn impulses<W: Lanes>(&mut self, way: &mut Way) -> bool {
        let m = self.states.len();
        let n = 3 * m;
        self.of.clear();
        self.lu.resize(n * n, 0.0);
        let mut row = vec![0.0; n];
        for (contact, state) in self.states.iter().enumerate() {
            for (k, equation) in way.equations(contact, *state).iter().enumerate() {
                let r = contact + k * m;
                self.x[r] = equation.right;
                way.write(contact, equation, &mut row);
                for (c, value) in row.iter().enumerate() {
                    self.lu[c * n + r] = *value;
                }
            }
        }
        if !eliminate::<W>(&mut self.lu, n, &mut self.pivots) {
            return false;
        }
        inverse::<W>(&self.lu, &self.pivots, n, &mut self.inverse);
        self.of = (0..m).map(|contact| self.set_of(way, contact)).collect();
        self.find::<W>();
        let x = self.sum.as_flattened();
        way.p.copy_from_slice(&x[..2 * m]);
        way.rows.p.copy_from_slice(&x[2 * m..n]);
        true
    }

    /// Change the states that break their conditions, and the directions of those that slip; true where none does, and the
    /// directions are right.
    fn turn(&mut self, way: &mut Way) -> bool {
        let m = self.states.len();
        let slack_u = SLACK * largest(&way.problem.b).max(largest(&way.rows.b));
        let most = largest(way.p).max(largest(&way.rows.p));
        let slack_p = SLACK * most;
        let mut right = true;
        for contact in 0..m {
            let before = self.states[contact];
            if before == State::Absent {
                continue;
            }
            let side = way.rows.side[contact];
            let next_side = way.side_of(contact, slack_u, slack_p);
            let stopped = next_side != Side::None;
            let (p_t, p_n, p_y) = (way.p[contact], way.p[m + contact], way.rows.p[contact]);
            let (u_t, u_n) = (way.u[contact], way.u[m + contact] + way.problem.h[contact]);
            let u_y = way.rows.u[contact];
            let (mut moved, mut next) = (next_side != side, before);
            match before {
                State::Open if u_n < -slack_u => next = State::Stick,
                State::Stick | State::Slip(..) if p_n < -slack_p => next = State::Open,
                State::Stick => {
                    let across = if stopped { 0.0 } else { p_y };
                    let size = length(p_t, across);
                    if size > way.limit(contact, false, p_n.max(0.0)) + slack_p {
                        let share = way.limit(contact, true, p_n.max(0.0)) / size;
                        next = State::Slip([p_t / size, across / size], share.min(1.0));
                    }
                }
                State::Slip([t, _], _) if stopped => {
                    if moved {
                        let sign = if t == 0.0 { -u_t.signum() } else { t.signum() };
                        next = State::Slip([sign, 0.0], 1.0);
                    } else if u_t * t > slack_u {
                        next = State::Stick;
                    }
                }
                State::Slip(..) => {
                    let rho = way.rho(contact);
                    let z = [p_t - rho * u_t, p_y - rho * u_y];
                    let (size, limit) = (length(z[0], z[1]), way.limit(contact, true, p_n.max(0.0)));
                    if size <= limit || size == 0.0 {
                        next = State::Stick;
                    } else {
                        let way = [z[0] / size, z[1] / size];
                        let off = length(p_t - limit * way[0], p_y - limit * way[1]);
                        moved |= off > RIGHT * most;
                        next = State::Slip(way, limit / size);
                    }
                }
                State::Absent | State::Open => {}
            }
            let same = match (before, next) {
                (State::Slip(..), State::Slip(..)) => true,
                (before, next) => before == next,
            };
            right &= same && !moved;
            self.states[contact] = next;
            way.rows.side[contact] = next_side;
        }
        right
    }

    /// What [`sweep`] does.
    fn sweeps(&mut self, way: &mut Way, most: u32) -> bool {
        let m = self.states.len();
        for contact in 0..m {
            let limit = way.limit(contact, false, way.p[m + contact].max(0.0));
            if !self.states[contact].closed() {
                (way.p[contact], way.p[m + contact], way.rows.p[contact]) = (0.0, 0.0, 0.0);
            }
            way.p[m + contact] = way.p[m + contact].max(0.0);
            let size = length(way.p[contact], way.rows.p[contact]);
            if size > limit {
                way.p[contact] *= limit / size;
                way.rows.p[contact] *= limit / size;
            }
        }
        for _ in 0..most {
            way.velocities::<super::super::simd::Plain>();
            let (mut change, mut most) = (0.0_f64, 0.0_f64);
            for contact in 0..m {
                if self.states[contact] == State::Absent {
                    continue;
                }
                let node = Node::of(way, contact);
                let (state, side, p) = node.solve();
                (self.states[contact], way.rows.side[contact]) = (state, side);
                let before = [way.p[contact], way.p[m + contact], way.rows.p[contact]];
                let step = [0, 1, 2].map(|k| p[k] - before[k]);
                change = step.iter().fold(change, |a, x| a.max(x.abs()));
                most = most.max(p[1]);
                (way.p[contact], way.p[m + contact], way.rows.p[contact]) = (p[0], p[1], p[2]);
                way.add(contact, step);
            }
            if change <= 1e-13 * most {
                return true;
            }
        }
        false
    }

    /// By what the worst contact breaks its conditions, over the impulse that would stop the fastest, or the largest.
    fn residual(&self, way: &Way) -> f64 {
        let m = self.states.len();
        let (problem, rows) = (way.problem, &*way.rows);
        let (mut worst, mut most) = (0.0_f64, 0.0_f64);
        // Rows of a contact that meets nothing are old.
        let there = |(_, state): &(usize, &State)| **state != State::Absent;
        for (contact, state) in self.states.iter().enumerate().filter(there) {
            let (p_t, p_n, p_y) = (way.p[contact], way.p[m + contact], rows.p[contact]);
            let scale = [problem.scale[contact], problem.scale[m + contact]];
            let stops = (problem.b[contact] * scale[0])
                .abs()
                .max((problem.b[m + contact] * scale[1]).abs())
                .max((rows.b[contact] * rows.scale[contact]).abs());
            most = most.max(p_n).max(stops);
            let apart = p_n.min((way.u[m + contact] + problem.h[contact]) * scale[1]);
            let slips = *state != State::Stick;
            let (limit, rho) = (way.limit(contact, slips, p_n.max(0.0)), way.rho(contact));
            let [left, right] = rows.touches[contact];
            let off = if rows.side[contact] != Side::None {
                let z = p_t - rho * way.u[contact];
                let pulls = match rows.side[contact] {
                    Side::Left => p_y.max(0.0),
                    _ => (-p_y).max(0.0),
                };
                let stopped = (rows.u[contact] * rows.scale[contact]).abs();
                (p_t - z.clamp(-limit, limit)).abs().max(pulls).max(stopped)
            } else {
                let z = [p_t - rho * way.u[contact], p_y - rho * rows.u[contact]];
                let share = (limit / length(z[0], z[1]).max(f64::MIN_POSITIVE)).min(1.0);
                let u = rows.u[contact];
                let past = if left && u > 0.0 || right && u < 0.0 {
                    u.abs()
                } else {
                    0.0
                };
                let off = length(p_t - share * z[0], p_y - share * z[1]);
                off.max(past * rows.scale[contact])
            };
            worst = worst.max(apart.abs()).max(off);
        }
        if most > 0.0 {
            worst / most
        } else {
            0.0
        }
    }
}

/// A problem with the impulses and velocities on the way to its solution.
struct Way<'s> {
    problem: &'s Problem,
    rows: &'s mut Rows,
    p: &'s mut [f64],
    u: &'s mut [f64],
}

impl Way<'_> {
    /// Matrix that makes impulses of velocities in the plane of the crack.
    #[inline(always)]
    fn rho(&self, contact: usize) -> f64 {
        self.problem.scale[contact].min(self.rows.scale[contact])
    }

    /// Friction of a contact that is pressed so; the line of a law may pass below zero.
    #[inline(always)]
    fn limit(&self, contact: usize, slips: bool, normal: f64) -> f64 {
        let problem = self.problem;
        let mu = if slips {
            &problem.mu_slip
        } else {
            &problem.mu_stick
        };
        (mu[contact] * normal + problem.added(contact, slips, 0.0)).max(0.0)
    }

    /// The equations of a contact in this state.
    #[inline(always)]
    fn equations(&self, contact: usize, state: State) -> [Row; 3] {
        let (problem, rows, m) = (self.problem, &*self.rows, self.rows.p.len());
        let b = [
            problem.b[contact],
            problem.b[m + contact] + problem.h[contact],
            rows.b[contact],
        ];
        // Impulses as large as the velocities that they make; one that has met nothing yet has no scale.
        let (rho, stopped) = (self.rho(contact), rows.side[contact] != Side::None);
        let rho = if rho > 0.0 { rho } else { 1.0 };
        let still = |k: usize| {
            let mut row = Row {
                right: -b[k],
                ..Row::default()
            };
            row.felt[k] = 1.0;
            row
        };
        let none = |k: usize| {
            let mut row = Row::default();
            row.own[k] = 1.0 / rho;
            row
        };
        let across = if stopped { still(2) } else { none(2) };
        match state {
            State::Stick => [still(0), still(1), still(2)],
            State::Slip([t, y], share) => {
                let y = if stopped { 0.0 } else { y };
                let rubs = Row {
                    own: [t / rho, -problem.mu_slip[contact] / rho, y / rho],
                    right: problem.added(contact, true, 0.0) / rho,
                    ..Row::default()
                };
                let own = (1.0 - share) / rho;
                let turns = Row {
                    felt: [-share * y, 0.0, share * t],
                    own: [-own * y, 0.0, own * t],
                    right: share * (y * b[0] - t * b[2]),
                };
                [rubs, still(1), if stopped { across } else { turns }]
            }
            State::Absent | State::Open => [none(0), none(1), across],
        }
    }

    /// Write an equation of a contact in terms of all impulses.
    #[inline(always)]
    fn write(&self, contact: usize, equation: &Row, to: &mut [f64]) {
        let m = self.rows.p.len();
        let [t, n, y] = equation.felt;
        let along = &self.problem.g[contact * 2 * m..][..2 * m];
        let normal = &self.problem.g[(m + contact) * 2 * m..][..2 * m];
        let across = &self.rows.g[contact * m..][..m];
        for ((to, along), normal) in to.iter_mut().zip(along).zip(normal) {
            *to = t * along + n * normal;
        }
        for (to, across) in to[2 * m..].iter_mut().zip(across) {
            *to = y * across;
        }
        for (k, own) in equation.own.iter().enumerate() {
            to[contact + k * m] += own;
        }
    }

    /// Let friction lean this way, with a change of the normal impulse.
    #[inline(always)]
    fn lean(&mut self, contact: usize, [t, y]: [f64; 2], change: f64) {
        let m = self.rows.p.len();
        let normal = self.p[m + contact] + change;
        let limit = self.limit(contact, true, normal);
        (self.p[contact], self.p[m + contact]) = (limit * t, normal);
        if self.rows.side[contact] == Side::None {
            self.rows.p[contact] = limit * y;
        }
    }

    /// Find `u = G p + b`.
    #[inline(always)]
    fn velocities<W: Lanes>(&mut self) {
        let rows = &mut *self.rows;
        let [room, room_y] = &mut rows.room_for;
        fill(&self.problem.b, room);
        inlined::combine::<W>(&rows.wide[0], room.len(), self.p, room);
        self.u.copy_from_slice(&room.as_flattened()[..self.u.len()]);
        fill(&rows.b, room_y);
        inlined::combine::<W>(&rows.wide[1], room_y.len(), &rows.p, room_y);
        let count = rows.u.len();
        rows.u.copy_from_slice(&room_y.as_flattened()[..count]);
    }

    /// Add to the velocities what a change of the impulses of a contact makes.
    fn add(&mut self, contact: usize, [t, n, y]: [f64; 3]) {
        let m = self.rows.p.len();
        let along = &self.problem.g[contact * 2 * m..][..2 * m];
        let normal = &self.problem.g[(m + contact) * 2 * m..][..2 * m];
        for ((u, a), b) in self.u.iter_mut().zip(along).zip(normal) {
            *u += t * a + n * b;
        }
        let across = &self.rows.g[contact * m..][..m];
        self.rows.u.iter_mut().zip(across).for_each(|(u, g)| *u += y * g);
    }

    /// Which neighbour pushes a contact next.
    fn side_of(&self, contact: usize, slack_u: f64, slack_p: f64) -> Side {
        let [left, right] = self.rows.touches[contact];
        let (p, u) = (self.rows.p[contact], self.rows.u[contact]);
        let (to_left, to_right) = (
            left && (u > slack_u || p < -slack_p),
            right && (u < -slack_u || p > slack_p),
        );
        match self.rows.side[contact] {
            Side::Left if p <= slack_p => Side::Left,
            Side::Right if p >= -slack_p => Side::Right,
            Side::Left if right => Side::Right,
            Side::Right if left => Side::Left,
            Side::Left | Side::Right => Side::None,
            Side::None if to_left => Side::Left,
            Side::None if to_right => Side::Right,
            Side::None => Side::None,
        }
    }
}

/// The inverse of three rows, each with those of the unit matrix beside it; none where it has none.
#[inline(always)]
fn inverse_of_three(mut rows: [[f64; 6]; 3]) -> Option<[[f64; 3]; 3]> {
    for k in 0..3 {
        let pivot = (k..3).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs()))?;
        rows.swap(k, pivot);
        if rows[k][k].is_nan() || rows[k][k].abs() < VANISHES {
            return None;
        }
        let own = rows[k].map(|x| x / rows[k][k]);
        rows[k] = own;
        for r in (0..3).filter(|r| *r != k) {
            let by = rows[r][k];
            rows[r].iter_mut().zip(&own).for_each(|(x, own)| *x -= by * own);
        }
    }
    Some(rows.map(|row| [row[3], row[4], row[5]]))
}

/// How much of a correction another one has.
#[inline(always)]
fn share(step: &[Group], sum: &[Group]) -> f64 {
    let (step, sum) = (step.as_flattened(), sum.as_flattened());
    dot(step, sum) / dot(step, step)
}

/// Add three columns, one after the other, times these numbers to another one.
#[inline(always)]
fn add_three<W: Lanes>([a, b, c]: [W; 3], columns: &[Group], to: &mut [Group]) {
    let (one, rest) = columns.split_at(to.len());
    let (two, three) = rest.split_at(to.len());
    for (((to, one), two), three) in to.iter_mut().zip(one).zip(two).zip(three) {
        let sum = a.fma(W::load(one), W::load(to));
        c.fma(W::load(three), b.fma(W::load(two), sum)).store(to);
    }
}

/// Length of a vector; unlike `hypot` it costs next to nothing.
#[inline(always)]
fn length(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// A contact by itself, the others held.
struct Node {
    /// Answers along and along, along and normal, normal and normal, across and across.
    tt: f64,
    tn: f64,
    nn: f64,
    yy: f64,
    /// Velocities without its impulses.
    free: [f64; 3],
    touches: [bool; 2],
    mu: [f64; 2],
    /// Impulse that it bears beside that.
    added: [f64; 2],
    rho: f64,
}

impl Node {
    fn of(way: &Way, contact: usize) -> Self {
        let (problem, rows, m) = (way.problem, &*way.rows, way.rows.p.len());
        let g = |r: usize, c: usize| problem.g[(contact + r * m) * 2 * m + contact + c * m];
        let (tt, tn, nn, yy) = (g(0, 0), g(0, 1), g(1, 1), rows.g[contact * (m + 1)]);
        let (t, n, y) = (way.p[contact], way.p[m + contact], rows.p[contact]);
        Node {
            tt,
            tn,
            nn,
            yy,
            free: [
                way.u[contact] - tt * t - tn * n,
                way.u[m + contact] + problem.h[contact] - tn * t - nn * n,
                rows.u[contact] - yy * y,
            ],
            touches: rows.touches[contact],
            mu: [problem.mu_stick[contact], problem.mu_slip[contact]],
            added: [false, true].map(|slips| problem.added(contact, slips, 0.0)),
            rho: way.rho(contact),
        }
    }

    /// Return state, neighbour and impulses.
    fn solve(&self) -> (State, Side, [f64; 3]) {
        let ([left, right], across) = (self.touches, self.free[2]);
        let side = match () {
            () if left && across > 0.0 => Side::Left,
            () if right && across < 0.0 => Side::Right,
            () => {
                let (state, p) = self.plane(across);
                return (state, Side::None, p);
            }
        };
        let (state, p) = self.plane(0.0);
        (state, side, [p[0], p[1], -across / self.yy])
    }

    /// The state and the impulses with friction alone, where this moves it across the valley.
    fn plane(&self, across: f64) -> (State, [f64; 3]) {
        let [along, normal, _] = self.free;
        if normal >= 0.0 {
            return (State::Open, [0.0; 3]);
        }
        // With the normal impulse eliminated.
        let own = self.tt - self.tn * self.tn / self.nn;
        let pushed = along - self.tn * normal / self.nn;
        let at = |lambda: f64| {
            let (t, y) = (-pushed / (own + lambda), -across / (self.yy + lambda));
            [t, -(normal + self.tn * t) / self.nn, y]
        };
        let size = |p: [f64; 3]| length(p[0], p[2]);
        let stick = at(0.0);
        if stick[1] >= 0.0 && size(stick) <= self.mu[0] * stick[1] + self.added[0] {
            return (State::Stick, stick);
        }
        let too_much = |lambda: f64| {
            let p = at(lambda);
            size(p) > self.mu[1] * p[1] + self.added[1]
        };
        let (mut low, mut high) = (0.0, own.max(self.yy));
        while too_much(high) && high < f64::MAX / 4.0 {
            (low, high) = (high, 4.0 * high);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if too_much(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        let p = at(high);
        let size = size(p);
        if size == 0.0 {
            return (State::Slip([1.0, 0.0], 0.0), p);
        }
        // |z| is that of p and of what it slips by.
        let share = 1.0 / (1.0 + self.rho * high);
        (State::Slip([p[0] / size, p[2] / size], share), p)
    }
}

apart! {
    /// Go from set to set with these problem and solution; false where none is right of so many.
    fn search(disc: &mut Disc, way: &mut Way<'_>, most: u32, report: &mut Report) -> bool = Disc::go_on;
}

/// Sweep so often; true where nothing changes any more.
// In line it would be compiled a few times over.
#[inline(never)]
fn sweep(disc: &mut Disc, way: &mut Way, most: u32) -> bool {
    disc.sweeps(way, most)
}

#[cfg(test)]
mod tests {
    use super::super::super::simd::Plain;
    use super::super::super::status::Status;
    use super::super::Problem;
    use super::{Disc, Rows};

    const CONTACTS: usize = 6;

    fn number(k: usize) -> f64 {
        ((k * 7919 + 13) % 1009) as f64 / 1009.0 - 0.5
    }

    /// `A A^T` and something on the diagonal.
    fn positive(size: usize, seed: usize) -> Vec<f64> {
        let a = |r: usize, c: usize| number(seed + 31 * r + 1007 * c);
        let mut g = vec![0.0; size * size];
        for r in 0..size {
            for c in 0..size {
                g[r * size + c] = (0..size).map(|k| a(r, k) * a(c, k)).sum::<f64>();
            }
            g[r * (size + 1)] += 0.2;
        }
        g
    }

    fn problem(seed: usize, mu: f64) -> (Problem, Rows) {
        let m = CONTACTS;
        let g = positive(2 * m, seed);
        let b = (0..2 * m).map(|k| number(seed + 3 * k) - if k < m { 0.0 } else { 0.4 });
        let mut rows = Rows::new(m);
        rows.g = positive(m, seed + 77);
        rows.b = (0..m).map(|k| number(seed + 5 * k + 1)).collect();
        rows.scale = (0..m).map(|k| 1.0 / rows.g[k * (m + 1)]).collect();
        let problem = Problem {
            scale: (0..2 * m).map(|k| 1.0 / g[k * (2 * m + 1)]).collect(),
            b: b.collect(),
            h: (0..m).map(|k| number(seed + k).max(0.0)).collect(),
            mu_stick: vec![mu; m],
            mu_slip: vec![mu; m],
            g,
            ..Problem::default()
        };
        (problem, rows)
    }

    fn solved(problem: &Problem, rows: &mut Rows) -> (Vec<f64>, f64) {
        let mut status = vec![Status::Stick; CONTACTS];
        let (mut p, mut u) = (vec![0.0; 2 * CONTACTS], vec![0.0; 2 * CONTACTS]);
        let solution = (&mut p[..], &mut u[..]);
        let report = Disc::new(CONTACTS).solve::<Plain>(problem, rows, &mut status, solution, true);
        (p, report.residual)
    }

    #[test]
    fn random_problems_meet_all_conditions_and_their_mirror_image_does() {
        for seed in 0..300 {
            let (problem, mut rows) = problem(97 * seed, [0.0, 0.3, 0.8, 1.2][seed % 4]);
            if seed % 3 == 0 {
                rows.touches = vec![[seed % 2 == 0, seed % 5 == 0]; CONTACTS];
            }
            let mut mirrored = Rows {
                g: rows.g.clone(),
                scale: rows.scale.clone(),
                b: rows.b.iter().map(|b| -b).collect(),
                touches: rows.touches.iter().map(|[left, right]| [*right, *left]).collect(),
                ..Rows::new(CONTACTS)
            };
            let (p, residual) = solved(&problem, &mut rows);
            assert!(residual < 1e-8, "{seed}: {residual}");
            let (other, _) = solved(&problem, &mut mirrored);
            assert_eq!(p, other, "{seed}");
            assert!(rows.p.iter().zip(&mirrored.p).all(|(a, b)| *a == -*b), "{seed}");
        }
    }

    #[test]
    fn a_node_that_meets_nothing_breaks_no_condition_beside_neighbours_without_a_gap() {
        for seed in 0..30 {
            let (problem, mut rows) = problem(97 * seed, 0.8);
            rows.touches = vec![[true; 2]; CONTACTS];
            let mut status = vec![Status::Stick; CONTACTS];
            status[2] = Status::Absent;
            let mut problem = problem;
            (problem.scale[2], problem.scale[CONTACTS + 2], rows.scale[2]) = (0.0, 0.0, 0.0);
            let (mut p, mut u) = (vec![0.0; 2 * CONTACTS], vec![0.0; 2 * CONTACTS]);
            let solution = (&mut p[..], &mut u[..]);
            let report = Disc::new(CONTACTS).solve::<Plain>(&problem, &mut rows, &mut status, solution, true);
            assert!(report.residual < 1e-8, "{seed}: {}", report.residual);
            assert!(rows.u.iter().enumerate().all(|(k, u)| k == 2 || u.abs() < 1e-9));
        }
    }

    /// Problems that drift from one to another, as those of steps do.
    #[test]
    fn the_inverse_that_goes_along_finds_what_a_new_one_does() {
        for seed in 0..40 {
            let ((mut problem, mut rows), (_, other)) =
                (problem(97 * seed, 0.8), problem(97 * seed + 50, 0.8));
            let start = (problem.b.clone(), rows.b.clone());
            let (mut disc, mut status) = (Disc::new(CONTACTS), vec![Status::Stick; CONTACTS]);
            let (mut p, mut u) = (vec![0.0; 2 * CONTACTS], vec![0.0; 2 * CONTACTS]);
            for step in 0..200 {
                let turn = f64::from(step) / 40.0;
                for (k, b) in problem.b.iter_mut().enumerate() {
                    *b = start.0[k] * turn.cos() + 0.3 * other.b[k % CONTACTS] * (1.7 * turn).sin();
                }
                for (k, b) in rows.b.iter_mut().enumerate() {
                    *b = start.1[k] * (1.3 * turn).cos() + 0.5 * other.b[k] * turn.sin();
                }
                if seed % 2 == 0 {
                    rows.touches = vec![[turn.sin() > 0.3, turn.sin() < -0.5]; CONTACTS];
                }
                disc.begin();
                let report =
                    disc.solve::<Plain>(&problem, &mut rows, &mut status, (&mut p, &mut u), step == 0);
                assert!(report.residual < 1e-8, "{seed} {step}: {}", report.residual);
            }
        }
    }

    #[test]
    fn a_node_by_itself_has_a_solution_however_strong_its_friction_is() {
        for seed in 0..500 {
            let (problem, mut rows) = problem(41 * seed, 4.0);
            let mut other = Rows::new(CONTACTS);
            std::mem::swap(&mut other, &mut rows);
            let (mut p, mut u) = (vec![0.0; 2 * CONTACTS], problem.b.clone());
            other.u.clone_from(&other.b);
            let way = super::Way {
                problem: &problem,
                rows: &mut other,
                p: &mut p,
                u: &mut u,
            };
            let node = super::Node::of(&way, 0);
            let (_, _, [t, n, y]) = node.solve();
            assert!(
                n >= 0.0 && super::length(t, y) <= 4.0 * n * (1.0 + 1e-9),
                "{seed}"
            );
            let apart = node.free[1] + node.tn * t + node.nn * n;
            assert!(apart > -1e-9 && (n * apart).abs() < 1e-9, "{seed}");
        }
    }
}
