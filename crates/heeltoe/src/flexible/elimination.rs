//! Factors of large sparse symmetric matrices with complex entries: `P A P^T = L D L^T`.
//!
//! Rock and water around a dam, in all their finite elements and shaken at a rate s, are `A = K + s C + s^2 M`. With growth
//! in s the imaginary part is positive definite, and no pivots need be sought (Higham, Mathematics of Computation 67, 1998).
//! Columns of L with the same rows are eliminated together in a dense front, from which what is left of the later rows goes
//! on to that of the next of them (multifrontal elimination; Duff and Reid, ACM Transactions on Mathematical Software 9,
//! 1983; Liu, SIAM Review 34, 1992). Where the rows are depends on the pattern of the matrix alone, and is found once.

use super::simd::{apart, Group, Lanes, Plain, LANES};

/// So many columns are eliminated before the later ones of a front hear of it.
const BLOCK: usize = 8;
/// Columns join those of the next front where that has so few columns with them, or where at most this part of it is zero.
const FEW: usize = 8;
const ZEROS: f64 = 0.2;
/// Complex numbers of a group.
const PAIRS: usize = LANES / 2;

/// A number with its imaginary part.
type Pair = [f64; 2];

/// Columns that are eliminated together.
struct Front {
    /// The first of them, and how many there are.
    first: usize,
    pivots: usize,
    /// Rows from there on, those of the columns first.
    rows: Vec<u32>,
    /// Fronts whose rest comes here.
    before: Vec<usize>,
    /// Where the rows after those of the columns are in the next front.
    next: Vec<u32>,
    /// Entries of the matrix that come here, and their places.
    entries: Vec<(u32, u32)>,
}

impl Front {
    fn groups(&self) -> usize {
        self.rows.len().div_ceil(LANES)
    }

    /// Where a row is among those of the front; none where the matrix is not symmetric.
    fn at(&self, row: u32) -> Option<u32> {
        let place = self.rows.partition_point(|other| *other < row);
        (self.rows.get(place) == Some(&row)).then_some(place as u32)
    }
}

/// The pattern of a symmetric matrix in the order in which it is eliminated.
pub struct Pattern {
    /// The unknown at each place.
    order: Vec<u32>,
    fronts: Vec<Front>,
    entries: usize,
}

/// Columns of a front: the real parts of a column in groups, then the imaginary ones, and the inverses of the pivots.
struct Panel {
    columns: Vec<Group>,
    inverses: Vec<Pair>,
}

/// The factors of a matrix with this pattern.
pub struct Factors {
    panels: Vec<Panel>,
}

impl Pattern {
    /// Look at a matrix with entries in `rows[starts[j]..starts[j + 1]]` of each column j, on both sides of the diagonal, in
    /// an order that fills little; none where these are no such matrix.
    pub fn new(starts: &[usize], rows: &[u32], order: &[u32]) -> Option<Pattern> {
        let size = order.len();
        let whole = starts.len() == size + 1 && starts[size] == rows.len();
        if !whole || !starts.is_sorted() || starts[0] != 0 || rows.iter().any(|row| *row as usize >= size) {
            return None;
        }
        // As many in each row as in its column.
        let mut counts: Vec<usize> = starts.windows(2).map(|pair| pair[1] - pair[0]).collect();
        for row in rows {
            counts[*row as usize] = counts[*row as usize].checked_sub(1)?;
        }
        let mut order = order.to_vec();
        let mut place = places(&order)?;
        let parents = elimination_tree(starts, rows, &order, &place);
        let after = postorder(&parents);
        order = after.iter().map(|old| order[*old]).collect();
        place = places(&order)?;
        let fronts = fronts(starts, rows, &order, &place)?;
        Some(Pattern {
            order,
            fronts,
            entries: rows.len(),
        })
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.order.len()
    }

