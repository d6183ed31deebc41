//! State shared by all passes: the program, the device, and the violations so far.

use super::allowed::{Allowed, Limit};
use super::{RuleId, Violation, Warning};
use crate::device::Profile;
use crate::isa::{
    DestinationRule, Instruction, Opcode, OpcodeClass, Program, RegisterFile, Span, Stage, Usage, Version,
};

/// The number of registers of a file.
pub(super) enum Count {
    /// A limit of the profile or the version.
    Limited(Allowed),
    /// A number fixed by the version.
    Fixed(u32),
}

impl Count {
    /// Number of registers in a file; `None` if the version has no such file.
    pub(super) fn of(file: RegisterFile, version: Version, profile: &Profile) -> Option<Self> {
        use RegisterFile as F;
        let pixel_2 = version.is_ps_2();
        let vertex = version.stage() == Stage::Vertex;
        let vs_2 = version == Version::Vs2_0;
        let limited = |limit: Limit| limit.allowed(profile, version).map(Self::Limited);
        let fixed = |n: u32, there: bool| there.then_some(Self::Fixed(n));
        match file {
            F::Temp => limited(Limit::Temporaries),
            F::Constant => limited(Limit::Constants),
            F::Input if vertex => fixed(16, true),
            F::Input => limited(Limit::ColorInputs),
            F::Texture => limited(Limit::TextureCoordinates).filter(|_| !vertex),
            F::Sampler => limited(Limit::Samplers).filter(|_| pixel_2),
            F::ConstantInt | F::ConstantBool => fixed(16, pixel_2 || vs_2),
            F::Label => fixed(16, version.is_ps_2_x() || vs_2),
            F::Predicate => fixed(1, version == Version::Ps2A),
            F::ColorOut => fixed(4, pixel_2),
            F::DepthOut => fixed(1, pixel_2),
            F::Address => fixed(1, vertex),
            F::Loop => fixed(1, vs_2),
            F::PositionOut | F::FogOut | F::PointSizeOut => fixed(1, vertex),
            F::DiffuseOut => fixed(2, vertex),
            F::TexCoordOut => fixed(8, vertex),
            // `fragment` checks the registers of OpenGL programs.
            F::Half | F::FogIn | F::WindowPosition | F::HalfColorOut | F::Discard | F::HalfDiscard => None,
        }
    }

    pub(super) fn value(&self) -> u32 {
        match self {
            Self::Limited(allowed) => allowed.value,
            Self::Fixed(n) => *n,
        }
    }
}

/// The state of checking one program.
pub(super) struct Context<'a> {
    pub(super) program: &'a Program,
    pub(super) profile: &'a Profile,
    pub(super) version: Version,
    pub(super) violations: Vec<Violation>,
    pub(super) warnings: Vec<Warning>,
    /// `true` for instruction `i` if the version has it and its operands are present; later passes rely on that.
    pub(super) sound: Vec<bool>,
    /// For each instruction, the index of the instruction that ends or continues its block, loop or subroutine.
    pub(super) jump: Vec<Option<usize>>,
    phase_marker: Option<usize>,
}

impl<'a> Context<'a> {
    pub(super) fn new(program: &'a Program, profile: &'a Profile) -> Self {
        let version = program.version;
        let sound = program.instructions.iter().map(|i| is_sound(i, version)).collect();
        Self {
            program,
            profile,
            version,
            violations: Vec::new(),
            warnings: Vec::new(),
            sound,
            jump: vec![None; program.instructions.len()],
            phase_marker: program.phase_marker().filter(|_| version == Version::Ps1_4),
        }
    }

    /// Records a violation; returns it for adding details.
    pub(super) fn breach(&mut self, rule: RuleId, span: Span, message: impl Into<String>) -> &mut Violation {
        self.violations.push_mut(Violation::new(rule, span, message))
    }

    pub(super) fn is_sound(&self, index: usize) -> bool {
        self.sound.get(index).copied().unwrap_or(false)
    }

    pub(super) fn instructions(&self) -> impl Iterator<Item = (usize, &'a Instruction)> + use<'a> {
        let sound = self.sound.clone();
        self.program.instructions.iter().enumerate().filter(move |(i, _)| sound[*i])
    }

    /// Phase of instruction `index`: 1 or 2 in ps_1_4 (all 2 in a program without a marker), 1 in other versions.
    pub(super) fn phase(&self, index: usize) -> u8 {
        match (self.version, self.phase_marker) {
            (Version::Ps1_4, Some(marker)) if index < marker => 1,
            (Version::Ps1_4, _) => 2,
            _ => 1,
        }
    }

    pub(super) fn phase_marker(&self) -> Option<usize> {
        self.phase_marker
    }

    pub(super) fn limit(&self, limit: Limit) -> Option<Allowed> {
        limit.allowed(self.profile, self.version)
    }

    /// Returns `true` if limits that only the version states (ports, tokens) apply; they don't apply on ideal devices.
    pub(super) fn version_limits(&self) -> bool {
        self.profile.limits.version_limits
    }

    /// Number of registers in `file`; `None` if the version has no such file.
    pub(super) fn count(&self, file: RegisterFile) -> Option<Count> {
        Count::of(file, self.version, self.profile)
    }

    pub(super) fn sampler_usage(&self, number: u16) -> Option<Usage> {
        let mut samplers =
            self.program.declarations.iter().filter(|d| {
                d.destination.register.file == RegisterFile::Sampler && d.destination.register.index == number
            });
        samplers.next().map(|d| d.usage)
    }

    /// The sampler type of a ps_2_x texture read.
    pub(super) fn sampled_usage(&self, instruction: &Instruction) -> Option<Usage> {
        let read = matches!(instruction.opcode, Opcode::TexLd | Opcode::TexLdB | Opcode::TexLdP | Opcode::TexLdD);
        let sampler = instruction.sources.get(1).filter(|_| read)?;
        self.sampler_usage(sampler.register.index)
    }
}

/// Returns `true` if the version has the instruction and its operands are present.
fn is_sound(instruction: &Instruction, version: Version) -> bool {
    let info = instruction.opcode.info();
    let Some(sources) = info.source_count(version) else { return false };
    instruction.sources.len() == usize::from(sources)
        && instruction.destination.is_some() == (info.destination != DestinationRule::None)
        && instruction.comparison.is_some() == info.comparison
}

/// Returns `true` for operations of class [`OpcodeClass::Texture`].
pub(super) fn is_texture(opcode: Opcode) -> bool {
    opcode.info().class == OpcodeClass::Texture
}

/// Returns `true` for operations of class [`OpcodeClass::Arithmetic`].
pub(super) fn is_arithmetic(opcode: Opcode) -> bool {
    opcode.info().class == OpcodeClass::Arithmetic
}

/// Returns `true` if registers of the file are numeric operands of arithmetic.
pub(super) fn is_numeric(file: RegisterFile) -> bool {
    matches!(file, RegisterFile::Temp | RegisterFile::Input | RegisterFile::Texture | RegisterFile::Constant)
}

/// `1st`, `2nd`, `3rd`, `4th`
pub(super) fn ordinal(n: u32) -> String {
    let suffix = match (n % 10, n % 100) {
        (1, h) if h != 11 => "st",
        (2, h) if h != 12 => "nd",
        (3, h) if h != 13 => "rd",
        _ => "th",
    };
    format!("{n}{suffix}")
}
