//! Scene files: a mesh with its materials, views and point lights, as docs/scenes.md shows. The mesh is an OBJ, PLY, STL
//! or glTF file beside the scene file; a model alone is a scene without views and point lights.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::model::{ModelOptions, load_scene_with};
use super::model_note::ModelNote;
use super::read_limited;
use super::scene_obj::{write_mtl, write_scene};
use crate::error::{FilePlace, InputError, input_error};
use crate::names::did_you_mean_field;
use crate::scene::{PointLight, Scene, View};

/// Longest scene file that is read, in bytes (1 MiB); its mesh may be longer.
const LONGEST: u64 = 1 << 20;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    mesh: PathBuf,
    #[serde(default)]
    view: Vec<View>,
    #[serde(default)]
    point_light: Vec<PointLight>,
}

/// File name extensions of models.
const MODELS: [&str; 5] = ["obj", "ply", "stl", "gltf", "glb"];

fn is_model(path: &Path) -> bool {
    MODELS.iter().any(|known| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known)))
}

/// Reads a scene: a model if the file name has a model's extension, else a scene file.
pub fn load(path: &Path) -> Result<Scene, InputError> {
    load_with(path, ModelOptions::STRICT).map(|(scene, _)| scene)
}

/// Like [`load`], with options for the model and notes on it. Views and point lights are not changed.
pub fn load_with(path: &Path, options: ModelOptions) -> Result<(Scene, Vec<ModelNote>), InputError> {
    if is_model(path) {
        return load_scene_with(path, options);
    }
    let read = read_limited(path, LONGEST).map_err(|source| {
        input_error!("crossbar::scene::unreadable" =>
            "cannot read the scene {}", path.display();
            help "check the path; `crossbar scene` lists the scenes that need no file")
        .with_source(source)
    })?;
    let text = read.and_then(|bytes| String::from_utf8(bytes).ok());
    let text = text.ok_or_else(|| {
        input_error!("crossbar::scene::text" =>
            "expected a scene file of at most {LONGEST} bytes of UTF-8";
            help "a scene file is TOML with the name of its mesh: docs/scenes.md")
        .at(path)
    })?;
    let (mesh, views, point_lights) = parse(&text, path)?;
    let (mut scene, notes) = load_scene_with(&path.parent().unwrap_or(Path::new("")).join(mesh), options)?;
    scene.views = views;
    scene.point_lights = point_lights;
    Ok((scene, notes))
}

/// Reads the mesh's path, the views and the lights from a scene file's text.
pub fn parse(text: &str, name: &Path) -> Result<(PathBuf, Vec<View>, Vec<PointLight>), InputError> {
    let file: File = toml::from_str(text).map_err(|error| {
        let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or("");
        let line = before.matches('\n').count() + 1;
        input_error!("crossbar::scene::toml" =>
            "{}", error.message();
            help "{}docs/scenes.md describes what a scene file may say", did_you_mean_field(error.message()))
        .at(FilePlace::line(name, line))
    })?;
    for (at, view) in file.view.iter().enumerate() {
        if file.view[..at].iter().any(|known| known.name == view.name) {
            return Err(input_error!("crossbar::scene::same_name" =>
                "expected views with different names, found {:?} twice", view.name; help "rename one of the two")
            .at(name));
        }
        if let Err(reason) = view.camera(1, 1) {
            return Err(input_error!("crossbar::scene::view" =>
                "view {:?}: {reason}", view.name; help "a view needs an eye away from its target, and another `up`")
            .at(name));
        }
    }
    let sound = |light: &PointLight| {
        light.position.iter().all(|value| value.is_finite())
            && light.intensity.iter().all(|value| value.is_finite() && *value >= 0.0)
    };
    if let Some(place) = file.point_light.iter().position(|light| !sound(light)) {
        return Err(input_error!("crossbar::scene::light" =>
            "point light {} (counted from 1): expected a finite position, and an intensity of at least 0", place + 1;
            help "docs/scenes.md describes point lights")
        .at(name));
    }
    Ok((file.mesh, file.view, file.point_light))
}

/// The three files of a scene, `stem.toml`, `stem.obj` and `stem.mtl`, with their names.
pub fn scene_files(scene: &Scene, stem: &str) -> io::Result<Vec<(String, Vec<u8>)>> {
    let (mesh, library) = (format!("{stem}.obj"), format!("{stem}.mtl"));
    let [mut file, mut obj, mut mtl] = [Vec::new(), Vec::new(), Vec::new()];
    write_scene_file(scene, &mesh, &mut file)?;
    write_scene(scene, &library, &mut obj)?;
    write_mtl(scene.materials(), &mut mtl)?;
    Ok(vec![(format!("{stem}.toml"), file), (mesh, obj), (library, mtl)])
}

/// Writes a scene file that names `mesh`; views and point lights read back with the same bits.
pub fn write_scene_file(scene: &Scene, mesh: &str, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "mesh = {}", toml::Value::from(mesh))?;
    for View { name, eye, target, up, tan_half_height } in &scene.views {
        writeln!(out, "\n[[view]]\nname = {}", toml::Value::from(name.as_str()))?;
        writeln!(out, "eye = {eye:?}\ntarget = {target:?}\nup = {up:?}\ntan_half_height = {tan_half_height:?}")?;
    }
    for PointLight { position, intensity } in &scene.point_lights {
        writeln!(out, "\n[[point_light]]\nposition = {position:?}\nintensity = {intensity:?}")?;
    }
    Ok(())
}
