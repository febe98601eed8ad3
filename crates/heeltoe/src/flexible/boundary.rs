//! A step of a body whose boundary takes energy, in blocks of its modes that do not move each other:
//!
//! ```text
//! v* = D g,      u_f = shapes D g,      D = (1 + theta dt c + theta^2 dt^2 omega^2)^-1
//! ```
//!
//! see [`super::modal_stepper`]. Rock that is the same on both sides of the middle of its base moves alike on both sides,
//! or opposite; in either block of modes the nodes come in pairs with
//!
//! ```text
//! shapes_b = s shapes_a,      s = 1 or -1
//! ```
//!
//! so the modes feel `p_a + s p_b`, and half of the shapes says all.

use std::ops::Range;

use super::body::ReducedBody;
use super::inverse::inverse;
use super::panels::Panels;
use super::scheme::TimeStep;
use super::simd::{fill, in_groups, Group, Lanes, LANES};
use super::symmetric::{add_product, Symmetric};

/// A component of motion of the crack or the rate of a link, with another that moves as it does or opposite.
struct Port {
    one: usize,
    other: Option<(usize, f64)>,
}

/// What a step needs of the modes of a block.
struct Block {
    modes: Range<usize>,
    ports: Vec<Port>,
    /// `shapes` of the ports: a row for each of them.
    pushed: Panels,
    /// `D`.
    held: Symmetric,
    /// `shapes D`: a row for each mode.
    moved: Panels,
}

/// What a body with a boundary that takes energy needs for a step.
pub(super) struct Boundary {
    blocks: Vec<Block>,
}

/// Room for the numbers of a block, twice for those of its modes.
pub(super) struct Room {
    ports: Vec<Group>,
    modes: Vec<Group>,
}

impl Room {
    pub(super) fn new(body: &ReducedBody) -> Self {
        let sizes = if body.boundary.is_some() {
            [body.width(), body.modes]
        } else {
            [0; 2]
        };
        let [ports, modes] = sizes.map(|size| size.div_ceil(LANES));
        Room {
            ports: vec![[0.0; LANES]; ports],
            modes: vec![[0.0; LANES]; 2 * modes],
        }
    }
}

impl Boundary {
    /// Of a body with this boundary, and how its crack and links answer to impulses on them, row by row, each filled up
    /// with zeros to whole groups.
    pub(super) fn new(
        body: &ReducedBody,
        boundary: &[Group],
        damping: usize,
        step: TimeStep,
    ) -> (Self, Vec<Group>) {
        let matrix = boundary.as_flattened();
        let stride = LANES * body.groups();
        let mut answers = vec![[0.0; LANES]; body.width() * body.stride()];
        let blocks = blocks(body, matrix, stride)
            .into_iter()
            .map(|(modes, signs)| {
                let of = |k: usize| &matrix[k * stride..][modes.clone()];
                let weight = step.dt * step.theta;
                let (c, w) = (
                    body.damping[damping].as_flattened(),
                    body.omega_squared.as_flattened(),
                );
                let size = modes.len();
                let mut a: Vec<f64> = modes.clone().flat_map(of).map(|c| weight * c).collect();
                for (place, k) in modes.clone().enumerate() {
                    a[place * (size + 1)] += 1.0 + weight * c[k] + weight * weight * w[k];
                }
                let ports = ports(body, &modes, signs.as_deref());
                Block::new(body, modes, ports, &inverse(a, size), &mut answers)
            })
            .collect();
        (Boundary { blocks }, answers)
    }

    /// Add `share` times what impulses are to the modes.
    #[inline(always)]
    pub(super) fn push<W: Lanes>(&self, impulses: &[f64], share: f64, to: &mut [Group], room: &mut Room) {
        let to = to.as_flattened_mut();
        for block in &self.blocks {
            let felt = room.ports.as_flattened_mut();
            for (felt, port) in felt.iter_mut().zip(&block.ports) {
                *felt = impulses[port.one] + port.other.map_or(0.0, |(other, sign)| sign * impulses[other]);
            }
            let pushed = &mut room.modes[..block.modes.len().div_ceil(LANES)];
            pushed.fill([0.0; LANES]);
            block.pushed.combine::<W>(&felt[..block.ports.len()], pushed);
            let pairs = to[block.modes.clone()].iter_mut().zip(pushed.as_flattened());
            pairs.for_each(|(to, pushed)| *to += share * pushed);
        }
    }

    /// Write `D g`.
    #[inline(always)]
    pub(super) fn hold<W: Lanes>(&self, g: &[Group], to: &mut [Group], room: &mut Room) {
        let (g, to) = (g.as_flattened(), to.as_flattened_mut());
        for block in &self.blocks {
            let (own, held) = room.modes.split_at_mut(block.held.groups());
            fill(&g[block.modes.clone()], own);
            let held = &mut held[..block.held.groups()];
            held.fill([0.0; LANES]);
            add_product::<W>(&block.held, own, held);
            to[block.modes.clone()].copy_from_slice(&held.as_flattened()[..block.modes.len()]);
        }
    }

