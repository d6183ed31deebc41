//! Table 1 from compressed models: remaining size after clustering and after coding of transfer.

use serde::{Deserialize, Serialize};

use super::models::{
    CompressedModel, ModelVisibility, SAMPLED_SEGMENTS, SeenModel, TableMaterial, TableModel, ground_side,
};
use super::segments::{ABSOLUTE, BITS, CODINGS};
use super::{Dependence, EntryFindings, PaperRow, Shared, StudyError, ends, paragraph, solved};
use crate::all_frequency::Reflectance;
use crate::all_frequency::compressed::SegmentOptions;
use crate::report::{Cell, Table};
use crate::scene::built::ground::GROUND_SIDE;
use crate::transfer::grid::{LIGHT_TEXELS, Segmentation};

use TableMaterial::{Cook, Diffuse, Schlick};
use TableModel::{Buddha, Bunny, Teapot, Tweety};

/// Columns of Table 1: name of the column and of the model in figure names, the model, and its material.
const TABLE_1: [(&str, &str, TableModel, TableMaterial); 6] = [
    ("bunny", "bunny", Bunny, Cook),
    ("teapot", "teapot", Teapot, Schlick),
    ("tweety-diffuse", "tweety", Tweety, Diffuse),
    ("tweety-glossy", "tweety", Tweety, Schlick),
    ("buddha-diffuse", "buddha", Buddha, Diffuse),
    ("buddha-glossy", "buddha", Buddha, Cook),
];
/// Figures of a column, as in figure names; the first belongs to the model, and is listed once for both materials.
const FIGURES: [&str; 5] = ["omega", "clustered", "coded", "size", "error"];

/// Figure to which the shape of a stand-in was fitted.
const SHAPED: &str = "omega-buddha";

const HOW: &str = "The teapot, the coarsened Stanford bunny, and stand-ins of {} to {} vertices for the other models, with the paper's two \
    reflectances in the textbook form, are compressed with clusters of {} vertices and {} representatives, which are added one by one, and coded in \
    {} bits. Only {} of the segments are compressed, a quarter of a face at the side, above and below; they represent the others, weighted by the \
    vertices that hold each segment. Omega and the ground use all segments. Sizes count representatives and weights; squared errors are of decoded \
    transfer, relative to its sum of squares.";
const GROUND: &str = "By one paragraph of section 7, a ground plane is \"in all examples\", and Table 1's performance is without it. So rows use \
    models by themselves; their ranges include the same models on a ground of {} x {} vertices, which blocks the light from below. The ground's own \
    transfer is from the bunny's scene, scaled to the printed vertices.";
const RANGE: &str = "The text does not state the range of its {} bits either. The ranges of rows include the range of each representative and of \
    each segment, absolute steps if weights are about one, and sizes with headers. No reading was chosen: a row holds if all of them do. Of the {} \
    sizes after coding, the best absolute step meets {} on models by themselves, {} on a ground.";
const QUESTION: &str = "the models; the range of the quantised numbers, which decides how many of them vanish; whether \
    the printed squared error is from before coding or after it; whether the ground shadows the models of Table 1.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let (runs, ground) = computed(shared)?;
    let figures = figures();
    let stated = values(&runs[0], 0, false);
    let mut rows: Vec<PaperRow> = Vec::new();
    for (at, name) in &figures {
        let others = runs.iter().flat_map(|run| readings(run)).map(|values| values[*at]);
        let mut row = solved(name, stated[*at])?.with_readings(others);
        if name == SHAPED {
            row.dependence = Dependence::Calibrated { on: "this figure, which determined the Buddha's coat" };
        }
        rows.push(row);
    }
    let met = runs.each_ref().map(|run| most_met(run, &figures, &rows));
    rows.extend(ground.rows()?);
    let [found, on_ground] = &runs;
    let total = |bytes: fn(&CompressedModel) -> f64| found.iter().map(bytes).sum::<f64>();
    rows.push(solved("ratio-haar", total(|model| model.raw) / total(CompressedModel::haar))?);
    let [least, most] = ends(found.iter().map(|model| model.vertices as f64));
    let SegmentOptions { points_per_cluster, vectors, .. } = SegmentOptions::default();
    let (bits, side) = (u32::from(BITS), ground_side(shared.models));
    let how = paragraph(HOW, &[&least, &most, &points_per_cluster, &vectors, &bits, &SAMPLED_SEGMENTS.len()]);
    Ok(EntryFindings::new(
        [how, paragraph(GROUND, &[&side, &side]), paragraph(RANGE, &[&bits, &TABLE_1.len(), &met[0], &met[1]])],
        rows,
        [QUESTION],
        [
            table("models by themselves", found),
            table("models on a ground", on_ground),
            by_representatives(found),
            by_segment(found),
        ],
    ))
}

