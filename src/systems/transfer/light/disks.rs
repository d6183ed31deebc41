//! Small sources: disks on the sphere.

use glam::{DMat3, DVec3};

use crate::elementary::sin_cos;
use crate::error::{InputError, ensure, input_error};
use crate::geom::vector::unit;
use crate::io::LightSourceRow;
use crate::sphere::CUBE_FACES;
use crate::transfer::grid::{FINE_SIDE, FineDirections, face_row_column};

/// A disk of constant radiance on the sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiskSource {
    /// Direction to the disk's center, of any length above 0.
    pub towards: DVec3,
    /// Angular radius in radians, above 0 and up to pi.
    pub radius: f64,
    /// Radiance: red, green, blue.
    pub radiance: [f64; 3],
}

/// The largest angle from a fine texel's center to its corner in radians: half a diagonal at the middle of a face.
const TEXEL_RADIUS: f64 = 1.5 / FINE_SIDE as f64;
/// Number of samples along the disk's radius.
const PER_RADIUS: f64 = 8.0;
/// Maximum number of samples along an edge of a fine texel.
const MAX_SAMPLES: usize = 64;

impl From<LightSourceRow> for DiskSource {
    fn from(row: LightSourceRow) -> Self {
        let LightSourceRow { towards, degrees, radiance } = row;
        Self { towards: towards.into(), radius: degrees.to_radians(), radiance }
    }
}

impl DiskSource {
    /// Checks the source, and normalises its direction.
    pub(super) fn checked(&self, number: usize) -> Result<Self, InputError> {
        let towards = unit(self.towards).ok_or_else(|| {
            input_error!("crossbar::prt::light" =>
                "source {number}: expected a direction of finite length above 0, found {}", self.towards)
        })?;
        ensure!(self.radius > 0.0 && self.radius <= std::f64::consts::PI, "crossbar::prt::light" =>
            "source {number}: expected an angular radius above 0 and up to pi radians, found {}", self.radius);
        ensure!(self.radiance.iter().all(|channel| channel.is_finite() && *channel >= 0.0), "crossbar::prt::light" =>
            "source {number}: expected finite radiances of at least 0, found {:?}", self.radiance);
        Ok(Self { towards, ..*self })
    }

    /// The solid angle of the disk: 2 pi (1 - cos radius), without cancellation.
    fn solid_angle(&self) -> f64 {
        let (half, _) = sin_cos(self.radius / 2.0);
        4.0 * std::f64::consts::PI * half * half
    }
}

/// Adds a source to the mean radiances of the fine texels.
pub(super) fn add_disk(source: &DiskSource, rotation: &DMat3, fine: &mut [[f64; 3]]) {
    let towards = *rotation * source.towards;
    // Chords are compared instead of angles: their order is the same, and small chords lose no digits.
    let chord = |angle: f64| 2.0 * sin_cos(angle.min(std::f64::consts::PI) / 2.0).0;
    let (edge, far) = (chord(source.radius), chord(source.radius + TEXEL_RADIUS));
    let near = if source.radius > TEXEL_RADIUS { chord(source.radius - TEXEL_RADIUS) } else { -1.0 };
    let samples =
        ((PER_RADIUS * 2.0 / FINE_SIDE as f64 / source.radius).ceil()).clamp(4.0, MAX_SAMPLES as f64) as usize;
    let directions = FineDirections::get();
    let mut covered: Vec<(usize, f64)> = Vec::new();
    for (at, direction) in directions.directions().iter().enumerate() {
        let distance = direction.distance(towards);
        if distance < near {
            covered.push((at, 1.0));
        } else if distance <= far {
            let share = covered_share(at, samples, |direction| direction.distance(towards) <= edge);
            covered.extend((share > 0.0).then_some((at, share)));
        }
    }
    if covered.is_empty() {
        // A disk that falls between all samples is put wholly into the texel of its center.
        let distance = |at: usize| directions.directions()[at].distance_squared(towards);
        let nearest = (0..fine.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
        covered.extend(nearest.map(|at| (at, 1.0)));
    }
    let found: f64 = covered.iter().map(|&(at, share)| share * directions.solid_angles()[at]).sum();
    let scale = source.solid_angle() / found;
    for (at, share) in covered {
        let share = share * scale;
        fine[at].iter_mut().zip(source.radiance).for_each(|(sum, radiance)| *sum += share * radiance);
    }
}

/// The fraction of a fine texel's solid angle in which a condition holds, on a grid of samples.
fn covered_share(fine: usize, samples: usize, holds: impl Fn(DVec3) -> bool) -> f64 {
    let [face, row, column] = face_row_column(fine, FINE_SIDE);
    let axes = CUBE_FACES[face];
    let along = |at: usize, k: usize| 2.0 * (at as f64 + (k as f64 + 0.5) / samples as f64) / FINE_SIDE as f64 - 1.0;
    let (mut inside, mut whole) = (0.0, 0.0);
    for v in (0..samples).map(|k| along(row, k)) {
        for u in (0..samples).map(|k| along(column, k)) {
            let point = axes.center + u * axes.right + v * axes.down;
            let length = point.length();
            let density = 1.0 / (length * length * length);
            whole += density;
            if holds(point / length) {
                inside += density;
            }
        }
    }
    inside / whole
}
