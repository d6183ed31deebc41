//! Reads a scene's OBJ file line by line: materials and normals in addition to the geometry.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use super::super::lines::{before_comment, decoded};
use super::super::model_note::ModelNote;
use super::super::obj::{ObjCorner, ObjReader};
use super::mtl::read_mtl;
use crate::error::{FilePlace, InputError, input_error};
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit, wide};
use crate::io::error::{material_error, scene_error};
use crate::scene::{Material, Scene};

/// Name of the material of faces without a material.
pub(in super::super) const DEFAULT: &str = "default";
/// Reflectance of materials that no library defines.
pub(in super::super) const GREY: f32 = 0.5;
/// Largest difference of a normal's squared length from 1 for which the normal is not rescaled.
const SLACK: f64 = 1e-4;

#[derive(Default)]
pub(super) struct SceneReader {
    name: PathBuf,
    geometry: ObjReader,
    /// For each face, the index of its material's name in `used`; `None` before the first `usemtl`.
    material_of: Vec<Option<usize>>,
    /// Names of libraries, and lines that list several names.
    libraries: Vec<String>,
    materials: Vec<Material>,
    /// Material names of `usemtl` lines, in order, each with its first line.
    used: Vec<(String, usize)>,
    place_of: BTreeMap<String, usize>,
    current: Option<usize>,
    /// Notes on changed materials; `None` if such materials are rejected.
    notes: Option<Vec<ModelNote>>,
}

impl SceneReader {
    pub(super) fn new(name: &Path, strict: bool) -> Self {
        let notes = (!strict).then(Vec::new);
        Self { name: name.into(), geometry: ObjReader::new(name), notes, ..Self::default() }
    }

