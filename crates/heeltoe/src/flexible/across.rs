//! The dam across the valley: one displacement w at right angles to its section.
//!
//! Nothing in the bodies couples w with the motion in the section,
//!
//! ```text
//! M_y w'' + C_y w' + K_y w = -M_y 1 a_y + forces in the cracks
//! ```
//!
//! so that they are bodies of their own in their modes, see [`super::body`], with one component for each node. In the
//! cracks friction joins both, see [`super::coulomb::disc`]. Water does nothing along a face, and before the earthquake
//! w is zero. A neighbour stops the nodes of a crack once they have slipped as far as the gap beside it, and does not let
//! them rebound.

use super::contact::Contacts;
use super::coulomb::disc::{Disc, Rows, Side, SLACK};
use super::coulomb::{Problem, Solver};
use super::dam::{CrossShaking, Dam};
use super::dampers::HeldNodes;
use super::dowels::Dowels;
use super::law::sideways::Sideways;
use super::ledger::Ledger;
use super::linear::LinearDam;
use super::modal_stepper::Drive;
use super::place::Place;
use super::scheme::TimeStep;
use super::simd::{largest, Lanes};
use super::status::Status;
use super::summary::CrossSummary;
use super::track::Track;

/// Closer to a neighbour than this (m) a node touches it; it may pass it by the way of one step.
const TOUCHES: f64 = 1e-9;

/// Left out is an open contact that would have to move so many times as fast to close.
const FAR: f64 = 2.0;

/// Contacts whose correlation, squared, differs from 1 by less are of the same two nodes.
const ALIKE: f64 = 1e-9;

/// The dam across the valley on its way.
pub(super) struct Across<'a> {
    crossing: CrossShaking<'a>,
    linear: LinearDam<'a>,
    held: [HeldNodes; 2],
    /// Added to the answer of a contact to itself, as a share of it.
    softness: f64,
    places: Vec<Place>,
    disc: Disc,
    pub rows: Rows,
    /// For each contact: velocity before the step, and how far it has slipped.
    before: Vec<f64>,
    slip: Vec<f64>,
    /// Impulses of friction and of bonds.
    friction: Vec<f64>,
    /// Those of bonds, which `rows.p` contains.
    pub bonds: Vec<f64>,
    dowels: Option<Dowels>,
    /// Whether contacts have moved since their answers were written.
    pub moved: bool,
    /// How often contacts have moved; at which of these times each did last, and the answer of each to each was written.
    now: u64,
    moved_last: Vec<u64>,
    known: Vec<u64>,
    /// Open contacts that the problem of a step leaves out, as long as they do not close without it. They would move in
    /// every step, and all answers to them with them.
    left_out: Vec<bool>,
    pub track: Option<Track>,
}

impl<'a> Across<'a> {
    /// None where the ground does not move that way.
    pub(super) fn new(
        dam: &Dam,
        crossing: Option<CrossShaking<'a>>,
        contacts: usize,
        step: TimeStep,
    ) -> Option<Self> {
        let crossing = crossing.filter(|crossing| crossing.ground.iter().any(|a| *a != 0.0))?;
        let linear = LinearDam::new(crossing.bodies, None, None, step);
        Some(Across {
            held: [0, 1].map(|state| linear.held(state)),
            linear,
            softness: dam.softness(),
            places: Place::all(&dam.cracks),
            disc: Disc::new(contacts),
            rows: Rows::new(contacts),
            before: vec![0.0; contacts],
            slip: vec![0.0; contacts],
            friction: vec![0.0; contacts],
            bonds: vec![0.0; contacts],
            dowels: Dowels::new(&dam.cracks),
            moved: true,
            now: 1,
            moved_last: vec![1; contacts],
            known: vec![0; contacts * contacts],
            left_out: vec![false; contacts],
            track: crossing.crest.map(|row| Track::new(row, crossing.ground.len())),
            crossing,
        })
    }

    /// Let the modes finish the present step, where there is one, and begin another.
    pub(super) fn go_on<W: Lanes>(&mut self, under_way: bool, next: usize, scale: f64, damping: usize) {
        let a = self.crossing.ground.get(next).copied().unwrap_or(0.0);
        let drive = Drive {
            ground: [scale * a * self.linear.step.dt, 0.0],
            damping,
        };
        self.linear.advance::<W>(under_way, drive);
    }

