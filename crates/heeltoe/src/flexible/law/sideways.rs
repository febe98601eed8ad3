//! Motion of the contacts across the valley, as laws need it.

/// Motion of contacts across the valley in a step; nothing where the ground moves along the stream alone.
#[derive(Clone, Copy, Default)]
pub(in super::super) struct Sideways<'a> {
    /// Impulses of friction and bonds, velocities, and those before the step.
    pub p: &'a [f64],
    pub u: &'a [f64],
    pub before: &'a [f64],
    /// About what impulse changes each velocity by 1.
    pub scale: &'a [f64],
}

impl Sideways<'_> {
    /// Size of the vector in the plane of the crack that a number of a contact along it belongs to.
    #[inline(always)]
    pub(super) fn size(along: f64, across: Option<f64>) -> f64 {
        across.map_or(along.abs(), |across| along.hypot(across))
    }
}
