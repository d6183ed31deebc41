//! Scenes of Tables I and II, and stand-ins for their models: visibility, transfer to local directions, biclusters, and
//! frames of the display on the emulated card.

use glam::DVec3;
use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use refsim::texture::TexelFormat;

use super::{HOST, ModelSize, PaperFigure, RunResult, Shared, StudyError, printed};
use crate::all_frequency::on_card::time::host_of_table_1;
use crate::bi_scale::bicluster::{Biclustering, SEED, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::matrix::SparseMatrix;
use crate::bi_scale::on_card::{BiScaleCard, DisplayCounts, DisplayOptions, TexturedMesh, corner_coordinates};
use crate::bi_scale::texture::BidirectionalTexture;
use crate::bi_scale::transfer::transfer_matrix;
use crate::card::MeshView;
use crate::card::frame_time::{FrameTime, frame_time};
use crate::geom::vector::wide;
use crate::geom::{Mesh, Sides};
use crate::scene::Camera;
use crate::scene::built::transfer_models::TransferModel;
use crate::study::framing::framed;
use crate::study::reproduce::shared::SharedResult;
use crate::tracer::HostTracer;
use crate::transfer::visibility::{Horizon, VisibilityMaps, VisibilitySampling};
use crate::transfer::{Tangents, Vertices};

/// Scene of either table.
pub(super) struct PrintedScene {
    /// Name of the scene in its figures' names.
    pub(super) id: &'static str,
    pub(super) name: &'static str,
    /// Number of local directions per side.
    pub(super) side: usize,
    /// Width and height of the picture that is timed; Table II gives no size.
    pub(super) picture: [u32; 2],
}

impl PrintedScene {
    /// Name of one of the scene's figures.
    pub(super) fn figure(&self, what: &str) -> String {
        format!("bi-scale/{what}-{}", self.id)
    }

    pub(super) fn printed(&self, what: &str) -> Result<&'static PaperFigure, StudyError> {
        printed(&self.figure(what))
    }

    pub(super) fn vertices(&self) -> Result<usize, StudyError> {
        Ok(self.printed("vertices")?.value as usize)
    }

    pub(super) fn rows(&self) -> Result<usize, StudyError> {
        Ok(self.vertices()? * self.side * self.side)
    }
}

const fn scene(id: &'static str, name: &'static str, side: usize, picture: [u32; 2]) -> PrintedScene {
    PrintedScene { id, name, side, picture }
}

pub(super) const SCENES: [PrintedScene; 6] = [
    scene("bunny", "bunny", 8, [640, 480]),
    scene("armor", "armor", 12, [480, 640]),
    scene("chair", "chair", 8, [640, 640]),
    scene("temple", "temple", 8, [640, 480]),
    scene("middle-bunny", "middle bunny", 8, [640, 480]),
    scene("fine-bunny", "fine bunny", 8, [640, 480]),
];

pub(super) const BUNNY: TransferModel = TransferModel::BiScaleBunny;
/// Base-2 logarithm of the number of visibility samples per side of a light texel.
pub(super) const LOG2_SAMPLES: u32 = 1;

/// Position of the eye, in units of the model's size, relative to its center.
const EYE: DVec3 = DVec3::new(1.6, -2.4, 0.9);

/// Model with the visibility at its vertices.
#[derive(Debug)]
pub(super) struct ModelVisibility {
    pub(super) mesh: Mesh,
    pub(super) vertices: Vertices,
    maps: VisibilityMaps,
}

#[derive(Debug)]
pub(super) struct ClusteredModel {
    pub(super) nonzeros: usize,
    pub(super) biclusters: Biclustering,
}

/// Camera of a picture that a model fills.
pub(super) fn filled(mesh: &Mesh, [width, height]: [u32; 2]) -> Result<Camera, StudyError> {
    let [low, high] = mesh.bounds().unwrap_or_default().map(wide);
    let (middle, size) = ((low + high) / 2.0, (high - low).max_element());
    let points: Vec<DVec3> = mesh.positions().iter().map(|&at| wide(at)).collect();
    let view = framed(middle + size * EYE, &points, f64::from(width) / f64::from(height));
    view.camera(width, height).on(HOST)
}

/// Visibility by the triangles of a model alone.
impl SharedResult for ModelVisibility {
    type Key = TransferModel;

    fn compute(model: &TransferModel, _: &Shared) -> Result<Self, StudyError> {
        Self::new(&model.mesh(1), Horizon::Geometry)
    }
}

/// Biclusters of a model's transfer, with the directions that both tables use.
impl SharedResult for ClusteredModel {
    type Key = TransferModel;

    fn compute(&model: &TransferModel, shared: &Shared) -> Result<Self, StudyError> {
        shared.get::<ModelVisibility>(model)?.clustered(SCENES[0].side)
    }
}

