//! The ground's motion as the kernels read it: accelerations `a(t)`, linear between the samples.

/// Accelerations of the ground at common moments; a moment that is there twice is a jump.
#[derive(Clone, Copy, Debug)]
pub struct Shaking<'a> {
    pub(super) time: &'a [f64],
    horizontal: &'a [f64],
    vertical: Option<&'a [f64]>,
    scale: [f64; 2],
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
        Ok(Shaking {
            time,
            horizontal,
            vertical,
            scale: [1.0; 2],
        })
    }

    /// The same with the horizontal and the vertical accelerations multiplied by these factors.
    #[must_use]
    pub fn scaled(self, scale: [f64; 2]) -> Self {
        Shaking { scale, ..self }
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
