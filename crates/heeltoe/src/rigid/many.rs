//! Many runs of the exact walk, side by side.

use super::block::{Block, BlockNumbers};
use super::exact::simulate;
use super::result::Summary;
use super::shaking::Shaking;
use super::walk::{Options, Wanted};
use crate::parallel::each;
use crate::stop::Stop;

/// Fewest runs that are worth a thread of their own.
const CHUNK: usize = 16;

/// Run `count` blocks that stand still; `case` says which block meets which motion.
pub fn run<'a>(
    count: usize,
    options: Options,
    stop: Stop,
    case: impl Fn(usize) -> (BlockNumbers, Shaking<'a>) + Sync + Send,
) -> Vec<Summary> {
    each(count, CHUNK, |k| {
        let (numbers, shaking) = case(k);
        let wanted = Wanted {
            stop,
            ..Wanted::default()
        };
        simulate(&Block::new(&numbers), &shaking, None, options, wanted).summary
    })
}
