//! A block on a base with friction 0.5, under ground that accelerates upstream with 0.8 g for one second.
//!
//! Source of the right value: the block is left behind by 0.3 g, and friction then brakes it with 0.5 g.
//!
//!     cargo run --release -p heeltoe --example block

use heeltoe::rigid::{exact, Block, BlockNumbers, Options, Shaking, Wanted};

fn main() {
    let (width, height, gravity, friction) = (2.0_f64, 1.0_f64, 9.81, 0.5);
    let mass = 2.4e3 * width * height;
    let block = Block::new(&BlockNumbers {
        mass_horizontal: mass,
        mass_vertical: mass,
        inertia: mass * (width.powi(2) + height.powi(2)) / 12.0,
        height: height / 2.0,
        heel_distance: width / 2.0,
        toe_distance: width / 2.0,
        static_vertical: -mass * gravity,
        per_horizontal_horizontal: -mass,
        per_vertical_vertical: -mass,
        friction_static: friction,
        friction_kinetic: friction,
        ..Default::default()
    });
    let push = -0.8 * gravity;
    let (time, ground) = ([0.0, 0.5, 0.5, 1.5, 1.5, 5.0], [0.0, 0.0, push, push, 0.0, 0.0]);
    let shaking = Shaking::new(&time, &ground, None).expect("times ascend");
    let wanted = Wanted {
        events: true,
        ..Wanted::default()
    };
    let run = exact::simulate(&block, &shaking, None, Options::default(), wanted);

    let speed = (0.8 - friction) * gravity;
    let expected = 0.5 * speed + 0.5 * speed * speed / (friction * gravity);
    let slip = run.summary.position[0];
    println!(
        "{:?}: slip {slip:.6} m, by hand {expected:.6} m",
        run.summary.outcome
    );
    for event in &run.events {
        println!("{:8.4} s  {:?}", event.time, event.kind);
    }
    assert!((slip - expected).abs() < 1e-12);
}
