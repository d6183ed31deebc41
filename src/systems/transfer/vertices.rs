//! The vertices at which transfer is computed: unique combinations of position, normal and tangent.

use std::collections::BTreeMap;
use std::fmt;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::frame::LocalFrame;
use crate::error::{InputError, ensure, input_error};
use crate::geom::Mesh;
use crate::geom::vector::{place_bits, unit, wide};

/// The source of the tangents.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Tangents {
    /// Any direction perpendicular to the normal, for isotropic materials.
    #[default]
    Any,
    /// The direction in which the first texture coordinate increases, as the area-weighted mean over the triangles
    /// around a vertex. Vertices are split where the texture is mirrored.
    Texture,
    /// An axis, projected onto the plane perpendicular to the normal.
    Along(DVec3),
}

impl fmt::Display for Tangents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => f.write_str("any"),
            Self::Texture => f.write_str("texture"),
            Self::Along(DVec3 { x, y, z }) => write!(f, "{x},{y},{z}"),
        }
    }
}

impl From<Tangents> for String {
    fn from(tangents: Tangents) -> Self {
        tangents.to_string()
    }
}

impl TryFrom<String> for Tangents {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        let axis = || {
            let numbers: Vec<f64> = text.split(',').map(|number| number.trim().parse().ok()).collect::<Option<_>>()?;
            let axis = DVec3::from_array(numbers.try_into().ok()?);
            unit(axis).map(|_| Self::Along(axis))
        };
        match text.as_str() {
            "any" => Ok(Self::Any),
            "texture" => Ok(Self::Texture),
            _ => axis().ok_or_else(|| {
                format!("expected tangents `any`, `texture` or an axis X,Y,Z of finite length above 0, found `{text}`")
            }),
        }
    }
}

/// A mesh with separate vertices for each combination of position, normal, tangent and material, and their local
/// frames. Triangles keep the source mesh's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Vertices {
    positions: Vec<[f32; 3]>,
    frames: Vec<LocalFrame>,
    materials: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    tangents: Tangents,
    /// Number of unused vertices of the source, which are dropped.
    pub unused: usize,
    /// Vertices whose tangent was parallel to the normal, and was replaced by an arbitrary one.
    pub replaced_tangents: Vec<u32>,
}

/// Key of unique vertices: bits of position and normal, handedness of the texture, and material.
type VertexKey = ([u32; 3], [u64; 3], bool, u32);

impl Vertices {
    /// Positions and triangles, for [`seen_pixels`](crate::card::seen_pixels).
    pub fn geometry(&self) -> (&[[f32; 3]], &[[u32; 3]]) {
        (&self.positions, &self.triangles)
    }

    /// The vertices of a mesh with one material. Normals are the mesh's, or else the area-weighted mean over the
    /// triangles at the same position. Fails with [`InputError`] for a mesh without triangles, a vertex without a
    /// normal, or tangents that cannot be computed.
    pub fn new(mesh: &Mesh, tangents: Tangents) -> Result<Self, InputError> {
        Self::with_materials(mesh, &vec![0; mesh.len()], tangents)
    }

    /// Like [`Self::new`], with a material per triangle. Fails as [`Self::new`] does, and if there is not one material
    /// per triangle.
    pub fn with_materials(mesh: &Mesh, materials: &[u32], tangents: Tangents) -> Result<Self, InputError> {
        ensure!(!mesh.is_empty(), "crossbar::prt::precompute" =>
            "expected a mesh of at least one triangle, found none");
        ensure!(materials.len() == mesh.len(), "crossbar::prt::precompute" =>
            "expected one material per triangle, {}, found {}", mesh.len(), materials.len());
        let normals = normals(mesh)?;
        let texture = match tangents {
            Tangents::Texture => Some(mesh.texcoords().ok_or_else(|| {
                input_error!("crossbar::prt::precompute" =>
                    "the mesh has no texture coordinates to take tangents from"; help "give an axis for the tangents")
            })?),
            Tangents::Any => None,
            Tangents::Along(axis) if unit(axis).is_some() => None,
            Tangents::Along(axis) => {
                return Err(input_error!("crossbar::prt::precompute" =>
                        "expected an axis of finite length above 0 for the tangents, found {:?}", axis.to_array()));
            }
        };
        let mut known: BTreeMap<VertexKey, u32> = BTreeMap::new();
        let (mut of, mut sums, mut materials_of) = (Vec::new(), Vec::new(), Vec::new());
        let mut triangles = Vec::with_capacity(mesh.len());
        for (indices, &material) in mesh.triangles().iter().zip(materials) {
            let (along, mirrored) = texture.map_or((DVec3::ZERO, false), |texture| gradient(mesh, *indices, texture));
            triangles.push(indices.map(|source| {
                let normal = normals[source as usize];
                let key = (place(mesh, source), normal.to_array().map(f64::to_bits), mirrored, material);
                let vertex = *known.entry(key).or_insert_with(|| {
                    of.push(source);
                    sums.push(DVec3::ZERO);
                    materials_of.push(material);
                    of.len() as u32 - 1
                });
                sums[vertex as usize] += along;
                vertex
            }));
        }
        let mut replaced_tangents = Vec::new();
        let frames = of.iter().zip(&sums).zip(0..).map(|((&source, &sum), vertex)| {
            let normal = normals[source as usize];
            let wanted = match tangents {
                Tangents::Any => return LocalFrame::of_normal(normal),
                Tangents::Texture => sum,
                Tangents::Along(axis) => axis,
            };
            LocalFrame::new(normal, wanted).unwrap_or_else(|| {
                replaced_tangents.push(vertex);
                LocalFrame::of_normal(normal)
            })
        });
        let frames = frames.collect();
        let positions = of.iter().map(|&source| mesh.positions()[source as usize]).collect();
        let unused = mesh.positions().len() - used(mesh).into_iter().filter(|&used| used).count();
        Ok(Self { positions, frames, materials: materials_of, triangles, tangents, unused, replaced_tangents })
    }

