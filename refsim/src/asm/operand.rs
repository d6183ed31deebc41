//! Parsing of operands: registers with addresses, swizzles, masks and modifiers.

use super::error::{ErrorKind, Parsed, SyntaxError, quote};
use super::letters::{components, mask, swizzle};
use super::lexer::{Token, TokenKind};
use super::limits::MAX_REGISTER;
use super::parser::Parser;
use super::word;
use crate::isa::{Destination, Mask, Modifier, Predicate, Register, RegisterFile, Relative, Source, Span, Swizzle};

/// A source modifier after the register.
#[derive(Clone, Copy)]
enum SourceSuffix {
    Bias,
    Bx2,
    X2,
    Dz,
    Dw,
}

/// A source modifier before the register.
#[derive(Clone, Copy)]
enum SourcePrefix {
    Negate,
    Invert,
    Not,
}

/// A register with its modifiers and selector.
struct NamedRegister<'a> {
    register: Register,
    /// Modifier words, in the order of the text.
    modifiers: Vec<(&'a str, Span)>,
    /// The letters after the point.
    selector: Option<(&'a str, Span)>,
}

fn is_file(letters: &str) -> Option<RegisterFile> {
    RegisterFile::DIRECT3D.iter().copied().find(|f| f.prefix().eq_ignore_ascii_case(letters))
}

/// Parses a register number; `None` if it exceeds [`MAX_REGISTER`].
fn number(digits: &str) -> Option<u16> {
    let digits = digits.trim_start_matches('0');
    match digits.len() {
        0 => Some(0),
        1..=5 => digits.parse().ok(),
        _ => None,
    }
}

fn out_of_range(what: &str, found: &str, span: Span) -> SyntaxError {
    SyntaxError::new(
        ErrorKind::RegisterNumber,
        span,
        format!("a {what} of at most {MAX_REGISTER}"),
        quote(found),
        "no version has more than a few hundred registers of any kind",
    )
}

fn suffix_of(word: &str, span: Span) -> Parsed<SourceSuffix> {
    match word.to_ascii_lowercase().as_str() {
        "bias" => Ok(SourceSuffix::Bias),
        "bx2" => Ok(SourceSuffix::Bx2),
        "x2" => Ok(SourceSuffix::X2),
        "dz" | "db" => Ok(SourceSuffix::Dz),
        "dw" | "da" => Ok(SourceSuffix::Dw),
        lower => Err(SyntaxError::new(
            ErrorKind::UnknownSourceModifier,
            span,
            "one of _bias _bx2 _x2 _dz _dw (or _db _da)",
            quote(&format!("_{word}")),
            match lower {
                "abs" => "`_abs` came with ps_3_0: use `abs`, or `max` of the value and its negative",
                "sat" | "x4" | "x8" | "d2" | "d4" | "d8" | "pp" => {
                    "this modifier belongs on the instruction: `add_sat`, for example"
                }
                _ => "write `r0_bx2` or `-r0_bias`, for example",
            },
        )),
    }
}

fn combine(prefix: Option<SourcePrefix>, suffix: Option<SourceSuffix>, span: Span) -> Parsed<Modifier> {
    Ok(match (prefix, suffix) {
        (None, None) => Modifier::None,
        (Some(SourcePrefix::Negate), None) => Modifier::Negate,
        (Some(SourcePrefix::Invert), None) => Modifier::Invert,
        (Some(SourcePrefix::Not), None) => Modifier::Not,
        (None, Some(SourceSuffix::Bias)) => Modifier::Bias,
        (None, Some(SourceSuffix::Bx2)) => Modifier::Bx2,
        (None, Some(SourceSuffix::X2)) => Modifier::X2,
        (None, Some(SourceSuffix::Dz)) => Modifier::Dz,
        (None, Some(SourceSuffix::Dw)) => Modifier::Dw,
        (Some(SourcePrefix::Negate), Some(SourceSuffix::Bias)) => Modifier::BiasNegate,
        (Some(SourcePrefix::Negate), Some(SourceSuffix::Bx2)) => Modifier::Bx2Negate,
        (Some(SourcePrefix::Negate), Some(SourceSuffix::X2)) => Modifier::X2Negate,
        _ => return Err(clash(span, "a prefix and a suffix that exclude each other")),
    })
}

fn clash(span: Span, found: &str) -> SyntaxError {
    SyntaxError::new(
        ErrorKind::SourceModifierClash,
        span,
        "one source modifier, or `-` with one of _bias _bx2 _x2",
        found,
        "`1-`, `!`, `_dz` and `_dw` cannot be combined with other modifiers",
    )
}

impl<'a> Parser<'a> {
    /// `(p0)`, `(!p0.x)`
    pub(super) fn predicate(&mut self) -> Parsed<Predicate> {
        let open = self.next();
        let not = self.accept(TokenKind::Bang).is_some();
        let bad = |token: Token<'_>, expected: &str| {
            token.error(ErrorKind::Predicate, expected, "write `(p0)`, `(!p0)` or `(p0.x)` in front of the instruction")
        };
        let name = self.next_in_line();
        if name.kind != TokenKind::Word || !name.text.eq_ignore_ascii_case("p0") {
            return Err(bad(name, "the predicate register `p0`"));
        }
        let swizzle = match self.accept(TokenKind::Dot) {
            Some(_) => {
                let letters = self.next_in_line();
                if letters.kind != TokenKind::Word {
                    return Err(bad(letters, "one to four of xyzw"));
                }
                swizzle(letters.text, letters.span)?
            }
            None => Swizzle::IDENTITY,
        };
        let close = self.peek();
        if close.kind != TokenKind::CloseParen {
            return Err(bad(close, "`)`"));
        }
        self.next();
        Ok(Predicate { not, swizzle, span: open.span.join(close.span) })
    }

    fn malformed(&self, expected: &str) -> SyntaxError {
        let token = self.peek();
        let help = match token.kind {
            TokenKind::Number => "an operand cannot be a number: write `def c0, ...` first, then `c0`",
            TokenKind::Newline | TokenKind::End => "the operand is missing",
            _ => "an operand is a register, with optional modifiers and letters: `-r0_bx2.xyz`",
        };
        token.error(ErrorKind::MalformedOperand, expected, help)
    }

    /// Parses a destination, without the modifiers that belong to its instruction's word.
    pub(super) fn destination(&mut self) -> Parsed<Destination> {
        let start = self.peek();
        if matches!(start.kind, TokenKind::Minus | TokenKind::Bang | TokenKind::Number) {
            return Err(match start.kind {
                TokenKind::Number if self.peek_at(1).kind != TokenKind::Minus => self.malformed("a register"),
                _ => self.on_destination(start.span, start.text),
            });
        }
        let named = self.named()?;
        if let Some((modifier, span)) = named.modifiers.first() {
            return Err(self.on_destination(*span, &format!("_{modifier}")));
        }
        let mask = match named.selector {
            Some((letters, span)) => mask(letters, span)?,
            None => Mask::ALL,
        };
        Ok(Destination::new(named.register, mask, Span::new(start.span.start, self.last_end())))
    }

    fn on_destination(&self, span: Span, found: &str) -> SyntaxError {
        SyntaxError::new(
            ErrorKind::ModifierOnDestination,
            span,
            "a register with or without a mask",
            quote(found),
            "the first operand is the result; its modifiers belong on the instruction: `add_x2_sat r0, ...`",
        )
    }

    pub(super) fn source(&mut self) -> Parsed<Source> {
        let start = self.peek().span.start;
        let prefix = match self.peek().kind {
            TokenKind::Minus => Some(SourcePrefix::Negate),
            TokenKind::Bang => Some(SourcePrefix::Not),
            TokenKind::Number if self.peek().text == "1" && self.peek_at(1).kind == TokenKind::Minus => {
                self.next();
                Some(SourcePrefix::Invert)
            }
            _ => None,
        };
        if prefix.is_some() {
            self.next();
        }
        let named = self.named()?;
        let span = Span::new(start, self.last_end());
        let suffix = match named.modifiers.as_slice() {
            [] => None,
            [(word, span)] => Some(suffix_of(word, *span)?),
            [(word, first), .., (last, span)] => {
                suffix_of(word, *first)?;
                suffix_of(last, *span)?;
                return Err(clash(*span, "two suffixes"));
            }
        };
        Ok(Source {
            register: named.register,
            swizzle: match named.selector {
                Some((letters, span)) => swizzle(letters, span)?,
                None => Swizzle::IDENTITY,
            },
            modifier: combine(prefix, suffix, span)?,
            span,
        })
    }

    /// Parses a register without modifiers or selector, for definitions.
    pub(super) fn bare_register(&mut self) -> Parsed<Register> {
        let start = self.peek();
        let named = self.named()?;
        if named.selector.is_some() || !named.modifiers.is_empty() {
            return Err(SyntaxError::new(
                ErrorKind::MalformedOperand,
                Span::new(start.span.start, self.last_end()),
                "a register without letters or modifiers",
                quote(start.text),
                "a definition sets all components: `def c0, 1, 0, 0, 0`",
            ));
        }
        Ok(named.register)
    }

    /// Parses a register and its address, then selector and suffixes in either order.
    fn named(&mut self) -> Parsed<NamedRegister<'a>> {
        let token = self.peek();
        if token.kind != TokenKind::Word {
            return Err(self.malformed("a register"));
        }
        self.next();
        let mut modifiers: Vec<_> = word::suffixes(&token).collect();
        let register = self.register(token)?;
        let after = self.peek();
        if register.1 && after.kind == TokenKind::Word && after.text.starts_with('_') {
            self.next();
            modifiers.extend(word::suffixes(&after));
        }
        let mut selector = None;
        if self.accept(TokenKind::Dot).is_some() {
            let letters = self.peek();
            if letters.kind != TokenKind::Word {
                return Err(letters.error(
                    ErrorKind::Swizzle,
                    "letters after the point",
                    "write `.x`, `.xyz` or `.rgba`, for example",
                ));
            }
            self.next();
            let text = word::base(letters.text);
            let start = letters.span.start;
            selector = Some((text, Span::new(start, start + text.len() as u32)));
            modifiers.extend(word::suffixes(&letters));
        }
        Ok(NamedRegister { register: register.0, modifiers, selector })
    }

    /// Parses the register that starts with `token`, which has been consumed; also returns `true` if an address in
    /// brackets follows it.
    fn register(&mut self, token: Token<'a>) -> Parsed<(Register, bool)> {
        let name = word::base(token.text);
        let span = Span::new(token.span.start, token.span.start + name.len() as u32);
        let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let digits = &name[letters.len()..];
        let Some(file) = is_file(letters).filter(|f| digits.is_empty() || !f.is_unnumbered()) else {
            return Err(SyntaxError::new(
                ErrorKind::UnknownRegister,
                span,
                "a register",
                quote(name),
                "registers are r# v# t# c# i# b# s# a0 aL p0 l# oC# oDepth oPos oFog oPts oD# oT#",
            ));
        };
        let bracket = self.peek().kind == TokenKind::OpenBracket;
        if digits.is_empty() && !file.is_unnumbered() && !bracket {
            return Err(SyntaxError::new(
                ErrorKind::MissingRegisterNumber,
                span,
                format!("a number after `{}`", file.prefix()),
                token.found(),
                format!("write `{}0`, for example", file.prefix()),
            ));
        }
        let base = number(digits).ok_or_else(|| out_of_range("register number", name, span))?;
        let mut register = Register::new(file, base);
        if bracket {
            if file.is_unnumbered() {
                return Err(self.address_error(self.peek(), &format!("`{}` alone", file.prefix())));
            }
            self.address(&mut register)?;
        }
        Ok((register, bracket))
    }

    fn address_error(&self, token: Token<'_>, expected: &str) -> SyntaxError {
        token.error(ErrorKind::RelativeAddress, expected, "write `c[a0.x + 3]`, `c3[a0.x]` or `c[aL + 3]`")
    }

    /// Parses an address such as `[a0.x + 3]`: a sum of numbers and at most one address register.
    fn address(&mut self, register: &mut Register) -> Parsed<()> {
        self.next();
        loop {
            let token = self.next_in_line();
            match token.kind {
                TokenKind::Number => {
                    if !token.text.bytes().all(|b| b.is_ascii_digit()) {
                        return Err(self.address_error(token, "an integer"));
                    }
                    register.index = number(token.text)
                        .and_then(|n| register.index.checked_add(n))
                        .ok_or_else(|| out_of_range("sum of offsets", token.text, token.span))?;
                }
                TokenKind::Word if register.relative.is_some() => {
                    return Err(self.address_error(token, "one address register at most"));
                }
                TokenKind::Word if token.text.eq_ignore_ascii_case("aL") => {
                    register.relative = Some(Relative::Loop);
                }
                TokenKind::Word if token.text.eq_ignore_ascii_case("a0") => {
                    register.relative = Some(Relative::Address(self.address_component()?));
                }
                _ => return Err(self.address_error(token, "`a0.x`, `aL` or a number")),
            }
            let token = self.peek();
            match token.kind {
                TokenKind::Plus => self.next(),
                TokenKind::CloseBracket => break,
                _ => return Err(self.address_error(token, "`+` or `]`")),
            };
        }
        self.next();
        Ok(())
    }

    fn address_component(&mut self) -> Parsed<u8> {
        let point = self.peek();
        if self.accept(TokenKind::Dot).is_none() {
            return Err(self.address_error(point, "`.x`: one component of a0"));
        }
        let letter = self.peek();
        match components(letter.text).as_deref() {
            Some(&[component]) if letter.kind == TokenKind::Word => {
                self.next();
                Ok(component)
            }
            _ => Err(self.address_error(letter, "one letter of xyzw")),
        }
    }
}
