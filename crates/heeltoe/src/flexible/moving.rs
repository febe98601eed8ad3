//! One body of the dam on its way through time by the scheme of [`super::step`]:
//!
//! ```text
//! v_f = d (v + dt f - gamma dV - dt (c late v + omega^2 (q + dt theta late v))),      late = 1 - theta
//! v' = v_f + d shapes^T p,      q' = q + dt v*,      d = 1 / (1 + theta dt c + theta^2 dt^2 omega^2)
//! ```
//!
//! The last half of one step and the first half of the next go over the mode shapes together, as reading them is what a
//! step costs.

use super::body::{dot, fma, total, Group, ReducedBody, BUNDLE, LANES};
use super::ledger::Sums;
use super::start::Still;

/// Length of a step, and weight of the new state in it.
#[derive(Clone, Copy)]
pub(super) struct TimeStep {
    pub dt: f64,
    pub theta: f64,
}

/// What a body needs for a given step, for both states of damping.
pub(super) struct Operator {
    d: [Vec<Group>; 2],
    /// Answer of the crack nodes to impulses on them, row by row.
    pub w: [Vec<f64>; 2],
    /// Answer of the dashpots to impulses on the crack nodes, a row for each dashpot, and to their own.
    damper_crack: [Vec<f64>; 2],
    pub damper_own: [Vec<f64>; 2],
}

impl Operator {
    fn new(body: &ReducedBody, step: TimeStep) -> Self {
        let TimeStep { dt, theta } = step;
        let d = [0, 1].map(|state| {
            let pairs = body.damping[state].iter().zip(&body.omega_squared);
            pairs
                .map(|(c, w)| {
                    std::array::from_fn(|l| 1.0 / (1.0 + theta * dt * c[l] + theta * theta * dt * dt * w[l]))
                })
                .collect::<Vec<Group>>()
        });
        let all = [0, 1].map(|state: usize| body.compliance(&d[state]));
        let (columns, width) = (body.columns(), body.width());
        let block = |rows: std::ops::Range<usize>, within: std::ops::Range<usize>| {
            let cut = |whole: &Vec<f64>| -> Vec<f64> {
                let rows = whole.chunks_exact(width).skip(rows.start).take(rows.len());
                rows.flat_map(|row| &row[within.clone()]).copied().collect()
            };
            [cut(&all[0]), cut(&all[1])]
        };
        Operator {
            w: block(0..columns, 0..columns),
            damper_crack: block(columns..width, 0..columns),
            damper_own: block(columns..width, columns..width),
            d,
        }
    }
}

/// The state of a body, and room for a step.
pub(super) struct Moving<'a> {
    pub body: &'a ReducedBody,
    pub operator: Operator,
    /// Modes at the start, and since then.
    start: &'a [Group],
    pub q: Vec<Group>,
    /// Forces of contact before the earthquake on the crack nodes, where they hold the dam, and what is left of the
    /// static loads without them.
    held: &'a [f64],
    left: Vec<Group>,
    /// How the crack nodes answer when these forces are taken away for a step, for both states of damping.
    released: [Vec<f64>; 2],
    pub v: Vec<Group>,
    v_free: Vec<Group>,
    /// Of the crack nodes: position, velocity, velocity without contact, impulse.
    pub position: Vec<f64>,
    pub velocity: Vec<f64>,
    pub free: Vec<f64>,
    pub impulse: Vec<f64>,
    /// Impulse of what acts in the crack beside contact; stays zero where there is nothing.
    pub push: Vec<f64>,
    /// Rates of the dashpots but for the impulses of dashpots and contact; impulses of the dashpots.
    pub strain: Vec<f64>,
    pub pull: Vec<f64>,
    answer: Vec<f64>,
    /// All impulses, those of the dashpots last.
    pushes: Vec<f64>,
    /// Room for the sums of `free` and `strain`, lane by lane.
    lanes: Vec<Group>,
    pub sums: Sums,
}

/// One step's ground: changes of velocity and the state of damping.
#[derive(Clone, Copy)]
pub(super) struct Drive {
    pub ground: [f64; 2],
    pub damping: usize,
}

