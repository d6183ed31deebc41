//! Closed solids: blocks, cylinders, spheres, vessels, bent tubes.

use super::parts::{MaterialId, Parts, Placement};
use crate::elementary::on_circle;

/// Cosine of the largest angle between neighbouring segments of a profile at which the corner is smoothed.
const CREASE: f64 = 0.6;

/// Materials of a block's faces: towards -x, +x, -y, +y, -z, +z.
pub(super) type Faces = [MaterialId; 6];

impl Parts {
    /// Adds a block between two corners. 12 triangles.
    pub(super) fn block(&mut self, place: Placement, low: [f64; 3], high: [f64; 3], material: MaterialId) {
        self.painted_block(place, low, high, [material; 6]);
    }

    /// Adds a block with a material per face. 12 triangles.
    pub(super) fn painted_block(&mut self, place: Placement, low: [f64; 3], high: [f64; 3], faces: Faces) {
        self.frustum(place, [low, high], 0.0, faces);
    }

    /// Adds a block whose upper face is inset by `inset` on all four sides. 12 triangles.
    pub(super) fn frustum(&mut self, place: Placement, [low, high]: [[f64; 3]; 2], inset: f64, faces: Faces) {
        let corner = |index: usize| {
            let pick = |axis: usize| if index >> axis & 1 == 0 { low[axis] } else { high[axis] };
            let draw = if index & 4 == 0 { 0.0 } else { inset };
            let drawn = |axis: usize| if index >> axis & 1 == 0 { draw } else { -draw };
            [pick(0) + drawn(0), pick(1) + drawn(1), pick(2)]
        };
        // Bits of the corner's number: x, y, z; each face counter-clockwise from outside.
        let rings = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        for (ring, material) in rings.into_iter().zip(faces) {
            self.polygon(place, &ring.map(corner), material);
        }
    }

    /// Adds an upright cylinder of `sides` sides, closed by two polygons. 4 `sides` - 4 triangles.
    pub(super) fn cylinder(
        &mut self,
        place: Placement,
        radius: f64,
        [low, high]: [f64; 2],
        sides: u32,
        material: MaterialId,
    ) {
        self.lathe(place, &[[radius, low], [radius, high]], sides, material);
        self.disc(place, radius, low, sides, false, material);
        self.disc(place, radius, high, sides, true, material);
    }

    /// Adds a flat polygon that faces up or down. `sides` - 2 triangles.
    pub(super) fn disc(
        &mut self,
        place: Placement,
        radius: f64,
        height: f64,
        sides: u32,
        up: bool,
        material: MaterialId,
    ) {
        let corner = |index: u32| {
            let [x, y] = on_circle(f64::from(index) / f64::from(sides));
            [radius * x, radius * y, height]
        };
        let ring: Vec<[f64; 3]> =
            if up { (0..sides).map(corner).collect() } else { (0..sides).rev().map(corner).collect() };
        self.polygon(place, &ring, material);
    }

    /// Adds a sphere of `bands` bands between its poles. 2 `sides` (`bands` - 1) triangles.
    pub(super) fn sphere(&mut self, place: Placement, radius: f64, sides: u32, bands: u32, material: MaterialId) {
        let profile: Vec<[f64; 2]> = (0..=bands)
            .map(|band| {
                let [z, r] = on_circle(0.5 * f64::from(bands - band) / f64::from(bands));
                [if band == 0 || band == bands { 0.0 } else { radius * r }, radius * z]
            })
            .collect();
        let normals = profile.iter().map(|&at| [at; 2]).collect();
        self.revolve(place, &profile, normals, sides, material);
    }

