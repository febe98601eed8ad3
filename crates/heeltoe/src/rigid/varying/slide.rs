//! A slide by a law that is a straight line over the path: exact, there is no step size.
//!
//! Where friction falls linearly with the path r since the start, or not at all, and the ground's acceleration is linear
//! in time, so is the slip's, `r'' = p + q t + k r`, and every force: [`super::curve::Curve`]. The next event is the earliest
//! root of the slip velocity, a normal force, and the way that is left up to a corner of the law.

use super::super::block::{Vector, HEEL, SLIP};
use super::super::choice::VIOLATION;
use super::super::mode::Mode;
use super::super::walk::Cause;
use super::advance::Trial;
use super::line::{Felt, Force, Line, Slide, CLEAR};
use super::shaking::{Ground, Piece, TurningShaking};
use super::step::{State, SIZE};
use super::walk::Varying;

impl Varying<'_> {
    /// The slide from the present state on, if it has a closed form; a slip that starts does so with the acceleration of
    /// `fresh`, freed from rounding.
    pub(super) fn closed_slide(&self, piece: &Piece, fresh: Option<Vector>) -> Option<Slide> {
        let Mode::Slide(slip) = self.walk.mode else {
            return None;
        };
        let (way, state) = (slip.sign(), self.state);
        let line = self.line(way, piece)?;
        let path = self.rubbing.worn.path;
        let speed = way * state[3];
        let begins = fresh.filter(|_| speed == 0.0).map(|all| all[SLIP]);
        line.slide(way, path, speed, begins, piece)
    }

    /// Whether the block lies on both corners of a plane crack that no anchor crosses: what it feels does not go by where
    /// it is then.
    pub(super) fn lies_plainly(&self) -> bool {
        self.state[2] == 0.0 && self.rough.is_none() && self.turning.anchors.is_empty()
    }

    /// What is felt sliding this way, where that is a straight line; kept as long as that holds.
    fn line(&self, way: f64, piece: &Piece) -> Option<Line> {
        let rubbing = &self.rubbing;
        let [across, up, spin] = piece.rate;
        // Where friction changes with the path and the normal force with the ground, their product does, too.
        let product = !rubbing.straight(false);
        let even = spin == 0.0 && self.walk.block.presses_evenly([across, up]);
        if !self.lies_plainly() || !rubbing.straight(even) {
            return None;
        }
        let (corner, path) = (rubbing.corner(), rubbing.worn.path);
        let place = usize::from(way < 0.0);
        let ground = product.then_some([piece.ground[1], piece.ground[2]]);
        let bonded = rubbing.worn.bonded;
        let same = |line: &Line| line.corner == corner && line.bonded == bonded && line.ground == ground;
        if let Some(line) = self.lines[place].get().filter(same) {
            return Some(line);
        }
        let state = self.state;
        let reach = corner - path;
        let base = if product {
            [0.0, piece.ground[1], piece.ground[2]]
        } else {
            [0.0; 3]
        };
        let now = self.felt_sliding(&state, &base)?;
        let mut per_ground = [[0.0; 5]; 3];
        for (k, per) in per_ground.iter_mut().enumerate() {
            let mut unit = base;
            unit[k] += 1.0;
            let felt = self.felt_sliding(&state, &unit)?;
            *per = std::array::from_fn(|i| felt[i] - now[i]);
        }
        let mut per_path = [0.0; 5];
        if reach.is_finite() {
            let mut further = state;
            further[0] += way * reach;
            let there = self.felt_sliding(&further, &base)?;
            per_path = std::array::from_fn(|i| (there[i] - now[i]) / reach);
        }
        let line = Line {
            still: std::array::from_fn(|i| now[i] - (1..3).map(|k| per_ground[k][i] * base[k]).sum::<f64>()),
            path,
            per_ground,
            per_path,
            corner,
            bonded,
            ground,
        };
        self.lines[place].set(Some(line));
        Some(line)
    }

    /// Reactions, the load along the crack and the acceleration, sliding at a state of the present step.
    fn felt_sliding(&self, state: &State, ground: &Ground) -> Option<Felt> {
        let instant = self.turning.at(self.corner, state, ground);
        let (reactions, _) = self.rubbed(self.walk.mode, state, &instant)?;
        let [friction, heel, toe] = reactions;
        let [acceleration, ..] = instant.acceleration(&reactions);
        Some([friction, heel, toe, instant.pushed(), acceleration])
    }

    /// While the block slides clear of every event, do what would be done piece by piece; return the last sample before that
    /// may end, and how far behind it.
    pub(super) fn slide_until(&mut self, shaking: &TurningShaking, from: usize) -> (usize, f64) {
        let clear = CLEAR * self.walk.block.force_scale;
        let (time, kind) = (shaking.level.time, self.walk.mode.kind());
        let (mut k, mut local) = (from, 0.0);
        while k + 1 < time.len() {
            if time[k + 1] <= time[k] {
                k += 1;
                continue;
            }
            let whole = shaking.piece(k);
            let piece = whole.rest(local);
            let (before, since) = (self.state[0], time[k] + local);
            let slid = match self.closed_slide(&piece, None) {
                Some(slide) => self.slide_through(&slide, &piece, clear, since),
                None => self.series_through(&piece, since),
            };
            let Some(taken) = slid else {
                break;
            };
            self.book();
            self.walk.summary.slip_by_mode[kind] += self.state[0] - before;
            self.walk.summary.time_by_mode[kind] += taken;
            if taken == piece.left {
                (k, local) = (k + 1, 0.0);
            } else {
                local += taken;
            }
        }
        if k > from || local > 0.0 {
            self.see();
            let at = self.walk.summary.position;
            // It goes one way alone.
            self.walk.summary.widen(&at, self.state[2]);
        }
        (k, local)
    }

    /// Slide through a piece, if nothing ends the slide before, and return how long that took; none where something may.
    fn slide_through(&mut self, slide: &Slide, piece: &Piece, clear: f64, time: f64) -> Option<f64> {
        if !slide.goes_on(piece, clear) {
            return None;
        }
        let start = self.state;
        self.record(&start, piece, time + piece.left, time);
        let end = slide.state(&start, piece.left);
        self.wear(&end);
        self.error.slip += self.error.speed * piece.left;
        self.state = end;
        Some(piece.left)
    }

    /// Slide on to the next event, or as long as that holds; returns the time that took and what ended it.
    pub(super) fn slide_on(&mut self, slide: &Slide, piece: &Piece, time: f64) -> (f64, Option<Cause>) {
        let (at, cause) = self.first_of_slide(slide);
        let turns_corner = cause.is_none() && at < slide.length;
        let mut end = slide.state(&self.state, at);
        if cause == Some(Cause::Stop) {
            end[3] = 0.0;
        }
        let trial = Trial::still(self.state, [0.0; SIZE], slide.length, piece);
        self.move_on(&trial, &end, at, time);
        if turns_corner {
            self.turn_corner(slide.corner);
        }
        (at, cause)
    }

    /// When the slide ends, and what ends it before its time.
    fn first_of_slide(&self, slide: &Slide) -> (f64, Option<Cause>) {
        let Slide {
            path,
            reach,
            length,
            reactions,
            ..
        } = slide;
        let mut first = (*length, None);
        let mut note = |t: Option<f64>, why: Option<Cause>| {
            if let Some(t) = t.filter(|t| *t < first.0 || *t == first.0 && first.1.is_none()) {
                first = (t, why);
            }
        };
        if reach.is_finite() {
            note(path.affine(*reach, 0.0, -1.0).first_fall(*length, 0.0), None);
        }
        note(path.derivative().first_fall(*length, 0.0), Some(Cause::Stop));
        for Force {
            start,
            per_time,
            per_path,
        } in &reactions[HEEL..]
        {
            let size = self.walk.block.force_scale.max(start.abs());
            let normal = path.affine(*start, *per_time, *per_path);
            note(normal.first_fall(*length, VIOLATION * size), Some(Cause::Normal));
        }
        first
    }
}
