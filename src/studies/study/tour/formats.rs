//! Errors of each system of the room, by number format.

use refsim::machine::Executor;

use super::light;
use super::scene::{BUNNY, TourScene};
use crate::card::{CardError, MeshView, SeenPixel, seen_pixels};
use crate::cpca::on_card::PrtCardOptions;
use crate::geom::Mesh;
use crate::picture::metrics::{ErrorSums, value_error};
use crate::radiosity::solve::{Options, Solver};
use crate::radiosity::{FormFactors, Patches, System};
use crate::report::words::percent;
use crate::report::{Cell, Findings, FoundTable, Table};
use crate::sphere::HarmonicLight;
use crate::study::caster::CasterChoice;
use crate::study::configuration::Configuration;
use crate::study::glossy_model::GlossyModel;
use crate::study::marble_model::MarbleModel;
use crate::study::radiosity::SolutionError;
use crate::study::{ProgressFn, StudyError};
use crate::subsurface::on_card::FloatTexels;
use crate::transfer::{Tangents, Vertices};
use refsim::texture::TexelFormat;

/// The formats; the first is the reference for pictures.
const FORMATS: [&str; 4] = ["fp32", "fp24", "fp16", "s3.12"];

/// Inputs that all formats share.
pub(super) struct FormatSubject<'a> {
    pub(super) scene: &'a TourScene,
    pub(super) patches: &'a Patches,
    pub(super) bunny: (&'a GlossyModel, &'a HarmonicLight),
    /// The marble statue, with the light that enters each texel of its atlas.
    pub(super) statue: (&'a MarbleModel, &'a [[f64; 3]]),
    pub(super) view: MeshView,
}

/// Errors of one format.
pub(super) struct FormatRow {
    format: &'static str,
    /// Fraction of the rays of form factors that differ from exact arithmetic.
    differing: f64,
    /// Error of radiosity if these rays compute the form factors, compared with the host's rays.
    by_rays: SolutionError,
    /// Error of radiosity by sums in the format, compared with the direct solution; `None` if the programs do not run.
    by_sums: Option<SolutionError>,
    /// Error of the bunny's coefficients by these rays: relative RMS of the differences.
    transfer: f64,
    /// RMS errors, in steps of 1/255, of pixels that show the bunny and the statue, compared with fp32.
    pictures: [Option<f64>; 2],
}

impl FormatSubject<'_> {
    /// The errors of each format, on cards without limits.
    pub(super) fn rows(
        &self,
        executor: &Executor,
        progress: &mut ProgressFn<'_>,
    ) -> Result<Vec<FormatRow>, StudyError> {
        let Self { scene, patches, bunny, statue, view } = *self;
        let system = |factors: FormFactors| System::new(factors, patches.reflectances(), patches.emittances());
        let direct = |system: &System| -> Result<Vec<[f64; 3]>, StudyError> {
            Ok(system.solve(Solver::Direct, &Options::default())?.radiosity())
        };
        let host = system(light::factors(patches, &CasterChoice::Host, progress)?.0)?;
        let reference = direct(&host)?;
        let error = |found: &[[f64; 3]]| SolutionError::between(found, &reference, host.emittance());
        let vertices = Vertices::new(&scene.bunny, Tangents::Any)?;
        let by_host = BUNNY.precompute((&scene.bunny, &vertices), &CasterChoice::Host, progress)?.0;
        let ideal = Configuration::format(FORMATS[0])?.profile;
        let shows = |mesh: &Mesh| seen_pixels(&ideal, (mesh.positions(), mesh.triangles()), &view.camera);
        let masks = [shows(&scene.bunny)?, shows(&scene.statue)?];
        let maps = PrtCardOptions { map_format: TexelFormat::Rgba32f, ..PrtCardOptions::default() };
        let (mut rows, mut first) = (Vec::new(), None);
        for format in FORMATS {
            let card = Configuration::format(format)?;
            let engine = CasterChoice::engine(card.clone(), executor.clone());
            let (factors, cast) = light::factors(patches, &engine, progress)?;
            let differing =
                cast.map_or(0.0, |cast| cast.differing.unwrap_or(0) as f64 / cast.counts.rays.max(1) as f64);
            let computed = BUNNY.precompute((&scene.bunny, &vertices), &engine, progress)?.0;
            progress(&format!("pictures in {format}"), 0, 1);
            let on = (&card.profile, executor);
            let marble = statue.0.draw(|card| card.irradiate(statue.1), on, view, FloatTexels::Fp32);
            let glossy = bunny.0.draw(bunny.1, on, &view, &maps);
            let drawn = [ran(glossy)?, ran(marble)?].map(|drawn| drawn.map(|(colors, _)| colors));
            let by_sums = ran(light::radiosity(&host, on.0, executor))?;
            let first = &*first.get_or_insert_with(|| drawn.clone());
            let off = |at: usize| Some(error_255ths(&masks[at], drawn[at].as_ref()?, first[at].as_ref()?));
            rows.push(FormatRow {
                format,
                differing,
                by_rays: error(&direct(&system(factors)?)?),
                by_sums: by_sums.map(|(found, ..)| error(&found)),
                transfer: computed.off(&by_host).1,
                pictures: [0, 1].map(off),
            });
        }
        Ok(rows)
    }
}

