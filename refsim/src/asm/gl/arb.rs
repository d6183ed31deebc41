//! `!!ARBfp1.0`: GL_ARB_fragment_program. State of the fixed pipeline (`state.*`) is not known here.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::super::error::{AssembleErrors, ErrorKind, Parsed, SyntaxError};
use super::build::Build;
use super::operand::{self, Mnemonic};
use crate::asm::cursor::Cursor;
use crate::asm::lexer::{Dialect, Token, TokenKind};
use crate::isa::{
    Destination, FIRST_ENVIRONMENT, FragmentPart, Instruction, Modifier, Opcode, OpcodeClass, Program, Register,
    RegisterFile, Source, Span, Swizzle, Version,
};

/// Names of temporaries that a program can declare; how many it may use is the checker's business.
const MAX_TEMPORARIES: u16 = 256;
/// The highest `program.local` and `program.env`.
pub(super) const MAX_PARAMETER: u16 = FIRST_ENVIRONMENT - 1;

/// Options that change nothing here: every instruction is computed in full precision.
const HINTS: [&str; 2] = ["ARB_precision_hint_fastest", "ARB_precision_hint_nicest"];

/// Reads a program whose first word is `!!ARBfp1.0` at `header`.
pub(super) fn assemble(text: &str, header: Span) -> Result<Program, AssembleErrors> {
    let cursor = Cursor::new(text, header.end as usize, Dialect::OpenGl);
    let mut parser = Parser { cursor, build: Build::default(), names: BTreeMap::new(), temporaries: 0, hint: None };
    match operand::statements(&mut parser, |parser| &mut parser.cursor, Parser::statement) {
        Some(errors) => Err(errors),
        None => Ok(parser.build.finish(Version::ArbFp1_0, header)),
    }
}

/// The statement that declares a program's temporaries: `R0` to the highest that it names.
pub(super) fn declarations(program: &Program, out: &mut String) {
    let written = program.instructions.iter().filter_map(|i| i.destination).map(|d| d.register);
    let read = program.instructions.iter().flat_map(|i| &i.sources).map(|s| s.register);
    let temporaries = written.chain(read).filter(|r| r.file == RegisterFile::Temp);
    let Some(most) = temporaries.map(|r| r.index).max() else { return };
    let names: Vec<String> = (0..=most).map(|n| format!("R{n}")).collect();
    if writeln!(out, "TEMP {};", names.join(", ")).is_err() {
        unreachable!("a string takes everything");
    }
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub(super) enum Name {
    Register(Register),
    Constant([u32; 4]),
    /// `PARAM name[n]`.
    Array(Vec<Name>),
}

pub(super) struct Parser<'a> {
    pub(super) cursor: Cursor<'a>,
    build: Build,
    pub(super) names: BTreeMap<&'a str, Name>,
    temporaries: u16,
    /// The precision hint, if there was one.
    hint: Option<&'a str>,
}

impl<'a> Parser<'a> {
    fn statement(&mut self) -> Parsed<()> {
        let token = self.cursor.next();
        match token.text {
            "OPTION" => self.option()?,
            "TEMP" => self.temporaries()?,
            "ATTRIB" => self.bound(Self::attribute)?,
            "OUTPUT" => self.bound(Self::output)?,
            "PARAM" => self.parameter()?,
            "ALIAS" => self.alias()?,
            _ => {
                let mnemonic = operand::mnemonic(token, false)?;
                let instruction = self.instruction(token, mnemonic)?;
                self.build.instructions.push(instruction);
            }
        }
        self.cursor.expect(";", "a statement ends with `;`")
    }

    fn option(&mut self) -> Parsed<()> {
        let token = self.cursor.next();
        let help = match token.text {
            text if HINTS.contains(&text) => {
                if self.hint.replace(text).is_none_or(|before| before == text) {
                    return Ok(());
                }
                "a program asks for one of the two"
            }
            text if text.starts_with("ARB_fog_") => {
                "there is no fog after the program: blend with `fragment.fogcoord` in it, the colour in program.local[0]"
            }
            _ => "other options change what a program means",
        };
        let expected = format!("one of {}", HINTS.join(", "));
        Err(token.error(ErrorKind::UnknownOption, expected, help))
    }