impl ModelVisibility {
    pub(super) fn new(mesh: &Mesh, horizon: Horizon) -> Result<Self, StudyError> {
        let vertices = Vertices::new(mesh, Tangents::Texture).on(HOST)?;
        let all: Vec<u32> = (0..vertices.len() as u32).collect();
        let sampling = VisibilitySampling { log2_samples: LOG2_SAMPLES, horizon };
        let mut caster = HostTracer::new(mesh, Sides::Both);
        let maps = VisibilityMaps::trace_sampled(&vertices, &all, sampling, &mut caster, &mut |_, _| ()).on(HOST)?;
        Ok(Self { mesh: mesh.clone(), vertices, maps })
    }

    /// Transfer matrix T with `side` local directions per side.
    pub(super) fn matrix(&self, side: usize) -> Result<SparseMatrix, StudyError> {
        let directions = LocalDirections::new(side).on(HOST)?;
        transfer_matrix(&self.vertices, &self.maps, &directions).on(HOST)
    }

    pub(super) fn clustered(&self, side: usize) -> Result<ClusteredModel, StudyError> {
        let matrix = self.matrix(side)?;
        let biclusters = bicluster(&matrix, SEED, &mut |_| ()).on(HOST)?;
        Ok(ClusteredModel { nonzeros: matrix.nonzeros(), biclusters })
    }
}

impl ClusteredModel {
    /// Megabytes of the biclusters: four bytes per row, eight per column.
    pub(super) fn megabytes(&self) -> f64 {
        4e-6 * (self.biclusters.row_entries() + 2 * self.biclusters.column_entries()) as f64
    }

    pub(super) fn operations_left(&self) -> f64 {
        100.0 * self.biclusters.cost() as f64 / (2 * self.nonzeros) as f64
    }
}

pub(super) const CARD: &str = "gt200";
/// Number of view directions per side.
const VIEWS: usize = 12;
/// Number of texels per side of a patch. Time depends on the number of reads, not on the number of texels.
const PATCH: usize = 4;

/// Timed frame without light: time does not depend on light values.
pub(super) struct DisplayRun {
    pub(super) counts: DisplayCounts,
    pub(super) time: FrameTime,
    pub(super) pixels: u64,
}

/// Width and height of the pictures in which views are timed.
pub(super) const PICTURE: [u32; 2] = [640, 480];

/// The size of pictures, small for a run without verdicts.
pub(super) fn picture(models: ModelSize) -> [u32; 2] {
    models.pick(PICTURE, [64, 48])
}

pub(super) fn of_bunny([width, height]: [u32; 2]) -> Result<Camera, StudyError> {
    Camera::new([3.0, -5.5, 1.5], [0.0; 3], [0.0, 0.0, 1.0], 0.22, width, height).on(CARD)
}

/// Draws a mesh with a single texture, and `side` local directions along an edge.
pub(super) fn display(model: (&Mesh, &Vertices), side: usize, camera: Camera) -> Result<DisplayRun, StudyError> {
    display_textured(model, &vec![0; model.0.len()], side, camera)
}

/// Draws a mesh with a texture for each material.
pub(super) fn display_textured(
    (mesh, vertices): (&Mesh, &Vertices),
    texture_of: &[u32],
    side: usize,
    camera: Camera,
) -> Result<DisplayRun, StudyError> {
    let directions = |side| LocalDirections::new(side).on(CARD);
    let (view, light) = (directions(VIEWS)?, directions(side)?);
    let lights = side * side;
    let samples = vec![[0.0; 3]; VIEWS * VIEWS * lights * PATCH * PATCH];
    let texture = BidirectionalTexture::new(PATCH, view, light, samples).on(CARD)?;
    let coordinates = corner_coordinates(mesh, [1.0; 2]).on(CARD)?;
    let textures = vec![texture; texture_of.iter().max().map_or(0, |&most| most as usize + 1)];
    let textured = TexturedMesh { vertices, coordinates: &coordinates, textures: &textures, texture_of };
    let profile = Profile::named(CARD)?;
    let options = DisplayOptions::default();
    let mut card = BiScaleCard::new(profile.clone(), ExecutorKind::Batch, textured, options).on(CARD)?;
    let view = MeshView { camera, exposure: 1.0, format: TexelFormat::Rgba8 };
    let local = vec![[0.0; 3]; vertices.len() * lights];
    let (texels, log) = card.logged_view(&local, &view).on(CARD)?;
    let pixels = texels.texels.iter().filter(|texel| texel[3] != 0.0).count() as u64;
    // The host only submits draws.
    let time = frame_time(&profile, &log, &host_of_table_1().on(HOST)?).on(CARD)?;
    Ok(DisplayRun { counts: card.counts(), time, pixels })
}
