//! A rough crack: both faces a sawtooth of one angle, mated before the earthquake, that wears.
//!
//! With the asperities' height a and wave length L the flanks rise by `tan i = 2 a / L` from a valley, where the faces
//! mate, to a peak half a wave length on. On a flank of slope k = +/- tan i friction of coefficient mu acts along the flank;
//! per normal force across the crack's mean plane (Patton 1966)
//!
//! `T/N = -tan(phi + i)` where the block slips up it, downstream, and `tan(phi - i)` where it slips down it.
//!
//! Seen in the coordinates `(slip, gaps above the flank)` the contact force does no work but by friction, and these become
//! the coefficients `mu (1 + k^2)/(1 -/+ mu k)`. The angle wears with the work W of friction per area (Plesha 1987):
//! `i = i_0 exp(-c W)`.

use crate::friction::Strength;
use crate::table::numbers;

numbers! {
    /// The numbers of a rough crack, SI.
    AsperityNumbers {
        /// Height of the asperities (m).
        height,
        /// From peak to peak (m).
        wave_length,
        /// Loss of the angle's logarithm per plastic work (m2/J).
        wear,
    }
}

/// The asperities of a crack before anything has worn them.
#[derive(Clone, Copy, Debug)]
pub struct Asperities {
    half_wave: f64,
    angle: f64,
    wear: f64,
}

impl Asperities {
    /// Asperities of these numbers.
    pub fn new(numbers: &AsperityNumbers) -> Self {
        Asperities {
            half_wave: 0.5 * numbers.wave_length,
            angle: (2.0 * numbers.height / numbers.wave_length).atan(),
            wear: numbers.wear,
        }
    }

    /// Their angle after this much plastic work per area (J/m2).
    pub fn worn(&self, work: f64) -> f64 {
        self.angle * self.kept(work)
    }

    /// What of an angle is left after this much more work.
    pub(crate) fn kept(&self, work: f64) -> f64 {
        if self.wear == 0.0 {
            return 1.0;
        }
        (-self.wear * work).exp()
    }

    /// Loss of the angle's logarithm per plastic work.
    pub(crate) fn wear(&self) -> f64 {
        self.wear
    }

    /// The flank at a slip.
    pub(crate) fn flank(&self, slip: f64) -> i64 {
        let flank = (slip / self.half_wave).floor() as i64;
        // What rounding has put on the other side of a turn.
        if slip >= self.turn(flank + 1) {
            flank + 1
        } else if slip < self.turn(flank) {
            flank - 1
        } else {
            flank
        }
    }

    /// The valley or peak at the upstream end of a flank; they are counted from the valley in which the block stands.
    pub(crate) fn turn(&self, flank: i64) -> f64 {
        flank as f64 * self.half_wave
    }
}

/// Sign of the slope of a flank.
pub(crate) fn rise(flank: i64) -> f64 {
    if flank.rem_euclid(2) == 0 {
        1.0
    } else {
        -1.0
    }
}

/// What friction bears on a profile whose slopes are `before` and `behind` the block, upstream and downstream of it, in the
/// coordinates of a flank of slope `own`.
pub(crate) fn on_slopes(strength: &Strength, [before, behind]: [f64; 2], own: f64) -> Strength {
    let mut leaning = *strength;
    for (k, mu) in strength.coefficient.into_iter().enumerate() {
        let down = mu * (1.0 + behind * behind) / (1.0 - mu * behind) + (behind - own);
        let up = mu * (1.0 + before * before) / (1.0 + mu * before) + (own - before);
        leaning.coefficient[k] = 0.5 * (down + up);
        leaning.lean[k] = 0.5 * (down - up);
    }
    leaning
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: Strength = Strength {
        coefficient: [0.9, 0.7],
        constant: [0.0; 2],
        lean: [0.0; 2],
    };

    #[test]
    fn friction_on_a_flank_is_pattons() {
        let slope = 0.3_f64;
        let leaning = on_slopes(&FLAT, [slope; 2], slope);
        for (k, mu) in FLAT.coefficient.into_iter().enumerate() {
            let (phi, i) = (mu.atan(), slope.atan());
            let [down, up] = [1.0, -1.0].map(|way| leaning.coefficient[k] + way * leaning.lean[k]);
            assert!((down - ((phi + i).tan() - slope)).abs() < 1e-14);
            assert!((up - ((phi - i).tan() + slope)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_level_flank_changes_nothing() {
        assert_eq!(on_slopes(&FLAT, [0.0; 2], 0.0), FLAT);
    }

    #[test]
    fn a_valley_holds_both_ways() {
        let k = 0.4_f64;
        let held = on_slopes(&FLAT, [-k, k], k);
        let both = (FLAT.coefficient[0].atan() + k.atan()).tan();
        let [down, up] = [1.0, -1.0].map(|way| held.coefficient[0] + way * held.lean[0]);
        // In the flank's coordinates T is seen with k N added.
        assert!((down + k - both).abs() < 1e-14 && (up - k - both).abs() < 1e-14);
    }

    #[test]
    fn flanks_rise_and_fall_in_turn() {
        assert_eq!([-2, -1, 0, 1].map(rise), [1.0, -1.0, 1.0, -1.0]);
    }
}
