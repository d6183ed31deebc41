//! Programs: instructions, declarations, constants and parameters.

use std::collections::BTreeMap;

use super::{
    Comparison, Destination, FogOption, FragmentPart, Opcode, Precision, Predicate, ProgramText, Register,
    RegisterFile, Source, Span, StateBinding, Version,
};
use crate::num::Format;

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

/// A constant defined in the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ConstantDef {
    /// The constant register.
    pub register: Register,
    /// Its value.
    pub value: ConstantValue,
    /// Number of instructions before the definition; 0 in a legal program.
    pub position: usize,
    /// Location in the program text.
    pub span: Span,
}

/// Usage of a declared register.
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

/// A register declaration (`dcl`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Declaration {
    /// The usage of the register.
    pub usage: Usage,
    /// The register with mask and hints (`dcl_pp`, `dcl_centroid`).
    pub destination: Destination,
    /// Number of instructions before it.
    pub position: usize,
    /// Location in the program text.
    pub span: Span,
}

/// One instruction.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Instruction {
    /// The operation.
    pub opcode: Opcode,
    /// The comparison, if the operation has one.
    pub comparison: Option<Comparison>,
    /// The destination, if the operation has one.
    pub destination: Option<Destination>,
    /// The operands, in the order of the text.
    pub sources: Vec<Source>,
    /// `+`: issued together with the previous instruction.
    pub coissue: bool,
    /// Predicate written before the instruction, such as `(p0)`.
    pub predicate: Option<Predicate>,
    /// Parts that only OpenGL fragment programs have; default in Direct3D's versions.
    pub fragment: FragmentPart,
    /// The instruction's own number format, in place of the registers' format and of `_pp` or a precision suffix.
    /// Operands are converted to it, the operation is done in it, and the result is converted to the format of its
    /// register; a texture instruction's result is rounded to it. Program texts contain no such formats: devices assign
    /// them ([`crate::device::InstructionFormats`]).
    pub format: Option<Format>,
    /// The whole instruction in the program text.
    pub span: Span,
}

/// A program of one version, not necessarily legal: [`crate::check`] validates it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Program {
    /// The version token.
    pub version: Version,
    /// Location of the version token.
    pub version_span: Span,
    /// Constant definitions, in the order of the text.
    pub constants: Vec<ConstantDef>,
    /// Register declarations, in the order of the text.
    pub declarations: Vec<Declaration>,
    /// Instructions, including `phase` and flow control.
    pub instructions: Vec<Instruction>,
    /// Host-set constants without a register number, in the order in which the text uses them.
    pub parameters: Vec<Parameter>,
    /// Resources that an `!!ARBfp1.0` program declares or binds, used or not, each with the span where it first occurs.
    pub resources: BTreeMap<ProgramResource, Span>,
    /// The OpenGL fog option that is applied at the end of the program.
    pub fog: Option<FogOption>,
    /// The text that it was assembled from.
    pub text: ProgramText,
}

/// A host-set constant of an OpenGL program: identified by name, or bound to an item of pipeline state.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// The constant register that holds its value.
    pub register: Register,
    /// Source of its value.
    pub source: ParameterSource,
    /// Number of components of the parameter's value, 1 to 4. Other components are not read.
    pub width: usize,
    /// Location in the program text.
    pub span: Span,
}

/// A resource of an `!!ARBfp1.0` program, which counts against a limit if it is declared or bound.
///
/// Source: GL_ARB_fragment_program, section 3.11.3.6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ProgramResource {
    /// A temporary, an attribute, `program.local[#]` or `program.env[#]`.
    Register(Register),
    /// A constant vector, IEEE single bit patterns; zeros are positive.
    Constant([u32; 4]),
    /// An item of pipeline state.
    State(StateBinding),
}

impl ProgramResource {
    /// Creates a constant vector. -0 becomes +0, because both count as the same number.
    pub fn constant(vector: [u32; 4]) -> Self {
        Self::Constant(vector.map(|bits| if bits == 1 << 31 { 0 } else { bits }))
    }

    /// Returns the resource of a source register of a program.
    pub fn of_source(program: &Program, register: Register) -> Self {
        let literal = program.constants.iter().find(|d| d.register == register).map(|d| d.value);
        let parameter = program.parameters.iter().find(|p| p.register == register).map(|p| p.source);
        match (literal, parameter) {
            (Some(ConstantValue::Float(vector)), _) => Self::constant(vector),
            (_, Some(ParameterSource::State(binding))) => Self::State(binding),
            _ => Self::Register(register),
        }
    }
}

/// Source of the value of a [`Parameter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ParameterSource {
    /// `DECLARE`: the entry of [`crate::exec::Constants::named`] with this name, or else this default (four IEEE single
    /// bit patterns).
    Named([u32; 4]),
    /// `state.*`: the value of this binding in [`crate::exec::Constants::state`].
    State(StateBinding),
}

impl Program {
    /// Identifies the program by its instructions: a 64-bit hash (FNV-1a) of the version and of the text of each
    /// instruction, without comments, layout, declarations and constants.
    pub fn digest(&self) -> u64 {
        let lines = self.instructions.iter().enumerate().map(|(index, instruction)| {
            // Programs that are built by tests have no text.
            let Instruction { opcode, comparison, destination, sources, .. } = instruction;
            self.instruction_text(index).unwrap_or_else(|| format!("{:?}", (opcode, comparison, destination, sources)))
        });
        std::iter::once(self.version.token().to_owned())
            .chain(lines)
            .flat_map(|line| (line + "\n").into_bytes())
            .fold(0xcbf2_9ce4_8422_2325, |digest, byte| (digest ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
    }

    /// The text of an instruction on one line; `None` if the program was not assembled from a text.
    pub fn instruction_text(&self, index: usize) -> Option<String> {
        let Span { start, end } = self.instructions.get(index)?.span;
        let text = self.text.as_str().get(start as usize..end as usize).filter(|text| !text.is_empty())?;
        Some(text.split_whitespace().collect::<Vec<_>>().join(" "))
    }

    /// The index of the `phase` instruction, if there is one.
    pub fn phase_marker(&self) -> Option<usize> {
        self.instructions.iter().position(|i| i.opcode == Opcode::Phase)
    }
}

impl Instruction {
    /// An instruction without comparison, predicate, co-issue, condition and format.
    pub(crate) fn new(opcode: Opcode, destination: Option<Destination>, sources: Vec<Source>, span: Span) -> Self {
        let fragment = FragmentPart::default();
        Self {
            opcode,
            comparison: None,
            destination,
            sources,
            coissue: false,
            predicate: None,
            fragment,
            format: None,
            span,
        }
    }

    /// The precision in which an arithmetic instruction of an OpenGL program computes: the precision of the suffix, or
    /// else of the destination. Operands `f[TEX#]` and `f[FOGC]` force full precision.
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
