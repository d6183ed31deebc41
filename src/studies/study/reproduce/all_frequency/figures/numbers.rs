//! Figures 2 and 5: the numbers of terms and of representatives.

use glam::DVec3;

use super::scene::{FigureScene, Surface};
use super::{EntryFindings, Shared, StudyError, models, paragraph, solved};
use crate::all_frequency::Reflectance;
use crate::report::{Cell, Table};
use crate::study::prt::SegmentTally;

const TERMS: [usize; 7] = [1, 2, 4, 6, 8, 10, 16];

const TERMS_HOW: &str = "Figure 2 shows Cook-Torrance reflectance with more and more terms: in the textbook form, and \
    as the facet distribution alone, which is nearest to the errors of section 3.";

pub(super) fn figure_2() -> Result<EntryFindings, StudyError> {
    let mut table = Table::of("Figure 2: error by terms", "form terms relative_squared_error");
    let mut falls = Vec::new();
    for (form, lobe) in models::cook_torrance() {
        let factorization = models::factorization(&lobe, TERMS[TERMS.len() - 1])?;
        let error = |terms: usize| factorization.relative_squared_error(terms);
        TERMS.into_iter().for_each(|terms| table.push([form.into(), terms.into(), Cell::measured(error(terms))]));
        falls.push(error(1) / error(10));
    }
    let row = solved("one-term-over-ten", falls[0])?.with_readings(falls[1..].iter().copied());
    let row = row.confined([1.0, f64::INFINITY], "each term removes the square of its singular value from the error");
    Ok(EntryFindings::new([TERMS_HOW.to_owned()], [row], [], [table]))
}

/// Numbers of representatives; the last is the paper's.
const VECTORS: [usize; 4] = [1, 4, 8, 16];

const HOW: &str = "Figure 5 shows a diffuse Buddha of {} vertices, with {} clusters in all {} nonempty segments, {} vertices each on average.";

/// Reason why the error falls with more representatives.
const FEWER: &str =
    "representatives are added to existing clusters; their 16-bit code adds far less error than they remove";

pub(super) fn figure_5(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let size = shared.models;
    let scene = FigureScene::new(&models::buddha(size), 2, DVec3::new(1.0, -2.0, 0.6))?;
    let (maps, reflectance) = (&scene.of_model, &Reflectance::Diffuse);
    let surface = Surface { scene: &scene, maps, reflectance, color: [1.0; 3], pieces: (shared, "figure-5") };
    let mut table = Table::of("Figure 5: representatives per cluster", "representatives squared_error");
    let (mut errors, mut counts) = (Vec::new(), [0, 0]);
    for vectors in VECTORS {
        let (coded, tally) = surface.coded(models::options(size, vectors))?;
        let sum = |of: fn(&SegmentTally) -> f64| tally.iter().map(of).sum::<f64>();
        let squared = sum(|part| part.coded_squared_error) / sum(|part| part.squares);
        table.push([vectors.into(), Cell::measured(squared)]);
        errors.push(squared);
        counts = [coded.clusters(), coded.segments.len()];
    }
    let row = solved("one-representative-over-16", errors[0] / errors[3])?.confined([1.0, f64::INFINITY], FEWER);
    let [clusters, segments] = counts;
    let how = paragraph(HOW, &[&maps.len(), &clusters, &segments, &models::options(size, 1).points_per_cluster]);
    Ok(EntryFindings::new([how], [row], [], [table]))
}
