//! How many holes does the teapot get? Figure 4 of the Ray Engine paper, in any number format, against exact arithmetic.
//!
//! The eye rays meet the triangles on the emulated card, in buckets or all pairs; what comes back is judged against first hits that are
//! decided exactly on the same f32 inputs. A second question aims rays at the edges and corners that triangles share,
//! where the paper's equations are evaluated once for each neighbour and need not agree.

use rayon::prelude::*;
use refsim::machine::Executor;
use serde::Serialize;

use super::configuration::Configuration;
use super::shade::Shader;
use crate::geom::Hit;
use crate::geom::aimed::{Aimed, aimed_at_edges, aimed_at_vertices};
use crate::geom::classify::{Candidate, HitVerdict, classify};
use crate::geom::exact::{NearestHit, Sides, Tracer};
use crate::geom::{Mesh, Ray};
use crate::ray_engine::{Crossbar, EngineError, RayBatch};

/// What is asked.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// The surface.
    pub mesh: Mesh,
    /// The eye rays: what the pictures show.
    pub view: RayBatch,
    /// Which faces count.
    pub sides: Sides,
    /// The rows.
    pub configurations: Vec<Configuration>,
    /// Rays aimed at every shared edge; 0 leaves the second table out.
    pub rays_per_edge: u32,
    /// Seed of the points on the edges.
    pub seed: u64,
    /// Who computes.
    pub executor: Executor,
    /// Whether every ray meets every triangle, or only those near its bucket.
    pub all_pairs: bool,
}

/// Counts of verdicts over a set of rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// Rays asked.
    pub rays: u64,
    /// Rays that truly hit.
    pub surface: u64,
    /// Hits reported.
    pub hits: u64,
    /// No hit reported where the surface is.
    pub leaks: u64,
    /// A hit reported where no surface is.
    pub false_hits: u64,
    /// Another triangle reported than the first one.
    pub wrong_triangle: u64,
    /// Of these, triangles that touch the right one.
    pub wrong_adjacent: u64,
    /// The largest |t - exact t| where both hit, in multiples of the ray's direction.
    pub largest_t_error: f64,
}

impl Tally {
    /// Leaks as a share of the rays that truly hit; 0 if none does.
    pub fn leak_share(&self) -> f64 {
        if self.surface == 0 { 0.0 } else { self.leaks as f64 / self.surface as f64 }
    }

    fn add(&mut self, verdict: HitVerdict, surface: bool, hit: bool, t_error: Option<f64>) {
        self.rays += 1;
        self.surface += u64::from(surface);
        self.hits += u64::from(hit);
        match verdict {
            HitVerdict::Right => {}
            HitVerdict::Leak => self.leaks += 1,
            HitVerdict::FalseHit => self.false_hits += 1,
            HitVerdict::WrongTriangle { adjacent } => {
                self.wrong_triangle += 1;
                self.wrong_adjacent += u64::from(adjacent);
            }
        }
        if let Some(error) = t_error {
            self.largest_t_error = self.largest_t_error.max(error);
        }
    }
}

/// One configuration's answer.
#[derive(Clone, Debug)]
pub struct Row {
    /// Who answered.
    pub configuration: Configuration,
    /// The program that ran.
    pub kernel: &'static str,
    /// The eye rays' verdicts.
    pub tally: Tally,
    /// Pixels of the shaded picture that differ from the exact one.
    pub pixels_differing: u64,
    /// The shaded picture: RGB bytes, row by row.
    pub picture: Vec<u8>,
    /// The leak map: RGB bytes, row by row; [`verdict_colour`] explains it.
    pub map: Vec<u8>,
    /// t a pixel; infinite where nothing was hit.
    pub t: Vec<f32>,
    /// The triangle a pixel; `u32::MAX` where nothing was hit.
    pub triangle: Vec<u32>,
    /// Rays aimed at shared edges.
    pub edges: Tally,
    /// Rays aimed at vertices.
    pub vertices: Tally,
}

/// Everything that the study found.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The exact picture: RGB bytes, row by row.
    pub exact_picture: Vec<u8>,
    /// t a pixel, exact and then rounded once; infinite where nothing is.
    pub exact_t: Vec<f32>,
    /// The triangle a pixel (the smallest of a tie); `u32::MAX` where nothing is.
    pub exact_triangle: Vec<u32>,
    /// The rows, in the order of the configurations.
    pub rows: Vec<Row>,
}

/// Rays with the truth about them.
struct Judged {
    rays: Vec<Ray>,
    truth: Vec<Option<NearestHit>>,
}

impl Judged {
    fn new(tracer: &Tracer<'_>, rays: Vec<Ray>, sides: Sides) -> Self {
        let truth = tracer.nearest_all(&rays, sides);
        Self { rays, truth }
    }