impl<'a> Moving<'a> {
    /// `face` is 0 for the body above the crack, 1 for that below; without a state before the earthquake it starts from
    /// that with the crack bonded.
    pub(super) fn new(body: &'a ReducedBody, still: Option<&'a Still>, face: usize, step: TimeStep) -> Self {
        let columns = body.columns();
        let zeros = vec![0.0; columns];
        let start = still.map_or(&body.start[..], |still| &still.modes[face]);
        let mut left = vec![[0.0; LANES]; body.groups()];
        // Against the state before the earthquake loads and stress add up to the forces of contact, to the last bit.
        for (group, left) in left.iter_mut().enumerate() {
            for (l, left) in left.iter_mut().enumerate() {
                if still.is_none() {
                    *left = body.load[group][l] - body.omega_squared[group][l] * start[group][l];
                }
            }
        }
        let operator = Operator::new(body, step);
        let force = still.map_or(&[][..], |still| &still.force[face]);
        let away: Vec<f64> = force.iter().map(|force| -step.dt * force).collect();
        let released = [0, 1].map(|state: usize| {
            let mut answer = zeros.clone();
            answered::<false>(&operator.w[state], &away, &mut answer);
            answer
        });
        Moving {
            body,
            operator,
            released,
            start,
            q: vec![[0.0; LANES]; body.groups()],
            held: still.map_or(&[], |still| &still.force[face]),
            left,
            v: vec![[0.0; LANES]; body.groups()],
            v_free: vec![[0.0; LANES]; body.groups()],
            position: still.map_or_else(|| body.position.clone(), |still| still.position[face].clone()),
            velocity: zeros.clone(),
            free: zeros.clone(),
            impulse: zeros.clone(),
            push: zeros.clone(),
            strain: vec![0.0; body.dampers],
            pull: vec![0.0; body.dampers],
            answer: zeros,
            pushes: vec![0.0; body.width()],
            lanes: vec![[0.0; LANES]; body.width()],
            sums: Sums::default(),
        }
    }

    /// Finish the step `now` with the impulses found, unless this is the start, and begin the step `next`.
    #[inline(always)]
    pub(super) fn advance<const FUSED: bool>(&mut self, now: Option<Drive>, next: Drive, step: TimeStep) {
        let (columns, width) = (self.body.columns(), self.body.width());
        self.pushes[..columns].copy_from_slice(&self.impulse);
        self.pushes[columns..].copy_from_slice(&self.pull);
        let touched = self.pushes.iter().any(|p| *p != 0.0);
        self.lanes.fill([0.0; LANES]);
        let body = self.body;
        for (bundle, shapes) in body.shapes.chunks_exact(BUNDLE * width).enumerate() {
            let first = BUNDLE * bundle;
            let (s0, rest) = shapes.split_at(width);
            let (s1, rest) = rest.split_at(width);
            let (s2, s3) = rest.split_at(width);
            let rows = s0.iter().zip(s1).zip(s2).zip(s3);
            if let Some(now) = now {
                let mut push = [[0.0; LANES]; BUNDLE];
                if touched {
                    push[..2].copy_from_slice(&pushes::<FUSED>(s0, s1, &self.pushes));
                    push[2..].copy_from_slice(&pushes::<FUSED>(s2, s3, &self.pushes));
                }
                for (k, push) in push.iter().enumerate() {
                    self.finish::<FUSED>(first + k, push, now, step);
                }
            }
            let mut v = [[0.0; LANES]; BUNDLE];
            for (k, v) in v.iter_mut().enumerate() {
                *v = self.begin::<FUSED>(first + k, next, step);
            }
            for (sum, (((a, b), c), d)) in self.lanes.iter_mut().zip(rows) {
                let mut new = *sum;
                product::<FUSED>(&mut new, a, &v[0]);
                product::<FUSED>(&mut new, b, &v[1]);
                product::<FUSED>(&mut new, c, &v[2]);
                product::<FUSED>(&mut new, d, &v[3]);
                *sum = new;
            }
        }
        for (free, sum) in self.free.iter_mut().chain(&mut self.strain).zip(&self.lanes) {
            *free = total(sum);
        }
    }