/// `None` if the device refuses to compute it.
fn ran<T>(result: Result<T, StudyError>) -> Result<Option<T>, StudyError> {
    match result {
        Err(error) if error.downcast_ref().is_some_and(CardError::is_refusal) => Ok(None),
        result => result.map(Some),
    }
}

/// Root mean square error of the pixels that show a model, in steps of 1/255.
fn error_255ths(shown: &[Option<SeenPixel>], found: &[[f64; 3]], expected: &[[f64; 3]]) -> f64 {
    let mut sums = ErrorSums::default();
    for ((found, expected), _) in found.iter().zip(expected).zip(shown).filter(|(_, seen)| seen.is_some()) {
        found.iter().zip(expected).for_each(|(&a, &b)| sums.add(255.0 * value_error(a, b), 1.0));
    }
    sums.rms()
}

/// Adds a sentence about the shortest format that runs everywhere.
pub(super) fn conclude(rows: &[FormatRow], found: &mut Findings) {
    for FormatRow { format, differing, by_rays, .. } in rows.iter().filter(|row| row.format == "s3.12") {
        found.conclusion(format!(
            "In {format}, {} of the rays differ from exact arithmetic, and the room is {} brighter than with the host's rays.",
            percent(*differing),
            percent(by_rays.bias),
        ));
    }
}

/// Adds the table.
pub(super) fn report(rows: &[FormatRow], found: &mut Findings) {
    let columns = "format rays_differing_% room_by_rays_% room_by_sums_% transfer_% bunny_255ths statue_255ths";
    let mut table = Table::of("Errors by format", columns);
    let ran = |cell: Option<Cell>| cell.unwrap_or_else(|| "cannot run".into());
    for row in rows {
        table.push([
            row.format.into(),
            Cell::percent(100.0 * row.differing),
            Cell::percent(100.0 * row.by_rays.bias),
            ran(row.by_sums.map(|error| Cell::percent(100.0 * error.bias))),
            Cell::percent(100.0 * row.transfer),
            ran(row.pictures[0].map(Cell::measured)),
            ran(row.pictures[1].map(Cell::measured)),
        ]);
    }
    found.heading("Errors of each number format");
    found.explained_table(FoundTable::from(table).csv("formats").field("formats"), EXPLAINED);
}

const EXPLAINED: &str = "Each system runs on an unlimited card that computes in the format. rays_differing counts \
    form-factor rays that do not hit the triangle that they hit in exact arithmetic. room_by_rays is the mean error \
    of non-emitting patches with the form factors of these rays; room_by_sums is the same error with the host's form \
    factors and iterations in the format. transfer is the relative root mean square error of the bunny's coefficients \
    by these rays. The last two columns are root mean square errors of the models' pixels against fp32, in steps of \
    1/255.";
