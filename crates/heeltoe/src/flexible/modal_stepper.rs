//! One body of the dam on its way through time by the scheme of [`super::step`]:
//!
//! ```text
//! v_f = d (v + dt f - gamma dV - dt (c late v + omega^2 (q + dt theta late v))),      late = 1 - theta
//! v' = v_f + d shapes^T p,      q' = q + dt v*,      d = 1 / (1 + theta dt c + theta^2 dt^2 omega^2)
//! ```
//!
//! Where a boundary takes energy, `c` and `d` are matrices. Then `D` of a step is known and `c` is not needed: with `g` the
//! momentum that a step begins with and the impulses in it
//!
//! ```text
//! v* = D g,      g = v + theta (dt (f - omega^2 q) - gamma dV + shapes^T p),      v' = (v* - late v) / theta
//! ```
//!
//! The last half of one step and the first half of the next go over the mode shapes together, as reading them is what a
//! step costs.

use super::scheme::TimeStep;
use std::borrow::Cow;

use super::body::{ReducedBody, BUNDLE};
use super::boundary::{Boundary, Room};
use super::compliance::Compliance;
use super::ledger::Sums;
use super::panels::Panels;
use super::simd::{apart, combine, fma, inlined, Group, Lanes, Plain, LANES};
use super::still::Still;

/// What a body needs for a given step, for both states of damping.
pub(super) struct Operator {
    d: [Vec<Group>; 2],
    /// Compliance of crack and dashpots to impulses on them, row by row.
    w: [Vec<Group>; 2],
    /// What impulses of the links are to the crack nodes.
    linked: [Panels; 2],
    /// Where a boundary takes energy.
    boundary: Option<[Boundary; 2]>,
}

impl Operator {
    fn new(body: &ReducedBody, step: TimeStep) -> Self {
        let TimeStep { dt, theta } = step;
        if let Some(boundary) = &body.boundary {
            let [(sticking, one), (free, other)] =
                [0, 1].map(|state: usize| Boundary::new(body, boundary, state, step));
            let w = [one, other];
            return Operator {
                d: [Vec::new(), Vec::new()],
                linked: Operator::linked(body, &w),
                w,
                boundary: Some([sticking, free]),
            };
        }
        let d = [0, 1].map(|state| {
            let pairs = body.damping[state].iter().zip(&body.omega_squared);
            pairs
                .map(|(c, w)| {
                    std::array::from_fn(|l| 1.0 / (1.0 + theta * dt * c[l] + theta * theta * dt * dt * w[l]))
                })
                .collect::<Vec<Group>>()
        });
        let w = [0, 1].map(|state: usize| body.compliance(&d[state]));
        Operator {
            d,
            linked: Operator::linked(body, &w),
            w,
            boundary: None,
        }
    }

    fn linked(body: &ReducedBody, w: &[Vec<Group>; 2]) -> [Panels; 2] {
        let (columns, stride) = (body.columns(), body.stride());
        [0, 1].map(|state: usize| Panels::new(&w[state][columns * stride..], stride, columns.div_ceil(LANES)))
    }
}

