//! Frame rates of both tables: with only the view changing, and with changing light too.

use super::display::{CARD, DisplayRun, display};
use super::printed::{PrintedScene, SCENES};
use super::{
    Bound, EntryFindings, Method, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Shared, Standing, number,
};
use crate::report::{Cell, Table};

const HOW: &str = "What light costs is the difference of a scene's two rates. One constant, {} billion operations a second and channel, is what the \
    transfers of table I take together; with it and the printed rates for views alone all rates for light are computed. The display is that of the emulated card: \
    our bunny in {} x {} pixels, {} passes of {} directions, {} texture reads and {} other instructions in each pixel of a pass. Its time is modelled by clocks and takes \
    texture reads to be as fast as the units can be; the paper names cache misses as what decides.";
const QUESTION: &str = "why the same bunny's view takes a third of the time in table II; how large models stand in the pictures; how many reads of textures missed the caches.";
const PICTURE: [u32; 2] = [640, 480];

/// Printed rates of a scene in a table.
struct PrintedFrames {
    scene: &'static PrintedScene,
    place: &'static str,
    /// Frames per second: with only the view changing, and with changing light too.
    rates: [f64; 2],
}

const fn printed(scene: &'static PrintedScene, place: &'static str, rates: [f64; 2]) -> PrintedFrames {
    PrintedFrames { scene, place, rates }
}

const FRAMES: [PrintedFrames; 7] = [
    printed(&SCENES[0], "table 1", [97.0, 56.1]),
    printed(&SCENES[1], "table 1", [42.8, 24.9]),
    printed(&SCENES[2], "table 1", [51.8, 33.7]),
    printed(&SCENES[3], "table 1", [61.1, 34.3]),
    printed(&SCENES[0], "table 2", [277.9, 86.8]),
    printed(&SCENES[4], "table 2", [115.8, 32.3]),
    printed(&SCENES[5], "table 2", [48.5, 11.9]),
];
/// Number of these that are in Table I.
const IN_TABLE_1: usize = 4;

impl PrintedFrames {
    /// Seconds of a transfer.
    fn transfer(&self) -> f64 {
        let [view, light] = self.rates;
        1.0 / light - 1.0 / view
    }

    /// Operations of a transfer, for one channel.
    fn operations(&self) -> f64 {
        1e6 * self.scene.operations[1]
    }

    fn name(&self) -> String {
        format!("{}, {}", self.scene.name, self.place)
    }
}

/// Operations per second over all transfers of Table I.
fn constant() -> f64 {
    let all = &FRAMES[..IN_TABLE_1];
    all.iter().map(PrintedFrames::operations).sum::<f64>() / all.iter().map(PrintedFrames::transfer).sum::<f64>()
}

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let constant = constant();
    let bunny = shared.bi_scale.bunny()?;
    let run = display((&bunny.mesh, &bunny.vertices), SCENES[0].side, PICTURE)?;
    let mut rows: Vec<PaperRow> =
        FRAMES.iter().enumerate().map(|(at, frames)| light_row(frames, at < IN_TABLE_1, constant)).collect();
    rows.extend([&FRAMES[0], &FRAMES[IN_TABLE_1]].map(|frames| view_row(frames, &run)));
    rows.extend(sentences(shared, &run, constant)?);
    let [reads, others] = run.counts.pixel_slots;
    let numbers = [f64::from(PICTURE[0]), f64::from(PICTURE[1]), run.counts.passes as f64].into_iter().chain([
        run.counts.directions_per_pass as f64,
        f64::from(reads),
        f64::from(others),
    ]);
    let values = std::iter::once(number(1e-9 * constant, 2)).chain(numbers.map(|value| number(value, 0)));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, values)],
        rows,
        questions: vec![QUESTION],
        tables: vec![table(constant), of_display(&run)],
        ..EntryFindings::default()
    })
}

