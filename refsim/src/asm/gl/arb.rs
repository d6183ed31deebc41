//! Parser of `!!ARBfp1.0`: GL_ARB_fragment_program.

use std::collections::BTreeMap;

use super::super::error::{AssembleErrors, ErrorKind, Parsed, SyntaxError};
use super::build::Build;
use super::operand::{self, Mnemonic};
use crate::asm::cursor::Cursor;
use crate::asm::lexer::{Dialect, Token, TokenKind};
use crate::isa::{
    Destination, FIRST_ENVIRONMENT, FogMode, FogOption, FragmentPart, Instruction, Modifier, Opcode, OpcodeClass,
    Program, ProgramResource, Register, RegisterFile, Source, Span, StateBinding, Swizzle, Version,
};

/// Maximum number of declared temporaries; the checker enforces the device's limit.
const MAX_TEMPORARIES: u16 = 256;
/// Highest index of `program.local` and `program.env`.
pub(super) const MAX_PARAMETER: u16 = FIRST_ENVIRONMENT - 1;

/// Options without effect: every instruction is computed in full precision.
const HINTS: [&str; 2] = ["ARB_precision_hint_fastest", "ARB_precision_hint_nicest"];

/// Parses a program whose header `!!ARBfp1.0` is at `header`.
pub(super) fn assemble(text: &str, header: Span) -> Result<Program, AssembleErrors> {
    Ok(parse(text, header)?.build.finish(Version::ArbFp1_0, header))
}

/// See [`crate::asm::parameter_names`].
pub(super) fn parameter_names(text: &str, header: Span) -> BTreeMap<String, Register> {
    let named = |name: String, meaning: &Name| match *meaning {
        Name::Register(register) if register.file == RegisterFile::Constant => Some((name, register)),
        _ => None,
    };
    let names = parse(text, header).map(|parser| parser.names).unwrap_or_default();
    let all = names.iter().flat_map(|(name, meaning)| match meaning {
        Name::Array(all) => (0..).zip(all).filter_map(|(n, one)| named(format!("{name}[{n}]"), one)).collect(),
        _ => Vec::from_iter(named((*name).to_owned(), meaning)),
    });
    all.collect()
}

fn parse(text: &str, header: Span) -> Result<Parser<'_>, AssembleErrors> {
    let cursor = Cursor::new(text, header.end as usize, Dialect::OpenGl);
    let mut parser = Parser {
        cursor,
        build: Build::default(),
        names: BTreeMap::new(),
        temporaries: 0,
        hint: None,
        options_over: false,
    };
    match operand::statements(&mut parser, |parser| &mut parser.cursor, Parser::statement) {
        Some(errors) => Err(errors),
        None => Ok(parser),
    }
}

#[derive(Clone, Debug)]
pub(super) enum Name {
    Register(Register),
    Constant([u32; 4]),
    State(StateBinding),
    /// `PARAM name[n]`.
    Array(Vec<Name>),
}

pub(super) struct Parser<'a> {
    pub(super) cursor: Cursor<'a>,
    build: Build,
    pub(super) names: BTreeMap<&'a str, Name>,
    temporaries: u16,
    /// The precision hint, if any.
    hint: Option<&'a str>,
    /// `true` once a statement other than an option was parsed.
    options_over: bool,
}

impl<'a> Parser<'a> {
    fn statement(&mut self) -> Parsed<()> {
        let token = self.cursor.next();
        if token.text == "OPTION" && self.options_over {
            let help = "options come before all other statements";
            return Err(token.error(ErrorKind::UnexpectedToken, "a statement other than an option", help));
        }
        self.options_over |= token.text != "OPTION";
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
        let all = || format!("one of {}, {}", HINTS.join(", "), FogMode::ALL.map(FogMode::name).join(", "));
        let (expected, help) = match token.text {
            text if HINTS.contains(&text) => {
                if self.hint.replace(text).is_none_or(|before| before == text) {
                    return Ok(());
                }
                ("one precision hint".to_owned(), "a program can have only one of the two hints")
            }
            text => match text.parse() {
                Ok(mode) => {
                    let fog = FogOption { mode, span: token.span };
                    if self.build.fog.replace(fog).is_none_or(|before| before.mode == mode) {
                        return Ok(());
                    }
                    ("one fog option".to_owned(), "a program can have only one fog option")
                }
                Err(_) => (all(), "other options are not supported"),
            },
        };
        Err(token.error(ErrorKind::UnknownOption, expected, help))
    }

    fn temporaries(&mut self) -> Parsed<()> {
        loop {
            let start = self.cursor.peek().span.start;
            let name = self.new_name()?;
            if self.temporaries >= MAX_TEMPORARIES {
                return Err(self.cursor.unexpected("fewer temporaries", "declare at most 256 temporaries"));
            }
            let temporary = Name::Register(Register::new(RegisterFile::Temp, self.temporaries));
            self.bind(&temporary, start);
            self.names.insert(name, temporary);
            self.temporaries += 1;
            if !self.cursor.accept_mark(",") {
                return Ok(());
            }
        }
    }

    /// Parses the rest of `ATTRIB name = fragment.color` or `OUTPUT name = result.color`.
    fn bound(&mut self, what: fn(&mut Self) -> Parsed<Register>) -> Parsed<()> {
        let name = self.new_name()?;
        self.cursor.expect("=", "write `=` and the attribute or output")?;
        let start = self.cursor.peek().span.start;
        let register = what(self)?;
        if !is_written(register.file) {
            self.bind(&Name::Register(register), start);
        }
        self.names.insert(name, Name::Register(register));
        Ok(())
    }

