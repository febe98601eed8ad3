//! Water with sound: a reservoir in modes of its velocity potential, tied to the wet faces of all parts.
//!
//! With `x` the amplitudes, `L` the rows of the wet faces over the modes of a body and `v_g` the ground's velocity
//!
//! ```text
//! x'' + C x' + Omega^2 x = sum L v + G v_g,      force on a body  -L^T x'
//! ```
//!
//! The tie is gyroscopic and takes no energy; what `C` takes has left through the far end of the reservoir and its floor.
//! With `x* = theta x'_new + (1 - theta) x'` and the rates `e = sum L v` of the faces a step is
//!
//! ```text
//! A x* = r + theta dt e*,      A = 1 + theta dt C + theta^2 dt^2 Omega^2,      r = x' - theta dt (Omega^2 x - G v_g*)
//! ```
//!
//! and the impulses `z = -dt x*` on the rows obey, with `e*_f` and `W` the rates and the answers without them,
//!
//! ```text
//! z = -N (e*_f / theta + r / (theta^2 dt)),      N = (W + A / (theta^2 dt^2))^-1
//! ```
//!
//! which is a dashpot (see [`super::dampers`]) with a memory.
//!
//! The rows have as few dimensions as the wet faces have nodes: `L = F B` with the orthonormal columns of `F` and a few
//! rows `B` for each body. In their place the bodies have `B`, whose impulses `y = F^T z` obey the same with
//!
//! ```text
//! K^-1  for  A / (theta dt),      G r  for  r,      Y = (A / (theta dt))^-1 F,      K = F^T Y,      G = K^-1 Y^T
//! ```
//!
//! and those on the rows themselves, by which the water goes on, are `z = Y K^-1 y + M r`.

use super::inverse::inverse;
use super::ledger::Ledger;
use super::panels::Panels;
use super::scheme::TimeStep;
use super::simd::{apart, fma, in_groups, Group, Lanes, Plain, LANES};
use super::symmetric::{add_product, Symmetric};
use crate::error::Error;

/// A reservoir in its modes; `m` of them.
pub struct Reservoir {
    /// Squared circular frequencies (1/s2).
    omega_squared: Vec<f64>,
    /// What leaves through the floor, and through the far end: `m x m`, symmetric, row by row (1/s).
    leaving: [Vec<f64>; 2],
    /// Share in the horizontal and in the vertical motion of the ground, `2 x m`.
    ground: [Vec<f64>; 2],
    /// `F`, column by column.
    ties: Vec<Vec<f64>>,
}

/// A column is a sum of others where no more than this part of the largest is left of it.
const LEFT: f64 = 1e-12;

impl Reservoir {
    /// # Errors
    /// Arrays that do not agree in the number of modes, or none.
    pub fn new(omega_squared: &[f64], leaving: [&[f64]; 2], ground: [&[f64]; 2]) -> Result<Self, Error> {
        let modes = omega_squared.len();
        let squares = leaving.iter().all(|matrix| matrix.len() == modes * modes);
        if modes == 0 || !squares || ground.iter().any(|share| share.len() != modes) {
            return Err(Error::Water(
                "the arrays of a reservoir must agree in the number of its modes",
            ));
        }
        Ok(Reservoir {
            omega_squared: omega_squared.to_vec(),
            leaving: leaving.map(<[f64]>::to_vec),
            ground: ground.map(<[f64]>::to_vec),
            ties: (0..modes)
                .map(|k| (0..modes).map(|c| f64::from(u8::from(c == k))).collect())
                .collect(),
        })
    }

    /// Tie it to the bodies by as few rows as say what these do, `modes x modes of the body` of each body, row by row;
    /// those of each body are returned.
    ///
    /// # Errors
    /// Where the rows are not as many as the modes.
    pub fn tie(&mut self, rows: &[&[f64]]) -> Result<Vec<Vec<f64>>, Error> {
        let modes = self.modes();
        if rows.iter().any(|rows| !rows.len().is_multiple_of(modes)) {
            return Err(Error::Water("the water needs a row for each of its modes"));
        }
        let column = |rows: &[f64], c: usize| -> Vec<f64> {
            let count = rows.len() / modes;
            (0..modes).map(|k| rows[k * count + c]).collect()
        };
        // Gram and Schmidt, each time with the column of which most is left.
        let columns = rows
            .iter()
            .flat_map(|rows| (0..rows.len() / modes).map(|c| column(rows, c)));
        let mut left: Vec<Vec<f64>> = columns.collect();
        let size = |x: &Vec<f64>| dot(x, x);
        let enough = LEFT * LEFT * left.iter().map(size).fold(0.0, f64::max);
        self.ties.clear();
        while let Some(most) = left.iter().max_by(|a, b| size(a).total_cmp(&size(b))) {
            if size(most) <= enough || self.ties.len() == modes {
                break;
            }
            let mut tie = most.clone();
            // Once more for what rounding has left.
            for other in &self.ties {
                take_off(&mut tie, other);
            }
            let length = size(&tie).sqrt();
            tie.iter_mut().for_each(|x| *x /= length);
            left.iter_mut().for_each(|column| take_off(column, &tie));
            self.ties.push(tie);
        }
        if self.ties.is_empty() {
            // It wets nothing.
            self.ties
                .push((0..modes).map(|k| f64::from(u8::from(k == 0))).collect());
        }
        let few = |rows: &&[f64]| {
            let count = rows.len() / modes;
            let along = |tie: &Vec<f64>| -> Vec<f64> {
                (0..count)
                    .map(|c| (0..modes).map(|k| tie[k] * rows[k * count + c]).sum())
                    .collect()
            };
            self.ties.iter().flat_map(along).collect()
        };
        Ok(rows.iter().map(few).collect())
    }

