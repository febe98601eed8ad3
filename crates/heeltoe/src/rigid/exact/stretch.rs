//! What rest or a slide on both corners adds up to from its start to its end.
//!
//! On such a stretch all forces are affine in the ground's accelerations, `f = f_0 + f_h a_h + f_v a_v`, so each does the
//! work `f_0 s + f_h P_h + f_v P_v` with the slip `s` and `P = integral a s' dt`, which is summed exactly piece by piece.

use super::super::block::{Affine, SLIP};
use super::super::ledger::{path_and_moment, Work};
use super::super::mode::Mode;
use super::super::shaking::Piece;
use super::walk::Exact;

/// A stretch of rest or of a slide that has not ended yet.
#[derive(Clone, Copy, Default)]
pub(super) struct Stretch {
    mode: Option<Mode>,
    since: f64,
    /// Slip on it.
    slip: f64,
    /// Integrals of the horizontal and of the vertical acceleration over the slip.
    power: [f64; 2],
}

impl Stretch {
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
        self.power[0] += piece.ground[0] * path + piece.rate[0] * moment;
        if !LEVEL {
            self.power[1] += piece.ground[1] * path + piece.rate[1] * moment;
        }
        path
    }

    /// Work of a force on it.
    fn work(&self, force: &Affine) -> Work {
        let parts = [
            force.constant * self.slip,
            force.horizontal * self.power[0],
            force.vertical * self.power[1],
        ];
        Work {
            net: parts.iter().sum(),
            size: parts.iter().map(|part| part.abs()).sum(),
        }
    }
}

impl Exact<'_> {
    /// Where the block rests or slides in another mode than before, from this time on: put what was into the summary.
    #[inline(always)]
    pub(super) fn turn_over(&mut self, time: f64) {
        if self.stretch.mode != Some(self.walk.mode) {
            self.close(time);
        }
    }

    /// Put the stretch that ends at this time into the summary, and begin another.
    pub(super) fn close(&mut self, time: f64) {
        let s = &mut self.walk.summary;
        let stretch = &self.stretch;
        if let Some(mode) = stretch.mode.filter(|mode| mode.contacts() == [true, true]) {
            let kind = mode.kind();
            s.time_by_mode[kind] += time - stretch.since;
            if mode != Mode::Rest {
                s.slip_by_mode[kind] += stretch.slip;
                let friction = self.reactions.of(mode).quantity(SLIP);
                s.ledger
                    .apply(stretch.work(&self.walk.block.generalised_force[SLIP]));
                s.ledger.rub(stretch.work(&friction));
            }
        }
        self.stretch = Stretch {
            mode: Some(self.walk.mode),
            since: time,
            ..Stretch::default()
        };
    }
}
