//! Figure 9: sum of subsurface and glossy transfer, in two lighting environments.

use glam::DVec3;

use super::figure_7::ModelView;
use super::signals::{ComputedSignal, GLOSS_OF_FIGURE_9, TRANSLUCENT_BUDDHA, iterative};
use super::{EntryFindings, HOST, RunResult, Shared, StudyError, paragraph};
use crate::report::{Cell, Table};
use crate::sphere::{ClearSky, HarmonicLight};

/// Sky with the sun at the model's side.
const SKY: ClearSky = ClearSky {
    sun: DVec3::new(1.0, -1.0, 1.0),
    sun_radiance: [5e4, 4.5e4, 4e4],
    zenith: [0.3, 0.5, 0.9],
    ground: [0.2; 3],
};

const HOW: &str = "The model is a Buddha of {} vertices with isotropic gloss over a scattering medium, whose light enters only the first function of \
    exit radiance. The share below the surface is the part of the sum that is not glossy. The error is the RMS error of the picture from {} clusters \
    of {} vectors, relative to the RMS of the uncompressed picture.";
const QUESTION: &str = "the model, its scale and its medium, and both environments.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let (computed, clustering) = iterative(shared, TRANSLUCENT_BUDDHA)?;
    let gloss = ComputedSignal::new(&GLOSS_OF_FIGURE_9, shared.models)?;
    let sky = SKY.light(5).on(HOST)?;
    let mut table = Table::of("The sum and its parts", "light share_below_the_surface_% error_of_picture_%");
    for (name, light) in [("red and blue", HarmonicLight::red_and_blue(5)), ("sky", sky)] {
        let sum = ModelView::new(&computed, &light)?;
        let below = ModelView::new(&gloss, &light)?.missing(&sum)?;
        let error = sum.difference(Some(&*clustering), &sum.colors(None)?, |_| true)?;
        table.push([Cell::from(name), Cell::percent(100.0 * below), Cell::percent(100.0 * error)]);
    }
    let (points, clusters) = (computed.signal.points(), clustering.subspaces().len());
    Ok(EntryFindings::new(
        [paragraph(HOW, &[&points, &clusters, &computed.paper.size.vectors])],
        [],
        [QUESTION],
        [table],
    ))
}
