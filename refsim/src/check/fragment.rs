//! OpenGL's fragment programs. Sources: GL_NV_fragment_program for `!!FP1.0`, GL_ARB_fragment_program for `!!ARBfp1.0`.
//! Temporaries start at zero, so reads need no earlier write.

use std::collections::{BTreeMap, BTreeSet};

use super::RuleId;
use super::allowed::Limit;
use super::context::{Context, ordinal};
use crate::isa::{
    ConstantValue, FIRST_ENVIRONMENT, FIRST_NAMED, Instruction, Modifier, Opcode, OpcodeClass, Precision, Program,
    Register, RegisterFile, Source, Span, Spelling, Version,
};

/// Numbers of named full- and half-precision temporaries.
const FULL: u16 = 32;
const HALF: u16 = 64;
/// Maximum total weight of a program's registers; a half-precision register weighs 1.
const MAX_WEIGHT: u32 = 64;

pub(super) fn check(context: &mut Context<'_>) {
    let nv = context.version == Version::Fp1_0;
    let all: Vec<&Instruction> = context.program.instructions.iter().collect();
    for (index, instruction) in all.iter().enumerate() {
        if !context.is_sound(index) {
            missing(context, instruction);
            continue;
        }
        registers(context, instruction);
        operands(context, instruction);
        if nv {
            reflection(context, instruction);
            suffixes(context, instruction);
            packing(context, instruction);
            distinct(context, instruction);
        }
    }
    outputs(context, &all);
    targets(context, &all);
    if nv {
        weight(context, &all);
    } else {
        indirections(context, &all);
    }
}

/// V03, [`RuleId::UnsupportedInstruction`].
fn missing(context: &mut Context<'_>, instruction: &Instruction) {
    let name = Spelling::of(instruction.opcode).map_or(instruction.opcode.info().mnemonic, |s| s.name);
    let version = context.version;
    let message = format!("`{name}` is not an instruction of {version}");
    let advice = "replace it by instructions that the extension has";
    context.breach(RuleId::UnsupportedInstruction, instruction.span, message).label("this one").help(advice);
}

fn all_registers(instruction: &Instruction) -> impl Iterator<Item = (Register, Span)> + '_ {
    let written = instruction.destination.map(|d| (d.register, d.span));
    written.into_iter().chain(instruction.sources.iter().map(|s| (s.register, s.span)))
}

/// V07: register numbers.
fn registers(context: &mut Context<'_>, instruction: &Instruction) {
    for (register, span) in all_registers(instruction) {
        let figure = |context: &Context<'_>, limit: Limit, emulated: u32| {
            context.limit(limit).map_or((emulated, "limits"), |a| (a.value.min(emulated), a.key))
        };
        let (count, key) = match register.file {
            RegisterFile::Temp => (FULL.into(), "version"),
            RegisterFile::Half => (HALF.into(), "version"),
            RegisterFile::Sampler => figure(context, Limit::Samplers, 16),
            RegisterFile::Texture => figure(context, Limit::TextureCoordinates, 8),
            RegisterFile::Constant if register.index < FIRST_NAMED => figure(context, Limit::Constants, 256),
            _ => continue,
        };
        let number = match register.file {
            RegisterFile::Constant => register.index % FIRST_ENVIRONMENT,
            _ => register.index,
        };
        if u32::from(number) >= count {
            let name = written_name(register, number);
            let message = format!("`{name}` does not exist: there are only {count}");
            let violation = context.breach(RuleId::NoSuchRegister, span, message).label("no such register");
            violation.figure(count, u32::from(number) + 1).help("count from 0");
            violation.key = (key != "version").then_some(key);
        }
    }
}

fn written_name(register: Register, number: u16) -> String {
    match register.file {
        RegisterFile::Temp => format!("R{number}"),
        RegisterFile::Sampler => format!("TEX{number}"),
        RegisterFile::Texture => format!("f[TEX{number}]"),
        RegisterFile::Constant if register.index >= FIRST_ENVIRONMENT => format!("program.env[{number}]"),
        RegisterFile::Constant => format!("p[{number}]"),
        _ => register.to_string(),
    }
}

/// V42: operands of scalar instructions select one component.
fn operands(context: &mut Context<'_>, instruction: &Instruction) {
    let Some(spelling) = Spelling::of(instruction.opcode).filter(|s| s.opcode.is_scalar()) else { return };
    // In !!FP1.0 a literal for all components counts as one component; in !!ARBfp1.0 it has a suffix, `0.5.x`.
    let plain = |register: &Register| {
        if context.version == Version::ArbFp1_0 {
            return false;
        }
        let defined = context.program.constants.iter().find(|d| d.register == *register);
        defined.is_some_and(|d| matches!(d.value, ConstantValue::Float([x, y, z, w]) if x == y && y == z && z == w))
    };
    let vague: Vec<Source> = instruction
        .sources
        .iter()
        .filter(|s| s.swizzle.replicated().is_none() && !plain(&s.register))
        .copied()
        .collect();
    for source in vague {
        let message = format!("`{}` reads one component, found four", spelling.name);
        let advice = "choose one: `.x`, `.y`, `.z` or `.w`";
        context.breach(RuleId::ScalarSource, source.span, message).label("which component?").help(advice);
    }
}

