//! Pictures of transfer for comparisons, interpolated between vertices on the host.

use glam::DVec3;

use super::signals::ComputedSignal;
use super::{HOST, RunResult, StudyError};
use crate::clustering::Clustering;
use crate::geom::vector::wide;
use crate::scene::Camera;
use crate::sphere::HarmonicLight;
use crate::study::prt::{Lit, SeenSurface};

/// Side of the pictures, in pixels.
const SIDE: u32 = 160;

/// Position of the eye, and the tangent of half the field of view.
const EYE: ([f32; 3], f32) = ([4.0, -3.0, 1.5], 0.3);

/// Cosine between view and normal below which a pixel counts as part of the silhouette.
pub(super) const RIM: f64 = 0.35;

/// Model under a light, seen by a camera.
pub(super) struct ModelView<'a> {
    computed: &'a ComputedSignal,
    light: &'a HarmonicLight,
    camera: Camera,
    seen: SeenSurface,
}

impl<'a> ModelView<'a> {
    pub(super) fn new(computed: &'a ComputedSignal, light: &'a HarmonicLight) -> Result<Self, StudyError> {
        let (eye, tan_half_height) = EYE;
        let camera = Camera::new(eye, [0.0; 3], [0.0, 0.0, 1.0], tan_half_height, SIDE, SIDE);
        let camera = camera.on(HOST)?;
        let seen = SeenSurface::new(&computed.mesh, &computed.vertices, &camera);
        Ok(Self { computed, light, camera, seen })
    }

    pub(super) fn eye(&self) -> DVec3 {
        wide(self.camera.eye())
    }

    /// Interpolates radiance of vertices towards the eye to colors of pixels.
    pub(super) fn of_vertices(&self, radiance: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.seen.colors(radiance, [0.0; 3])
    }

    /// Difference of a picture from another picture with the same model and camera: RMS of the difference, relative to
    /// the RMS of the other picture. `wanted` selects pixels by the cosine between view and normal at the vertex with
    /// the largest weight.
    pub(super) fn difference(
        &self,
        clustering: Option<&Clustering>,
        other: &[[f64; 3]],
        wanted: impl Fn(f64) -> bool,
    ) -> Result<f64, StudyError> {
        let (mut apart, mut whole) = (0.0, 0.0);
        for ((vertex, ours), theirs) in self.seen.nearest().zip(self.colors(clustering)?).zip(other) {
            if vertex.is_some_and(|vertex| wanted(self.cosine(vertex as usize))) {
                let apart_by = |channel: usize| ours[channel] - theirs[channel];
                apart += (0..3).map(|channel| apart_by(channel) * apart_by(channel)).sum::<f64>();
                whole += theirs.iter().map(|value| value * value).sum::<f64>();
            }
        }
        Ok(if whole > 0.0 { (apart / whole).sqrt() } else { 0.0 })
    }

    /// Fraction of another picture's light that this picture lacks, over all pixels and channels.
    pub(super) fn missing(&self, other: &Self) -> Result<f64, StudyError> {
        let sum = |colors: Vec<[f64; 3]>| colors.iter().flatten().sum::<f64>();
        let (ours, theirs) = (sum(self.colors(None)?), sum(other.colors(None)?));
        Ok(if theirs > 0.0 { 1.0 - ours / theirs } else { 0.0 })
    }

    /// Colors of pixels from a clustering, or from the transfer itself.
    pub(super) fn colors(&self, clustering: Option<&Clustering>) -> Result<Vec<[f64; 3]>, StudyError> {
        let lit = Lit::new(&self.computed.meaning, self.light).ok_or("the signal is not transfer").on(HOST)?;
        let exit = clustering.map_or_else(|| lit.of_signal(&self.computed.signal), |c| lit.of_clusters(c));
        Ok(self.of_vertices(&lit.radiance(&exit, &self.computed.vertices, self.eye())))
    }

    fn cosine(&self, vertex: usize) -> f64 {
        let vertices = &self.computed.vertices;
        let view = self.eye() - wide(vertices.positions()[vertex]);
        view.normalize_or_zero().dot(vertices.frames()[vertex].normal())
    }
}
