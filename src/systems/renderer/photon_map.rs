//! Photon map with density estimation: a balanced kd-tree in one array (Jensen 1996; Bentley 1975).

use std::collections::BinaryHeap;
use std::f64::consts::PI;

use glam::DVec3;

/// Minimum cosine between the normals of a surface and of the photons in its estimate: 45 degrees.
const SAME_WAY: f64 = 0.707;

/// Stored photon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon {
    /// Position.
    pub at: DVec3,
    /// Normal of the triangle, on the side that was hit.
    pub normal: DVec3,
    /// Unit vector back along the photon's ray.
    pub from: DVec3,
    /// Flux: red, green, blue.
    pub power: DVec3,
}

/// Kd-tree: the middle element of each range is its node, split along the axis in `axes`.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    photons: Vec<Photon>,
    axes: Vec<u8>,
}

impl PhotonMap {
    /// Builds a map; equal photons in equal order give equal maps.
    pub fn new(mut photons: Vec<Photon>) -> Self {
        let mut axes = vec![0; photons.len()];
        build(&mut photons, &mut axes);
        Self { photons, axes }
    }

    /// Returns the sum of `value` over the photons around a point per unit area, from the `nearest` photons within
    /// `radius` on surfaces with a similar normal; `nearest` is at least 2. The k-th photon determines the area, pi
    /// r^2, and the k - 1 others the sum, which is unbiased for evenly distributed photons. If fewer than `nearest`
    /// photons are within the radius, all of them count, and the area is the whole disk of this radius.
    pub fn density(
        &self,
        at: DVec3,
        normal: DVec3,
        nearest: usize,
        radius: f64,
        value: impl Fn(&Photon) -> DVec3,
    ) -> DVec3 {
        let mut search =
            NearestSearch { map: self, at, normal, nearest, square: radius * radius, found: BinaryHeap::new() };
        search.range(0, self.photons.len());
        let full = search.found.len() == search.nearest;
        let mut found = search.found.into_sorted_vec();
        let square = if full { found.pop().map_or(0.0, |(square, _)| f64::from_bits(square)) } else { radius * radius };
        if square <= 0.0 {
            return DVec3::ZERO;
        }
        let sum: DVec3 = found.iter().map(|&(_, photon)| value(&self.photons[photon as usize])).sum();
        1.0 / (PI * square) * sum
    }
}

/// Puts the median along the widest axis in the middle, and recurses on both halves.
fn build(photons: &mut [Photon], axes: &mut [u8]) {
    if photons.len() < 2 {
        return;
    }
    let axis = widest(photons);
    let middle = photons.len() / 2;
    // `select_nth_unstable` is deterministic, even for equal keys.
    photons.select_nth_unstable_by(middle, |a, b| a.at[axis].total_cmp(&b.at[axis]));
    axes[middle] = axis as u8;
    let (left, right) = photons.split_at_mut(middle);
    let (axes_left, axes_right) = axes.split_at_mut(middle);
    build(left, axes_left);
    build(&mut right[1..], &mut axes_right[1..]);
}

fn widest(photons: &[Photon]) -> usize {
    let width = |axis: usize| {
        let bounds = photons.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], photon| {
            [low.min(photon.at[axis]), high.max(photon.at[axis])]
        });
        bounds[1] - bounds[0]
    };
    let widths = [width(0), width(1), width(2)];
    (0..3).fold(0, |best, axis| if widths[axis] > widths[best] { axis } else { best })
}

struct NearestSearch<'a> {
    map: &'a PhotonMap,
    at: DVec3,
    normal: DVec3,
    nearest: usize,
    /// Squared search radius; shrinks once enough photons are found.
    square: f64,
    /// Bits of the squared distance, which are in its order, and index in the map, so that the order of sums is fixed.
    found: BinaryHeap<(u64, u32)>,
}

impl NearestSearch<'_> {
    fn range(&mut self, start: usize, end: usize) {
        if start >= end {
            return;
        }
        let middle = start + (end - start) / 2;
        let photon = &self.map.photons[middle];
        let axis = usize::from(self.map.axes[middle]);
        let beside = self.at[axis] - photon.at[axis];
        let (near, far) = ((start, middle), (middle + 1, end));
        let (near, far) = if beside <= 0.0 { (near, far) } else { (far, near) };
        self.range(near.0, near.1);
        self.offer(middle);
        if beside * beside <= self.square {
            self.range(far.0, far.1);
        }
    }

    fn offer(&mut self, index: usize) {
        let photon = &self.map.photons[index];
        let offset = photon.at - self.at;
        let square = offset.dot(offset);
        if square > self.square || photon.normal.dot(self.normal) < SAME_WAY {
            return;
        }
        self.found.push((square.to_bits(), index as u32));
        if self.found.len() > self.nearest {
            self.found.pop();
        }
        if self.found.len() == self.nearest
            && let Some(&(last, _)) = self.found.peek()
        {
            self.square = f64::from_bits(last);
        }
    }
}
