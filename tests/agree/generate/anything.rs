//! Programs that can be written in assembly, legal or not.

use super::bare;
use crate::random::Random;
use refsim::isa::{
    Comparison, ConstantDef, ConstantValue, Declaration, Destination, DestinationRule, Instruction, Mask, Modifier,
    Opcode, Predicate, Program, ProgramText, Register, RegisterFile, Relative, Source, Span, Swizzle, Usage, Version,
};

/// Any program of any Direct3D version.
pub(crate) fn anything(seed: u64) -> Program {
    let r = &mut Random::new(seed);
    let version = r.of(&Version::ALL);
    let instructions: Vec<Instruction> = (0..r.below(16)).map(|_| instruction(version, r)).collect();
    let last = instructions.len() + 1;
    // Ascending, most of them 0.
    let positions = |r: &mut Random| {
        let mut all: Vec<usize> = (0..r.below(5)).map(|_| if r.one_in(4) { r.below(last) } else { 0 }).collect();
        all.sort_unstable();
        all
    };
    let span = Span::default();
    let constants = positions(r).into_iter().map(|position| ConstantDef { position, ..constant(r) }).collect();
    let declarations = positions(r).into_iter().map(|position| {
        let (usage, centroid) = (usage(r), r.coin());
        let destination = Destination { shift: 0, saturate: false, centroid, ..destination(r) };
        Declaration { usage, destination, position, span }
    });
    let declarations = declarations.collect();
    let (parameters, resources, text) = (Vec::new(), std::collections::BTreeMap::new(), ProgramText::default());
    Program {
        version,
        version_span: span,
        constants,
        declarations,
        instructions,
        parameters,
        resources,
        fog: None,
        text,
    }
}

/// An instruction of any version; those that `version` has get as many operands as it takes.
fn instruction(version: Version, r: &mut Random) -> Instruction {
    let opcode = r.of(Opcode::ALL);
    let info = opcode.info();
    let count = info.source_count(version).map_or_else(|| r.below(5), usize::from);
    Instruction {
        comparison: info.comparison.then(|| r.of(&Comparison::ALL)),
        destination: (info.destination != DestinationRule::None).then(|| destination(r)),
        sources: (0..count).map(|_| source(r)).collect(),
        coissue: r.one_in(5),
        predicate: r.one_in(5).then(|| Predicate { not: r.coin(), swizzle: swizzle(r), span: Span::default() }),
        ..bare(opcode)
    }
}

/// Mostly small register numbers, some beyond any version, some extreme.
fn index(r: &mut Random) -> u16 {
    match r.below(10) {
        0 => r.next() as u16,
        1 => u16::MAX,
        _ => r.below(12),
    }
}

fn register(r: &mut Random) -> Register {
    let file = r.of(RegisterFile::DIRECT3D);
    if file.is_unnumbered() {
        return Register::new(file, 0);
    }
    let relative = |r: &mut Random| if r.coin() { Relative::Address(r.below(4)) } else { Relative::Loop };
    Register { file, index: index(r), relative: r.one_in(10).then(|| relative(r)) }
}

fn swizzle(r: &mut Random) -> Swizzle {
    match r.below(3) {
        0 => Swizzle::IDENTITY,
        1 => Swizzle::replicate(r.below(4)),
        _ => Swizzle([0; 4].map(|_: u8| r.below(4))),
    }
}

fn source(r: &mut Random) -> Source {
    Source { register: register(r), swizzle: swizzle(r), modifier: r.of(Modifier::DIRECT3D), span: Span::default() }
}

fn destination(r: &mut Random) -> Destination {
    Destination {
        register: register(r),
        mask: Mask(1 + r.below(15)),
        shift: r.below(7i8) - 3,
        saturate: r.coin(),
        partial_precision: r.coin(),
        centroid: false,
        span: Span::default(),
    }
}

fn constant(r: &mut Random) -> ConstantDef {
    let (file, value) = match r.below(3) {
        0 => (RegisterFile::Constant, ConstantValue::Float(r.vector())),
        1 => (RegisterFile::ConstantInt, ConstantValue::Int([0; 4].map(|_: i32| r.bits().cast_signed()))),
        _ => (RegisterFile::ConstantBool, ConstantValue::Bool(r.coin())),
    };
    ConstantDef { register: Register::new(file, index(r)), value, position: 0, span: Span::default() }
}

fn usage(r: &mut Random) -> Usage {
    match r.below(2) {
        0 => r.of(&[Usage::Plain, Usage::Sampler2d, Usage::SamplerCube, Usage::SamplerVolume]),
        _ => r.of(&Usage::NUMBERED)(r.next() as u8),
    }
}
