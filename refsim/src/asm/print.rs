//! Printer of Direct3D programs in canonical form.

use super::declare::usage_suffix;
use super::{number, word};
use crate::isa::{
    ConstantDef, ConstantValue, Declaration, Destination, Instruction, Mask, Modifier, Program, Source, Swizzle,
};
use std::fmt::Write;

const LETTERS: [char; 4] = ['x', 'y', 'z', 'w'];

/// Prints a program in canonical form: one statement per line; definitions before declarations, at their positions
/// among the instructions; lower case, except for registers that Direct3D writes otherwise; components as `xyzw`;
/// modifiers in the order shift, `_sat`, `_pp`; shortest decimals.
///
/// [`super::assemble`] parses the result back to an equal program, if definitions and declarations are in ascending
/// order of position, no mask is empty, and shifts are from -3 to 3.
pub(super) fn print(program: &Program) -> String {
    let mut out = format!("{}\n", program.version);
    let mut constants = program.constants.iter().peekable();
    let mut declarations = program.declarations.iter().peekable();
    for position in 0..=program.instructions.len() {
        let last = position == program.instructions.len();
        while let Some(def) = constants.next_if(|d| last || d.position <= position) {
            definition(&mut out, def);
        }
        while let Some(dcl) = declarations.next_if(|d| last || d.position <= position) {
            declaration(&mut out, dcl);
        }
        if let Some(i) = program.instructions.get(position) {
            instruction(&mut out, i);
        }
    }
    out
}

/// Writing to a string cannot fail.
macro_rules! put {
    ($out:expr, $($arg:tt)*) => {
        if write!($out, $($arg)*).is_err() {
            unreachable!("a string takes everything");
        }
    };
}

fn definition(out: &mut String, def: &ConstantDef) {
    let register = def.register;
    match def.value {
        ConstantValue::Float(bits) => {
            let [x, y, z, w] = bits.map(number::float_text);
            put!(out, "def {register}, {x}, {y}, {z}, {w}\n");
        }
        ConstantValue::Int([x, y, z, w]) => put!(out, "defi {register}, {x}, {y}, {z}, {w}\n"),
        ConstantValue::Bool(value) => put!(out, "defb {register}, {value}\n"),
    }
}

fn declaration(out: &mut String, dcl: &Declaration) {
    out.push_str("dcl");
    let (suffix, index) = usage_suffix(dcl.usage);
    if !suffix.is_empty() {
        put!(out, "_{suffix}");
    }
    if let Some(index) = index.filter(|&n| n > 0) {
        put!(out, "{index}");
    }
    if dcl.destination.partial_precision {
        out.push_str("_pp");
    }
    if dcl.destination.centroid {
        out.push_str("_centroid");
    }
    out.push(' ');
    destination(out, &dcl.destination);
    out.push('\n');
}

fn instruction(out: &mut String, i: &Instruction) {
    if i.coissue {
        out.push('+');
    }
    if let Some(p) = i.predicate {
        out.push_str(if p.not { "(!p0" } else { "(p0" });
        swizzle(out, p.swizzle);
        out.push_str(") ");
    }
    out.push_str(i.opcode.info().mnemonic);
    if let Some(comparison) = i.comparison {
        put!(out, "_{}", comparison.suffix());
    }
    if let Some(d) = &i.destination {
        out.push_str(word::shift_suffix(d.shift));
        out.push_str(if d.saturate { "_sat" } else { "" });
        out.push_str(if d.partial_precision { "_pp" } else { "" });
    }
    let mut separator = " ";
    if let Some(d) = &i.destination {
        out.push_str(separator);
        destination(out, d);
        separator = ", ";
    }
    for s in &i.sources {
        out.push_str(separator);
        source(out, s);
        separator = ", ";
    }
    out.push('\n');
}

fn destination(out: &mut String, d: &Destination) {
    put!(out, "{}", d.register);
    if d.mask != Mask::ALL {
        out.push('.');
        out.extend(d.mask.components().map(|c| LETTERS[c]));
    }
}

fn source(out: &mut String, s: &Source) {
    let (prefix, suffix) = match s.modifier {
        Modifier::None => ("", ""),
        Modifier::Negate => ("-", ""),
        Modifier::Invert => ("1-", ""),
        Modifier::Not => ("!", ""),
        // Not part of Direct3D's syntax.
        Modifier::Absolute => ("", "_abs"),
        Modifier::AbsoluteNegate => ("-", "_abs"),
        Modifier::Bias => ("", "_bias"),
        Modifier::BiasNegate => ("-", "_bias"),
        Modifier::Bx2 => ("", "_bx2"),
        Modifier::Bx2Negate => ("-", "_bx2"),
        Modifier::X2 => ("", "_x2"),
        Modifier::X2Negate => ("-", "_x2"),
        Modifier::Dz => ("", "_dz"),
        Modifier::Dw => ("", "_dw"),
    };
    put!(out, "{prefix}{}{suffix}", s.register);
    swizzle(out, s.swizzle);
}

/// Prints as few letters as possible: none for the identity, and repeated last letters once.
fn swizzle(out: &mut String, s: Swizzle) {
    if s == Swizzle::IDENTITY {
        return;
    }
    let last = s.0[3];
    let len = s.0.iter().rposition(|&c| c != last).map_or(1, |p| p + 2);
    out.push('.');
    out.extend(s.0[..len].iter().map(|&c| LETTERS[usize::from(c & 3)]));
}
