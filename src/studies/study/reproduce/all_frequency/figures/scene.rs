//! Model on a ground, and differences of its pictures.

use glam::{DMat3, DVec3};

use super::{HOST, ModelSize, StudyError, failed};
use crate::geom::Mesh;
use crate::geom::exact::Sides;
use crate::picture::metrics::{ScreenPicture, flip};
use crate::report::NamedPicture;
use crate::scene::Camera;
use crate::scene::built::ground::on_ground;
use crate::sphere::{function_count, harmonics};
use crate::study::prt::{FineView, SeenSurface, auto_exposure, linear_picture};
use crate::study::reproduce::sky::HARD_SUN;
use crate::tracer::HostTracer;
use crate::transfer::grid::LIGHT_MAP;
use crate::transfer::light::{CubeLight, Decimation, DistantLight};
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::VisibilityMaps;
use crate::transfer::{Tangents, Vertices};

/// Side of the pictures whose differences are measured, in pixels.
const SIDE: u32 = 160;
/// Pixels per degree of the observer, FLIP's usual value.
const PIXELS_PER_DEGREE: f64 = 67.0;

/// Model on a ground: vertices of the model first.
pub(super) struct FigureScene {
    pub(super) vertices: Vertices,
    /// Visibility at the vertices of the model.
    pub(super) of_model: VisibilityMaps,
    /// Visibility at the vertices of the ground.
    pub(super) of_ground: VisibilityMaps,
    pub(super) hats: LinearBasis,
    camera: Camera,
    seen: SeenSurface,
    /// View of the pictures that are shown.
    pub(super) fine: FineView,
}

/// Difference of a picture from the exact one.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PictureDifference {
    /// Root mean square of the pixels' differences, relative to that of the picture.
    pub(super) rms: f64,
    /// Mean FLIP, with the same exposure of both.
    pub(super) flip: f64,
}

impl FigureScene {
    /// Creates the scene, seen from an eye in units of the model's size, relative to its center. The model fills the
    /// pictures that are shown, of the size that goes with that of the models.
    pub(super) fn new(model: &Mesh, ground: u32, eye: DVec3, models: ModelSize) -> Result<Self, StudyError> {
        let problem = |reason: &dyn std::fmt::Display| failed(HOST)(reason);
        let (mesh, materials) = on_ground(model, ground).map_err(|e| problem(&e))?;
        let vertices =
            Vertices::with_materials(&mesh, &materials, Tangents::Along(DVec3::Z)).map_err(|e| problem(&e))?;
        let is_ground = |&vertex: &u32| vertices.materials()[vertex as usize] == 1;
        let (ground, own): (Vec<u32>, Vec<u32>) = (0..vertices.len() as u32).partition(is_ground);
        let mut tracer = HostTracer::new(&mesh, Sides::Both);
        let mut maps = |of: &[u32]| VisibilityMaps::trace(&vertices, of, &mut tracer, &mut |_, _| ());
        let (of_model, of_ground) = (maps(&own).map_err(|e| problem(&e))?, maps(&ground).map_err(|e| problem(&e))?);
        let [low, high] = model.bounds().unwrap_or_default().map(|corner| DVec3::from(corner.map(f64::from)));
        let (middle, size) = ((low + high) / 2.0, (high - low).max_element());
        let place = (middle + size * eye).as_vec3().to_array();
        let camera = Camera::new(place, middle.as_vec3().to_array(), [0.0, 0.0, 1.0], 0.3, SIDE, SIDE);
        let camera = camera.map_err(|e| problem(&e))?;
        let seen = SeenSurface::new(&mesh, &vertices, &camera);
        let framed = (models.picture_side(), &own[..]);
        let fine = FineView::new((&mesh, &vertices), place, framed).map_err(|e| problem(&e))?;
        Ok(Self { vertices, of_model, of_ground, hats: LinearBasis::new(BasisWidth::default()), camera, seen, fine })
    }

