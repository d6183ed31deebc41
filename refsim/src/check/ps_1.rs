//! V18, V19, V31, V32, V33: rules of ps_1_1 to ps_1_3 only.

use super::RuleId;
use super::context::{Context, is_texture};
use crate::isa::{Instruction, Modifier, Opcode, Register, RegisterFile, Span, Swizzle, Version};

pub(super) fn check(context: &mut Context<'_>) {
    selects(context);
    counts(context);
    sequences(context);
    bump_maps(context);
    expansion(context);
}

/// V18, [`RuleId::CndCondition`].
fn selects(context: &mut Context<'_>) {
    for (_, instruction) in context.instructions() {
        if instruction.opcode != Opcode::Cnd {
            continue;
        }
        let source = &instruction.sources[0];
        let alpha = source.swizzle == Swizzle::replicate(3) && source.modifier == Modifier::None;
        if source.register != Register::new(RegisterFile::Temp, 0) || !alpha {
            context
                .breach(RuleId::CndCondition, source.span, "the first source of `cnd` is not `r0.a`")
                .help("before ps_1_4, cnd only compares r0.a with 0.5: mov the value into r0.a");
        }
    }
}

/// V19, [`RuleId::CmpOrDp4`].
fn counts(context: &mut Context<'_>) {
    if context.version == Version::Ps1_1 {
        return;
    }
    for (opcode, limit) in [(Opcode::Cmp, 3_u32), (Opcode::Dp4, 4)] {
        let all: Vec<Span> = context.instructions().filter(|(_, i)| i.opcode == opcode).map(|(_, i)| i.span).collect();
        if let Some(span) = all.get(limit as usize) {
            let (found, name, version) = (all.len() as u32, opcode.info().mnemonic, context.version);
            let message = format!("program has {found} `{name}` instructions, {version} allows {limit}");
            context.breach(RuleId::CmpOrDp4, *span, message).figure(limit, found);
        }
    }
    for (_, instruction) in context.instructions() {
        let Some(destination) = instruction.destination.filter(|_| instruction.opcode == Opcode::Cmp) else { continue };
        if instruction.sources.iter().any(|s| s.register == destination.register) {
            context
                .breach(RuleId::CmpOrDp4, instruction.span, "`cmp` writes one of its own sources")
                .help("before ps_1_4, the destination of cmp cannot be one of its sources");
        }
    }
}

/// An incomplete matrix product.
struct Pending {
    rows: u8,
    done: u8,
    next: u16,
    source: Register,
    span: Span,
}

/// V31, [`RuleId::TextureChain`].
fn sequences(context: &mut Context<'_>) {
    let mut pending: Option<Pending> = None;
    for (_, instruction) in context.instructions() {
        if !is_texture(instruction.opcode) {
            continue;
        }
        let Some(destination) = instruction.destination else { continue };
        let stage = destination.register.index;
        let source = instruction.sources.first().map(|s| s.register);
        if let Some(source) = source
            && source.file == RegisterFile::Texture
            && source.index >= stage
        {
            let name = instruction.opcode.info().mnemonic;
            let message =
                format!("`{name}` of stage {stage} reads `{source}`, expected the result of an earlier stage");
            context.breach(RuleId::TextureChain, instruction.span, message);
        }
        let rows = match instruction.opcode {
            Opcode::TexM3x2Pad | Opcode::TexM3x2Tex | Opcode::TexM3x2Depth => 2,
            Opcode::TexM3x3Pad | Opcode::TexM3x3Tex | Opcode::TexM3x3Spec | Opcode::TexM3x3VSpec | Opcode::TexM3x3 => 3,
            _ => 0,
        };
        pending = step(context, pending, instruction, rows, stage, source);
    }
    if let Some(left) = pending {
        unfinished(context, left.span);
    }
}

fn unfinished(context: &mut Context<'_>, span: Span) {
    context
        .breach(RuleId::TextureChain, span, "a pad is not followed by the rest of its matrix")
        .help("write texm3x2pad then texm3x2tex, or texm3x3pad twice then texm3x3tex, in consecutive stages");
}

fn step(
    context: &mut Context<'_>,
    pending: Option<Pending>,
    instruction: &Instruction,
    rows: u8,
    stage: u16,
    source: Option<Register>,
) -> Option<Pending> {
    let pad = matches!(instruction.opcode, Opcode::TexM3x2Pad | Opcode::TexM3x3Pad);
    let fits =
        |p: &Pending| p.rows == rows && p.next == stage && Some(p.source) == source && pad == (p.done + 2 == rows);
    match pending {
        Some(p) if fits(&p) => {
            return pad.then_some(Pending { done: p.done + 1, next: stage.saturating_add(1), ..p });
        }
        Some(p) => unfinished(context, p.span),
        None if rows > 0 && !pad => {
            let name = instruction.opcode.info().mnemonic;
            let n = rows - 1;
            let message = format!("`{name}` does not follow its {n} pad{}", if n == 1 { "" } else { "s" });
            context.breach(RuleId::TextureChain, instruction.span, message);
        }
        None => {}
    }
    let source = source.filter(|_| pad)?;
    Some(Pending { rows, done: 1, next: stage.saturating_add(1), source, span: instruction.span })
}

/// V32, [`RuleId::BumpMapReused`].
fn bump_maps(context: &mut Context<'_>) {
    let mut read_by_bump = 0_u64;
    for (_, instruction) in context.instructions() {
        let bump = matches!(instruction.opcode, Opcode::TexBem | Opcode::TexBemL);
        for source in &instruction.sources {
            let register = source.register;
            if register.file != RegisterFile::Texture || register.index > 63 {
                continue;
            }
            if bump {
                read_by_bump |= 1 << register.index;
            } else if read_by_bump >> register.index & 1 == 1 {
                let message = format!("`{register}` was read by texbem and is read again");
                context.breach(RuleId::BumpMapReused, source.span, message);
            }
        }
    }
}

/// V33, [`RuleId::ExpandModifier`].
fn expansion(context: &mut Context<'_>) {
    use Opcode as O;
    for (_, instruction) in context.instructions() {
        let opcode = instruction.opcode;
        let allowed = match context.version {
            Version::Ps1_1 => matches!(
                opcode,
                O::TexM3x2Pad | O::TexM3x2Tex | O::TexM3x3Pad | O::TexM3x3Tex | O::TexM3x3Spec | O::TexM3x3VSpec
            ),
            _ => !matches!(opcode, O::TexReg2Ar | O::TexReg2Gb | O::TexBem | O::TexBemL),
        };
        let source = instruction.sources.first().filter(|_| is_texture(opcode) && !allowed);
        if let Some(source) = source.filter(|s| s.modifier == Modifier::Bx2) {
            let (name, version) = (opcode.info().mnemonic, context.version);
            context.breach(
                RuleId::ExpandModifier,
                source.span,
                format!("`{name}` of {version} cannot expand with `_bx2`"),
            );
        }
    }
}