    /// `A / (theta dt)`, row by row.
    fn impedance(&self, TimeStep { dt, theta }: TimeStep) -> Vec<f64> {
        let (modes, weight) = (self.modes(), theta * dt);
        let [floor, far] = &self.leaving;
        let mut a: Vec<f64> = floor.iter().zip(far).map(|(a, b)| a + b).collect();
        for (k, square) in self.omega_squared.iter().enumerate() {
            a[k * (modes + 1)] += 1.0 / weight + weight * square;
        }
        a
    }

    /// Number of rows that tie it to the bodies.
    pub(super) fn ties(&self) -> usize {
        self.ties.len()
    }

    /// Number of its modes.
    pub fn modes(&self) -> usize {
        self.omega_squared.len()
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Take off what a vector has in the direction of another, of length 1.
fn take_off(x: &mut [f64], unit: &[f64]) {
    let share = dot(x, unit);
    x.iter_mut().zip(unit).for_each(|(x, unit)| *x -= share * unit);
}

/// A reservoir under way.
pub(super) struct Water<'a> {
    of: &'a Reservoir,
    step: TimeStep,
    /// `K^-1`, row by row.
    impedance: Vec<f64>,
    /// `G`, `Y K^-1` and `M`.
    remembered: Panels,
    followed: Panels,
    own: Symmetric,
    /// `r`, and room for `G r` and for `z`.
    rest: Vec<Group>,
    ties_room: Vec<Group>,
    modes_room: Vec<Group>,
    /// Squared circular frequencies, and shares in the motion of the ground.
    omega_squared: Vec<Group>,
    share: [Vec<Group>; 2],
    /// Amplitudes and their velocities.
    amplitude: Vec<Group>,
    velocity: Vec<Group>,
    /// Velocity of the ground.
    ground: [f64; 2],
    /// What the ground does to the modes in this step.
    drive: Vec<Group>,
    /// What leaves, and `x*` of the last steps, one after the other, in which it has not been booked.
    leaving: [Leaving; 2],
    means: Vec<Group>,
    waiting: usize,
    /// Energies: put in by the ground, left through the floor and the far end, taken by the scheme, all that went in.
    input: Group,
    left: [f64; 2],
    numerical: Group,
    turnover: Group,
}

/// The lower half of a symmetric matrix, row by row, what is beside the diagonal twice; nothing where it is zero.
struct Leaving(Vec<f64>);

impl Leaving {
    fn new(matrix: &[f64]) -> Self {
        if matrix.iter().all(|x| *x == 0.0) {
            return Leaving(Vec::new());
        }
        let rows = matrix.chunks_exact(matrix.len().isqrt()).enumerate();
        Leaving(
            rows.flat_map(|(k, row)| row[..k].iter().map(|x| 2.0 * x).chain([row[k]]))
                .collect(),
        )
    }

