//! V21 to V27, V30: rules of ps_1_4 only. V28 and V29 are checked with the operands.

use std::collections::BTreeMap;

use super::RuleId;
use super::context::{Context, is_arithmetic, is_texture};
use crate::isa::{Instruction, Modifier, Opcode, Register, RegisterFile, Span};

const R5: Register = Register::new(RegisterFile::Temp, 5);

pub(super) fn check(context: &mut Context<'_>) {
    colors(context);
    selectors(context);
    projections(context);
    depth(context);
    bump(context);
    loads(context);
    stages(context);
}

/// V21, [`RuleId::ColorReadInPhase1`].
fn colors(context: &mut Context<'_>) {
    for (index, instruction) in context.instructions() {
        for source in &instruction.sources {
            if source.register.file == RegisterFile::Input && context.phase(index) == 1 {
                context
                    .breach(RuleId::ColorReadInPhase1, source.span, format!("`{}` is read in phase 1", source.register))
                    .help("colours can only be read in phase 2: move the instruction after `phase`");
            }
        }
    }
}

/// V23, [`RuleId::MixedSelectors`].
fn selectors(context: &mut Context<'_>) {
    let mut chosen: BTreeMap<u16, bool> = BTreeMap::new();
    for (_, instruction) in context.instructions() {
        let source = instruction.sources.first().filter(|_| is_texture(instruction.opcode));
        let Some(source) = source.filter(|s| s.register.file == RegisterFile::Texture) else { continue };
        let third_is_w = source.swizzle.0[2] == 3;
        if *chosen.entry(source.register.index).or_insert(third_is_w) != third_is_w {
            let message = format!("`{}` is read as .xyz and as .xyw", source.register);
            context
                .breach(RuleId::MixedSelectors, source.span, message)
                .label("the other selector")
                .help("choose one of .xyz and .xyw for all reads of a coordinate set");
        }
    }
}

/// V24, [`RuleId::DivideModifier`].
fn projections(context: &mut Context<'_>) {
    let mut by_z = 0;
    for (_, instruction) in context.instructions() {
        let Some(source) = instruction.sources.first().filter(|_| is_texture(instruction.opcode)) else { continue };
        let file = source.register.file;
        let problem = match source.modifier {
            Modifier::Dz if instruction.opcode != Opcode::TexLd || file != RegisterFile::Temp => {
                Some("`_dz` is only allowed on the r# of texld")
            }
            Modifier::Dz => {
                by_z += 1;
                (by_z == 3).then_some("program has a third `_dz`, ps_1_4 allows 2")
            }
            Modifier::Dw if file != RegisterFile::Texture || source.swizzle.0 != [0, 1, 3, 3] => {
                Some("`_dw` is only allowed on a t# that is read as .xyw")
            }
            _ => None,
        };
        if let Some(problem) = problem {
            context.breach(RuleId::DivideModifier, source.span, problem);
        }
    }
}

/// V26, [`RuleId::TexDepth`].
fn depth(context: &mut Context<'_>) {
    let mut spent: Option<Span> = None;
    for (index, instruction) in context.instructions() {
        let destination = instruction.destination.map(|d| d.register);
        if spent.is_some() {
            let read = instruction.sources.iter().find(|s| s.register == R5).map(|s| s.span);
            let written = instruction.destination.filter(|d| d.register == R5).map(|d| d.span);
            if let Some(span) = read.or(written) {
                context
                    .breach(RuleId::TexDepth, span, "`r5` is used after texdepth")
                    .help("r5 is lost after texdepth: copy its value with texcrd first");
            }
        }
        if instruction.opcode != Opcode::TexDepth {
            continue;
        }
        let message = match destination {
            Some(register) if register != R5 => {
                Some(format!("the operand of `texdepth` is `{register}`, expected `r5`"))
            }
            _ if context.phase(index) == 1 => Some("`texdepth` is in phase 1, but only phase 2 allows it".to_owned()),
            _ => None,
        };
        if let Some(message) = message {
            context.breach(RuleId::TexDepth, instruction.span, message);
        }
        spent = spent.or(Some(instruction.span));
    }
}

/// V27, except the write mask (checked with the operands) and co-issue (checked with the pairs).
fn bump(context: &mut Context<'_>) {
    let mut found = 0;
    for (index, instruction) in context.instructions() {
        if instruction.opcode != Opcode::Bem {
            continue;
        }
        found += 1;
        if context.phase(index) != 1 {
            context
                .breach(RuleId::Bem, instruction.span, "`bem` is in phase 2, but only phase 1 allows it")
                .help("a program without `phase` only has phase 2: write `phase` after bem");
        }
        if found == 2 {
            context.breach(RuleId::Bem, instruction.span, "program has a second `bem`, ps_1_4 allows 1");
        }
    }
}

/// V22 (computed addresses) and V30.
fn loads(context: &mut Context<'_>) {
    let mut phase = 0;
    let mut loaded: Vec<u16> = Vec::new();
    let mut computed: BTreeMap<u16, u8> = BTreeMap::new();
    for (index, instruction) in context.instructions() {
        if context.phase(index) != phase {
            phase = context.phase(index);
            loaded.clear();
        }
        let load = matches!(instruction.opcode, Opcode::TexLd | Opcode::TexCrd);
        if load {
            let temp = instruction.sources.first().filter(|s| s.register.file == RegisterFile::Temp);
            if let Some(source) = temp.filter(|_| phase == 2) {
                let number = source.register.index;
                let ready = computed.get(&number).copied().unwrap_or(0) & 0b0111 == 0b0111;
                let late = loaded.contains(&number);
                if late || instruction.opcode == Opcode::TexLd && !ready {
                    address(context, instruction, late);
                }
            }
        }
        let Some(destination) = instruction.destination else { continue };
        let number = destination.register.index;
        if load {
            if loaded.contains(&number) {
                context
                    .breach(
                        RuleId::LoadedTwice,
                        instruction.span,
                        format!("`{}` is loaded twice in phase {phase}", destination.register),
                    )
                    .label("the second load");
            }
            loaded.push(number);
        }
        if phase == 1 && (load || is_arithmetic(instruction.opcode)) {
            *computed.entry(number).or_insert(0) |= destination.mask.0;
        }
    }
}

fn address(context: &mut Context<'_>, instruction: &Instruction, late: bool) {
    let source = &instruction.sources[0];
    let register = source.register;
    let message = if late {
        format!("`{register}` is an address in the phase that loads it")
    } else {
        format!("`{register}` is an address, but phase 1 did not write its x, y and z")
    };
    context
        .breach(RuleId::AddressPhase, source.span, message)
        .label("the address")
        .help("compute the address in phase 1 and read it in phase 2");
}

/// A load samples the stage with the number of its destination; the stage must exist.
fn stages(context: &mut Context<'_>) {
    let Some(allowed) = context.limit(super::allowed::Limit::Samplers) else { return };
    for (_, instruction) in context.instructions() {
        let Some(destination) = instruction.destination.filter(|_| instruction.opcode == Opcode::TexLd) else {
            continue;
        };
        let stage = u32::from(destination.register.index);
        // Numbers beyond the temporaries have already been reported as registers.
        let is_register = context.count(RegisterFile::Temp).is_some_and(|c| stage < c.value());
        if stage >= allowed.value && is_register {
            let message = format!("`texld` samples stage {stage}, {} has {} stages", allowed.owner, allowed.value);
            let advice = "texld samples the stage with the number of its destination register: use a register with a \
                 lower number";
            context
                .breach(RuleId::NoSuchRegister, instruction.span, message)
                .label("this stage")
                .exceeds(stage, &allowed, advice);
        }
    }
}
