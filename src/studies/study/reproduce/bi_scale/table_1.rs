//! Table I with stand-ins: biclusters of an armor, a chair and a temple; the bunny is in Table II.

use super::models::{ClusteredModel, ModelVisibility};
use super::scenes::{PrintedScene, SCENES};
use super::{Dependence, EntryFindings, ModelSize, PaperRow, Shared, StudyError, number, paragraph, solved};
use crate::geom::Mesh;
use crate::report::{Cell, Table};
use crate::scene::built::flat_models::FlatModel;
use crate::scene::built::transfer_models::TransferModel;
use crate::transfer::visibility::Horizon;

const HOW: &str = "The paper's models are not at hand. Ours are made by code: an armor, and a chair and a temple of flat and curved parts, with edges {} times as long as in \
    models of the printed sizes. Nonzero values are judged by vertex; the temple has only what is seen from outside, because that figure is large. \
    Which share of operations is left falls as a model grows, since neighbors become alike. Vertices see what triangles leave free.";
const QUESTION: &str =
    "the models, and how many of their vertices stand inside of other parts, where they see nothing.";
/// Scene whose stand-in was shaped to match the printed numbers per vertex.
const SHAPED: &str = "temple";
/// Edge length of reduced models, as a multiple of the full model's.
const COARSER: u32 = 4;

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let coarser = if shared.models == ModelSize::Reduced { COARSER } else { 1 };
    let models: [(&PrintedScene, Mesh); 3] = [
        (&SCENES[1], TransferModel::BiScaleArmor.mesh(coarser)),
        (&SCENES[2], FlatModel::Chair.model(coarser).mesh),
        (&SCENES[3], FlatModel::Temple.model(coarser).mesh),
    ];
    let mut table = Table::of(
        "Biclusters of the stand-ins",
        "scene vertices_printed vertices nonzeros_M biclusters thousand_per_vertex_printed thousand_per_vertex \
         operations_left_%_printed operations_left_% MB by_rows_3_bytes_MB",
    );
    let mut rows = Vec::new();
    for (scene, mesh) in models {
        let seen = ModelVisibility::new(&mesh, Horizon::Geometry)?;
        let (vertices, found) = (seen.vertices.len(), seen.clustered(scene.side)?);
        rows.extend(scene_rows(scene, vertices, &found)?);
        table.push([
            scene.name.into(),
            scene.vertices()?.into(),
            vertices.into(),
            Cell::decimals(1e-6 * found.nonzeros as f64, 2),
            found.biclusters.len().into(),
            scene.printed("per-vertex")?.cell(),
            Cell::decimals(per_vertex(&found, vertices), 2),
            scene.printed("left")?.cell(),
            Cell::decimals(found.operations_left(), 1),
            Cell::decimals(found.megabytes(), 1),
            Cell::decimals(3e-6 * found.nonzeros as f64, 1),
        ]);
    }
    Ok(EntryFindings::new([paragraph(HOW, [number(f64::from(coarser), 0)])], rows, [QUESTION], [table]))
}

/// Thousands of nonzero values per vertex.
fn per_vertex(found: &ClusteredModel, vertices: usize) -> f64 {
    1e-3 * found.nonzeros as f64 / vertices as f64
}

fn scene_rows(scene: &PrintedScene, vertices: usize, found: &ClusteredModel) -> Result<[PaperRow; 2], StudyError> {
    let row = |what: &str, ours| solved(&format!("{what}-{}", scene.id), ours);
    let mut values = row("per-vertex", per_vertex(found, vertices))?;
    if scene.id == SHAPED {
        values.dependence = Dependence::Calibrated { on: "this figure, which left out what is inside of the temple" };
    }
    Ok([values, row("left", found.operations_left())?])
}
