//! Representation of shader programs: versions, registers, modifiers, instructions, and the opcode table.
//!
//! Assembler front ends produce a [`Program`], the checker validates it, and executors run it. This module only
//! contains data; for execution see [`crate::exec`]. Terms are Direct3D's (`ps_1_4`, `texcrd`, `phase`, `oDepth`).

mod fragment;
mod opcode;
mod operand;
mod program;
mod reads;
mod register;
mod span;
mod state;
mod text;
mod version;

pub use fragment::{
    Condition, ConditionTest, FIRST_ENVIRONMENT, FIRST_LITERAL, FIRST_NAMED, FragmentPart, Precision, Spelling,
    TextureTarget,
};
pub use opcode::{Comparison, DestinationRule, OpInfo, Opcode, OpcodeClass, ResultKind, SlotCost};
pub use operand::{Destination, Mask, Modifier, Predicate, Source, Swizzle};
pub use program::{
    ConstantDef, ConstantValue, Declaration, Instruction, Parameter, ParameterSource, Program, ProgramResource, Usage,
};
pub use register::{Register, RegisterFile, Relative};
pub use span::Span;
pub use state::{
    FogMode, FogOption, LightingColor, MAX_LIGHTS, MAX_PROGRAM_MATRICES, MAX_TEXTURE_UNITS, MaterialFace, MatrixForm,
    StateBinding, StateMatrix,
};
pub(crate) use text::PlacedMessage;
pub use text::ProgramText;
pub use version::{Stage, Version};