    pub(super) fn eye(&self) -> DVec3 {
        DVec3::from(self.camera.eye().map(f64::from))
    }

    /// Colors of all vertices from those of the model's maps and of the ground's.
    pub(super) fn joined(&self, model: &[[f64; 3]], ground: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut all = vec![[0.0; 3]; self.vertices.len()];
        for (maps, colors) in [(&self.of_model, model), (&self.of_ground, ground)] {
            maps.vertices().iter().zip(colors).for_each(|(&vertex, &color)| all[vertex as usize] = color);
        }
        all
    }

    pub(super) fn pixels(&self, of_vertex: &[[f64; 3]]) -> Vec<[f64; 3]> {
        self.seen.colors(of_vertex, [0.0; 3])
    }

    pub(super) fn exposure(&self, of_vertex: &[[f64; 3]]) -> f64 {
        auto_exposure(&self.pixels(of_vertex))
    }

    pub(super) fn picture(
        &self,
        of_vertex: &[[f64; 3]],
        exposure: f64,
        (name, caption): (String, String),
    ) -> Result<NamedPicture, StudyError> {
        let image = self.fine.picture(of_vertex).display(exposure).map_err(|e| failed(HOST)(&e))?;
        Ok(NamedPicture::new(name, image, caption))
    }

    pub(super) fn error(
        &self,
        found: &[[f64; 3]],
        exact: &[[f64; 3]],
        exposure: f64,
    ) -> Result<PictureDifference, StudyError> {
        let [found, exact] = [found, exact].map(|colors| self.pixels(colors));
        let pairs = || found.iter().flatten().zip(exact.iter().flatten());
        let apart: f64 = pairs().map(|(a, b)| (a - b) * (a - b)).sum();
        let whole: f64 = exact.iter().flatten().map(|value| value * value).sum();
        let screen = |colors: &[[f64; 3]]| {
            ScreenPicture::new(&linear_picture(&self.camera, colors), exposure).map_err(|e| failed(HOST)(&e))
        };
        let seen = flip(&screen(&found)?, &screen(&exact)?, PIXELS_PER_DEGREE);
        Ok(PictureDifference { rms: (apart / whole).sqrt(), flip: seen.map_or(0.0, |seen| seen.mean) })
    }
}

/// Stand-in for the light of St. Peter's: [`HARD_SUN`].
pub(super) fn stand_in() -> Result<CubeLight, StudyError> {
    let cube = DistantLight::Sky(HARD_SUN).cube(&DMat3::IDENTITY, Decimation::SolidAngle);
    cube.map_err(|e| failed(HOST)(&e))
}

/// Projects the light to harmonics of an order, as radiances of texels; negative ringing is clipped to 0.
pub(super) fn of_low_frequency(light: &CubeLight, order: usize) -> Result<CubeLight, StudyError> {
    let mut coefficients = vec![[0.0; 3]; function_count(order)];
    let mut y = vec![0.0; coefficients.len()];
    let at = |texel: usize| {
        let [face, row, column] = [texel / 1024, texel / 32 % 32, texel % 32];
        (LIGHT_MAP.direction(face, column, row), LIGHT_MAP.solid_angle(column, row))
    };
    for (texel, radiance) in light.texels().iter().enumerate() {
        let (direction, angle) = at(texel);
        harmonics(order, direction, &mut y);
        for (sum, y) in coefficients.iter_mut().zip(&y) {
            (0..3).for_each(|channel| sum[channel] += y * radiance[channel] * angle);
        }
    }
    let smooth = (0..light.texels().len()).map(|texel| {
        harmonics(order, at(texel).0, &mut y);
        [0, 1, 2].map(|channel| y.iter().zip(&coefficients).map(|(y, rgb)| y * rgb[channel]).sum::<f64>().max(0.0))
    });
    CubeLight::new(smooth.collect()).map_err(|e| failed(HOST)(&e))
}
