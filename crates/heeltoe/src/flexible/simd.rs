//! Eight numbers at a time, by the widest registers of the machine that runs the program.
//!
//! The loops over the mode shapes are most of what a step costs. Compilers turn them into wide instructions when they
//! please, and into worse ones than none when they do not; here they are written out. The innermost loops alone are
//! compiled for registers of their own, [`apart!`] from the rest: compiled as one function by inlining, the steps of an
//! elastic dam took a quarter of an hour. Registers are chosen once for a run, see [`super::step::simulate`].

/// Modes are kept in groups this wide, so that one instruction works on a group.
pub(super) const LANES: usize = 8;
/// One number for each mode of a group.
pub(super) type Group = [f64; LANES];

/// What is compiled for the registers of a machine as a function of its own.
pub(super) trait Work {
    type Answer;

    /// To be inlined into [`Lanes::apart`].
    fn run<W: Lanes>(self) -> Self::Answer;
}

/// A function that does what one to be inlined does, but is compiled by itself for the registers of the machine.
macro_rules! apart {
    (
        $(#[$doc:meta])*
        $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?) -> $answer:ty = $of:ident::$inlined:ident;
    ) => {
        $(#[$doc])*
        $vis fn $name<W: $crate::flexible::simd::Lanes>($($arg: $type),*) -> $answer {
            struct Call<T>(T);
            impl $crate::flexible::simd::Work for Call<($($type,)*)> {
                type Answer = $answer;

                #[inline(always)]
                fn run<W: $crate::flexible::simd::Lanes>(self) -> $answer {
                    let Call(($($arg,)*)) = self;
                    $of::$inlined::<W>($($arg),*)
                }
            }
            W::apart(Call(($($arg,)*)))
        }
    };
}
pub(super) use apart;

/// A group in registers.
pub(super) trait Lanes: Copy {
    /// Whether `a b + c` is rounded once.
    const FUSED: bool;

    /// Do this in a function of its own.
    fn apart<T: Work>(work: T) -> T::Answer;

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

impl Lanes for Plain {
    const FUSED: bool = false;

    #[inline(never)]
    fn apart<T: Work>(work: T) -> T::Answer {
        work.run::<Plain>()
    }

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

    use super::{Group, Lanes, Work, LANES};

    /// In one register of AVX-512.
    #[derive(Clone, Copy)]
    pub struct Avx512(__m512d);

    // Safety of all below: they run where the machine has been found to have these registers, and a group has eight numbers.
    impl Lanes for Avx512 {
        const FUSED: bool = true;

        #[inline(always)]
        fn apart<T: Work>(work: T) -> T::Answer {
            #[target_feature(enable = "avx512f,avx512vl,avx2,fma")]
            #[inline(never)]
            fn run<T: Work>(work: T) -> T::Answer {
                work.run::<Avx512>()
            }
            unsafe { run(work) }
        }

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

    impl Lanes for Avx2 {
        const FUSED: bool = true;

        #[inline(always)]
        fn apart<T: Work>(work: T) -> T::Answer {
            #[target_feature(enable = "avx2,fma")]
            #[inline(never)]
            fn run<T: Work>(work: T) -> T::Answer {
                work.run::<Avx2>()
            }
            unsafe { run(work) }
        }

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

/// Add `sum_k x_k rows_k`, where each row has as many groups as `sum`.
pub(super) fn combine<W: Lanes>(rows: &[Group], x: &[f64], sum: &mut [Group]) {
    combine_first::<W>(rows, sum.len(), x, sum);
}

apart! {
    /// The same with the first groups of rows of `stride` groups.
    pub(super) fn combine_first(rows: &[Group], stride: usize, x: &[f64], sum: &mut [Group]) -> () = inlined::combine;
}

/// Add `x` times some groups to others.
#[inline(always)]
pub(super) fn add_times<W: Lanes>(x: f64, groups: &[Group], to: &mut [Group]) {
    let x = W::all(x);
    for (to, groups) in to.iter_mut().zip(groups) {
        x.fma(W::load(groups), W::load(to)).store(to);
    }
}

/// What is to be inlined where it is used.
pub(super) mod inlined {
    use super::{columns, Group, Lanes};

    /// [`super::combine_first`].
    #[inline(always)]
    pub(in super::super) fn combine<W: Lanes>(rows: &[Group], stride: usize, x: &[f64], sum: &mut [Group]) {
        let mut first = 0;
        // What is summed up stays in registers.
        while first < sum.len() {
            first += match sum.len() - first {
                1 => columns::<W, 1>(rows, stride, x, first, sum),
                2 => columns::<W, 2>(rows, stride, x, first, sum),
                3 => columns::<W, 3>(rows, stride, x, first, sum),
                4 => columns::<W, 4>(rows, stride, x, first, sum),
                _ => columns::<W, 5>(rows, stride, x, first, sum),
            }
        }
    }
}

/// The same for so many groups of each row from the `first` one on; returns how many.
#[inline(always)]
fn columns<W: Lanes, const N: usize>(
    rows: &[Group],
    stride: usize,
    x: &[f64],
    first: usize,
    sum: &mut [Group],
) -> usize {
    // Closures would be compiled for any machine, so these are loops. Two sums in turn do not wait for each other.
    let mut new = [[W::all(0.0); N]; 2];
    for n in 0..N {
        new[0][n] = W::load(&sum[first + n]);
    }
    let (pairs, last) = x.as_chunks::<2>();
    for (x, rows) in pairs.iter().zip(rows.chunks_exact(2 * stride)) {
        if x[0] != 0.0 || x[1] != 0.0 {
            let (even, odd) = (&rows[first..first + N], &rows[stride + first..][..N]);
            let x = [W::all(x[0]), W::all(x[1])];
            for n in 0..N {
                new[0][n] = x[0].fma(W::load(&even[n]), new[0][n]);
                new[1][n] = x[1].fma(W::load(&odd[n]), new[1][n]);
            }
        }
    }
    for x in last {
        let row = &rows[2 * pairs.len() * stride + first..][..N];
        for n in 0..N {
            new[0][n] = W::all(*x).fma(W::load(&row[n]), new[0][n]);
        }
    }
    for n in 0..N {
        new[0][n].add(new[1][n]).store(&mut sum[first + n]);
    }
    N
}

/// A matrix with rows of `count` numbers in groups, each row filled up with zeros.
pub(super) fn in_groups(matrix: &[f64], count: usize) -> Vec<Group> {
    let stride = count.div_ceil(LANES);
    let mut groups = vec![[0.0; LANES]; matrix.len() / count * stride];
    for (full, row) in groups.chunks_exact_mut(stride).zip(matrix.chunks_exact(count)) {
        full.as_flattened_mut()[..count].copy_from_slice(row);
    }
    groups
}

/// Copy numbers into groups, the last of which is filled up with zeros.
#[inline(always)]
pub(super) fn fill(numbers: &[f64], groups: &mut [Group]) {
    let (numbers_to, rest) = groups.as_flattened_mut().split_at_mut(numbers.len());
    numbers_to.copy_from_slice(numbers);
    rest.fill(0.0);
}

/// `sum a b`, lane by lane: a plain sum waits for each addition.
#[inline(always)]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((wide_a, rest_a), (wide_b, rest_b)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut lanes = [0.0; LANES];
    for (a, b) in wide_a.iter().zip(wide_b) {
        for l in 0..LANES {
            lanes[l] += a[l] * b[l];
        }
    }
    lanes.iter().sum::<f64>() + rest_a.iter().zip(rest_b).map(|(a, b)| a * b).sum::<f64>()
}

/// The largest of all amounts, lane by lane as [`dot`]; a number that is none is the most.
#[inline(always)]
pub(super) fn largest(numbers: &[f64]) -> f64 {
    let (wide, rest) = numbers.as_chunks::<LANES>();
    let more = |most: f64, x: f64| {
        if x.abs() > most || x.is_nan() {
            x.abs()
        } else {
            most
        }
    };
    let mut lanes = [0.0; LANES];
    for numbers in wide {
        for l in 0..LANES {
            lanes[l] = more(lanes[l], numbers[l]);
        }
    }
    for (most, x) in lanes.iter_mut().zip(rest) {
        *most = more(*most, *x);
    }
    let mut width = LANES / 2;
    while width > 0 {
        for l in 0..width {
            lanes[l] = more(lanes[l], lanes[l + width]);
        }
        width /= 2;
    }
    lanes[0]
}

/// `a b + c`, in one rounding where the machine has it.
#[inline(always)]
pub(super) fn fma<W: Lanes>(a: f64, b: f64, c: f64) -> f64 {
    if W::FUSED {
        a.mul_add(b, c)
    } else {
        a * b + c
    }
}

#[cfg(test)]
mod tests {
    use super::{combine, largest, Group, Lanes, Plain, LANES};

    /// Sums of 7 rows of 11 groups, with what was there, and of the lanes of the first eight.
    fn found<W: Lanes>() -> (Vec<Group>, Group) {
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
    fn check<W: Lanes>() {
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
    #[test]
    fn a_number_that_is_none_is_the_most() {
        for count in [0, 1, 7, 8, 9, 34] {
            let mut numbers: Vec<f64> = (0..count).map(|k| -f64::from(k)).collect();
            assert_eq!(largest(&numbers), f64::from((count - 1).max(0)));
            for k in 0..numbers.len() {
                let number = std::mem::replace(&mut numbers[k], f64::NAN);
                assert!(largest(&numbers).is_nan());
                numbers[k] = number;
            }
        }
    }
}
