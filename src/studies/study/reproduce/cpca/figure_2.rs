//! Figure 2: squared error of static principal components by storage, one curve per number of vectors.

use super::signals::{ComputedSignal, DIFFUSE_BIRD};
use super::{EntryFindings, Shared, StudyError, paragraph, solved};
use crate::cpca::on_card::model::TransferSize;
use crate::elementary::ln;
use crate::report::{Cell, Table};

/// Numbers of vectors, one per curve of the figure.
const VECTORS: [usize; 6] = [0, 1, 2, 4, 8, 16];
/// Minimum number of points per cluster: 48,688 points allow up to 16,384 clusters.
const LEAST_POINTS: usize = 2;

const HOW: &str = "The signal is {} points of shadowed diffuse transfer of order {} on our bird, in {} to {} clusters. \
    Static principal components are used: their clusters do not depend on the number of vectors. The figure's axes are \
    lost. By its text, each number of vectors is worse than the previous one with few clusters, and better with many. \
    Curves are compared at equal storage; the previous curve is interpolated between its points.";

/// Storage and squared error for increasing numbers of clusters.
type Curve = Vec<(f64, f64)>;

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let computed = shared.get::<ComputedSignal>(DIFFUSE_BIRD)?;
    let points = computed.signal.points();
    let counts: Vec<usize> = std::iter::successors(Some(1), |&count| Some(2 * count))
        .take_while(|count| count * LEAST_POINTS <= points)
        .collect();
    let mut curves: Vec<Curve> = vec![Vec::new(); VECTORS.len()];
    let mut table = Table::of("Squared error, relative to one cluster without vectors (%)", "clusters 0 1 2 4 8 16");
    let mut whole = None;
    for &clusters in &counts {
        let errors = computed.static_errors(clusters, VECTORS[VECTORS.len() - 1])?;
        let whole = *whole.get_or_insert(errors[0]);
        let mut cells: Vec<Cell> = vec![clusters.into()];
        for (curve, &vectors) in curves.iter_mut().zip(&VECTORS) {
            let size = TransferSize { vertices: points, clusters, vectors, ..computed.paper.size };
            curve.push((size.stored_numbers() as f64, errors[vectors]));
            cells.push(Cell::measured(100.0 * errors[vectors] / whole));
        }
        table.push(cells);
    }
    let [worse, better] = crossings(&curves);
    let last = counts.last().copied().unwrap_or(1);
    Ok(EntryFindings::new(
        [paragraph(HOW, &[&points, &5.0, &1.0, &last])],
        [solved("curves-worse", worse as f64)?, solved("curves-better", better as f64)?],
        ["the axes of the figure, which the scan has lost."],
        [table],
    ))
}

/// Numbers of curves that are above the previous curve at the smallest common storage, and below it at the largest.
pub fn crossings(curves: &[Curve]) -> [usize; 2] {
    let mut found = [0, 0];
    for pair in curves.windows(2) {
        let mut differences = pair[1].iter().filter_map(|&(storage, error)| Some(error - at(&pair[0], storage)?));
        let first = differences.next();
        let last = differences.next_back().or(first);
        found[0] += usize::from(first.is_some_and(|difference| difference > 0.0));
        found[1] += usize::from(last.is_some_and(|difference| difference < 0.0));
    }
    found
}

/// Error of a curve at a storage within its range, interpolated logarithmically.
fn at(curve: &Curve, storage: f64) -> Option<f64> {
    let segment = curve.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&storage))?;
    let [(s0, e0), (s1, e1)] = [segment[0], segment[1]];
    let part = ln(storage / s0) / ln(s1 / s0);
    Some(if e1 > 0.0 { e0 * crate::elementary::exp(part * ln(e1 / e0)) } else { e0 * (1.0 - part) })
}
