//! The contact problem against its own conditions, on random problems and on those with a known answer.

use super::coulomb::{Problem, Report, Solver};
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
        g,
        b: (0..n).map(|_| dice.roll()).collect(),
        h: (0..contacts).map(|_| dice.roll().max(0.0)).collect(),
        mu_stick: vec![mu; contacts],
        mu_slip: mu,
    }
}

/// Largest violation of the conditions, worked out from scratch.
fn violation(problem: &Problem, p: &[f64]) -> f64 {
    let n = p.len();
    let u = |i: usize| problem.b[i] + (0..n).map(|j| problem.g[i * n + j] * p[j]).sum::<f64>();
    (0..n / 2).fold(0.0, |worst, c| {
        let (u_t, u_n) = (u(2 * c), u(2 * c + 1) + problem.h[c]);
        let (p_t, p_n) = (p[2 * c], p[2 * c + 1]);
        let limit = problem.mu_slip * p_n;
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
        let problem = random(&mut dice, contacts, 0.15, 0.8);
        let mut solver = Solver::new(contacts);
        let report = solver.solve::<false>(&problem);
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
        let problem = random(&mut dice, 5, 0.15, 0.6);
        let starts = [
            Status::Stick,
            Status::Open,
            Status::SlipDownstream,
            Status::SlipUpstream,
        ];
        let answers = starts.map(|status| {
            let mut solver = Solver::new(5);
            solver.status.fill(status);
            solver.solve::<false>(&problem);
            solver.p
        });
        for other in &answers[1..] {
            for (a, b) in answers[0].iter().zip(other) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }
    }
}

/// One contact with `G` the unit matrix.
fn single(b: [f64; 2], mu: f64) -> (Status, Vec<f64>, Report) {
    let problem = Problem {
        g: vec![1.0, 0.0, 0.0, 1.0],
        b: b.to_vec(),
        h: vec![0.0],
        mu_stick: vec![mu],
        mu_slip: mu,
    };
    let mut solver = Solver::new(1);
    let report = solver.solve::<false>(&problem);
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
    let problem = random(&mut dice, 3, 0.15, 0.5);
    let mut solver = Solver::new(3);
    solver.status[1] = Status::Absent;
    solver.solve::<false>(&problem);
    assert_eq!(solver.status[1], Status::Absent);
    assert_eq!(solver.p[2..4], [0.0, 0.0]);
}

#[test]
fn pivoting_keeps_the_order_of_the_unknowns() {
    // A matrix that needs rows exchanged twice; its factors once came back in the wrong order.
    let problem = Problem {
        g: vec![
            0.1, 0.05, 0.3, 0.0, //
            0.05, 1.0, 0.3, 0.4, //
            0.3, 0.3, 2.0, 0.7, //
            0.0, 0.4, 0.7, 3.0,
        ],
        b: vec![0.01, -1.0, 0.02, -1.0],
        h: vec![0.0; 2],
        mu_stick: vec![10.0; 2],
        mu_slip: 10.0,
    };
    let mut solver = Solver::new(2);
    let report = solver.solve::<false>(&problem);
    assert!(!report.swept && report.iterations < 5);
    assert!(violation(&problem, &solver.p) < 1e-12);
}