    /// The verdicts on an answer, a ray each, and their tally.
    fn judge(&self, mesh: &Mesh, hits: &[Option<Hit>]) -> (Vec<HitVerdict>, Tally) {
        let judge = |(hit, truth): (&Option<Hit>, &Option<NearestHit>)| {
            let none = Candidate { triangle: None, t: 0.0 };
            let candidate = hit.map_or(none, |h| Candidate { triangle: Some(h.triangle), t: h.t });
            classify(mesh, truth.as_ref(), candidate)
        };
        let judgements: Vec<_> = hits.par_iter().zip(&self.truth).map(judge).collect();
        let mut tally = Tally::default();
        for ((judgement, truth), hit) in judgements.iter().zip(&self.truth).zip(hits) {
            let error = judgement.t_error.map(|e| e.absolute);
            tally.add(judgement.verdict, truth.is_some(), hit.is_some(), error);
        }
        (judgements.into_iter().map(|j| j.verdict).collect(), tally)
    }
}

/// Runs the study. `progress` hears the label of each configuration before it starts.
///
/// # Errors
/// If a configuration has no intersection program, or the card refuses the work.
pub fn run(parameters: &Parameters, progress: &dyn Fn(&str)) -> Result<Outcome, EngineError> {
    let Parameters { mesh, sides, .. } = parameters;
    progress("exact arithmetic");
    let tracer = Tracer::new(mesh);
    let view = Judged::new(&tracer, parameters.view.rays().to_vec(), *sides);
    let eye = parameters.view.common_origin().filter(|_| parameters.rays_per_edge > 0);
    let aim = |aimed: Vec<Aimed>| Judged::new(&tracer, aimed.into_iter().map(|a| a.ray).collect(), *sides);
    let edges = eye.map(|eye| aim(aimed_at_edges(mesh, eye, parameters.rays_per_edge, parameters.seed)));
    let vertices = eye.map(|eye| aim(aimed_at_vertices(mesh, eye)));

    let shader = Shader::new(mesh);
    let exact: Vec<Option<u32>> = view.truth.iter().map(|t| t.as_ref().map(|h| h.triangle)).collect();
    let exact_picture = shader.picture(&parameters.view, &exact);
    let mut rows = Vec::new();
    for configuration in &parameters.configurations {
        progress(&configuration.label);
        let crossbar =
            Crossbar::new(configuration.profile.clone(), parameters.executor.clone()).all_pairs(parameters.all_pairs);
        let answer = crossbar.intersect(mesh, &parameters.view, *sides)?;
        let (verdicts, tally) = view.judge(mesh, &answer.hits);
        let triangles: Vec<Option<u32>> = answer.hits.iter().map(|h| h.map(|h| h.triangle)).collect();
        let picture = shader.picture(&parameters.view, &triangles);
        let aimed = |judged: &Option<Judged>| -> Result<Tally, EngineError> {
            let Some(judged) = judged else { return Ok(Tally::default()) };
            Ok(judged.judge(mesh, &crossbar.intersect_list(mesh, &judged.rays, *sides)?).1)
        };
        rows.push(Row {
            configuration: configuration.clone(),
            kernel: answer.kernel,
            tally,
            pixels_differing: pixels_differing(&picture, &exact_picture),
            map: verdicts.iter().zip(&exact).flat_map(|(v, e)| verdict_colour(*v, e.is_some())).collect(),
            picture,
            t: answer.hits.iter().map(|h| h.map_or(f32::INFINITY, |h| h.t)).collect(),
            triangle: triangles.iter().map(|t| t.unwrap_or(u32::MAX)).collect(),
            edges: aimed(&edges)?,
            vertices: aimed(&vertices)?,
        });
    }
    Ok(Outcome {
        exact_picture,
        exact_t: view.truth.iter().map(|t| t.as_ref().map_or(f32::INFINITY, |h| h.t.to_f32())).collect(),
        exact_triangle: exact.iter().map(|t| t.unwrap_or(u32::MAX)).collect(),
        rows,
    })
}

fn pixels_differing(a: &[u8], b: &[u8]) -> u64 {
    a.chunks_exact(3).zip(b.chunks_exact(3)).filter(|(x, y)| x != y).count() as u64
}

/// The leak map's colours: red for a leak, blue for a false hit, yellow and orange for a wrong triangle that touches the
/// right one or does not, grey where the surface is right, black where nothing is.
pub const fn verdict_colour(verdict: HitVerdict, surface: bool) -> [u8; 3] {
    match verdict {
        HitVerdict::Right if surface => [120, 124, 130],
        HitVerdict::Right => [16, 18, 22],
        HitVerdict::Leak => [235, 40, 40],
        HitVerdict::FalseHit => [60, 110, 255],
        HitVerdict::WrongTriangle { adjacent: true } => [240, 205, 70],
        HitVerdict::WrongTriangle { adjacent: false } => [245, 130, 30],
    }
}
