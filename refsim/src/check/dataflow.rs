//! V11, V12, V48, V49, V57: reads of unwritten registers.
//!
//! Straight-line code is analysed exactly. Where paths join, a component counts as written if any path writes it. On
//! entry to a loop, all components that the loop writes count as written; on entry to a subroutine, all that the
//! program writes. So no legal program is rejected.

use std::collections::BTreeMap;

use super::RuleId;
use super::context::{Context, is_arithmetic, is_texture};
use super::reads::{destination_reads, matrix_rows, source_lanes};
use crate::isa::{
    DestinationRule, Instruction, Mask, Modifier, Opcode, RegisterFile, Relative, Source, Span, Stage, Swizzle, Version,
};

#[derive(Default)]
struct Written(BTreeMap<(RegisterFile, u16), u8>);

impl Written {
    fn get(&self, file: RegisterFile, index: u16) -> u8 {
        self.0.get(&(file, index)).copied().unwrap_or(0)
    }

    fn add(&mut self, file: RegisterFile, index: u16, mask: u8) {
        *self.0.entry((file, index)).or_insert(0) |= mask & 0b1111;
    }
}

pub(super) fn check(context: &mut Context<'_>) {
    let mut written = Written::default();
    let sound: Vec<bool> = context.sound.to_vec();
    // V03 reports instructions that the version lacks; here they still count as writing their destination.
    let all: Vec<(usize, &Instruction)> = context.program.instructions.iter().enumerate().collect();
    let mut at = 0;
    let mut loop_end = 0;
    let mut subroutines = false;
    while at < all.len() {
        let (index, instruction) = all[at];
        if !sound[index] {
            write(&mut written, context.version, instruction);
            at += 1;
            continue;
        }
        match instruction.opcode {
            Opcode::Phase if context.phase_marker() == Some(index) => clear_alpha(&mut written),
            // Only for an outermost loop, which contains the inner loops.
            Opcode::Rep | Opcode::Loop if index >= loop_end => {
                loop_end = context.jump[index].unwrap_or(index);
                for (_, i) in all.iter().filter(|(i, _)| (index..loop_end).contains(i)) {
                    write(&mut written, context.version, i);
                }
            }
            Opcode::Call | Opcode::CallNz | Opcode::Label if !subroutines => {
                subroutines = true;
                for (_, i) in &all {
                    write(&mut written, context.version, i);
                }
            }
            _ => {}
        }
        // Both halves of a pair read before either writes.
        let pair = all.get(at + 1).filter(|(i, next)| sound[*i] && next.coissue);
        let group = [Some(instruction), pair.map(|(_, next)| *next)];
        for instruction in group.into_iter().flatten() {
            read(context, &mut written, instruction);
        }
        for instruction in group.into_iter().flatten() {
            write(&mut written, context.version, instruction);
        }
        at += if pair.is_some() { 2 } else { 1 };
    }
    results(context, &written);
}

fn clear_alpha(written: &mut Written) {
    for ((file, _), mask) in &mut written.0 {
        if *file == RegisterFile::Temp {
            *mask &= Mask::RGB.0;
        }
    }
}

fn write(written: &mut Written, version: Version, instruction: &Instruction) {
    let Some(destination) = instruction.destination else { return };
    if instruction.opcode.info().destination != DestinationRule::Write || instruction.opcode == Opcode::TexDepth {
        return;
    }
    let register = destination.register;
    let whole = version.is_ps_1_x() && is_texture(instruction.opcode) && instruction.opcode != Opcode::TexCrd;
    let mask = if whole { Mask::ALL } else { destination.mask };
    let mut mask = mask.0;
    if instruction.opcode == Opcode::TexCrd {
        // texcrd leaves the fourth component (and the third with _dw) undefined; from a register it copies only
        // components that were written.
        let source = instruction.sources.first().filter(|s| s.register.file == RegisterFile::Temp);
        if let Some(source) = source {
            let there = written.get(source.register.file, source.register.index);
            let passed = |c: &usize| there >> (source.swizzle.0[*c] & 3) & 1 == 1;
            mask = Mask(mask).components().filter(passed).fold(0, |m, c| m | 1 << c);
        }
        written.0.remove(&(register.file, register.index));
    }
    written.add(register.file, register.index, mask);
}

/// Returns `true` if reads of this file need an earlier write.
fn needs_write(version: Version, file: RegisterFile) -> bool {
    match file {
        RegisterFile::Temp | RegisterFile::Address | RegisterFile::Predicate => true,
        RegisterFile::Texture => version.is_ps_1_1_to_1_3(),
        _ => false,
    }
}

