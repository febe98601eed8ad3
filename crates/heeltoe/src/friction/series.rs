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
    /// The tangent of so many angles per natural logarithm of the stress; stress at the start, and its change.
    Tangent { rate: f64, stress: [f64; 2] },
}

/// A coefficient of friction whose terms are asked for one after the other.
pub(crate) struct Unfolding {
    rule: Rule,
    first: f64,
    /// Of the exponential or the tangent.
    terms: Terms,
    /// Of the angle, and of one over the square of its cosine.
    angle: Terms,
    square: Terms,
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
        let mut angle = [0.0; TERMS];
        let mut square = [0.0; TERMS];
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
                        square[0] = 1.0 + first * first;
                        let rate = -roughness.to_radians() / std::f64::consts::LN_10;
                        Rule::Tangent { rate, stress }
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
        angle[0] = 0.0;
        Some(Unfolding {
            rule,
            first,
            terms,
            angle,
            square,
        })
    }
}

impl Unfolding {
    /// Term n, where those of the path and of its rate of change up to that one are known.
    pub(crate) fn term(&mut self, n: usize, path: &Terms, rate_of_path: &Terms) -> f64 {
        if n == 0 {
            return self.first;
        }
        let count = n as f64;
        match self.rule {
            Rule::Level => 0.0,
            Rule::Path(factor) => factor * path[n],
            Rule::Straight(change) => {
                if n == 1 {
                    change
                } else {
                    0.0
                }
            }
            Rule::Fading { rate, drop, by_speed } => {
                let by = if by_speed { rate_of_path } else { path };
                self.terms[n] = rate * grown(by, &self.terms, n) / count;
                drop * self.terms[n]
            }
            Rule::Tangent { rate, stress } => {
                let [now, change] = stress;
                let before = (count - 1.0) * self.angle[n - 1] / rate;
                let logarithm = if n == 1 { change } else { -before * change } / (count * now);
                self.angle[n] = rate * logarithm;
                self.terms[n] = grown(&self.angle, &self.square, n) / count;
                self.square[n] = (0..=n).map(|k| self.terms[k] * self.terms[n - k]).sum();
                self.terms[n]
            }
        }
    }
}

/// `1 a_1 b_(n-1) + 2 a_2 b_(n-2) + ... + n a_n b_0`.
fn grown(a: &Terms, b: &Terms, n: usize) -> f64 {
    (1..=n).map(|k| k as f64 * a[k] * b[n - k]).sum()
}