    /// Whether nothing moves or drives it.
    pub(super) fn rests(&self) -> bool {
        self.linear.rests()
    }

    /// Leave it at rest for a step.
    pub(super) fn stay(&mut self, contacts: &Contacts) {
        self.note_moved(contacts);
        self.rows.p.fill(0.0);
        self.rows.u.fill(0.0);
        if let Some(dowels) = &mut self.dowels {
            dowels.stay();
        }
    }

    /// Write the rows of the step's contact problem.
    pub(super) fn set_up<W: Lanes>(&mut self, contacts: &Contacts) {
        if let Some(dowels) = &mut self.dowels {
            self.linear.push_across(dowels);
        }
        self.linear.find_free::<W>(self.dowels.is_some(), false);
        self.disc.begin();
        self.note_moved(contacts);
        let (linear, rows, m) = (&self.linear, &mut self.rows, contacts.len());
        if self.moved {
            let held = &self.held[linear.damping()];
            for (scale, pair) in rows.scale.iter_mut().zip(&contacts.pairs) {
                if let (Some(pair), 0.0) = (pair, *scale) {
                    *scale = 1.0 / ((1.0 + self.softness) * held.across(pair, pair));
                }
            }
        }
        contacts.relative_across(|crack| linear.free(crack), &mut rows.b);
        contacts.relative_across(|crack| linear.velocity(crack), &mut self.before);
        contacts.relative_across(|crack| linear.position(crack), &mut self.slip);
        for (touches, slip) in rows.touches.iter_mut().zip(&self.slip) {
            let [left, right] = self.crossing.gap;
            *touches = [slip + TOUCHES > left, TOUCHES - slip > right];
        }
        if rows.touches.iter().any(|touches| *touches != [false; 2]) {
            self.fill(contacts, |_| true);
            let rows = &mut self.rows;
            for contact in 1..m {
                if stopped_by_another(|k| contacts.pairs[k].is_some(), rows, self.softness, contact) {
                    rows.touches[contact] = [false; 2];
                }
            }
        }
    }

    /// Note which contacts have moved.
    fn note_moved(&mut self, contacts: &Contacts) {
        if contacts.moved.contains(&true) {
            self.moved = true;
            self.now += 1;
            let moved = self.moved_last.iter_mut().zip(&contacts.moved);
            moved.for_each(|(last, moved)| *last = if *moved { self.now } else { *last });
        }
    }

    /// Write how each of the `wanted` contacts answers to any other of them, where it is not known.
    pub(super) fn fill(&mut self, contacts: &Contacts, wanted: impl Fn(usize) -> bool) {
        let (rows, m) = (&mut self.rows, contacts.len());
        let held = &self.held[self.linear.damping()];
        for (i, one) in contacts.pairs.iter().enumerate() {
            let (Some(one), true) = (one, wanted(i)) else {
                continue;
            };
            for (j, other) in contacts.pairs[..=i].iter().enumerate() {
                let (Some(other), true) = (other, wanted(j)) else {
                    continue;
                };
                let known = &mut self.known[i * m + j];
                if *known >= self.moved_last[i].max(self.moved_last[j]) {
                    continue;
                }
                *known = self.now;
                let own = if i == j { 1.0 + self.softness } else { 1.0 };
                let answer = own * held.across(one, other);
                (rows.g[i * m + j], rows.g[j * m + i]) = (answer, answer);
            }
        }
    }

    /// Choose what the problem of a step leaves out: open contacts that have moved and do not close fast; `before` are the
    /// velocities before the step.
    pub(super) fn leave_out(
        &mut self,
        contacts: &Contacts,
        problem: &Problem,
        status: &[Status],
        before: &[f64],
    ) {
        let m = contacts.len();
        for (k, left_out) in self.left_out.iter_mut().enumerate() {
            let slowest = before[m + k].min(problem.b[m + k]);
            let stays = contacts.moved[k]
                && status[k] == Status::Open
                && self.rows.touches[k] == [false; 2]
                && problem.h[k] + FAR * slowest > 0.0;
            self.moved |= *left_out && !stays;
            *left_out = stays;
        }
    }