/// The state of a body, and room for a step.
pub(super) struct ModalStepper<'a> {
    pub body: &'a ReducedBody,
    pub operator: Operator,
    /// Modes at the start, and since then.
    start: &'a [Group],
    pub q: Vec<Group>,
    /// Forces of contact before the earthquake on the crack nodes, where they hold the dam, and what is left of the
    /// static loads without them.
    held: &'a [f64],
    left: Vec<Group>,
    /// The static loads as the motion has them: those that the forces and the stress of the start balance to the last bit.
    balanced: Cow<'a, [Group]>,
    /// How crack and dashpots answer when these forces are taken away for a step, for both states of damping.
    released: [Vec<Group>; 2],
    pub v: Vec<Group>,
    /// What the step would end with without contact; with a boundary that takes energy, the momentum it begins with.
    v_free: Vec<Group>,
    /// With such a boundary: `v*`, and room for the numbers of a block.
    mean: Vec<Group>,
    room: Room,
    /// Of the crack nodes: position, velocity, impulse.
    pub position: Vec<f64>,
    pub velocity: Vec<f64>,
    pub impulse: Vec<f64>,
    /// Velocities of the crack nodes without contact, then the mean rates of the links over `theta`, and with contact.
    pub free: Vec<Group>,
    pub answer: Vec<Group>,
    /// Impulse of what acts in the crack beside contact; stays zero where there is nothing.
    pub push: Vec<f64>,
    /// Impulses of the dashpots.
    pub pull: Vec<f64>,
    /// All impulses, those of the dashpots last.
    pushes: Vec<f64>,
    /// Room for the sums of `free`, lane by lane, and for those that fill up its last group.
    lanes: Vec<Group>,
    pub sums: Sums,
}

/// Add the products of the shapes of each component in a bundle with these groups to its lanes.
#[inline(always)]
fn add_products<W: Lanes>(shapes: &[[Group; BUNDLE]], values: [W; BUNDLE], lanes: &mut [Group]) {
    for (sum, shapes) in lanes.iter_mut().zip(shapes) {
        let mut new = W::load(sum);
        for k in 0..BUNDLE {
            new = values[k].fma(W::load(&shapes[k]), new);
        }
        new.store(sum);
    }
}

/// One step's ground: changes of velocity and the state of damping.
#[derive(Clone, Copy)]
pub(super) struct Drive {
    pub ground: [f64; 2],
    pub damping: usize,
}

/// The loads that balance the stress of these modes and these forces on the crack.
fn balancing(body: &ReducedBody, modes: &[Group], force: &[f64]) -> Vec<Group> {
    let balance = |(group, q): (usize, &Group)| -> Group {
        let push = body.on_modes(group, force);
        std::array::from_fn(|l| body.omega_squared[group][l] * q[l] - push[l])
    };
    modes.iter().enumerate().map(balance).collect()
}

impl<'a> ModalStepper<'a> {
    /// Without a state before the earthquake the `part`, counted from the crest down, starts from that with the cracks
    /// bonded.
    pub(super) fn new(body: &'a ReducedBody, still: Option<&'a Still>, part: usize, step: TimeStep) -> Self {
        let columns = body.columns();
        let zeros = vec![0.0; columns];
        let start = still.map_or(&body.start[..], |still| &still.modes[part]);
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
        let room = vec![[0.0; LANES]; body.stride()];
        let force = still.map_or(&[][..], |still| &still.force[part]);
        let away: Vec<f64> = force.iter().map(|force| -step.dt * force).collect();
        let released = [0, 1].map(|state: usize| {
            let mut answer = room.clone();
            combine::<Plain>(&operator.w[state], &away, &mut answer);
            answer
        });
        ModalStepper {
            body,
            operator,
            released,
            start,
            q: vec![[0.0; LANES]; body.groups()],
            held: still.map_or(&[], |still| &still.force[part]),
            left,
            balanced: still.map_or(Cow::Borrowed(&body.load), |still| {
                Cow::Owned(balancing(body, start, &still.force[part]))
            }),
            v: vec![[0.0; LANES]; body.groups()],
            v_free: vec![[0.0; LANES]; body.groups()],
            mean: vec![[0.0; LANES]; if body.boundary.is_some() { body.groups() } else { 0 }],
            room: Room::new(body),
            position: still.map_or_else(|| body.position.clone(), |still| still.position[part].clone()),
            velocity: zeros.clone(),
            impulse: zeros.clone(),
            free: room.clone(),
            answer: room,
            push: zeros,
            pull: vec![0.0; body.links()],
            pushes: vec![0.0; body.width()],
            lanes: vec![[0.0; LANES]; LANES * body.stride()],
            sums: Sums::default(),
        }
    }

