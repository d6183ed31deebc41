//! Figure 1: our method and spherical harmonics, compared with the exact picture.

use glam::DVec3;

use super::scene::{FigureScene, Surface, stand_in};
use super::{EntryFindings, Shared, StudyError, models, paragraph, solved};
use crate::all_frequency::Reflectance;
use crate::all_frequency::baselines::{BaselineSubject, FixedView, HarmonicTransfer};
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::factor::ProductFunction;
use crate::clustering::CpcaMethod;
use crate::report::{Cell, Table};
use crate::transfer::brdf::Brdf;
use crate::transfer::grid::Segmentation;
use crate::transfer::light::{CubeLight, HaarLight};
use crate::transfer::visibility::VisibilityMaps;

/// Order of the harmonics.
const ORDER: usize = 5;
/// Numbers of terms and of representatives.
const TERMS: usize = 10;
const VECTORS: usize = 16;
/// Colors of the model and of the ground.
const COLORS: [[f64; 3]; 2] = [[0.9, 0.75, 0.5], [0.7; 3]];

const HOW: &str = "Figure 1 shows a bird with {} vertices on a ground with {} under a clear sky with a sun. Exact: the unfactored reflectance for \
    every direction at every vertex. Ours: {} terms, {} representatives per cluster of {} vertices, whose number doubles from one, and all light \
    coefficients. Harmonics: order {} for the light and for the incident light, and the reflectance's own coefficients towards the eye. The bird has \
    Schlick's model in the textbook form, and in the form nearest to the errors of section 3, which has visible highlights.";

/// Colors of vertices by method: exact, ours, harmonics.
type MethodColors = Vec<Vec<[f64; 3]>>;

pub(super) fn figure(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let size = shared.models;
    let scene = FigureScene::new(&models::tweety(size), models::ground(size), DVec3::new(1.3, -2.6, 1.3))?;
    // The number of representatives is doubled, as the command does by default; otherwise two models would take seven
    // hours of processor time at full size.
    let options = SegmentOptions { method: CpcaMethod::Doubling, ..models::options(size, VECTORS) };
    let methods = Methods { scene: &scene, light: stand_in()?, options, shared };
    let lambert = Brdf::Lambert { albedo: 1.0 };
    let ground = methods.colors((&scene.of_ground, &lambert, &Reflectance::Diffuse), COLORS[1], "figure-1-ground")?;
    let mut table = Table::of("Figure 1: errors against the exact picture", "form method rms_%");
    let mut ratios = Vec::new();
    for (form, lobe) in models::schlick() {
        let glossy = Reflectance::Factored(models::factorization(&lobe, TERMS)?.factors(TERMS));
        // Names of pieces.
        let name = if form == "textbook" { "figure-1-model" } else { "figure-1-model-quarter-of-half-vector" };
        let model = methods.colors((&scene.of_model, &lobe, &glossy), COLORS[0], name)?;
        let [exact, ours, harmonics] = [0, 1, 2].map(|at| scene.joined(&model[at], &ground[at]));
        let [ours, harmonics] = [ours, harmonics].map(|colors| scene.rms(&colors, &exact));
        for (method, rms) in [("ours".to_owned(), ours), (format!("spherical harmonics of order {ORDER}"), harmonics)] {
            table.push([form.into(), method.into(), Cell::measured(100.0 * rms)]);
        }
        ratios.push(harmonics / ours);
    }
    let (model, ground) = (scene.of_model.len(), scene.of_ground.len());
    Ok(EntryFindings::new(
        [paragraph(HOW, &[&model, &ground, &TERMS, &VECTORS, &methods.options.points_per_cluster, &ORDER])],
        [solved("harmonics-over-ours", ratios[0])?.with_readings(ratios[1..].iter().copied())],
        [],
        [table],
    ))
}

/// All methods for a scene under the stand-in for the light of St. Peter's.
struct Methods<'a> {
    scene: &'a FigureScene,
    light: CubeLight,
    options: SegmentOptions,
    shared: &'a Shared,
}

impl Methods<'_> {
    /// Colors of the model or the ground. Like segments, they are stored as a piece of the work.
    fn colors(
        &self,
        (maps, product, reflectance): (&VisibilityMaps, &dyn ProductFunction, &Reflectance),
        color: [f64; 3],
        name: &str,
    ) -> Result<MethodColors, StudyError> {
        self.shared.piece(name, || {
            let scene = self.scene;
            let subject = BaselineSubject { vertices: &scene.vertices, maps, hats: &scene.hats, product };
            let exact = FixedView(subject).radiance(scene.eye(), &[self.light.texels()]).remove(0);
            let harmonics = HarmonicTransfer::new(subject, ORDER);
            let harmonics = harmonics.radiance(scene.eye(), &harmonics.light(self.light.texels()));
            let colored = |colors: Vec<[f64; 3]>| -> Vec<[f64; 3]> {
                colors.into_iter().map(|rgb| [0, 1, 2].map(|channel| rgb[channel] * color[channel])).collect()
            };
            let surface = Surface { scene, maps, reflectance, color, pieces: (self.shared, name) };
            let quarters = HaarLight::new(&self.light, Segmentation::Quarters);
            let ours = surface.of_code(&surface.coded(self.options)?.0, &quarters)?;
            Ok(vec![colored(exact), ours, colored(harmonics)])
        })
    }
}
