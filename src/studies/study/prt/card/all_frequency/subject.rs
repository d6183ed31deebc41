//! A lit model with all-frequency transfer, and the steps that the host computes before a card draws it.

use crate::all_frequency::code::CodedTransfer;
use crate::all_frequency::on_card::{ProductPlace, TransferredMesh};
use crate::all_frequency::shade::{Multiplies, TransferredRadiance, plain};
use crate::error::InputError;
use crate::study::StudyError;
use crate::study::prt::LitModel;
use crate::study::prt::all_frequency::{FrameTimes, Part, exact, singles};
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

/// Steps 1 to 3 of section 6 for the model and its ground, and their counts of multiplications.
pub(super) struct HostSteps {
    pub(super) cut: LightTruncation,
    pub(super) transferred: Vec<TransferredRadiance>,
    pub(super) multiplies: Multiplies,
}

impl AllFrequencyOnCard {
    /// The model, then the ground.
    pub(super) fn meshes<'a>(&'a self, transferred: &'a [TransferredRadiance]) -> Vec<TransferredMesh<'a>> {
        let mesh = |(part, transferred)| Part::mesh(part, transferred);
        self.lit.parts().iter().zip(transferred).map(mesh).collect()
    }

    pub(super) fn cut(&self, keep: Option<usize>) -> Result<LightTruncation, InputError> {
        exact::coefficients(&self.lit.light, keep)
    }

    /// Computes the host's steps, before a card draws.
    pub(super) fn steps(&self) -> Result<HostSteps, StudyError> {
        let cut = self.cut(self.lit.keep)?;
        let (mut transferred, mut multiplies) = (Vec::new(), Multiplies::default());
        for part in self.lit.parts() {
            transferred.push(part.transferred(&cut.light, &mut FrameTimes::default())?.singles());
            let [per_cluster, per_vertex, _] = part.multiplies(&cut.light.singles());
            multiplies.per_cluster += per_cluster;
            multiplies.per_vertex += per_vertex;
        }
        Ok(HostSteps { cut, transferred, multiplies })
    }

    /// Transferred radiance of the model and its ground in f64, one rounding to f32 each.
    pub(super) fn in_double(&self, light: &HaarLight) -> Result<Vec<TransferredRadiance>, StudyError> {
        let of = |part: &Part<'_>| match part.coded() {
            Some(coded) => Ok(in_double(coded, light)?),
            None => Ok(part.transferred(light, &mut FrameTimes::default())?.singles()),
        };
        self.lit.parts().iter().map(of).collect()
    }
}

/// Steps 2 and 3 in f64, one rounding to f32 each.
pub(super) fn in_double(coded: &CodedTransfer, light: &HaarLight) -> Result<TransferredRadiance, InputError> {
    let light: Vec<[f64; 3]> = light.singles().into_iter().map(|rgb| rgb.map(f64::from)).collect();
    Ok(singles(coded.rows, plain::transferred_of_code(coded, &light)?))
}
