//! The reactions of all modes of a block whose friction is known, each worked out where it is asked for.

use std::cell::OnceCell;

use super::super::block::Block;
use super::super::choice::Modes;
use super::super::mode::{Mode, Slip};
use super::super::reaction::Reaction;

/// Blocks with the friction of this moment: on both corners, where there may be a bond, and else.
pub(super) type Blocks = [Block; 2];

/// The reactions of all modes.
pub(super) struct Ready {
    downstream: Blocks,
    /// On the flank upstream of where the block stands, and whether it falls that way; where it stands between two.
    upstream: Option<(Blocks, bool)>,
    known: [OnceCell<Reaction>; Mode::COUNT],
}

impl Ready {
    pub(super) fn new(downstream: Blocks, upstream: Option<(Blocks, bool)>) -> Self {
        Ready {
            downstream,
            upstream,
            known: Default::default(),
        }
    }
}

impl Ready {
    /// The block with the friction of a mode, downstream.
    pub(super) fn block(&self, mode: Mode) -> &Block {
        &self.downstream[usize::from(mode.contacts() != [true, true])]
    }
}

impl Modes for Ready {
    fn of(&self, mode: Mode) -> &Reaction {
        self.known[mode.index()].get_or_init(|| {
            let blocks = match &self.upstream {
                Some((blocks, falls)) if goes_upstream(mode, *falls) => blocks,
                _ => &self.downstream,
            };
            Reaction::new(&blocks[usize::from(mode.contacts() != [true, true])], mode)
        })
    }
}

/// Whether a mode goes to the flank upstream, where a block in the air `falls` that way.
pub(super) fn goes_upstream(mode: Mode, falls: bool) -> bool {
    match mode.slip() {
        Some(slip) => slip == Slip::Upstream,
        None => falls && mode == Mode::Drift,
    }
}
