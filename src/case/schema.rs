//! What a case may say. Field by field this is what docs/cases.md describes.

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

/// A case as written, with places for error messages; nothing in it is checked beyond words and types.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// What the case shows.
    pub title: Option<String>,
    /// A device profile; or else `shader_model` and `format`.
    pub device: Option<Spanned<String>>,
    /// The version token that the pixel program must have, on a device without limits.
    pub shader_model: Option<Spanned<String>>,
    /// The format of the pixel registers; with `device`, in place of the device's own.
    pub format: Option<Spanned<String>>,
    /// The device's open questions, by name.
    #[serde(default)]
    pub switches: BTreeMap<String, Spanned<String>>,
    /// Instructions that a program may execute per pixel or vertex, in place of the device's figures.
    pub step_budget: Option<Spanned<u32>>,
    /// The pixel program.
    pub pixel: Spanned<ShaderSource>,
    /// The vertex program, if there is one.
    pub vertex: Option<Spanned<ShaderSource>>,
    /// The pixel program's constants: `c0` to lists of numbers, `i0` to lists of integers, `b0` to truth values.
    #[serde(default)]
    pub constants: BTreeMap<String, Spanned<Constant>>,
    /// The vertex program's constants.
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
    /// What is drawn.
    pub geometry: Spanned<Geometry>,
    /// What is drawn on.
    pub target: TargetTable,
    /// The depth buffer, if there is one.
    pub depth: Option<Depth>,
    /// The alpha test, if there is one.
    pub alpha: Option<Alpha>,
    /// Blending, if there is any.
    pub blend: Option<Blend>,
    /// What must come out.
    #[serde(default)]
    pub probe: Vec<Spanned<Probe>>,
}

/// A program: in a file or in the case itself.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShaderSource {
    /// A file, from the folder of the case.
    pub file: Option<Spanned<PathBuf>>,
    /// The program itself.
    pub source: Option<Spanned<String>>,
}

/// A texture and the sampler that reads it.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Texture {
    /// The sampler, or texture stage, from 0.
    pub slot: Spanned<u32>,
    /// The shape.
    #[serde(default)]
    pub kind: TextureKind,
    /// The texel format.
    pub format: Spanned<String>,
    /// Width, height, depth, as many as the kind has; with a `file` the picture's.
    pub size: Option<Spanned<Vec<u32>>>,
    /// A PNG file, from the folder of the case.
    pub file: Option<Spanned<PathBuf>>,
    /// The texels of level 0, each red, green, blue, alpha, as many as are not (0, 0, 0, 1): rows from the top, then
    /// faces or slices.
    pub texels: Option<Spanned<Vec<Vec<Number>>>>,
    /// Whether `texels` and `mipmaps` are the stored codes, whole numbers: as many to a texel as the format stores.
    #[serde(default)]
    pub raw: bool,
    /// Where levels 1 and up come from.
    pub mipmaps: Option<Spanned<Mipmaps>>,
    /// Both `min` and `mag`.
    pub filter: Option<Spanned<Filter>>,
    /// How a texture is read that appears smaller.
    pub min: Option<Filter>,
    /// How a texture is read that appears larger.
    pub mag: Option<Filter>,
    /// How mip levels are chosen.
    #[serde(default)]
    pub mip: MipFilter,
    /// What lies outside: one for all axes, or one per axis.
    pub address: Option<Spanned<OneOrMany>>,
    /// The colour outside, for `border`.
    pub border: Option<Spanned<Vec<Number>>>,
    /// Added to the level of detail.
    pub lod_bias: Option<Number>,
    /// The most detailed level that is read.
    pub max_mip_level: Option<Spanned<u32>>,
    /// The coordinate that `tex`, `texbem` and `texbeml` of ps_1_1 to 1_3 divide the others by.
    pub projected: Option<Spanned<Projection>>,
}

