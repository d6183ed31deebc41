//! Binding of a case's constants.

use std::{collections::BTreeMap, ops::Range};

use refsim::{
    asm::parameter_names,
    check::registers,
    device::Profile,
    exec::{CheckedProgram, Constants},
    isa::{FIRST_ENVIRONMENT, ParameterSource, Register, RegisterFile, Version},
};
use toml::Spanned;

use super::{
    CaseError,
    binder::{Binder, register},
    value::{Constant, Number},
};
use crate::names::did_you_mean;
use crate::report::words::counted;

enum ConstantTarget {
    Float(usize),
    Int(usize),
    Bool(usize),
    /// A constant with a name and this number of components.
    Named(usize),
}

impl Binder<'_> {
    /// Binds the constants of a table to a program: `c0`, `i0`, `b0`; for OpenGL programs, the names that they use, and
    /// the names that they declare.
    pub(super) fn constants(
        &self,
        written: &BTreeMap<String, Spanned<Constant>>,
        program: &CheckedProgram,
        profile: &Profile,
    ) -> Result<Constants, CaseError> {
        let mut constants = Constants::default();
        // OpenGL's constants have two names each.
        let mut floats = BTreeMap::new();
        let numbered = parameter_names(program);
        for (name, value) in written {
            let span = value.span();
            match (self.constant_target(name, (program, &numbered), profile, span.clone())?, value.get_ref()) {
                (ConstantTarget::Float(number), Constant::Vector(numbers)) => {
                    if let Some(other) = floats.insert(number, name) {
                        let message = format!("`{other}` and `{name}` are the same constant");
                        let help = "give the constant one value, under one of its names";
                        return Err(self.place.wrong(span, message, help));
                    }
                    *place_at(&mut constants.float, number) = self.four(numbers, span)?;
                }
                (ConstantTarget::Named(width), Constant::Vector(numbers)) => {
                    let singles: Vec<u32> = numbers.iter().map(|number| number.single()).collect();
                    let value = of_width(name, width, &singles);
                    let help = "a scalar has one number, a vector one per component, a matrix one vector per column";
                    let value = value.map_err(|message| self.place.wrong(span, message, help))?;
                    constants.named.insert(name.clone(), value);
                }
                (ConstantTarget::Int(number), Constant::Vector(numbers)) => match integers(numbers) {
                    Some(four) => *place_at(&mut constants.int, number) = four,
                    None => return self.odd(span, format!("expected 4 whole numbers of 32 bits for `{name}`")),
                },
                (ConstantTarget::Bool(number), Constant::Bool(value)) => {
                    *place_at(&mut constants.boolean, number) = *value;
                }
                _ => {
                    return self.odd(span, format!("the value of `{name}` does not fit the register"));
                }
            }
        }
        Ok(constants)
    }

    fn odd<T>(&self, span: Range<usize>, message: String) -> Result<T, CaseError> {
        let help = "write for example `c0 = [0.5, 0, 0, 1]`, `i0 = [3, 0, 1, 0]` or `b0 = true`";
        Err(self.place.wrong(span, message, help))
    }

    fn constant_target(
        &self,
        name: &str,
        (program, numbered): (&CheckedProgram, &BTreeMap<String, Register>),
        profile: &Profile,
        span: Range<usize>,
    ) -> Result<ConstantTarget, CaseError> {
        let declared = || program.parameters.iter().filter(|p| matches!(p.source, ParameterSource::Named(_)));
        if let Some(parameter) = declared().find(|p| p.name == *name) {
            return Ok(ConstantTarget::Named(parameter.width));
        }
        if let Some(register) = numbered.get(name) {
            return Ok(ConstantTarget::Float(register.index.into()));
        }
        let opengl = program.version.is_fragment_program();
        let counts = counts(program.version, profile);
        let file = name.chars().next().and_then(|letter| "cib".find(letter));
        match (file, file.and_then(|file| register(name, counts[file] as usize))) {
            (Some(0), Some(number)) => return Ok(ConstantTarget::Float(number)),
            (Some(1), Some(number)) => return Ok(ConstantTarget::Int(number)),
            (_, Some(number)) => return Ok(ConstantTarget::Bool(number)),
            _ if !opengl => {
                let known = "cib".chars().zip(counts).filter(|(_, count)| *count > 0);
                let known: Vec<String> = known.map(|(c, count)| format!("{c}0 to {c}{}", count - 1)).collect();
                return self.odd(span, format!("expected a constant {}, found `{name}`", known.join(", ")));
            }
            _ => {}
        }
        if let Some(number) = parameter(name, program.version) {
            return Ok(ConstantTarget::Float(number));
        }
        let examples = match program.version {
            Version::Fp1_0 => "`p[0]` to `p[255]`",
            _ => "`program.local[0]` to `program.local[255]`, `program.env[0]` to `program.env[255]`",
        };
        let names: Vec<&String> = declared().map(|p| &p.name).chain(numbered.keys()).collect();
        let message = format!("expected {examples} or a name that the program declares, found `{name}`");
        let meant = did_you_mean(name, names.iter().map(|name| name.as_str()));
        let help = match &*names {
            [] => "the program declares no names".to_owned(),
            names => {
                let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
                format!("{meant}the program declares {}", quoted.join(", "))
            }
        };
        Err(self.place.wrong(span, message, help))
    }
}

/// Numbers of constants `c#`, `i#` and `b#` of a program's version on a device.
pub(super) fn counts(version: Version, profile: &Profile) -> [u32; 3] {
    let count = |file| registers(file, version, profile).unwrap_or(0);
    match version.is_fragment_program() {
        true => [256, 0, 0],
        false => [RegisterFile::Constant, RegisterFile::ConstantInt, RegisterFile::ConstantBool].map(count),
    }
}

/// The value of a named constant; rejects a number of values that differs from its number of components.
pub(super) fn of_width(name: &str, width: usize, numbers: &[u32]) -> Result<[u32; 4], String> {
    if numbers.len() != width {
        let expected = counted(width as u64, "number", "numbers");
        return Err(format!("expected {expected} for `{name}`, found {}", numbers.len()));
    }
    Ok([0, 1, 2, 3].map(|lane| numbers.get(lane).copied().unwrap_or_default()))
}

/// Parses a constant that an OpenGL program refers to by number: `p[3]`, `program.local[3]`, `program.env[3]`.
fn parameter(name: &str, version: Version) -> Option<usize> {
    let (words, rest) = name.split_once('[')?;
    let digits = rest.strip_suffix(']')?;
    let number = register(&format!("c{digits}"), 256)?;
    match (words, version) {
        ("p", Version::Fp1_0) | ("program.local", Version::ArbFp1_0) => Some(number),
        ("program.env", Version::ArbFp1_0) => Some(usize::from(FIRST_ENVIRONMENT) + number),
        _ => None,
    }
}

fn place_at<T: Clone + Default>(list: &mut Vec<T>, index: usize) -> &mut T {
    if list.len() <= index {
        list.resize(index + 1, T::default());
    }
    &mut list[index]
}

fn integers(numbers: &[Number]) -> Option<[i32; 4]> {
    let whole = |number: &Number| match *number {
        // Within the range of `i32` a whole double converts exactly.
        Number::Value(value) if (-2_147_483_648.0..=2_147_483_647.0).contains(&value) && value % 1.0 == 0.0 => {
            Some(value as i32)
        }
        _ => None,
    };
    let four: Vec<i32> = numbers.iter().map(whole).collect::<Option<_>>()?;
    four.try_into().ok()
}
