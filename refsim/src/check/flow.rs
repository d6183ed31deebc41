//! V52 to V57: flow control. Fills in [`Context::jump`], which the executors use.

use std::collections::BTreeMap;

use super::RuleId;
use super::allowed::Limit;
use super::context::Context;
use crate::isa::{Instruction, Modifier, Opcode, OpcodeClass, RegisterFile, Relative, Source, Span, Swizzle, Version};

struct OpenBlock {
    opcode: Opcode,
    start: usize,
    /// Instruction whose jump target is not yet known: the block's opening instruction, or `else`.
    patch: usize,
    breaks: Vec<usize>,
    /// `true` if a computed value decides which fragments execute the block.
    dynamic: bool,
    has_else: bool,
}

impl OpenBlock {
    fn is_loop(&self) -> bool {
        matches!(self.opcode, Opcode::Rep | Opcode::Loop)
    }
}

/// A call instruction, recorded for the rules on subroutines.
struct Call {
    at: usize,
    label: u16,
    /// The subroutine that contains the call, by label; `None`: the main program.
    within: Option<u16>,
    dynamic: bool,
}

struct Walk {
    blocks: Vec<OpenBlock>,
    labels: BTreeMap<u16, usize>,
    calls: Vec<Call>,
    /// Label of the current subroutine.
    section: Option<u16>,
    /// `true` after the section's `ret`.
    ended: bool,
    /// Gradient instructions: index, subroutine, and `true` if fragments may have diverged within the section.
    gradients: Vec<(usize, Option<u16>, bool)>,
}

pub(super) fn check(context: &mut Context<'_>) {
    predicates(context);
    let mut walk = Walk {
        blocks: Vec::new(),
        labels: BTreeMap::new(),
        calls: Vec::new(),
        section: None,
        ended: false,
        gradients: Vec::new(),
    };
    for (index, instruction) in context.instructions() {
        if walk.ended && instruction.opcode != Opcode::Label {
            context.breach(RuleId::Subroutines, instruction.span, "an instruction follows `ret` and is never reached");
            walk.ended = false;
        }
        if instruction.opcode.info().class == OpcodeClass::Flow {
            operands(context, instruction);
            step(context, &mut walk, index, instruction);
        } else {
            inside(context, &mut walk, index, instruction);
        }
    }
    close(context, &mut walk);
    subroutines(context, &walk);
    static_count(context);
}

/// Returns `true` for `b#`, `p0.x` and `!p0.x` (other operands violate V55).
fn is_condition(source: &Source, version: Version) -> bool {
    let plain = matches!(source.modifier, Modifier::None | Modifier::Not);
    match source.register.file {
        RegisterFile::ConstantBool => plain && source.swizzle == Swizzle::IDENTITY,
        RegisterFile::Predicate => plain && version == Version::Ps2A && source.swizzle.replicated().is_some(),
        _ => false,
    }
}

/// V55: operands of flow control. V07 for labels and other registers is checked with the operands.
fn operands(context: &mut Context<'_>, instruction: &Instruction) {
    use RegisterFile as F;
    let version = context.version;
    let name = instruction.opcode.info().mnemonic;
    let file = |s: &Source, f: F| s.register.file == f && s.modifier == Modifier::None;
    for (k, source) in instruction.sources.iter().enumerate() {
        let numeric = matches!(source.register.file, F::Temp | F::Input | F::Texture | F::Constant);
        let (fits, expected) = match (instruction.opcode, k) {
            (Opcode::If, 0) | (Opcode::CallNz, 1) => (is_condition(source, version), "b# or, in ps_2_a, p0.x"),
            (Opcode::BreakP, 0) => {
                (is_condition(source, version) && source.register.file == F::Predicate, "one component of p0")
            }
            (Opcode::IfC | Opcode::BreakC, _) => {
                (numeric && source.swizzle.replicated().is_some(), "one component of a register")
            }
            (Opcode::Rep, 0) | (Opcode::Loop, 1) => (file(source, F::ConstantInt), "i#"),
            (Opcode::Loop, 0) => (file(source, F::Loop), "aL"),
            (Opcode::Call | Opcode::CallNz | Opcode::Label, 0) => (file(source, F::Label), "l#"),
            _ => (true, ""),
        };
        if !fits {
            let message = format!("the operand of `{name}` is `{}`, expected {expected}", source.register);
            context.breach(RuleId::FlowOperands, source.span, message).label("this operand");
        }
    }
    if instruction.coissue && version.is_ps_1_x() {
        context.breach(RuleId::MalformedPair, instruction.span, format!("`{name}` is co-issued"));
    }
}