    /// Eliminate a matrix with these entries, a real and an imaginary part each.
    pub fn factors(&self, entries: &[Pair]) -> Option<Factors> {
        if entries.len() != self.entries {
            return None;
        }
        #[cfg(target_arch = "x86_64")]
        {
            use super::simd::x86::{Avx2, Avx512};
            let fma = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            if fma && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
                return Some(self.eliminated::<Avx512>(entries));
            }
            if fma {
                return Some(self.eliminated::<Avx2>(entries));
            }
        }
        Some(self.eliminated::<Plain>(entries))
    }

    fn eliminated<W: Lanes>(&self, entries: &[Pair]) -> Factors {
        let mut panels: Vec<Panel> = Vec::with_capacity(self.fronts.len());
        for front in &self.fronts {
            let (groups, size) = (front.groups(), front.rows.len());
            let mut columns = vec![[0.0; LANES]; 2 * groups * size];
            let values = columns.as_flattened_mut();
            for (entry, to) in &front.entries {
                let (entry, to) = (entries[*entry as usize], *to as usize);
                values[to] += entry[0];
                values[to + groups * LANES] += entry[1];
            }
            for before in &front.before {
                self.fronts[*before].pass_on(&mut panels[*before].columns, values, groups);
            }
            let mut inverses = vec![[0.0; 2]; front.pivots];
            eliminate::<W>(&mut columns, groups, size, &mut inverses);
            panels.push(Panel { columns, inverses });
        }
        Factors { panels }
    }

    /// Solve for `count` right sides, the pairs of each unknown one after the other, in place.
    pub fn solve(&self, factors: &Factors, sides: &mut [f64], count: usize) {
        #[cfg(target_arch = "x86_64")]
        {
            use super::simd::x86::{Avx2, Avx512};
            let fma = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            if fma && is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
                return self.solved::<Avx512>(factors, sides, count);
            }
            if fma {
                return self.solved::<Avx2>(factors, sides, count);
            }
        }
        self.solved::<Plain>(factors, sides, count);
    }

    fn solved<W: Lanes>(&self, factors: &Factors, sides: &mut [f64], count: usize) {
        let mut group = vec![[0.0; LANES]; self.order.len()];
        let mut some = Vec::new();
        for first in (0..count).step_by(PAIRS) {
            let width = 2 * PAIRS.min(count - first);
            for (group, unknown) in group.iter_mut().zip(&self.order) {
                *group = [0.0; LANES];
                group[..width].copy_from_slice(&sides[2 * (*unknown as usize * count + first)..][..width]);
            }
            for (front, panel) in self.fronts.iter().zip(&factors.panels) {
                some.clear();
                some.extend(front.rows.iter().map(|row| group[*row as usize]));
                forward::<W>(&panel.columns, front.groups(), &panel.inverses, &mut some);
                for (row, solved) in front.rows.iter().zip(&some) {
                    group[*row as usize] = *solved;
                }
            }
            for (front, panel) in self.fronts.iter().zip(&factors.panels).rev() {
                some.clear();
                some.extend(front.rows.iter().map(|row| group[*row as usize]));
                backward::<W>(&panel.columns, front.groups(), &panel.inverses, &mut some);
                group[front.first..front.first + front.pivots].copy_from_slice(&some[..front.pivots]);
            }
            for (group, unknown) in group.iter().zip(&self.order) {
                sides[2 * (*unknown as usize * count + first)..][..width].copy_from_slice(&group[..width]);
            }
        }
    }
}

impl Front {
    /// Add what is left of the later columns to those of the next front, and keep the eliminated ones alone.
    fn pass_on(&self, columns: &mut Vec<Group>, next: &mut [f64], next_groups: usize) {
        let (ld, next_ld) = (self.groups() * LANES, next_groups * LANES);
        let values = columns.as_flattened();
        for (column, to) in self.next.iter().enumerate() {
            let from = &values[(self.pivots + column) * 2 * ld + self.pivots..][..2 * ld - self.pivots];
            let to = &mut next[*to as usize * 2 * next_ld..][..2 * next_ld];
            for (row, to_row) in self.next.iter().enumerate().skip(column) {
                let to_row = *to_row as usize;
                to[to_row] += from[row];
                to[next_ld + to_row] += from[ld + row];
            }
        }
        columns.truncate(2 * self.groups() * self.pivots);
        columns.shrink_to_fit();
    }
}

apart! {
    /// Eliminate the first columns of a front of `size` rows in `groups`, as many as there are `inverses` of pivots.
    fn eliminate(columns: &mut [Group], groups: usize, size: usize, inverses: &mut [Pair]) -> () = inlined::eliminate;
}

apart! {
    /// Take what a front knows of right sides on its rows out of those of the later ones.
    fn forward(columns: &[Group], groups: usize, inverses: &[Pair], sides: &mut [Group]) -> () = inlined::forward;
}

apart! {
    /// Solve for the right sides on the columns of a front, those of the later rows known.
    fn backward(columns: &[Group], groups: usize, inverses: &[Pair], sides: &mut [Group]) -> () = inlined::backward;
}

/// What is compiled for the registers of the machine.
mod inlined {
    use super::{turned, Group, Lanes, Pair, BLOCK, LANES};

