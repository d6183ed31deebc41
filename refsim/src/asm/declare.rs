//! Parsing of definitions (`def`, `defi`, `defb`) and declarations (`dcl`).

use super::error::{ErrorKind, Parsed, SyntaxError, quote};
use super::lexer::{Token, TokenKind};
use super::parser::Parser;
use super::{number, word};
use crate::isa::{ConstantDef, ConstantValue, Declaration, Register, RegisterFile, Span, Usage};

/// The suffix of a usage, and the usage's index if it has one. Used for parsing and printing.
pub(super) fn usage_suffix(usage: Usage) -> (&'static str, Option<u8>) {
    match usage {
        Usage::Plain => ("", None),
        Usage::Sampler2d => ("2d", None),
        Usage::SamplerCube => ("cube", None),
        Usage::SamplerVolume => ("volume", None),
        Usage::Position(n) => ("position", Some(n)),
        Usage::BlendWeight(n) => ("blendweight", Some(n)),
        Usage::BlendIndices(n) => ("blendindices", Some(n)),
        Usage::Normal(n) => ("normal", Some(n)),
        Usage::PointSize(n) => ("psize", Some(n)),
        Usage::TexCoord(n) => ("texcoord", Some(n)),
        Usage::Tangent(n) => ("tangent", Some(n)),
        Usage::Binormal(n) => ("binormal", Some(n)),
        Usage::TessFactor(n) => ("tessfactor", Some(n)),
        Usage::Color(n) => ("color", Some(n)),
        Usage::Fog(n) => ("fog", Some(n)),
        Usage::Depth(n) => ("depth", Some(n)),
        Usage::Sample(n) => ("sample", Some(n)),
    }
}

const SAMPLERS: [Usage; 3] = [Usage::Sampler2d, Usage::SamplerCube, Usage::SamplerVolume];

fn usage(part: &str, span: Span) -> Parsed<Usage> {
    let lower = part.to_ascii_lowercase();
    if let Some(&sampler) = SAMPLERS.iter().find(|u| usage_suffix(**u).0 == lower) {
        return Ok(sampler);
    }
    let name = lower.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &lower[name.len()..];
    let Some(make) = Usage::NUMBERED.iter().find(|make| usage_suffix(make(0)).0 == name) else {
        return Err(SyntaxError::new(
            ErrorKind::UnknownUsage,
            span,
            "a usage (_position _normal _texcoord0 ...), a texture type (_2d _cube _volume), _pp or _centroid",
            quote(&format!("_{part}")),
            "write `dcl_texcoord1 v3`, `dcl_2d s0` or `dcl t0.xy`, for example",
        ));
    };
    let index = if digits.is_empty() { Ok(0) } else { digits.parse() };
    index.map(make).map_err(|_| {
        SyntaxError::new(
            ErrorKind::RegisterNumber,
            span,
            "a usage index of at most 255",
            quote(digits),
            "indices of usages are 0 to 15 in Direct3D",
        )
    })
}

fn values_in_words(count: usize) -> String {
    if count == 1 { "1 value".to_owned() } else { format!("{count} values") }
}

impl<'a> Parser<'a> {
    /// Parses a declaration; its word, `dcl` with suffixes, has been consumed.
    pub(super) fn declaration(&mut self, token: Token<'a>) {
        let hints = self.declaration_hints(&token);
        let destination = if self.at_list_end() {
            Err(self.peek().error(
                ErrorKind::MalformedOperand,
                "the declared register",
                "write `dcl t0.xy` or `dcl_2d s0`, for example",
            ))
        } else {
            self.destination()
        };
        let good = destination.is_ok();
        match (hints, destination) {
            (Ok((usage, partial_precision, centroid)), Ok(mut destination)) => {
                destination.partial_precision = partial_precision;
                destination.centroid = centroid;
                let position = self.instructions.len();
                let span = token.span.join(destination.span);
                self.declarations.push(Declaration { usage, destination, position, span });
            }
            (hints, destination) => {
                for error in [hints.err(), destination.err()].into_iter().flatten() {
                    self.record(error);
                }
            }
        }
        self.end_list(good, "dcl", "one register per declaration");
    }

    fn declaration_hints(&self, token: &Token<'a>) -> Parsed<(Usage, bool, bool)> {
        let mut found = None;
        let (mut partial_precision, mut centroid) = (false, false);
        for (part, span) in word::suffixes(token) {
            let repeated = if part.eq_ignore_ascii_case("pp") {
                std::mem::replace(&mut partial_precision, true)
            } else if part.eq_ignore_ascii_case("centroid") {
                std::mem::replace(&mut centroid, true)
            } else {
                found.replace(usage(part, span)?).is_some()
            };
            if repeated {
                return Err(SyntaxError::new(
                    ErrorKind::RepeatedModifier,
                    span,
                    "one usage, one `_pp` and one `_centroid` at most",
                    quote(&format!("_{part}")),
                    "declare a register once for each usage",
                ));
            }
        }
        Ok((found.unwrap_or(Usage::Plain), partial_precision, centroid))
    }

