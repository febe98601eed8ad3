//! What the walk from event to event asks of a block that is carried by integration.

use std::borrow::Cow;

use super::super::block::{Block, Vector, HEEL, SLIP, TOE};
use super::super::mode::{Corner, Mode};
use super::super::walk::{Single, Walk};
use super::block::Rotation;
use super::instant::Slope;
use super::shaking::Piece;
use super::walk::Varying;

impl<'a> Single<'a> for Varying<'a> {
    type Piece = Piece;

    fn walk(&mut self) -> &mut Walk<'a> {
        &mut self.walk
    }

    fn velocity(&self) -> Vector {
        let (corner, state) = self.slipping(&self.state);
        self.turning.contact_velocity(corner, &state)
    }

    fn closed(&self) -> [bool; 2] {
        let gaps = self.turning.gaps(self.corner, &self.state);
        let velocity = self.velocity();
        [
            gaps[0] == 0.0 && velocity[HEEL] == 0.0,
            gaps[1] == 0.0 && velocity[TOE] == 0.0,
        ]
    }

    fn block(&self) -> Cow<'_, Block> {
        let block = self.walk.block;
        let slope = self.slope(&self.state).slope;
        let still = self.turning.at(self.corner, &self.state, &[0.0; 3]);
        let compliance = still.on(Slope { slope, wear: 0.0 }).compliance;
        let block = block.at(compliance, block.free_acceleration).on_slope(slope);
        Cow::Owned(block.rubbing(&self.struck()))
    }

    /// The accelerations with which the block goes on are kept. A corner that would lift takes the bond with it: where no
    /// mode is admissible with a bond, it breaks.
    fn pick(&mut self, piece: &Piece) -> Option<Mode> {
        self.catch_up();
        self.chosen(piece).or_else(|| {
            let breaks = self.break_bond();
            if breaks {
                self.chosen(piece)
            } else {
                None
            }
        })
    }

    fn land(&mut self, gap: usize) -> [bool; 2] {
        let corner = if gap == HEEL { Corner::Heel } else { Corner::Toe };
        if corner != self.corner {
            self.turn_to(corner);
        }
        self.state[1] = 0.0;
        let other = corner.other().gap();
        let open = self.turning.gaps(corner, &self.state)[other - HEEL];
        if self.walk.touches(open, self.velocity()[other]) {
            self.state[2] = 0.0;
        }
        let touching = self.turning.gaps(corner, &self.state).map(|open| open <= 0.0);
        self.strike_on(touching);
        touching
    }

    fn set_velocity(&mut self, velocity: &Vector) {
        // A corner that has come to lie is at exactly zero velocity only where the motion counts from it.
        let other = self.corner.other();
        if self.state[2] == 0.0 && velocity[other.gap()] == 0.0 {
            self.turn_to(other);
        }
        let cosine = match self.turning.rotation {
            Rotation::Finite => self.state[2].cos(),
            _ => 1.0,
        };
        self.state[3] = velocity[SLIP];
        self.state[4] = velocity[self.corner.gap()];
        self.state[5] = self.walk.block.rotation(velocity) / cosine;
    }

    /// The motion counts from a corner that stays in contact.
    fn begin(&mut self) {
        self.reserve = None;
        self.lift();
        if let Mode::Rock(corner) | Mode::SlideRock(corner, _) = self.walk.mode {
            if corner != self.corner {
                self.turn_to(corner);
            }
        }
        self.see();
    }
}
