//! A power series in the time over its length, and where it falls through zero.

use super::super::event::bracketed;
use crate::friction::{INVERSE, TERMS};

/// Halvings in the search for a fall; what falls and rises again within so short a time only touches.
const HALVINGS: usize = 40;

/// Most terms of a series of a flight: where it needs more it is better cut.
pub(super) const MOST: usize = 22;
/// The terms of such a series.
pub(super) type Terms = [f64; MOST];
/// Such a series.
pub(super) type Series = Power<MOST>;

/// A power series.
#[derive(Clone, Copy)]
pub(super) struct Power<const N: usize = TERMS> {
    pub terms: [f64; N],
    /// How many of them there are.
    pub count: usize,
}

impl<const N: usize> Power<N> {
    pub(super) const NONE: Self = Power {
        terms: [0.0; N],
        count: 0,
    };

    /// End it with so many terms, and with a length that is `part` of what it was.
    pub(super) fn end(&mut self, count: usize, part: f64) {
        self.count = count;
        if part < 1.0 {
            self.shorten(part);
        }
    }

    pub(super) fn at(&self, t: f64) -> f64 {
        self.terms[..self.count]
            .iter()
            .rev()
            .fold(0.0, |sum, term| sum * t + term)
    }

    /// Its rate of change.
    pub(super) fn rate(&self, t: f64) -> f64 {
        let later = self.terms[..self.count].iter().enumerate().skip(1).rev();
        later.fold(0.0, |sum, (n, term)| sum * t + n as f64 * term)
    }

    /// It times a factor.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        Power {
            terms: self.terms.map(|term| factor * term),
            ..*self
        }
    }

    /// With another one of as many terms, times a factor.
    pub(super) fn plus(&self, other: &Self, factor: f64) -> Self {
        Power {
            terms: std::array::from_fn(|n| self.terms[n] + factor * other.terms[n]),
            ..*self
        }
    }

    /// Its integral from zero on.
    pub(super) fn integral(&self, t: f64) -> f64 {
        let terms = self.terms[..self.count].iter().enumerate().rev();
        t * terms.fold(0.0, |sum, (n, term)| sum * t + term * INVERSE[n + 1])
    }

    /// The least that it can be anywhere in [0, 1].
    pub(super) fn floor(&self) -> f64 {
        self.terms[0] - self.swing()
    }

    /// How far it can go from its start in [0, 1].
    pub(super) fn swing(&self) -> f64 {
        self.terms[1..self.count].iter().map(|term| term.abs()).sum()
    }

    /// With a length that is `part` of what it was.
    pub(super) fn shorten(&mut self, part: f64) {
        let mut power = 1.0;
        for term in &mut self.terms[..self.count] {
            *term *= power;
            power *= part;
        }
    }

    /// First moment in [0, 1] at which it falls through zero; one that reaches zero at the end but for rounding does so.
    /// A root at the start, where it rises, is none.
    pub(super) fn first_fall(&self) -> Option<f64> {
        let rounding = 4.0 * f64::EPSILON * (self.terms[0].abs() + self.swing());
        if self.floor() > rounding {
            return None;
        }
        if self.terms[0] < 0.0 {
            return Some(0.0);
        }
        let ends_at_zero = || (self.at(1.0) <= rounding && self.rate(1.0) <= 0.0).then_some(1.0);
        let mut whole = *self;
        if whole.terms[0] == 0.0 {
            // What is left once the root at the start is divided out.
            whole.terms.copy_within(1..self.count, 0);
            whole.count -= 1;
            if whole.terms[0] < 0.0 {
                return Some(0.0);
            }
        }
        whole.fall_in(0.0, 1.0, HALVINGS).or_else(ends_at_zero)
    }

    /// The same where it falls below `-floor` after that.
    pub(super) fn first_fall_below(&self, floor: f64) -> Option<f64> {
        if self.floor() > 0.0 {
            return None;
        }
        let mut raised = *self;
        raised.terms[0] += floor;
        raised.first_fall().and_then(|_| self.first_fall())
    }

    /// The same on a stretch at whose start it is not negative.
    fn fall_in(&self, start: f64, end: f64, halvings: usize) -> Option<f64> {
        let mut near = *self;
        if start > 0.0 {
            near = self.about(start);
        }
        if start > 0.0 || end < 1.0 {
            near.shorten(end - start);
        }
        if near.floor() > 0.0 {
            return None;
        }
        let slope = near.derivative();
        if slope.terms[0] + slope.swing() < 0.0 {
            // It falls all the way.
            return (self.at(end) <= 0.0).then(|| {
                let middle = 0.5 * (start + end);
                bracketed(|t| self.at(t), |t| self.rate(t), [start, end], middle)
            });
        }
        if slope.floor() > 0.0 || halvings == 0 {
            return None;
        }
        let middle = 0.5 * (start + end);
        let first = self.fall_in(start, middle, halvings - 1);
        first.or_else(|| self.fall_in(middle, end, halvings - 1))
    }

    /// The same function about another moment.
    fn about(&self, start: f64) -> Self {
        let mut moved = *self;
        for low in 0..self.count {
            for n in (low..self.count - 1).rev() {
                moved.terms[n] += start * moved.terms[n + 1];
            }
        }
        moved
    }

    fn derivative(&self) -> Self {
        let mut rate = Power {
            terms: [0.0; N],
            count: (self.count - 1).max(1),
        };
        for n in 1..self.count {
            rate.terms[n - 1] = n as f64 * self.terms[n];
        }
        rate
    }
}

