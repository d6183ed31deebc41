//! Number of segments below the horizon, from the geometry of the cube; Table 1's frame rates, from its sizes. Figures
//! that follow from printed values alone are expressions in `src/studies/papers`.

use refsim::timing::host::HostOperation;

use super::{
    Dependence, EntryFindings, HOST, Method, RunResult, Shared, StudyError, paper_row, paragraph, printed_value,
};
use crate::all_frequency::on_card::time::host_of_table_1;
use crate::elementary::log10;
use crate::linalg::dot;
use crate::sphere::CubeMap;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::segments_below_horizon;

/// Rows of a glossy transfer matrix, and representatives per cluster.
const M: usize = 10;
const N: usize = 16;
/// Texels along an edge of the cube map whose texel centers are the normals for counting segments.
const NORMALS: usize = 48;

/// Columns of Table 1: the names of model and column in figure names, and the number of rows of a matrix.
pub(super) const COLUMNS: [(&str, &str, usize); 6] = [
    ("bunny", "bunny", M),
    ("teapot", "teapot", M),
    ("tweety", "tweety-diffuse", 1),
    ("tweety", "tweety-glossy", M),
    ("buddha", "buddha-diffuse", 1),
    ("buddha", "buddha-glossy", M),
];
const HOW: &str = "Nothing is run: sizes follow from printed sizes by equation 12. Segments below the horizon are counted for {} normals that are \
    spread over the sphere; a segment is below if none of the fine directions within it is above the horizon. Frame rates follow from one constant, \
    {} G multiplications per second, fitted to all six printed rates without drawing. Representatives count as dense, though the paper's are \
    sparse.";
const QUESTION: &str = "why fewer multiplications per second fit diffuse models and Buddha: sparse representatives, memory, or the host's share of the loop.";
const RATE: &str = "Table 1: frames without drawing, which together determined the constant";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (least, mean) = below_horizon();
    let row = |id: &str, ours| paper_row(&format!("all-frequency/{id}"), (HOST, Method::Equation), ours);
    let mut rows = Vec::new();
    let orders = log10(LIGHT_TEXELS as f64 / 25.0);
    for (id, ours) in
        [("orders", orders), ("below-least", least), ("below-mean", mean), ("open-share", 1.0 - mean / 24.0)]
    {
        rows.push(row(id, (ours, Dependence::Counted))?);
    }
    let rate = 1e9 / host_of_table_1().on(HOST)?.time_of(HostOperation::MultiplyAdd, 1_000_000_000).seconds();
    for (model, column, terms) in COLUMNS {
        let value = |what: &str, of: &str| printed_value(&format!("all-frequency/{what}-{of}"));
        let (thousands, omega) = (value("vertices", model)?, value("omega", model)? / 100.0);
        // Multiplications per frame.
        let of_clusters = value("clusters", column)? * N as f64 * (terms * Segmentation::Quarters.len()) as f64 * 3.0;
        let of_vertices = 1e3 * thousands * 24.0 * omega * (N * terms * 3) as f64;
        let ours = (rate / (of_clusters + of_vertices), Dependence::Calibrated { on: RATE });
        rows.push(row(&format!("fps-alone-{column}"), ours)?);
    }
    let how = paragraph(HOW, &[&(6 * NORMALS * NORMALS), &(1e-9 * rate, 2)]);
    Ok(EntryFindings::new([how], rows, [QUESTION], []))
}

/// Minimum number of segments below the horizon of a normal, and the mean over all directions.
fn below_horizon() -> (f64, f64) {
    let (hats, map) = (LinearBasis::new(BasisWidth::OneTexel), CubeMap::new(NORMALS));
    let (mut counts, mut weights) = (Vec::new(), Vec::new());
    for (face, row, column) in
        (0..6 * NORMALS * NORMALS).map(|at| (at / NORMALS / NORMALS, at / NORMALS % NORMALS, at % NORMALS))
    {
        counts.push(f64::from(segments_below_horizon(map.direction(face, column, row), &hats).count_ones()));
        weights.push(map.solid_angle(column, row));
    }
    let mean = dot(&counts, &weights) / weights.iter().sum::<f64>();
    (counts.into_iter().fold(f64::INFINITY, f64::min), mean)
}
