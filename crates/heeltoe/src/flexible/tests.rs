//! The contact problem against its own conditions, on random problems and on those with a known answer.

use super::body::{Modes, ReducedBody};
use super::compliance::Compliance;
use super::contact::Contacts;
use super::coulomb::{Known, Problem, Report, Solver};
use super::coupling::Crack;
use super::crack_line::{BondLaw, Line, RockingThresholds};
use super::dam::Dam;
use super::dampers::Holding;
use super::faces::Faces;
use super::observe::State;
use super::place::Place;
use super::rocking_thresholds::Stance;
use super::simd::{Group, Plain};
use super::status::Status;

/// Numbers from -1 to 1 that are the same each time.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Random problem with a positive definite `G` whose contacts are coupled by `coupling`.
fn random(dice: &mut Dice, contacts: usize, coupling: f64, mu: f64) -> Problem {
    let n = 2 * contacts;
    let a: Vec<f64> = (0..n * n).map(|_| coupling * dice.roll()).collect();
    let mut g = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..n {
            g[i * n + j] = (0..n).map(|k| a[i * n + k] * a[j * n + k]).sum();
        }
        g[i * n + i] += 1.0;
    }
    Problem {
        scale: (0..n).map(|i| 1.0 / g[i * n + i]).collect(),
        g,
        b: (0..n).map(|_| dice.roll()).collect(),
        h: (0..contacts).map(|_| dice.roll().max(0.0)).collect(),
        mu_stick: vec![mu; contacts],
        mu_slip: vec![mu; contacts],
        added: Vec::new(),
        lean: Vec::new(),
    }
}

/// Largest violation of the conditions, worked out from scratch.
fn violation(problem: &Problem, p: &[f64]) -> f64 {
    let n = p.len();
    let u = |i: usize| problem.b[i] + (0..n).map(|j| problem.g[i * n + j] * p[j]).sum::<f64>();
    (0..n / 2).fold(0.0, |worst, c| {
        let (u_t, u_n) = (u(c), u(n / 2 + c) + problem.h[c]);
        let (p_t, p_n) = (p[c], p[n / 2 + c]);
        let limit = problem.mu_slip[c] * p_n;
        let mut found = [-u_n, -p_n, (u_n * p_n).abs(), p_t.abs() - limit, 0.0];
        // Whoever slips does so against the whole of friction.
        found[4] = (u_t.abs() * (limit - p_t.abs())).max(u_t * p_t);
        found.into_iter().fold(worst, f64::max)
    })
}

#[test]
fn random_problems_are_solved_to_rounding() {
    let mut dice = Dice(1);
    let mut swept = 0;
    for round in 0..4000 {
        let contacts = 1 + round % 12;
        let mut problem = random(&mut dice, contacts, 0.15, 0.8);
        let mut solver = Solver::new(contacts);
        let report = solver.solve::<Plain>(&mut problem, &mut Known);
        assert!(violation(&problem, &solver.p) < 1e-9, "round {round}: {report:?}");
        assert!(report.residual < 1e-9, "round {round}: {report:?}");
        swept += u32::from(report.swept);
    }
    assert!(swept < 200, "{swept} of 4000 needed sweeps");
}

#[test]
fn the_answer_does_not_depend_on_where_the_search_starts() {
    let mut dice = Dice(7);
    for _ in 0..300 {
        let mut problem = random(&mut dice, 5, 0.15, 0.6);
        let starts = [
            Status::Stick,
            Status::Open,
            Status::SlipDownstream,
            Status::SlipUpstream,
        ];
        let answers = starts.map(|status| {
            let mut solver = Solver::new(5);
            solver.status.fill(status);
            solver.solve::<Plain>(&mut problem, &mut Known);
            solver.p
        });
        for other in &answers[1..] {
            for (a, b) in answers[0].iter().zip(other) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }
    }
}

