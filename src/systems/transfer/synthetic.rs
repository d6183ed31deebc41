//! Signals and a mesh given by formulas, for tests and measurements.

use rayon::prelude::*;

use crate::clustering::Signal;
use crate::elementary::{on_circle, sin_cos};
use crate::geom::Mesh;
use crate::geom::random::CounterRng;

/// The torus's larger radius; the smaller is 1 less.
const RADIUS: f64 = 1.5;

/// A signal over points of a torus that behaves like radiance transfer: each component is a wave, longer for the first
/// components, that ends at an edge as at a shadow. `points` and `dimension` must be at least 1.
///
/// Points wind around the torus, so that any number of points is distributed evenly; successive points are not adjacent
/// in space.
pub fn torus_signal(points: usize, dimension: usize, seed: u64) -> Signal {
    signal_at(points, dimension, seed, |at| place(at, points))
}

/// The waves of [`torus_signal`] at other positions, with finite coordinates up to about 2.
pub fn signal_at(points: usize, dimension: usize, seed: u64, place: impl Fn(usize) -> [f64; 3] + Sync) -> Signal {
    let random = CounterRng::new(seed);
    let waves: Vec<Wave> = (0..dimension.max(1) as u64).map(|j| Wave::new(random, j, dimension)).collect();
    let mut values = vec![0.0; points.max(1) * waves.len()];
    values.par_chunks_mut(waves.len()).enumerate().for_each(|(at, into)| {
        let place = place(at);
        into.iter_mut().zip(&waves).for_each(|(value, wave)| *value = wave.at(place) as f32);
    });
    Signal::new(waves.len(), values).expect("sines, at least one")
}

/// Hills over the square [-1, 1]^2: `2 * parts * parts` triangles, at least two, with fronts upwards.
pub fn hills(parts: u32) -> Mesh {
    let parts = parts.max(1);
    let along = |at: u32| 2.0 * f64::from(at) / f64::from(parts) - 1.0;
    let height = |x: f64, y: f64| 0.3 * sin_cos(3.0 * x + 1.0).0 * sin_cos(2.5 * y).1;
    let grid = (0..=parts).flat_map(|row| (0..=parts).map(move |column| (column, row)));
    let positions = grid.map(|(column, row)| [along(column), along(row), height(along(column), along(row))]);
    let positions = positions.map(|position| position.map(|value| value as f32)).collect();
    let squares = (0..parts).flat_map(|row| (0..parts).map(move |column| row * (parts + 1) + column));
    let triangles = squares.flat_map(|a| {
        let [b, c, d] = [a + 1, a + parts + 1, a + parts + 2];
        [[a, b, d], [a, d, c]]
    });
    Mesh::new(positions, triangles.collect()).expect("indices of a grid, and finite heights")
}

/// A point of the torus.
fn place(at: usize, points: usize) -> [f64; 3] {
    // Multiples of the golden ratio are the most evenly distributed.
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
