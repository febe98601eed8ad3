//! Numbers of the nodes on the faces of cracks, and what is read off a face.

use super::crack_line::Span;

/// Numbers of the crack nodes of the parts above and below a crack, of either all along its cracks and then all across
/// them.
#[derive(Clone, Copy)]
pub(super) struct Faces<'a> {
    pub upper: &'a [f64],
    /// Empty on a rigid plane.
    pub lower: &'a [f64],
}

impl<'a> Faces<'a> {
    /// Those around a crack, from one quantity of all parts.
    #[inline(always)]
    pub(super) fn around<T>(crack: usize, parts: &'a [T], of: impl Fn(&'a T) -> &'a [f64]) -> Self {
        Faces {
            upper: of(&parts[crack]),
            lower: parts.get(crack + 1).map_or(&[], of),
        }
    }
}

/// Numbers of the nodes of one face of a crack.
#[derive(Clone, Copy)]
pub(super) struct Face<'a> {
    pub along: &'a [f64],
    pub across: &'a [f64],
}

impl<'a> Face<'a> {
    #[inline(always)]
    pub(super) fn of(all: &'a [f64], span: Span) -> Self {
        let (along, across) = all.split_at(all.len() / 2);
        Face {
            along: &along[span.first..][..span.count],
            across: &across[span.first..][..span.count],
        }
    }

    /// The only face of a body.
    #[inline(always)]
    pub(super) fn whole(all: &'a [f64]) -> Self {
        let (along, across) = all.split_at(all.len() / 2);
        Face { along, across }
    }
}

/// Numbers of the nodes of both faces of a crack.
#[derive(Clone, Copy)]
pub(super) struct Meeting<'a> {
    pub upper: Face<'a>,
    /// Empty on a rigid plane.
    pub lower: Face<'a>,
}

/// Mean of the positions, or velocities, along the crack; zero for a rigid plane.
#[inline(always)]
pub(super) fn mean_along(face: Face) -> f64 {
    face.along.iter().sum::<f64>() / face.along.len().max(1) as f64
}

/// Rotation of the line from heel to toe.
#[inline(always)]
pub(super) fn chord(face: Face) -> f64 {
    let last = face.along.len() - 1;
    (face.across[last] - face.across[0]) / (face.along[last] - face.along[0])
}

/// Height of the lower face at `t`; beyond its ends that of the end, and zero on a rigid plane.
#[inline(always)]
pub(super) fn height(face: Face, t: f64) -> f64 {
    let Face { along, across } = face;
    if along.is_empty() {
        return 0.0;
    }
    let j = along.partition_point(|a| *a <= t).clamp(1, along.len() - 1) - 1;
    let s = ((t - along[j]) / (along[j + 1] - along[j])).clamp(0.0, 1.0);
    across[j] + s * (across[j + 1] - across[j])
}