#[test]
fn an_inverse_that_follows_gives_what_factors_give() {
    let mut dice = Dice(11);
    let contacts = 24;
    let mut problem = random(&mut dice, contacts, 0.08, 0.5);
    let (mut factors, mut inverse) = (Solver::new(contacts), Solver::with_inverse(contacts));
    let mut seen = [0; 4];
    for round in 0..3000 {
        // A step changes little; now and then everything does, and friction.
        let much = if round % 100 == 99 { 1.0 } else { 0.1 };
        problem
            .b
            .iter_mut()
            .for_each(|b| *b += much * dice.roll() - 0.02 * *b);
        if round % 7 == 0 {
            let mu = 0.5 + 0.2 * dice.roll();
            problem.mu_stick.fill(mu);
            problem.mu_slip.fill(mu);
            // Factors do not last; an inverse is corrected.
            factors.forget(&vec![true; contacts]);
            inverse.forget(&vec![true; contacts]);
        }
        let reports =
            [&mut factors, &mut inverse].map(|solver| solver.solve::<Plain>(&mut problem, &mut Known));
        for report in reports {
            assert!(report.residual < 1e-9, "round {round}: {report:?}");
        }
        assert_eq!(factors.status, inverse.status, "round {round}");
        for (one, other) in factors.p.iter().zip(&inverse.p) {
            assert!((one - other).abs() < 1e-9, "round {round}: {one} {other}");
        }
        for (seen, status) in seen.iter_mut().zip([
            Status::Open,
            Status::Stick,
            Status::SlipDownstream,
            Status::SlipUpstream,
        ]) {
            *seen += usize::from(factors.status.contains(&status));
        }
    }
    assert!(seen.iter().all(|rounds| *rounds > 1000), "{seen:?}");
}

/// One contact with `G` the unit matrix.
fn single(b: [f64; 2], mu: f64) -> (Status, Vec<f64>, Report) {
    let mut problem = Problem {
        scale: vec![1.0; 2],
        g: vec![1.0, 0.0, 0.0, 1.0],
        b: b.to_vec(),
        h: vec![0.0],
        mu_stick: vec![mu],
        mu_slip: vec![mu],
        added: Vec::new(),
        lean: Vec::new(),
    };
    let mut solver = Solver::new(1);
    let report = solver.solve::<Plain>(&mut problem, &mut Known);
    (solver.status[0], solver.p, report)
}

#[test]
fn a_single_contact_opens_sticks_or_slips() {
    assert_eq!(single([0.3, 0.1], 0.5).0, Status::Open);
    let (status, p, _) = single([0.3, -1.0], 0.5);
    assert_eq!((status, p), (Status::Stick, vec![-0.3, 1.0]));
    let (status, p, _) = single([0.7, -1.0], 0.5);
    assert_eq!((status, p), (Status::SlipDownstream, vec![-0.5, 1.0]));
    let (status, p, _) = single([-0.7, -1.0], 0.5);
    assert_eq!((status, p), (Status::SlipUpstream, vec![0.5, 1.0]));
}

#[test]
fn absent_contacts_play_no_part() {
    let mut dice = Dice(3);
    let mut problem = random(&mut dice, 3, 0.15, 0.5);
    let mut solver = Solver::new(3);
    solver.status[1] = Status::Absent;
    solver.solve::<Plain>(&mut problem, &mut Known);
    assert_eq!(solver.status[1], Status::Absent);
    assert_eq!([solver.p[1], solver.p[4]], [0.0, 0.0]);
}