fn by_predicate(source: Option<&Source>) -> bool {
    source.is_some_and(|s| s.register.file == RegisterFile::Predicate)
}

fn step(context: &mut Context<'_>, walk: &mut Walk, index: usize, instruction: &Instruction) {
    match instruction.opcode {
        Opcode::If | Opcode::IfC | Opcode::Rep | Opcode::Loop => open(context, walk, index, instruction),
        Opcode::Else => match walk.blocks.last_mut() {
            Some(block) if !block.is_loop() && !block.has_else => {
                context.jump[block.patch] = Some(index);
                block.patch = index;
                block.has_else = true;
            }
            _ => {
                context.breach(RuleId::UnclosedBlock, instruction.span, "`else` without an open `if`");
            }
        },
        Opcode::EndIf => end(context, walk, index, instruction, &[Opcode::If, Opcode::IfC]),
        Opcode::EndRep => end(context, walk, index, instruction, &[Opcode::Rep]),
        Opcode::EndLoop => end(context, walk, index, instruction, &[Opcode::Loop]),
        Opcode::Break | Opcode::BreakC | Opcode::BreakP => {
            let computed = instruction.opcode != Opcode::Break;
            let inside = walk.blocks.iter().rposition(|b| b.is_loop());
            let Some(at) = inside else {
                context.breach(RuleId::FlowOperands, instruction.span, "a break is outside of any loop");
                return;
            };
            let within_dynamic = walk.blocks[at..].iter().any(|b| b.dynamic);
            walk.blocks[at].breaks.push(index);
            if computed || within_dynamic {
                // From here on fragments may have diverged.
                walk.blocks[at].dynamic = true;
                dynamic_depth(context, walk, instruction, u32::from(computed));
            }
        }
        Opcode::Call | Opcode::CallNz => {
            let Some(label) = instruction.sources.first() else { return };
            let dynamic = walk.blocks.iter().any(|b| b.dynamic) || by_predicate(instruction.sources.get(1));
            walk.calls.push(Call { at: index, label: label.register.index, within: walk.section, dynamic });
        }
        Opcode::Label => label(context, walk, index, instruction),
        Opcode::Ret => {
            if walk.blocks.is_empty() {
                walk.ended = true;
            } else {
                context.breach(RuleId::Subroutines, instruction.span, "`ret` is inside a block");
            }
        }
        _ => {}
    }
}

fn open(context: &mut Context<'_>, walk: &mut Walk, index: usize, instruction: &Instruction) {
    let opcode = instruction.opcode;
    let dynamic = opcode == Opcode::IfC || opcode == Opcode::If && by_predicate(instruction.sources.first());
    walk.blocks.push(OpenBlock { opcode, start: index, patch: index, breaks: Vec::new(), dynamic, has_else: false });
    let of = |f: &dyn Fn(&OpenBlock) -> bool| walk.blocks.iter().filter(|b| f(b)).count() as u32;
    let (limit, found, what) = if matches!(opcode, Opcode::Rep | Opcode::Loop) {
        (Limit::LoopDepth, of(&OpenBlock::is_loop), "loops are")
    } else if dynamic {
        dynamic_depth(context, walk, instruction, 0);
        return;
    } else {
        (Limit::StaticFlowDepth, of(&|b| b.opcode == Opcode::If && !b.dynamic), "`if b#` is")
    };
    depth(context, limit, found, what, instruction.span);
}

