//! Programs and their parts.

use super::{
    Comparison, Destination, FogOption, FragmentPart, Opcode, Precision, Predicate, Register, RegisterFile, Source,
    Span, StateBinding, Version,
};

/// The value of a `def`, `defi` or `defb`.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ConstantValue {
    /// `def c#`: four IEEE single bit patterns, the decimal text rounded to nearest even.
    Float([u32; 4]),
    /// `defi i#`
    Int([i32; 4]),
    /// `defb b#`
    Bool(bool),
}

/// A constant that the program brings along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ConstantDef {
    /// The constant register.
    pub register: Register,
    /// Its value.
    pub value: ConstantValue,
    /// How many instructions stand before it; 0 for a well-placed `def`.
    pub position: usize,
    /// Where it stands in the program text.
    pub span: Span,
}

/// What a declared register carries.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the variants are Direct3D's usages and texture types")]
pub enum Usage {
    /// `dcl t0`, `dcl v0` in a pixel program.
    Plain,
    Sampler2d,
    SamplerCube,
    SamplerVolume,
    /// `dcl_position# v#` in a vertex program; the number is the usage index.
    Position(u8),
    BlendWeight(u8),
    BlendIndices(u8),
    Normal(u8),
    PointSize(u8),
    TexCoord(u8),
    Tangent(u8),
    Binormal(u8),
    TessFactor(u8),
    Color(u8),
    Fog(u8),
    Depth(u8),
    Sample(u8),
}

impl Usage {
    /// The usages that have an index.
    pub const NUMBERED: [fn(u8) -> Self; 13] = [
        Self::Position,
        Self::BlendWeight,
        Self::BlendIndices,
        Self::Normal,
        Self::PointSize,
        Self::TexCoord,
        Self::Tangent,
        Self::Binormal,
        Self::TessFactor,
        Self::Color,
        Self::Fog,
        Self::Depth,
        Self::Sample,
    ];
}

/// A `dcl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Declaration {
    /// What the register carries.
    pub usage: Usage,
    /// The register with mask and hints (`dcl_pp`, `dcl_centroid`).
    pub destination: Destination,
    /// How many instructions stand before it.
    pub position: usize,
    /// Where it stands in the program text.
    pub span: Span,
}

/// One instruction.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Instruction {
    /// The operation.
    pub opcode: Opcode,
    /// The comparison, where the operation takes one.
    pub comparison: Option<Comparison>,
    /// Where the result goes, if the operation has one.
    pub destination: Option<Destination>,
    /// The operands, in the order of the text.
    pub sources: Vec<Source>,
    /// `+`: issued together with the instruction before.
    pub coissue: bool,
    /// `(p0)` in front.
    pub predicate: Option<Predicate>,
    /// What an OpenGL fragment program says besides; nothing in Direct3D's versions.
    pub fragment: FragmentPart,
    /// The whole instruction in the program text.
    pub span: Span,
}

/// A program of one version. Nothing says that it is legal: that is [`crate::check`]'s question.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Program {
    /// The version token.
    pub version: Version,
    /// Where the version token stands.
    pub version_span: Span,
    /// The constants it defines, in the order of the text.
    pub constants: Vec<ConstantDef>,
    /// What it declares, in the order of the text.
    pub declarations: Vec<Declaration>,
    /// Its instructions, `phase` and flow control included.
    pub instructions: Vec<Instruction>,
    /// The constants that the host sets and that have no number, in the order in which the text names them.
    pub parameters: Vec<Parameter>,
    /// The fog that OpenGL applies when the program ends, if there is one.
    pub fog: Option<FogOption>,
}

/// A constant of OpenGL's programs that the host sets: by name, or with the state that it is part of.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// The constant register that the program reads it in.
    pub register: Register,
    /// Where its value comes from.
    pub source: ParameterSource,
    /// Where it stands in the program text.
    pub span: Span,
}

/// Where the value of a [`Parameter`] comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ParameterSource {
    /// `DECLARE`: what [`crate::exec::Constants::named`] has by this name; or else this, single precision patterns.
    Named([u32; 4]),
    /// `state.*`: what [`crate::exec::Constants::state`] has there.
    State(StateBinding),
}

impl Program {
    /// The index of the `phase` instruction, if there is one.
    pub fn phase_marker(&self) -> Option<usize> {
        self.instructions.iter().position(|i| i.opcode == Opcode::Phase)
    }
}

impl Instruction {
    /// The precision that an arithmetic instruction of an OpenGL program computes in: the suffix's, or the
    /// destination's. Operands `f[TEX#]` and `f[FOGC]` ask for full precision whatever the suffix says.
    pub fn precision(&self) -> Precision {
        let interpolated = |file| matches!(file, RegisterFile::Texture | RegisterFile::FogIn);
        if self.sources.iter().any(|s| interpolated(s.register.file)) {
            return Precision::Full;
        }
        self.fragment.precision.unwrap_or(match self.destination {
            Some(d) if d.register.file.is_half() => Precision::Half,
            _ => Precision::Full,
        })
    }
}
