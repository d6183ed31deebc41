//! A mesh with its transfer: a model, or the ground below it.

use std::time::Instant;

use super::exact;
use crate::all_frequency::code::CodedTransfer;
use crate::all_frequency::file::AllFrequencyFile;
use crate::all_frequency::on_card::TransferredMesh;
use crate::all_frequency::shade::{Multiplies, Shader, TransferredRadiance, exit_radiance};
use crate::error::InputError;
use crate::geom::vector::wide;
use crate::scene::Camera;
use crate::study::StudyError;
use crate::transfer::Vertices;
use crate::transfer::light::HaarLight;

/// Transferred radiance, from coded transfer or from raw matrices.
pub(in crate::study::prt) enum Transferred {
    Coded(TransferredRadiance),
    Exact { rows: usize, values: Vec<[f64; 3]> },
}

impl Transferred {
    /// Converts to single precision, in which a card takes it.
    pub(in crate::study::prt) fn singles(self) -> TransferredRadiance {
        match self {
            Self::Coded(radiance) => radiance,
            Self::Exact { rows, values } => singles(rows, values),
        }
    }
}

/// Transferred radiance, each number rounded once to f32.
pub(in crate::study::prt) fn singles(rows: usize, values: Vec<[f64; 3]>) -> TransferredRadiance {
    let values = values.into_iter().map(|row| row.map(|value| value as f32)).collect();
    TransferredRadiance::new(rows, values)
}

/// Times of a frame, in seconds.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::study::prt) struct FrameTimes {
    pub(super) light: f64,
    pub(super) clusters: f64,
    pub(super) vertices: f64,
    pub(super) view: f64,
}

impl FrameTimes {
    pub(super) fn total(self) -> f64 {
        self.light + self.clusters + self.vertices + self.view
    }
}

/// A mesh's vertices with transfer, laid out for rendering.
pub(in crate::study::prt) struct Part<'a> {
    vertices: &'a Vertices,
    colors: &'a [[f64; 3]],
    file: &'a AllFrequencyFile,
    shader: Option<Shader>,
}

impl<'a> Part<'a> {
    pub(super) fn new(vertices: &'a Vertices, colors: &'a [[f64; 3]], file: &'a AllFrequencyFile) -> Self {
        let shader = file.coded.as_ref().map(Shader::new);
        Self { vertices, colors, file, shader }
    }

    /// Returns `true` if transfer is coded.
    pub(in crate::study::prt) fn is_coded(&self) -> bool {
        self.shader.is_some()
    }

    pub(in crate::study::prt) fn coded(&self) -> Option<&'a CodedTransfer> {
        self.file.coded.as_ref()
    }

    /// The mesh in the form that a card draws.
    pub(in crate::study::prt) fn mesh(&self, transferred: &'a TransferredRadiance) -> TransferredMesh<'a> {
        let Self { vertices, colors, .. } = *self;
        TransferredMesh { vertices, reflectance: &self.file.reflectance, colors, transferred }
    }

    /// Transferred radiance by steps 2 and 3, or by raw matrices if transfer is not coded.
    pub(in crate::study::prt) fn transferred(
        &self,
        light: &HaarLight,
        times: &mut FrameTimes,
    ) -> Result<Transferred, StudyError> {
        let Some(shader) = &self.shader else { return Ok(self.exact(self.file, light)?) };
        let light = light.singles();
        let start = Instant::now();
        let products = shader.per_cluster(&light)?;
        times.clusters += start.elapsed().as_secs_f64();
        let start = Instant::now();
        let transferred = shader.weighted(&products);
        times.vertices += start.elapsed().as_secs_f64();
        Ok(Transferred::Coded(transferred))
    }

    /// Transferred radiance by the raw matrices of a file.
    pub(in crate::study::prt) fn exact(
        &self,
        file: &AllFrequencyFile,
        light: &HaarLight,
    ) -> Result<Transferred, InputError> {
        let rows = file.reflectance.terms();
        let values = match &file.visibility {
            Some(maps) => exact::transferred((self.vertices, maps), file.hats, &file.reflectance, &[light])?.remove(0),
            None => vec![[0.0; 3]; rows * self.vertices.len()],
        };
        Ok(Transferred::Exact { rows, values })
    }

    /// Computes exit radiance: step 4.
    pub(super) fn radiance(&self, transferred: &Transferred, camera: &Camera, times: &mut FrameTimes) -> Vec<[f64; 3]> {
        let start = Instant::now();
        let of = |vertex: usize, row: usize| match transferred {
            Transferred::Coded(radiance) => radiance.of(vertex)[row].map(f64::from),
            Transferred::Exact { rows, values } => values[vertex * rows + row],
        };
        let color = |vertex: usize| self.colors[self.vertices.materials()[vertex] as usize];
        let radiance = exit_radiance(self.vertices, &self.file.reflectance, &color, &of, wide(camera.eye()));
        times.view += start.elapsed().as_secs_f64();
        radiance
    }

    /// Multiplications of steps 2, 3 and 4. Without a code each light coefficient that is not 0 is multiplied in the raw
    /// matrix of every vertex.
    pub(in crate::study::prt) fn multiplies(&self, light: &[[f32; 3]]) -> [u64; 3] {
        let products = 3 * (self.file.reflectance.terms() * self.vertices.len()) as u64;
        let Some(shader) = &self.shader else {
            return [0, products * light.iter().filter(|rgb| **rgb != [0.0; 3]).count() as u64, products];
        };
        let Multiplies { per_cluster, per_vertex } = shader.multiplies(light);
        [per_cluster, per_vertex, products]
    }
}
