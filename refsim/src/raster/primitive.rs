//! Primitive topologies.

use serde::Deserialize;

/// Primitive topology.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Primitive {
    /// Every three vertices make a triangle.
    #[serde(rename = "triangles")]
    TriangleList,
    /// From the third on, each vertex makes a triangle with its two predecessors.
    TriangleStrip,
    /// From the third on, each vertex makes a triangle with its predecessor and the first.
    TriangleFan,
    /// Every four vertices make a quad.
    #[serde(rename = "quads")]
    QuadList,
    /// From the third on, every two vertices make a quad with the two before.
    QuadStrip,
    /// Not supported.
    #[serde(skip)]
    PointList,
    /// Not supported.
    #[serde(skip)]
    LineList,
    /// Not supported.
    #[serde(skip)]
    LineStrip,
}

/// Provoking vertex: the vertex whose colours a flat-shaded primitive takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Provoking {
    /// The first one (Direct3D's `D3DSHADE_FLAT`). In a fan it is the vertex after the common one.
    First,
    /// The last one (OpenGL's `GL_FLAT`); the fourth of a quad.
    Last,
}
