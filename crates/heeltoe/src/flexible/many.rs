//! Many runs of one dam side by side, each in the same ground with other factors on it.

use super::dam::{Dam, Shaking, Wanted};
use super::scheme::Scheme;
use super::simulate::simulate;
use super::summary::Summary;
use crate::parallel::each;
use crate::stop::Stop;

/// Shake the dam once for each pair of factors on the horizontal and the vertical acceleration; what each crack does.
pub fn run(
    dam: &Dam,
    shaking: &Shaking,
    scheme: &Scheme,
    scales: &[[f64; 2]],
    stop: Stop,
) -> Vec<Vec<Summary>> {
    each(scales.len(), 1, |k| {
        let shaking = Shaking {
            scale: scales[k],
            ..*shaking
        };
        let wanted = Wanted {
            stop,
            ..Wanted::default()
        };
        simulate(dam, &shaking, scheme, wanted).cracks
    })
}
