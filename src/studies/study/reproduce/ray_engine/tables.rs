//! Tables 3 to 5: the teapot room with and without a card, with asynchronous read-back, and with an infinitely fast
//! card; by the range of triangle counts that go to the card; and by the rays per pass. The octree of the host alone,
//! and the costs of commands.

use super::shares::{self, Share};
use super::speed_ups::{SpeedUpRun, SpeedUps, host_alone, table};
use super::workload::{OCTREE, QUESTION, RATE, Run, TIMES, TeapotRoom, how, plus_card};
use super::{Dependence, EntryFindings, Method, PaperRow, Shared, StudyError, paper_row, paragraph};
use crate::report::words::listed;
use crate::report::{Chart, NamedChart, Series};
use crate::study::reproduce::number;

const TABLE_3: &str = "Table 3";
const OCTREE_MATTERS: &str = "The octree of the host alone matters most, because the host's time per ray is the unit of all our times. The sweep varies the \
    number of triangles in its leaves; the engine keeps its own octree, and the host is recalibrated each time. The largest step of the sweep is \
    from {} to {} triangles, where the speed-up of the infinitely fast card goes from {} to {} %; its size depends on our mesh. Rows use {} \
    triangles, for host and engine alike; we chose this number before we computed any row.";

pub(in crate::study::reproduce) fn table_3(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.lines_of(TABLE_3);
    Ok(EntryFindings {
        text: vec![how(), passes(&lines), octree(&found)],
        rows: std::iter::once(host_alone(&room)?).chain(found.rows(TABLE_3)).chain([readback(&lines)?]).collect(),
        questions: vec![
            QUESTION,
            "how full the leaves of the host's octree were when the host was timed alone, and whether the engine used the same octree.",
        ],
        tables: vec![
            table(&lines, TABLE_3),
            found.table(&found.host_leaf, "Speed-ups by leaf size of the host-alone octree"),
        ],
        charts: vec![NamedChart {
            name: "ray-engine-host-octree".into(),
            chart: octree_chart(&found, &lines),
            caption: format!(
                "Speed-ups of Table 3 by leaf size of the host-alone octree; printed values are drawn at the {} triangles of our rows.",
                OCTREE.most_triangles,
            ),
        }],
        ..EntryFindings::default()
    })
}

/// Row for the cost of synchronous read-back: speed-up by asynchronous read-back minus that of "plus card", in points.
fn readback(lines: &[&SpeedUpRun]) -> Result<PaperRow, StudyError> {
    let ours = |name: &str| lines.iter().find(|line| line.name == name).map_or(f64::NAN, |line| line.ours());
    let lost = ours("asynchronous read-back") - ours("plus card");
    paper_row("ray-engine/readback-points", (TIMES, Method::Engine), (lost, RATE))
}

/// Paragraph about the time per pass that the printed values and ours imply.
fn passes(lines: &[&SpeedUpRun]) -> String {
    let us = |rays_per_s: f64| 1e6 / rays_per_s;
    let [plus, asynchronous, fast] = lines else { return String::new() };
    let counts = &plus.run.counts;
    let a_pass = counts.rays as f64 / counts.passes as f64;
    let of = |of: fn(&SpeedUpRun) -> f64| [fast, asynchronous].map(|other| (us(of(plus)) - us(of(other))) * a_pass);
    let ([printed_all, printed_wait], [our_all, our_wait]) =
        (of(|line| line.row.target.value), of(|line| line.row.ours));
    paragraph(
        "A pass of our run holds {} rays, and each ray meets the card {} times. With these counts, the printed figures imply that a pass takes {} us more \
         than with an infinitely fast card, and that asynchronous read-back saves {} us of this time; our figures imply {} us and {} us.",
        &[
            &(counts.pass_rays as f64 / counts.passes as f64, 1),
            &(counts.pass_rays as f64 / counts.rays as f64, 1),
            &printed_all,
            &printed_wait,
            &our_all,
            &our_wait,
        ],
    )
}

/// Paragraph about the largest step in the sweep's last row, the infinitely fast card.
fn octree(found: &SpeedUps) -> String {
    let settings = found.under(&found.host_leaf, TABLE_3);
    let fast = |values: &[f64]| values.last().copied().unwrap_or(f64::NAN);
    let step = |two: &&[(String, Vec<f64>)]| fast(&two[1].1) - fast(&two[0].1);
    let largest = settings.windows(2).max_by(|a, b| step(a).total_cmp(&step(b)));
    let Some([(from, low), (to, high)]) = largest else { return String::new() };
    paragraph(OCTREE_MATTERS, &[from, to, &fast(low), &fast(high), &OCTREE.most_triangles])
}

