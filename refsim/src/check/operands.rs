//! V07, V13 to V17, V34, V35, V45, V47: operand rules that apply to every instruction.

use super::RuleId;
use super::context::{Context, Count, is_arithmetic, is_numeric, is_texture};
use crate::isa::{
    Destination, DestinationRule, Instruction, Mask, Modifier, Opcode, Register, RegisterFile, Relative, Source, Span,
    Stage, Swizzle, Version,
};

pub(super) fn check(context: &mut Context<'_>) {
    for (index, instruction) in context.instructions() {
        if let Some(destination) = &instruction.destination {
            if number_in_range(context, destination.register, destination.span) {
                destination_file(context, instruction, destination);
            }
            mask(context, instruction, destination);
            result_modifiers(context, instruction, destination);
        }
        for (k, source) in instruction.sources.iter().enumerate() {
            if number_in_range(context, source.register, source.span) {
                source_file(context, index, instruction, k);
            }
            relative(context, source);
            if is_numeric(source.register.file) {
                swizzle(context, instruction, source);
                source_modifier(context, instruction, source);
            } else if source.swizzle != Swizzle::IDENTITY && source.register.file != RegisterFile::Predicate {
                let file = source.register.file.prefix();
                context.breach(
                    RuleId::InvalidSwizzle,
                    source.span,
                    format!("a `{file}` register cannot have a swizzle"),
                );
            }
        }
    }
}

/// V07. Returns `true` if the register exists.
pub(super) fn number_in_range(context: &mut Context<'_>, register: Register, span: Span) -> bool {
    let (file, index, version) = (register.file, u32::from(register.index), context.version);
    let prefix = file.prefix();
    let Some(count) = context.count(file) else {
        let name = if file.is_unnumbered() { prefix.to_owned() } else { format!("{prefix}#") };
        context.breach(RuleId::NoSuchRegister, span, format!("{version} has no register `{name}`"));
        return false;
    };
    let n = count.value();
    if index < n {
        return true;
    }
    let range = match n {
        0 => "has none".to_owned(),
        1 => format!("has `{prefix}0` only"),
        _ => format!("has `{prefix}0` to `{prefix}{}`", n - 1),
    };
    let found = if register.relative.is_some() { register.to_string() } else { format!("{prefix}{index}") };
    match count {
        Count::Limited(allowed) => {
            let message = format!("program uses `{found}`, {} {range}", allowed.owner);
            context.breach(RuleId::NoSuchRegister, span, message).label("no such register").exceeds(
                index,
                &allowed,
                "reuse a register",
            );
        }
        Count::Fixed(_) => {
            let message = format!("program uses `{found}`, {version} {range}");
            context.breach(RuleId::NoSuchRegister, span, message).label("no such register");
        }
    }
    false
}

/// V45, and the syntax of relative addresses in versions that have them.
fn relative(context: &mut Context<'_>, source: &Source) {
    let Some(relative) = source.register.relative else { return };
    let (version, span) = (context.version, source.span);
    let breach = if version.stage() == Stage::Pixel {
        Some(format!("{version} has no relative addressing"))
    } else if source.register.file != RegisterFile::Constant {
        Some(format!("`{}` is addressed relatively", source.register))
    } else {
        match (relative, version) {
            (Relative::Address(component), _) if component > 3 => Some("a0 has four components".to_owned()),
            (Relative::Address(1..), Version::Vs1_1) => Some("vs_1_1 addresses through a0.x only".to_owned()),
            (Relative::Loop, Version::Vs1_1) => Some("vs_1_1 has no `aL`".to_owned()),
            _ => None,
        }
    };
    if let Some(message) = breach {
        let help = "only constants are addressed relatively, in vs_1_1 by a0.x, in vs_2_0 by a0 or aL";
        context.breach(RuleId::RelativeAddress, span, message).help(help);
    }
}

