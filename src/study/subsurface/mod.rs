//! Subsurface scattering of a model by several ways of gathering: the three passes of an emulated card beside the host's
//! sums over the same links, and over all pairs of texels.

mod conclusion;
mod error;
mod model;
mod parameters;
mod pictures;
mod report;
mod tables;
mod truth;
mod way;

use crate::atlas::Atlas;
use crate::report::{Findings, Provenance};
use crate::study::{ProgressFn, Study};
use crate::subsurface::factor::SurfaceMoments;
use crate::subsurface::on_card::CardModel;
use crate::subsurface::{Dipole, irradiance};

pub use error::SubsurfaceError;
pub use model::ModelLengths;
pub use parameters::{GatherWay, Lighting, MapBits, Parameters};
pub use truth::{RadiosityError, Truth};
pub use way::WayRow;

/// What a study found.
#[derive(Debug)]
pub struct SubsurfaceOutcome {
    /// The model's atlas.
    pub atlas: Atlas,
    /// Lengths of model and medium.
    pub lengths: ModelLengths,
    /// Of red, green and blue.
    pub dipoles: [Dipole; 3],
    /// E of equation 8 per texel, by the host.
    pub irradiance: Vec<[f64; 3]>,
    /// All pairs, if asked for.
    pub truth: Option<Truth>,
    /// For each probe its texel.
    pub probe_texels: Vec<usize>,
    /// A row per way.
    pub rows: Vec<WayRow>,
}

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
    let lengths = ModelLengths::of(&atlas, parameters, &dipoles);
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
    let mut rows = Vec::new();
    for (at, &way) in parameters.ways.iter().enumerate() {
        rows.push(way::run(&scene, way, at == 0, progress)?);
    }
    Ok(SubsurfaceOutcome { atlas, lengths, dipoles, irradiance, truth, probe_texels, rows })
}
