//! Where a polynomial in time falls through zero, and where it changes its sign: by its coefficients in Bernstein's
//! basis, whose changes of sign are no fewer than the roots between two moments (Descartes), and which halving separates.

/// Coefficients of a velocity: order `ORDER` of `series`, and what a start adds to it.
pub(super) const TERMS: usize = 16;
/// Coefficients of a place: a velocity and one integration.
const PLACES: usize = TERMS + 1;
/// Most halvings of a stretch: less of it than rounding is left.
const CUTS: u32 = 52;
/// A coefficient of less than this part of the largest is zero to rounding.
const ROUNDING: f64 = 1e-15;

/// A polynomial in time, its terms ascending.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polynomial([f64; PLACES]);

impl Polynomial {
    /// Make one of the terms of a rate.
    pub(super) fn new(terms: impl Iterator<Item = f64>) -> Self {
        let mut all = [0.0; PLACES];
        for (term, given) in all.iter_mut().zip(terms) {
            *term = given;
        }
        Polynomial(all)
    }

    /// Make one that begins at `start` and has this rate.
    pub(super) fn place(start: f64, rate: &Self) -> Self {
        let mut all = [0.0; PLACES];
        all[0] = start;
        for (k, (term, rate)) in all[1..].iter_mut().zip(&rate.0).enumerate() {
            *term = rate / (k + 1) as f64;
        }
        Polynomial(all)
    }

    /// Its value after a time.
    pub(super) fn at(&self, t: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, term| sum * t + term)
    }

    /// Most that it may be away from its first term until `end`.
    pub(super) fn reach(&self, end: f64) -> f64 {
        let rest = self.0[1..].iter().rev();
        rest.fold(0.0, |sum: f64, term| (sum + term.abs()) * end)
    }

    /// The same times a factor.
    pub(super) fn times(&self, factor: f64) -> Self {
        Polynomial(self.0.map(|term| factor * term))
    }

    /// The first moment in `[0, end]` at which it falls below zero. Where it starts at zero that root is divided out, so
    /// that it is never found again; a double root is no fall.
    pub(super) fn falls(&self, end: f64) -> Option<f64> {
        let terms = self.divided()?;
        if terms[0] < 0.0 {
            return Some(0.0);
        }
        if terms[0] > Polynomial(terms).reach(end) {
            return None;
        }
        let mut found = None;
        separate(&terms, end, &mut |part| {
            found = Some(Polynomial(terms).between(1.0, part));
            true
        });
        found
    }

    /// The same and something linear.
    pub(super) fn plus(mut self, [value, slope]: [f64; 2]) -> Self {
        self.0[0] += value;
        self.0[1] += slope;
        self
    }

    /// Integrals from zero to `end` of it and of it times the time.
    pub(super) fn integrals(&self, end: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for (k, term) in self.0.iter().enumerate().rev() {
            sums[0] = sums[0] * end + term / (k + 1) as f64;
            sums[1] = sums[1] * end + term / (k + 2) as f64;
        }
        [sums[0] * end, sums[1] * end * end]
    }

    /// The rate of its change.
    pub(super) fn rate(&self) -> Self {
        Polynomial::new((1..PLACES).map(|k| k as f64 * self.0[k]))
    }

    /// The same less another one.
    pub(super) fn less(&self, other: &Self) -> Self {
        Polynomial(std::array::from_fn(|k| self.0[k] - other.0[k]))
    }

    /// The same from a moment on.
    pub(super) fn after(&self, since: f64) -> Self {
        if since == 0.0 {
            return *self;
        }
        let mut all = self.0;
        for row in 0..PLACES - 1 {
            for k in (row..PLACES - 1).rev() {
                all[k] += since * all[k + 1];
            }
        }
        Polynomial(all)
    }

    /// Its value and its change per second at the start.
    pub(super) fn start(&self) -> [f64; 2] {
        [self.0[0], self.0[1]]
    }

    /// The same, zero at the start.
    pub(super) fn without_start(mut self) -> Self {
        self.0[0] = 0.0;
        self
    }

    /// Moments in `(0, end)` at which it changes its sign, ascending; a zero at the start is none.
    pub(super) fn turns(&self, end: f64) -> Vec<f64> {
        let mut turns = Vec::new();
        let Some(terms) = self.divided() else {
            return turns;
        };
        if terms[0].abs() > Polynomial(terms).reach(end) {
            return turns;
        }
        let mut sign = terms[0].signum();
        separate(&terms, end, &mut |part| {
            turns.push(Polynomial(terms).between(sign, part));
            sign = -sign;
            false
        });
        turns
    }

    /// Its terms without the zeros at the start; `None` where it vanishes.
    fn divided(&self) -> Option<[f64; PLACES]> {
        let zeros = self.0.iter().position(|term| *term != 0.0)?;
        let mut terms = [0.0; PLACES];
        terms[..PLACES - zeros].copy_from_slice(&self.0[zeros..]);
        Some(terms)
    }

    /// Where it loses the sign that it has at `from`; at `to` it has lost it.
    fn between(&self, sign: f64, [mut from, mut to]: [f64; 2]) -> f64 {
        loop {
            let middle = 0.5 * (from + to);
            if middle <= from || middle >= to {
                return to;
            }
            if sign * self.at(middle) > 0.0 {
                from = middle;
            } else {
                to = middle;
            }
        }
    }
}

