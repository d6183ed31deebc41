//! Reads the parts of a scene's OBJ file beyond its geometry, line by line.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use super::super::error::{FilePlace, ModelError};
use super::super::model_note::ModelNote;
use super::super::obj::ObjReader;
use super::mtl::read_mtl;
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit, wide};
use crate::scene::{Material, Scene};

/// Name of the material of faces without one.
const DEFAULT: &str = "default";
/// Reflectance of materials that no library defines.
const GREY: f32 = 0.5;
/// Largest difference of a normal's squared length from 1 at which it is not scaled.
const SLACK: f64 = 1e-4;

/// State of the reader of a scene.
#[derive(Default)]
pub(super) struct SceneReader {
    name: PathBuf,
    geometry: ObjReader,
    /// Per face the index of its material's name in `used`; `None` before the first `usemtl`.
    material_of: Vec<Option<usize>>,
    libraries: Vec<PathBuf>,
    materials: Vec<Material>,
    /// Material names of `usemtl` lines, in order.
    used: Vec<String>,
    place_of: BTreeMap<String, usize>,
    current: Option<usize>,
    /// Notes on changed materials; `None` if such materials are refused.
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
    ) -> Result<(), ModelError> {
        self.geometry.line(line, words, text)?;
        match words.split_first() {
            Some((&b"f", _)) => self.face(line, text),
            Some((&b"usemtl", _)) => self.material(line, &text[6..]),
            Some((&b"mtllib", _)) => self.library(line, &text[6..], library),
            _ => Ok(()),
        }
    }

    fn face(&mut self, line: usize, text: &[u8]) -> Result<(), ModelError> {
        let corners = self.geometry.last_face();
        let with_normals = corners.iter().filter(|corner| corner[2] > 0).count();
        if with_normals != 0 && with_normals != corners.len() {
            return Err(self.geometry.syntax(line, "normals at all corners of a face, or at none", text));
        }
        self.material_of.push(self.current);
        Ok(())
    }

    fn material(&mut self, line: usize, rest: &[u8]) -> Result<(), ModelError> {
        let name = self.rest_of(line, rest, "the name of a material `usemtl name`")?;
        let next = self.used.len();
        let place = *self.place_of.entry(name.clone()).or_insert(next);
        if place == next {
            self.used.push(name);
        }
        self.current = Some(place);
        Ok(())
    }

    fn library(
        &mut self,
        line: usize,
        rest: &[u8],
        library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<(), ModelError> {
        let file = PathBuf::from(self.rest_of(line, rest, "the name of a library `mtllib name.mtl`")?);
        // Exporters repeat the line for every object.
        if self.libraries.contains(&file) {
            return Ok(());
        }
        let path = self.name.parent().unwrap_or(Path::new("")).join(&file);
        let bytes = library(&file).map_err(|source| {
            let place = FilePlace::line(&self.name, line);
            ModelError::Library { place, library: path.clone(), source }
        })?;
        self.materials.extend(read_mtl(&bytes, &path, self.notes.as_mut())?);
        self.libraries.push(file);
        Ok(())
    }

    fn rest_of(&self, line: usize, rest: &[u8], expected: &'static str) -> Result<String, ModelError> {
        let name = std::str::from_utf8(rest.trim_ascii()).ok().filter(|name| !name.is_empty());
        name.map(str::to_owned).ok_or_else(|| self.geometry.syntax(line, expected, rest.trim_ascii()))
    }

    /// The scene, once all lines have been read, with notes on changes.
    pub(super) fn scene(self) -> Result<(Scene, Vec<ModelNote>), ModelError> {
        let Self { name, mut geometry, material_of: faces, mut materials, used, notes, .. } = self;
        let mesh = geometry.mesh(false)?;
        let list: Vec<[f32; 3]> = geometry.normals().iter().copied().map(of_length_one).collect();
        let mut place_of = BTreeMap::<String, u32>::new();
        for (place, material) in (0..).zip(&materials) {
            // Of two libraries with the same material, the first counts.
            place_of.entry(material.name.clone()).or_insert(place);
        }
        let mut of = |name: &str| {
            *place_of.entry(name.to_owned()).or_insert_with(|| {
                materials.push(Material::diffuse(name, [GREY; 3]));
                materials.len() as u32 - 1
            })
        };
        let (mut material_of, mut normals) = (Vec::with_capacity(mesh.len()), Vec::with_capacity(mesh.len()));
        for (face, place) in geometry.faces().zip(faces) {
            let material = of(place.map_or(DEFAULT, |place| &used[place]));
            let corners: Vec<[f32; 3]> =
                face.iter().filter_map(|corner| list.get(corner[2].wrapping_sub(1))).copied().collect();
            for corner in 1..face.len() - 1 {
                material_of.push(material);
                let fan = [0, corner, corner + 1].map(|at| corners.get(at).copied().unwrap_or_default());
                // If a corner has no normal, the triangle is flat.
                normals.push(if fan.contains(&[0.0; 3]) { [[0.0; 3]; 3] } else { fan });
            }
        }
        let scene = Scene::new(mesh, materials, material_of, normals)
            .map_err(|reason| ModelError::Scene(name.as_path().into(), reason))?;
        Ok((scene, notes.unwrap_or_default()))
    }
}

/// The scene of a mesh without materials, with the normals of its vertices.
pub(in super::super) fn plain_scene(mesh: Mesh, name: &Path) -> Result<Scene, ModelError> {
    let normals = mesh.normals().map_or_else(Vec::new, |normals| {
        let corner = |&index: &u32| of_length_one(normals[index as usize]);
        let flat_where_unknown = |fan: [[f32; 3]; 3]| if fan.contains(&[0.0; 3]) { [[0.0; 3]; 3] } else { fan };
        mesh.triangles().iter().map(|triangle| flat_where_unknown(triangle.each_ref().map(corner))).collect()
    });
    let material_of = vec![0; mesh.len()];
    Scene::new(mesh, vec![Material::diffuse(DEFAULT, [GREY; 3])], material_of, normals)
        .map_err(|reason| ModelError::Scene(name.into(), reason))
}

/// A normal whose length is close to 1 is kept, bit for bit; others are scaled to length 1. A normal without a
/// direction is zero.
fn of_length_one(normal: [f32; 3]) -> [f32; 3] {
    if (wide(normal).length_squared() - 1.0).abs() <= SLACK {
        return normal;
    }
    unit(wide(normal)).map_or([0.0; 3], narrow)
}
