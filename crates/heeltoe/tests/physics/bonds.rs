//! Bonded joints against their law: the mass on two nodes of [`super::flexible`], pulled off and pushed along its joint.

use heeltoe::flexible::{rest, simulate, BondLaw, Dam, Frames, Run, Scheme, Summary, Wanted};
use heeltoe::stop::Stop;

use crate::flexible::{pair_of_nodes, waves, Pair};
use crate::numbers::{near, GRAVITY};

/// Length of the joint (m).
pub(crate) const LENGTH: f64 = 10.0;
pub(crate) const BOND: BondLaw = BondLaw {
    tensile: 1e4,
    cohesion: 2e4,
    energy: [100.0, 300.0],
    dynamic: 1.0,
    first: 1.0,
};
/// A spring across that is ten times as stiff as the bond softens, and one along.
const HELD: Pair = Pair {
    omega: [100.0, 100.0],
    ..Pair::FREE
};

fn bonded(pair: &Pair, bond: BondLaw) -> Dam {
    let mut dam = pair_of_nodes(pair);
    dam.cracks[0].bond = Some(bond);
    dam.check().unwrap();
    dam
}

fn shake(dam: &Dam, ground: &[[f64; 2]], dt: f64) -> Run {
    let wanted = Wanted {
        stride: 1,
        ..Wanted::default()
    };
    simulate(dam, &Pair::FREE.shaking(ground, dt), &Scheme::Exact(0.5), wanted)
}

/// Ground accelerations that follow straight lines between factors on `size`, in the direction 0 along or 1 across.
fn lines(turns: &[f64], steps: usize, size: f64, direction: usize) -> Vec<[f64; 2]> {
    let mut ground = Vec::new();
    for pair in turns.windows(2) {
        for k in 0..steps {
            let share = (k as f64 + 0.5) / steps as f64;
            let mut acceleration = [0.0; 2];
            acceleration[direction] = size * (pair[0] + (pair[1] - pair[0]) * share);
            ground.push(acceleration);
        }
    }
    ground
}

fn column(run: &Run, name: &str) -> Vec<f64> {
    let place = Frames::FIELDS.iter().position(|field| *field == name).unwrap();
    run.frames.rows.iter().map(|row| row[place]).collect()
}

fn gaps(run: &Run) -> Vec<f64> {
    run.frames.upper[0]
        .chunks_exact(4)
        .map(|frame| frame[2])
        .collect()
}

#[test]
fn a_node_that_is_pulled_follows_the_law_and_takes_its_energy() {
    let run = shake(&bonded(&HELD, BOND), &lines(&[0.0, -300.0], 20_000, 1.0, 1), 1e-4);
    let crack = &run.cracks[0];
    let reach = 2.0 * BOND.energy[0] / BOND.tensile;
    let tension = |gap: f64| LENGTH * BOND.tensile * (1.0 - gap / reach).max(0.0);
    let (gaps, forces) = (gaps(&run), column(&run, "normal_force"));
    let mut softened = 0;
    for k in 1..gaps.len() {
        if gaps[k - 1] > 0.0 && gaps[k] > gaps[k - 1] && gaps[k] < reach {
            // What a frame tells is the mean since the one before.
            near(forces[k], -0.5 * (tension(gaps[k - 1]) + tension(gaps[k])), 1e-4);
            softened += 1;
        }
    }
    assert!(softened > 300, "{softened}");
    near(crack.cracked.energy, LENGTH * BOND.energy[0], 0.01);
    near(crack.ledger.fracture, crack.cracked.energy, 1e-9);
    assert_eq!(crack.cracked.lengths, [LENGTH, LENGTH, LENGTH, 0.0]);
    assert!(crack.cracked.first[0] > 0.0 && crack.cracked.through >= crack.cracked.first[0]);
    assert!(crack.ledger.residual() < 1e-11, "{:?}", crack.ledger);
    assert!(crack.residual < 1e-9, "{}", crack.residual);
}

