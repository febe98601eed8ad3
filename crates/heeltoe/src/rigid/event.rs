//! Roots of the linear, quadratic and cubic functions whose sign ends a mode.
//!
//! Every function asked about is positive (or starts to be) at time zero; what is wanted is the first moment in
//! `(0, end]` at which it falls through zero. A double root touches zero without falling through it and is no event.
//! Where a function starts at exactly zero that root is divided out first, so that it is never found again.

/// A value no larger than this part of its terms is rounding.
const END: f64 = 4.0 * f64::EPSILON;

/// First fall through zero of `c0 + c1 t` in `[0, end]`, where its end value is already known to be negative.
pub(super) fn linear(c0: f64, c1: f64, end: f64) -> f64 {
    if c0 <= 0.0 {
        return 0.0;
    }
    (-c0 / c1).clamp(0.0, end)
}

/// Whether `c0 + c1 t + c2 t^2` starts so far above zero that it cannot reach it in `(0, end]`, whatever the rounding.
#[inline(always)]
pub(super) fn stays_positive(c0: f64, c1: f64, c2: f64, end: f64) -> bool {
    c0 > 2.0 * end * (c1.abs() + end * c2.abs())
}

/// First fall through zero of `c0 + c1 t + c2 t^2` in `(0, end]`.
#[inline(always)]
pub(super) fn quadratic(c0: f64, c1: f64, c2: f64, end: f64) -> Option<f64> {
    if stays_positive(c0, c1, c2, end) {
        return None;
    }
    near_quadratic(c0, c1, c2, end)
}

/// Whether the slope of `c0 + c1 t + c2 t^2` turns from falling to rising in `(0, end)`.
#[inline(always)]
fn dips(c1: f64, c2: f64, end: f64) -> bool {
    c2 > 0.0 && c1 < 0.0 && -c1 < 2.0 * c2 * end
}

fn near_quadratic(c0: f64, c1: f64, c2: f64, end: f64) -> Option<f64> {
    if c0 == 0.0 {
        return if c1 == 0.0 {
            (c2 < 0.0).then_some(0.0)
        } else if c1 < 0.0 {
            Some(0.0)
        } else {
            (c1 + c2 * end <= 0.0).then(|| (-c1 / c2).min(end))
        };
    }
    if c0 < 0.0 {
        return Some(0.0);
    }
    let value = |t: f64| c0 + t * (c1 + t * c2);
    // A slip that stops right at the end of a piece stops there whatever the rounding says.
    let size = c0 + end * (c1.abs() + end * c2.abs());
    let falls_at_end = value(end) <= END * size && c1 + 2.0 * end * c2 <= 0.0 || value(end) <= 0.0;
    if !falls_at_end && !dips(c1, c2, end) {
        return None;
    }
    let discriminant = c1 * c1 - 4.0 * c2 * c0;
    if discriminant <= 0.0 && !falls_at_end {
        return None;
    }
    let q = -0.5 * (c1 + discriminant.max(0.0).sqrt().copysign(c1));
    let smallest = [q / c2, c0 / q]
        .into_iter()
        .filter(|t| *t > 0.0)
        .fold(f64::INFINITY, f64::min);
    Some(smallest.min(end))
}

/// Times in `(0, end)` at which `c0 + c1 t + c2 t^2` changes sign, in ascending order.
pub(super) fn sign_changes(c0: f64, c1: f64, c2: f64, end: f64) -> [Option<f64>; 2] {
    // Most pieces are monotone and keep their sign: no need of the roots.
    if c0 * (c0 + end * (c1 + end * c2)) > 0.0 && c1 * (c1 + 2.0 * end * c2) >= 0.0 {
        return [None, None];
    }
    let inside = |t: f64| (t > 0.0 && t < end).then_some(t);
    let discriminant = c1 * c1 - 4.0 * c2 * c0;
    if discriminant <= 0.0 {
        return [None, None];
    }
    let q = -0.5 * (c1 + discriminant.sqrt().copysign(c1));
    let (r1, r2) = (inside(q / c2), inside(c0 / q));
    match (r1, r2) {
        (Some(a), Some(b)) if a > b => [Some(b), Some(a)],
        (None, b) => [b, None],
        pair => [pair.0, pair.1],
    }
}

/// First fall through zero of `c0 + c1 t + c2 t^2 + c3 t^3` in `(0, end]`.
#[inline(always)]
pub(super) fn cubic(c0: f64, c1: f64, c2: f64, c3: f64, end: f64) -> Option<f64> {
    // Most pieces end far from contact: no fall is possible where the start outweighs all the rest.
    if c0 > 0.0 && c0 > end * (c1.abs() + end * (c2.abs() + end * c3.abs())) {
        return None;
    }
    near_cubic(c0, c1, c2, c3, end)
}

