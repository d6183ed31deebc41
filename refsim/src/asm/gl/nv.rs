//! Parser of `!!FP1.0`: GL_NV_fragment_program.

use std::collections::BTreeMap;

use super::super::error::{AssembleErrors, ErrorKind, Parsed, SyntaxError};
use super::build::Build;
use super::operand::{self, Mnemonic};
use crate::asm::cursor::Cursor;
use crate::asm::lexer::{Dialect, Token, TokenKind};
use crate::isa::{
    Condition, ConditionTest, Destination, DestinationRule, FragmentPart, Instruction, Modifier, Opcode, OpcodeClass,
    Program, Register, RegisterFile, Source, Span, Swizzle, Version,
};

/// Highest register number accepted; the checker enforces the version's limits.
const MAX_REGISTER: u16 = 999;
/// Highest index of a local parameter.
const MAX_PARAMETER: u16 = 255;

/// Parses a program whose header `!!FP1.0` is at `header`.
pub(super) fn assemble(text: &str, header: Span) -> Result<Program, AssembleErrors> {
    let mut parser = Parser {
        cursor: Cursor::new(text, header.end as usize, Dialect::OpenGl),
        build: Build::default(),
        names: BTreeMap::new(),
    };
    match operand::statements(&mut parser, |parser| &mut parser.cursor, Parser::statement) {
        Some(errors) => Err(errors),
        None => Ok(parser.build.finish(Version::Fp1_0, header)),
    }
}

#[derive(Clone, Copy)]
enum Name {
    Constant([u32; 4]),
    Parameter(Register),
}

struct Parser<'a> {
    cursor: Cursor<'a>,
    build: Build,
    names: BTreeMap<&'a str, Name>,
}

impl<'a> Parser<'a> {
    fn statement(&mut self) -> Parsed<()> {
        let token = self.cursor.next();
        match token.text {
            "DEFINE" | "DECLARE" => self.definition(token.text == "DEFINE")?,
            _ => {
                let mnemonic = operand::mnemonic(token, true)?;
                let instruction = self.instruction(token, mnemonic)?;
                self.build.instructions.push(instruction);
            }
        }
        self.cursor.expect(";", "a statement ends with `;`")
    }

    /// Parses the rest of `DEFINE name = constant` or `DECLARE name [= constant]`.
    fn definition(&mut self, fixed: bool) -> Parsed<()> {
        let name = self.cursor.next();
        if name.kind != TokenKind::Word || self.names.contains_key(name.text) || reserved(name.text) {
            let (expected, help) =
                ("a new name", "names start with a letter, are declared once, and are not registers");
            return Err(name.error(ErrorKind::Name, expected, help));
        }
        let value = match self.cursor.accept_mark("=") {
            true => operand::constant(&mut self.cursor)?,
            false if fixed => return Err(self.cursor.unexpected("`=`", "a `DEFINE` needs a value")),
            false => [0; 4],
        };
        let name_of = match fixed {
            true => Name::Constant(value),
            false => Name::Parameter(self.build.parameter(name, value)?),
        };
        self.names.insert(name.text, name_of);
        Ok(())
    }

    fn instruction(&mut self, token: Token<'a>, mnemonic: Mnemonic) -> Parsed<Instruction> {
        let opcode = mnemonic.spelling.opcode;
        let info = opcode.info();
        let mut fragment =
            FragmentPart { precision: mnemonic.precision, updates: mnemonic.updates, ..FragmentPart::default() };
        let mut sources = Vec::new();
        let mut destination = None;
        if opcode == Opcode::Kil {
            let open = self.cursor.accept_mark("(");
            fragment.condition = Some(self.condition()?);
            if open {
                self.cursor.expect(")", "close the condition")?;
            }
        } else {
            let (place, condition) = self.destination(mnemonic.saturate)?;
            destination = Some(place);
            fragment.condition = condition;
            let texture = info.class == OpcodeClass::Texture;
            // In the opcode table the image unit is the second operand; in the text it follows the coordinates and
            // derivatives.
            let count = usize::from(info.source_count(Version::Fp1_0).unwrap_or(1)) - usize::from(texture);
            for _ in 0..count {
                self.cursor.expect(",", "operands are separated by commas")?;
                sources.push(self.source()?);
            }
            if texture {
                self.cursor.expect(",", "the image unit follows the coordinates")?;
                let unit = self.unit()?;
                sources.insert(1, unit);
                self.cursor.expect(",", "the kind of texture follows the image unit")?;
                fragment.target = Some(operand::target(&mut self.cursor)?);
            }
        }
        debug_assert_eq!(destination.is_some(), info.destination != DestinationRule::None);
        let span = Span::new(token.span.start, self.cursor.last_end());
        Ok(Instruction { fragment, ..Instruction::new(opcode, destination, sources, span) })
    }

    /// `GT.x`
    fn condition(&mut self) -> Parsed<Condition> {
        let token = self.cursor.next();
        let Ok(test) = token.text.parse() else {
            let names = ConditionTest::ALL.map(ConditionTest::name).join(", ");
            return Err(token.error(
                ErrorKind::Predicate,
                format!("one of {names}"),
                "a condition tests the condition codes: `(GT.x)`",
            ));
        };
        let swizzle = operand::swizzle(&mut self.cursor)?;
        Ok(Condition { test, swizzle, span: Span::new(token.span.start, self.cursor.last_end()) })
    }

