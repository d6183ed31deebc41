//! The model, light and camera of a picture, the visible surface of each pixel, and the product of light and transfer.

use glam::DVec3;
use rayon::prelude::*;

use crate::bi_scale::file::BiScaleFile;
use crate::bi_scale::paper;
use crate::bi_scale::product::{Gather, by_rows};
use crate::bi_scale::shade::{ShadedPixel, pixel_frame};
use crate::bi_scale::texture::{BidirectionalTexture, MesoPatch};
use crate::bi_scale::transfer::{light_vectors, side_by_side};
use crate::elementary::on_circle;
use crate::geom::exact::Sides;
use crate::geom::vector::{unit, wide};
use crate::geom::{Hit, Mesh, Ray};
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::prt::LitView;
use crate::study::prt::interpolate::weights;
use crate::tracer::HostTracer;
use crate::transfer::light::{CubeLight, DistantLight};
use crate::transfer::{LocalFrame, Vertices};

/// A model with its transfer, its textures, a light and a camera.
#[derive(Debug)]
pub struct BiScaleRendering {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model's mesh.
    pub surface: TexturedSurface,
    /// The model's transfer.
    pub file: BiScaleFile,
    /// The textures that the model's triangles refer to.
    pub textures: Vec<SurfaceTexture>,
    /// The light.
    pub light: DistantLight,
    /// `true` to compare the picture with a ray-traced one; all textures must have patches.
    pub reference: bool,
}

/// A bidirectional texture with its name.
#[derive(Debug)]
pub struct SurfaceTexture {
    /// The name.
    pub name: String,
    /// Its samples.
    pub samples: BidirectionalTexture,
    /// The patch that the texture was made from, if known.
    pub patch: Option<MesoPatch>,
}

/// L~ of all vertices.
#[derive(Clone, Debug)]
pub(in crate::study) struct LocalLight {
    /// `biclusters` or `rows`.
    pub(super) way: &'static str,
    /// Red, green and blue of each row of the transfer.
    pub(in crate::study) rows: Vec<[f64; 3]>,
}

impl LocalLight {
    /// The light times a file's transfer, by its biclusters in f32 if it has any, otherwise by its matrix in f64;
    /// `None` without both. Panics if the transfer does not have one column per light texel.
    pub(super) fn new(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let Some(biclusters) = &file.biclusters else { return Self::exact(file, light) };
        let light = side_by_side(light_vectors(light));
        let single: Vec<[f32; 3]> = light.into_iter().map(|texel| texel.map(|value| value as f32)).collect();
        let rows = Gather::new(biclusters).multiply(&single);
        Some(Self { way: "biclusters", rows: rows.into_iter().map(|row| row.map(f64::from)).collect() })
    }

    /// Local light in f64, by the file's matrix if it has one, else by its biclusters. Panics as [`Self::new`] does.
    pub(super) fn exact(file: &BiScaleFile, light: &CubeLight) -> Option<Self> {
        let channels = light_vectors(light);
        let (way, channels) = match (&file.matrix, &file.biclusters) {
            (Some(matrix), _) => ("rows", channels.map(|channel| by_rows(matrix, &channel))),
            (None, Some(biclusters)) => ("biclusters", channels.map(|channel| paper::multiply(biclusters, &channel))),
            (None, None) => return None,
        };
        Some(Self { way, rows: side_by_side(channels) })
    }
}

pub(super) fn no_mesh_transfer() -> StudyError {
    let help = "give a file that `crossbar bi-scale precompute` wrote, or the biclusters of such a file";
    let what = "expected transfer of a mesh, found a matrix without a mesh";
    StudyError::new("crossbar::prt::meaning", what).with_help(help)
}

/// A mesh with texture coordinates.
#[derive(Debug)]
pub struct TexturedSurface {
    /// The mesh.
    pub mesh: Mesh,
    /// Its vertices.
    pub vertices: Vertices,
    /// Texture index per triangle.
    texture_of: Vec<u32>,
    /// Repetitions of a patch along each edge of the unit square of texture coordinates.
    repeat: f64,
}

/// Gives a mesh normals that are smooth over edges with angles up to `degrees` (section VII).
pub fn creased(mesh: &Mesh, degrees: f64) -> Mesh {
    mesh.creased(on_circle(degrees / 360.0)[0])
}

/// The surface point in a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct SurfacePixel {
    pub(super) triangle: u32,
    pub(super) texture: usize,
    pub(super) frame: LocalFrame,
    pub(super) shaded: ShadedPixel,
}

impl TexturedSurface {
    /// Creates a surface. `texture_of` is a texture index per triangle, `repeat` the number of patches per unit of
    /// texture coordinates. Fails if the mesh has no texture coordinates, or if a triangle has no texture index.
    pub fn new(mesh: Mesh, vertices: Vertices, texture_of: Vec<u32>, repeat: f64) -> Result<Self, StudyError> {
        if mesh.texcoords().is_none() {
            let what = "the model has no texture coordinates, which place patches on it";
            return Err(StudyError::new("crossbar::prt::surface", what));
        }
        if texture_of.len() != mesh.len() {
            let [triangles, found] = [mesh.len(), texture_of.len()];
            let what = format!("expected a texture for each of {triangles} triangles, found {found}");
            return Err(StudyError::new("crossbar::prt::surface", what));
        }
        Ok(Self { mesh, vertices, texture_of, repeat })
    }

    /// The surface points at the pixels of a camera, front faces only.
    pub(super) fn pixels(&self, camera: &Camera) -> Vec<Option<SurfacePixel>> {
        let rays = camera.rays();
        let (hits, _) = HostTracer::new(&self.mesh, Sides::Front).nearest_all(&rays);
        let eye = wide(camera.eye());
        rays.par_iter().zip(&hits).map(|(ray, hit)| Some(self.pixel(ray, hit.as_ref()?, eye))).collect()
    }

    /// The shaded point where a ray hits.
    fn pixel(&self, ray: &Ray, hit: &Hit, eye: DVec3) -> SurfacePixel {
        let triangle = hit.triangle as usize;
        let corners = self.vertices.triangles()[triangle];
        let places = corners.map(|corner| wide(self.vertices.positions()[corner as usize]));
        let at = wide(ray.origin()) + f64::from(hit.t) * wide(ray.direction());
        let weights = weights(at, places).to_array();
        let frame = pixel_frame(&self.vertices, corners, weights);
        let coordinates = self.mesh.texcoords().unwrap_or_default();
        let mut place = [0.0; 2];
        for (corner, weight) in self.mesh.triangles()[triangle].into_iter().zip(weights) {
            for (into, along) in place.iter_mut().zip(coordinates[corner as usize]) {
                *into += weight * self.repeat * f64::from(along);
            }
        }
        // If the eye lies on the surface, there is no view direction; no picture is drawn from there.
        let view = frame.to_local(unit(eye - at).unwrap_or(frame.normal()));
        let shaded = ShadedPixel { corners, weights, place, view };
        SurfacePixel { triangle: hit.triangle, texture: self.texture_of[triangle] as usize, frame, shaded }
    }
}
