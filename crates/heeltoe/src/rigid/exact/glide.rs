//! Starts and stops of a slip that presses both corners clear of every limit: what the walk from event to event does, to
//! the bit, by the few quantities that this takes.

use super::super::block::{Affine, HEEL, SLIP, TOE};
use super::super::choice::{begun, sign, TIE, VIOLATION};
use super::super::event;
use super::super::mode::{Mode, Slip};
use super::super::reaction::{Reaction, ACCELERATION, CONE};
use super::super::shaking::{clear_of, Piece, Range, Shaking};
use super::super::walk::{Carried, Cause, Ended};
use super::walk::{Exact, Halt};

/// A number above this part of the terms that make it up is not zero: no rounding makes it so.
pub(super) const CLEAR: f64 = 1e-9;

/// How a block that stays pressed onto both corners goes on from here, how long, and what ends that.
struct Leg {
    mode: Mode,
    /// Acceleration of the slip and its change per second, where it slides.
    slide: Option<[f64; 2]>,
    step: f64,
    ended: Option<Cause>,
}

/// One quantity of a mode on a piece: its value at the start, and its change per second.
#[inline(always)]
pub(super) fn felt<const LEVEL: bool>(quantity: &Affine, piece: &Piece<2>) -> [f64; 2] {
    [
        quantity.on::<LEVEL>(piece.ground),
        quantity.rate::<LEVEL>(piece.rate),
    ]
}

/// Where the normal forces of a mode at heel and toe are clear of zero: what they are more than that by, and horizontal
/// accelerations between which it is more than nothing on a level ground.
pub(super) struct Pressed {
    margins: [Affine; 2],
    range: Range,
}

impl Pressed {
    pub(super) fn new(reaction: &Reaction) -> Self {
        let margins = margins(reaction);
        let range = clear_of(&margins);
        Pressed { margins, range }
    }

    /// Whether they are so on a level ground, wherever its acceleration is within this peak.
    pub(super) fn within(&self, peak: f64) -> bool {
        self.range[0] < -peak && peak < self.range[1]
    }

    /// Whether they are so from one end of a piece to the other.
    #[inline(always)]
    pub(super) fn stays<const LEVEL: bool>(&self, piece: &Piece<2>) -> bool {
        if LEVEL {
            let [least, most] = self.range;
            let (start, end) = (piece.ground[0], piece.after(piece.left)[0]);
            return least < start && start < most && least < end && end < most;
        }
        all_along::<LEVEL>(&self.margins, piece)
    }
}

/// By what the normal forces at heel and toe are more than clear of zero.
#[inline(always)]
fn margins(reaction: &Reaction) -> [Affine; 2] {
    [HEEL, TOE].map(|gap| reaction.quantity(gap).less(CLEAR * reaction.size[gap]))
}

/// Whether these are positive from one end of a piece to the other.
#[inline(always)]
fn all_along<const LEVEL: bool>(margins: &[Affine; 2], piece: &Piece<2>) -> bool {
    margins.iter().all(|margin| {
        let [value, slope] = felt::<LEVEL>(margin, piece);
        value > 0.0 && value + slope * piece.left > 0.0
    })
}