fn octree_chart(found: &SpeedUps, lines: &[&SpeedUpRun]) -> Chart {
    let settings = found.under(&found.host_leaf, TABLE_3);
    let line = |(i, line): (usize, &&SpeedUpRun)| Series {
        label: line.name.to_owned(),
        points: settings.iter().filter_map(|(at, values)| Some((at.parse().ok()?, values[i]))).collect(),
    };
    let stated = OCTREE.most_triangles as f64;
    let printed = |line: &&SpeedUpRun| Series {
        label: format!("printed: {}", line.name),
        points: vec![(stated, line.printed())],
    };
    Chart {
        title: "Speed-up over the host alone".to_owned(),
        x: "triangles per leaf of the host-alone octree".to_owned(),
        y: "%".to_owned(),
        lines: lines.iter().enumerate().map(line).collect(),
        printed: lines.iter().map(printed).collect(),
        ..Chart::default()
    }
}

const TABLE_4: &str = "Table 4";
const ORDER: &str = "In the paper, the widest range sends the fewest rays to the card. Our rule cannot do this: a GPU \
    cell is the largest cell whose number of triangles lies in the range, so a wider range gives more GPU cells, and \
    more rays meet such a cell. Our speed-ups are {} %; the paper has {} %.";

pub(in crate::study::reproduce) fn table_4(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.lines_of(TABLE_4);
    let counts = lines.iter().map(|line| &line.run.counts);
    let shares: Vec<Share<'_>> = ["4-16", "5-12", "5-15"].into_iter().zip(counts).collect();
    let (share_rows, readings) = shares::rows(&shares, TABLE_4)?;
    let speed_ups =
        |of: fn(&SpeedUpRun) -> f64| listed(&lines.iter().map(|line| number(of(line), 1)).collect::<Vec<_>>());
    let order = paragraph(ORDER, &[&speed_ups(SpeedUpRun::ours), &speed_ups(SpeedUpRun::printed)]);
    let mut rows = found.rows(TABLE_4);
    rows.extend(share_rows);
    Ok(EntryFindings::new(
        [how(), order],
        rows,
        [QUESTION, "the authors' rule for marking GPU cells: with ours, the widest range cannot have the fewest rays."],
        [table(&lines, TABLE_4), readings],
    ))
}

const TABLE_5: &str = "Table 5";
const SIZE: &str = "Larger passes cost less per ray, but more caches never fill, and the rays in them are forced to \
    the host: {} times per ray at {}, {} times at {}. Commands make up most of a pass's cost, and their costs are \
    guesses; the sweep multiplies all of them by one factor, for the rows of all three tables.";
const FILL: &str = "Section 5.3 states how full the buckets of the ray tree typically are. The rows have the mean fill \
    of nonempty buckets after each bundle of the room's rays, before the engine empties partly filled buckets. Figures \
    4 and 6 of the paper are pictures: `crossbar leaky-teapot` and `crossbar render` draw them.";

pub(in crate::study::reproduce) fn table_5(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.lines_of(TABLE_5);
    Ok(EntryFindings {
        text: vec![how(), size(&lines), FILL.into()],
        rows: found.rows(TABLE_5).into_iter().chain(fill(&room)?).collect(),
        questions: vec![
            QUESTION,
            "the cost of draws, uploads and read-backs in the authors' driver: a factor on our guesses moves all rows.",
        ],
        tables: vec![
            table(&lines, TABLE_5),
            found.table(&found.commands, "Speed-ups by a factor on all command costs"),
        ],
        charts: vec![NamedChart {
            name: "ray-engine-table-5".into(),
            chart: rays_chart(&found, &lines),
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
    let forced = |line: &SpeedUpRun| (line.run.counts.forced_rays as f64 / line.run.counts.rays as f64, 2);
    let (Some(first), Some(last)) = (lines.first(), lines.last()) else { return String::new() };
    paragraph(SIZE, &[&forced(first), &first.name, &forced(last), &last.name])
}

fn rays_chart(found: &SpeedUps, lines: &[&SpeedUpRun]) -> Chart {
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
        lines: found.under(&found.commands, TABLE_5).into_iter().map(line).collect(),
        printed: vec![Series {
            label: "printed".to_owned(),
            points: points(lines.iter().map(|line| line.printed()).collect()),
        }],
        ..Chart::default()
    }
}