/// The columns without and with a ground, and the ground of the bunny's scene.
fn computed(shared: &Shared) -> Result<([Vec<CompressedModel>; 2], CompressedGround), StudyError> {
    let (diffuse, cook, schlick) = (Diffuse.reflectance()?, Cook.reflectance()?, Schlick.reflectance()?);
    let mut runs = [Vec::new(), Vec::new()];
    let ground = shared.piece("ground", || CompressedGround::new(Bunny, &diffuse, shared))?;
    let mut seen = SeenModel::new(Bunny, shared.models);
    for (column, _, model, material) in TABLE_1 {
        if seen.model != model {
            seen = SeenModel::new(model, shared.models);
        }
        let reflectance = match material {
            Diffuse => &diffuse,
            Cook => &cook,
            Schlick => &schlick,
        };
        for (on_ground, run) in [(false, "alone"), (true, "on-ground")] {
            let name = format!("{column}-{run}");
            let compress = || seen.get(on_ground)?.compressed(reflectance, SAMPLED_SEGMENTS, (shared, &name));
            runs[usize::from(on_ground)].push(shared.piece(&name, compress)?);
        }
    }
    Ok((runs, ground))
}

/// The ground of section 7: "the raw data was about 715MB which compressed down to 23.6MB".
#[derive(Serialize, Deserialize)]
struct CompressedGround {
    /// Fraction of the ground's segments with nonzero transfer.
    omega: f64,
    /// Ratio of coded to raw bytes, per coding.
    left: Vec<f64>,
}

impl CompressedGround {
    /// The ground below a model.
    fn new(model: TableModel, diffuse: &Reflectance, shared: &Shared) -> Result<Self, StudyError> {
        let ground = ModelVisibility::on_ground(model, true, shared.models)?;
        let found = ground.compressed(diffuse, 0..Segmentation::Quarters.count(), (shared, "ground"))?;
        Ok(Self {
            omega: found.omega,
            left: (0..CODINGS).map(|coding| found.coded(coding, false) / found.raw).collect(),
        })
    }

    /// Rows for raw and coded data with the printed number of vertices. The value counts all segments, as Table 1 does,
    /// in units of 10^6 bytes; the other readings count only segments with transfer, or use units of 2^20 bytes.
    fn rows(&self) -> Result<[PaperRow; 2], StudyError> {
        let raw = 4.0 * f64::from(GROUND_SIDE * GROUND_SIDE) * LIGHT_TEXELS as f64;
        let units = |bytes: f64| [1e-6 * bytes, bytes / f64::from(1 << 20)];
        let [all, held] = [units(raw), units(raw * self.omega)];
        let coded: Vec<f64> = self.left.iter().flat_map(|share| units(raw * share)).collect();
        Ok([
            solved("raw-ground", all[0])?.with_readings([all[1], held[0], held[1]]),
            solved("coded-ground", coded[0])?.with_readings(coded[1..].iter().copied()),
        ])
    }
}

