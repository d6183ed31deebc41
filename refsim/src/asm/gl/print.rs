//! Printer of OpenGL fragment programs in canonical form.

use std::collections::BTreeSet;
use std::fmt::Write;

use super::super::number::float_text;
use crate::isa::{
    Condition, ConstantValue, Destination, FIRST_ENVIRONMENT, Instruction, Mask, Modifier, Opcode, OpcodeClass,
    ParameterSource, Program, ProgramResource, Register, RegisterFile, Source, Spelling, Swizzle, Version,
};

const LETTERS: [char; 4] = ['x', 'y', 'z', 'w'];

/// Writing to a string cannot fail.
macro_rules! put {
    ($out:expr, $($arg:tt)*) => {
        if write!($out, $($arg)*).is_err() {
            unreachable!("a string takes everything");
        }
    };
}

/// Prints a program in canonical form: names of host-set constants first, other constants written out where they are
/// used, one statement per line, shortest decimals.
///
/// If [`super::assemble`] produced the program, it parses the result back to an equal program.
pub(in super::super) fn print(program: &Program) -> String {
    let mut out = format!("{}\n", program.version);
    let arb = program.version == Version::ArbFp1_0;
    if let Some(fog) = program.fog {
        put!(out, "OPTION {};\n", fog.mode.name());
    }
    if arb {
        declarations(program, &mut out);
    }
    for parameter in &program.parameters {
        if let ParameterSource::Named(default) = parameter.source {
            put!(out, "DECLARE {} = {};\n", parameter.name, vector(default));
        }
    }
    for i in &program.instructions {
        Printer { program, arb, out: &mut out }.instruction(i);
    }
    out.push_str("END\n");
    out
}

/// Writes the declarations of a program: temporaries from `R0` to the highest one, and bindings that no instruction
/// uses.
fn declarations(program: &Program, out: &mut String) {
    let written = program.instructions.iter().filter_map(|i| i.destination).map(|d| d.register);
    let read = program.instructions.iter().flat_map(|i| &i.sources).map(|s| s.register);
    let used: BTreeSet<_> = written.chain(read).map(|r| ProgramResource::of_source(program, r)).collect();
    let (mut temporaries, mut unused) = (0, String::new());
    for (number, resource) in used.iter().chain(program.resources.keys()).enumerate() {
        let (word, text) = match *resource {
            ProgramResource::Register(Register { file: RegisterFile::Temp, index, .. }) => {
                temporaries = temporaries.max(index + 1);
                continue;
            }
            _ if used.contains(resource) => continue,
            ProgramResource::Register(r) if r.file != RegisterFile::Constant => ("ATTRIB", register_name(program, &r)),
            ProgramResource::Register(r) => ("PARAM", register_name(program, &r)),
            ProgramResource::Constant(bits) => ("PARAM", vector(bits)),
            ProgramResource::State(binding) => ("PARAM", binding.to_string()),
        };
        unused += &format!("{word} unused{number} = {text};\n");
    }
    if temporaries > 0 {
        let names: Vec<String> = (0..temporaries).map(|n| format!("R{n}")).collect();
        *out += &format!("TEMP {};\n", names.join(", "));
    }
    *out += &unused;
}

pub(in super::super) fn register_name(program: &Program, register: &Register) -> String {
    let mut out = String::new();
    let arb = program.version == Version::ArbFp1_0;
    Printer { program, arb, out: &mut out }.register(register, false);
    out
}

fn vector(bits: [u32; 4]) -> String {
    let [x, y, z, w] = bits.map(float_text);
    format!("{{{x}, {y}, {z}, {w}}}")
}

struct Printer<'p> {
    program: &'p Program,
    arb: bool,
    out: &'p mut String,
}

