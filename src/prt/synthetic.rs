//! Signals made by a formula, for tests and measurements.

use rayon::prelude::*;

use super::Signal;
use crate::elementary::{on_circle, sin_cos};
use crate::geom::random::CounterRng;

/// The torus's larger radius; the smaller is 1 less.
const RADIUS: f64 = 1.5;

/// A signal over points of a torus that behaves like radiance transfer: each component is a wave, longer for the first
/// components, that is cut off along an edge as if by a shadow. There must be a point and a component.
///
/// Points wind around the torus so that any number of them is spread evenly; neighbours in number are no neighbours in
/// place.
pub fn torus_signal(points: usize, dimension: usize, seed: u64) -> Signal {
    let random = CounterRng::new(seed);
    let waves: Vec<Wave> = (0..dimension.max(1) as u64).map(|j| Wave::new(random, j, dimension)).collect();
    let mut values = vec![0.0; points.max(1) * waves.len()];
    values.par_chunks_mut(waves.len()).enumerate().for_each(|(at, into)| {
        let place = place(at, points);
        into.iter_mut().zip(&waves).for_each(|(value, wave)| *value = wave.at(place) as f32);
    });
    Signal::new(waves.len(), values).expect("sines, at least one")
}

/// A point of the torus.
fn place(at: usize, points: usize) -> [f64; 3] {
    // The golden ratio, whose multiples are the most evenly spread.
    let around = (at as f64 * 0.618_033_988_749_894_9).fract();
    let [c, s] = on_circle((at as f64 + 0.5) / points as f64);
    let [x, z] = on_circle(around);
    let radius = RADIUS + (RADIUS - 1.0) * c;
    [radius * x, (RADIUS - 1.0) * s, radius * z]
}

struct Wave {
    direction: [f64; 3],
    phase: f64,
    amplitude: f64,
    edge: [f64; 3],
    offset: f64,
}

impl Wave {
    fn new(random: CounterRng, component: u64, dimension: usize) -> Self {
        let signed = |dimension| 2.0 * random.unit(component, 0, dimension) - 1.0;
        let high = component as f64 / dimension as f64;
        Self {
            direction: [0, 1, 2].map(|axis| (1.0 + 5.0 * high) * signed(axis)),
            phase: 4.0 * signed(3),
            amplitude: 1.0 / (1.0 + 4.0 * high),
            edge: [4, 5, 6].map(|axis| 8.0 * signed(axis)),
            offset: 4.0 * signed(7),
        }
    }

    fn at(&self, place: [f64; 3]) -> f64 {
        let along = |axis: [f64; 3]| axis.iter().zip(place).map(|(a, x)| a * x).sum::<f64>();
        let (sine, _) = sin_cos(along(self.direction) + self.phase);
        self.amplitude * sine * (along(self.edge) + self.offset).clamp(0.0, 1.0)
    }
}
