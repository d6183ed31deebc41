//! Expansion of the fog options of `!!ARBfp1.0` into instructions. Source: GL_ARB_fragment_program, "Fog Application
//! Options".
//!
//! The program's color is redirected to a temporary, and instructions that blend it with the fog color are appended;
//! for `ARB_fog_exp`:
//!
//! ```text
//! MOV result.color.w, t.w;               issued together with the next: alpha is not fogged
//! MUL t.w, factors.z, fragment.fogcoord.x;
//! EX2_SAT t.w, -t.w;
//! LRP result.color.xyz, t.w, t, state.fog.color;
//! ```
//!
//! These instructions count towards the limits as in the specification: three for `ARB_fog_exp`, four for
//! `ARB_fog_exp2`, two for `ARB_fog_linear`. Each option also counts as one temporary, one attribute and two
//! parameters. A limit exceeded because of them is reported at the option. Programs that write no color are not fogged.

use crate::isa::{
    Destination, FIRST_NAMED, FogMode, FogOption, Instruction, Mask, Modifier, Opcode, Parameter, ParameterSource,
    Program, Register, RegisterFile, Source, StateBinding, Swizzle,
};

/// Replaces the program's fog option by instructions.
pub(super) fn expand(mut program: Program) -> Program {
    let Some(fog) = program.fog.take() else { return program };
    let color = Register::new(RegisterFile::ColorOut, 0);
    let temporary = Register::new(RegisterFile::Temp, free_temporary(&program));
    let mut colored = false;
    for destination in program.instructions.iter_mut().filter_map(|i| i.destination.as_mut()) {
        if destination.register == color {
            destination.register = temporary;
            colored = true;
        }
    }
    if colored {
        let factors = parameter(&mut program, StateBinding::FogFactors, fog);
        let hue = parameter(&mut program, StateBinding::FogColor, fog);
        program.instructions.extend(Writer { fog, temporary, color }.instructions(factors, hue));
    }
    program
}

/// One more than the highest temporary that the program uses.
fn free_temporary(program: &Program) -> u16 {
    let written = program.instructions.iter().filter_map(|i| i.destination).map(|d| d.register);
    let read = program.instructions.iter().flat_map(|i| &i.sources).map(|s| s.register);
    let temporaries = written.chain(read).filter(|r| r.file == RegisterFile::Temp);
    temporaries.map(|r| r.index + 1).max().unwrap_or(0)
}

fn parameter(program: &mut Program, binding: StateBinding, fog: FogOption) -> Register {
    let source = ParameterSource::State(binding);
    if let Some(known) = program.parameters.iter().find(|p| p.source == source) {
        return known.register;
    }
    // The assembler leaves two numbers free for these.
    let register = Register::new(RegisterFile::Constant, FIRST_NAMED + program.parameters.len() as u16);
    program.parameters.push(Parameter { name: binding.to_string(), register, source, width: 4, span: fog.span });
    register
}

struct Writer {
    fog: FogOption,
    temporary: Register,
    color: Register,
}

impl Writer {
    fn instructions(&self, factors: Register, hue: Register) -> Vec<Instruction> {
        let (x, y, z, w) = (Swizzle::replicate(0), Swizzle::replicate(1), Swizzle::replicate(2), Swizzle::replicate(3));
        let own = |swizzle| self.source(self.temporary, swizzle);
        let coordinate = self.source(Register::new(RegisterFile::FogIn, 0), x);
        let factor = |swizzle| self.source(factors, swizzle);
        let fourth = |opcode, saturate, sources| self.instruction(opcode, self.temporary, 0b1000, saturate, sources);
        let minus = Source { modifier: Modifier::Negate, ..own(w) };
        let exponential = || fourth(Opcode::Exp, true, vec![minus]);
        let mut out = vec![self.instruction(Opcode::Mov, self.color, 0b1000, false, vec![own(w)])];
        match self.fog.mode {
            FogMode::Exp => out.extend([fourth(Opcode::Mul, false, vec![factor(z), coordinate]), exponential()]),
            FogMode::Exp2 => out.extend([
                fourth(Opcode::Mul, false, vec![factor(w), coordinate]),
                fourth(Opcode::Mul, false, vec![own(w), own(w)]),
                exponential(),
            ]),
            FogMode::Linear => out.push(fourth(Opcode::Mad, true, vec![factor(x), coordinate, factor(y)])),
        }
        out[1].coissue = true;
        let blended = vec![own(w), own(Swizzle::IDENTITY), self.source(hue, Swizzle::IDENTITY)];
        out.push(self.instruction(Opcode::Lrp, self.color, 0b0111, false, blended));
        out
    }

    fn source(&self, register: Register, swizzle: Swizzle) -> Source {
        Source { register, swizzle, modifier: Modifier::None, span: self.fog.span }
    }

    fn instruction(
        &self,
        opcode: Opcode,
        register: Register,
        mask: u8,
        saturate: bool,
        sources: Vec<Source>,
    ) -> Instruction {
        let span = self.fog.span;
        let destination = Destination { saturate, ..Destination::new(register, Mask(mask), span) };
        Instruction::new(opcode, Some(destination), sources, span)
    }
}
