//! V37 and V51: declarations.

use std::collections::BTreeSet;

use super::RuleId;
use super::context::Context;
use crate::isa::{RegisterFile, Stage, Usage};

pub(super) fn check(context: &mut Context<'_>) {
    let version = context.version;
    let vertex = version.stage() == Stage::Vertex;
    let rule = if vertex { RuleId::AttributeDeclaration } else { RuleId::Declaration };
    let mut registers = BTreeSet::new();
    let mut usages = Vec::new();
    for declaration in &context.program.declarations {
        let register = declaration.destination.register;
        if version.is_ps_1_x() {
            context.breach(rule, declaration.span, format!("{version} has no declarations"));
            continue;
        }
        if declaration.position > 0 {
            context
                .breach(rule, declaration.span, format!("`{register}` is declared after an instruction"))
                .help("move every dcl in front of the first instruction");
        }
        let sampler = matches!(declaration.usage, Usage::Sampler2d | Usage::SamplerCube | Usage::SamplerVolume);
        let fits = match register.file {
            _ if register.relative.is_some() => false,
            RegisterFile::Sampler => sampler && !vertex,
            RegisterFile::Texture => declaration.usage == Usage::Plain && !vertex,
            RegisterFile::Input if vertex => declaration.usage != Usage::Plain && !sampler,
            RegisterFile::Input => declaration.usage == Usage::Plain,
            _ => false,
        };
        if !fits {
            let message = format!("the declaration does not fit `{register}` in {version}");
            let help = if vertex {
                "vertex programs declare v# with a usage: dcl_position v0"
            } else {
                "pixel programs declare t# and v# without a suffix, and s# with a texture type: dcl_2d s0"
            };
            context.breach(rule, declaration.span, message).help(help);
            continue;
        }
        if super::operands::number_in_range(context, register, declaration.span)
            && !registers.insert((register.file, register.index))
        {
            context.breach(rule, declaration.span, format!("`{register}` is declared twice"));
        }
        if vertex && usages.contains(&declaration.usage) {
            context.breach(rule, declaration.span, format!("the usage of `{register}` is declared twice"));
        }
        usages.push(declaration.usage);
    }
    if !version.is_ps_1_x() {
        undeclared(context, rule, &registers, vertex);
    }
}

fn undeclared(context: &mut Context<'_>, rule: RuleId, declared: &BTreeSet<(RegisterFile, u16)>, vertex: bool) {
    let mut reported = BTreeSet::new();
    for (_, instruction) in context.instructions() {
        let kill = instruction.destination.map(|d| (d.register, d.span));
        let reads = instruction.sources.iter().map(|s| (s.register, s.span)).chain(kill);
        for (register, span) in reads {
            let needs = match register.file {
                RegisterFile::Input => true,
                RegisterFile::Texture | RegisterFile::Sampler => !vertex,
                _ => false,
            };
            let key = (register.file, register.index);
            let exists = context.count(register.file).is_some_and(|c| u32::from(register.index) < c.value());
            if needs && exists && !declared.contains(&key) && reported.insert(key) {
                let how = match register.file {
                    RegisterFile::Sampler => format!("write `dcl_2d {register}`, or _cube or _volume"),
                    _ if vertex => format!("write `dcl_position {register}`, or another usage"),
                    _ => format!("write `dcl {register}`"),
                };
                context.breach(rule, span, format!("`{register}` is used but not declared")).help(how);
            }
        }
    }
}
