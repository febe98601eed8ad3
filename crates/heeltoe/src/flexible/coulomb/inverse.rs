//! The inverse of the linear problem that is left once every contact has its state, carried along from set to set.
//!
//! Of many contacts one or two change their state in a step. The inverse `M` of the matrix `A` of the unknowns (see
//! [`super::factors`]) follows them, each by one change of rank one. An unknown with the column `c`, the row `r` and the
//! diagonal `a` comes in by
//!
//! ```text
//! s = a - r M c,     M' = [ M + M c r M / s,  -M c / s ;  -r M / s,  1 / s ]
//! ```
//!
//! and the impulse `p_t` of a contact is no longer its own, but `p_t = -f p_n` (`f = 0`: none), by
//!
//! ```text
//! v = M_t + f M_n,     M' = M - M e_t v / v_t,     less the row and the column of p_t
//! ```
//!
//! A contact that slips and sticks again lets `p_t` in as what it bears beside `-f p_n`, and adds that. What has moved
//! since, another part of `G` and another coefficient of friction, is left for the corrections of the solution. No law
//! adds to the friction here.

use super::super::simd::{add_times, apart, combine_first, fma, inlined, Group, Lanes, LANES};
use super::super::status::Status;
use super::linear::{missing, Linear};
use super::problem::Problem;

/// A change that divides by less than this share of what it began with is not to be trusted.
const SAFE: f64 = 1e-9;
/// More changes than this share of the unknowns cost more than to begin anew.
const ANEW: f64 = 0.3;
const NONE: usize = usize::MAX;

/// The inverse of the matrix of a set of states.
pub(super) struct Inverse {
    /// The set it belongs to, and what share of its normal impulse each contact that slips bears along the crack.
    of: Vec<Status>,
    friction: Vec<f64>,
    /// Component of each unknown, and the place of each component among the unknowns.
    unknowns: Vec<usize>,
    place: Vec<usize>,
    /// Column by column, each filled up with zeros to so many groups.
    columns: Vec<Group>,
    stride: usize,
    /// Room for a right-hand side, a column and a row.
    x: Vec<f64>,
    column: Vec<f64>,
    row: Vec<f64>,
    sum: Vec<Group>,
    /// Whether there is one.
    fresh: bool,
}

impl Inverse {
    pub(super) fn new(contacts: usize) -> Self {
        let size = 2 * contacts;
        let stride = size.div_ceil(LANES);
        Inverse {
            of: vec![Status::Open; contacts],
            friction: vec![0.0; contacts],
            unknowns: Vec::with_capacity(size),
            place: vec![NONE; size],
            columns: vec![[0.0; LANES]; size * stride],
            stride,
            x: Vec::with_capacity(size),
            column: Vec::with_capacity(size),
            row: Vec::with_capacity(size),
            sum: vec![[0.0; LANES]; stride],
            fresh: false,
        }
    }

    /// Contacts whose state is another one, as far as impulses are concerned.
    #[inline(always)]
    pub(super) fn changed<'s>(&'s self, status: &'s [Status]) -> impl Iterator<Item = usize> + 's {
        let pairs = self.of.iter().zip(status).enumerate();
        pairs
            .filter(|(_, (old, new))| old != new && (old.closed() || new.closed()))
            .map(|(contact, _)| contact)
    }

    /// Whether it pays to begin anew.
    #[inline(always)]
    pub(super) fn far_from(&self, status: &[Status]) -> bool {
        !self.fresh || self.changed(status).count() as f64 > ANEW * self.unknowns.len() as f64
    }

    /// Begin anew, with nothing closed.
    pub(super) fn clear(&mut self) {
        self.of.fill(Status::Open);
        self.unknowns.clear();
        self.place.fill(NONE);
        self.columns.fill([0.0; LANES]);
        self.fresh = true;
    }

    /// Go on to another set of states; false where that cannot be trusted. What `G` has for contacts that come in must be
    /// known.
    pub(super) fn turn_to<W: Lanes>(&mut self, problem: &Problem, status: &[Status]) -> bool {
        self.fresh = false;
        // What gets smaller first.
        for (contact, new) in status.iter().enumerate() {
            if !self.let_go::<W>(problem, contact, *new) {
                return false;
            }
        }
        for (contact, new) in status.iter().enumerate() {
            if !self.take_up::<W>(problem, contact, *new) {
                return false;
            }
        }
        self.fresh = true;
        true
    }

