//! Table 1 by compressing models: remaining size after clustering and coding of transfer.

use super::models::{CODINGS, CompressedModel, HAAR_BITS, ModelVisibility, TableMaterial, TableModel};
use super::{EntryFindings, PaperRow, Prose, ReproduceError, Setting, Shared, Sweep, number, solved};
use crate::all_frequency::code::CodeOptions;
use crate::all_frequency::compressed::SegmentOptions;
use crate::report::{Cell, Table};

use TableMaterial::{Cook, Diffuse, Schlick};
use TableModel::{Buddha, Bunny, Teapot, Tweety};

/// Columns: the column's and the model's name in the names of figures, the model and its material.
const TABLE_1: [(&str, &str, TableModel, TableMaterial); 6] = [
    ("bunny", "bunny", Bunny, Cook),
    ("teapot", "teapot", Teapot, Schlick),
    ("tweety-diffuse", "tweety", Tweety, Diffuse),
    ("tweety-glossy", "tweety", Tweety, Schlick),
    ("buddha-diffuse", "buddha", Buddha, Diffuse),
    ("buddha-glossy", "buddha", Buddha, Cook),
];
/// Figures of a column, in the names of figures; the first is of the model, and stands once for both its materials.
const FIGURES: [&str; 5] = ["omega", "clustered", "coded", "size", "error"];

const HOW: &str = "The teapot and stand-ins of {} to {} vertices for the other models, with the paper's two reflectances in the textbooks' form, are \
    compressed by clusters of {} vertices and {} representatives, which are added one by one, and coded in {} bits: {} of the segments. \
    Omega is that of all segments. Sizes are those of representatives and weights; squared errors are those of decoded transfer, as a share of its squares.";
const QUESTION: &str = "the models; of what range the quantised numbers are a share, which decides how many of them vanish; whether the printed squared error is that before coding or after it.";
/// Bits of a representative's numbers: "16 bits rather than 8".
const PRINTED_BITS: u8 = 16;
const OPEN: &str = "what coding leaves open";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let mut found: Vec<CompressedModel> = Vec::new();
    let mut seen: Option<(TableModel, ModelVisibility)> = None;
    let (diffuse, cook, schlick) = (Diffuse.reflectance()?, Cook.reflectance()?, Schlick.reflectance()?);
    for (_, _, model, material) in TABLE_1 {
        let visibility = match seen.take() {
            Some((last, seen)) if last == model => seen,
            _ => ModelVisibility::new(model, shared.models)?,
        };
        let reflectance = match material {
            Diffuse => &diffuse,
            Cook => &cook,
            Schlick => &schlick,
        };
        found.push(visibility.compressed(reflectance)?);
        seen = Some((model, visibility));
    }
    let (codings, figures) = (|| CODINGS.iter().enumerate(), figures());
    let setting = |name: &str, coding: usize, headers: bool| {
        let values = values(&found, coding, headers);
        Setting { at: name.to_owned(), values: figures.iter().map(|(at, _)| values[*at]).collect() }
    };
    // The paper has 16 bits: only of what range they are, and whether headers count, is open.
    let open =
        codings().filter(|(_, how)| how.bits == PRINTED_BITS).map(|(coding, how)| setting(how.name, coding, false));
    let settings = open.chain([setting("16_bits_and_headers", 0, true)]).collect();
    let sweep = Sweep { name: OPEN, parameter: "coding", settings };
    let stated = figures.iter().zip(&sweep.settings[0].values);
    let mut rows: Vec<PaperRow> = stated.map(|((_, name), &ours)| solved(name, ours)).collect::<Result<_, _>>()?;
    sweep.explain(&mut rows);
    let all = codings().map(|(coding, how)| setting(how.name, coding, false));
    let all = all.chain([setting("16_bits_and_headers", 0, true)]).collect();
    let all = Sweep { name: OPEN, parameter: "coding", settings: all };
    let mut tables =
        vec![table(&found), all.table("Rows by coding; the paper has 16 bits", &rows, (None, |value| value))];
    let bits = haar(&found)?;
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

/// Figures of [`values`], each once: its place there, and its name.
fn figures() -> Vec<(usize, String)> {
    let of_column = |&(column, model, ..): &(&'static str, &'static str, _, _)| {
        FIGURES.map(|figure| format!("{figure}-{}", if figure == "omega" { model } else { column }))
    };
    let all = TABLE_1.iter().flat_map(of_column).chain(["ratio-least", "ratio-largest"].map(str::to_owned));
    let mut found: Vec<(usize, String)> = Vec::new();
    for (at, name) in all.enumerate() {
        if !found.iter().any(|(_, known)| *known == name) {
            found.push((at, name));
        }
    }
    found
}

/// Row of "roughly a factor of 10" without clusters, explained by the number of bits, which is not printed.
fn haar(found: &[CompressedModel]) -> Result<(PaperRow, Table), ReproduceError> {
    let raw: f64 = found.iter().map(|model| model.raw).sum();
    let factor = |at: usize| raw / found.iter().map(|model| model.haar[at]).sum::<f64>();
    let mut rows = [solved("ratio-haar", factor(0))?];
    let settings = HAAR_BITS.iter().enumerate();
    let settings = settings.map(|(at, bits)| Setting { at: bits.to_string(), values: vec![factor(at)] });
    let sweep =
        Sweep { name: "bits of Haar coefficients without clusters", parameter: "bits", settings: settings.collect() };
    sweep.explain(&mut rows);
    let table = sweep.table("Haar coefficients without clusters", &rows, (None, |value| value));
    let [row] = rows;
    Ok((row, table))
}

fn table(found: &[CompressedModel]) -> Table {
    let mut table = Table::of(
        "Table 1, by compressing models",
        "model vertices omega_% clusters raw_MB clustered_MB coded_MB with_headers_MB squared_error_% ratio",
    );
    for ((column, ..), model) in TABLE_1.iter().zip(found) {
        let coded = &model.coded[0];
        let megabytes = |bytes: f64| Cell::measured(1e-6 * bytes);
        table.push([
            (*column).into(),
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
    for ((column, ..), model) in TABLE_1.iter().zip(found) {
        let errors = model.error_of.iter().map(|(_, error)| Cell::measured(100.0 * error));
        table.push([(*column).into()].into_iter().chain(errors));
    }
    table
}