impl Printer<'_> {
    fn instruction(&mut self, i: &Instruction) {
        let name = Spelling::of(i.opcode).map_or(i.opcode.info().mnemonic, |s| s.name);
        self.out.push_str(name);
        self.out.extend(i.fragment.precision.map(crate::isa::Precision::letter));
        self.out.push_str(if i.fragment.updates { "C" } else { "" });
        self.out.push_str(if i.destination.is_some_and(|d| d.saturate) { "_SAT" } else { "" });
        let mut separator = " ";
        if let Some(d) = &i.destination {
            self.out.push_str(separator);
            self.destination(d);
            if let Some(c) = &i.fragment.condition {
                self.out.push_str(" (");
                self.condition(c);
                self.out.push(')');
            }
            separator = ", ";
        } else if let Some(c) = &i.fragment.condition {
            self.out.push_str(separator);
            self.condition(c);
            separator = ", ";
        }
        let texture = i.opcode.info().class == OpcodeClass::Texture && i.opcode != Opcode::Kil;
        for (k, s) in i.sources.iter().enumerate().filter(|(k, _)| !(texture && *k == 1)) {
            self.out.push_str(separator);
            match (i.opcode, k) {
                (Opcode::Swz, 0) => self.extended(s, i.fragment.negate),
                _ => self.source(s),
            }
            separator = ", ";
        }
        if let (true, Some(unit)) = (texture, i.sources.get(1)) {
            match self.arb {
                true => put!(self.out, ", texture[{}]", unit.register.index),
                false => put!(self.out, ", TEX{}", unit.register.index),
            }
        }
        if let Some(target) = i.fragment.target {
            put!(self.out, ", {}", target.name());
        }
        self.out.push_str(";\n");
    }

    fn condition(&mut self, c: &Condition) {
        self.out.push_str(c.test.name());
        self.swizzle(c.swizzle);
    }

    fn destination(&mut self, d: &Destination) {
        self.register(&d.register, true);
        if d.mask != Mask::ALL {
            self.out.push('.');
            self.out.extend(d.mask.components().map(|c| LETTERS[c]));
        }
    }

    fn source(&mut self, s: &Source) {
        let (open, close) = match s.modifier {
            Modifier::Negate => ("-", ""),
            Modifier::Absolute => ("|", "|"),
            Modifier::AbsoluteNegate => ("-|", "|"),
            _ => ("", ""),
        };
        self.out.push_str(open);
        self.register(&s.register, false);
        self.swizzle(s.swizzle);
        self.out.push_str(close);
    }

    /// Writes the operands of `SWZ`: `R0, -x, 0, 1, z`.
    fn extended(&mut self, s: &Source, negate: u8) {
        self.register(&s.register, false);
        for (i, c) in s.swizzle.0.into_iter().enumerate() {
            let sign = if negate >> i & 1 == 1 { "-" } else { "" };
            let letter = ['x', 'y', 'z', 'w', '0', '1'][usize::from(c.min(5))];
            put!(self.out, ", {sign}{letter}");
        }
    }

    fn swizzle(&mut self, s: Swizzle) {
        match s.replicated() {
            Some(c) => put!(self.out, ".{}", LETTERS[usize::from(c & 3)]),
            None if s == Swizzle::IDENTITY => {}
            None => {
                self.out.push('.');
                self.out.extend(s.0.iter().map(|&c| LETTERS[usize::from(c & 3)]));
            }
        }
    }

    fn register(&mut self, register: &Register, written: bool) {
        let n = register.index;
        let arb = self.arb;
        match (register.file, arb) {
            (RegisterFile::Temp, _) => put!(self.out, "R{n}"),
            (RegisterFile::Half, _) => put!(self.out, "H{n}"),
            (RegisterFile::Discard, _) => self.out.push_str("RC"),
            (RegisterFile::HalfDiscard, _) => self.out.push_str("HC"),
            (RegisterFile::ColorOut, false) => self.out.push_str("o[COLR]"),
            (RegisterFile::ColorOut, true) => self.out.push_str("result.color"),
            (RegisterFile::HalfColorOut, _) => self.out.push_str("o[COLH]"),
            (RegisterFile::DepthOut, false) => self.out.push_str("o[DEPR]"),
            (RegisterFile::DepthOut, true) => self.out.push_str("result.depth"),
            (RegisterFile::Input, false) => put!(self.out, "f[COL{n}]"),
            (RegisterFile::Input, true) => {
                self.out.push_str(if n == 0 { "fragment.color" } else { "fragment.color.secondary" });
            }
            (RegisterFile::Texture, false) => put!(self.out, "f[TEX{n}]"),
            (RegisterFile::Texture, true) => put!(self.out, "fragment.texcoord[{n}]"),
            (RegisterFile::FogIn, false) => self.out.push_str("f[FOGC]"),
            (RegisterFile::FogIn, true) => self.out.push_str("fragment.fogcoord"),
            (RegisterFile::WindowPosition, false) => self.out.push_str("f[WPOS]"),
            (RegisterFile::WindowPosition, true) => self.out.push_str("fragment.position"),
            (RegisterFile::Constant, _) => self.constant(register),
            _ => put!(self.out, "{register}"),
        }
        debug_assert!(!written || register.file != RegisterFile::Constant);
    }

    fn constant(&mut self, register: &Register) {
        let n = register.index;
        let defined = self.program.constants.iter().find(|d| d.register == *register);
        let named = self.program.parameters.iter().find(|p| p.register == *register);
        match (defined.map(|d| d.value), named, self.arb) {
            (Some(ConstantValue::Float(bits)), ..) => self.out.push_str(&vector(bits)),
            (_, Some(parameter), _) => self.out.push_str(&parameter.name),
            (_, _, true) if n >= FIRST_ENVIRONMENT => put!(self.out, "program.env[{}]", n - FIRST_ENVIRONMENT),
            (_, _, true) => put!(self.out, "program.local[{n}]"),
            _ => put!(self.out, "p[{n}]"),
        }
    }
}
