//! The M local directions in which a bidirectional texture is sampled, for light and for view.
//!
//! A square of k x k cells is mapped onto the hemisphere with equal areas: the concentric map of Shirley and Chiu from
//! the square to the disc, then Lambert's equal-area map from the disc to the hemisphere. Section VI-A cites reference
//! 34, which is missing in the scan; that it is Shirley and Chiu's map is inferred. The cells' centers give the
//! directions.

use std::f64::consts::FRAC_PI_4;

use glam::DVec3;

use crate::elementary;
use crate::error::{InputError, ensure};

/// M = k x k directions of the upper hemisphere. Direction k v + u belongs to cell (u, v).
#[derive(Clone, Debug, PartialEq)]
pub struct LocalDirections {
    side: usize,
    directions: Vec<DVec3>,
}

impl LocalDirections {
    /// Maximum number of cells along an edge, for 4096 directions.
    pub const MOST: usize = 64;

    /// The directions of a square of `side` x `side` cells. Fails with [`InputError`] unless `side` is 1 to
    /// [`Self::MOST`].
    pub fn new(side: usize) -> Result<Self, InputError> {
        ensure!(
            (1..=Self::MOST).contains(&side),
            "expected 1 to {} directions along an edge of the square, found {side}",
            LocalDirections::MOST
        );
        let center = |cell: usize| (2 * cell + 1) as f64 / side as f64 - 1.0;
        let direction = |cell: usize| hemisphere([center(cell % side), center(cell / side)]);
        Ok(Self { side, directions: (0..side * side).map(direction).collect() })
    }

    /// Cells along an edge of the square.
    pub fn side(&self) -> usize {
        self.side
    }

    /// The M directions in order, of length 1.
    pub fn directions(&self) -> &[DVec3] {
        &self.directions
    }

    /// The index of the direction nearest to `direction` (local, may lie below the horizon), by the largest cosine; on
    /// ties, the lowest index.
    pub fn nearest(&self, direction: DVec3) -> usize {
        // Cells are at most three times as long as wide, so no center two cells away is nearer than the center of the
        // cell itself.
        let around = square(direction).map(|at| {
            let cell = ((at + 1.0) / 2.0 * self.side as f64) as usize;
            cell.saturating_sub(2)..(cell + 3).min(self.side)
        });
        let [across, down] = around;
        self.nearest_of(direction, down.flat_map(|v| across.clone().map(move |u| v * self.side + u)))
    }

    /// Like [`Self::nearest`], by a search over all directions.
    pub fn nearest_of_all(&self, direction: DVec3) -> usize {
        self.nearest_of(direction, 0..self.directions.len())
    }

    fn nearest_of(&self, direction: DVec3, numbers: impl Iterator<Item = usize>) -> usize {
        let mut best = (f64::NEG_INFINITY, 0);
        for number in numbers {
            let cosine = self.directions[number].dot(direction);
            if cosine > best.0 {
                best = (cosine, number);
            }
        }
        best.1
    }
}

/// The direction of length 1 for a point of the square [-1, 1]^2.
pub fn hemisphere([u, v]: [f64; 2]) -> DVec3 {
    let (radius, angle) = if u == 0.0 && v == 0.0 {
        (0.0, 0.0)
    } else if u * u > v * v {
        (u, FRAC_PI_4 * (v / u))
    } else {
        (v, 2.0 * FRAC_PI_4 - FRAC_PI_4 * (u / v))
    };
    let (sine, cosine) = elementary::sin_cos(angle);
    // Lambert's map: the height falls linearly with the disc's area, and the horizontal radius follows from length 1.
    let height = 1.0 - radius * radius;
    let ground = radius * (2.0 - radius * radius).sqrt();
    DVec3::new(ground * cosine, ground * sine, height)
}

/// The point of the square [-1, 1]^2 for a direction of the upper hemisphere: the inverse of [`hemisphere`]. Directions
/// below the horizon are moved to the horizon.
pub fn square(direction: DVec3) -> [f64; 2] {
    let radius = (1.0 - direction.z.clamp(0.0, 1.0)).sqrt();
    let (x, y) = (direction.x, direction.y);
    if x == 0.0 && y == 0.0 {
        return [0.0, 0.0];
    }
    if x.abs() > y.abs() {
        let across = elementary::atan2(y * x.signum(), x.abs()) / FRAC_PI_4;
        [radius * x.signum(), radius * across * x.signum()]
    } else {
        let across = elementary::atan2(x * y.signum(), y.abs()) / FRAC_PI_4;
        [radius * across * y.signum(), radius * y.signum()]
    }
}