    /// What [`powers`] does.
    #[inline(always)]
    fn take<W: Lanes>(&self, x: &[Group]) -> f64 {
        let (mut total, mut rows) = (W::all(0.0), &self.0[..]);
        for (k, own) in x.iter().enumerate() {
            if rows.is_empty() {
                break;
            }
            let (row, rest) = rows.split_at(k + 1);
            // Four sums do not wait for each other.
            let mut sums = [W::all(0.0); 4];
            let (fours, last) = row.as_chunks::<4>();
            for (row, x) in fours.iter().zip(x.as_chunks::<4>().0) {
                for k in 0..4 {
                    sums[k] = W::all(row[k]).fma(W::load(&x[k]), sums[k]);
                }
            }
            for (c, x) in last.iter().zip(&x[4 * fours.len()..]) {
                sums[0] = W::all(*c).fma(W::load(x), sums[0]);
            }
            total = W::load(own).fma(sums[0].add(sums[1]).add(sums[2].add(sums[3])), total);
            rows = rest;
        }
        let mut lanes = [0.0; LANES];
        total.store(&mut lanes);
        lanes.iter().sum()
    }
}

apart! {
    /// `sum x^T C x` of the vectors in all lanes.
    fn powers(leaving: &Leaving, x: &[Group]) -> f64 = Leaving::take;
}

impl<'a> Water<'a> {
    pub(super) fn new(of: &'a Reservoir, step: TimeStep) -> Self {
        let (modes, ties, weight) = (of.modes(), of.ties(), step.dt * step.theta);
        let zeros = vec![[0.0; LANES]; modes.div_ceil(LANES)];
        let inverted = inverse(of.impedance(step), modes);
        let answers: Vec<Vec<f64>> = of
            .ties
            .iter()
            .map(|tie| inverted.chunks_exact(modes).map(|row| dot(row, tie)).collect())
            .collect();
        let own = |tie: &Vec<f64>| {
            answers
                .iter()
                .map(|answer| dot(tie, answer))
                .collect::<Vec<f64>>()
        };
        let impedance = inverse(of.ties.iter().flat_map(own).collect(), ties);
        // `Y K^-1`, of which `G` is the other way round.
        let followed: Vec<Vec<f64>> = impedance
            .chunks_exact(ties)
            .map(|row| {
                let share = |k: usize| row.iter().zip(&answers).map(|(a, answer)| a * answer[k]).sum();
                (0..modes).map(share).collect()
            })
            .collect();
        let mut rest: Vec<f64> = inverted.iter().map(|x| -weight * x).collect();
        for (answer, followed) in answers.iter().zip(&followed) {
            for (row, y) in rest.chunks_exact_mut(modes).zip(answer) {
                row.iter_mut()
                    .zip(followed)
                    .for_each(|(x, g)| *x += weight * y * g);
            }
        }
        // Products go over rows.
        let panels = |rows: &[f64], width: usize| {
            let groups = width.div_ceil(LANES);
            Panels::new(&in_groups(rows, width), groups, groups)
        };
        let turned: Vec<f64> = (0..modes)
            .flat_map(|k| followed.iter().map(move |row| row[k]))
            .collect();
        Water {
            of,
            step,
            remembered: panels(&turned, ties),
            followed: panels(&followed.concat(), modes),
            own: Symmetric::new(&rest, modes),
            impedance,
            rest: zeros.clone(),
            ties_room: vec![[0.0; LANES]; ties.div_ceil(LANES)],
            modes_room: zeros.clone(),
            omega_squared: in_groups(&of.omega_squared, modes),
            share: of.ground.each_ref().map(|share| in_groups(share, modes)),
            amplitude: zeros.clone(),
            velocity: zeros.clone(),
            ground: [0.0; 2],
            means: vec![[0.0; LANES]; LANES * zeros.len()],
            drive: zeros,
            leaving: of.leaving.each_ref().map(|matrix| Leaving::new(matrix)),
            waiting: 0,
            input: [0.0; LANES],
            left: [0.0; 2],
            numerical: [0.0; LANES],
            turnover: [0.0; LANES],
        }
    }

    /// `K^-1`, row by row: what stands for dashpots where the bodies are tied.
    pub(super) fn impedance(&self) -> &[f64] {
        &self.impedance
    }

    /// Velocities of its modes.
    pub(super) fn velocities(&self) -> &[f64] {
        &self.velocity.as_flattened()[..self.of.modes()]
    }

    /// The same in groups.
    pub(super) fn groups(&self) -> &Vec<Group> {
        &self.velocity
    }

    /// Whether it rests, and the ground with it in a step that changes its velocity so.
    pub(super) fn rests(&self, change: [f64; 2]) -> bool {
        let zero = |numbers: &[f64]| numbers.iter().all(|x| *x == 0.0);
        let still = |numbers: &[Group]| zero(numbers.as_flattened());
        zero(&self.ground) && zero(&change) && still(&self.velocity) && still(&self.amplitude)
    }

    /// Add to the rates of the rows what it does of itself in a step in which the ground's velocity changes so.
    pub(super) fn begin<W: Lanes>(&mut self, change: [f64; 2], rates: &mut [f64]) {
        set_off::<W>(self, change);
        self.ties_room.fill([0.0; LANES]);
        self.remembered
            .combine::<W>(self.rest.as_flattened(), &mut self.ties_room);
        for (rate, more) in rates.iter_mut().zip(self.ties_room.as_flattened()) {
            *rate += more;
        }
    }

