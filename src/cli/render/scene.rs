//! Which scene `crossbar render` is asked for, and from where it is looked at.

use super::Args;
use crate::cli::scene_name::{self, Stand};
use crate::cli::view;
use crate::io::scene_file::load;
use crate::scene::{Camera, Scene};

/// A scene to be lit.
pub(super) struct Asked {
    pub(super) scene: Scene,
    /// Whether it comes with lights and views of its own.
    pub(super) lit: bool,
}

/// The scene, if it is to be lit; `None` for an OBJ or PLY file by its eye rays on a card.
pub(super) fn lit(args: &Args) -> miette::Result<Option<Asked>> {
    if let Some(scene) = scene_name::by_name(&args.scene)? {
        return Ok(Some(Asked { scene, lit: true }));
    }
    let described = args.scene.extension().is_some_and(|ending| ending == "toml");
    if !described && !args.light.asked() {
        return Ok(None);
    }
    view::require_mesh(&args.scene)?;
    Ok(Some(Asked { scene: load(&args.scene)?, lit: described }))
}

/// From where: see [`Stand::camera`].
pub(super) fn camera(args: &Args, scene: &Scene) -> miette::Result<Camera> {
    Stand { size: args.size, view: args.light.view.as_deref(), eye: args.eye }.camera(scene)
}
