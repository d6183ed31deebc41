//! Table 1 by compressing models: remaining size after clustering and coding of transfer.

use super::models::{CODINGS, CompressedModel, HAAR_BITS, ModelVisibility, TableMaterial, TableModel};
use super::{
    Bound, EntryFindings, HOST, Method, PaperFigure, PaperRow, Prose, ReproduceError, Setting, Shared, Standing, Sweep,
    number,
};
use crate::all_frequency::code::CodeOptions;
use crate::all_frequency::compressed::SegmentOptions;
use crate::report::{Cell, Table};

use TableMaterial::{Cook, Diffuse, Schlick};
use TableModel::{Buddha, Bunny, Teapot, Tweety};

/// Column of the table: omega, size after clustering, relative size after coding, both together, and the squared error,
/// in % with the digits after the point.
struct Column {
    name: &'static str,
    model: TableModel,
    material: TableMaterial,
    percent: [(f64, u8); 5],
}

const fn column(name: &'static str, (model, material): (TableModel, TableMaterial), percent: [(f64, u8); 5]) -> Column {
    Column { name, model, material, percent }
}

const TABLE_1: [Column; 6] = [
    column("bunny", (Bunny, Cook), [(56.0, 1), (4.43, 2), (29.5, 1), (1.31, 2), (0.20, 2)]),
    column("teapot", (Teapot, Schlick), [(61.8, 1), (5.36, 2), (31.2, 1), (1.67, 2), (0.051, 3)]),
    column("tweety, diffuse", (Tweety, Diffuse), [(57.6, 1), (8.16, 2), (50.0, 1), (4.17, 2), (0.02, 2)]),
    column("tweety, glossy", (Tweety, Schlick), [(57.6, 1), (4.85, 2), (30.4, 1), (1.42, 2), (0.79, 2)]),
    column("Buddha, diffuse", (Buddha, Diffuse), [(42.4, 1), (6.23, 2), (54.5, 1), (3.39, 2), (0.11, 2)]),
    column("Buddha, glossy", (Buddha, Cook), [(42.4, 1), (3.65, 2), (32.2, 1), (1.19, 2), (0.0063, 4)]),
];
const WHAT: [&str; 5] = ["omega", "size after clustering", "size after coding, of that", "size", "squared error"];

const HOW: &str = "The teapot and stand-ins of {} to {} vertices for the other models, with the paper's two reflectances in the textbooks' form, are \
    compressed by clusters of {} vertices and {} representatives, which are added one by one, and coded in {} bits: {} of the segments. \
    Omega is that of all segments. Sizes are those of representatives and weights; squared errors are those of decoded transfer, as a share of its squares.";
const QUESTION: &str = "the models; of what range the quantised numbers are a share, which decides how many of them vanish; whether the printed squared error is that before coding or after it.";
const OPEN: &str = "what coding leaves open";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let mut found: Vec<CompressedModel> = Vec::new();
    let mut seen: Option<(TableModel, ModelVisibility)> = None;
    let (diffuse, cook, schlick) = (Diffuse.reflectance()?, Cook.reflectance()?, Schlick.reflectance()?);
    for column in &TABLE_1 {
        let model = match seen.take() {
            Some((model, seen)) if model == column.model => seen,
            _ => ModelVisibility::new(column.model, shared.models)?,
        };
        let reflectance = match column.material {
            Diffuse => &diffuse,
            Cook => &cook,
            Schlick => &schlick,
        };
        found.push(model.compressed(reflectance)?);
        seen = Some((column.model, model));
    }
    let codings = CODINGS.iter().enumerate().map(|(coding, how)| (how.name, coding, false));
    let setting = |(at, coding, headers): (&str, usize, bool)| Setting {
        at: at.to_owned(),
        values: values(&found, coding, headers),
    };
    let settings = codings.chain([("16_bits_and_headers", 0, true)]).map(setting).collect();
    let sweep = Sweep { name: OPEN, parameter: "coding", settings };
    let mut rows = rows(&sweep.settings[0].values);
    sweep.explain(&mut rows);
    let mut tables = vec![table(&found), sweep.table("Rows by what coding leaves open", &rows, (None, |value| value))];
    let bits = haar(&found);
    rows.push(bits.0);
    tables.extend([bits.1, by_representatives(&found)]);
    let counts = || found.iter().map(|model| model.vertices as f64);
    let options = SegmentOptions::default();
    let figures = [
        number(counts().fold(f64::INFINITY, f64::min), 0),
        number(counts().fold(0.0, f64::max), 0),
        number(options.points_per_cluster as f64, 0),
        number(options.vectors as f64, 0),
        number(f64::from(CodeOptions::default().weight_bits), 0),
        number(found[0].segments as f64, 0),
    ];
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, figures)],
        rows,
        questions: vec![QUESTION],
        tables,
        ..EntryFindings::default()
    })
}