    pub(super) fn line(
        &mut self,
        line: usize,
        words: &[&[u8]],
        text: &[u8],
        library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<(), InputError> {
        self.geometry.line(line, words, text)?;
        match words.split_first() {
            Some((&b"f", _)) => self.face(line, text),
            Some((&b"usemtl", _)) => self.material(line, &text[6..]),
            Some((&b"mtllib", _)) => self.library(line, &text[6..], library),
            _ => Ok(()),
        }
    }

    fn face(&mut self, line: usize, text: &[u8]) -> Result<(), InputError> {
        let corners = self.geometry.faces().last();
        let with_normals = corners.iter().filter(|corner| corner[2] > 0).count();
        if with_normals != 0 && with_normals != corners.len() {
            return Err(self.geometry.syntax(line, "normals at all corners of a face, or at no corner", text));
        }
        self.material_of.push(self.current);
        Ok(())
    }

    fn material(&mut self, line: usize, rest: &[u8]) -> Result<(), InputError> {
        let name = self.rest_of(line, rest, "the name of a material `usemtl name`")?;
        let next = self.used.len();
        let place = *self.place_of.entry(name.clone()).or_insert(next);
        if place == next {
            self.used.push((name, line));
        }
        self.current = Some(place);
        Ok(())
    }

    fn library(
        &mut self,
        line: usize,
        rest: &[u8],
        library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<(), InputError> {
        let whole = self.rest_of(line, rest, "the name of a library `mtllib name.mtl`")?;
        // Some exporters repeat the line for every object.
        if self.libraries.contains(&whole) {
            return Ok(());
        }
        let (mut read, several) = (vec![(whole.clone(), library(Path::new(&whole)))], several_libraries(&whole));
        if read[0].1.is_err() && !several.is_empty() {
            read = several.into_iter().map(|file| (file.to_owned(), library(Path::new(file)))).collect();
        }
        for (file, bytes) in read {
            let path = self.name.parent().unwrap_or(Path::new("")).join(&file);
            let bytes = bytes.map_err(|source| {
                let place = FilePlace::line(&self.name, line);
                input_error!("crossbar::model::library" =>
                    "cannot read the material library {}", path.display();
                    help "put it beside the model, or remove the line")
                .with_source(source)
                .at(place)
            })?;
            if !self.libraries.contains(&file) {
                self.materials.extend(read_mtl(&bytes, &path, self.notes.as_mut())?);
                self.libraries.push(file);
            }
        }
        self.libraries.push(whole);
        Ok(())
    }

    fn rest_of(&self, line: usize, rest: &[u8], expected: &'static str) -> Result<String, InputError> {
        let name = Some(decoded(rest.trim_ascii())).filter(|name| !name.is_empty());
        name.ok_or_else(|| self.geometry.syntax(line, expected, b""))
    }

    /// Returns the scene after all lines have been read, with notes on changes.
    pub(super) fn scene(self) -> Result<(Scene, Vec<ModelNote>), InputError> {
        let Self { name, geometry, material_of: faces, mut materials, used, mut notes, .. } = self;
        let (triangles, odd_faces) = geometry.triangles(notes.is_none())?;
        let mesh = geometry.mesh(&triangles, false)?;
        let list: Vec<[f32; 3]> = geometry.normals().iter().copied().map(of_length_one).collect();
        let (mut known, mut place_of) = (BTreeMap::new(), BTreeMap::<Option<usize>, u32>::new());
        for (place, material) in (0..).zip(&materials) {
            // If two libraries have the same material, the first library counts.
            known.entry(material.name.clone()).or_insert(place);
        }
        let mut material_of = Vec::with_capacity(mesh.len());
        for ((_, face), current) in geometry.faces().iter().zip(faces) {
            let place = match place_of.get(&current) {
                Some(&place) => place,
                None => {
                    let (material, line) = current.map_or((DEFAULT, None), |at| (&*used[at].0, Some(used[at].1)));
                    let found = known.get(material).copied();
                    if let (None, Some(line)) = (found, line) {
                        let (place, material) = (FilePlace::line(&name, line), material.to_owned());
                        let Some(notes) = &mut notes else {
                            let (expected, found) = ("a material of its libraries", "no such material".to_owned());
                            return Err(material_error(place, material, expected, found));
                        };
                        notes.push(ModelNote::Unknown { place, material });
                    }
                    let place = found.unwrap_or_else(|| {
                        materials.push(Material::diffuse(material, [GREY; 3]));
                        let place = materials.len() as u32 - 1;
                        known.insert(material.to_owned(), place);
                        place
                    });
                    place_of.insert(current, place);
                    place
                }
            };
            material_of.extend(std::iter::repeat_n(place, face.len() - 2));
        }
        let normal = |corner: ObjCorner| list.get((corner[2] as usize).wrapping_sub(1)).copied().unwrap_or_default();
        let normals = triangles.iter().map(|corners| flat_where_unknown(corners.map(normal))).collect();
        let scene = Scene::new(mesh, materials, material_of, normals).map_err(|reason| scene_error(&name, reason))?;
        Ok((scene, notes.into_iter().flatten().chain(odd_faces).collect()))
    }
}

/// The normals of a triangle's corners; if a corner has none, the triangle is flat.
pub(in super::super) fn flat_where_unknown(corners: [[f32; 3]; 3]) -> [[f32; 3]; 3] {
    if corners.contains(&[0.0; 3]) { [[0.0; 3]; 3] } else { corners }
}

/// The names in a line of several libraries; each ends with a word that ends in `.mtl`.
fn several_libraries(line: &str) -> Vec<&str> {
    let line = line[..before_comment(line.as_bytes()).len()].trim_end();
    let (mut files, mut rest, mut end) = (Vec::new(), line, 0);
    for word in rest.split_inclusive(|c: char| c.is_ascii_whitespace()) {
        end += word.len();
        if word.trim_end().to_ascii_lowercase().ends_with(".mtl") {
            files.push(rest[..end].trim());
            (rest, end) = (&rest[end..], 0);
        }
    }
    files.extend(Some(rest.trim()).filter(|file| !file.is_empty()));
    files
}

/// The scene of a mesh without materials, with the normals of its vertices.
pub(in super::super) fn plain_scene(mesh: Mesh, name: &Path) -> Result<Scene, InputError> {
    let normals = mesh.normals().map_or_else(Vec::new, |normals| {
        let corner = |&index: &u32| of_length_one(normals[index as usize]);
        mesh.triangles().iter().map(|triangle| flat_where_unknown(triangle.each_ref().map(corner))).collect()
    });
    let material_of = vec![0; mesh.len()];
    Scene::new(mesh, vec![Material::diffuse(DEFAULT, [GREY; 3])], material_of, normals)
        .map_err(|reason| scene_error(name, reason))
}

/// Scales a normal to length 1. A normal whose length is close to 1 is kept bit for bit; a normal without a direction
/// becomes zero.
fn of_length_one(normal: [f32; 3]) -> [f32; 3] {
    if (wide(normal).length_squared() - 1.0).abs() <= SLACK {
        return normal;
    }
    unit(wide(normal)).map_or([0.0; 3], narrow)
}