/// V13, and other rules on the file of a destination.
fn destination_file(context: &mut Context<'_>, instruction: &Instruction, destination: &Destination) {
    use RegisterFile as F;
    let (version, opcode) = (context.version, instruction.opcode);
    let (file, name) = (destination.register.file, opcode.info().mnemonic);
    if destination.register.relative.is_some() {
        context.breach(RuleId::RelativeAddress, destination.span, "a destination is addressed relatively");
    }
    let (rule, allowed, expected): (RuleId, bool, &str) = match version {
        _ if opcode == Opcode::TexKill => match version {
            Version::Ps1_4 => (RuleId::TextureSource, matches!(file, F::Texture | F::Temp), "t# or r#"),
            v if v.is_ps_2() => (RuleId::TexKillOperand, matches!(file, F::Texture | F::Temp), "t# or r#"),
            _ => (RuleId::InvalidDestination, file == F::Texture, "t#"),
        },
        v if v.is_ps_1_1_to_1_3() && is_texture(opcode) => (RuleId::InvalidDestination, file == F::Texture, "t#"),
        v if v.is_ps_1_1_to_1_3() => (RuleId::InvalidDestination, matches!(file, F::Temp | F::Texture), "r# or t#"),
        Version::Ps1_4 => (RuleId::InvalidDestination, file == F::Temp, "r#"),
        _ if opcode == Opcode::Setp => (RuleId::PredicateUse, file == F::Predicate, "p0"),
        _ if opcode == Opcode::Mova => (RuleId::UnsetAddress, file == F::Address, "a0"),
        v if v.is_ps_2() && matches!(file, F::ColorOut | F::DepthOut) => {
            (RuleId::OutputWrite, opcode == Opcode::Mov, "r#")
        }
        v if v.is_ps_2() => (RuleId::InvalidDestination, file == F::Temp, "r#, oC# or oDepth"),
        Version::Vs1_1 if file == F::Address => (RuleId::UnsetAddress, opcode == Opcode::Mov, "mov to write a0"),
        Version::Vs2_0 if file == F::Address => (RuleId::UnsetAddress, false, "mova to write a0"),
        _ if matches!(opcode, Opcode::SinCos | Opcode::Sgn) => (RuleId::InvalidDestination, file == F::Temp, "r#"),
        _ => {
            let output = [F::PositionOut, F::FogOut, F::PointSizeOut, F::DiffuseOut, F::TexCoordOut].contains(&file);
            (RuleId::InvalidDestination, file == F::Temp || output, "r# or an output")
        }
    };
    if !allowed {
        let message = format!("`{name}` writes `{}`, expected {expected}", destination.register);
        context.breach(rule, destination.span, message).label("the destination");
    }
}

/// V14, and the mask rules of V20, V25, V40 and V41.
fn mask(context: &mut Context<'_>, instruction: &Instruction, destination: &Destination) {
    let (version, opcode, mask) = (context.version, instruction.opcode, destination.mask);
    let texture = is_texture(opcode);
    let (rule, allowed, expected): (RuleId, bool, &str) = match version {
        _ if mask.0 == 0 || mask.0 > 0b1111 => (RuleId::InvalidMask, false, "one to four components"),
        v if v.is_ps_2() && opcode == Opcode::TexKill => (RuleId::TexKillOperand, mask == Mask::ALL, "no mask"),
        v if v.is_ps_2() && texture => (RuleId::TextureReadOperands, mask == Mask::ALL, "no mask"),
        Version::Ps1_4 if opcode == Opcode::TexLd => (RuleId::TextureLoadMask, mask == Mask::ALL, "no mask"),
        Version::Ps1_4 if opcode == Opcode::TexCrd => {
            let projected = instruction.sources.first().is_some_and(|s| s.modifier == Modifier::Dw);
            if projected {
                (RuleId::TextureLoadMask, mask == Mask(0b0011), ".rg (with _dw)")
            } else {
                (RuleId::TextureLoadMask, mask == Mask::RGB, ".rgb")
            }
        }
        Version::Ps1_4 if opcode == Opcode::Bem => (RuleId::Bem, mask == Mask(0b0011), ".rg"),
        v if v.is_ps_1_x() && texture => (RuleId::InvalidMask, mask == Mask::ALL, "no mask"),
        v if v.is_ps_1_1_to_1_3() && opcode == Opcode::Dp3 => {
            (RuleId::Dp3Mask, matches!(mask, Mask::RGB | Mask::ALL), ".rgb or .rgba")
        }
        v if v.is_ps_1_1_to_1_3() => {
            (RuleId::InvalidMask, matches!(mask, Mask::RGB | Mask::ALPHA | Mask::ALL), ".rgb, .a or .rgba")
        }
        Version::Vs1_1 if opcode == Opcode::Frc => {
            (RuleId::InvalidMask, matches!(mask.0, 0b0010 | 0b0011), ".y or .xy")
        }
        _ => (RuleId::InvalidMask, true, ""),
    };
    if !allowed {
        let name = opcode.info().mnemonic;
        let message = format!("`{name}` writes {}, expected {expected}", mask_text(mask));
        context.breach(rule, destination.span, message).label("this mask");
    }
}

fn mask_text(mask: Mask) -> String {
    let letters: String = mask.components().map(|c| ['r', 'g', 'b', 'a'][c]).collect();
    if letters.is_empty() { "nothing".to_owned() } else { format!("`.{letters}`") }
}

