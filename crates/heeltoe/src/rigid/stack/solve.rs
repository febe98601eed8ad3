//! Systems of up to six equations.

/// Contact coordinates or reactions of the lower crack, and behind them those of the upper one.
pub(super) type Six = [f64; 6];

pub(super) type Square = [Six; 6];

/// A matrix taken apart by Gauss with pivots from its columns.
pub(super) struct Factors {
    rows: Square,
    order: [usize; 6],
    /// Product of the pivots with the sign of their order.
    pub determinant: f64,
}

impl Factors {
    pub(super) fn new(mut rows: Square) -> Self {
        let mut order = [0, 1, 2, 3, 4, 5];
        let mut determinant = 1.0;
        for k in 0..6 {
            let mut best = k;
            for i in k + 1..6 {
                if rows[i][k].abs() > rows[best][k].abs() {
                    best = i;
                }
            }
            if best != k {
                rows.swap(best, k);
                order.swap(best, k);
                determinant = -determinant;
            }
            let pivot = rows[k];
            determinant *= pivot[k];
            if pivot[k] == 0.0 {
                return Factors {
                    rows,
                    order,
                    determinant: 0.0,
                };
            }
            for row in &mut rows[k + 1..] {
                let factor = row[k] / pivot[k];
                row[k] = factor;
                for j in k + 1..6 {
                    row[j] -= factor * pivot[j];
                }
            }
        }
        Factors {
            rows,
            order,
            determinant,
        }
    }

    /// What solves the equations with this right-hand side; the determinant is not zero.
    pub(super) fn solve(&self, right: &Six) -> Six {
        let mut x = self.order.map(|i| right[i]);
        for i in 0..6 {
            for j in 0..i {
                x[i] -= self.rows[i][j] * x[j];
            }
        }
        for i in (0..6).rev() {
            for j in i + 1..6 {
                x[i] -= self.rows[i][j] * x[j];
            }
            x[i] /= self.rows[i][i];
        }
        x
    }
}