    #[inline(always)]
    pub(super) fn eliminate<W: Lanes>(
        columns: &mut [Group],
        groups: usize,
        size: usize,
        inverses: &mut [Pair],
    ) {
        let (stride, pivots) = (2 * groups, inverses.len());
        // Columns of a block before they are divided by their pivots.
        let mut whole = vec![[0.0; LANES]; BLOCK * stride];
        let mut start = 0;
        while start < pivots {
            let end = pivots.min(start + BLOCK);
            for c in start..end {
                let (done, later) = columns.split_at_mut(c * stride);
                let column = &mut later[..stride];
                subtract::<W>(&done[start * stride..], &whole, c - start, c, column);
                let first = c / LANES;
                let (real, imag) = (column[first][c % LANES], column[groups + first][c % LANES]);
                let length = real * real + imag * imag;
                let inverse = [real / length, -imag / length];
                inverses[c] = inverse;
                whole[(c - start) * stride..][..stride].copy_from_slice(column);
                let [a, b, minus] = [W::all(inverse[0]), W::all(inverse[1]), W::all(-inverse[1])];
                for g in first..groups {
                    let (x, y) = (W::load(&column[g]), W::load(&column[groups + g]));
                    a.fma(x, minus.fma(y, W::all(0.0))).store(&mut column[g]);
                    a.fma(y, b.fma(x, W::all(0.0))).store(&mut column[groups + g]);
                }
            }
            let (done, later) = columns.split_at_mut(end * stride);
            for c in end..size {
                let column = &mut later[(c - end) * stride..][..stride];
                subtract::<W>(&done[start * stride..], &whole, end - start, c, column);
            }
            start = end;
        }
    }

    /// Take the products of `count` divided columns with the row of column `c` in the `whole` ones out of it.
    #[inline(always)]
    fn subtract<W: Lanes>(done: &[Group], whole: &[Group], count: usize, c: usize, column: &mut [Group]) {
        match count {
            0 => {}
            1 => times::<W, 1>(done, whole, c, column),
            2 => times::<W, 2>(done, whole, c, column),
            3 => times::<W, 3>(done, whole, c, column),
            4 => times::<W, 4>(done, whole, c, column),
            5 => times::<W, 5>(done, whole, c, column),
            6 => times::<W, 6>(done, whole, c, column),
            7 => times::<W, 7>(done, whole, c, column),
            _ => times::<W, BLOCK>(done, whole, c, column),
        }
    }

    #[inline(always)]
    fn times<W: Lanes, const N: usize>(done: &[Group], whole: &[Group], c: usize, column: &mut [Group]) {
        let stride = column.len();
        let (groups, first) = (stride / 2, c / LANES);
        let (done, whole) = (&done[..N * stride], &whole[..N * stride]);
        let mut with = [[W::all(0.0); 3]; N];
        for n in 0..N {
            let row = [
                whole[n * stride + first][c % LANES],
                whole[n * stride + groups + first][c % LANES],
            ];
            with[n] = [W::all(-row[0]), W::all(row[1]), W::all(-row[1])];
        }
        let (real, imag) = column.split_at_mut(groups);
        for g in first..groups {
            let (mut x, mut y) = (W::load(&real[g]), W::load(&imag[g]));
            for n in 0..N {
                let (a, b) = (
                    W::load(&done[n * stride + g]),
                    W::load(&done[n * stride + groups + g]),
                );
                let [less, other, other_less] = with[n];
                x = other.fma(b, less.fma(a, x));
                y = less.fma(b, other_less.fma(a, y));
            }
            x.store(&mut real[g]);
            y.store(&mut imag[g]);
        }
    }

    #[inline(always)]
    pub(super) fn forward<W: Lanes>(
        columns: &[Group],
        groups: usize,
        inverses: &[Pair],
        sides: &mut [Group],
    ) {
        for (c, inverse) in inverses.iter().enumerate() {
            let column = columns[c * 2 * groups..][..2 * groups].as_flattened();
            let (real, imag) = column.split_at(groups * LANES);
            let (known, later) = sides[c..].split_at_mut(1);
            let (x, y) = (W::load(&known[0]), W::load(&turned(&known[0])));
            for (r, side) in later.iter_mut().enumerate() {
                let row = c + 1 + r;
                let (a, b) = (W::all(-real[row]), W::all(-imag[row]));
                b.fma(y, a.fma(x, W::load(side))).store(side);
            }
            let (a, b) = (W::all(inverse[0]), W::all(inverse[1]));
            b.fma(y, a.fma(x, W::all(0.0))).store(&mut known[0]);
        }
    }

