//! Which mode of motion comes next: the first that is admissible.
//!
//! A mode is admissible if every contact it keeps is pushed, every corner that leaves does leave, and
//! `|T| <= mu_s (N_h + N_t)` where it sticks; where it slips the slip must go, or start, its way. Where a quantity is zero
//! its rate of change decides.

use super::block::{Affine, HEEL, SLIP, TOE};
use super::mode::Mode;
use super::reaction::{Reaction, Reactions};
use super::shaking::Piece;

// The next three are relative to the size of the terms that make up a quantity, see [`Reaction`]. They are thus
// changes of the loads and mean the same for every condition: the one that ends a mode and the one that admits its
// successor agree.

/// Below this a value counts as zero and the sign of its slope decides.
const TIE: f64 = 1e-13;
/// A condition counts as violated within a piece only if it falls below this. It is far above [`TIE`], so that where an
/// event is seen the slopes that decide what follows are told from rounding.
pub(super) const VIOLATION: f64 = 1e-10;
/// Last resort where rounding makes every mode look inadmissible by a hair, as under ground accelerations a thousand
/// times the loads, by which sizes are not measured.
const HAIR: f64 = 1e-9;
/// Sign of a quantity at the start of a piece: of its value or, where that is zero to rounding, of its slope.
fn sign(q: Affine, size: f64, piece: &Piece<2>, tie: f64) -> i8 {
    let value = q.at(piece.ground);
    if value.abs() > tie * size {
        return if value > 0.0 { 1 } else { -1 };
    }
    let change = q.slope(piece.rate) * piece.left;
    if change.abs() > tie * size {
        return if change > 0.0 { 1 } else { -1 };
    }
    0
}

/// Whether the block can move on in `mode` from the contact state at hand.
///
/// `closed` are the corners whose gap and gap velocity are zero; `velocity` is the slip velocity.
fn admissible(
    reaction: &Reaction,
    mode: Mode,
    closed: [bool; 2],
    velocity: f64,
    piece: &Piece<2>,
    tie: f64,
) -> bool {
    let contacts = mode.contacts();
    if (contacts[0] && !closed[0]) || (contacts[1] && !closed[1]) || !reaction.regular {
        return false;
    }
    let (force, acceleration) = (&reaction.force, &reaction.acceleration);
    let (force_size, acceleration_size) = (&reaction.force_size, &reaction.acceleration_size);
    for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
        if contacts[corner] {
            if sign(force[gap], force_size[gap], piece, tie) < 0 {
                return false;
            }
        } else if closed[corner] && sign(acceleration[gap], acceleration_size[gap], piece, tie) < 0 {
            return false;
        }
    }
    match mode {
        Mode::Drift => true,
        Mode::Rest | Mode::Rock(_) => {
            velocity == 0.0
                && reaction
                    .cone
                    .into_iter()
                    .all(|left| sign(left, reaction.cone_size, piece, tie) >= 0)
        }
        Mode::Slide(slip) | Mode::SlideRock(_, slip) => {
            let s = slip.sign();
            if velocity != 0.0 {
                return velocity * s > 0.0;
            }
            // A slip that starts must grow; at the friction limit its acceleration is zero and its slope decides.
            let growth = sign(acceleration[SLIP], acceleration_size[SLIP], piece, tie);
            f64::from(growth) * s > 0.0 || (tie >= HAIR && growth == 0)
        }
    }
}

/// The mode in which the block goes on: the present one if it is still admissible and nothing has come to stand or to lie,
/// else the first of [`Mode::ALL`] that is, or drift; `None` is a Painlevé paradox.
pub(super) fn select(
    reactions: &Reactions,
    present: Mode,
    closed: [bool; 2],
    velocity: f64,
    piece: &Piece<2>,
) -> Option<Mode> {
    for tie in [TIE, HAIR] {
        // A base that has come to stand is held by static friction if that can hold it: sticking goes first. So does
        // contact where a corner has come to lie: loads that just balance there leave it lying, while a motion that went
        // on would lift it by rounding, and close it at once.
        let stopped = velocity == 0.0 && present.slip().is_some();
        let landed = (0..2).any(|corner| closed[corner] && !present.contacts()[corner]);
        let goes_on = !stopped && !landed;
        let mut candidates = goes_on
            .then_some(present)
            .into_iter()
            .chain(Mode::ALL)
            .chain(std::iter::once(Mode::Drift));
        let found =
            candidates.find(|&mode| admissible(reactions.of(mode), mode, closed, velocity, piece, tie));
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Acceleration and its slope of each contact coordinate on a piece. `starts` has the way, 1 or -1, in which a
/// coordinate starts to move in this very moment, and 0 for the others. What starts has its rounding removed, and that
/// against its way up to the hair by which [`select`] may have let it: it must not end the moment it begins.
pub(super) fn accelerations(reaction: &Reaction, starts: [f64; 3], piece: &Piece<2>) -> [[f64; 2]; 3] {
    let mut result = [[0.0; 2]; 3];
    for i in 0..3 {
        let size = reaction.acceleration_size[i];
        let nothing = |value: f64, way: f64| {
            value.abs() <= TIE * size || (value * way < 0.0 && value.abs() <= HAIR * size)
        };
        let mut value = reaction.acceleration[i].at(piece.ground);
        let mut slope = reaction.acceleration[i].slope(piece.rate);
        if starts[i] != 0.0 && nothing(value, starts[i]) {
            value = 0.0;
            if nothing(slope * piece.left, starts[i]) {
                slope = 0.0;
            }
        }
        result[i] = [value, slope];
    }
    result
}
