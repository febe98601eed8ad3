//! Which share of its crack belongs to each contact, and which ends stand for one another.

use super::super::contact::{Contactor, Contacts};
use super::super::dam::Dam;
use super::super::faces::{Faces, Meeting};
use super::super::place::Place;

/// What a contact has of its crack.
pub(in super::super) struct Spot {
    /// Its share of the length (m), see [`shares`].
    pub length: f64,
    /// The contact, counted in its crack, of the other face's end or corner in whose place it comes; none of a contact that
    /// is there from the beginning.
    pub double: Option<usize>,
}

/// Find those of all contacts, crack by crack.
pub(in super::super) fn spots(dam: &Dam, contacts: &Contacts) -> Vec<Vec<Spot>> {
    let places = Place::all(&dam.cracks);
    let cracks = places
        .iter()
        .zip(&dam.cracks)
        .zip(contacts.of_cracks())
        .enumerate();
    cracks
        .map(|(crack, ((place, line), own))| {
            let meeting = place.of(Faces::around(crack, &dam.bodies, |body| &body.position));
            let shares = [
                shares(meeting.upper.along, &line.angles[0]),
                shares(meeting.lower.along, &line.angles[1]),
            ];
            let contactors = &contacts.contactors[own];
            // Where all nodes of both faces are watched, each place is there twice.
            let twice = dam.contactors == 5 && !shares[1].is_empty();
            let spot = |contactor: &Contactor| {
                let face = usize::from(!contactor.of_upper);
                Spot {
                    length: shares[face][contactor.node] * if twice { 0.5 } else { 1.0 },
                    double: double(contactor, contactors, meeting),
                }
            };
            contactors.iter().map(spot).collect()
        })
        .collect()
}

/// Length of a face that belongs to each node, as a uniform stress makes forces on them: of an edge of three nodes, which
/// eight-node elements have, a sixth, four and a sixth. A face of an even number of nodes has edges of two. An edge at an
/// angle to the line from heel to toe is longer than it is along that line.
fn shares(along: &[f64], angles: &[f64]) -> Vec<f64> {
    let of_edge: &[f64] = if along.len() % 2 == 1 {
        &[1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0]
    } else {
        &[0.5, 0.5]
    };
    let mut shares = vec![0.0; along.len()];
    let last = of_edge.len() - 1;
    for first in (0..along.len().saturating_sub(1)).step_by(last) {
        let turned = angles.get(first).map_or(1.0, |angle| angle.cos());
        let length = (along[first + last] - along[first]) / turned;
        for (k, share) in of_edge.iter().enumerate() {
            shares[first + k] += share * length;
        }
    }
    shares
}

fn double(contactor: &Contactor, all: &[Contactor], faces: Meeting) -> Option<usize> {
    if contactor.closed {
        return None;
    }
    let (own, other) = if contactor.of_upper {
        (faces.upper.along, faces.lower.along)
    } else {
        (faces.lower.along, faces.upper.along)
    };
    let away = |node: usize| (other[node] - own[contactor.node]).abs();
    let met = match contactor.node {
        0 => 0,
        node if node + 1 == own.len() => other.len() - 1,
        _ => (0..other.len()).min_by(|a, b| away(*a).total_cmp(&away(*b)))?,
    };
    all.iter()
        .position(|other| other.closed && other.of_upper != contactor.of_upper && other.node == met)
}

#[cfg(test)]
mod tests {
    use super::shares;

    #[test]
    fn a_uniform_stress_presses_each_node_by_its_share() {
        // Two edges of quadratic shape functions, of lengths 6 and 12.
        assert_eq!(
            shares(&[0.0, 3.0, 6.0, 12.0, 18.0], &[]),
            [1.0, 4.0, 3.0, 8.0, 2.0]
        );
        // Linear ones.
        assert_eq!(shares(&[0.0, 3.0, 6.0, 12.0], &[]), [1.5, 3.0, 4.5, 3.0]);
    }

    #[test]
    fn a_slope_is_longer_than_it_is_wide() {
        let slope = 0.8_f64.acos();
        let found = shares(&[0.0, 4.0, 8.0, 12.0], &[slope, -slope, 0.0]);
        for (found, expected) in found.iter().zip([2.5, 5.0, 4.5, 2.0]) {
            assert!((found - expected).abs() < 1e-14, "{found}");
        }
    }
}
