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

use super::coulomb::Status;
use super::coupling::{Answer, Crack};
use super::dam::{Dam, Options};
use super::frames::{keep, Since, Snapshot};
use super::inside::Acting;
use super::ledger::Ledger;
use super::observe::{self, Faces, Motion};
use super::part::{Drive, Part};
use super::result::{Frames, Outcome, Summary};

/// Shake the dam. `ground` has the horizontal and vertical mean acceleration of each step.
pub fn simulate(dam: &Dam, ground: &[[f64; 2]], options: &Options, frames: Option<&mut Frames>) -> Summary {
    #[cfg(target_arch = "x86_64")]
    {
        if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("fma") {
            // Safety: the machine has what the function is compiled for.
            return unsafe { simulate_avx512(dam, ground, options, frames) };
        }
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            // Safety: as above.
            return unsafe { simulate_avx2(dam, ground, options, frames) };
        }
    }
    walk::<false>(dam, ground, options, frames)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx2,fma")]
fn simulate_avx512(
    dam: &Dam,
    ground: &[[f64; 2]],
    options: &Options,
    frames: Option<&mut Frames>,
) -> Summary {
    walk::<true>(dam, ground, options, frames)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn simulate_avx2(dam: &Dam, ground: &[[f64; 2]], options: &Options, frames: Option<&mut Frames>) -> Summary {
    walk::<true>(dam, ground, options, frames)
}

#[inline(always)]
fn walk<const FUSED: bool>(
    dam: &Dam,
    ground: &[[f64; 2]],
    options: &Options,
    mut frames: Option<&mut Frames>,
) -> Summary {
    let dt = options.dt;
    let mut upper = Part::new(&dam.upper, options);
    let mut lower = dam.lower.as_ref().map(|body| Part::new(body, options));
    let mut crack = Crack::new(dam);
    let mut summary = Summary::default();
    let mut ledger = Ledger {
        start: energy(&upper, lower.as_ref()),
        ..Ledger::default()
    };
    let zero = observe::mean_along(&upper.position)
        - lower.as_ref().map_or(0.0, |l| observe::mean_along(&l.position));
    let mut motion = Motion::of(faces(&upper, lower.as_ref(), |part| &part.position), zero);
    let reach = 100.0 * (upper.position[dam.upper.nodes - 1] - upper.position[0]);
    let mut acting = Acting::new(&dam.inside, faces(&upper, lower.as_ref(), |part| &part.position));
    // The dam has been standing: it starts with the damping of a crack that sticks.
    let mut drive = Drive {
        ground: [0.0; 2],
        damping: 0,
    };
    let next_ground = |step: usize| {
        let a = ground.get(step).copied().unwrap_or([0.0; 2]);
        [options.scale[0] * a[0] * dt, options.scale[1] * a[1] * dt]
    };
    drive.ground = next_ground(0);
    upper.advance::<FUSED>(None, drive, options);
    if let Some(lower) = &mut lower {
        lower.advance::<FUSED>(None, drive, options);
    }
    let mut since = Since::new(&dam.upper);
    if let Some(frames) = &mut frames {
        ledger.stored = ledger.start;
        keep(
            frames,
            &snapshot(&upper, lower.as_ref(), &crack, &motion, &since, &summary, &ledger),
            options.keep_modes,
        );
    }
    for step in 0..ground.len() {
        // Where the nodes are, and how they would go on without contact.
        let status = &crack.solver.status;
        let below: &[f64] = lower.as_ref().map_or(&[], |l| &l.position);
        crack
            .contacts
            .update(&upper.position, below, |k| status[k] == Status::Stick);
        if crack.contacts.changed || crack.assembled != Some(drive.damping) {
            // Nodes of both faces that meet say the same twice; a little softness makes them share.
            let softness = if dam.contactors == 5 && lower.is_some() {
                1e-9
            } else {
                0.0
            };
            let answers = [Some(&upper), lower.as_ref()].map(|part| {
                part.map(|part| Answer {
                    w: &part.operator.w[drive.damping],
                    nodes: part.body.nodes,
                })
            });
            if let [Some(above), below] = answers {
                crack.assemble(above, below, drive.damping, |largest| softness * largest);
            }
        }
        if let Some(acting) = &mut acting {
            act::<FUSED>(acting, &mut upper, lower.as_mut(), drive.damping, options);
        }
        let free = faces(&upper, lower.as_ref(), |part| &part.free);
        let before = faces(&upper, lower.as_ref(), |part| &part.velocity);
        crack.set_up(dam, free, before, options);
        summary.note(crack.solver.solve::<FUSED>(&crack.problem));
        // The nodes move; the parts get their impulses.
        let old = crack.work(faces(&upper, lower.as_ref(), |part| &part.velocity));
        let acted = acting
            .as_ref()
            .map(|acting| acting.work(faces(&upper, lower.as_ref(), |part| &part.velocity)));
        let impulse = crack.impulses(
            &mut upper.impulse,
            lower.as_mut().map_or(&mut [][..], |part| &mut part.impulse),
        );
        upper.move_crack::<FUSED>(drive.damping, options);
        if let Some(lower) = &mut lower {
            lower.move_crack::<FUSED>(drive.damping, options);
        }
        let new = crack.work(faces(&upper, lower.as_ref(), |part| &part.velocity));
        let work = [0, 1].map(|d| (1.0 - options.theta) * old[d] + options.theta * new[d]);
        ledger.friction -= work[0];
        ledger.impact -= work[1];
        ledger.gained += (work[0] + work[1]).max(0.0);
        ledger.turnover += work[0].abs() + work[1].abs();
        if let (Some(acting), Some(old)) = (&mut acting, acted) {
            let new = acting.work(faces(&upper, lower.as_ref(), |part| &part.velocity));
            let work = [0, 1].map(|k| (1.0 - options.theta) * old[k] + options.theta * new[k]);
            let taken_up = acting.settle(faces(&upper, lower.as_ref(), |part| &part.position));
            ledger.input += work[0];
            // What the anchors have not taken up of their work is the scheme's doing.
            ledger.numerical -= work[1] + taken_up;
            ledger.springs = acting.stored;
            ledger.turnover += work[0].abs() + work[1].abs();
        }
        let after = Motion::of(faces(&upper, lower.as_ref(), |part| &part.position), zero);
        let state = observe::state(&crack.solver.status);
        summary.end_time = (step + 1) as f64 * dt;
        observe::book(&mut summary, dt, &motion, &after, state, impulse[1] / dt);
        observe::strikes(
            &mut summary,
            &crack.contacts,
            &crack.closed,
            &crack.solver.status,
            &crack.approach,
        );
        motion = after;
        if frames.is_some() {
            since.add(&upper.impulse, impulse, dt);
        }
        if acting.is_some() {
            upper.join_push();
            if let Some(lower) = &mut lower {
                lower.join_push();
            }
        }
        // The modes follow, and begin the next step.
        let sticks = crack.solver.status.contains(&Status::Stick);
        let next = Drive {
            ground: next_ground(step + 1),
            damping: usize::from(!sticks),
        };
        upper.advance::<FUSED>(Some(drive), next, options);
        if let Some(lower) = &mut lower {
            lower.advance::<FUSED>(Some(drive), next, options);
        }
        drive = next;
        if let Some(frames) = &mut frames {
            if (step + 1).is_multiple_of(options.stride) {
                let now = balance(ledger, &upper, lower.as_ref());
                keep(
                    frames,
                    &snapshot(&upper, lower.as_ref(), &crack, &motion, &since, &summary, &now),
                    options.keep_modes,
                );
                since.clear();
            }
        }
        if !(motion.slip.abs() < reach && motion.opening_heel.abs() < reach) {
            summary.outcome = if motion.slip.is_finite() {
                Outcome::Lost
            } else {
                Outcome::BlownUp
            };
            break;
        }
    }
    summary.ledger = balance(ledger, &upper, lower.as_ref());
    summary.tensions = acting.map_or_else(Vec::new, |acting| acting.peaks);
    summary
}

/// Let what is in the crack beside contact push the nodes of both faces.
#[inline(always)]
fn act<const FUSED: bool>(
    acting: &mut Acting,
    upper: &mut Part,
    mut lower: Option<&mut Part>,
    damping: usize,
    options: &Options,
) {
    let mut above = std::mem::take(&mut upper.push);
    let mut below = lower
        .as_mut()
        .map_or_else(Vec::new, |part| std::mem::take(&mut part.push));
    let position = faces(upper, lower.as_deref(), |part| &part.position);
    let velocity = faces(upper, lower.as_deref(), |part| &part.velocity);
    acting.push(
        position,
        velocity,
        options.dt,
        options.theta,
        &mut above,
        &mut below,
    );
    upper.push = above;
    upper.push_crack::<FUSED>(damping);
    if let Some(lower) = lower {
        lower.push = below;
        lower.push_crack::<FUSED>(damping);
    }
}

/// The ledger with the sums of both parts and the energy they hold; the sums go on, so that frames change nothing.
fn balance(mut ledger: Ledger, upper: &Part, lower: Option<&Part>) -> Ledger {
    for part in std::iter::once(upper).chain(lower) {
        part.sums.book(&mut ledger);
    }
    ledger.stored = energy(upper, lower) + ledger.springs;
    ledger
}

fn energy(upper: &Part, lower: Option<&Part>) -> f64 {
    let of = |part: &Part| part.body.energy(&part.q, &part.v);
    of(upper) + lower.map_or(0.0, of)
}

/// One quantity of the crack nodes of both faces.
#[inline(always)]
fn faces<'a>(
    upper: &'a Part,
    lower: Option<&'a Part>,
    what: impl for<'p> Fn(&'p Part) -> &'p [f64],
) -> Faces<'a> {
    Faces {
        upper: what(upper),
        lower: lower.map_or(&[], what),
    }
}

fn snapshot<'a>(
    upper: &'a Part,
    lower: Option<&'a Part>,
    crack: &'a Crack,
    motion: &'a Motion,
    since: &'a Since,
    summary: &'a Summary,
    ledger: &'a Ledger,
) -> Snapshot<'a> {
    Snapshot {
        faces: faces(upper, lower, |part| &part.position),
        modes: [&upper.q, lower.map_or(&[], |part| &part.q)],
        status: &crack.solver.status,
        motion,
        since,
        summary,
        ledger,
    }
}
