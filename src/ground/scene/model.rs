//! Scenes: triangles with materials and normals, lights, and named views.

use serde::Deserialize;

use super::{Camera, Color, Material};
use crate::error::{InputError, ensure, input_error};
use crate::geom::Mesh;
use crate::geom::vector::{area_vector, narrow, unit, wide};

/// Point light.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PointLight {
    /// Position.
    pub position: [f32; 3],
    /// Radiant intensity, equal in all directions: irradiance at distance r, perpendicular to the direction, is
    /// `intensity / r^2`.
    pub intensity: Color,
}

/// Named view of a scene. [`View::camera`] creates its camera for a picture size.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Name on the command line.
    pub name: String,
    /// Origin of the rays.
    pub eye: [f32; 3],
    /// Point in the centre of the picture.
    pub target: [f32; 3],
    /// Upward direction in the picture.
    pub up: [f32; 3],
    /// Tangent of half the vertical field of view.
    pub tan_half_height: f32,
}

impl View {
    /// Creates a view with z up.
    pub(super) fn upright(name: &str, eye: [f32; 3], target: [f32; 3], tan_half_height: f32) -> Self {
        Self { name: name.into(), eye, target, up: [0.0, 0.0, 1.0], tan_half_height }
    }

    /// Creates the camera of this view for a picture of `width` x `height` pixels.
    pub fn camera(&self, width: u32, height: u32) -> Result<Camera, InputError> {
        Camera::new(self.eye, self.target, self.up, self.tan_half_height, width, height)
    }
}

/// Triangles with materials, normals, lights and views.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    mesh: Mesh,
    materials: Vec<Material>,
    material_of: Vec<u32>,
    /// Normals at the corners of each triangle; zero vectors where the triangle is flat.
    normals: Vec<[[f32; 3]; 3]>,
    /// Point lights.
    pub point_lights: Vec<PointLight>,
    /// Views; the first is the default.
    pub views: Vec<View>,
}

impl Scene {
    /// Creates a scene from triangles with one material each. `normals` are unit normals at each triangle's corners, or
    /// zero for a flat triangle; an empty list makes all triangles flat.
    pub fn new(
        mesh: Mesh,
        materials: Vec<Material>,
        material_of: Vec<u32>,
        normals: Vec<[[f32; 3]; 3]>,
    ) -> Result<Self, InputError> {
        let triangles = mesh.len();
        let normal_count = if normals.is_empty() { triangles } else { normals.len() };
        for (what, found) in [("materials", material_of.len()), ("normals", normal_count)] {
            ensure!(found == triangles, "expected {triangles} {what}, one per triangle, found {found}");
        }
        if let Some(triangle) = material_of.iter().position(|&m| m as usize >= materials.len()) {
            let material = material_of[triangle];
            return Err(input_error!(
                "triangle {triangle} has material {material}, expected one below {} (counted from 0)",
                materials.len()
            ));
        }
        // Scenes without smooth normals always have an empty list.
        let normals = if normals.iter().all(|corners| *corners == [[0.0; 3]; 3]) { Vec::new() } else { normals };
        Ok(Self { mesh, materials, material_of, normals, point_lights: Vec::new(), views: Vec::new() })
    }

    /// The triangles.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// All materials.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Returns the material of a triangle. Panics if there is no such triangle.
    pub fn material(&self, triangle: u32) -> &Material {
        &self.materials[self.material_of[triangle as usize] as usize]
    }

    /// Index into [`Scene::materials`] of each triangle's material.
    pub fn material_of(&self) -> &[u32] {
        &self.material_of
    }

    /// Returns the normals at a triangle's corners; `None` if it is flat.
    pub fn corner_normals(&self, triangle: u32) -> Option<[[f32; 3]; 3]> {
        let normals = *self.normals.get(triangle as usize)?;
        (normals != [[0.0; 3]; 3]).then_some(normals)
    }

    /// Returns the triangles with their normals, one vertex per corner; a flat triangle has its geometric normal. The
    /// mesh is unchanged if no triangle has normals.
    pub fn mesh_with_normals(&self) -> Mesh {
        if self.normals.is_empty() {
            return self.mesh.clone();
        }
        let positions: Vec<_> = self.mesh.iter_corners().flatten().collect();
        let own = |corners: [[f32; 3]; 3]| [unit(area_vector(corners.map(wide))).map_or([0.0; 3], narrow); 3];
        let normals = (0..).zip(self.mesh.iter_corners());
        let normals =
            normals.flat_map(|(at, corners)| self.corner_normals(at).unwrap_or_else(|| own(corners))).collect();
        let triangles = (0..self.mesh.len() as u32).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
        let mesh = Mesh::new(positions, triangles).and_then(|mesh| mesh.with_normals(normals));
        mesh.unwrap_or_else(|_| self.mesh.clone())
    }

    /// Rotates mesh and normals; views and lights do not change.
    pub fn rotated(mut self, rotation: impl Fn([f32; 3]) -> [f32; 3]) -> Self {
        self.normals.iter_mut().flatten().for_each(|normal| *normal = rotation(*normal));
        self.mesh = self.mesh.rotated(rotation);
        self
    }

    /// Flips triangles: exchanges their second and third corners, with the normals.
    pub fn turned_round(mut self, triangles: &[u32]) -> Self {
        for &triangle in triangles {
            if let Some([_, b, c]) = self.normals.get_mut(triangle as usize) {
                std::mem::swap(b, c);
            }
        }
        self.mesh = self.mesh.turned_round(triangles);
        self
    }

    /// Returns the emitting triangles, in ascending order.
    pub fn emitters(&self) -> Vec<u32> {
        (0..self.mesh.len() as u32).filter(|&triangle| self.material(triangle).emits()).collect()
    }

    /// Returns the view with this name.
    pub fn view(&self, name: &str) -> Option<&View> {
        self.views.iter().find(|view| view.name == name)
    }
}
