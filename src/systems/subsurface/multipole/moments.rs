//! Area, mean point and second moments of a piece of surface, the data for a far receiver.

use glam::DVec3;

/// The moments of a piece of surface, with lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moments {
    pub(super) area: f64,
    pub(super) point: DVec3,
    pub(super) covariance: Covariance,
    pub(super) size_squared: f64,
}

/// Maximum of a piece's squared bounding radius divided by its squared size.
pub(super) const BALL: f64 = 5.0;

/// The mean squared distance from the mean point, at least the squared bounding radius divided by [`BALL`].
pub(super) fn size_squared(covariance: &Covariance, radius_squared: f64) -> f64 {
    covariance.trace().max(radius_squared / BALL)
}

/// A symmetric matrix of mean products of coordinates: xx, yy, zz, xy, xz, yz.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Covariance(pub(super) [f64; 6]);

impl Covariance {
    /// The sum of `factor v v^T` over the given vectors.
    pub(super) fn of<const K: usize>(terms: [(f64, DVec3); K]) -> Self {
        let mut sum = [0.0; 6];
        for (factor, v) in terms {
            let products = [v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z];
            sum.iter_mut().zip(products).for_each(|(sum, product)| *sum += factor * product);
        }
        Self(sum)
    }

    /// The covariance of the difference of two independent points is the sum of their covariances.
    pub(super) fn plus(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Self([a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3], a[4] + b[4], a[5] + b[5]])
    }

    pub(super) fn times(&self, factor: f64) -> Self {
        Self(self.0.map(|value| factor * value))
    }

    /// The mean squared distance from the mean point.
    pub(super) fn trace(&self) -> f64 {
        self.0[0] + self.0[1] + self.0[2]
    }

    /// The trace of the product of two matrices: the sum of the products of their elements.
    pub(super) fn product_trace(&self, other: &Self) -> f64 {
        let (a, b) = (&self.0, &other.0);
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
    }

    /// v^T C v.
    pub(super) fn along(&self, v: DVec3) -> f64 {
        let [xx, yy, zz, xy, xz, yz] = self.0;
        v.x * v.x * xx + v.y * v.y * yy + v.z * v.z * zz + 2.0 * (v.x * v.y * xy + v.x * v.z * xz + v.y * v.z * yz)
    }
}

impl Moments {
    /// Moments of the union of four pieces, without its size; with equal weights if no piece has an area.
    pub(super) fn together(parts: &[Self; 4]) -> Self {
        let area: f64 = parts.iter().map(|part| part.area).sum();
        let weight = |part: &Self| if area > 0.0 { part.area / area } else { 0.25 };
        let point = parts.iter().map(|part| weight(part) * part.point).sum::<DVec3>();
        let mut covariance = Covariance::default();
        for part in parts {
            let offset = part.point - point;
            let about = part.covariance.plus(&Covariance::of([(1.0, offset)]));
            covariance = covariance.plus(&about.times(weight(part)));
        }
        Self { area, point, covariance, size_squared: 0.0 }
    }
}
