//! A block at rest: its reactions are linear in the ground's acceleration, so that it need not be integrated to see
//! that it stays where it is: every limit is `still + a_h across + a_v up + alpha turning`.

use super::advance::Trial;
use super::shaking::{Ground, Piece};
use super::walk::Varying;

/// A limit is far off by more than this part of the forces at hand: well beyond what rounding could make of it.
const CLEAR: f64 = 1e-9;

impl Varying<'_> {
    /// Pass over a piece in which a block at rest stays clear of every limit; false where it may not.
    pub(super) fn rests_through(&mut self, piece: &Piece, time: f64) -> bool {
        let clear = CLEAR * self.walk.block.force_scale;
        if let Some(rubbing) = self.rubbing.as_ref().filter(|rubbing| rubbing.bends()) {
            return rubbing.sags_nowhere() && self.bends_through(piece, time, clear);
        }
        let [still, across, up, turning] = self.reserve.unwrap_or_else(|| self.reserve_at_rest());
        self.reserve = Some([still, across, up, turning]);
        let rests = [piece.ground, piece.after(piece.left)]
            .iter()
            .all(|[a, b, c]| (0..4).all(|i| still[i] + a * across[i] + b * up[i] + c * turning[i] > clear));
        if rests {
            self.rest_on(piece, time);
        }
        rests
    }

    /// The same where what friction bears bends with the normal force: downward, so that it is least at an end.
    fn bends_through(&mut self, piece: &Piece, time: f64, clear: f64) -> bool {
        let ends = [piece.ground, piece.after(piece.left)];
        let rests = ends.iter().all(|ground| {
            let limits = self.limits(&self.state, ground);
            limits.iter().all(|(value, _)| *value > clear)
        });
        if rests {
            self.rest_on(piece, time);
        }
        rests
    }

    fn rest_on(&mut self, piece: &Piece, time: f64) {
        let state = self.state;
        let trial = Trial::still(state, [0.0; 8], piece.left, piece);
        self.move_on(&trial, &state, piece.left, time);
    }

    /// The limits of [`Varying::limits`] in a still ground, and what each unit of the ground's acceleration adds to them.
    fn reserve_at_rest(&self) -> [[f64; 4]; 4] {
        let of = |ground: Ground| self.limits(&self.state, &ground).map(|(value, _)| value);
        let still = of([0.0; 3]);
        let per = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|unit| {
            let with = of(unit);
            [0, 1, 2, 3].map(|i| with[i] - still[i])
        });
        [still, per[0], per[1], per[2]]
    }
}
