//! What is traced, and what came of it.

use refsim::machine::Executor;
use serde::Serialize;

use super::format_limits::FormatLimits;
use crate::geom::classify::HitVerdict;
use crate::geom::exact::Sides;
use crate::geom::{Mesh, Ray};
use crate::picture::RgbImage;
use crate::ray_engine::RayBatch;
use crate::study::configuration::Configuration;

/// What to trace, and in which configurations.
#[derive(Clone, Debug)]
pub struct Parameters {
    /// What the surface is called; `None` for the teapot.
    pub model: Option<String>,
    /// The surface.
    pub mesh: Mesh,
    /// The rays: what the pictures show.
    pub view: RayBatch,
    /// Of rays that are a list and no view, how many there are; the pictures show them row by row, and the rest of
    /// `view` fills the last row and is not asked.
    pub listed: Option<usize>,
    /// Which faces count.
    pub sides: Sides,
    /// The rows.
    pub configurations: Vec<Configuration>,
    /// Rays aimed at every shared edge; 0 leaves the second table out.
    pub rays_per_edge: u32,
    /// Seed of the points on the edges.
    pub seed: u64,
    /// The executor of the cards.
    pub executor: Executor,
    /// Whether every ray meets every triangle, or only those near its bucket.
    pub all_pairs: bool,
}

impl Parameters {
    /// A list of rays as rows of a picture that is about square, and how many there are.
    pub fn of_list(rays: &[Ray]) -> (RayBatch, usize) {
        let width = rays.len().isqrt().max(1);
        let width = if width * width < rays.len() { width + 1 } else { width };
        let height = rays.len().div_ceil(width);
        let padded: Vec<Ray> =
            rays.iter().chain(rays.last().into_iter().cycle()).take(width * height).copied().collect();
        (RayBatch::rows(width as u32, padded), rays.len())
    }

    /// The rays that are asked.
    pub fn rays(&self) -> &[Ray] {
        let rays = self.view.rays();
        &rays[..self.listed.unwrap_or(rays.len()).min(rays.len())]
    }
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

/// One configuration's hits, judged.
#[derive(Clone, Debug)]
pub struct TeapotRow {
    /// The configuration.
    pub configuration: Configuration,
    /// The eye rays' verdicts.
    pub tally: Tally,
    /// Pixels of the shaded picture that differ from the exact one.
    pub pixels_differing: u64,
    /// The shaded picture.
    pub picture: RgbImage,
    /// The verdict per pixel.
    pub verdicts: Vec<HitVerdict>,
    /// The leak map; [`super::PixelVerdict`] explains it.
    pub map: RgbImage,
    /// t per pixel; infinite where nothing was hit.
    pub t: Vec<f32>,
    /// The triangle per pixel; `u32::MAX` where nothing was hit.
    pub triangle: Vec<u32>,
    /// Rays aimed at shared edges.
    pub edges: Tally,
    /// Rays aimed at vertices.
    pub vertices: Tally,
    /// What the number format leaves.
    pub limits: FormatLimits,
}

/// Every configuration's hits, and the exact ones.
#[derive(Clone, Debug)]
pub struct TeapotOutcome {
    /// The exact picture.
    pub exact_picture: RgbImage,
    /// t per pixel, exact and then rounded once; infinite where nothing is.
    pub exact_t: Vec<f32>,
    /// The triangle per pixel (the smallest of a tie); `u32::MAX` where nothing is.
    pub exact_triangle: Vec<u32>,
    /// The rows, in the order of the configurations.
    pub rows: Vec<TeapotRow>,
}
