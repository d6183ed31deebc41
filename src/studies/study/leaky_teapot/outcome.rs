//! Parameters and results of the study.

use refsim::machine::Executor;
use serde::Serialize;

use super::cost::IntersectionCost;
use super::format_limits::FormatLimits;
use super::inside::Holes;
use crate::geom::classify::HitVerdict;
use crate::geom::exact::Sides;
use crate::geom::{Mesh, Ray};
use crate::options::number;
use crate::options::sides;
use crate::picture::RgbImage;
use crate::ray_engine::{EdgeRule, RayBatch};
use crate::study::configuration::Configuration;

/// Rays, surface and configurations to trace.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// Name of the surface; `None` for the teapot.
    pub model: Option<String>,
    /// Surface.
    pub mesh: Mesh,
    /// Rays, in the layout of the pictures.
    pub view: RayBatch,
    /// Number of rays, if they are a list instead of a view; the pictures show them row by row, and the rest of `view`
    /// is padding that is not traced.
    pub listed: Option<usize>,
    /// Configurations with the paper's program, one per row.
    pub configurations: Vec<Configuration>,
    /// Configurations with shared edges, one per row, after the others.
    pub shared: Vec<Configuration>,
    /// Executor of the cards.
    pub executor: Executor,
    /// Options.
    pub options: LeakyTeapotOptions,
}

/// Options of the study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::Args)]
pub struct LeakyTeapotOptions {
    /// Rays aimed at each edge that two triangles share, for the second table; 0 leaves the table out.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = number::whole::<u32>(0..=64))]
    pub rays_per_edge: u32,

    /// Sides of faces that can be hit.
    #[arg(long, default_value = "front", value_parser = sides())]
    pub sides: Sides,

    /// Tests every ray against every triangle; otherwise, buckets of 32 x 32 rays are tested against the triangles near
    /// them.
    #[arg(skip)]
    pub all_pairs: bool,
}

impl Parameters {
    /// Lays out a list of rays as rows of an approximately square picture; also returns the number of rays.
    pub fn of_list(rays: &[Ray]) -> (RayBatch, usize) {
        let width = rays.len().isqrt().max(1);
        let width = if width * width < rays.len() { width + 1 } else { width };
        let height = rays.len().div_ceil(width);
        let padded: Vec<Ray> =
            rays.iter().chain(rays.last().into_iter().cycle()).take(width * height).copied().collect();
        (RayBatch::rows(width as u32, padded), rays.len())
    }

    /// Rays to trace.
    pub fn rays(&self) -> &[Ray] {
        let rays = self.view.rays();
        &rays[..self.listed.unwrap_or(rays.len()).min(rays.len())]
    }
}

/// Suffix of the names of rows with shared edges.
pub(super) const SHARED: &str = "-shared-edges";

/// Counts of verdicts over a set of rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// Rays traced.
    pub rays: u64,
    /// Rays that hit in exact arithmetic.
    pub surface: u64,
    /// Hits reported.
    pub hits: u64,
    /// Misses reported where there is a surface.
    pub leaks: u64,
    /// Hits reported where there is no surface.
    pub false_hits: u64,
    /// Hits reported on a triangle that is not the first.
    pub wrong_triangle: u64,
    /// Number of these hits on triangles that touch the correct triangle.
    pub wrong_adjacent: u64,
    /// Largest |t - exact t| where both hit; t counts multiples of the ray's direction.
    pub largest_t_error: f64,
}

impl Tally {
    /// Leaks as a fraction of the rays that hit in exact arithmetic, in [0, 1]; 0 if no ray hits.
    pub fn leak_share(&self) -> f64 {
        if self.surface == 0 { 0.0 } else { self.leaks as f64 / self.surface as f64 }
    }

    pub(super) fn add(&mut self, verdict: HitVerdict, surface: bool, hit: bool, t_error: Option<f64>) {
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

/// Judged hits of one configuration.
#[derive(Clone, Debug)]
pub struct TeapotRow {
    /// Configuration.
    pub configuration: Configuration,
    /// Rule by which the program evaluates edges.
    pub edge_rule: EdgeRule,
    /// Cost of an intersection.
    pub cost: IntersectionCost,
    /// Verdicts of the eye rays.
    pub tally: Tally,
    /// Number of pixels of the shaded picture that differ from the exact one.
    pub pixels_differing: u64,
    /// Shaded picture.
    pub picture: RgbImage,
    /// Verdict per pixel.
    pub verdicts: Vec<HitVerdict>,
    /// Leak map; [`super::PixelVerdict`] defines its colors.
    pub map: RgbImage,
    /// t per pixel; infinite for a miss.
    pub t: Vec<f32>,
    /// Triangle per pixel; `u32::MAX` for a miss.
    pub triangle: Vec<u32>,
    /// Verdicts of rays aimed at shared edges.
    pub edges: Tally,
    /// Verdicts of rays aimed at vertices.
    pub vertices: Tally,
    /// Counts of eye rays, rays aimed at shared edges and rays aimed at vertices that meet the inside of the surface; 0
    /// if the rays have no common origin.
    pub holes: [Holes; 3],
    /// Information lost to the number format.
    pub limits: FormatLimits,
}

/// Hits of all configurations, and the exact ones.
#[derive(Clone, Debug)]
pub struct TeapotOutcome {
    /// Exact picture.
    pub exact_picture: RgbImage,
    /// t per pixel, exact and then rounded once; infinite for a miss.
    pub exact_t: Vec<f32>,
    /// Triangle per pixel (the smallest of a tie); `u32::MAX` for a miss.
    pub exact_triangle: Vec<u32>,
    /// Rows, in the order of the configurations.
    pub rows: Vec<TeapotRow>,
}