    /// Parses a definition; its word has been consumed.
    pub(super) fn definition(&mut self, token: Token<'a>) {
        let lower = token.text.to_ascii_lowercase();
        let (file, wanted) = match lower.as_str() {
            "defi" => (RegisterFile::ConstantInt, 4),
            "defb" => (RegisterFile::ConstantBool, 1),
            _ => (RegisterFile::Constant, 4),
        };
        let register = match self.defined_register(file) {
            Ok(register) => Some(register),
            Err(error) => {
                self.record(error);
                self.skip_operand();
                None
            }
        };
        let (values, good) = self.values(file);
        let span = Span::new(token.span.start, self.last_end().max(token.span.end));
        let (Some(register), true) = (register, good) else {
            return;
        };
        let value = match (file, values.as_slice()) {
            (RegisterFile::ConstantBool, &[b]) => ConstantValue::Bool(b != 0),
            (RegisterFile::ConstantInt, &[x, y, z, w]) => ConstantValue::Int([x, y, z, w].map(u32::cast_signed)),
            (RegisterFile::Constant, &[x, y, z, w]) => ConstantValue::Float([x, y, z, w]),
            _ => {
                self.record(SyntaxError::new(
                    ErrorKind::ValueCount,
                    span,
                    format!("`{lower}` with {} after its register", values_in_words(wanted)),
                    values_in_words(values.len()),
                    "a definition sets all components: `def c0, 1, 0, 0, 0`, `defb b0, true`",
                ));
                return;
            }
        };
        let position = self.instructions.len();
        self.constants.push(ConstantDef { register, value, position, span });
    }

    fn defined_register(&mut self, file: RegisterFile) -> Parsed<Register> {
        let token = self.peek();
        let register = self.bare_register()?;
        if register.file == file && register.relative.is_none() {
            return Ok(register);
        }
        Err(SyntaxError::new(
            ErrorKind::NotAConstant,
            Span::new(token.span.start, self.last_end()),
            format!("a register `{}#`", file.prefix()),
            token.found(),
            "`def` defines c#, `defi` defines i#, `defb` defines b#",
        ))
    }

    /// Parses the values of a definition; integers are returned as their bits. Also returns `true` if all are well
    /// formed.
    fn values(&mut self, file: RegisterFile) -> (Vec<u32>, bool) {
        let mut values = Vec::new();
        let mut good = true;
        loop {
            if let Err(error) = self.comma(false) {
                self.record(error);
                good = false;
            }
            if self.peek().kind == TokenKind::Comma {
                continue;
            }
            let signed = self.peek().kind == TokenKind::Plus && self.peek_at(1).kind == TokenKind::Number;
            if self.at_list_end() && !signed {
                return (values, good);
            }
            match self.value(file) {
                Ok(bits) => values.push(bits),
                Err(error) => {
                    self.record(error);
                    self.skip_operand();
                    good = false;
                }
            }
        }
    }

    fn value(&mut self, file: RegisterFile) -> Parsed<u32> {
        let sign = match self.peek().kind {
            TokenKind::Minus | TokenKind::Plus => Some(self.next()),
            _ => None,
        };
        let token = self.peek();
        if matches!(token.kind, TokenKind::Number | TokenKind::Word) {
            self.next();
        }
        let span = sign.map_or(token.span, |s| s.span.join(token.span));
        let text = format!("{}{}", sign.map_or("", |s| s.text), token.text);
        if file == RegisterFile::ConstantBool {
            return match text.to_ascii_lowercase().as_str() {
                "true" | "1" => Ok(1),
                "false" | "0" => Ok(0),
                _ => Err(SyntaxError::new(
                    ErrorKind::MalformedValue,
                    span,
                    "`true` or `false`",
                    token.found(),
                    "write `defb b0, true`",
                )),
            };
        }
        match (token.kind, file) {
            (TokenKind::Number, RegisterFile::ConstantInt) => number::integer(&text, span).map(i32::cast_unsigned),
            (TokenKind::Number, _) => number::float(&text, span),
            _ => Err(SyntaxError::new(
                ErrorKind::MalformedValue,
                span,
                "a number",
                token.found(),
                "write `1`, `-0.5`, `2.5e-3` or the bits of a float, `0x3f800000`",
            )),
        }
    }

    /// Skips surplus text in the line after a complete list; reports it if `report`.
    fn end_list(&mut self, report: bool, name: &str, help: &str) {
        if self.at_list_end() {
            return;
        }
        let token = self.peek();
        if report {
            self.record(token.error(
                ErrorKind::OperandCount,
                format!("the end of the line after `{name}` and its register"),
                help,
            ));
        }
        while !self.at_list_end() {
            self.next();
        }
    }
}
