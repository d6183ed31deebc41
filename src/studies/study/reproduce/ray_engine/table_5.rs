//! Table 5: the teapot room with different numbers of rays per pass, and the costs of commands.

use super::engine_run::Run;
use super::speed_ups::{SpeedUpRun, SpeedUps, table};
use super::teapot::{QUESTION, TeapotRoom, how, plus_card};
use super::{Dependence, EntryFindings, Method, PaperRow, Shared, StudyError, number, paper_row, paragraph};
use crate::report::{Chart, NamedChart, Series};

const PLACE: &str = "Table 5";
const SIZE: &str = "Larger passes cost less per ray, but more caches never fill, and the rays in them are forced to \
    the host: {} times per ray at {}, {} times at {}. Commands make up most of a pass's cost, and their costs are \
    guesses; the sweep multiplies all of them by one factor, for the rows of all three tables.";
const FILL: &str = "Section 5.3 states how full the buckets of the ray tree typically are. The rows have the mean fill \
    of nonempty buckets after each bundle of the room's rays, before the engine empties partly filled buckets. Figures \
    4 and 6 of the paper are pictures: `crossbar leaky-teapot` and `crossbar render` draw them.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.lines_of(PLACE);
    Ok(EntryFindings {
        text: vec![how(), size(&lines), FILL.into()],
        rows: found.rows(PLACE).into_iter().chain(fill(&room)?).collect(),
        questions: vec![
            QUESTION,
            "the cost of draws, uploads and read-backs in the authors' driver: a factor on our guesses moves all rows.",
        ],
        tables: vec![table(&lines, PLACE), found.table(&found.commands, "Speed-ups by a factor on all command costs")],
        charts: vec![NamedChart {
            name: "ray-engine-table-5".into(),
            chart: chart(&found, &lines),
            caption: "Table 5, with the guessed command costs and with higher costs.".into(),
        }],
        ..EntryFindings::default()
    })
}

/// Rows for the fill of the ray tree's buckets.
fn fill(room: &TeapotRoom) -> Result<[PaperRow; 2], StudyError> {
    let means = Run::fill_of(&room.work, plus_card())?;
    let filled = 100.0 * means.iter().sum::<f64>() / means.len().max(1) as f64;
    let row = |id: &str, ours: f64| paper_row(id, ("host", Method::Engine), (ours, Dependence::Counted));
    Ok([row("ray-engine/buckets-least", filled)?, row("ray-engine/buckets-free", 100.0 - filled)?])
}

fn size(lines: &[&SpeedUpRun]) -> String {
    let forced = |line: &SpeedUpRun| number(line.run.counts.forced_rays as f64 / line.run.counts.rays as f64, 2);
    let (Some(first), Some(last)) = (lines.first(), lines.last()) else { return String::new() };
    paragraph(SIZE, [forced(first), first.name.to_owned(), forced(last), last.name.to_owned()])
}

fn chart(found: &SpeedUps, lines: &[&SpeedUpRun]) -> Chart {
    let rays: Vec<f64> = lines.iter().filter_map(|line| line.name.split(' ').next()?.parse().ok()).collect();
    let points = |values: Vec<f64>| rays.iter().copied().zip(values).collect();
    let line = |(at, values): (String, Vec<f64>)| Series {
        label: format!("ours, command costs x {at}"),
        points: points(values),
    };
    Chart {
        title: "Speed-up over the host alone".to_owned(),
        x: "rays per pass".to_owned(),
        y: "%".to_owned(),
        lines: found.under(&found.commands, PLACE).into_iter().map(line).collect(),
        printed: vec![Series {
            label: "printed".to_owned(),
            points: points(lines.iter().map(|line| line.printed()).collect()),
        }],
        ..Chart::default()
    }
}
