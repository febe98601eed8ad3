//! One elastic part of the dam in its own vibration modes, and what the crack feels of it.
//!
//! Each mode obeys
//!
//! ```text
//! w'' + c w' + omega^2 w = f - gamma_x a_x(t) - gamma_z a_z(t) + shapes^T p
//! ```
//!
//! with `w` mass-normalised, `f` the static loads, `a` the ground and `p` the forces on the nodes of the crack, which
//! are counted along it (all first) and across it, away from the lower part.

/// Modes are kept in groups this wide, so that one instruction works on a group.
pub const LANES: usize = 8;
/// Groups are worked on in bundles of so many, so that their sums run side by side.
pub const BUNDLE: usize = 4;
/// One number for each mode of a group.
pub type Group = [f64; LANES];

/// The numbers of one part; they do not change during a run, and many runs may share them.
pub struct Body {
    /// Number of modes, without those that fill up the last group.
    pub modes: usize,
    /// Number of nodes on the crack.
    pub nodes: usize,
    /// Squared circular frequency.
    pub omega_squared: Vec<Group>,
    /// Damping coefficient while some node sticks, and while none does.
    pub damping: [Vec<Group>; 2],
    /// Static loads.
    pub load: Vec<Group>,
    /// Share in the horizontal and in the vertical motion of the ground.
    pub participation: [Vec<Group>; 2],
    /// Modes of the state at the start.
    pub start: Vec<Group>,
    /// Motion of the crack nodes in each mode: for each group of modes all `2 nodes` components.
    pub shapes: Vec<Group>,
    /// Where the nodes are at the start: along the crack, then across it.
    pub position: Vec<f64>,
}

/// What one body is made from; each slice has one number for each mode.
pub struct Modes<'a> {
    pub omega_squared: &'a [f64],
    pub damping: [&'a [f64]; 2],
    pub load: &'a [f64],
    pub participation: [&'a [f64]; 2],
    pub start: &'a [f64],
    /// `modes x 2 nodes`, row by row.
    pub shapes: &'a [f64],
    pub position: &'a [f64],
}

impl Body {
    /// Put the modes into groups and bundles; the last is filled up with modes that never move.
    pub fn new(modes: &Modes) -> Self {
        let columns = modes.position.len();
        let groups = group_count(modes.omega_squared.len());
        let mut shapes = vec![[0.0; LANES]; groups * columns];
        for (mode, row) in modes.shapes.chunks_exact(columns).enumerate() {
            for (c, value) in row.iter().enumerate() {
                shapes[mode / LANES * columns + c][mode % LANES] = *value;
            }
        }
        Body {
            modes: modes.omega_squared.len(),
            nodes: columns / 2,
            omega_squared: grouped(modes.omega_squared),
            damping: modes.damping.map(grouped),
            load: grouped(modes.load),
            participation: modes.participation.map(grouped),
            start: grouped(modes.start),
            shapes,
            position: modes.position.to_vec(),
        }
    }

    /// Number of groups of modes.
    pub fn groups(&self) -> usize {
        self.omega_squared.len()
    }

    /// Number of components of motion on the crack.
    pub fn columns(&self) -> usize {
        2 * self.nodes
    }

    /// `shapes^T diag(weight) shapes`: how the crack answers to forces on itself, row by row.
    pub fn compliance(&self, weight: &[Group]) -> Vec<f64> {
        let columns = self.columns();
        let mut matrix = vec![0.0; columns * columns];
        for (group, weight) in self.shapes.chunks_exact(columns).zip(weight) {
            for (row, a) in matrix.chunks_exact_mut(columns).zip(group) {
                for (value, b) in row.iter_mut().zip(group) {
                    *value += (0..LANES).map(|l| a[l] * weight[l] * b[l]).sum::<f64>();
                }
            }
        }
        matrix
    }

    /// Motion of the crack that belongs to an amplitude of each mode.
    pub fn at_crack(&self, amplitude: &[Group]) -> Vec<f64> {
        let mut motion = vec![0.0; self.columns()];
        for (group, amplitude) in self.shapes.chunks_exact(self.columns()).zip(amplitude) {
            for (value, a) in motion.iter_mut().zip(group) {
                *value += (0..LANES).map(|l| a[l] * amplitude[l]).sum::<f64>();
            }
        }
        motion
    }

    /// Strain and kinetic energy.
    pub fn energy(&self, q: &[Group], v: &[Group]) -> f64 {
        let mut sum = 0.0;
        for ((q, v), w) in q.iter().zip(v).zip(&self.omega_squared) {
            for l in 0..LANES {
                sum += 0.5 * (v[l] * v[l] + w[l] * q[l] * q[l]);
            }
        }
        sum
    }
}

/// Number of groups for so many modes, in whole bundles.
fn group_count(modes: usize) -> usize {
    modes.div_ceil(LANES * BUNDLE) * BUNDLE
}

fn grouped(values: &[f64]) -> Vec<Group> {
    let mut groups = vec![[0.0; LANES]; group_count(values.len())];
    for (k, value) in values.iter().enumerate() {
        groups[k / LANES][k % LANES] = *value;
    }
    groups
}

/// `a b + c`, in one rounding where the machine has it.
#[inline(always)]
pub fn fma<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}
