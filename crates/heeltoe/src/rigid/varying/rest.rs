//! A block at rest: its reactions are linear in the ground's acceleration, so that it need not be integrated to see
//! that it stays where it is: every limit is `still + a_h across + a_v up + alpha turning`.

use super::super::mode::Mode;
use super::line::CLEAR;
use super::shaking::{Ground, TurningShaking};
use super::walk::Varying;

impl Varying<'_> {
    /// Pass over the samples from `from` on in which a block at rest stays clear of every limit; return the last of them,
    /// or `from` where there are none. Between two such samples it rests, too: what friction bears is a straight line over
    /// the normal force, or bends downward, so that a limit is least at an end.
    pub(super) fn rest_until(&mut self, shaking: &TurningShaking, from: usize) -> usize {
        let clear = CLEAR * self.walk.block.force_scale;
        let beyond = match self.rubbing.bends() {
            true if !self.rubbing.sags_nowhere() => return from,
            true => shaking.first_beyond(from, |ground| {
                let limits = self.limits(&self.state, ground);
                limits.iter().all(|(value, _)| *value > clear)
            }),
            false => {
                let reserve = self.reserve.unwrap_or_else(|| self.reserve_at_rest());
                self.reserve = Some(reserve);
                let [still, across, up, turning] = reserve;
                shaking.first_beyond(from, |[a, b, c]| {
                    (0..4).all(|i| still[i] + a * across[i] + b * up[i] + c * turning[i] > clear)
                })
            }
        };
        let last = beyond.max(from + 1) - 1;
        let time = shaking.level.time;
        self.walk.summary.time_by_mode[Mode::Rest.kind()] += time[last] - time[from];
        if self.walk.observed() {
            let state = self.state;
            for k in (from..last).filter(|k| time[k + 1] > time[*k]) {
                self.record(&state, &shaking.piece(k), time[k + 1], time[k]);
            }
        }
        last
    }

    /// The limits of [`Varying::limits`] in a still ground, and what each unit of the ground's acceleration adds to them.
    fn reserve_at_rest(&self) -> [[f64; 4]; 4] {
        let of = |ground: Ground| self.limits(&self.state, &ground).map(|(value, _)| value);
        let still = of([0.0; 3]);
        let per = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|unit| {
            let with = of(unit);
            [0, 1, 2, 3].map(|i| with[i] - still[i])
        });
        [still, per[0], per[1], per[2]]
    }
}
