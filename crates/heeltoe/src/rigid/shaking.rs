//! The ground's motion as the kernels read it: accelerations `a(t)`, linear between the samples.

use crate::Error;
use std::borrow::Cow;

use super::block::Affine;

/// So many samples, one after the other, are looked at together where nothing depends on a single one.
const STRETCH: usize = 32;

/// Share of the way to a limit that is clear of it.
const INSIDE: f64 = 1.0 - 1e-9;

/// Accelerations of the ground at common moments; a moment that is there twice is a jump.
#[derive(Clone, Debug)]
pub struct Shaking<'a> {
    pub(super) time: &'a [f64],
    horizontal: &'a [f64],
    vertical: Option<&'a [f64]>,
    scale: [f64; 2],
    /// Least and largest accelerations of each stretch of samples, before they are scaled.
    stretches: Cow<'a, [[Range; 2]]>,
    /// Largest accelerations without their sign, before they are scaled.
    peaks: [f64; 2],
}

/// Least and largest of some numbers.
pub(super) type Range = [f64; 2];

impl<'a> Shaking<'a> {
    /// Horizontal (downstream) and, if there is one, vertical (upward) acceleration in m/s2 at each `time` in s, which
    /// does not decrease.
    ///
    /// # Errors
    /// Less than two moments, or not as many accelerations as moments.
    pub fn new(time: &'a [f64], horizontal: &'a [f64], vertical: Option<&'a [f64]>) -> Result<Self, Error> {
        let n = time.len();
        if n < 2 || horizontal.len() != n || vertical.is_some_and(|v| v.len() != n) {
            let why = "a motion needs two samples or more, and as many accelerations as times";
            return Err(Error::Motion(why));
        }
        let up = |k: usize| vertical.map_or(&[0.0][..], |v| &v[k..n.min(k + STRETCH)]);
        let stretches: Vec<_> = (0..n)
            .step_by(STRETCH)
            .map(|k| [range(&horizontal[k..n.min(k + STRETCH)]), range(up(k))])
            .collect();
        let peak = |i: usize| {
            stretches
                .iter()
                .fold(0.0, |peak: f64, of| peak.max(-of[i][0]).max(of[i][1]))
        };
        Ok(Shaking {
            time,
            horizontal,
            vertical,
            scale: [1.0; 2],
            peaks: [peak(0), peak(1)],
            stretches: Cow::Owned(stretches),
        })
    }

