//! Rays in flight.

use crate::geom::Ray;
use crate::tracer::Best;
use crate::tracer::triangle_test::HostRay;

/// Id of a ray given to the engine, in the order of submission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ticket(pub u64);

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Waiting {
    pub(super) flight: u32,
    /// Parameter at which the ray leaves the cell, in multiples of its direction.
    pub(super) leave: f64,
}

/// Rays that wait for a GPU cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Cache {
    pub(super) rays: Vec<Waiting>,
    /// Number of the cell's entries in the queue of full cells: one per full pass of rays.
    pub(super) turns: usize,
}

impl Cache {
    pub(super) fn bytes(&self) -> usize {
        self.rays.capacity() * size_of::<Waiting>()
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct RayInFlight {
    pub(super) ticket: Ticket,
    pub(super) ray: Ray,
    pub(super) host: HostRay,
    pub(super) best: Best,
    /// `true` if the ray was tested on the card.
    pub(super) on_card: bool,
}

#[derive(Clone, Debug, Default)]
pub(super) struct RaysInFlight {
    places: Vec<RayInFlight>,
    free: Vec<u32>,
}

impl RaysInFlight {
    pub(super) fn start(&mut self, ticket: Ticket, ray: Ray, host: HostRay) -> u32 {
        let flight = RayInFlight { ticket, ray, host, best: Best::default(), on_card: false };
        if let Some(place) = self.free.pop() {
            self.places[place as usize] = flight;
            return place;
        }
        self.places.push(flight);
        (self.places.len() - 1) as u32
    }

    pub(super) fn at(&mut self, place: u32) -> &mut RayInFlight {
        &mut self.places[place as usize]
    }

    pub(super) fn end(&mut self, place: u32) -> RayInFlight {
        self.free.push(place);
        self.places[place as usize]
    }

    pub(super) fn bytes(&self) -> usize {
        self.places.capacity() * size_of::<RayInFlight>() + self.free.capacity() * size_of::<u32>()
    }
}
