//! Sums over rest or a slide on both corners from its start to its end.
//!
//! On such a stretch all forces are affine in the ground's accelerations, `f = f_0 + f_h a_h + f_v a_v`, so each does the
//! work `f_0 s + f_h P_h + f_v P_v` with the slip `s` and `P = integral a s' dt`, which is summed exactly piece by piece.

use super::super::block::Affine;
use super::super::ledger::{path_and_moment, Work};
use super::super::mode::Mode;
use super::super::shaking::Piece;

/// A stretch of rest or of a slide that has not ended yet.
#[derive(Clone, Copy, Default)]
pub(super) struct Stretch {
    pub mode: Option<Mode>,
    /// When it began (s).
    pub since: f64,
    /// Slip on it.
    pub slip: f64,
    /// Integrals of the horizontal and of the vertical acceleration over the slip.
    power: [f64; 2],
    /// How much goes to and fro in them.
    gross: [f64; 2],
}

impl Stretch {
    /// One that begins now.
    pub(super) fn begin(mode: Mode, since: f64) -> Self {
        Stretch {
            mode: Some(mode),
            since,
            ..Stretch::default()
        }
    }

    /// The same with the slip counted this way, 1 or -1.
    #[inline(always)]
    pub(super) fn turned(self, way: f64) -> Self {
        Stretch {
            slip: way * self.slip,
            power: self.power.map(|power| way * power),
            ..self
        }
    }

    /// Slide on with a velocity and an acceleration that changes linearly for `step` of a piece; returns how far.
    #[inline(always)]
    pub(super) fn slide<const LEVEL: bool>(
        &mut self,
        velocity: f64,
        acceleration: [f64; 2],
        piece: &Piece<2>,
        step: f64,
    ) -> f64 {
        let (path, moment) = path_and_moment(velocity, acceleration, step);
        self.slip += path;
        let components = if LEVEL { 1 } else { 2 };
        for i in 0..components {
            let (steady, changing) = (piece.ground[i] * path, piece.rate[i] * moment);
            self.power[i] += steady + changing;
            self.gross[i] += steady.abs() + changing.abs();
        }
        path
    }

    /// Work of a force on it.
    pub(super) fn work(&self, force: &Affine) -> Work {
        let steady = force.constant * self.slip;
        let per = [force.horizontal, force.vertical];
        Work {
            net: steady + per[0] * self.power[0] + per[1] * self.power[1],
            size: steady.abs() + per[0].abs() * self.gross[0] + per[1].abs() * self.gross[1],
        }
    }
}
