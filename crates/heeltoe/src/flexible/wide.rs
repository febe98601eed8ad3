//! Eight numbers at a time, by the widest registers of the machine that runs the program.
//!
//! The loops over the mode shapes are most of what a step costs. Compilers turn them into wide instructions when they
//! please, and into worse ones than none when they do not; here they are said outright. What is compiled for registers
//! of its own must be called where the machine has them only, see [`super::step::simulate`].

use super::body::{Group, LANES};

/// A group in registers.
pub(super) trait Wide: Copy {
    /// Whether `a b + c` is rounded once.
    const FUSED: bool;

    fn load(group: &Group) -> Self;

    fn store(self, group: &mut Group);

    /// The same number eight times.
    fn all(x: f64) -> Self;

    fn add(self, b: Self) -> Self;

    /// `self b + c`.
    fn fma(self, b: Self, c: Self) -> Self;

    /// The sum of each of eight groups.
    #[inline(always)]
    fn sums(groups: &[Group; LANES]) -> Group {
        let mut sums = [0.0; LANES];
        for (sum, group) in sums.iter_mut().zip(groups) {
            *sum = total(group);
        }
        sums
    }
}

/// Sum of a group, by halves.
#[inline(always)]
fn total(group: &Group) -> f64 {
    let mut lanes = *group;
    let mut width = LANES / 2;
    while width > 0 {
        for l in 0..width {
            lanes[l] += lanes[l + width];
        }
        width /= 2;
    }
    lanes[0]
}

/// On any machine.
#[derive(Clone, Copy)]
pub(super) struct Plain(Group);

impl Wide for Plain {
    const FUSED: bool = false;

    #[inline(always)]
    fn load(group: &Group) -> Self {
        Plain(*group)
    }

    #[inline(always)]
    fn store(self, group: &mut Group) {
        *group = self.0;
    }

    #[inline(always)]
    fn all(x: f64) -> Self {
        Plain([x; LANES])
    }

    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Plain(std::array::from_fn(|l| self.0[l] + b.0[l]))
    }

    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        Plain(std::array::from_fn(|l| self.0[l] * b.0[l] + c.0[l]))
    }
}

#[cfg(target_arch = "x86_64")]
pub(super) mod x86 {
    use std::arch::x86_64::{
        __m256d, __m512d, _mm256_add_pd, _mm256_fmadd_pd, _mm256_loadu_pd, _mm256_set1_pd, _mm256_storeu_pd,
        _mm512_add_pd, _mm512_fmadd_pd, _mm512_loadu_pd, _mm512_set1_pd, _mm512_shuffle_f64x2,
        _mm512_storeu_pd, _mm512_unpackhi_pd, _mm512_unpacklo_pd,
    };

    use super::{Group, Wide, LANES};

    /// In one register of AVX-512.
    #[derive(Clone, Copy)]
    pub struct Avx512(__m512d);

    // Safety of all below: they run where the machine has been found to have these registers, and a group has eight numbers.
    impl Wide for Avx512 {
        const FUSED: bool = true;

        #[inline(always)]
        fn load(group: &Group) -> Self {
            Avx512(unsafe { _mm512_loadu_pd(group.as_ptr()) })
        }

        #[inline(always)]
        fn store(self, group: &mut Group) {
            unsafe { _mm512_storeu_pd(group.as_mut_ptr(), self.0) }
        }

        #[inline(always)]
        fn all(x: f64) -> Self {
            Avx512(unsafe { _mm512_set1_pd(x) })
        }

        #[inline(always)]
        fn add(self, b: Self) -> Self {
            Avx512(unsafe { _mm512_add_pd(self.0, b.0) })
        }

        #[inline(always)]
        fn fma(self, b: Self, c: Self) -> Self {
            Avx512(unsafe { _mm512_fmadd_pd(self.0, b.0, c.0) })
        }

        /// Neighbours first, two groups at a time, then neighbouring pairs of four groups, then fours of all eight.
        #[inline(always)]
        fn sums(groups: &[Group; LANES]) -> Group {
            let [a, b, c, d, e, f, g, h] = groups;
            let mut sums = [0.0; LANES];
            unsafe {
                let (one, other) = (fours(twos(a, b), twos(c, d)), fours(twos(e, f), twos(g, h)));
                Avx512(fours(one, other)).store(&mut sums);
            }
            sums
        }
    }