    /// Write `shapes D g`.
    #[inline(always)]
    pub(super) fn motion<W: Lanes>(&self, g: &[Group], to: &mut [Group], room: &mut Room) {
        to.fill([0.0; LANES]);
        let (g, to) = (g.as_flattened(), to.as_flattened_mut());
        for block in &self.blocks {
            let moved = &mut room.ports[..block.ports.len().div_ceil(LANES)];
            moved.fill([0.0; LANES]);
            block.moved.combine::<W>(&g[block.modes.clone()], moved);
            for (moved, port) in moved.as_flattened().iter().zip(&block.ports) {
                to[port.one] += moved;
                if let Some((other, sign)) = port.other {
                    to[other] += sign * moved;
                }
            }
        }
    }
}

impl Block {
    /// With `D` of these modes, row by row; what it is to the answers of the body is added to them.
    fn new(
        body: &ReducedBody,
        modes: Range<usize>,
        ports: Vec<Port>,
        d: &[f64],
        answers: &mut [Group],
    ) -> Self {
        let (count, groups) = (modes.len(), modes.len().div_ceil(LANES));
        let shapes: Vec<Vec<f64>> = ports
            .iter()
            .map(|port| modes.clone().map(|k| body.shape(port.one, k)).collect())
            .collect();
        let held: Vec<Vec<f64>> = shapes
            .iter()
            .map(|shape| {
                d.chunks_exact(count)
                    .map(|row| sum_of_products(row, shape))
                    .collect()
            })
            .collect();
        let stride = LANES * body.stride();
        let answers = answers.as_flattened_mut();
        for (row, held) in ports.iter().zip(&held) {
            for (column, shape) in ports.iter().zip(&shapes) {
                let answer = sum_of_products(held, shape);
                for (r, sign) in row.components() {
                    for (c, other) in column.components() {
                        answers[r * stride + c] += sign * other * answer;
                    }
                }
            }
        }
        let turned: Vec<f64> = (0..count)
            .flat_map(|k| held.iter().map(move |row| row[k]))
            .collect();
        let width = ports.len().div_ceil(LANES);
        Block {
            modes,
            pushed: Panels::new(&in_groups(&shapes.concat(), count), groups, groups),
            held: Symmetric::new(d, count),
            moved: Panels::new(&in_groups(&turned, ports.len().max(1)), width, width),
            ports,
        }
    }
}

impl Port {
    /// Its components with their signs.
    fn components(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        std::iter::once((self.one, 1.0)).chain(self.other)
    }
}

/// Blocks of modes that the boundary does not couple, with the signs of the pairs that their nodes move in; neighbours
/// with the same signs are one, as a boundary that damps each mode alone couples none of them.
fn blocks(body: &ReducedBody, matrix: &[f64], stride: usize) -> Vec<(Range<usize>, Option<Vec<f64>>)> {
    let mut blocks: Vec<(Range<usize>, Option<Vec<f64>>)> = Vec::new();
    let (mut first, mut last) = (0, 0);
    for k in 0..body.modes {
        let row = &matrix[k * stride..][..body.modes];
        last = last.max(row.iter().rposition(|c| *c != 0.0).unwrap_or(k)).max(k);
        if last == k {
            let modes = first..k + 1;
            let signs = signs(body, &modes);
            first = k + 1;
            match blocks.last_mut() {
                Some((before, known)) if *known == signs => before.end = first,
                _ => blocks.push((modes, signs)),
            }
        }
    }
    blocks
}

/// The component of the node that is as far on the other side.
fn mirrored(body: &ReducedBody, component: usize) -> usize {
    let (direction, node) = (component / body.nodes, component % body.nodes);
    direction * body.nodes + body.nodes - 1 - node
}

/// With what sign each component of the crack moves as the mirrored one does in these modes, where all do to the last bit.
fn signs(body: &ReducedBody, modes: &Range<usize>) -> Option<Vec<f64>> {
    let sign = |c: usize| {
        let other = mirrored(body, c);
        let alike = |sign: &f64| {
            let mut pairs = modes.clone().map(|k| (body.shape(c, k), body.shape(other, k)));
            pairs.all(|(own, other)| other == sign * own)
        };
        [1.0, -1.0].into_iter().find(alike)
    };
    (0..body.columns()).map(sign).collect()
}

/// What moves in these modes, by the signs of the pairs.
fn ports(body: &ReducedBody, modes: &Range<usize>, signs: Option<&[f64]>) -> Vec<Port> {
    let moves = |port: &Port| modes.clone().any(|k| body.shape(port.one, k) != 0.0);
    let port = |one| {
        let pair = |signs: &[f64]| (mirrored(body, one), signs[one]);
        let other = signs.filter(|signs| one < signs.len()).map(pair);
        Port {
            one,
            other: other.filter(|(other, _)| *other != one),
        }
    };
    let first_of_pair = |port: &Port| port.other.is_none_or(|(other, _)| port.one < other);
    (0..body.width())
        .map(port)
        .filter(|port| first_of_pair(port) && moves(port))
        .collect()
}

