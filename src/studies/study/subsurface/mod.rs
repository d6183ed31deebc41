//! Subsurface scattering of a model by several ways of gathering: the three passes of an emulated card, the host's sums
//! over the same links, and those over all pairs of texels.

mod conclusion;
mod error;
mod model;
mod outcome;
mod parameters;
mod pictures;
mod report;
mod roundings;
mod tables;
mod truth;
mod way;

use crate::atlas::Atlas;
use crate::report::{Findings, Provenance};
use crate::study::{ProgressFn, Study};
use crate::subsurface::factor::SurfaceMoments;
use crate::subsurface::links::Links;
use crate::subsurface::on_card::CardModel;
use crate::subsurface::{Dipole, irradiance};

pub use error::SubsurfaceError;
pub use model::ModelLengths;
pub use outcome::SubsurfaceOutcome;
pub use parameters::{GatherWay, Lighting, MapBits, Parameters};
pub use roundings::RoundingRow;
pub use truth::{GatherError, Truth};
pub use way::WayRow;

impl Study for Parameters {
    type Error = SubsurfaceError;

    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, SubsurfaceError> {
        report::findings(self, &run(self, progress)?)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.clone_from(&self.switches);
        provenance
    }
}

/// Builds the atlas, lights it, gathers over all pairs and by every way.
///
/// # Errors
/// [`SubsurfaceError`].
pub fn run(parameters: &Parameters, progress: &mut ProgressFn<'_>) -> Result<SubsurfaceOutcome, SubsurfaceError> {
    let eta = parameters.material.eta;
    let [red, green, blue] = parameters.material.channels;
    let dipoles = [Dipole::new(red, eta)?, Dipole::new(green, eta)?, Dipole::new(blue, eta)?];
    progress("atlas", 0, 1);
    let atlas = Atlas::new(&parameters.mesh, parameters.side)?;
    let surface = SurfaceMoments::new(&atlas, parameters.mm_per_unit)?;
    let lengths = ModelLengths::of(&atlas, &surface, parameters, &dipoles);
    let probe_texels = model::probe_texels(&atlas, parameters, lengths.diagonal)?;
    let irradiance = match &parameters.lighting {
        Lighting::Lights(lights) => irradiance(&atlas, lights, eta),
        Lighting::ByFace(values) if values.len() != parameters.mesh.len() => {
            return Err(SubsurfaceError::Faces { faces: parameters.mesh.len(), found: values.len() });
        }
        Lighting::ByFace(values) => model::by_texel(&atlas, values),
    };
    if irradiance.iter().flatten().all(|&e| e == 0.0) {
        return Err(SubsurfaceError::Dark);
    }
    let truth = if parameters.reference {
        Some(truth::truth(&atlas, parameters, &dipoles, &irradiance, progress)?)
    } else {
        None
    };
    let model = CardModel::new(&atlas);
    let scene = way::Scene {
        parameters,
        atlas: &atlas,
        surface: &surface,
        model: &model,
        dipoles: &dipoles,
        irradiance: &irradiance,
        truth: truth.as_ref(),
    };
    let (mut rows, mut roundings) = (Vec::new(), Vec::new());
    // Ways that differ in formats alone follow each other and share their links.
    let mut last: Option<(GatherWay, Links)> = None;
    for (at, &way) in parameters.ways.iter().enumerate() {
        let links = match last.take() {
            Some((other, links)) if (other.choice, other.rgb) == (way.choice, way.rgb) => links,
            _ => way::links(&scene, way, progress)?,
        };
        let row = way::run(&scene, way, (&links, at == 0), progress)?;
        if parameters.roundings {
            roundings.extend(roundings::roundings(&scene, way, (&links, &row.radiosity), progress)?);
        }
        rows.push(row);
        last = Some((way, links));
    }
    Ok(SubsurfaceOutcome { atlas, lengths, dipoles, irradiance, truth, probe_texels, rows, roundings })
}