    /// The same with the horizontal and the vertical accelerations multiplied by these factors.
    #[must_use]
    pub fn scaled(&self, scale: [f64; 2]) -> Shaking<'_> {
        Shaking {
            scale,
            stretches: Cow::Borrowed(&self.stretches),
            ..*self
        }
    }

    /// Whether it has no vertical part.
    pub(super) fn is_level(&self) -> bool {
        self.vertical.is_none()
    }

    /// Largest horizontal and vertical acceleration, without their signs.
    pub(super) fn peaks(&self) -> [f64; 2] {
        [0, 1].map(|i| (self.peaks[i] * self.scale[i]).abs())
    }

    /// The pieces from sample `k` on, each from one sample to the next.
    #[inline(always)]
    pub(super) fn pieces(&self, k: usize) -> impl Iterator<Item = Piece<2>> + use<'_> {
        self.pieces_on::<false>(k)
    }

    /// The same where it is known that the ground moves on a LEVEL.
    #[inline(always)]
    pub(super) fn pieces_on<const LEVEL: bool>(
        &self,
        k: usize,
    ) -> impl Iterator<Item = Piece<2>> + use<'_, LEVEL> {
        let n = self.time.len();
        let (time, horizontal) = (&self.time[k..n], &self.horizontal[k..n]);
        let vertical = self.vertical.filter(|_| !LEVEL).map(|v| &v[k..n]);
        let at = move |j: usize| {
            let up = vertical.map_or(0.0, |v| v[j] * self.scale[1]);
            [horizontal[j] * self.scale[0], up]
        };
        let mut a0 = at(0);
        (1..time.len()).map(move |j| {
            let a1 = at(j);
            let left = time[j] - time[j - 1];
            let inverse = 1.0 / left;
            let piece = Piece {
                ground: a0,
                rate: [(a1[0] - a0[0]) * inverse, (a1[1] - a0[1]) * inverse],
                left,
            };
            a0 = a1;
            piece
        })
    }

    /// The first sample from `k` on at which one of the limits is negative, or the number of samples.
    pub(super) fn first_below(&self, limits: &Limits, k: usize) -> usize {
        let Limits {
            limits,
            clear: [least, most],
        } = limits;
        let within = |ground| limits.iter().all(|limit| limit.at(ground) >= 0.0);
        if self.vertical.is_some() {
            let all_within = |ranges| limits.iter().all(|limit| limit.least(ranges) >= 0.0);
            return self.first_beyond(k, all_within, within);
        }
        self.first_outside(k, |a| *least < a && a < *most, |a| within([a, 0.0]))
    }

    /// The same as [`Self::first_beyond`] on a ground without vertical accelerations; what is `clear` of the limits is within
    /// them, and quicker to see.
    fn first_outside(
        &self,
        mut k: usize,
        clear: impl Fn(f64) -> bool,
        within: impl Fn(f64) -> bool,
    ) -> usize {
        let (n, scale) = (self.time.len(), self.scale[0]);
        while k < n {
            let end = n.min(k - k % STRETCH + STRETCH);
            if !self.stretches[k / STRETCH][0].iter().all(|a| clear(a * scale)) {
                for (j, a) in self.horizontal[k..end].iter().enumerate() {
                    let a = a * scale;
                    if !clear(a) && !within(a) {
                        return k + j;
                    }
                }
            }
            k = end;
        }
        n
    }

    /// The first sample from `k` on that is not `within` some limits, or the number of samples; `all_within` says it of
    /// all accelerations between the least and the largest ones.
    pub(super) fn first_beyond(
        &self,
        mut k: usize,
        all_within: impl Fn([Range; 2]) -> bool,
        within: impl Fn([f64; 2]) -> bool,
    ) -> usize {
        let n = self.time.len();
        while k < n {
            let end = n.min(k - k % STRETCH + STRETCH);
            // Rounding keeps order: what holds at the ends of the ranges holds at every sample in them.
            let ranges = [0, 1].map(|i| self.stretches[k / STRETCH][i].map(|a| a * self.scale[i]));
            if !all_within(ranges) {
                if let Some(found) = (k..end).find(|k| !within(self.at(*k))) {
                    return found;
                }
            }
            k = end;
        }
        n
    }

    /// Where a straight piece ends right before the last moment, whatever jumps there.
    pub(super) fn last(&self) -> usize {
        let end = self.time[self.time.len() - 1];
        self.time.iter().rposition(|t| *t < end).map_or(0, |k| k + 1)
    }

    /// Horizontal accelerations at some moments, ascending; at a jump those behind it.
    pub(super) fn horizontal_at<'t>(&'t self, times: &'t [f64]) -> impl Iterator<Item = f64> + use<'t> {
        let last = self.time.len() - 1;
        let mut k = 0;
        times.iter().map(move |&t| {
            while k < last && self.time[k + 1] <= t {
                k += 1;
            }
            let here = self.at(k)[0];
            if k == last || t <= self.time[k] {
                return here;
            }
            here + (self.at(k + 1)[0] - here) * ((t - self.time[k]) / (self.time[k + 1] - self.time[k]))
        })
    }

    #[inline]
    pub(super) fn at(&self, k: usize) -> [f64; 2] {
        let up = self.vertical.map_or(0.0, |v| v[k] * self.scale[1]);
        [self.horizontal[k] * self.scale[0], up]
    }
}

/// What must not be negative, and where none of it is on a level ground, see [`clear_of`].
pub(super) struct Limits {
    limits: [Affine; 4],
    clear: Range,
}

impl Limits {
    pub(super) fn new(limits: [Affine; 4]) -> Self {
        let clear = clear_of(&limits);
        Limits { limits, clear }
    }
}

/// Horizontal accelerations between which none of the limits is negative, whatever the rounding.
#[inline(always)]
pub(super) fn clear_of(limits: &[Affine]) -> Range {
    let mut range = [f64::NEG_INFINITY, f64::INFINITY];
    for limit in limits {
        if limit.constant <= 0.0 {
            return [0.0; 2];
        }
        let inside = INSIDE * limit.constant / limit.horizontal.abs();
        if limit.horizontal >= 0.0 {
            range[0] = range[0].max(-inside);
        }
        if limit.horizontal <= 0.0 {
            range[1] = range[1].min(inside);
        }
    }
    range
}

fn range(series: &[f64]) -> Range {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    series
        .iter()
        .fold(start, |[least, most], a| [least.min(*a), most.max(*a)])
}

/// Ground accelerations from here to the end of a piece on which they are linear: values, rates of change, time left.
#[derive(Clone, Copy, Debug)]
pub struct Piece<const N: usize> {
    /// Accelerations now.
    pub ground: [f64; N],
    /// Their change per second.
    pub rate: [f64; N],
    /// How long the piece goes on (s).
    pub left: f64,
}

impl<const N: usize> Piece<N> {
    /// A ground that stands still.
    pub(super) fn still(left: f64) -> Self {
        Piece {
            ground: [0.0; N],
            rate: [0.0; N],
            left,
        }
    }

    /// What is left of it after so many seconds.
    #[inline(always)]
    pub(super) fn rest(&self, since: f64) -> Self {
        Piece {
            ground: self.after(since),
            left: self.left - since,
            ..*self
        }
    }

    /// Accelerations after so many seconds.
    #[inline]
    pub(super) fn after(&self, since: f64) -> [f64; N] {
        std::array::from_fn(|i| self.ground[i] + self.rate[i] * since)
    }
}