/// Term n of the product of two series.
pub(super) fn product(a: &Terms, b: &Terms, n: usize) -> f64 {
    crossed(&a[..=n], &b[..=n])
}

/// The same without the first term of the first series.
pub(super) fn later(a: &Terms, b: &Terms, n: usize) -> f64 {
    crossed(&a[1..=n], &b[..n])
}

/// Sum of the products of some numbers with others from last to first, in four sums that need not wait for each other.
fn crossed(a: &[f64], b: &[f64]) -> f64 {
    let (ahead, behind) = (a.chunks_exact(4), b.rchunks_exact(4));
    let left = ahead.remainder().iter().zip(behind.remainder().iter().rev());
    let rest: f64 = left.map(|(a, b)| a * b).sum();
    let mut sums = [0.0; 4];
    for (a, b) in ahead.zip(behind) {
        for i in 0..4 {
            sums[i] += a[i] * b[3 - i];
        }
    }
    rest + ((sums[0] + sums[1]) + (sums[2] + sums[3]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn power(given: &[f64]) -> Power {
        let mut terms = [0.0; TERMS];
        terms[..given.len()].copy_from_slice(given);
        Power {
            terms,
            count: given.len(),
        }
    }

    #[test]
    fn a_dip_between_two_ends_above_zero_is_found() {
        // (t - 0.3) (t - 0.31) (t + 2)
        let dip = power(&[0.186, -1.127, 1.39, 1.0]);
        assert!((dip.first_fall().unwrap() - 0.3).abs() < 1e-13);
        // The same, above zero by a hair.
        assert_eq!(power(&[0.1861, -1.127, 1.39, 1.0]).first_fall(), None);
    }

    #[test]
    fn a_root_at_the_start_is_not_found_again() {
        // t (0.5 - t), and t^2 (0.5 - t).
        assert_eq!(power(&[0.0, 0.5, -1.0]).first_fall(), Some(0.5));
        assert!((power(&[0.0, 0.0, 0.5, -1.0]).first_fall().unwrap() - 0.5).abs() < 1e-13);
        assert_eq!(power(&[0.0, -0.5, 2.0]).first_fall(), Some(0.0));
        assert_eq!(power(&[0.0, 0.5, 1.0]).first_fall(), None);
    }

    #[test]
    fn a_root_right_at_the_end_is_one_whatever_the_rounding() {
        assert_eq!(power(&[1.0, -1.0 + 1e-16]).first_fall(), Some(1.0));
        assert_eq!(power(&[1.0, -1.0 + 1e-9]).first_fall(), None);
    }

    #[test]
    fn a_part_of_it_is_the_same_function() {
        let whole = power(&[0.3, -1.0, 0.7, 2.0, -0.4]);
        let moved = whole.about(0.25);
        let mut part = whole;
        part.shorten(0.5);
        for t in [0.0, 0.3, 0.7] {
            assert!((moved.at(t) - whole.at(t + 0.25)).abs() < 1e-15);
            assert!((part.at(t) - whole.at(0.5 * t)).abs() < 1e-15);
            assert!((whole.derivative().at(t) - whole.rate(t)).abs() < 1e-15);
        }
        assert!((whole.integral(0.5) - (0.15 - 0.125 + 0.7 / 24.0 + 0.03125 - 0.0025)).abs() < 1e-15);
    }
}