    /// What [`advance`] does.
    #[inline(always)]
    fn go_on<W: Lanes>(&mut self, now: Option<Drive>, next: Drive, step: TimeStep) {
        let (columns, width) = (self.body.columns(), self.body.width());
        let late = (1.0 - step.theta) / step.theta;
        self.pushes[..columns].copy_from_slice(&self.impulse);
        self.pushes[columns..].copy_from_slice(&self.pull);
        let touched = self.pushes.iter().any(|p| *p != 0.0);
        if self.operator.boundary.is_some() {
            return advance_absorbing::<W>(self, now.map(|now| (now, touched)), next, step);
        }
        self.lanes.fill([0.0; LANES]);
        let (body, mut sums) = (self.body, self.sums);
        for (bundle, shapes) in body.shapes.chunks_exact(BUNDLE * width).enumerate() {
            let first = BUNDLE * bundle;
            if let Some(now) = now {
                let mut push = [[0.0; LANES]; BUNDLE];
                if touched {
                    inlined::combine::<W>(shapes, BUNDLE, &self.pushes, &mut push);
                }
                for (k, push) in push.iter().enumerate() {
                    self.finish::<W>(first + k, push, now, step, &mut sums);
                }
            }
            let (mut v, mut mean) = ([W::all(0.0); BUNDLE], [W::all(0.0); BUNDLE]);
            for (k, (v, mean)) in v.iter_mut().zip(&mut mean).enumerate() {
                *v = W::load(&self.begin::<W>(first + k, next, step));
                *mean = W::all(late).fma(W::load(&self.v[first + k]), *v);
            }
            let (nodes, links) = shapes.as_chunks::<BUNDLE>().0.split_at(columns);
            let (at_nodes, at_links) = self.lanes.split_at_mut(columns);
            add_products(nodes, v, at_nodes);
            add_products(links, mean, at_links);
        }
        self.sums = sums;
        for (free, lanes) in self.free.iter_mut().zip(self.lanes.as_chunks::<LANES>().0) {
            *free = W::sums(lanes);
        }
    }

    /// What [`advance_absorbing`] does.
    #[inline(always)]
    fn go_on_absorbing<W: Lanes>(&mut self, now: Option<(Drive, bool)>, next: Drive, step: TimeStep) {
        let TimeStep { dt, theta } = step;
        let (late, body, room) = (1.0 - theta, self.body, &mut self.room);
        // Not the modes that fill up the last bundle.
        let used = body.modes.div_ceil(LANES);
        let Some(boundary) = &self.operator.boundary else {
            return;
        };
        if let Some((now, touched)) = now {
            if touched {
                boundary[now.damping].push::<W>(&self.pushes, theta, &mut self.v_free, room);
            }
            boundary[now.damping].hold::<W>(&self.v_free, &mut self.mean, room);
            // Copies, as in `finish`.
            let (mut sums, back) = (self.sums, 1.0 / theta);
            for group in 0..used {
                let (w, load, c) = (
                    body.omega_squared[group],
                    self.balanced[group],
                    body.damping[now.damping][group],
                );
                let gamma = [body.participation[0][group], body.participation[1][group]];
                let (mean, g) = (self.mean[group], self.v_free[group]);
                let (mut q, mut v) = (self.q[group], self.v[group]);
                for l in 0..LANES {
                    let way = dt * mean[l];
                    let v_new = (mean[l] - late * v[l]) * back;
                    let work =
                        (load[l] * dt - gamma[0][l] * now.ground[0] - gamma[1][l] * now.ground[1]) * mean[l];
                    let damped = c[l] * mean[l] * way;
                    let elastic = mean[l] + theta * theta * dt * w[l] * way;
                    let dv = v_new - v[l];
                    sums.input[l] += work;
                    sums.turnover[l] += work.abs();
                    sums.damping[l] += damped;
                    sums.boundary[l] += mean[l] * (g[l] - elastic) * back - damped;
                    sums.numerical[l] += (theta - 0.5) * (dv * dv + w[l] * way * way);
                    q[l] += way;
                    v[l] = v_new;
                }
                (self.q[group], self.v[group]) = (q, v);
            }
            self.sums = sums;
        }
        for group in 0..used {
            let (w, load) = (body.omega_squared[group], self.left[group]);
            let gamma = [body.participation[0][group], body.participation[1][group]];
            let (q, v) = (self.q[group], self.v[group]);
            let mut g = [0.0; LANES];
            for l in 0..LANES {
                let drive = (load[l] - w[l] * q[l]) * dt
                    - gamma[0][l] * next.ground[0]
                    - gamma[1][l] * next.ground[1];
                g[l] = fma::<W>(theta, drive, v[l]);
            }
            self.v_free[group] = g;
        }
        boundary[next.damping].motion::<W>(&self.v_free, &mut self.free, room);
        let free = self.free.as_flattened_mut();
        for (free, before) in free.iter_mut().zip(&self.velocity) {
            *free -= late * before;
        }
        free.iter_mut().for_each(|free| *free /= theta);
    }

