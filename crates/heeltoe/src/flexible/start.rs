//! The dam before the earthquake: static equilibrium with a crack that may open and slip.
//!
//! From the state with the crack bonded, steps of
//!
//! ```text
//! (omega^2 + s) dq = f - omega^2 q + shapes^T p
//! ```
//!
//! with the conditions of contact and Coulomb on the motion of the step, as in [`super::coulomb`], until nothing moves
//! any more. The small `s` holds a part that is free; it plays no part in the state that is found. It goes by the lowest
//! frequency of the dam and holds its modes alone: by that of the rock, which is many times lower, a step would be so long
//! that the softness of nodes that are watched twice, a share of it, lets them creep without end. Thin layers between many
//! cracks bend far more softly than the dam that they make up: held by that, they would answer to forces with motions
//! whose rounding is more than what counts as rest. They are held by the dam's own frequency, from Rayleigh's quotient.

use super::still::{Still, Unrest};
use std::ops::Range;

use super::body::ReducedBody;
use super::compliance::Compliance;
use super::coulomb::{Known, Report};
use super::coupling::Crack;
use super::dam::Dam;
use super::faces::{mean_along, Faces};
use super::law::sideways::Sideways;
use super::place::Place;
use super::scheme::TimeStep;
use super::simd::{Group, Plain};
use super::status::Status;
use crate::stop::Stop;

/// What holds a free part, as a share of the smallest squared frequency of the dam.
const HOLD: f64 = 1e-2;
/// The static deformation is stiffer than the lowest mode: the quotient is some five times that one's squared frequency.
const THIN: f64 = 8.0;
const STEPS: usize = 3000;
/// Motions stand for velocities, forces for impulses.
const ONE: TimeStep = TimeStep { dt: 1.0, theta: 1.0 };
/// Six steps in turn that move the crack by less than this share of its static deformation have done all they can: each
/// leaves a hundredth of the one before at most, and rounding leaves some 1e-11.
const NOTHING: f64 = 1e-8;

/// One part under way.
struct Side<'a> {
    body: &'a ReducedBody,
    d: Vec<Group>,
    w: Vec<Group>,
    q: Vec<Group>,
    way: Vec<Group>,
    position: Vec<f64>,
    free: Vec<f64>,
    force: Vec<f64>,
}

impl<'a> Side<'a> {
    fn new(body: &'a ReducedBody, hold: f64) -> Self {
        let inverse = |(group, w): (usize, &Group)| -> Group {
            std::array::from_fn(|l| 1.0 / (w[l] + if body.of_rock(group, l) { 0.0 } else { hold }))
        };
        let d: Vec<Group> = body.omega_squared.iter().enumerate().map(inverse).collect();
        let columns = body.columns();
        Side {
            w: body.compliance(&d),
            q: body.start.clone(),
            way: d.clone(),
            position: body.position.clone(),
            free: vec![0.0; columns],
            force: vec![0.0; columns],
            body,
            d,
        }
    }

    fn answer(&self) -> Compliance<'_> {
        Compliance {
            w: &self.w,
            nodes: self.body.nodes,
            stride: self.body.stride(),
        }
    }

    /// Find the motion of a step without contact.
    fn begin(&mut self) {
        for (group, way) in self.way.iter_mut().enumerate() {
            for (l, way) in way.iter_mut().enumerate() {
                let left = self.body.load[group][l] - self.body.omega_squared[group][l] * self.q[group][l];
                *way = self.d[group][l] * left;
            }
        }
        self.free = self.body.at_crack(&self.way);
    }

    /// Add the motion that the forces of contact make, and return how far the crack has moved at most.
    fn finish(&mut self) -> f64 {
        let body = self.body;
        for group in 0..body.groups() {
            let push = body.on_modes(group, &self.force);
            for (l, push) in push.iter().enumerate() {
                self.way[group][l] += self.d[group][l] * push;
                self.q[group][l] += self.way[group][l];
            }
        }
        let moved = body.at_crack(&self.way);
        self.position
            .iter_mut()
            .zip(&moved)
            .for_each(|(x, way)| *x += way);
        moved.iter().fold(0.0, |most, way| most.max(way.abs()))
    }
}

