//! Which share of its crack belongs to each contact, and which ends stand for one another.

use super::super::contact::{Contactor, Contacts};
use super::super::dam::Dam;
use super::super::sides::Place;
use super::super::stance::lengths;

/// What a contact has of its crack.
pub(super) struct Spot {
    /// Its share of the length (m).
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
        let shares = [meeting.upper, meeting.lower].map(|face| lengths(face.along));
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

fn double(contactor: &Contactor, all: &[Contactor], others: usize) -> Option<usize> {
    if contactor.closed {
        return None;
    }
    let end = if contactor.node == 0 { 0 } else { others - 1 };
    all.iter()
        .position(|other| other.closed && other.of_upper != contactor.of_upper && other.node == end)
}