#[test]
fn pivoting_keeps_the_order_of_the_unknowns() {
    // A matrix that needs rows exchanged twice; its factors once came back in the wrong order.
    let mut problem = Problem {
        scale: vec![10.0, 0.5, 1.0, 0.3],
        g: vec![
            0.1, 0.3, 0.05, 0.0, //
            0.3, 2.0, 0.3, 0.7, //
            0.05, 0.3, 1.0, 0.4, //
            0.0, 0.7, 0.4, 3.0,
        ],
        b: vec![0.01, 0.02, -1.0, -1.0],
        h: vec![0.0; 2],
        mu_stick: vec![10.0; 2],
        mu_slip: vec![10.0; 2],
        added: Vec::new(),
        lean: Vec::new(),
    };
    let mut solver = Solver::new(2);
    let report = solver.solve::<Plain>(&mut problem, &mut Known);
    assert!(!report.swept && report.iterations < 5);
    assert!(violation(&problem, &solver.p) < 1e-12);
}

/// A face of nine nodes 10 m wide on a rigid plane, turned by `slope` about its toe, that touches from node `first` on
/// with the given status; the rest is open.
fn stands(first: usize, slope: f64, status: Status) -> State {
    let along = (0..9).map(|k| 1.25 * f64::from(k));
    let flat: Vec<f64> = along.clone().chain([0.0; 9]).collect();
    let turned: Vec<f64> = along.clone().chain(along.map(|x| slope * (10.0 - x))).collect();
    let place = Place::only(9, 0);
    let mut contacts = Contacts::new(3, &[place], &[]);
    let faces = |upper| Faces { upper, lower: &[] };
    contacts.update(|_| faces(&turned), |_| false);
    let give = RockingThresholds {
        rotation: 1e-3,
        gap: 1e-4,
    };
    let stance = Stance::new(give, &contacts.contactors, place.of(faces(&flat)));
    let states: Vec<Status> = (0..9)
        .map(|k| if k < first { Status::Open } else { status })
        .collect();
    stance.state(
        place.of(faces(&turned)),
        &contacts.contactors,
        &contacts.gaps,
        &states,
    )
}

#[test]
fn a_part_rocks_only_where_it_stands_on_one_end_and_has_turned() {
    // One open node, or half of them, is no rocking, however far the face has turned.
    assert_eq!(stands(1, 2e-3, Status::Stick), State::Rest);
    assert_eq!(stands(4, 2e-3, Status::SlipDownstream), State::Sliding);
    // Standing on its outer quarter, it rocks about its toe from 1 mrad on.
    assert_eq!(stands(6, 2e-3, Status::Stick), State::Rocking);
    assert_eq!(stands(6, 2e-3, Status::SlipUpstream), State::SlideRocking);
    assert_eq!(stands(6, 9e-4, Status::Stick), State::Rest);
    // The other way round it does not stand on the end about which it has turned.
    assert_eq!(stands(6, -2e-3, Status::Stick), State::Rest);
    // Off by a little it still stands on its nearest node, off by more it drifts.
    assert_eq!(stands(9, 2e-3, Status::Stick), State::SlideRocking);
    assert_eq!(stands(9, -2e-5, Status::Stick), State::Sliding);
}

/// A part of six modes and five crack nodes whose shapes are drawn at random.
fn body(dice: &mut Dice) -> ReducedBody {
    let mut draw = |count: usize| (0..count).map(|_| dice.roll()).collect::<Vec<f64>>();
    let (numbers, shapes) = (draw(6), draw(60));
    let position: Vec<f64> = (0..10).map(|k| f64::from(k % 5) * f64::from(k < 5)).collect();
    ReducedBody::new(&Modes {
        omega_squared: &numbers,
        damping: [&numbers, &numbers],
        load: &numbers,
        participation: [&numbers, &numbers],
        start: &numbers,
        shapes: &shapes,
        position: &position,
        directions: 2,
        dampers: &[],
        damper_signs: &[],
        wet: &[],
        boundary: &[],
    })
    .unwrap()
}

/// Answers of ten components of two faces, drawn at random.
fn answers(dice: &mut Dice) -> [Vec<Group>; 2] {
    [(); 2].map(|()| (0..20).map(|_| std::array::from_fn(|_| dice.roll())).collect())
}

