//! A block that flies, or rocks about a corner without slip, while its geometry or the water in the crack changes: power
//! series in time on each piece of the record.
//!
//! With the forces F on the block and their moment M about its centroid G, the horizontal e, the way d from G to the water
//! that moves with the block, `v = e . R(theta) d`, `u = dv/dtheta`, and the acceleration w of that water,
//!
//! `m G'' = F - m_w w e`, `J theta'' = M - m_w w u`, `w (1 + m_w/m + m_w u^2/J) = a + e . F/m + u M/J - theta'^2 v`
//!
//! in the air. About a corner that stays, from which d, M and the moment of inertia I count then,
//!
//! `(I + m_w u^2) theta'' = M + m_w u (theta'^2 v - a)`, `(T, N) = m G'' + m_w w e - F`, `w = a + v''`.
//!
//! The terms follow one after the other, those of sine and cosine by `s' = theta' c`, `c' = -theta' s` (Jorba and Zou, A
//! software package for the numerical integration of ODEs by means of high-order Taylor methods, Experimental Mathematics
//! 14, 2005). Events are roots of these series.

use super::super::mode::Corner;
use super::block::{Rotation, TurningBlock};
use super::power::{later, product, Series, Terms, MOST};
use super::shaking::{Ground, Piece};
use super::step::State;
use super::wetting::Wetting;
use crate::friction::INVERSE;
use crate::inside::Law;

/// Fewest that say whether it fades.
const FEWEST: usize = 2;
/// A series is long enough where its last two terms are no more than this part of its leading ones.
const FADED: f64 = 1e-15;
/// A series that has not come to an end is cut to this part of the length at which it would.
const SHORTER: f64 = 0.9;

/// A straight line in time: its start, and its change up to the end of the piece.
type Straight = [f64; 2];

/// Loads along and across the crack; the moment, that of the loads whose lever is the cosine, the sine of the rotation, one
/// or the rotation; the acceleration of the ground that the water feels.
struct Loads {
    force: [Straight; 2],
    turning: [Straight; 4],
    driven: Straight,
}

impl Loads {
    /// On a piece of the record, about the corner so far from the heel of a block that rocks, else about the centroid.
    fn on(block: &TurningBlock, from: f64, piece: &Piece, rocks: bool) -> Self {
        let [b, d] = [block.centroid[0] - from, block.centroid[1]];
        let ([e1, e2], middle) = (block.horizontal, 0.5 * block.width);
        let [lifting, about_heel] = match block.water.law {
            Law::Constant => block.water.force(0.0, 0.0),
            _ => [0.0; 2],
        };
        let under = |[across, up, spin]: Ground| {
            let down = block.gravity + up;
            let swing = [-spin * block.centroid[1], spin * (block.centroid[0] - middle)];
            let inertia = [
                -block.mass * (across * e1 - down * e2 + swing[0]),
                -block.mass * (across * e2 + down * e1 + swing[1]),
            ];
            let dead: [f64; 4] = std::array::from_fn(|i| block.dead[i] + up * block.per_vertical[i]);
            let still = [dead[0], dead[1] + lifting];
            let about = dead[2] - from * dead[1] + about_heel - from * lifting;
            let virial = dead[3] - from * dead[0];
            // Loads whose moment is not in that of the others already.
            let [f, g] = if rocks { inertia } else { still.map(|force| -force) };
            let [along, high] = [block.water_place[0] - middle, block.water_place[1]];
            [
                inertia[0] + still[0],
                inertia[1] + still[1],
                about - d * f + b * g,
                -virial - b * f - d * g,
                -block.inertia * spin,
                if block.rotation == Rotation::PDelta {
                    -block.mass * down * (b * e2 - d * e1)
                } else {
                    0.0
                },
                across + spin * (e2 * along - e1 * high),
            ]
        };
        let (start, end) = (under(piece.ground), under(piece.after(piece.left)));
        let [along, across, cosine, sine, still, angle, driven] =
            std::array::from_fn(|i| [start[i], end[i] - start[i]]);
        Loads {
            force: [along, across],
            turning: [cosine, sine, still, angle],
            driven,
        }
    }
}

/// Term n of a straight line.
fn line(straight: Straight, n: usize) -> f64 {
    straight.get(n).copied().unwrap_or_default()
}

/// Term n of a series times a straight line.
fn along(straight: Straight, series: &Terms, n: usize) -> f64 {
    let before = if n > 0 { series[n - 1] } else { 0.0 };
    straight[0] * series[n] + straight[1] * before
}

