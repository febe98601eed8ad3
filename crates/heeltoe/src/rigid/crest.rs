//! The crest of a rigid dam, which slip and gaps w of the block move by `x = c.w`, seen at some moments.
//!
//! Its acceleration is `a + (v_k - v_k-1) / ((t_k+1 - t_k-1) / 2)`, the ground's and the change of the mean velocity of
//! two neighbouring intervals `v_k = (x_k+1 - x_k) / (t_k+1 - t_k)`: exact in the mean, whatever strikes in between. It is
//! judged within a band: `sum_j w_j a_k+j` with the weights of a symmetric filter, the ends going on as they are.

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
    /// Weights of the filter for the distances 0, 1, 2, ... between moments, the same either way.
    pub weights: &'a [f64],
}

impl Crest<'_> {
    /// Largest displacement from its first place (m) and largest acceleration with the ground's in the band (m/s2), without
    /// signs.
    pub(super) fn peaks(&self, moments: &[Moment], shaking: &Shaking) -> [f64; 2] {
        let place = |k: usize| {
            let [a, b, c] = self.moves;
            let [x, y, z] = moments[k].position;
            a * x + b * y + c * z
        };
        let ground = shaking.horizontal_at(&self.times[..moments.len()]);
        let last = moments.len().saturating_sub(1);
        let [mut farthest, mut before] = [0.0_f64; 2];
        let mut acceleration = Vec::with_capacity(moments.len());
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
            acceleration.push(own + ground);
        }
        let hardest =
            (0..acceleration.len()).fold(0.0_f64, |most, k| most.max(self.in_band(&acceleration, k).abs()));
        [farthest, hardest]
    }

    /// What passes the filter at a moment.
    fn in_band(&self, acceleration: &[f64], k: usize) -> f64 {
        let last = acceleration.len() - 1;
        let pair = |(j, weight): (usize, &f64)| {
            let [before, after] = [acceleration[k.saturating_sub(j)], acceleration[(k + j).min(last)]];
            weight * if j == 0 { after } else { before + after }
        };
        self.weights.iter().enumerate().map(pair).sum()
    }
}
