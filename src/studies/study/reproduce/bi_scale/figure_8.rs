//! Figure 8: more local directions.

use super::models::{CARD, ModelVisibility, SCENES, display, of_bunny};
use super::{EntryFindings, Shared, StudyError, drawn, paragraph, solved};
use crate::elementary::ln;
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel;
use crate::transfer::visibility::Horizon;

const HOW: &str = "The Stanford bunny has {} vertices; sizes are scaled to the paper's {}, since bytes of biclusters \
    grow in proportion to vertices (table II). The emulated card displays it in {} x {} pixels.";
const QUESTION: &str = "how the paper's bunny was made from the scan.";
/// Numbers of local directions per side.
const SIDES: [usize; 4] = [8, 12, 16, 32];
/// Size of the picture: large enough to show differences in cost.
const PICTURE: [u32; 2] = [160, 120];

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let bunny = TransferModel::BiScaleBunny.mesh(shared.models.pick(1, 3));
    let model = ModelVisibility::new(&bunny, Horizon::Geometry)?;
    let (vertices, of_paper) = (model.vertices.len() as f64, SCENES[0].vertices()? as f64);
    let mut table = Table::of(
        "Local directions",
        "along_an_edge nonzeros_M operations_left_% MB_of_all_vertices times_64_directions passes display_ms over_64_directions",
    );
    let (mut megabytes, mut seconds) = (Vec::new(), Vec::new());
    for side in SIDES {
        let found = model.clustered(side)?;
        let run = display((&model.mesh, &model.vertices), side, of_bunny(PICTURE)?)?;
        megabytes.push(found.megabytes() * of_paper / vertices);
        seconds.push(run.time.frame.seconds());
        let last = seconds.len() - 1;
        table.push([
            side.into(),
            Cell::decimals(1e-6 * found.nonzeros as f64, 2),
            Cell::decimals(found.operations_left(), 1),
            Cell::decimals(megabytes[last], 1),
            Cell::ratio(megabytes[last] / megabytes[0]),
            run.counts.passes.into(),
            Cell::measured(1e3 * seconds[last]),
            Cell::measured(seconds[last] / seconds[0]),
        ]);
    }
    let last = SIDES.len() - 1;
    let power = ln(seconds[last] / seconds[0]) / ln(SIDES[last] as f64 / SIDES[0] as f64);
    let rows = [solved("biclusters-32", megabytes[last])?, drawn("bi-scale/display-power", CARD, power)?];
    let how = paragraph(HOW, &[&vertices, &of_paper, &PICTURE[0], &PICTURE[1]]);
    Ok(EntryFindings::new([how], rows, [QUESTION], [table]))
}