/// V17, V34, V46, and the modifiers of V36 and V40.
fn result_modifiers(context: &mut Context<'_>, instruction: &Instruction, destination: &Destination) {
    let (version, opcode) = (context.version, instruction.opcode);
    let name = opcode.info().mnemonic;
    let texture = is_texture(opcode) || instruction.opcode.info().destination == DestinationRule::Read;
    let mut add = |rule: RuleId, what: &str| {
        let message = format!("`{name}` has {what}");
        context.breach(rule, instruction.span, message).label("the instruction modifier");
    };
    let shift = destination.shift;
    if shift != 0 {
        if !version.is_ps_1_x() {
            let rule = if version.is_ps_2() { RuleId::ShiftedResult } else { RuleId::InvalidInstructionModifier };
            add(rule, &format!("a shift, but {version} has none"));
        } else if texture {
            add(RuleId::InvalidInstructionModifier, "a shift, but only arithmetic can be shifted");
        } else if !(-3..=3).contains(&shift) || version.is_ps_1_1_to_1_3() && !(-1..=2).contains(&shift) {
            let expected = if version == Version::Ps1_4 { "_x8 to _d8" } else { "_x2, _x4 or _d2" };
            add(
                RuleId::InvalidInstructionModifier,
                &format!("a shift that {version} does not have; its shifts are {expected}"),
            );
        }
    }
    let output = matches!(destination.register.file, RegisterFile::ColorOut | RegisterFile::DepthOut);
    if destination.saturate {
        if matches!(opcode, Opcode::Frc | Opcode::SinCos) && version.is_ps_2() {
            add(RuleId::InvalidSaturate, "_sat, which frc and sincos do not allow");
        } else if output {
            add(RuleId::OutputWrite, "_sat, but outputs have no modifiers");
        } else if texture || version.stage() == Stage::Vertex || !is_arithmetic(opcode) || opcode == Opcode::Setp {
            add(RuleId::InvalidInstructionModifier, "_sat, but only arithmetic of pixel programs can be saturated");
        }
    }
    if destination.partial_precision && !version.is_ps_2() {
        add(RuleId::InvalidInstructionModifier, &format!("_pp, but {version} has no partial precision"));
    }
    if destination.centroid {
        add(RuleId::InvalidInstructionModifier, "_centroid, which belongs on a declaration");
    }
}

/// V28, V29, V31, V40, V43, V47: register files of sources. [`super::flow`] checks the operands of flow control.
fn source_file(context: &mut Context<'_>, index: usize, instruction: &Instruction, k: usize) {
    use RegisterFile as F;
    let (version, opcode) = (context.version, instruction.opcode);
    let source = &instruction.sources[k];
    let file = source.register.file;
    let (rule, allowed, expected): (RuleId, bool, &str) = match (version, opcode) {
        (Version::Ps1_4, op) if is_texture(op) => {
            let second = context.phase(index) == 2;
            let rule =
                if file == F::Temp && op == Opcode::TexLd { RuleId::AddressPhase } else { RuleId::TextureSource };
            let expected = if second { "t# or r#" } else { "t# (in phase 1)" };
            (rule, file == F::Texture || second && file == F::Temp, expected)
        }
        (Version::Ps1_4, _) if file == F::Texture => {
            (RuleId::ArithmeticReadsCoordinates, false, "r#, c# or v#: load it with texcrd")
        }
        (Version::Ps1_4, _) => (RuleId::Operands, is_numeric(file), "r#, c# or v#"),
        (v, op) if v.is_ps_1_1_to_1_3() && is_texture(op) => {
            if k == 1 {
                (RuleId::TextureChain, file == F::Constant, "c# (the eye)")
            } else {
                (RuleId::TextureChain, file == F::Texture, "t#")
            }
        }
        (_, op) if is_texture(op) && k == 1 => (RuleId::TextureReadOperands, file == F::Sampler, "s#"),
        (_, op) if is_texture(op) && k == 0 => {
            (RuleId::TextureReadOperands, matches!(file, F::Temp | F::Texture), "t# or r#")
        }
        (_, Opcode::SinCos) if k > 0 => (RuleId::SinCosOperands, file == F::Constant, "c#"),
        (_, Opcode::Sgn) if k > 0 => (RuleId::MacroOperands, file == F::Temp, "r# (a scratch register)"),
        (_, op) if is_arithmetic(op) || is_texture(op) => (RuleId::Operands, is_numeric(file), "a register of numbers"),
        _ => return,
    };
    if !allowed {
        let name = opcode.info().mnemonic;
        let message = format!("`{name}` reads `{}`, expected {expected}", source.register);
        context.breach(rule, source.span, message).label("this source");
    }
}

