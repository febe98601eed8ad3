//! A block of which one corner lies, or none: how it goes on in a mode, whether it can, and its events.
//!
//! | mode | along, across | corner |
//! | --- | --- | --- |
//! | rock | stick: `T_x` as without the shaking across, `T_y = m a_y`, `T_x^2 + T_y^2 <= mu_s^2 N^2` | N |
//! | slide-rock | [`super::rubbing`]; where nothing moves across, as without it | N |
//! | drift | `y'' = -a_y` | none |
//!
//! All that moves, and all forces, are polynomials in time on a stretch.

use super::super::block::{HEEL, SLIP, TOE};
use super::super::choice::{accelerations, admissible, Moving, HAIR, TIE};
use super::super::event;
use super::super::mode::{Corner, Mode, Slip};
use super::super::reaction::Felt;
use super::super::shaking::Piece;
use super::super::walk::Cause;
use super::aloft::{rises, Lifted, SPEED};
use super::polynomial::{Polynomial, TERMS};
use super::rubbing::{self, Contact, Slide, ACROSS};
use super::series::Bounds;
use super::start::REST;
use super::walk::{Going, Here, Plane, SIDES};

impl Plane<'_> {
    /// Which corners lie.
    pub(super) fn lying(&self) -> [bool; 2] {
        let s = &self.walk.summary;
        [HEEL, TOE].map(|gap| s.position[gap] == 0.0 && s.velocity[gap] == 0.0)
    }

    /// The first mode, off one corner or both, in which the block can go on; none is a Painlevé paradox.
    pub(super) fn lift(&self, here: &Here) -> Option<Lifted> {
        use Corner::{Heel, Toe};
        use Slip::{Downstream, Upstream};
        let closed = self.lying();
        let u = self.velocity();
        let modes = [
            Mode::Rock(Heel),
            Mode::Rock(Toe),
            Mode::SlideRock(Heel, Downstream),
            Mode::SlideRock(Heel, Upstream),
            Mode::SlideRock(Toe, Downstream),
            Mode::SlideRock(Toe, Upstream),
            Mode::Drift,
        ];
        [TIE, HAIR].into_iter().find_map(|tie| {
            modes.into_iter().find_map(|mode| {
                let [heel, toe] = mode.contacts();
                if heel && !closed[0] || toe && !closed[1] || mode.sticks() && u != [0.0; 2] {
                    return None;
                }
                self.admissible(mode, here, tie)
            })
        })
    }

    /// The motion in a mode if the block can go on in it.
    fn admissible(&self, mode: Mode, here: &Here, tie: f64) -> Option<Lifted> {
        let mut lifted = self.lifted(mode, here)?;
        if !lifted.curved {
            let piece = along(here);
            let moving = Moving {
                closed: self.lying(),
                velocity: self.velocity()[0],
                piece: &piece,
            };
            let reaction = self.reactions.of(mode);
            let holds = admissible(reaction, &moving, tie, &mut Felt::default());
            return (holds && (!mode.sticks() || self.grips(&mut lifted, here, tie))).then_some(lifted);
        }
        let lies = lifted.lies()?;
        let other = HEEL + TOE - lies;
        let block = self.walk.block;
        let part = self.contact(lies, here).regular(self.way(&lifted)[0])?;
        let mut normal = [0, 1].map(|k| lifted.force[k][lies]);
        let pushed = rises(&mut normal, here.left, tie * block.force_scale / part);
        let mut gap = [1, 2].map(|k| lifted.velocity[k][other]);
        let closed = self.lying() == [true; 2];
        let leaves = !closed || rises(&mut gap, here.left, tie * block.acceleration_scale() / part);
        for k in 0..2 {
            lifted.force[k][lies] = normal[k];
            lifted.velocity[k + 1][other] = gap[k];
        }
        (pushed && leaves).then_some(lifted)
    }

    /// Whether the cone of friction holds a corner that sticks.
    fn grips(&self, lifted: &mut Lifted, here: &Here, tie: f64) -> bool {
        let [x, n, m, y] = lifted.force[0];
        let hold = self.friction[0] * (n + m);
        let [spare, change, bend] = lifted.cone;
        let mut start = [spare, change];
        let grips = rises(&mut start, here.left, tie * (x * x + y * y + hold * hold));
        lifted.cone = [start[0], start[1], bend];
        grips
    }

    /// The direction in which it slides or begins to.
    fn way(&self, lifted: &Lifted) -> [f64; 2] {
        let first = lifted.velocity.iter().find(|term| term[SPEED] != 0.0);
        first.map_or([0.0; 2], |term| {
            [term[SLIP] / term[SPEED], term[ACROSS] / term[SPEED]]
        })
    }

    /// How the block moves in a mode; none where friction jams it or does not let it begin.
    pub(super) fn lifted(&self, mode: Mode, here: &Here) -> Option<Lifted> {
        let u = self.velocity();
        let [push, slope] = here.forces.push[1];
        let still = self.side != 0.0 || [push, slope, u[1]] == [0.0; 3];
        match (mode, mode.slip()) {
            (Mode::SlideRock(corner, _), Some(_)) if !still => self.slides(corner, here, u),
            _ => Some(self.straight(mode, here, still)),
        }
    }

    /// The contact of a corner that slides.
    fn contact(&self, lies: usize, here: &Here) -> Contact {
        let block = self.walk.block;
        let [ground, rate] = [here.ground, here.rate];
        let mut free = [[0.0; 2]; 4];
        for (free, b) in free.iter_mut().zip(&block.free_acceleration) {
            *free = [b.at([ground[0], ground[1]]), b.slope([rate[0], rate[1]])];
        }
        free[ACROSS] = here.forces.push[1];
        Contact {
            compliance: block.compliance,
            gaps: [lies, HEEL + TOE - lies],
            per_mass: 1.0 / self.across.mass,
            friction: self.friction[1],
            free,
        }
    }

    /// A corner that slides any way.
    fn slides(&self, corner: Corner, here: &Here, u: [f64; 2]) -> Option<Lifted> {
        let lies = corner.gap();
        let contact = self.contact(lies, here);
        let other = contact.gaps[1];
        let gap = self.walk.summary.velocity[other];
        let slide = if u == [0.0; 2] {
            rubbing::begin(&contact, gap, here.left, self.fastest)?
        } else {
            let bounds = Bounds::new(self.fastest.max(u[0].hypot(u[1])), self.crossing.path);
            rubbing::go_on(&contact, u, gap, here.left, bounds)?
        };
        let Slide {
            length,
            velocity,
            friction,
            normal,
        } = slide;
        let mut lifted = Lifted {
            mode: Mode::SlideRock(corner, Slip::Downstream),
            length,
            velocity: [[0.0; 5]; TERMS],
            force: [[0.0; 4]; TERMS],
            cone: [0.0; 3],
            stops: false,
            curved: true,
        };
        for k in 0..TERMS {
            let [x, y, gap, speed] = velocity[k];
            let v = &mut lifted.velocity[k];
            (v[SLIP], v[other], v[ACROSS], v[SPEED]) = (x, gap, y, speed);
            let f = &mut lifted.force[k];
            (f[SLIP], f[lies], f[ACROSS]) = (friction[k][0], normal[k], friction[k][1]);
        }
        // To turn on the way is no event.
        let end = lifted.rate(SLIP).at(length);
        let way = match self.walk.mode {
            Mode::SlideRock(_, way) | Mode::Slide(way) if u != [0.0; 2] => way,
            _ if end < 0.0 => Slip::Upstream,
            _ => Slip::Downstream,
        };
        lifted.mode = Mode::SlideRock(corner, way);
        Some(lifted)
    }

    /// A motion of which the ground's is all that is felt across the valley, if anything is: by the reactions of the modes.
    fn straight(&self, mode: Mode, here: &Here, still: bool) -> Lifted {
        let u = self.velocity();
        let piece = along(here);
        let reaction = self.reactions.of(mode);
        let mut felt = Felt::default();
        reaction.on(&piece, &mut felt);
        let closed = self.lying();
        let free = mode.free();
        let starts = [
            if free[SLIP] && u[0] == 0.0 {
                reaction.way
            } else {
                0.0
            },
            f64::from(free[HEEL] && closed[0]),
            f64::from(free[TOE] && closed[1]),
        ];
        let motion = accelerations(reaction, &felt, starts, here.left);
        let mut lifted = Lifted {
            mode,
            length: here.left,
            velocity: [[0.0; 5]; TERMS],
            force: [[0.0; 4]; TERMS],
            cone: [0.0; 3],
            stops: false,
            curved: false,
        };
        let v = &mut lifted.velocity;
        for i in [SLIP, HEEL, TOE].into_iter().filter(|i| free[*i]) {
            (v[0][i], v[1][i], v[2][i]) = (self.walk.summary.velocity[i], motion[i][0], 0.5 * motion[i][1]);
        }
        let f = &mut lifted.force;
        for (i, normal) in [(SLIP, false), (HEEL, true), (TOE, true)] {
            (f[0][i], f[1][i]) = (felt.value[i], felt.slope[i]);
            if normal && f[0][i].abs() <= HAIR * reaction.size[i] {
                f[0][i] = f[0][i].max(0.0);
            }
        }
        let [push, slope] = here.forces.push[1];
        match mode {
            Mode::Drift if self.side == 0.0 => {
                (v[0][ACROSS], v[1][ACROSS], v[2][ACROSS]) = (u[1], push, 0.5 * slope);
            }
            Mode::Rock(_) => {
                if !still {
                    (f[0][ACROSS], f[1][ACROSS]) = (-self.across.mass * push, -self.across.mass * slope);
                }
                lifted.cone = cone(self.friction[0], &lifted.force);
            }
            Mode::SlideRock(..) => {
                let way = reaction.way;
                for term in &mut lifted.velocity {
                    term[SPEED] = way * term[SLIP];
                }
                let [a0, a1] = motion[SLIP];
                let stop = event::quadratic(way * u[0], way * a0, way * a1 / 2.0, here.left);
                lifted.length = stop.unwrap_or(here.left);
                lifted.stops = stop.is_some();
            }
            _ => {}
        }
        if self.side != 0.0 {
            let held = self.held_for(here);
            lifted.stops &= lifted.length <= held;
            lifted.length = lifted.length.min(held);
        }
        lifted
    }

    /// The first event on a stretch, or its end.
    fn first_lifted_event(&self, lifted: &Lifted) -> (f64, Option<Cause>) {
        let (mut step, mut cause) = (lifted.length, None);
        let mut falls = |polynomial: &Polynomial, why: Cause| {
            if let Some(t) = polynomial.falls(step) {
                (step, cause) = (t, Some(why));
            }
        };
        let s = &self.walk.summary;
        for gap in [HEEL, TOE] {
            if lifted.lies() == Some(gap) {
                falls(&lifted.pull(gap), Cause::Normal);
            } else {
                let way = Polynomial::place(s.position[gap], &lifted.rate(gap));
                falls(&way, Cause::Gap(gap));
            }
        }
        if lifted.mode.sticks() {
            falls(&Polynomial::new(lifted.cone.into_iter()), Cause::Cone);
        }
        for ((number, side), gap) in SIDES.into_iter().zip(self.across.gap) {
            let room = (gap - side * self.crossing.position).max(0.0);
            if self.side == 0.0 && room.is_finite() {
                let rate = lifted.rate(ACROSS).times(-side);
                falls(&Polynomial::place(room, &rate), Cause::Gap(number));
            }
        }
        (step, cause)
    }

    /// Move to the next event or to the end of a stretch, and keep what there is to keep; returns the time that took, and
    /// what ended it.
    pub(super) fn go_on_lifted(&mut self, here: &Here, lifted: &Lifted, time: f64) -> (f64, Option<Cause>) {
        let (step, cause) = self.first_lifted_event(lifted);
        if self.walk.observed() {
            self.record(here, &Going::Lifted(*lifted), time + step, time);
        }
        self.walk.summary.time_by_mode[lifted.mode.kind()] += step;
        self.take_side(here, step);
        self.move_lifted(here, lifted, step);
        if let Some(Cause::Gap(gap @ (HEEL | TOE))) = cause {
            self.walk.summary.position[gap] = 0.0;
        }
        let [along, across] = self.velocity();
        let crawls = along * along + across * across < REST * REST;
        let slides = lifted.mode.slip().is_some();
        let stands = lifted.stops && step >= lifted.length;
        if slides && cause.is_none() && (stands || lifted.curved && crawls && step > 0.0) {
            self.stand();
            return (step, Some(Cause::Stop));
        }
        (step, cause)
    }
}

/// The rest of the cone of friction, `mu^2 N^2 - T_x^2 - T_y^2`, of forces that are linear in time.
fn cone(friction: f64, force: &[[f64; 4]; TERMS]) -> [f64; 3] {
    let [a, b] = [0, 1].map(|k| {
        let [x, heel, toe, y] = force[k];
        [friction * (heel + toe), x, y]
    });
    let product = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] - p[1] * q[1] - p[2] * q[2];
    [product(a, a), 2.0 * product(a, b), product(b, b)]
}

/// The ground along the stream and upward.
fn along(here: &Here) -> Piece<2> {
    Piece {
        ground: [here.ground[0], here.ground[1]],
        rate: [here.rate[0], here.rate[1]],
        left: here.left,
    }
}
