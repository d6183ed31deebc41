//! Rays on their way.

use crate::geom::Ray;
use crate::ray_engine::host_test::HostRay;
use crate::ray_engine::host_tracer::Best;

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
pub(super) struct Flight {
    pub(super) ticket: u64,
    pub(super) ray: Ray,
    pub(super) host: HostRay,
    pub(super) best: Best,
    /// Whether it has met the card.
    pub(super) on_card: bool,
}

/// All of them, in places that are used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Flights {
    places: Vec<Flight>,
    free: Vec<u32>,
    given: u64,
}

impl Flights {
    /// Rays given so far: the next ticket.
    pub(super) fn given(&self) -> u64 {
        self.given
    }

    pub(super) fn start(&mut self, ray: Ray) -> u32 {
        let ticket = self.given;
        self.given += 1;
        let flight = Flight { ticket, ray, host: HostRay::new(&ray), best: Best::default(), on_card: false };
        if let Some(place) = self.free.pop() {
            self.places[place as usize] = flight;
            return place;
        }
        self.places.push(flight);
        (self.places.len() - 1) as u32
    }

    pub(super) fn at(&mut self, place: u32) -> &mut Flight {
        &mut self.places[place as usize]
    }

    /// Takes a ray out; its place is free again.
    pub(super) fn end(&mut self, place: u32) -> Flight {
        self.free.push(place);
        self.places[place as usize]
    }

    pub(super) fn bytes(&self) -> usize {
        self.places.capacity() * size_of::<Flight>() + self.free.capacity() * size_of::<u32>()
    }
}
