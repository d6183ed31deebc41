//! Figure 1: our method, spherical harmonics, and wavelets of a fixed view beside the exact picture.

use glam::DVec3;

use super::lit::Surface;
use super::scene::{FigureScene, PictureDifference, stand_in};
use super::{FigureParts, HOST, Prose, Shared, StudyError, failed, models, number, solved};
use crate::all_frequency::Reflectance;
use crate::all_frequency::baselines::{BaselineSubject, FixedView, HarmonicTransfer};
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::factor::ProductFunction;
use crate::report::{Cell, PictureGrid, Table};
use crate::study::reproduce::ModelSize;
use crate::transfer::brdf::Brdf;
use crate::transfer::clustering::CpcaMethod;
use crate::transfer::grid::Segmentation;
use crate::transfer::light::{CubeLight, HaarLight, TruncationPriority};
use crate::transfer::visibility::VisibilityMaps;

/// Order of the harmonics.
const ORDER: usize = 5;
/// Light coefficients kept for a fixed view: \[NRH03\] uses a hundred or two.
const KEPT: [usize; 3] = [100, 200, 800];
/// Numbers of terms and of representatives.
const TERMS: usize = 10;
const VECTORS: usize = 16;
/// Colors of the model and of the ground.
pub(super) const COLORS: [[f64; 3]; 2] = [[0.9, 0.75, 0.5], [0.7; 3]];

const HOW: &str = "Figure 1 draws a bird with {} vertices on a ground with {} under a clear sky with a sun. Exact: every direction of every vertex, the reflectance \
    itself. Ours: {} terms, {} representatives per cluster of {} vertices, whose number is doubled from one on, all light coefficients. Harmonics: order {} for light and for the light that \
    arrives, and the reflectance's own coefficients towards the eye. Fixed view: exact transfer for this one eye, and a light cut to \
    a number of wavelets on six faces, by area times magnitude. The bird is drawn twice: with Schlick's model in the textbooks' form, and in the form \
    that is nearest to the errors of section 3, whose highlights can be seen.";

/// Radiance of all vertices of a scene by each method.
struct MethodColors {
    exact: Vec<[f64; 3]>,
    others: Vec<(String, Vec<[f64; 3]>)>,
}

/// Compression options: the number of representatives is doubled, as the command does by default, or two models would
/// take seven hours of processor time at full size.
pub(super) fn options(size: ModelSize) -> SegmentOptions {
    SegmentOptions { method: CpcaMethod::Doubling, ..models::options(size, VECTORS) }
}

pub(super) fn figure(shared: &Shared) -> Result<FigureParts, StudyError> {
    let size = shared.models;
    let scene = FigureScene::new(&models::tweety(size), models::ground(size), DVec3::new(1.3, -2.6, 1.3), size)?;
    let methods = Methods::new(&scene, options(size), shared)?;
    let lambert = Brdf::Lambert { albedo: 1.0 };
    let ground = methods.colors((&scene.of_ground, &lambert, &Reflectance::Diffuse), COLORS[1], "figure-1-ground")?;
    let mut parts = FigureParts::default();
    let columns = ["exact".to_owned(), "ours".to_owned(), format!("harmonics, order {ORDER}")];
    let fixed = KEPT.map(|kept| format!("fixed view, {kept} wavelets"));
    let mut grid = PictureGrid::new("Figure 1", columns.into_iter().chain(fixed));
    let mut table = Table::of("Figure 1: off the exact picture", "form method rms_% flip");
    let mut ratios = Vec::new();
    for (form, lobe) in models::schlick() {
        let glossy = Reflectance::Factored(models::factorization(&lobe, TERMS)?.factors(TERMS));
        let name = |what: &str| format!("figure-1-{what}{}", models::ending(form));
        let model = methods.colors((&scene.of_model, &lobe, &glossy), COLORS[0], &name("model"))?;
        let found = methods.joined(&model, &ground);
        let exposure = scene.exposure(&found.exact);
        let caption = format!("exact: no factors, no compression, the whole light; {form}");
        let mut pictures = vec![scene.picture(&found.exact, exposure, (name("exact"), caption))?];
        let mut errors: Vec<PictureDifference> = Vec::new();
        for (at, (method, colors)) in found.others.iter().enumerate() {
            let error = scene.error(colors, &found.exact, exposure)?;
            table.push([
                form.into(),
                method.clone().into(),
                Cell::measured(100.0 * error.rms),
                Cell::measured(error.flip),
            ]);
            let shown = (name(&at.to_string()), format!("{method}; {form}"));
            pictures.push(scene.picture(colors, exposure, shown)?);
            errors.push(error);
        }
        grid = grid.row(format!("Schlick's model, {form}"), pictures);
        ratios.push(errors[1].rms / errors[0].rms);
    }
    parts.pictures = vec![grid];
    let sizes = [scene.of_model.len(), scene.of_ground.len(), TERMS, VECTORS, models::points_per_cluster(size), ORDER];
    // The paper does not compare with a fixed view: its differences stand in the table alone.
    parts.rows = vec![solved("harmonics-over-ours", ratios[0])?.with_readings(ratios[1..].iter().copied())];
    parts.text = vec![Prose::new(HOW, sizes.map(|size| number(size as f64, 0)))];
    parts.tables = vec![table];
    Ok(parts)
}