/// Values of the rows for each reading of "16 bits": one list per coding, then one with headers.
fn readings(found: &[CompressedModel]) -> Vec<Vec<f64>> {
    (0..CODINGS).map(|at| values(found, at, false)).chain([values(found, 0, true)]).collect()
}

/// Maximum number of printed coded sizes that a single absolute step meets.
fn most_met(found: &[CompressedModel], figures: &[(usize, String)], rows: &[PaperRow]) -> usize {
    let of_coding = || figures.iter().zip(rows).filter(|((_, name), _)| name.starts_with("coded-"));
    let met = |coding: usize| {
        let values = values(found, coding, false);
        of_coding().filter(|((figure, _), row)| row.admits(values[*figure])).count()
    };
    (ABSOLUTE..CODINGS).map(met).max().unwrap_or(0)
}

/// Values of the rows: five for each column, then the smallest and the largest ratio.
fn values(found: &[CompressedModel], coding: usize, headers: bool) -> Vec<f64> {
    let bytes = |model: &CompressedModel| model.coded(coding, headers);
    let of_model = |model: &CompressedModel| {
        let (bytes, clustered) = (bytes(model), model.clustered());
        let shares = [model.omega, clustered / model.raw, bytes / clustered, bytes / model.raw];
        shares.into_iter().chain([model.squared_error(coding)]).map(|share| 100.0 * share).collect::<Vec<_>>()
    };
    let extremes = ends(found.iter().map(|model| model.raw / bytes(model)));
    found.iter().flat_map(of_model).chain(extremes).collect()
}

/// Figures of [`values`], each once: index there, and name.
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

fn table(name: &str, columns: &[CompressedModel]) -> Table {
    let mut table = Table::of(
        format!("Table 1, by compressing {name}"),
        "model vertices omega_% clusters raw_MB clustered_MB coded_MB with_headers_MB squared_error_% ratio",
    );
    for ((column, ..), model) in TABLE_1.iter().zip(columns) {
        let megabytes = |bytes: f64| Cell::measured(1e-6 * bytes);
        table.push([
            (*column).into(),
            model.vertices.into(),
            Cell::decimals(100.0 * model.omega, 1),
            model.clusters().into(),
            megabytes(model.raw),
            megabytes(model.clustered()),
            megabytes(model.coded(0, false)),
            megabytes(model.coded(0, true)),
            Cell::measured(100.0 * model.squared_error(0)),
            Cell::measured(model.raw / model.coded(0, false)),
        ]);
    }
    table
}

/// Table of the data of Figure 5.
fn by_representatives(found: &[CompressedModel]) -> Table {
    let counts = found[0].error_of().map(|(vectors, _)| format!("n={vectors}"));
    let headings: Vec<String> = ["model".to_owned()].into_iter().chain(counts).collect();
    let mut table = Table::new("Squared error before coding, %, by number of representatives", &headings);
    for ((column, ..), model) in TABLE_1.iter().zip(found) {
        let errors = model.error_of().map(|(_, error)| Cell::measured(100.0 * error));
        table.push([(*column).into()].into_iter().chain(errors));
    }
    table
}

fn by_segment(found: &[CompressedModel]) -> Table {
    let headings = SAMPLED_SEGMENTS.iter().flat_map(|segment| [format!("coded_{segment}"), format!("error_{segment}")]);
    let headings: Vec<String> = ["model".to_owned()].into_iter().chain(headings).collect();
    let mut table =
        Table::new("Size after coding over size after clustering, and squared error, %, by segment", &headings);
    for ((column, ..), model) in TABLE_1.iter().zip(found) {
        let of_segment = |segment: &usize| {
            let found = model.segments.iter().find(|(known, _)| known == segment);
            found.map_or([f64::NAN; 2], |(_, sums)| sums.shares()).map(|share| Cell::measured(100.0 * share))
        };
        table.push([(*column).into()].into_iter().chain(SAMPLED_SEGMENTS.iter().flat_map(of_segment)));
    }
    table
}
