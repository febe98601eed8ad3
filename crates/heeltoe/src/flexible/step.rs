//! The walk through time with exact contact: Moreau-Jean on velocity level.
//!
//! For each mode, with `v* = theta v' + (1 - theta) v`,
//!
//! ```text
//! v' - v = -dt (omega^2 (q + theta dt v*) + c v*) + dt f - gamma dV + shapes^T p,      q' - q = dt v*
//! ```
//!
//! where `dV` is the change of the ground's velocity in the step, exact for any record. Without contact `v' = v_f`;
//! contact adds `D shapes^T p` with `D = 1 / (1 + theta dt c + theta^2 dt^2 omega^2)`. The normal condition
//! `u_n' >= -h` has
//!
//! ```text
//! h = max(g, 0) / dt,   at least (1 - theta) / theta u_n
//! ```
//!
//! (`g` the gap, `u_n` the velocity before): a gap may close but not be passed, and a node that has just left cannot
//! be thrown back so that contact would do positive work. Nothing rebounds at a node: the waves in the concrete do
//! that.

use super::acting::Acting;
use super::contact::relative;
use super::coupling::{Answer, WithoutContact};
use super::dam::{Dam, Shaking, Wanted};
use super::dampers::Dampers;
use super::ledger::Ledger;
use super::moving::{Drive, Moving, TimeStep};
use super::result::Run;
use super::sides::Sides;
use super::start::Still;
use super::status::Status;
use super::walk::Walk;

/// Shake the dam; `theta` is the weight of the new state within a step.
pub(super) fn simulate(dam: &Dam, shaking: &Shaking, theta: f64, wanted: Wanted) -> Run {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("fma") {
            // Safety: the machine has what the function is compiled for.
            return unsafe { simulate_avx512(dam, shaking, theta, wanted) };
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // Safety: as above.
            return unsafe { simulate_avx2(dam, shaking, theta, wanted) };
        }
    }
    run::<false>(dam, shaking, theta, wanted)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx2,fma")]
fn simulate_avx512(dam: &Dam, shaking: &Shaking, theta: f64, wanted: Wanted) -> Run {
    run::<true>(dam, shaking, theta, wanted)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn simulate_avx2(dam: &Dam, shaking: &Shaking, theta: f64, wanted: Wanted) -> Run {
    run::<true>(dam, shaking, theta, wanted)
}

#[inline(always)]
fn run<const FUSED: bool>(dam: &Dam, shaking: &Shaking, theta: f64, wanted: Wanted) -> Run {
    let mut moreau = Moreau::new(dam, shaking, theta, wanted);
    moreau.go_on::<FUSED>(None, 0, 0);
    if moreau.walk.observed() {
        moreau.ledger.stored = moreau.ledger.start;
        let start = moreau.ledger;
        moreau.keep(&start);
    }
    for step in 0..shaking.ground.len() {
        moreau.set_up::<FUSED>();
        let impulse = moreau.contact::<FUSED>();
        let position = moreau.bodies.faces(|body| &body.position);
        moreau.walk.book(step, position, impulse[1] / shaking.dt);
        if moreau.walk.observed() {
            moreau.walk.gather(&moreau.bodies.upper.impulse, impulse);
        }
        moreau.join();
        // The modes follow, and begin the next step.
        let sticks = moreau.walk.crack.solver.status.contains(&Status::Stick);
        moreau.go_on::<FUSED>(Some(moreau.drive), step + 1, usize::from(!sticks));
        if moreau.walk.due(step) {
            let now = moreau.balance();
            moreau.keep(&now);
        }
        if moreau.walk.lost() {
            break;
        }
    }
    let ledger = moreau.balance();
    let tensions = moreau.acting.map_or_else(Vec::new, |acting| acting.peaks);
    moreau.walk.end(ledger, tensions)
}

/// The dam on its way.
struct Moreau<'a> {
    walk: Walk<'a>,
    bodies: Sides<Moving<'a>>,
    acting: Option<Acting<'a>>,
    dampers: Dampers,
    still: Option<&'a Still>,
    /// Whether nothing moves the dam in this step.
    quiet: bool,
    ledger: Ledger,
    drive: Drive,
    shaking: &'a Shaking<'a>,
    step: TimeStep,
}