fn light_row(frames: &PrintedFrames, is_of_table_1: bool, constant: f64) -> PaperRow {
    let target = PaperFigure::printed(frames.rates[1], 1, "frames/s", frames.place);
    let standing = if is_of_table_1 {
        Standing::Calibrated { on: "rates of table I" }
    } else {
        Standing::Predicted { from: "rates of table I, operations, rates of views" }
    };
    let ours = 1.0 / (1.0 / frames.rates[0] + frames.operations() / constant);
    let what = format!("{}: light changed too", frames.scene.name);
    PaperRow::new(what, (CARD, Method::Equation), target, (ours, standing), Bound::PREDICTION)
}

fn view_row(frames: &PrintedFrames, run: &DisplayRun) -> PaperRow {
    let target = PaperFigure::printed(frames.rates[0], 1, "frames/s", frames.place);
    let standing = Standing::Predicted { from: "" };
    let what = format!("{}: view changed alone", frames.scene.name);
    PaperRow::new(what, (CARD, Method::Pipeline), target, (run.time.per_second(), standing), Bound::PREDICTION)
}

/// Rows on "roughly comparable", and on the dominant cost.
fn sentences(shared: &Shared, run: &DisplayRun, constant: f64) -> Result<[PaperRow; 2], ReproduceError> {
    let comparable = PaperFigure {
        origin: Origin::Inferred("\"roughly comparable\"".to_owned()),
        ..PaperFigure::printed(1.0, 0, "times", "section 6")
    };
    let ratio = FRAMES[0].operations() / constant / run.time.frame.seconds();
    let from = Standing::Predicted { from: "rates of table I, operations" };
    let biclusters = &shared.bi_scale.biclusters()?.biclusters;
    let gathered = biclusters.row_entries() as f64;
    let share = 100.0 * gathered / (gathered + 2.0 * biclusters.column_entries() as f64);
    let dominates = PaperFigure {
        origin: Origin::Inferred("\"dominated by the gathering phase\": more than half".to_owned()),
        ..PaperFigure::printed(50.0, 0, "%", "section 6")
    };
    Ok([
        PaperRow::new("transfer over display", (CARD, Method::Pipeline), comparable, (ratio, from), Bound::TooVague),
        PaperRow::new(
            "share of a transfer's operations that gather",
            (super::HOST, Method::Solver),
            dominates,
            (share, Standing::Counted),
            Bound::AtLeast,
        ),
    ])
}

fn table(constant: f64) -> Table {
    let mut table = Table::of(
        "What light costs, from printed rates",
        "scene operations_M transfer_ms_printed billion_operations_per_second transfer_ms view_ms transfer_over_view",
    );
    for frames in &FRAMES {
        let (transfer, view) = (frames.transfer(), 1.0 / frames.rates[0]);
        table.push([
            frames.name().into(),
            Cell::decimals(1e-6 * frames.operations(), 1),
            Cell::decimals(1e3 * transfer, 1),
            Cell::measured(1e-9 * frames.operations() / transfer),
            Cell::decimals(1e3 * frames.operations() / constant, 1),
            Cell::decimals(1e3 * view, 1),
            Cell::measured(transfer / view),
        ]);
    }
    table
}

fn of_display(run: &DisplayRun) -> Table {
    let mut table = Table::new("A view of our bunny on the emulated card", &["what", "number"]);
    let rows = [
        ("pixels covered", run.pixels),
        ("passes", run.counts.passes as u64),
        ("texture reads of a pixel", run.counts.passes as u64 * u64::from(run.counts.pixel_slots[0])),
        ("vertices", run.counts.vertices as u64),
    ];
    rows.into_iter().for_each(|(what, count)| table.push([what.into(), count.into()]));
    table.push(["frame in ms".into(), Cell::measured(1e3 * run.time.frame.seconds())]);
    let waits = run.time.bottleneck.map_or_else(String::new, |bottleneck| bottleneck.to_string());
    table.push(["draws wait for".into(), waits.into()]);
    table
}
