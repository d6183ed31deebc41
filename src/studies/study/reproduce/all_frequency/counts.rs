//! Number of segments below the horizon, from the geometry of the cube; Table 1's frame rates, from its sizes. Figures
//! that follow from printed values alone are expressions in `src/studies/papers`.

use refsim::timing::host::HostOperation;

use super::{
    Dependence, EntryFindings, HOST, Method, PaperRow, RunResult, Shared, StudyError, number, paper_row, paragraph,
    printed, printed_value,
};
use crate::all_frequency::on_card::time::host_of_table_1;
use crate::elementary::log10;
use crate::linalg::dot;
use crate::report::{Cell, Table};
use crate::sphere::CubeMap;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};
use crate::transfer::linear_basis::{BasisWidth, LinearBasis};
use crate::transfer::visibility::segments_below_horizon;

/// Rows of a glossy transfer matrix, representatives per cluster, and target vertices per cluster.
const M: usize = 10;
const N: usize = 16;
const PER_CLUSTER: f64 = 200.0;
/// Texels along an edge of the cube map whose texel centers are the normals for counting segments.
const NORMALS: usize = 48;

/// Columns of Table 1: the names of model and column in figure names, and the number of rows of a matrix.
const COLUMNS: [(&str, &str, usize); 6] = [
    ("bunny", "bunny", M),
    ("teapot", "teapot", M),
    ("tweety", "tweety-diffuse", 1),
    ("tweety", "tweety-glossy", M),
    ("buddha", "buddha-diffuse", 1),
    ("buddha", "buddha-glossy", M),
];

/// Column of Table 1, as printed.
struct Column {
    id: &'static str,
    rows: usize,
    /// Number of vertices, in thousands.
    vertices: f64,
    /// Fraction of the segments that are not empty.
    omega: f64,
    clusters: f64,
}

impl Column {
    fn all() -> Result<Vec<Self>, StudyError> {
        let column = |&(model, id, rows): &(&str, &'static str, usize)| {
            Ok(Self {
                id,
                rows,
                vertices: printed_value(&format!("all-frequency/vertices-{model}"))?,
                omega: printed_value(&format!("all-frequency/omega-{model}"))? / 100.0,
                clusters: printed_value(&format!("all-frequency/clusters-{id}"))?,
            })
        };
        COLUMNS.iter().map(column).collect()
    }

    /// Full name of one of the column's figures.
    fn figure(&self, what: &str) -> String {
        format!("all-frequency/{what}-{}", self.id)
    }

    fn segment_numbers(&self) -> f64 {
        (self.rows * Segmentation::Quarters.len()) as f64
    }

    fn raw_gigabytes(&self) -> f64 {
        4e-9 * 1e3 * self.vertices * (self.rows * LIGHT_TEXELS) as f64
    }

    /// Number of non-empty segments over all vertices.
    fn nonempty(&self) -> f64 {
        1e3 * self.vertices * 24.0 * self.omega
    }

    /// Size after clustering relative to the raw size: omega / r.
    fn clustered(&self) -> f64 {
        self.omega / ratio(self.nonempty() / self.clusters, self.segment_numbers())
    }

    /// Multiplications per frame: for clusters and for vertices.
    fn multiplies(&self) -> [f64; 2] {
        let clusters = self.clusters * N as f64 * self.segment_numbers() * 3.0;
        [clusters, self.nonempty() * (N * self.rows * 3) as f64]
    }
}

/// Equation 12: ratio of uncompressed to compressed size of a cluster.
fn ratio(members: f64, numbers: f64) -> f64 {
    members * numbers / (N as f64 * (members + numbers))
}

const HOW: &str = "Nothing is run: sizes follow from printed ones by equation 12. Segments below the horizon are counted for {} normals spread over \
    the sphere, by fine directions within the segment only. Frame rates come from one constant, {} G multiplications per second, fitted to all six \
    rates without drawing; representatives count as dense, though the paper's are sparse.";
const QUESTION: &str = "why fewer multiplications per second fit diffuse models and Buddha: sparse representatives, memory, or the host's share of the loop.";
const RATE: &str = "Table 1: frames without drawing, which together determined the constant";

pub(in crate::study::reproduce) fn findings(_: &Shared) -> Result<EntryFindings, StudyError> {
    let (least, mean) = below_horizon();
    let equation = |id: &str, ours: (f64, Dependence)| paper_row(id, (HOST, Method::Equation), ours);
    let count = |(id, ours): (&str, f64)| equation(&format!("all-frequency/{id}"), (ours, Dependence::Counted));
    let counts = [
        ("orders", log10(LIGHT_TEXELS as f64 / 25.0)),
        ("below-least", least),
        ("below-mean", mean),
        ("open-share", 1.0 - mean / 24.0),
    ];
    let mut rows: Vec<PaperRow> = counts.into_iter().map(count).collect::<Result<_, _>>()?;
    let columns = Column::all()?;
    let per_second = |column: &Column, fps: f64| {
        let [clusters, vertices] = column.multiplies();
        (clusters + vertices) * fps
    };
    let host = host_of_table_1().on(HOST)?;
    let rate = 1e9 / host.time_of(HostOperation::MultiplyAdd, 1_000_000_000).seconds();
    let mut table = Table::of(
        "Table 1, from sizes alone",
        "model vertices_thousands raw_printed raw_GB raw_GiB clusters_printed clusters clustered_printed_% clustered_% \
         cluster_M vertex_M fps_printed fps G_per_second",
    );
    for column in &columns {
        let [clusters, vertices] = column.multiplies();
        let fps = rate / (clusters + vertices);
        let total = column.nonempty() / PER_CLUSTER;
        rows.push(equation(&column.figure("fps-alone"), (fps, Dependence::Calibrated { on: RATE }))?);
        let of_print = |what: &str| printed(&column.figure(what));
        table.push([
            column.id.into(),
            Cell::decimals(column.vertices, 1),
            of_print("raw")?.cell(),
            Cell::decimals(column.raw_gigabytes(), 3),
            Cell::decimals(column.raw_gigabytes() * 1e9 / (1u64 << 30) as f64, 3),
            of_print("clusters")?.cell(),
            Cell::decimals(total, 0),
            of_print("clustered")?.cell(),
            Cell::decimals(100.0 * column.clustered(), 2),
            Cell::decimals(1e-6 * clusters, 1),
            Cell::decimals(1e-6 * vertices, 1),
            of_print("fps-alone")?.cell(),
            Cell::measured(fps),
            Cell::measured(1e-9 * per_second(column, of_print("fps-alone")?.value)),
        ]);
    }
    Ok(EntryFindings::new(
        [paragraph(HOW, [number((6 * NORMALS * NORMALS) as f64, 0), number(1e-9 * rate, 2)])],
        rows,
        [QUESTION],
        [table],
    ))
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
