//! Table 3: the teapot room with and without a card, with asynchronous read-back, and with an infinitely fast card; and
//! the octree of the host alone.

use super::speed_ups::{SpeedUpRun, SpeedUps, host_alone, table};
use super::teapot::{QUESTION, RATE, TeapotRoom, how};
use super::workload::{OCTREE as OCTREE_OF_ALL, TIMES};
use super::{EntryFindings, Method, PaperRow, Shared, StudyError, number, paper_row, paragraph};
use crate::report::{Chart, NamedChart, Series};

const PLACE: &str = "Table 3";
const OCTREE: &str = "The octree of the host alone matters most, because the host's time per ray is the unit of all our times. The sweep varies the \
    number of triangles in its leaves; the engine keeps its own octree, and the host is recalibrated each time. The largest step of the sweep is \
    from {} to {} triangles, where the speed-up of the infinitely fast card goes from {} to {} %; its size depends on our mesh. Rows use {} \
    triangles, for host and engine alike; we chose this number before we computed any row.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.lines_of(PLACE);
    Ok(EntryFindings {
        text: vec![how(), passes(&lines), octree(&found)],
        rows: std::iter::once(host_alone(&room)?).chain(found.rows(PLACE)).chain([readback(&lines)?]).collect(),
        questions: vec![
            QUESTION,
            "how full the leaves of the host's octree were when the host was timed alone, and whether the engine used the same octree.",
        ],
        tables: vec![
            table(&lines, PLACE),
            found.table(&found.host_leaf, "Speed-ups by leaf size of the host-alone octree"),
        ],
        charts: vec![NamedChart {
            name: "ray-engine-host-octree".into(),
            chart: chart(&found, &lines),
            caption: format!(
                "Speed-ups of Table 3 by leaf size of the host-alone octree; printed values are drawn at the {} triangles of our rows.",
                OCTREE_OF_ALL.most_triangles,
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
        [
            number(counts.pass_rays as f64 / counts.passes as f64, 1),
            number(counts.pass_rays as f64 / counts.rays as f64, 1),
            number(printed_all, 0),
            number(printed_wait, 0),
            number(our_all, 0),
            number(our_wait, 0),
        ],
    )
}

/// Paragraph about the largest step in the sweep's last row, the infinitely fast card.
fn octree(found: &SpeedUps) -> String {
    let settings = found.under(&found.host_leaf, PLACE);
    let fast = |values: &[f64]| values.last().copied().unwrap_or(f64::NAN);
    let step = |two: &&[(String, Vec<f64>)]| fast(&two[1].1) - fast(&two[0].1);
    let largest = settings.windows(2).max_by(|a, b| step(a).total_cmp(&step(b)));
    let Some([(from, low), (to, high)]) = largest else { return String::new() };
    let stated = OCTREE_OF_ALL.most_triangles.to_string();
    paragraph(OCTREE, [from.clone(), to.clone(), number(fast(low), 0), number(fast(high), 0), stated])
}

fn chart(found: &SpeedUps, lines: &[&SpeedUpRun]) -> Chart {
    let settings = found.under(&found.host_leaf, PLACE);
    let line = |(i, line): (usize, &&SpeedUpRun)| Series {
        label: line.name.to_owned(),
        points: settings.iter().filter_map(|(at, values)| Some((at.parse().ok()?, values[i]))).collect(),
    };
    let stated = OCTREE_OF_ALL.most_triangles as f64;
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
