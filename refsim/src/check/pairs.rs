//! V08, V09, V10: read ports and co-issue.

use std::collections::BTreeSet;

use super::RuleId;
use super::context::{Context, is_arithmetic, is_numeric};
use crate::isa::{Instruction, Mask, Opcode, Register, RegisterFile, Relative, Source, Version};

pub(super) fn check(context: &mut Context<'_>) {
    for (index, instruction) in context.instructions() {
        if context.version_limits() {
            ports(context, instruction);
        }
        if instruction.coissue {
            pair(context, index, instruction);
        }
    }
    // Operand checks report malformed co-issued instructions; the `+` is checked anyway.
    for (index, instruction) in context.program.instructions.iter().enumerate() {
        if instruction.coissue && !context.is_sound(index) && !context.version.is_ps_1_x() {
            context.breach(RuleId::MalformedPair, instruction.span, format!("{} has no co-issue", context.version));
        }
    }
}

/// Number of different registers of a file that one instruction can read.
fn read_ports(version: Version, file: RegisterFile) -> Option<u32> {
    use RegisterFile as F;
    Some(match (version, file) {
        (Version::Ps1_1, F::Texture | F::Temp) => 2,
        (Version::Ps1_2 | Version::Ps1_3, F::Texture) => 3,
        (Version::Ps1_2 | Version::Ps1_3, F::Temp) => 2,
        (Version::Ps1_4, F::Texture) => 1,
        (Version::Ps1_4, F::Temp) => 3,
        (v, F::Constant | F::Input) if v.is_ps_1_x() => 2,
        (v, F::Input | F::Texture) if v.is_ps_2() => 1,
        (v, F::Temp) if v.is_ps_2() => 3,
        (Version::Vs1_1 | Version::Vs2_0, F::Constant | F::Input) => 1,
        _ => return None,
    })
}

fn key(register: Register) -> (RegisterFile, u16, Option<u8>) {
    let relative = register.relative.map(|r| match r {
        Relative::Address(component) => component,
        Relative::Loop => u8::MAX,
    });
    (register.file, register.index, relative)
}

fn different<'a>(sources: impl Iterator<Item = &'a Source>, file: RegisterFile) -> u32 {
    let set: BTreeSet<_> = sources.filter(|s| s.register.file == file).map(|s| key(s.register)).collect();
    set.len() as u32
}

const FILES: [RegisterFile; 4] =
    [RegisterFile::Temp, RegisterFile::Input, RegisterFile::Texture, RegisterFile::Constant];

fn ports(context: &mut Context<'_>, instruction: &Instruction) {
    // sincos of ps_2_0 and vs_2_0 reads two constants by definition.
    if instruction.opcode == Opcode::SinCos {
        return;
    }
    for file in FILES {
        let Some(ports) = read_ports(context.version, file) else { continue };
        let found = different(instruction.sources.iter(), file);
        if found > ports {
            let (version, prefix) = (context.version, file.prefix());
            let message =
                format!("instruction reads {found} different `{prefix}#` registers, {version} allows {ports}");
            let violation = context.breach(RuleId::TooManyReads, instruction.span, message).figure(ports, found);
            violation.help("first copy one of them into another register file with mov");
        }
    }
}

/// V09 and V10 for the pair whose second instruction is at `index`.
fn pair(context: &mut Context<'_>, index: usize, second: &Instruction) {
    let version = context.version;
    if !version.is_ps_1_x() {
        context.breach(RuleId::MalformedPair, second.span, format!("{version} has no co-issue"));
        return;
    }
    let bad = |context: &mut Context<'_>, message: &str, help: &str| {
        context.breach(RuleId::MalformedPair, second.span, message).label("the second of the pair").help(help);
    };
    let Some(first) = index.checked_sub(1).map(|i| &context.program.instructions[i]) else {
        bad(context, "the first instruction of the program has a `+`", "the first instruction of a pair has no `+`");
        return;
    };
    if first.coissue {
        bad(context, "three instructions are co-issued", "a pair has two instructions");
        return;
    }
    if !context.is_sound(index - 1) {
        return;
    }
    for one in [first, second] {
        let name = one.opcode.info().mnemonic;
        if one.opcode == Opcode::Bem {
            context.breach(RuleId::Bem, one.span, "`bem` is co-issued");
            return;
        }
        if !is_arithmetic(one.opcode) || one.opcode == Opcode::Dp4 {
            bad(context, &format!("`{name}` is co-issued"), "only arithmetic other than dp4 and bem can pair up");
            return;
        }
    }
    let mask = |i: &Instruction| i.destination.map_or(Mask(0), |d| d.mask);
    let (a, b) = (mask(first), mask(second));
    let color = |m: Mask| m.0 != 0 && m.0 & !Mask::RGB.0 == 0;
    let alpha = if color(a) && b == Mask::ALPHA {
        second
    } else if color(b) && a == Mask::ALPHA {
        first
    } else {
        bad(context, "the pair does not write .rgb and .a", "one instruction writes within .rgb, the other .a alone");
        return;
    };
    if alpha.opcode == Opcode::Dp3 {
        bad(context, "the alpha half of the pair is dp3", "dp3 runs in the colour pipe: let it write .rgb");
    }
    pair_ports(context, first, second);
}

/// V09, [`RuleId::TooManyPairReads`].
fn pair_ports(context: &mut Context<'_>, first: &Instruction, second: &Instruction) {
    if !context.version_limits() {
        return;
    }
    for file in FILES {
        debug_assert!(is_numeric(file));
        let found = different(first.sources.iter().chain(&second.sources), file);
        if found > 3 {
            let prefix = file.prefix();
            let message = format!("pair reads {found} different `{prefix}#` registers, {} allows 3", context.version);
            let violation = context.breach(RuleId::TooManyPairReads, first.span.join(second.span), message);
            violation.figure(3, found).help("issue the two one after the other, or share a register");
        }
    }
}
