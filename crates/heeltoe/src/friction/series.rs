//! The coefficient of friction along a slide as a power series in time, term by term from those of what it goes by.
//!
//! With the path r, the speed v and the normal stress s, which is a straight line in time, each term follows from the
//! ones before it (Jorba and Zou, A software package for the numerical integration of ODEs by means of high-order Taylor
//! methods, Experimental Mathematics 14, 2005):
//!
//! | function | terms |
//! | --- | --- |
//! | `e = exp(-r/D)`, or of v | `n e_n = -1/D (1 r_1 e_(n-1) + ... + n r_n e_0)` |
//! | `l = ln s` | `n l_n s_0 = s_1 (n = 1), -(n - 1) l_(n-1) s_1` |
//! | `y = tan z` | `n y_n = 1 z_1 q_(n-1) + ... + n z_n q_0`, `q = 1 + y^2` |

use super::{between, Law, LawNumbers, Shape, FADED, STEEPEST};

/// Most terms of a series.
pub(crate) const TERMS: usize = 26;
/// A series, in powers of the time over its length.
pub(crate) type Terms = [f64; TERMS];

/// One over each whole number, as integrals of a series ask for.
pub(crate) const INVERSE: [f64; TERMS + 1] = {
    let mut inverse = [0.0; TERMS + 1];
    let mut n = 1;
    while n <= TERMS {
        inverse[n] = 1.0 / n as f64;
        n += 1;
    }
    inverse
};

/// How the terms go on.
enum Rule {
    /// No further terms.
    Level,
    /// So much of the path's.
    Path(f64),
    /// One more term.
    Straight(f64),
    /// An exponential of the path's, or of those of the path per unit of time, times these; it falls by so much.
    Fading { rate: f64, drop: f64, by_speed: bool },
    /// The tangent of an angle, so much of it per natural logarithm of the stress; stress at the start, and its change;
    /// terms of the angle and of one over the square of its cosine.
    Tangent {
        rate: f64,
        stress: [f64; 2],
        angle_and_square: Box<[Terms; 2]>,
    },
}

/// A coefficient of friction whose terms are asked for one after the other.
pub(crate) struct Unfolding {
    rule: Rule,
    first: f64,
    /// Of the exponential or the tangent.
    terms: Terms,
}

impl Law {
    /// Begin at a path, a speed and a normal stress that changes by so much; time counts in so many seconds. None where a
    /// corner of the law lies on the way.
    pub(crate) fn unfold(&self, path: f64, speed: f64, stress: [f64; 2], unit: f64) -> Option<Unfolding> {
        let LawNumbers {
            peak,
            residual,
            scale,
            roughness,
            residual_angle,
            ..
        } = self.numbers;
        let [[_, [first, _]], [_, [last, _]]] =
            [stress[0], stress[0] + stress[1]].map(|stress| self.friction(stress, speed, path));
        let drop = peak - residual;
        let fading = |rate: f64, by_speed: bool| Rule::Fading { rate, drop, by_speed };
        let mut terms = [0.0; TERMS];
        let rule = match self.shape {
            Shape::Constant => Rule::Level,
            Shape::Linear if path >= scale => Rule::Level,
            Shape::Linear => Rule::Path(-drop / scale),
            Shape::Exponential if path >= FADED * scale => Rule::Level,
            Shape::Exponential => {
                terms[0] = (-path / scale).exp();
                fading(-1.0 / scale, false)
            }
            Shape::Speed => {
                terms[0] = (-speed / scale).exp();
                fading(-1.0 / (scale * unit), true)
            }
            Shape::Barton => {
                let held = |value: f64| value == residual_angle.tan() || value == STEEPEST.tan();
                match (held(first), held(last)) {
                    (true, true) if first == last => Rule::Level,
                    (false, false) => {
                        terms[0] = first;
                        let mut square = [0.0; TERMS];
                        square[0] = 1.0 + first * first;
                        Rule::Tangent {
                            rate: -roughness.to_radians() / std::f64::consts::LN_10,
                            stress,
                            angle_and_square: Box::new([[0.0; TERMS], square]),
                        }
                    }
                    _ => return None,
                }
            }
            Shape::Lift => {
                let [_, slope] = between(&self.points, stress[0]);
                let change = slope * stress[1];
                if (first + change - last).abs() > 4.0 * f64::EPSILON * first.abs() {
                    return None;
                }
                Rule::Straight(change)
            }
        };
        Some(Unfolding { rule, first, terms })
    }
}

