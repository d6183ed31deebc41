//! Triangles put together piece by piece: where a piece stands, of what it is made, and the piece itself.

use super::super::{Material, PointLight, Scene, View};
use crate::elementary::on_circle;
use crate::geom::mesh::{Mesh, Welder};

/// A point or vector.
pub(super) type Vec3 = [f64; 3];

/// A material of the [`Parts`] that gave it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Stuff(u32);

/// Where a piece stands: its own axes, of length 1 and at right angles, and its origin, in the room's coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    origin: Vec3,
    axes: [Vec3; 3],
}

impl Place {
    /// The room itself.
    pub(super) const ROOM: Self = Self { origin: [0.0; 3], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

    /// A place in the room, not turned.
    pub(super) const fn at(x: f64, y: f64, z: f64) -> Self {
        Self { origin: [x, y, z], ..Self::ROOM }
    }

    /// A place named in the coordinates of this one.
    pub(super) fn to(self, x: f64, y: f64, z: f64) -> Self {
        Self { origin: self.point([x, y, z]), ..self }
    }

    /// Turned counter-clockwise around its own axis (0 to 2) by a part of a full turn.
    pub(super) fn turned(self, axis: usize, turns: f64) -> Self {
        let [cos, sin] = on_circle(turns);
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let mix = |u: f64, v: f64| [0, 1, 2].map(|i| u * self.axes[a][i] + v * self.axes[b][i]);
        let mut axes = self.axes;
        (axes[a], axes[b]) = (mix(cos, sin), mix(-sin, cos));
        Self { axes, ..self }
    }

    /// Turned around the vertical, in degrees.
    pub(super) fn facing(self, degrees: f64) -> Self {
        self.turned(2, degrees / 360.0)
    }

    /// A point of the piece in the room.
    pub(super) fn point(&self, at: Vec3) -> Vec3 {
        let along = self.direction(at);
        [0, 1, 2].map(|i| self.origin[i] + along[i])
    }

    /// A direction of the piece in the room.
    pub(super) fn direction(&self, along: Vec3) -> Vec3 {
        [0, 1, 2].map(|i| along[0] * self.axes[0][i] + along[1] * self.axes[1][i] + along[2] * self.axes[2][i])
    }
}

/// A scene in the making.
#[derive(Default)]
pub(super) struct Parts {
    welder: Welder,
    triangles: Vec<[u32; 3]>,
    normals: Vec<[[f32; 3]; 3]>,
    materials: Vec<Material>,
    material_of: Vec<u32>,
}

impl Parts {
    /// One more material.
    pub(super) fn material(&mut self, material: Material) -> Stuff {
        self.materials.push(material);
        Stuff(self.materials.len() as u32 - 1)
    }

    /// One more Lambert surface.
    pub(super) fn paint(&mut self, name: &str, albedo: [f32; 3]) -> Stuff {
        self.material(Material::diffuse(name, albedo))
    }

    /// One triangle of the room, counter-clockwise from the front; with normals at its corners if it is part of something round.
    pub(super) fn triangle(&mut self, corners: [Vec3; 3], normals: Option<[Vec3; 3]>, stuff: Stuff) {
        // Zero is added to turn -0 into 0: both are one place.
        let corners = corners.map(|corner| self.welder.vertex(corner.map(|value| value as f32 + 0.0)));
        self.triangles.push(corners);
        self.normals.push(normals.map_or([[0.0; 3]; 3], |n| n.map(|n| unit(n).map(|value| value as f32 + 0.0))));
        self.material_of.push(stuff.0);
    }

    /// A flat convex polygon of n corners as a fan of n - 2 triangles, counter-clockwise from the front.
    pub(super) fn polygon(&mut self, place: Place, corners: &[Vec3], stuff: Stuff) {
        for pair in corners[1..].windows(2) {
            self.triangle([corners[0], pair[0], pair[1]].map(|at| place.point(at)), None, stuff);
        }
    }

    /// A parallelogram: a corner and its two sides, `across` x `along` looking out of the front. 2 triangles.
    pub(super) fn quad(&mut self, place: Place, [corner, across, along]: [Vec3; 3], stuff: Stuff) {
        self.tiles(place, [corner, across, along], [1, 1], |_, _| stuff);
    }

    /// A parallelogram cut into `counts` tiles along its two sides, 2 triangles each; `stuff` says of what each is.
    pub(super) fn tiles(
        &mut self,
        place: Place,
        [corner, across, along]: [Vec3; 3],
        counts: [u32; 2],
        stuff: impl Fn(u32, u32) -> Stuff,
    ) {
        let at = |i: u32, j: u32| {
            let (s, t) = (f64::from(i) / f64::from(counts[0]), f64::from(j) / f64::from(counts[1]));
            [0, 1, 2].map(|axis| corner[axis] + s * across[axis] + t * along[axis])
        };
        for j in 0..counts[1] {
            for i in 0..counts[0] {
                self.polygon(place, &[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], stuff(i, j));
            }
        }
    }

    /// The whole scene.
    ///
    /// # Panics
    /// If a generator made coordinates that are not finite; the tests build every scene.
    pub(super) fn scene(self, views: Vec<View>, point_lights: Vec<PointLight>) -> Scene {
        let mesh = Mesh::new(self.welder.into_positions(), self.triangles).expect("places are finite");
        let mut scene =
            Scene::new(mesh, self.materials, self.material_of, self.normals).expect("lists of the same length");
        scene.views = views;
        scene.point_lights = point_lights;
        scene
    }
}

pub(super) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector at length 1; a zero vector stays zero.
pub(super) fn unit(v: Vec3) -> Vec3 {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    if length > 0.0 { v.map(|value| value / length) } else { v }
}
