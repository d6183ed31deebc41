//! The lit model that studies of all-frequency transfer share, and the steps of its rendering (section 6).

use rayon::prelude::*;

use crate::all_frequency::file::AllFrequencyFile;
use crate::all_frequency::on_card::TransferredMesh;
use crate::all_frequency::shade::{Multiplies, Shader, TransferredRadiance, exit_radiance};
use crate::all_frequency::transfer::transfer_of;
use crate::error::InputError;
use crate::geom::Mesh;
use crate::geom::vector::wide;
use crate::linalg::dot;
use crate::scene::Camera;
use crate::study::StudyError;
use crate::study::prt::LitView;
use crate::transfer::Vertices;
use crate::transfer::grid::Segmentation;
use crate::transfer::light::{DistantLight, HaarLight, LightTruncation, TruncationPriority};
use crate::transfer::linear_basis::LinearBasis;

/// A model with its transfer, a light and a camera.
#[derive(Debug)]
pub struct LitModel {
    /// Names, camera and exposure.
    pub view: LitView,
    /// The model.
    pub model: LitPart,
    /// The ground below the model, with transfer of its own.
    pub ground: Option<LitPart>,
    /// A file with the model's visibility, for measuring the loss of compression.
    pub original: Option<AllFrequencyFile>,
    /// The light.
    pub light: DistantLight,
    /// Number of light coefficients kept, the largest by area times magnitude; `None` for all.
    pub keep: Option<usize>,
}

/// A mesh with transfer: a model, or the ground below it.
#[derive(Debug)]
pub struct LitPart {
    /// The mesh.
    pub mesh: Mesh,
    /// Its vertices.
    pub vertices: Vertices,
    /// Surface color per material.
    pub colors: Vec<[f64; 3]>,
    /// Visibility, coded transfer or both; if there is coded transfer, it is drawn.
    pub file: AllFrequencyFile,
}

/// Transferred radiance: `rows` rows per vertex.
pub(in crate::study::prt) struct Transferred {
    rows: usize,
    values: Vec<[f64; 3]>,
}

impl Transferred {
    /// Converts to single precision, the precision of a card's input.
    pub(in crate::study::prt) fn singles(self) -> TransferredRadiance {
        singles(self.rows, self.values)
    }
}

/// Transferred radiance, each number rounded once to f32.
pub(in crate::study::prt) fn singles(rows: usize, values: Vec<[f64; 3]>) -> TransferredRadiance {
    let values = values.into_iter().map(|row| row.map(|value| value as f32)).collect();
    TransferredRadiance::new(rows, values)
}

impl LitModel {
    /// The model, then the ground below it.
    pub(in crate::study::prt) fn parts(&self) -> impl Iterator<Item = &LitPart> {
        std::iter::once(&self.model).chain(&self.ground)
    }

    /// The coefficients of the light: the `keep` largest by area times magnitude, or all (step 1).
    pub(in crate::study::prt) fn cut(&self, keep: Option<usize>) -> Result<LightTruncation, InputError> {
        let light = HaarLight::new(&self.light.cube()?, Segmentation::Quarters);
        Ok(light.truncated(keep.unwrap_or(usize::MAX), TruncationPriority::Area))
    }
}

impl LitPart {
    /// The mesh in the form that a card draws.
    pub(in crate::study::prt) fn on_card<'a>(&'a self, transferred: &'a TransferredRadiance) -> TransferredMesh<'a> {
        let Self { vertices, colors, file, .. } = self;
        TransferredMesh { vertices, reflectance: &file.reflectance, colors, transferred }
    }

    /// Transferred radiance by steps 2 and 3, or by raw matrices if transfer is not coded.
    pub(in crate::study::prt) fn transferred(&self, light: &HaarLight) -> Result<Transferred, StudyError> {
        let Some(coded) = &self.file.coded else { return Ok(self.exact(&self.file, light)?) };
        let radiance = Shader::new(coded).transferred(&light.singles())?;
        let rows = (0..radiance.vertices()).flat_map(|vertex| radiance.of(vertex));
        Ok(Transferred { rows: radiance.rows(), values: rows.map(|row| row.map(f64::from)).collect() })
    }

    /// Transferred radiance by the raw matrices of a file, M_p L, segment by segment.
    pub(in crate::study::prt) fn exact(
        &self,
        file: &AllFrequencyFile,
        light: &HaarLight,
    ) -> Result<Transferred, InputError> {
        let rows = file.reflectance.terms();
        let mut values = vec![[0.0; 3]; self.vertices.len() * rows];
        let Some(maps) = &file.visibility else { return Ok(Transferred { rows, values }) };
        let hats = LinearBasis::new(file.hats);
        let transfer = transfer_of(&self.vertices, maps, &hats, &file.reflectance);
        for segment in transfer.segments() {
            let segment = segment?;
            let light = [0, 1, 2].map(|channel| light.segment(channel, segment.segment));
            let products = |point: usize| -> Vec<[f64; 3]> {
                let numbers: Vec<f64> = segment.signal.point(point).iter().map(|&value| f64::from(value)).collect();
                numbers.chunks_exact(light[0].len()).map(|row| light.map(|light| dot(row, light))).collect()
            };
            let products: Vec<Vec<[f64; 3]>> = (0..segment.vertices.len()).into_par_iter().map(products).collect();
            for (&vertex, products) in segment.vertices.iter().zip(products) {
                for (into, product) in values[vertex as usize * rows..].iter_mut().zip(products) {
                    (0..3).for_each(|channel| into[channel] += product[channel]);
                }
            }
        }
        Ok(Transferred { rows, values })
    }

    /// Exit radiance towards a camera (step 4).
    pub(super) fn radiance(&self, transferred: &Transferred, camera: &Camera) -> Vec<[f64; 3]> {
        let of = |vertex: usize, row: usize| transferred.values[vertex * transferred.rows + row];
        let color = |vertex: usize| self.colors[self.vertices.materials()[vertex] as usize];
        exit_radiance(&self.vertices, &self.file.reflectance, &color, &of, wide(camera.eye()))
    }

    /// Multiplications of steps 2 and 3. Without a code each light coefficient that is not 0 is multiplied in the raw
    /// matrix of every vertex.
    pub(in crate::study::prt) fn multiplies(&self, light: &HaarLight) -> Multiplies {
        let light = light.singles();
        let Some(coded) = &self.file.coded else {
            let nonzero = light.iter().filter(|rgb| **rgb != [0.0; 3]).count();
            let per_vertex = (3 * self.file.reflectance.terms() * self.vertices.len() * nonzero) as u64;
            return Multiplies { per_cluster: 0, per_vertex };
        };
        Shader::new(coded).multiplies(&light)
    }
}