    /// Take out what a contact no longer bears by itself.
    fn let_go<W: Lanes>(&mut self, problem: &Problem, contact: usize, new: Status) -> bool {
        let (m, old) = (self.of.len(), self.of[contact]);
        let going = match (old, new) {
            (Status::Stick, new) if new.slips() => self.slip::<W>(problem, contact, new),
            (Status::Stick, new) if !new.closed() => {
                take_out::<W>(self, contact, 0.0) && take_out::<W>(self, m + contact, 0.0)
            }
            (old, new) if old.slips() && !new.closed() => take_out::<W>(self, m + contact, 0.0),
            _ => return true,
        };
        self.of[contact] = new;
        going
    }

    /// Let in what a contact now bears by itself.
    fn take_up<W: Lanes>(&mut self, problem: &Problem, contact: usize, new: Status) -> bool {
        let (m, old) = (self.of.len(), self.of[contact]);
        if old == new {
            return true;
        }
        let coming = match (old.closed(), new) {
            (true, Status::Stick) => self.stick_again::<W>(problem, contact),
            // From one slip to the other.
            (true, new) => self.stick_again::<W>(problem, contact) && self.slip::<W>(problem, contact, new),
            (false, Status::Stick) => {
                let_in::<W>(self, problem, m + contact, 0.0) && let_in::<W>(self, problem, contact, 0.0)
            }
            (false, new) if new.slips() => {
                self.friction[contact] = new.sign() * problem.mu_slip[contact];
                let_in::<W>(self, problem, m + contact, self.friction[contact])
            }
            _ => true,
        };
        self.of[contact] = new;
        coming
    }

    /// Let a contact that sticks bear along the crack by friction alone.
    fn slip<W: Lanes>(&mut self, problem: &Problem, contact: usize, new: Status) -> bool {
        self.friction[contact] = new.sign() * problem.mu_slip[contact];
        take_out::<W>(self, contact, self.friction[contact])
    }

    /// Let a contact that slips bear along the crack what it must.
    fn stick_again<W: Lanes>(&mut self, problem: &Problem, contact: usize) -> bool {
        if !let_in::<W>(self, problem, contact, 0.0) {
            return false;
        }
        // Until here that was beside friction.
        let (t, n) = (self.place[contact], self.place[self.of.len() + contact]);
        let f = self.friction[contact];
        for column in self
            .columns
            .chunks_exact_mut(self.stride)
            .take(self.unknowns.len())
        {
            let column = column.as_flattened_mut();
            column[t] -= f * column[n];
        }
        self.of[contact] = Status::Stick;
        true
    }

    /// What [`let_in`] does.
    #[inline(always)]
    fn extend<W: Lanes>(&mut self, problem: &Problem, k: usize, f: f64) -> bool {
        let (m, size, n) = (self.of.len(), problem.b.len(), self.unknowns.len());
        let own = &problem.g[k * size..][..size];
        let along = &problem.g[(k % m) * size..][..size];
        let mut diagonal = own[k];
        self.column.clear();
        self.column.extend(self.unknowns.iter().map(|&row| own[row]));
        if f != 0.0 {
            diagonal -= f * along[k];
            for (value, &row) in self.column.iter_mut().zip(&self.unknowns) {
                *value -= f * along[row];
            }
        }
        self.row.clear();
        for &other in &self.unknowns {
            let slips = other >= m && self.of[other - m].slips();
            let friction = if slips {
                self.friction[other - m] * own[other - m]
            } else {
                0.0
            };
            self.row.push(own[other] - friction);
        }
        self.row.resize(self.stride * LANES, 0.0);
        // M c, then r M, which is kept column by column.
        let groups = n.div_ceil(LANES);
        self.sum.fill([0.0; LANES]);
        inlined::combine::<W>(&self.columns, self.stride, &self.column, &mut self.sum[..groups]);
        let answered: f64 = dot::<W>(&self.sum[..groups], &self.row);
        let s = diagonal - answered;
        if s.is_nan() || s.abs() <= SAFE * diagonal.abs() {
            return false;
        }
        let inverse = 1.0 / s;
        for column in self.columns.chunks_exact_mut(self.stride).take(n) {
            let share = inverse * dot::<W>(&column[..groups], &self.row);
            add_times::<W>(share, &self.sum[..groups], &mut column[..groups]);
            column.as_flattened_mut()[n] = -share;
        }
        let new = &mut self.columns[n * self.stride..][..self.stride];
        new.fill([0.0; LANES]);
        add_times::<W>(-inverse, &self.sum[..groups], &mut new[..groups]);
        new.as_flattened_mut()[n] = inverse;
        self.place[k] = n;
        self.unknowns.push(k);
        true
    }

