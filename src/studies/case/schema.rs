//! Schema of a case. docs/cases.md describes every field.

use std::{collections::BTreeMap, path::PathBuf};

use serde::Deserialize;
use toml::Spanned;

use refsim::{
    exec::Projection,
    output::{BlendFactor, BlendOp, CompareFunction},
    raster::{Cull, Primitive},
    texture::{Filter, MipFilter, TextureKind},
};

use super::fixed_function::StateTable;
use super::value::{Constant, Exactly, Mipmaps, Number, OneOrMany};

/// A case as written, with source positions; only names and types are checked.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Title of the case.
    pub title: Option<String>,
    /// Device profile; alternatively `shader_model` and `format`.
    pub device: Option<Spanned<String>>,
    /// Required version token of the pixel program, on a device without limits.
    pub shader_model: Option<Spanned<String>>,
    /// Format of the pixel registers; with `device`, replaces the device's own.
    pub format: Option<Spanned<String>>,
    /// Settings of the device's open questions, by name.
    #[serde(default)]
    pub switches: BTreeMap<String, Spanned<String>>,
    /// Maximum number of instructions that a program may execute per pixel or vertex, in place of the device's.
    pub step_budget: Option<Spanned<u32>>,
    /// Pixel program.
    pub pixel: Spanned<ShaderSource>,
    /// Vertex program, if there is one.
    pub vertex: Option<Spanned<ShaderSource>>,
    /// Constants of the pixel program: `c0` to lists of numbers, `i0` to lists of integers, `b0` to truth values.
    #[serde(default)]
    pub constants: BTreeMap<String, Spanned<Constant>>,
    /// Constants of the vertex program.
    #[serde(default)]
    pub vertex_constants: BTreeMap<String, Spanned<Constant>>,
    /// OpenGL's state, which `!!ARBfp1.0` reads as `state.*`.
    pub state: Option<Spanned<StateTable>>,
    /// Textures, each bound to a sampler.
    #[serde(default)]
    pub texture: Vec<Spanned<Texture>>,
    /// Bump state of texture stages.
    #[serde(default)]
    pub bump: Vec<Spanned<Bump>>,
    /// Geometry to draw.
    pub geometry: Spanned<Geometry>,
    /// Render targets.
    pub target: TargetTable,
    /// Depth buffer, if there is one.
    pub depth: Option<Depth>,
    /// Alpha test, if there is one.
    pub alpha: Option<Alpha>,
    /// Blending, if there is any.
    pub blend: Option<Blend>,
    /// Expected results.
    #[serde(default)]
    pub probe: Vec<Spanned<Probe>>,
}

/// A program: in a file or inline.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShaderSource {
    /// Path of a file, relative to the folder of the case.
    pub file: Option<Spanned<PathBuf>>,
    /// Inline text of the program.
    pub source: Option<Spanned<String>>,
}

/// A texture with its sampler state.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Texture {
    /// Index of the sampler, or texture stage, from 0.
    pub slot: Spanned<u32>,
    /// Dimensionality.
    #[serde(default)]
    pub kind: TextureKind,
    /// Texel format.
    pub format: Spanned<String>,
    /// Width, height and depth, one per axis of the kind; not required with `file`.
    pub size: Option<Spanned<Vec<u32>>>,
    /// Path of a PNG file, relative to the folder of the case.
    pub file: Option<Spanned<PathBuf>>,
    /// Texels of level 0, each as red, green, blue, alpha; missing channels come from (0, 0, 0, 1). Rows from the top,
    /// then faces or slices.
    pub texels: Option<Spanned<Vec<Vec<Number>>>>,
    /// `true` if `texels` and `mipmaps` list stored codes: integers, one per stored channel.
    #[serde(default)]
    pub raw: bool,
    /// Source of levels 1 and up.
    pub mipmaps: Option<Spanned<Mipmaps>>,
    /// Filter for both `min` and `mag`.
    pub filter: Option<Spanned<Filter>>,
    /// Minification filter.
    pub min: Option<Filter>,
    /// Magnification filter.
    pub mag: Option<Filter>,
    /// Mipmap filter.
    #[serde(default)]
    pub mip: MipFilter,
    /// Address mode outside of the texture: one for all axes, or one per axis.
    pub address: Option<Spanned<OneOrMany>>,
    /// Border color, for `border`.
    pub border: Option<Spanned<Vec<Number>>>,
    /// Bias added to the level of detail.
    pub lod_bias: Option<Number>,
    /// Most detailed level that is read.
    pub max_mip_level: Option<Spanned<u32>>,
    /// Coordinate by which `tex`, `texbem` and `texbeml` of ps_1_1 to 1_3 divide the other coordinates.
    pub projected: Option<Spanned<Projection>>,
}