#[test]
fn a_node_that_is_pulled_softens_along_two_lines_and_takes_its_energy() {
    let two = BondLaw { first: 0.4, ..BOND };
    let run = shake(&bonded(&HELD, two), &lines(&[0.0, -600.0], 40_000, 1.0, 1), 5e-5);
    let crack = &run.cracks[0];
    // Down to a quarter over 0.75 of 2 * 0.4 G_f / f_t, then to nothing: the area is G_f.
    let (meet, end) = (
        0.6 * two.energy[0] / two.tensile,
        5.6 * two.energy[0] / two.tensile,
    );
    let tension = |gap: f64| {
        let share = if gap < meet {
            1.0 - 0.75 * gap / meet
        } else {
            0.25 * ((end - gap) / (end - meet)).max(0.0)
        };
        LENGTH * two.tensile * share
    };
    let (gaps, forces) = (gaps(&run), column(&run, "normal_force"));
    let (mut softened, mut widest) = ([0; 2], 0.0_f64);
    for k in 1..gaps.len() {
        if gaps[k - 1] > 0.0 && gaps[k - 1] == widest && gaps[k] > widest && gaps[k] < end {
            near(forces[k], -0.5 * (tension(gaps[k - 1]) + tension(gaps[k])), 1e-4);
            softened[usize::from(gaps[k] > meet)] += 1;
        }
        widest = widest.max(gaps[k]);
    }
    assert!(softened.iter().all(|count| *count > 50), "{softened:?}");
    near(
        crack.cracked.energy,
        LENGTH * two.energy[0],
        0.002 * LENGTH * two.energy[0],
    );
    assert!(crack.ledger.residual() < 1e-11, "{:?}", crack.ledger);
}

#[test]
fn a_bond_never_heals() {
    // Opened to about half, closed, opened again: the second time it bears no more than the first time left.
    let turns = [0.0, -130.0, 50.0, -130.0, 0.0];
    let run = shake(&bonded(&HELD, BOND), &lines(&turns, 10_000, 1.0, 1), 1e-4);
    let reach = 2.0 * BOND.energy[0] / BOND.tensile;
    let (gaps, forces) = (gaps(&run), column(&run, "normal_force"));
    let mut widest = 0.0_f64;
    let mut again = 0;
    for k in 1..gaps.len() {
        if gaps[k].min(gaps[k - 1]) > 0.0 && gaps[k] < widest && gaps[k - 1] < widest {
            let left = LENGTH * BOND.tensile * (1.0 - widest / reach).max(0.0);
            let gap = 0.5 * (gaps[k] + gaps[k - 1]);
            near(-forces[k], left * gap / widest, 0.02 * LENGTH * BOND.tensile);
            again += 1;
        }
        widest = widest.max(gaps[k]);
    }
    assert!(
        again > 1000 && widest < reach && widest > 0.2 * reach,
        "{again} {widest}"
    );
    let crack = &run.cracks[0];
    // What opened and closed is given back but for what broke.
    let broken = LENGTH * BOND.energy[0] * (1.0 - (1.0 - widest / reach).powi(2));
    assert!(
        crack.cracked.energy < broken + 1e-6 && crack.cracked.energy > 0.3 * broken,
        "{crack:?}"
    );
    assert_eq!((crack.cracked.first[0], crack.cracked.through), (-1.0, -1.0));
    assert_eq!(crack.cracked.lengths, [0.0, 0.0, 0.0, LENGTH]);
    assert!(crack.ledger.residual() < 1e-11, "{:?}", crack.ledger);
}

#[test]
fn shear_under_pressure_takes_its_energy_beside_friction() {
    let run = shake(&bonded(&HELD, BOND), &lines(&[0.0, 600.0], 20_000, 1.0, 0), 1e-4);
    let crack = &run.cracks[0];
    let weight = HELD.mass * GRAVITY;
    let reach = 2.0 * BOND.energy[1] / BOND.cohesion;
    let slips = column(&run, "slip");
    let forces = column(&run, "friction_force");
    let bears =
        |slip: f64| LENGTH * BOND.cohesion * (1.0 - slip.abs() / reach).max(0.0) + HELD.friction * weight;
    let mut softened = 0;
    for k in 1..slips.len() {
        let way = slips[k] - slips[k - 1];
        if way < -1e-7 && slips[k - 1] < 0.0 && slips[k] > -reach {
            // Within what the spring of the bond gives.
            near(
                forces[k].abs(),
                0.5 * (bears(slips[k - 1]) + bears(slips[k])),
                60.0,
            );
            softened += 1;
        }
    }
    assert!(softened > 300, "{softened}");
    near(crack.cracked.energy, LENGTH * BOND.energy[1], 0.3);
    assert!(
        slips.windows(2).all(|pair| pair[1] <= pair[0] + 1e-12),
        "it slips one way"
    );
    near(
        crack.ledger.friction,
        HELD.friction * weight * crack.slip.abs(),
        1.0,
    );
    assert!(crack.ledger.residual() < 1e-11, "{:?}", crack.ledger);
}

