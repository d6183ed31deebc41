//! Table 4: the teapot room by the range of triangle counts that go to the card.

use super::shares::{self, Share};
use super::speed_ups::{SpeedUpRun, SpeedUps, table};
use super::teapot::{QUESTION, how};
use super::{EntryFindings, Shared, StudyError, number, paragraph};

const PLACE: &str = "Table 4";
const ORDER: &str = "In the paper, the widest range sends the fewest rays to the card. Our rule cannot do this: a GPU \
    cell is the largest cell whose number of triangles lies in the range, so a wider range gives more GPU cells, and \
    more rays meet such a cell. Our speed-ups are {}, {} and {} %; the paper has {}, {} and {} %.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.lines_of(PLACE);
    let counts = lines.iter().map(|line| &line.run.counts);
    let shares: Vec<Share<'_>> = ["4-16", "5-12", "5-15"].into_iter().zip(counts).collect();
    let (share_rows, readings) = shares::rows(&shares, PLACE)?;
    let speed_ups_of = |of: fn(&SpeedUpRun) -> f64| lines.iter().map(move |line| number(of(line), 1));
    let order = paragraph(ORDER, speed_ups_of(SpeedUpRun::ours).chain(speed_ups_of(SpeedUpRun::printed)));
    let mut rows = found.rows(PLACE);
    rows.extend(share_rows);
    Ok(EntryFindings::new(
        [how(), order],
        rows,
        [QUESTION, "the authors' rule for marking GPU cells: with ours, the widest range cannot have the fewest rays."],
        [table(&lines, PLACE), readings],
    ))
}