/// Put a dam into its state before the earthquake; a search that is stopped finds none.
pub fn rest(mut dam: Dam, stop: Stop) -> Dam {
    dam.still = find_rest(&dam, stop).ok();
    dam
}

/// Find the dam at rest.
///
/// # Errors
/// Says why there is no state of rest.
pub fn find_rest(dam: &Dam, stop: Stop) -> Result<Still, Unrest> {
    let own = |body: &ReducedBody| -> f64 {
        let groups = body.omega_squared.iter().enumerate();
        let squares = groups.flat_map(|(group, w)| w.iter().enumerate().map(move |(l, w)| (group, l, *w)));
        squares
            .filter(|(group, l, w)| *w > 0.0 && !body.of_rock(*group, *l))
            .fold(f64::INFINITY, |a, (_, _, w)| a.min(w))
    };
    let lowest = dam.bodies.iter().map(own).fold(f64::INFINITY, f64::min);
    if !lowest.is_finite() {
        return Err(Unrest::NotSought);
    }
    let whole = quotient(dam);
    let own = if THIN * lowest < whole { whole } else { lowest };
    let mut sides: Vec<_> = dam
        .bodies
        .iter()
        .map(|body| Side::new(body, HOLD * own))
        .collect();
    let mut crack = Crack::new(dam, 0, false);
    crack.solver.thorough = true;
    let places = Place::all(&dam.cracks);
    let bonded = slips(&places, &sides);
    let stretched = dam
        .bodies
        .iter()
        .flat_map(|body| [stretch(body), bent(body)].concat());
    let scale = stretched.fold(0.0_f64, |a, u| a.max(u.abs()));
    // A part that begins off the plane below it, as one that leans, is let go as it is.
    let off = |(crack, place): (usize, &Place)| {
        let faces = place.of(position(&sides, crack));
        faces.lower.along.is_empty() && faces.upper.across.iter().any(|gap| gap.abs() > scale)
    };
    if places.iter().enumerate().any(off) {
        return Err(Unrest::NotSought);
    }
    let mut settled = 0;
    for _ in 0..STEPS {
        if stop.asked() {
            return Err(Unrest::NotSought);
        }
        step(dam, &mut crack, &mut sides);
        let mut moved = 0.0_f64;
        for side in &mut sides {
            moved = moved.max(side.finish());
        }
        let within = |(crack, place): (usize, &Place)| {
            let along = place.of(position(&sides, crack)).upper.along;
            moved < along[along.len() - 1] - along[0]
        };
        if !(moved.is_finite() && places.iter().enumerate().all(within)) {
            return Err(Unrest::MovesAway);
        }
        settled = if moved <= NOTHING * scale { settled + 1 } else { 0 };
        if settled == 6 {
            return Ok(still(&places, sides, crack, &bonded));
        }
    }
    Err(Unrest::NotFound)
}

/// Rayleigh's quotient of the deformation under the static loads, while the cracks are bonded.
fn quotient(dam: &Dam) -> f64 {
    let (mut stiffness, mut mass) = (0.0, 0.0);
    for body in dam.bodies.iter() {
        for (q, w) in body
            .start
            .as_flattened()
            .iter()
            .zip(body.omega_squared.as_flattened())
        {
            stiffness += w * q * q;
            mass += q * q;
        }
    }
    if mass > 0.0 {
        stiffness / mass
    } else {
        0.0
    }
}

/// Where the nodes around a crack are.
fn position<'s>(sides: &'s [Side], crack: usize) -> Faces<'s> {
    Faces::around(crack, sides, |side| &side.position)
}