    /// Joins two meshes: vertices, triangles and frames of `self`, then of `others`. Material indices are not changed.
    #[must_use]
    pub fn joined(&self, others: &Self) -> Self {
        let first = self.positions.len() as u32;
        let moved = |vertex: &u32| vertex + first;
        let triangles = others.triangles.iter().map(|corners| corners.map(|corner| corner + first));
        Self {
            positions: [&self.positions[..], &others.positions].concat(),
            frames: [&self.frames[..], &others.frames].concat(),
            materials: [&self.materials[..], &others.materials].concat(),
            triangles: self.triangles.iter().copied().chain(triangles).collect(),
            tangents: self.tangents,
            unused: self.unused + others.unused,
            replaced_tangents: [
                &self.replaced_tangents[..],
                &others.replaced_tangents.iter().map(moved).collect::<Vec<_>>(),
            ]
            .concat(),
        }
    }

    /// The number of vertices.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Always false: there is at least one triangle.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Position of each vertex.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Local frame of each vertex.
    pub fn frames(&self) -> &[LocalFrame] {
        &self.frames
    }

    /// Material of each vertex.
    pub fn materials(&self) -> &[u32] {
        &self.materials
    }

    /// The vertices of each triangle, in the order of the source mesh.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The source of the frames' tangents.
    pub fn tangents(&self) -> Tangents {
        self.tangents
    }

    pub(crate) fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|vertex| wide(self.positions[vertex as usize]))
    }
}

/// Position as bits, where -0 and +0 are equal.
fn place(mesh: &Mesh, vertex: u32) -> [u32; 3] {
    place_bits(mesh.positions()[vertex as usize])
}

fn used(mesh: &Mesh) -> Vec<bool> {
    let mut used = vec![false; mesh.positions().len()];
    mesh.triangles().iter().flatten().for_each(|&vertex| used[vertex as usize] = true);
    used
}

/// A unit normal per vertex of the source; zero for unused vertices.
fn normals(mesh: &Mesh) -> Result<Vec<DVec3>, InputError> {
    let mut sums: BTreeMap<[u32; 3], DVec3> = BTreeMap::new();
    for (indices, corners) in mesh.triangles().iter().zip(mesh.iter_corners()) {
        let [a, b, c] = corners.map(wide);
        let normal = (b - a).cross(c - a);
        indices.iter().for_each(|&vertex| *sums.entry(place(mesh, vertex)).or_default() += normal);
    }
    // Adding 0 makes -0 and +0 equal.
    let given = |vertex: usize| mesh.normals().and_then(|normals| unit(wide(normals[vertex]) + DVec3::ZERO));
    let around = |vertex: usize| sums.get(&place(mesh, vertex as u32)).copied().and_then(|sum| unit(sum + DVec3::ZERO));
    let normal = |(vertex, used)| match used {
        false => Ok(DVec3::ZERO),
        true => given(vertex).or_else(|| around(vertex)).ok_or_else(|| {
            input_error!("crossbar::prt::precompute" =>
                "vertex {vertex} (counted from 0) has no normal: the model gives it none, and its triangles \
                 have no area or cancel out; remove them, or give a normal")
        }),
    };
    used(mesh).into_iter().enumerate().map(normal).collect()
}

/// The direction in which the first texture coordinate increases on a triangle, scaled by the triangle's area; and true
/// if the texture is mirrored. Zero where the texture coordinates are degenerate.
fn gradient(mesh: &Mesh, indices: [u32; 3], texture: &[[f32; 2]]) -> (DVec3, bool) {
    let [a, b, c] = indices.map(|vertex| wide(mesh.positions()[vertex as usize]));
    let [ta, tb, tc] = indices.map(|vertex| texture[vertex as usize].map(f64::from));
    let [u1, v1] = [tb[0] - ta[0], tb[1] - ta[1]];
    let [u2, v2] = [tc[0] - ta[0], tc[1] - ta[1]];
    let area = u1 * v2 - u2 * v1;
    let along = unit(v2 * (b - a) - v1 * (c - a)).filter(|_| area != 0.0);
    let length = (b - a).cross(c - a).length() / 2.0;
    (along.map_or(DVec3::ZERO, |along| along * (length * area.signum())), area < 0.0)
}
