//! Figure 9: sum of subsurface and glossy transfer, in two lighting environments.

use glam::DVec3;

use super::figure_3::EYE;
use super::shared::iterative;
use super::signals::{ComputedSignal, GLOSS_OF_FIGURE_9, TRANSLUCENT_BUDDHA};
use super::views::ModelView;
use super::{EntryFindings, HOST, Prose, Shared, StudyError, failed, number};
use crate::report::{Cell, NamedPicture, PictureGrid, Table};
use crate::sphere::{ClearSky, HarmonicLight};

/// Sky with the sun to the side of the model.
const SKY: ClearSky = ClearSky {
    sun: DVec3::new(1.0, -1.0, 1.0),
    sun_radiance: [5e4, 4.5e4, 4e4],
    zenith: [0.3, 0.5, 0.9],
    ground: [0.2; 3],
};

const HOW: &str = "A Buddha of {} vertices: isotropic gloss over a scattering medium, whose light goes into the first function of exit radiance alone. \
    Pictures are of the glossy part, of the sum, and of the sum from {} clusters of {} vectors, exposed alike. The share below the surface is what \
    the sum has beyond the glossy part; the error is that of the picture, root mean square over that of the picture without compression.";
const QUESTION: &str = "the model, its scale and its medium, and both environments.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let (computed, clustering) = iterative(shared, TRANSLUCENT_BUDDHA)?;
    let gloss = ComputedSignal::new(&GLOSS_OF_FIGURE_9, shared.models)?;
    let mut table = Table::of("The sum and its parts", "light share_below_the_surface_% error_of_picture_%");
    let mut columns: Vec<Vec<NamedPicture>> = Vec::new();
    for (name, light) in lights()? {
        let sum = ModelView::new(computed, &light, EYE)?;
        let glossy = ModelView::new(&gloss, &light, EYE)?.exposed_as(&sum);
        let [below, error] = [glossy.missing(&sum)?, sum.difference(Some(clustering), &sum.colors(None)?, |_| true)?];
        table.push([Cell::from(name), Cell::percent(100.0 * below), Cell::percent(100.0 * error)]);
        let file = |what: &str| format!("cpca-figure-9-{}-{what}", name.replace(' ', "-"));
        columns.push(vec![
            sum.picture(Some(clustering), file("compressed"), format!("{name}: the sum, compressed"))?,
            sum.picture(None, file("sum"), format!("{name}: the sum"))?,
            glossy.picture(None, file("gloss"), format!("{name}: the glossy part"))?,
            sum.light(&format!("cpca-figure-9-{}", name.replace(' ', "-")), name)?,
        ]);
    }
    let mut grid = PictureGrid::new("Figure 9", ["red and blue", "sky"]);
    for (at, label) in ["compressed", "the sum", "its glossy part", ""].into_iter().enumerate() {
        grid = grid.row(label, columns.iter().map(|column| column[at].clone()));
    }
    let vectors = computed.paper.size.vectors;
    let figures = [computed.signal.points(), clustering.subspaces().len(), vectors].map(|n| number(n as f64, 0));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures)],
        questions: vec![QUESTION],
        tables: vec![table],
        pictures: vec![grid],
        ..EntryFindings::default()
    })
}

/// Two environments: colored disks, and a sky with the sun to the side.
fn lights() -> Result<[(&'static str, HarmonicLight); 2], StudyError> {
    Ok([("red and blue", HarmonicLight::red_and_blue(5)), ("sky", SKY.light(5).map_err(|e| failed(HOST)(&e))?)])
}