/// V60: suffixes of the instruction.
fn suffixes(context: &mut Context<'_>, instruction: &Instruction) {
    let Some(spelling) = Spelling::of(instruction.opcode) else { return };
    let part = &instruction.fragment;
    let precise = match part.precision {
        None => true,
        Some(Precision::Fixed) => spelling.fixed,
        Some(_) => spelling.floats,
    };
    let saturates = instruction.destination.is_some_and(|d| d.saturate);
    let wrong = match part.precision {
        Some(precision) if !precise => precision.letter().to_string(),
        _ if part.updates && !spelling.result => "C".to_owned(),
        _ if saturates && !spelling.result => "_SAT".to_owned(),
        _ => return,
    };
    let message = format!("`{}` has no suffix {wrong}", spelling.name);
    context.breach(RuleId::InvalidSuffix, instruction.span, message).help("see the extension's table of instructions");
}

/// V14: `RFL` writes three components (section 3.11.5.26).
fn reflection(context: &mut Context<'_>, instruction: &Instruction) {
    let Some(destination) = instruction.destination.filter(|d| instruction.opcode == Opcode::Rfl && d.mask.contains(3))
    else {
        return;
    };
    let message = "`RFL` only writes x, y and z, found a write mask with w";
    let violation = context.breach(RuleId::InvalidMask, destination.span, message);
    violation.label("writes w too").help("write the mask `.xyz`");
}

/// V61: packed words have full precision.
fn packing(context: &mut Context<'_>, instruction: &Instruction) {
    let half = match instruction.opcode {
        Opcode::Pk2h | Opcode::Pk2us | Opcode::Pk4b | Opcode::Pk4ub => {
            instruction.destination.filter(|d| d.register.file.is_half()).map(|d| d.span)
        }
        Opcode::Up2h | Opcode::Up2us | Opcode::Up4b | Opcode::Up4ub => {
            instruction.sources.first().filter(|s| s.register.file.is_half()).map(|s| s.span)
        }
        _ => None,
    };
    if let Some(span) = half {
        let message = "a packed word has 32 bits, but a half-precision register has only 16";
        context.breach(RuleId::PackedPrecision, span, message).help("keep packed words in R# or o[COLR]");
    }
}

/// Returns `true` if literals, and names of literals, merge into one constant: they have at most four different numbers
/// (section 3.11.2 of GL_NV_fragment_program). The sign of a single number is part of the number.
fn merge_into_one<'a>(program: &Program, mut constants: impl Iterator<Item = &'a Source>) -> bool {
    let mut numbers = BTreeSet::new();
    constants.all(|source| {
        let defined = program.constants.iter().find(|d| d.register == source.register);
        let Some(ConstantValue::Float(vector)) = defined.map(|d| d.value) else { return false };
        let negated = vector == [vector[0]; 4] && source.modifier == Modifier::Negate;
        numbers.extend(vector.map(|bits| bits ^ u32::from(negated) << 31));
        numbers.len() <= 4
    })
}

/// V62: one attribute and one constant per instruction.
fn distinct(context: &mut Context<'_>, instruction: &Instruction) {
    if !context.version_limits() {
        return;
    }
    let is_attribute = |file| {
        use RegisterFile as F;
        matches!(file, F::Input | F::Texture | F::FogIn | F::WindowPosition)
    };
    let kinds: [(&str, &dyn Fn(RegisterFile) -> bool); 2] =
        [("attributes", &is_attribute), ("constants", &|file| file == RegisterFile::Constant)];
    for (what, belongs) in kinds {
        let sources = instruction.sources.iter().filter(|s| belongs(s.register.file));
        if merge_into_one(context.program, sources.clone()) {
            continue;
        }
        let mut seen = BTreeSet::new();
        let mut second = None;
        for source in sources {
            if seen.insert((source.register.file, source.register.index)) && seen.len() == 2 {
                second = Some(source.span);
            }
        }
        if let Some(span) = second {
            let message = format!("instruction reads {} different {what}, allowed is 1", seen.len());
            let violation = context.breach(RuleId::TooManyOperandReads, span, message).label("the second");
            violation.figure(1, seen.len() as u32).help("move one of them into a temporary first");
        }
    }
}

