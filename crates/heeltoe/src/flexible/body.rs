//! One elastic body of the dam, reduced to its vibration modes, and what the crack feels of it.
//!
//! Each mode obeys
//!
//! ```text
//! w'' + c w' + omega^2 w = f - gamma_x a_x(t) - gamma_z a_z(t) + shapes^T p
//! ```
//!
//! with `w` mass-normalised, `f` the static loads, `a` the ground and `p` the forces on the nodes of the crack, which
//! are counted along it (all first) and across it, away from the lower part.

use super::simd::Group;
use super::simd::LANES;
/// Groups are worked on in bundles of so many, so that their sums run side by side.
pub(super) const BUNDLE: usize = 4;
/// The numbers of one body in its modes; they do not change during a run, and many runs may share them.
pub struct ReducedBody {
    /// Number of modes, without those that fill up the last group.
    pub(super) modes: usize,
    /// Number of nodes on the crack.
    pub(super) nodes: usize,
    /// Number of dashpots, see [`super::dampers`].
    pub(super) dampers: usize,
    /// 1 for a dashpot that takes energy, -1 for one that gives back what others take too much.
    pub(super) damper_signs: Vec<f64>,
    /// Squared circular frequency.
    pub(super) omega_squared: Vec<Group>,
    /// Damping coefficient while some node sticks, and while none does.
    pub(super) damping: [Vec<Group>; 2],
    /// Static loads.
    pub(super) load: Vec<Group>,
    /// Share in the horizontal and in the vertical motion of the ground.
    pub(super) participation: [Vec<Group>; 2],
    /// Modes of the state at the start.
    pub(super) start: Vec<Group>,
    /// Motion of the crack nodes in each mode: for each bundle of groups all `2 nodes` components, then the rates of the
    /// dashpots, each with what it is in every group of the bundle.
    pub(super) shapes: Vec<Group>,
    /// Where the nodes are at the start: along the crack, then across it.
    pub(super) position: Vec<f64>,
}

/// What one body is made from; each slice has one number for each mode.
pub struct Modes<'a> {
    /// Squared circular frequency (1/s2).
    pub omega_squared: &'a [f64],
    /// Damping coefficient while some node sticks, and while none does (1/s).
    pub damping: [&'a [f64]; 2],
    /// Static loads.
    pub load: &'a [f64],
    /// Share in the horizontal and in the vertical motion of the ground.
    pub participation: [&'a [f64]; 2],
    /// Amplitudes at the start.
    pub start: &'a [f64],
    /// Motion of the crack nodes in each mode, `modes x 2 nodes`, row by row.
    pub shapes: &'a [f64],
    /// Where the crack nodes are at the start: along the crack, then across it (m).
    pub position: &'a [f64],
    /// Dashpots that couple the modes, `dashpots x modes`, row by row.
    pub dampers: &'a [f64],
    /// A sign for each.
    pub damper_signs: &'a [f64],
}

impl Modes<'_> {
    fn agree(&self) -> Result<(), &'static str> {
        let count = self.omega_squared.len();
        let columns = self.position.len();
        if count == 0 || columns < 4 || !columns.is_multiple_of(2) {
            return Err("a body needs modes and two crack nodes or more");
        }
        let each = [self.load, self.start]
            .into_iter()
            .chain(self.damping)
            .chain(self.participation);
        let whole = self.dampers.len() == count * self.damper_signs.len();
        if each.into_iter().any(|v| v.len() != count) || self.shapes.len() != count * columns || !whole {
            return Err("the arrays of a body must agree in the number of modes and of crack nodes");
        }
        Ok(())
    }
}