fn sum_of_products(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::super::body::{Modes, ReducedBody};
    use super::super::scheme::TimeStep;
    use super::super::simd::{fill, Plain};
    use super::{inverse, Boundary, Room, LANES};

    const STEP: TimeStep = TimeStep { dt: 0.1, theta: 0.6 };
    const NODES: usize = 5;

    fn number(k: usize) -> f64 {
        ((k * 7919 + 13) % 1009) as f64 / 1009.0 - 0.5
    }

    /// A body of 7 modes that are alike on both sides and 9 that are opposite, each half coupled by its boundary; `skew`
    /// keeps the sides from being the same.
    fn body(skew: f64, coupled: bool) -> (ReducedBody, Vec<f64>, Vec<f64>) {
        let (count, half, columns) = (16, 7, 2 * NODES);
        let mut shapes = vec![0.0; count * columns];
        let mut boundary = vec![0.0; count * count];
        for k in 0..count {
            let sign = if k < half { 1.0 } else { -1.0 };
            for node in 0..NODES.div_ceil(2) {
                let (a, b) = (node, NODES - 1 - node);
                let own = &mut shapes[k * columns..][..columns];
                let [along, across] = [number(31 * k + a), number(17 * k + a + 5)];
                (own[a], own[NODES + a]) = (along, across);
                (own[b], own[NODES + b]) = (-sign * along, sign * across);
                if a == b {
                    own[if sign > 0.0 { a } else { NODES + a }] = 0.0;
                }
            }
            for other in 0..count {
                if (k < half) == (other < half) && (coupled || k == other) {
                    let parts = (0..20).map(|n| number(k * 20 + n) * number(other * 20 + n));
                    boundary[k * count + other] = parts.sum();
                }
            }
        }
        shapes[3] += skew;
        let (none, squares) = (
            vec![0.0; count],
            (0..count).map(|k| (k * k) as f64).collect::<Vec<_>>(),
        );
        let body = ReducedBody::new(&Modes {
            omega_squared: &squares,
            damping: [&none, &none],
            load: &none,
            participation: [&none, &none],
            start: &none,
            shapes: &shapes,
            position: &none[..columns],
            directions: 2,
            dampers: &[],
            damper_signs: &[],
            wet: &[],
            boundary: &boundary,
        });
        let weight = STEP.dt * STEP.theta;
        let mut a: Vec<f64> = boundary.iter().map(|c| weight * c).collect();
        for (k, square) in squares.iter().enumerate() {
            a[k * (count + 1)] += 1.0 + weight * weight * square;
        }
        (body.unwrap(), shapes, inverse(a, count))
    }

    #[test]
    fn blocks_and_pairs_of_nodes_say_what_all_modes_and_nodes_do() {
        for (skew, coupled) in [(0.0, true), (0.0, false), (0.25, true)] {
            let (body, shapes, d) = body(skew, coupled);
            let (count, columns) = (16, 2 * NODES);
            let (boundary, answers) = Boundary::new(&body, body.boundary.as_ref().unwrap(), 0, STEP);
            let of_blocks: Vec<usize> = boundary.blocks.iter().map(|block| block.ports.len()).collect();
            let expected = if skew == 0.0 { vec![5, 5] } else { vec![9, 5] };
            assert_eq!(of_blocks, expected);
            let mut room = Room::new(&body);
            let g: Vec<f64> = (0..count).map(|k| number(k + 3)).collect();
            let impulses: Vec<f64> = (0..columns).map(|k| number(k + 77)).collect();
            let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a} {b}");
            let row = |k: usize| &d[k * count..][..count];
            let shape = |c: usize, k: usize| shapes[k * columns + c];
            let held = |k: usize| row(k).iter().zip(&g).map(|(d, g)| d * g).sum::<f64>();
            let mut to = vec![[0.0; 8]; body.groups()];
            let mut start = to.clone();
            fill(&g, &mut start);
            boundary.hold::<Plain>(&start, &mut to, &mut room);
            (0..count).for_each(|k| close(to.as_flattened()[k], held(k)));
            let mut moved = vec![[1.0; 8]; body.stride()];
            boundary.motion::<Plain>(&start, &mut moved, &mut room);
            let motion = |c: usize| (0..count).map(|k| shape(c, k) * held(k)).sum::<f64>();
            (0..columns).for_each(|c| close(moved.as_flattened()[c], motion(c)));
            let mut pushed = start.clone();
            boundary.push::<Plain>(&impulses, 0.5, &mut pushed, &mut room);
            for (k, g) in g.iter().enumerate() {
                let push = (0..columns).map(|c| shape(c, k) * impulses[c]).sum::<f64>();
                close(pushed.as_flattened()[k], g + 0.5 * push);
            }
            for r in 0..columns {
                for c in 0..columns {
                    let answer = |k: usize| {
                        let turned = row(k)
                            .iter()
                            .enumerate()
                            .map(|(j, d)| d * shape(c, j))
                            .sum::<f64>();
                        shape(r, k) * turned
                    };
                    let expected = (0..count).map(answer).sum::<f64>();
                    close(answers.as_flattened()[r * LANES * body.stride() + c], expected);
                }
            }
        }
    }
}
