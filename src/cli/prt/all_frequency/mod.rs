//! The verbs of `crossbar prt` for transfer of all frequencies.

mod arrays;
pub(super) mod card;
pub(super) mod compress;
pub(super) mod error;
pub(super) mod precompute;
pub(super) mod render;
pub(super) mod show;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::model::{load, vertices};
use super::values::KindArg;
use crate::all_frequency::file::{AllFrequencyFile, is_all_frequency, load_all_frequency};
use crate::cli::model_name::Model;
use crate::cli::prt::light::LightArgs;
use crate::cli::scene_name::EyeArgs;
use crate::cli::size::Size;
use crate::cli::{Problem, view};
use crate::scene::{Material, Surface};
use crate::study::prt::LitModel;
use crate::transfer::Vertices;
use crate::transfer::file::MeshDigest;
use crate::transfer::light::Decimation;

/// Whether a file is one of all-frequency transfer, by how it begins. What is no file is none.
pub(super) fn is_such(path: &Path) -> bool {
    let mut head = [0; 16];
    path.is_file()
        && File::open(path).and_then(|mut file| file.read_exact(&mut head)).is_ok()
        && is_all_frequency(&head)
}

/// The same, held against the kind that was asked for.
pub(super) fn is_asked(kind: Option<KindArg>, path: &Path) -> Result<bool, Problem> {
    if kind == Some(KindArg::BiScale) {
        let what = "bi-scale transfer is for `crossbar prt precompute`, `bicluster`, `multiply`, `render` and `show`";
        return Err(Problem::usage(what, "leave `--kind` out, or use these"));
    }
    let (found, asked) = (is_such(path), kind.map(|kind| kind == KindArg::AllFrequency));
    if !path.is_file() || asked.is_none_or(|asked| asked == found) {
        return Ok(found);
    }
    let (expected, other) =
        if found { ("low frequency", "all frequencies") } else { ("all frequencies", "another file") };
    let what = format!("{}: expected transfer of {expected}, found {other}", path.display());
    Err(Problem::usage(what, "leave `--kind` out, or name another file"))
}

/// A file with the model that it was made from.
pub(super) struct FileOfModel {
    pub(super) file: AllFrequencyFile,
    pub(super) model: Model,
    pub(super) vertices: Vertices,
    pub(super) digest: MeshDigest,
}

impl FileOfModel {
    pub(super) fn load(path: &Path, model: &Path) -> miette::Result<Self> {
        let file = load_all_frequency(path, None)?;
        let model = load(model, file.mesh.tangents)?;
        let vertices = vertices(&model, file.mesh.tangents)?;
        let digest = MeshDigest::new(&vertices);
        file.require_mesh(&digest, path)?;
        Ok(Self { file, model, vertices, digest })
    }
}

/// A file with visibility, of the same mesh and reflectance as another.
fn original_of(file: &AllFrequencyFile, mesh: &MeshDigest, path: &Path) -> miette::Result<AllFrequencyFile> {
    view::require_file(path, 3, "name a smaller file")?;
    let original = load_all_frequency(path, Some(mesh))?;
    if original.visibility.is_none() || original.reflectance != file.reflectance || original.hats != file.hats {
        let what = format!("{}: expected visibility with the same reflectance, found other", path.display());
        return Err(Problem::usage(what, "name the file that was compressed").into());
    }
    Ok(original)
}

/// What `render` and `card` draw, as the options of either say.
struct LitArgs<'a> {
    file: &'a Path,
    model: &'a Path,
    original: Option<&'a Path>,
    light: &'a LightArgs,
    keep: Option<u32>,
    eye: &'a EyeArgs,
    size: Size,
    exposure: Option<f64>,
}

impl LitArgs<'_> {
    fn load(&self) -> miette::Result<LitModel> {
        view::require_file(self.file, 3, "name a smaller file")?;
        let FileOfModel { file, model, vertices, digest } = FileOfModel::load(self.file, self.model)?;
        let original = self.original.map(|path| original_of(&file, &digest, path)).transpose()?;
        Ok(LitModel {
            model: self.model.display().to_string(),
            camera: self.eye.framing(&model.mesh, self.size)?,
            colors: model.materials.iter().map(color).collect(),
            mesh: model.mesh,
            vertices,
            file,
            original,
            light_name: self.light.name(),
            light: self.light.distant()?,
            decimation: Decimation::SolidAngle,
            keep: self.keep.map(|keep| keep as usize),
            exposure: self.exposure,
        })
    }
}

/// What a surface's radiance is multiplied by: its albedo, or 1 if it has none.
fn color(material: &Material) -> [f64; 3] {
    match &material.surface {
        Surface::Diffuse { albedo } | Surface::Glossy { albedo, .. } => albedo.map(f64::from),
        _ => [1.0; 3],
    }
}