fn read(context: &mut Context<'_>, written: &mut Written, instruction: &Instruction) {
    let version = context.version;
    let sampler = context.sampled_usage(instruction);
    for (k, source) in instruction.sources.iter().enumerate() {
        if let Some(Relative::Address(component)) = source.register.relative {
            let mask = 1 << (component & 3);
            need(context, written, RegisterFile::Address, 0, mask, source.span, RuleId::UnsetAddress);
        }
        let (file, first) = (source.register.file, source.register.index);
        if !needs_write(version, file) {
            continue;
        }
        // V22 covers the address of texld in ps_1_4; texcrd copies the written components, at least one.
        let passes = instruction.opcode == Opcode::TexCrd && written.get(file, first) & Mask::RGB.0 != 0;
        if version == Version::Ps1_4 && (instruction.opcode == Opcode::TexLd || passes) {
            continue;
        }
        let rule = if file == RegisterFile::Predicate { RuleId::PredicateUse } else { RuleId::UnwrittenRead };
        let lanes = source_lanes(version, instruction, k, sampler);
        let components = through(source, lanes);
        let rows = if k == 1 { matrix_rows(instruction.opcode).unwrap_or(1) } else { 1 };
        for row in 0..rows {
            need(context, written, file, first.saturating_add(row), components, source.span, rule);
        }
    }
    if let Some(destination) = instruction.destination {
        let register = destination.register;
        let mask = destination_reads(instruction.opcode);
        // In ps_1_1 to 1_3 texkill tests the coordinates, not the register's contents.
        if mask.0 != 0 && register.file == RegisterFile::Temp {
            need(context, written, register.file, register.index, mask.0, destination.span, RuleId::UnwrittenRead);
        }
    }
    if let Some(predicate) = instruction.predicate {
        let lanes = instruction.destination.map_or(Mask::ALL, |d| d.mask);
        let components = swizzled(predicate.swizzle, lanes);
        need(context, written, RegisterFile::Predicate, 0, components, predicate.span, RuleId::PredicateUse);
    }
}

fn swizzled(swizzle: Swizzle, lanes: Mask) -> u8 {
    lanes.components().fold(0, |mask, lane| mask | 1 << (swizzle.0[lane] & 3))
}

/// Components that the lanes read; _dz and _dw also read their divisor.
fn through(source: &Source, lanes: Mask) -> u8 {
    let divisor = match source.modifier {
        Modifier::Dz => 0b0100,
        Modifier::Dw => 0b1000,
        _ => 0,
    };
    swizzled(source.swizzle, lanes) | divisor
}

fn letters(mask: u8) -> String {
    let all = Mask(mask).components().map(|c| ['x', 'y', 'z', 'w'][c]);
    all.collect()
}

fn need(
    context: &mut Context<'_>,
    written: &mut Written,
    file: RegisterFile,
    index: u16,
    components: u8,
    span: Span,
    rule: RuleId,
) {
    let missing = components & !written.get(file, index) & 0b1111;
    if missing == 0 {
        return;
    }
    // Marks them as written, so that later reads don't repeat the report.
    written.add(file, index, missing);
    let exists = context.count(file).is_some_and(|c| u32::from(index) < c.value());
    if !exists {
        return;
    }
    let (prefix, letters) = (file.prefix(), letters(missing));
    let message = format!("`{prefix}{index}.{letters}` is read but was not written");
    let help = match (context.version, missing) {
        (Version::Ps1_4, 0b1000) if file == RegisterFile::Temp && context.phase_marker().is_some() => {
            "`phase` leaves every alpha component undefined, and texcrd does not write alpha: write alpha in phase 2 first"
        }
        _ => "write every component before it is read",
    };
    context.breach(rule, span, message).label("read here").help(help);
}

/// V12 and V48: registers that must be written by the end of the program.
fn results(context: &mut Context<'_>, written: &Written) {
    let (rule, file, name) = match context.version {
        v if v.is_ps_1_x() => (RuleId::UnwrittenResult, RegisterFile::Temp, "r0"),
        v if v.stage() == Stage::Vertex => (RuleId::UnwrittenPosition, RegisterFile::PositionOut, "oPos"),
        _ => return,
    };
    let missing = 0b1111 & !written.get(file, 0);
    if missing == 0 {
        return;
    }
    let last = context.program.instructions.iter().rev().find(|i| is_arithmetic(i.opcode) || is_texture(i.opcode));
    let span = last.map_or(context.program.version_span, |i| i.span);
    let message = format!("program ends without writing `{name}.{}`", letters(missing));
    context
        .breach(rule, span, message)
        .label("the end of the program")
        .help(format!("write all components of {name}: they are the result"));
}
