//! The ground's motion as the kernels read it: accelerations `a(t)`, linear between the samples.

/// Accelerations of the ground at common moments; a moment that is there twice is a jump.
#[derive(Clone, Copy, Debug)]
pub struct Shaking<'a> {
    pub(super) time: &'a [f64],
    horizontal: &'a [f64],
    vertical: Option<&'a [f64]>,
    scale: [f64; 2],
    /// Largest accelerations without their sign, before they are scaled.
    peaks: [f64; 2],
}

impl<'a> Shaking<'a> {
    /// Horizontal (downstream) and, if there is one, vertical (upward) acceleration in m/s2 at each `time` in s, which
    /// does not decrease.
    ///
    /// # Errors
    /// Less than two moments, or not as many accelerations as moments.
    pub fn new(
        time: &'a [f64],
        horizontal: &'a [f64],
        vertical: Option<&'a [f64]>,
    ) -> Result<Self, &'static str> {
        let n = time.len();
        if n < 2 || horizontal.len() != n || vertical.is_some_and(|v| v.len() != n) {
            return Err("a motion needs two samples or more, and as many accelerations as times");
        }
        let peak = |series: &[f64]| series.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
        Ok(Shaking {
            time,
            horizontal,
            vertical,
            scale: [1.0; 2],
            peaks: [peak(horizontal), vertical.map_or(0.0, peak)],
        })
    }

    /// The same with the horizontal and the vertical accelerations multiplied by these factors.
    #[must_use]
    pub fn scaled(self, scale: [f64; 2]) -> Self {
        Shaking { scale, ..self }
    }

    /// Largest horizontal and vertical acceleration, without their signs.
    pub(super) fn peaks(&self) -> [f64; 2] {
        [0, 1].map(|i| (self.peaks[i] * self.scale[i]).abs())
    }

    /// Where a straight piece ends right before the last moment, whatever jumps there.
    pub(super) fn last(&self) -> usize {
        let end = self.time[self.time.len() - 1];
        self.time.iter().rposition(|t| *t < end).map_or(0, |k| k + 1)
    }

    #[inline]
    pub(super) fn at(&self, k: usize) -> [f64; 2] {
        let up = self.vertical.map_or(0.0, |v| v[k] * self.scale[1]);
        [self.horizontal[k] * self.scale[0], up]
    }
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

    /// Accelerations after so many seconds.
    #[inline]
    pub(super) fn after(&self, since: f64) -> [f64; N] {
        std::array::from_fn(|i| self.ground[i] + self.rate[i] * since)
    }
}