/// The series of a motion as they grow term by term, in the time over the length of the piece.
pub(super) struct Unfolding<'a> {
    block: &'a TurningBlock,
    rocks: bool,
    finite: bool,
    unit: f64,
    loads: Loads,
    /// Distance of the corner from the heel.
    from: f64,
    /// Place of the centroid from the corner, along and across the crack.
    centroid: [f64; 2],
    /// Of d: along and across the horizontal.
    water: [f64; 2],
    inertia: f64,
    wetting: Option<Wetting<'a>>,
    /// Displacement of the corner along and across the crack, rotation; how much that lifts a point of the base, per
    /// distance ahead of the corner, its sine or itself.
    moved: [Series; 3],
    lift: Series,
    spin: Terms,
    cosine: Terms,
    /// Displacement of the centroid by the rotation, v, u, u^2 and the square of the rate of rotation.
    lever: [Terms; 2],
    v: Terms,
    u: Terms,
    u_square: Terms,
    spin_square: Terms,
    /// Force across the crack, moment, acceleration of rotation and of the water.
    across: Terms,
    moment: Terms,
    turns: Terms,
    felt: Terms,
    /// Velocity of the centroid and of the water.
    pace: [Terms; 3],
    power: Series,
    heel: Terms,
    /// Friction and normal force at the corner of a block that rocks.
    borne: [Series; 2],
}

impl<'a> Unfolding<'a> {
    /// Begin at a state, seen from a corner that stays where the block `rocks`, on a piece of the record.
    pub(super) fn new(
        block: &'a TurningBlock,
        corner: Corner,
        state: &State,
        piece: &Piece,
        rocks: bool,
    ) -> Self {
        let from = block.place(corner);
        let centroid = [block.centroid[0] - from, block.centroid[1]];
        let base = if rocks { [from, 0.0] } else { block.centroid };
        let [to, up] = [0, 1].map(|i| block.water_place[i] - base[i]);
        let [e1, e2] = block.horizontal;
        let mut inertia = block.inertia;
        if rocks {
            inertia += block.mass * (centroid[0] * centroid[0] + centroid[1] * centroid[1]);
        }
        let unit = piece.left;
        let none = [0.0; MOST];
        let mut moved = [Series::NONE; 3];
        for (i, series) in moved.iter_mut().enumerate() {
            [series.terms[0], series.terms[1]] = [state[i], unit * state[i + 3]];
        }
        let (mut spin, mut cosines, mut lift) = (none, none, Series::NONE);
        spin[0] = unit * state[5];
        [lift.terms[0], cosines[0]] = block.turned(state[2]);
        let mut all = Unfolding {
            block,
            rocks,
            finite: block.rotation == Rotation::Finite,
            unit,
            loads: Loads::on(block, from, piece, rocks),
            from,
            centroid,
            water: [e1 * to + e2 * up, e2 * to - e1 * up],
            inertia,
            wetting: None,
            moved,
            lift,
            spin,
            cosine: cosines,
            lever: [none; 2],
            v: none,
            u: none,
            u_square: none,
            spin_square: none,
            across: none,
            moment: none,
            turns: none,
            felt: none,
            pace: [none; 3],
            power: Series::NONE,
            heel: none,
            borne: [Series::NONE; 2],
        };
        all.turn(0);
        all.turn(1);
        if block.water.law != Law::Constant {
            let open = |k: usize| {
                let slope = all.lift.terms[k];
                [all.moved[1].terms[k] - from * slope, slope]
            };
            all.wetting = Some(Wetting::new(&block.water, open(0), open(1)));
        }
        all
    }

    /// Find the terms n of what goes by the rotation, whose own are known up to there.
    fn turn(&mut self, n: usize) {
        let [b, d] = self.centroid;
        let [near, far] = self.water;
        if self.finite {
            if n > 0 {
                let sine = &mut self.lift.terms;
                sine[n] = product(&self.spin, &self.cosine, n - 1) * INVERSE[n];
                self.cosine[n] = -product(&self.spin, sine, n - 1) * INVERSE[n];
            }
            let (s, c) = (self.lift.terms[n], self.cosine[n]);
            self.lever[0][n] = b * c - d * s;
            self.lever[1][n] = b * s + d * c;
            self.v[n] = near * c + far * s;
            self.u[n] = far * c - near * s;
        } else {
            let theta = self.moved[2].terms[n];
            self.lift.terms[n] = theta;
            self.lever[0][n] = -d * theta;
            self.lever[1][n] = b * theta;
            self.v[n] = far * theta;
            self.u[n] = if n == 0 { far } else { 0.0 };
        }
    }

    /// Second rate of change of a series, its term n.
    fn bend(&self, series: &Terms, n: usize) -> f64 {
        ((n + 1) * (n + 2)) as f64 * series[n + 2] / (self.unit * self.unit)
    }

