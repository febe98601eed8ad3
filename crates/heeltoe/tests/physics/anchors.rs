//! Anchors in cracks of elastic parts: one through two cracks, against the oscillator that it makes of the part above.
//!
//! Two parts lie on each other and on a plane. Nothing but the upper one is pushed, upwards by a force `f`, and an anchor
//! without prestress goes through both cracks into the plane:
//!
//! ```text
//! m z'' = f - k z,      z = f / k (1 - cos(omega t)),      omega^2 = k / m
//! ```
//!
//! The lower part feels the tension up at the one crack and down at the other, and stays where it is.

use heeltoe::flexible::{
    simulate, Crossing, Dam, FaceAnchor, Inside, Line, Modes, ReducedBody, RockingThresholds, Run, Scheme,
    Shaking, Span, Wanted,
};

use crate::numbers::near;

const MASS: f64 = 4000.0;
const FORCE: f64 = 2e4;
const STIFFNESS: f64 = 1e6;
const NODES: usize = 2;

/// A part with so many faces of two nodes, pushed up by a force: its means along and across, and the differences of the
/// nodes of each face from them, which are held.
fn part(faces: usize, force: f64) -> ReducedBody {
    let (nodes, share) = (NODES * faces, 1.0 / MASS.sqrt());
    let columns = 2 * nodes;
    let mut shapes = Vec::new();
    for direction in 0..2 {
        shapes.extend((0..columns).map(|c| if c / nodes == direction { share } else { 0.0 }));
    }
    for c in 0..columns {
        shapes.extend(
            (0..columns).map(|other| match (other == c, other / NODES == c / NODES) {
                (true, _) => share,
                (_, true) => -share,
                _ => 0.0,
            }),
        );
    }
    let count = shapes.len() / columns;
    let zeros = vec![0.0; count];
    let squares: Vec<f64> = (0..count).map(|mode| if mode < 2 { 0.0 } else { 4e4 }).collect();
    let load: Vec<f64> = (0..count)
        .map(|mode| if mode == 1 { force * share } else { 0.0 })
        .collect();
    let position: Vec<f64> = (0..columns)
        .map(|c| if c < nodes { 10.0 * (c % NODES) as f64 } else { 0.0 })
        .collect();
    ReducedBody::new(&Modes {
        omega_squared: &squares,
        damping: [&zeros; 2],
        load: &load,
        participation: [&zeros; 2],
        start: &zeros,
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

/// In the middle of a crack, whose lower face is that of a part or a rigid plane.
fn crossing(lower: Span) -> FaceAnchor {
    let middle = [(0, 0.5), (1, 0.5), (0, 0.0)];
    FaceAnchor {
        place: Crossing {
            anchor: 0,
            points: [middle, if lower.count > 0 { middle } else { [(0, 0.0); 3] }],
        },
        axis: [0.0, 1.0],
        prestress: 0.0,
        axial_stiffness: STIFFNESS,
        shear_stiffness: 0.0,
        capacity: f64::INFINITY,
    }
}

fn shake(dt: f64, steps: usize) -> Run {
    let span = |first| Span { first, count: NODES };
    let crack = |upper, lower: Span| Line {
        nodes: [upper, lower],
        inside: Inside {
            water: None,
            anchors: vec![crossing(lower)],
        },
        ..Line::only([NODES, 0], [0.5; 2], RockingThresholds::default())
    };
    let dam = Dam {
        bodies: vec![part(1, FORCE), part(2, -1.0)],
        cracks: vec![crack(span(0), span(0)), crack(span(NODES), Span::default())],
        contactors: 1,
        reservoir: None,
        still: None,
    };
    dam.check().unwrap();
    let ground = vec![[0.0; 2]; steps];
    let shaking = Shaking {
        ground: &ground,
        dt,
        scale: [1.0; 2],
        rising: &[],
        across: None,
    };
    let wanted = Wanted {
        stride: 1,
        ..Wanted::default()
    };
    simulate(&dam, &shaking, &Scheme::Exact(0.5), wanted)
}

#[test]
fn an_anchor_through_two_cracks_has_one_tension() {
    let omega = (STIFFNESS / MASS).sqrt();
    let (dt, steps) = (1e-4, 3000);
    let run = shake(dt, steps);
    for (k, frame) in run.frames.upper[0].chunks_exact(2 * NODES).enumerate() {
        let rise = FORCE / STIFFNESS * (1.0 - (omega * k as f64 * dt).cos());
        near(frame[NODES], rise, 1e-3 * FORCE / STIFFNESS);
    }
    // Springs that knew their own crack alone would pull the lower part up.
    for frame in run.frames.upper[1].chunks_exact(2 * NODES) {
        near(frame[NODES], 0.0, 1e-15);
    }
    for crack in &run.cracks {
        // Of a push that comes all at once the largest tension is twice its force.
        near(crack.anchors[0].tension, 2.0 * FORCE, 2e-3 * FORCE);
        assert!(crack.ledger.residual() < 1e-12, "{:?}", crack.ledger);
    }
    near(run.cracks[0].ledger.springs, run.cracks[1].ledger.springs, 0.0);
}
