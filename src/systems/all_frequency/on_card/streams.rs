//! The vertex streams of a frame.

use glam::DVec3;
use rayon::prelude::*;

use super::options::{ProductOptions, RadianceFormat, VertexColors, ViewMaker};
use super::subject::TransferredMesh;
use crate::all_frequency::Reflectance;
use crate::all_frequency::kernels::{LEAST_DENOMINATOR, ViewNumbers};
use crate::all_frequency::shade::exit_radiance;
use crate::card::{Attribute, MeshError, attribute, through_half};
use crate::geom::UnitFrame;
use crate::geom::vector::wide;
use crate::scene::Camera;

/// Vertex colors, and counts of those out of range.
#[derive(Clone, Debug, Default)]
pub(super) struct ColorStream {
    pub(super) colors: Attribute,
    /// Number of vertices with a channel below 0.
    pub(super) below_zero: u64,
    /// Number of vertices with a channel above 1, which bytes cannot hold.
    pub(super) above_one: u64,
}

impl ColorStream {
    /// Colors G(v) . T_p, times exposure, in a format.
    pub(super) fn new(
        mesh: &TransferredMesh<'_>,
        (camera, exposure): (&Camera, f64),
        format: VertexColors,
    ) -> Result<Self, MeshError> {
        Self::of(&radiance(mesh, camera.eye()), exposure, format)
    }

    /// Colors from the one term of a diffuse surface, whose G does not depend on the view.
    pub(super) fn diffuse(mesh: &TransferredMesh<'_>, exposure: f64) -> Result<Self, MeshError> {
        let mut g = [0.0];
        Reflectance::Diffuse.view(DVec3::Z, &mut g);
        let of = |vertex: usize| {
            let (row, color) = (mesh.transferred.of(vertex)[0], mesh.color(vertex));
            [0, 1, 2].map(|channel| g[0] * f64::from(row[channel]) * color[channel])
        };
        let radiance: Vec<[f64; 3]> = (0..mesh.vertices.len()).map(of).collect();
        Self::of(&radiance, exposure, VertexColors::Floats)
    }

    fn of(radiance: &[[f64; 3]], exposure: f64, format: VertexColors) -> Result<Self, MeshError> {
        let mut stream = Self::default();
        for color in radiance {
            let color = color.map(|value| exposure * value);
            stream.below_zero += u64::from(color.iter().any(|&value| value < 0.0));
            stream.above_one += u64::from(color.iter().any(|&value| value > 1.0));
            stream.colors.push(match format {
                VertexColors::Floats => attribute(color, 1.0),
                VertexColors::Bytes => {
                    attribute(color.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() / 255.0), 1.0)
                }
            });
        }
        finite(&stream.colors)?;
        Ok(stream)
    }
}

/// Refuses numbers that overflow single precision.
fn finite(attribute: &[[u32; 4]]) -> Result<(), MeshError> {
    let mut numbers = attribute.as_flattened().iter().map(|&bits| f32::from_bits(bits));
    match numbers.find(|value| !value.is_finite()) {
        Some(found) => Err(MeshError::Figure { what: "radiance that its format holds", found: found.into() }),
        None => Ok(()),
    }
}

/// Transferred radiance for products per pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct RadianceStream<'a> {
    pub(super) mesh: TransferredMesh<'a>,
    pub(super) options: &'a ProductOptions,
    /// Per term the factor of T_p that compensates the scale of G's texels.
    pub(super) scales: &'a [f64],
    pub(super) frame: &'a UnitFrame,
}

impl RadianceStream<'_> {
    /// The coordinate sets of a pass: T_p times exposure, color and scales, and the view if the host computes it.
    pub(super) fn sets(&self, camera: &Camera, exposure: f64, pass: usize) -> Result<Vec<Attribute>, MeshError> {
        let layout = self.options.layout(self.mesh.terms());
        let eye = self.frame.of_scene(wide(camera.eye()));
        let rounded = |value: f64| match self.options.radiance {
            RadianceFormat::Fp32 => value as f32,
            RadianceFormat::Fp16 => through_half(value as f32),
        };
        let of_vertex = |vertex: usize| {
            let mut numbers = vec![[0_u32; 4]; layout.sets()];
            let color = self.mesh.color(vertex);
            for (term, row) in self.mesh.transferred.of(vertex).iter().enumerate() {
                for channel in 0..layout.channels {
                    let of = if layout.channels == 1 { pass } else { channel };
                    let (set, component) = layout.place(term, channel);
                    let value = f64::from(row[of]) * color[of] * exposure * self.scales[term];
                    numbers[set][component] = rounded(value).to_bits();
                }
            }
            if self.options.view_maker == ViewMaker::Host {
                for (component, value) in self.view(vertex, eye).into_iter().take(layout.view.count()).enumerate() {
                    numbers[layout.view_set()][component] = rounded(value).to_bits();
                }
            }
            numbers
        };
        let by_vertex: Vec<Vec<[u32; 4]>> = (0..self.mesh.vertices.len()).into_par_iter().map(of_vertex).collect();
        let sets: Vec<Attribute> =
            (0..layout.sets()).map(|set| by_vertex.iter().map(|numbers| numbers[set]).collect()).collect();
        sets.iter().try_for_each(|set| finite(set))?;
        Ok(sets)
    }

    /// The view of a vertex, by the vertex program's formula in f64.
    fn view(&self, vertex: usize, eye: DVec3) -> [f64; 3] {
        let position = self.frame.of_scene(wide(self.mesh.vertices.positions()[vertex]));
        let local = self.mesh.vertices.frames()[vertex].to_local(eye - position);
        match self.options.view {
            ViewNumbers::Vector => local.to_array(),
            ViewNumbers::Coordinates => {
                let scale = 0.5 / (local.length() + local.z).max(LEAST_DENOMINATOR);
                [0.5 + scale * local.x, 0.5 + scale * local.y, 0.0]
            }
        }
    }
}

/// Step 4 per vertex, for vertex colors.
fn radiance(mesh: &TransferredMesh<'_>, eye: [f32; 3]) -> Vec<[f64; 3]> {
    let transferred = |vertex: usize, row: usize| mesh.transferred.of(vertex)[row].map(f64::from);
    exit_radiance(mesh.vertices, mesh.reflectance, &|vertex| mesh.color(vertex), &transferred, wide(eye))
}
