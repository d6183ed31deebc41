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
    /// Each vertex after the second makes a triangle with the two vertices before it.
    TriangleStrip,
    /// Each vertex after the second makes a triangle with the vertex before it and the first vertex.
    TriangleFan,
    /// Every four vertices make a quad.
    #[serde(rename = "quads")]
    QuadList,
    /// Every two vertices after the second make a quad with the two vertices before them.
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

/// Provoking vertex: the vertex that determines the colours of a flat-shaded primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Provoking {
    /// The first vertex (Direct3D's `D3DSHADE_FLAT`); in a fan, the vertex after the common vertex.
    First,
    /// The last vertex (OpenGL's `GL_FLAT`); the fourth vertex of a quad.
    Last,
}
