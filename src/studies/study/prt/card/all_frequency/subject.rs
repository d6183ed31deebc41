//! A lit model with all-frequency transfer, and the steps that the host computes before a card draws it.

use crate::all_frequency::code::CodedTransfer;
use crate::all_frequency::file::AllFrequencyFile;
use crate::all_frequency::on_card::{ProductPlace, TransferredMesh};
use crate::all_frequency::shade::{LightSizeError, Multiplies, Shader, TransferredRadiance, plain};
use crate::error::InputError;
use crate::study::StudyError;
use crate::study::prt::LitModel;
use crate::study::prt::all_frequency::exact;
use crate::study::prt::card::CardSetting;
use crate::transfer::light::{HaarLight, LightTruncation};

/// A lit model with all-frequency transfer, and the card that draws it.
#[derive(Debug)]
pub struct AllFrequencyOnCard {
    /// The model, its transfer, the light and the camera.
    pub lit: LitModel,
    /// The card that draws.
    pub card: CardSetting,
    /// Where products with G are computed.
    pub place: ProductPlace,
}

/// Steps 1 to 3 of section 6, and their counts of multiplications.
pub(super) struct HostSteps {
    pub(super) cut: LightTruncation,
    pub(super) transferred: TransferredRadiance,
    pub(super) multiplies: Multiplies,
}

impl AllFrequencyOnCard {
    pub(super) fn mesh_of<'a>(&'a self, transferred: &'a TransferredRadiance) -> TransferredMesh<'a> {
        let LitModel { vertices, colors, file, .. } = &self.lit;
        TransferredMesh { vertices, reflectance: &file.reflectance, colors, transferred }
    }

    pub(super) fn cut(&self, keep: Option<usize>) -> Result<LightTruncation, InputError> {
        exact::coefficients((&self.lit.light, self.lit.decimation), keep)
    }

    /// Computes the host's steps, before a card draws.
    pub(super) fn steps(&self) -> Result<HostSteps, StudyError> {
        let cut = self.cut(self.lit.keep)?;
        let (transferred, multiplies) = match &self.lit.file.coded {
            Some(coded) => by_shader(coded, &cut.light)?,
            // Each nonzero light coefficient is multiplied with the raw matrix of every vertex.
            None => {
                let per_vertex = 3 * (self.lit.file.reflectance.terms() * cut.kept * self.lit.vertices.len()) as u64;
                (self.raw(&self.lit.file, &cut.light)?, Multiplies { per_cluster: 0, per_vertex })
            }
        };
        Ok(HostSteps { cut, transferred, multiplies })
    }

    /// Transferred radiance by raw matrices in f64, with one rounding to f32.
    pub(super) fn raw(&self, file: &AllFrequencyFile, light: &HaarLight) -> Result<TransferredRadiance, StudyError> {
        let rows = file.reflectance.terms();
        let values = match &file.visibility {
            Some(maps) => {
                exact::transferred((&self.lit.vertices, maps), file.hats, &file.reflectance, &[light])?.remove(0)
            }
            None => vec![[0.0; 3]; rows * self.lit.vertices.len()],
        };
        Ok(singles(rows, values))
    }
}

/// Steps 2 and 3 in f32, as in rendering a frame.
pub(super) fn by_shader(
    coded: &CodedTransfer,
    light: &HaarLight,
) -> Result<(TransferredRadiance, Multiplies), LightSizeError> {
    let (shader, light) = (Shader::new(coded), light.singles());
    Ok((shader.transferred(&light)?, shader.multiplies(&light)))
}

/// Steps 2 and 3 in f64, with one rounding to f32.
pub(super) fn in_double(coded: &CodedTransfer, light: &HaarLight) -> Result<TransferredRadiance, LightSizeError> {
    let light: Vec<[f64; 3]> = light.singles().into_iter().map(|rgb| rgb.map(f64::from)).collect();
    Ok(singles(coded.rows, plain::transferred_of_code(coded, &light)?))
}

fn singles(rows: usize, values: Vec<[f64; 3]>) -> TransferredRadiance {
    let values = values.into_iter().map(|row| row.map(|value| value as f32)).collect();
    TransferredRadiance::new(rows, values)
}
