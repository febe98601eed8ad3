//! Which modes of motion come next in both cracks.
//!
//! A pair of modes is admissible where each is by [`super::super::choice`], with the reactions that go with the pair. More
//! than one pair may be: a crack in which nothing has happened keeps its mode if it can, and then stick comes before slip
//! and contact before lift-off, in the lower crack first.

use super::super::block::SLIP;
use super::super::choice::{admissible, Moving, HAIR, TIE};
use super::super::mode::Mode;
use super::super::reaction::Felt;
use super::super::shaking::Piece;
use super::reaction::{Modes, Reactions};
use super::solve::Six;

/// Blocks that have to go on: corners whose gap and gap velocity are zero, velocities, the ground from here.
pub(super) struct Going<'a> {
    pub closed: [[bool; 2]; 2],
    pub velocity: &'a Six,
    pub piece: &'a Piece<2>,
}

/// The pair in which the blocks go on, and what is felt in it; `None` is a Painlevé paradox.
pub(super) fn select(
    reactions: &mut Reactions,
    present: Modes,
    going: &Going,
    felt: &mut [Felt; 2],
) -> Option<Modes> {
    let goes_on = [0, 1].map(|crack| {
        let mode = present[crack];
        let stopped = going.velocity[3 * crack + SLIP] == 0.0 && mode.slip().is_some();
        let landed = (0..2).any(|corner| going.closed[crack][corner] && !mode.contacts()[corner]);
        !stopped && !landed
    });
    let fits = |reactions: &mut Reactions, modes: Modes, tie: f64, felt: &mut [Felt; 2]| {
        let pair = reactions.of(modes);
        (0..2).all(|crack| {
            let moving = Moving {
                closed: going.closed[crack],
                velocity: going.velocity[3 * crack + SLIP],
                piece: going.piece,
            };
            admissible(&pair[crack], &moving, tie, &mut felt[crack])
        })
    };
    if goes_on == [true, true] && fits(reactions, present, TIE, felt) {
        return Some(present);
    }
    let all = || Mode::ALL.into_iter().chain([Mode::Drift]);
    for tie in [TIE, HAIR] {
        if tie == HAIR && goes_on == [true, true] && fits(reactions, present, tie, felt) {
            return Some(present);
        }
        for kept in [1, 0] {
            if !goes_on[kept] {
                continue;
            }
            for mode in all() {
                let mut modes = present;
                modes[1 - kept] = mode;
                if fits(reactions, modes, tie, felt) {
                    return Some(modes);
                }
            }
        }
        for lower in all() {
            for upper in all() {
                if fits(reactions, [lower, upper], tie, felt) {
                    return Some([lower, upper]);
                }
            }
        }
    }
    None
}