    /// Move the modes of a group to the end of the step and book their energies; `push` is the impulse on each.
    #[inline(always)]
    fn finish<const FUSED: bool>(&mut self, group: usize, push: &Group, now: Drive, step: TimeStep) {
        let TimeStep { dt, theta } = step;
        let body = self.body;
        // Copies, so that the compiler sees that nothing overlaps, and uses wide registers.
        let (w, load) = (body.omega_squared[group], body.load[group]);
        let gamma = [body.participation[0][group], body.participation[1][group]];
        let c = body.damping[now.damping][group];
        let d = self.operator.d[now.damping][group];
        let free = self.v_free[group];
        let (mut q, mut v, mut sums) = (self.q[group], self.v[group], self.sums);
        for l in 0..LANES {
            let v_new = fma::<FUSED>(d[l], push[l], free[l]);
            let mean = fma::<FUSED>(theta, v_new, (1.0 - theta) * v[l]);
            let way = dt * mean;
            let drive = load[l] * dt - gamma[0][l] * now.ground[0] - gamma[1][l] * now.ground[1];
            let work = drive * mean;
            sums.input[l] += work;
            sums.turnover[l] += work.abs();
            sums.damping[l] = fma::<FUSED>(c[l] * mean, way, sums.damping[l]);
            let dv = v_new - v[l];
            sums.numerical[l] += (theta - 0.5) * fma::<FUSED>(dv, dv, w[l] * way * way);
            q[l] += way;
            v[l] = v_new;
        }
        (self.q[group], self.v[group], self.sums) = (q, v, sums);
    }

    /// Return, and keep, the velocities that the modes of a group would have after the step without contact.
    #[inline(always)]
    fn begin<const FUSED: bool>(&mut self, group: usize, next: Drive, step: TimeStep) -> Group {
        let TimeStep { dt, theta } = step;
        let late = 1.0 - theta;
        let body = self.body;
        let (w, load) = (body.omega_squared[group], self.left[group]);
        let gamma = [body.participation[0][group], body.participation[1][group]];
        let c = body.damping[next.damping][group];
        let d = self.operator.d[next.damping][group];
        let (q, v) = (self.q[group], self.v[group]);
        let mut free = [0.0; LANES];
        for l in 0..LANES {
            let drive = load[l] * dt - gamma[0][l] * next.ground[0] - gamma[1][l] * next.ground[1];
            let spring = w[l] * fma::<FUSED>(dt * theta * late, v[l], q[l]);
            free[l] = d[l] * (v[l] + drive - dt * fma::<FUSED>(c[l] * late, v[l], spring));
        }
        self.v_free[group] = free;
        free
    }

    /// Add to the velocities of the crack nodes without contact what `push` changes in them; where this is no more than
    /// the forces of contact at rest, `alone`, that is known.
    #[inline(always)]
    pub(super) fn push_crack<const FUSED: bool>(&mut self, damping: usize, alone: bool) {
        if alone {
            for (free, change) in self.free.iter_mut().zip(&self.released[damping]) {
                *free += change;
            }
            return;
        }
        answered::<FUSED>(&self.operator.w[damping], &self.push, &mut self.free);
    }

    /// Whether nothing moves this part.
    pub(super) fn rests(&self) -> bool {
        let zero = |numbers: &[f64]| numbers.iter().all(|x| *x == 0.0);
        zero(&self.free) && zero(&self.velocity) && zero(&self.push) && zero(&self.strain) && zero(&self.pull)
    }

    /// Take away the forces of contact that the state before the earthquake has in it; `alone` where nothing else acts.
    #[inline(always)]
    pub(super) fn let_go(&mut self, dt: f64, alone: bool) {
        if alone {
            self.push.fill(0.0);
        }
        for (push, held) in self.push.iter_mut().zip(self.held) {
            *push -= dt * held;
        }
    }

