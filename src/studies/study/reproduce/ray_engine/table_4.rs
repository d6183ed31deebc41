//! Table 4: the teapot room by the range of triangles that goes to the card.

use super::shares::{self, Share};
use super::speed_ups::{SpeedUpRun, SpeedUps, table};
use super::teapot::TeapotRoom;
use super::{EntryChart, EntryFindings, Prose, QUESTION, Shared, StudyError, how, number};
use crate::report::{Chart, Series};

const PLACE: &str = "Table 4";
/// Printed fractions of rays on the card.
const SHARES: [&str; 3] = ["ray-engine/share-4-16", "ray-engine/share-5-12", "ray-engine/share-5-15"];

const ORDER: &str = "Printed, the widest range brings the fewest rays to the card. Ours can't: a GPU cell is the largest \
    cell whose triangles lie in the range, so a wider range has more of them, and more rays meet one. Our speed-ups are {}, {} and {} % \
    for the printed {}, {} and {} %.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.of(PLACE);
    let shares: Vec<Share<'_>> = SHARES.into_iter().zip(lines.iter().map(|line| &line.run.counts)).collect();
    let (share_rows, readings) = shares::rows(&shares, PLACE)?;
    let ticks: Vec<&str> = lines.iter().map(|line| line.name).collect();
    let speed_ups_of = |of: fn(&SpeedUpRun) -> f64| lines.iter().map(move |line| number(of(line), 1));
    let order = Prose::new(ORDER, speed_ups_of(SpeedUpRun::ours).chain(speed_ups_of(SpeedUpRun::printed)));
    let mut rows = found.rows(PLACE);
    rows.extend(share_rows);
    Ok(EntryFindings {
        text: vec![how(room), order],
        rows,
        questions: vec![
            QUESTION,
            "by which rule the authors mark GPU cells: with ours the widest range can't have the fewest rays.",
        ],
        tables: vec![table(room, &lines, PLACE)?, readings],
        charts: vec![
            EntryChart {
                name: "ray-engine-table-4",
                chart: speed_ups(found, &lines, &ticks),
                caption: "Table 4 by the range of triangles, with the costs of commands as stated and more.".into(),
            },
            EntryChart {
                name: "ray-engine-table-4-shares",
                chart: shares::chart(&shares, &ticks, "Share of rays on the card")?,
                caption: "The share of rays on the card of Table 4, and both readings of our runs.".into(),
            },
        ],
        ..EntryFindings::default()
    })
}

fn speed_ups(found: &SpeedUps, lines: &[&SpeedUpRun], ticks: &[&str]) -> Chart {
    let points = |values: Vec<f64>| (1..).zip(values).map(|(x, value)| (f64::from(x), value)).collect();
    let dots =
        |(at, values): (String, Vec<f64>)| Series { label: format!("ours, commands x {at}"), points: points(values) };
    Chart {
        title: "Speed-up over the host alone".to_owned(),
        y: "%".to_owned(),
        ticks: ticks.iter().map(ToString::to_string).collect(),
        dots: found.under(&found.commands, PLACE).into_iter().map(dots).collect(),
        printed: points(lines.iter().map(|line| line.printed()).collect()),
        ..Chart::default()
    }
}