    /// How long the term n of the way of the block is.
    fn length(&self, n: usize) -> f64 {
        let [along, across, turn] = [0, 1, 2].map(|i| self.moved[i].terms[n].abs());
        let turned = self.lift.terms[n].abs() + self.cosine[n].abs();
        along + across + self.block.width * (turn + turned)
    }

    /// Find the term n of all accelerations, and what follows of it; returns how much it changes them over the piece.
    fn step(&mut self, n: usize) -> f64 {
        let square = self.unit * self.unit;
        let Loads {
            force,
            turning: [by_cosine, by_sine, still, by_angle],
            ..
        } = self.loads;
        let water = self.block.water_mass;
        let [lifting, about] = self.press(n);
        self.across[n] = line(force[1], n) + lifting;
        self.moment[n] = along(by_cosine, &self.cosine, n) + line(still, n) + about;
        // Where it is small the lift is the rotation.
        let by_lift = if self.finite { by_sine } else { by_angle };
        self.moment[n] += along(by_lift, &self.lift.terms, n);
        if water != 0.0 {
            if self.finite || n == 0 {
                self.u_square[n] = product(&self.u, &self.u, n);
            }
            if self.finite {
                self.spin_square[n] = product(&self.spin, &self.spin, n);
            }
        }
        let whirl = if self.finite && water != 0.0 {
            product(&self.spin_square, &self.v, n) / square
        } else {
            0.0
        };
        if self.rocks {
            self.rock(n, whirl);
        } else {
            self.fly(n, whirl);
        }
        self.drive(n);
        ((n + 1) * (n + 2)) as f64 * self.length(n + 2)
    }

    /// Force of the water that follows the opening across the crack, and its moment about what the moments are about.
    fn press(&mut self, n: usize) -> [f64; 2] {
        self.heel[n] = self.moved[1].terms[n] - self.from * self.lift.terms[n];
        let Some(wetting) = &mut self.wetting else {
            return [0.0; 2];
        };
        wetting.unfold(n, &self.heel, &self.lift.terms);
        let Wetting {
            force, about_heel, ..
        } = wetting;
        let mut ahead = self.from;
        if !self.rocks {
            ahead += self.centroid[0];
        }
        let lever = |k: usize| about_heel[k] - ahead * force[k];
        if !self.finite {
            return [force[n], lever(n)];
        }
        let mut moment = (0..=n).map(|k| lever(k) * self.cosine[n - k]).sum();
        if !self.rocks {
            moment += self.centroid[1] * product(&self.lift.terms, force, n);
        }
        [force[n], moment]
    }

    fn fly(&mut self, n: usize, whirl: f64) {
        let (mass, water) = (self.block.mass, self.block.water_mass);
        let [e1, e2] = self.block.horizontal;
        let push = [line(self.loads.force[0], n), self.across[n]];
        let mut turned = self.moment[n];
        if water != 0.0 {
            let pushed = (e1 * push[0] + e2 * push[1]) / mass;
            let driven = line(self.loads.driven, n);
            let mut felt = driven + pushed + product(&self.u, &self.moment, n) / self.inertia - whirl;
            let per = water / self.inertia;
            felt -= per * later(&self.u_square, &self.felt, n);
            self.felt[n] = felt / (1.0 + water / mass + per * self.u_square[0]);
            turned -= water * product(&self.u, &self.felt, n);
        }
        let turns = turned / self.inertia;
        self.spread(n, turns);
        let drag = water * self.felt[n];
        let square = self.unit * self.unit * INVERSE[n + 1] * INVERSE[n + 2];
        let moves = [(push[0] - drag * e1) / mass, (push[1] - drag * e2) / mass];
        self.moved[0].terms[n + 2] = square * moves[0] - self.lever[0][n + 2];
        self.moved[1].terms[n + 2] = square * moves[1] - self.lever[1][n + 2];
    }

    fn rock(&mut self, n: usize, whirl: f64) {
        let (mass, water) = (self.block.mass, self.block.water_mass);
        let [e1, e2] = self.block.horizontal;
        let driven = line(self.loads.driven, n);
        let mut turned = self.moment[n];
        let mut inertia = self.inertia;
        if water != 0.0 {
            self.felt[n] = whirl - driven;
            turned += water * product(&self.u, &self.felt, n);
            turned -= water * later(&self.u_square, &self.turns, n);
            inertia += water * self.u_square[0];
        }
        let turns = turned / inertia;
        self.spread(n, turns);
        let drag = water * (driven + self.bend(&self.v, n));
        let [rise_1, rise_2] = [0, 1].map(|i| mass * self.bend(&self.lever[i], n));
        self.borne[0].terms[n] = rise_1 + drag * e1 - line(self.loads.force[0], n);
        self.borne[1].terms[n] = rise_2 + drag * e2 - self.across[n];
    }