/// How many ways there are to choose so many of so many.
const BINOMIAL: [[f64; PLACES]; PLACES] = {
    let mut rows = [[0.0; PLACES]; PLACES];
    let mut i = 0;
    while i < PLACES {
        rows[i][0] = 1.0;
        let mut k = 1;
        while k <= i {
            rows[i][k] = rows[i - 1][k - 1] + rows[i - 1][k];
            k += 1;
        }
        i += 1;
    }
    rows
};

/// Coefficients in Bernstein's basis on `[0, end]`.
fn bernstein(terms: &[f64; PLACES], end: f64) -> [f64; PLACES] {
    // With t = s end, s^k = sum over i of binomial(i, k) / binomial(n, k) b_i.
    let n = PLACES - 1;
    let mut scaled = *terms;
    let mut power = 1.0;
    for (term, choose) in scaled.iter_mut().zip(BINOMIAL[n]) {
        *term *= power / choose;
        power *= end;
    }
    let mut result = [0.0; PLACES];
    for (b, row) in result.iter_mut().zip(&BINOMIAL) {
        *b = scaled
            .iter()
            .zip(row)
            .fold(0.0, |sum, (term, choose)| sum + choose * term);
    }
    result
}

/// Hand over parts of `[0, end]` with one change of sign each, in order, until one is all that is wanted.
fn separate(terms: &[f64; PLACES], end: f64, take: &mut impl FnMut([f64; 2]) -> bool) {
    let b = bernstein(terms, end);
    let largest = b.iter().fold(0.0, |most: f64, b| most.max(b.abs()));
    let mut positive = terms[0] > 0.0;
    parts(&b, [0.0, end], CUTS, ROUNDING * largest, &mut positive, take);
}

/// The same of a part of it before which the sign is known; less than `least` counts as zero. True where no more is wanted.
fn parts(
    b: &[f64; PLACES],
    [from, to]: [f64; 2],
    cuts: u32,
    least: f64,
    positive: &mut bool,
    take: &mut impl FnMut([f64; 2]) -> bool,
) -> bool {
    let (mut changes, mut sign) = (0, *positive);
    for b in b.iter().filter(|b| b.abs() > least) {
        changes += u32::from(sign != (*b > 0.0));
        sign = *b > 0.0;
    }
    let ends = b[PLACES - 1].abs() > least;
    if changes == 0 || (cuts == 0 && changes % 2 == 0) {
        return false;
    }
    if (changes == 1 && ends) || cuts == 0 {
        *positive = !*positive;
        return take([from, to]);
    }
    // By de Casteljau: the first of each row are the left half, the last the right one.
    let (mut left, mut right) = ([0.0; PLACES], *b);
    for (row, slot) in left.iter_mut().enumerate() {
        *slot = right[0];
        for i in 0..PLACES - 1 - row {
            right[i] = 0.5 * (right[i] + right[i + 1]);
        }
    }
    let middle = 0.5 * (from + to);
    parts(&left, [from, middle], cuts - 1, least, positive, take)
        || parts(&right, [middle, to], cuts - 1, least, positive, take)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_roots(roots: &[f64], factor: f64) -> Polynomial {
        let mut terms = vec![factor];
        for root in roots {
            let mut next = vec![0.0; terms.len() + 1];
            for (k, term) in terms.iter().enumerate() {
                next[k] -= root * term;
                next[k + 1] += term;
            }
            terms = next;
        }
        Polynomial::new(terms.into_iter())
    }

    #[test]
    fn the_first_fall_is_found_and_a_double_root_is_none() {
        let p = with_roots(&[0.3, 0.5, 0.9], -1.0);
        assert!((p.falls(1.0).unwrap() - 0.3).abs() < 1e-14);
        // A simple root where a stretch is halved.
        let p = with_roots(&[0.25, 0.625], -1.0).times(-1.0);
        assert!((p.falls(1.0).unwrap() - 0.25).abs() < 1e-14);
        let touches = with_roots(&[0.25, 0.25, 0.75], -1.0);
        assert!((touches.falls(1.0).unwrap() - 0.75).abs() < 1e-13);
        assert_eq!(touches.falls(0.5), None);
        // Near roots stay apart.
        let close = with_roots(&[0.4, 0.400001, 0.7], -1.0);
        assert!((close.falls(1.0).unwrap() - 0.4).abs() < 1e-9);
    }

    #[test]
    fn a_root_at_the_start_is_not_found_again() {
        let p = with_roots(&[0.0, 0.0, 0.6], -1.0);
        assert!((p.falls(1.0).unwrap() - 0.6).abs() < 1e-14);
        assert_eq!(p.times(-1.0).falls(1.0), Some(0.0));
        assert_eq!(Polynomial::new(std::iter::empty()).falls(1.0), None);
    }

    #[test]
    fn every_change_of_sign_is_a_turn() {
        let roots = [0.1, 0.2, 0.35, 0.8];
        let turns = with_roots(&roots, 1.0).turns(1.0);
        assert_eq!(turns.len(), 4);
        for (turn, root) in turns.iter().zip(roots) {
            assert!((turn - root).abs() < 1e-12);
        }
        assert!(with_roots(&[1.5, -2.0], 1.0).turns(1.0).is_empty());
    }
}