    /// Sums of the neighbours in `a` and in `b`, in turn.
    #[inline(always)]
    unsafe fn twos(a: &Group, b: &Group) -> __m512d {
        let (a, b) = (Avx512::load(a).0, Avx512::load(b).0);
        _mm512_add_pd(_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b))
    }

    /// Sums of neighbouring pairs of numbers, those of `a` and then those of `b`.
    #[inline(always)]
    unsafe fn fours(a: __m512d, b: __m512d) -> __m512d {
        _mm512_add_pd(
            _mm512_shuffle_f64x2::<0x88>(a, b),
            _mm512_shuffle_f64x2::<0xdd>(a, b),
        )
    }

    /// In two registers of AVX2.
    #[derive(Clone, Copy)]
    pub struct Avx2(__m256d, __m256d);

    impl Wide for Avx2 {
        const FUSED: bool = true;

        #[inline(always)]
        fn load(group: &Group) -> Self {
            unsafe {
                Avx2(
                    _mm256_loadu_pd(group.as_ptr()),
                    _mm256_loadu_pd(group.as_ptr().add(4)),
                )
            }
        }

        #[inline(always)]
        fn store(self, group: &mut Group) {
            unsafe {
                _mm256_storeu_pd(group.as_mut_ptr(), self.0);
                _mm256_storeu_pd(group.as_mut_ptr().add(4), self.1);
            }
        }

        #[inline(always)]
        fn all(x: f64) -> Self {
            let half = unsafe { _mm256_set1_pd(x) };
            Avx2(half, half)
        }

        #[inline(always)]
        fn add(self, b: Self) -> Self {
            unsafe { Avx2(_mm256_add_pd(self.0, b.0), _mm256_add_pd(self.1, b.1)) }
        }

        #[inline(always)]
        fn fma(self, b: Self, c: Self) -> Self {
            unsafe {
                Avx2(
                    _mm256_fmadd_pd(self.0, b.0, c.0),
                    _mm256_fmadd_pd(self.1, b.1, c.1),
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::body::combine;
    use super::{Group, Plain, Wide, LANES};

    /// Sums of 7 rows of 11 groups, with what was there, and of the lanes of the first eight.
    fn found<W: Wide>() -> (Vec<Group>, Group) {
        let number = |k: usize| ((k * 7919 + 13) % 1009) as f64 / 1009.0 - 0.5;
        let rows: Vec<Group> = (0..77)
            .map(|row| std::array::from_fn(|l| number(row * LANES + l)))
            .collect();
        let x = [0.3, 0.0, -0.7, 0.0, 0.0, 1.1, 0.9];
        let mut sum = rows[60..71].to_vec();
        combine::<W>(&rows, &x, &mut sum);
        let lanes = rows.as_chunks().0;
        (sum, W::sums(&lanes[0]))
    }

    #[cfg(target_arch = "x86_64")]
    fn check<W: Wide>() {
        let ((sums, totals), (ours, our_totals)) = (found::<Plain>(), found::<W>());
        let pairs = sums.as_flattened().iter().zip(ours.as_flattened());
        for (one, other) in pairs.chain(totals.iter().zip(&our_totals)) {
            assert!((one - other).abs() < 4e-16, "{one} {other}");
        }
    }

    #[test]
    fn plain_sums_are_what_they_say() {
        let (sums, totals) = found::<Plain>();
        let number = |k: usize| ((k * 7919 + 13) % 1009) as f64 / 1009.0 - 0.5;
        for (k, sum) in sums.as_flattened().iter().enumerate() {
            let terms = [(0, 0.3), (2, -0.7), (5, 1.1), (6, 0.9)];
            let expected = terms.map(|(row, x)| x * number(row * 88 + k)).iter().sum::<f64>();
            assert!((sum - expected - number(480 + k)).abs() < 4e-16);
        }
        for (k, total) in totals.iter().enumerate() {
            let expected = (0..LANES).map(|l| number(k * LANES + l)).sum::<f64>();
            assert!((total - expected).abs() < 1e-15);
        }
    }

    #[test]
    #[cfg(target_arch = "x86_64")]
    fn wide_registers_sum_like_plain_numbers() {
        use super::x86::{Avx2, Avx512};
        if is_x86_feature_detected!("avx512f") {
            check::<Avx512>();
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            check::<Avx2>();
        }
    }
}