#[test]
fn shear_under_tension_is_the_bonds_and_friction_takes_none() {
    // Held by half its tensile strength, then pushed along until it gives way.
    let bond = BondLaw {
        energy: [1e6, 300.0],
        ..BOND
    };
    let pulled = -(GRAVITY + 0.5 * LENGTH * BOND.tensile / HELD.mass);
    let mut ground = lines(&[0.0, pulled], 4_000, 1.0, 1);
    ground.extend(
        lines(&[0.0, 600.0], 20_000, 1.0, 0)
            .iter()
            .map(|along| [along[0], pulled]),
    );
    for dt in [1e-4, 2.5e-5] {
        let steps = (1e-4_f64 / dt).round() as usize;
        let finer: Vec<_> = ground
            .iter()
            .flat_map(|a| std::iter::repeat_n(*a, steps))
            .collect();
        let pair = Pair {
            omega: [100.0, 0.0],
            ..HELD
        };
        let run = shake(&bonded(&pair, bond), &finer, dt);
        let crack = &run.cracks[0];
        let reach = 2.0 * bond.energy[1] / bond.cohesion;
        let (slips, normal, along) = (
            column(&run, "slip"),
            column(&run, "normal_force"),
            column(&run, "friction_force"),
        );
        let mut softened = 0;
        for k in 1..slips.len() {
            if normal[k] < 0.0 && slips[k] - slips[k - 1] < -1e-7 && slips[k] > -0.3 * reach {
                let mean = -0.5 * (slips[k] + slips[k - 1]);
                let bears = LENGTH * bond.cohesion * (1.0 - mean / reach) + pair.friction * normal[k];
                near(along[k].abs(), bears, 0.01 * bears);
                softened += 1;
            }
        }
        assert!(softened > 50, "{softened}");
        assert!(
            crack.ledger.friction.abs() < 1e-6 * crack.cracked.energy,
            "{:?}",
            crack.ledger
        );
        assert!(
            crack.ledger.gained < 0.01 * crack.cracked.energy,
            "{:?}",
            crack.ledger
        );
        assert!(crack.ledger.residual() < 1e-11, "{:?}", crack.ledger);
    }
}

#[test]
fn a_strength_beyond_reach_holds() {
    let strong = BondLaw {
        tensile: 1e7,
        cohesion: 1e7,
        ..BOND
    };
    let run = shake(&bonded(&HELD, strong), &waves(3000, 0.001, 2.0), 0.001);
    let crack = &run.cracks[0];
    assert!(gaps(&run).iter().all(|gap| gap.abs() < 1e-10));
    assert!(column(&run, "slip").iter().all(|slip| slip.abs() < 1e-10));
    assert!(crack.cracked.energy.abs() < 1e-3);
    assert_eq!(crack.cracked.first, [-1.0; 2]);
}

#[test]
fn a_bond_that_is_broken_at_once_ends_as_a_crack() {
    // So weak that the first waves break it: from there on the contact is the one of a crack.
    let weak = BondLaw {
        tensile: 1.0,
        cohesion: 1.0,
        energy: [1e-6; 2],
        dynamic: 1.0,
        first: 1.0,
    };
    let pair = Pair {
        omega: [15.0, 20.0],
        damping: 0.04,
        ..Pair::FREE
    };
    let ground = waves(2000, 0.001, 0.7);
    let run = shake(&bonded(&pair, weak), &ground, 0.001);
    let cracked = shake(&pair_of_nodes(&pair), &ground, 0.001);
    let name = |summary: &Summary| summary.slip_max - summary.slip_min;
    near(
        name(&run.cracks[0]),
        name(&cracked.cracks[0]),
        2e-4 * name(&cracked.cracks[0]),
    );
    assert_eq!(run.cracks[0].cracked.lengths[2], LENGTH);
}

