//! A scene by name or from a file, and its camera.

use std::path::Path;

use miette::IntoDiagnostic as _;

use super::{Problem, given, model_file, view};
use crate::geom::Mesh;
use crate::io::{ModelOptions, scenes};
use crate::names::did_you_mean;
use crate::options::Size;
use crate::options::number;
use crate::scene::{Camera, Scene};

/// A scene of the project, if the path is its name; `None` for a file.
pub(super) fn by_name(path: &Path) -> Result<Option<Scene>, Problem> {
    let name = path.to_str().unwrap_or_default();
    if let Some(scene) = scenes::named(name) {
        model_file::refuse_options(name)?;
        return Ok(Some(scene));
    }
    require_file(path)?;
    Ok(None)
}

/// Refuses a word that is neither a file nor the name of a scene.
fn require_file(path: &Path) -> Result<(), Problem> {
    given::require_file(path, "scene", &scenes::names().collect::<Vec<_>>(), "obj")
}

/// The scene that surrounds a model and lights it. Options of model files apply to the model, not to this scene.
pub(super) fn surroundings(path: &Path) -> miette::Result<Scene> {
    if let Some(scene) = scenes::named(path.to_str().unwrap_or_default()) {
        return Ok(scene);
    }
    require_file(path)?;
    model_file::scene_with(path, ModelOptions::default())
}

/// The path, unless it is the name of a scene of the project.
pub(super) fn named_file(path: &Path) -> Vec<&Path> {
    if scenes::names().any(|name| path == Path::new(name)) { Vec::new() } else { vec![path] }
}

/// A scene of the project by its name, or from a scene file or an OBJ, PLY, STL or glTF file.
pub(super) fn scene(path: &Path) -> miette::Result<Scene> {
    Ok(match by_name(path)? {
        Some(scene) => scene,
        None => model_file::scene(path)?,
    })
}

/// A camera chosen by the user.
#[derive(Clone, Copy, Debug, Default, clap::Args)]
pub(super) struct EyeArgs {
    /// Position of the camera [default: far enough to see the whole scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = number::point, allow_hyphen_values = true)]
    pub(super) eye: Option<[f32; 3]>,

    /// Point that the camera looks at [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = number::point, allow_hyphen_values = true)]
    pub(super) target: Option<[f32; 3]>,

    /// Tangent of half the vertical field of view, for a camera that is not a view of the scene [default: 0.375]
    #[arg(long, value_name = "TAN", value_parser = number::single)]
    pub(super) tan_half_height: Option<f32>,
}

impl EyeArgs {
    pub(super) fn is_default(&self) -> bool {
        let Self { eye, target, tan_half_height } = *self;
        eye.is_none() && target.is_none() && tan_half_height.is_none()
    }

    /// A camera; without `--eye`, one that shows the whole mesh. Up is z, or y for a vertical line of sight.
    pub(super) fn framing(&self, mesh: &Mesh, size: Size) -> miette::Result<Camera> {
        let is_upright = self.eye.zip(self.target).is_some_and(|(eye, target)| eye[..2] == target[..2]);
        let up = if is_upright { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        view::framing(mesh, size, self.tan_half_height.unwrap_or(0.375), (self.eye, self.target, up))
    }

    /// Rejects options that a view of the scene determines.
    fn require_no_lens(&self, view: &str) -> Result<(), Problem> {
        if self.tan_half_height.is_none() {
            return Ok(());
        }
        let what = format!("`--tan-half-height` needs `--eye` or `--target`, found view `{view}` of the scene");
        Err(Problem::usage(what, "add `--eye` or `--target`, or remove `--tan-half-height`"))
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Viewpoint<'a> {
    pub(super) size: Size,
    pub(super) view: Option<&'a str>,
    pub(super) eye: EyeArgs,
}

impl Viewpoint<'_> {
    /// The requested view or eye, otherwise the scene's first view, otherwise a view of the whole scene.
    pub(super) fn camera(&self, scene: &Scene) -> miette::Result<Camera> {
        let aimed = self.eye.eye.is_some() || self.eye.target.is_some();
        let view = match self.view {
            Some(_) if aimed => {
                let help = "remove `--view`, or remove `--eye` and `--target`";
                return Err(Problem::usage("`--view` already places the camera", help).into());
            }
            Some(name) => Some(scene.view(name).ok_or_else(|| no_view(scene, name))?),
            None if aimed => None,
            None => scene.views.first(),
        };
        match view {
            Some(view) => {
                self.eye.require_no_lens(&view.name)?;
                view.camera(self.size.width, self.size.height).into_diagnostic()
            }
            None => self.eye.framing(scene.mesh(), self.size),
        }
    }
}

fn no_view(scene: &Scene, name: &str) -> Problem {
    let names: Vec<&str> = scene.views.iter().map(|view| view.name.as_str()).collect();
    let help = match names.is_empty() {
        true => "the scene has no named views: use `--eye` and `--target`".to_owned(),
        false => format!("{}its views are {}", did_you_mean(name, names.iter().copied()), names.join(", ")),
    };
    Problem::usage(format!("the scene has no view `{name}`"), help)
}
