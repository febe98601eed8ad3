//! A slide of which friction acts along the stream alone: a neighbour holds the block across it, or nothing pushes it
//! there.

use super::super::event;
use super::flight::Flight;
use super::polynomial::TERMS;
use super::series::Forces;

/// How a block goes on with the velocity `u` along the stream in the direction `way`, for `left` seconds at most, and
/// whether it stops then.
pub(super) fn go_on(forces: &Forces, u: f64, way: f64, left: f64) -> (Flight, bool) {
    let [f0, f1] = forces.push[0];
    let [rub, rub_slope] = forces.rub;
    let mut a0 = (f0 - way * rub) / forces.mass;
    let a1 = (f1 - way * rub_slope) / forces.mass;
    if u == 0.0 && way * a0 < 0.0 {
        // It starts: rounding must not end that at once.
        a0 = 0.0;
    }
    let stop = event::quadratic(way * u, way * a0, way * a1 / 2.0, left);
    let mut terms = [[0.0; 3]; TERMS];
    for (terms, term) in terms.iter_mut().zip([u, a0, a1 / 2.0]) {
        *terms = [term, 0.0, way * term];
    }
    let flight = Flight {
        begin: 0.0,
        length: stop.unwrap_or(left),
        terms,
        friction: None,
    };
    (flight, stop.is_some())
}