    /// Take over the term n of the acceleration of rotation.
    fn spread(&mut self, n: usize, turns: f64) {
        self.turns[n] = turns;
        self.spin[n + 1] = self.unit * self.unit * turns * INVERSE[n + 1];
        self.moved[2].terms[n + 2] = self.spin[n + 1] * INVERSE[n + 2];
        self.turn(n + 2);
    }

    /// Find the term n of the power of the loads.
    fn drive(&mut self, n: usize) {
        let water = self.block.water_mass;
        let driven = self.loads.driven;
        self.power.terms[n] = product(&self.moment, &self.spin, n);
        let next = (n + 1) as f64;
        if self.rocks {
            self.pace[2][n] = next * self.v[n + 1];
        } else {
            let [e1, e2] = self.block.horizontal;
            self.pace[0][n] = next * (self.moved[0].terms[n + 1] + self.lever[0][n + 1]);
            self.pace[1][n] = next * (self.moved[1].terms[n + 1] + self.lever[1][n + 1]);
            self.pace[2][n] = next * self.v[n + 1] + e1 * self.pace[0][n] + e2 * self.pace[1][n];
            self.power.terms[n] += along(self.loads.force[0], &self.pace[0], n);
            self.power.terms[n] += product(&self.across, &self.pace[1], n);
        }
        self.power.terms[n] -= water * along(driven, &self.pace[2], n);
    }

    /// All terms that matter; none where they say nothing.
    pub(super) fn grown(mut self) -> Option<Flight> {
        let mut size = self.length(1);
        let (mut n, mut before) = (0, f64::INFINITY);
        let last = loop {
            let now = self.step(n);
            if n < FEWEST {
                size += now;
            }
            let last = now + before;
            if n >= FEWEST && last <= FADED * size || n + 3 == MOST {
                break last;
            }
            (n, before) = (n + 1, now);
        };
        if !(size.is_finite() && last.is_finite()) || size == 0.0 {
            return None;
        }
        let part = if last > FADED * size {
            SHORTER * (FADED * size / last).powf(1.0 / n as f64)
        } else {
            1.0
        };
        for series in self.moved.iter_mut().chain([&mut self.lift]) {
            series.end(n + 3, part);
        }
        for series in self.borne.iter_mut().chain([&mut self.power]) {
            series.end(n + 1, part);
        }
        let mut flight = Flight {
            length: part * self.unit,
            moved: self.moved,
            lift: self.lift,
            power: self.power.scaled(1.0 / self.unit),
            borne: self.rocks.then_some(self.borne),
            error: last.min(FADED * size),
            bends: Vec::new(),
        };
        if let Some(wetting) = &self.wetting {
            let from = self.from;
            flight.bends = wetting.bends(|place| flight.gap(place - from));
        }
        Some(flight)
    }
}

/// Flight or rocking on a piece of the record, in the time over its length.
pub(super) struct Flight {
    /// How long it holds (s).
    pub length: f64,
    /// Displacement of the corner along and across the crack, rotation.
    moved: [Series; 3],
    /// What the rotation lifts a point by, per distance ahead of the corner.
    lift: Series,
    /// Of the loads, per second.
    power: Series,
    /// Friction and normal force at the corner of a block that rocks.
    pub borne: Option<[Series; 2]>,
    /// What the last terms come to (m).
    pub error: f64,
    /// What is above zero as long as the water's force has no kink.
    pub bends: Vec<Series>,
}

impl Flight {
    /// The state after so much time.
    pub(super) fn state_after(&self, start: &State, since: f64) -> State {
        self.state(start, since / self.length)
    }

    /// The state at a part of its length.
    pub(super) fn state(&self, start: &State, t: f64) -> State {
        let mut state = *start;
        for (i, series) in self.moved.iter().enumerate() {
            state[i] = series.at(t);
            state[i + 3] = series.rate(t) / self.length;
        }
        state[6] += self.length * self.power.integral(t);
        state
    }

    /// How far slip, gaps and rotation can go, of a crack so wide.
    pub(super) fn swing(&self, width: f64) -> [f64; 4] {
        let [along, across, turn] = [0, 1, 2].map(|i| self.moved[i].swing());
        let gap = across + width * self.lift.swing();
        [along + width * turn, gap, gap, turn]
    }

    /// How far a point of the base is open that lies so far ahead of the corner.
    pub(super) fn gap(&self, ahead: f64) -> Series {
        self.moved[1].plus(&self.lift, ahead)
    }
}
