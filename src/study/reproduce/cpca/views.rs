//! Pictures of transfer, interpolated between vertices on the host.

use super::signals::ComputedSignal;
use super::{HOST, ReproduceError, failed};
use crate::geom::vector::wide;
use crate::prt::cpca::Clustering;
use crate::report::{NamedPicture, false_color};
use crate::scene::Camera;
use crate::sphere::HarmonicLight;
use crate::study::prt::{Lit, Seen, auto_exposure, linear_picture};

/// Pixels along an edge.
const SIDE: u32 = 160;

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
        let picture = linear_picture(&self.camera, &self.colors(clustering)?);
        let image = picture.display(self.exposure).map_err(|e| failed(HOST)(&e))?;
        Ok(NamedPicture::new(name, image, caption))
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

    fn colors(&self, clustering: Option<&Clustering>) -> Result<Vec<[f64; 3]>, ReproduceError> {
        let missing = || failed(HOST)(&"the signal is no transfer");
        let lit = Lit::new(&self.computed.meaning, self.light).ok_or_else(missing)?;
        let exit = clustering.map_or_else(|| lit.of_signal(&self.computed.signal), |c| lit.of_clusters(c));
        let radiance = lit.radiance(&exit, &self.computed.vertices, wide(self.camera.eye()));
        Ok(self.seen.colors(&radiance, [0.0; 3]))
    }
}
