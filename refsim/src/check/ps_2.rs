//! V36, V38, V39, V42 to V44, V50, V59: rules of ps_2_0 and up; some are shared with vertex programs.

use std::collections::BTreeMap;

use super::RuleId;
use super::allowed::Limit;
use super::context::Context;
use super::reads::matrix_rows;
use crate::isa::{DestinationRule, Instruction, Mask, Modifier, Opcode, RegisterFile, Source, Span, Swizzle};

pub(super) fn check(context: &mut Context<'_>) {
    for (_, instruction) in context.instructions() {
        tokens(context, instruction);
        shared(context, instruction);
    }
    outputs(context);
    dependent_reads(context);
}

/// Rules on single instructions that apply to pixel and vertex programs.
pub(super) fn shared(context: &mut Context<'_>, instruction: &Instruction) {
    scalars(context, instruction);
    if instruction.opcode == Opcode::SinCos {
        sincos(context, instruction);
    }
    matrix(context, instruction);
    steps(context, instruction);
}

/// V39, [`RuleId::TooManyConstants`].
fn tokens(context: &mut Context<'_>, instruction: &Instruction) {
    if !context.version_limits() || instruction.opcode == Opcode::SinCos {
        return;
    }
    let found = instruction.sources.iter().filter(|s| s.register.file == RegisterFile::Constant).count();
    if found > 2 {
        let message = format!("instruction reads {found} constants, {} allows 2", context.version);
        let violation = context.breach(RuleId::TooManyConstants, instruction.span, message);
        violation.figure(2, found as u32).help("mov one of them into a temporary first");
    }
}

fn one_component(source: &Source) -> bool {
    source.swizzle.replicated().is_some()
}

/// V42, [`RuleId::ScalarSource`] and V44, [`RuleId::Dp2AddSource`].
fn scalars(context: &mut Context<'_>, instruction: &Instruction) {
    let opcode = instruction.opcode;
    let name = opcode.info().mnemonic;
    let scalar: &[Source] = match opcode {
        op if op.is_scalar() => &instruction.sources,
        Opcode::Dp2Add => instruction.sources.get(2..).unwrap_or_default(),
        _ => &[],
    };
    for source in scalar.iter().filter(|s| !one_component(s)) {
        let rule = if opcode == Opcode::Dp2Add { RuleId::Dp2AddSource } else { RuleId::ScalarSource };
        let message = format!("`{name}` reads several components of `{}`", source.register);
        context.breach(rule, source.span, message).help("choose one: .x, .y, .z or .w");
    }
}

/// V43, [`RuleId::SinCosOperands`].
fn sincos(context: &mut Context<'_>, instruction: &Instruction) {
    if let Some(destination) = instruction.destination
        && !matches!(destination.mask.0, 0b0001..=0b0011)
    {
        context.breach(
            RuleId::SinCosOperands,
            destination.span,
            "`sincos` writes components other than .x (cos) and .y (sin)",
        );
    }
    let [angle, first, second] = instruction.sources.as_slice() else { return };
    if !one_component(angle) {
        context.breach(RuleId::SinCosOperands, angle.span, "`sincos` reads several components of its angle");
    }
    if first.register == second.register {
        context.breach(RuleId::SinCosOperands, second.span, "both constants of `sincos` are in the same register");
    }
    let plain = |s: &Source| s.swizzle == Swizzle::IDENTITY && s.modifier == Modifier::None;
    for source in [first, second].into_iter().filter(|s| !plain(s)) {
        context.breach(RuleId::SinCosOperands, source.span, "a constant of `sincos` is swizzled or negated");
    }
}

/// V50, [`RuleId::MatrixRows`].
fn matrix(context: &mut Context<'_>, instruction: &Instruction) {
    let (Some(rows), Some(source)) = (matrix_rows(instruction.opcode), instruction.sources.get(1)) else { return };
    let name = instruction.opcode.info().mnemonic;
    let register = source.register;
    let last = u32::from(register.index) + u32::from(rows) - 1;
    let count = context.count(register.file).map_or(0, |c| c.value());
    let prefix = register.file.prefix();
    // A nonexistent first row is reported elsewhere, as a register.
    if u32::from(register.index) < count && last >= count {
        let message =
            format!("the last row of `{name}` is `{prefix}{last}`, the last register is `{prefix}{}`", count - 1);
        context.breach(RuleId::MatrixRows, source.span, message);
    }
    if source.swizzle != Swizzle::IDENTITY || source.modifier != Modifier::None {
        context.breach(RuleId::MatrixRows, source.span, format!("the matrix of `{name}` is swizzled or negated"));
    }
    if !matches!(register.file, RegisterFile::Constant | RegisterFile::Temp) {
        context.breach(
            RuleId::MatrixRows,
            source.span,
            format!("the matrix of `{name}` is in `{prefix}#`, expected c# or r#"),
        );
    }
}