/// V63: colour is written in one precision, depth through z, and a `!!FP1.0` program writes an output. `!!ARBfp1.0`
/// leaves unwritten outputs undefined; here the target keeps its contents.
fn outputs(context: &mut Context<'_>, all: &[&Instruction]) {
    let find = |file| all.iter().filter_map(|i| i.destination).find(move |d| d.register.file == file);
    let (full, half) = (find(RegisterFile::ColorOut), find(RegisterFile::HalfColorOut));
    if let (Some(full), Some(half)) = (full, half) {
        let later = if full.span.start > half.span.start { full } else { half };
        let message = "program writes both o[COLR] and o[COLH]";
        context.breach(RuleId::FragmentOutputs, later.span, message).help("write the colour to only one of them");
    }
    let depths = all.iter().filter_map(|i| i.destination).filter(|d| d.register.file == RegisterFile::DepthOut);
    for depth in depths.filter(|d| d.mask.0 != 0b0100) {
        let message = "depth is the z component, which the mask leaves out";
        context.breach(RuleId::FragmentOutputs, depth.span, message).help("write o[DEPR].z or result.depth.z");
    }
    let nothing = full.is_none() && half.is_none() && find(RegisterFile::DepthOut).is_none();
    if nothing && context.version == Version::Fp1_0 {
        let span = context.program.version_span;
        let message = "program writes neither colour nor depth";
        context.breach(RuleId::FragmentOutputs, span, message).help("write a result, for example o[COLR]");
    }
}

/// V64: each texture image unit is read with one texture target.
fn targets(context: &mut Context<'_>, all: &[&Instruction]) {
    let mut known = BTreeMap::new();
    for instruction in all {
        let (Some(target), Some(unit)) = (instruction.fragment.target, instruction.sources.get(1)) else { continue };
        let first = *known.entry(unit.register.index).or_insert(target);
        if first != target {
            let message =
                format!("image unit {} is read as {} and as {}", unit.register.index, first.name(), target.name());
            context
                .breach(RuleId::ImageUnitTarget, instruction.span, message)
                .help("bind the second texture to another unit");
        }
    }
}

/// V65: total weight of the registers.
fn weight(context: &mut Context<'_>, all: &[&Instruction]) {
    if !context.version_limits() {
        return;
    }
    let mut seen = BTreeSet::new();
    let mut weight = 0;
    let mut first = None;
    for (register, span) in all.iter().flat_map(|i| all_registers(i)) {
        let one = match register.file {
            RegisterFile::Temp | RegisterFile::ColorOut | RegisterFile::DepthOut => 2,
            RegisterFile::Half | RegisterFile::HalfColorOut => 1,
            _ => 0,
        };
        if one > 0 && seen.insert((register.file, register.index)) {
            weight += one;
            if weight > MAX_WEIGHT && first.is_none() {
                first = Some(span);
            }
        }
    }
    let Some(span) = first else { return };
    let message = format!("registers weigh {weight}, !!FP1.0 allows {MAX_WEIGHT}");
    let violation = context.breach(RuleId::RegisterWeight, span, message).label("from here on");
    violation.figure(MAX_WEIGHT, weight).help("use fewer temporaries, or H# (weight 1) instead of R# (weight 2)");
}

/// V66: texture indirections of ARB programs. A texture read begins a new indirection if its coordinates were computed,
/// or its destination used, since the last one began.
fn indirections(context: &mut Context<'_>, all: &[&Instruction]) {
    let Some(allowed) = context.limit(Limit::DependentReads) else { return };
    let mut touched: BTreeSet<Register> = BTreeSet::new();
    let mut written: BTreeSet<Register> = BTreeSet::new();
    let mut count = 1_u32;
    let mut first = None;
    for instruction in all {
        let temporary = |r: &Register| r.file == RegisterFile::Temp;
        let sources: Vec<Register> = instruction.sources.iter().map(|s| s.register).filter(temporary).collect();
        let destination = instruction.destination.map(|d| d.register).filter(temporary);
        if instruction.opcode.info().class == OpcodeClass::Texture {
            let computed = sources.iter().any(|r| written.contains(r));
            let used = destination.is_some_and(|r| touched.contains(&r));
            if computed || used {
                count += 1;
                touched.clear();
                written.clear();
                if count > allowed.value && first.is_none() {
                    first = Some(instruction.span);
                }
            }
        } else {
            touched.extend(sources.iter().copied());
            touched.extend(destination);
        }
        written.extend(destination);
    }
    let Some(span) = first else { return };
    let message = format!("program has {count} texture indirections, {} allows {}", allowed.owner, allowed.value);
    let label = format!("the {} begins here", ordinal(allowed.value + 1));
    context.breach(RuleId::Indirections, span, message).label(label).exceeds(
        count,
        &allowed,
        "read textures together, before the instructions that depend on them",
    );
}