fn dynamic_depth(context: &mut Context<'_>, walk: &Walk, instruction: &Instruction, more: u32) {
    let found = walk.blocks.iter().filter(|b| b.dynamic && !b.is_loop()).count() as u32 + more;
    depth(context, Limit::DynamicFlowDepth, found, "data-dependent flow control is", instruction.span);
}

/// V53, [`RuleId::NestingDepth`].
fn depth(context: &mut Context<'_>, limit: Limit, found: u32, what: &str, span: Span) {
    let Some(allowed) = context.limit(limit) else { return };
    // Reported only at the first level that is too deep.
    if found == allowed.value + 1 {
        let message = format!("{what} nested {found} deep, {} allows {}", allowed.owner, allowed.value);
        let advice = "unroll loops, or select values with cmp";
        context.breach(RuleId::NestingDepth, span, message).label("this level").exceeds(found, &allowed, advice);
    }
}

fn end(context: &mut Context<'_>, walk: &mut Walk, index: usize, instruction: &Instruction, opened_by: &[Opcode]) {
    let name = instruction.opcode.info().mnemonic;
    let Some(block) = walk.blocks.pop_if(|b| opened_by.contains(&b.opcode)) else {
        let opener = opened_by[0].info().mnemonic;
        let message = match walk.blocks.last() {
            Some(block) => format!("`{name}` closes `{}`, expected `{opener}`", block.opcode.info().mnemonic),
            None => format!("`{name}` without an open `{opener}`"),
        };
        context.breach(RuleId::UnclosedBlock, instruction.span, message);
        return;
    };
    context.jump[block.patch] = Some(index);
    if block.is_loop() {
        context.jump[index] = Some(block.start);
    }
    for at in block.breaks {
        context.jump[at] = Some(index);
    }
}

fn label(context: &mut Context<'_>, walk: &mut Walk, index: usize, instruction: &Instruction) {
    if !walk.ended {
        context
            .breach(RuleId::Subroutines, instruction.span, "`label` follows a section that does not end with `ret`")
            .help("end the main program and every subroutine with ret");
    }
    close(context, walk);
    let number = instruction.sources.first().map_or(0, |s| s.register.index);
    if walk.labels.insert(number, index).is_some() {
        context.breach(RuleId::Subroutines, instruction.span, format!("`l{number}` labels two subroutines"));
    }
    walk.section = Some(number);
    walk.ended = false;
}

/// Reports blocks that are still open at the end of a section, and a subroutine without `ret`.
fn close(context: &mut Context<'_>, walk: &mut Walk) {
    for block in walk.blocks.drain(..) {
        let span = context.program.instructions[block.start].span;
        let name = block.opcode.info().mnemonic;
        context.breach(RuleId::UnclosedBlock, span, format!("`{name}` is never closed")).label("opened here");
    }
}

/// Checks an instruction that is not flow control: addressing through aL, and gradients.
fn inside(context: &mut Context<'_>, walk: &mut Walk, index: usize, instruction: &Instruction) {
    let in_loop = walk.section.is_some() || walk.blocks.iter().any(|b| b.opcode == Opcode::Loop);
    for source in &instruction.sources {
        if source.register.relative == Some(Relative::Loop) && !in_loop && context.version == Version::Vs2_0 {
            context.breach(RuleId::UnsetAddress, source.span, "`aL` is used in an address outside of any loop");
        }
    }
    let computed = instruction.sources.first().is_some_and(|s| s.register.file == RegisterFile::Temp);
    let gradient = match instruction.opcode {
        Opcode::Dsx | Opcode::Dsy => true,
        Opcode::TexLd | Opcode::TexLdB | Opcode::TexLdP => context.version.is_ps_2() && computed,
        _ => false,
    };
    if gradient {
        let diverged = walk.blocks.iter().any(|b| b.dynamic);
        walk.gradients.push((index, walk.section, diverged));
    }
}