/// V59, [`RuleId::MacroOperands`].
fn steps(context: &mut Context<'_>, instruction: &Instruction) {
    let opcode = instruction.opcode;
    let Some(destination) = instruction.destination else { return };
    let rows = matrix_rows(opcode);
    let several = rows.is_some() || matches!(opcode, Opcode::Crs | Opcode::Nrm | Opcode::SinCos | Opcode::Sgn);
    if !several {
        return;
    }
    let name = opcode.info().mnemonic;
    for (k, source) in instruction.sources.iter().enumerate() {
        let count = if k == 1 { rows.unwrap_or(1) } else { 1 };
        let first = source.register.index;
        let hit = source.register.file == destination.register.file
            && source.register.relative.is_none()
            && (first..first.saturating_add(count)).contains(&destination.register.index);
        if hit {
            let message = format!("`{name}` writes `{}`, which it still reads", destination.register);
            context.breach(RuleId::MacroOperands, source.span, message).help("write another register");
        }
    }
    if let (Opcode::Sgn, [_, a, b]) = (opcode, instruction.sources.as_slice())
        && a.register == b.register
    {
        context.breach(RuleId::MacroOperands, b.span, "`sgn` has the same scratch register twice");
    }
    let mask = destination.mask;
    let (fits, expected) = match (opcode, rows) {
        (Opcode::Crs, _) => (mask.0 & 0b1000 == 0, "components of .xyz"),
        (Opcode::Nrm, _) => (matches!(mask, Mask::RGB | Mask::ALL), ".xyz or .xyzw"),
        (_, Some(rows)) => (mask.0 == (1 << rows) - 1, "one component for each row"),
        _ => (true, ""),
    };
    if !fits && mask.0 != 0 {
        context.breach(RuleId::MacroOperands, destination.span, format!("the mask of `{name}` is not {expected}"));
    }
}

/// V36, [`RuleId::OutputWrite`].
fn outputs(context: &mut Context<'_>) {
    let mut written: [Option<Span>; 4] = [None; 4];
    let mut depth: Option<Span> = None;
    for (_, instruction) in context.instructions() {
        let Some(destination) = instruction.destination else { continue };
        let register = destination.register;
        let before = match register.file {
            RegisterFile::ColorOut => match written.get_mut(usize::from(register.index)) {
                Some(entry) => entry.replace(instruction.span),
                None => continue,
            },
            RegisterFile::DepthOut => depth.replace(instruction.span),
            _ => continue,
        };
        let mut bad = |what: &str| {
            context.breach(RuleId::OutputWrite, instruction.span, format!("`{register}` {what}"));
        };
        if before.is_some() {
            bad("is written twice");
        }
        if instruction.predicate.is_some() {
            bad("is written under a predicate");
        }
        if destination.mask != Mask::ALL {
            bad("is written in part, expected all components");
        }
        let source = instruction.sources.first();
        if source.is_some_and(|s| s.modifier != Modifier::None) {
            bad("is written through a source modifier");
        }
        if register.file == RegisterFile::DepthOut && source.is_some_and(|s| !one_component(s)) {
            bad("is written from several components, expected one: .x, .y, .z or .w");
        }
    }
    let span = context.program.version_span;
    if written[0].is_none() {
        let violation = context.breach(RuleId::OutputWrite, span, "program does not write `oC0`");
        violation.label("this program").help("end with `mov oC0, r0`");
    } else if let Some(gap) = (1..4).find(|i| written[*i].is_none())
        && let Some(later) = written[gap..].iter().flatten().next()
    {
        context.breach(RuleId::OutputWrite, *later, format!("`oC{gap}` is skipped"));
    }
}

/// V38: a texture read is one level above its coordinates; a computed value has the highest level of its operands.
fn dependent_reads(context: &mut Context<'_>) {
    let Some(allowed) = context.limit(Limit::DependentReads) else { return };
    let mut levels: BTreeMap<u16, u32> = BTreeMap::new();
    let mut deepest: Option<(Span, u32)> = None;
    for (_, instruction) in context.instructions() {
        let read = matches!(instruction.opcode, Opcode::TexLd | Opcode::TexLdB | Opcode::TexLdP | Opcode::TexLdD);
        let of = |s: &Source| match s.register.file {
            RegisterFile::Temp => levels.get(&s.register.index).copied().unwrap_or(1),
            _ => 0,
        };
        let from = if read { instruction.sources.first().map_or(0, of) } else { 0 };
        let level = if read { from + 1 } else { instruction.sources.iter().map(of).max().unwrap_or(0).max(1) };
        if read && level > allowed.value && deepest.is_none_or(|(_, l)| level > l) {
            deepest = Some((deepest.map_or(instruction.span, |(span, _)| span), level));
        }
        let Some(destination) = instruction.destination.filter(|d| d.register.file == RegisterFile::Temp) else {
            continue;
        };
        if instruction.opcode.info().destination == DestinationRule::Write {
            let whole = destination.mask == Mask::ALL && instruction.predicate.is_none();
            let entry = levels.entry(destination.register.index).or_insert(level);
            *entry = if whole { level } else { level.max(*entry) };
        }
    }
    if let Some((span, level)) = deepest {
        let message = format!(
            "texture reads depend on one another over {level} levels, {} allows {}",
            allowed.owner, allowed.value
        );
        let label = "the first read whose chain is too long".to_owned();
        context.breach(RuleId::DependentReads, span, message).label(label).exceeds(
            level,
            &allowed,
            "make fewer reads depend on one another, or use a further pass",
        );
    }
}