    /// Let the states be those that the problem has, or, `after` it, those of all contacts.
    pub(super) fn mark_left_out(&self, status: &mut [Status], after: bool) {
        for (status, left_out) in status.iter_mut().zip(&self.left_out) {
            if *left_out {
                *status = if after { Status::Open } else { Status::Absent };
            }
        }
    }

    /// Take contacts back that have been left out and would pass the other face; false where none would.
    pub(super) fn take_back(&mut self, problem: &Problem, solver: &Solver) -> bool {
        let (m, slack) = (self.left_out.len(), SLACK * largest(&problem.b));
        let mut any = false;
        for (k, left_out) in self.left_out.iter_mut().enumerate() {
            if *left_out && solver.u[m + k] + problem.h[k] < -slack {
                (*left_out, any) = (false, true);
            }
        }
        self.moved |= any;
        any
    }

    /// Motion of its contacts. Where a neighbour pushes, it bears all that acts across the valley.
    pub(super) fn sideways(&self) -> Sideways<'_> {
        Sideways {
            p: &self.friction,
            u: &self.rows.u,
            before: &self.before,
            scale: &self.rows.scale,
        }
    }

    /// Let contact bear what it does without the bonds.
    pub(super) fn part_with_bonds(&mut self) {
        let impulses = self.rows.p.iter_mut().zip(&self.bonds);
        impulses.for_each(|(p, bond)| *p -= bond);
    }

    /// Let bonds push with these impulses, with the velocities `own` without them; `push` is what those of `self.bonds` do.
    pub(super) fn push_by_bonds<W: Lanes>(
        &mut self,
        contacts: &Contacts,
        bonds: &[f64],
        own: &[f64],
        push: &mut [f64],
    ) {
        if self.moved || self.bonds != bonds {
            self.bonds.copy_from_slice(bonds);
            self.linear.spread_across(contacts, bonds);
            self.linear.answer::<W>();
            contacts.relative_across(|crack| self.linear.answered(crack), push);
            push.iter_mut().zip(own).for_each(|(u, own)| *u -= own);
        }
        let velocities = self.rows.b.iter_mut().zip(own.iter().zip(push));
        velocities.for_each(|(b, (own, push))| *b = own + *push);
    }

    /// Let the impulses be those of contact and bonds together, and the velocities without them what they are.
    pub(super) fn join_bonds(&mut self, own: &[f64]) {
        self.rows.b.copy_from_slice(own);
        let impulses = self.rows.p.iter_mut().zip(&self.bonds);
        impulses.for_each(|(p, bond)| *p += bond);
        self.note();
    }

    /// Note what friction and bonds do.
    pub(super) fn note(&mut self) {
        let pushed = self.rows.p.iter().zip(&self.rows.side).zip(&self.bonds);
        for (friction, ((p, side), bond)) in self.friction.iter_mut().zip(pushed) {
            *friction = if *side == Side::None { *p } else { *bond };
        }
    }

    /// The solver and the rows that it needs.
    pub(super) fn problem(&mut self) -> (&mut Disc, &mut Rows) {
        (&mut self.disc, &mut self.rows)
    }

    /// Move the nodes by the impulses found.
    pub(super) fn finish<W: Lanes>(&mut self, contacts: &Contacts) {
        self.moved = false;
        self.linear.spread_across(contacts, &self.rows.p);
        self.linear.answer::<W>();
        contacts.relative_across(|crack| self.linear.answered(crack), &mut self.rows.u);
        let work = self.dowels_work();
        self.linear.finish::<W>();
        let (theta, after) = (self.linear.step.theta, self.dowels_work());
        if let Some(dowels) = &mut self.dowels {
            dowels.settle(
                |crack| self.linear.position(crack),
                (1.0 - theta) * work + theta * after,
            );
            self.linear.join(false, true);
        }
    }

    /// Work of the impulses of anchors on the velocities as they are.
    fn dowels_work(&self) -> f64 {
        let dowels = self.dowels.as_ref();
        dowels.map_or(0.0, |dowels| dowels.work(|crack| self.linear.velocity(crack)))
    }

    /// How far the points of each anchor have moved against each other.
    pub(super) fn stretched(&self) -> &[f64] {
        self.dowels.as_ref().map_or(&[], |dowels| &dowels.moved)
    }

    /// Book what anchors have done in the step.
    pub(super) fn book_acted(&self, ledger: &mut Ledger) {
        if let Some(dowels) = &self.dowels {
            dowels.book(ledger);
        }
    }

    /// Works of friction and of the neighbours on some contacts; `taken` is what bonds take, empty without any.
    pub(super) fn works(&self, contacts: std::ops::Range<usize>, taken: &[f64]) -> [f64; 2] {
        let (theta, rows) = (self.linear.step.theta, &self.rows);
        let mut works = [0.0; 2];
        for k in contacts {
            let mean = (1.0 - theta) * self.before[k] + theta * rows.u[k];
            let bond = taken.get(k).copied().unwrap_or(0.0);
            works[usize::from(rows.side[k] != Side::None)] += rows.p[k] * mean + bond;
        }
        works
    }

    /// Book what the step has done to a crack with these contacts, whose faces have slipped so far against each other
    /// along it in the step.
    pub(super) fn book(
        &self,
        crack: usize,
        contacts: std::ops::Range<usize>,
        along: f64,
        summary: &mut CrossSummary,
    ) {
        let faces = self.linear.position(crack);
        let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len().max(1) as f64;
        let [upper, lower] = self.places[crack].spans();
        let of = |numbers: &[f64], first: usize, count: usize| {
            if count == 0 {
                0.0
            } else {
                mean(&numbers[first..][..count])
            }
        };
        let slip = of(faces.upper, upper.first, upper.count) - of(faces.lower, lower.first, lower.count);
        summary.slip_path += along.hypot(slip - summary.slip);
        summary.slip = slip;
        summary.slip_max = summary.slip_max.max(slip);
        summary.slip_min = summary.slip_min.min(slip);
        let (mut held, rows) = (false, &self.rows);
        for k in contacts {
            if rows.side[k] != Side::None {
                held = true;
                summary.side_impulse += (rows.p[k] - self.bonds[k]).abs();
            }
        }
        summary.side_contacts += u64::from(held && !summary.at_side);
        summary.at_side = held;
        if held {
            summary.time_at_side += self.linear.step.dt;
        }
    }

    /// Follow the point of the crest that is wanted.
    pub(super) fn follow<W: Lanes>(&mut self) {
        if let Some(track) = &mut self.track {
            track.add::<W>(self.linear.moved());
        }
    }

    /// Add its works and the energy it holds to a ledger that has those of the motion in the section.
    pub(super) fn balance(&self, ledger: &mut Ledger) {
        let stored = ledger.stored;
        self.linear.book(ledger);
        ledger.stored = stored + self.linear.energy();
    }
}