#[test]
fn intact_bonds_hold_at_rest() {
    // A spring that would slip the cracked pair at rest.
    let pair = Pair {
        omega: [10.0, 10.0],
        pulled: 0.32,
        ..Pair::FREE
    };
    let dam = rest(bonded(&pair, BOND), Stop::default());
    let run = shake(&dam, &vec![[0.0; 2]; 100], 1e-3);
    assert!(run.cracks[0].slip.abs() < 1e-12, "{:?}", run.cracks[0]);
    assert_eq!(run.cracks[0].cracked.first, [-1.0; 2]);
}

#[test]
fn random_joints_close_their_books() {
    for k in 0..300_u32 {
        let share = |n: u32| f64::from((k * 37 + n * 53 + k * k * n) % 101) / 100.0;
        let tensile = 10.0_f64.powf(3.0 + 3.0 * share(1));
        let cohesion = tensile * (0.3 + 3.0 * share(2));
        let dynamic = 1.0 + share(5);
        let first = if k % 2 == 0 { 1.0 } else { 0.3 + 0.6 * share(9) };
        // As tough as the step of 2 ms follows: dt^2 L f^2 / (2 G m) <= 1.
        let tough =
            |strength: f64, more: f64| (4e-9 * (dynamic * strength).powi(2) * (1.0 + more) + 1.0) / first;
        let bond = BondLaw {
            tensile,
            cohesion,
            energy: [tough(tensile, share(3)), tough(cohesion, share(4))],
            dynamic,
            first,
        };
        let pair = Pair {
            omega: [5.0 + 60.0 * share(6), 5.0 + 60.0 * share(7)],
            damping: 0.03,
            ..Pair::FREE
        };
        let run = shake(&bonded(&pair, bond), &waves(1500, 0.002, 3.0 * share(8)), 0.002);
        let crack = &run.cracks[0];
        assert!(
            crack.row().iter().all(|value| value.is_finite()),
            "{k}: {crack:?}"
        );
        // One that holds takes no energy: what is left is rounding.
        let held = crack.cracked.lengths[2] + crack.cracked.lengths[3] == 0.0;
        assert!(held || crack.ledger.residual() < 1e-9, "{k}: {:?}", crack.ledger);
        assert!(crack.residual < 1e-6, "{k}: {}", crack.residual);
        let healed =
            |[before, after]: [&[f64]; 2]| before.iter().zip(after).any(|(before, after)| after < before);
        let damages: Vec<&[f64]> = run.frames.damage.chunks_exact(2).collect();
        assert!(!damages.windows(2).any(|pair| healed([pair[0], pair[1]])), "{k}");
        let most = LENGTH * (bond.energy[0].max(bond.energy[1])) * 1.05;
        assert!(
            crack.cracked.energy > -1e-6 && crack.cracked.energy < 3.0 * most,
            "{k}: {crack:?}"
        );
    }
}

#[test]
fn a_bond_without_strength_is_a_crack_to_the_last_bit() {
    let none = BondLaw {
        tensile: 0.0,
        cohesion: 0.0,
        ..BOND
    };
    let pair = Pair {
        omega: [15.0, 20.0],
        damping: 0.04,
        ..Pair::FREE
    };
    let ground = waves(2000, 0.001, 0.7);
    let mut bonded = pair_of_nodes(&pair);
    bonded.cracks[0].bond = Some(none);
    bonded.check().unwrap();
    let (dam, crack) = (
        shake(&bonded, &ground, 0.001),
        shake(&pair_of_nodes(&pair), &ground, 0.001),
    );
    for name in [
        "slip",
        "rotation",
        "normal_force",
        "friction_force",
        "stored_energy",
    ] {
        assert_eq!(column(&dam, name), column(&crack, name), "{name}");
    }
    assert_eq!(dam.cracks[0].cracked.lengths, [LENGTH, LENGTH, LENGTH, 0.0]);
    assert_eq!(
        (dam.cracks[0].cracked.first[0], dam.cracks[0].cracked.through),
        (0.0, 0.0)
    );
}
