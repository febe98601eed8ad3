//! The crest of a rigid dam, which slip and gaps w of the block move by `x = c.w`, seen at some moments.
//!
//! Its acceleration is `a + (v_k - v_k-1) / ((t_k+1 - t_k-1) / 2)`, the ground's and the change of the mean velocity of
//! two neighbouring intervals `v_k = (x_k+1 - x_k) / (t_k+1 - t_k)`: exact in the mean, whatever strikes in between.

use super::block::Vector;
use super::result::Moment;
use super::shaking::Shaking;

/// A crest that is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Crest<'a> {
    /// Moments, ascending (s).
    pub times: &'a [f64],
    /// How far slip, heel gap and toe gap move it.
    pub moves: Vector,
}

impl Crest<'_> {
    /// Largest displacement from its first place (m) and largest acceleration with the ground's (m/s2), without signs.
    pub(super) fn peaks(&self, moments: &[Moment], shaking: &Shaking) -> [f64; 2] {
        let place = |k: usize| {
            let [a, b, c] = self.moves;
            let [x, y, z] = moments[k].position;
            a * x + b * y + c * z
        };
        let ground = shaking.horizontal_at(&self.times[..moments.len()]);
        let last = moments.len().saturating_sub(1);
        let [mut farthest, mut hardest, mut before] = [0.0_f64; 3];
        for (k, ground) in ground.enumerate() {
            let mut own = 0.0;
            if k < last {
                let velocity = (place(k + 1) - place(k)) / (self.times[k + 1] - self.times[k]);
                if k > 0 {
                    own = (velocity - before) / (0.5 * (self.times[k + 1] - self.times[k - 1]));
                }
                before = velocity;
            }
            farthest = farthest.max((place(k) - place(0)).abs());
            hardest = hardest.max((own + ground).abs());
        }
        [farthest, hardest]
    }
}
