//! What a scene's OBJ says beyond its geometry, line by line.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

use super::super::obj::{Pass, single};
use super::{SceneObjError, parse_mtl};
use crate::scene::{Material, Scene};

/// What a face is made of that names no material.
const DEFAULT: &str = "default";
/// Reflectance of materials that are named nowhere.
const GREY: f32 = 0.5;
/// How far the square of a normal's length may lie from 1 before it is scaled.
const SLACK: f64 = 1e-4;

/// One face: how many triangles it gives, of which material, with which normals.
struct Face {
    line: usize,
    /// Place in the list of names; none before the first `usemtl`.
    material: Option<usize>,
    /// The normals' numbers as written and counted from 1, a corner each; none if the face is flat.
    normals: Vec<(i64, usize)>,
    corners: usize,
}

/// A scene's lines so far.
pub(super) struct ScenePass<'a> {
    name: &'a Path,
    geometry: Pass<'a>,
    normals: Vec<[f32; 3]>,
    faces: Vec<Face>,
    libraries: Vec<PathBuf>,
    materials: Vec<Material>,
    /// Names that `usemtl` has named, in order.
    used: Vec<String>,
    place_of: BTreeMap<String, usize>,
    current: Option<usize>,
}

impl<'a> ScenePass<'a> {
    pub(super) fn new(name: &'a Path) -> Self {
        Self {
            name,
            geometry: Pass::new(name),
            normals: Vec::new(),
            faces: Vec::new(),
            libraries: Vec::new(),
            materials: Vec::new(),
            used: Vec::new(),
            place_of: BTreeMap::new(),
            current: None,
        }
    }

    pub(super) fn line(
        &mut self,
        line: usize,
        words: &[&[u8]],
        text: &[u8],
        library: &mut dyn FnMut(&Path) -> io::Result<Vec<u8>>,
    ) -> Result<(), SceneObjError> {
        self.geometry.line(line, words, text)?;
        match words.split_first() {
            Some((&b"vn", numbers)) => self.normal(line, text, numbers),
            Some((&b"f", corners)) => self.face(line, text, corners),
            Some((&b"usemtl", _)) => self.material(line, &text[6..]),
            Some((&b"mtllib", _)) => self.library(line, &text[6..], library),
            _ => Ok(()),
        }
    }

    fn normal(&mut self, line: usize, text: &[u8], numbers: &[&[u8]]) -> Result<(), SceneObjError> {
        let &[x, y, z] = numbers else {
            return Err(self.geometry.syntax(line, "a normal `vn x y z`", text).into());
        };
        let mut normal = [0.0; 3];
        for (value, word) in normal.iter_mut().zip([x, y, z]) {
            *value = single(word).map_err(|fault| self.geometry.syntax(line, fault.expected(), word))?;
        }
        self.normals.push(of_length_one(normal));
        Ok(())
    }

    fn face(&mut self, line: usize, text: &[u8], corners: &[&[u8]]) -> Result<(), SceneObjError> {
        // The geometry's pass has checked the corners; only the third number matters here.
        let numbers: Vec<i64> = corners.iter().filter_map(|corner| normal_index(corner)).collect();
        if !numbers.is_empty() && numbers.len() != corners.len() {
            return Err(self.geometry.syntax(line, "normals at all corners of a face, or at none", text).into());
        }
        let seen = self.normals.len();
        let mut normals = Vec::with_capacity(numbers.len());
        for index in numbers {
            let place = match index {
                1.. => usize::try_from(index).ok(),
                _ => usize::try_from(index.unsigned_abs()).ok().and_then(|back| (seen + 1).checked_sub(back)),
            };
            let Some(place) = place.filter(|&place| index != 0 && place > 0) else {
                return Err(SceneObjError::Normal { path: self.name.into(), line, index, normals: seen });
            };
            normals.push((index, place));
        }
        self.faces.push(Face { line, material: self.current, normals, corners: corners.len() });
        Ok(())
    }

    fn material(&mut self, line: usize, rest: &[u8]) -> Result<(), SceneObjError> {
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
    ) -> Result<(), SceneObjError> {
        let file = PathBuf::from(self.rest_of(line, rest, "the name of a library `mtllib name.mtl`")?);
        // Exporters repeat the line for each object.
        if self.libraries.contains(&file) {
            return Ok(());
        }
        let path = self.name.parent().unwrap_or(Path::new("")).join(&file);
        let bytes = library(&file).map_err(|source| SceneObjError::Library {
            path: self.name.into(),
            line,
            library: path.clone(),
            source,
        })?;
        self.materials.extend(parse_mtl(&bytes, &path)?);
        self.libraries.push(file);
        Ok(())
    }

    fn rest_of(&self, line: usize, rest: &[u8], expected: &'static str) -> Result<String, SceneObjError> {
        let name = std::str::from_utf8(rest.trim_ascii()).ok().filter(|name| !name.is_empty());
        name.map(str::to_owned).ok_or_else(|| self.geometry.syntax(line, expected, rest.trim_ascii()).into())
    }

    /// The whole scene, once everything has been read.
    pub(super) fn scene(self) -> Result<Scene, SceneObjError> {
        let Self { name, geometry, normals: list, faces, mut materials, used, .. } = self;
        let mesh = geometry.mesh()?;
        let mut place_of = BTreeMap::<String, u32>::new();
        for (place, material) in (0..).zip(&materials) {
            // Of two libraries the first counts.
            place_of.entry(material.name.clone()).or_insert(place);
        }
        let mut of = |name: &str| {
            *place_of.entry(name.to_owned()).or_insert_with(|| {
                materials.push(Material::diffuse(name, [GREY; 3]));
                materials.len() as u32 - 1
            })
        };
        let (mut material_of, mut normals) = (Vec::with_capacity(mesh.len()), Vec::with_capacity(mesh.len()));
        for face in &faces {
            let material = of(face.material.map_or(DEFAULT, |place| &used[place]));
            let mut corners = Vec::with_capacity(face.normals.len());
            for &(index, place) in &face.normals {
                let beyond =
                    || SceneObjError::Normal { path: name.into(), line: face.line, index, normals: list.len() };
                corners.push(*list.get(place - 1).ok_or_else(beyond)?);
            }
            for corner in 1..face.corners - 1 {
                material_of.push(material);
                let fan = [0, corner, corner + 1].map(|at| corners.get(at).copied().unwrap_or_default());
                // A corner without direction leaves the triangle flat.
                normals.push(if fan.contains(&[0.0; 3]) { [[0.0; 3]; 3] } else { fan });
            }
        }
        Scene::new(mesh, materials, material_of, normals)
            .map_err(|reason| SceneObjError::Scene { path: name.into(), reason })
    }
}

/// A normal that is near enough to length 1 stays as it is, to the bit; another is scaled. One without direction is zero.
fn of_length_one(normal: [f32; 3]) -> [f32; 3] {
    let wide = normal.map(f64::from);
    let square = wide[0] * wide[0] + wide[1] * wide[1] + wide[2] * wide[2];
    if square == 0.0 {
        return [0.0; 3];
    }
    if (square - 1.0).abs() <= SLACK {
        return normal;
    }
    let length = square.sqrt();
    wide.map(|value| (value / length) as f32)
}

/// The normal's index of a corner `v//vn` or `v/vt/vn`.
fn normal_index(corner: &[u8]) -> Option<i64> {
    std::str::from_utf8(corner).ok()?.split('/').nth(2)?.parse().ok()
}