impl<'a> Moreau<'a> {
    fn new(dam: &'a Dam, shaking: &'a Shaking, theta: f64, wanted: Wanted) -> Self {
        let dt = shaking.dt;
        let step = TimeStep { dt, theta };
        let still = dam.still.as_ref();
        let bodies = Sides {
            upper: Moving::new(&dam.bodies.upper, still, 0, step),
            lower: dam
                .bodies
                .lower
                .as_ref()
                .map(|body| Moving::new(body, still, 1, step)),
        };
        let start = energy(&bodies);
        let faces = bodies.faces(|body| &body.position);
        let mut walk = Walk::new(dam, dt, wanted, faces);
        if let Some(still) = still {
            walk.crack.solver.status.copy_from_slice(&still.status);
        }
        Moreau {
            walk,
            acting: Acting::new(&dam.inside, faces),
            dampers: Dampers::new(&bodies, step),
            still,
            quiet: false,
            ledger: Ledger {
                start,
                ..Ledger::default()
            },
            // The dam has been standing: it starts with the damping of a crack that sticks.
            drive: Drive {
                ground: [0.0; 2],
                damping: 0,
            },
            bodies,
            shaking,
            step,
        }
    }

    /// Let the modes finish the step `now`, unless this is the start, and begin another with this state of damping.
    #[inline(always)]
    fn go_on<const FUSED: bool>(&mut self, now: Option<Drive>, next: usize, damping: usize) {
        let Shaking { ground, dt, scale } = self.shaking;
        let a = ground.get(next).copied().unwrap_or([0.0; 2]);
        self.drive = Drive {
            ground: [scale[0] * a[0] * dt, scale[1] * a[1] * dt],
            damping,
        };
        for body in self.bodies.iter_mut() {
            body.advance::<FUSED>(now, self.drive, self.step);
        }
    }

    /// Write the contact problem of the step, with what else acts in the crack.
    #[inline(always)]
    fn set_up<const FUSED: bool>(&mut self) {
        let (dam, damping) = (self.walk.dam, self.drive.damping);
        let softness = dam.softness();
        let bodies = &self.bodies;
        let answers = || {
            bodies.map(|body| Answer {
                w: &body.operator.w[damping],
                nodes: body.body.nodes,
            })
        };
        let position = bodies.faces(|body| &body.position);
        let crack = &mut self.walk.crack;
        let other = crack.meet(position, damping, answers, |largest| softness * largest);
        if other && !self.dampers.is_empty() {
            self.dampers
                .soften(&mut crack.problem.g, &crack.contacts, bodies, damping);
        }
        self.act();
        // A dam that stands under loads that do not change goes on standing, to the last bit.
        self.quiet = self.still.is_some() && self.bodies.iter().all(Moving::rests);
        if self.quiet {
            return;
        }
        self.push::<FUSED>();
        let TimeStep { dt, theta } = self.step;
        let back = (1.0 - theta) / theta;
        let free = self.bodies.faces(|body| &body.free);
        let before = self.bodies.faces(|body| &body.velocity);
        self.walk.crack.set_up(dam.friction, |pair, gap, _| {
            let approach = relative(pair, before.upper, before.lower, 1);
            WithoutContact {
                b: [0, 1].map(|d| relative(pair, free.upper, free.lower, d)),
                h: (gap.max(0.0) / dt).max(back * approach),
                approach,
            }
        });
    }

    /// Let what is in the crack beside contact push the nodes of both faces.
    #[inline(always)]
    fn act(&mut self) {
        let Some(acting) = &mut self.acting else {
            return;
        };
        let mut above = std::mem::take(&mut self.bodies.upper.push);
        let mut below = match &mut self.bodies.lower {
            Some(body) => std::mem::take(&mut body.push),
            None => Vec::new(),
        };
        let position = self.bodies.faces(|body| &body.position);
        let velocity = self.bodies.faces(|body| &body.velocity);
        acting.push(position, velocity, self.step, &mut above, &mut below);
        self.bodies.upper.push = above;
        if let Some(lower) = &mut self.bodies.lower {
            lower.push = below;
        }
    }

