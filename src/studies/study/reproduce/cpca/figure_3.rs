//! Figures 3 and 4: static, iterative and adaptive compression by number of vectors.

use super::signals::{ComputedSignal, DIFFUSE_BIRD};
use super::{EntryFindings, PaperRow, Shared, StudyError, paragraph, solved};
use crate::clustering::CpcaMethod;
use crate::elementary::ln;
use crate::report::{Cell, Table};

/// Number of clusters of both figures.
const CLUSTERS: usize = 256;
/// Number of vectors in Figure 4, "n = 3".
const FIGURE_4: usize = 3;
/// Maximum number of vectors of the rows; static and iterative curves extend further, for comparison.
const VECTORS: usize = 8;
/// Number of further vectors of the static and iterative curves.
const MORE: usize = 6;
/// Maximum number of rounds of redistribution.
const ROUNDS: usize = 20;

const HOW: &str = "The signal is {} points of diffuse transfer of order {} in {} clusters. Vectors gained: how many more vectors the simpler method \
    needs for the same error, interpolated in the logarithm of the error. Redistribution ends when nothing changes, or after {} rounds.";
const QUESTION: &str =
    "the paper's model: iteration and redistribution gain more where clusters differ more, and on more clusters.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let computed = shared.get::<ComputedSignal>(DIFFUSE_BIRD)?;
    let clusters = computed.clusters(CLUSTERS);
    let still = computed.static_errors(clusters, VECTORS + MORE)?;
    let iterative = computed.iterative_errors(clusters, VECTORS + MORE)?;
    let adaptive = adaptive_errors(&computed, clusters)?;
    let mut table = Table::of(
        "Squared errors, and the vectors that iteration and redistribution gain",
        "vectors static iterative adaptive iterative_gains adaptive_gains",
    );
    let mut gained: [Vec<f64>; 2] = Default::default();
    for vectors in 1..=VECTORS {
        let gains = [
            reaching(&still, iterative[vectors]) - vectors as f64,
            reaching(&iterative, adaptive[vectors]) - vectors as f64,
        ];
        let errors = [still[vectors], iterative[vectors], adaptive[vectors]].map(Cell::measured);
        table.push([Cell::from(vectors)].into_iter().chain(errors).chain(gains.map(|gain| Cell::decimals(gain, 2))));
        if vectors.is_power_of_two() {
            gained.iter_mut().zip(gains).for_each(|(all, gain)| all.push(gain));
        }
    }
    let ratio = |above: &[f64], below: &[f64]| above[FIGURE_4] / below[FIGURE_4];
    let [by_iteration, by_redistribution] = gained;
    let rows = vec![
        over_readings("gained-by-iteration", &by_iteration)?,
        over_readings("gained-by-redistribution", &by_redistribution)?,
        solved("figure-4-iterative", ratio(&still, &iterative))?,
        solved("figure-4-adaptive", ratio(&iterative, &adaptive))?,
    ];
    let how = paragraph(HOW, &[&computed.signal.points(), &5.0, &clusters, &ROUNDS]);
    Ok(EntryFindings::new([how], rows, [QUESTION], [table]))
}

/// Row for a sentence about several numbers of vectors or clusters: the first value is ours, the others are readings.
pub(super) fn over_readings(id: &str, values: &[f64]) -> Result<PaperRow, StudyError> {
    let [first, others @ ..] = values else { return solved(id, f64::NAN) };
    Ok(solved(id, *first)?.with_readings(others.iter().copied()))
}

fn adaptive_errors(computed: &ComputedSignal, clusters: usize) -> Result<Vec<f64>, StudyError> {
    let method = CpcaMethod::Adaptive { rounds: ROUNDS };
    let error = |vectors| Ok(computed.error(&computed.compressed_to(clusters, vectors, method)?));
    (0..=VECTORS).map(error).collect()
}

/// Number of vectors at which a curve falls to `error`, interpolated logarithmically; the last number if it stays
/// above.
pub fn reaching(curve: &[f64], error: f64) -> f64 {
    let Some(at) = (1..curve.len()).find(|&at| curve[at] <= error) else { return (curve.len() - 1) as f64 };
    let [above, below] = [curve[at - 1], curve[at]];
    if above <= error { 0.0 } else { (at - 1) as f64 + ln(above / error) / ln(above / below) }
}
