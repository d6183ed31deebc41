//! Buckets of rays with one origin and similar directions: finds the triangles that they can hit.
//!
//! As in section 5.3, triangles outside the bucket of rays are not drawn. The test is conservative by a margin that is
//! much larger than the card's errors, and runs in f64: a triangle is omitted only if it lies entirely to one side of
//! all rays.

use glam::DVec3;
use refsim::texture::Region;

use super::RayBatch;
use crate::geom::Mesh;
use crate::geom::vector::{unit, wide};

/// Margin added on each side of a bucket, as a fraction of its extent.
const MARGIN_SHARE: f64 = 0.25;
/// Margin added to [`MARGIN_SHARE`], in units of the picture plane at distance 1: a direction error of 2^-8.
const MARGIN: f64 = 1.0 / 256.0;

/// Splits a batch into squares of `side` pixels, row by row, clipped at its edges.
pub(super) fn regions(rays: &RayBatch, side: u32) -> Vec<Region> {
    let (width, height) = (rays.width(), rays.height());
    let rows = (0..height).step_by(side as usize);
    rows.flat_map(|y| (0..width).step_by(side as usize).map(move |x| (x, y)))
        .map(|(x, y)| Region { x, y, width: side.min(width - x), height: side.min(height - y) })
        .collect()
}

/// Bundle of rays with a common origin: a rectangle on a plane at distance 1 perpendicular to its middle ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bundle {
    origin: DVec3,
    forward: DVec3,
    axes: [DVec3; 2],
    low: [f64; 2],
    high: [f64; 2],
}

impl Bundle {
    /// Builds the bundle of a region's rays, which all start at `origin`; `None` if no half-space contains all of their
    /// directions.
    pub(super) fn of(rays: &RayBatch, region: Region, origin: [f32; 3]) -> Option<Self> {
        let origin = wide(origin);
        let rows = region.y..region.y + region.height;
        let index = |(x, y): (u32, u32)| y as usize * rays.width() as usize + x as usize;
        let pixels = rows.flat_map(|y| (region.x..region.x + region.width).map(move |x| (x, y)));
        let directions: Vec<DVec3> = pixels.filter_map(|p| unit(wide(rays.rays()[index(p)].direction()))).collect();
        let forward = unit(directions.iter().sum())?;
        // Any vector that is not parallel to the view can span the plane.
        let helper = if forward.x.abs() < 0.7 { DVec3::X } else { DVec3::Y };
        let right = unit(forward.cross(helper))?;
        let axes = [right, right.cross(forward)];
        let mut bundle = Self { origin, forward, axes, low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        for d in directions {
            let point = bundle.project(d)?;
            for (axis, at) in point.into_iter().enumerate() {
                bundle.low[axis] = bundle.low[axis].min(at);
                bundle.high[axis] = bundle.high[axis].max(at);
            }
        }
        for axis in 0..2 {
            let margin = MARGIN_SHARE * (bundle.high[axis] - bundle.low[axis]) + MARGIN;
            bundle.low[axis] -= margin;
            bundle.high[axis] += margin;
        }
        Some(bundle)
    }

    /// Projects a vector from the origin to the plane; `None` if it points backwards or almost along the plane.
    fn project(&self, v: DVec3) -> Option<[f64; 2]> {
        let depth = v.dot(self.forward);
        (depth > 1e-3 * v.length()).then(|| self.axes.map(|axis| v.dot(axis) / depth))
    }

    /// Returns the triangles that the bundle may hit, in ascending order.
    pub(super) fn near(&self, mesh: &Mesh) -> Vec<u32> {
        let corners = mesh.iter_corners().map(|corners| corners.map(wide));
        (0..).zip(corners).filter(|(_, corners)| self.may_meet(corners)).map(|(id, _)| id).collect()
    }

    fn may_meet(&self, corners: &[DVec3; 3]) -> bool {
        let [Some(a), Some(b), Some(c)] = corners.map(|p| self.project(p - self.origin)) else {
            // A triangle that reaches behind the origin has no outline on the plane. It cannot be hit only if it is
            // wholly behind.
            return corners.iter().any(|p| (p - self.origin).dot(self.forward) > 0.0);
        };
        (0..2).all(|axis| {
            let least = a[axis].min(b[axis]).min(c[axis]);
            let most = a[axis].max(b[axis]).max(c[axis]);
            most >= self.low[axis] && least <= self.high[axis]
        })
    }
}
