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
//! so that two unknowns are left of a node that slips. The states, directions and shares of the last step are tried first.
//! From step to step directions turn little: the factors of the last few sets are kept, and with them
//!
//! ```text
//! p_T = mu p_n e(phi),      u_n + h = 0,      u_q = 0      and, where it sticks,      u_T = 0
//! ```
//!
//! are solved by corrections of p and phi, as long as each leaves little of what was amiss. Where sets of states come round in a circle, sweeps help: each node by itself, the others held, has a solution by one
//! number `lambda >= 0` with `u_T = -lambda p_T`.
//!
//! A neighbour that a node touches is a plastic stop: where it pushes, `u_y = 0`, it takes all that acts across the valley,
//! and friction acts along the crack alone. The forces that a node bears there are a convex set, half of a disc and half of a
//! strip, to which the slip is normal; one that stopped a node within a step would make them jump.

use super::super::simd::{apart, fill, fma, in_groups, inlined, largest, Group, Lanes, LANES};
use super::super::status::Status;
use super::problem::Problem;
use super::triangles::{eliminate, inverse, substitute};
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
/// Sets whose factors are kept; corrections by old ones at most, and what each may leave of what was amiss.
const KEPT: usize = 16;
const CORRECTIONS: u32 = 12;
const CLOSER: f64 = 0.25;
/// Solutions by the same factors after which their inverse pays.
const INVERT_AFTER: u32 = 3;
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

/// An impulse that is not known: what it is to its contact, what its equation feels there, and of itself beside.
#[derive(Clone, Copy)]
struct Unknown {
    contact: usize,
    column: [f64; 3],
    row: [f64; 3],
    own: f64,
    right: f64,
}

/// The solver, with the states of the last step.
pub(in super::super) struct Disc {
    states: Vec<State>,
    unknowns: Vec<Unknown>,
    x: Vec<f64>,
    sum: Vec<Group>,
    /// The factors of the last few sets, and the one in use.
    kept: Vec<Factors>,
    now: usize,
    turns: u64,
}

/// The factors of a set of states, in the directions and with the shares that it had.
#[derive(Default)]
struct Factors {
    /// The set they belong to; empty where they are good for nothing any more.
    of: Vec<(State, Side)>,
    lu: Vec<f64>,
    pivots: Vec<usize>,
    /// How often they have been used, and the inverse, column by column, once that pays.
    used: u32,
    inverse: Vec<Group>,
    /// When they came into use last.
    turn: u64,
}

