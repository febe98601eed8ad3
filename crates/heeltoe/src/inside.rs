//! What acts in a crack beside contact, as it depends on how far the crack is open: water and anchors.
//!
//! Where the crack is open by g, the pressure p that is there while it is closed becomes
//!
//! | law | pressure |
//! | --- | --- |
//! | constant | p |
//! | zero while open | p max(0, 1 - g/w) |
//! | full while open | p + (p_full - p) min(1, g/w) |
//! | follows opening | p w/(w + g): the water that is there fills the wider crack |
//!
//! with the opening w over which it changes. An anchor pulls with max(0, P + k e), e its elongation along its axis, and
//! resists slip as a dowel.

use crate::table::{columns, named};

named! {
    /// What the pressure in the crack does as it opens.
    Law {
        /// Nothing.
        Constant = "constant",
        /// It vanishes, in proportion to the gap, until this is `opening`.
        ZeroWhileOpen = "zero while open",
        /// It becomes the reservoir's, in proportion to the gap, until this is `opening`.
        FullWhileOpen = "full while open",
        /// It falls as a given volume of water fills a wider crack.
        FollowsOpening = "follows opening",
    }
}

impl Law {
    /// Pressure, or force of a node, that is `still` in the closed crack and `full` at the reservoir's pressure.
    pub(crate) fn pressure(self, still: f64, full: f64, gap: f64, opening: f64) -> f64 {
        let open = (gap / opening).max(0.0);
        match self {
            Law::Constant => still,
            Law::ZeroWhileOpen => still * (1.0 - open).max(0.0),
            Law::FullWhileOpen => still + (full - still) * open.min(1.0),
            Law::FollowsOpening => still / (1.0 + open),
        }
    }

    /// The same less `still`, with all its digits where the crack is hardly open.
    #[inline(always)]
    pub(crate) fn change(self, still: f64, full: f64, gap: f64, opening: f64) -> f64 {
        let gap = gap.max(0.0);
        let part = (gap / opening).min(1.0);
        match self {
            Law::Constant => 0.0,
            Law::ZeroWhileOpen => -part * still,
            Law::FullWhileOpen => part * (full - still),
            Law::FollowsOpening => -still * gap / (opening + gap),
        }
    }
}

/// An anchor through the crack; `Place` says where.
#[derive(Clone, Copy, Debug)]
pub struct Anchor<Place> {
    /// Where it crosses the crack.
    pub place: Place,
    /// Its axis, along and across the crack.
    pub axis: [f64; 2],
    /// Tension before the earthquake.
    pub prestress: f64,
    /// Tension per elongation.
    pub axial_stiffness: f64,
    /// Resistance per slip.
    pub shear_stiffness: f64,
    /// Force that it is good for; infinite where nothing says so. It bears more all the same.
    pub capacity: f64,
}

/// What an anchor has borne in a run.
#[derive(Clone, Copy, Debug)]
pub struct Borne {
    /// Largest tension.
    pub tension: f64,
    /// Largest force, tension and resistance to slip together.
    pub force: f64,
    /// When its prestress was gone for the first time (s); below zero where it never was.
    pub slack: f64,
    /// When its force was more than its capacity for the first time (s); below zero where it never was.
    pub yields: f64,
    /// Tension at the end.
    pub last: f64,
    /// The moment noted last, and the force then.
    before: [f64; 2],
}

columns!(Borne, borne => {
    "tension": borne.tension,
    "force": borne.force,
    "slack": borne.slack,
    "yields": borne.yields,
    "last": borne.last,
});

impl Borne {
    /// Before anything has moved, at a moment.
    pub(crate) fn new<Place>(anchor: &Anchor<Place>, time: f64) -> Self {
        let mut borne = Borne {
            tension: 0.0,
            force: 0.0,
            slack: -1.0,
            yields: -1.0,
            last: 0.0,
            before: [time, 0.0],
        };
        borne.note(anchor, [anchor.prestress; 2], time);
        borne
    }

    /// Take tension and force of a moment into account.
    pub(crate) fn note<Place>(&mut self, anchor: &Anchor<Place>, [tension, force]: [f64; 2], time: f64) {
        self.tension = self.tension.max(tension);
        self.force = self.force.max(force);
        self.last = tension;
        // Without prestress there is nothing to lose.
        if tension == 0.0 && anchor.prestress > 0.0 && self.slack < 0.0 {
            self.slack = time;
        }
        let [then, less] = std::mem::replace(&mut self.before, [time, force]);
        if force > anchor.capacity && self.yields < 0.0 {
            // Somewhere between both moments.
            self.yields = then + (time - then) * (anchor.capacity - less) / (force - less);
        }
    }
}

impl<Place> Anchor<Place> {
    /// Elongation where its upper end has moved so far along and across the crack.
    pub(crate) fn elongation(&self, moved: [f64; 2]) -> f64 {
        self.axis[0] * moved[0] + self.axis[1] * moved[1]
    }

    /// Tension at an elongation, which may be that at several cracks.
    pub(crate) fn tension(&self, elongation: f64) -> f64 {
        (self.prestress + self.axial_stiffness * elongation).max(0.0)
    }

    /// Tension, and the force that it bears with its resistance to slip.
    pub(crate) fn borne(&self, moved: [f64; 2], elongation: f64) -> [f64; 2] {
        let tension = self.tension(elongation);
        [tension, tension.hypot(self.shear_stiffness * moved[0])]
    }

