//! Frames of the display on the emulated card.

use refsim::device::Profile;
use refsim::machine::ExecutorKind;
use refsim::texture::TexelFormat;

use super::{HOST, ModelSize, RunResult, StudyError};
use crate::all_frequency::on_card::time::host_of_table_1;
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::on_card::{BiScaleCard, DisplayCounts, DisplayOptions, TexturedMesh, corner_coordinates};
use crate::bi_scale::texture::BidirectionalTexture;
use crate::card::MeshView;
use crate::card::frame_time::{FrameTime, frame_time};
use crate::geom::Mesh;
use crate::scene::Camera;
use crate::transfer::Vertices;

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