impl Disc {
    pub(in super::super) fn new(contacts: usize) -> Self {
        Disc {
            states: vec![State::Stick; contacts],
            unknowns: Vec::new(),
            x: Vec::new(),
            sum: Vec::new(),
            kept: (0..KEPT).map(|_| Factors::default()).collect(),
            now: 0,
            turns: 0,
        }
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

    /// Go from set to set; false where none is right of so many.
    #[inline(always)]
    fn go_on<W: Lanes>(&mut self, way: &mut Way, most: u32, report: &mut Report) -> bool {
        for _ in 0..most {
            report.iterations += 1;
            if !self.correct::<W>(way) {
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

    /// Correct the impulses of the last step by the factors of the set of states; false where these are not known, or do
    /// not come closer fast.
    #[inline(always)]
    fn correct<W: Lanes>(&mut self, way: &mut Way) -> bool {
        let (states, side) = (&self.states, &way.rows.side);
        let same = |factors: &Factors| {
            let sides = states.iter().zip(side);
            let mut pairs = sides.zip(&factors.of);
            factors.of.len() == states.len()
                && pairs.all(|((state, side), (of, of_side))| {
                    side == of_side && std::mem::discriminant(state) == std::mem::discriminant(of)
                })
        };
        if !same(&self.kept[self.now]) {
            let Some(known) = self.kept.iter().position(same) else {
                return false;
            };
            self.turns += 1;
            (self.now, self.kept[known].turn) = (known, self.turns);
        }
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
        let mut before = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            way.velocities::<W>();
            let now = self.amiss(way);
            if now <= enough {
                return true;
            }
            if now > CLOSER * before || now.is_nan() {
                break;
            }
            before = now;
            self.solve_known::<W>();
            if !self.apply(way) {
                break;
            }
        }
        self.kept[self.now].of.clear();
        false
    }

    /// Turn the right-hand sides into the solution by the factors in use, or by their inverse.
    #[inline(always)]
    fn solve_known<W: Lanes>(&mut self) {
        let (factors, n) = (&mut self.kept[self.now], self.x.len());
        factors.used += 1;
        if factors.used < INVERT_AFTER || n == 0 {
            return substitute::<W>(&factors.lu, &factors.pivots, &mut self.x);
        }
        if factors.used == INVERT_AFTER {
            inverse::<W>(&factors.lu, &factors.pivots, n, &mut factors.inverse);
        }
        let stride = n.div_ceil(LANES);
        self.sum.clear();
        self.sum.resize(stride, [0.0; LANES]);
        inlined::combine::<W>(&factors.inverse, stride, &self.x, &mut self.sum);
        self.x.copy_from_slice(&self.sum.as_flattened()[..n]);
    }

    /// Write by what the velocities are amiss, as right-hand sides, and return the most of it.
    #[inline(always)]
    fn amiss(&mut self, way: &Way) -> f64 {
        let (m, rows, x) = (self.states.len(), &*way.rows, &mut self.x);
        x.clear();
        for (contact, state) in self.states.iter().enumerate() {
            let stopped = rows.side[contact] != Side::None;
            let (u_t, u_n) = (way.u[contact], way.u[m + contact] + way.problem.h[contact]);
            match *state {
                State::Stick => {
                    x.extend([-u_t, -u_n]);
                    if !stopped {
                        x.push(-rows.u[contact]);
                    }
                }
                State::Slip([t, y], _) => {
                    x.push(-u_n);
                    if !stopped {
                        let share = match self.kept[self.now].of[contact].0 {
                            State::Slip(_, share) => share,
                            _ => 1.0,
                        };
                        x.push(share * (y * u_t - t * rows.u[contact]));
                    }
                }
                State::Absent | State::Open => {}
            }
            if stopped {
                x.push(-rows.u[contact]);
            }
        }
        largest(x)
    }

    /// Change impulses and directions by the solution; false where a node that slips is not pressed any more.
    #[inline(always)]
    fn apply(&mut self, way: &mut Way) -> bool {
        let m = self.states.len();
        let mut x = self.x.iter();
        let mut next = || x.next().copied().unwrap_or(0.0);
        for (contact, state) in self.states.iter_mut().enumerate() {
            let stopped = way.rows.side[contact] != Side::None;
            match state {
                State::Stick => {
                    way.p[contact] += next();
                    way.p[m + contact] += next();
                    if !stopped {
                        way.rows.p[contact] += next();
                    }
                }
                State::Slip(to, _) => {
                    let normal = next();
                    if !stopped {
                        let limit = way.problem.mu_slip[contact] * (way.p[m + contact] + normal);
                        if limit <= 0.0 {
                            return false;
                        }
                        let turn = next() / limit;
                        let turned = [to[0] - to[1] * turn, to[1] + to[0] * turn];
                        let size = length(turned[0], turned[1]);
                        *to = [turned[0] / size, turned[1] / size];
                    }
                    way.lean(contact, *to, normal);
                }
                State::Absent | State::Open => {}
            }
            if stopped {
                way.rows.p[contact] += next();
            }
        }
        true
    }

    /// Find the impulses of the states as they are; false where they have none.
    #[inline(always)]
    fn impulses<W: Lanes>(&mut self, way: &mut Way) -> bool {
        self.write(way);
        self.turns += 1;
        let oldest = (0..KEPT).min_by_key(|k| self.kept[*k].turn * u64::from(!self.kept[*k].of.is_empty()));
        self.now = oldest.unwrap_or(0);
        self.assemble::<W>(way);
        let factors = &mut self.kept[self.now];
        factors.of.clear();
        if !eliminate::<W>(&mut factors.lu, self.unknowns.len(), &mut factors.pivots) {
            return false;
        }
        let sides = self.states.iter().copied().zip(way.rows.side.iter().copied());
        factors.of.extend(sides);
        (factors.turn, factors.used) = (self.turns, 0);
        self.x.clear();
        self.x.extend(self.unknowns.iter().map(|unknown| unknown.right));
        substitute::<W>(&factors.lu, &factors.pivots, &mut self.x);
        let m = self.states.len();
        way.p.fill(0.0);
        way.rows.p.fill(0.0);
        for (unknown, x) in self.unknowns.iter().zip(&self.x) {
            let [t, n, y] = unknown.column;
            way.p[unknown.contact] += t * x;
            way.p[m + unknown.contact] += n * x;
            way.rows.p[unknown.contact] += y * x;
        }
        true
    }

    /// Write the unknowns.
    fn write(&mut self, way: &Way) {
        let (problem, rows, m) = (way.problem, &*way.rows, self.states.len());
        self.unknowns.clear();
        for (contact, state) in self.states.iter().enumerate() {
            let b = [
                problem.b[contact],
                problem.b[m + contact] + problem.h[contact],
                rows.b[contact],
            ];
            let mut add = |column: [f64; 3], row: [f64; 3], own: f64, right: f64| {
                self.unknowns.push(Unknown {
                    contact,
                    column,
                    row,
                    own,
                    right,
                });
            };
            let stopped = rows.side[contact] != Side::None;
            match *state {
                State::Stick => {
                    add([1.0, 0.0, 0.0], [1.0, 0.0, 0.0], 0.0, -b[0]);
                    add([0.0, 1.0, 0.0], [0.0, 1.0, 0.0], 0.0, -b[1]);
                    if !stopped {
                        add([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 0.0, -b[2]);
                    }
                }
                State::Slip([t, y], share) => {
                    let mu = problem.mu_slip[contact];
                    add([mu * t, 1.0, mu * y], [0.0, 1.0, 0.0], 0.0, -b[1]);
                    if !stopped {
                        let across = [-share * y, 0.0, share * t];
                        let right = share * (y * b[0] - t * b[2]);
                        add([-y, 0.0, t], across, (1.0 - share) / way.rho(contact), right);
                    }
                }
                State::Absent | State::Open => {}
            }
            if stopped {
                add([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 0.0, -b[2]);
            }
        }
    }

    /// Write the matrix of the unknowns, column by column.
    #[inline(always)]
    fn assemble<W: Lanes>(&mut self, way: &Way) {
        let (m, g, g_y) = (self.states.len(), &way.problem.g, &way.rows.g);
        let lu = &mut self.kept[self.now].lu;
        lu.clear();
        for (c, one) in self.unknowns.iter().enumerate() {
            let [t, n, y] = one.column;
            let along = &g[one.contact * 2 * m..][..2 * m];
            let normal = &g[(m + one.contact) * 2 * m..][..2 * m];
            let across = &g_y[one.contact * m..][..m];
            for (r, other) in self.unknowns.iter().enumerate() {
                let (k, row) = (other.contact, &other.row);
                let felt = [
                    fma::<W>(t, along[k], n * normal[k]),
                    fma::<W>(t, along[m + k], n * normal[m + k]),
                    y * across[k],
                ];
                let own = if r == c { one.own } else { 0.0 };
                let value = fma::<W>(row[0], felt[0], fma::<W>(row[1], felt[1], row[2] * felt[2]));
                lu.push(value + own);
            }
        }
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
            let [mu_stick, mu_slip] = [way.problem.mu_stick[contact], way.problem.mu_slip[contact]];
            let (mut moved, mut next) = (next_side != side, before);
            match before {
                State::Open if u_n < -slack_u => next = State::Stick,
                State::Stick | State::Slip(..) if p_n < -slack_p => next = State::Open,
                State::Stick => {
                    let across = if stopped { 0.0 } else { p_y };
                    let size = length(p_t, across);
                    if size > mu_stick * p_n.max(0.0) + slack_p {
                        let share = mu_slip * p_n.max(0.0) / size;
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
                    let (size, limit) = (length(z[0], z[1]), mu_slip * p_n.max(0.0));
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
            let limit = way.problem.mu_stick[contact] * way.p[m + contact].max(0.0);
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
        for (contact, state) in self.states.iter().enumerate() {
            let (p_t, p_n, p_y) = (way.p[contact], way.p[m + contact], rows.p[contact]);
            let scale = [problem.scale[contact], problem.scale[m + contact]];
            let stops = (problem.b[contact] * scale[0])
                .abs()
                .max((problem.b[m + contact] * scale[1]).abs())
                .max((rows.b[contact] * rows.scale[contact]).abs());
            most = most.max(p_n).max(stops);
            let apart = p_n.min((way.u[m + contact] + problem.h[contact]) * scale[1]);
            let mu = if *state == State::Stick {
                problem.mu_stick[contact]
            } else {
                problem.mu_slip[contact]
            };
            let (limit, rho) = (mu * p_n.max(0.0), way.rho(contact));
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

    /// Let friction lean this way, with a change of the normal impulse.
    #[inline(always)]
    fn lean(&mut self, contact: usize, [t, y]: [f64; 2], change: f64) {
        let m = self.rows.p.len();
        let normal = self.p[m + contact] + change;
        let limit = self.problem.mu_slip[contact] * normal;
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
        if stick[1] >= 0.0 && size(stick) <= self.mu[0] * stick[1] {
            return (State::Stick, stick);
        }
        let too_much = |lambda: f64| {
            let p = at(lambda);
            size(p) > self.mu[1] * p[1]
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
