//! What is read off the crack in each step: slip, rotation, openings, strikes, and in which state all that happens.

use super::contact::Contacts;
use super::coulomb::Status;
use super::result::Summary;

/// Nodes of both faces at one moment, positions along the crack and then across it.
#[derive(Clone, Copy)]
pub struct Faces<'a> {
    pub upper: &'a [f64],
    /// Empty on a rigid plane.
    pub lower: &'a [f64],
}

/// The motion of the upper face against the lower one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Motion {
    pub slip: f64,
    pub rotation: f64,
    pub opening_heel: f64,
    pub opening_toe: f64,
}

impl Motion {
    /// Measure; `zero` is the mean position along the crack of the upper face less that of the lower at the start.
    #[inline(always)]
    pub fn of(faces: Faces, zero: f64) -> Self {
        let (upper, lower) = (faces.upper, faces.lower);
        let k = upper.len() / 2;
        let ends = [0, k - 1].map(|node| upper[k + node] - height(lower, upper[node]));
        let mut rotation = chord(upper);
        if !lower.is_empty() {
            rotation -= chord(lower);
        }
        Motion {
            slip: mean_along(upper) - mean_along(lower) - zero,
            rotation,
            opening_heel: ends[0],
            opening_toe: ends[1],
        }
    }
}

/// Mean of the positions, or velocities, along the crack; zero for a rigid plane.
#[inline(always)]
pub fn mean_along(face: &[f64]) -> f64 {
    let k = face.len() / 2;
    face[..k].iter().sum::<f64>() / k.max(1) as f64
}

/// Rotation of the line from heel to toe.
#[inline(always)]
fn chord(face: &[f64]) -> f64 {
    let k = face.len() / 2;
    (face[2 * k - 1] - face[k]) / (face[k - 1] - face[0])
}

/// Height of the lower face at `t`; beyond its ends that of the end, and zero on a rigid plane.
#[inline(always)]
pub fn height(face: &[f64], t: f64) -> f64 {
    if face.is_empty() {
        return 0.0;
    }
    let k = face.len() / 2;
    let (along, across) = face.split_at(k);
    let j = along.partition_point(|a| *a <= t).clamp(1, k - 1) - 1;
    let s = ((t - along[j]) / (along[j + 1] - along[j])).clamp(0.0, 1.0);
    across[j] + s * (across[j + 1] - across[j])
}

/// States of the whole crack: nothing slips and all touch; all touch; some do, and none or some of them slips; none
/// touches.
pub const REST: usize = 0;
pub const SLIDING: usize = 1;
pub const ROCKING: usize = 2;
pub const SLIDE_ROCKING: usize = 3;
pub const DRIFTING: usize = 4;
pub const STATES: [&str; 5] = ["rest", "sliding", "rocking", "slide-rocking", "drifting"];
/// Under which of sliding, slide-rocking and drifting the slip of each state is booked: the little that a crack at
/// rest slips is elastic, it comes and goes.
const SLIPS_AS: [usize; 5] = [0, 0, 1, 1, 2];

/// Tell in which state the crack is.
#[inline(always)]
pub fn state(status: &[Status]) -> usize {
    let (mut touching, mut open, mut slipping) = (false, false, false);
    for s in status {
        match s {
            Status::Absent => {}
            Status::Open => open = true,
            Status::Stick => touching = true,
            _ => {
                touching = true;
                slipping = true;
            }
        }
    }
    match (touching, open, slipping) {
        (false, ..) => DRIFTING,
        (_, true, true) => SLIDE_ROCKING,
        (_, true, false) => ROCKING,
        (_, false, true) => SLIDING,
        _ => REST,
    }
}

/// Book one step: `before` and `after` are the motion at its start and end.
#[inline(always)]
pub fn book(
    summary: &mut Summary,
    dt: f64,
    before: &Motion,
    after: &Motion,
    state: usize,
    normal_force: f64,
) {
    let slip = after.slip - before.slip;
    summary.time_by_state[state] += dt;
    summary.slip_by_state[SLIPS_AS[state]] += slip;
    summary.slip = after.slip;
    summary.slip_velocity = slip / dt;
    summary.slip_max = summary.slip_max.max(after.slip);
    summary.slip_min = summary.slip_min.min(after.slip);
    summary.rotation_max = summary.rotation_max.max(after.rotation);
    summary.rotation_min = summary.rotation_min.min(after.rotation);
    summary.opening_heel = summary.opening_heel.max(after.opening_heel);
    summary.opening_toe = summary.opening_toe.max(after.opening_toe);
    summary.peak_normal_force = summary.peak_normal_force.max(normal_force);
    summary.final_state = state as u8;
}

/// Count the nodes that have come down in this step, and how fast they came; `velocities` are those before it.
#[inline(always)]
pub fn strikes(
    summary: &mut Summary,
    contacts: &Contacts,
    before: &[bool],
    now: &[Status],
    velocities: &[f64],
) {
    for (k, status) in now.iter().enumerate() {
        let speed = -velocities[k];
        if status.closed() && !before[k] && speed > 0.0 {
            summary.impacts += 1;
            summary.impact_velocity = summary.impact_velocity.max(speed);
        }
        summary.penetration = summary.penetration.max(-contacts.gaps[k]);
    }
}
