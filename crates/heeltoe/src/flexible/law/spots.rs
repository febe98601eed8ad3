//! Which share of its crack belongs to each contact, and which ends stand for one another.

use super::super::contact::{Contactor, Contacts};
use super::super::dam::Dam;
use super::super::sides::Place;

/// What a contact has of its crack.
pub(super) struct Spot {
    /// Its share of the length (m), see [`shares`].
    pub length: f64,
    /// The contact, counted in its crack, of the other face's end in whose place it comes; none of a contact that is there
    /// from the beginning.
    pub double: Option<usize>,
}

/// Find those of all contacts, crack by crack.
pub(super) fn spots(dam: &Dam, contacts: &Contacts) -> Vec<Vec<Spot>> {
    let faces = dam.bodies.faces(|body| &body.position);
    let places = Place::all(dam);
    let each = places.iter().zip(contacts.of_cracks());
    each.map(|(place, own)| {
        let meeting = place.of(faces);
        let shares = [meeting.upper, meeting.lower].map(|face| shares(face.along));
        let contactors = &contacts.contactors[own];
        // Where all nodes of both faces are watched, each place is there twice.
        let twice = dam.contactors == 5 && !shares[1].is_empty();
        let spot = |contactor: &Contactor| {
            let face = usize::from(!contactor.of_upper);
            Spot {
                length: shares[face][contactor.node] * if twice { 0.5 } else { 1.0 },
                double: double(contactor, contactors, shares[1 - face].len()),
            }
        };
        contactors.iter().map(spot).collect()
    })
    .collect()
}

/// Length of a face that belongs to each node, as a uniform stress makes forces on them: of an edge of three nodes, which
/// eight-node elements have, a sixth, four and a sixth. A face of an even number of nodes has edges of two.
fn shares(along: &[f64]) -> Vec<f64> {
    let of_edge: &[f64] = if along.len() % 2 == 1 {
        &[1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0]
    } else {
        &[0.5, 0.5]
    };
    let mut shares = vec![0.0; along.len()];
    let last = of_edge.len() - 1;
    for first in (0..along.len().saturating_sub(1)).step_by(last) {
        let length = along[first + last] - along[first];
        for (k, share) in of_edge.iter().enumerate() {
            shares[first + k] += share * length;
        }
    }
    shares
}

fn double(contactor: &Contactor, all: &[Contactor], others: usize) -> Option<usize> {
    if contactor.closed {
        return None;
    }
    let end = if contactor.node == 0 { 0 } else { others - 1 };
    all.iter()
        .position(|other| other.closed && other.of_upper != contactor.of_upper && other.node == end)
}

#[cfg(test)]
mod tests {
    use super::shares;

    #[test]
    fn a_uniform_stress_presses_each_node_by_its_share() {
        // Two edges of quadratic shape functions, of lengths 6 and 12.
        assert_eq!(shares(&[0.0, 3.0, 6.0, 12.0, 18.0]), [1.0, 4.0, 3.0, 8.0, 2.0]);
        // Linear ones.
        assert_eq!(shares(&[0.0, 3.0, 6.0, 12.0]), [1.5, 3.0, 4.5, 3.0]);
    }
}