/// Bump state of a texture stage.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bump {
    /// Index of the stage: the number of the destination register of `texbem`, `texbeml` or `bem`.
    pub stage: Spanned<u32>,
    /// M00, M01, M10, M11.
    pub matrix: Exactly<Number, 4>,
    /// Scale of the luminance in `texbeml`; defaults to 0.
    pub luminance_scale: Option<Number>,
    /// Offset of the luminance in `texbeml`; defaults to 0.
    pub luminance_offset: Option<Number>,
}

/// Geometry to draw.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Geometry {
    /// Primitive topology.
    pub primitive: Option<Spanned<Primitive>>,
    /// Vertices: maps from attribute name to up to four numbers.
    #[serde(default)]
    pub vertices: Vec<Spanned<BTreeMap<String, Spanned<Vec<Number>>>>>,
    /// Draws one quad over the whole target in place of vertices, with `t0` from (0, 0) in row 0 to (1, 1).
    #[serde(default)]
    pub full_screen: bool,
    /// Default attributes of all vertices.
    #[serde(default)]
    pub attributes: BTreeMap<String, Spanned<Vec<Number>>>,
    /// Culled side.
    #[serde(default)]
    pub cull: Cull,
    /// Interpolation of the colors `v#`: smooth or flat.
    #[serde(default)]
    pub shading: Shading,
    /// Convention of pixel centres and clip space.
    #[serde(default)]
    pub convention: Convention,
}

/// Interpolation of colors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the variants are the words")]
pub enum Shading {
    #[default]
    Smooth,
    Flat,
}

/// Convention of pixel centres and clip space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the variants are the words")]
pub enum Convention {
    #[default]
    Direct3d,
    Opengl,
}

/// Render targets.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetTable {
    /// Width and height in pixels.
    pub size: Spanned<Exactly<u32, 2>>,
    /// Texel format, or up to four for several targets.
    pub format: Spanned<OneOrMany>,
    /// Clear color of every target; defaults to (0, 0, 0, 0).
    pub clear: Option<Spanned<Vec<Number>>>,
    /// Channels that are written: some letters of `rgba`.
    pub write: Option<Spanned<String>>,
}

/// Depth buffer.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Depth {
    /// Format; defaults to `d24`.
    pub format: Option<Spanned<String>>,
    /// Clear depth; defaults to 1.
    pub clear: Option<Spanned<Number>>,
    /// Depth test; defaults to none.
    pub test: Option<CompareFunction>,
    /// `true` if fragments that pass write their depth.
    pub write: Option<Spanned<bool>>,
}

/// Alpha test.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Alpha {
    /// Comparison of a fragment's alpha with the reference.
    pub test: CompareFunction,
    /// Reference value.
    pub reference: Spanned<Number>,
}

/// Blending. Without the `alpha_` fields, alpha is blended like color.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Blend {
    /// Factor of the fragment.
    pub source: BlendFactor,
    /// Factor of the target.
    pub destination: BlendFactor,
    /// Operation that combines the products.
    #[serde(default)]
    pub operation: BlendOp,
    /// Factor `source` for alpha.
    pub alpha_source: Option<BlendFactor>,
    /// Factor `destination` for alpha.
    pub alpha_destination: Option<BlendFactor>,
    /// `operation` for alpha.
    pub alpha_operation: Option<BlendOp>,
}

/// Expected value at a pixel.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// Column and row, from the top left, from 0.
    pub pixel: Spanned<Exactly<u32, 2>>,
    /// Index of the target, from 0.
    pub target: Option<Spanned<u32>>,
    /// Red, green, blue, alpha as numbers; omitted trailing channels are not checked.
    pub expected: Option<Spanned<Vec<Number>>>,
    /// Stored channels as integers, compared exactly.
    pub raw: Option<Spanned<Vec<u32>>>,
    /// Depth as a number.
    pub depth: Option<Number>,
    /// Maximum absolute error of numbers.
    pub tolerance: Option<Spanned<Number>>,
}
