//! What is shaken, and how.

use super::body::ReducedBody;
use super::crack_line::Line;
use super::envelope::Stressed;
use super::inside::RisingWater;
use super::reservoir::Reservoir;
use super::still::Still;
use crate::error::Error;
use crate::stop::Stop;

/// Parts and the cracks between them: crack k is between the parts k and k + 1, the lowest one may be on a rigid plane.
pub struct Dam {
    /// The parts, from the crest down; elastic rock below the base is one of them.
    pub bodies: Vec<ReducedBody>,
    /// The cracks, from the crest down.
    pub cracks: Vec<Line>,
    /// Which nodes are watched, by the five kinds of Zhu (2004), section 6.3: 1 all nodes of the upper face, 2 of the
    /// lower, 3 all of the upper and the ends of the lower, 4 the reverse, 5 all of both. On a rigid plane those of the
    /// upper face are.
    pub contactors: u8,
    /// Water with sound before it.
    pub reservoir: Option<Reservoir>,
    /// The state before the earthquake, see [`super::rest`]; none where friction does not hold the dam, which then starts
    /// from the state with its crack bonded.
    pub still: Option<Still>,
}

/// Nodes of both faces that meet say the same twice; this part of the largest answer to itself makes them share.
const SOFTNESS: f64 = 1e-9;

impl Dam {
    /// What to add to the answer of a contact to itself, as a share of the largest.
    pub(super) fn softness(&self) -> f64 {
        let kinked = self.cracks.iter().any(|line| !line.angles[0].is_empty());
        if kinked || self.contactors == 5 && self.bodies.len() > 1 {
            SOFTNESS
        } else {
            0.0
        }
    }

    /// Whether cracks, water and anchors are at nodes that are there.
    ///
    /// # Errors
    /// Says what is not.
    pub fn check(&self) -> Result<(), Error> {
        let [first, rest @ ..] = &self.bodies[..] else {
            return Err(Error::Dam("a dam needs a part"));
        };
        if !(rest.len()..=self.bodies.len()).contains(&self.cracks.len()) || self.cracks.is_empty() {
            return Err(Error::Dam(
                "a dam needs a crack below each part, but for the lowest one, which may have one",
            ));
        }
        let rows = |body: &ReducedBody| (body.dampers, body.wet);
        if rest.iter().any(|body| rows(body) != rows(first)) {
            return Err(Error::Dam(
                "all parts need a row for each dashpot and each mode of the water",
            ));
        }
        if first.wet != self.reservoir.as_ref().map_or(0, Reservoir::ties) {
            return Err(Error::Water("the parts need the rows that tie them to the water"));
        }
        let mut met = vec![0; self.bodies.len()];
        for (k, line) in self.cracks.iter().enumerate() {
            for (side, span) in line.nodes.iter().enumerate() {
                let nodes = self.bodies.get(k + side).map(ReducedBody::nodes);
                let there = nodes.map_or(span.count == 0, |nodes| {
                    span.count > 1 && span.first + span.count <= nodes
                });
                if !there {
                    return Err(Error::Dam(
                        "a crack needs two nodes or more of each part, which are there",
                    ));
                }
                let segments = line.angles[side].len();
                if segments > 0 && segments + 1 != span.count {
                    return Err(Error::Dam(
                        "a crack that is not straight needs an angle for each segment",
                    ));
                }
                if let Some(met) = met.get_mut(k + side) {
                    *met += span.count;
                }
            }
        }
        if !met.iter().copied().eq(self.bodies.iter().map(ReducedBody::nodes)) {
            return Err(Error::Dam("every node of a part needs its crack"));
        }
        for line in &self.cracks {
            let Some(bond) = line.bond else { continue };
            let friction = line.friction[0].max(line.friction[1]);
            if line.law.is_some() || self.contactors == 5 {
                return Err(Error::Dam(
                    "a bonded joint has constant friction, and its nodes are watched once",
                ));
            }
            let strengths = [bond.tensile, bond.cohesion];
            let others = [bond.energy[0], bond.energy[1], bond.dynamic, bond.first];
            if !strengths.iter().all(|strength| *strength >= 0.0)
                || !others.iter().all(|number| *number > 0.0)
                || strengths.iter().chain(&others).any(|number| !number.is_finite())
                || bond.cohesion < friction * bond.tensile
            {
                return Err(Error::Dam(
                    "a bond needs energies above zero, and a cohesion of friction times its tensile strength",
                ));
            }
        }
        for line in &self.cracks {
            line.inside.check(line.nodes.map(|span| span.count))?;
        }
        Ok(())
    }