/// Bump state of a texture stage.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bump {
    /// The stage: the number of the destination of `texbem`, `texbeml` or `bem`.
    pub stage: Spanned<u32>,
    /// M00, M01, M10, M11.
    pub matrix: Exactly<Number, 4>,
    /// What `texbeml` multiplies the luminance by; 0 if not said.
    pub luminance_scale: Option<Number>,
    /// What `texbeml` adds to that; 0 if not said.
    pub luminance_offset: Option<Number>,
}

/// What is drawn.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Geometry {
    /// How vertices make triangles.
    pub primitive: Option<Spanned<Primitive>>,
    /// The vertices: attribute name to up to four numbers.
    #[serde(default)]
    pub vertices: Vec<Spanned<BTreeMap<String, Spanned<Vec<Number>>>>>,
    /// Instead of vertices: one quad over the whole target, its `t0` going from (0, 0) in row 0 to (1, 1).
    #[serde(default)]
    pub full_screen: bool,
    /// Attributes of every vertex that does not set them itself.
    #[serde(default)]
    pub attributes: BTreeMap<String, Spanned<Vec<Number>>>,
    /// Which side is left out.
    #[serde(default)]
    pub cull: Cull,
    /// Whether the colours `v#` are interpolated or those of one vertex.
    #[serde(default)]
    pub shading: Shading,
    /// Where in a pixel its centre lies, and how depth is clipped.
    #[serde(default)]
    pub convention: Convention,
}

/// Whether colours are interpolated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the variants are the words")]
pub enum Shading {
    #[default]
    Smooth,
    Flat,
}

/// Whose rules hold for pixel centres and clip space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the variants are the words")]
pub enum Convention {
    #[default]
    Direct3d,
    Opengl,
}

/// What is drawn on.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TargetTable {
    /// Width and height in pixels.
    pub size: Spanned<Exactly<u32, 2>>,
    /// The texel format, or up to four for several targets.
    pub format: Spanned<OneOrMany>,
    /// What every target holds before the draw; (0, 0, 0, 0) if not said.
    pub clear: Option<Spanned<Vec<Number>>>,
    /// The channels that are written, some of `rgba`.
    pub write: Option<Spanned<String>>,
}

/// The depth buffer.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Depth {
    /// The format; `d24` if not said.
    pub format: Option<Spanned<String>>,
    /// What it holds before the draw; 1 if not said.
    pub clear: Option<Spanned<Number>>,
    /// The test a fragment must pass; none if not said.
    pub test: Option<CompareFunction>,
    /// Whether fragments that pass write their depth.
    pub write: Option<Spanned<bool>>,
}

/// The alpha test.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Alpha {
    /// The test that a fragment's alpha must pass.
    pub test: CompareFunction,
    /// What it is compared with.
    pub reference: Spanned<Number>,
}

/// Blending. Without the `alpha_` fields alpha is blended as colour is.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Blend {
    /// What the fragment is multiplied by.
    pub source: BlendFactor,
    /// What the target is multiplied by.
    pub destination: BlendFactor,
    /// How the products are combined.
    #[serde(default)]
    pub operation: BlendOp,
    /// `source` for alpha.
    pub alpha_source: Option<BlendFactor>,
    /// `destination` for alpha.
    pub alpha_destination: Option<BlendFactor>,
    /// `operation` for alpha.
    pub alpha_operation: Option<BlendOp>,
}

/// What must come out at a pixel.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Probe {
    /// Column and row, from the top left, from 0.
    pub pixel: Spanned<Exactly<u32, 2>>,
    /// Which target, from 0.
    pub target: Option<Spanned<u32>>,
    /// Red, green, blue, alpha as numbers; channels left out at the end may be anything.
    pub expected: Option<Spanned<Vec<Number>>>,
    /// The stored channels as whole numbers, to the bit.
    pub raw: Option<Spanned<Vec<u32>>>,
    /// The depth as a number.
    pub depth: Option<Number>,
    /// How far numbers may be off.
    pub tolerance: Option<Spanned<Number>>,
}
