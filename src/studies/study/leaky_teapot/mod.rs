//! The leaky teapot: the number of holes in Figure 4 of the Ray Engine paper, in any number format, against exact
//! arithmetic.
//!
//! The emulated card intersects eye rays with triangles, in buckets or all pairs; the hits are compared with first hits
//! decided exactly on the same f32 inputs. A second test aims rays at edges and corners that triangles share: the
//! paper's equations are evaluated once per neighbour and may disagree. A third test uses shared edges
//! ([`EdgeRule::SharedEdges`]): the card evaluates each edge once.

mod conclusion;
mod cost;
mod format_limits;
mod inside;
mod outcome;
mod pixel_verdict;
mod report;

use std::borrow::Cow;

use inside::Inside;
use outcome::SHARED;
use rayon::prelude::*;

use super::shade::TeapotShader;
use super::{ProgressFn, Study};
use crate::geom::Hit;
use crate::geom::aimed::{Aimed, aimed_at_edges, aimed_at_vertices};
use crate::geom::classify::{HitVerdict, classify, t_error};
use crate::geom::exact::{NearestHit, Sides, Tracer};
use crate::geom::{Mesh, Ray};
use crate::picture::rgb8;
use crate::ray_engine::{Crossbar, EdgeRule, EngineError};
use crate::report::{Findings, Provenance};
use crate::study::StudyError;
use crate::study::configuration::Configuration;
use crate::study::error::library_errors;

/// Seed of the points on the edges.
const SEED: u64 = 1;

pub use cost::IntersectionCost;
pub use format_limits::FormatLimits;
pub use inside::Holes;
pub use outcome::{LeakyTeapotOptions, Parameters, Tally, TeapotOutcome, TeapotRow};
pub use pixel_verdict::PixelVerdict;

library_errors! {
    EngineError;
}

/// Rays with their exact hits.
pub(super) struct JudgedRays {
    rays: Vec<Ray>,
    pub(super) nearest: Vec<Option<NearestHit>>,
}

impl JudgedRays {
    pub(super) fn new(tracer: &Tracer<'_>, rays: Vec<Ray>, sides: Sides) -> Self {
        let nearest = tracer.nearest_all(&rays, sides);
        Self { rays, nearest }
    }

    /// Judges each ray's hit, and counts the verdicts.
    pub(super) fn judge(&self, mesh: &Mesh, hits: &[Option<Hit>]) -> (Vec<HitVerdict>, Tally) {
        let judge = |(hit, nearest): (&Option<Hit>, &Option<NearestHit>)| {
            let error = hit.as_ref().zip(nearest.as_ref()).map(|(hit, nearest)| t_error(&nearest.t, hit.t));
            (classify(mesh, nearest.as_ref(), *hit), error)
        };
        let judgements: Vec<_> = hits.par_iter().zip(&self.nearest).map(judge).collect();
        let mut tally = Tally::default();
        for ((&(verdict, error), nearest), hit) in judgements.iter().zip(&self.nearest).zip(hits) {
            tally.add(verdict, nearest.is_some(), hit.is_some(), error);
        }
        (judgements.into_iter().map(|(verdict, _)| verdict).collect(), tally)
    }

    /// Verdicts of the leak map.
    pub(super) fn pixels<'a>(&'a self, verdicts: &'a [HitVerdict]) -> impl Iterator<Item = PixelVerdict> + Clone + 'a {
        verdicts.iter().zip(&self.nearest).map(|(verdict, nearest)| PixelVerdict::of(*verdict, nearest.is_some()))
    }
}

impl Parameters {
    /// The rows: each configuration with its edge rule.
    fn cases(&self) -> impl Iterator<Item = (Cow<'_, Configuration>, EdgeRule)> {
        let shared = |configuration: &Configuration| {
            let label = format!("{}{SHARED}", configuration.label);
            (Cow::Owned(Configuration { label, ..configuration.clone() }), EdgeRule::SharedEdges)
        };
        let paper = self.configurations.iter().map(|configuration| (Cow::Borrowed(configuration), EdgeRule::Paper));
        paper.chain(self.shared.iter().map(shared))
    }
}

/// Hits of a configuration: of listed or camera rays, of rays aimed at edges, and of rays aimed at vertices.
type ConfigurationHits = [Vec<Option<Hit>>; 3];

/// Rays aimed at edges and at vertices. Empty if the rays have no common origin, or none are requested.
fn aimed(parameters: &Parameters) -> [Vec<Ray>; 2] {
    let eye = parameters.view.common_origin().filter(|_| parameters.options.rays_per_edge > 0);
    let rays = |aimed: Vec<Aimed>| aimed.into_iter().map(|aimed| aimed.ray).collect();
    let (mesh, count) = (&parameters.mesh, parameters.options.rays_per_edge);
    let edges = eye.map(|eye| rays(aimed_at_edges(mesh, eye, count, SEED)));
    let vertices = eye.map(|eye| rays(aimed_at_vertices(mesh, eye)));
    [edges, vertices].map(Option::unwrap_or_default)
}

/// Traces all rays with a configuration's card.
fn hits(
    parameters: &Parameters,
    crossbar: &Crossbar,
    [edges, vertices]: [&[Ray]; 2],
) -> Result<ConfigurationHits, EngineError> {
    let Parameters { mesh, options: LeakyTeapotOptions { sides, .. }, .. } = parameters;
    let list = |rays: &[Ray]| match rays {
        [] => Ok(Vec::new()),
        rays => crossbar.intersect_list(mesh, rays, *sides),
    };
    let view = match parameters.listed {
        None => crossbar.intersect(mesh, &parameters.view, *sides)?.hits,
        Some(_) => list(parameters.rays())?,
    };
    Ok([view, list(edges)?, list(vertices)?])
}