    /// What [`take_out`] does.
    #[inline(always)]
    fn shrink<W: Lanes>(&mut self, k: usize, f: f64) -> bool {
        let (m, n, q) = (self.of.len(), self.unknowns.len(), self.place[k]);
        // Nothing of itself where that is nothing.
        let normal = if f == 0.0 { q } else { self.place[m + k] };
        let groups = n.div_ceil(LANES);
        let column = &self.columns[q * self.stride..][..groups];
        self.sum[..groups].copy_from_slice(column);
        let of = self.sum.as_flattened();
        let own = fma::<W>(f, of[normal], of[q]);
        let largest = of[..n].iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        if own.is_nan() || own.abs() <= SAFE * largest {
            return false;
        }
        let inverse = -1.0 / own;
        for column in self.columns.chunks_exact_mut(self.stride).take(n) {
            let values = column.as_flattened();
            let v = fma::<W>(f, values[normal], values[q]);
            add_times::<W>(inverse * v, &self.sum[..groups], &mut column[..groups]);
        }
        // The last takes its place.
        let last = n - 1;
        self.columns
            .copy_within(last * self.stride..(last + 1) * self.stride, q * self.stride);
        for column in self.columns.chunks_exact_mut(self.stride).take(last) {
            let values = column.as_flattened_mut();
            values[q] = values[last];
            values[last] = 0.0;
        }
        self.place[self.unknowns[last]] = q;
        self.place[k] = NONE;
        self.unknowns.swap_remove(q);
        true
    }
}

impl Linear for Inverse {
    #[inline(always)]
    fn amiss(&mut self, u: &[f64], h: &[f64]) -> f64 {
        missing(&self.unknowns, u, h, &mut self.x)
    }

    fn add<W: Lanes>(&mut self, problem: &Problem, p: &mut [f64]) {
        let (m, groups) = (self.of.len(), self.unknowns.len().div_ceil(LANES));
        self.sum[..groups].fill([0.0; LANES]);
        combine_first::<W>(&self.columns, self.stride, &self.x, &mut self.sum[..groups]);
        for (&k, value) in self.unknowns.iter().zip(self.sum.as_flattened()) {
            p[k] += value;
        }
        for (contact, status) in self.of.iter().enumerate() {
            if status.slips() {
                p[contact] = -status.sign() * problem.mu_slip[contact] * p[m + contact];
            }
        }
    }
}

apart! {
    /// Let a component be unknown, whose contact bears `-f` of it along the crack where it is a normal one that slips.
    fn let_in(inverse: &mut Inverse, problem: &Problem, k: usize, f: f64) -> bool = Inverse::extend;
}

apart! {
    /// Let a component be no longer unknown, but `-f` times the normal one of its contact.
    fn take_out(inverse: &mut Inverse, k: usize, f: f64) -> bool = Inverse::shrink;
}

/// `sum a b` of groups and as many numbers.
#[inline(always)]
fn dot<W: Lanes>(a: &[Group], b: &[f64]) -> f64 {
    let mut sums = [W::all(0.0); 4];
    let b = b.as_chunks::<LANES>().0;
    let (fours, rest) = a.as_chunks::<4>();
    for (a, b) in fours.iter().zip(b.as_chunks::<4>().0) {
        for k in 0..4 {
            sums[k] = W::load(&a[k]).fma(W::load(&b[k]), sums[k]);
        }
    }
    for (a, b) in rest.iter().zip(&b[4 * fours.len()..]) {
        sums[0] = W::load(a).fma(W::load(b), sums[0]);
    }
    let mut lanes = [0.0; LANES];
    sums[0].add(sums[1]).add(sums[2].add(sums[3])).store(&mut lanes);
    lanes.iter().sum()
}