/// V15, V40: selectors and swizzles.
fn swizzle(context: &mut Context<'_>, instruction: &Instruction, source: &Source) {
    let (version, opcode, swizzle) = (context.version, instruction.opcode, source.swizzle);
    if swizzle.0.iter().any(|c| *c > 3) {
        context.breach(RuleId::InvalidSwizzle, source.span, "a selector selects a component beyond the fourth");
        return;
    }
    let identity = swizzle == Swizzle::IDENTITY;
    let replicated = swizzle.replicated();
    let alpha_only = instruction.destination.is_some_and(|d| d.mask == Mask::ALPHA);
    let texture = is_texture(opcode);
    let (rule, allowed, expected): (RuleId, bool, &str) = match version {
        // V23 and V24 check the selectors of texld and texcrd.
        Version::Ps1_4 if texture => {
            let xyz = matches!(swizzle.0, [0, 1, 2, 2 | 3]);
            (RuleId::InvalidSwizzle, xyz || swizzle.0 == [0, 1, 3, 3], ".xyz or .xyw")
        }
        Version::Ps1_4 => (RuleId::InvalidSwizzle, identity || replicated.is_some(), ".r .g .b or .a"),
        v if v.is_ps_1_1_to_1_3() && texture => (RuleId::InvalidSwizzle, identity, "no selector"),
        v if v.is_ps_1_1_to_1_3() => {
            let blue = replicated == Some(2) && alpha_only;
            (RuleId::InvalidSwizzle, identity || replicated == Some(3) || blue, ".a, or .b where only .a is written")
        }
        v if v.is_ps_2() && texture => (RuleId::TextureReadOperands, identity || v == Version::Ps2A, "no swizzle"),
        Version::Ps2_0 | Version::Ps2B => {
            let rotated = matches!(swizzle.0, [1, 2, 0, 3] | [2, 0, 1, 3] | [3, 2, 1, 0]);
            (RuleId::InvalidSwizzle, identity || replicated.is_some() || rotated, ".x .y .z .w .yzxw .zxyw or .wzyx")
        }
        _ => (RuleId::InvalidSwizzle, true, ""),
    };
    if !allowed {
        let letters: String = swizzle.0.iter().map(|c| ['x', 'y', 'z', 'w'][usize::from(*c)]).collect();
        let message = format!("`{}` is read as `.{letters}`, {version} allows {expected} here", source.register);
        context.breach(rule, source.span, message).label("this selector");
    }
}

/// V16, V35, V40: source modifiers. On texture reads V24 checks `_dz` and `_dw` (ps_1_4), and V33 checks `_bx2` (ps_1_1
/// to 1_3).
fn source_modifier(context: &mut Context<'_>, instruction: &Instruction, source: &Source) {
    use Modifier as M;
    let (version, modifier) = (context.version, source.modifier);
    let texture = is_texture(instruction.opcode);
    let simple = matches!(modifier, M::None | M::Negate);
    let (rule, allowed, expected): (RuleId, bool, &str) = match version {
        Version::Ps1_4 if texture => (
            RuleId::InvalidSourceModifier,
            matches!(modifier, M::None | M::Dz | M::Dw),
            "only _dz and _dw on texture instructions",
        ),
        v if v.is_ps_1_1_to_1_3() && texture => {
            (RuleId::InvalidSourceModifier, matches!(modifier, M::None | M::Bx2), "only _bx2 on texture instructions")
        }
        Version::Ps1_4 if source.register.file == RegisterFile::Constant => {
            (RuleId::InvalidSourceModifier, modifier == M::None, "no modifier on constants")
        }
        v if v.is_ps_1_x() => {
            let expands = matches!(modifier, M::Invert | M::Bias | M::BiasNegate | M::Bx2 | M::Bx2Negate);
            let doubles = matches!(modifier, M::X2 | M::X2Negate) && v == Version::Ps1_4;
            let all = if v == Version::Ps1_4 { "-, 1-, _bias, _bx2 and _x2" } else { "-, 1-, _bias and _bx2" };
            (RuleId::InvalidSourceModifier, simple || expands || doubles, all)
        }
        v if v.is_ps_2() && texture => {
            (RuleId::TextureReadOperands, modifier == M::None, "no modifier on texture instructions")
        }
        v if v.is_ps_2() => (RuleId::OnlyNegation, simple, "only -"),
        _ => (RuleId::InvalidSourceModifier, simple, "only -"),
    };
    if !allowed {
        let message = format!("`{}` has a source modifier, {version} allows {expected}", source.register);
        context.breach(rule, source.span, message).label("this modifier");
    }
}