/// Traces all configurations. `progress` is called with the label of each before it starts. Fails if a configuration
/// has no intersection program, or the card refuses the work.
pub fn run(parameters: &Parameters, progress: &mut ProgressFn<'_>) -> Result<TeapotOutcome, EngineError> {
    let [edges, vertices] = aimed(parameters);
    let steps = parameters.cases().count() as u64 + 1;
    let found = (0..).zip(parameters.cases()).map(|(done, (configuration, edge_rule))| {
        progress(&configuration.label, done, steps);
        hits(parameters, &crossbar(parameters, &configuration, edge_rule), [&edges, &vertices])
    });
    let found = found.collect::<Result<_, _>>()?;
    judged(parameters, [edges, vertices], found, progress)
}

/// The card of a configuration.
fn crossbar(parameters: &Parameters, configuration: &Configuration, edges: EdgeRule) -> Crossbar {
    Crossbar::new(configuration.profile.clone(), parameters.executor.clone())
        .all_pairs(parameters.options.all_pairs)
        .edges(edges)
}

/// Compares the hits of all configurations with exact hits.
fn judged(
    parameters: &Parameters,
    aimed: [Vec<Ray>; 2],
    found: Vec<ConfigurationHits>,
    progress: &mut ProgressFn<'_>,
) -> Result<TeapotOutcome, EngineError> {
    let Parameters { mesh, options: LeakyTeapotOptions { sides, .. }, .. } = parameters;
    let (width, height) = (parameters.view.width(), parameters.view.height());
    let steps = parameters.cases().count() as u64;
    progress("exact arithmetic", steps, steps + 1);
    let tracer = Tracer::new(mesh);
    let [edges, vertices] = aimed;
    let rays = [parameters.rays().to_vec(), edges, vertices].map(|rays| JudgedRays::new(&tracer, rays, *sides));
    let view = &rays[0];

    let shader = TeapotShader::new(mesh);
    let pixels = parameters.view.rays().len();
    let mut exact: Vec<Option<u32>> = view.nearest.iter().map(|t| t.as_ref().map(|h| h.triangle)).collect();
    exact.resize(pixels, None);
    let exact_picture = shader.picture(&parameters.view, &exact);
    let mut rows = Vec::new();
    let one_origin = parameters.view.common_origin().is_some();
    let inside = parameters.view.common_origin().map(|eye| Inside::new(mesh, eye));
    for ((configuration, edge_rule), found) in parameters.cases().zip(found) {
        let bits_left = crossbar(parameters, &configuration, edge_rule).bits_left(mesh, &view.rays, *sides)?;
        let limits = FormatLimits::new(bits_left, &found[0]);
        let judge = |kind: usize| {
            let (verdicts, tally) = rays[kind].judge(mesh, &found[kind]);
            let holes = inside.as_ref().map(|inside| inside.holes(&rays[kind].nearest, &verdicts)).unwrap_or_default();
            (verdicts, tally, holes)
        };
        let [(mut verdicts, tally, eye_holes), (_, edges, edge_holes), (_, vertices, vertex_holes)] =
            [0, 1, 2].map(judge);
        let [mut hits, ..] = found;
        hits.resize(pixels, None);
        verdicts.resize(pixels, HitVerdict::Right);
        let triangles: Vec<Option<u32>> = hits.iter().map(|h| h.map(|h| h.triangle)).collect();
        let picture = shader.picture(&parameters.view, &triangles);
        let colors = verdicts.iter().zip(&exact).map(|(v, e)| PixelVerdict::of(*v, e.is_some()).color());
        rows.push(TeapotRow {
            cost: IntersectionCost::of(&configuration.profile, one_origin, *sides, edge_rule)?,
            edge_rule,
            holes: [eye_holes, edge_holes, vertex_holes],
            configuration: configuration.into_owned(),
            tally,
            pixels_differing: picture.pixels().zip(exact_picture.pixels()).filter(|(a, b)| a != b).count() as u64,
            map: rgb8(width, height, colors),
            verdicts,
            picture,
            t: hits.iter().map(|h| h.map_or(f32::INFINITY, |h| h.t)).collect(),
            triangle: triangles.iter().map(|t| t.unwrap_or(u32::MAX)).collect(),
            edges,
            vertices,
            limits,
        });
    }
    let mut exact_t: Vec<f32> =
        view.nearest.iter().map(|t| t.as_ref().map_or(f32::INFINITY, |h| h.t.to_f32())).collect();
    exact_t.resize(pixels, f32::INFINITY);
    let exact_triangle = exact.iter().map(|t| t.unwrap_or(u32::MAX)).collect();
    Ok(TeapotOutcome { exact_picture, exact_t, exact_triangle, rows })
}

impl Study for Parameters {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        Ok(report::findings(self, run(self, progress)?)?)
    }

    fn provenance(&self, mut provenance: Provenance) -> Provenance {
        provenance.seed = Some(SEED);
        for configuration in self.configurations.iter().chain(&self.shared) {
            if !provenance.profiles.contains(&configuration.profile.name) {
                provenance.profiles.push(configuration.profile.name.clone());
            }
            provenance.switches.extend(configuration.switch.clone());
        }
        provenance
    }
}
