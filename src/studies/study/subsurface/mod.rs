//! Subsurface scattering of a model by several ways of gathering: the three passes of an emulated card, the host's sums
//! over the same links, and the sums over all pairs of texels.

mod all_pairs;
mod angles;
mod conclusion;
pub(in crate::study) mod environment;
mod model;
mod options;
mod outcome;
mod pictures;
mod report;
mod seams;
mod tables;
mod way;

use crate::atlas::Atlas;
use crate::report::{Findings, Provenance};
use crate::study::{ProgressFn, Study, StudyError};
use crate::subsurface::links::Links;
use crate::subsurface::multipole::SurfaceMoments;
use crate::subsurface::on_card::{CardModel, SubsurfaceCard};
use crate::subsurface::{Dipole, irradiance};

use angles::{AngleBin, BinError};
use model::ModelLengths;
use options::ALL_PAIRS_SIDE;
use outcome::SubsurfaceOutcome;
use seams::Neighbours;
use way::WayRow;

pub(in crate::study) use options::no_card;
pub use options::{GatherWay, Lighting, MapBits, Parameters, SubsurfaceOptions, no_atlas};

impl Study for Parameters {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        report::findings(self, &run(self, progress)?)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.profiles.push(self.profile.name.clone());
        provenance.switches.clone_from(&self.switches);
        provenance
    }
}

/// Builds the atlas, lights it, gathers over all pairs and by every way.
fn run(parameters: &Parameters, progress: &mut ProgressFn<'_>) -> Result<SubsurfaceOutcome, StudyError> {
    // Before the sums, which take long.
    SubsurfaceCard::require(&parameters.profile).map_err(no_card)?;
    let eta = parameters.material.eta;
    let [red, green, blue] = parameters.material.channels;
    let dipoles = [Dipole::new(red, eta)?, Dipole::new(green, eta)?, Dipole::new(blue, eta)?];
    progress("atlas", 0, 1);
    let atlas = Atlas::new(&parameters.mesh, parameters.options.side).map_err(no_atlas)?;
    let surface = SurfaceMoments::new(&atlas, parameters.options.mm_per_unit)?;
    let lengths = ModelLengths::of(&atlas, parameters, &dipoles);
    let (irradiance, cast) = match &parameters.lighting {
        Lighting::Lights(lights) => (irradiance(&atlas, lights, eta), None),
        Lighting::Environment(light) => {
            progress("environment light", 0, 1);
            environment::irradiance(&atlas, parameters, light)?
        }
    };
    if irradiance.iter().flatten().all(|&e| e == 0.0) {
        let help = "add a `--light`, or move one to where the model's front faces see it";
        return Err(StudyError::new("subsurface::dark", "expected light on the model, found none").with_help(help));
    }
    let (model, neighbours) = (CardModel::new(&atlas), Neighbours::of(&atlas));
    let truth = parameters.options.gathers_all_pairs();
    let truth = truth.then(|| all_pairs::radiosity(parameters, &atlas, &dipoles, &irradiance, progress)).transpose()?;
    let scene = way::Scene {
        parameters,
        atlas: &atlas,
        surface: &surface,
        model: &model,
        dipoles: &dipoles,
        irradiance: &irradiance,
        truth: truth.as_deref(),
        neighbours: &neighbours,
    };
    let mut rows = Vec::new();
    // Ways that differ only in formats follow each other, and share their links.
    let mut last: Option<(GatherWay, Links)> = None;
    for (at, &way) in parameters.ways.iter().enumerate() {
        let links = match last.take() {
            Some((other, links)) if (other.choice, other.rgb) == (way.choice, way.rgb) => links,
            _ => way::links(&scene, way, progress)?,
        };
        rows.push(way::run(&scene, way, (&links, at == 0), progress)?);
        last = Some((way, links));
    }
    Ok(SubsurfaceOutcome { lengths, truth, rows, atlas, dipoles, irradiance, cast })
}
