//! How to step through time.

/// How to step through time.
#[derive(Clone, Copy, Debug)]
pub enum Scheme {
    /// Exact contact, with this weight of the new state within a step, 0.5 to 1.
    Exact(f64),
    /// Springs at the contacts, for comparison; knows neither water nor anchors that follow the crack.
    Penalty(Penalty),
}

/// The numbers of the penalty method, see the module `idce`.
#[derive(Clone, Copy, Debug)]
pub struct Penalty {
    /// Stiffness of the spring at a contact (N/m).
    pub stiffness: f64,
    /// Newmark's gamma.
    pub gamma: f64,
    /// Newmark's beta.
    pub beta: f64,
}

/// Length of a step, and weight of the new state in it.
#[derive(Clone, Copy)]
pub(super) struct TimeStep {
    pub dt: f64,
    pub theta: f64,
}
