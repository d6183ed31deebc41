//! Schema of a case as written, with source positions: only names and types are checked. docs/cases.md describes every
//! field.

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

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Case {
    pub(super) title: Option<String>,
    pub(super) device: Option<Spanned<String>>,
    pub(super) shader_model: Option<Spanned<String>>,
    pub(super) format: Option<Spanned<String>>,
    #[serde(default)]
    pub(super) switches: BTreeMap<String, Spanned<String>>,
    pub(super) step_budget: Option<Spanned<u32>>,
    pub(super) pixel: Spanned<ShaderSource>,
    pub(super) vertex: Option<Spanned<ShaderSource>>,
    #[serde(default)]
    pub(super) constants: BTreeMap<String, Spanned<Constant>>,
    #[serde(default)]
    pub(super) vertex_constants: BTreeMap<String, Spanned<Constant>>,
    pub(super) state: Option<Spanned<StateTable>>,
    #[serde(default)]
    pub(super) texture: Vec<Spanned<Texture>>,
    #[serde(default)]
    pub(super) bump: Vec<Spanned<Bump>>,
    pub(super) geometry: Spanned<Geometry>,
    pub(super) target: TargetTable,
    pub(super) depth: Option<Depth>,
    pub(super) alpha: Option<Alpha>,
    pub(super) blend: Option<Blend>,
    #[serde(default)]
    pub(super) probe: Vec<Spanned<Probe>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ShaderSource {
    pub(super) file: Option<Spanned<PathBuf>>,
    pub(super) source: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Texture {
    pub(super) slot: Spanned<u32>,
    #[serde(default)]
    pub(super) kind: TextureKind,
    pub(super) format: Spanned<String>,
    pub(super) size: Option<Spanned<Vec<u32>>>,
    pub(super) file: Option<Spanned<PathBuf>>,
    pub(super) texels: Option<Spanned<Vec<Vec<Number>>>>,
    #[serde(default)]
    pub(super) raw: bool,
    pub(super) mipmaps: Option<Spanned<Mipmaps>>,
    pub(super) filter: Option<Spanned<Filter>>,
    pub(super) min: Option<Filter>,
    pub(super) mag: Option<Filter>,
    #[serde(default)]
    pub(super) mip: MipFilter,
    pub(super) address: Option<Spanned<OneOrMany>>,
    pub(super) border: Option<Spanned<Vec<Number>>>,
    pub(super) lod_bias: Option<Number>,
    pub(super) max_mip_level: Option<Spanned<u32>>,
    pub(super) projected: Option<Spanned<Projection>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Bump {
    pub(super) stage: Spanned<u32>,
    pub(super) matrix: Exactly<Number, 4>,
    pub(super) luminance_scale: Option<Number>,
    pub(super) luminance_offset: Option<Number>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Geometry {
    pub(super) primitive: Option<Spanned<Primitive>>,
    #[serde(default)]
    pub(super) vertices: Vec<Spanned<BTreeMap<String, Spanned<Vec<Number>>>>>,
    #[serde(default)]
    pub(super) full_screen: bool,
    #[serde(default)]
    pub(super) attributes: BTreeMap<String, Spanned<Vec<Number>>>,
    #[serde(default)]
    pub(super) cull: Cull,
    #[serde(default)]
    pub(super) shading: Shading,
    #[serde(default)]
    pub(super) convention: Convention,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Shading {
    #[default]
    Smooth,
    Flat,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Convention {
    #[default]
    Direct3d,
    Opengl,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TargetTable {
    pub(super) size: Spanned<Exactly<u32, 2>>,
    pub(super) format: Spanned<OneOrMany>,
    pub(super) clear: Option<Spanned<Vec<Number>>>,
    pub(super) write: Option<Spanned<String>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Depth {
    pub(super) format: Option<Spanned<String>>,
    pub(super) clear: Option<Spanned<Number>>,
    pub(super) test: Option<CompareFunction>,
    pub(super) write: Option<Spanned<bool>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Alpha {
    pub(super) test: CompareFunction,
    pub(super) reference: Spanned<Number>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Blend {
    pub(super) source: BlendFactor,
    pub(super) destination: BlendFactor,
    #[serde(default)]
    pub(super) operation: BlendOp,
    pub(super) alpha_source: Option<BlendFactor>,
    pub(super) alpha_destination: Option<BlendFactor>,
    pub(super) alpha_operation: Option<BlendOp>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Probe {
    pub(super) pixel: Spanned<Exactly<u32, 2>>,
    pub(super) target: Option<Spanned<u32>>,
    pub(super) expected: Option<Spanned<Vec<Number>>>,
    pub(super) raw: Option<Spanned<Vec<u32>>>,
    pub(super) depth: Option<Number>,
    pub(super) tolerance: Option<Spanned<Number>>,
}
