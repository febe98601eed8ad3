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
