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
//! The states of the last step are tried first. In a set of states velocities are given where nodes stick, are closed or
//! are held, impulses elsewhere; a [`Tableau`] says what answers, and follows the states by one exchange for each component
//! that changes sides. So all is linear but friction where nodes slip, and of these alone
//!
//! ```text
//! p_T = mu p_n e(phi),      u_q = 0
//! ```
//!
//! is solved by corrections of p_n and phi, which start from where the last steps lead by their differences (see
//! [`super::past`]), as long as each leaves little of what was amiss; where one does not, their matrix is renewed with the
//! directions and shares that they have come to. Whatever the corrections before have shown of the matrix is used
//! (Broyden; Kelley, Iterative Methods for Linear and Nonlinear Equations, 1995, chapter 7). The last word has
//! `G` itself: a tableau may be off by rounding, and by how far `G` has moved since. Where sets of states come round in a
//! circle, sweeps over the nodes help, see [`node`]. A law adds a constant to `mu p_n`.
//!
//! A neighbour that a node touches is a plastic stop: where it pushes, `u_y = 0`, it takes all that acts across the valley,
//! and friction acts along the crack alone. The forces that a node bears there are a convex set, half of a disc and half of a
//! strip, to which the slip is normal; one that stopped a node within a step would make them jump.

mod node;
mod slide;

use super::super::simd::{apart, fill, in_groups, inlined, largest, Group, Lanes, LANES};
use super::super::status::Status;
use super::past::{next, Course, ORDER};
use super::problem::Problem;
use super::tableau::Tableau;
use super::Report;

/// Most sets of states in turn, at first and between sweeps.
const TRIALS: u32 = 40;
const TRIALS_BETWEEN: u32 = 15;
/// Sweeps before the first look, each look in vain doubles them, and most of a step.
const LOOK: u32 = 16;
const SWEEPS: u32 = 4000;
/// Relative to the largest impulse or velocity: what counts as a violation, and by how much friction may be off.
pub(in super::super) const SLACK: f64 = 1e-11;
const RIGHT: f64 = 1e-10;
/// The part of what was amiss that each correction may leave.
const CLOSER: f64 = 0.5;
/// Looks at the velocities of a set of states at most, and how many of them say that the tableaux are worn.
const LOOKS: usize = 8;
const WORN: usize = 2;
/// Cosine of the most that a direction may turn from one step to where it goes on.
const NEAR: f64 = 0.9;

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

    /// Whether another one is the same but for direction and share.
    fn alike(self, other: State) -> bool {
        matches!((self, other), (State::Slip(..), State::Slip(..))) || self == other
    }
}

/// The solver, with the states of the last step.
pub(in super::super) struct Disc {
    states: Vec<State>,
    /// An earlier set in the search, to see where sets come round, and whether the last look has changed the set.
    mark: Vec<(State, Side)>,
    changed: bool,
    /// Where contacts were, how many differences of that are known, and whether a step begins.
    past: Vec<Past>,
    known: usize,
    begins: bool,
    /// Along the crack and across its faces, and across the valley: what answers where in the states as they are, and
    /// whether `G` has moved since.
    tableaux: [Tableau; 2],
    stale: bool,
    /// Contacts that met something when the tableaux were written.
    met: Vec<bool>,
    /// Contacts that slip; to a change of their friction, along the crack and then across the valley, what answers there,
    /// column by column: velocities along the crack, normal impulses, velocities across the valley.
    slips: Vec<usize>,
    answers: Vec<Group>,
    /// How far the solution for them has come.
    sliding: Vec<Sliding>,
    /// Factors of Newton's matrix, without pivots where there are none; how many corrections they have made, and, after a
    /// few, the inverse that they have been turned into, column by column, each filled up to whole groups.
    lu: Vec<f64>,
    pivots: Vec<usize>,
    made: usize,
    inverse: Vec<Group>,
    /// Right-hand sides, and room for answers, for a solution, and for the corrections of a set.
    x: Vec<f64>,
    sums: [Vec<Group>; 2],
    near: Vec<Group>,
    sum: Vec<Group>,
    steps: Vec<Group>,
}