    fn destination(&mut self, saturate: bool) -> Parsed<(Destination, Option<Condition>)> {
        let token = self.cursor.next();
        let register = match token.text {
            "RC" => Register::new(RegisterFile::Discard, 0),
            "HC" => Register::new(RegisterFile::HalfDiscard, 0),
            "o" => self.output()?,
            _ => temporary(token).unwrap_or_else(|| {
                Err(token.error(
                    ErrorKind::UnknownRegister,
                    "R#, H#, RC, HC or o[...]",
                    "the first operand is the destination",
                ))
            })?,
        };
        let place = operand::destination(&mut self.cursor, register, token.span.start, saturate)?;
        let condition = match self.cursor.accept_mark("(") {
            true => {
                let condition = self.condition()?;
                self.cursor.expect(")", "close the condition")?;
                Some(condition)
            }
            false => None,
        };
        Ok((place, condition))
    }

    fn output(&mut self) -> Parsed<Register> {
        self.cursor.expect("[", "outputs are o[COLR], o[COLH] and o[DEPR]")?;
        let token = self.cursor.next();
        let file = match token.text {
            "COLR" => RegisterFile::ColorOut,
            "COLH" => RegisterFile::HalfColorOut,
            "DEPR" => RegisterFile::DepthOut,
            _ => return Err(unknown(token, "COLR, COLH or DEPR", "these are the outputs of a fragment program")),
        };
        self.cursor.expect("]", "close the brackets")?;
        Ok(Register::new(file, 0))
    }

    /// `TEX3`, the image unit.
    fn unit(&mut self) -> Parsed<Source> {
        let token = self.cursor.next();
        let number = operand::numbered(token, "TEX", MAX_REGISTER)
            .unwrap_or_else(|| Err(unknown(token, "TEX0 to TEX15", "write the number of the texture image unit")))?;
        Ok(plain(Register::new(RegisterFile::Sampler, number), token.span))
    }

    /// `-|R0.x|`, `f[TEX0].xyxy`, `{1, 2}.x`
    fn source(&mut self) -> Parsed<Source> {
        let start = self.cursor.peek().span.start;
        let negative = operand::sign(&mut self.cursor);
        let absolute = self.cursor.accept_mark("|");
        let register = self.register()?;
        let swizzle = operand::swizzle(&mut self.cursor)?;
        if absolute {
            self.cursor.expect("|", "close the absolute value")?;
        }
        let modifier = match (absolute, negative) {
            (false, false) => Modifier::None,
            (false, true) => Modifier::Negate,
            (true, false) => Modifier::Absolute,
            (true, true) => Modifier::AbsoluteNegate,
        };
        Ok(Source { register, swizzle, modifier, span: Span::new(start, self.cursor.last_end()) })
    }

    fn register(&mut self) -> Parsed<Register> {
        let token = self.cursor.peek();
        if token.text == "{" || token.kind == TokenKind::Number {
            let value = operand::constant(&mut self.cursor)?;
            return self.build.literal(value, Span::new(token.span.start, self.cursor.last_end()));
        }
        self.cursor.next();
        match token.text {
            "f" => return self.attribute(),
            "p" if !self.names.contains_key("p") => {
                self.cursor.expect("[", "parameters are p[0], p[1] and so on")?;
                let number = operand::index(&mut self.cursor, MAX_PARAMETER)?;
                self.cursor.expect("]", "close the brackets")?;
                return Ok(Register::new(RegisterFile::Constant, number));
            }
            _ => {}
        }
        match (self.names.get(token.text), temporary(token)) {
            (Some(&Name::Parameter(register)), _) => Ok(register),
            (Some(&Name::Constant(value)), _) => self.build.literal(value, token.span),
            (None, Some(register)) => register,
            (None, None) => Err(unknown(
                token,
                "R#, H#, f[...], p[#], a name or a constant",
                "declare names with DEFINE or DECLARE before their first use",
            )),
        }
    }

    fn attribute(&mut self) -> Parsed<Register> {
        self.cursor.expect("[", "attributes are f[COL0], f[TEX0] and so on")?;
        let token = self.cursor.next();
        let register = match token.text {
            "WPOS" => Register::new(RegisterFile::WindowPosition, 0),
            "FOGC" => Register::new(RegisterFile::FogIn, 0),
            "COL0" => Register::new(RegisterFile::Input, 0),
            "COL1" => Register::new(RegisterFile::Input, 1),
            _ => {
                let number = operand::numbered(token, "TEX", 7).unwrap_or_else(|| {
                    Err(unknown(
                        token,
                        "WPOS, COL0, COL1, FOGC or TEX0 to TEX7",
                        "these are the attributes of a fragment program",
                    ))
                })?;
                Register::new(RegisterFile::Texture, number)
            }
        };
        self.cursor.expect("]", "close the brackets")?;
        Ok(register)
    }
}

fn plain(register: Register, span: Span) -> Source {
    Source { register, swizzle: Swizzle::IDENTITY, modifier: Modifier::None, span }
}

fn unknown(token: Token<'_>, expected: &str, help: &str) -> SyntaxError {
    token.error(ErrorKind::UnknownRegister, expected, help)
}

fn temporary(token: Token<'_>) -> Option<Parsed<Register>> {
    let full = operand::numbered(token, "R", MAX_REGISTER).map(|n| (RegisterFile::Temp, n));
    let (file, number) = full.or_else(|| Some((RegisterFile::Half, operand::numbered(token, "H", MAX_REGISTER)?)))?;
    Some(number.map(|n| Register::new(file, n)))
}

/// Returns `true` if a name already has a meaning.
fn reserved(name: &str) -> bool {
    let span = Span::default();
    let token = Token { kind: TokenKind::Word, text: name, span };
    matches!(name, "f" | "o" | "p" | "RC" | "HC" | "END" | "DEFINE" | "DECLARE")
        || temporary(token).is_some()
        || operand::mnemonic(token, true).is_ok()
}