    /// Move the modes of a group to the end of the step and book their energies; `push` is the impulse on each.
    #[inline(always)]
    fn finish<W: Lanes>(&mut self, group: usize, push: &Group, now: Drive, step: TimeStep, sums: &mut Sums) {
        let TimeStep { dt, theta } = step;
        let body = self.body;
        // Copies, so that the compiler sees that nothing overlaps, and uses wide registers.
        let (w, load) = (body.omega_squared[group], self.balanced[group]);
        let gamma = [body.participation[0][group], body.participation[1][group]];
        let c = body.damping[now.damping][group];
        let d = self.operator.d[now.damping][group];
        let free = self.v_free[group];
        let (mut q, mut v) = (self.q[group], self.v[group]);
        for l in 0..LANES {
            let v_new = fma::<W>(d[l], push[l], free[l]);
            let mean = fma::<W>(theta, v_new, (1.0 - theta) * v[l]);
            let way = dt * mean;
            let drive = load[l] * dt - gamma[0][l] * now.ground[0] - gamma[1][l] * now.ground[1];
            let work = drive * mean;
            sums.input[l] += work;
            sums.turnover[l] += work.abs();
            sums.damping[l] = fma::<W>(c[l] * mean, way, sums.damping[l]);
            let dv = v_new - v[l];
            sums.numerical[l] += (theta - 0.5) * fma::<W>(dv, dv, w[l] * way * way);
            q[l] += way;
            v[l] = v_new;
        }
        (self.q[group], self.v[group]) = (q, v);
    }

