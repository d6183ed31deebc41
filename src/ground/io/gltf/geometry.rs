//! The triangles of all mesh instances.

use glam::{DMat3, DVec3};
use gltf::mesh::Mode;
use gltf::{Primitive, Semantic};

use super::accessor::{AccessorReader, MAX_ELEMENTS};
use super::material::Materials;
use super::nodes::Instance;
use crate::error::InputError;
use crate::geom::Mesh;
use crate::geom::vector::{narrow, unit, wide};
use crate::io::error::part_error;
use crate::io::scene_obj::flat_where_unknown;

/// Largest number of vertices of a model over all mesh instances.
const MAX_VERTICES: usize = 1 << 24;

/// Vertices and triangles read so far. Missing normals or texture coordinates are zeros.
#[derive(Default)]
pub(super) struct Geometry {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    texcoords: Vec<[f32; 2]>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Index of each triangle's material.
    pub(super) material_of: Vec<u32>,
    some_without: [bool; 2],
    /// Number of corners of all primitives, including the corners of omitted triangles.
    corners: usize,
}

impl Geometry {
    /// Adds a primitive of a mesh instance; points, lines and primitives without positions are ignored.
    pub(super) fn add(
        &mut self,
        instance: &Instance<'_>,
        primitive: &Primitive<'_>,
        materials: &mut Materials,
        reader: &AccessorReader<'_>,
    ) -> Result<(), InputError> {
        let wrong = |expected: &'static str, found: String| {
            part_error(
                reader.name,
                format!("meshes[{}].primitives[{}]", instance.mesh.index(), primitive.index()),
                expected,
                found,
            )
        };
        let mode = primitive.mode();
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(());
        }
        let Some(positions) = primitive.get(&Semantic::Positions) else { return Ok(()) };
        let positions: Vec<[f32; 3]> = reader.vectors(&positions)?;
        let vertices = positions.len();
        let normals = primitive.get(&Semantic::Normals).map(|accessor| reader.vectors::<3>(&accessor)).transpose()?;
        let texcoords =
            primitive.get(&Semantic::TexCoords(0)).map(|accessor| reader.vectors::<2>(&accessor)).transpose()?;
        let indices: Vec<u32> = match primitive.indices() {
            Some(accessor) => reader.indices(&accessor, vertices)?,
            None => (0..vertices as u32).collect(),
        };
        if mode == Mode::Triangles && !indices.len().is_multiple_of(3) {
            return Err(wrong("three vertices per triangle", format!("{} in all", indices.len())));
        }
        for count in [normals.as_ref().map(Vec::len), texcoords.as_ref().map(Vec::len)].into_iter().flatten() {
            if count != vertices {
                return Err(wrong("attributes with as many elements as `POSITION`", count.to_string()));
            }
        }
        self.corners += indices.len();
        if self.positions.len() + vertices > MAX_VERTICES || self.corners > MAX_ELEMENTS {
            let found = format!("{} and {}", self.positions.len() + vertices, self.corners);
            return Err(wrong("at most 16777216 vertices and 67108864 corners, counting copies", found));
        }
        let first = self.positions.len() as u32;
        self.some_without[0] |= normals.is_none();
        self.some_without[1] |= texcoords.is_none();
        let turned = DMat3::from_mat4(instance.to_scene);
        let point = |position: [f32; 3]| narrow(instance.to_scene.transform_point3(wide(position)));
        let across = cofactors(turned);
        let normal = |normal: [f32; 3]| unit(across * wide(normal)).map_or([0.0; 3], narrow);
        self.positions.extend(positions.into_iter().map(point));
        self.normals.extend(normals.unwrap_or_else(|| vec![[0.0; 3]; vertices]).into_iter().map(normal));
        self.texcoords.extend(texcoords.unwrap_or_else(|| vec![[0.0; 2]; vertices]));
        let mirrored = turned.determinant() < 0.0;
        let corners = triangles(mode, &indices).map(|[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] });
        self.triangles.extend(corners.map(|corners| corners.map(|index| first + index)));
        self.material_of.resize(self.triangles.len(), materials.place(primitive.material().index()));
        Ok(())
    }

    /// Normals at the corners of each triangle; all zeros if one of them is missing.
    pub(super) fn corner_normals(&self) -> Vec<[[f32; 3]; 3]> {
        let of = |corners: &[u32; 3]| flat_where_unknown(corners.map(|index| self.normals[index as usize]));
        self.triangles.iter().map(of).collect()
    }

    /// The mesh, with normals or texture coordinates if all its primitives have them.
    pub(super) fn mesh(self) -> Result<Mesh, InputError> {
        let [normals, texcoords] = self.some_without.map(|without| !without);
        Mesh::new(self.positions, self.triangles)?
            .with_attributes(normals.then_some(self.normals), texcoords.then_some(self.texcoords))
    }
}

/// The triangles of a primitive's indices. Degenerate connecting triangles of strips and fans are omitted.
fn triangles(mode: Mode, indices: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    let count = if mode == Mode::Triangles { indices.len() / 3 } else { indices.len().saturating_sub(2) };
    let corners = move |i: usize| match mode {
        Mode::TriangleStrip => [i, i + 1 + i % 2, i + 2 - i % 2],
        Mode::TriangleFan => [0, i + 1, i + 2],
        _ => [3 * i, 3 * i + 1, 3 * i + 2],
    };
    let leads_on = move |&[a, b, c]: &[u32; 3]| mode != Mode::Triangles && (a == b || b == c || c == a);
    (0..count).map(move |i| corners(i).map(|at| indices[at])).filter(move |corners| !leads_on(corners))
}

/// The matrix for normals: the inverse transpose times the absolute determinant. It exists even for scales of 0, and
/// normals still point outwards after mirroring.
fn cofactors(matrix: DMat3) -> DMat3 {
    let DMat3 { x_axis, y_axis, z_axis } = matrix;
    let across = DMat3::from_cols(y_axis.cross(z_axis), z_axis.cross(x_axis), x_axis.cross(y_axis));
    let sign = if x_axis.dot(y_axis.cross(z_axis)) < 0.0 { -1.0 } else { 1.0 };
    across * DMat3::from_diagonal(DVec3::splat(sign))
}
