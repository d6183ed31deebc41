//! Figure 8: more local directions.

use super::display::{CARD, display};
use super::models::ModelVisibility;
use super::{
    Bound, EntryFindings, HOST, Method, ModelSize, Origin, PaperFigure, PaperRow, Prose, ReproduceError, Shared,
    Standing, number,
};
use crate::elementary::ln;
use crate::report::{Cell, Table};
use crate::scene::built::transfer_models::TransferModel;
use crate::transfer::visibility::Horizon;

const HOW: &str = "The stand-in for the bunny with {} vertices, and sizes as if it had the {} of the paper's: bytes of biclusters grow as vertices do (table II). \
    The display is that of the emulated card in {} x {} pixels.";
const QUESTION: &str = "the model, and how smooth it is.";
/// Local directions along an edge.
const SIDES: [usize; 4] = [8, 12, 16, 32];
/// Size of the picture: large enough to distinguish costs.
const PICTURE: [u32; 2] = [160, 120];
/// Vertices of the paper's model, and megabytes with the fewest and the most directions.
const VERTICES: f64 = 3286.0;
const PRINTED: [f64; 2] = [24.2, 58.5];

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, ReproduceError> {
    let coarser = if shared.models == ModelSize::Reduced { 3 } else { 1 };
    let model = ModelVisibility::new(&TransferModel::BiScaleBunny.mesh(coarser), Horizon::Geometry)?;
    let vertices = model.vertices.len() as f64;
    let mut table = Table::of(
        "Local directions",
        "along_an_edge nonzeros_M operations_left_% MB_of_all_vertices passes display_ms over_64_directions",
    );
    let (mut megabytes, mut seconds) = (Vec::new(), Vec::new());
    for side in SIDES {
        let found = model.clustered(side)?;
        let run = display((&model.mesh, &model.vertices), side, PICTURE)?;
        megabytes.push(found.megabytes() * VERTICES / vertices);
        seconds.push(run.time.frame.seconds());
        let last = seconds.len() - 1;
        table.push([
            side.into(),
            Cell::decimals(1e-6 * found.nonzeros as f64, 2),
            Cell::decimals(found.operations_left(), 1),
            Cell::decimals(megabytes[last], 1),
            run.counts.passes.into(),
            Cell::measured(1e3 * seconds[last]),
            Cell::measured(seconds[last] / seconds[0]),
        ]);
    }
    let last = SIDES.len() - 1;
    let power = ln(seconds[last] / seconds[0]) / ln(SIDES[last] as f64 / SIDES[0] as f64);
    let ratio = PaperFigure {
        origin: Origin::Implied("58.5 MB over 24.2 MB".to_owned()),
        ..PaperFigure::printed(PRINTED[1] / PRINTED[0], 2, "times", "figure 8")
    };
    let quadratic = PaperFigure::printed(2.0, 0, "power", "section 6");
    let solver = |what: &str, target, ours| {
        PaperRow::new(what, (HOST, Method::Solver), target, (ours, Standing::Counted), Bound::PREDICTION)
    };
    let rows = vec![
        solver(
            "biclusters of 32 x 32 directions",
            PaperFigure::printed(PRINTED[1], 1, "MB", "section 6"),
            megabytes[last],
        ),
        solver("biclusters of 32 x 32 directions over those of 8 x 8", ratio, megabytes[last] / megabytes[0]),
        PaperRow::new(
            "power of directions along an edge that the display costs",
            (CARD, Method::Pipeline),
            quadratic,
            (power, Standing::Predicted { from: "" }),
            Bound::PREDICTION,
        ),
    ];
    let values = [vertices, VERTICES, f64::from(PICTURE[0]), f64::from(PICTURE[1])].map(|value| number(value, 0));
    Ok(EntryFindings {
        text: vec![Prose::new(HOW, values)],
        rows,
        questions: vec![QUESTION],
        tables: vec![table],
        ..EntryFindings::default()
    })
}