    /// Whether these are its parts across the valley, and that can be followed.
    ///
    /// # Errors
    /// Says why not.
    pub fn check_across(&self, bodies: &[ReducedBody]) -> Result<(), &'static str> {
        let fits = |(own, body): (&ReducedBody, &ReducedBody)| {
            own.directions() == 1 && own.nodes() == body.nodes() && own.wet() == 0
        };
        let alike = bodies.iter().all(|body| body.dampers() == bodies[0].dampers());
        if bodies.len() != self.bodies.len() || !alike || !bodies.iter().zip(&self.bodies).all(fits) {
            return Err("across the valley each part needs a component for each of its nodes");
        }
        if self.contactors == 5 && self.bodies.len() > 1 {
            return Err("across the valley nodes are watched once");
        }
        Ok(())
    }
}

/// Accelerations of the ground, step by step.
#[derive(Clone, Copy, Debug)]
pub struct Shaking<'a> {
    /// Horizontal and vertical acceleration (m/s2): the mean in each step or, for the penalty method, at both ends of all
    /// steps, one more than there are steps.
    pub ground: &'a [[f64; 2]],
    /// Length of a step (s).
    pub dt: f64,
    /// Factors on the two accelerations.
    pub scale: [f64; 2],
    /// Water in the cracks whose pressure changes meanwhile; the penalty method knows none.
    pub rising: &'a [RisingWater],
    /// Shaking of the dam across the valley, by the first of the factors; the penalty method knows nothing of it.
    pub across: Option<CrossShaking<'a>>,
}

/// Shaking across the valley.
#[derive(Clone, Copy, Debug)]
pub struct CrossShaking<'a> {
    /// The parts with one component for each node, otherwise as those of the dam.
    pub bodies: &'a [ReducedBody],
    /// How far a crack may slip to the left and to the right bank until a neighbour stops it (m).
    pub gap: [f64; 2],
    /// Mean acceleration of the ground to the left bank in each step (m/s2).
    pub ground: &'a [f64],
    /// How far each mode of the part at the crest moves a point of it whose way is wanted.
    pub crest: Option<&'a [f64]>,
}

/// What is wanted of a run beside its summary.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// Steps from frame to frame; 0 for no frames.
    pub stride: usize,
    /// Whether frames keep the amplitudes of all modes, too.
    pub modes: bool,
    /// Stresses whose extremes are wanted.
    pub stresses: Option<Stressed<'a>>,
    /// The same of the pressures of water with sound, which is one part.
    pub pressures: Option<Stressed<'a>>,
    /// How far each mode of the part at the crest moves a point of it whose way is wanted.
    pub crest: Option<&'a [f64]>,
    /// Where a dam that is at rest ends its run; it needs frames.
    pub rest: Option<UntilRest>,
    /// What ends the run before its time.
    pub stop: Stop<'a>,
}

/// When a run looks whether its dam is at rest: where slip and openings of all cracks change by less than `moved` in the
/// last `seconds`, or in the second half of a shorter run, it ends.
#[derive(Clone, Copy, Debug)]
pub struct UntilRest {
    /// After so many steps for the first time.
    pub first: usize,
    /// And every so many steps from then on.
    pub every: usize,
    /// (s)
    pub seconds: f64,
    /// (m)
    pub moved: f64,
}