/// All methods on a scene under the stand-in for the light of St. Peter's.
struct Methods<'a> {
    scene: &'a FigureScene,
    light: CubeLight,
    /// The light cut to each of [`KEPT`].
    cut: Vec<Vec<[f64; 3]>>,
    options: SegmentOptions,
    shared: &'a Shared,
}

impl<'a> Methods<'a> {
    fn new(scene: &'a FigureScene, options: SegmentOptions, shared: &'a Shared) -> Result<Self, StudyError> {
        let light = stand_in()?;
        let faces = HaarLight::new(&light, Segmentation::Faces);
        let kept = |keep: usize| faces.truncated(keep, TruncationPriority::Area).map_err(|e| failed(HOST)(&e));
        let cut = KEPT.iter().map(|&keep| Ok(kept(keep)?.light.radiances())).collect::<Result<_, StudyError>>()?;
        Ok(Self { scene, light, cut, options, shared })
    }

    /// Colors of the model or the ground: exact, ours, harmonics, and a fixed view with each of the cut lights. They
    /// are a piece of the work, and so are segments.
    fn colors(
        &self,
        subject: (&VisibilityMaps, &dyn ProductFunction, &Reflectance),
        color: [f64; 3],
        name: &str,
    ) -> Result<Vec<Vec<[f64; 3]>>, StudyError> {
        self.shared.piece(name, || self.computed(subject, color, name))
    }

    fn computed(
        &self,
        (maps, product, reflectance): (&VisibilityMaps, &dyn ProductFunction, &Reflectance),
        color: [f64; 3],
        name: &str,
    ) -> Result<Vec<Vec<[f64; 3]>>, StudyError> {
        let scene = self.scene;
        let lights: Vec<&[[f64; 3]]> =
            [self.light.texels()].into_iter().chain(self.cut.iter().map(Vec::as_slice)).collect();
        let subject = BaselineSubject { vertices: &scene.vertices, maps, hats: &scene.hats, product };
        let mut all = FixedView(subject).radiance(scene.eye(), &lights);
        let harmonics = HarmonicTransfer::new(subject, ORDER);
        all.insert(1, harmonics.radiance(scene.eye(), &harmonics.light(self.light.texels())));
        let colored = |colors: Vec<[f64; 3]>| -> Vec<[f64; 3]> {
            colors.into_iter().map(|rgb| [0, 1, 2].map(|channel| rgb[channel] * color[channel])).collect()
        };
        let mut all: Vec<Vec<[f64; 3]>> = all.into_iter().map(colored).collect();
        let surface = Surface { scene, maps, reflectance, color, pieces: (self.shared, name) };
        let quarters = HaarLight::new(&self.light, Segmentation::Quarters);
        all.insert(1, surface.of_code(&surface.coded(self.options)?.0, &quarters)?);
        Ok(all)
    }

    fn joined(&self, model: &[Vec<[f64; 3]>], ground: &[Vec<[f64; 3]>]) -> MethodColors {
        let mut all = model.iter().zip(ground).map(|(model, ground)| self.scene.joined(model, ground));
        let exact = all.next().unwrap_or_default();
        let names = ["ours".to_owned(), format!("spherical harmonics of order {ORDER}")]
            .into_iter()
            .chain(KEPT.map(|keep| format!("fixed view, {keep} wavelets")));
        MethodColors { exact, others: names.zip(all).collect() }
    }
}