    /// Total modes.
    pub(super) fn amplitudes(&self) -> Vec<Group> {
        let sum = |(a, b): (&Group, &Group)| -> Group { std::array::from_fn(|l| a[l] + b[l]) };
        self.start.iter().zip(&self.q).map(sum).collect()
    }

    /// Add how the dashpots answer to impulses on the crack nodes.
    #[inline(always)]
    pub(super) fn at_dampers(&self, damping: usize, impulse: &[f64], rate: &mut [f64]) {
        let rows = self.operator.damper_crack[damping].chunks_exact(impulse.len());
        for (rate, row) in rate.iter_mut().zip(rows) {
            *rate += dot(row, impulse);
        }
    }

    /// Add to the velocities of the crack nodes without contact how they answer to impulses of the dashpots.
    #[inline(always)]
    pub(super) fn pull_crack(&mut self, damping: usize, pull: &[f64]) {
        let rows = self.operator.damper_crack[damping].chunks_exact(self.free.len());
        for (pull, row) in pull.iter().zip(rows) {
            for (free, w) in self.free.iter_mut().zip(row) {
                *free += pull * w;
            }
        }
    }

    /// Add what the dashpots feel of a unit impulse on the nodes of a contact, with their weights.
    pub(super) fn felt_by_dampers(
        &self,
        damping: usize,
        nodes: &[(usize, f64); 2],
        direction: usize,
        rate: &mut [f64],
    ) {
        let offset = direction * self.body.nodes;
        let rows = self.operator.damper_crack[damping].chunks_exact(self.free.len());
        for (rate, row) in rate.iter_mut().zip(rows) {
            *rate += nodes
                .iter()
                .map(|&(node, weight)| weight * row[offset + node])
                .sum::<f64>();
        }
    }

    /// Count `push` with the impulses of contact, which have been used by themselves where they must be.
    #[inline(always)]
    pub(super) fn join_push(&mut self) {
        for (impulse, push) in self.impulse.iter_mut().zip(&self.push) {
            *impulse += push;
        }
    }

    /// Velocities and positions of the crack nodes at the end of the step.
    #[inline(always)]
    pub(super) fn move_crack<const FUSED: bool>(&mut self, damping: usize, step: TimeStep) {
        self.answer.copy_from_slice(&self.free);
        answered::<FUSED>(&self.operator.w[damping], &self.impulse, &mut self.answer);
        let TimeStep { dt, theta } = step;
        for ((x, u), new) in self.position.iter_mut().zip(&mut self.velocity).zip(&self.answer) {
            *x += dt * fma::<FUSED>(theta, *new, (1.0 - theta) * *u);
            *u = *new;
        }
    }
}

/// Add to velocities how the crack nodes answer to impulses.
#[inline(always)]
fn answered<const FUSED: bool>(w: &[f64], impulse: &[f64], velocity: &mut [f64]) {
    for (p, row) in impulse.iter().zip(w.chunks_exact(velocity.len())) {
        if *p != 0.0 {
            for (u, w) in velocity.iter_mut().zip(row) {
                *u = fma::<FUSED>(*p, *w, *u);
            }
        }
    }
}

/// Impulses on the modes of two groups. Two at a time keep the machine busy, and compilers still see the lanes.
#[inline(always)]
fn pushes<const FUSED: bool>(a: &[Group], b: &[Group], impulse: &[f64]) -> [Group; 2] {
    let mut push = [[0.0; LANES]; 2];
    for ((a, b), p) in a.iter().zip(b).zip(impulse) {
        for l in 0..LANES {
            push[0][l] = fma::<FUSED>(a[l], *p, push[0][l]);
            push[1][l] = fma::<FUSED>(b[l], *p, push[1][l]);
        }
    }
    push
}

/// `sum += a b`, lane by lane.
#[inline(always)]
fn product<const FUSED: bool>(sum: &mut Group, a: &Group, b: &Group) {
    for l in 0..LANES {
        sum[l] = fma::<FUSED>(a[l], b[l], sum[l]);
    }
}