    /// A name that means nothing yet.
    pub(super) fn new_name(&mut self) -> Parsed<&'a str> {
        let token = self.cursor.next();
        let reserved = matches!(token.text, "fragment" | "result" | "program" | "state" | "texture" | "vertex" | "END");
        if token.kind == TokenKind::Word && !reserved && !self.names.contains_key(token.text) {
            return Ok(token.text);
        }
        let help = "names start with a letter and stand for one thing";
        Err(token.error(ErrorKind::Name, "a name of its own", help))
    }

    fn temporaries(&mut self) -> Parsed<()> {
        loop {
            let name = self.new_name()?;
            if self.temporaries >= MAX_TEMPORARIES {
                return Err(self.cursor.unexpected("fewer temporaries", "256 names of temporaries are the most"));
            }
            self.names.insert(name, Name::Register(Register::new(RegisterFile::Temp, self.temporaries)));
            self.temporaries += 1;
            if !self.cursor.accept_mark(",") {
                return Ok(());
            }
        }
    }

    /// `ATTRIB name = fragment.color`, `OUTPUT name = result.color`
    fn bound(&mut self, what: fn(&mut Self) -> Parsed<Register>) -> Parsed<()> {
        let name = self.new_name()?;
        self.cursor.expect("=", "the name stands for something")?;
        let register = what(self)?;
        self.names.insert(name, Name::Register(register));
        Ok(())
    }

    fn alias(&mut self) -> Parsed<()> {
        let name = self.new_name()?;
        self.cursor.expect("=", "the name stands for another")?;
        let token = self.cursor.next();
        let old = self.names.get(token.text).cloned().ok_or_else(|| unknown(token, "a name", "declare it first"))?;
        self.names.insert(name, old);
        Ok(())
    }

    fn instruction(&mut self, token: Token<'a>, mnemonic: Mnemonic) -> Parsed<Instruction> {
        let opcode = mnemonic.spelling.opcode;
        let info = opcode.info();
        let Some(count) = info.source_count(Version::ArbFp1_0) else {
            let help = "it belongs to !!FP1.0";
            return Err(token.error(ErrorKind::UnknownOpcode, "an instruction", help));
        };
        let mut fragment = FragmentPart::default();
        let mut sources = Vec::new();
        let mut destination = None;
        let texture = info.class == OpcodeClass::Texture && opcode != Opcode::Kil;
        if opcode != Opcode::Kil {
            destination = Some(self.destination(mnemonic.saturate)?);
            self.comma()?;
        }
        for i in 0..usize::from(count) - usize::from(texture) {
            if i > 0 {
                self.comma()?;
            }
            sources.push(self.source()?);
        }
        if texture {
            self.comma()?;
            let unit = self.unit()?;
            sources.insert(1, unit);
            self.comma()?;
            fragment.target = Some(operand::target(&mut self.cursor)?);
        }
        if let (Opcode::Swz, [source]) = (opcode, &mut *sources) {
            self.extended(source, &mut fragment)?;
        }
        Ok(Instruction {
            opcode,
            comparison: None,
            destination,
            sources,
            coissue: false,
            predicate: None,
            fragment,
            span: Span::new(token.span.start, self.cursor.last_end()),
        })
    }

    fn comma(&mut self) -> Parsed<()> {
        self.cursor.expect(",", "operands stand apart by commas")
    }

    /// `, x, -y, 0, 1` after the operand of `SWZ`.
    fn extended(&mut self, source: &mut Source, fragment: &mut FragmentPart) -> Parsed<()> {
        for (i, slot) in source.swizzle.0.iter_mut().enumerate() {
            self.cursor.expect(",", "SWZ chooses four components")?;
            if self.cursor.accept_mark("-") {
                fragment.negate |= 1 << i;
            } else {
                self.cursor.accept_mark("+");
            }
            let token = self.cursor.next();
            *slot = match token.text {
                "x" | "r" => 0,
                "y" | "g" => 1,
                "z" | "b" => 2,
                "w" | "a" => 3,
                "0" => 4,
                "1" => 5,
                _ => {
                    let help = "each component of SWZ is chosen on its own";
                    let expected = "x, y, z, w, 0 or 1";
                    return Err(token.error(ErrorKind::Swizzle, expected, help));
                }
            };
        }
        source.span.end = self.cursor.last_end();
        Ok(())
    }

    fn destination(&mut self, saturate: bool) -> Parsed<Destination> {
        let token = self.cursor.peek();
        let register = match (token.text, self.names.get(token.text)) {
            ("result", _) => self.output()?,
            (_, Some(&Name::Register(register))) if is_written(register.file) => {
                self.cursor.next();
                register
            }
            _ => return Err(unknown(token, "a temporary or result.*", "declare temporaries with TEMP")),
        };
        operand::destination(&mut self.cursor, register, token.span.start, saturate)
    }

    fn output(&mut self) -> Parsed<Register> {
        let start = self.cursor.next();
        if start.text != "result" {
            return Err(unknown(start, "result.color or result.depth", "these are the outputs of a fragment program"));
        }
        self.cursor.expect(".", "outputs are result.color and result.depth")?;
        let token = self.cursor.next();
        match token.text {
            "color" => Ok(Register::new(RegisterFile::ColorOut, 0)),
            "depth" => Ok(Register::new(RegisterFile::DepthOut, 0)),
            _ => Err(unknown(token, "color or depth", "these are the outputs of a fragment program")),
        }
    }

    /// `texture[3]`, or `texture` for the first image unit.
    fn unit(&mut self) -> Parsed<Source> {
        let token = self.cursor.next();
        if token.text != "texture" {
            return Err(unknown(token, "texture[0] to texture[15]", "texture image units are numbered"));
        }
        let mut number = 0;
        if self.cursor.accept_mark("[") {
            number = operand::index(&mut self.cursor, MAX_PARAMETER)?;
            self.cursor.expect("]", "close the brackets")?;
        }
        let register = Register::new(RegisterFile::Sampler, number);
        let span = Span::new(token.span.start, self.cursor.last_end());
        Ok(Source { register, swizzle: Swizzle::IDENTITY, modifier: Modifier::None, span })
    }

    fn source(&mut self) -> Parsed<Source> {
        let start = self.cursor.peek().span.start;
        let negative = self.cursor.accept_mark("-");
        if !negative {
            self.cursor.accept_mark("+");
        }
        let register = self.register()?;
        let swizzle = operand::swizzle(&mut self.cursor)?;
        let modifier = if negative { Modifier::Negate } else { Modifier::None };
        Ok(Source { register, swizzle, modifier, span: Span::new(start, self.cursor.last_end()) })
    }

    fn register(&mut self) -> Parsed<Register> {
        let token = self.cursor.peek();
        if token.text == "{" || token.kind == TokenKind::Number {
            let value = operand::constant(&mut self.cursor)?;
            return self.build.literal(value, Span::new(token.span.start, self.cursor.last_end()));
        }
        match token.text {
            "fragment" => return self.attribute(),
            "program" => {
                return match self.element()? {
                    Name::Register(register) => Ok(register),
                    _ => Err(unknown(token, "a parameter", "write program.local[0]")),
                };
            }
            _ => self.no_state()?,
        }
        self.cursor.next();
        let mut name = self.names.get(token.text).cloned();
        if let Some(Name::Array(all)) = name {
            self.cursor.expect("[", "an element of an array is chosen by its number")?;
            let place = self.cursor.peek();
            let number = operand::index(&mut self.cursor, MAX_PARAMETER)?;
            self.cursor.expect("]", "close the brackets")?;
            let Some(element) = all.get(usize::from(number)) else {
                return Err(unknown(place, &format!("a number below {}", all.len()), "count from 0"));
            };
            name = Some(element.clone());
        }
        match name {
            Some(Name::Register(register)) if !is_written(register.file) || register.file == RegisterFile::Temp => {
                Ok(register)
            }
            Some(Name::Constant(value)) => self.build.literal(value, token.span),
            _ => Err(unknown(
                token,
                "a temporary, fragment.*, program.*, a constant or a name of one",
                "names are made by TEMP, ATTRIB and PARAM before they are used",
            )),
        }
    }
}

fn is_written(file: RegisterFile) -> bool {
    matches!(file, RegisterFile::Temp | RegisterFile::ColorOut | RegisterFile::DepthOut)
}

pub(super) fn unknown(token: Token<'_>, expected: &str, help: &str) -> SyntaxError {
    token.error(ErrorKind::UnknownRegister, expected, help)
}
