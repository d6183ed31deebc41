//! Shader programs as data: versions, registers, modifiers, instructions, and THE opcode table.
//!
//! A [`Program`] is what an assembler front end produces, what the checker judges and what every executor
//! runs. Nothing in here evaluates anything: values are the business of [`crate::exec`]. The words are
//! Direct3D's (`ps_1_4`, `texcrd`, `phase`, `oDepth`), because the programs are.

mod fragment;
mod opcode;
mod operand;
mod program;
mod reads;
mod register;
mod span;
mod state;
mod version;

pub use fragment::{
    Condition, ConditionTest, FIRST_ENVIRONMENT, FIRST_LITERAL, FIRST_NAMED, FragmentPart, Precision, Spelling,
    TextureTarget,
};
pub use opcode::{Comparison, DestinationRule, OpInfo, Opcode, OpcodeClass, SlotCost};
pub use operand::{Destination, Mask, Modifier, Predicate, Source, Swizzle};
pub use program::{ConstantDef, ConstantValue, Declaration, Instruction, Parameter, ParameterSource, Program, Usage};
pub use register::{Register, RegisterFile, Relative};
pub use span::Span;
pub use state::{
    FogMode, FogOption, LightingColor, MAX_LIGHTS, MAX_PROGRAM_MATRICES, MAX_TEXTURE_UNITS, MaterialFace, MatrixForm,
    StateBinding, StateMatrix,
};
pub use version::{Stage, Version};