impl ReducedBody {
    /// Put the modes into groups and bundles; the last is filled up with modes that never move.
    ///
    /// # Errors
    /// No modes, less than two crack nodes, or arrays that do not agree in their number.
    pub fn new(modes: &Modes) -> Result<Self, &'static str> {
        modes.agree()?;
        let columns = modes.position.len();
        let count = modes.omega_squared.len();
        let groups = group_count(count);
        let dampers = modes.dampers.len() / count;
        let width = columns + dampers;
        let mut shapes = vec![[0.0; LANES]; groups * width];
        for (mode, row) in modes.shapes.chunks_exact(columns).enumerate() {
            for (c, value) in row.iter().enumerate() {
                shapes[place(width, mode / LANES, c)][mode % LANES] = *value;
            }
        }
        for (c, row) in modes.dampers.chunks_exact(count).enumerate() {
            for (mode, value) in row.iter().enumerate() {
                shapes[place(width, mode / LANES, columns + c)][mode % LANES] = *value;
            }
        }
        Ok(ReducedBody {
            modes: count,
            nodes: columns / 2,
            dampers,
            damper_signs: modes.damper_signs.to_vec(),
            omega_squared: grouped(modes.omega_squared),
            damping: modes.damping.map(grouped),
            load: grouped(modes.load),
            participation: modes.participation.map(grouped),
            start: grouped(modes.start),
            shapes,
            position: modes.position.to_vec(),
        })
    }

    /// Number of nodes on the crack.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Number of dashpots that couple its modes.
    pub fn dampers(&self) -> usize {
        self.dampers
    }

    /// Number of groups of modes.
    pub(super) fn groups(&self) -> usize {
        self.omega_squared.len()
    }

    /// Number of components of motion on the crack.
    pub(super) fn columns(&self) -> usize {
        2 * self.nodes
    }

    /// Number of components of motion on the crack and of dashpots.
    pub(super) fn width(&self) -> usize {
        self.columns() + self.dampers
    }

    /// Groups that hold a number for each of them.
    pub(super) fn stride(&self) -> usize {
        self.width().div_ceil(LANES)
    }

    /// Motion of the crack, or rates of the dashpots, in the modes of a group.
    fn shapes_of(&self, group: usize) -> impl Iterator<Item = &Group> {
        let width = self.width();
        (0..width).map(move |c| &self.shapes[place(width, group, c)])
    }

    /// `shapes^T diag(weight) shapes`: how crack and dashpots answer to forces on them, row by row, each filled up with
    /// zeros to whole groups.
    pub(super) fn compliance(&self, weight: &[Group]) -> Vec<Group> {
        let (width, stride) = (self.width(), self.stride());
        let mut matrix = vec![[0.0; LANES]; width * stride];
        for (group, weight) in weight.iter().enumerate() {
            let shapes: Vec<Group> = self.shapes_of(group).copied().collect();
            for (row, a) in matrix.chunks_exact_mut(stride).zip(&shapes) {
                for (value, b) in row.as_flattened_mut().iter_mut().zip(&shapes) {
                    *value += (0..LANES).map(|l| a[l] * weight[l] * b[l]).sum::<f64>();
                }
            }
        }
        matrix
    }

    /// Motion of the crack that belongs to an amplitude of each mode.
    pub(super) fn at_crack(&self, amplitude: &[Group]) -> Vec<f64> {
        let mut motion = vec![0.0; self.columns()];
        for (group, amplitude) in amplitude.iter().enumerate() {
            for (value, a) in motion.iter_mut().zip(self.shapes_of(group)) {
                *value += (0..LANES).map(|l| a[l] * amplitude[l]).sum::<f64>();
            }
        }
        motion
    }

    /// What forces on the crack nodes are to the modes of a group.
    pub(super) fn on_modes(&self, group: usize, force: &[f64]) -> Group {
        let mut push = [0.0; LANES];
        for (shape, force) in self.shapes_of(group).zip(force) {
            for l in 0..LANES {
                push[l] += shape[l] * force;
            }
        }
        push
    }

    /// Strain and kinetic energy.
    pub(super) fn energy(&self, q: &[Group], v: &[Group]) -> f64 {
        let mut sum = 0.0;
        for ((q, v), w) in q.iter().zip(v).zip(&self.omega_squared) {
            for l in 0..LANES {
                sum += 0.5 * (v[l] * v[l] + w[l] * q[l] * q[l]);
            }
        }
        sum
    }
}

/// Where the component `c` of a group of modes stands among the shapes of a body with so many components.
fn place(width: usize, group: usize, c: usize) -> usize {
    (group / BUNDLE * width + c) * BUNDLE + group % BUNDLE
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
