//! Properties of a legal program, derived once for the executors.

use std::ops::Deref;

use super::Warning;
use super::context::{Context, is_texture};
use super::slots::{self, SlotCount};
use crate::isa::{Opcode, Program, RegisterFile, ResultKind, TextureTarget, Usage};

/// Derived properties of a legal program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Facts {
    /// The phase of each instruction: 1 or 2 in ps_1_4 (all 2 without a marker), 1 elsewhere.
    pub phase: Vec<u8>,
    /// Index of the `phase` instruction.
    pub phase_marker: Option<usize>,
    /// Jump target of each instruction: from `if` to its `else` or `endif`, from `else` to `endif`, from `rep` and
    /// `loop` to their end and back, from `break` to the end of its loop, from `call` to its `label`.
    pub jump: Vec<Option<usize>>,
    /// Index of the first `label`, where the main program ends; the number of instructions if there is no label.
    pub main_end: usize,
    /// `true` if the program has flow control.
    pub has_flow: bool,
    /// One more than the highest `r#`, matrix rows included.
    pub temporaries: u16,
    /// One more than the highest `c#` used or defined, matrix rows included; relative addresses may be higher.
    pub constants: u16,
    /// `true` if constants are addressed relatively.
    pub relative_constants: bool,
    /// Bit `n`: the program reads coordinate set or texture register `t#n` (pixel).
    pub texture_registers: u32,
    /// Bit `n`: the program reads `v#n` (colour or attribute).
    pub inputs: u32,
    /// Bit `n`: the program samples sampler (ps_1_x: stage) `n`.
    pub samplers: u32,
    /// The declared types of the samplers (ps_2_0 and up).
    pub sampler_usage: [Option<Usage>; 16],
    /// Bit `n`: the program writes colour output `n`; ps_1_x writes output 0.
    pub color_outputs: u32,
    /// `true` if the program writes depth.
    pub writes_depth: bool,
    /// `true` if the program can kill fragments.
    pub kills: bool,
    /// `true` if the program uses derivatives, explicitly (`dsx`, `dsy`) or to select a mip level.
    pub uses_derivatives: bool,
    /// Bit `n`: a vertex program writes `oT#n`.
    pub texcoord_outputs: u32,
    /// Bit `n`: a vertex program writes `oD#n`.
    pub diffuse_outputs: u32,
    /// Slots per phase; the second entry is for phase 2 of ps_1_4 only.
    pub slots: [SlotCount; 2],
}

/// A program that is legal for a device. Only [`super::check`] creates this type, so code that accepts it may rely on
/// all rules.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checked<T> {
    inner: T,
    facts: Facts,
    device: String,
    warnings: Vec<Warning>,
}

impl<T> Checked<T> {
    pub(super) fn new(inner: T, facts: Facts, device: String, warnings: Vec<Warning>) -> Self {
        Self { inner, facts, device, warnings }
    }

    /// Warnings, in the order of the text.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Derived properties of the program.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// Name of the device for which the program is legal.
    pub fn device(&self) -> &str {
        &self.device
    }

    /// Returns the program without the guarantee.
    pub fn into_inner(self) -> T {
        self.inner
    }
}

impl<T> Deref for Checked<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.inner
    }
}

/// Derives the properties of a program without violations.
pub(super) fn derive(context: &Context<'_>) -> Facts {
    let program: &Program = context.program;
    let count = program.instructions.len();
    let mut facts = Facts {
        phase: (0..count).map(|i| context.phase(i)).collect(),
        phase_marker: context.phase_marker(),
        jump: context.jump.clone(),
        main_end: program.instructions.iter().position(|i| i.opcode == Opcode::Label).unwrap_or(count),
        slots: slots::counts(context),
        ..Facts::default()
    };
    if context.version.is_ps_1_x() {
        facts.color_outputs = 1;
    }
    for declaration in &program.declarations {
        let register = declaration.destination.register;
        if register.file == RegisterFile::Sampler
            && let Some(entry) = facts.sampler_usage.get_mut(usize::from(register.index))
        {
            *entry = Some(declaration.usage);
        }
    }
    for def in program.constants.iter().filter(|d| d.register.file == RegisterFile::Constant) {
        facts.constants = facts.constants.max(def.register.index.saturating_add(1));
    }
    for instruction in program.instructions.iter().filter(|i| i.fragment.target.is_some()) {
        let unit = instruction.sources.get(1).map_or(usize::MAX, |s| usize::from(s.register.index));
        if let Some(entry) = facts.sampler_usage.get_mut(unit) {
            *entry = instruction.fragment.target.map(usage);
        }
    }
    for instruction in &program.instructions {
        note(&mut facts, context, instruction);
    }
    facts
}

fn note(facts: &mut Facts, context: &Context<'_>, instruction: &crate::isa::Instruction) {
    let opcode = instruction.opcode;
    let samples = opcode.info().result == ResultKind::Texel;
    let bit = |index: u16| 1_u32.checked_shl(u32::from(index)).unwrap_or(0);
    for (k, source) in instruction.sources.iter().enumerate() {
        let register = source.register;
        let rows = if k == 1 { super::matrix_rows(opcode).unwrap_or(1) } else { 1 };
        match register.file {
            RegisterFile::Temp => facts.temporaries = facts.temporaries.max(register.index.saturating_add(rows)),
            RegisterFile::Constant => {
                facts.constants = facts.constants.max(register.index.saturating_add(rows));
                facts.relative_constants |= register.relative.is_some();
            }
            RegisterFile::Texture => facts.texture_registers |= bit(register.index),
            RegisterFile::Input => facts.inputs |= bit(register.index),
            RegisterFile::Sampler => facts.samplers |= bit(register.index),
            _ => {}
        }
    }
    if let Some(destination) = instruction.destination {
        let register = destination.register;
        match register.file {
            RegisterFile::Temp => facts.temporaries = facts.temporaries.max(register.index.saturating_add(1)),
            RegisterFile::ColorOut => facts.color_outputs |= bit(register.index),
            RegisterFile::HalfColorOut => facts.color_outputs |= 1,
            RegisterFile::DepthOut => facts.writes_depth = true,
            RegisterFile::TexCoordOut => facts.texcoord_outputs |= bit(register.index),
            RegisterFile::DiffuseOut => facts.diffuse_outputs |= bit(register.index),
            RegisterFile::Texture if is_texture(opcode) => {
                // In ps_1_1 to 1_3 the destination selects the coordinate set, and the stage if one is sampled.
                facts.texture_registers |= bit(register.index);
            }
            _ => {}
        }
        // In ps_1_x the destination selects the sampler.
        if samples && context.version.is_ps_1_x() {
            facts.samplers |= bit(register.index);
        }
    }
    facts.has_flow |= opcode.info().class == crate::isa::OpcodeClass::Flow;
    facts.kills |= matches!(opcode, Opcode::TexKill | Opcode::Kil);
    facts.writes_depth |= matches!(opcode, Opcode::TexDepth | Opcode::TexM3x2Depth);
    facts.uses_derivatives |= samples && opcode != Opcode::TexLdD || matches!(opcode, Opcode::Dsx | Opcode::Dsy);
}

/// The Direct3D sampler type of an OpenGL texture target.
fn usage(target: TextureTarget) -> Usage {
    match target {
        TextureTarget::D1 | TextureTarget::D2 | TextureTarget::Rect => Usage::Sampler2d,
        TextureTarget::D3 => Usage::SamplerVolume,
        TextureTarget::Cube => Usage::SamplerCube,
    }
}
