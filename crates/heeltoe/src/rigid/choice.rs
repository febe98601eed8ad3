//! Which mode of motion comes next: the first that is admissible.
//!
//! A mode is admissible if every contact it keeps is pushed, every corner that leaves does leave, and
//! `|T| <= mu_s (N_h + N_t)` where it sticks; where it slips the slip must go, or start, its way. Where a quantity is zero
//! its rate of change decides.

use super::block::{HEEL, SLIP, TOE};
use super::mode::Mode;
use super::reaction::{Felt, Reaction, Reactions, ReactionsOf, ACCELERATION, CONE};
use super::shaking::Piece;

// The next three are relative to the size of the terms that make up a quantity, see [`Reaction`]. They are thus
// changes of the loads and mean the same for every condition: the one that ends a mode and the one that admits its
// successor agree.

/// Below this a value counts as zero and the sign of its slope decides.
pub(super) const TIE: f64 = 1e-13;
/// A condition counts as violated within a piece only if it falls below this. It is far above [`TIE`], so that where an
/// event is seen the slopes that decide what follows are told from rounding.
pub(super) const VIOLATION: f64 = 1e-10;
/// Last resort where rounding makes every mode look inadmissible by a hair, as under ground accelerations a thousand
/// times the loads, by which sizes are not measured.
pub(super) const HAIR: f64 = 1e-9;

/// A block that has to go on: the corners whose gap and gap velocity are zero, the slip velocity, the ground from here.
pub(super) struct Moving<'a> {
    pub closed: [bool; 2],
    pub velocity: f64,
    pub piece: &'a Piece<2>,
}

/// The reactions of all modes.
pub(super) trait Modes {
    fn of(&self, mode: Mode) -> &Reaction;
}

impl Modes for Reactions {
    #[inline(always)]
    fn of(&self, mode: Mode) -> &Reaction {
        Reactions::of(self, mode)
    }
}

impl Modes for ReactionsOf<'_> {
    #[inline(always)]
    fn of(&self, mode: Mode) -> &Reaction {
        ReactionsOf::of(self, mode)
    }
}

/// Sign of a quantity at the start of a piece: of its value or, where that is no more than rounding, of its change.
#[inline(always)]
pub(super) fn sign(value: f64, change: f64, rounding: f64) -> i8 {
    [value, change]
        .into_iter()
        .find(|part| part.abs() > rounding)
        .map_or(0, |part| if part > 0.0 { 1 } else { -1 })
}

/// Whether the block can move on in `mode`, and if so what it feels there.
#[inline(always)]
pub(super) fn admissible(reaction: &Reaction, moving: &Moving, tie: f64, felt: &mut Felt) -> bool {
    let Moving {
        closed,
        velocity,
        piece,
    } = *moving;
    let contacts = reaction.contacts;
    if (contacts[0] && !closed[0]) || (contacts[1] && !closed[1]) || !reaction.regular {
        return false;
    }
    reaction.on(piece, felt);
    let sign = |i: usize| sign(felt.value[i], felt.slope[i] * piece.left, tie * reaction.size[i]);
    for (corner, gap) in [HEEL, TOE].into_iter().enumerate() {
        if contacts[corner] {
            if sign(gap) < 0 {
                return false;
            }
        } else if closed[corner] && sign(ACCELERATION + gap) < 0 {
            return false;
        }
    }
    if reaction.way != 0.0 {
        if velocity != 0.0 {
            return velocity * reaction.way > 0.0;
        }
        // A slip that starts must grow; at the friction limit its acceleration is zero and its slope decides.
        let growth = sign(ACCELERATION + SLIP);
        return f64::from(growth) * reaction.way > 0.0 || (tie >= HAIR && growth == 0);
    }
    let drifts = contacts == [false, false];
    drifts || velocity == 0.0 && sign(CONE) >= 0 && sign(CONE + 1) >= 0
}

/// The mode in which the block goes on: the present one if it is still admissible and nothing has come to stand or to lie,
/// else the first of [`Mode::ALL`] that is, or drift; `None` is a Painlevé paradox. What is felt there is in `felt` then.
#[inline(always)]
pub(super) fn select(
    reactions: &impl Modes,
    present: Mode,
    moving: &Moving,
    felt: &mut Felt,
) -> Option<Mode> {
    // A base that has come to stand is held by static friction if that can hold it: sticking goes first. So does
    // contact where a corner has come to lie: loads that just balance there leave it lying, while a motion that went
    // on would lift it by rounding, and close it at once.
    let reaction = reactions.of(present);
    let stopped = moving.velocity == 0.0 && reaction.way != 0.0;
    let landed = (0..2).any(|corner| moving.closed[corner] && !reaction.contacts[corner]);
    let goes_on = !stopped && !landed;
    if goes_on && admissible(reaction, moving, TIE, felt) {
        return Some(present);
    }
    another(reactions, goes_on.then_some(present), moving, felt)
}

/// As [`select`], where the present mode, if the block may go on in it, is admissible by a hair at most.
#[inline(never)]
fn another(reactions: &impl Modes, present: Option<Mode>, moving: &Moving, felt: &mut Felt) -> Option<Mode> {
    for (tie, first) in [(TIE, None), (HAIR, present)] {
        for mode in first.into_iter().chain(Mode::ALL).chain([Mode::Drift]) {
            let [heel, toe] = mode.contacts();
            let leaves = heel && !moving.closed[0] || toe && !moving.closed[1];
            if !leaves && admissible(reactions.of(mode), moving, tie, felt) {
                return Some(mode);
            }
        }
    }
    None
}

/// Acceleration and its slope of each contact coordinate on a piece; `starts` is the way in which each starts to move, as
/// [`begun`] takes it.
#[inline(always)]
pub(super) fn accelerations(reaction: &Reaction, felt: &Felt, starts: [f64; 3], left: f64) -> [[f64; 2]; 3] {
    let mut result = [[0.0; 2]; 3];
    for i in [SLIP, HEEL, TOE] {
        let of = ACCELERATION + i;
        result[i] = begun(felt.value[of], felt.slope[of], reaction.size[of], starts[i], left);
    }
    result
}

/// Acceleration and its slope of a contact coordinate on a piece. `way` is 1 or -1 where it starts to move that way in this
/// very moment, else 0. A start has its rounding removed, and that against its way up to the hair by which [`select`]
/// may have let it: it must not end the moment it begins.
#[inline(always)]
pub(super) fn begun(mut value: f64, mut slope: f64, size: f64, way: f64, left: f64) -> [f64; 2] {
    let nothing = |value: f64| value.abs() <= TIE * size || (value * way < 0.0 && value.abs() <= HAIR * size);
    if way != 0.0 && nothing(value) {
        value = 0.0;
        if nothing(slope * left) {
            slope = 0.0;
        }
    }
    [value, slope]
}
