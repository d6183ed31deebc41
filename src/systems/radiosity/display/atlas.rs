//! Radiosities in a meshed atlas (section 3.1: "an atlas of the scene, such as the meshed atlas described in Section
//! 2.3").
//!
//! Every patch is a triangle of the atlas, or two. A texel holds the mean, over the part of the surface under it, of
//! the radiosity interpolated between the corners of its triangle ([`super::at_corners`]). Reads are bilinear and
//! clamped to half a texel within the triangle's rectangle, its gutter, so that no triangle shows another one's texels.

use glam::DVec3;

use super::corners::at_corners;
use crate::atlas::Atlas;
use crate::error::InputError;
use crate::geom::Mesh;
use crate::geom::vector::narrow;
use crate::radiosity::{Patch, Patches};

/// The patches of a scene in an atlas.
#[derive(Clone, Debug)]
pub struct RadiosityAtlas {
    atlas: Atlas,
    mesh: Mesh,
    /// Per triangle its patch, and the indices of the patch's corners that are its own.
    of_face: Vec<(u32, [u8; 3])>,
}

/// Total power stored in a texture of the atlas, and its exact value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtlasPower {
    /// Radiosity times area, summed over texels: red, green, blue.
    pub held: [f64; 3],
    /// Radiosity times area, summed over patches of constant radiosity.
    pub exact: [f64; 3],
    /// Bound on the difference of the two, except for rounding: areas times the largest difference between a patch and
    /// one of its corners.
    pub bound: [f64; 3],
}

impl RadiosityAtlas {
    /// Creates an atlas of `side` texels along a side, a power of two.
    ///
    /// # Errors
    /// [`InputError`] if there are fewer texels than triangles, or the side is not that of an atlas.
    pub fn new(patches: &Patches, side: u32) -> Result<Self, InputError> {
        let (mut positions, mut triangles, mut of_face) = (Vec::new(), Vec::new(), Vec::new());
        for (number, patch) in (0..).zip(patches.list()) {
            let first = positions.len() as u32;
            positions.extend(patch.corners().iter().map(|&corner| narrow(corner)));
            for corners in [[0_u8, 1, 2], [0, 2, 3]].into_iter().take(patch.corners().len() - 2) {
                triangles.push(corners.map(|corner| first + u32::from(corner)));
                of_face.push((number, corners));
            }
        }
        let mesh = Mesh::new(positions, triangles).expect("corners of patches are finite");
        Ok(Self { atlas: Atlas::new(&mesh, side)?, mesh, of_face })
    }

    /// The atlas.
    pub fn atlas(&self) -> &Atlas {
        &self.atlas
    }

    /// Triangles of the atlas.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns the patch that a triangle is a part of.
    ///
    /// # Panics
    /// If there is no such triangle.
    pub fn patch_of(&self, triangle: u32) -> u32 {
        self.of_face[triangle as usize].0
    }

    /// Computes the texels, row by row: means of the radiosity interpolated between corners. Constant radiosity stays
    /// constant.
    ///
    /// # Panics
    /// If there is not one radiosity per patch.
    pub fn texels(&self, patches: &Patches, radiosity: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let corners = at_corners(patches, radiosity);
        let side = self.atlas.side() as usize;
        let texel = |(at, texel): (usize, &crate::atlas::Texel)| {
            let place = &self.atlas.places()[texel.face as usize];
            let low = [at % side, at / side].map(|at| at as f64);
            let weights = place.mean_weights(low, low.map(|at| at + 1.0));
            let (patch, own) = self.of_face[texel.face as usize];
            let [a, b, c] = own.map(|corner| corners[patch as usize][usize::from(corner)]);
            // Relative to the first corner, so that equal corners give no rounding error.
            [0, 1, 2].map(|channel| {
                a[channel] + weights[1] * (b[channel] - a[channel]) + weights[2] * (c[channel] - a[channel])
            })
        };
        self.atlas.texels().iter().enumerate().map(texel).collect()
    }

    /// Samples a texture at a point of a triangle, given by barycentric weights: bilinear, between texels of the
    /// triangle alone.
    ///
    /// # Panics
    /// If there is no such triangle, or not a value per texel.
    pub fn read(&self, texels: &[[f64; 3]], triangle: u32, weights: [f64; 3]) -> [f64; 3] {
        let side = self.atlas.side() as usize;
        assert_eq!(texels.len(), side * side, "a value per texel");
        let place = &self.atlas.places()[triangle as usize];
        let [x, y] = place.coordinates(weights);
        let [left, top, right, bottom] = place.bounds();
        // Integer and fractional position between texel centers.
        let split = |at: f64, low: f64, high: f64, texels: u32| {
            let at = at.clamp(low, high) - low;
            let whole = (at as u32).min(texels.saturating_sub(2));
            (whole, at - f64::from(whole))
        };
        let (column, u) = split(x, left, right, place.width);
        let (row, v) = split(y, top, bottom, place.height);
        let texel = |dx: u32, dy: u32| {
            let [x, y] = [(column + dx).min(place.width - 1) + place.x, (row + dy).min(place.height - 1) + place.y];
            texels[y as usize * side + x as usize]
        };
        let [a, b, c, d] = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
        [0, 1, 2].map(|channel| {
            let between = |from: [f64; 3], to: [f64; 3]| from[channel] + u * (to[channel] - from[channel]);
            between(a, b) + v * (between(c, d) - between(a, b))
        })
    }

    /// Samples a texture at a point of a triangle's plane.
    ///
    /// # Panics
    /// As [`Self::read`].
    pub fn read_at(&self, texels: &[[f64; 3]], triangle: u32, point: DVec3) -> [f64; 3] {
        self.read(texels, triangle, weights(self.atlas.corners(triangle), point))
    }

    /// Computes the power in a texture, and that of the patches. Partly covered patches count whole.
    ///
    /// # Panics
    /// If there is not one radiosity per patch, or not a value per texel.
    pub fn power(&self, patches: &Patches, radiosity: &[[f64; 3]], texels: &[[f64; 3]]) -> AtlasPower {
        assert_eq!(texels.len(), self.atlas.texels().len(), "a value per texel");
        let corners = at_corners(patches, radiosity);
        let off = |patch: usize, channel: usize| {
            let apart = corners[patch].iter().map(|corner| (corner[channel] - radiosity[patch][channel]).abs());
            apart.fold(0.0, f64::max)
        };
        let over_patches = |of: &dyn Fn(usize, usize) -> f64| {
            let patch = |(at, patch): (usize, &Patch)| [0, 1, 2].map(|channel| patch.area() * of(at, channel));
            sum(patches.list().iter().enumerate().map(patch))
        };
        let texel = |(texel, value): (&crate::atlas::Texel, &[f64; 3])| value.map(|value| texel.area * value);
        AtlasPower {
            held: sum(self.atlas.texels().iter().zip(texels).map(texel)),
            exact: over_patches(&|at, channel| radiosity[at][channel]),
            bound: over_patches(&off),
        }
    }
}

fn sum(parts: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    parts.fold([0.0; 3], |sum, part| [sum[0] + part[0], sum[1] + part[1], sum[2] + part[2]])
}

/// Barycentric weights of a point in a triangle's plane.
fn weights([a, b, c]: [DVec3; 3], at: DVec3) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let share = |p: DVec3, q: DVec3| (p - at).cross(q - at).dot(normal) / normal.length_squared();
    [share(b, c), share(c, a), share(a, b)]
}