/// V54: labels of calls. V53: depth of calls. V56: gradients in called subroutines.
fn subroutines(context: &mut Context<'_>, walk: &Walk) {
    let program = context.program;
    let span = |at: usize| program.instructions[at].span;
    if walk.section.is_some() && !walk.ended {
        let at = walk.section.and_then(|s| walk.labels.get(&s)).copied().unwrap_or(0);
        context.breach(RuleId::Subroutines, span(at), "the last subroutine does not end with `ret`");
    }
    // Callers precede callees, so one pass in the order of the text visits every caller first.
    let mut depths: BTreeMap<u16, u32> = BTreeMap::new();
    let mut diverged: BTreeMap<u16, bool> = BTreeMap::new();
    for call in &walk.calls {
        let Some(&target) = walk.labels.get(&call.label) else {
            context.breach(RuleId::Subroutines, span(call.at), format!("`l{}` labels no subroutine", call.label));
            continue;
        };
        if target < call.at {
            context
                .breach(
                    RuleId::Subroutines,
                    span(call.at),
                    format!("subroutine `l{}` comes before its call", call.label),
                )
                .help("a subroutine can only call later subroutines, so that none can call itself");
            continue;
        }
        context.jump[call.at] = Some(target);
        let outer = call.within.map_or(0, |w| depths.get(&w).copied().unwrap_or(0));
        let entry = depths.entry(call.label).or_insert(0);
        *entry = (*entry).max(outer + 1);
        let found = *entry;
        depth(context, Limit::CallDepth, found, "calls are", span(call.at));
        let diverges = call.dynamic || call.within.is_some_and(|w| diverged.get(&w).copied().unwrap_or(false));
        *diverged.entry(call.label).or_insert(false) |= diverges;
    }
    for &(at, section, within) in &walk.gradients {
        if within || section.is_some_and(|s| diverged.get(&s).copied().unwrap_or(false)) {
            let name = program.instructions[at].opcode.info().mnemonic;
            context
                .breach(
                    RuleId::DivergentGradient,
                    span(at),
                    format!("`{name}` needs a gradient where fragments may have diverged"),
                )
                .help("move it out of data-dependent flow control, or read with texldd");
        }
    }
}

/// V53 for vs_2_0: total static flow instructions.
fn static_count(context: &mut Context<'_>) {
    let Some(allowed) = context.limit(Limit::StaticFlowCount) else { return };
    let counted =
        |o: Opcode| matches!(o, Opcode::If | Opcode::Else | Opcode::Rep | Opcode::Loop | Opcode::Call | Opcode::CallNz);
    let spans: Vec<Span> = context.instructions().filter(|(_, i)| counted(i.opcode)).map(|(_, i)| i.span).collect();
    if let Some(span) = spans.get(allowed.value as usize) {
        let found = spans.len() as u32;
        let message =
            format!("program has {found} flow control instructions, {} allows {}", allowed.owner, allowed.value);
        context.breach(RuleId::NestingDepth, *span, message).label("one too many").exceeds(
            found,
            &allowed,
            "unroll loops, or select values with cmp",
        );
    }
}

/// V57: instructions that may be predicated. `dataflow` checks that the predicate is set.
fn predicates(context: &mut Context<'_>) {
    for (_, instruction) in context.instructions() {
        let Some(predicate) = instruction.predicate else { continue };
        let class = instruction.opcode.info().class;
        let problem = if context.version != Version::Ps2A {
            Some(format!("{} has no predicates", context.version))
        } else if matches!(class, OpcodeClass::Flow | OpcodeClass::Marker) || instruction.opcode == Opcode::Setp {
            Some(format!("`{}` cannot have a predicate", instruction.opcode.info().mnemonic))
        } else if predicate.swizzle != Swizzle::IDENTITY && predicate.swizzle.replicated().is_none() {
            Some("the predicate is swizzled, expected p0 or one component of it".to_owned())
        } else {
            None
        };
        if let Some(problem) = problem {
            context.breach(RuleId::PredicateUse, predicate.span, problem);
        }
        if predicate.swizzle.0.iter().any(|c| *c > 3) {
            context.breach(RuleId::InvalidSwizzle, predicate.span, "a predicate selects a component beyond the fourth");
        }
    }
}