    /// What [`set_off`] does.
    #[inline(always)]
    fn remember<W: Lanes>(&mut self, change: [f64; 2]) {
        let TimeStep { dt, theta } = self.step;
        let [x, z] = [0, 1].map(|k| self.ground[k] + theta * change[k]);
        let weight = 1.0 / (theta * theta * dt);
        for (group, rest) in self.rest.iter_mut().enumerate() {
            let [along, up] = [0, 1].map(|k: usize| self.share[k][group]);
            let (w, amplitude, velocity) = (
                self.omega_squared[group],
                self.amplitude[group],
                self.velocity[group],
            );
            let (mut drive, mut own) = ([0.0; LANES], [0.0; LANES]);
            for l in 0..LANES {
                drive[l] = fma::<W>(along[l], x, up[l] * z);
                let spring = fma::<W>(w[l], amplitude[l], -drive[l]);
                own[l] = weight * fma::<W>(-theta * dt, spring, velocity[l]);
            }
            (self.drive[group], *rest) = (drive, own);
        }
    }

    /// Go on to the end of the step under these impulses on what ties it to the bodies.
    pub(super) fn finish<W: Lanes>(&mut self, change: [f64; 2], impulses: &[f64]) {
        self.modes_room.fill([0.0; LANES]);
        self.followed.combine::<W>(impulses, &mut self.modes_room);
        add_product::<W>(&self.own, &self.rest, &mut self.modes_room);
        go_on::<W>(self);
        // Eight steps together: reading a matrix is what its product costs.
        self.waiting += 1;
        if self.waiting == LANES {
            let means = self.by_modes();
            for (left, matrix) in self.left.iter_mut().zip(&self.leaving) {
                *left += self.step.dt * powers::<W>(matrix, &means);
            }
            self.means.fill([0.0; LANES]);
            self.waiting = 0;
        }
        for (ground, change) in self.ground.iter_mut().zip(change) {
            *ground += change;
        }
    }

    /// What [`go_on`] does.
    #[inline(always)]
    fn move_on<W: Lanes>(&mut self) {
        let TimeStep { dt, theta } = self.step;
        let (late, back, turned) = (1.0 - theta, 1.0 / theta, -1.0 / dt);
        // Copies, so that the compiler sees that nothing overlaps, and uses wide registers.
        let (mut input, mut turnover, mut numerical) = (self.input, self.turnover, self.numerical);
        let groups = self.modes_room.len();
        for (group, impulse) in self.modes_room.iter().enumerate() {
            let (w, drive) = (self.omega_squared[group], self.drive[group]);
            let (mut amplitude, mut velocity) = (self.amplitude[group], self.velocity[group]);
            let mut means = [0.0; LANES];
            for l in 0..LANES {
                let mean = turned * impulse[l];
                let new = back * fma::<W>(-late, velocity[l], mean);
                let (way, more) = (dt * mean, new - velocity[l]);
                let work = drive[l] * way;
                input[l] += work;
                turnover[l] += work.abs();
                numerical[l] += (theta - 0.5) * fma::<W>(more, more, w[l] * way * way);
                means[l] = mean;
                amplitude[l] += way;
                velocity[l] = new;
            }
            self.means[self.waiting * groups + group] = means;
            (self.amplitude[group], self.velocity[group]) = (amplitude, velocity);
        }
        (self.input, self.turnover, self.numerical) = (input, turnover, numerical);
    }

    /// `x*` of the steps that have not been booked, those of a mode in one group.
    fn by_modes(&self) -> Vec<Group> {
        let means = self.means.as_flattened();
        let stride = means.len() / LANES;
        (0..self.of.modes())
            .map(|mode| std::array::from_fn(|step| means[step * stride + mode]))
            .collect()
    }

    /// Energy it holds.
    fn stored(&self) -> f64 {
        let modes = self
            .velocity
            .as_flattened()
            .iter()
            .zip(self.amplitude.as_flattened())
            .zip(self.omega_squared.as_flattened());
        modes.map(|((v, x), square)| 0.5 * (v * v + square * x * x)).sum()
    }

    /// Add its energies to a ledger.
    pub(super) fn book(&self, ledger: &mut Ledger) {
        let means = self.by_modes();
        let waiting = self
            .leaving
            .each_ref()
            .map(|matrix| powers::<Plain>(matrix, &means));
        let [floor, far] = [0, 1].map(|k| self.left[k] + self.step.dt * waiting[k]);
        let sum = |group: &Group| group.iter().sum::<f64>();
        ledger.input += sum(&self.input);
        ledger.floor += floor;
        ledger.far_end += far;
        ledger.numerical += sum(&self.numerical);
        ledger.stored += self.stored();
        ledger.turnover += sum(&self.turnover) + floor + far;
    }
}

apart! {
    /// Find what the water does of itself in a step in which the ground's velocity changes so.
    fn set_off(water: &mut Water<'_>, change: [f64; 2]) -> () = Water::remember;
}

apart! {
    /// Let the modes go on to the end of the step under the impulses on them, and book their energies.
    fn go_on(water: &mut Water<'_>) -> () = Water::move_on;
}
