//! Many stacks, side by side.

use super::super::shaking::Shaking;
use super::super::walk::{Options, Wanted};
use super::blocks::Stack;
use super::walk::{simulate, StackRun};
use crate::parallel::each;
use crate::stop::Stop;

/// Fewest runs that are worth a thread of their own.
const CHUNK: usize = 4;

/// Run stacks that stand still, each through its motion.
pub fn run(cases: &[(Stack, Shaking)], options: Options, stop: Stop) -> Vec<StackRun> {
    each(cases.len(), CHUNK, |k| {
        let (stack, shaking) = &cases[k];
        let wanted = Wanted {
            stop,
            ..Wanted::default()
        };
        simulate(stack, shaking, options, wanted)
    })
}