fn compliance(answers: &[Vec<Group>; 2], part: usize) -> Option<Compliance<'_>> {
    answers.get(part).map(|w| Compliance {
        w,
        nodes: 5,
        stride: 2,
    })
}

#[test]
fn what_has_not_moved_keeps_its_answer() {
    let mut dice = Dice(11);
    for contactors in [3, 5] {
        let dam = Dam {
            bodies: vec![body(&mut dice), body(&mut dice)],
            cracks: vec![Line::only([5, 5], [0.6; 2], RockingThresholds::default())],
            contactors,
            reservoir: None,
            still: None,
        };
        let answers = answers(&mut dice);
        let answer = |part| compliance(&answers, part);
        let mut kept = Crack::new(&dam, 0, true);
        kept.solver.status.fill(Status::Open);
        let mut upper = dam.bodies[0].position.clone();
        let lower = &dam.bodies[1].position;
        let mut partly = 0;
        for step in 0..20 {
            // One node sticks in every second step; in the end one leaves the other face.
            let sticks = [Status::Open, Status::Stick][step % 2];
            kept.solver.status[0] = sticks;
            let position = Faces { upper: &upper, lower };
            kept.meet(|_| position, 0, answer);
            // What is not wanted for a while must not be taken for known later.
            let wanted = |contact: usize| step % 5 == 4 || contact % 5 != step % 5;
            let Crack {
                contacts,
                blocks,
                problem,
                ..
            } = &mut kept;
            blocks.fill(&mut problem.g, contacts, &answer, Holding::Gain(&[]), 0.1, wanted);
            partly += usize::from(kept.contacts.moved.contains(&false));
            let mut new = Crack::new(&dam, 0, true);
            new.contacts.pairs.clone_from(&kept.contacts.pairs);
            new.fill(answer, 0.1);
            let m = kept.contacts.len();
            let there = |k: usize| wanted(k % m) && kept.contacts.pairs[k % m].is_some();
            for (k, (old, new)) in kept.problem.g.iter().zip(&new.problem.g).enumerate() {
                assert!(
                    old == new || !(there(k / (2 * m)) && there(k % (2 * m))),
                    "step {step}, {k}"
                );
            }
            upper[..5].iter_mut().for_each(|x| *x += 0.07);
        }
        assert!(kept.contacts.pairs.contains(&None));
        assert!(partly > 5);
    }
}

/// A crack between faces of three nodes with such a bond.
fn joint(bond: Option<BondLaw>) -> Line {
    let mut line = Line::only([3, 3], [1.0; 2], RockingThresholds::default());
    line.bond = bond;
    line
}

#[test]
fn a_bonded_node_meets_the_end_of_the_other_face_until_its_slip_has_broken_the_bond() {
    let law = |tensile, cohesion| {
        let energy = [100.0, 1000.0];
        Some(BondLaw {
            tensile,
            cohesion,
            energy,
            dynamic: 1.0,
            first: 1.0,
        })
    };
    // 2 G_II / c, or 2 G_f / f_t where there is no cohesion.
    for (bond, last) in [
        (None, 0.0),
        (law(0.0, 0.0), 0.0),
        (law(1e6, 2e6), 1e-3),
        (law(1e6, 0.0), 2e-4),
    ] {
        for (slip, meets) in [(last + 1e-9, false), (0.99 * last, true)] {
            let lines = [joint(bond)];
            let mut contacts = Contacts::new(1, &Place::all(&lines), &lines);
            let upper = [slip, 1.0 + slip, 2.0 + slip, 0.0, 0.0, 0.0];
            let lower = [0.0, 1.0, 2.0, 0.0, 0.0, 0.0];
            let faces = Faces {
                upper: &upper,
                lower: &lower,
            };
            contacts.update(|_| faces, |_| false);
            assert_eq!(contacts.pairs[2].is_some(), meets, "{bond:?} {slip}");
        }
    }
}
