//! Numbered scenes: triangles anywhere, whose sizes range from a thousandth of the scene to all of it, and a square of
//! rays.

use crate::support::soup;
use crossbar::geom::exact::Sides;
use crossbar::geom::random::CounterRng;
use crossbar::geom::{Mesh, Ray};
use crossbar::ray_engine::RayBatch;

use refsim::num::power_of_two;

/// Side of the square of rays of a scene, in rays.
pub(crate) const SIDE: u32 = 16;
pub(crate) const RAYS: usize = (SIDE * SIDE) as usize;

pub(crate) struct Scene {
    pub(crate) mesh: Mesh,
    pub(crate) rays: RayBatch,
    pub(crate) sides: Sides,
}

impl Scene {
    /// A scene whose size is a power of two from 2^-20 to 2^20.
    pub(crate) fn new(number: u64) -> Self {
        Self::of_size(number, (CounterRng::new(number).bits(0, 0, 0) % 41) as i32 - 20)
    }

    /// A scene of size 2^`power`.
    pub(crate) fn of_size(number: u64, power: i32) -> Self {
        let random = CounterRng::new(number);
        let size = power_of_two(power);
        let number_in = |index: u64, sample: u64, k: u64| 2.0 * random.unit(index, sample, k) - 1.0;
        let point = |index: u64, sample: u64| [0, 1, 2].map(|k| number_in(index, sample, k));
        let add = |p: [f64; 3], q: [f64; 3], by: f64| [0, 1, 2].map(|k| p[k] + by * q[k]);
        // A third of the scenes lie around the origin, the others up to four times their size away from it.
        let middle = point(1, 0).map(|x| if number.is_multiple_of(3) { 0.0 } else { 4.0 * x });
        let mut corners: Vec<[f64; 3]> = Vec::new();
        let count = 2 + random.bits(2, 0, 0) % 10;
        // Edges of one scene: all tiny, all large, or mixed.
        let finest = [0, 4, 10][(random.bits(2, 1, 0) % 3) as usize];
        for i in 0..count {
            let edge = power_of_two(-((random.bits(3, i, 0) % (finest + 1)) as i32)) * (1.0 + random.unit(3, i, 1));
            let at = add(middle, point(4, i), if number.is_multiple_of(5) { 0.01 } else { 1.0 });
            corners.extend((0..3).map(|k| add(at, point(5 + k, i), edge)));
        }
        let single = |p: [f64; 3]| p.map(|x| (x * size) as f32);
        let positions = corners.iter().copied().map(single).collect();
        let mesh = soup(positions);
        let eye = add(middle, point(9, 0), [0.1, 1.0, 3.0][(random.bits(9, 1, 0) % 3) as usize]);
        let spread = [0.0, 0.0, 1e-3, 0.1, 1.0][(random.bits(9, 2, 0) % 5) as usize];
        let ray = |i: u64| {
            let origin = add(eye, point(10, i), spread);
            let target = if random.bits(11, i, 0).is_multiple_of(4) {
                add(middle, point(12, i), 3.0)
            } else {
                let at = 3 * (random.bits(11, i, 1) % count) as usize;
                let [p, q] = [0, 1].map(|k| 0.1 + 0.4 * random.unit(13, i, k));
                [0, 1, 2].map(|k| {
                    let [a, b, c] = [corners[at][k], corners[at + 1][k], corners[at + 2][k]];
                    a + p * (b - a) + q * (c - a)
                })
            };
            let length = power_of_two((random.bits(14, i, 0) % 21) as i32 - 10) * size;
            let direction = add(target, origin, -1.0).map(|x| (x * length) as f32);
            Ray::new(single(origin), direction).expect("a direction")
        };
        let rays = RayBatch::new(SIDE, SIDE, (0..RAYS as u64).map(ray).collect()).expect("a square of rays");
        let sides = if random.bits(15, 0, 0).is_multiple_of(2) { Sides::Both } else { Sides::Front };
        Self { mesh, rays, sides }
    }
}