    /// Let the crack feel what acts beside contact, the forces that the start has in it, and the dashpots.
    #[inline(always)]
    fn push<const FUSED: bool>(&mut self) {
        let (alone, damping) = (self.acting.is_none(), self.drive.damping);
        let pushed = !alone || self.still.is_some();
        for body in self.bodies.iter_mut() {
            if self.still.is_some() {
                body.let_go(self.step.dt, alone);
            }
            if pushed {
                body.push_crack::<FUSED>(damping, alone);
            }
        }
        if !self.dampers.is_empty() {
            self.dampers.begin(&mut self.bodies, damping, pushed);
        }
    }

    /// Hand the bodies all impulses of the step: those of contact, less what the start has in it, and the others.
    #[inline(always)]
    fn join(&mut self) {
        let pushed = self.acting.is_some() || self.still.is_some();
        for body in self.bodies.iter_mut() {
            if self.quiet {
                body.impulse.fill(0.0);
            } else if pushed {
                body.join_push();
            }
        }
    }

    /// Solve the contact problem and move the nodes; the bodies get their impulses, the ledger its works. Returns the sum
    /// of the impulses along and across the crack.
    #[inline(always)]
    fn contact<const FUSED: bool>(&mut self) -> [f64; 2] {
        let crack = &mut self.walk.crack;
        let report = match self.still.filter(|_| self.quiet) {
            Some(still) => crack.hold(&still.contact, self.step.dt),
            None => crack.solver.solve::<FUSED>(&crack.problem),
        };
        self.walk.summary.note(report);
        let before = self.works();
        let (upper, lower) = (&mut self.bodies.upper, &mut self.bodies.lower);
        let none = &mut [][..];
        let below = lower.as_mut().map_or(none, |body| &mut body.impulse);
        let impulse = self.walk.crack.impulses(&mut upper.impulse, below);
        if !self.quiet {
            if !self.dampers.is_empty() {
                self.dampers.finish(&mut self.bodies, self.drive.damping);
            }
            for body in self.bodies.iter_mut() {
                body.move_crack::<FUSED>(self.drive.damping, self.step);
            }
        }
        let after = self.works();
        let theta = self.step.theta;
        let mean = |k: usize, d: usize| (1.0 - theta) * before[k][d] + theta * after[k][d];
        let ledger = &mut self.ledger;
        let work = [mean(0, 0), mean(0, 1)];
        ledger.friction -= work[0];
        ledger.impact -= work[1];
        ledger.gained += (work[0] + work[1]).max(0.0);
        ledger.turnover += work[0].abs() + work[1].abs();
        if let Some(acting) = &mut self.acting {
            let work = [mean(1, 0), mean(1, 1)];
            let taken_up = acting.settle(self.bodies.faces(|body| &body.position));
            ledger.input += work[0];
            // What the anchors have not taken up of their work is the scheme's doing.
            ledger.numerical -= work[1] + taken_up;
            ledger.springs = acting.stored;
            ledger.turnover += work[0].abs() + work[1].abs();
        }
        impulse
    }

    /// Work of the impulses on the velocities as they are: of contact along and across the crack, of water and anchors.
    #[inline(always)]
    fn works(&self) -> [[f64; 2]; 2] {
        let velocity = self.bodies.faces(|body| &body.velocity);
        let acted = self.acting.as_ref().map(|acting| acting.work(velocity));
        [self.walk.crack.work(velocity), acted.unwrap_or_default()]
    }

    /// Keep a frame.
    fn keep(&mut self, ledger: &Ledger) {
        let position = self.bodies.faces(|body| &body.position);
        let total = self.bodies.map(Moving::amplitudes);
        self.walk.keep(position, &total.map(|modes| &modes[..]), ledger);
    }

    /// The ledger with the sums of both bodies and the energy they hold; the sums go on, so that frames change nothing.
    fn balance(&self) -> Ledger {
        let mut ledger = self.ledger;
        for body in self.bodies.iter() {
            body.sums.book(&mut ledger);
        }
        ledger.damping += self.dampers.taken;
        ledger.turnover += self.dampers.taken;
        ledger.stored = energy(&self.bodies) + ledger.springs;
        ledger
    }
}

fn energy(bodies: &Sides<Moving>) -> f64 {
    let of = |body: &Moving| body.body.energy(&body.amplitudes(), &body.v);
    of(&bodies.upper) + bodies.lower.as_ref().map_or(0.0, of)
}
