//! A slide on a flank, of a block whose loads, geometry and coefficient of friction stay as they are: what a flank that
//! wears asks for a dozen times a step.
//!
//! With the slope k of the moment, `A` and `b` of the level crack, and w what friction adds to the acceleration off a flank
//! that wears (see [`super::instant`]), in coordinates counted from the flank
//!
//! `A*_sg = A_sg - k A_ss`, `A*_gs = A*_sg + w`, `A*_gh = A_gh - k (A_sg + A_sh) + k^2 A_ss`, `b*_g = b_g - k b_s`.

use super::super::block::{Vector, HEEL, SLIP, TOE};
use super::super::mode::Mode;
use super::super::reaction::reaction_to;
use super::instant::Slope;
use super::shaking::Ground;
use super::step::State;
use super::walk::Varying;
use crate::asperity::on_slopes;
use crate::friction::Strength;

/// What a block feels that slides on a flank.
pub(super) struct Climb {
    pub slope: f64,
    pub reactions: Vector,
    pub strength: Strength,
    /// Acceleration of the slip.
    pub acceleration: f64,
    /// What the loads push along the flank.
    pub pushed: f64,
}

impl Varying<'_> {
    /// What is felt at a state of such a slide; none of any other, or where friction makes the reactions infinite.
    pub(super) fn climb(&self, state: &State, ground: &Ground) -> Option<Climb> {
        let (rough, rubbing) = (self.rough.as_ref()?, &self.rubbing);
        let Mode::Slide(slip) = self.walk.mode else {
            return None;
        };
        if !self.plain || state[3] == 0.0 || !rubbing.settled() || !self.gives_way(rough) {
            return None;
        }
        let Slope { slope: k, wear } = self.slope(state);
        let flat = rubbing
            .law
            .strength(rubbing.width, 0.0, state[3].abs(), rubbing.worn);
        let strength = on_slopes(&flat, [k; 2], k);
        let (a, b, load) = self.still(self.corner).felt(ground);
        let own = a[SLIP][SLIP];
        let [heel, toe] = [HEEL, TOE].map(|gap| a[SLIP][gap]);
        let across = |i: usize, j: usize, along: f64| a[i][j] - k * along + k * k * own;
        let compliance = [
            [own, heel - k * own, toe - k * own],
            [
                heel - k * own + wear,
                across(HEEL, HEEL, 2.0 * heel),
                across(HEEL, TOE, heel + toe),
            ],
            [
                toe - k * own + wear,
                across(TOE, HEEL, heel + toe),
                across(TOE, TOE, 2.0 * toe),
            ],
        ];
        let free = [b[SLIP], b[HEEL] - k * b[SLIP], b[TOE] - k * b[SLIP]];
        // A stage of a step may lie behind the end of the slip, whose way is that of the mode.
        let way = slip.sign();
        let coefficient = strength.coefficient[1] + way * strength.lean[1];
        let reactions = reaction_to(&compliance, coefficient, self.walk.mode, &free)?;
        let pushed: f64 = (0..3).map(|i| compliance[SLIP][i] * reactions[i]).sum();
        Some(Climb {
            slope: k,
            reactions,
            strength,
            acceleration: free[SLIP] + pushed,
            pushed: load[0] + k * load[1],
        })
    }
}
