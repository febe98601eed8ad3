//! One body of the dam on its way through time by Newmark's scheme; the equations are those of [`super::idce`].

use super::body::ReducedBody;
use super::ledger::Ledger;
use super::scheme::Penalty;
use super::simd::{combine, Group, Plain, LANES};

/// The state of a body.
pub(super) struct NewmarkStepper<'a> {
    pub body: &'a ReducedBody,
    /// Share of the right-hand side that becomes acceleration, for both states of damping.
    gain: [Vec<Group>; 2],
    /// Compliance of the crack nodes to forces on them.
    pub w: [Vec<Group>; 2],
    pub q: Vec<Group>,
    pub v: Vec<Group>,
    a: Vec<Group>,
    /// Position of the crack nodes less what the modes say at the start: nothing, if no modes are left out.
    base: Vec<f64>,
    pub position: Vec<f64>,
    pub free: Vec<f64>,
    pub force: Vec<f64>,
    force_before: Vec<f64>,
}

impl<'a> NewmarkStepper<'a> {
    pub(super) fn new(body: &'a ReducedBody, penalty: &Penalty, dt: f64) -> Self {
        let gain = [0, 1].map(|state: usize| {
            let pairs = body.damping[state].iter().zip(&body.omega_squared);
            let each = |(c, w): (&Group, &Group)| -> Group {
                std::array::from_fn(|l| {
                    1.0 / (1.0 + penalty.gamma * dt * c[l] + penalty.beta * dt * dt * w[l])
                })
            };
            pairs.map(each).collect::<Vec<_>>()
        });
        let w = [0, 1].map(|state: usize| {
            let mut w = body.compliance(&gain[state]);
            let values = w.as_flattened_mut().iter_mut();
            values.for_each(|value| *value *= penalty.beta * dt * dt);
            w
        });
        let at_start = body.at_crack(&body.start);
        let zeros = vec![0.0; body.columns()];
        NewmarkStepper {
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
    pub(super) fn go_on(
        &mut self,
        ground: [[f64; 2]; 2],
        damping: usize,
        penalty: &Penalty,
        dt: f64,
    ) -> Before {
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
                let late = (0.5 - penalty.beta) * a + penalty.beta * (push - w[l] * q);
                let way = gain[l] * (dt * v + dt * dt * late);
                self.q[group][l] = q + way;
                self.a[group][l] = push - w[l] * (q + way);
                self.v[group][l] =
                    v + dt * ((1.0 - penalty.gamma) * a + penalty.gamma * self.a[group][l]) - c[l] * way;
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
    pub(super) fn correct(
        &mut self,
        before: &Before,
        damping: usize,
        penalty: &Penalty,
        dt: f64,
        ledger: &mut Ledger,
    ) -> [f64; 2] {
        let body = self.body;
        for group in 0..body.groups() {
            let push = body.on_modes(group, &self.force);
            for (l, push) in push.iter().enumerate() {
                let (c, w) = (body.damping[damping][group][l], body.omega_squared[group][l]);
                let further = self.gain[damping][group][l] * penalty.beta * dt * dt * push;
                let a = push - w * further;
                self.q[group][l] += further;
                self.a[group][l] += a;
                self.v[group][l] += penalty.gamma * dt * a - c * further;
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
        let mut answer = vec![[0.0; LANES]; body.stride()];
        combine::<Plain>(&self.w[damping], &self.force, &mut answer);
        let answer = answer.as_flattened();
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

/// Modes of a body before a step, and the ground at both ends of it.
pub(super) struct Before {
    q: Vec<Group>,
    ground: [[f64; 2]; 2],
}
