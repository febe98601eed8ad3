//! How the state changes, `q'' = M^-1 (Q + G^T (T, N_h, N_t))` with what the mode holds held, and what limits the mode.

use super::super::block::{Vector, HEEL, SLIP};
use super::super::mode::Mode;
use super::super::walk::Cause;
use super::instant::Instant;
use super::shaking::{Ground, Piece};
use super::step::{step, State};
use super::walk::Varying;
use crate::friction::Strength;

impl Varying<'_> {
    /// Reactions in the present mode; where friction makes them infinite, none, and the choice of the next mode says so.
    pub(super) fn reactions(&self, state: &State, instant: &Instant) -> (Vector, Strength) {
        self.rubbed(self.walk.mode, state, instant)
            .unwrap_or_else(|| ([0.0; 3], self.walk.block.strength()))
    }

    /// Whether friction makes the reactions of a slip infinite at a state.
    pub(super) fn jams(&self, state: &State, ground: &Ground) -> bool {
        self.walk.mode.slip().is_some() && self.climb(state, ground).is_none() && {
            let instant = self.seen_from(self.corner, state, ground);
            self.rubbed(self.walk.mode, state, &instant).is_none()
        }
    }

    pub(super) fn rates(&self, state: &State, ground: &Ground) -> State {
        if let Some(climb) = self.climb(state, ground) {
            let speed = state[3];
            let worked = [climb.pushed, climb.reactions[SLIP], climb.slope].map(|force| force * speed);
            let [power, rubbing, rise] = worked;
            return [
                speed,
                0.0,
                0.0,
                climb.acceleration,
                0.0,
                0.0,
                power,
                rubbing,
                rise,
            ];
        }
        let [x, z, spin] = [state[3], state[4], state[5]];
        match self.walk.mode {
            Mode::Rock(corner) if self.rough.is_none() => {
                let [acceleration, moment] = self.turning.swing(corner, state, ground);
                return [0.0, 0.0, spin, 0.0, 0.0, acceleration, moment * spin, 0.0, 0.0];
            }
            Mode::Drift if self.rough.is_none() => {
                let [[a, b, c], load] = self.turning.flight(self.corner, state, ground);
                let power = load[0] * x + load[1] * z + load[2] * spin;
                return [x, z, spin, a, b, c, power, 0.0, 0.0];
            }
            _ => {}
        }
        let slope = self.slope(state);
        let instant = self.on_flank(self.corner, state, ground, slope);
        let (reactions, _) = self.reactions(state, &instant);
        let mut acceleration = instant.acceleration(&reactions);
        let contacts = self.walk.mode.contacts();
        if self.walk.mode.sticks() {
            acceleration[0] = 0.0;
        }
        if contacts[self.corner.gap() - HEEL] {
            acceleration[1] = 0.0;
        }
        if contacts == [true, true] {
            acceleration[2] = 0.0;
        }
        let [a, b, c] = acceleration;
        let rubbing = reactions[SLIP] * x;
        [
            x,
            z,
            spin,
            a,
            b,
            c,
            instant.power(state),
            rubbing,
            slope.slope * x,
        ]
    }

    /// The state after `since` from the present one, `start`, in closed form or by one step.
    pub(super) fn moved(&self, start: &State, rate: &State, piece: &Piece, since: f64) -> State {
        match self.closed_slide(piece, None) {
            Some(slide) => slide.state(start, since),
            None => self
                .by_series(start, piece, since)
                .or_else(|| self.by_cubic(start, piece, since))
                .or_else(|| self.by_flight(start, piece, since))
                .unwrap_or_else(|| self.stepped(start, rate, piece, since).0),
        }
    }

    /// The same with its rate of change and the error of that step, as [`step`] has it.
    pub(super) fn stepped(
        &self,
        start: &State,
        rate: &State,
        piece: &Piece,
        since: f64,
    ) -> (State, State, f64) {
        if since == 0.0 || self.walk.mode == Mode::Rest {
            return (*start, *rate, 0.0);
        }
        let mut rates = |t: f64, y: &State| self.rates(y, &piece.after(t));
        let taken = step(start, rate, since, &self.scale, &mut rates);
        (taken.end, taken.rate, taken.error)
    }

    /// Normal forces and what is left of the friction cone, both ways, at a state; sizes to judge them by.
    pub(super) fn limits(&self, state: &State, ground: &Ground) -> [(f64, f64); 4] {
        if let Some(climb) = self.climb(state, ground) {
            return self.limits_under(&climb.reactions, &climb.strength);
        }
        let instant = self.seen_from(self.corner, state, ground);
        let (reactions, strength) = self.reactions(state, &instant);
        self.limits_under(&reactions, &strength)
    }

    pub(super) fn limits_under(&self, reactions: &Vector, strength: &Strength) -> [(f64, f64); 4] {
        let [friction, heel, toe] = *reactions;
        let scale = self.walk.block.force_scale;
        let ([mu, _], [held, _], [lean, _]) = (strength.coefficient, strength.constant, strength.lean);
        let size = |force: f64| scale.max(force.abs());
        let cone = mu * (size(heel) + size(toe)) + size(friction) + held.abs();
        [
            (heel, size(heel)),
            (toe, size(toe)),
            ((mu - lean) * (heel + toe) - friction + held, cone),
            ((mu + lean) * (heel + toe) + friction + held, cone),
        ]
    }

    /// Which of the limits of [`Self::limits`] end the present mode.
    pub(super) fn watched(&self) -> [Option<Cause>; 4] {
        let [heel, toe] = self.walk.mode.contacts().map(|on| on.then_some(Cause::Normal));
        let cone = self.walk.mode.sticks().then_some(Cause::Cone);
        [heel, toe, cone, cone]
    }
}
