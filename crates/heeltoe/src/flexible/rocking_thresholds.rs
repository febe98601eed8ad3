//! What the part above the crack does as a whole: rest, slide, rock, slide while it rocks, drift.
//!
//! An elastic crack opens at its heel long before the part above it rocks, and some node of it slips in every
//! earthquake. So no single node decides, but what the part stands on, how far it has turned and what holds it:
//!
//! ```text
//! drifts    nothing touches, and the nearest node of the crack is farther off than `give.gap`
//! rocks     all that touches lies within a quarter of the crack from heel or toe, and the rotation of the face
//!           about that end is larger than `give.rotation`
//! slides    of what touches more than half slips
//! ```
//!
//! The rotation is that of the straight lines that fit both faces best, each node with its share of the crack. What
//! leaves the other face by less than `give.gap` still stands on its nearest node.

use super::contact::Contactor;
use super::crack_line::RockingThresholds;
use super::faces::{Face, Meeting};
use super::observe::State;
use super::status::Status;

/// A part that stands on less of the crack than this, about one end, may be rocking: with a pressure that falls off
/// linearly its resultant has come to a twelfth of the width, five sixths of the way to where a rigid block rocks.
const STANDS_ON: f64 = 0.25;
/// A part that more of what touches lets go than this is no longer held.
const HALF: f64 = 0.5;

/// The shares of the nodes, from where they stood at the start.
pub(super) struct Stance {
    give: RockingThresholds,
    /// Of each contactor in the length of its face.
    lengths: Vec<f64>,
    /// Of each node in the rotation of its face.
    upper: Vec<f64>,
    lower: Vec<f64>,
}

impl Stance {
    /// Of the crack with these contactors.
    pub(super) fn new(give: RockingThresholds, contactors: &[Contactor], faces: Meeting) -> Self {
        let [upper, lower] = [faces.upper, faces.lower].map(|face| lengths(face.along));
        let own = |of_upper: bool| if of_upper { &upper } else { &lower };
        Stance {
            give,
            lengths: contactors.iter().map(|c| own(c.of_upper)[c.node]).collect(),
            upper: slopes(faces.upper, &upper),
            lower: slopes(faces.lower, &lower),
        }
    }

    /// Tell what the part does, from where both faces are, the state of each contact and the gaps.
    pub(super) fn state(
        &self,
        faces: Meeting,
        contactors: &[Contactor],
        gaps: &[f64],
        status: &[Status],
    ) -> State {
        let mut stand = Stand::on(faces);
        for (k, status) in status.iter().enumerate() {
            if status.closed() {
                stand.add(&contactors[k], self.lengths[k], *status != Status::Stick);
            }
        }
        if stand.length == 0.0 {
            let nearest = (0..status.len()).min_by(|a, b| gaps[*a].total_cmp(&gaps[*b]));
            match nearest {
                Some(k) if gaps[k] <= self.give.gap => stand.add(&contactors[k], self.lengths[k], true),
                _ => return State::Drifting,
            }
        }
        let rotation = turned(faces.upper, &self.upper) - turned(faces.lower, &self.lower);
        let narrow = STANDS_ON * (stand.toe - stand.heel);
        let on_heel = stand.last - stand.heel <= narrow && rotation > self.give.rotation;
        let on_toe = stand.toe - stand.first <= narrow && -rotation > self.give.rotation;
        match (on_heel || on_toe, stand.slipping > HALF * stand.length) {
            (false, false) => State::Rest,
            (false, true) => State::Sliding,
            (true, false) => State::Rocking,
            (true, true) => State::SlideRocking,
        }
    }
}

/// What the part above the crack stands on.
struct Stand<'a> {
    faces: Meeting<'a>,
    /// Ends of where both faces are.
    heel: f64,
    toe: f64,
    /// Ends of what touches.
    first: f64,
    last: f64,
    /// Length of what touches, and of what slips of it.
    length: f64,
    slipping: f64,
}

impl<'a> Stand<'a> {
    fn on(faces: Meeting<'a>) -> Self {
        let ends = |face: Face| match face.along {
            [] => (f64::NEG_INFINITY, f64::INFINITY),
            along => (along[0], along[along.len() - 1]),
        };
        let (upper, lower) = (ends(faces.upper), ends(faces.lower));
        Stand {
            faces,
            heel: upper.0.max(lower.0),
            toe: upper.1.min(lower.1),
            first: f64::INFINITY,
            last: f64::NEG_INFINITY,
            length: 0.0,
            slipping: 0.0,
        }
    }

    fn add(&mut self, contactor: &Contactor, length: f64, slips: bool) {
        let face = if contactor.of_upper {
            self.faces.upper
        } else {
            self.faces.lower
        };
        let place = face.along[contactor.node];
        self.first = self.first.min(place);
        self.last = self.last.max(place);
        self.length += length;
        if slips {
            self.slipping += length;
        }
    }
}

/// Length of the face that belongs to each node: half of what is between it and its neighbours.
fn lengths(along: &[f64]) -> Vec<f64> {
    let last = along.len().saturating_sub(1);
    (0..along.len())
        .map(|k| (along[(k + 1).min(last)] - along[k.saturating_sub(1)]) / 2.0)
        .collect()
}

/// Shares of the nodes' motions across the crack in the slope of the straight line that fits them best.
fn slopes(face: Face, lengths: &[f64]) -> Vec<f64> {
    let along = face.along;
    let mean = |of: &dyn Fn(f64) -> f64| along.iter().zip(lengths).map(|(x, w)| w * of(*x)).sum::<f64>();
    let middle = mean(&|x| x) / mean(&|_| 1.0);
    let spread = mean(&|x| (x - middle).powi(2));
    along
        .iter()
        .zip(lengths)
        .map(|(x, w)| w * (x - middle) / spread)
        .collect()
}

/// Rotation of a face; none of a rigid plane.
fn turned(face: Face, slopes: &[f64]) -> f64 {
    face.across.iter().zip(slopes).map(|(n, share)| share * n).sum()
}
