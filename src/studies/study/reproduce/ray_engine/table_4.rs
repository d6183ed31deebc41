//! Table 4: the teapot room by the range of triangle counts that go to the card.

use super::shares::{self, Share};
use super::speed_ups::{SpeedUpRun, SpeedUps, table};
use super::teapot::TeapotRoom;
use super::{EntryFindings, QUESTION, Shared, StudyError, how, number, paragraph};

const PLACE: &str = "Table 4";
/// Printed fractions of rays on the card.
const SHARES: [&str; 3] = ["ray-engine/share-4-16", "ray-engine/share-5-12", "ray-engine/share-5-15"];

const ORDER: &str = "In the paper, the widest range sends the fewest rays to the card. Ours cannot: a GPU cell is the \
    largest cell whose number of triangles lies in the range, so a wider range gives more GPU cells, and more rays \
    meet one. Our speed-ups are {}, {} and {} % for the printed {}, {} and {} %.";

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let room = shared.get::<TeapotRoom>(())?;
    let found = shared.get::<SpeedUps>(())?;
    let lines = found.lines_of(PLACE);
    let shares: Vec<Share<'_>> = SHARES.into_iter().zip(lines.iter().map(|line| &line.run.counts)).collect();
    let (share_rows, readings) = shares::rows(&shares, PLACE)?;
    let speed_ups_of = |of: fn(&SpeedUpRun) -> f64| lines.iter().map(move |line| number(of(line), 1));
    let order = paragraph(ORDER, speed_ups_of(SpeedUpRun::ours).chain(speed_ups_of(SpeedUpRun::printed)));
    let mut rows = found.rows(PLACE);
    rows.extend(share_rows);
    Ok(EntryFindings::new(
        [how(room), order],
        rows,
        [QUESTION, "the authors' rule for marking GPU cells: with ours, the widest range cannot have the fewest rays."],
        [table(room, &lines, PLACE)?, readings],
    ))
}
