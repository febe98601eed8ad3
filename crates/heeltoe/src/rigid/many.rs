//! Many runs of the exact walk, side by side.

use super::block::{Block, BlockNumbers};
use super::crest::Crest;
use super::exact::simulate;
use super::result::Summary;
use super::shaking::Shaking;
use super::walk::{Options, Wanted};
use crate::parallel::each;
use crate::stop::Stop;

/// Fewest runs that are worth a thread of their own.
const CHUNK: usize = 16;

/// Run `count` blocks that stand still; `case` says which block meets which motion, and which crest is looked at, if any:
/// what `Crest::peaks` says of it is returned, too.
pub fn run<'a>(
    count: usize,
    options: Options,
    stop: Stop,
    case: impl Fn(usize) -> (BlockNumbers, Shaking<'a>, Option<Crest<'a>>) + Sync + Send,
) -> Vec<(Summary, [f64; 2])> {
    each(count, CHUNK, |k| {
        let (numbers, shaking, crest) = case(k);
        let wanted = Wanted {
            times: crest.map_or(&[], |crest| crest.times),
            stop,
            ..Wanted::default()
        };
        let run = simulate(&Block::new(&numbers), &shaking, None, options, wanted);
        let peaks = crest.map_or([0.0; 2], |crest| crest.peaks(&run.moments, &shaking));
        (run.summary, peaks)
    })
}
