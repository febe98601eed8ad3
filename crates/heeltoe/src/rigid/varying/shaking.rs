//! The ground's motion: `(a_h, a_v, alpha)(t)`, linear between the samples; the ground may turn, too.

use super::super::shaking::{Piece as Level, Range, Shaking};
use crate::Error;

/// Ground acceleration: horizontal, upward, rotation (counter-clockwise about the middle of the crack).
pub(super) type Ground = [f64; 3];

/// Ground acceleration from here to the end of the piece.
pub(super) type Piece = Level<3>;

/// The same piece without a ground that turns.
pub(super) fn level(piece: &Piece) -> Level<2> {
    let ([across, up, _], [per_across, per_up, _]) = (piece.ground, piece.rate);
    Level {
        ground: [across, up],
        rate: [per_across, per_up],
        left: piece.left,
    }
}

/// Accelerations of a ground that turns.
#[derive(Clone, Debug)]
pub struct TurningShaking<'a> {
    pub(super) level: Shaking<'a>,
    turning: Option<&'a [f64]>,
}

impl<'a> TurningShaking<'a> {
    /// Add a rotational acceleration about the middle of the crack (rad/s2), if there is one, to the others.
    ///
    /// # Errors
    /// Not as many accelerations as moments.
    pub fn new(level: Shaking<'a>, turning: Option<&'a [f64]>) -> Result<Self, Error> {
        if turning.is_some_and(|a| a.len() != level.time.len()) {
            let why = "a motion needs as many rotational accelerations as times";
            return Err(Error::Motion(why));
        }
        Ok(TurningShaking { level, turning })
    }

    /// A ground that never turns.
    pub(in super::super) fn straight(level: &Shaking<'a>) -> Self {
        TurningShaking {
            level: level.clone(),
            turning: None,
        }
    }

    /// Whether it never turns.
    pub(in super::super) fn is_level(&self) -> bool {
        self.turning.is_none()
    }

    /// Largest accelerations, without their signs.
    pub(super) fn peaks(&self) -> Ground {
        let [horizontal, vertical] = self.level.peaks();
        let turning = self.turning.unwrap_or(&[]).iter();
        [
            horizontal,
            vertical,
            turning.fold(0.0, |peak, a| peak.max(a.abs())),
        ]
    }

    /// The first sample from `k` on that is not `within` some limits, or the number of samples. Between any two
    /// accelerations within the limits all are.
    pub(super) fn first_beyond(&self, k: usize, within: impl Fn(&Ground) -> bool) -> usize {
        if self.turning.is_some() {
            let n = self.level.time.len();
            return (k..n).find(|k| !within(&self.at(*k))).unwrap_or(n);
        }
        let corners = |[across, up]: [Range; 2]| {
            let all = across.iter().flat_map(|a| up.map(|b| [*a, b, 0.0]));
            all.into_iter().all(|corner| within(&corner))
        };
        self.level.first_beyond(k, corners, |[a, b]| within(&[a, b, 0.0]))
    }

    /// The piece from a sample to the next one.
    pub(super) fn piece(&self, k: usize) -> Piece {
        let left = self.level.time[k + 1] - self.level.time[k];
        let (a0, a1) = (self.at(k), self.at(k + 1));
        Piece {
            ground: a0,
            rate: [0, 1, 2].map(|i| (a1[i] - a0[i]) / left),
            left,
        }
    }

    pub(super) fn at(&self, k: usize) -> Ground {
        let [horizontal, vertical] = self.level.at(k);
        [horizontal, vertical, self.turning.map_or(0.0, |a| a[k])]
    }
}