/// Find the forces of contact of one step.
fn step(dam: &Dam, crack: &mut Crack, sides: &mut [Side]) {
    let answers = |part: usize| sides.get(part).map(Side::answer);
    crack.meet(|crack| position(sides, crack), 0, answers);
    // Softness creeps; here it must not.
    let softness = 1e-2 * crack.softness(dam.softness());
    crack.fill(answers, softness);
    sides.iter_mut().for_each(Side::begin);
    // Motion stands for velocity, forces for impulses. A gap may be negative: what an unfinished search has let enter
    // comes out again.
    let free = |crack| Faces::around(crack, sides, |side| &side.free);
    crack.contacts.relative(free, &mut crack.problem.b);
    crack.problem.h.copy_from_slice(&crack.contacts.gaps);
    crack.set_up();
    crack.bear(ONE, Sideways::default());
    let mut report = Report::default();
    loop {
        let (problem, solver) = (&mut crack.problem, &mut crack.solver);
        report.go_on(match &mut crack.bonds {
            Some(bonds) => bonds.rest::<Plain>(problem, solver, ONE),
            None => solver.solve::<Plain>(problem, &mut Known),
        });
        let met = crack.laws.as_mut().is_none_or(|laws| {
            laws.met(
                problem,
                solver,
                &crack.before,
                Sideways::default(),
                ONE,
                &mut report,
            )
        });
        if met {
            break;
        }
    }
    if let Some(bonds) = &mut crack.bonds {
        bonds.settle();
    }
    crack.impulses(sides, |side| &mut side.force);
}

/// How far the crack of a part has moved by its deformation while it is bonded. Weight alone deforms no free part.
fn bent(body: &ReducedBody) -> Vec<f64> {
    let pairs = body.start.iter().zip(&body.omega_squared);
    let amplitude =
        |(q, w): (&Group, &Group)| -> Group { std::array::from_fn(|l| if w[l] > 0.0 { q[l] } else { 0.0 }) };
    body.at_crack(&pairs.map(amplitude).collect::<Vec<_>>())
}

/// How far the static loads would move the crack of a part by its deformation.
fn stretch(body: &ReducedBody) -> Vec<f64> {
    let pairs = body.load.iter().zip(&body.omega_squared);
    let amplitude = |(f, w): (&Group, &Group)| -> Group {
        std::array::from_fn(|l| if w[l] > 0.0 { f[l] / w[l] } else { 0.0 })
    };
    body.at_crack(&pairs.map(amplitude).collect::<Vec<_>>())
}

fn slips(places: &[Place], sides: &[Side]) -> Vec<f64> {
    let places = places.iter().enumerate();
    let faces = places.map(|(crack, place)| place.of(position(sides, crack)));
    faces
        .map(|faces| mean_along(faces.upper) - mean_along(faces.lower))
        .collect()
}

fn still(places: &[Place], sides: Vec<Side>, crack: Crack, bonded: &[f64]) -> Still {
    let status = crack
        .solver
        .status
        .iter()
        .enumerate()
        .map(|(k, status)| match status {
            Status::Absent => Status::Absent,
            _ if crack.solver.p[crack.contacts.len() + k] > 0.0 => Status::Stick,
            _ if crack.holds(k) => Status::Stick,
            _ => Status::Open,
        });
    let status: Vec<Status> = status.collect();
    let open = |range: Range<usize>| {
        status[range]
            .iter()
            .filter(|status| **status == Status::Open)
            .count()
    };
    let (mut modes, mut positions, mut forces) = (Vec::new(), Vec::new(), Vec::new());
    let slips = slips(places, &sides);
    for side in sides {
        modes.push(side.q);
        positions.push(side.position);
        forces.push(side.force);
    }
    Still {
        open: crack.contacts.of_cracks().map(open).collect(),
        slip: slips
            .iter()
            .zip(bonded)
            .map(|(now, bonded)| now - bonded)
            .collect(),
        modes,
        position: positions,
        force: forces,
        status,
        contact: crack.solver.p,
        bonds: crack.bonds,
        worked: crack.laws.map_or_else(Vec::new, |laws| laws.contacts),
    }
}