/// Values of the rows: five for each column, then the smallest and the largest ratio.
fn values(found: &[CompressedModel], coding: usize, headers: bool) -> Vec<f64> {
    let bytes = |model: &CompressedModel| {
        let coded = &model.coded[coding];
        coded.numbers + if headers { coded.headers } else { 0.0 }
    };
    let of_model = |model: &CompressedModel| {
        let bytes = bytes(model);
        let shares = [model.omega, model.clustered / model.raw, bytes / model.clustered, bytes / model.raw];
        shares.into_iter().chain([model.coded[coding].squared_error]).map(|share| 100.0 * share).collect::<Vec<_>>()
    };
    let ratios = || found.iter().map(|model| model.raw / bytes(model));
    let extremes = [ratios().fold(f64::INFINITY, f64::min), ratios().fold(0.0, f64::max)];
    found.iter().flat_map(of_model).chain(extremes).collect()
}

fn rows(values: &[f64]) -> Vec<PaperRow> {
    let row = |what: String, target: PaperFigure, &ours: &f64| {
        PaperRow::new(what, (HOST, Method::Solver), target, (ours, Standing::Counted), Bound::PREDICTION)
    };
    let mut targets = Vec::new();
    for column in &TABLE_1 {
        for (what, (printed, decimals)) in WHAT.into_iter().zip(column.percent) {
            targets.push((format!("{}: {what}", column.name), PaperFigure::printed(printed, decimals, "%", "table 1")));
        }
    }
    for (what, printed) in [("least", 24.0), ("largest", 84.0)] {
        targets.push((format!("{what} ratio of compression"), PaperFigure::printed(printed, 0, "times", "section 7")));
    }
    targets.into_iter().zip(values).map(|((what, target), ours)| row(what, target, ours)).collect()
}

/// Row of "roughly a factor of 10" without clusters, explained by the number of bits, which is not printed.
fn haar(found: &[CompressedModel]) -> (PaperRow, Table) {
    let raw: f64 = found.iter().map(|model| model.raw).sum();
    let factor = |at: usize| raw / found.iter().map(|model| model.haar[at]).sum::<f64>();
    let target = PaperFigure::printed(10.0, 0, "times", "section 4");
    let standing = (factor(0), Standing::Counted);
    let what = "ratio of compression by Haar coefficients alone";
    let mut rows = [PaperRow::new(what, (HOST, Method::Solver), target, standing, Bound::PREDICTION)];
    let settings = HAAR_BITS.iter().enumerate();
    let settings = settings.map(|(at, bits)| Setting { at: bits.to_string(), values: vec![factor(at)] });
    let sweep =
        Sweep { name: "bits of Haar coefficients without clusters", parameter: "bits", settings: settings.collect() };
    sweep.explain(&mut rows);
    let table = sweep.table("Haar coefficients without clusters", &rows, (None, |value| value));
    let [row] = rows;
    (row, table)
}

fn table(found: &[CompressedModel]) -> Table {
    let mut table = Table::of(
        "Table 1, by compressing models",
        "model vertices omega_% clusters raw_MB clustered_MB coded_MB with_headers_MB squared_error_% ratio",
    );
    for (column, model) in TABLE_1.iter().zip(found) {
        let coded = &model.coded[0];
        let megabytes = |bytes: f64| Cell::measured(1e-6 * bytes);
        table.push([
            column.name.into(),
            model.vertices.into(),
            Cell::decimals(100.0 * model.omega, 1),
            model.clusters.into(),
            megabytes(model.raw),
            megabytes(model.clustered),
            megabytes(coded.numbers),
            megabytes(coded.numbers + coded.headers),
            Cell::measured(100.0 * coded.squared_error),
            Cell::measured(model.raw / coded.numbers),
        ]);
    }
    table
}

/// Table of the data of Figure 5.
fn by_representatives(found: &[CompressedModel]) -> Table {
    let counts: Vec<usize> = found[0].error_of.iter().map(|(vectors, _)| *vectors).collect();
    let headings: Vec<String> =
        ["model".to_owned()].into_iter().chain(counts.iter().map(|n| format!("n={n}"))).collect();
    let mut table = Table::new("Squared error before coding, %, by the number of representatives", &headings);
    for (column, model) in TABLE_1.iter().zip(found) {
        let errors = model.error_of.iter().map(|(_, error)| Cell::measured(100.0 * error));
        table.push([column.name.into()].into_iter().chain(errors));
    }
    table
}
