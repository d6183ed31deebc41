//! The `.npz` files of `crossbar all-frequency`, their models, and the drawn model.

use std::io;
use std::path::{Component, Path, PathBuf, absolute};

use crate::all_frequency::file::{AllFrequencyFile, load_all_frequency};
use crate::cli::Problem;
use crate::cli::model_name::Model;
use crate::cli::transfer::light::{CUBE_LIGHT, DEFAULT_LIGHT, DistantLightArg};
use crate::cli::transfer::model::model_of;
use crate::cli::transfer::picture::PictureArgs;
use crate::options::number;
use crate::scene::{Material, Surface};
use crate::study::prt::{LitGround, LitModel};
use crate::transfer::Vertices;
use crate::transfer::file::MeshDigest;

/// A file with the model from which it was made.
pub(super) struct FileOfModel {
    pub(super) file: AllFrequencyFile,
    pub(super) model: Model,
    pub(super) vertices: Vertices,
    pub(super) digest: MeshDigest,
}

impl FileOfModel {
    pub(super) fn load(path: &Path, model: &Path) -> miette::Result<Self> {
        Self::of(load_all_frequency(path, None)?, path, model)
    }

    fn of(file: AllFrequencyFile, path: &Path, model: &Path) -> miette::Result<Self> {
        let (model, vertices, digest) = model_of(path, Some(file.mesh), model)?;
        Ok(Self { file, model, vertices, digest })
    }
}

/// A file with visibility, for the same mesh and reflectance as another file.
fn original_of(file: &AllFrequencyFile, mesh: &MeshDigest, path: &Path) -> miette::Result<AllFrequencyFile> {
    let original = load_all_frequency(path, Some(mesh))?;
    if original.visibility.is_none() || original.reflectance != file.reflectance || original.hats != file.hats {
        let what = format!("{}: expected visibility with the same reflectance, found other", path.display());
        return Err(Problem::usage(what, "name the file that was compressed").into());
    }
    Ok(original)
}

/// A ground, with the model that its file names.
fn ground(path: &Path) -> miette::Result<LitGround> {
    let file = load_all_frequency(path, None)?;
    let Some(model) = file.model.as_ref().map(|name| path.with_file_name(name)) else {
        let what = format!("{}: expected a ground, whose file names its model, found none named", path.display());
        let help = "name the ground that `crossbar all-frequency precompute --ground` wrote, or its compressed form";
        return Err(Problem::usage(what, help).into());
    };
    let FileOfModel { file, model, vertices, .. } = FileOfModel::of(file, path, &model)?;
    Ok(LitGround { colors: model.materials.iter().map(color).collect(), mesh: model.mesh, vertices, file })
}

/// Relative path from a file's folder to another file.
pub(super) fn path_from(file: &Path, to: &Path) -> io::Result<String> {
    let [file, to] = [absolute(file)?, absolute(to)?];
    let (from, to) = (file.parent().unwrap_or(&file).components(), to.components());
    let shared = from.clone().zip(to.clone()).take_while(|(a, b)| a == b).count();
    let up = from.skip(shared).map(|_| Component::ParentDir);
    Ok(up.chain(to.skip(shared)).collect::<PathBuf>().to_string_lossy().into_owned())
}

/// Factor of a surface's radiance: its albedo, or 1 if it has none.
fn color(material: &Material) -> [f64; 3] {
    match &material.surface {
        Surface::Diffuse { albedo } | Surface::Glossy { albedo, .. } => albedo.map(f64::from),
        _ => [1.0; 3],
    }
}

/// Model, light and camera of `render` and `card`.
#[derive(Debug, clap::Args)]
pub(super) struct LitArgs {
    /// Visibility or coded transfer; coded transfer is drawn if there are both
    #[arg(value_name = "FILE.npz")]
    file: PathBuf,

    /// A file with visibility of the same model, to measure the loss of compression
    #[arg(long, value_name = "X.npz")]
    original: Option<PathBuf>,

    #[arg(long, value_name = "LIGHT", default_value = DEFAULT_LIGHT, allow_hyphen_values = true, help = CUBE_LIGHT)]
    light: DistantLightArg,

    /// Number of light coefficients kept, largest area times magnitude first [default: all]
    #[arg(long, value_name = "N", value_parser = number::whole::<u32>(1..=6144))]
    keep: Option<u32>,

    #[command(flatten)]
    picture: PictureArgs,

    /// The ground that `crossbar all-frequency precompute --ground` wrote, compressed or not; it is found with its model
    #[arg(long, value_name = "G.npz")]
    ground: Option<PathBuf>,
}

impl LitArgs {
    /// The input files.
    pub(super) fn inputs(&self) -> Vec<&Path> {
        let files = [Some(self.file.as_path()), self.original.as_deref(), self.light.file(), self.ground.as_deref()];
        files.into_iter().flatten().chain(self.picture.inputs()).collect()
    }

    /// The model under its light.
    pub(super) fn load(&self) -> miette::Result<LitModel> {
        let FileOfModel { file, model, vertices, digest } = FileOfModel::load(&self.file, &self.picture.model)?;
        let original = self.original.as_deref().map(|path| original_of(&file, &digest, path)).transpose()?;
        Ok(LitModel {
            view: self.picture.view(&model.mesh, self.light.name())?,
            colors: model.materials.iter().map(color).collect(),
            mesh: model.mesh,
            vertices,
            file,
            original,
            ground: self.ground.as_deref().map(ground).transpose()?,
            light: self.light.distant()?,
            keep: self.keep.map(|keep| keep as usize),
        })
    }
}
