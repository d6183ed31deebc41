//! Sections 1, 4, 5 and 6, and the columns of Table 1: values that follow from sizes and from the geometry of the cube.

use super::{Bound, EntryFindings, HOST, Method, PaperFigure, PaperRow, Prose, Standing, number};
use crate::elementary::log10;
use crate::linalg::dot;
use crate::report::{Cell, Table};
use crate::sphere::CubeMap;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};
use crate::transfer::hats::{HatWidth, Hats};
use crate::transfer::visibility::segments_below_horizon;

/// Rows of a glossy transfer matrix, representatives per cluster, and target vertices per cluster.
const M: usize = 10;
const N: usize = 16;
const PER_CLUSTER: f64 = 200.0;
/// Texels along an edge of the cube map whose texel centers are the normals for counting segments.
const NORMALS: usize = 48;

/// Column of Table 1.
struct Column {
    name: &'static str,
    rows: usize,
    /// Number of vertices, in thousands.
    vertices: f64,
    /// Raw size in decimal gigabytes, with its printed digits.
    raw: (f64, u8),
    omega: f64,
    clusters: f64,
    /// Size after clustering, in %.
    clustered: f64,
    /// Frames per second with and without drawing, the latter with its digits.
    fps: (f64, f64, u8),
}

const TABLE_1: [Column; 6] = [
    Column {
        name: "bunny",
        rows: M,
        vertices: 11.5,
        raw: (2.83, 2),
        omega: 0.560,
        clusters: 763.0,
        clustered: 4.43,
        fps: (5.0, 6.2, 1),
    },
    Column {
        name: "teapot",
        rows: M,
        vertices: 51.3,
        raw: (11.7, 1),
        omega: 0.618,
        clusters: 3801.0,
        clustered: 5.36,
        fps: (1.2, 1.3, 1),
    },
    Column {
        name: "tweety, diffuse",
        rows: 1,
        vertices: 32.8,
        raw: (0.768, 3),
        omega: 0.576,
        clusters: 2260.0,
        clustered: 8.16,
        fps: (8.4, 14.0, 0),
    },
    Column {
        name: "tweety, glossy",
        rows: M,
        vertices: 32.8,
        raw: (7.68, 2),
        omega: 0.576,
        clusters: 2263.0,
        clustered: 4.85,
        fps: (1.7, 1.8, 1),
    },
    Column {
        name: "Buddha, diffuse",
        rows: 1,
        vertices: 54.1,
        raw: (1.24, 2),
        omega: 0.424,
        clusters: 2739.0,
        clustered: 6.23,
        fps: (6.6, 9.4, 1),
    },
    Column {
        name: "Buddha, glossy",
        rows: M,
        vertices: 54.1,
        raw: (12.4, 1),
        omega: 0.424,
        clusters: 2740.0,
        clustered: 3.65,
        fps: (1.1, 1.2, 1),
    },
];

impl Column {
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

    /// Size after clustering relative to the raw one: omega / r.
    fn clustered(&self) -> f64 {
        self.omega / ratio(self.nonempty() / self.clusters, self.segment_numbers())
    }

    /// Multiplications per frame by clusters, by dense representatives, and by vertices.
    fn multiplies(&self) -> [f64; 2] {
        let clusters = self.clusters * N as f64 * self.segment_numbers() * 3.0;
        [clusters, self.nonempty() * (N * self.rows * 3) as f64]
    }
}

/// Equation 12: ratio of uncompressed to compressed size of a cluster.
fn ratio(members: f64, numbers: f64) -> f64 {
    members * numbers / (N as f64 * (members + numbers))
}

const HOW: &str = "Nothing is run: sizes as printed, by equation 12. Segments below the horizon are counted for {} normals spread over the sphere, by fine \
    directions of the segment alone. Frame rates come from one constant, {} G multiplications a second, which the bunny's rate without drawing chose; \
    representatives count as dense, though the paper's are sparse.";
const SECTION_5: &str = "section 5";
const QUESTION: &str = "why fewer multiplications a second fit diffuse models and Buddha: sparse representatives, memory, or the host's share of the loop.";
const RATE: &str = "6.2 fps of the bunny, which chose the constant; printed vertices, omega and clusters";
const SIZES: &str = "printed vertices, omega and clusters";

