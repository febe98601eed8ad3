//! How the walk from event to event has the block in the plane carried.

use std::borrow::Cow;

use super::super::block::{Block, Vector};
use super::super::impact::{Impact, Sideways};
use super::super::mode::{Mode, Slip};
use super::super::shaking::Piece;
use super::super::walk::{Cause, Ended, Exactly, Single, Walk};
use super::walk::{Going, Plane, SIDES};

impl<'a> Single<'a> for Plane<'a> {
    type Piece = Piece<3>;

    fn walk(&mut self) -> &mut Walk<'a> {
        &mut self.walk
    }

    fn velocity(&self) -> Vector {
        self.walk.summary.velocity
    }

    fn closed(&self) -> [bool; 2] {
        self.lying()
    }

    fn block(&self) -> Cow<'_, Block> {
        Cow::Borrowed(self.walk.block)
    }

    fn sideways(&self) -> Option<Sideways> {
        Some(Sideways {
            mass: self.across.mass,
            velocity: self.crossing.velocity,
        })
    }

    fn set_sideways(&mut self, velocity: f64) {
        self.crossing.velocity = velocity;
    }

    fn stop_aside(&mut self, gap: usize) -> Option<Impact> {
        SIDES
            .into_iter()
            .find(|side| side.0 == gap)
            .map(|side| self.strike_side(side.1))
    }

    fn pick(&mut self, piece: &Piece<3>) -> Option<Mode> {
        let here = self.here(piece);
        self.going = self.go(&here)?;
        let moved = Plane::velocity(self) != [0.0; 2];
        Some(match (&self.going, self.walk.mode) {
            (Going::Rests { .. }, _) => Mode::Rest,
            (Going::Lifted(lifted), _) => lifted.mode,
            // To turn on the way is no event.
            (_, Mode::Slide(way)) if moved => Mode::Slide(way),
            (Going::Moves { flight, .. }, _) if flight.velocities(flight.length)[0] < 0.0 => {
                Mode::Slide(Slip::Upstream)
            }
            _ => Mode::Slide(Slip::Downstream),
        })
    }

    /// Both gaps may have closed: corners nearer than rounding strike together.
    fn land(&mut self, _gap: usize) -> [bool; 2] {
        self.walk.land()
    }

    fn set_velocity(&mut self, velocity: &Vector) {
        self.walk.summary.velocity = *velocity;
    }

    fn begin(&mut self) {}
}

impl<'a> Exactly<'a, 1, 3> for Plane<'a> {
    fn advance(&mut self, piece: &Piece<3>, time: f64) -> (f64, Option<Ended>) {
        let (mut here, mut going, mut local) = (self.here(piece), self.going, 0.0);
        loop {
            let (step, cause) = self.go_on(&here, &going, time + local);
            let ended = step >= here.left;
            let stands = local + step <= local;
            local += step;
            let lies = !matches!(going, Going::Lifted(_));
            if cause.is_none() && ended {
                return (piece.left, None);
            }
            here = self.here(&piece.rest(local));
            // At the end of a short step the series errs in the acceleration, and so in the normal forces.
            let doubtful = cause == Some(Cause::Normal) && lies && !ended && {
                let next = self.choose_way(&here);
                self.presses(&here, &next)
            };
            if cause.is_some() && !doubtful {
                return (local, cause.map(|cause| (0, cause)));
            }
            let goes_on = match &going {
                Going::Lifted(lifted) => {
                    let same = self.held(&here) == self.side;
                    let next = self.lifted(lifted.mode, &here).filter(|_| same);
                    next.map(Going::Lifted)
                }
                _ => {
                    let next = self.choose_way(&here);
                    (next.moves() == going.moves()).then_some(next)
                }
            };
            match goes_on {
                Some(next) if !stands => going = next,
                _ => return (local, Some((0, Cause::Cone))),
            }
        }
    }
}