impl Unfolding {
    /// Term n, where those of the path and of its rate of change up to that one are known.
    pub(crate) fn term(&mut self, n: usize, path: &Terms, rate_of_path: &Terms) -> f64 {
        if n == 0 {
            return self.first;
        }
        let count = n as f64;
        match &mut self.rule {
            Rule::Level => 0.0,
            Rule::Path(factor) => *factor * path[n],
            Rule::Straight(change) => {
                if n == 1 {
                    *change
                } else {
                    0.0
                }
            }
            Rule::Fading { rate, drop, by_speed } => {
                let by = if *by_speed { rate_of_path } else { path };
                self.terms[n] = *rate * grown(by, &self.terms, n) * INVERSE[n];
                *drop * self.terms[n]
            }
            Rule::Tangent {
                rate,
                stress: [now, change],
                angle_and_square,
            } => {
                let [angle, square] = &mut **angle_and_square;
                let logarithm = if n == 1 {
                    *change
                } else {
                    -(count - 1.0) * angle[n - 1] / *rate * *change
                };
                angle[n] = *rate * logarithm / (count * *now);
                self.terms[n] = grown(angle, square, n) * INVERSE[n];
                square[n] = (0..=n).map(|k| self.terms[k] * self.terms[n - k]).sum();
                self.terms[n]
            }
        }
    }
}

/// `1 a_1 b_(n-1) + 2 a_2 b_(n-2) + ... + n a_n b_0`.
fn grown(a: &Terms, b: &Terms, n: usize) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for k in 1..=n {
        count += 1.0;
        sum += count * a[k] * b[n - k];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::friction::Law;

    const WAY: [f64; 4] = [0.0, 0.8, -0.3, 0.1];
    const UNIT: f64 = 0.5;

    /// The series of a law on this way from a path and a speed on, and its value at a moment.
    fn series(law: &Law, path: f64, stress: [f64; 2], t: f64) -> f64 {
        let (mut way, mut rate) = ([0.0; TERMS], [0.0; TERMS]);
        way[..4].copy_from_slice(&WAY);
        for n in 1..4 {
            rate[n - 1] = n as f64 * WAY[n];
        }
        let mut unfolding = law.unfold(path, rate[0] / UNIT, stress, UNIT).unwrap();
        let mut sum = 0.0;
        for n in 0..TERMS {
            sum += unfolding.term(n, &way, &rate) * t.powi(n as i32);
        }
        sum
    }

    fn law(shape: Shape, points: &[[f64; 2]]) -> Law {
        let numbers = LawNumbers {
            peak: 1.1,
            residual: 0.7,
            scale: 2.0,
            roughness: 10.0,
            wall_strength: 50e6,
            residual_angle: 30f64.to_radians(),
            ..LawNumbers::default()
        };
        Law::new(shape, &numbers, points.to_vec())
    }

    #[test]
    fn the_series_of_every_law_is_the_law() {
        let points = [[0.0, 0.5], [1e6, 0.2], [2e6, 0.0]];
        let stress = [1.2e6, -1.5e5];
        for shape in [
            Shape::Constant,
            Shape::Linear,
            Shape::Exponential,
            Shape::Speed,
            Shape::Barton,
            Shape::Lift,
        ] {
            let law = law(shape, &points);
            for t in [0.0, 0.4, 1.0] {
                let path = 0.3 + t * (WAY[1] + t * (WAY[2] + t * WAY[3]));
                let speed = (WAY[1] + t * (2.0 * WAY[2] + t * 3.0 * WAY[3])) / UNIT;
                let [_, expected] = law.coefficients(stress[0] + t * stress[1], speed, path);
                let value = series(&law, 0.3, stress, t);
                assert!(
                    (value - expected).abs() < 1e-13,
                    "{shape:?} {t}: {value} {expected}"
                );
            }
        }
    }

    #[test]
    fn a_corner_on_the_way_has_no_series() {
        let points = [[0.0, 0.5], [1e6, 0.2], [2e6, 0.0]];
        assert!(law(Shape::Lift, &points)
            .unfold(0.0, 0.0, [1.1e6, -2e5], 1.0)
            .is_none());
        assert!(law(Shape::Barton, &[])
            .unfold(0.0, 0.0, [49e6, 2e6], 1.0)
            .is_none());
        assert!(law(Shape::Barton, &[])
            .unfold(0.0, 0.0, [51e6, 2e6], 1.0)
            .is_some());
    }
}
