//! Figure 2: the number of terms.

use glam::DVec3;

use super::lit::Surface;
use super::models::NamedLobe;
use super::scene::{FigureScene, stand_in};
use super::{FigureParts, Prose, Shared, StudyError, models, number, solved};
use crate::all_frequency::Reflectance;
use crate::all_frequency::baselines::{BaselineSubject, FixedView};
use crate::report::{Cell, NamedPicture, PictureGrid, Table};
use crate::transfer::grid::Segmentation;
use crate::transfer::light::{CubeLight, HaarLight};

/// Numbers of terms.
const TERMS: [usize; 7] = [1, 2, 4, 6, 8, 10, 16];
/// Vertices along an edge of the ground, which is not visible.
const GROUND: u32 = 2;
const COLOR: [f64; 3] = [0.9, 0.75, 0.5];

const HOW: &str = "Figure 2 draws a teapot with {} vertices and the reflectance of Cook and Torrance with more and more terms, transfer not compressed, beside the \
    reflectance itself: in the textbooks' form, and as the distribution of facets alone, which is nearest to the errors of section 3.";

fn surface<'a>(scene: &'a FigureScene, reflectance: &'a Reflectance, pieces: (&'a Shared, &'a str)) -> Surface<'a> {
    Surface { scene, maps: &scene.of_model, reflectance, color: COLOR, pieces }
}

pub(super) fn figure(shared: &Shared) -> Result<FigureParts, StudyError> {
    let size = shared.models;
    let scene = FigureScene::new(&models::drawn_teapot(size)?, GROUND, DVec3::new(0.9, -1.9, 1.1), size)?;
    let light = stand_in()?;
    let mut parts = FigureParts::default();
    let columns = std::iter::once("the reflectance itself".to_owned()).chain(TERMS.map(|terms| format!("m = {terms}")));
    let mut grid = PictureGrid::new("Figure 2", columns);
    let mut table = Table::of("Figure 2: terms", "form terms relative_squared_error rms_% flip");
    let mut falls = Vec::new();
    for form in models::cook_torrance() {
        let (errors, pictures) = of_form(&scene, &light, form, (&mut table, shared))?;
        let at = |terms: usize| TERMS.iter().position(|&other| other == terms).map_or(f64::NAN, |at| errors[at]);
        falls.push(at(1) / at(10));
        grid = grid.row(format!("Cook and Torrance's model, {}", form.0), pictures);
    }
    parts.pictures = vec![grid];
    let row = solved("one-term-over-ten", falls[0])?.with_readings(falls[1..].iter().copied());
    parts.rows =
        vec![row.confined([1.0, f64::INFINITY], "each term is a singular value, whose square leaves the error")];
    parts.text = vec![Prose::new(HOW, [number(scene.of_model.len() as f64, 0)])];
    parts.tables = vec![table];
    Ok(parts)
}

/// Errors of the table of a form by the number of terms, and its pictures.
fn of_form(
    scene: &FigureScene,
    light: &CubeLight,
    (form, lobe): NamedLobe,
    (table, shared): (&mut Table, &Shared),
) -> Result<(Vec<f64>, Vec<NamedPicture>), StudyError> {
    let most = TERMS[TERMS.len() - 1];
    let factorization = models::factorization(&lobe, most)?;
    let of_most = Reflectance::Factored(factorization.factors(most));
    let dark = vec![[0.0; 3]; scene.of_ground.len()];
    let name = |what: &str| format!("figure-2-{what}{}", models::ending(form));
    let of_all = name("all");
    let pieces = (shared, of_all.as_str());
    let raw = surface(scene, &of_most, pieces).raw(&[&HaarLight::new(light, Segmentation::Quarters)])?.remove(0);
    let subject =
        BaselineSubject { vertices: &scene.vertices, maps: &scene.of_model, hats: &scene.hats, product: &lobe };
    let exact = || Ok(FixedView(subject).radiance(scene.eye(), &[light.texels()]).remove(0));
    let exact: Vec<[f64; 3]> = shared.piece(&name("itself"), exact)?;
    let colored: Vec<[f64; 3]> =
        exact.iter().map(|rgb| [0, 1, 2].map(|channel| rgb[channel] * COLOR[channel])).collect();
    let exact = scene.joined(&colored, &dark);
    let exposure = scene.exposure(&exact);
    let mut pictures =
        vec![scene.picture(&exact, exposure, (name("exact"), format!("the reflectance itself, {form}")))?];
    let mut errors = Vec::new();
    for terms in TERMS {
        let reflectance = Reflectance::Factored(factorization.factors(terms));
        let model = surface(scene, &reflectance, pieces).exit_of_rows((most, &raw));
        let found = scene.joined(&model, &dark);
        let error = scene.error(&found, &exact, exposure)?;
        let of_table = factorization.relative_squared_error(terms);
        table.push([
            form.into(),
            terms.into(),
            Cell::measured(of_table),
            Cell::measured(100.0 * error.rms),
            Cell::measured(error.flip),
        ]);
        let caption = format!("terms: {terms}, {form}");
        pictures.push(scene.picture(&found, exposure, (name(&terms.to_string()), caption))?);
        errors.push(of_table);
    }
    Ok((errors, pictures))
}
