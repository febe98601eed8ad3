//! What is shaken, and how.

use super::body::Body;
use super::inside::Inside;

/// Two parts, and the crack between them.
pub struct Dam {
    pub upper: Body,
    /// None: the crack is on a rigid plane.
    pub lower: Option<Body>,
    /// Coefficients of friction of a node that sticks and of one that slips.
    pub friction: [f64; 2],
    /// Which nodes are watched; see [`Contacts::new`].
    pub contactors: u8,
    /// What acts in the crack beside contact.
    pub inside: Inside,
}

impl Dam {
    pub fn parts(&self) -> impl Iterator<Item = &Body> {
        std::iter::once(&self.upper).chain(&self.lower)
    }
}

/// How to walk.
#[derive(Clone, Copy)]
pub struct Options {
    pub dt: f64,
    pub theta: f64,
    /// Steps from frame to frame; 0 for no frames.
    pub stride: usize,
    /// Whether frames keep the modes too.
    pub keep_modes: bool,
    /// Factors on the ground's motion.
    pub scale: [f64; 2],
}