    /// Records that the program binds the object of a name; the binding's text begins at `start`.
    pub(super) fn bind(&mut self, name: &Name, start: u32) {
        let resource = match name {
            Name::Register(register) => ProgramResource::Register(*register),
            Name::Constant(vector) => ProgramResource::constant(*vector),
            Name::State(binding) => ProgramResource::State(*binding),
            Name::Array(all) => return all.iter().for_each(|element| self.bind(element, start)),
        };
        self.build.bind(resource, Span::new(start, self.cursor.last_end()));
    }

    fn alias(&mut self) -> Parsed<()> {
        let name = self.new_name()?;
        self.cursor.expect("=", "write `=` and the other name")?;
        let token = self.cursor.next();
        let old = self.names.get(token.text).cloned().ok_or_else(|| unknown(token, "a name", "declare it first"))?;
        self.names.insert(name, old);
        Ok(())
    }

    fn instruction(&mut self, token: Token<'a>, mnemonic: Mnemonic) -> Parsed<Instruction> {
        let opcode = mnemonic.spelling.opcode;
        let info = opcode.info();
        let Some(count) = info.source_count(Version::ArbFp1_0) else {
            let help = "this instruction belongs to !!FP1.0";
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
            sources.push(if opcode == Opcode::Swz { self.extended(&mut fragment)? } else { self.source()? });
        }
        if texture {
            self.comma()?;
            let unit = self.unit()?;
            sources.insert(1, unit);
            self.comma()?;
            fragment.target = Some(operand::target(&mut self.cursor)?);
        }
        let span = Span::new(token.span.start, self.cursor.last_end());
        Ok(Instruction { fragment, ..Instruction::new(opcode, destination, sources, span) })
    }

    fn comma(&mut self) -> Parsed<()> {
        self.cursor.expect(",", "operands are separated by commas")
    }

    /// Parses the operand of `SWZ`, `R0, x, -y, 0, 1`: a register without swizzle, and a selector per component.
    fn extended(&mut self, fragment: &mut FragmentPart) -> Parsed<Source> {
        let start = self.cursor.peek().span.start;
        let register = self.register()?;
        let (mut swizzle, mut letters) = (Swizzle::IDENTITY, None);
        for (i, slot) in swizzle.0.iter_mut().enumerate() {
            self.cursor.expect(",", "the operand of SWZ has four selectors, separated by commas, and no swizzle")?;
            fragment.negate |= u8::from(operand::sign(&mut self.cursor)) << i;
            let token = self.cursor.next();
            let known =
                ["xyzw01", "rgba01"].iter().enumerate().find_map(|(set, all)| Some((set, all.find(token.text)?)));
            let Some((set, component)) = known.filter(|_| token.text.len() == 1) else {
                let help = "SWZ has one selector per component, each of one letter or digit";
                return Err(token.error(ErrorKind::Swizzle, "x, y, z, w, 0 or 1", help));
            };
            if component < 4 && *letters.get_or_insert(set) != set {
                let help = "letters of xyzw and of rgba cannot be mixed";
                return Err(token.error(ErrorKind::Swizzle, "a letter of the same set as the others", help));
            }
            *slot = component as u8;
        }
        Ok(Source { register, swizzle, modifier: Modifier::None, span: Span::new(start, self.cursor.last_end()) })
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

    /// Parses an image unit: `texture[3]`, or `texture` for the first unit.
    fn unit(&mut self) -> Parsed<Source> {
        let token = self.cursor.next();
        if token.text != "texture" {
            return Err(unknown(token, "texture[0] to texture[15]", "write the number of the texture image unit"));
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
        let negative = operand::sign(&mut self.cursor);
        let register = self.register()?;
        let swizzle = operand::swizzle(&mut self.cursor)?;
        let modifier = if negative { Modifier::Negate } else { Modifier::None };
        Ok(Source { register, swizzle, modifier, span: Span::new(start, self.cursor.last_end()) })
    }

    fn register(&mut self) -> Parsed<Register> {
        let token = self.cursor.peek();
        if token.text == "{" || token.kind == TokenKind::Number {
            let value = operand::constant(&mut self.cursor)?;
            return self.read(Some(Name::Constant(value)), token);
        }
        match token.text {
            "fragment" => {
                let attribute = self.attribute()?;
                return self.read(Some(Name::Register(attribute)), token);
            }
            "program" | "state" => {
                let element = self.element()?;
                return self.read(Some(element), token);
            }
            _ => {}
        }
        self.cursor.next();
        let mut name = self.names.get(token.text).cloned();
        if let Some(Name::Array(all)) = name {
            self.cursor.expect("[", "select an element of the array by its number")?;
            let place = self.cursor.peek();
            let number = operand::index(&mut self.cursor, MAX_PARAMETER)?;
            self.cursor.expect("]", "close the brackets")?;
            let Some(element) = all.get(usize::from(number)) else {
                return Err(unknown(place, &format!("a number below {}", all.len()), "count from 0"));
            };
            name = Some(element.clone());
        }
        self.read(name, token)
    }

    fn read(&mut self, name: Option<Name>, token: Token<'a>) -> Parsed<Register> {
        let span = Span::new(token.span.start, self.cursor.last_end());
        match name {
            Some(Name::State(binding)) => {
                self.build.bind(ProgramResource::State(binding), span);
                self.build.state(binding, span)
            }
            Some(Name::Register(register)) if !is_written(register.file) || register.file == RegisterFile::Temp => {
                self.build.bind(ProgramResource::Register(register), span);
                Ok(register)
            }
            Some(Name::Constant(value)) => {
                self.build.bind(ProgramResource::constant(value), span);
                self.build.literal(value, span)
            }
            _ => Err(unknown(
                token,
                "a temporary, fragment.*, program.*, state.*, a constant or a declared name",
                "declare names with TEMP, ATTRIB or PARAM before their first use",
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
