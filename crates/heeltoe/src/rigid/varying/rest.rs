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
        let [still, across, up, turning] = self.reserve.unwrap_or_else(|| self.reserve_at_rest());
        self.reserve = Some([still, across, up, turning]);
        let clear = CLEAR * self.walk.block.force_scale;
        let rests = [piece.ground, piece.after(piece.left)]
            .iter()
            .all(|[a, b, c]| (0..4).all(|i| still[i] + a * across[i] + b * up[i] + c * turning[i] > clear));
        if rests {
            let state = self.state;
            let trial = Trial::still(state, [0.0; 8], piece.left, piece);
            self.move_on(&trial, &state, piece.left, time);
        }
        rests
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
