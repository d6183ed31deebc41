//! Accumulation of samples into a picture.

use glam::DVec3;
use rayon::prelude::*;

use super::counting::{CountingCaster, RayCounts, RayKind};
use super::settings::{Lens, Settings};
use super::wave::{PathRay, SampleRng, Shade, follow};
use crate::error::InputError;
use crate::geom::vector::{narrow, unit, wide};
use crate::geom::{Hit, Ray};
use crate::picture::{self, RgbImage};
use crate::scene::{Camera, Scene};

/// Linear radiance of each pixel, rows from the top, with the first hit of the ray through its centre.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderedPicture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Mean of the samples.
    pub color: Vec<[f64; 3]>,
    /// Estimated variance of the mean: the variance of the samples divided by their number; 0 for one sample.
    pub variance: Vec<[f64; 3]>,
    /// First hit of the ray through the centre of the pixel; its t is the depth along the view.
    pub first: Vec<Option<Hit>>,
    /// Samples that were not finite and count as black: 0 for scenes with reasonable parameters.
    pub not_finite: u64,
    /// Number of rays cast, per kind.
    pub counts: RayCounts,
}

impl RenderedPicture {
    /// Tone-maps to 8 bits: color times `exposure` through the sRGB curve, clipped at 1.
    pub fn display(&self, exposure: f64) -> RgbImage {
        let byte = |channel: f64| picture::display::encode(channel * exposure);
        let shown = self.color.iter().map(|color| color.map(byte));
        picture::rgb8(self.width, self.height, shown)
    }
}

/// Sums of samples per pixel.
struct Film {
    sum: Vec<DVec3>,
    squares: Vec<DVec3>,
    not_finite: u64,
}

impl Film {
    fn add(&mut self, pixel: usize, sample: DVec3) {
        if !sample.is_finite() {
            self.not_finite += 1;
            return;
        }
        self.sum[pixel] += sample;
        self.squares[pixel] += sample * sample;
    }
}

/// Renders with a shader. `fan` is the approximate maximum number of simultaneous rays from one eye ray.
pub(super) fn expose(
    tracer: &mut CountingCaster<'_>,
    scene: &Scene,
    camera: &Camera,
    settings: &Settings,
    fan: usize,
    shader: &impl Shade,
) -> Result<RenderedPicture, InputError> {
    settings.checked()?;
    let pixels = camera.width() as usize * camera.height() as usize;
    let samples = u64::from(settings.samples);
    let mut film = Film { sum: vec![DVec3::ZERO; pixels], squares: vec![DVec3::ZERO; pixels], not_finite: 0 };
    // With one sample per pixel and no lens, the picture's rays pass through the pixel centres.
    let middles = settings.samples == 1 && settings.lens.is_none();
    let mut first = if middles { Vec::with_capacity(pixels) } else { through_middles(tracer, camera, settings)? };
    let total = pixels as u64 * samples;
    tracer.begin("samples", total);
    let chunk = (settings.bundle / fan.max(1)).clamp(1, 1 << 24) as u64;
    let mut start = 0;
    while start < total {
        let end = total.min(start + chunk);
        let flights = (start..end).into_par_iter().map(|index| {
            let (pixel, sample) = (index / samples, index % samples);
            let rng = SampleRng::new(settings.seed, pixel, sample);
            PathRay::eye(eye_ray(camera, settings, pixel, rng), (index - start) as u32, rng)
        });
        let wave = follow(tracer, flights.collect(), scene, settings, shader)?;
        for (index, light) in (start..end).zip(wave.light) {
            film.add((index / samples) as usize, light);
        }
        if middles {
            first.extend(wave.first);
        }
        tracer.advance(end - start);
        start = end;
    }
    let (color, variance) = means(&film, settings.samples);
    let (width, height, counts) = (camera.width(), camera.height(), tracer.counts);
    Ok(RenderedPicture { width, height, color, variance, first, not_finite: film.not_finite, counts })
}

fn means(film: &Film, samples: u32) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
    let n = f64::from(samples);
    let of = |(sum, squares): (&DVec3, &DVec3)| {
        let mean = 1.0 / n * *sum;
        // Cancellation can make the difference negative.
        let spread = (*squares - n * (mean * mean)).map(|x| x.max(0.0));
        let variance = if samples > 1 { 1.0 / (n * (n - 1.0)) * spread } else { DVec3::ZERO };
        (mean.to_array(), variance.to_array())
    };
    film.sum.iter().zip(&film.squares).map(of).unzip()
}

/// Returns the first hits of the rays through the centres of the pixels.
fn through_middles(
    tracer: &mut CountingCaster<'_>,
    camera: &Camera,
    settings: &Settings,
) -> Result<Vec<Option<Hit>>, InputError> {
    let pixels = u64::from(camera.width()) * u64::from(camera.height());
    tracer.begin("pixels", pixels);
    let mut hits = Vec::with_capacity(pixels as usize);
    while (hits.len() as u64) < pixels {
        let start = hits.len() as u64;
        let end = pixels.min(start + settings.bundle.clamp(1, 1 << 24) as u64);
        let rays: Vec<Ray> = (start..end).map(|pixel| middle(camera, pixel)).collect();
        hits.extend(tracer.cast(&rays, |_| RayKind::Eye)?);
        if (hits.len() as u64) < end {
            // If the caster returns too few hits, the rest count as misses.
            hits.resize(end as usize, None);
        }
        tracer.advance(end - start);
    }
    Ok(hits)
}

fn middle(camera: &Camera, pixel: u64) -> Ray {
    let width = u64::from(camera.width());
    camera.ray((pixel % width) as u32, (pixel / width) as u32)
}

fn eye_ray(camera: &Camera, settings: &Settings, pixel: u64, rng: SampleRng) -> Ray {
    let centre = middle(camera, pixel);
    if settings.samples == 1 && settings.lens.is_none() {
        return centre;
    }
    let width = u64::from(camera.width());
    let jitter = if settings.samples == 1 { [0.5; 2] } else { [rng.before(0), rng.before(1)] };
    let direction = camera.direction_at((pixel % width) as f64 + jitter[0], (pixel / width) as f64 + jitter[1]);
    let ray = match settings.lens {
        None => Ray::new(camera.eye(), narrow(direction)),
        Some(lens) => through_lens(camera, lens, direction, [rng.before(2), rng.before(3)]),
    };
    // There is no ray if its direction overflows f32.
    ray.unwrap_or(centre)
}

/// Generates a ray from a point of the lens to the point where the pinhole's ray reaches the focal distance.
fn through_lens(camera: &Camera, lens: Lens, direction: DVec3, u: [f64; 2]) -> Result<Ray, InputError> {
    let [x, y] = super::sampling::disk(u);
    let [right, up] = [camera.right(), camera.up()].map(|axis| unit(axis).unwrap_or(axis));
    let eye = wide(camera.eye());
    let start = eye + x * lens.radius * right + y * lens.radius * up;
    let start = narrow(start);
    let sharp = eye + lens.focus * direction;
    // The direction has the pinhole ray's component along the view, so that t stays the depth along the view.
    Ray::new(start, narrow(1.0 / lens.focus * (sharp - wide(start))))
}
