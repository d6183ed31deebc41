//! Which scene `crossbar render` is asked for, and from where it is looked at.

use miette::IntoDiagnostic as _;

use super::Args;
use crate::cli::{Problem, view};
use crate::io::scene_file::load;
use crate::scene::{Camera, Scene, built};

/// A scene to be lit.
pub(super) struct Asked {
    pub(super) scene: Scene,
    /// Whether it comes with lights and views of its own.
    pub(super) lit: bool,
}

/// The scene, if it is to be lit; `None` for an OBJ file by its eye rays on a card.
pub(super) fn lit(args: &Args) -> miette::Result<Option<Asked>> {
    let name = args.scene.to_str().unwrap_or_default();
    if let Some(scene) = built::build(name) {
        return Ok(Some(Asked { scene, lit: true }));
    }
    // A word without a dot or a folder is a name, not a file.
    if !args.scene.exists() && args.scene.components().count() == 1 && !name.contains('.') {
        let names: Vec<&str> = built::names().collect();
        let help = format!("the scenes are {}; a file needs its ending, as in `{name}.obj`", names.join(", "));
        return Err(Problem::usage(format!("there is no scene `{name}`"), help).into());
    }
    let described = args.scene.extension().is_some_and(|ending| ending == "toml");
    if !described && !args.light.asked() {
        return Ok(None);
    }
    Ok(Some(Asked { scene: load(&args.scene)?, lit: described }))
}

/// From where: the view asked for, else the eye asked for, else the scene's first view, else so that all is seen.
pub(super) fn camera(args: &Args, scene: &Scene) -> miette::Result<Camera> {
    let size = args.size;
    let view = match &args.light.view {
        Some(_) if args.eye.is_some() || args.target.is_some() => {
            let help = "leave out `--view`, or `--eye` and `--target`";
            return Err(Problem::usage("`--view` says where the eye is", help).into());
        }
        Some(name) => Some(scene.view(name).ok_or_else(|| no_view(scene, name))?),
        None if args.eye.is_some() || args.target.is_some() => None,
        None => scene.views.first(),
    };
    match view {
        Some(view) => view.camera(size.width, size.height).into_diagnostic(),
        None => view::framing(scene.mesh(), size, args.tan_half_height, (args.eye, args.target, args.up)),
    }
}

fn no_view(scene: &Scene, name: &str) -> Problem {
    let names: Vec<&str> = scene.views.iter().map(|view| view.name.as_str()).collect();
    let help = match names.is_empty() {
        true => "it has none: use `--eye` and `--target`".to_owned(),
        false => format!("its views are {}", names.join(", ")),
    };
    Problem::usage(format!("the scene has no view `{name}`"), help)
}