/// Whether a contact that touches a neighbour is of the same two nodes as one before it that does, too, and that moves the
/// same way: where the ends of both faces meet, each has one, and what stops one of them stops the other.
fn stopped_by_another(meets: impl Fn(usize) -> bool, rows: &Rows, softness: f64, contact: usize) -> bool {
    let touches = |k: usize| meets(k) && rows.touches[k] != [false; 2];
    let g = |i: usize, j: usize| rows.g[i * rows.b.len() + j];
    let own = |k: usize| g(k, k) / (1.0 + softness);
    let alike = |other: usize| {
        let both = g(contact, other);
        both > 0.0 && both.powi(2) > (1.0 - ALIKE) * own(contact) * own(other)
    };
    touches(contact) && (0..contact).any(|other| touches(other) && alike(other))
}

#[cfg(test)]
mod tests {
    use super::{stopped_by_another, Rows};

    #[test]
    fn only_contacts_of_the_same_nodes_that_move_alike_are_stopped_once() {
        let mut rows = Rows::new(2);
        rows.touches = vec![[true, false]; 2];
        for (between, alike) in [(2.0, true), (-2.0, false), (1.9, false)] {
            rows.g = vec![2.0, between, between, 2.0];
            assert_eq!(stopped_by_another(|_| true, &rows, 0.0, 1), alike, "{between}");
            assert!(!stopped_by_another(|k| k != 0, &rows, 0.0, 1), "{between}");
        }
    }
}
