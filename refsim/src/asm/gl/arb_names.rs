//! Names and parameters of `!!ARBfp1.0`.

use super::super::error::{ErrorKind, Parsed, SyntaxError};
use super::arb::{MAX_PARAMETER, Name, Parser, unknown};
use super::operand;
use crate::asm::lexer::{Token, TokenKind};
use crate::isa::{FIRST_ENVIRONMENT, Register, RegisterFile, Version};

impl<'a> Parser<'a> {
    /// Parses the rest of `PARAM a = {1, 2};` or `PARAM b[2] = { program.local[0..1] };`.
    pub(super) fn parameter(&mut self) -> Parsed<()> {
        let name = self.new_name()?;
        if !self.cursor.accept_mark("[") {
            self.cursor.expect("=", "a parameter is a constant or a value that the host sets")?;
            let start = self.cursor.peek().span.start;
            let value = self.element()?;
            self.bind(&value, start);
            self.names.insert(name, value);
            return Ok(());
        }
        let counted = self.cursor.peek();
        let count = if counted.text == "]" { None } else { Some(operand::index(&mut self.cursor, MAX_PARAMETER)?) };
        self.cursor.expect("]", "close the brackets")?;
        self.cursor.expect("=", "an array is assigned several constants: `= { ... }`")?;
        self.cursor.expect("{", "write the elements of an array between braces")?;
        let mut all = Vec::new();
        loop {
            let (first, start) = (all.len(), self.cursor.peek().span.start);
            self.elements(&mut all)?;
            all[first..].iter().for_each(|element| self.bind(element, start));
            if !self.cursor.accept_mark(",") {
                break;
            }
        }
        self.cursor.expect("}", "close the array")?;
        if let Some(count) = count.filter(|&n| usize::from(n) != all.len()) {
            return Err(SyntaxError::new(
                ErrorKind::ValueCount,
                counted.span,
                format!("{count} elements"),
                format!("{} elements", all.len()),
                "the number of elements differs from the size in the declaration",
            ));
        }
        self.names.insert(name, Name::Array(all));
        Ok(())
    }

    /// Parses one constant or bound parameter.
    pub(super) fn element(&mut self) -> Parsed<Name> {
        match self.cursor.peek().text {
            "program" => Ok(Name::Register(self.program_range(false)?.0)),
            "state" => self.state_item().map(Name::State),
            _ => operand::constant(&mut self.cursor).map(Name::Constant),
        }
    }

    /// Parses an element of an array, or a range of them.
    fn elements(&mut self, all: &mut Vec<Name>) -> Parsed<()> {
        match self.cursor.peek().text {
            "program" => {
                let (first, last) = self.program_range(true)?;
                all.extend((first.index..=last).map(|n| Name::Register(Register::new(first.file, n))));
            }
            "state" => all.extend(self.state_items(true)?.into_iter().map(Name::State)),
            _ => all.push(self.element()?),
        }
        Ok(())
    }

    /// Parses `program.local[3]` or, if `many`, `program.env[0..4]`; returns the first register and the index of the
    /// last.
    fn program_range(&mut self, many: bool) -> Parsed<(Register, u16)> {
        self.cursor.next();
        self.cursor.expect(".", "parameters are program.local[0] or program.env[0]")?;
        let token = self.cursor.next();
        let base = match token.text {
            "local" => 0,
            "env" => FIRST_ENVIRONMENT,
            _ => return Err(unknown(token, "local or env", "parameters are program.local[0] or program.env[0]")),
        };
        self.cursor.expect("[", "write the number of the parameter")?;
        let (first, last) = self.range(many, MAX_PARAMETER)?;
        Ok((Register::new(RegisterFile::Constant, base + first), base + last))
    }

    /// Parses `3]` or, if `many`, `3..5]`; returns the first and last index.
    pub(super) fn range(&mut self, many: bool, most: u16) -> Parsed<(u16, u16)> {
        let first = operand::index(&mut self.cursor, most)?;
        let mut last = first;
        if many && self.cursor.accept_mark("..") {
            let place = self.cursor.peek();
            last = operand::index(&mut self.cursor, most)?;
            if last < first {
                return Err(unknown(place, "a number not below the first", "the range is reversed"));
            }
        }
        let help = if many { "close the brackets" } else { "close the brackets; a range needs an array" };
        self.cursor.expect("]", help)?;
        Ok((first, last))
    }

    pub(super) fn new_name(&mut self) -> Parsed<&'a str> {
        let token = self.cursor.next();
        if token.kind == TokenKind::Word && !reserved(token) && !self.names.contains_key(token.text) {
            return Ok(token.text);
        }
        let help = "names start with a letter, are declared once, and are not reserved words";
        Err(token.error(ErrorKind::Name, "a new name", help))
    }

    /// `fragment.color.secondary`, `fragment.texcoord[1]`
    pub(super) fn attribute(&mut self) -> Parsed<Register> {
        let start = self.cursor.next();
        let help = "attributes are fragment.color, fragment.texcoord[0] and so on";
        if start.text != "fragment" {
            return Err(unknown(start, "fragment.*", help));
        }
        self.cursor.expect(".", help)?;
        let token = self.cursor.next();
        Ok(match token.text {
            "fogcoord" => Register::new(RegisterFile::FogIn, 0),
            "position" => Register::new(RegisterFile::WindowPosition, 0),
            "texcoord" => {
                let mut number = 0;
                if self.cursor.accept_mark("[") {
                    number = operand::index(&mut self.cursor, 7)?;
                    self.cursor.expect("]", "close the brackets")?;
                }
                Register::new(RegisterFile::Texture, number)
            }
            "color" => {
                let which = self.cursor.after_point(&["primary", "secondary"]);
                Register::new(RegisterFile::Input, u16::from(which == Some("secondary")))
            }
            _ => return Err(unknown(token, "color, texcoord, fogcoord or position", help)),
        })
    }
}

/// Returns `true` for the specification's reserved keywords.
fn reserved(token: Token<'_>) -> bool {
    let statement = matches!(token.text, "ALIAS" | "ATTRIB" | "END" | "OPTION" | "OUTPUT" | "PARAM" | "TEMP");
    let group = matches!(token.text, "fragment" | "program" | "result" | "state" | "texture");
    let instruction = |m: operand::Mnemonic| m.spelling.opcode.info().available(Version::ArbFp1_0);
    statement || group || operand::mnemonic(token, false).is_ok_and(instruction)
}
