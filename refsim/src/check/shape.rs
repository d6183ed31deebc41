//! V01, V02, V03, V05, V06 and the operand counts of V47: rules on the program as a whole.

use super::context::Context;
use super::{RuleId, Warning, WarningId};
use crate::isa::{ConstantValue, DestinationRule, Opcode, OpcodeClass, RegisterFile, Version};

pub(super) fn check(context: &mut Context<'_>) {
    version(context);
    constants(context);
    instructions(context);
    phases(context);
    if context.version.is_ps_1_x() {
        order(context);
    }
}

pub(super) fn version(context: &mut Context<'_>) {
    let (program, profile) = (context.program, context.profile);
    if profile.supports(context.version) {
        return;
    }
    let tokens: Vec<&str> = profile.limits.versions.iter().map(|v| v.token()).collect();
    let message = format!("program is {}, `{}` runs {}", context.version, profile.name, tokens.join(" "));
    let advice =
        "choose another device, or write the program in a version of this one; the list is `versions` of the profile";
    let violation = context.breach(RuleId::UnsupportedVersion, program.version_span, message);
    violation.label("the version").help(advice).key = Some("versions");
}

fn constants(context: &mut Context<'_>) {
    let program = context.program;
    let mut seen = std::collections::BTreeSet::new();
    for def in &program.constants {
        let register = def.register;
        if def.position > 0 {
            context
                .breach(RuleId::MisplacedDefinition, def.span, format!("`{register}` is defined after an instruction"))
                .help("move every def in front of the first instruction");
        }
        let wanted = match def.value {
            ConstantValue::Float(_) => RegisterFile::Constant,
            ConstantValue::Int(_) => RegisterFile::ConstantInt,
            ConstantValue::Bool(_) => RegisterFile::ConstantBool,
        };
        if register.file != wanted || register.relative.is_some() {
            let message = format!("the definition is for `{register}`, expected a `{}#` register", wanted.prefix());
            context.breach(RuleId::MisplacedDefinition, def.span, message);
            continue;
        }
        super::operands::number_in_range(context, register, def.span);
        if !seen.insert((register.file, register.index)) {
            context.breach(RuleId::MisplacedDefinition, def.span, format!("`{register}` is defined twice"));
        }
        if let (ConstantValue::Float(values), true) = (def.value, context.version.is_ps_1_x()) {
            // True for magnitudes above 1, for infinity and for NaN.
            if values.iter().any(|v| v & 0x7fff_ffff > 0x3f80_0000) {
                context.warnings.push(Warning {
                    id: WarningId::ClampedConstant,
                    span: def.span,
                    message: format!("`{register}` has values outside -1 to 1, which are clamped"),
                    help: "constants of ps_1_x are in -1 to 1: scale the value down, then up with _x2, _x4 or _x8",
                });
            }
        }
    }
}

fn instructions(context: &mut Context<'_>) {
    let version = context.version;
    for instruction in &context.program.instructions {
        let info = instruction.opcode.info();
        let name = info.mnemonic;
        let Some(sources) = info.source_count(version) else {
            let has: Vec<&str> = Version::ALL.iter().filter(|v| info.available(**v)).map(|v| v.token()).collect();
            let message = format!("{version} has no `{name}`");
            let help = format!("`{name}` is in {}", has.join(" "));
            context.breach(RuleId::UnsupportedInstruction, instruction.span, message).help(help);
            continue;
        };
        let mut wrong = |what: String| {
            context.breach(RuleId::Operands, instruction.span, what);
        };
        if instruction.sources.len() != usize::from(sources) {
            let found = instruction.sources.len();
            wrong(format!("`{name}` has {found} sources, expected {sources} in {version}"));
        }
        let destination = info.destination != DestinationRule::None;
        if instruction.destination.is_some() != destination {
            let expected = if destination { "expected a destination" } else { "expected no destination" };
            let found = if destination { "no destination" } else { "a destination" };
            wrong(format!("`{name}` has {found}, {expected}"));
        }
        if instruction.comparison.is_some() != info.comparison {
            let found = if info.comparison { "lacks its comparison" } else { "cannot have a comparison" };
            wrong(format!("`{name}` {found}"));
        }
    }
}

fn phases(context: &mut Context<'_>) {
    if context.version != Version::Ps1_4 {
        return;
    }
    let markers = context.program.instructions.iter().filter(|i| i.opcode == Opcode::Phase);
    for marker in markers.skip(1) {
        context
            .breach(RuleId::RepeatedPhase, marker.span, "program has a second `phase`, ps_1_4 allows 1")
            .label("the second marker")
            .help("a program has two phases at most: use a further pass");
    }
}

/// V05, for the two phases of ps_1_4 and the single phase of ps_1_1 to 1_3.
fn order(context: &mut Context<'_>) {
    let program = context.program;
    let mut arithmetic_in = 0;
    for (index, instruction) in context.instructions() {
        let phase = context.phase(index);
        match instruction.opcode.info().class {
            OpcodeClass::Arithmetic => arithmetic_in = phase,
            OpcodeClass::Texture if arithmetic_in == phase => {
                let name = instruction.opcode.info().mnemonic;
                context
                    .breach(
                        RuleId::TextureAfterArithmetic,
                        program.instructions[index].span,
                        format!("`{name}` follows arithmetic"),
                    )
                    .label("a texture instruction too late")
                    .help("move it in front of the phase's arithmetic, or behind `phase` in ps_1_4");
            }
            _ => {}
        }
    }
}
