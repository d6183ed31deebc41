//! Frame rates of both tables: if only the view changes, and if the light changes too.

use super::models::{
    BUNNY, CARD, ClusteredModel, DisplayRun, ModelVisibility, PICTURE, PrintedScene, SCENES, display, of_bunny,
};
use super::{
    Contradiction, Dependence, EntryFindings, Method, PaperRow, RunResult, Shared, StudyError, TimedWork, drawn,
    paper_row, paragraph, printed_value, solved,
};
use crate::transfer::{Tangents, Vertices};

const HOW: &str = "The cost of new light is the difference between a scene's two frame times. One constant, {} billion operations per second and \
    channel, is fitted to all transfers of table I; all rates with new light follow from it and from the printed rates with only a new view. The \
    emulated card displays our bunny in {} x {} pixels, in {} passes of {} directions; a pass has {} texture reads and {} other instructions per \
    pixel. The time is modelled from clocks, with texture units at full speed; the paper says that cache misses are decisive.";
const QUESTION: &str = "why the same bunny's view takes a third of the time in table II; how large the models appear in the pictures; how many texture reads missed the caches.";

/// A scene's printed rates in one table.
struct PrintedFrames {
    place: &'static str,
    /// Names of the figures: if only the view changes, and if the light changes too.
    ids: [String; 2],
    /// Frames per second of these figures.
    rates: [f64; 2],
    /// Number of operations per transfer and channel.
    operations: f64,
}

/// Scenes with their tables, and the suffixes of their figures' names.
const FRAMES: [(&PrintedScene, &str, &str); 7] = [
    (&SCENES[0], "table 1", ""),
    (&SCENES[1], "table 1", ""),
    (&SCENES[2], "table 1", ""),
    (&SCENES[3], "table 1", ""),
    (&SCENES[0], "table 2", "-2"),
    (&SCENES[4], "table 2", "-2"),
    (&SCENES[5], "table 2", "-2"),
];
/// Number of these scenes that are in Table I.
const IN_TABLE_1: usize = 4;

impl PrintedFrames {
    fn all() -> Result<Vec<Self>, StudyError> {
        let frames = |&(scene, place, ending): &(&'static PrintedScene, &'static str, &str)| {
            let ids = ["view", "light"].map(|what| format!("{}{ending}", scene.figure(what)));
            let rates = [printed_value(&ids[0])?, printed_value(&ids[1])?];
            Ok(Self { place, ids, rates, operations: 1e6 * scene.printed("operations-after")?.value })
        };
        FRAMES.iter().map(frames).collect()
    }

    fn transfer(&self) -> f64 {
        let [view, light] = self.rates;
        1.0 / light - 1.0 / view
    }
}

/// Operations per second over all transfers of Table I.
fn constant(printed: &[PrintedFrames]) -> f64 {
    let all = &printed[..IN_TABLE_1];
    all.iter().map(|frames| frames.operations).sum::<f64>() / all.iter().map(PrintedFrames::transfer).sum::<f64>()
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let printed = PrintedFrames::all()?;
    let constant = constant(&printed);
    let bunny = shared.get::<ModelVisibility>(BUNNY)?;
    let run = display((&bunny.mesh, &bunny.vertices), SCENES[0].side, of_bunny(PICTURE)?)?;
    let light = printed.iter().enumerate().map(|(at, frames)| light_row(frames, at < IN_TABLE_1, constant));
    let mut rows: Vec<PaperRow> = light.collect::<Result<_, _>>()?;
    rows.extend(view_rows(&printed, &run)?);
    rows.extend(sentences(shared, &run, printed[0].operations / constant)?);
    let [reads, others] = run.counts.pixel_slots;
    let [width, height] = PICTURE;
    let (passes, directions) = (run.counts.passes, run.counts.directions_per_pass);
    let how = paragraph(HOW, &[&(1e-9 * constant, 2), &width, &height, &passes, &directions, &reads, &others]);
    Ok(EntryFindings::new([how], rows, [QUESTION], []))
}

pub(in crate::study::reproduce) fn timed() -> Result<TimedWork, StudyError> {
    let mesh = BUNNY.mesh(1);
    let vertices = Vertices::new(&mesh, Tangents::Texture).on(CARD)?;
    let run = display((&mesh, &vertices), SCENES[0].side, of_bunny(PICTURE)?)?;
    TimedWork::new("bi-scale/view-bunny", CARD, run.time.frame)
}

fn light_row(frames: &PrintedFrames, is_of_table_1: bool, constant: f64) -> Result<PaperRow, StudyError> {
    let dependence = if is_of_table_1 {
        Dependence::Calibrated { on: "rates of table I" }
    } else {
        Dependence::Predicted { from: "rates of table I, operations, rates with only a new view" }
    };
    let ours = 1.0 / (1.0 / frames.rates[0] + frames.operations / constant);
    paper_row(&frames.ids[1], (CARD, Method::Equation), (ours, dependence))
}

/// Rows for the view rates of the small bunny, on which the paper's two tables disagree.
fn view_rows(all: &[PrintedFrames], run: &DisplayRun) -> Result<Vec<PaperRow>, StudyError> {
    let [one, two] = [&all[0], &all[IN_TABLE_1]];
    let row = |(frames, other): (&PrintedFrames, &PrintedFrames)| {
        let row = drawn(&frames.ids[0], CARD, run.time.per_second())?;
        let how = format!("the same bunny on the same card in {}", other.place);
        let contradiction = Contradiction::between(&row.target, other.rates[0], &how);
        Ok(row.contradicted(contradiction))
    };
    [(one, two), (two, one)].into_iter().map(row).collect()
}

/// Rows for "roughly comparable", and for the dominant cost.
fn sentences(shared: &Shared, run: &DisplayRun, transfer: f64) -> Result<[PaperRow; 2], StudyError> {
    let from = Dependence::Predicted { from: "rates of table I, operations" };
    let comparable = (transfer / run.time.frame.seconds(), from);
    let clustered = shared.get::<ClusteredModel>(BUNNY)?;
    let biclusters = &clustered.biclusters;
    let gathered = biclusters.row_entries() as f64;
    let share = 100.0 * gathered / (gathered + 2.0 * biclusters.column_entries() as f64);
    Ok([paper_row("bi-scale/comparable", (CARD, Method::Pipeline), comparable)?, solved("gathering", share)?])
}
