//! The drawn object, and the vertex streams of a frame.

use glam::DVec3;

use super::options::{ProductOptions, RadianceFormat, VertexColors};
use crate::all_frequency::Reflectance;
use crate::all_frequency::shade::{TransferredRadiance, exit_radiance};
use crate::card::{Attribute, CardError, attribute, by_register, check_finite, through_half};
use crate::geom::vector::wide;
use crate::transfer::Vertices;

/// A mesh with transferred radiance at its vertices.
#[derive(Clone, Copy, Debug)]
pub struct TransferredMesh<'a> {
    /// The mesh.
    pub vertices: &'a Vertices,
    /// The reflectance for which transfer was computed.
    pub reflectance: &'a Reflectance,
    /// The surface color of each material.
    pub colors: &'a [[f64; 3]],
    /// T_p of each vertex.
    pub transferred: &'a TransferredRadiance,
}

impl TransferredMesh<'_> {
    /// The number of terms m.
    pub fn terms(&self) -> usize {
        self.reflectance.terms()
    }

    /// G(v) . T_p times the surface's color for each vertex, of any sign; 0 if the eye is below the horizon.
    pub fn radiance(&self, eye: [f32; 3]) -> Vec<[f64; 3]> {
        let transferred = |vertex: usize, row: usize| self.transferred.of(vertex)[row].map(f64::from);
        exit_radiance(self.vertices, self.reflectance, &|vertex| self.color(vertex), &transferred, wide(eye))
    }

    pub(super) fn color(&self, vertex: usize) -> [f64; 3] {
        self.colors[self.vertices.materials()[vertex] as usize]
    }

    pub(super) fn check(&self) -> Result<(), CardError> {
        let materials = self.vertices.materials().iter().max().map_or(0, |&most| most as usize + 1);
        let transferred = self.transferred;
        CardError::check_size("vertices with transferred radiance", self.vertices.len(), transferred.vertices())?;
        CardError::check_size("rows, one per term", self.terms(), transferred.rows())?;
        CardError::check_size("colors, one per material", materials, self.colors.len().min(materials))
    }
}

/// Counts of clamped colors. Truncated factors have negative lobes, which fixed-point targets and vertex colors clamp
/// to 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FactoredCounts {
    /// Pixels that show a mesh; `None` if the device has no floating-point target, which counting needs.
    pub covered: Option<u64>,
    /// Covered pixels with a negative channel before clamping.
    pub below_zero: Option<u64>,
    /// Vertices with a negative channel; `None` if products are computed per pixel.
    pub vertices_below_zero: Option<u64>,
    /// Vertices with a channel above 1, which bytes clamp.
    pub vertices_above_one: Option<u64>,
}

impl FactoredCounts {
    pub(super) fn add_vertices(&mut self, others: Self) {
        let sum = |of: Option<u64>, others: Option<u64>| of.into_iter().chain(others).reduce(|a, b| a + b);
        self.vertices_below_zero = sum(self.vertices_below_zero, others.vertices_below_zero);
        self.vertices_above_one = sum(self.vertices_above_one, others.vertices_above_one);
    }
}

/// Computes step 4 per vertex of a diffuse surface, whose radiance does not depend on the view.
pub(super) fn diffuse_radiance(mesh: &TransferredMesh<'_>) -> Vec<[f64; 3]> {
    let mut g = [0.0];
    Reflectance::Diffuse.view(DVec3::Z, &mut g);
    let of = |vertex: usize| {
        let (row, color) = (mesh.transferred.of(vertex)[0], mesh.color(vertex));
        [0, 1, 2].map(|channel| g[0] * f64::from(row[channel]) * color[channel])
    };
    (0..mesh.vertices.len()).map(of).collect()
}

/// Vertex colors, and the numbers of vertices below 0 and above 1, which bytes clamp.
pub(super) fn colors(
    radiance: &[[f64; 3]],
    exposure: f64,
    format: VertexColors,
) -> Result<(Attribute, FactoredCounts), CardError> {
    let colors: Vec<[f64; 3]> = radiance.iter().map(|color| color.map(|value| exposure * value)).collect();
    let count = |is_out: fn(&f64) -> bool| Some(colors.iter().filter(|color| color.iter().any(is_out)).count() as u64);
    let counts = FactoredCounts {
        vertices_below_zero: count(|&value| value < 0.0),
        vertices_above_one: count(|&value| value > 1.0),
        ..FactoredCounts::default()
    };
    let held = |color: &[f64; 3]| match format {
        VertexColors::Floats => attribute(*color, 1.0),
        VertexColors::Bytes => attribute(color.map(|value| (value.clamp(0.0, 1.0) * 255.0).round() / 255.0), 1.0),
    };
    let stream: Attribute = colors.iter().map(held).collect();
    check_finite(HELD, std::slice::from_ref(&stream))?;
    Ok((stream, counts))
}

/// The expected value in error messages about attributes.
const HELD: &str = "radiance that its format holds";

/// The coordinate sets of a pass that multiplies per pixel: T_p times exposure, color and `scales`. Each term has a
/// scale, which compensates the scale of G's texels.
pub(super) fn radiance_sets(
    mesh: &TransferredMesh<'_>,
    options: &ProductOptions,
    scales: &[f64],
    exposure: f64,
    pass: usize,
) -> Result<Vec<Attribute>, CardError> {
    let layout = options.layout(mesh.terms());
    let rounded = |value: f64| match options.radiance {
        RadianceFormat::Fp32 => value as f32,
        RadianceFormat::Fp16 => through_half(value as f32),
    };
    let of_vertex = |vertex: usize| {
        let mut numbers = vec![[0_u32; 4]; layout.sets()];
        let color = mesh.color(vertex);
        for (term, row) in mesh.transferred.of(vertex).iter().enumerate() {
            for channel in 0..layout.channels {
                let of = if layout.channels == 1 { pass } else { channel };
                let (set, component) = layout.place(term, channel);
                let value = f64::from(row[of]) * color[of] * exposure * scales[term];
                numbers[set][component] = rounded(value).to_bits();
            }
        }
        numbers
    };
    let sets = by_register(layout.sets(), mesh.vertices.len(), of_vertex);
    check_finite(HELD, &sets)?;
    Ok(sets)
}