    /// Adds a surface of revolution around z. The profile is a polyline of (radius, height) with the outside to its
    /// right: upwards on the outside, downwards on the inside of a vessel. Each segment takes 2 `sides` triangles, or
    /// `sides` if an end lies on the axis. Corners below an angle limit are smoothed.
    pub(super) fn lathe(&mut self, place: Placement, profile: &[[f64; 2]], sides: u32, material: MaterialId) {
        let stretches: Vec<[f64; 2]> = profile.windows(2).map(|ends| outward(ends[0], ends[1])).collect();
        let smooth = |one: [f64; 2], other: [f64; 2]| {
            let gentle = one[0] * other[0] + one[1] * other[1] > CREASE;
            if gentle { [one[0] + other[0], one[1] + other[1]] } else { one }
        };
        let normals = (0..profile.len())
            .map(|at| {
                let (before, after) = (at.checked_sub(1).map(|i| stretches[i]), stretches.get(at).copied());
                let (before, after) = (before.or(after).unwrap_or_default(), after.or(before).unwrap_or_default());
                // On the axis, a smooth top is horizontal.
                let level = |n: [f64; 2]| if profile[at][0] == 0.0 && n[1].abs() > CREASE { [0.0, n[1]] } else { n };
                [level(smooth(before, after)), level(smooth(after, before))]
            })
            .collect();
        self.revolve(place, profile, normals, sides, material);
    }

    /// Revolves a profile around z; `normals` (radius, height) are given at each of its points twice, for the segments
    /// that end and begin there.
    fn revolve(
        &mut self,
        place: Placement,
        profile: &[[f64; 2]],
        normals: Vec<[[f64; 2]; 2]>,
        sides: u32,
        material: MaterialId,
    ) {
        for (at, ends) in profile.windows(2).enumerate() {
            let normals = [normals[at][1], normals[at + 1][0]];
            for side in 0..sides {
                let corner = |end: usize, step: u32| {
                    let [x, y] = on_circle(f64::from((side + step) % sides) / f64::from(sides));
                    let turn = |[r, z]: [f64; 2]| [r * x, r * y, z];
                    (place.point(turn(ends[end])), place.direction(turn(normals[end])))
                };
                let [a, b, c, d] = [corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)];
                if ends[0][0] != 0.0 {
                    self.triangle([a.0, b.0, c.0], Some([a.1, b.1, c.1]), material);
                }
                if ends[1][0] != 0.0 {
                    self.triangle([a.0, c.0, d.0], Some([a.1, c.1, d.1]), material);
                }
            }
        }
    }

    /// Adds a tube bent in a circle around the placement's y axis: `bend` is its radius, `from` and `to` fractions of a
    /// full turn from +x towards +z. Both ends are closed. 2 `steps` `sides` + 2 (`sides` - 2) triangles.
    pub(super) fn bent_tube(
        &mut self,
        place: Placement,
        [bend, radius]: [f64; 2],
        [from, to]: [f64; 2],
        [steps, sides]: [u32; 2],
        material: MaterialId,
    ) {
        let corner = |step: u32, side: u32| {
            let [along, up] = on_circle(from + (to - from) * f64::from(step) / f64::from(steps));
            let [out, y] = on_circle(f64::from(side % sides) / f64::from(sides));
            let normal = [out * along, y, out * up];
            let r = bend + radius * out;
            ([r * along, radius * y, r * up], normal)
        };
        for step in 0..steps {
            for side in 0..sides {
                let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)]
                    .map(|(i, j)| corner(step + i, side + j))
                    .map(|(at, normal)| (place.point(at), place.direction(normal)));
                self.triangle([a.0, b.0, c.0], Some([a.1, b.1, c.1]), material);
                self.triangle([a.0, c.0, d.0], Some([a.1, c.1, d.1]), material);
            }
        }
        let end = |step: u32| (0..sides).map(move |side| corner(step, side).0);
        self.polygon(place, &end(0).rev().collect::<Vec<_>>(), material);
        self.polygon(place, &end(steps).collect::<Vec<_>>(), material);
    }
}

/// Unit normal on the right side of a profile's segment.
fn outward(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let (across, up) = (to[0] - from[0], to[1] - from[1]);
    let length = (across * across + up * up).sqrt();
    [up / length, -across / length]
}