pub(in crate::study::reproduce) fn findings() -> EntryFindings {
    let glossy = (M * LIGHT_TEXELS) as f64;
    let segment = (M * Segmentation::Quarters.len()) as f64;
    let (least, mean) = below_horizon();
    let example = 16_000.0 * 2.0 / 3.0;
    let members = example / 64.0;
    let equation = |what: &str, (value, decimals, unit, place), found: f64, bound| {
        let target = PaperFigure::printed(value, decimals, unit, place);
        PaperRow::new(what, (HOST, Method::Equation), target, (found, Standing::Counted), bound)
    };
    let count =
        |what: &str, value: f64, place, found| equation(what, (value, 0, "numbers", place), found, Bound::Print);
    let mut rows = vec![
        count("light coefficients", 6144.0, "section 1", LIGHT_TEXELS as f64),
        count("numbers of a raw matrix", 61_440.0, "section 4", glossy),
        count("numbers of a transfer segment", 2560.0, "section 4", segment),
        count("vertices of the ground plane", 36_864.0, "section 7", 192.0 * 192.0),
        equation(
            "times as many numbers as 25 x 25",
            (100.0, 0, "times", "section 1"),
            glossy / 625.0,
            Bound::PREDICTION,
        ),
        equation(
            "orders of magnitude more light coefficients than 25",
            (2.0, 0, "orders", "abstract"),
            log10(LIGHT_TEXELS as f64 / 25.0),
            Bound::AtLeast,
        ),
        equation(
            "vertices with a given segment, of 16,000",
            (10_667.0, 0, "vertices", SECTION_5),
            example,
            Bound::Print,
        ),
        equation("members of a cluster of 64", (167.0, 0, "vertices", SECTION_5), members, Bound::Print),
        equation("compression ratio of these", (9.8, 1, "times", SECTION_5), ratio(members, segment), Bound::Print),
        equation(
            "size left, with empty segments dropped",
            (6.8, 1, "%", SECTION_5),
            100.0 * 2.0 / 3.0 / ratio(members, segment),
            Bound::Print,
        ),
        equation(
            "compression ratio of clusters of 200",
            (11.6, 1, "times", SECTION_5),
            ratio(PER_CLUSTER, segment),
            Bound::Print,
        ),
        equation("segments below the horizon, at least", (4.0, 0, "segments", SECTION_5), least, Bound::AtLeast),
        equation("segments below the horizon, on average", (8.0, 0, "segments", SECTION_5), mean, Bound::PREDICTION),
        equation(
            "share of vertices with a given segment, without shadows",
            (0.67, 2, "", SECTION_5),
            1.0 - mean / 24.0,
            Bound::PREDICTION,
        ),
        equation(
            "multiplications per vertex",
            (7680.0, 0, "multiplications", "section 6"),
            2.0 / 3.0 * (24 * N * M * 3) as f64,
            Bound::Print,
        ),
    ];
    let first = TABLE_1[0].multiplies();
    let rate = (first[0] + first[1]) * TABLE_1[0].fps.1;
    let mut table = Table::of(
        "Table 1, by sizes alone",
        "model vertices_thousands raw_printed raw_GB raw_GiB clusters_printed clusters clustered_printed_% clustered_% \
         cluster_M vertex_M fps_printed fps G_per_second",
    );
    for (at, column) in TABLE_1.iter().enumerate() {
        let [clusters, vertices] = column.multiplies();
        let fps = rate / (clusters + vertices);
        let row = |what: &str, (value, decimals, unit), found, from| {
            let target = PaperFigure::printed(value, decimals, unit, "table 1");
            let name = format!("{}: {what}", column.name);
            PaperRow::new(
                name,
                (HOST, Method::Equation),
                target,
                (found, Standing::Predicted { from }),
                Bound::PREDICTION,
            )
        };
        let (raw, digits) = column.raw;
        rows.push(row("raw data", (raw, digits, "GB"), column.raw_gigabytes(), "printed vertices"));
        let total = column.nonempty() / PER_CLUSTER;
        rows.push(row("clusters", (column.clusters, 0, "clusters"), total, "printed vertices and omega"));
        rows.push(row("size after clustering", (column.clustered, 2, "%"), 100.0 * column.clustered(), SIZES));
        if at > 0 {
            rows.push(row("frames per second without drawing", (column.fps.1, column.fps.2, "fps"), fps, RATE));
        }
        table.push([
            column.name.into(),
            Cell::decimals(column.vertices, 1),
            Cell::decimals(raw, digits),
            Cell::decimals(column.raw_gigabytes(), 3),
            Cell::decimals(column.raw_gigabytes() * 1e9 / (1u64 << 30) as f64, 3),
            Cell::decimals(column.clusters, 0),
            Cell::decimals(total, 0),
            Cell::decimals(column.clustered, 2),
            Cell::decimals(100.0 * column.clustered(), 2),
            Cell::decimals(1e-6 * clusters, 1),
            Cell::decimals(1e-6 * vertices, 1),
            Cell::decimals(column.fps.1, column.fps.2),
            Cell::measured(fps),
            Cell::measured(1e-9 * (clusters + vertices) * column.fps.1),
        ]);
    }
    EntryFindings {
        text: vec![Prose::new(HOW, [number((6 * NORMALS * NORMALS) as f64, 0), number(1e-9 * rate, 2)])],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        ..EntryFindings::default()
    }
}

/// Minimum number of segments below the horizon of a normal, and the mean over all directions.
fn below_horizon() -> (f64, f64) {
    let (hats, map) = (Hats::new(HatWidth::OneTexel), CubeMap::new(NORMALS));
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the text that other entries use or that are computed by hand.
    #[test]
    fn sizes_are_those_of_equation_12() {
        assert!((ratio(200.0, 2560.0) - 11.594).abs() < 1e-3);
        let [clusters, vertices] = TABLE_1[0].multiplies().map(|count| count / 3e6);
        assert!((clusters - 31.25).abs() < 0.01 && (vertices - 24.73).abs() < 0.01, "{clusters} {vertices}");
        assert!((TABLE_1[1].raw_gigabytes() - 12.607).abs() < 1e-3);
    }

    #[test]
    fn as_many_segments_are_below_as_the_laws_say() {
        let (least, mean) = below_horizon();
        assert!(least == 6.0 && (mean - 6.70).abs() < 0.03, "{least}, {mean}");
    }
}