impl Exact<'_> {
    /// Go on as [`Self::pass`] does, across starts and stops, where both corners stay pressed, so that the modes of one
    /// corner are no choice, and where no event is wanted. `None` where the run ends.
    pub(super) fn glide(&mut self, shaking: &Shaking, from: usize) -> Option<Halt> {
        if shaking.is_level() {
            self.glide_on::<true>(shaking, from)
        } else {
            self.glide_on::<false>(shaking, from)
        }
    }

    /// The same where it is known whether the ground moves on a LEVEL.
    fn glide_on<const LEVEL: bool>(&mut self, shaking: &Shaking, from: usize) -> Option<Halt> {
        let mut k = from;
        loop {
            k = self.pass(shaking, k);
            if self.walk.mode.contacts() != [true, true] || self.walk.stopped() {
                return Some(Halt::at(k));
            }
            let piece = shaking
                .pieces_on::<LEVEL>(k)
                .next()
                .filter(|piece| piece.left > 0.0);
            let Some(whole) = piece else {
                return Some(Halt::at(k));
            };
            let (local, cause) = self.glide_over::<LEVEL>(&whole, shaking.time[k])?;
            if local < whole.left {
                return Some(Halt { k, local, cause });
            }
            k += 1;
        }
    }

    /// Go over a piece that begins at `time`; return how far that leads, and what ended the way if it is not to the end.
    #[inline(always)]
    fn glide_over<const LEVEL: bool>(&mut self, whole: &Piece<2>, time: f64) -> Option<(f64, Option<Ended>)> {
        let (mut local, mut cause) = (0.0, None);
        let here = |local, cause: Option<Cause>| Some((local, cause.map(|cause| (0, cause))));
        loop {
            let piece = whole.rest(local);
            let Some(leg) = self.next_leg::<LEVEL>(&piece, cause) else {
                return here(local, cause);
            };
            let Leg {
                mode, step, ended, ..
            } = leg;
            // An event at either end of a piece is left to the walk.
            if ended.is_some() && (step <= 0.0 || step >= piece.left || local + step >= whole.left) {
                return here(local, cause);
            }
            self.walk.mode = mode;
            self.turn_over(time + local);
            let s = &mut self.walk.summary;
            s.mode = mode;
            s.slip_stops += u64::from(cause == Some(Cause::Stop));
            if let Some([a0, a1]) = leg.slide {
                let velocity = s.velocity[SLIP];
                s.position[SLIP] += self.stretch.slide::<LEVEL>(velocity, [a0, a1], &piece, step);
                let slip = s.position[SLIP];
                s.slip_range = [s.slip_range[0].min(slip), s.slip_range[1].max(slip)];
                s.velocity[SLIP] = if ended.is_some() {
                    0.0
                } else {
                    velocity + step * (a0 + step * a1 / 2.0)
                };
            }
            if ended.is_none() {
                return here(whole.left, None);
            }
            let moved = local + step > local;
            local += step;
            cause = ended;
            if !self.count(moved) {
                self.walk.summary.end_time = time + local;
                return None;
            }
        }
    }

    /// How the block goes on after what ended the way here; `None` where a corner may not stay pressed.
    #[inline(always)]
    fn next_leg<const LEVEL: bool>(&self, piece: &Piece<2>, cause: Option<Cause>) -> Option<Leg> {
        let velocity = self.walk.summary.velocity[SLIP];
        match (cause, self.walk.mode) {
            (None, Mode::Rest) if velocity == 0.0 => self.lie::<LEVEL>(piece)?,
            (None, Mode::Slide(slip)) if velocity != 0.0 => self.slide::<LEVEL>(slip, piece)?,
            (None, _) => None,
            // Pressed at rest, it rocks about no corner.
            _ => self
                .lie::<LEVEL>(piece)
                .or_else(|| self.slide::<LEVEL>(Slip::Downstream, piece))
                .or_else(|| self.slide::<LEVEL>(Slip::Upstream, piece))?,
        }
    }

    /// How it lies on a piece where friction holds it; `Some(None)` where a corner may not stay pressed.
    #[inline(always)]
    fn lie<const LEVEL: bool>(&self, piece: &Piece<2>) -> Option<Option<Leg>> {
        let rest = self.reactions.of(Mode::Rest);
        if !all_along::<LEVEL>(&margins(rest), piece) {
            return Some(None);
        }
        let (mut step, mut ended) = (piece.left, None);
        for i in [CONE, CONE + 1] {
            let [value, slope] = felt::<LEVEL>(&rest.quantity(i), piece);
            if sign(value, slope * piece.left, TIE * rest.size[i]) < 0 {
                return None;
            }
            if value + slope * piece.left < -VIOLATION * rest.size[i] && slope < 0.0 {
                let t = event::linear(value, slope, piece.left);
                if t < step || ended.is_none() {
                    (step, ended) = (t, Some(Cause::Cone));
                }
            }
        }
        Some(Some(Leg {
            mode: Mode::Rest,
            slide: None,
            step,
            ended,
        }))
    }

    /// How it slides this way on a piece, if it can; `Some(None)` where a corner may not stay pressed.
    #[inline(always)]
    fn slide<const LEVEL: bool>(&self, slip: Slip, piece: &Piece<2>) -> Option<Option<Leg>> {
        let (mode, velocity) = (Mode::Slide(slip), self.walk.summary.velocity[SLIP]);
        let reaction = self.reactions.of(mode);
        let (way, size) = (reaction.way, reaction.size[ACCELERATION + SLIP]);
        let [value, slope] = felt::<LEVEL>(&reaction.quantity(ACCELERATION + SLIP), piece);
        let grows = if velocity == 0.0 {
            f64::from(sign(value, slope * piece.left, TIE * size))
        } else {
            velocity
        };
        if !reaction.regular || grows * way <= 0.0 {
            return None;
        }
        if !all_along::<LEVEL>(&margins(reaction), piece) {
            return Some(None);
        }
        let starts = if velocity == 0.0 { way } else { 0.0 };
        let [a0, a1] = begun(value, slope, size, starts, piece.left);
        let stop = event::quadratic(way * velocity, way * a0, way * a1 / 2.0, piece.left);
        Some(Some(Leg {
            mode,
            slide: Some([a0, a1]),
            step: stop.unwrap_or(piece.left),
            ended: stop.map(|_| Cause::Stop),
        }))
    }
}
