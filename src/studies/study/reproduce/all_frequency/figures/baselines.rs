//! Figure 1: our method, spherical harmonics, and wavelets of a fixed view beside the exact picture.

use glam::DVec3;

use super::lit::Surface;
use super::scene::{FigureScene, PictureDifference, stand_in};
use super::{FigureParts, HOST, ModelSize, Prose, ReproduceError, failed, models, number, solved};
use crate::all_frequency::Reflectance;
use crate::all_frequency::compressed::SegmentOptions;
use crate::all_frequency::factor::ProductFunction;
use crate::all_frequency::rivals::{FixedView, HarmonicTransfer, RivalSubject};
use crate::report::{Cell, Table};
use crate::transfer::brdf::Brdf;
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
    itself. Ours: {} terms, {} representatives per cluster of {} vertices, all light coefficients. Harmonics: order {} for light and for the light that \
    arrives, and the reflectance's own coefficients towards the eye. Fixed view: exact transfer for this one eye, and a light cut to \
    a number of wavelets on six faces, by area times magnitude.";

/// Radiance of all vertices of a scene by each method.
struct MethodColors {
    exact: Vec<[f64; 3]>,
    others: Vec<(String, Vec<[f64; 3]>)>,
}

pub(super) fn figure(size: ModelSize) -> Result<FigureParts, ReproduceError> {
    let scene = FigureScene::new(&models::tweety(size), models::ground(size), DVec3::new(1.3, -2.6, 1.3), size)?;
    let light = stand_in()?;
    let methods = methods(&scene, &light, models::options(size, VECTORS))?;
    let exposure = scene.exposure(&methods.exact);
    let caption = "exact: no factors, no compression, the whole light".to_owned();
    let mut pictures = vec![scene.picture(&methods.exact, exposure, ("figure-1-exact".to_owned(), caption))?];
    let mut table = Table::of("Figure 1: off the exact picture", "method rms_% flip");
    let mut errors: Vec<PictureDifference> = Vec::new();
    for (at, (name, colors)) in methods.others.iter().enumerate() {
        let error = scene.error(colors, &methods.exact, exposure)?;
        table.push([name.clone().into(), Cell::measured(100.0 * error.rms), Cell::measured(error.flip)]);
        pictures.push(scene.picture(colors, exposure, (format!("figure-1-{at}"), name.clone()))?);
        errors.push(error);
    }
    let sizes = [scene.of_model.len(), scene.of_ground.len(), TERMS, VECTORS, models::points_per_cluster(size), ORDER];
    // The paper does not compare with a fixed view: its differences stand in the table alone.
    let rows = vec![solved("harmonics-over-ours", errors[1].rms / errors[0].rms)?];
    let text = vec![Prose::new(HOW, sizes.map(|size| number(size as f64, 0)))];
    Ok(FigureParts { text, rows, tables: vec![table], pictures })
}

/// Computes model and ground by each method.
fn methods(scene: &FigureScene, light: &CubeLight, options: SegmentOptions) -> Result<MethodColors, ReproduceError> {
    let lobe = models::schlick();
    let factors = models::factorization(&lobe, TERMS)?.factors(TERMS);
    let glossy = Reflectance::Factored(factors);
    let lambert = Brdf::Lambert { albedo: 1.0 };
    let faces = HaarLight::new(light, Segmentation::Faces);
    let kept = |keep: usize| faces.truncated(keep, TruncationPriority::Area).map_err(|e| failed(HOST)(&e));
    let cut: Vec<Vec<[f64; 3]>> =
        KEPT.iter().map(|&keep| Ok(kept(keep)?.light.radiances())).collect::<Result<_, ReproduceError>>()?;
    let lights: Vec<&[[f64; 3]]> = [light.texels()].into_iter().chain(cut.iter().map(Vec::as_slice)).collect();
    let quarters = HaarLight::new(light, Segmentation::Quarters);
    let parts: [(&VisibilityMaps, &dyn ProductFunction, &Reflectance); 2] =
        [(&scene.of_model, &lobe, &glossy), (&scene.of_ground, &lambert, &Reflectance::Diffuse)];
    let mut by_part = Vec::new();
    for ((maps, product, reflectance), color) in parts.into_iter().zip(COLORS) {
        let subject = RivalSubject { vertices: &scene.vertices, maps, hats: &scene.hats, product };
        let mut all = FixedView(subject).radiance(scene.eye(), &lights);
        let harmonics = HarmonicTransfer::new(subject, ORDER);
        all.insert(1, harmonics.radiance(scene.eye(), &harmonics.light(light.texels())));
        let colored = |colors: Vec<[f64; 3]>| -> Vec<[f64; 3]> {
            colors.into_iter().map(|rgb| [0, 1, 2].map(|channel| rgb[channel] * color[channel])).collect()
        };
        let mut all: Vec<Vec<[f64; 3]>> = all.into_iter().map(colored).collect();
        let surface = Surface { scene, maps, reflectance, color };
        all.insert(1, surface.of_code(&surface.coded(options)?.0, &quarters)?);
        by_part.push(all);
    }
    let ground = by_part.pop().unwrap_or_default();
    let model = by_part.pop().unwrap_or_default();
    let mut all = model.iter().zip(&ground).map(|(model, ground)| scene.joined(model, ground));
    let exact = all.next().unwrap_or_default();
    let names = ["ours".to_owned(), format!("spherical harmonics of order {ORDER}")]
        .into_iter()
        .chain(KEPT.map(|keep| format!("fixed view, {keep} wavelets")));
    let others = names.zip(all).collect();
    Ok(MethodColors { exact, others })
}
