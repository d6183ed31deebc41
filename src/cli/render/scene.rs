//! The scene of `crossbar render`, and its camera.

use super::args::Args;
use crate::cli::model_file;
use crate::cli::scene_name::{self, Viewpoint};
use crate::scene::{Camera, Scene};

/// A scene to be lit.
pub(super) struct LitScene {
    pub(super) scene: Scene,
    /// `true` if it has its own lights and views.
    pub(super) lit: bool,
}

/// The scene, if it is to be lit; `None` for an OBJ, PLY, STL or glTF file whose eye rays a card casts.
pub(super) fn lit(args: &Args) -> miette::Result<Option<LitScene>> {
    if let Some(scene) = scene_name::by_name(&args.scene)? {
        return Ok(Some(LitScene { scene, lit: true }));
    }
    let described = args.scene.extension().is_some_and(|ending| ending == "toml");
    if !described && !args.light.asked() && !args.caster.is_named() {
        return Ok(None);
    }
    Ok(Some(LitScene { scene: model_file::scene(&args.scene)?, lit: described }))
}

/// The camera: see [`Viewpoint::camera`].
pub(super) fn camera(args: &Args, scene: &Scene) -> miette::Result<Camera> {
    Viewpoint { size: args.size, view: args.light.view.as_deref(), eye: args.eye }.camera(scene)
}
