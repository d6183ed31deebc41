//! The dipole's own error: photons followed through the model, beside what ways gather.

use super::{Parameters, model};
use crate::atlas::Atlas;
use crate::geom::Sides;
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::walk::{self, PhotonWalk, WalkEstimate, WalkTally};
use crate::subsurface::{Dipole, Material};
use crate::tracer::HostTracer;

/// Photons of one channel, and the light that they stand for.
#[derive(Clone, Debug, PartialEq)]
pub struct WalkedChannel {
    /// Light that enters the model: the sum of E times area, in mm^2.
    pub flux: f64,
    /// The photons; bins are the faces.
    pub tally: WalkTally,
}

impl WalkedChannel {
    /// The mean of B on a face of this area in mm^2.
    pub fn radiosity(&self, face: usize, area: f64) -> WalkEstimate {
        let factor = if area > 0.0 { self.flux / area } else { 0.0 };
        self.tally.fraction(face).times(factor)
    }
}

/// Follows photons through the model, as many per channel; `None` for a channel that no light enters. A photon enters
/// a face with the probability of what enters there, and diffusely, as the dipole assumes.
pub(super) fn walk(
    atlas: &Atlas,
    parameters: &Parameters,
    (dipoles, irradiance): (&[Dipole; 3], &[[f64; 3]]),
    photons: u64,
    progress: &mut ProgressFn<'_>,
) -> Result<[Option<WalkedChannel>; 3], StudyError> {
    let scale = parameters.options.mm_per_unit * parameters.options.mm_per_unit;
    let entered = model::by_face(atlas, irradiance);
    let flux = |channel: usize| -> Vec<f64> {
        (0..).zip(&entered).map(|(face, e)| e[channel] * parameters.mesh.area(face) * scale).collect()
    };
    let fluxes = [0, 1, 2].map(flux);
    let mut caster = HostTracer::new(&parameters.mesh, Sides::Both);
    let mut found: [Option<WalkedChannel>; 3] = [None, None, None];
    for (channel, flux) in fluxes.iter().enumerate() {
        progress(&format!("photons, {}", Material::CHANNELS[channel]), channel as u64, 3);
        let medium = |of: usize| dipoles[of].coefficients();
        let same = |&other: &usize| medium(other) == medium(channel) && fluxes[other] == *flux;
        if let Some(other) = (0..channel).find(same) {
            found[channel] = found[other].clone();
            continue;
        }
        let total = flux.iter().sum::<f64>();
        if total > 0.0 {
            let walk = PhotonWalk { photons, ..PhotonWalk::new(medium(channel), parameters.material.eta)? };
            let tally = walk::mesh(&walk, &parameters.mesh, parameters.options.mm_per_unit, flux, &mut caster)?;
            found[channel] = Some(WalkedChannel { flux: total, tally });
        }
    }
    Ok(found)
}
