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
//!
//! The last half of one step and the first half of the next go over the mode shapes together, as reading them is what
//! a step costs.

use super::body::{fma, Body, Group, BUNDLE, LANES};
use super::contact::{relative, spread, Contacts};
use super::coulomb::{Problem, Solver, Status};
use super::ledger::{Ledger, Sums};
use super::observe::{self, Faces, Motion};
use super::result::{Frames, Outcome, Summary};

/// Two parts, and the crack between them.
pub struct Dam {
    pub upper: Body,
    /// None: the crack is on a rigid plane.
    pub lower: Option<Body>,
    /// Coefficients of friction of a node that sticks and of one that slips.
    pub friction: [f64; 2],
    /// Which nodes are watched; see [`Contacts::new`].
    pub contactors: u8,
}

impl Dam {
    pub fn parts(&self) -> impl Iterator<Item = &Body> {
        std::iter::once(&self.upper).chain(&self.lower)
    }
}

/// How to walk.
#[derive(Clone, Copy)]
pub struct Options {
    pub dt: f64,
    pub theta: f64,
    /// Steps from frame to frame; 0 for no frames.
    pub stride: usize,
    /// Whether frames keep the modes too.
    pub keep_modes: bool,
    /// Factors on the ground's motion.
    pub scale: [f64; 2],
}

/// What a part needs for a given step, for both states of damping.
struct Operator {
    d: [Vec<Group>; 2],
    /// Answer of the crack nodes to impulses on them, row by row.
    w: [Vec<f64>; 2],
}

impl Operator {
    fn new(body: &Body, options: &Options) -> Self {
        let (dt, theta) = (options.dt, options.theta);
        let d = [0, 1].map(|state| {
            let pairs = body.damping[state].iter().zip(&body.omega_squared);
            pairs
                .map(|(c, w)| {
                    std::array::from_fn(|l| 1.0 / (1.0 + theta * dt * c[l] + theta * theta * dt * dt * w[l]))
                })
                .collect::<Vec<Group>>()
        });
        let w = [0, 1].map(|state: usize| body.compliance(&d[state]));
        Operator { d, w }
    }
}

/// The state of a part, and room for a step.
struct Part<'a> {
    body: &'a Body,
    operator: Operator,
    q: Vec<Group>,
    v: Vec<Group>,
    v_free: Vec<Group>,
    /// Of the crack nodes: position, velocity, velocity without contact, impulse.
    position: Vec<f64>,
    velocity: Vec<f64>,
    free: Vec<f64>,
    impulse: Vec<f64>,
    answer: Vec<f64>,
    /// Room for the sums of `free`, lane by lane.
    lanes: Vec<Group>,
    sums: Sums,
}

/// One step's ground: changes of velocity and the state of damping.
#[derive(Clone, Copy)]
struct Drive {
    ground: [f64; 2],
    damping: usize,
}

impl<'a> Part<'a> {
    fn new(body: &'a Body, options: &Options) -> Self {
        let columns = body.columns();
        let zeros = vec![0.0; columns];
        Part {
            body,
            operator: Operator::new(body, options),
            q: body.start.clone(),
            v: vec![[0.0; LANES]; body.groups()],
            v_free: vec![[0.0; LANES]; body.groups()],
            position: body.position.clone(),
            velocity: zeros.clone(),
            free: zeros.clone(),
            impulse: zeros.clone(),
            answer: zeros,
            lanes: vec![[0.0; LANES]; columns],
            sums: Sums::default(),
        }
    }