    #[inline(always)]
    pub(super) fn backward<W: Lanes>(
        columns: &[Group],
        groups: usize,
        inverses: &[Pair],
        sides: &mut [Group],
    ) {
        for c in (0..inverses.len()).rev() {
            let column = columns[c * 2 * groups..][..2 * groups].as_flattened();
            let (real, imag) = column.split_at(groups * LANES);
            let (own, later) = sides[c..].split_at_mut(1);
            let (mut sum, mut aside) = (W::load(&own[0]), W::all(0.0));
            for (r, side) in later.iter().enumerate() {
                let row = c + 1 + r;
                let x = W::load(side);
                sum = W::all(-real[row]).fma(x, sum);
                aside = W::all(-imag[row]).fma(x, aside);
            }
            let mut by = [0.0; LANES];
            aside.store(&mut by);
            sum.add(W::load(&turned(&by))).store(&mut own[0]);
        }
    }
}

/// Numbers times the imaginary unit.
#[inline(always)]
fn turned(group: &Group) -> Group {
    let mut result = *group;
    for pair in 0..PAIRS {
        result[2 * pair] = -group[2 * pair + 1];
        result[2 * pair + 1] = group[2 * pair];
    }
    result
}

/// The place of each unknown in an order; none where one is missing.
fn places(order: &[u32]) -> Option<Vec<u32>> {
    let mut place = vec![u32::MAX; order.len()];
    for (k, unknown) in order.iter().enumerate() {
        *place.get_mut(*unknown as usize)? = k as u32;
    }
    (!place.contains(&u32::MAX)).then_some(place)
}

/// The next place at which the elimination of each place fills a row, that of the last ones their number (Liu 1990).
fn elimination_tree(starts: &[usize], rows: &[u32], order: &[u32], place: &[u32]) -> Vec<usize> {
    let size = order.len();
    let (mut parents, mut oldest) = (vec![size; size], vec![size; size]);
    for (k, unknown) in order.iter().enumerate() {
        let unknown = *unknown as usize;
        for row in &rows[starts[unknown]..starts[unknown + 1]] {
            let mut at = place[*row as usize] as usize;
            while at < k {
                let next = std::mem::replace(&mut oldest[at], k);
                if next == size {
                    parents[at] = k;
                    break;
                }
                at = next;
            }
        }
    }
    parents
}

/// An order in which all that comes before a place follows on one another.
fn postorder(parents: &[usize]) -> Vec<usize> {
    let size = parents.len();
    let mut children = vec![Vec::new(); size + 1];
    for (k, parent) in parents.iter().enumerate() {
        children[*parent].push(k);
    }
    let (mut order, mut open) = (Vec::with_capacity(size), std::mem::take(&mut children[size]));
    // From the last place back, and turned round.
    while let Some(k) = open.pop() {
        order.push(k);
        open.append(&mut children[k]);
    }
    order.reverse();
    order
}

/// The fronts of a matrix, in an order where all that comes before a place follows on one another.
fn fronts(starts: &[usize], rows: &[u32], order: &[u32], place: &[u32]) -> Option<Vec<Front>> {
    let size = order.len();
    let parents = elimination_tree(starts, rows, order, place);
    let mut below: Vec<Vec<u32>> = Vec::with_capacity(size);
    let mut children = vec![Vec::new(); size + 1];
    let mut seen = vec![usize::MAX; size];
    for k in 0..size {
        let unknown = order[k] as usize;
        let mut found = Vec::new();
        let own = rows[starts[unknown]..starts[unknown + 1]]
            .iter()
            .map(|row| place[*row as usize]);
        let passed = children[k]
            .iter()
            .flat_map(|child: &usize| below[*child].iter().copied());
        for row in own.chain(passed) {
            if row as usize > k && seen[row as usize] != k {
                seen[row as usize] = k;
                found.push(row);
            }
        }
        found.sort_unstable();
        below.push(found);
        children[parents[k]].push(k);
    }
    // First column, the one after the last, and how many of the entries are zero.
    let mut spans: Vec<(usize, usize, usize)> = Vec::new();
    for k in 0..size {
        match spans.last_mut() {
            Some(span) if parents[k - 1] == k && below[k - 1].len() == below[k].len() + 1 => span.1 = k + 1,
            _ => spans.push((k, k + 1, 0)),
        }
    }
    let mut joined: Vec<(usize, usize, usize)> = Vec::new();
    for mut span in spans {
        while let Some(&(first, end, zeros)) = joined.last() {
            if parents[end - 1] >= span.1 {
                break;
            }
            let (count, rest) = (end - first, below[span.1 - 1].len());
            let zeros = zeros + span.2 + count * (span.1 - span.0 + rest - below[end - 1].len());
            let pivots = span.1 - first;
            if pivots > FEW && zeros as f64 > ZEROS * (pivots * (pivots / 2 + rest)) as f64 {
                break;
            }
            span = (first, span.1, zeros);
            joined.pop();
        }
        joined.push(span);
    }
    let mut front_of = vec![0; size];
    for (number, (first, end, _)) in joined.iter().enumerate() {
        front_of[*first..*end].fill(number);
    }
    let mut fronts: Vec<Front> = joined
        .iter()
        .map(|(first, end, _)| {
            let rows = (*first as u32..*end as u32)
                .chain(below[end - 1].iter().copied())
                .collect();
            Front {
                first: *first,
                pivots: end - first,
                rows,
                before: Vec::new(),
                next: Vec::new(),
                entries: Vec::new(),
            }
        })
        .collect();
    for number in 0..fronts.len() {
        let later = &fronts[number].rows[fronts[number].pivots..];
        let Some(row) = later.first() else { continue };
        let parent = front_of[*row as usize];
        let next = later
            .iter()
            .map(|row| fronts[parent].at(*row))
            .collect::<Option<_>>()?;
        fronts[number].next = next;
        fronts[parent].before.push(number);
    }
    for (unknown, column) in place.iter().enumerate() {
        let front = &mut fronts[front_of[*column as usize]];
        let stride = 2 * front.groups() * LANES;
        for entry in starts[unknown]..starts[unknown + 1] {
            let row = place[rows[entry] as usize];
            if row >= *column {
                let to = (*column as usize - front.first) * stride + front.at(row)? as usize;
                front.entries.push((entry as u32, to as u32));
            }
        }
    }
    Some(fronts)
}