/// A contact that slips on the way to its solution: friction, velocities, the normal impulse that friction is of and the
/// one that it leads to.
#[derive(Clone, Copy, Default)]
struct Sliding {
    p: [f64; 2],
    u: [f64; 2],
    normal: f64,
    pressed: f64,
    /// Velocity of an impulse, to measure by.
    per: f64,
}

/// Where a contact was at the last step: its state, its neighbour, and its impulses with their differences until there.
#[derive(Clone, Copy)]
struct Past {
    state: State,
    side: Side,
    courses: [Course; 3],
}

impl Disc {
    pub(in super::super) fn new(contacts: usize) -> Self {
        let past = Past {
            state: State::Absent,
            side: Side::None,
            courses: [[0.0; ORDER]; 3],
        };
        Disc {
            states: vec![State::Stick; contacts],
            mark: Vec::new(),
            changed: false,
            past: vec![past; contacts],
            known: 0,
            begins: false,
            tableaux: Default::default(),
            stale: true,
            met: Vec::new(),
            slips: Vec::new(),
            answers: Vec::new(),
            sliding: Vec::new(),
            lu: Vec::new(),
            pivots: Vec::new(),
            made: 0,
            inverse: Vec::new(),
            x: vec![0.0; 3 * contacts],
            sums: [2 * contacts, contacts].map(|size| vec![[0.0; LANES]; size.div_ceil(LANES)]),
            near: Vec::new(),
            sum: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// Begin a step, which starts from where the last ones lead.
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
        if rows.wide[0].is_empty() {
            let m = self.states.len();
            rows.wide = [in_groups(&problem.g, 2 * m), in_groups(&rows.g, m)];
            rows.room_for = [2 * m, m].map(|size| vec![[0.0; LANES]; size.div_ceil(LANES)]);
        } else if moved {
            let m = self.states.len();
            let [plane, across] = &mut rows.wide;
            self.stale |= refill(plane, &problem.g, 2 * m) | refill(across, &rows.g, m);
        } else if self.stale {
            // It stays as it is: tableaux of it are worth their while.
            self.met.clear();
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
            if self.sweeps(&mut way, look) {
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

    /// Let impulses and directions go on by their differences, as long as no contact changes its state.
    fn go_ahead(&mut self, way: &mut Way) {
        let m = self.states.len();
        let same =
            |(k, past): (usize, &Past)| way.rows.side[k] == past.side && self.states[k].alike(past.state);
        let lasts = self.past.iter().enumerate().all(same);
        self.known = if lasts { self.known } else { 0 };
        for (k, (state, past)) in self.states.iter_mut().zip(&mut self.past).enumerate() {
            (past.state, past.side) = (*state, way.rows.side[k]);
            let now = [way.p[k], way.p[m + k], way.rows.p[k]];
            let mut ahead = now;
            for (ahead, course) in ahead.iter_mut().zip(&mut past.courses) {
                *ahead = next(*ahead, course, self.known);
            }
            if !state.closed() && past.side == Side::None {
                continue;
            }
            if let State::Slip(to, _) = state {
                if past.side == Side::None {
                    let size = length(ahead[0], ahead[2]);
                    // Nothing has no direction.
                    let near = to[0] * ahead[0] + to[1] * ahead[2] > NEAR * size;
                    if !near {
                        continue;
                    }
                    *to = [ahead[0] / size, ahead[2] / size];
                }
            }
            (way.p[k], way.p[m + k], way.rows.p[k]) = (ahead[0], ahead[1], ahead[2]);
        }
        self.known = (self.known + 1).min(ORDER);
    }

    /// Go from set to set; false where none is right of so many, or they come round in a circle.
    #[inline(always)]
    fn go_on<W: Lanes>(&mut self, way: &mut Way, most: u32, report: &mut Report) -> bool {
        self.mark.clear();
        for trial in 1..=most {
            report.iterations += 1;
            let corrected = self.correct::<W>(way);
            if !corrected && !self.bend::<W>(way) {
                return false;
            }
            if self.turn(way) {
                return true;
            }
            if !corrected {
                // The same set goes on with other directions.
                self.mark.clear();
            } else if self.changed && self.comes_round(way) {
                return false;
            }
            if trial.is_power_of_two() {
                self.mark.clear();
                self.mark
                    .extend(self.states.iter().copied().zip(way.rows.side.iter().copied()));
            }
        }
        false
    }

    /// Whether the set is the one that was marked.
    fn comes_round(&self, way: &Way) -> bool {
        let mut now = self.states.iter().zip(&way.rows.side).zip(&self.mark);
        !self.mark.is_empty()
            && now.all(|((state, side), (marked, beside))| state.alike(*marked) && side == beside)
    }

    /// Let be given in the tableaux what the states say.
    #[inline(always)]
    fn follow<W: Lanes>(&mut self, way: &Way) {
        let m = self.states.len();
        let absent = |state: &State| *state == State::Absent;
        let new = self.met.is_empty()
            || self
                .states
                .iter()
                .zip(&self.met)
                .any(|(state, met)| !absent(state) && !met);
        if new {
            self.met.clear();
            self.met.extend(self.states.iter().map(|state| !absent(state)));
            for (tableau, (g, size)) in self.tableaux.iter_mut().zip(way.rows.wide.iter().zip([2 * m, m])) {
                tableau.begin(g, size);
            }
            self.stale = false;
            self.answers.clear();
        }
        let [plane, across] = &mut self.tableaux;
        let mut changed = self.answers.is_empty();
        for (k, state) in self.states.iter().enumerate() {
            let (sticks, stopped) = (*state == State::Stick, way.rows.side[k] != Side::None);
            if plane.given(k) != sticks {
                changed |= plane.exchange::<W>(k);
            }
            if plane.given(m + k) != state.closed() {
                changed |= plane.exchange::<W>(m + k);
            }
            if across.given(k) != (sticks || stopped) {
                changed |= across.exchange::<W>(k);
            }
        }
        let slips = |k: &usize| matches!(self.states[*k], State::Slip(..));
        changed |= (0..m).filter(slips).ne(self.slips.iter().copied());
        if changed {
            self.slips.clear();
            self.slips
                .extend((0..m).filter(|k| matches!(self.states[*k], State::Slip(..))));
            self.gather(way);
            self.pivots.clear();
        }
    }

    /// Let impulses and velocities answer to what is given now, as `x` has it.
    #[inline(always)]
    fn respond<W: Lanes>(&mut self, way: &mut Way) {
        let m = self.states.len();
        let (x, x_y) = self.x.split_at(2 * m);
        let [sums, sums_y] = &mut self.sums;
        let [plane, across] = &self.tableaux;
        plane.answers::<W>(x, sums);
        across.answers::<W>(x_y, sums_y);
        let rows = &mut *way.rows;
        for (tableau, x, y, p, u) in [
            (plane, x, sums, &mut *way.p, &mut *way.u),
            (across, x_y, sums_y, &mut rows.p[..], &mut rows.u[..]),
        ] {
            let y = y.as_flattened();
            for k in 0..x.len() {
                if tableau.given(k) {
                    p[k] += y[k];
                    u[k] += x[k];
                } else {
                    u[k] += y[k];
                }
            }
        }
    }

    /// Ask by `x` for the velocities that are given.
    #[inline(always)]
    fn ask(&mut self, way: &Way) {
        let m = self.states.len();
        let [plane, across] = &self.tableaux;
        let (x, x_y) = self.x.split_at_mut(2 * m);
        let (x_t, x_n) = x.split_at_mut(m);
        for k in 0..m {
            x_t[k] = if plane.given(k) { -way.u[k] } else { 0.0 };
            x_n[k] = if plane.given(m + k) {
                -(way.u[m + k] + way.problem.h[k])
            } else {
                0.0
            };
            x_y[k] = if across.given(k) { -way.rows.u[k] } else { 0.0 };
        }
    }

    /// Start with friction alone of what slips, in its directions, and all that is given right by the tableaux.
    #[inline(always)]
    fn start<W: Lanes>(&mut self, way: &mut Way) {
        let m = self.states.len();
        for (k, state) in self.states.iter().enumerate() {
            if !state.closed() {
                (way.p[k], way.p[m + k]) = (0.0, 0.0);
            }
            match *state {
                State::Slip(to, _) => way.lean(k, to, 0.0),
                State::Stick => {}
                State::Absent | State::Open if way.rows.side[k] != Side::None => {}
                State::Absent | State::Open => way.rows.p[k] = 0.0,
            }
        }
        if self.stale {
            way.velocities::<W>();
            self.ask(way);
        } else {
            way.u.copy_from_slice(&way.problem.b);
            way.rows.u.copy_from_slice(&way.rows.b);
            self.ask(way);
            let [plane, across] = &self.tableaux;
            let (x, x_y) = self.x.split_at_mut(2 * m);
            let rows = &mut *way.rows;
            for (tableau, x, p) in [(plane, x, &mut *way.p), (across, x_y, &mut rows.p[..])] {
                for k in 0..x.len() {
                    if tableau.given(k) {
                        p[k] = 0.0;
                    } else {
                        x[k] = p[k];
                    }
                }
            }
        }
        self.respond::<W>(way);
    }

    /// Find the impulses of the states by corrections; false where they do not come closer fast.
    #[inline(always)]
    fn correct<W: Lanes>(&mut self, way: &mut Way) -> bool {
        self.follow::<W>(way);
        let enough = RIGHT * largest(&way.problem.b).max(largest(&way.rows.b));
        self.start::<W>(way);
        let (mut before, mut anew) = (f64::INFINITY, false);
        for look in 1..=LOOKS {
            if !self.slide::<W>(way, enough) {
                return false;
            }
            way.velocities::<W>();
            let now = self.amiss(way);
            if now <= enough {
                if look > WORN {
                    self.met.clear();
                }
                return true;
            }
            if now > CLOSER * before || now.is_nan() {
                if anew || now.is_nan() {
                    break;
                }
                self.met.clear();
                self.follow::<W>(way);
                anew = true;
            }
            before = now;
            self.ask(way);
            self.respond::<W>(way);
        }
        self.met.clear();
        false
    }

    /// By how much velocities and friction are amiss.
    #[inline(always)]
    fn amiss(&self, way: &Way) -> f64 {
        let (m, rows) = (self.states.len(), &*way.rows);
        let mut worst = 0.0_f64;
        let mut note = |x: f64| {
            if x.is_nan() || x.abs() > worst {
                worst = x.abs();
            }
        };
        for (k, state) in self.states.iter().enumerate() {
            let stopped = rows.side[k] != Side::None;
            let (u_t, u_y) = (way.u[k], rows.u[k]);
            if state.closed() {
                note(way.u[m + k] + way.problem.h[k]);
            }
            if stopped || *state == State::Stick {
                note(u_y);
            }
            match *state {
                State::Stick => note(u_t),
                State::Slip([t, y], share) => {
                    let limit = way.limit(k, true, way.p[m + k]);
                    note((way.p[k] - limit * t) / way.rho(k));
                    if !stopped {
                        note((rows.p[k] - limit * y) / way.rho(k));
                        note(share * (y * u_t - t * u_y));
                    }
                }
                State::Absent | State::Open => {}
            }
        }
        worst
    }

    /// Take one step of Newton's method with directions and shares as the states have them, wherever it leads; false where
    /// there is none.
    #[inline(always)]
    fn bend<W: Lanes>(&mut self, way: &mut Way) -> bool {
        self.follow::<W>(way);
        self.start::<W>(way);
        if !self.slips.is_empty() {
            self.look(way);
            self.move_on::<W>(way);
            if !self.renew::<W>(way) {
                return false;
            }
            self.missing(way);
            self.find::<W>();
            let (count, x) = (self.slips.len(), self.sum.as_flattened());
            for (c, (sliding, &k)) in self.sliding.iter_mut().zip(&self.slips).enumerate() {
                let State::Slip([t, y], _) = self.states[k] else {
                    continue;
                };
                let (problem, normal, turn) = (way.problem, sliding.normal + x[c], x[count + c]);
                let limit = problem.mu_slip[k] * normal + problem.added(k, true, 0.0);
                sliding.p[0] = limit * t;
                if way.rows.side[k] == Side::None {
                    sliding.p = [limit * t - turn * y, limit * y + turn * t];
                }
            }
            self.pass_on(way);
            self.respond::<W>(way);
        }
        way.velocities::<W>();
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
        self.changed = false;
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
                    let (z, share) = way.slide_of(contact, [p_t, p_y], [u_t, u_y], p_n.max(0.0));
                    if share >= 1.0 {
                        next = State::Stick;
                    } else {
                        let limit = way.limit(contact, true, p_n.max(0.0));
                        let off = length(p_t - limit * z[0], p_y - limit * z[1]);
                        moved |= off > RIGHT * most;
                        next = State::Slip(z, share);
                    }
                }
                State::Absent | State::Open => {}
            }
            let same = before.alike(next);
            self.changed |= !same || next_side != side;
            right &= same && !moved;
            self.states[contact] = next;
            way.rows.side[contact] = next_side;
        }
        right
    }

    /// By what the worst contact breaks its conditions, over the impulse that would stop the fastest, or the largest.
    fn residual(&self, way: &Way) -> f64 {
        let m = self.states.len();
        let (problem, rows) = (way.problem, &*way.rows);
        let mut worst = 0.0_f64;
        // A contact that is left out moves, too.
        let mut most = (0..m).fold(0.0_f64, |most, contact| {
            let stops = [
                problem.b[contact] * problem.scale[contact],
                problem.b[m + contact] * problem.scale[m + contact],
                rows.b[contact] * rows.scale[contact],
            ];
            stops.iter().fold(most, |most, stop| most.max(stop.abs()))
        });
        // Rows of a contact that meets nothing are old.
        let there = |(_, state): &(usize, &State)| **state != State::Absent;
        for (contact, state) in self.states.iter().enumerate().filter(there) {
            let (p_t, p_n, p_y) = (way.p[contact], way.p[m + contact], rows.p[contact]);
            let scale = [problem.scale[contact], problem.scale[m + contact]];
            most = most.max(p_n);
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

    /// Direction of `z` where a contact has these friction, velocities and normal impulse, and the share of it that friction
    /// can be, without a bound.
    #[inline(always)]
    fn slide_of(&self, contact: usize, p: [f64; 2], u: [f64; 2], normal: f64) -> ([f64; 2], f64) {
        let rho = self.rho(contact);
        let z = [p[0] - rho * u[0], p[1] - rho * u[1]];
        let (size, limit) = (length(z[0], z[1]), self.limit(contact, true, normal));
        if size == 0.0 {
            return ([1.0, 0.0], f64::INFINITY);
        }
        ([z[0] / size, z[1] / size], limit / size)
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

/// Fill groups with a matrix again; whether it is another one.
fn refill(groups: &mut [Group], matrix: &[f64], count: usize) -> bool {
    let mut other = false;
    for (full, row) in groups
        .chunks_exact_mut(count.div_ceil(LANES))
        .zip(matrix.chunks_exact(count))
    {
        let full = &mut full.as_flattened_mut()[..count];
        other |= full != row;
        full.copy_from_slice(row);
    }
    other
}

/// Length of a vector; unlike `hypot` it costs next to nothing.
#[inline(always)]
fn length(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

apart! {
    /// Go from set to set with these problem and solution; false where none is right of so many.
    fn search(disc: &mut Disc, way: &mut Way<'_>, most: u32, report: &mut Report) -> bool = Disc::go_on;
}

#[cfg(test)]
mod tests {
    use super::super::super::simd::Plain;
    use super::super::super::status::Status;
    use super::super::Problem;
    use super::{Disc, Rows};

    pub(super) const CONTACTS: usize = 6;

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

    pub(super) fn problem(seed: usize, mu: f64) -> (Problem, Rows) {
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

    /// Where two contacts are of the same two nodes the other way round, each stops what the other one lets go.
    #[test]
    fn contacts_that_move_against_each_other_hold_what_is_between_them() {
        for seed in 0..30 {
            let (problem, mut rows) = problem(97 * seed, 0.8);
            let m = CONTACTS;
            for k in 0..m {
                rows.g[m + k] = -rows.g[k];
            }
            for k in 0..m {
                rows.g[k * m + 1] = -rows.g[k * m];
            }
            (rows.b[1], rows.scale[1]) = (-rows.b[0], rows.scale[0]);
            (rows.touches[0], rows.touches[1]) = ([true, false], [true, false]);
            let (_, residual) = solved(&problem, &mut rows);
            assert!(residual < 1e-8, "{seed}: {residual}");
            assert!(rows.u[0].abs() < 1e-9 && rows.u[1].abs() < 1e-9, "{seed}");
        }
    }

    /// Problems that drift from one to another, as those of steps do.
    #[test]
    fn tableaux_that_go_along_find_what_new_ones_do() {
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
}
