//! Pictures of transfer, interpolated between vertices on the host.

use glam::DVec3;

use super::signals::ComputedSignal;
use super::{HOST, ReproduceError, failed};
use crate::geom::vector::wide;
use crate::picture::rgb8;
use crate::report::{NamedPicture, false_color};
use crate::scene::Camera;
use crate::sphere::HarmonicLight;
use crate::study::prt::{Lit, Seen, auto_exposure, cluster_color, linear_picture};
use crate::transfer::clustering::Clustering;

/// Pixels along an edge.
const SIDE: u32 = 160;

/// Below this cosine between view and normal a pixel counts as silhouette.
pub(super) const RIM: f64 = 0.35;

/// A model under a light, seen by a camera. All pictures are exposed as the one without compression is.
pub(super) struct ModelView<'a> {
    computed: &'a ComputedSignal,
    light: &'a HarmonicLight,
    camera: Camera,
    seen: Seen,
    exposure: f64,
}

impl<'a> ModelView<'a> {
    /// From an eye towards the middle of the model.
    pub(super) fn new(
        computed: &'a ComputedSignal,
        light: &'a HarmonicLight,
        (eye, tan_half_height): ([f32; 3], f32),
    ) -> Result<Self, ReproduceError> {
        let camera = Camera::new(eye, [0.0; 3], [0.0, 0.0, 1.0], tan_half_height, SIDE, SIDE);
        let camera = camera.map_err(|e| failed(HOST)(&e))?;
        let seen = Seen::new(&computed.mesh, &computed.vertices, &camera);
        let mut view = Self { computed, light, camera, seen, exposure: 1.0 };
        view.exposure = auto_exposure(&view.colors(None)?);
        Ok(view)
    }

    /// A picture of a clustering, or of the transfer itself.
    pub(super) fn picture(
        &self,
        clustering: Option<&Clustering>,
        name: String,
        caption: String,
    ) -> Result<NamedPicture, ReproduceError> {
        self.shown(&self.colors(clustering)?, name, caption)
    }

    /// Colors of pixels as a picture.
    pub(super) fn shown(
        &self,
        colors: &[[f64; 3]],
        name: String,
        caption: String,
    ) -> Result<NamedPicture, ReproduceError> {
        let image = linear_picture(&self.camera, colors).display(self.exposure).map_err(|e| failed(HOST)(&e))?;
        Ok(NamedPicture::new(name, image, caption))
    }

    /// Exposes pictures so that these colors are well exposed.
    pub(super) fn expose(&mut self, colors: &[[f64; 3]]) {
        self.exposure = auto_exposure(colors);
    }

    /// Where the camera stands.
    pub(super) fn eye(&self) -> DVec3 {
        wide(self.camera.eye())
    }

    /// Colors of pixels from radiance of vertices towards the eye.
    pub(super) fn of_vertices(&self, radiance: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.seen.colors(radiance, [0.0; 3])
    }

    /// Exposes pictures as those of another view are.
    pub(super) fn exposed_as(mut self, other: &Self) -> Self {
        self.exposure = other.exposure;
        self
    }

    /// The group of each pixel's nearest vertex, each in a color of its own.
    pub(super) fn groups(&self, of_vertex: &[u32], (name, caption): (String, String)) -> NamedPicture {
        let color = |vertex: Option<u32>| vertex.map_or([0; 3], |vertex| cluster_color(of_vertex[vertex as usize]));
        NamedPicture::new(name, rgb8(SIDE, SIDE, self.seen.nearest().map(color)), caption)
    }

    /// How far a picture is off another one of the same model and camera: the root mean square of their difference
    /// over that of the other. `wanted` chooses pixels by the cosine between view and normal, at the vertex that weighs
    /// most.
    pub(super) fn difference(
        &self,
        clustering: Option<&Clustering>,
        other: &[[f64; 3]],
        wanted: impl Fn(f64) -> bool,
    ) -> Result<f64, ReproduceError> {
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

    /// The share of another picture's light that this one lacks, over all pixels and channels.
    pub(super) fn missing(&self, other: &Self) -> Result<f64, ReproduceError> {
        let sum = |colors: Vec<[f64; 3]>| colors.iter().flatten().sum::<f64>();
        let (ours, theirs) = (sum(self.colors(None)?), sum(other.colors(None)?));
        Ok(if theirs > 0.0 { 1.0 - ours / theirs } else { 0.0 })
    }

    fn cosine(&self, vertex: usize) -> f64 {
        let vertices = &self.computed.vertices;
        let view = self.eye() - wide(vertices.positions()[vertex]);
        view.normalize_or_zero().dot(vertices.frames()[vertex].normal())
    }

    /// The error of each vertex, as a share of `most`; pale is large.
    pub(super) fn error_map(
        &self,
        clustering: &Clustering,
        most: f64,
        (name, caption): (String, String),
    ) -> NamedPicture {
        let error = |point: usize| [(clustering.squared_error_of(point, &self.computed.signal) / most).sqrt(); 3];
        let of_vertex: Vec<[f64; 3]> = (0..self.computed.signal.points()).map(error).collect();
        let map: Vec<f64> = self.seen.colors(&of_vertex, [f64::NAN; 3]).into_iter().map(|[value, ..]| value).collect();
        NamedPicture::new(name, false_color::magnitude(SIDE, &map), caption)
    }

    /// Colors of pixels of a clustering, or of the transfer itself.
    pub(super) fn colors(&self, clustering: Option<&Clustering>) -> Result<Vec<[f64; 3]>, ReproduceError> {
        let missing = || failed(HOST)(&"the signal is no transfer");
        let lit = Lit::new(&self.computed.meaning, self.light).ok_or_else(missing)?;
        let exit = clustering.map_or_else(|| lit.of_signal(&self.computed.signal), |c| lit.of_clusters(c));
        let radiance = lit.radiance(&exit, &self.computed.vertices, wide(self.camera.eye()));
        Ok(self.seen.colors(&radiance, [0.0; 3]))
    }
}
