//! Table I with stand-ins: biclusters and views of an armor, a chair and a temple; the bunny is in Table II.

use super::display::{CARD, DisplayRun, display_textured};
use super::models::{ClusteredModel, ModelVisibility, filled};
use super::scenes::{PrintedScene, SCENES};
use super::{
    Dependence, EntryFindings, Method, ModelSize, PaperRow, RunResult, Shared, StudyError, number, paper_row,
    paragraph, solved,
};
use crate::geom::Mesh;
use crate::report::{Cell, Table};
use crate::scene::built::flat_models::FlatModel;
use crate::scene::built::transfer_models::TransferModel;
use crate::transfer::visibility::Horizon;
use crate::transfer::{Tangents, Vertices};

const HOW: &str = "The paper's models are not at hand. Ours are made by code: an armor, and a chair and a temple of flat and curved parts, with edges {} times as long as in \
    models of the printed sizes. Nonzero values are judged by vertex; the temple has only what is seen from outside, because that figure is large. \
    Which share of operations is left falls as a model grows, since neighbors become alike. Vertices see what triangles leave free. \
    For the rate of views, each stand-in fills a picture of the printed size on the emulated card.";
const QUESTION: &str =
    "the models, and how many of their vertices stand inside of other parts, where they see nothing.";
/// Scene whose stand-in was shaped to match the printed numbers per vertex.
const SHAPED: &str = "temple";
/// Edge length of reduced models, as a multiple of the full model's.
const COARSER: u32 = 4;

pub(in crate::study::reproduce) fn findings(shared: &Shared) -> Result<EntryFindings, StudyError> {
    let coarser = if shared.models == ModelSize::Reduced { COARSER } else { 1 };
    let armor = TransferModel::BiScaleArmor.mesh(coarser);
    let one_texture = vec![0; armor.len()];
    let [chair, temple] = [FlatModel::Chair, FlatModel::Temple].map(|model| model.model(coarser));
    let models = [(armor, one_texture), (chair.mesh, chair.material_of), (temple.mesh, temple.material_of)];
    let mut table = Table::of(
        "Biclusters of the stand-ins",
        "scene vertices_printed vertices nonzeros_M biclusters thousand_per_vertex_printed thousand_per_vertex \
         operations_left_%_printed operations_left_% MB by_rows_3_bytes_MB",
    );
    let mut views = views_table();
    let mut rows = Vec::new();
    for (scene, (mesh, texture_of)) in SCENES[1..].iter().zip(&models) {
        let seen = ModelVisibility::new(mesh, Horizon::Geometry)?;
        let (vertices, found) = (seen.vertices.len(), seen.clustered(scene.side)?);
        let run = view(scene, (mesh, texture_of), shared.models)?;
        rows.extend(scene_rows(scene, vertices, &found)?);
        let ours = (run.time.per_second(), Dependence::Predicted { from: "" });
        rows.push(paper_row(&scene.figure("view"), (CARD, Method::Pipeline), ours)?);
        push_view(&mut views, scene, &run);
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
    Ok(EntryFindings::new([paragraph(HOW, [number(f64::from(coarser), 0)])], rows, [QUESTION], [table, views]))
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

/// Draws a stand-in with its textures, so that it fills a picture of the printed size, or a small one for reduced models.
fn view(
    scene: &PrintedScene,
    (mesh, texture_of): (&Mesh, &[u32]),
    models: ModelSize,
) -> Result<DisplayRun, StudyError> {
    let size = match models {
        ModelSize::Printed => scene.picture,
        ModelSize::Reduced => scene.picture.map(|side| side / 10),
    };
    let vertices = Vertices::with_materials(mesh, texture_of, Tangents::Texture).on(CARD)?;
    display_textured((mesh, &vertices), texture_of, scene.side, filled(mesh, size)?)
}

fn views_table() -> Table {
    Table::of(
        "Views of the stand-ins on the emulated card",
        "scene width height pixels_covered vertices passes frame_ms draws_wait_for",
    )
}

fn push_view(table: &mut Table, scene: &PrintedScene, run: &DisplayRun) {
    let [width, height] = scene.picture;
    let waits = run.time.bottleneck.map_or_else(String::new, |bottleneck| bottleneck.to_string());
    table.push([
        scene.name.into(),
        width.into(),
        height.into(),
        run.pixels.into(),
        run.counts.vertices.into(),
        run.counts.passes.into(),
        Cell::measured(1e3 * run.time.frame.seconds()),
        waits.into(),
    ]);
}