fn near_cubic(c0: f64, c1: f64, c2: f64, c3: f64, end: f64) -> Option<f64> {
    if c0 <= 0.0 {
        return if c0 < 0.0 && c1 < 0.0 {
            Some(0.0)
        } else {
            quadratic(c1, c2, c3, end)
        };
    }
    let value = |t: f64| c0 + t * (c1 + t * (c2 + t * c3));
    let turns = sign_changes(c1, 2.0 * c2, 3.0 * c3, end);
    let mut start = 0.0;
    for stop in turns.into_iter().flatten().chain([end]) {
        if value(stop) <= 0.0 {
            return Some(bracketed(
                value,
                |t| c1 + t * (2.0 * c2 + t * 3.0 * c3),
                [start, stop],
                near(c0, c1, c2, [start, stop]),
            ));
        }
        start = stop;
    }
    None
}

/// Where to start on the root of a cubic: at that of its quadratic part, as pieces are short, else in the middle.
fn near(c0: f64, c1: f64, c2: f64, [start, stop]: [f64; 2]) -> f64 {
    let discriminant = c1 * c1 - 4.0 * c2 * c0;
    let q = -0.5 * (c1 + discriminant.max(0.0).sqrt().copysign(c1));
    [c0 / q, q / c2]
        .into_iter()
        .find(|t| *t > start && *t < stop)
        .unwrap_or(0.5 * (start + stop))
}

/// Root of a function that falls monotonically from `value(above) > 0` to `value(below) <= 0`, to rounding error:
/// Newton's iteration kept inside the bracket by bisection.
pub(super) fn bracketed(
    value: impl Fn(f64) -> f64,
    slope: impl Fn(f64) -> f64,
    [mut above, mut below]: [f64; 2],
    guess: f64,
) -> f64 {
    let mut t = guess;
    for _ in 0..200 {
        let v = value(t);
        if v == 0.0 {
            return t;
        }
        if v > 0.0 {
            above = t;
        } else {
            below = t;
        }
        let newton = t - v / slope(t);
        let next = if newton > above && newton < below {
            newton
        } else {
            0.5 * (above + below)
        };
        if next == t || next == above || next == below {
            return below;
        }
        t = next;
    }
    below
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_at_the_start_is_not_found_again() {
        // 3 t - t^2 starts at zero, rises, and falls through zero at 3.
        assert_eq!(quadratic(0.0, 3.0, -1.0, 5.0), Some(3.0));
        // t^2 (2 - t): both the value and the slope start at zero.
        assert_eq!(cubic(0.0, 0.0, 2.0, -1.0, 5.0), Some(2.0));
        assert_eq!(cubic(0.0, 0.0, 2.0, -1.0, 1.0), None);
    }

    #[test]
    fn a_double_root_is_no_event() {
        assert_eq!(quadratic(1.0, -2.0, 1.0, 5.0), None);
        // (t - 1)^2 (t + 1)
        assert_eq!(cubic(1.0, -1.0, -1.0, 1.0, 0.9), None);
    }

    #[test]
    fn a_dip_between_two_positive_ends_is_found() {
        let root = quadratic(2.0, -3.0, 1.0, 10.0).unwrap();
        assert!((root - 1.0).abs() < 1e-15);
        // (t - 1)(t - 2)(t + 5) = t^3 + 2 t^2 - 13 t + 10
        let root = cubic(10.0, -13.0, 2.0, 1.0, 10.0).unwrap();
        assert!((root - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_root_of_a_cubic_is_exact_to_rounding() {
        // Three roots 0.1, 0.1 + 1e-6, 7: the first is found, not the second.
        let (a, b, c) = (0.1, 0.1 + 1e-6, 7.0);
        let root = cubic(a * b * c, -(a * b + b * c + a * c), a + b + c, -1.0, 1.0).unwrap();
        assert!((root - a).abs() < 1e-9, "{root}");
    }

    #[test]
    fn a_function_that_already_falls_gives_time_zero() {
        assert_eq!(quadratic(-1e-20, -1.0, 0.0, 1.0), Some(0.0));
        assert_eq!(cubic(0.0, -1.0, 0.0, 0.0, 1.0), Some(0.0));
        assert_eq!(linear(-1e-20, -1.0, 1.0), 0.0);
    }
}