    /// Return, and keep, the velocities that the modes of a group would have after the step without contact.
    #[inline(always)]
    fn begin<W: Lanes>(&mut self, group: usize, next: Drive, step: TimeStep) -> Group {
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
            let spring = w[l] * fma::<W>(dt * theta * late, v[l], q[l]);
            free[l] = d[l] * (v[l] + drive - dt * fma::<W>(c[l] * late, v[l], spring));
        }
        self.v_free[group] = free;
        free
    }

    /// Numbers of the crack nodes among those of crack and dashpots.
    #[inline(always)]
    pub(super) fn at_crack<'s>(&self, all: &'s [Group]) -> &'s [f64] {
        &all.as_flattened()[..self.body.columns()]
    }

    /// Those of the links.
    #[inline(always)]
    pub(super) fn rates<'s>(&self, all: &'s [Group]) -> &'s [f64] {
        &all.as_flattened()[self.body.columns()..self.body.width()]
    }

    /// How crack and dashpots answer to impulses on them.
    #[inline(always)]
    pub(super) fn answers(&self, damping: usize) -> Compliance<'_> {
        Compliance {
            w: &self.operator.w[damping],
            nodes: self.body.nodes,
            stride: self.body.stride(),
        }
    }

    /// Those to impulses of the dashpots.
    pub(super) fn damper_rows(&self, damping: usize) -> &[Group] {
        &self.operator.w[damping][self.body.columns() * self.body.stride()..]
    }

    /// Add to the velocities without contact what `push` changes in them; where this is no more than the forces of contact
    /// at rest, `alone`, that is known.
    pub(super) fn push_crack<W: Lanes>(&mut self, damping: usize, alone: bool) {
        if alone {
            for (free, change) in self.free.iter_mut().zip(&self.released[damping]) {
                for l in 0..LANES {
                    free[l] += change[l];
                }
            }
            return;
        }
        combine::<W>(&self.operator.w[damping], &self.push, &mut self.free);
    }

    /// Whether nothing moves this part.
    pub(super) fn rests(&self) -> bool {
        let zero = |numbers: &[f64]| numbers.iter().all(|x| *x == 0.0);
        zero(self.free.as_flattened()) && zero(&self.velocity) && zero(&self.push) && zero(&self.pull)
    }

    /// Take away the forces of contact that the state before the earthquake has in it; `alone` where nothing else acts.
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

    /// Add to the velocities of the crack nodes without contact what impulses of the links change in them.
    pub(super) fn pull_free<W: Lanes>(&mut self, damping: usize, pull: &[f64]) {
        let groups = self.body.columns().div_ceil(LANES);
        self.operator.linked[damping].combine::<W>(pull, &mut self.free[..groups]);
    }

    /// Find how crack and dashpots answer to `impulse`.
    pub(super) fn find_answer<W: Lanes>(&mut self, damping: usize) {
        self.answer.fill([0.0; LANES]);
        combine::<W>(&self.operator.w[damping], &self.impulse, &mut self.answer);
    }

    /// Add to it what impulses of the dashpots change in it.
    pub(super) fn pull_answer<W: Lanes>(&mut self, damping: usize, pull: &[f64]) {
        let first = self.body.columns() * self.body.stride();
        combine::<W>(&self.operator.w[damping][first..], pull, &mut self.answer);
    }

    /// Make velocities of the answer.
    pub(super) fn finish_answer(&mut self) {
        for (answer, free) in self.answer.iter_mut().zip(&self.free) {
            for l in 0..LANES {
                answer[l] += free[l];
            }
        }
    }

    /// Count `push` with the impulses of contact, which have been used by themselves where they must be.
    pub(super) fn join_push(&mut self) {
        for (impulse, push) in self.impulse.iter_mut().zip(&self.push) {
            *impulse += push;
        }
    }

    /// What [`move_crack`] does.
    #[inline(always)]
    fn move_nodes<W: Lanes>(&mut self, step: TimeStep) {
        let TimeStep { dt, theta } = step;
        let new = self.answer.as_flattened();
        for ((x, u), new) in self.position.iter_mut().zip(&mut self.velocity).zip(new) {
            *x += dt * fma::<W>(theta, *new, (1.0 - theta) * *u);
            *u = *new;
        }
    }
}

apart! {
    /// Finish the step `now` with the impulses found, unless this is the start, and begin the step `next`.
    pub(super) fn advance(body: &mut ModalStepper<'_>, now: Option<Drive>, next: Drive, step: TimeStep) -> () =
        ModalStepper::go_on;
}

apart! {
    /// The same where a boundary takes energy; `now` with whether there are any impulses.
    fn advance_absorbing(body: &mut ModalStepper<'_>, now: Option<(Drive, bool)>, next: Drive, step: TimeStep) -> () =
        ModalStepper::go_on_absorbing;
}

apart! {
    /// Let the crack nodes go on to the end of the step with the velocities found.
    pub(super) fn move_crack(body: &mut ModalStepper<'_>, step: TimeStep) -> () = ModalStepper::move_nodes;
}
