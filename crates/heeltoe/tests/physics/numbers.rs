//! Shared by the tests: gravity, a rectangular block, options, a comparison, random numbers.

use heeltoe::rigid::varying::VaryingNumbers;
use heeltoe::rigid::{BlockNumbers, Options};

pub const GRAVITY: f64 = 9.81;
/// Places in the vectors of slip, heel gap and toe gap.
pub const SLIP: usize = 0;
pub const HEEL: usize = 1;
pub const TOE: usize = 2;

pub const OPTIONS: Options = Options {
    settle: 1e-7,
    event_limit: 100_000,
    jam: true,
};

/// A rectangle of so many metres on a level crack, one coefficient of friction, Newton's restitution.
#[derive(Clone, Copy)]
pub struct Rectangle {
    pub width: f64,
    pub height: f64,
    pub friction: f64,
    pub restitution: f64,
}

impl Rectangle {
    pub fn mass(&self) -> f64 {
        2400.0 * self.width * self.height
    }

    /// Moment of inertia about the centroid.
    fn inertia(&self) -> f64 {
        self.mass() * (self.width.powi(2) + self.height.powi(2)) / 12.0
    }

    /// Moment of inertia about a corner.
    pub fn about_corner(&self) -> f64 {
        self.mass() * (self.width.powi(2) + self.height.powi(2)) / 3.0
    }

    pub fn numbers(&self) -> BlockNumbers {
        let mass = self.mass();
        BlockNumbers {
            mass_horizontal: mass,
            mass_vertical: mass,
            inertia: self.inertia(),
            height: self.height / 2.0,
            heel_distance: self.width / 2.0,
            toe_distance: self.width / 2.0,
            static_vertical: -mass * GRAVITY,
            per_horizontal_horizontal: -mass,
            per_vertical_vertical: -mass,
            friction_static: self.friction,
            friction_kinetic: self.friction,
            restitution: self.restitution,
            ..BlockNumbers::default()
        }
    }

    pub fn varying(&self) -> VaryingNumbers {
        VaryingNumbers {
            mass: self.mass(),
            inertia: self.inertia(),
            centroid_along: self.width / 2.0,
            centroid_across: self.height / 2.0,
            horizontal_along: 1.0,
            gravity: GRAVITY,
            width: self.width,
            opening: 1.0,
            ..VaryingNumbers::default()
        }
    }
}

#[track_caller]
pub fn near(value: f64, expected: f64, allowed: f64) {
    let apart = (value - expected).abs();
    assert!(apart <= allowed, "{value}, not {expected}: {apart:e} apart");
}

/// Numbers from -1 to 1 that are the same each time.
pub struct Dice(pub u64);

impl Dice {
    pub fn roll(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Numbers between 0 and 1, the same each time.
pub fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}
