//! Assembly of scenes from pieces: placement, materials, triangles, and random numbers for positions and angles.

use glam::DVec3;

use super::super::{Material, PointLight, Scene, View};
use crate::elementary::on_circle;
use crate::geom::mesh::{Mesh, Welder};
use crate::geom::random::CounterRng;
use crate::geom::vector::{narrow, unit};

/// Index of a material of the [`Parts`] that created it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct MaterialId(u32);

/// Coordinate frame of a piece: orthonormal axes and an origin, in the room's coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    origin: DVec3,
    axes: [DVec3; 3],
}

impl Placement {
    /// The room's own frame.
    pub(super) const ROOM: Self = Self { origin: DVec3::ZERO, axes: DVec3::AXES };

    /// Creates an unrotated frame at a point of the room.
    pub(super) const fn at(x: f64, y: f64, z: f64) -> Self {
        Self { origin: DVec3::new(x, y, z), ..Self::ROOM }
    }

    /// Returns this frame moved to a point in its own coordinates.
    pub(super) fn to(self, x: f64, y: f64, z: f64) -> Self {
        Self { origin: self.point([x, y, z]), ..self }
    }

    /// Rotates the frame counter-clockwise around its own axis (0 to 2) by a fraction of a full turn.
    pub(super) fn turned(self, axis: usize, turns: f64) -> Self {
        let [cos, sin] = on_circle(turns);
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let mix = |u: f64, v: f64| u * self.axes[a] + v * self.axes[b];
        let mut axes = self.axes;
        (axes[a], axes[b]) = (mix(cos, sin), mix(-sin, cos));
        Self { axes, ..self }
    }

    /// Rotates the frame around the vertical, in degrees.
    pub(super) fn facing(self, degrees: f64) -> Self {
        self.turned(2, degrees / 360.0)
    }

    /// Converts a point of the piece to room coordinates.
    pub(super) fn point(&self, at: impl Into<DVec3>) -> DVec3 {
        self.origin + self.direction(at)
    }

    /// Converts a direction of the piece to room coordinates.
    pub(super) fn direction(&self, along: impl Into<DVec3>) -> DVec3 {
        let (along, [x, y, z]) = (along.into(), self.axes);
        along.x * x + along.y * y + along.z * z
    }
}

/// Builder of a scene.
#[derive(Default)]
pub(super) struct Parts {
    welder: Welder,
    triangles: Vec<[u32; 3]>,
    normals: Vec<[[f32; 3]; 3]>,
    materials: Vec<Material>,
    material_of: Vec<u32>,
}

impl Parts {
    /// Adds a material.
    pub(super) fn material(&mut self, material: Material) -> MaterialId {
        self.materials.push(material);
        MaterialId(self.materials.len() as u32 - 1)
    }

    /// Adds a Lambert material.
    pub(super) fn paint(&mut self, name: &str, albedo: [f32; 3]) -> MaterialId {
        self.material(Material::diffuse(name, albedo))
    }

    /// Adds a triangle in room coordinates, counter-clockwise from the front, with normals at its corners if it is part
    /// of a curved surface.
    pub(super) fn triangle(&mut self, corners: [DVec3; 3], normals: Option<[DVec3; 3]>, material: MaterialId) {
        let corners = corners.map(|corner| self.welder.vertex(positive_zeros(corner)));
        self.triangles.push(corners);
        // A zero vector stays zero.
        let normal = |n: DVec3| positive_zeros(unit(n).unwrap_or(n));
        self.normals.push(normals.map_or([[0.0; 3]; 3], |normals| normals.map(normal)));
        self.material_of.push(material.0);
    }

    /// Adds a flat convex polygon of n corners as a fan of n - 2 triangles, counter-clockwise from the front.
    pub(super) fn polygon(&mut self, place: Placement, corners: &[impl Into<DVec3> + Copy], material: MaterialId) {
        for pair in corners[1..].windows(2) {
            self.triangle([corners[0], pair[0], pair[1]].map(|at| place.point(at)), None, material);
        }
    }

    /// Adds a parallelogram given by a corner and its two sides; `across` x `along` points out of the front. 2
    /// triangles.
    pub(super) fn quad(&mut self, place: Placement, [corner, across, along]: [[f64; 3]; 3], material: MaterialId) {
        self.tiles(place, [corner, across, along], [1, 1], |_, _| material);
    }

    /// Adds a parallelogram divided into `counts` tiles along its two sides, 2 triangles each; `material` returns the
    /// material of a tile.
    pub(super) fn tiles(
        &mut self,
        place: Placement,
        [corner, across, along]: [[f64; 3]; 3],
        counts: [u32; 2],
        material: impl Fn(u32, u32) -> MaterialId,
    ) {
        let [corner, across, along] = [corner, across, along].map(DVec3::from);
        let at = |i: u32, j: u32| {
            let (s, t) = (f64::from(i) / f64::from(counts[0]), f64::from(j) / f64::from(counts[1]));
            corner + s * across + t * along
        };
        for j in 0..counts[1] {
            for i in 0..counts[0] {
                self.polygon(place, &[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], material(i, j));
            }
        }
    }

    /// Returns the finished scene. Panics if coordinates are not finite; tests build every scene.
    pub(super) fn scene(self, views: Vec<View>, point_lights: Vec<PointLight>) -> Scene {
        let mesh = Mesh::new(self.welder.into_positions(), self.triangles).expect("places are finite");
        let mut scene =
            Scene::new(mesh, self.materials, self.material_of, self.normals).expect("lists of the same length");
        scene.views = views;
        scene.point_lights = point_lights;
        scene
    }
}

/// Rounds to f32 and turns -0 into 0, so that equal points have equal bits.
fn positive_zeros(vector: DVec3) -> [f32; 3] {
    narrow(vector).map(|value| value + 0.0)
}

/// Triangles of a grid of `columns` x `rows` quads whose vertices are numbered row by row from `first`; each quad is
/// split along the diagonal from its first corner.
pub(super) fn grid_triangles(first: u32, [columns, rows]: [u32; 2]) -> impl Iterator<Item = [u32; 3]> {
    let quads = (0..rows).flat_map(move |row| (0..columns).map(move |column| first + row * (columns + 1) + column));
    quads.flat_map(move |a| {
        let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
        [[a, b, c], [a, c, d]]
    })
}

/// Creates a mesh with one normal and texture coordinate per vertex; all must be finite.
pub(super) fn with_attributes(
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<[f32; 3]>,
    texture: Vec<[f32; 2]>,
) -> Mesh {
    let mesh = Mesh::new(positions, triangles).and_then(|mesh| mesh.with_normals(normals));
    mesh.and_then(|mesh| mesh.with_texcoords(texture)).expect("finite numbers, as many as vertices")
}

/// Seed of all scenes.
pub const SEED: u64 = 2002;

/// Random number generator with the seed [`SEED`]; its numbers depend on the order of calls.
pub(super) struct SceneRng {
    random: CounterRng,
    drawn: u64,
}

impl Default for SceneRng {
    fn default() -> Self {
        Self { random: CounterRng::new(SEED), drawn: 0 }
    }
}

impl SceneRng {
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.drawn += 1;
        low + (high - low) * self.random.unit(self.drawn, 0, 0)
    }

    /// Chooses one of several items.
    pub(super) fn one_of<T: Copy>(&mut self, things: &[T]) -> T {
        let place = self.between(0.0, things.len() as f64) as usize;
        things[place.min(things.len() - 1)]
    }
}