    /// Finish the step `now` with the impulses found, unless this is the start, and begin the step `next`.
    #[inline(always)]
    fn advance<const FUSED: bool>(&mut self, now: Option<Drive>, next: Drive, options: &Options) {
        let columns = self.body.columns();
        let touched = self.impulse.iter().any(|p| *p != 0.0);
        self.lanes.fill([0.0; LANES]);
        let body = self.body;
        for (bundle, shapes) in body.shapes.chunks_exact(BUNDLE * columns).enumerate() {
            let first = BUNDLE * bundle;
            let (s0, rest) = shapes.split_at(columns);
            let (s1, rest) = rest.split_at(columns);
            let (s2, s3) = rest.split_at(columns);
            let rows = s0.iter().zip(s1).zip(s2).zip(s3);
            if let Some(now) = now {
                let mut push = [[0.0; LANES]; BUNDLE];
                if touched {
                    push[..2].copy_from_slice(&pushes::<FUSED>(s0, s1, &self.impulse));
                    push[2..].copy_from_slice(&pushes::<FUSED>(s2, s3, &self.impulse));
                }
                for (k, push) in push.iter().enumerate() {
                    self.finish::<FUSED>(first + k, push, now, options);
                }
            }
            let mut v = [[0.0; LANES]; BUNDLE];
            for (k, v) in v.iter_mut().enumerate() {
                *v = self.begin::<FUSED>(first + k, next, options);
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
        for (free, sum) in self.free.iter_mut().zip(&self.lanes) {
            *free = total(sum);
        }
    }

    /// Move the modes of a group to the end of the step and book their energies; `push` is the impulse on each.
    #[inline(always)]
    fn finish<const FUSED: bool>(&mut self, group: usize, push: &Group, now: Drive, options: &Options) {
        let (dt, theta) = (options.dt, options.theta);
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
    fn begin<const FUSED: bool>(&mut self, group: usize, next: Drive, options: &Options) -> Group {
        let (dt, theta) = (options.dt, options.theta);
        let late = 1.0 - theta;
        let body = self.body;
        let (w, load) = (body.omega_squared[group], body.load[group]);
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

    /// Velocities and positions of the crack nodes at the end of the step.
    #[inline(always)]
    fn move_crack<const FUSED: bool>(&mut self, damping: usize, options: &Options) {
        let columns = self.body.columns();
        self.answer.copy_from_slice(&self.free);
        for (p, row) in self
            .impulse
            .iter()
            .zip(self.operator.w[damping].chunks_exact(columns))
        {
            if *p != 0.0 {
                for (u, w) in self.answer.iter_mut().zip(row) {
                    *u = fma::<FUSED>(*p, *w, *u);
                }
            }
        }
        let (dt, theta) = (options.dt, options.theta);
        for ((x, u), new) in self.position.iter_mut().zip(&mut self.velocity).zip(&self.answer) {
            *x += dt * fma::<FUSED>(theta, *new, (1.0 - theta) * *u);
            *u = *new;
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

/// Sum of the lanes, by halves, as wide registers can.
#[inline(always)]
fn total(lanes: &Group) -> f64 {
    let mut lanes = *lanes;
    let mut width = LANES / 2;
    while width > 0 {
        for l in 0..width {
            lanes[l] += lanes[l + width];
        }
        width /= 2;
    }
    lanes[0]
}

/// Shake the dam. `ground` has the horizontal and vertical mean acceleration of each step.
pub fn simulate(dam: &Dam, ground: &[[f64; 2]], options: &Options, frames: Option<&mut Frames>) -> Summary {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("fma") {
            // Safety: the machine has what the function is compiled for.
            return unsafe { simulate_avx512(dam, ground, options, frames) };
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // Safety: as above.
            return unsafe { simulate_avx2(dam, ground, options, frames) };
        }
    }
    walk::<false>(dam, ground, options, frames)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx2,fma")]
fn simulate_avx512(
    dam: &Dam,
    ground: &[[f64; 2]],
    options: &Options,
    frames: Option<&mut Frames>,
) -> Summary {
    walk::<true>(dam, ground, options, frames)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn simulate_avx2(dam: &Dam, ground: &[[f64; 2]], options: &Options, frames: Option<&mut Frames>) -> Summary {
    walk::<true>(dam, ground, options, frames)
}

/// The contact problem of a step, in terms of the faces.
struct Crack {
    contacts: Contacts,
    problem: Problem,
    solver: Solver,
    /// Normal velocity before the step, and whether the contact was closed.
    approach: Vec<f64>,
    closed: Vec<bool>,
    /// State of damping that `problem.g` belongs to.
    assembled: Option<usize>,
}

impl Crack {
    fn new(dam: &Dam) -> Self {
        let lower = dam.lower.as_ref().map_or(0, |body| body.nodes);
        let contacts = Contacts::new(dam.contactors, dam.upper.nodes, lower);
        let m = contacts.len();
        Crack {
            problem: Problem {
                g: vec![0.0; 4 * m * m],
                b: vec![0.0; 2 * m],
                h: vec![0.0; m],
                mu_stick: vec![dam.friction[0]; m],
                mu_slip: dam.friction[1],
            },
            solver: Solver::new(m),
            approach: vec![0.0; m],
            closed: vec![true; m],
            contacts,
            assembled: None,
        }
    }

    /// How each contact answers to an impulse at any other.
    #[inline(always)]
    fn assemble(&mut self, upper: &Part, lower: Option<&Part>, damping: usize, redundant: bool) {
        let size = self.problem.b.len();
        self.problem.g.fill(0.0);
        let mut largest = 0.0_f64;
        for (i, one) in self.contacts.pairs.iter().enumerate() {
            let Some(one) = one else { continue };
            for (j, other) in self.contacts.pairs[..=i].iter().enumerate() {
                let Some(other) = other else { continue };
                let mut block = [[0.0; 2]; 2];
                couple(
                    &mut block,
                    &one.upper,
                    &other.upper,
                    &upper.operator.w[damping],
                    upper.body.nodes,
                );
                if let Some(lower) = lower {
                    couple(
                        &mut block,
                        &one.lower,
                        &other.lower,
                        &lower.operator.w[damping],
                        lower.body.nodes,
                    );
                }
                for (a, row) in block.iter().enumerate() {
                    for (b, value) in row.iter().enumerate() {
                        self.problem.g[(2 * i + a) * size + 2 * j + b] = *value;
                        self.problem.g[(2 * j + b) * size + 2 * i + a] = *value;
                    }
                }
                if i == j {
                    largest = largest.max(block[0][0]).max(block[1][1]);
                }
            }
        }
        if redundant {
            // Nodes of both faces that meet say the same twice; this little makes them share.
            for k in 0..size {
                self.problem.g[k * (size + 1)] += 1e-9 * largest;
            }
        }
        self.solver.forget();
        self.assembled = Some(damping);
    }
}

/// Add what the nodes of one contact feel of those of another, in one part.
#[inline(always)]
fn couple(
    block: &mut [[f64; 2]; 2],
    one: &[(usize, f64); 2],
    other: &[(usize, f64); 2],
    w: &[f64],
    nodes: usize,
) {
    let columns = 2 * nodes;
    for &(i, a) in one {
        for &(j, b) in other {
            let weight = a * b;
            if weight != 0.0 {
                for (r, row) in block.iter_mut().enumerate() {
                    for (c, value) in row.iter_mut().enumerate() {
                        *value += weight * w[(r * nodes + i) * columns + c * nodes + j];
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn walk<const FUSED: bool>(
    dam: &Dam,
    ground: &[[f64; 2]],
    options: &Options,
    mut frames: Option<&mut Frames>,
) -> Summary {
    let dt = options.dt;
    let mut upper = Part::new(&dam.upper, options);
    let mut lower = dam.lower.as_ref().map(|body| Part::new(body, options));
    let mut crack = Crack::new(dam);
    let mut summary = Summary::default();
    let mut ledger = Ledger {
        start: energy(&upper, lower.as_ref()),
        ..Ledger::default()
    };
    let zero = observe::mean_along(&upper.position)
        - lower.as_ref().map_or(0.0, |l| observe::mean_along(&l.position));
    let mut motion = Motion::of(faces(&upper, lower.as_ref()), zero);
    let reach = 100.0 * (upper.position[dam.upper.nodes - 1] - upper.position[0]);
    // The dam has been standing: it starts with the damping of a crack that sticks.
    let mut drive = Drive {
        ground: [0.0; 2],
        damping: 0,
    };
    let next_ground = |step: usize| {
        let a = ground.get(step).copied().unwrap_or([0.0; 2]);
        [options.scale[0] * a[0] * dt, options.scale[1] * a[1] * dt]
    };
    drive.ground = next_ground(0);
    upper.advance::<FUSED>(None, drive, options);
    if let Some(lower) = &mut lower {
        lower.advance::<FUSED>(None, drive, options);
    }
    let mut since = Since::new(&dam.upper);
    if let Some(frames) = &mut frames {
        ledger.stored = ledger.start;
        keep(
            frames,
            &upper,
            lower.as_ref(),
            &crack,
            &motion,
            &since,
            &summary,
            &ledger,
            options,
        );
    }
    for step in 0..ground.len() {
        // Where the nodes are, and how they would go on without contact.
        let status = &crack.solver.status;
        let below: &[f64] = lower.as_ref().map_or(&[], |l| &l.position);
        crack
            .contacts
            .update(&upper.position, below, |k| status[k] == Status::Stick);
        if crack.contacts.changed || crack.assembled != Some(drive.damping) {
            let redundant = dam.contactors == 5 && lower.is_some();
            crack.assemble(&upper, lower.as_ref(), drive.damping, redundant);
        }
        crack.set_up(dam, &upper, lower.as_ref(), options);
        summary.note(crack.solver.solve::<FUSED>(&crack.problem));
        // The nodes move; the parts get their impulses.
        let (work, impulse) = crack.impulses(&mut upper, lower.as_mut(), options);
        upper.move_crack::<FUSED>(drive.damping, options);
        if let Some(lower) = &mut lower {
            lower.move_crack::<FUSED>(drive.damping, options);
        }
        let work = crack.work(work, &upper, lower.as_ref(), options);
        ledger.friction -= work[0];
        ledger.impact -= work[1];
        ledger.gained += (work[0] + work[1]).max(0.0);
        ledger.turnover += work[0].abs() + work[1].abs();
        let after = Motion::of(faces(&upper, lower.as_ref()), zero);
        let state = observe::state(&crack.solver.status);
        summary.end_time = (step + 1) as f64 * dt;
        observe::book(&mut summary, dt, &motion, &after, state, impulse[1] / dt);
        observe::strikes(
            &mut summary,
            &crack.contacts,
            &crack.closed,
            &crack.solver.status,
            &crack.approach,
        );
        motion = after;
        // The modes follow, and begin the next step.
        let sticks = crack.solver.status.contains(&Status::Stick);
        let next = Drive {
            ground: next_ground(step + 1),
            damping: usize::from(!sticks),
        };
        upper.advance::<FUSED>(Some(drive), next, options);
        if let Some(lower) = &mut lower {
            lower.advance::<FUSED>(Some(drive), next, options);
        }
        drive = next;
        if let Some(frames) = &mut frames {
            since.add(&upper.impulse, impulse, dt);
            if (step + 1).is_multiple_of(options.stride) {
                book_sums(&mut ledger, &mut upper, lower.as_mut());
                ledger.stored = energy(&upper, lower.as_ref());
                keep(
                    frames,
                    &upper,
                    lower.as_ref(),
                    &crack,
                    &motion,
                    &since,
                    &summary,
                    &ledger,
                    options,
                );
                since.clear();
            }
        }
        if !(motion.slip.abs() < reach && motion.opening_heel.abs() < reach) {
            summary.outcome = if motion.slip.is_finite() {
                Outcome::Lost
            } else {
                Outcome::BlownUp
            };
            break;
        }
    }
    book_sums(&mut ledger, &mut upper, lower.as_mut());
    ledger.stored = energy(&upper, lower.as_ref());
    summary.ledger = ledger;
    summary
}

impl Crack {
    /// Write the contact problem of the step.
    #[inline(always)]
    fn set_up(&mut self, dam: &Dam, upper: &Part, lower: Option<&Part>, options: &Options) {
        let (u, l): (&[f64], &[f64]) = (&upper.free, lower.map_or(&[], |p| &p.free));
        let (u_old, l_old): (&[f64], &[f64]) = (&upper.velocity, lower.map_or(&[], |p| &p.velocity));
        let back = (1.0 - options.theta) / options.theta;
        for (k, pair) in self.contacts.pairs.iter().enumerate() {
            let status = self.solver.status[k];
            self.closed[k] = status.closed();
            let Some(pair) = pair else {
                self.solver.status[k] = Status::Absent;
                self.problem.b[2 * k] = 0.0;
                self.problem.b[2 * k + 1] = 0.0;
                self.approach[k] = 0.0;
                continue;
            };
            if status == Status::Absent {
                self.solver.status[k] = Status::Open;
            }
            self.problem.b[2 * k] = relative(pair, u, l, 0);
            self.problem.b[2 * k + 1] = relative(pair, u, l, 1);
            self.approach[k] = relative(pair, u_old, l_old, 1);
            self.problem.h[k] = (self.contacts.gaps[k].max(0.0) / options.dt).max(back * self.approach[k]);
            let slips = matches!(status, Status::SlipDownstream | Status::SlipUpstream);
            self.problem.mu_stick[k] = dam.friction[usize::from(slips)];
        }
    }

    /// Put the impulses on both faces; return half of their work, that on the velocities before, and their sums.
    #[inline(always)]
    fn impulses(
        &self,
        upper: &mut Part,
        lower: Option<&mut Part>,
        options: &Options,
    ) -> ([f64; 2], [f64; 2]) {
        upper.impulse.fill(0.0);
        let (below, below_velocity): (&mut [f64], &[f64]) = match lower {
            Some(part) => (&mut part.impulse, &part.velocity),
            None => (&mut [], &[]),
        };
        below.fill(0.0);
        let (mut work, mut sum) = ([0.0; 2], [0.0; 2]);
        for (k, pair) in self.contacts.pairs.iter().enumerate() {
            let Some(pair) = pair else { continue };
            for direction in 0..2 {
                let p = self.solver.p[2 * k + direction];
                if p != 0.0 {
                    spread(pair, direction, p, &mut upper.impulse, below);
                    let u = relative(pair, &upper.velocity, below_velocity, direction);
                    work[direction] += (1.0 - options.theta) * p * u;
                    sum[direction] += p;
                }
            }
        }
        (work, sum)
    }

    /// Add the work of the impulses on the velocities after the step.
    #[inline(always)]
    fn work(&self, mut work: [f64; 2], upper: &Part, lower: Option<&Part>, options: &Options) -> [f64; 2] {
        let below: &[f64] = lower.map_or(&[], |part| &part.velocity);
        for (k, pair) in self.contacts.pairs.iter().enumerate() {
            let Some(pair) = pair else { continue };
            for (direction, work) in work.iter_mut().enumerate() {
                let p = self.solver.p[2 * k + direction];
                if p != 0.0 {
                    *work += options.theta * p * relative(pair, &upper.velocity, below, direction);
                }
            }
        }
        work
    }
}

/// Impulses since the last frame.
struct Since {
    nodes: Vec<f64>,
    sum: [f64; 2],
    time: f64,
}

impl Since {
    fn new(upper: &Body) -> Self {
        Since {
            nodes: vec![0.0; upper.columns()],
            sum: [0.0; 2],
            time: 0.0,
        }
    }

    #[inline(always)]
    fn add(&mut self, nodes: &[f64], sum: [f64; 2], dt: f64) {
        for (total, p) in self.nodes.iter_mut().zip(nodes) {
            *total += p;
        }
        self.sum = [self.sum[0] + sum[0], self.sum[1] + sum[1]];
        self.time += dt;
    }

    fn clear(&mut self) {
        self.nodes.fill(0.0);
        self.sum = [0.0; 2];
        self.time = 0.0;
    }
}

/// Add a frame.
#[allow(clippy::too_many_arguments)]
fn keep(
    frames: &mut Frames,
    upper: &Part,
    lower: Option<&Part>,
    crack: &Crack,
    motion: &Motion,
    since: &Since,
    summary: &Summary,
    ledger: &Ledger,
    options: &Options,
) {
    let status = &crack.solver.status;
    let rate = if since.time > 0.0 { 1.0 / since.time } else { 0.0 };
    let present = status.iter().filter(|s| **s != Status::Absent).count();
    let closed = status.iter().filter(|s| s.closed()).count();
    frames.rows.push([
        summary.end_time,
        motion.slip,
        summary.slip_velocity,
        motion.rotation,
        motion.opening_heel,
        motion.opening_toe,
        since.sum[1] * rate,
        since.sum[0] * rate,
        closed as f64 / present.max(1) as f64,
        f64::from(summary.final_state),
        ledger.stored,
        ledger.input,
        ledger.damping,
        ledger.impact,
        ledger.friction,
        ledger.numerical,
    ]);
    frames.upper.extend_from_slice(&upper.position);
    frames.force.extend(since.nodes.iter().map(|p| p * rate));
    frames.status.extend(status.iter().map(|s| *s as u8));
    if let Some(lower) = lower {
        frames.lower.extend_from_slice(&lower.position);
    }
    if options.keep_modes {
        frames.modes_upper.extend_from_slice(upper.q.as_flattened());
        if let Some(lower) = lower {
            frames.modes_lower.extend_from_slice(lower.q.as_flattened());
        }
    }
}

fn book_sums<'a, 'b>(ledger: &mut Ledger, upper: &'a mut Part<'b>, lower: Option<&'a mut Part<'b>>) {
    for part in std::iter::once(upper).chain(lower) {
        std::mem::take(&mut part.sums).book(ledger);
    }
}

fn energy(upper: &Part, lower: Option<&Part>) -> f64 {
    let of = |part: &Part| part.body.energy(&part.q, &part.v);
    of(upper) + lower.map_or(0.0, of)
}

fn faces<'a>(upper: &'a Part, lower: Option<&'a Part>) -> Faces<'a> {
    Faces {
        upper: &upper.position,
        lower: lower.map_or(&[], |part| &part.position),
    }
}