    /// Force along and across the only crack on the part above.
    pub(crate) fn pull(&self, moved: [f64; 2]) -> [f64; 2] {
        let tension = self.tension(self.elongation(moved));
        [
            -tension * self.axis[0] - self.shear_stiffness * moved[0],
            -tension * self.axis[1],
        ]
    }

    /// The force beyond that of the prestress, on the part below.
    pub(crate) fn pull_beyond_prestress(&self, moved: [f64; 2], elongation: f64) -> [f64; 2] {
        let more = self.tension(elongation) - self.prestress;
        let dowel = [self.shear_stiffness * moved[0], 0.0];
        [0, 1].map(|d| more * self.axis[d] + dowel[d])
    }

    /// Energy stored by resistance to slip.
    pub(crate) fn dowel_energy(&self, moved: [f64; 2]) -> f64 {
        0.5 * self.shear_stiffness * moved[0] * moved[0]
    }

    /// Energy stored by elongation beyond the work of the prestress.
    pub(crate) fn axial_energy(&self, e: f64) -> f64 {
        if self.prestress + self.axial_stiffness * e > 0.0 {
            return 0.5 * self.axial_stiffness * e * e;
        }
        // Slack: from where its tension vanished only the prestress is missing.
        let slack = if self.axial_stiffness > 0.0 {
            0.5 * self.prestress * self.prestress / self.axial_stiffness
        } else {
            0.0
        };
        -slack - self.prestress * e
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANCHOR: Anchor<()> = Anchor {
        place: (),
        axis: [0.6, 0.8],
        prestress: 10.0,
        axial_stiffness: 100.0,
        shear_stiffness: 50.0,
        capacity: 30.0,
    };

    #[test]
    fn the_change_is_the_difference_from_the_still_pressure() {
        for law in Law::ALL {
            for gap in [-1e-3, 0.0, 1e-12, 3e-4, 1e-3, 0.2] {
                let pressure = law.pressure(2.0, 7.0, gap, 1e-3);
                let change = law.change(2.0, 7.0, gap, 1e-3);
                assert!((pressure - 2.0 - change).abs() < 1e-14, "{law:?} {gap}");
            }
        }
    }

    #[test]
    fn a_slack_anchor_pulls_nothing() {
        assert_eq!(ANCHOR.pull([0.0, 0.0]), [-6.0, -8.0]);
        assert_eq!(ANCHOR.pull_beyond_prestress([0.0, 0.0], 0.0), [0.0, 0.0]);
        assert_eq!(ANCHOR.tension(-0.3), 0.0);
        assert_eq!(ANCHOR.pull([-0.5, 0.0]), [25.0, 0.0]);
    }

    #[test]
    fn an_anchor_bears_tension_and_shear_together() {
        // A tension of 10 + 100 * 0.3 * 0.6 = 28, and a shear of 50 * 0.3 = 15.
        let [tension, force] = ANCHOR.borne([0.3, 0.0], 0.18);
        assert!((tension - 28.0).abs() < 1e-12);
        assert!((force - 28_f64.hypot(15.0)).abs() < 1e-12);
        assert_eq!(ANCHOR.borne([-0.5, 0.0], -0.3), [0.0, 25.0]);
    }

    #[test]
    fn the_first_moments_of_slack_and_of_too_much_are_kept() {
        let mut borne = Borne::new(&ANCHOR, 0.0);
        // Elongations by hand: 10 + 100 e is 0 at e = -0.1, and 30 at e = 0.2.
        for (time, e) in [
            (1.0, -0.09),
            (2.0, -0.11),
            (3.0, -0.2),
            (4.0, 0.19),
            (5.0, 0.21),
            (6.0, 0.3),
        ] {
            let tension = ANCHOR.tension(e);
            borne.note(&ANCHOR, [tension; 2], time);
        }
        assert_eq!(borne.slack, 2.0);
        // Half way from 29 to 31.
        assert!((borne.yields - 4.5).abs() < 1e-12, "{}", borne.yields);
        assert!((borne.tension - 40.0).abs() < 1e-12 && borne.last == borne.tension);
        let passive = Anchor {
            prestress: 0.0,
            ..ANCHOR
        };
        let mut borne = Borne::new(&passive, 0.0);
        borne.note(&passive, [0.0; 2], 1.0);
        assert_eq!([borne.slack, borne.yields], [-1.0; 2]);
    }

    #[test]
    fn the_energy_of_an_anchor_is_the_work_done_on_it() {
        // From taut to slack and on: the integral of the force beyond the prestress, which works at every moment.
        let (n, end) = (100_000, [-0.3, -0.1]);
        let work: f64 = (0..n)
            .map(|k| {
                let share = (f64::from(k) + 0.5) / f64::from(n);
                let moved = end.map(|x| x * share);
                let force = ANCHOR.pull_beyond_prestress(moved, ANCHOR.elongation(moved));
                (force[0] * end[0] + force[1] * end[1]) / f64::from(n)
            })
            .sum();
        let stored = ANCHOR.axial_energy(ANCHOR.elongation(end)) + ANCHOR.dowel_energy(end);
        assert!((stored - work).abs() < 1e-8, "{work}");
    }
}
