//! A block that flies, or rocks about a corner without slip, goes by the series of [`super::unfolding`]; events are roots of
//! them.

use super::super::block::{Vector, HEEL, TOE};
use super::super::choice::VIOLATION;
use super::super::event;
use super::super::mode::Mode;
use super::super::walk::Cause;
use super::advance::{Trial, SHORT};
use super::block::Rotation;
use super::shaking::Piece;
use super::step::{State, SIZE};
use super::unfolding::{Flight, Unfolding};
use super::walk::Varying;

/// A series is as long as so many times the time up to its end by the accelerations of its start.
const MARGIN: f64 = 1.25;

impl Varying<'_> {
    /// The flight or rocking from the present state on, where it has a series: no longer than to where it should end by the
    /// accelerations of its start, where these are known.
    pub(super) fn flight(&self, piece: &Piece, fresh: Option<Vector>) -> Option<Flight> {
        let rocks = match self.walk.mode {
            Mode::Drift => false,
            Mode::Rock(_) if !self.rubbing.bends() => true,
            _ => return None,
        };
        let block = self.turning;
        let known = self.rough.is_none() && block.anchors.is_empty();
        if !known || piece.left <= 0.0 {
            return None;
        }
        let expected = fresh.and_then(|fresh| self.landing(&fresh, piece.left));
        let left = expected.map_or(piece.left, |t| piece.left.min(MARGIN * t));
        Unfolding::new(block, self.corner, &self.state, &Piece { left, ..*piece }, rocks).grown()
    }

    /// When the first corner lands that is open, at the accelerations of the start.
    fn landing(&self, fresh: &Vector, left: f64) -> Option<f64> {
        let gaps = self.turning.gaps(self.corner, &self.state);
        let velocity = self.turning.contact_velocity(self.corner, &self.state);
        let contacts = self.walk.mode.contacts();
        let open = [HEEL, TOE].into_iter().filter(|gap| !contacts[gap - HEEL]);
        let lands = open.filter_map(|gap| {
            event::quadratic(gaps[gap - HEEL].max(0.0), velocity[gap], 0.5 * fresh[gap], left)
        });
        lands.filter(|t| *t > 0.0).reduce(f64::min)
    }

    /// The state by the series, if there is one that reaches so far.
    pub(super) fn by_flight(&self, start: &State, piece: &Piece, since: f64) -> Option<State> {
        let flight = self.flight(piece, None)?;
        (since <= flight.length).then(|| flight.state_after(start, since))
    }

    /// Fly or rock on to the next event, or as long as the series holds; returns the time that took and what ended it. None
    /// where only shorter steps say what happens.
    pub(super) fn fly_on(
        &mut self,
        flight: &Flight,
        fresh: Option<Vector>,
        piece: &Piece,
        time: f64,
    ) -> Option<(f64, Option<Cause>)> {
        let (part, cause) = self.end_of(flight, fresh);
        let taken = if part == 1.0 {
            flight.length
        } else {
            part * flight.length
        };
        let end = flight.state(&self.state, part);
        let lies = self.turning.rotation != Rotation::Small && end[2].abs() >= std::f64::consts::FRAC_PI_2;
        // Steps of the integrator pass over what cuts the series ever shorter.
        let creeps = cause.is_none() && taken < piece.left && taken < SHORT * self.time_scale;
        if part == 0.0 && fresh.is_some() || creeps || lies {
            return None;
        }
        let trial = Trial {
            error: flight.error / self.scale[0],
            integrated: true,
            flight: Some(flight),
            ..Trial::still(self.state, [0.0; SIZE], flight.length, piece)
        };
        self.move_on(&trial, &end, taken, time);
        Some((taken, cause))
    }

    /// When the flight ends, as a part of its length, and what ends it.
    fn end_of(&self, flight: &Flight, fresh: Option<Vector>) -> (f64, Option<Cause>) {
        let mut first = (1.0, None);
        let mut note = |t: Option<f64>, why: Option<Cause>| {
            if let Some(t) = t.filter(|t| *t < first.0 || *t == first.0 && first.1.is_none()) {
                first = (t, why);
            }
        };
        let own = self.corner.gap();
        let contacts = self.walk.mode.contacts();
        for gap in [HEEL, TOE] {
            if contacts[gap - HEEL] {
                continue;
            }
            let ahead = if gap == own {
                0.0
            } else {
                self.turning.ahead(self.corner)
            };
            let mut open = flight.gap(ahead);
            if let Some(fresh) = fresh.filter(|_| open.terms[0] == 0.0 && open.terms[1] == 0.0) {
                open.terms[2] = 0.5 * flight.length * flight.length * fresh[gap];
            }
            note(open.first_fall(), Some(Cause::Gap(gap)));
        }
        if let Some([friction, normal]) = &flight.borne {
            let strength = self.strength(self.walk.mode, 0.0, &self.state);
            let mut reactions = [friction.terms[0], 0.0, 0.0];
            reactions[own] = normal.terms[0];
            let sizes = self.limits_under(&reactions, &strength).map(|(_, size)| size);
            let ([mu, _], [held, _], [lean, _]) = (strength.coefficient, strength.constant, strength.lean);
            note(
                normal.first_fall_below(VIOLATION * sizes[own - HEEL]),
                Some(Cause::Normal),
            );
            let most = friction.terms[0].abs() + friction.swing();
            for (k, way) in [1.0, -1.0].into_iter().enumerate() {
                let bears = mu - way * lean;
                if bears >= 0.0 && bears * normal.floor() + held > most {
                    continue;
                }
                let mut left = friction.scaled(-way).plus(normal, bears);
                left.terms[0] += held;
                note(left.first_fall_below(VIOLATION * sizes[2 + k]), Some(Cause::Cone));
            }
        }
        for bend in &flight.bends {
            note(bend.first_fall(), None);
        }
        first
    }
}
