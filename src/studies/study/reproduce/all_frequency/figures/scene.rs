//! Model on a ground: differences of its pictures, and radiance of vertices by compressed factored transfer.

use glam::DVec3;

use super::{HOST, RunResult, Shared, StudyError};
use crate::all_frequency::Reflectance;
use crate::all_frequency::code::{CodeOptions, CodedTransfer};
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::shade::{Shader, exit_radiance};
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::scene::Camera;
use crate::scene::built::ground::on_ground;
use crate::study::prt::{SeenSurface, SegmentTally, SegmentedCompression};
use crate::study::reproduce::shared::HARD_SUN;
use crate::tracer::HostTracer;
use crate::transfer::light::{CubeLight, DistantLight, HaarLight};
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::VisibilityMaps;
use crate::transfer::{Tangents, Vertices};

/// Side of the pictures whose differences are measured, in pixels.
const SIDE: u32 = 160;

/// Model on a ground: vertices of the model first.
pub(super) struct FigureScene {
    pub(super) vertices: Vertices,
    pub(super) of_model: VisibilityMaps,
    pub(super) of_ground: VisibilityMaps,
    pub(super) hats: LinearBasis,
    camera: Camera,
    seen: SeenSurface,
}

impl FigureScene {
    /// Creates the scene; the eye is relative to the model's center, in units of the model's size.
    pub(super) fn new(model: &Mesh, ground: u32, eye: DVec3) -> Result<Self, StudyError> {
        let (mesh, materials) = on_ground(model, ground).on(HOST)?;
        let vertices = Vertices::with_materials(&mesh, &materials, Tangents::Along(DVec3::Z)).on(HOST)?;
        let is_ground = |&vertex: &u32| vertices.materials()[vertex as usize] == 1;
        let (ground, own): (Vec<u32>, Vec<u32>) = (0..vertices.len() as u32).partition(is_ground);
        let mut tracer = HostTracer::new(&mesh, Sides::Both);
        let mut maps = |of: &[u32]| VisibilityMaps::trace(&vertices, of, &mut tracer, &mut |_, _| ());
        let (of_model, of_ground) = (maps(&own).on(HOST)?, maps(&ground).on(HOST)?);
        let [low, high] = model.bounds().unwrap_or_default().map(|corner| DVec3::from(corner.map(f64::from)));
        let (middle, size) = ((low + high) / 2.0, (high - low).max_element());
        let place = (middle + size * eye).as_vec3().to_array();
        let camera = Camera::new(place, middle.as_vec3().to_array(), [0.0, 0.0, 1.0], 0.3, SIDE, SIDE);
        let camera = camera.on(HOST)?;
        let seen = SeenSurface::new(&mesh, &vertices, &camera);
        Ok(Self { vertices, of_model, of_ground, hats: LinearBasis::new(BasisWidth::default()), camera, seen })
    }

    pub(super) fn eye(&self) -> DVec3 {
        DVec3::from(self.camera.eye().map(f64::from))
    }

    /// Merges the colors of the model's and the ground's vertices into one list over all vertices.
    pub(super) fn joined(&self, model: &[[f64; 3]], ground: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut all = vec![[0.0; 3]; self.vertices.len()];
        for (maps, colors) in [(&self.of_model, model), (&self.of_ground, ground)] {
            maps.vertices().iter().zip(colors).for_each(|(&vertex, &color)| all[vertex as usize] = color);
        }
        all
    }

    /// Difference of a picture from the exact one: RMS of the pixels' differences, relative to the exact picture's RMS.
    pub(super) fn rms(&self, found: &[[f64; 3]], exact: &[[f64; 3]]) -> f64 {
        let [found, exact] = [found, exact].map(|of_vertex| self.seen.colors(of_vertex, [0.0; 3]));
        let pairs = found.iter().flatten().zip(exact.iter().flatten());
        let apart: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
        let whole: f64 = exact.iter().flatten().map(|value| value * value).sum();
        (apart / whole).sqrt()
    }
}

/// Stand-in for the light of St. Peter's: [`HARD_SUN`].
pub(super) fn stand_in() -> Result<CubeLight, StudyError> {
    let cube = DistantLight::Sky(HARD_SUN).cube();
    cube.on(HOST)
}

/// Surface of a scene: the vertices of some visibility maps, with a reflectance and a color.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) scene: &'a FigureScene,
    pub(super) maps: &'a VisibilityMaps,
    pub(super) reflectance: &'a Reflectance,
    pub(super) color: [f64; 3],
    /// Storage of finished pieces, and the prefix of their names.
    pub(super) pieces: (&'a Shared, &'a str),
}

impl Surface<'_> {
    /// Compresses and encodes the transfer.
    pub(super) fn coded(&self, options: SegmentOptions) -> Result<(CodedTransfer, Vec<SegmentTally>), StudyError> {
        let (shared, name) = self.pieces;
        let name = format!("{name}-{}-", options.vectors);
        let compression = SegmentedCompression {
            vertices: &self.scene.vertices,
            maps: self.maps,
            hats: self.scene.hats.width(),
            reflectance: self.reflectance,
            options,
            code: CodeOptions::default(),
            kept: shared.kept().map(|kept| (kept, name.as_str())),
        };
        compression.run(&mut |_, _, _| ()).on(HOST)
    }

    /// Radiance of the maps' vertices towards the scene's eye, from coded transfer.
    pub(super) fn of_code(&self, coded: &CodedTransfer, light: &HaarLight) -> Result<Vec<[f64; 3]>, StudyError> {
        let shader = Shader::new(coded);
        let transferred = shader.transferred(&light.singles()).on(HOST)?;
        let transferred = |vertex, row: usize| transferred.of(vertex)[row].map(f64::from);
        let color = self.color;
        let color = |_: usize| color;
        let all = exit_radiance(&self.scene.vertices, self.reflectance, &color, &transferred, self.scene.eye());
        Ok(self.maps.vertices().iter().map(|&vertex| all[vertex as usize]).collect())
    }
}