#[cfg(test)]
mod tests {
    use super::{Pair, Pattern};

    fn times(a: Pair, b: Pair) -> Pair {
        [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
    }

    /// Columns of a grid of so many places in rows and columns, each coupled with all about it.
    fn grid(side: usize) -> (Vec<usize>, Vec<u32>, Vec<Pair>) {
        let (mut starts, mut rows, mut entries) = (vec![0], Vec::new(), Vec::new());
        for j in 0..side * side {
            for i in 0..side * side {
                let apart = (i / side).abs_diff(j / side).max((i % side).abs_diff(j % side));
                if apart < 2 {
                    let (low, high) = (i.min(j) as f64, i.max(j) as f64);
                    rows.push(i as u32);
                    entries.push(if i == j {
                        [(0.7 * low).sin(), 9.0]
                    } else {
                        [(low + 3.0 * high).cos(), 0.5]
                    });
                }
            }
            starts.push(rows.len());
        }
        (starts, rows, entries)
    }

    #[test]
    fn factors_of_a_grid_solve_for_many_right_sides() {
        for (side, count) in [(1, 1), (4, 3), (9, 4), (13, 11)] {
            let (starts, rows, entries) = grid(side);
            let size = side * side;
            // In stripes, so that fronts join and split.
            let order: Vec<u32> = (0..5).flat_map(|first| (first..size as u32).step_by(5)).collect();
            let pattern = Pattern::new(&starts, &rows, &order).expect("a pattern");
            let factors = pattern.factors(&entries).expect("entries of it");
            let wanted: Vec<Pair> = (0..size * count)
                .map(|k| [(k as f64).sin(), (2.0 * k as f64).cos()])
                .collect();
            let mut sides = vec![[0.0; 2]; size * count];
            for j in 0..size {
                for entry in starts[j]..starts[j + 1] {
                    for k in 0..count {
                        let product = times(entries[entry], wanted[j * count + k]);
                        let side = &mut sides[rows[entry] as usize * count + k];
                        *side = [side[0] + product[0], side[1] + product[1]];
                    }
                }
            }
            pattern.solve(&factors, sides.as_flattened_mut(), count);
            for (found, wanted) in sides.as_flattened().iter().zip(wanted.as_flattened()) {
                assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
            }
        }
    }

    #[test]
    fn what_is_no_matrix_has_no_pattern() {
        assert!(Pattern::new(&[0, 1], &[0], &[0]).is_some());
        assert!(Pattern::new(&[0, 1], &[1], &[0]).is_none());
        assert!(Pattern::new(&[0, 1, 2], &[0, 1], &[0, 0]).is_none());
        assert!(Pattern::new(&[0, 2], &[0], &[0]).is_none());
        // On one side of the diagonal alone.
        assert!(Pattern::new(&[0, 1, 3], &[0, 0, 1], &[0, 1]).is_none());
    }
}
