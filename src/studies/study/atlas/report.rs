//! The study: parameters, tables, pictures and files.

use serde_json::json;

use super::export;
use super::pictures::{self, Coloring, ModelPictures};
use crate::atlas::{Atlas, AtlasQuality};
use crate::error::InputError;
use crate::geom::Mesh;
use crate::report::digits::{Quantity, shown};
use crate::report::words::{counted, percent};
use crate::report::{Cell, Findings, FoundTable, NamedPicture, Table};
use crate::scene::Camera;
use crate::study::{ProgressFn, Study, StudyError};

const COMPACTNESS: &str = "A cluster's compactness is its area divided by the area of a disc with the radius of its \
    ball: 1 for a flat disc, 0.64 for a flat square, 0.41 for an equilateral triangle, and more for folded surfaces, \
    such as a whole closed surface. One cluster in twenty is less compact than low_compactness. The last columns count \
    the nodes of the cluster tree that have the size of one texel of the level and hold more than one face, and those \
    of them that are connected or simply connected.";

const EVENNESS: &str = "Areas are relative to the mean over all texels. Each face owns a rectangle whose sides are \
    powers of two, so its number of texels can only double or halve: areas vary by about a factor of 2 even if all \
    faces are alike.";

/// Error of a mesh without an atlas.
pub fn no_atlas(error: InputError) -> StudyError {
    StudyError::coded("crossbar::atlas", error)
}

/// Parameters: an atlas to build and measure.
#[derive(Debug, Clone)]
pub struct AtlasStudy {
    /// Name of the mesh.
    pub name: String,
    /// Mesh.
    pub mesh: Mesh,
    /// Side of the atlas, in texels.
    pub side: u32,
    /// Camera of the pictures of the mesh; `None` for no pictures and no files.
    pub camera: Option<Camera>,
}

impl Study for AtlasStudy {
    fn findings(&self, progress: &mut ProgressFn<'_>) -> Result<Findings, StudyError> {
        progress("clustering faces", 0, 3);
        let atlas = Atlas::new(&self.mesh, self.side).map_err(no_atlas)?;
        progress("measuring", 1, 3);
        let quality = AtlasQuality::of(&atlas);
        progress("drawing", 2, 3);
        Ok(findings(self, &atlas, &quality))
    }
}

fn findings(asked: &AtlasStudy, atlas: &Atlas, quality: &AtlasQuality) -> Findings {
    let mut found = Findings::new("A meshed atlas");
    conclude(&mut found, atlas, quality);
    found.paragraph(format!("{}, {} x {} texels.", asked.name, atlas.side(), atlas.side()));
    if let Some(camera) = &asked.camera {
        let model = ModelPictures::new(&asked.mesh, atlas, camera);
        let pair = |name: &str, coloring: Coloring, what: &str| {
            vec![
                NamedPicture::new(name, pictures::atlas(atlas, coloring), format!("The atlas: {what}")),
                NamedPicture::new(format!("model_{name}"), model.picture(coloring), format!("The mesh: {what}")),
            ]
        };
        found.pictures(pair("faces", Coloring::Face, "one color per face"));
        for across in [2_u32, 4, 16].into_iter().filter(|across| *across < atlas.side()) {
            let level = atlas.levels() - 1 - across.ilog2();
            let what = format!("one color per cluster of level {level}, {across} x {across} clusters");
            found.pictures(pair(&format!("level_{level}"), Coloring::Level(level), &what));
        }
        found.keep_file("atlas.obj", export::obj(&asked.mesh, atlas).into_bytes());
        found.keep_file("atlas.mtl", export::MATERIAL.as_bytes().to_vec());
        found.keep_file("faces.csv", export::faces(atlas).into_bytes());
    }
    found.explained_table(FoundTable::from(evenness(atlas, quality)).csv("evenness").field("evenness"), EVENNESS);
    found.explained_table(FoundTable::from(levels(atlas, quality)).csv("levels").field("levels"), COMPACTNESS);
    found.table(FoundTable::from(census(atlas)).csv("mesh").field("mesh"));
    found.field("side", json!(atlas.side()));
    found.field("given_normals", json!(atlas.has_given_normals()));
    found
}

fn conclude(found: &mut Findings, atlas: &Atlas, quality: &AtlasQuality) {
    let faces = counted(atlas.census().faces as u64, "face", "faces");
    let per_face = shown(atlas.texels().len() as f64 / atlas.census().faces as f64, Quantity::Ratio);
    let nodes = counted(quality.nodes as u64, "node", "nodes");
    found.conclusion(format!("{faces}, {per_face} texels each; {nodes}."));
    let share = |part: usize| percent(part as f64 / quality.nodes as f64);
    found.conclusion(format!(
        "{} of the texels lie on faces of nonzero area; the standard deviation of the texels' areas is {} of their \
         mean.",
        percent(quality.used),
        percent(quality.deviation)
    ));
    found.conclusion(format!(
        "{} of the clusters are connected, and {} are simply connected.",
        share(quality.connected),
        share(quality.simply_connected)
    ));
    if !atlas.has_given_normals() {
        found.conclusion("The mesh has no normals: each vertex gets the mean normal of its faces.");
    }
}

fn evenness(atlas: &Atlas, quality: &AtlasQuality) -> Table {
    let mut table = Table::of("Texels", "what value");
    let mut row = |what: &str, value: Cell| table.push([what.into(), value]);
    row("texels", atlas.texels().len().into());
    row("texels on faces with nonzero area (share)", Cell::measured(quality.used));
    row("area of the surface", Cell::measured(atlas.area()));
    row("mean area of a texel", Cell::measured(atlas.mean_texel_area()));
    row("standard deviation of the texel areas, divided by their mean", Cell::measured(quality.deviation));
    row("the same deviation, weighted by area", Cell::measured(quality.deviation_by_area));
    row("smallest texel area, divided by the mean", Cell::measured(quality.least));
    row("largest texel area, divided by the mean", Cell::measured(quality.most));
    table
}

fn levels(atlas: &Atlas, quality: &AtlasQuality) -> Table {
    let columns = "level across compactness low_compactness radius_over_disc nodes connected simply_connected";
    let mut table = Table::of("Clusters by level", columns);
    for (level, row) in (0_u32..).zip(&quality.levels) {
        table.push([
            level.into(),
            (atlas.side() >> level).into(),
            Cell::measured(row.compactness),
            Cell::measured(row.low_compactness),
            Cell::measured(row.radius),
            row.nodes.into(),
            row.connected.into(),
            row.simply_connected.into(),
        ]);
    }
    table
}

fn census(atlas: &Atlas) -> Table {
    let census = atlas.census();
    let mut table = Table::of("The mesh", "what count");
    for (what, count) in [
        ("faces", census.faces),
        ("parts that share no edge", census.parts),
        ("edges of one face", census.boundary_edges),
        ("edges of more than two faces", census.crowded_edges),
        ("edges traversed twice in the same direction", census.orientation_conflicts),
        ("faces without area", census.faces_without_area),
        ("faces that lie on another face", census.duplicate_faces),
    ] {
        table.push([what.into(), count.into()]);
    }
    table
}
