//! Rays on their way.

use crate::geom::{Hit, Ray};
use crate::tracer::Best;
use crate::tracer::triangle_test::HostRay;

/// A ray given to the engine, by the order of giving.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ticket(pub u64);

/// A ray in a GPU cell's cache.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Waiting {
    pub(super) flight: u32,
    /// Where the ray leaves the cell, in multiples of its direction.
    pub(super) leave: f64,
}

/// The rays that wait for a GPU cell.
#[derive(Clone, Debug, Default)]
pub(super) struct Cache {
    pub(super) rays: Vec<Waiting>,
    /// How often the cell stands in the queue of full cells: once for each whole pass of rays.
    pub(super) turns: usize,
}

impl Cache {
    pub(super) fn bytes(&self) -> usize {
        self.rays.capacity() * size_of::<Waiting>()
    }
}

/// A ray that has no answer yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct RayInFlight {
    pub(super) ticket: Ticket,
    pub(super) ray: Ray,
    pub(super) host: HostRay,
    pub(super) best: Best,
    /// Whether it has met the card.
    pub(super) on_card: bool,
    /// The last triangle that the card hit, with what it computed there.
    pub(super) uvw: Option<(u32, [f32; 3])>,
}

/// A ray that has its answer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answered {
    pub(super) ticket: Ticket,
    pub(super) hit: Option<Hit>,
    /// What the card computed of the hit, if it did.
    pub(super) uvw: Option<[f32; 3]>,
}

/// All of them, in places that are used again.
#[derive(Clone, Debug, Default)]
pub(super) struct RaysInFlight {
    places: Vec<RayInFlight>,
    free: Vec<u32>,
    given: u64,
}

impl RaysInFlight {
    /// Rays given so far: the next ticket.
    pub(super) fn given(&self) -> u64 {
        self.given
    }

    /// So many tickets more have been given.
    pub(super) fn give(&mut self, rays: usize) {
        self.given += rays as u64;
    }

    pub(super) fn start(&mut self, ticket: Ticket, ray: Ray, host: HostRay) -> u32 {
        let flight = RayInFlight { ticket, ray, host, best: Best::default(), on_card: false, uvw: None };
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

    /// Takes a ray out; its place is free again.
    pub(super) fn end(&mut self, place: u32) -> RayInFlight {
        self.free.push(place);
        self.places[place as usize]
    }

    pub(super) fn bytes(&self) -> usize {
        self.places.capacity() * size_of::<RayInFlight>() + self.free.capacity() * size_of::<u32>()
    }
}
