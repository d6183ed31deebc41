//! A scene cut into patches.

use std::collections::BTreeMap;

use super::open::open_parts;
use super::patch::{Patch, PatchPoint};
use super::subdivide::{Face, faces_of, steps_for_at_most, too_thin_error};
use crate::error::{InputError, ensure, input_error};
use crate::geom::Mesh;
use crate::geom::vector::wide;
use crate::linalg::MAX_SQUARE;
use crate::scene::{Scene, Surface};

/// Maximum number of patches: the rows of the largest matrix.
pub const MAX_PATCHES: usize = MAX_SQUARE;

/// Fineness of the subdivision of faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Subdivision {
    /// Number of parts of every side of every face, at least 1: n^2 patches per face.
    PerSide(u32),
    /// Maximum number of patches, at least one per face: sides are cut into parts of lengths as equal as possible.
    AtMost(usize),
}

/// The patches of a scene, with their faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Patches {
    list: Vec<Patch>,
    /// The open parts of patches that are not wholly open.
    open: BTreeMap<u32, Vec<Patch>>,
    mesh: Mesh,
    face_of: Vec<u32>,
    extent: f64,
    /// Reflectance and radiance of each material.
    materials: Vec<([f64; 3], [f64; 3])>,
}

impl Patches {
    /// Cuts a scene's faces. A face is a triangle, or two successive triangles of the same material that form a flat
    /// convex quadrilateral.
    pub fn new(scene: &Scene, subdivision: Subdivision) -> Result<Self, InputError> {
        let mesh = scene.mesh();
        let materials = scene.materials().iter().map(diffuse).collect::<Result<Vec<_>, _>>();
        let (faces, face_of) = faces_of(scene)?;
        let (steps, found) = steps(&faces, subdivision)?;
        let mut list = Vec::with_capacity(found);
        for (id, (face, &steps)) in (0_u32..).zip(faces.iter().zip(&steps)) {
            face.cut(id, steps, &mut list).ok_or_else(|| too_thin_error(face.triangle))?;
        }
        let [low, high] = mesh.bounds().unwrap_or_default().map(wide);
        let (materials, extent) = (materials?, (high - low).length());
        let open = open_parts(&list, mesh, &face_of, extent);
        Ok(Self { list, open, mesh: mesh.clone(), face_of, extent, materials })
    }

    /// All patches, in the order of the matrix's rows.
    pub fn list(&self) -> &[Patch] {
        &self.list
    }

    /// The triangles of the scene, in which visibility rays are traced.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Returns the face that contains a triangle of [`Patches::mesh`]. Panics if there is no such triangle.
    pub fn face_of(&self, triangle: u32) -> u32 {
        self.face_of[triangle as usize]
    }

    /// The diagonal of the scene's bounding box.
    pub fn extent(&self) -> f64 {
        self.extent
    }

    /// Returns the parts of a patch that no solid covers: the patch itself if nothing covers it, no part if it is
    /// wholly covered. Radiosities and form factors are means over the open parts. The rule is in `open.rs`. Panics if
    /// there is no such patch.
    pub fn open_parts(&self, patch: usize) -> &[Patch] {
        let whole = std::slice::from_ref(&self.list[patch]);
        self.open.get(&(patch as u32)).map_or(whole, Vec::as_slice)
    }

    /// Area of the open parts of a patch. Panics if there is no such patch.
    pub fn open_area(&self, patch: usize) -> f64 {
        self.open_parts(patch).iter().map(Patch::area).sum()
    }

    /// Numbers of partly and of wholly covered patches.
    pub fn covered(&self) -> [usize; 2] {
        let altogether = self.open.values().filter(|parts| parts.is_empty()).count();
        [self.open.len() - altogether, altogether]
    }

    /// A point of the open parts, which divide the unit square's first side in proportion to their areas.
    pub(super) fn open_point(&self, patch: usize, [u, v]: [f64; 2]) -> PatchPoint {
        let parts = self.open_parts(patch);
        if let [one] = parts {
            return one.at(u, v);
        }
        let area = self.open_area(patch);
        let mut along = u * area;
        let is_here = |part: &&Patch| {
            let here = along <= part.area();
            along -= if here { 0.0 } else { part.area() };
            here
        };
        // Rounding may lead beyond the last part. A wholly covered patch has no exchange, so its points do not matter.
        let part = parts.iter().find(is_here).or(parts.last()).unwrap_or(&self.list[patch]);
        let point = part.at((along / part.area()).min(1.0), v);
        PatchPoint { density: point.density * (area / part.area()), ..point }
    }

    /// Area of each patch in form factors: of its open parts; a wholly covered patch gets its whole area.
    pub fn areas(&self) -> Vec<f64> {
        let area = |i| if self.open_parts(i).is_empty() { self.list[i].area() } else { self.open_area(i) };
        (0..self.list.len()).map(area).collect()
    }

    /// The reflectance of each patch: red, green, blue.
    pub fn reflectances(&self) -> Vec<[f64; 3]> {
        self.list.iter().map(|patch| self.materials[patch.material as usize].0).collect()
    }

    /// The emittance of each patch: pi times its material's radiance.
    pub fn emittances(&self) -> Vec<[f64; 3]> {
        let emittance = |patch: &Patch| self.materials[patch.material as usize].1.map(|l| std::f64::consts::PI * l);
        self.list.iter().map(emittance).collect()
    }
}

/// Numbers of parts per side of each face, and the number of all patches.
fn steps(faces: &[Face], subdivision: Subdivision) -> Result<(Vec<[u32; 2]>, usize), InputError> {
    ensure!(subdivision != Subdivision::PerSide(0), "radiosity::patches" =>
        "expected sides cut into 1 part or more, found 0");
    let steps = match subdivision {
        Subdivision::PerSide(n) => vec![[n, n]; faces.len()],
        Subdivision::AtMost(most) => steps_for_at_most(faces, most),
    };
    let found = steps.iter().map(|&[u, v]| u as usize * v as usize).sum();
    ensure!(faces.len() <= MAX_PATCHES, "radiosity::patches" =>
        "expected at most {MAX_PATCHES} faces, each at least one patch, found {}", faces.len());
    ensure!(found <= MAX_PATCHES, "radiosity::patches" =>
        "expected at most {MAX_PATCHES} patches, found {found}; cut the faces into fewer");
    Ok((steps, found))
}

/// Reflectance and radiance of a material.
fn diffuse(material: &crate::scene::Material) -> Result<([f64; 3], [f64; 3]), InputError> {
    let found = match material.surface {
        Surface::Diffuse { albedo } => return Ok((albedo.map(f64::from), material.emission.map(f64::from))),
        Surface::Glossy { .. } => "glossy",
        Surface::Mirror { .. } => "a mirror",
        Surface::Glass { .. } => "glass",
    };
    Err(input_error!("radiosity::patches" =>
            "material `{}` is {found}, expected a diffuse surface: radiosity supports no other", material.name))
}
