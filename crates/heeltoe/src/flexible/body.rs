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
use crate::error::Error;
/// Groups are worked on in bundles of so many, so that their sums run side by side.
pub(super) const BUNDLE: usize = 4;
/// The numbers of one body in its modes; they do not change during a run, and many runs may share them.
#[derive(Debug)]
pub struct ReducedBody {
    /// Number of modes, without those that fill up the last group.
    pub(super) modes: usize,
    /// Number of nodes on the crack.
    pub(super) nodes: usize,
    /// Components of the motion of each: along the crack and across it, or one across the valley.
    pub(super) directions: usize,
    /// Number of dashpots, see [`super::dampers`].
    pub(super) dampers: usize,
    /// Number of rows of the water on its wet faces, see [`super::reservoir`].
    pub(super) wet: usize,
    /// Whether any of these rows has to do with it; without water they are few, and there always.
    pub(super) tied: bool,
    /// What its boundary takes, a symmetric matrix over all modes and those that fill up the last group, row by row; none
    /// of a body without such a boundary.
    pub(super) boundary: Option<Vec<Group>>,
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
    /// Components of the motion of each node: two, or one of a body that moves across the valley.
    pub directions: usize,
    /// Dashpots that couple the modes, `dashpots x modes`, row by row.
    pub dampers: &'a [f64],
    /// A sign for each.
    pub damper_signs: &'a [f64],
    /// Rows of the water on the wet faces, `modes of the water x modes`, row by row; empty without water.
    pub wet: &'a [f64],
    /// Damping of the boundary, `modes x modes`, symmetric, row by row (1/s); empty where it takes nothing.
    pub boundary: &'a [f64],
}

impl Modes<'_> {
    fn agree(&self) -> Result<(), Error> {
        let count = self.omega_squared.len();
        let columns = self.position.len();
        let directions = self.directions;
        if count == 0
            || ![1, 2].contains(&directions)
            || columns < 2 * directions
            || !columns.is_multiple_of(directions)
        {
            return Err(Error::Body("a body needs modes and two crack nodes or more"));
        }
        let each = [self.load, self.start]
            .into_iter()
            .chain(self.damping)
            .chain(self.participation);
        let whole = self.dampers.len() == count * self.damper_signs.len()
            && self.wet.len().is_multiple_of(count)
            && [0, count * count].contains(&self.boundary.len());
        if each.into_iter().any(|v| v.len() != count) || self.shapes.len() != count * columns || !whole {
            return Err(Error::Body(
                "the arrays of a body must agree in the number of modes and of crack nodes",
            ));
        }
        Ok(())
    }
}

impl ReducedBody {
    /// Put the modes into groups and bundles; the last is filled up with modes that never move.
    ///
    /// # Errors
    /// No modes, less than two crack nodes, or arrays that do not agree in their number.
    pub fn new(modes: &Modes) -> Result<Self, Error> {
        modes.agree()?;
        let columns = modes.position.len();
        let count = modes.omega_squared.len();
        let groups = group_count(count);
        let (dampers, wet) = (modes.dampers.len() / count, modes.wet.len() / count);
        let moves = |rows: &[f64]| rows.iter().any(|x| *x != 0.0);
        let tied = wet == 0 || moves(modes.dampers) || moves(modes.wet);
        let width = columns + if tied { dampers + wet } else { 0 };
        let mut shapes = vec![[0.0; LANES]; groups * width];
        for (mode, row) in modes.shapes.chunks_exact(columns).enumerate() {
            for (c, value) in row.iter().enumerate() {
                shapes[place(width, mode / LANES, c)][mode % LANES] = *value;
            }
        }
        let links = modes
            .dampers
            .chunks_exact(count)
            .chain(modes.wet.chunks_exact(count));
        for (c, row) in links.enumerate().filter(|_| tied) {
            for (mode, value) in row.iter().enumerate() {
                shapes[place(width, mode / LANES, columns + c)][mode % LANES] = *value;
            }
        }
        Ok(ReducedBody {
            modes: count,
            nodes: columns / modes.directions,
            directions: modes.directions,
            dampers,
            wet,
            tied,
            boundary: (!modes.boundary.is_empty()).then(|| {
                let mut matrix = vec![[0.0; LANES]; groups * LANES * groups];
                let rows = modes.boundary.chunks_exact(count);
                for (full, row) in matrix.chunks_exact_mut(groups).zip(rows) {
                    full.as_flattened_mut()[..count].copy_from_slice(row);
                }
                matrix
            }),
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

    /// Number of components of the motion of each.
    pub fn directions(&self) -> usize {
        self.directions
    }

    /// Number of dashpots that couple its modes.
    pub fn dampers(&self) -> usize {
        self.dampers
    }

    /// Number of rows of the water.
    pub fn wet(&self) -> usize {
        self.wet
    }

    /// Whether the boundary takes energy of a mode, as that of the rock does.
    pub(super) fn of_rock(&self, group: usize, lane: usize) -> bool {
        let mode = group * LANES + lane;
        let takes = |matrix: &Vec<Group>| matrix.as_flattened()[mode * (self.groups() * LANES + 1)] > 0.0;
        self.boundary.as_ref().is_some_and(takes)
    }

    /// Whether its boundary takes energy.
    pub fn radiates(&self) -> bool {
        self.boundary.is_some()
    }

    /// Number of rows by which something ties the modes of all parts: dashpots first, then water.
    pub(super) fn rows(&self) -> usize {
        self.dampers + self.wet
    }

    /// Number of those that are there for this body.
    pub(super) fn links(&self) -> usize {
        if self.tied {
            self.rows()
        } else {
            0
        }
    }

    /// Numbers of its modes, without those that fill up the last group.
    pub(super) fn without_filling<'a>(&self, numbers: &'a [Group]) -> &'a [f64] {
        &numbers.as_flattened()[..self.modes]
    }

    /// Number of modes.
    pub fn count(&self) -> usize {
        self.modes
    }

    /// Number of groups of modes.
    pub(super) fn groups(&self) -> usize {
        self.omega_squared.len()
    }

    /// Number of components of motion on the crack.
    pub(super) fn columns(&self) -> usize {
        self.directions * self.nodes
    }

    /// Number of components of motion on the crack and of rows that tie the modes.
    pub(super) fn width(&self) -> usize {
        self.columns() + self.links()
    }

    /// Groups that hold a number for each of them.
    pub(super) fn stride(&self) -> usize {
        self.width().div_ceil(LANES)
    }

    /// Motion of a component of the crack, or rate of a link, in a mode.
    pub(super) fn shape(&self, component: usize, mode: usize) -> f64 {
        self.shapes[place(self.width(), mode / LANES, component)][mode % LANES]
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
