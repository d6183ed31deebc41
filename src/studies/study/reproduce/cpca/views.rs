//! Pictures of transfer, interpolated between vertices on the host.

use glam::DVec3;

use super::signals::ComputedSignal;
use super::{HOST, StudyError, failed};
use crate::geom::vector::wide;
use crate::picture::rgb8;
use crate::report::{NamedPicture, false_color};
use crate::scene::Camera;
use crate::sphere::HarmonicLight;
use crate::study::prt::{FineView, Lit, SeenSurface, auto_exposure, cluster_color, light_picture};
use crate::transfer::clustering::Clustering;

/// Side of the pictures whose differences are measured, in pixels.
const SIDE: u32 = 160;

/// Shades of a group's color, down to about half of it.
const SHADES: u32 = 5;

/// Caption of the light of most figures.
pub(super) const RED_AND_BLUE: &str = "a red and a blue disk at order 5";

/// Cosine between view and normal below which a pixel counts as silhouette.
pub(super) const RIM: f64 = 0.35;

/// Model under a light, seen by a camera. All pictures have the exposure of the one without compression.
pub(super) struct ModelView<'a> {
    computed: &'a ComputedSignal,
    light: &'a HarmonicLight,
    camera: Camera,
    seen: SeenSurface,
    /// View of the pictures that are shown.
    fine: FineView,
    exposure: f64,
}

impl<'a> ModelView<'a> {
    /// Creates the view from an eye towards the center of the model.
    pub(super) fn new(
        computed: &'a ComputedSignal,
        light: &'a HarmonicLight,
        (eye, tan_half_height): ([f32; 3], f32),
    ) -> Result<Self, StudyError> {
        let camera = Camera::new(eye, [0.0; 3], [0.0, 0.0, 1.0], tan_half_height, SIDE, SIDE);
        let camera = camera.map_err(|e| failed(HOST)(&e))?;
        let seen = SeenSurface::new(&computed.mesh, &computed.vertices, &camera);
        let all: Vec<u32> = (0..computed.vertices.len() as u32).collect();
        let model = (&computed.mesh, &computed.vertices);
        let fine = FineView::new(model, eye, (computed.models.picture_side(), &all)).map_err(|e| failed(HOST)(&e))?;
        let mut view = Self { computed, light, camera, seen, fine, exposure: 1.0 };
        view.exposure = auto_exposure(&view.colors(None)?);
        Ok(view)
    }

    /// Picture of a clustering, or of the transfer itself.
    pub(super) fn picture(
        &self,
        clustering: Option<&Clustering>,
        name: String,
        caption: String,
    ) -> Result<NamedPicture, StudyError> {
        self.shown(&self.radiance(clustering)?, name, caption)
    }

    /// Picture of the light, named for a figure.
    pub(super) fn light(&self, figure: &str, caption: &str) -> Result<NamedPicture, StudyError> {
        let radiance = |direction| self.light.radiance(direction);
        light_picture(format!("{figure}-light"), caption, radiance).map_err(|e| failed(HOST)(&e))
    }

    /// Converts radiance of vertices towards the eye to a picture.
    pub(super) fn shown(
        &self,
        radiance: &[[f64; 3]],
        name: String,
        caption: String,
    ) -> Result<NamedPicture, StudyError> {
        let image = self.fine.picture(radiance).display(self.exposure).map_err(|e| failed(HOST)(&e))?;
        Ok(NamedPicture::new(name, image, caption))
    }

    /// Sets the exposure for these colors.
    pub(super) fn expose(&mut self, colors: &[[f64; 3]]) {
        self.exposure = auto_exposure(colors);
    }

    /// Position of the eye.
    pub(super) fn eye(&self) -> DVec3 {
        wide(self.camera.eye())
    }

    /// Interpolates radiance of vertices towards the eye to colors of pixels.
    pub(super) fn of_vertices(&self, radiance: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.seen.colors(radiance, [0.0; 3])
    }

    /// Copies the exposure of another view.
    pub(super) fn exposed_as(mut self, other: &Self) -> Self {
        self.exposure = other.exposure;
        self
    }

    /// Picture of the group of each pixel's nearest vertex, each in a color of its own; where groups are of several
    /// clusters, these are shades of it.
    pub(super) fn groups(
        &self,
        (groups, clusters): (&[u32], &[u32]),
        (name, caption): (String, String),
    ) -> NamedPicture {
        let color = |vertex: u32| {
            let [group, cluster] = [groups, clusters].map(|of_vertex| of_vertex[vertex as usize]);
            let shade = if groups == clusters { 0 } else { cluster % SHADES };
            cluster_color(group).map(|channel| (u32::from(channel) * (2 * SHADES - shade) / (2 * SHADES)) as u8)
        };
        let colors = self.fine.nearest(color);
        NamedPicture::new(name, rgb8(self.fine.side(), self.fine.side(), colors), caption)
    }

    /// Relative difference of a picture from another one of the same model and camera: root mean square of the
    /// difference over that of the other. `wanted` selects pixels by the cosine between view and normal, at the vertex
    /// with the largest weight.
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

    /// Fraction of another picture's light that this one lacks, over all pixels and channels.
    pub(super) fn missing(&self, other: &Self) -> Result<f64, StudyError> {
        let sum = |colors: Vec<[f64; 3]>| colors.iter().flatten().sum::<f64>();
        let (ours, theirs) = (sum(self.colors(None)?), sum(other.colors(None)?));
        Ok(if theirs > 0.0 { 1.0 - ours / theirs } else { 0.0 })
    }

    fn cosine(&self, vertex: usize) -> f64 {
        let vertices = &self.computed.vertices;
        let view = self.eye() - wide(vertices.positions()[vertex]);
        view.normalize_or_zero().dot(vertices.frames()[vertex].normal())
    }

    /// Picture of the error of each vertex, relative to `most`; pale is large.
    pub(super) fn error_map(
        &self,
        clustering: &Clustering,
        most: f64,
        (name, caption): (String, String),
    ) -> NamedPicture {
        let error = |point: usize| (clustering.squared_error_of(point, &self.computed.signal) / most).sqrt();
        let of_vertex: Vec<f64> = (0..self.computed.signal.points()).map(error).collect();
        NamedPicture::new(name, false_color::magnitude(self.fine.side(), &self.fine.values(&of_vertex)), caption)
    }

    /// Colors of pixels by a clustering, or by the transfer itself.
    pub(super) fn colors(&self, clustering: Option<&Clustering>) -> Result<Vec<[f64; 3]>, StudyError> {
        Ok(self.of_vertices(&self.radiance(clustering)?))
    }

    /// Radiance of vertices towards the eye, by a clustering or by the transfer itself.
    fn radiance(&self, clustering: Option<&Clustering>) -> Result<Vec<[f64; 3]>, StudyError> {
        let missing = || failed(HOST)(&"the signal is no transfer");
        let lit = Lit::new(&self.computed.meaning, self.light).ok_or_else(missing)?;
        let exit = clustering.map_or_else(|| lit.of_signal(&self.computed.signal), |c| lit.of_clusters(c));
        Ok(lit.radiance(&exit, &self.computed.vertices, wide(self.camera.eye())))
    }
}
